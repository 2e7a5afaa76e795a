/* Linearly or logarithmically spaced values.
 *
 * Invariant: the first and the last value are exactly those given. Only the four operations and fma() are used, so the
 * values have the same bits on every machine. Numbers have 106 bits, and an end is the decimal that was typed, so that
 * the values equal typed numbers: 0.15 in 0:1:101, powers of ten in log:0.001:1:4.
 */
#include "cli/model/range.h"

#include "base/decimal.h"

#include <math.h>
#include <stdlib.h>

/* Returns a + b without loss [Dekker71]. */
static range_pair sum(double a, double b)
{
    double s = a + b, z = s - a;
    return (range_pair){s, (a - (s - z)) + (b - z)};
}

static range_pair product(range_pair a, range_pair b)
{
    double p = a.high * b.high;
    return sum(p, fma(a.high, b.high, -p) + (a.high * b.low + a.low * b.high));
}

static range_pair quotient(range_pair a, range_pair b)
{
    double q = a.high / b.high;
    range_pair p = product(b, (range_pair){q, 0});
    return sum(q, ((a.high - p.high) + (a.low - p.low)) / b.high);
}

static range_pair power(range_pair base, uint64_t n)
{
    range_pair result = {1, 0};
    for (; n > 0; n >>= 1) {
        if (n & 1) result = product(result, base);
        if (n > 1) base = product(base, base);
    }
    return result;
}

/* Returns q^(1/n) for q ≥ 1: to double precision by halving an interval, and then by Newton's method. */
static range_pair root(range_pair q, uint64_t n)
{
    double low = 1, high = q.high;
    for (double middle; (middle = low + (high - low) / 2) > low && middle < high;) {
        /* an overflow gives NaN, which is not less than q */
        if (power((range_pair){middle, 0}, n).high < q.high)
            low = middle;
        else
            high = middle;
    }
    range_pair r = {low, 0};
    for (int i = 0; i < 3; i++) {
        range_pair p = power(r, n);
        double off = ((p.high - q.high) + (p.low - q.low)) / q.high;
        r = sum(r.high, r.low - r.high * (off / (double)n));
    }
    return r;
}

/* Returns the shortest decimal that reads as `value`, the one that was typed: 0.1 is a tenth. Beyond 1e±280, returns
 * `value`. */
static range_pair as_typed(double value)
{
    if (!(fabs(value) > 1e-280 && fabs(value) < 1e280)) return (range_pair){value, 0};
    char text[DECIMAL_MAX];
    decimal_write(fabs(value), text);
    double digits[2] = {0, 0}; /* the last eight digits, and those before */
    int places = 0, count = 0;
    const char *s = text;
    for (bool point = false; *s && *s != 'e'; s++) {
        if (*s == '.')
            point = true;
        else
            count++;
        places += point && *s != '.';
    }
    uint64_t exponent = 0;
    if (*s == 'e') decimal_read_whole(s + 2, DECIMAL_MAX, &exponent);
    int power_of_ten = (*s == 'e' && s[1] == '-' ? -(int)exponent : (int)exponent) - places;
    for (s = text; *s && *s != 'e'; s++)
        if (*s != '.') {
            double *part = &digits[count-- > 8];
            *part = *part * 10 + (*s - '0');
        }
    range_pair all = sum(copysign(digits[1] * 1e8, value), copysign(digits[0], value)),
               scale = power((range_pair){10, 0}, (uint64_t)abs(power_of_ten));
    return power_of_ten < 0 ? quotient(all, scale) : product(all, scale);
}

range range_linear(double from, double to, uint64_t count)
{
    return (range){.from = from, .to = to, .last = count - 1, .low = as_typed(from), .high = as_typed(to)};
}

range range_log(double from, double to, uint64_t count)
{
    double a = fmin(fabs(from), fabs(to)), b = fmax(fabs(from), fabs(to));
    range r = {.from = from, .to = to, .last = count - 1, .logarithmic = true, .low = as_typed(a), .high = {1, 0}};
    if (r.last > 0) r.high = root(quotient(as_typed(b), r.low), r.last);
    return r;
}

static double between(const range *r, uint64_t k)
{
    range_pair n = {(double)r->last, 0}, a = product(r->low, (range_pair){(double)(r->last - k), 0}),
               b = product(r->high, (range_pair){(double)k, 0});
    range_pair s = sum(a.high, b.high), v = sum(s.high, s.low + (a.low + b.low));
    /* only the rounding to 106 bits keeps this difference from 0 */
    if (fabs(v.high) < 0x1p-99 * (fabs(a.high) + fabs(b.high))) return 0;
    return quotient(v, n).high;
}

double range_value(const range *r, uint64_t k)
{
    if (k == 0) return r->from;
    if (k == r->last) return r->to;
    if (!r->logarithmic) return between(r, k);
    bool down = fabs(r->to) < fabs(r->from);
    range_pair p = product(power(r->high, down ? r->last - k : k), r->low);
    return r->from < 0 ? -p.high : p.high;
}
