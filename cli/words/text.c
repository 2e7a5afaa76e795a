/* Text for a terminal.
 *
 * Invariant: text_safe() and text_put() write valid UTF-8 without control characters, whatever bytes they get. The
 * program never calls setlocale(), so printf writes a decimal point in every locale.
 */
#include "cli/words/text.h"

#include "base/platform.h"
#include "base/utf8.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { REPLACEMENT = 0xFFFD };

size_t text_decode(const char *s, uint32_t *character)
{
    const size_t n = utf8_read(s, SIZE_MAX, character);
    if (n == 0) *character = REPLACEMENT;
    return n ? n : 1;
}

void text_safe(const char *s, char *out, size_t size)
{
    size_t used = 0;
    while (*s) {
        uint32_t c;
        char bytes[4];
        s += text_decode(s, &c);
        size_t n = utf8_write(utf8_visible(c) ? c : REPLACEMENT, bytes);
        if (used + n >= size) break;
        memcpy(out + used, bytes, n);
        used += n;
    }
    if (size) out[used] = 0;
}

void text_put(FILE *out, const char *s)
{
    while (*s) {
        uint32_t c;
        char bytes[4];
        s += text_decode(s, &c);
        fwrite(bytes, 1, utf8_write(utf8_visible(c) ? c : REPLACEMENT, bytes), out);
    }
}

typedef struct range {
    uint32_t first, last;
} range;

static bool within(uint32_t c, const range *ranges, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (c >= ranges[i].first && c <= ranges[i].last) return true;
    return false;
}

size_t text_width(const char *s)
{
    static const range none[] = {
        {0x300, 0x36F},   {0x483, 0x489},   {0x591, 0x5BD},   {0x610, 0x61A},   {0x64B, 0x65F},   {0x1AB0, 0x1AFF},
        {0x1DC0, 0x1DFF}, {0x200B, 0x200D}, {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}, {0xFE20, 0xFE2F},
    };
    static const range two[] = {
        {0x1100, 0x115F}, {0x2E80, 0x303E},   {0x3041, 0xA4CF},   {0xA960, 0xA97F},
        {0xAC00, 0xD7A3}, {0xF900, 0xFAFF},   {0xFE30, 0xFE6F},   {0xFF00, 0xFF60},
        {0xFFE0, 0xFFE6}, {0x1F300, 0x1F64F}, {0x1F900, 0x1F9FF}, {0x20000, 0x3FFFD},
    };
    size_t width = 0;
    while (*s) {
        uint32_t c;
        s += text_decode(s, &c);
        if (!utf8_visible(c)) c = REPLACEMENT;
        if (within(c, none, sizeof none / sizeof *none)) continue;
        width += within(c, two, sizeof two / sizeof *two) ? 2 : 1;
    }
    return width;
}

size_t text_columns(FILE *out)
{
    enum { USUAL = 80, LEAST = 40 };
    const int columns = platform_columns(fileno(out));
    return columns <= 0 ? USUAL : columns < LEAST ? LEAST : (size_t)columns;
}

void text_flow(FILE *out, const char *s, size_t column, size_t indent, size_t width)
{
    char word[512];
    bool begun = false;
    for (s += strspn(s, " \t\n"); *s; s += strspn(s, " \t\n")) {
        const size_t length = strcspn(s, " \n\t"), part = length < sizeof word ? length : sizeof word - 1;
        memcpy(word, s, part);
        word[part] = 0;
        s += part;
        const size_t columns = text_width(word);
        const bool fits = column + begun + columns <= width || (!begun && column <= indent);
        if (!fits) fprintf(out, "\n%*s", (int)indent, "");
        if (begun && fits) putc(' ', out);
        column = (fits ? column + begun : indent) + columns;
        text_put(out, word);
        begun = true;
    }
}

enum { PROSE = 100 }; /* columns of a line that the eye can follow */

static size_t prose_columns(FILE *out)
{
    const size_t columns = text_columns(out);
    return columns < PROSE ? columns : PROSE;
}

/* Wraps every line, whose first line has the indent `first`. */
static void wrap(FILE *out, const char *s, size_t first, size_t indent)
{
    while (*s) {
        const size_t length = strcspn(s, "\n");
        char *line = strndup(s, length);
        fprintf(out, "%*s", (int)first, "");
        text_flow(out, line ? line : "", first, indent, prose_columns(out));
        putc('\n', out);
        free(line);
        s += length + (s[length] == '\n');
    }
}

void text_wrap(FILE *out, const char *s, size_t indent) { wrap(out, s, indent, indent); }

void text_say(FILE *out, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    wrap(out, text, 0, 4);
}

void text_brief(double value, int digits, char out[DECIMAL_MAX])
{
    if (isnan(value))
        strcpy(out, "-");
    else if (digits < 0 && value != 0 && isfinite(value))
        snprintf(out, DECIMAL_MAX, "%.*e", -digits - 1, value);
    else
        snprintf(out, DECIMAL_MAX, "%.*g", digits < 0 ? -digits : digits, value);
}

void text_seconds(double seconds, char out[DECIMAL_MAX])
{
    if (!(seconds >= 0))
        strcpy(out, "-");
    else if (seconds < 1e-3)
        snprintf(out, DECIMAL_MAX, "%.3g µs", seconds * 1e6);
    else if (seconds < 1)
        snprintf(out, DECIMAL_MAX, "%.3g ms", seconds * 1e3);
    else
        snprintf(out, DECIMAL_MAX, "%.3g s", seconds);
}

static void write_json(void *to, const char *bytes, size_t count) { fwrite(bytes, 1, count, to); }

json text_json(FILE *out)
{
    json j = {.write = write_json, .to = out};
    json_open(&j, NULL, '{');
    return j;
}
