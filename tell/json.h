/* Writes one JSON value (RFC 8259) piece by piece, with its commas, to a callback. */
#ifndef TELL_JSON_H
#define TELL_JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct json {
    void (*write)(void *to, const char *bytes, size_t count); /* notes its own failures */
    void *to;
    bool comma; /* another value stands before it in the brackets */
} json;

/* Write values; key: NULL in a list, and for the outermost value. */
void json_open(json *, const char *key, char bracket);   /* '{' or '[' */
void json_close(json *, char bracket);                   /* '}' or ']' */
void json_end(json *);                                   /* '}' of the outermost object, and a newline */
void json_string(json *, const char *key, const char *); /* NULL: null; bytes that are not UTF-8 become U+FFFD */
void json_part(json *, const char *key, const char *, size_t length);
void json_number(json *, const char *key, double); /* shortest exact form; null for NaN and infinities */
void json_numbers(json *, const char *key, const double *, size_t count); /* NULL: null */
void json_integer(json *, const char *key, int64_t);
void json_bool(json *, const char *key, int value);

#endif
