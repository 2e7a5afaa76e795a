/* See bytes.h. */
#define _XOPEN_SOURCE 700
#include "archive/bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool bytes_get(int descriptor, void *bytes, size_t count, uint64_t place)
{
    for (char *at = bytes; count > 0;) {
        const ssize_t got = pread(descriptor, at, count, (off_t)place);
        if (got < 0 && errno == EINTR) continue;
        if (got == 0) errno = 0;
        if (got <= 0) return false;
        at += got, place += (uint64_t)got, count -= (size_t)got;
    }
    return true;
}

bool bytes_put(int descriptor, const void *bytes, size_t count, uint64_t place)
{
    for (const char *at = bytes; count > 0;) {
        const ssize_t done = pwrite(descriptor, at, count, (off_t)place);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return false;
        at += done, place += (uint64_t)done, count -= (size_t)done;
    }
    return true;
}

/* A real failure to write reports EIO, ENOSPC or EDQUOT. */
bool bytes_sync(int descriptor)
{
    return fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EINTR;
}

void bytes_sync_name(const char *path)
{
    char *folder = realpath(path, NULL), *slash = folder ? strrchr(folder, '/') : NULL; /* where a link leads */
    if (slash) slash[1] = 0;
    const int descriptor = folder ? open(slash ? folder : ".", O_RDONLY | O_CLOEXEC) : -1;
    if (descriptor >= 0) {
        (void)fsync(descriptor);
        close(descriptor);
    }
    free(folder);
}
