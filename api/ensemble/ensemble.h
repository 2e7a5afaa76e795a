/* An ensemble: what varies, what is recorded, and three ways to compute trajectories: in lanes, in blocks of a
 * callback, or one at a time. Each file here uses only files whose functions stand above its own in this header.
 *
 * Invariant: a trajectory has the bits of a run with its values, in each of these ways and on every thread, unless a
 * witness objects to a step.
 */
#ifndef API_ENSEMBLE_ENSEMBLE_H
#define API_ENSEMBLE_ENSEMBLE_H

#include "api/motion/run.h"
#include "machine/lanes.h"

#include <stdatomic.h>

/* The state of one thread. The first worker has the ensemble's system, the others clones, because a model's numbers
 * change from trajectory to trajectory, and observing writes to memory of the system. */
typedef struct worker {
    motus_ensemble *e;
    motus_system *system;
    diagnosed diagnosed;
    vary *vary;
    machine machine;
    timing timing;    /* of the present trajectory */
    stepper *stepper; /* NULL before the first trajectory; later ones start it again */
    events *events;   /* NULL before the first trajectory, and where the system has no rules */
    int number;
    motus_run *run;     /* the trajectory as a run with the worker's stepper; NULL: no errors are wanted */
    vary *half_vary;    /* of the companion's system */
    motus_system *home; /* where `system` is located: the typed system, with the same values; else NULL */
    vary *home_vary;    /* of `home` */
    pace pace;
    beside beside;       /* used while the ensemble awaits a compiled object */
    size_t trajectories; /* of the present item */
    size_t failed_at;    /* the item that failed, if status is not OK */
    motus_status status;
    motus_error why;
} worker;

typedef struct ensemble_followed ensemble_followed; /* trajectories with events in lanes */

/* The accuracy that an ensemble is asked for. */
typedef struct ensemble_goal {
    motus_allocator allocator;
    double wanted;
    bool told;              /* the caller asks for errors */
    motus_ensemble_def def; /* what its pointers pointed to may be gone */
    request request;        /* with the first tolerance */
    const char *machine;
    struct ensemble_other *others; /* one for each other tolerance */
    /* The progress hook of the caller. The present part of the search has the share `size` of a call, from `from` on:
     * half of what is left. */
    int (*progress)(void *context, double fraction);
    void *context;
    double from, size;
} ensemble_goal;

/* The events of a trajectory. */
typedef struct ensemble_table {
    size_t count;
    double *values; /* of every row: the columns before its event and after it */
    struct {
        event event;
        double error; /* of the event's time */
    } row[];
} ensemble_table;

/* What a trajectory of the last run came to, besides its numbers. */
typedef struct ensemble_outcome {
    ensemble_table *table; /* NULL: it has no events, or no tables are kept */
    uint32_t ended;        /* 1 + the rule that ended it; 0: none */
    unsigned char cause;   /* the motus_cause of its stop, where causes are told */
    unsigned char left;    /* LANES_STOPPED or LANES_MAY_CRAWL: lanes or a block did not finish it; else 0 */
} ensemble_outcome;

struct motus_ensemble {
    motus_allocator allocator;
    int (*progress)(void *context, double fraction);
    void *context;
    double reported, fraction; /* reported: when `progress` was last called; fraction: of the present run */
    double seconds;

    /* ---- what is computed ---- */
    motus_system *system;    /* a located one (api/system/system.h) where switches are located */
    motus_system *home;      /* the caller's system where `system` is a located one; else NULL */
    const char *not_located; /* why switches are not located; "": they are, or nobody asked */
    const rules *rules;      /* of the system; NULL: it has none */
    ensemble_goal *goal;     /* NULL: no accuracy is asked for */
    chosen chosen;
    const motus_method *card;
    timing timing;
    double step; /* given or suggested; NaN: the model's */
    int64_t every;
    motus_record *records;
    size_t record_count;

    /* ---- what varies ---- */
    size_t vary_count;     /* numbers that vary, without `until` */
    size_t *places;        /* of these numbers: in the pool of a model, or in x and then v of a callback */
    size_t *home_places;   /* of these numbers in `home` */
    const double **values; /* of the present run, for these numbers */
    size_t given;          /* how many arrays of values a run is given, the one of `until` included */
    size_t until;          /* the array of ends; SIZE_MAX: the end does not vary */
    vary *vary;

