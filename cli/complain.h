/* Errors of the program: made, and shown to the person who asked. */
#ifndef CLI_COMPLAIN_H
#define CLI_COMPLAIN_H

#include "motus.h"

#include <stdbool.h>

/* Fill an error and return its status. */
motus_status complain(motus_error *, motus_status, const char *format, ...) __attribute__((format(printf, 3, 4)));
void complain_hint(motus_error *, const char *format, ...) __attribute__((format(printf, 2, 3)));
motus_status complain_memory(motus_error *);

/* Shows an error (with json: one object on standard output) and returns the exit status. */
int complain_show(const motus_error *, bool json);
/* A remark on standard error. */
void complain_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Whether a stream (1 or 2) is a terminal that wants colours. */
bool complain_colours(int descriptor);

#endif
