/* See beside.h.
 *
 * The system tells how often a thread lost its processor although it could go on: a few times a second on a processor
 * of its own, every few milliseconds where others compute. Once others do, the thread rests until the end: it would
 * compute little before the object is there, and resting takes no longer than waiting for the compiler.
 */
#include "machine/beside.h"

#include "base/platform.h"

#include <math.h>
#include <time.h>

#define PIECE 1e-3      /* seconds from one look to the next, and of computing between two rests */
#define RESTS 9.0       /* seconds of rest for each second of computing, where it is crowded */
#define WINDOW 0.02     /* seconds of processor time over which displacements are counted */
enum { DISPLACED = 2 }; /* this many displacements within WINDOW mean that it is crowded */

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void sleep_for(beside *b, double seconds)
{
    const double rest = fmin(seconds, BESIDE_REST_MOST);
    nanosleep(&(struct timespec){.tv_nsec = (long)(1e9 * rest)}, NULL);
    b->rested += rest;
}

static void count(beside *b, double computed, int64_t displaced)
{
    b->began = computed;
    b->displaced = displaced;
}

void beside_rest(beside *b)
{
    if (now() - b->looked < PIECE) return;
    double computed;
    int64_t displaced;
    if (!platform_thread(&computed, &displaced)) return;
    if (b->looked == 0) count(b, computed, displaced);
    b->crowded = b->crowded || displaced - b->displaced >= DISPLACED;
    if (b->crowded && b->looked > 0 && b->rested < BESIDE_REST_ALL) sleep_for(b, RESTS * (computed - b->computed));
    if (computed - b->began > WINDOW) count(b, computed, displaced);
    b->computed = computed;
    b->looked = now();
}
