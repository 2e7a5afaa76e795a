/* See bytes.h. */
#include "archive/bytes.h"

#include <errno.h>
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
