/* What a user types: the words of a command, lists in the value of an option, and numbers. */
#ifndef CLI_WORDS_WORDS_H
#define CLI_WORDS_WORDS_H

#include "cli/words/options.h"
#include "motus.h"

#include <stdbool.h>
#include <stdint.h>

/* Splits a command that command_word() has written. Blanks separate words; text between two ' is literal, $'\xNN' is a
 * byte, and a character after \ is literal. The items point into *memory. The caller frees *memory and the list's
 * items, also after a failure. */
motus_status words_split(const char *text, char **memory, options_list *, motus_error *);

/* Splits "x,r.x,u[1,2]" at the commas outside brackets. */
motus_status words_part(const char *text, const char *option, options_list *, motus_error *);
motus_status words_add(options_list *, const char *, motus_error *);
void words_free(options_list *);

/* ---- numbers ---- */

/* Reads a decimal number, with or without a sign, if the text is nothing else. The number may be infinite. */
bool typed_decimal(const char *, double *);
#define TYPED_COUNT_MAX 9e18
/* Reads an integer from 1 to INT64_MAX, as 7 or 1e6; *rest is the text after it. */
bool typed_count(const char *, int64_t *, const char **rest);
/* Reads an integer from 0 to 2^64 - 1. */
bool typed_seed(const char *, uint64_t *);
/* Reads a constant expression of the language, "2 pi/3". The message of an error begins with `where`; its hint says
 * what is wrong with the expression. */
motus_status typed_constant(const char *expression, const char *where, double *, motus_error *);

#endif
