/* The words of the language: reserved ones and functions. */
#ifndef LANG_TEXT_WORDS_H
#define LANG_TEXT_WORDS_H

#include "motus.h"

#include <stdbool.h>

/* Functions that the graph has no operation for; their numbers are larger than those of all operations. */
enum { CALL_DOT = 1000, CALL_CROSS, CALL_IF, CALL_DIFF };

/* Function k, in a fixed order; NULL: past the last. */
const char *words_called(size_t k);
int words_function(const char *name); /* operation, CALL_… or -1 */
bool words_reserved(const char *name);
const char *words_at(size_t k);           /* all of them; NULL: past the last */
motus_word_kind words_kind(const char *); /* UNKNOWN: it is none of them */

/* Words that events alone have, so that models may use them as names: OPERATOR within a `when`, FUNCTION of what an
 * event keeps, in models that have events; else UNKNOWN. */
motus_word_kind words_event_kind(const char *);

/* The statement that a mistaken word may be meant for; false: none. */
bool words_nearest_statement(const char *name, char *out, size_t size);

#endif
