/* An ensemble: which numbers vary, which are recorded, and one of three ways to compute the trajectories: in lanes, in
 * blocks of a callback, or one at a time. Each of the files here uses only those whose functions stand above its own in
 * this header; the public calls are in api/calls/ensembles.c.
 *
 * Invariant: a trajectory has the same bits in each of these ways and on every thread; they are those of a run with its
 * values, unless a witness objects to a step.
 */
#ifndef API_ENSEMBLE_ENSEMBLE_H
#define API_ENSEMBLE_ENSEMBLE_H

#include "api/motion/run.h"
#include "machine/lanes.h"

#include <stdatomic.h>

/* A worker is the state of one thread. Each has a system of its own, because a model's numbers change from trajectory
 * to trajectory and observing writes to memory of the system: the first the ensemble's, the others clones. */
typedef struct worker {
    motus_ensemble *e;
    motus_system *system;
    diagnosed diagnosed;
    vary *vary;
    machine machine;
    timing timing;    /* of the trajectory that it computes */
    stepper *stepper; /* made for the first trajectory, and started again for the others; NULL */
    events *events;   /* likewise; NULL also where the system has no rules */
    int number;
    motus_run *run;     /* where errors are told: the same trajectory as a run, with the worker's stepper; NULL */
    vary *half_vary;    /* of its companion's system */
    motus_system *home; /* of a located one: the typed system, with the same numbers; NULL */
    vary *home_vary;
    pace pace;
    beside beside;       /* while the ensemble awaits its object */
    size_t trajectories; /* of the present item */
    size_t failed_at;    /* the item that failed, where status is not OK */
    motus_status status;
    motus_error why;
} worker;

typedef struct ensemble_followed ensemble_followed; /* ensemble_followed.c: trajectories with events in lanes */

/* An accuracy is asked for. */
typedef struct ensemble_goal {
    motus_allocator allocator;
    double wanted;
    bool told;              /* the caller asks for errors */
    motus_ensemble_def def; /* of which all that it points to may be gone */
    const char *machine;
    struct ensemble_other *others; /* the ensembles of other tolerances */
    /* of the caller: each part of the search takes half of what is left of a call */
    int (*progress)(void *context, double fraction);
    void *context;
    double from, size;
} ensemble_goal;

/* The events of a trajectory. */
typedef struct ensemble_table {
    size_t count;
    double *values; /* of every row: the columns on arrival, and as the action left them */
    struct {
        event event;
        double error; /* of its time */
    } row[];
} ensemble_table;

/* What a trajectory of the last run came to, beside its numbers. */
typedef struct ensemble_outcome {
    ensemble_table *table; /* where tables are kept; NULL: it has no events */
    uint32_t ended;        /* 1 + the rule that ended it, or 0 */
    unsigned char cause;   /* a motus_cause: why it stopped, where that is told */
    unsigned char left;    /* LANES_STOPPED or LANES_MAY_CRAWL: lanes or a block have left it there; or 0 */
} ensemble_outcome;

struct motus_ensemble {
    motus_allocator allocator;
    int (*progress)(void *context, double fraction);
    void *context;
    double reported, fraction; /* when `progress` was last called, and with which part of the present run */
    double seconds;

    /* ---- what is computed ---- */
    motus_system *system;    /* a located one where its switches are (api/system/located.h), */
    motus_system *home;      /*   of this one; NULL: the caller's own */
    const char *not_located; /* why switches are not; "": they are, or that was not asked for */
    const rules *rules;      /* of the system, NULL: it has none */
    ensemble_goal *goal;     /* NULL: no accuracy is asked for */
    chosen chosen;
    const motus_method *card;
    timing timing;
    double step; /* of the definition, or suggested; NaN: the model's */
    int64_t every;
    motus_record *records;
    size_t record_count;

    /* ---- what varies ---- */
    size_t vary_count;     /* without `until` */
    size_t *places;        /* of the numbers that vary: in the pool; of a callback: in x, then v */
    size_t *home_places;   /*   of `home` */
    const double **values; /* of the present run, at these places */
    size_t given;          /* arrays of values that a run is given, `until` included */
    size_t until;          /* its index among them where it varies, or SIZE_MAX */
    vary *vary;

