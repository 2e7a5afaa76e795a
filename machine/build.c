/* See build.h.
 *
 * Invariant: a build that this process began is ended by it alone. After fork the copy leaves the original's files and
 * compiler as they are, and begins its own.
 */
#include "machine/build.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

bool build_privileged(void) { return geteuid() != getuid() || getegid() != getgid() || getenv("SUDO_UID") != NULL; }

/* ---- folders ---- */

enum { ABANDONED_SECONDS = 10 * COMPILER_SECONDS_MAX };

/* Removes a folder that is older than `seconds` and holds only files of a compilation. 0 means any age: the clock of
 * time() may be behind that of the files. */
static void remove_folder(int parent, const char *name, time_t seconds)
{
    struct stat s;
    int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    bool ours =
        fd >= 0 && !fstat(fd, &s) && s.st_uid == geteuid() && (seconds == 0 || time(NULL) - s.st_mtime >= seconds);
    DIR *d = ours ? fdopendir(fd) : NULL;
    for (struct dirent *e; d && (e = readdir(d));)
        if (!strncmp(e->d_name, "model", 5) || !strncmp(e->d_name, "cc", 2)) /* ours, and the compiler's own */
            (void)unlinkat(fd, e->d_name, 0);
    if (d)
        closedir(d);
    else if (fd >= 0)
        close(fd);
    if (d) (void)unlinkat(parent, name, AT_REMOVEDIR);
}

/* Removes folders that killed processes have left, since a compiler writes files by name. pattern: the name that
 * mkdtemp is given. */
static void remove_abandoned(const char *pattern)
{
    char parent[PATH_MAX + 80];
    snprintf(parent, sizeof parent, "%s", pattern);
    char *name = strrchr(parent, '/');
    *name++ = 0;
    const size_t n = strlen(name), fixed = n - strlen("XXXXXX");
    DIR *d = opendir(parent);
    for (struct dirent *e; d && (e = readdir(d));)
        if (strlen(e->d_name) == n && !strncmp(e->d_name, name, fixed))
            remove_folder(dirfd(d), e->d_name, ABANDONED_SECONDS);
    if (d) closedir(d);
}

static const char *file_of(const build *b, const char *name, char out[BUILD_FILE_MAX])
{
    snprintf(out, BUILD_FILE_MAX, "%s/%s", b->folder, name);
    return out;
}

const char *build_library(const build *b, char out[BUILD_FILE_MAX]) { return file_of(b, "model.so", out); }

static bool write_source(const char *path, const char *text, size_t length)
{
    const int fd = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    bool ok = fd >= 0;
    while (ok && length > 0) {
        const ssize_t k = write(fd, text, length);
        if (k < 0 && errno == EINTR) continue;
        ok = k > 0;
        if (ok) text += k, length -= (size_t)k;
    }
    if (fd >= 0) close(fd);
    return ok;
}

static void remove_files(build *b)
{
    if (b->folder[0]) remove_folder(AT_FDCWD, b->folder, 0);
    b->folder[0] = 0;
}

/* ---- stages ---- */

static bool start(build *b, char *why, size_t size)
{
    char source[BUILD_FILE_MAX], object[BUILD_FILE_MAX];
    const char *tmp = getenv("TMPDIR");
    if (b->parent[0])
        snprintf(b->folder, sizeof b->folder, "%s/build-XXXXXX", b->parent);
    else
        snprintf(b->folder, sizeof b->folder, "%s/motus-build-XXXXXX",
                 !build_privileged() && tmp && tmp[0] == '/' && strlen(tmp) < 512 ? tmp : "/tmp");
    b->stage = BUILD_COMPILES;
    remove_abandoned(b->folder);
    if (!mkdtemp(b->folder)) {
        snprintf(why, size, "%s: %s", b->folder, strerror(errno));
        b->folder[0] = 0;
        return false;
    }
    file_of(b, "model.c", source);
    file_of(b, "model.o", object);
    if (write_source(source, b->text, b->length))
        return compiler_compile(&b->compiler, source, object, b->how, &b->work, why, size);
    snprintf(why, size, "%s cannot be written: %s", source, strerror(errno));
    return false;
}

bool build_begin(build *b, char *why, size_t size)
{
    if (start(b, why, size)) return true;
    remove_files(b);
    return false;
}

static bool begin_link(build *b, bool alone, char *why, size_t size)
{
    char object[BUILD_FILE_MAX], library[BUILD_FILE_MAX];
    file_of(b, "model.o", object);
    unlink(build_library(b, library));
    b->stage = alone ? BUILD_LINKS_ALONE : BUILD_LINKS;
    if (compiler_link(&b->compiler, object, library, alone, &b->work, why, size)) return true;
    return alone && begin_link(b, false, why, size);
}

bool build_relink(build *b, char *why, size_t size)
{
    return b->stage == BUILD_LINKS_ALONE && begin_link(b, false, why, size);
}

static bool start_again(build *b, char *why, size_t size)
{
    if (compiler_owned(&b->work)) remove_files(b);
    b->again = true;
    return build_begin(b, why, size);
}

build_state build_look(build *b, char *why, size_t size)
{
    char out[BUILD_FILE_MAX];
    const bool compiles = b->stage == BUILD_COMPILES;
    const compiler_state state = compiler_look(&b->work, file_of(b, compiles ? "model.o" : "model.so", out), why, size);
    bool goes_on = state == COMPILER_AT_WORK;
    if (state == COMPILER_DONE && !compiles) return BUILD_DONE;
    if (state == COMPILER_DONE) goes_on = begin_link(b, true, why, size);
    if (state == COMPILER_FAILED) goes_on = build_relink(b, why, size);
    if (state == COMPILER_LOST) goes_on = !b->again && start_again(b, why, size);
    return goes_on ? BUILD_WAIT : BUILD_FAILED;
}

void build_end(build *b)
{
    compiler_stop(&b->work);
    if (compiler_owned(&b->work)) remove_files(b);
}
