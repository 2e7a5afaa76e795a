/* A thread that computes in the interpreter while a compiler works for it. Compiled code is many times as fast, so the
 * compiler goes first where both share a processor.
 *
 * Invariant: resting changes when a thread computes, never what.
 */
#ifndef MACHINE_BESIDE_H
#define MACHINE_BESIDE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct beside {
    double looked;     /* monotonic time of the latest look at the processor; 0: none yet */
    double computed;   /* seconds of this thread's processor time at that look */
    double began;      /* seconds of its processor time when the count of displacements began */
    int64_t displaced; /* how often others had taken its processor by then */
    double rested;     /* seconds of rest in all */
    bool crowded;      /* others want the processor, so the thread rests most of the time */
} beside;

/* Lets the thread rest nine tenths of the time if others take its processor again and again; call it between pieces of
 * work. It rests BESIDE_REST_ALL seconds in all, since a compiler may hang, and at most BESIDE_REST_MOST seconds at
 * once, so that the caller can report progress. */
#define BESIDE_REST_MOST 0.02
#define BESIDE_REST_ALL 2.0
void beside_rest(beside *);

#endif
