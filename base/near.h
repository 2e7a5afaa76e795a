/* "Did you mean": the similarity of two words. */
#ifndef BASE_NEAR_H
#define BASE_NEAR_H

#include <stdbool.h>
#include <stddef.h>

/* Counts the edits (insert, delete, replace, swap neighbours) from a to b, in halves: letter case and look-alikes (µ
 * and μ) count as half an edit. Above `limit`, returns any number above it. */
int near_distance(const char *a, const char *b, int limit);
/* Returns whether b is a plausible misspelling of a. */
bool near_likely(const char *a, const char *b);
/* Returns whether b is a plausible misspelling of a, and nearer than *least, which then becomes its distance. */
bool near_nearer(const char *a, const char *b, int *least);
/* Returns whether the words differ in look-alikes alone. out: the first of them, "U+00B5 against U+03BC". */
bool near_look_alike(const char *a, const char *b, char *out, size_t size);

#endif