    /* ---- what trajectories came to ---- */
    ensemble_outcome *outcomes; /* of the last run; NULL: there was none */
    size_t outcome_count;
    size_t *event_columns, event_columns_count; /* of the tables of events; NULL: no tables are kept */
    bool tells_causes;

    /* ---- errors, where they can be told ---- */
    motus_bars error;
    /* The columns that are compared: the time, the state, and then those of the records. how: how each is reduced
     * (NULL: none is). compared_record: for each record, the place of its column among these. */
    size_t compared, *compared_columns, *compared_record;
    int *how;
    motus_system *half;    /* the system of companions in lanes; NULL */
    atomic_flag rounding;  /* set while a thread uses `half` in ensemble_errors_rounding */
    double *rounding_room; /* what varies, a state, and bars_moved_room */
    chosen half_chosen;
    vary *half_vary;
    bool decided, looks; /* decided: it is known whether witnesses are needed; looks: they are needed */

    /* ---- what computes it ---- */
    lanes *lanes;                /* NULL, or awaited: workers compute the trajectories */
    lanes *half_lanes;           /* of companions */
    ensemble_followed *followed; /* NULL: lanes have no events */
    int lane_threads;            /* how many threads lanes would take */
    machine machine;             /* of the first worker */
    worker *workers;             /* `threads` of them; all bytes of one are 0 before it is prepared */
    int threads;
    size_t block; /* trajectories in a block of a callback; 0: no blocks */
    char note[MOTUS_TEXT_MAX];

    /* ---- the present run ---- */
    size_t count;       /* of trajectories */
    atomic_size_t done; /* trajectories that are done */
    size_t before;      /* trajectories before the first that lanes compute */
    size_t computed;    /* trajectories of earlier runs */
    atomic_bool stop;   /* an item failed, or the run was cancelled */
    atomic_bool over;   /* what is awaited is there: workers leave the trajectories that they have not finished */
    atomic_size_t left; /* the first trajectory that workers have left */

    /* ---- what is awaited ---- */
    enum { AWAITS_NOTHING, AWAITS_LANES, AWAITS_MACHINE } awaits;
    machine found;         /* the machine that was awaited */
    const char *missing;   /* why there is no such machine; NULL */
    int64_t compiled_from; /* trajectories that the interpreter computed before; -1: it computes all */
    size_t exactly;        /* for tests: 1 + the trajectory before which workers leave; 0: as soon as they can */
};

/* Returns whether a record is of the steps of a trajectory; and which, as TALLY_ of core/tally.h. */
static inline bool ensemble_tallies(const motus_record *r) { return r->how >= MOTUS_REDUCE_STEPS; }
static inline int ensemble_tally(const motus_record *r) { return (int)r->how - (int)MOTUS_REDUCE_STEPS; }
_Static_assert(MOTUS_REDUCE_TOLERANCE - MOTUS_REDUCE_STEPS == TALLY_TOLERANCE, "they are the same list");

/* Returns whether trajectories take different numbers of steps. */
static inline bool ensemble_steps_differ(const motus_ensemble *e)
{
    return e->until != SIZE_MAX || row_adaptive(&e->chosen);
}

/* The arrays of a run: values, and room for results. */
typedef struct places {
    const double *const *values;                      /* for e->places */
    const double *until;                              /* NULL: the end does not vary */
    double *const *results, *const *errors, *stopped; /* errors NULL: no errors are wanted */
    bool observes;                                    /* numbers are observed before the end, too */
} places;

/* ---- ensemble_names.c: what varies ---- */

/* Finds the place of a number that varies: in the pool of a model, or in x and then v of a callback. */
motus_status ensemble_place(const motus_system *, const char *name, size_t *place, motus_error *);

/* ---- ensemble_outcome.c: what trajectories came to ---- */

/* Makes room for the outcomes of `count` trajectories. */
motus_status ensemble_outcome_begin(motus_ensemble *, size_t count, motus_error *);
/* Notes the outcome of the worker's trajectory k, which is at its end, or stopped by w->why. began: its stepper had
 * begun; errors: whether to find the errors of its events' times. */
