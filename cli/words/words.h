/* What is typed: lists of words, those of a command line, as command_word() has written them, or of the value of an
 * option; and numbers. */
#ifndef CLI_WORDS_WORDS_H
#define CLI_WORDS_WORDS_H

#include "cli/words/options.h"
#include "motus.h"

#include <stdbool.h>
#include <stdint.h>

/* Words are separated by blanks; in one, what is between two ' is taken as it is, $'\xNN' is a byte, and \ takes the
 * next character so. The items point into *memory, and there is room for two more; the caller frees it and the list's
 * items, also after a failure. */
motus_status words_split(const char *text, char **memory, options_list *, motus_error *);

/* Splits "x,r.x,u[1,2]" at the commas outside brackets. */
motus_status words_part(const char *text, const char *option, options_list *, motus_error *);
motus_status words_add(options_list *, const char *, motus_error *);
void words_free(options_list *);

/* ---- numbers ---- */

/* A decimal number with or without a sign, and nothing else; it may be infinite. */
bool typed_decimal(const char *, double *);
/* An integer from 1 to INT64_MAX; *rest: what follows it. 1e6 is one. */
#define TYPED_COUNT_MAX 9e18
bool typed_count(const char *, int64_t *, const char **rest);
/* 0 … 2^64 - 1. */
bool typed_seed(const char *, uint64_t *);
/* A constant expression of the language, "2 pi/3". The error's message begins with `where`; its hint says what is wrong
 * with the expression. */
motus_status typed_constant(const char *expression, const char *where, double *, motus_error *);

#endif
