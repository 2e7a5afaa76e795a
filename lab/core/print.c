/* snprintf and vsnprintf, instead of the C library's, which are four times as large: they bring its streams and
 * locales along.
 *
 * Invariant: the characters are the C library's in the locale C, for what the library asks for: %d %u %lld %zu %x %X
 * %c %s %g %e %f with + and 0, a width and a precision. Digits of a double are exact, however many are wanted: a double
 * is a whole number times a power of 2 or 1/2, and that of a power of 5 and a power of 10.
 */
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* What is written so far; characters beyond the end are counted and dropped. */
typedef struct sheet {
    char *out;
    size_t size, used;
} sheet;

static void put(sheet *s, char c)
{
    if (s->used + 1 < s->size) s->out[s->used] = c;
    s->used++;
}

static void put_text(sheet *s, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) put(s, text[i]);
}

static void put_many(sheet *s, char c, int count)
{
    for (; count > 0; count--) put(s, c);
}

/* One conversion: %, flags, width, precision, letter. */
typedef struct wish {
    bool plus, zeros, wide; /* wide: 64 bits */
    int width, precision;   /* precision: -1 where there is none */
    char letter;
} wish;

static void put_padded(sheet *s, const wish *w, const char *sign, const char *text, size_t length)
{
    const int missing = w->width - (int)(strlen(sign) + length);
    if (!w->zeros) put_many(s, ' ', missing);
    put_text(s, sign, strlen(sign));
    if (w->zeros) put_many(s, '0', missing);
    put_text(s, text, length);
}

static const char *sign_of(const wish *w, bool negative) { return negative ? "-" : w->plus ? "+" : ""; }

static void put_whole(sheet *s, const wish *w, uint64_t n, unsigned base, const char *sign)
{
    char digits[20];
    size_t at = sizeof digits;
    do digits[--at] = (char)((w->letter == 'X' ? "0123456789ABCDEF" : "0123456789abcdef")[n % base]);
    while (n /= base);
    put_padded(s, w, sign, digits + at, sizeof digits - at);
}

enum { BASE = 1000000000, WORDS = 88, DIGITS = 9 * WORDS }; /* a double has at most 767 digits */

/* All digits of x > 0 from the first to the last that is not 0; x = 0.d1 d2 d3 … times 10^*point. How many. */
static int expand(double x, char digits[DIGITS], int *point)
{
    uint32_t word[WORDS];
    int count = 0, power, fives = 0;
    uint64_t whole = (uint64_t)ldexp(frexp(x, &power), 53);
    for (power -= 53; power < 0 && !(whole & 1); power++) whole >>= 1;
    for (; whole; whole /= BASE) word[count++] = (uint32_t)(whole % BASE);
    for (; power != 0;) { /* times 2, up to 29 times, or 5, up to 12 times and one power of ten less for each */
        uint64_t factor = 1, carry = 0;
        for (int i = 0; i < 29 && power > 0; i++, power--) factor *= 2;
        for (int i = 0; i < 12 && power < 0; i++, power++, fives++) factor *= 5;
        for (int i = 0; i < count; i++, carry /= BASE) {
            carry += word[i] * factor;
            word[i] = (uint32_t)(carry % BASE);
        }
        if (carry) word[count++] = (uint32_t)carry;
    }
    int n = 0, zeros = 0;
    for (int i = count; i-- > 0;)
        for (uint32_t unit = BASE / 10, rest = word[i]; unit; rest %= unit, unit /= 10)
            if (n > 0 || rest / unit)
                digits[n++] = (char)('0' + rest / unit);
            else
                zeros++;
    *point = 9 * count - zeros - fives;
    while (n > 0 && digits[n - 1] == '0') n--;
    return n;
}

/* Rounds to `wanted` digits, a tie to the even one; fewer digits are followed by zeros that are not there. */
static int round_to(char *digits, int count, int wanted, int *point)
{
    if (wanted >= count) return count;
    if (wanted < 0) return 0;
    const bool odd = wanted > 0 && (digits[wanted - 1] - '0') % 2;
    const bool up = digits[wanted] > '5' || (digits[wanted] == '5' && (odd || wanted + 1 < count));
    int n = wanted;
    if (!up) return n;
    while (n > 0 && digits[n - 1] == '9') n--;
    if (n == 0) {
        digits[n++] = '1';
        ++*point;
    } else {
        digits[n - 1]++;
    }
    return n;
}

