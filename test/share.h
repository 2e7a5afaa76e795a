/* Of the many cases that a test goes through, or draws, every SHARE-th is tried, where the environment says so: evenly
 * over all of them, the first always. Without it all are; under the sanitizers, which make a program several times
 * slower and look for other faults than wrong numbers, every tenth.
 *
 * SANITIZED is defined where AddressSanitizer watches. */
#ifndef TEST_SHARE_H
#define TEST_SHARE_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef __SANITIZE_ADDRESS__
#define SANITIZED
#elif defined __has_feature
#if __has_feature(address_sanitizer)
#define SANITIZED
#endif
#endif

static inline int share_one_in(void)
{
    const char *said = getenv("SHARE");
#ifdef SANITIZED
    const int n = said ? atoi(said) : 10;
#else
    const int n = said ? atoi(said) : 1;
#endif
    return n > 1 ? n : 1;
}

/* Whether the next case is tried. `turn` counts them, from 0. Multiples of the golden ratio meet no period of loops. */
static inline bool share_takes(int *turn)
{
    const int n = share_one_in(), now = (*turn)++;
    if (n > 1 && now == 0) printf("# of many cases one in %d; SHARE=1 tries all\n", n);
    return fmod(0.61803398874989485 * now, 1) * n < 1;
}

#endif
