/* See disk.h. */
#include "base/disk.h"

#include "base/platform.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Synchronises the size of a file with its data; its times need not be. */
bool disk_sync(int descriptor)
{
    return fdatasync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EINTR;
}

void disk_sync_name(const char *path)
{
    char *folder = disk_real(path);
    if (!folder) return;
    char *slash = strrchr(folder, '/');
    if (slash) slash[1] = 0;
    const int descriptor = open(slash ? folder : ".", O_RDONLY | O_CLOEXEC);
    if (descriptor >= 0) {
        (void)fsync(descriptor);
        close(descriptor);
    }
    free(folder);
}

char *disk_real(const char *path)
{
    char *real = realpath(path, NULL);
    return real ? real : strdup(path);
}

char *disk_beside(const char *name, const char *ending)
{
    char *beside = malloc(strlen(name) + strlen(ending) + 1);
    return beside ? strcat(strcpy(beside, name), ending) : NULL;
}

bool disk_replace(const char *from, const char *name)
{
    if (rename(from, name) != 0) return false;
    disk_sync_name(name);
    return true;
}

int disk_nameless(const char *name, int mode)
{
    char *folder = strdup(name);
    if (!folder) return -1;
    char *slash = strrchr(folder, '/');
    if (slash) slash[1] = 0;
    const int descriptor = platform_nameless(slash ? folder : ".", mode);
    free(folder);
    return descriptor;
}

/* Returns a free name in the folder of `name`; the caller frees it. NULL: errno says why. */
static char *free_name(const char *name)
{
    static const char beside[] = ".motus-XXXXXX";
    const char *slash = strrchr(name, '/');
    const size_t folder = slash ? (size_t)(slash - name) + 1 : 0;
    char *made = malloc(folder + sizeof beside);
    if (!made) return NULL;
    memcpy(made, name, folder);
    memcpy(made + folder, beside, sizeof beside);
    const int descriptor = mkstemp(made);
    if (descriptor < 0) {
        free(made);
        return NULL;
    }
    close(descriptor);
    unlink(made);
    return made;
}

bool disk_name(int descriptor, const char *name)
{
    char place[PLATFORM_PLACE], *between = NULL;
    platform_place(descriptor, place);
    bool named = linkat(AT_FDCWD, place, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
    if (named) disk_sync_name(name);
    for (int tries = 0; !named && errno == EEXIST && tries < 100; tries++) {
        free(between);
        between = free_name(name);
        if (!between) break;
        if (linkat(AT_FDCWD, place, AT_FDCWD, between, AT_SYMLINK_FOLLOW) != 0) continue;
        named = disk_replace(between, name);
        if (named) break;
        const int code = errno;
        unlink(between);
        errno = code;
        break;
    }
    const int code = errno;
    free(between);
    errno = code;
    return named;
}
