/* Lanes: many trajectories of one model at once, one in each lane of the processor's vectors, by a text compiled for
 * the model, the row and the numbers that vary. A block is the trajectories that the text computes side by side; it
 * consists of groups, each of which is one vector. A row that solves equations runs in lanes if the equations are few
 * and have one structure; where a family of variables has them, trajectories are computed one at a time.
 */
#ifndef MACHINE_LANES_H
#define MACHINE_LANES_H

#include "core/methods.h"
#include "core/tally.h"
#include "lang/model/vary.h"
#include "machine/differences.h"

typedef struct lanes lanes;

/* A number that is recorded: time, x[place], v[place], or number `place` of a definition. */
typedef struct lanes_source {
    enum { SOURCE_TIME, SOURCE_X, SOURCE_V, SOURCE_DEFINITION } kind;
    const model_definition *definition;
    size_t place;
    int how;       /* REDUCE_ of machine/text/reduce.h */
    size_t result; /* which of the results it is */
} lanes_source;

/* A number of the trajectory's tally that is recorded: TALLY_ of core/tally.h. */
typedef struct lanes_tally {
    int which;
    size_t result;
} lanes_tally;

/* The state of a trajectory between lanes and the one who follows its events: where the next step begins. */
typedef struct lanes_state {
    double t0, h, tick; /* the leg; a step that reaches the time `tick` is looked at */
    int64_t stop;       /* with fixed steps: the steps of the leg after which lanes give the trajectory back */
    stepper_count at;   /* the counters */
    double *carry;      /* the numbers of stepper_save */
    bool end;           /* the trajectory is at its end */
    /* whether the whole call is over, so that nothing counts any more; asked on a long way, with `asked` */
    bool (*over)(void *asked);
    void *asked;
} lanes_state;
/* Who follows the events of trajectories, while lanes take the steps in which nothing happens (lanes_watched.c). A
 * trajectory keeps its `place` from beginning to end. */
typedef struct lanes_follower {
    void *ctx;
    /* Begins a trajectory, and gives the state from which lanes go on. False: the trajectory is over already. */
    bool (*begin)(void *ctx, int thread, size_t place, size_t trajectory, lanes_state *);
    /* Tells whether nothing happened in a step for which the bounds did not prove it. */
    bool (*idle)(void *ctx, int thread, size_t place, const stepper_shown *);
    /* Takes a trajectory back before a step that must be looked at, or at its end, `steps` after the state that it gave
     * last. Gives the state from which lanes go on. False: the trajectory is over. */
    bool (*look)(void *ctx, int thread, size_t place, int64_t steps, const double *largest, lanes_state *);
} lanes_follower;

typedef struct lanes_def {
    model *model;
    const problem *problem;
    const chosen *chosen;
    const vary *vary;
    const size_t *places;
    size_t place_count; /* how many numbers of the pool vary */
    const lanes_source *sources;
    size_t source_count;
    const lanes_tally *tallies;
    size_t tally_count;
    double t0, h, last, until; /* last: the size of the shorter last step; 0: there is none */
    int64_t whole, every;      /* the number of whole steps; the steps from one observation to the next */
    bool own_clock;            /* steps adapt, or ends differ: then whole, last and the sign of h are ignored */
    int lanes, threads;        /* lanes 0: the library chooses */
    bool fast;
    const lanes_follower *follower; /* NULL: the model has no events */
    bool later;                     /* the creator does not wait for the compiler */
    const motus_allocator *allocator;
    int (*progress)(void *context, double fraction);
    /* Adds to the errors of a trajectory the rounding of its quantities at its last state: t, positions and velocities.
     * NULL: nothing is added. */
    void (*rounding)(void *context, const double *const *values, size_t trajectory, const double *state,
                     double *const *errors);
    /* Takes each trajectory that does not come to its end: it may crawl (core/stepper.h), or has stopped while its
     * events were followed. A stepper then judges it. */
    void (*left)(void *context, size_t trajectory, int how);
    void *context;
} lanes_def;
enum { LANES_STOPPED = 1, LANES_MAY_CRAWL };

/* Returns NULL, or the reason why lanes cannot compute these trajectories. */
const char *lanes_refuse(const lanes_def *);
/* Creates lanes; the definition's pointers must outlive them. MOTUS_TOOL, without an error: `note`, with room for
 * `size` characters, says why there is no object. */
motus_status lanes_create(const lanes_def *, lanes **, char *note, size_t size, motus_error *);
/* Tells whether lanes_ready must still be called for lanes that were created `later`. Until it has succeeded, lanes may
 * be joined but do not run. */
bool lanes_awaited(const lanes *);
/* Tells whether the compiler has ended, so that lanes_ready does not wait. It may be called while trajectories of the
 * model are computed in another way. */
bool lanes_look(lanes *);
/* Takes the object, when no trajectories of the model are computed. Fails as lanes_create does. */
motus_status lanes_ready(lanes *, char *note, size_t size, motus_error *);
void lanes_destroy(lanes *);
/* Joins these lanes with the lanes of their companions, which have as many lanes in a block and equal sources, none of
 * them reduced. Compared are the time, the numbers of the state and the sources, as `shape` says. */
motus_status lanes_join(lanes *, lanes *half, const differences_shape *, const lanes_source *state, motus_error *);
/* Computes trajectories i < count from values[k][i] to until[i] (NULL: that of the definition). Writes results[r][i],
 * errors[r][i] (NULL: none are computed; only joined lanes compute them) and stopped[i] (may be NULL). MOTUS_METHOD,
 * without an error: the row may not admit the parameters of some trajectory, which is decided one trajectory at a
 * time. */
motus_status lanes_run(lanes *, size_t count, const double *const *values, const double *until, double *const *results,
                       double *const *errors, double *stopped, motus_error *);
int lanes_in_block(const lanes *);

#endif
