/* Writes one JSON value piece by piece.
 *
 * Invariant: the output is valid JSON in valid UTF-8 on one line, whatever the strings and numbers are.
 */
#include "tell/json.h"

#include "base/decimal.h"
#include "base/utf8.h"

#include <math.h>
#include <string.h>

static void put(json *j, const char *text) { j->write(j->to, text, strlen(text)); }

/* Writes a character that JSON does not allow in a string. */
static void escape(json *j, uint32_t c)
{
    static const char digits[] = "0123456789abcdef";
    if (c == '"' || c == '\\')
        j->write(j->to, (char[]){'\\', (char)c}, 2);
    else if (c == '\n')
        put(j, "\\n");
    else
        j->write(j->to,
                 (char[]){'\\', 'u', digits[c >> 12 & 15], digits[c >> 8 & 15], digits[c >> 4 & 15], digits[c & 15]},
                 6);
}

static void quoted(json *j, const char *s, size_t length)
{
    put(j, "\"");
    const char *end = s + length;
    for (size_t n; s < end; s += n) {
        size_t plain = 0;
        uint32_t c = 0;
        while ((n = utf8_read(s + plain, (size_t)(end - s) - plain, &c)) && c != '"' && c != '\\' && utf8_visible(c))
            plain += n;
        j->write(j->to, s, plain);
        s += plain;
        if (s < end && n > 0)
            escape(j, c);
        else if (s < end)
            put(j, "\uFFFD"), n = 1;
    }
    put(j, "\"");
}

/* Writes the comma and the key before a value. */
static void begin(json *j, const char *key)
{
    if (j->comma) put(j, ", ");
    j->comma = true;
    if (key) {
        quoted(j, key, strlen(key));
        put(j, ": ");
    }
}

void json_open(json *j, const char *key, char bracket)
{
    begin(j, key);
    j->write(j->to, &bracket, 1);
    j->comma = false;
}

void json_close(json *j, char bracket)
{
    j->write(j->to, &bracket, 1);
    j->comma = true;
}

void json_end(json *j) { put(j, "}\n"); }

void json_part(json *j, const char *key, const char *s, size_t length)
{
    begin(j, key);
    quoted(j, s, length);
}

void json_string(json *j, const char *key, const char *s)
{
    begin(j, key);
    if (s)
        quoted(j, s, strlen(s));
    else
        put(j, "null");
}

void json_number(json *j, const char *key, double value)
{
    char text[DECIMAL_MAX];
    begin(j, key);
    put(j, isfinite(value) ? decimal(value, text) : "null");
}

void json_numbers(json *j, const char *key, const double *values, size_t count)
{
    if (!values) {
        json_string(j, key, NULL);
        return;
    }
    json_open(j, key, '[');
    for (size_t i = 0; i < count; i++) json_number(j, NULL, values[i]);
    json_close(j, ']');
}

void json_integer(json *j, const char *key, int64_t value)
{
    char text[DECIMAL_MAX + 1];
    begin(j, key);
    text[0] = '-';
    decimal_write_whole(value < 0 ? -(uint64_t)value : (uint64_t)value, text + 1);
    put(j, text + (value >= 0));
}

void json_bool(json *j, const char *key, int value)
{
    begin(j, key);
    put(j, value ? "true" : "false");
}
