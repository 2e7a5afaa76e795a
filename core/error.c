/* Errors and memory: the sentence that goes with a status, and the user's allocation hooks.
 *
 * Invariant: a motus_error that was filled here is printable as it is: valid UTF-8, no control character, no character that turns
 * the direction of text, and always terminated, whatever the arguments were (names and lines come from untrusted models).
 */
#include "core/system.h"

#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Length of the UTF-8 sequence at s, and its code point; 0 where s does not start one. */
static int decode(const unsigned char *s, uint32_t *point)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    int length = s[0] < 0x80 ? 1 : (s[0] & 0xE0) == 0xC0 ? 2 : (s[0] & 0xF0) == 0xE0 ? 3 : (s[0] & 0xF8) == 0xF0 ? 4 : 0;
    if (!length) return 0;
    uint32_t c = length == 1 ? s[0] : s[0] & (0x7Fu >> length);
    for (int i = 1; i < length; i++) {
        if ((s[i] & 0xC0) != 0x80) return 0;
        c = c << 6 | (s[i] & 0x3Fu);
    }
    if (c < least[length] || c > 0x10FFFF || (c >= 0xD800 && c <= 0xDFFF)) return 0;
    *point = c;
    return length;
}

static bool unsafe(uint32_t c)
{
    return c < 0x20 || (c >= 0x7F && c <= 0x9F)                                  /* C0, DEL, C1 */
        || (c >= 0x200E && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E)          /* marks and overrides of direction, separators */
        || (c >= 0x2066 && c <= 0x2069) || c == 0x061C || c == 0xFEFF;
}

/* In place; the text never grows. */
static void make_safe(char *text)
{
    unsigned char *in = (unsigned char *)text, *out = in;
    while (*in) {
        uint32_t point = 0;
        int length = decode(in, &point);
        if (!length || unsafe(point)) {
            *out++ = length && (point == '\n' || point == '\t') ? ' ' : '?';
            in += length ? length : 1;
        } else {
            for (int i = 0; i < length; i++) *out++ = *in++;
        }
    }
    *out = 0;
}

/* A text too long for its place ends in "..." and is cut between characters. */
static void compose(char out[MOTUS_TEXT_MAX], const char *format, va_list arguments)
{
    locale_t point = newlocale(LC_ALL_MASK, "C", (locale_t)0), host = point ? uselocale(point) : (locale_t)0;
    int wanted = vsnprintf(out, MOTUS_TEXT_MAX, format, arguments);
    if (point) {                     /* numbers have a point whatever the host's locale */
        uselocale(host);
        freelocale(point);
    }
    if (wanted < 0) out[0] = 0;
    if (wanted >= MOTUS_TEXT_MAX) {
        size_t end = MOTUS_TEXT_MAX - 4;
        while (end > 0 && ((unsigned char)out[end] & 0xC0) == 0x80) end--;
        memcpy(out + end, "...", 4);
    }
    make_safe(out);
}

motus_status fail(motus_error *err, motus_status status, const char *format, ...)
{
    if (!err) return status;
    err->status = status;
    err->line = err->column = err->returned = 0;
    err->time = NAN;
    err->variable[0] = err->hint[0] = err->source[0] = err->caret[0] = err->file[0] = 0;
    va_list arguments;
    va_start(arguments, format);
    compose(err->message, format, arguments);
    va_end(arguments);
    return status;
}

void hint(motus_error *err, const char *format, ...)
{
    if (!err) return;
    va_list arguments;
    va_start(arguments, format);
    compose(err->hint, format, arguments);
    va_end(arguments);
}

char *decimal(double value, char out[DECIMAL_MAX])
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, DECIMAL_MAX, "%.*g", digits, value);
        if (strtod(out, NULL) == value) break;
    }
    const char *point = localeconv()->decimal_point;
    char *at = strchr(out, *point);
    if (at) {
        *at = '.';
        memmove(at + 1, at + strlen(point), strlen(at + strlen(point)) + 1);
    }
    return out;
}

void *take(const motus_allocator *allocator, size_t count, size_t bytes)
{
    if (bytes && count > SIZE_MAX / bytes) return NULL;
    size_t all = count * bytes;
    if (!all) all = 1;
    if (!allocator || !allocator->allocate) return calloc(1, all);      /* calloc: fresh pages come zeroed without being touched */
    void *block = allocator->allocate(allocator->context, all);
    if (block) memset(block, 0, all);
    return block;
}

void give(const motus_allocator *allocator, void *block)
{
    if (!block) return;
    if (!allocator || !allocator->allocate) free(block);
    else if (allocator->release) allocator->release(allocator->context, block);
}
