/* The words of the language: reserved words and functions. */
#ifndef LANG_TEXT_WORDS_H
#define LANG_TEXT_WORDS_H

#include "motus.h"

#include <stdbool.h>

/* Functions for which the graph has no operation; their numbers are larger than those of all operations. */
enum { CALL_DOT = 1000, CALL_CROSS, CALL_IF, CALL_DIFF, CALL_INTERP, CALL_SPLINE };

/* Returns the name of function k, in a fixed order; NULL: k is past the last. */
const char *words_called(size_t k);
int words_function(const char *name); /* an operation, CALL_…, or -1 */
bool words_reserved(const char *name);
const char *words_at(size_t k);           /* word k of all; NULL: k is past the last */
motus_word_kind words_kind(const char *); /* UNKNOWN: it is no word of the language */

/* Classifies the words of events, which models may use as names: OPERATOR for words within a `when`; FUNCTION for what
 * events keep, in models that have events; else UNKNOWN. */
motus_word_kind words_event_kind(const char *);

/* Finds the statement that a mistaken word may mean; false: there is none. */
bool words_nearest_statement(const char *name, char *out, size_t size);

#endif
