/* Numbers as people type them on a command line. */
#include "cli/typed.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>

bool typed_number(const char *s, double *value)
{
    char *end;
    double result = 1;
    bool negative = *s == '-', some = false;
    s += negative || *s == '+';
    if ((*s >= '0' && *s <= '9') || *s == '.') {
        if (s[0] == '0' && (s[1] == 'x' || s[1] == 'X'))
            return false;
        result = strtod(s, &end);
        some = end != s;
        s = end;
    }
    while (*s == ' ')
        s++;
    if (some && *s == '*')
        s++;
    while (*s == ' ')
        s++;
    if (s[0] == 'p' && s[1] == 'i') {
        result *= 3.14159265358979323846;
        some = true;
        s += 2;
    }
    while (*s == ' ')
        s++;
    if (*s == '/') {
        s++;
        while (*s == ' ')
            s++;
        if (!(*s >= '0' && *s <= '9') || (s[0] == '0' && (s[1] == 'x' || s[1] == 'X')))
            return false;
        result /= strtod(s, &end);
        s = end;
    }
    *value = negative ? -result : result;
    return some && *s == 0 && isfinite(*value);
}

bool typed_count(const char *s, int64_t *count, const char **rest)
{
    if (!(*s >= '0' && *s <= '9'))
        return false;
    char *end;
    errno = 0;
    long long n = strtoll(s, &end, 10);
    /* 1e6 is how people write a million */
    if (*end == 'e' || *end == 'E' || *end == '.') {
        double d = strtod(s, &end);
        if (!(d >= 1 && d < 9e18) || d != trunc(d))
            return false;
        n = (long long)d;
    }
    *count = n;
    *rest = end;
    return errno == 0 && n >= 1;
}

bool typed_seed(const char *s, uint64_t *seed)
{
    if (!(*s >= '0' && *s <= '9'))
        return false;
    char *end;
    errno = 0;
    *seed = strtoull(s, &end, 10);
    return errno == 0 && *end == 0;
}
