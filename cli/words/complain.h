/* Messages of the program on the terminal. fail() and hint() of base/error.h make the errors. */
#ifndef CLI_WORDS_COMPLAIN_H
#define CLI_WORDS_COMPLAIN_H

#include "base/error.h"
#include "motus.h"
#include "tell/json.h"

#include <stdbool.h>

/* Calls fail() with the words at its end, and hint() with `right`, what to do; its value is the status. */
#define complain(err, status, right, ...) (fail(err, status, __VA_ARGS__), hint(err, "%s", right), (status))
motus_status complain_memory(motus_error *);

/* Prints an error, as an object on standard output if `json`. Returns the exit status. */
int complain_show(const motus_error *, bool json);
/* Writes an error as the member `key` of an open object: {kind, message, line, column}. */
void complain_json(json *, const char *key, const motus_error *);
/* Copies a text of the library; the members of definitions that it names become options of the program. */
void complain_named(const char *text, char *out, size_t size);
/* Prints a note on standard error, changed by complain_named(). */
void complain_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Returns whether to use colours on standard output (1) or standard error (2). */
bool complain_colours(int descriptor);

#endif
