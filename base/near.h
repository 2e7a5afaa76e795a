/* "Did you mean": the similarity of two words. */
#ifndef BASE_NEAR_H
#define BASE_NEAR_H

#include <stdbool.h>
#include <stddef.h>

/* Edits (insert, delete, replace, swap neighbours) that lead from a to b, in halves: letter case and look-alikes (µ
 * and μ) count as half of one. Where that is more than `limit`, any number above it. */
int near_distance(const char *a, const char *b, int limit);
/* Is b a plausible misspelling of a? */
bool near_likely(const char *a, const char *b);
/* Whether b is one, and nearer than *least, which then becomes its distance. */
bool near_nearer(const char *a, const char *b, int *least);
/* Whether they differ in look-alikes alone. out: the first of them, "U+00B5 against U+03BC". */
bool near_look_alike(const char *a, const char *b, char *out, size_t size);

#endif
