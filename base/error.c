/* Errors: the message of a status.
 *
 * Invariant: a motus_error that was filled here is printable as it is: valid UTF-8, no control character, no
 * character that turns the direction of text, and always terminated, whatever the arguments were (names and lines
 * come from untrusted models).
 */
#include "base/error.h"

#include "base/utf8.h"

#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Makes a text safe in its place; it never grows. */
static void make_safe(char *text)
{
    char *in = text, *out = text;
    while (*in) {
        uint32_t point = 0;
        const size_t length = utf8_read(in, SIZE_MAX, &point);
        if (!length || !utf8_visible(point)) {
            *out++ = length && (point == '\n' || point == '\t') ? ' ' : '?';
            in += length ? length : 1;
        } else {
            for (size_t i = 0; i < length; i++) *out++ = *in++;
        }
    }
    *out = 0;
}

/* Writes a text; one that is too long ends in "..." and is cut between characters. */
static void compose(char out[MOTUS_TEXT_MAX], const char *format, va_list arguments)
{
    locale_t point = newlocale(LC_ALL_MASK, "C", (locale_t)0), host = point ? uselocale(point) : (locale_t)0;
    int wanted = vsnprintf(out, MOTUS_TEXT_MAX, format, arguments);
    if (point) { /* so that numbers have a decimal point in every locale */
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
    err->word[0] = err->instead[0] = err->attempt[0] = 0;
    err->singular = err->singular_error = err->exponent = err->exponent_error = NAN;
    err->cause = MOTUS_CAUSE_NONE;
    err->verified = 0;
    va_list arguments;
    va_start(arguments, format);
    compose(err->message, format, arguments);
    va_end(arguments);
    return status;
}

void error_text(char out[MOTUS_TEXT_MAX], const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    compose(out, format, arguments);
    va_end(arguments);
}

void error_repair(motus_error *err, const char *word, const char *format, ...)
{
    if (!err) return;
    snprintf(err->word, sizeof err->word, "%s", word);
    make_safe(err->word);
    va_list arguments;
    va_start(arguments, format);
    compose(err->instead, format, arguments);
    va_end(arguments);
}

void hint(motus_error *err, const char *format, ...)
{
    if (!err) return;
    va_list arguments;
    va_start(arguments, format);
    compose(err->hint, format, arguments);
    va_end(arguments);
}
