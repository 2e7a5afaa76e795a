/* What is asked of an operating system, in a module that has none: there is no way out but a trap, time stands still,
 * and there is one locale. These take the place of what the module would otherwise import from its host, so that it
 * imports nothing.
 */
#include <locale.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

_Noreturn void _Exit(int status)
{
    (void)status;
    __builtin_trap();
}

int clock_gettime(clockid_t id, struct timespec *t)
{
    (void)id;
    *t = (struct timespec){0};
    return 0;
}

locale_t newlocale(int mask, const char *name, locale_t base)
{
    (void)mask, (void)name, (void)base;
    return (locale_t)0;
}
locale_t uselocale(locale_t l) { return l; }
void freelocale(locale_t l) { (void)l; }
struct lconv *localeconv(void)
{
    static char point[] = ".";
    static struct lconv c = {.decimal_point = point};
    return &c;
}

/* The engine has instructions for these. */
void *memcpy(void *restrict to, const void *restrict from, size_t n) { return __builtin_memcpy(to, from, n); }
void *memmove(void *to, const void *from, size_t n) { return __builtin_memmove(to, from, n); }
void *memset(void *to, int value, size_t n) { return __builtin_memset(to, value, n); }
