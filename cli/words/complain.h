/* Messages of the program on the terminal. Errors are made by fail() and hint() of base/error.h. */
#ifndef CLI_WORDS_COMPLAIN_H
#define CLI_WORDS_COMPLAIN_H

#include "base/error.h"
#include "motus.h"
#include "tell/json.h"

#include <stdbool.h>

/* fail() with these words, and hint() with what would be right; its value is the status. */
#define complain(err, status, right, ...) (fail(err, status, __VA_ARGS__), hint(err, "%s", right), (status))
/* fail() with MOTUS_MEMORY. */
motus_status complain_memory(motus_error *);

/* Prints an error (with json: one object on standard output) and returns the exit status. */
int complain_show(const motus_error *, bool json);
/* The error as a member of an object that is open: {kind, message, line, column}. */
void complain_json(json *, const char *key, const motus_error *);
/* Puts the program's options for the members of definitions which a text of the library names. */
void complain_named(const char *text, char *out, size_t size);
/* Prints a note on standard error, with these options. */
void complain_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Whether to use colours on standard output (1) or standard error (2). */
bool complain_colours(int descriptor);

#endif
