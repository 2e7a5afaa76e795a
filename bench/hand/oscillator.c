/* The ensembles of oscillators: which block size is best here, and the loop over blocks.
 *
 * Invariant: every block size gives the same bits; the last block of an ensemble overlaps the one before rather than
 * being shorter.
 */
#include "bench/hand/hand.h"
#include "bench/hand/lanes.h"

#include <stdio.h>
#include <time.h>

#define U 2
#define S 1
#include "bench/hand/oscillator_block.h"
#define U 4
#define S 1
#include "bench/hand/oscillator_block.h"
#define U 6
#define S 1
#include "bench/hand/oscillator_block.h"
#define U 8
#define S 1
#include "bench/hand/oscillator_block.h"
#define U 10
#define S 1
#include "bench/hand/oscillator_block.h"
#define U 11
#define S 1
#include "bench/hand/oscillator_block.h"
#define U 12
#define S 1
#include "bench/hand/oscillator_block.h"
#define U 13
#define S 1
#include "bench/hand/oscillator_block.h"
#define U 10
#define S 2
#include "bench/hand/oscillator_block.h"
#define U 10
#define S 5
#include "bench/hand/oscillator_block.h"
#define U 8
#define S 4
#include "bench/hand/oscillator_block.h"

typedef void block(const oscillators *, size_t at);
typedef struct size {
    int registers, in_step;
    block *run[HAND_KINDS];
} size;

/* In the order of hand_kind. */
#define SIZE(u, s)                                                                                                   \
    {                                                                                                                \
        u, s,                                                                                                        \
        {                                                                                                            \
            verlet_##u##_##s, velocity_verlet_##u##_##s, rk4_##u##_##s, free_leapfrog_##u##_##s, free_rk4_##u##_##s, \
                free_position_##u##_##s, first_rk4_##u##_##s                                                         \
        }                                                                                                            \
    }
static const size sizes[] = {SIZE(2, 1),  SIZE(4, 1),  SIZE(6, 1),  SIZE(8, 1),  SIZE(10, 1), SIZE(11, 1),
                             SIZE(12, 1), SIZE(13, 1), SIZE(10, 2), SIZE(10, 5), SIZE(8, 4)};
enum { SIZES = sizeof sizes / sizeof *sizes, TRIES = 5 };

static int chosen[HAND_KINDS];

const char *hand_lanes(void) { return LANES_NAME; }

static void sweep(hand_kind kind, const size *s, const oscillators *o)
{
    size_t block = (size_t)s->registers * WIDTH, at = 0;
    for (; at + block <= o->count; at += block) s->run[kind](o, at);
    if (at < o->count) s->run[kind](o, o->count - block);
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void hand_oscillators_choose(hand_kind kind, const oscillators *o)
{
    double best = INFINITY;
    for (int try = 0; try < TRIES; try++)
        for (int k = 0; k < SIZES; k++) {
            double start = seconds();
            sweep(kind, &sizes[k], o);
            double took = seconds() - start;
            if (took < best) best = took, chosen[kind] = k;
        }
}

const char *hand_oscillators_chosen(hand_kind kind)
{
    static char text[64];
    const size *s = &sizes[chosen[kind]];
    snprintf(text, sizeof text, "%d registers, %d in step", s->registers, s->in_step);
    return text;
}

void hand_oscillators(hand_kind kind, const oscillators *o) { sweep(kind, &sizes[chosen[kind]], o); }
