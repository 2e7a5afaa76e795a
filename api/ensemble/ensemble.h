/* An ensemble: which numbers vary, which are recorded, and one of three ways to compute the trajectories: in lanes, in
 * blocks of a callback, or one at a time.
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

typedef struct ensemble_goal ensemble_goal;         /* ensemble_accuracy.c */
typedef struct ensemble_followed ensemble_followed; /* ensemble_followed.c: trajectories with events in lanes */
typedef struct ensemble_table ensemble_table;       /* ensemble_events.c: the events of a trajectory */

struct motus_ensemble {
    motus_system *system;    /* a located one where its switches are (api/system/located.h), */
    motus_system *home;      /*   of this one; NULL: the caller's own */
    const char *not_located; /* why switches are not; "": they are, or that was not asked for */
    ensemble_goal *goal;     /* an accuracy is asked for; NULL: none is */
    motus_allocator allocator;
    chosen chosen;
    timing timing;
    int64_t every;
    size_t vary_count, record_count; /* vary_count: without `until` */
    size_t *places;                  /* of the numbers that vary: in the pool; of a callback: in x, then v */
    size_t *home_places;             /*   of `home`; NULL */
    const double **values;           /* of the present run, at these places */
    size_t given;                    /* arrays of values that a run is given, `until` included */
    size_t until;                    /* its index among them where it varies, or SIZE_MAX */
    double step;                     /* of the definition, or suggested; NaN: the model's */
    const motus_method *card;
    motus_record *records;
    const rules *rules; /* of the system, NULL: it has none */
    /* Where tables of events are kept: their columns, and the table of each trajectory of the last run; NULL */
    size_t *event_columns, event_columns_count;
    ensemble_table *tables;
    size_t tables_count;
    /* ensemble_stopped.c: of each trajectory of the last run, where they are told; and `ends` of places */
    bool tells_causes;
    unsigned char *causes, *ends;
    size_t causes_count;
    size_t *ended, ended_count; /* ensemble_ended.c: of each trajectory of the last run 1 + the rule, or 0; NULL */
    double fraction;            /* reported of the present run */
    /* Where errors can be told: the columns that are compared, the time and the state and then those of the records,
     * whose reductions `how` are (NULL: none is reduced); and the number of each record among them. */
    motus_bars error;
    size_t compared, *compared_columns, *compared_record;
    int *how;
    motus_system *half;    /* of the companions in lanes; NULL */
    atomic_flag rounding;  /* a thread computes with half, for ensemble_errors_rounding */
    double *rounding_room; /* for that: what varies, a state, and bars_moved_room */
    chosen half_chosen;
    vary *half_vary;
    vary *vary;
    lanes *lanes;                /* NULL, or while they are awaited: workers compute the trajectories */
    lanes *half_lanes;           /* of the companions */
    ensemble_followed *followed; /* NULL: lanes have no events */
    machine machine;             /* of the first worker */
    /* `threads` of them, each prepared when it is first needed; until then all its bytes are 0 */
    worker *workers;
    size_t count, block; /* trajectories of the present run; of a block of a callback, or 0 */
    atomic_size_t done;  /* trajectories */
    atomic_bool stop;    /* an item failed, or the run was cancelled */
    bool decided, looks; /* ensemble_witness.c: whether trajectories that tell errors have a witness each */
    /* ensemble_later.c: workers begin in the interpreter while a compiler works, and the trajectories that are left
     * are computed by what it makes. */
    enum { AWAITS_NOTHING, AWAITS_LANES, AWAITS_MACHINE } awaits;
    atomic_bool over;      /* what is awaited is there: workers leave the trajectories that they have not finished, */
    atomic_size_t left;    /*   of which this is the first */
    size_t exactly;        /* tests: 1 + the trajectory before which it is over, 0: as soon as it can be */
    size_t computed;       /* trajectories, by earlier calls; */
    size_t before;         /*   in this call, before those that lanes compute */
    int64_t compiled_from; /* trajectories that the interpreter computed before; -1: all of them */
    int lane_threads;      /* that lanes would take, where workers take fewer */
    machine found;         /* the machine that was awaited, */
    const char *missing;   /*   or why there is none */
    int threads;
    double seconds;
    int (*progress)(void *context, double fraction);
    void *context;
    double reported; /* when `progress` was last called */
    char note[MOTUS_TEXT_MAX];
};