/* [first, last) of the digits, which may lie before or behind those that are there. */
static void put_digits(sheet *s, const char *digits, int count, int first, int last)
{
    for (; first < last; first++) put(s, first >= 0 && first < count ? digits[first] : '0');
}

static void put_number(sheet *s, const wish *w, double x)
{
    char digits[DIGITS];
    const char *sign = sign_of(w, signbit(x));
    if (!isfinite(x)) {
        put_padded(s, &(wish){.width = w->width}, sign, isnan(x) ? "nan" : "inf", 3);
        return;
    }
    int precision = w->precision < 0 ? 6 : w->precision, point = 1;
    int count = x != 0 ? expand(fabs(x), digits, &point) : 0;
    bool power = w->letter == 'e';
    if (w->letter == 'g') {
        if (precision == 0) precision = 1;
        count = round_to(digits, count, precision, &point);
        while (count > 0 && digits[count - 1] == '0') count--;
        power = point <= -4 || point > precision;
        precision = power ? count - 1 : count - point; /* zeros at the end are left out */
    } else {
        count = round_to(digits, count, power ? precision + 1 : point + precision, &point);
    }
    if (precision < 0) precision = 0;
    put_text(s, sign, strlen(sign));
    const int before = power ? 1 : point;
    if (before > 0)
        put_digits(s, digits, count, 0, before);
    else
        put(s, '0');
    if (precision > 0) put(s, '.');
    put_digits(s, digits, count, before, before + precision);
    if (!power) return;
    put(s, 'e');
    const int exponent = point - 1;
    put_whole(s, &(wish){.width = 3, .zeros = true}, (uint64_t)(exponent < 0 ? -exponent : exponent), 10,
              exponent < 0 ? "-" : "+");
}

static int read_count(const char **format, va_list *arguments)
{
    int n = 0;
    if (**format == '*') {
        ++*format;
        return va_arg(*arguments, int);
    }
    for (; **format >= '0' && **format <= '9'; ++*format) n = 10 * n + (**format - '0');
    return n;
}

static wish read_wish(const char **format, va_list *arguments)
{
    wish w = {.precision = -1};
    for (;; ++*format)
        if (**format == '+')
            w.plus = true;
        else if (**format == '0')
            w.zeros = true;
        else
            break;
    w.width = read_count(format, arguments);
    if (**format == '.') {
        ++*format;
        w.precision = read_count(format, arguments);
    }
    for (; **format == 'l' || **format == 'z'; ++*format) w.wide |= (*format)[0] == 'l' && (*format)[1] == 'l';
    w.letter = *(*format)++;
    return w;
}

static void put_argument(sheet *s, const wish *w, va_list *arguments)
{
    switch (w->letter) {
    case 'd': {
        const int64_t n = w->wide ? va_arg(*arguments, int64_t) : va_arg(*arguments, int);
        put_whole(s, w, n < 0 ? -(uint64_t)n : (uint64_t)n, 10, sign_of(w, n < 0));
        break;
    }
    case 'u':
    case 'x':
    case 'X': {
        const uint64_t n = w->wide ? va_arg(*arguments, uint64_t) : va_arg(*arguments, unsigned);
        put_whole(s, w, n, w->letter == 'u' ? 10 : 16, "");
        break;
    }
    case 'c': put(s, (char)va_arg(*arguments, int)); break;
    case 's': {
        const char *text = va_arg(*arguments, const char *);
        put_padded(s, w, "", text, w->precision < 0 ? strlen(text) : strnlen(text, (size_t)w->precision));
        break;
    }
    case 'e':
    case 'f':
    case 'g': put_number(s, w, va_arg(*arguments, double)); break;
    default: put(s, w->letter); /* %% */
    }
}

int vsnprintf(char *restrict out, size_t size, const char *format, va_list list)
{
    sheet s = {out, size, 0};
    va_list arguments;
    va_copy(arguments, list);
    while (*format) {
        const char c = *format++;
        if (c != '%') {
            put(&s, c);
        } else {
            const wish w = read_wish(&format, &arguments);
            put_argument(&s, &w, &arguments);
        }
    }
    va_end(arguments);
    if (size > 0) out[s.used < size ? s.used : size - 1] = 0;
    return (int)s.used;
}

int snprintf(char *restrict out, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(out, size, format, arguments);
    va_end(arguments);
    return length;
}
