/* The reserved words and functions of the language, and the distance between two names, for hints about a misspelt one.
 * */
#ifndef LANG_TEXT_WORDS_H
#define LANG_TEXT_WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* Functions that the graph has no operation for; their numbers are larger than those of all operations. */
enum { CALL_DOT = 1000, CALL_CROSS, CALL_IF };

int words_function(const char *name);        /* operation, CALL_… or -1 */
bool words_reserved(const char *name);

/* The edit distance between two names in half edits (insert, delete, replace, swap neighbours), at most `limit` + 1. A
 * change of case or of a look-alike (µ and μ) counts as half an edit. */
int words_distance(const char *a, const char *b, int limit);
/* Whether b may be a misspelling of a. */
bool words_near(const char *a, const char *b);
bool words_nearest_statement(const char *name, char *out, size_t size);
/* "µ (U+00B5)": a description of the first character in which two look-alikes differ; false if they differ otherwise. */
bool words_look_alike(const char *a, const char *b, char *out, size_t size);

#endif
