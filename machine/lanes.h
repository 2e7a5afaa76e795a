/* Lanes: many trajectories of one model at once, one in each lane of the processor's vectors, by a text compiled for
 * the model, the row and the numbers that vary. A block is the trajectories that the text computes side by side; it
 * consists of groups, each of which is one vector. A row that solves equations runs in lanes where they are few and of
 * one structure; equations of families are solved one trajectory at a time.
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

/* What is recorded of the trajectory itself: TALLY_ of core/tally.h. */
typedef struct lanes_tally {
    int which;
    size_t result;
} lanes_tally;

/* Who follows the events of trajectories, of which lanes take the steps in which nothing happens (lanes_watched.c).
 * A state is that at which the next step begins: of a leg from t0 with step h, the counters, and the numbers of
 * stepper_save; a step that reaches the time `tick` is looked at; where steps have one size, lanes give the trajectory
 * back after `stop` steps of the leg. A trajectory keeps the `place` that it begins with. `idle` is asked of a step of
 * which the bounds leave something open; where it denies, or a trajectory is to be looked at for another reason, `look`
 * is led to the state before that step, or to the `end` of the trajectory, `steps` after the state that it gave.
 * `begin` and `look` give a state from which lanes go on, or tell that the trajectory is over: then nothing is left to
 * do for it. On a long way they ask whether all is `over`, and nothing counts any more. */
typedef struct lanes_state {
    double t0, h, tick;
    int64_t stop;
    stepper_count at;
    double *carry;
    bool end;
    bool (*over)(void *asked);
    void *asked;
} lanes_state;
typedef struct lanes_follower {
    void *ctx;
    bool (*begin)(void *ctx, int thread, size_t place, size_t trajectory, lanes_state *);
    bool (*idle)(void *ctx, int thread, size_t place, const stepper_shown *);
    bool (*look)(void *ctx, int thread, size_t place, int64_t steps, const double *largest, lanes_state *);
} lanes_follower;

typedef struct lanes_def {
    model *model;
    const problem *problem;
    const chosen *chosen;
    const vary *vary;
    const size_t *places;
    size_t place_count; /* numbers of the pool that vary */
    const lanes_source *sources;
    size_t source_count;
    const lanes_tally *tallies;
    size_t tally_count;
    double t0, h, last, until; /* last: the shorter last step, 0 none */
    int64_t whole, every;      /* whole steps; steps from one observation to the next */
    bool own_clock;            /* steps adapt, or ends differ: whole, last and the sign of h are ignored */
    int lanes, threads;        /* lanes 0: the library chooses */
    bool fast;
    const lanes_follower *follower; /* of a model with events; NULL: of one without */
    bool later;                     /* whoever makes them does not wait for a compiler */
    const motus_allocator *allocator;
    int (*progress)(void *context, double fraction);
    /* Where errors are told: adds to those of a trajectory what rounding makes of its quantities at its last state: t,
     * positions and velocities. NULL: nothing is added. */
    void (*rounding)(void *context, const double *const *values, size_t trajectory, const double *state,
                     double *const *errors);
    /* Called for each trajectory that does not come to its end. One that may crawl (core/stepper.h), or stops while its
     * events are followed, is left where it is, for a stepper to judge. */
    void (*left)(void *context, size_t trajectory, int how);
    void *context;
} lanes_def;
enum { LANES_STOPPED = 1, LANES_MAY_CRAWL };

/* NULL, or the reason why lanes cannot compute these trajectories. */
const char *lanes_refuse(const lanes_def *);
/* The definition's pointers must outlive it. MOTUS_TOOL, with no error: `note`, room for `size` characters, says why
 * there is no object. */
motus_status lanes_create(const lanes_def *, lanes **, char *note, size_t size, motus_error *);
/* `later`: whether lanes_ready is due, because a compiler is still at work, or has ended. lanes_look asks for it,
 * and may be called while trajectories of the model are computed in another way; lanes_ready may not, and fails as
 * lanes_create does. Till it has succeeded lanes may be joined, and do not run. */
bool lanes_awaited(const lanes *);
bool lanes_look(lanes *);
motus_status lanes_ready(lanes *, char *note, size_t size, motus_error *);
void lanes_destroy(lanes *);
/* Joins these lanes with those of their companions, which have as many lanes in a block and the same sources, of which
 * none is reduced. Compared are, as `shape` says, the time, the numbers of the state and the sources. MOTUS_MEMORY. */
motus_status lanes_join(lanes *, lanes *half, const differences_shape *, const lanes_source *state, motus_error *);
/* values[k][i], until[i] (NULL: that of the definition), results[r][i], errors[r][i] (NULL: none are told; else of
 * lanes that are joined), stopped[i] (may be NULL) for i < count.
 * MOTUS_METHOD, with no error: the row may not admit the parameters of some trajectory, which is decided one trajectory
 * at a time. */
motus_status lanes_run(lanes *, size_t count, const double *const *values, const double *until, double *const *results,
                       double *const *errors, double *stopped, motus_error *);
int lanes_in_block(const lanes *);

#endif