/* Whether a record tells of the trajectory itself, and what: TALLY_ of core/tally.h. */
static inline bool ensemble_tallies(const motus_record *r) { return r->how >= MOTUS_REDUCE_STEPS; }
static inline int ensemble_tally(const motus_record *r) { return (int)r->how - (int)MOTUS_REDUCE_STEPS; }

/* Calls the progress hook, at most every 10 ms; other than 0: cancel. The context is the ensemble. */
int ensemble_report(void *context, double fraction);
/* The place of a number that varies: in the pool of a model, or in x and then v of a callback. */
motus_status ensemble_place(const motus_system *, const char *name, size_t *place, motus_error *);

/* The arguments of a run: values, and room for results. */
typedef struct places {
    const double *const *values;                      /* at e->places */
    const double *until;                              /* where it varies; else NULL */
    double *const *results, *const *errors, *stopped; /* errors NULL: none are told */
    bool observes;                                    /* also before the end */
    unsigned char *ends; /* how lanes and blocks have left a trajectory: LANES_ARRIVED … */
} places;
/* The timing of trajectory k. */
motus_status ensemble_timing(const motus_ensemble *, const places *, size_t k, timing *, motus_error *);

/* ensemble_errors.c: what is compared; the companion of a worker's trajectories. */
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
void ensemble_errors_end(worker *);   /* the worker is over */

/* ensemble_witness.c: decides whether trajectories need a witness each, where that is not decided: by `pilots`
 * trajectories of those given; by some of a call; as another ensemble of the same system. */
motus_status ensemble_witness_ask(motus_ensemble *, const places *, size_t pilots, motus_error *);
motus_status ensemble_witness_first(motus_ensemble *, const places *, motus_error *);
motus_status ensemble_witness_as(motus_ensemble *, const motus_ensemble *, motus_error *);

/* ensemble_events.c: whether the definition asks for tables, and room for those of `count` trajectories; the table of a
 * worker's trajectory k, `errors`: with those of the times; takes over that of another ensemble. */
motus_status ensemble_events_prepare(motus_ensemble *, const motus_ensemble_def *, motus_error *);
motus_status ensemble_events_begin(motus_ensemble *, size_t count, motus_error *);
motus_status ensemble_events_take(worker *, size_t k, bool errors, motus_error *);
void ensemble_events_move(motus_ensemble *to, size_t k, motus_ensemble *from, size_t i);
void ensemble_events_end(motus_ensemble *);

/* ensemble_stopped.c: room for the causes of `count` trajectories, and for how they end; the latter is given back. */
motus_status ensemble_stopped_begin(motus_ensemble *, size_t count, places *, motus_error *);
void ensemble_stopped_finish(motus_ensemble *);
void ensemble_stopped_end(motus_ensemble *);
/* The worker's stepper is judged as that of a run. */
void ensemble_stopped_judged(worker *);
/* The worker's trajectory k stopped, by w->why; `began`: its stepper had begun. */
void ensemble_stopped_take(worker *, size_t k, bool began);
void ensemble_stopped_move(motus_ensemble *to, size_t k, const motus_ensemble *from, size_t i);
/* Those from `first` on whose ends are not final, or not explained, once more by workers. */
motus_status ensemble_stopped_again(motus_ensemble *, const places *, size_t first, motus_error *);

/* ensemble_ended.c: room for what ended `count` trajectories, where there are rules; and that of the worker's
 * trajectory k. */
motus_status ensemble_ended_begin(motus_ensemble *, size_t count, motus_error *);
void ensemble_ended_end(motus_ensemble *);
void ensemble_ended_take(worker *, size_t k, bool stopped);
void ensemble_ended_move(motus_ensemble *to, size_t k, const motus_ensemble *from, size_t i);

