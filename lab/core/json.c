/* Answers to the page, as JSON. Numbers are written with 17 digits, so that the page has the very double. */
#include "lab/core/core.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add(json *j, const char *text, size_t length)
{
    if (j->failed)
        return;
    if (j->length + length + 1 > j->capacity) {
        size_t capacity = 2 * (j->length + length) + 256;
        char *more = realloc(j->text, capacity);
        if (!more) {
            j->failed = true;
            return;
        }
        j->text = more;
        j->capacity = capacity;
    }
    memcpy(j->text + j->length, text, length);
    j->length += length;
    j->text[j->length] = 0;
}

static void say(json *j, const char *text) { add(j, text, strlen(text)); }

void json_clear(json *j)
{
    j->length = 0;
    j->failed = j->comma = false;
}

void json_free(json *j)
{
    free(j->text);
    *j = (json){0};
}

const char *json_text(json *j) { return j->failed ? NULL : j->text; }

static void quoted(json *j, const char *value, size_t length)
{
    say(j, "\"");
    for (const char *p = value; p < value + length; p++) {
        unsigned char c = (unsigned char)*p;
        if (c < 0x20) {
            char code[8];
            snprintf(code, sizeof code, "\\u%04x", c);
            say(j, code);
        } else {
            if (c == '"' || c == '\\')
                say(j, "\\");
            add(j, p, 1);
        }
    }
    say(j, "\"");
}

static void begin(json *j, const char *name)
{
    if (j->comma)
        say(j, ",");
    j->comma = true;
    if (name) {
        quoted(j, name, strlen(name));
        say(j, ":");
    }
}

void json_open(json *j, const char *name, char bracket)
{
    begin(j, name);
    add(j, &bracket, 1);
    j->comma = false;
}

void json_close(json *j, char bracket)
{
    add(j, &bracket, 1);
    j->comma = true;
}

void json_string(json *j, const char *name, const char *value)
{
    begin(j, name);
    if (value)
        quoted(j, value, strlen(value));
    else
        say(j, "null");
}

void json_part(json *j, const char *name, const char *value, size_t length)
{
    begin(j, name);
    quoted(j, value, length);
}

void json_number(json *j, const char *name, double value)
{
    begin(j, name);
    if (isnan(value)) {
        say(j, "null");
    } else if (isinf(value)) {
        say(j, value > 0 ? "\"inf\"" : "\"-inf\"");
    } else {
        char digits[32];
        snprintf(digits, sizeof digits, "%.17g", value);
        say(j, digits);
    }
}

void json_bool(json *j, const char *name, bool value)
{
    begin(j, name);
    say(j, value ? "true" : "false");
}

void json_numbers(json *j, const char *name, const double *values, size_t count)
{
    if (!values) {
        json_string(j, name, NULL);
        return;
    }
    json_open(j, name, '[');
    for (size_t i = 0; i < count; i++)
        json_number(j, NULL, values[i]);
    json_close(j, ']');
}
