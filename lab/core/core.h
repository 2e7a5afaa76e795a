/* What the calls of the page share. */
#ifndef LAB_CORE_H
#define LAB_CORE_H

#include "tell/bar.h"
#include "tell/tell.h"

#include <stdbool.h>
#include <stddef.h>

/* A name under which the page finds a call. */
#define LAB_CALL(name) __attribute__((export_name(#name)))

/* A text that grows. */
typedef struct lab_text {
    char *text;
    size_t length, capacity;
    bool failed; /* there was no memory */
} lab_text;

/* One model, and what is done with it. */
typedef struct lab {
    motus_system *system;
    motus_run *run;
    motus_reference *reference;
    motus_error error;
    lab_text answer;
    char bar[BAR_MAX];
} lab;

/* NUL-terminated strings one behind the other become an array of pointers, to be freed; NULL: no memory. */
const char **lab_list(const char *strings, size_t count);
/* An answer begins: a JSON object, up to lab_answered(). */
json lab_answer(lab *);
/* Its text; NULL: no memory. */
const char *lab_answered(lab *, json *);
/* The definition of a run; "" and NaN: the model's. */
motus_run_def lab_run(const char *method, double step, double tolerance, double until);
void lab_forget_run(lab *);
/* Makes want of memory the last problem; false, for its callers to return. */
bool lab_no_memory(lab *);

#endif
