/* The structs and internal functions of lanes, shared by lanes.c (text and object), lanes_block.c (one block),
 * lanes_companion.c (how far a trajectory is from its companion), lanes_together.c (blocks whose trajectories share one
 * clock), lanes_schedule.c (own clocks: a lane that is free takes the next trajectory), lanes_apart.c and
 * lanes_watched.c (what such lanes do, without events and with them) and lanes_run.c (a call).
 */
#ifndef MACHINE_LANES_PARTS_H
#define MACHINE_LANES_PARTS_H

#include "machine/cache.h"
#include "machine/compose.h"
#include "machine/lanes.h"
#include "machine/reduction.h"

#include "machine/text/host.h"
#include "machine/text/lanes_job.h"

#include <stdatomic.h>

enum { ALIGNMENT = 64 }; /* bytes of a cache line, and of the widest vector */
enum { CHUNK = 512 };    /* steps of one call of the object, at most */
enum { GROUPS_MAX = 12, BLOCK_MAX = GROUPS_MAX * 8 };

struct lanes {
    lanes_def def;
    work plan;                /* of the row, for no particular step */
    int width, groups, block; /* trajectories in a vector; vectors in a block; trajectories in a block */
    emit e;
    void *handle;
    cache_job *job; /* the compiler that is at work; NULL: none */
    bool awaited;   /* the object is not taken yet */
    char why[256];  /* why there is no object, after a compiler has ended */
    void (*bind)(const double *, const int64_t *, double *);
    void (*table)(const lanes_job *, double *, whole);
    void (*begin)(const lanes_job *);
    void (*set)(const lanes_job *);
    void (*first)(const lanes_job *);
    void (*observe)(const lanes_job *);
    void (*run)(const lanes_job *, whole, whole);
    int (*far)(const double *, size_t count, double limit);
    /* the places of the pool of which each lane has its own copy: those that vary, and the others of their arrays */
    size_t *read, reads;
    double *u;
    int64_t *q, *places, *from_x, *from_v;
    size_t outs;     /* how many numbers of definitions are observed */
    bool needs_a;    /* a definition that is observed contains x'' */
    bool on_the_way; /* some record needs observations before the end */
    size_t solving;  /* bytes of the linear systems of a group */
    size_t carried;  /* elements of a group's carry */
    lanes *half;     /* the lanes of the companions; NULL: errors are not computed */
    differences_shape shape;
    lanes_record *compared; /* where the compared numbers are, in both lanes */
    /* sizes for one block, in doubles, rounded up to whole cache lines */
    size_t own_size, bound_size, carry_size, kept_size, clock_size, known_size, work_size, observed_size, solve_size,
        watch_size;
};

/* Returns how many doubles hold `elements` elements of every lane of a block, in whole cache lines. */
static inline size_t lines(const lanes *l, size_t elements) { return (elements * (size_t)l->block + 7) / 8 * 8; }

/* Returns the index of element k of lane i of a block, where a group has `elements` elements. */
static inline size_t lane_at(const lanes *l, size_t elements, size_t k, size_t i)
{
    const int shift = __builtin_ctz((unsigned)l->width); /* a division would take longer than all the rest */
    const size_t within = i & ((size_t)l->width - 1);
    return (((i >> shift) * elements + k) << shift) + within;
}

/* Copy `count` elements of a lane, from element `first` on, into a row (lanes_row), or a lane into another lane
 * (lanes_copy). */
static inline void lanes_row(const lanes *l, double *to, const double *from, size_t elements, size_t first,
                             size_t count, size_t lane)
{
    for (size_t k = 0; k < count; k++) to[k] = from[lane_at(l, elements, first + k, lane)];
}
static inline void lanes_copy(const lanes *l, double *to, size_t at, const double *from, size_t lane, size_t elements)
{
    for (size_t k = 0; k < elements; k++) to[lane_at(l, elements, k, at)] = from[lane_at(l, elements, k, lane)];
}

