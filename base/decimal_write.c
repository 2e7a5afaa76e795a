/* Writes decimal numbers, fast enough for a hundred million of them.
 *
 * Invariant: decimal_write() writes the characters of decimal_write_plain(). It scales the number by a power of ten to
 * 17 digits before the point, as a fixed-point number with 64 bits after it that is too small by less than 2 units of
 * the last bit. Where this error could change a digit or the number of digits, decimal_write_plain() writes it.
 *
 * Why there is a fast way beside the plain one: with the plain one alone, about 190 lines would go, and writing a
 * CSV would take most of the time of a run or a sweep. A number takes 7 times (round ones) to 15 times as long by it
 * with glibc, 3 to 5 times by one printf of %.17g, which is not the shortest form; `motus run -o` of a pendulum,
 * every step, 4.7 times; `motus sweep` of 200000 pendula, 100 steps each, 5 times. C has no such function, and the
 * library depends on the C library alone.
 */
#include "base/decimal.h"

#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Replaces the decimal point of the host's locale by a point. */
static size_t set_point(char *text)
{
    const char *host = localeconv()->decimal_point;
    char *at = *host ? strstr(text, host) : NULL;
    if (at) {
        *at = '.';
        memmove(at + 1, at + strlen(host), strlen(at + strlen(host)) + 1);
    }
    return strlen(text);
}

size_t decimal_write_plain(double value, char out[DECIMAL_MAX])
{
    if (!isfinite(value))
        return (size_t)snprintf(out, DECIMAL_MAX, "%s", isnan(value) ? "nan" : value > 0 ? "inf" : "-inf");
    if (value == trunc(value) && fabs(value) < 1e15) return (size_t)snprintf(out, DECIMAL_MAX, "%.0f", value);
    /* 17 digits always suffice, 15 always survive; what a computation leaves rarely fits into fewer than 16 */
    for (int digits = 15;; digits++) {
        snprintf(out, DECIMAL_MAX, "%.*g", digits, value);
        const size_t length = set_point(out);
        double back;
        if (digits == 17 || (decimal_read(out + (*out == '-'), DECIMAL_MAX, &back) && back == fabs(value)))
            return length;
    }
}

/* Writes the digits of n from the left, and returns how many. */
static int spell(uint64_t n, char *out)
{
    char reversed[20];
    int count = 0;
    /* Two digits at a time take half the divisions. */
    while (n >= 10) {
        unsigned pair = (unsigned)(n % 100);
        n /= 100;
        reversed[count++] = (char)('0' + pair % 10);
        reversed[count++] = (char)('0' + pair / 10);
    }
    if (n > 0 || count == 0) reversed[count++] = (char)('0' + n);
    for (int i = 0; i < count; i++) out[i] = reversed[count - 1 - i];
    return count;
}

size_t decimal_write_whole(uint64_t n, char out[DECIMAL_MAX])
{
    int count = spell(n, out);
    out[count] = 0;
    return (size_t)count;
}

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 wide;

/* The powers of five are products of these: 5^(27 a), a = -11 … 12, as 128 leading bits, cut off; and 5^r, r = 0 … 26,
 * whole. */
