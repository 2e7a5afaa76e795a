/* A cache of compiled objects: one for this program alone, removed at its end, or the one that all programs of a run of
 * `make test` share, where MOTUS_TEST_CACHE names it. An object does not depend on what compiled the library, so
 * sanitized tests find what the release tests compiled. */
#ifndef TEST_GIVEN_CACHE_H
#define TEST_GIVEN_CACHE_H

#include "motus.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static char given_cache[] = "/tmp/motus-cache-XXXXXX";

static inline void open_cache(void)
{
    if (!mkdtemp(given_cache)) exit(1);
    setenv("XDG_CACHE_HOME", given_cache, 1);
    unsetenv("SUDO_UID");
}

static inline void open_shared_cache(void)
{
    const char *shared = getenv("MOTUS_TEST_CACHE");
    if (!shared) {
        open_cache();
        return;
    }
    setenv("XDG_CACHE_HOME", shared, 1);
    unsetenv("SUDO_UID");
    given_cache[0] = 0; /* none to remove */
}

static inline void close_cache(void)
{
    if (!given_cache[0]) return;
    char path[600];
    motus_cache_clear();
    snprintf(path, sizeof path, "%s/motus", given_cache);
    DIR *d = opendir(path);
    for (struct dirent *e; d && (e = readdir(d));) {
        char file[1200];
        snprintf(file, sizeof file, "%s/%s", path, e->d_name);
        if (e->d_name[0] != '.') unlink(file);
    }
    if (d) closedir(d);
    rmdir(path);
    rmdir(given_cache);
}

#endif