motus_status ensemble_outcome_take(worker *, size_t k, bool stopped, bool began, bool errors, motus_error *);
/* Gives trajectory k the outcome of trajectory i of another ensemble. */
void ensemble_outcome_move(motus_ensemble *to, size_t k, motus_ensemble *from, size_t i);
void ensemble_outcome_end(motus_ensemble *);

/* ---- ensemble_workers.c: threads, and the trajectories that they take ---- */

/* Calls the progress hook of the ensemble, at most every 10 ms. Nonzero: the caller cancels. */
int ensemble_report(void *context, double fraction);
/* Pauses a worker between two pieces of work. Nonzero: it has to stop. */
int ensemble_tell(void *worker, double now);
/* Counts trajectories that a worker has done. MOTUS_CANCELLED: the caller wants no more. */
motus_status ensemble_done(worker *, size_t count);
/* Returns whether what is awaited is there, or will never be. Only the caller's thread asks while workers compute. */
bool ensemble_look(motus_ensemble *);
/* Returns whether a status means that one trajectory stopped, while the others go on. */
bool ensemble_stopped(motus_status, const motus_error *why);
/* Finds the timing of trajectory k. */
motus_status ensemble_timing(const motus_ensemble *, const places *, size_t k, timing *, motus_error *);
/* Tells a callback that computes blocks which ones come next: `count` trajectories from k on. 0, 0: runs of the
 * system. */
void ensemble_number_calls(motus_system *, size_t k, size_t count);
/* Calls one(worker, item, ctx) for every item from `first` on, by the threads of the ensemble; afterwards the system
 * has its own numbers again. Returns the status of the first item that failed. */
motus_status ensemble_each(motus_ensemble *, size_t first, size_t items,
                           motus_status (*one)(worker *, size_t item, void *ctx), void *ctx, motus_error *);
/* Prepares a worker, with a system and a machine of its own unless its number is 0. */
motus_status ensemble_worker_prepare(motus_ensemble *, worker *, int number, motus_error *);
void ensemble_worker_end_run(worker *);
void ensemble_workers_destroy(motus_ensemble *);

/* ---- ensemble_errors.c: what is compared; the companion of a worker's trajectories ---- */

motus_status ensemble_errors_prepare(motus_ensemble *, motus_error *);
differences_shape ensemble_errors_shape(const motus_ensemble *);
/* Makes the system of companions in lanes, with what varies in it, and their method. */
motus_status ensemble_errors_half(motus_ensemble *, motus_error *);
/* Adds roundings to the errors: the hook `rounding` of lanes_def. Threads wait for one another in it. */
void ensemble_errors_rounding(void *ensemble, const double *const *values, size_t trajectory, const double *state,
                              double *const *errors);
motus_status ensemble_errors_worker(worker *, motus_error *);
/* Begins trajectory k where the worker's stepper stands. values: the numbers that vary. */
motus_status ensemble_errors_begin(worker *, const double *values, size_t k, motus_error *);
void ensemble_errors_blind(worker *); /* ends the witness of the worker's trajectories */

/* ---- ensemble_single.c: a trajectory that a worker computes by itself ---- */

typedef struct trajectory {
    worker *w;
    double *x, *v, *kept, *now, *values; /* now: the records, at present; values: the numbers that vary */
    size_t *columns;
    int64_t observations;
    bool errors;         /* errors are wanted */
    stepper_count began; /* the stepper's counters at the start */
} trajectory;

/* Computes trajectory k from start to end; `places` is a struct places. */
motus_status ensemble_one(worker *, size_t k, void *places);
/* Makes room for a trajectory. False: there is no memory. */
bool ensemble_single_open(trajectory *, worker *);
/* Begins trajectory k in the worker's stepper and events. *began: the stepper stands at the start. */
motus_status ensemble_single_begin(trajectory *, const places *, size_t k, bool *began, motus_error *);
/* Gives the worker's system the numbers of a trajectory that has begun. */
motus_status ensemble_single_numbers(trajectory *, motus_error *);
motus_status ensemble_single_observe(trajectory *, motus_error *);
/* Writes results and outcome of a trajectory, which is at its end and was observed there, or stopped by w->why. */
motus_status ensemble_single_results(trajectory *, const places *, size_t k, bool stopped, bool began);
void ensemble_single_close(trajectory *);