    /* ---- what trajectories came to ---- */
    ensemble_outcome *outcomes; /* of the last run; NULL */
    size_t outcome_count;
    size_t *event_columns, event_columns_count; /* of the tables of events; NULL: none are kept */
    bool tells_causes;

    /* ---- errors, where they can be told ---- */
    motus_bars error;
    /* The columns that are compared, the time and the state and then those of the records, whose reductions `how` are
     * (NULL: none is reduced); and the number of each record among them. */
    size_t compared, *compared_columns, *compared_record;
    int *how;
    motus_system *half;    /* of the companions in lanes; NULL */
    atomic_flag rounding;  /* a thread computes with half, for ensemble_errors_rounding */
    double *rounding_room; /* for that: what varies, a state, and bars_moved_room */
    chosen half_chosen;
    vary *half_vary;
    bool decided, looks; /* whether trajectories that tell errors have a witness each */

    /* ---- what computes it ---- */
    lanes *lanes;                /* NULL, or while they are awaited: workers compute the trajectories */
    lanes *half_lanes;           /* of the companions */
    ensemble_followed *followed; /* NULL: lanes have no events */
    int lane_threads;            /* that lanes would take, where workers take fewer */
    machine machine;             /* of the first worker */
    /* `threads` of them, each prepared when it is first needed; until then all its bytes are 0 */
    worker *workers;
    int threads;
    size_t block; /* trajectories of a block of a callback, or 0 */
    char note[MOTUS_TEXT_MAX];

    /* ---- the present run ---- */
    size_t count;       /* trajectories */
    atomic_size_t done; /* of these */
    size_t before;      /* those before the ones that lanes compute */
    size_t computed;    /* trajectories, by earlier runs */
    atomic_bool stop;   /* an item failed, or the run was cancelled */
    atomic_bool over;   /* what is awaited is there: workers leave the trajectories that they have not finished, */
    atomic_size_t left; /*   of which this is the first */

    /* ---- what is awaited ---- */
    enum { AWAITS_NOTHING, AWAITS_LANES, AWAITS_MACHINE } awaits;
    machine found;         /* the machine that was awaited, */
    const char *missing;   /*   or why there is none */
    int64_t compiled_from; /* trajectories that the interpreter computed before; -1: all of them */
    size_t exactly;        /* tests: 1 + the trajectory before which it is over, 0: as soon as it can be */
};

/* Whether a record tells of the trajectory itself, and what: TALLY_ of core/tally.h. */
static inline bool ensemble_tallies(const motus_record *r) { return r->how >= MOTUS_REDUCE_STEPS; }
static inline int ensemble_tally(const motus_record *r) { return (int)r->how - (int)MOTUS_REDUCE_STEPS; }
_Static_assert(MOTUS_REDUCE_TOLERANCE - MOTUS_REDUCE_STEPS == TALLY_TOLERANCE, "they are the same list");

/* Whether trajectories take different numbers of steps. */
static inline bool ensemble_steps_differ(const motus_ensemble *e)
{
    return e->until != SIZE_MAX || row_adaptive(&e->chosen);
}

/* The arguments of a run: values, and room for results. */
typedef struct places {
    const double *const *values;                      /* at e->places */
    const double *until;                              /* where it varies; else NULL */
    double *const *results, *const *errors, *stopped; /* errors NULL: none are told */
    bool observes;                                    /* also before the end */
} places;

/* ---- ensemble_names.c: what varies ---- */

/* The place of a number that varies: in the pool of a model, or in x and then v of a callback. */
motus_status ensemble_place(const motus_system *, const char *name, size_t *place, motus_error *);

/* ---- ensemble_outcome.c: what trajectories came to ---- */

/* Room for the outcomes of `count` trajectories. */
motus_status ensemble_outcome_begin(motus_ensemble *, size_t count, motus_error *);
/* The outcome of the worker's trajectory k, which has come to its end, or stopped, by w->why. `began`: the worker's
 * stepper had begun; `errors`: those of the times of its events are told. */