/* ensemble_followed.c: who follows the events of lanes, which are made after that; what is needed for the trajectories
 * from `first` on; and their end, before that of the lanes. */
motus_status ensemble_followed_create(motus_ensemble *, const lanes_follower **, motus_error *);
motus_status ensemble_followed_begin(motus_ensemble *, const places *, size_t first, motus_error *);
void ensemble_followed_destroy(motus_ensemble *);

/* ensemble.c: all trajectories, with the tolerance of the ensemble. p: the room that the caller supplies. */
motus_status ensemble_run_all(motus_ensemble *, size_t count, const double *const *values, places p, motus_error *);

/* ensemble_accuracy.c. Where the definition or the model asks for an accuracy, completes the definition by the first
 * tolerance that is tried, by bars and by a record, and makes what searches for the others. */
motus_status ensemble_accuracy_begin(motus_system *, motus_ensemble_def *, ensemble_goal **, motus_error *);
void ensemble_accuracy_end(ensemble_goal *);
bool ensemble_accuracy_told(const ensemble_goal *); /* the caller's definition asks for errors */
motus_status ensemble_accuracy_run(motus_ensemble *, size_t count, const double *const *values, const places *,
                                   motus_error *);

/* ensemble_single.c: one trajectory at a time, from the first on, up to the one before e->left. ensemble_block.c:
 * blocks of a callback. */
motus_status ensemble_singly(motus_ensemble *, const places *, size_t first, motus_error *);
/* Trajectory k; the context is the places. And ensemble_each, after which the system has its own numbers again. */
motus_status ensemble_one(worker *, size_t k, void *places);
motus_status ensemble_each_singly(motus_ensemble *, size_t first, size_t items,
                                  motus_status (*one)(worker *, size_t item, void *ctx), void *ctx, motus_error *);
/* A callback that computes blocks is told which trajectory it is; other runs of the system are trajectory 0. */
void ensemble_number_calls(motus_system *, size_t k, size_t count);
motus_status ensemble_blocks(motus_ensemble *, const places *, motus_error *);

/* How many trajectories a block of a callback has with this method. */
size_t ensemble_block_size(const motus_system *, const chosen *);

/* ensemble_later.c. Whether what is awaited is there, or will never be; while workers compute it may be asked by the
 * caller's thread. */
bool ensemble_look(motus_ensemble *);
/* Computes trajectories by the workers while they are awaited, and then goes over; *first: those that are left. */
motus_status ensemble_meanwhile(motus_ensemble *, const places *, size_t *first, motus_error *);
/* What is awaited is not any more: compilers are killed. */
void ensemble_later_end(motus_ensemble *);
/* For tests, before the first call: the first `count` trajectories of it are computed by the interpreter, and the
 * others by what is awaited, for which it waits there. */
void ensemble_later_at(motus_ensemble *, size_t count);
/* ensemble.c: chooses one trajectory at a time, compiled where that is wanted and possible. */
motus_status ensemble_choose_single(motus_ensemble *, const char *wanted, bool later, motus_error *);
void ensemble_end_lanes(motus_ensemble *);

/* ensemble_workers.c: calls one(worker, item, ctx) for every item from the first on, by the ensemble's threads.
 * Where items fail, returns the status of the one with the lowest number. */
motus_status ensemble_each(motus_ensemble *, size_t first, size_t items,
                           motus_status (*one)(worker *, size_t item, void *ctx), void *ctx, motus_error *);
/* Gives a worker of this number a system and a machine of its own. */
motus_status ensemble_worker_prepare(motus_ensemble *, worker *, int number, motus_error *);
/* As stepper_advance, of the worker's stepper; with a progress hook, in pieces of some milliseconds. */
motus_status ensemble_advance(worker *, stepper_limit, stepper_stop *, motus_error *);
int ensemble_tell(void *worker, double now);
void ensemble_workers_destroy(motus_ensemble *);

#endif
