/* A thread that computes in the interpreter while a compiler works for it. What the compiler makes computes many times
 * as fast, so where both have to share a processor the compiler goes first.
 *
 * Invariant: resting changes when a thread computes, never what.
 */
#ifndef MACHINE_BESIDE_H
#define MACHINE_BESIDE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct beside {
    double looked;     /* monotonic; 0: not yet */
    double computed;   /* seconds of this thread's processor time until then */
    double began;      /* ... when it began to count how often others took its processor */
    int64_t displaced; /* how often they had until then */
    double rested;     /* in all */
    bool crowded;      /* they want it: the thread rests most of the time */
} beside;

/* To be called between pieces of work, as often as is convenient. A thread whose processor others take again and again
 * then rests nine tenths of the time: BESIDE_REST_ALL seconds in all, since a compiler may hang, and never longer than
 * BESIDE_REST_MOST seconds at once, so that its caller can be told how far it is. */
#define BESIDE_REST_MOST 0.02
#define BESIDE_REST_ALL 2.0
void beside_rest(beside *);

#endif
