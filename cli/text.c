/* Text as people see it.
 *
 * Invariant: what leaves text_safe() and text_put() is valid UTF-8 without control characters, whatever bytes came in.
 * The program never calls setlocale(), so printf and strtod use the point everywhere.
 */
#include "cli/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REPLACEMENT = 0xFFFD };

size_t text_decode(const char *text, uint32_t *character)
{
    const unsigned char *s = (const unsigned char *)text;
    *character = s[0];
    if (s[0] < 0x80)
        return 1;
    size_t length = s[0] >= 0xF0 && s[0] < 0xF5 ? 4 : s[0] >= 0xE0 ? 3 : 2;
    uint32_t c = s[0] & (0xFFu >> (length + 1));
    bool good = s[0] >= 0xC2 && s[0] < 0xF5;
    for (size_t i = 1; good && i < length; i++) {
        good = (s[i] & 0xC0) == 0x80;
        if (good)
            c = c << 6 | (s[i] & 0x3Fu);
    }
    static const uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    good = good && c >= smallest[length] && c <= 0x10FFFF && !(c >= 0xD800 && c <= 0xDFFF);
    *character = good ? c : REPLACEMENT;
    return good ? length : 1;
}

bool text_visible(uint32_t c)
{
    if (c < 0x20 || (c >= 0x7F && c < 0xA0))
        return false;
    if (c == 0x061C || c == 0x200E || c == 0x200F || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069))
        return false;
    return c != 0xFEFF;
}

static size_t encode(uint32_t c, char out[4])
{
    if (c < 0x80) {
        out[0] = (char)c;
        return 1;
    }
    size_t length = c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
    for (size_t i = length - 1; i > 0; i--, c >>= 6)
        out[i] = (char)(0x80 | (c & 0x3F));
    static const unsigned char lead[] = {0, 0, 0xC0, 0xE0, 0xF0};
    out[0] = (char)(lead[length] | c);
    return length;
}

void text_safe(const char *s, char *out, size_t size)
{
    size_t used = 0;
    while (*s) {
        uint32_t c;
        char bytes[4];
        s += text_decode(s, &c);
        size_t n = encode(text_visible(c) ? c : REPLACEMENT, bytes);
        if (used + n >= size)
            break;
        memcpy(out + used, bytes, n);
        used += n;
    }
    if (size)
        out[used] = 0;
}

void text_put(FILE *out, const char *s)
{
    while (*s) {
        uint32_t c;
        char bytes[4];
        s += text_decode(s, &c);
        fwrite(bytes, 1, encode(text_visible(c) ? c : REPLACEMENT, bytes), out);
    }
}

typedef struct range { uint32_t first, last; } range;

static bool within(uint32_t c, const range *ranges, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (c >= ranges[i].first && c <= ranges[i].last)
            return true;
    return false;
}

size_t text_width(const char *s)
{
    static const range none[] = {
        {0x300, 0x36F}, {0x483, 0x489}, {0x591, 0x5BD}, {0x610, 0x61A}, {0x64B, 0x65F}, {0x1AB0, 0x1AFF},
        {0x1DC0, 0x1DFF}, {0x200B, 0x200D}, {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}, {0xFE20, 0xFE2F},
    };
    static const range two[] = {
        {0x1100, 0x115F}, {0x2E80, 0x303E}, {0x3041, 0xA4CF}, {0xA960, 0xA97F}, {0xAC00, 0xD7A3}, {0xF900, 0xFAFF},
        {0xFE30, 0xFE6F}, {0xFF00, 0xFF60}, {0xFFE0, 0xFFE6}, {0x1F300, 0x1F64F}, {0x1F900, 0x1F9FF}, {0x20000, 0x3FFFD},
    };
    size_t width = 0;
    while (*s) {
        uint32_t c;
        s += text_decode(s, &c);
        if (!text_visible(c))
            c = REPLACEMENT;
        if (within(c, none, sizeof none / sizeof *none))
            continue;
        width += within(c, two, sizeof two / sizeof *two) ? 2 : 1;
    }
    return width;
}

void text_wrap(FILE *out, const char *s, size_t indent, size_t width)
{
    char word[512];
    size_t column = 0;
    while (*s) {
        size_t blanks = strspn(s, " \n\t"), length = strcspn(s + blanks, " \n\t");
        s += blanks;
        if (length == 0)
            break;
        size_t part = length < sizeof word ? length : sizeof word - 1;
        memcpy(word, s, part);
        word[part] = 0;
        s += part;
        size_t columns = text_width(word);
        if (column > 0 && column + 1 + columns > width) {
            putc('\n', out);
            column = 0;
        }
        if (column == 0)
            fprintf(out, "%*s", (int)indent, "");
        else
            putc(' ', out);
        column += (column == 0 ? indent : 1) + columns;
        text_put(out, word);
    }
    putc('\n', out);
}

void text_number(double value, char out[TEXT_NUMBER])
{
    digits_print(value, out);
}

void text_brief(double value, int digits, char out[TEXT_NUMBER])
{
    if (isnan(value))
        strcpy(out, "-");
    else if (digits < 0 && value != 0 && isfinite(value))
        snprintf(out, TEXT_NUMBER, "%.*e", -digits - 1, value);
    else
        snprintf(out, TEXT_NUMBER, "%.*g", digits < 0 ? -digits : digits, value);
}

void text_seconds(double seconds, char out[TEXT_NUMBER])
{
    if (!(seconds >= 0))
        strcpy(out, "-");
    else if (seconds < 1e-3)
        snprintf(out, TEXT_NUMBER, "%.3g µs", seconds * 1e6);
    else if (seconds < 1)
        snprintf(out, TEXT_NUMBER, "%.3g ms", seconds * 1e3);
    else
        snprintf(out, TEXT_NUMBER, "%.3g s", seconds);
}

size_t text_distance(const char *a, const char *b)
{
    enum { LONGEST = 32 };
    size_t m = strlen(a), n = strlen(b), d[LONGEST + 1][LONGEST + 1];
    if (m > LONGEST || n > LONGEST)
        return LONGEST;
    for (size_t i = 0; i <= m; i++)
        for (size_t j = 0; j <= n; j++) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            size_t best = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            if (d[i - 1][j] + 1 < best)
                best = d[i - 1][j] + 1;
            if (d[i][j - 1] + 1 < best)
                best = d[i][j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && d[i - 2][j - 2] + 1 < best)
                best = d[i - 2][j - 2] + 1;
            d[i][j] = best;
        }
    return d[m][n];
}