motus_status ensemble_outcome_take(worker *, size_t k, bool stopped, bool began, bool errors, motus_error *);
/* Trajectory k takes over the outcome that trajectory i has in another ensemble. */
void ensemble_outcome_move(motus_ensemble *to, size_t k, motus_ensemble *from, size_t i);
void ensemble_outcome_end(motus_ensemble *);

/* ---- ensemble_workers.c: threads, and the trajectories that they take ---- */

/* Calls the progress hook, at most every 10 ms; other than 0: cancel. The context is the ensemble. */
int ensemble_report(void *context, double fraction);
/* Between two pieces of a worker's work: other than 0: it is to leave it. */
int ensemble_tell(void *worker, double now);
/* Of a worker so many more trajectories are done. MOTUS_CANCELLED: the caller wants no more. */
motus_status ensemble_done(worker *, size_t count);
/* Whether what is awaited is there, or will never be; while workers compute it may be asked by the caller's thread. */
bool ensemble_look(motus_ensemble *);
/* Whether a status is that of a trajectory that stopped, while the others go on. */
bool ensemble_stopped(motus_status, const motus_error *why);
/* The timing of trajectory k. */
motus_status ensemble_timing(const motus_ensemble *, const places *, size_t k, timing *, motus_error *);
/* A callback that computes blocks is told which trajectory it is; other runs of the system are trajectory 0. */
void ensemble_number_calls(motus_system *, size_t k, size_t count);
/* Calls one(worker, item, ctx) for every item from the first on, by the ensemble's threads; afterwards the system has
 * its own numbers again. Where items fail, returns the status of the one with the lowest number. */
motus_status ensemble_each(motus_ensemble *, size_t first, size_t items,
                           motus_status (*one)(worker *, size_t item, void *ctx), void *ctx, motus_error *);
/* Gives a worker of this number a system and a machine of its own. */
motus_status ensemble_worker_prepare(motus_ensemble *, worker *, int number, motus_error *);
void ensemble_worker_end_run(worker *);
void ensemble_workers_destroy(motus_ensemble *);

/* ---- ensemble_errors.c: what is compared; the companion of a worker's trajectories ---- */

motus_status ensemble_errors_prepare(motus_ensemble *, motus_error *);
differences_shape ensemble_errors_shape(const motus_ensemble *);
/* Makes the system of the companions in lanes, what varies in it, and their method. */
motus_status ensemble_errors_half(motus_ensemble *, motus_error *);
/* lanes_def's hook of this name; by one thread at a time. */
void ensemble_errors_rounding(void *ensemble, const double *const *values, size_t trajectory, const double *state,
                              double *const *errors);
motus_status ensemble_errors_worker(worker *, motus_error *);
/* Trajectory k begins, where the worker's stepper stands; `values` are what varies. */
motus_status ensemble_errors_begin(worker *, const double *values, size_t k, motus_error *);
void ensemble_errors_blind(worker *); /* no witness looks at its steps any more */

/* ---- ensemble_single.c: a trajectory that a worker computes by itself ---- */

typedef struct trajectory {
    worker *w;
    double *x, *v, *kept, *now, *values; /* now: of the records; values: what varies */
    size_t *columns;
    int64_t observations;
    bool errors;         /* are told */
    stepper_count began; /* the stepper's counters at the start */
} trajectory;

/* Trajectory k from its start to its end; the context is the places. */
motus_status ensemble_one(worker *, size_t k, void *places);
/* Its parts: room for a trajectory (false: there is no memory); trajectory k begins in the worker's stepper and events
 * (*began: the stepper stands at the start); the worker's system gets the numbers of the trajectory, which has begun;
 * an observation; results and outcome of a trajectory that has been observed at its end, or stopped by w->why. */
bool ensemble_single_open(trajectory *, worker *);
motus_status ensemble_single_begin(trajectory *, const places *, size_t k, bool *began, motus_error *);
motus_status ensemble_single_numbers(trajectory *, motus_error *);
motus_status ensemble_single_observe(trajectory *, motus_error *);
motus_status ensemble_single_results(trajectory *, const places *, size_t k, bool stopped, bool began);
void ensemble_single_close(trajectory *);

