/* What the calls of the page share. */
#ifndef LAB_CORE_H
#define LAB_CORE_H

#include "motus.h"

#include <stdbool.h>
#include <stddef.h>

/* A name under which the page finds a call. */
#define LAB_CALL(name) __attribute__((export_name(#name)))

/* A text that grows. After a failure for want of memory it is NULL at the end, whatever was added. */
typedef struct json {
    char *text;
    size_t length, capacity;
    bool failed, comma;
} json;

void json_clear(json *);
void json_free(json *);
const char *json_text(json *);       /* NULL: no memory */

/* An object or array opens with its bracket '{' or '[' and closes with the other; name: NULL in arrays. Commas come by themselves. */
void json_open(json *, const char *name, char bracket);
void json_close(json *, char bracket);
void json_string(json *, const char *name, const char *value);      /* UTF-8; NULL is null */
void json_part(json *, const char *name, const char *value, size_t length);
void json_number(json *, const char *name, double value);           /* every bit; NaN is null, infinities are strings "inf", "-inf" */
void json_bool(json *, const char *name, bool value);
void json_numbers(json *, const char *name, const double *values, size_t count);      /* NULL is null */

/* One model, and what is done with it. */
typedef struct lab {
    motus_system *system;
    motus_run *run;
    motus_reference *reference;
    motus_error error;
    json json;
} lab;

/* NUL-terminated strings one behind the other become an array of pointers, to be freed; NULL: no memory. */
const char **lab_list(const char *strings, size_t count);
/* Makes want of memory the last problem; false, for its callers to return. */
bool lab_no_memory(lab *);

#endif
