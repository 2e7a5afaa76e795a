/* One JSON value, written as it goes.
 *
 * Invariant: whatever strings and numbers come in, what goes out is valid JSON in valid UTF-8, on one line.
 */
#include "cli/json.h"

#include "base/utf8.h"
#include "cli/text.h"

#include <inttypes.h>
#include <math.h>

json json_begin(FILE *out)
{
    return (json){out, false};
}

void json_end(json *j)
{
    putc('\n', j->out);
}

static void separate(json *j)
{
    if (j->comma)
        fputs(", ", j->out);
    j->comma = true;
}

void json_open(json *j, char bracket)
{
    separate(j);
    putc(bracket, j->out);
    j->comma = false;
}

void json_close(json *j, char bracket)
{
    putc(bracket, j->out);
    j->comma = true;
}

static void quoted(json *j, const char *s)
{
    putc('"', j->out);
    while (*s) {
        uint32_t c;
        size_t n = text_decode(s, &c);
        if (c == '"' || c == '\\')
            fprintf(j->out, "\\%c", (char)c);
        else if (c == '\n')
            fputs("\\n", j->out);
        else if (!utf8_visible(c))
            fprintf(j->out, "\\u%04x", (unsigned)c);
        else if (n == 1 && c >= 0x80)
            fputs("\xEF\xBF\xBD", j->out);
        else
            fwrite(s, 1, n, j->out);
        s += n;
    }
    putc('"', j->out);
}

void json_key(json *j, const char *key)
{
    separate(j);
    quoted(j, key);
    fputs(": ", j->out);
    j->comma = false;
}

void json_string(json *j, const char *s)
{
    separate(j);
    if (s)
        quoted(j, s);
    else
        fputs("null", j->out);
}

void json_number(json *j, double value)
{
    separate(j);
    if (!isfinite(value)) {
        fputs("null", j->out);
        return;
    }
    char text[DECIMAL_MAX];
    decimal(value, text);
    fputs(text, j->out);
}

void json_integer(json *j, int64_t value)
{
    separate(j);
    fprintf(j->out, "%" PRId64, value);
}

void json_bool(json *j, bool value)
{
    separate(j);
    fputs(value ? "true" : "false", j->out);
}