/* ---- ensemble_block.c: blocks of a callback ---- */

/* How many trajectories a block has with this method. */
size_t ensemble_block_size(const motus_system *, const chosen *);
motus_status ensemble_blocks(motus_ensemble *, const places *, motus_error *);

/* ---- ensemble_witness.c: whether trajectories need a witness each ---- */

/* Decides that, where it is not decided, by `pilots` trajectories of those given; by some of a call. */
motus_status ensemble_witness_ask(motus_ensemble *, const places *, size_t pilots, motus_error *);
motus_status ensemble_witness_first(motus_ensemble *, const places *, motus_error *);

/* ---- ensemble_followed.c: who follows the events of lanes, which are made after that ---- */

motus_status ensemble_followed_create(motus_ensemble *, const lanes_follower **, motus_error *);
/* What is needed for the trajectories from `first` on. */
motus_status ensemble_followed_begin(motus_ensemble *, const places *, size_t first, motus_error *);
void ensemble_followed_destroy(motus_ensemble *); /* before the lanes */

/* ---- ensemble_lanes.c ---- */

/* Makes lanes where they can compute the ensemble; else e->lanes stays NULL and e->note says why. */
motus_status ensemble_lanes_make(motus_ensemble *, const motus_ensemble_def *, bool later, motus_error *);
/* The trajectories from `first` on. MOTUS_METHOD: as lanes_run. */
motus_status ensemble_lanes_run(motus_ensemble *, const places *, size_t first, motus_error *);
void ensemble_lanes_end(motus_ensemble *);

/* ---- ensemble_machine.c: what computes the trajectories ---- */

const char *ensemble_machine(const motus_ensemble *); /* its name */
motus_status ensemble_machine_choose(motus_ensemble *, const motus_ensemble_def *, motus_error *);
/* One trajectory at a time in place of lanes, which do not know whether the method admits it; which have no witness. */
void ensemble_machine_refused(motus_ensemble *);
motus_status ensemble_machine_witnessed(motus_ensemble *, motus_error *);
/* What was awaited is there, or will never be: it computes the trajectories from `first` on. */
motus_status ensemble_machine_take(motus_ensemble *, size_t first, motus_error *);
/* What is awaited is not any more: compilers are killed. */
void ensemble_machine_end(motus_ensemble *);
/* For tests, before the first call: the first `count` trajectories of it are computed by the interpreter, and the
 * others by what is awaited, for which it waits there. */
void ensemble_later_at(motus_ensemble *, size_t count);

/* ---- ensemble_run.c: a call ---- */

/* Finds the arrays of values of a call, and that of the ends among them; and checks all ends. */
motus_status ensemble_run_values(motus_ensemble *, const double *const *values, places *, motus_error *);
motus_status ensemble_run_ends(const motus_ensemble *, const places *, size_t count, motus_error *);
/* All trajectories, with the tolerance of the ensemble. p: the room that the caller supplies. */
motus_status ensemble_run_all(motus_ensemble *, size_t count, const double *const *values, places p, motus_error *);

/* ---- ensemble_make.c ---- */

/* An ensemble by a definition that is sound and complete. goal: NULL, or the ensemble's, with which it has one more
 * record. like: NULL, or the ensemble from which it takes what varies, since the names are gone. */
motus_status ensemble_make(motus_system *, const motus_ensemble_def *, ensemble_goal *goal, const motus_ensemble *like,
                           motus_ensemble **, motus_error *);
void ensemble_free(motus_ensemble *); /* but for its goal */

/* ---- ensemble_accuracy.c: every trajectory has a tolerance of its own ---- */

/* Where the definition or the model asks for an accuracy, completes the definition by the first tolerance that is
 * tried and by bars, and makes what searches for the others. */
motus_status ensemble_accuracy_begin(motus_system *, motus_ensemble_def *, ensemble_goal **, motus_error *);
void ensemble_accuracy_end(ensemble_goal *);
motus_status ensemble_accuracy_run(motus_ensemble *, size_t count, const double *const *values, const places *,
                                   motus_error *);

#endif
