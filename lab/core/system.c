/* What the C library asks of an operating system, in a module that has none: no files, no way out but a trap, and
 * time stands still. These take the place of the calls that the module would otherwise import from its host, so that
 * it imports nothing.
 */
#include <wasi/api.h>

#include <locale.h>
#include <stddef.h>
#include <string.h>

__wasi_errno_t __wasi_clock_time_get(__wasi_clockid_t id, __wasi_timestamp_t precision, __wasi_timestamp_t *t)
{
    (void)id, (void)precision;
    *t = 0;
    return 0;
}

__wasi_errno_t __wasi_fd_close(__wasi_fd_t fd)
{
    (void)fd;
    return __WASI_ERRNO_BADF;
}

__wasi_errno_t __wasi_fd_seek(__wasi_fd_t fd, __wasi_filedelta_t offset, __wasi_whence_t whence, __wasi_filesize_t *at)
{
    (void)fd, (void)offset, (void)whence, (void)at;
    return __WASI_ERRNO_BADF;
}

__wasi_errno_t __wasi_fd_write(__wasi_fd_t fd, const __wasi_ciovec_t *list, size_t count, __wasi_size_t *written)
{
    (void)fd, (void)list, (void)count, (void)written;
    return __WASI_ERRNO_BADF;
}

_Noreturn void __wasi_proc_exit(__wasi_exitcode_t status)
{
    (void)status;
    __builtin_trap();
}

/* There is one locale, C's. */
locale_t newlocale(int mask, const char *name, locale_t base)
{
    (void)mask, (void)name, (void)base;
    return (locale_t)0;
}
locale_t uselocale(locale_t l) { return l; }
void freelocale(locale_t l) { (void)l; }

/* No error is of a system. */
char *strerror(int error)
{
    (void)error;
    return "";
}

/* The engine has instructions for these. */
void *memcpy(void *restrict to, const void *restrict from, size_t n) { return __builtin_memcpy(to, from, n); }
void *memmove(void *to, const void *from, size_t n) { return __builtin_memmove(to, from, n); }
void *memset(void *to, int value, size_t n) { return __builtin_memset(to, value, n); }
