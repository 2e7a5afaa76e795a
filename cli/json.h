/* One JSON value, written as it goes (RFC 8259). Commas come by themselves; failures show in ferror() of the stream. */
#ifndef CLI_JSON_H
#define CLI_JSON_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct json {
    FILE *out;
    bool comma;                 /* a value stands before this place in the same brackets */
} json;

json json_begin(FILE *);
void json_end(json *);                          /* a newline */
void json_open(json *, char bracket);           /* '{' or '[' */
void json_close(json *, char bracket);          /* '}' or ']' */
void json_key(json *, const char *);
void json_string(json *, const char *);         /* NULL: null; bytes that are not UTF-8 become U+FFFD */
void json_number(json *, double);               /* shortest exact form; null for NaN and infinities */
void json_integer(json *, int64_t);
void json_bool(json *, bool);

#endif