enum { STRIDE = 27, FIRST = -11 };
static const struct {
    uint64_t high, low;
} coarse[] = {
    {0xa76c582338ed2621, 0xaf2af2b80af6f24e}, {0x873e4f75e2224e68, 0x5a7744a6e804a291},
    {0xda7f5bf590966848, 0xaf39a475506a899e}, {0xb080392cc4349dec, 0xbd8d794d96aacfb3},
    {0x8e938662882af53e, 0x547eb47b7282ee9c}, {0xe65829b3046b0afa, 0x0cb4a5a3112a5112},
    {0xba121a4650e4ddeb, 0x92f34d62616ce413}, {0x964e858c91ba2655, 0x3a6a07f8d510f86f},
    {0xf2d56790ab41c2a2, 0xfae27299423fb9c3}, {0xc428d05aa4751e4c, 0xaa97e14c3c26b886},
    {0x9e74d1b791e07e48, 0x775ea264cf55347d}, {0x8000000000000000, 0x0000000000000000},
    {0xcecb8f27f4200f3a, 0x0000000000000000}, {0xa70c3c40a64e6c51, 0x999090b65f67d924},
    {0x86f0ac99b4e8dafd, 0x69a028bb3ded71a3}, {0xda01ee641a708de9, 0xe80e6f4820cc9495},
    {0xb01ae745b101e9e4, 0x5ec05dcff72e7f8f}, {0x8e41ade9fbebc27d, 0x14588f13be847307},
    {0xe5d3ef282a242e81, 0x8f1668c8a86da5fa}, {0xb9a74a0637ce2ee1, 0x6d953e2bd7173692},
    {0x95f83d0a1fb69cd9, 0x4abdaf101564f98e}, {0xf24a01a73cf2dccf, 0xbc633b39673c8cec},
    {0xc3b8358109e84f07, 0x0a862f80ec4700c8}, {0x9e19db92b4e31ba9, 0x6c07a2c26a8346d1},
};
/* clang-format off */
static const uint64_t fine[STRIDE] = {
    1, 5, 25, 125, 625, 3125, 15625, 78125, 390625, 1953125, 9765625, 48828125, 244140625, 1220703125, 6103515625,
    30517578125, 152587890625, 762939453125, 3814697265625, 19073486328125, 95367431640625, 476837158203125,
    2384185791015625, 11920928955078125, 59604644775390625, 298023223876953125, 1490116119384765625};
/* clang-format on */

/* bits × 2^exponent, the highest bit set. */
typedef struct scaled {
    wide bits;
    int exponent;
} scaled;

/* Multiplies a and b to 192 bits: the upper 128, and, for rounding and shifting, the lower 64. */
static wide multiply(wide a, uint64_t b, uint64_t *low)
{
    wide bottom = (wide)(uint64_t)a * b, top = (wide)(uint64_t)(a >> 64) * b;
    *low = (uint64_t)bottom;
    return top + (bottom >> 64);
}

/* Returns 10^p, cut off: too small by less than 2^-125 of itself. */
static scaled power_of_ten(int p)
{
    int a = (p >= 0 ? p : p - (STRIDE - 1)) / STRIDE, r = p - STRIDE * a, shift = __builtin_clzll(fine[r]);
    uint64_t low;
    wide c = (wide)coarse[a - FIRST].high << 64 | coarse[a - FIRST].low;
    wide bits = multiply(c, fine[r] << shift, &low);
    /* floor(log2 5^(27 a)) by a multiple of log2 5, good for all a here */
    int exponent = ((STRIDE * a * 1217359) >> 19) - 127 + 64 - shift + p;
    if (!(bits >> 127)) {
        bits = bits << 1 | low >> 63;
        exponent--;
    }
    return (scaled){bits, exponent};
}

/* |value| × 10^p and half the distance to its neighbours, as fixed-point numbers with 64 bits after the point, each
 * too small by less than 2 last bits. */
typedef struct fixed {
    wide value, half;
} fixed;
static fixed scale(uint64_t mantissa, int exponent, int shift, int p)
{
    scaled g = power_of_ten(p);
    uint64_t low;
    wide product = multiply(g.bits, mantissa, &low);
    int q = exponent + g.exponent; /* value = product 2^(q + 64), its 64 lower bits left out */
    return (fixed){product >> -(q + 128), g.bits >> -(q + shift + 63)};
}

enum { DOUBT = 8 }; /* last bits; four times what may be wrong */
#define UNSURE(a, b) ((a) < (b) + DOUBT && (b) < (a) + DOUBT)

/* Rounds the value to a multiple of `unit`. 1: it reads back; 0: it does not; -1: unsure. */
static inline int round_to(fixed f, bool at_power, uint64_t unit, uint64_t *digits)
{
    uint64_t whole = (uint64_t)(f.value >> 64);
    *digits = whole / unit;
    wide rest = (wide)(whole % unit) << 64 | (uint64_t)f.value, middle = (wide)unit << 63;
    if (UNSURE(rest, middle)) return -1;
    bool up = rest > middle;
    *digits += up;
    if (unit == 1) return 1;
    wide away = up ? ((wide)unit << 64) - rest : rest, most = !up && at_power ? f.half / 2 : f.half;
    return UNSURE(away, most) ? -1 : away < most;
}