/* ---- ensemble_block.c: blocks of a callback ---- */

/* Returns how many trajectories a block has with this method; 0: there are no blocks. */
size_t ensemble_block_size(const motus_system *, const chosen *);
motus_status ensemble_blocks(motus_ensemble *, const places *, motus_error *);

/* ---- ensemble_witness.c: whether trajectories need a witness each ---- */

/* Decides it once, by `pilots` pilots, spread over the trajectories. */
motus_status ensemble_witness_ask(motus_ensemble *, const places *, size_t pilots, motus_error *);
/* Decides it once, by a few pilots, when a call wants errors. */
motus_status ensemble_witness_first(motus_ensemble *, const places *, motus_error *);

/* ---- ensemble_followed.c: what follows the events of lanes ---- */

/* Makes the follower, before the lanes. */
motus_status ensemble_followed_create(motus_ensemble *, const lanes_follower **, motus_error *);
/* Prepares for the trajectories from `first` on. */
motus_status ensemble_followed_begin(motus_ensemble *, const places *, size_t first, motus_error *);
void ensemble_followed_destroy(motus_ensemble *); /* call it before the lanes are destroyed */

/* ---- ensemble_lanes.c ---- */

/* Makes lanes if they can compute the ensemble; else e->lanes stays NULL, and e->note says why. */
motus_status ensemble_lanes_make(motus_ensemble *, const motus_ensemble_def *, bool later, motus_error *);
/* Computes the trajectories from `first` on. MOTUS_METHOD: as of lanes_run. */
motus_status ensemble_lanes_run(motus_ensemble *, const places *, size_t first, motus_error *);
void ensemble_lanes_end(motus_ensemble *);

/* ---- ensemble_machine.c: what computes the trajectories ---- */

const char *ensemble_machine(const motus_ensemble *); /* its name */
motus_status ensemble_machine_choose(motus_ensemble *, const motus_ensemble_def *, motus_error *);
/* Replaces lanes by workers, since lanes do not know whether the method admits a trajectory. */
void ensemble_machine_refused(motus_ensemble *);
/* Replaces lanes by workers, since lanes have no witness. */
motus_status ensemble_machine_witnessed(motus_ensemble *, motus_error *);
/* Lets what was awaited, if it is there, compute the trajectories from `first` on. */
motus_status ensemble_machine_take(motus_ensemble *, size_t first, motus_error *);
/* Ends the waiting, and kills the compilers. */
void ensemble_machine_end(motus_ensemble *);
/* For tests, before the first call: lets the interpreter compute the first `count` trajectories, waits there for what
 * is awaited, and lets that compute the others. */
void ensemble_later_at(motus_ensemble *, size_t count);

/* ---- ensemble_run.c: a call ---- */

/* Find the arrays of values of a call, the one of the ends included, and check all ends. */
motus_status ensemble_run_values(motus_ensemble *, const double *const *values, places *, motus_error *);
motus_status ensemble_run_ends(const motus_ensemble *, const places *, size_t count, motus_error *);
/* Computes all trajectories with the tolerance of the ensemble. p: the caller's room. */
motus_status ensemble_run_all(motus_ensemble *, size_t count, const double *const *values, places p, motus_error *);

/* ---- ensemble_make.c ---- */

/* Makes an ensemble from a sound definition and its settled request. goal: adds one record, for the accuracy; may be
 * NULL. like: an ensemble to copy the varying numbers from, once the caller's names are gone; may be NULL. */
motus_status ensemble_make(motus_system *, const motus_ensemble_def *, const request *, ensemble_goal *goal,
                           const motus_ensemble *like, motus_ensemble **, motus_error *);
void ensemble_free(motus_ensemble *); /* keeps the goal */

/* ---- ensemble_accuracy.c: every trajectory has a tolerance of its own ---- */

/* Puts a first tolerance into a settled request for an accuracy, and bars into its definition, and makes the goal. */
motus_status ensemble_accuracy_begin(motus_system *, motus_ensemble_def *, request *, ensemble_goal **, motus_error *);
void ensemble_accuracy_end(ensemble_goal *);
motus_status ensemble_accuracy_run(motus_ensemble *, size_t count, const double *const *values, const places *,
                                   motus_error *);

#endif