/* A call of lanes_run: all its trajectories. */
typedef struct lanes_call {
    lanes *l;
    size_t count;
    const double *const *values;
    const double *until; /* the end of every trajectory; NULL: that of the definition */
    double *const *results, *const *errors, *stopped;
    double *memory; /* of every thread: blocks, scratch and table, these three for companions, and differences */
    size_t blocks, block_size, scratch_size, table_size, thread_size;
    struct lanes_call *half; /* of the companions: sizes and memory alone; NULL: errors are not computed */
    bool keeps;              /* calls of the object are short, so accelerations are kept from one call to the next */
    size_t companions;       /* how many companions a thread has at once */
    size_t items, most;      /* how many items of work, and trajectories in one */
    atomic_size_t done;      /* how many trajectories are done */
    atomic_bool cancelled;
    atomic_bool refused; /* the row does not admit the parameters of some lane */
} lanes_call;

/* One item of work: trajectories first … first + count - 1, computed by one thread in blocks of its own. */
typedef struct lanes_item {
    lanes *l;
    lanes_call *call;
    size_t first, count;
    bool reports;                     /* calls the progress hook */
    double *memory, *scratch, *table; /* of all blocks; of the present block; of values of time alone */
    double t0, h;                     /* the leg of trajectories that share a clock */
    int64_t n, first_row;             /* the steps taken in the leg, and the first row of the table */
    int64_t observations;             /* recorded so far */
    bool ends;                        /* the next observation is the one at the end */
    int thread;
    struct lanes_item *half;            /* the companions; NULL: there are none */
    struct lanes_companion *companions; /* how far they are from their trajectories */
    double landed;                      /* with a shared clock: when companions landed last */
    int64_t landed_steps, due;          /* after how many steps that was, and after how many they land again */
} lanes_item;

/* How far a trajectory is from its companion. */
typedef struct lanes_companion {
    differences differences;
    double landed; /* when it landed last */
    bool failed;   /* it has left the finite numbers, or did not land */
} lanes_companion;

/* One block of an item: the object's arguments, and the library's own data. */
typedef struct lanes_block {
    lanes *l;
    lanes_job job;
    double *stopped; /* the time at which each lane stopped; NaN: it has not */
    double *saved;   /* carry and clocks before the latest steps */
    size_t *number;  /* with own clocks: the trajectory of each lane, or NO_TRAJECTORY; else NULL */
} lanes_block;
#define NO_TRAJECTORY SIZE_MAX

/* Returns the place of number k of a lane's own clock. */
static inline double *lanes_clock(const lanes_block *b, size_t lane, int k)
{
    return &b->job.clocks[lane_at(b->l, LANES_CLOCKS, (size_t)k, lane)];
}
static inline int64_t lanes_steps(const lanes_block *b, size_t lane) { return (int64_t)*lanes_clock(b, lane, LANES_N); }
static inline bool lanes_occupied(const lanes_block *b, size_t lane) { return b->number[lane] != NO_TRAJECTORY; }

/* ---- lanes_block.c ---- */

size_t lanes_block_size(const lanes *);
size_t lanes_scratch_size(const lanes *);
lanes_block lanes_block_of(const lanes_item *, size_t block);
/* Turns a block of an item into block number `block` of the item. */
void lanes_block_place(lanes_block *, const lanes_item *, size_t block);
void lanes_block_save(const lanes_block *);
/* Forgets the accelerations of the lane's group. */
void lanes_block_forget(const lanes_block *, size_t lane);
/* Restores the carry and the clock of a lane as lanes_block_save saved them. */
void lanes_block_put_back(const lanes_block *, size_t lane);
/* Gives lane i of the block the numbers of trajectory trajectories[i], where lanes have numbers of their own. */
void lanes_block_number(const lanes_block *, const lanes_item *, const size_t *trajectories);
/* Sets lane i of the block to the start of trajectory trajectories[i]. */
void lanes_block_begin(const lanes_block *, const lanes_item *, const size_t *trajectories);
bool lanes_block_finite(const lanes *, const double *numbers, size_t elements, size_t lane);
/* Tells whether the carry of a lane that has not stopped is NaN, infinite, or so large that an observed number may
 * overflow. */
