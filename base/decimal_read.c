/* Reads decimal numbers, rounded to the nearest double, ties to even.
 *
 * Invariant: a number is held as an integer of as many bits as it needs, with a flag for a remainder that was cut off;
 * so it is rounded once, and neither the locale nor the C library matters.
 */
#include "base/decimal.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* A tie between two doubles has at most 767 significant digits; 10^-330 rounds to 0, and 10^310 is infinite. */
enum { DIGITS_MAX = 800, EXPONENT_MAX = 100000000, SMALLEST = -330, LARGEST = 310, WORDS = 96 };

typedef struct number {
    uint32_t word[WORDS]; /* the lowest word first, the highest of `count` not 0 */
    int count;
    bool more; /* the number is a little larger */
} number;

static void times_plus(number *n, uint32_t factor, uint32_t plus)
{
    uint64_t carry = plus;
    for (int i = 0; i < n->count; i++) {
        carry += (uint64_t)n->word[i] * factor;
        n->word[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry) n->word[n->count++] = (uint32_t)carry;
}

static void over(number *n, uint32_t divisor)
{
    uint64_t rest = 0;
    for (int i = n->count; i-- > 0;) {
        rest = rest << 32 | n->word[i];
        n->word[i] = (uint32_t)(rest / divisor);
        rest %= divisor;
    }
    while (n->count > 0 && n->word[n->count - 1] == 0) n->count--;
    n->more = n->more || rest != 0;
}

/* Applies 5^p in as few steps as 32 bits allow. */
static void by_fives(number *n, int p, void (*step)(number *, uint32_t))
{
    while (p > 0) {
        uint32_t power = 1;
        for (int i = 0; i < 13 && p > 0; i++, p--) power *= 5;
        step(n, power);
    }
}

static void times(number *n, uint32_t factor) { times_plus(n, factor, 0); }

static uint64_t bit(const number *n, int k) { return k >= 0 && k < 32 * n->count ? n->word[k / 32] >> k % 32 & 1 : 0; }

/* Returns n × 2^exponent as a double, with the double on its other side, and what rounding has left out. */
static double rounded(const number *n, int exponent, double *other, double *rest)
{
    enum { BITS = 53 };
    int top = 32 * n->count - 1;
    while (!bit(n, top)) top--;
    int last = top - 52; /* the last bit that a double keeps, at least 2^-1074 */
    if (last + exponent < -1074) last = -1074 - exponent;
    uint64_t mantissa = 0;
    for (int k = top; k >= last; k--) mantissa = mantissa << 1 | bit(n, k);
    bool more = n->more;
    for (int k = last - 2; !more && k >= 0; k--) more = bit(n, k);
    const bool half = bit(n, last - 1), up = half && (more || mantissa & 1);
    mantissa += up;
    uint64_t left = 0;
    for (int k = last - 1; k >= last - BITS; k--) left = left << 1 | bit(n, k);
    *rest = ldexp((double)left - (up ? (double)(UINT64_C(1) << BITS) : 0), last + exponent - BITS);
    /* Above a power of two the neighbour below is nearer than the last bit says. */
    const double value = ldexp((double)mantissa, last + exponent);
    *other = !half && !more ? value : nextafter(value, up ? 0 : INFINITY);
    return value;
}

/* Returns n × 10^exponent as a double, with the double on its other side, and what rounding has left out. */
static double scaled(number *n, int exponent, double *other, double *rest)
{
    int words = 0;
    if (exponent >= 0) {
        by_fives(n, exponent, times);
    } else {
        /* Zeros after the number let the quotient have more bits than two doubles: log2 of 5 is below 7/3. */
        words = -exponent * 7 / 3 / 32 + 6 - n->count;
        words = words > 0 ? words : 0;
        memmove(n->word + words, n->word, (size_t)n->count * sizeof *n->word);
        memset(n->word, 0, (size_t)words * sizeof *n->word);
        n->count += words;
        by_fives(n, -exponent, over);
    }
    return rounded(n, exponent - 32 * words, other, rest);
}

static bool digit(const char *s, size_t length, size_t at) { return at < length && s[at] >= '0' && s[at] <= '9'; }

/* Reads e[+-]digits at s[at], if it is there. Returns where it ends. */
static size_t read_exponent(const char *s, size_t length, size_t at, int64_t *exponent)
{
    if (at >= length || (s[at] != 'e' && s[at] != 'E')) return at;
    const bool sign = at + 1 < length && (s[at + 1] == '-' || s[at + 1] == '+');
    size_t end = at + 1 + sign;
    if (!digit(s, length, end)) return at;
    int64_t n = 0;
    for (; digit(s, length, end); end++)
        if (n < EXPONENT_MAX) n = 10 * n + (s[end] - '0');
    *exponent += sign && s[at + 1] == '-' ? -n : n;
    return end;
}

size_t decimal_read_between(const char *s, size_t length, double *value, double *other, double *rest)
{
    number n = {.count = 0};
    size_t at = 0, digits = 0;
    int significant = 0;
    int64_t exponent = 0; /* of the last digit that is kept */
    bool fraction = false;
    for (; digit(s, length, at) || (!fraction && at < length && s[at] == '.'); at++) {
        if (s[at] == '.') {
            fraction = true;
            continue;
        }
        digits++;
        if (significant == DIGITS_MAX) {
            n.more = n.more || s[at] != '0';
            exponent += !fraction;
            continue;
        }
        times_plus(&n, 10, (uint32_t)(s[at] - '0'));
        significant += n.count > 0;
        exponent -= fraction;
    }
    if (digits == 0) return 0;
    *rest = 0;
    at = read_exponent(s, length, at, &exponent);
    if (n.count == 0)
        *other = *value = 0;
    else if (significant + exponent < SMALLEST)
        *value = 0, *other = nextafter(0, 1);
    else if (significant + exponent > LARGEST)
        *value = INFINITY, *other = nextafter(INFINITY, 0);
    else
        *value = scaled(&n, (int)exponent, other, rest);
    return at;
}

size_t decimal_read(const char *s, size_t length, double *value)
{
    double other, rest;
    return decimal_read_between(s, length, value, &other, &rest);
}

size_t decimal_read_whole(const char *s, size_t length, uint64_t *value)
{
    size_t at = 0;
    for (*value = 0; digit(s, length, at); at++) {
        const uint64_t last = (uint64_t)(s[at] - '0');
        if (*value > (UINT64_MAX - last) / 10) return 0;
        *value = 10 * *value + last;
    }
    return at;
}

double decimal_scaled(double digits, int power)
{
    char text[48];
    double value = NAN;
    const int length = snprintf(text, sizeof text, "%.0fe%d", digits, power);
    decimal_read(text, (size_t)length, &value);
    return value;
}
