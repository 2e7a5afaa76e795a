/* Decimals read.
 *
 * Invariant: what the C library is given to round are digits and an exponent without a point, so no locale has a
 * say; and so many digits that what lies behind them decides nothing but that the number is not a tie.
 */
#include "base/decimal.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

/* 767 significant digits are the most that a tie between two doubles can have. */
enum { DIGITS_MAX = 800, EXPONENT_MAX = 100000000 };

static bool digit(const char *s, size_t length, size_t at) { return at < length && s[at] >= '0' && s[at] <= '9'; }

/* e[+-]digits at s[at], or nothing; where it ends. */
static size_t read_exponent(const char *s, size_t length, size_t at, long long *exponent)
{
    if (at >= length || (s[at] != 'e' && s[at] != 'E'))
        return at;
    const bool sign = at + 1 < length && (s[at + 1] == '-' || s[at + 1] == '+');
    size_t end = at + 1 + sign;
    if (!digit(s, length, end))
        return at;
    long long n = 0;
    for (; digit(s, length, end); end++)
        if (n < EXPONENT_MAX)
            n = 10 * n + (s[end] - '0');
    *exponent += sign && s[at + 1] == '-' ? -n : n;
    return end;
}

size_t decimal_read(const char *s, size_t length, double *value)
{
    char text[DIGITS_MAX + 32];
    size_t n = 0, at = 0, digits = 0;
    long long exponent = 0;          /* of the last digit kept */
    bool fraction = false, more = false;
    for (; digit(s, length, at) || (!fraction && at < length && s[at] == '.'); at++) {
        if (s[at] == '.') {
            fraction = true;
            continue;
        }
        digits++;
        if (n == DIGITS_MAX) {
            more = more || s[at] != '0';
            exponent += !fraction;
            continue;
        }
        if (n > 0 || s[at] != '0')
            text[n++] = s[at];
        exponent -= fraction;
    }
    if (digits == 0)
        return 0;
    at = read_exponent(s, length, at, &exponent);
    if (more) {
        text[n++] = '1';
        exponent--;
    }
    snprintf(text + n, sizeof text - n, "%se%lld", n ? "" : "0", exponent);
    *value = strtod(text, NULL);
    return at;
}

size_t decimal_read_whole(const char *s, size_t length, uint64_t *value)
{
    size_t at = 0;
    for (*value = 0; digit(s, length, at); at++) {
        const uint64_t last = (uint64_t)(s[at] - '0');
        if (*value > (UINT64_MAX - last) / 10)
            return 0;
        *value = 10 * *value + last;
    }
    return at;
}