bool lanes_block_diverged(const lanes_block *);
/* Marks the lanes whose carry is not finite as stopped now. */
void lanes_block_stop(const lanes_block *);
/* Repeats the steps since lanes_block_save, one by one, to find the time at which each lane stopped. Observes after
 * every `every` steps, counted from step n; 0: never. */
void lanes_block_trace(const lanes_block *, bool first, int64_t steps, int64_t n, int64_t every);
/* Observes a block (with own clocks, the lanes in job.where) and marks the lanes whose observed state is not finite as
 * stopped. */
void lanes_block_observe(const lanes_block *);
double lanes_block_time(const lanes_block *, size_t lane);
/* Writes the results of lanes `from` to `to` - 1, after these numbers of observations and steps, for the trajectories
 * from `trajectory` on. */
void lanes_block_results(const lanes_block *, const lanes_call *, size_t from, size_t to, size_t trajectory,
                         int64_t observations, int64_t steps);
/* Writes the errors of a trajectory, which may have stopped. */
void lanes_block_errors(const lanes_call *, const lanes_companion *, bool stopped, size_t trajectory);
/* Computes the state of a block as it is observed, at the present time or, with `ends`, as of time t. Records nothing.
 */
void lanes_block_see(const lanes_block *, bool ends, double t);
/* Calls the progress hook with the fraction done, with `more` trajectories of this item. */
void lanes_item_report(lanes_item *, double more);
/* Tells whether the call is cancelled or refused, so that no more need be computed. */
bool lanes_item_over(const lanes_item *);

/* ---- lanes_companion.c ---- */

/* Returns how many doubles `count` companions need. */
size_t lanes_companion_size(const lanes *, size_t count);
/* Makes `count` companions in this memory. */
lanes_companion *lanes_companion_place(const lanes *, double *memory, size_t count);
void lanes_companion_begin(lanes_companion *, double t0, double until);
/* Compares lanes of both blocks where they landed last, after lanes_block_see: list[i] is the companion of lane i, or
 * NULL where it is not compared. Changes the list. */
void lanes_companion_compare(const lanes_block *, const lanes_block *half, lanes_companion **list,
                             const bool *observed);

/* ---- lanes_schedule.c ---- */

/* How trajectories with own clocks go through the lanes of one block, until the item is over. */
typedef struct lanes_schedule {
    lanes_item *item;
    const lanes_block *block;
    void *ctx;
    /* Gives a free lane the next trajectory, which may be over at once, or prepares some for the next call of `fill`.
     * False: there are no more. */
    bool (*fill)(void *ctx, size_t lane);
    /* Takes steps of all lanes. */
    void (*run)(void *ctx);
    /* Looks at a lane with a trajectory after `run`, and frees it if the trajectory is over. */
    void (*look)(void *ctx, size_t lane);
} lanes_schedule;
void lanes_schedule_run(const lanes_schedule *);
/* Frees a lane. It counts as stopped, because it goes on to compute numbers that belong to no trajectory. */
void lanes_schedule_free(const lanes_block *, size_t lane);
/* Returns, where steps adapt, the step number at which a trajectory is looked at, whatever happens. */
int64_t lanes_schedule_pace(const lanes_block *, size_t lane);

/* ---- lanes_together.c, lanes_apart.c, lanes_watched.c ---- */

void lanes_together(lanes_item *, size_t blocks);
void lanes_apart(lanes_item *);
void lanes_watched(lanes_item *);
size_t lanes_watched_size(const lanes *); /* doubles that lanes_watched needs in the table */
size_t lanes_apart_blocks(void);
size_t lanes_apart_size(const lanes *); /* doubles that lanes_apart needs in the table */

#endif
