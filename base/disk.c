/* See disk.h. */
#define _XOPEN_SOURCE 700
#include "base/disk.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The size of a file is synchronised with its data, its times need not be. */
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