/* Writes `count` digits as %.*g does; the first stands for 10^place, and zeros at the end are left out. */
static size_t arrange(uint64_t digits, int count, int place, bool negative, char *out)
{
    char text[20], *s = out;
    int n = spell(digits, text);
    while (n > 1 && text[n - 1] == '0') n--;
    if (negative) *s++ = '-';
    if (place >= -4 && place < count) {
        if (place < 0) {
            memcpy(s, "0.000", 5);
            s += 1 - place;
            place = n; /* no other point */
        } else {
            place++;
        }
        for (int i = 0; i < n; i++) {
            if (i == place) *s++ = '.';
            *s++ = text[i];
        }
        for (int i = n; i < place; i++) *s++ = '0';
    } else {
        *s++ = text[0];
        if (n > 1) *s++ = '.';
        memcpy(s, text + 1, (size_t)n - 1);
        s += n - 1;
        *s++ = 'e';
        *s++ = place < 0 ? '-' : '+';
        unsigned power = (unsigned)abs(place);
        if (power < 10) *s++ = '0';
        s += spell(power, s);
    }
    *s = 0;
    return (size_t)(s - out);
}

/* Writes a value fast, and returns the length. 0: unsure. */
static size_t print(double value, char *out)
{
    static const uint64_t ten17 = 100000000000000000;
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    bool negative = bits >> 63;
    uint64_t mantissa = bits & (((uint64_t)1 << 52) - 1);
    int exponent = (int)(bits >> 52 & 0x7FF);
    bool at_power = mantissa == 0 && exponent > 1; /* the neighbour below is only half as far */
    if (exponent > 0)
        mantissa |= (uint64_t)1 << 52;
    else
        exponent = 1;
    int shift = __builtin_clzll(mantissa);
    mantissa <<= shift;
    exponent -= 1075 + shift;
    /* the first digit stands for 10^place or 10^(place + 1) */
    int place = ((exponent + 63) * 78913) >> 18;
    fixed f = scale(mantissa, exponent, shift, 16 - place);
    if ((uint64_t)(f.value >> 64) >= ten17) f = scale(mantissa, exponent, shift, 16 - ++place);
    /* Units are constants, so that the compiler replaces divisions by them. */
    uint64_t digits, one_more = ten17 / 100;
    int count = 15, good = round_to(f, at_power, 100, &digits);
    if (good == 0) {
        count++;
        one_more *= 10;
        good = round_to(f, at_power, 10, &digits);
    }
    if (good == 0) {
        count++;
        one_more *= 10;
        good = round_to(f, at_power, 1, &digits);
    }
    return good < 0 ? 0 : arrange(digits, count, place + (digits == one_more), negative, out);
}
#else
static size_t print(double value, char *out)
{
    (void)value;
    (void)out;
    return 0;
}
#endif

size_t decimal_write(double value, char out[DECIMAL_MAX])
{
    if (!isfinite(value)) return decimal_write_plain(value, out);
    if (fabs(value) < 1e15 && value == (double)(int64_t)value) {
        out[0] = '-';
        int sign = signbit(value) != 0;
        return (size_t)sign + decimal_write_whole((uint64_t)fabs(value), out + sign);
    }
    size_t length = print(value, out);
    return length ? length : decimal_write_plain(value, out);
}

char *decimal_time(double t, double span, char out[DECIMAL_MAX])
{
    if (!(fabs(span) > 0) || !isfinite(span) || !isfinite(t)) return decimal(t, out);
    int digits = 6;
    double parts = fabs(t) / fabs(span);
    for (; parts > 1 && digits < 12; digits++) parts /= 10;
    snprintf(out, DECIMAL_MAX, "%.*g", digits, t);
    set_point(out);
    return out;
}

double decimal_near(double wanted, double off, char out[DECIMAL_MAX])
{
    double value = wanted;
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(out, DECIMAL_MAX, "%.*g", digits, wanted);
        set_point(out);
        const bool negative = *out == '-';
        if (!decimal_read(out + negative, DECIMAL_MAX, &value)) break;
        if (negative) value = -value;
        if (fabs(value - wanted) <= off) break;
    }
    decimal(value, out);
    return value;
}

char *decimal(double value, char out[DECIMAL_MAX])
{
    decimal_write(value, out);
    return out;
}
