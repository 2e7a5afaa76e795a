/* Numbers on the command line. */
#include "cli/typed.h"

#include "base/decimal.h"

#include <math.h>

bool typed_decimal(const char *s, double *value)
{
    const bool negative = *s == '-';
    s += negative || *s == '+';
    const size_t length = decimal_read(s, SIZE_MAX, value);
    *value = negative ? -*value : *value;
    return length > 0 && !s[length];
}

bool typed_count(const char *s, int64_t *count, const char **rest)
{
    uint64_t n;
    size_t length = decimal_read_whole(s, SIZE_MAX, &n);
    if (length == 0) return false;
    if (s[length] == 'e' || s[length] == 'E' || s[length] == '.') {
        double d;
        length = decimal_read(s, SIZE_MAX, &d);
        if (!(d >= 1 && d < TYPED_COUNT_MAX) || d != trunc(d)) return false;
        n = (uint64_t)d;
    }
    *count = (int64_t)n;
    *rest = s + length;
    return n >= 1 && n <= INT64_MAX;
}

bool typed_seed(const char *s, uint64_t *seed)
{
    const size_t length = decimal_read_whole(s, SIZE_MAX, seed);
    return length > 0 && !s[length];
}
