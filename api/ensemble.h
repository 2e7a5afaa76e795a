/* An ensemble: what varies, what is recorded, and one of three ways to compute it: in lanes; blocks of a callback;
 * one trajectory at a time.
 *
 * Invariant: whoever computes a trajectory, on whichever thread, gives it the bits of a run with its values.
 */
#ifndef API_ENSEMBLE_H
#define API_ENSEMBLE_H

#include "api/run.h"
#include "machine/lanes.h"

#include <stdatomic.h>

/* What a thread has of its own. The first one's system is the ensemble's, the others' are read again: a model's
 * numbers change from trajectory to trajectory, and to look at a state takes scratch memory. */
typedef struct worker {
    motus_ensemble *e;
    motus_system *system;
    vary *vary;
    machine machine;
    timing timing; /* of the trajectory that it computes */
    stepper *stepper; /* made for the first trajectory, and started again for the others; NULL */
    int number;
    pace pace;
    size_t trajectories; /* that are computed at present */
    size_t failed_at;    /* item, where status is not OK */
    motus_status status;
    motus_error why;
} worker;

struct motus_ensemble {
    motus_system *system;
    motus_allocator allocator;
    chosen chosen;
    timing timing;
    int64_t every;
    size_t vary_count, record_count; /* vary_count: without `until` */
    size_t *places;                  /* of the pool; of a callback: of x, then v */
    const double **values;           /* room for the values at them */
    size_t given;                    /* arrays of values that a run is given: `until` among them */
    size_t until;                    /* its place among them where it varies, or SIZE_MAX */
    double step;                     /* as asked for; NaN: the model's */
    motus_record *records;
    vary *vary;
    lanes *lanes;    /* NULL: one trajectory after the other */
    machine machine; /* then, of the first worker */
    /* `threads` of them, made when they are first needed; those not made yet are zero */
    worker *workers;
    size_t count, block; /* trajectories of this run; of a block, where a callback takes them so; else 0 */
    atomic_size_t done;
    atomic_bool stop; /* somebody failed, or nobody wants the rest */
    int threads;
    double seconds;
    int (*progress)(void *context, double fraction);
    void *context;
    double told; /* when `progress` was last called */
    char note[MOTUS_TEXT_MAX];
};

/* Tells the one who watches, not more often than every 10 ms; other than 0: cancel. The context is the ensemble. */
int ensemble_watched(void *context, double fraction);
/* What varies: its place in the pool of a model, or in x and then v of a callback. */
motus_status ensemble_place(const motus_system *, const char *name, size_t *place, motus_error *);

/* What a run is given: where values come from and results go. */
typedef struct places {
    const double *const *values; /* at e->places */
    const double *until;         /* where it varies; else NULL */
    double *const *results, *stopped;
    bool observes; /* on the way, not at the end alone */
} places;
/* The timing of trajectory k. */
motus_status ensemble_timing(const motus_ensemble *, const places *, size_t k, timing *, motus_error *);

/* ensemble_single.c: one trajectory after the other. ensemble_block.c: blocks of a callback. */
motus_status ensemble_singly(motus_ensemble *, const places *, motus_error *);
motus_status ensemble_blocks(motus_ensemble *, const places *, motus_error *);

/* How many of a callback's trajectories go side by side by this method. */
size_t ensemble_block_size(const motus_system *, const chosen *);

/* ensemble_workers.c: one(worker, item, ctx) for every item by the ensemble's threads. The first item that fails
 * decides. */
motus_status ensemble_each(motus_ensemble *, size_t items, motus_status (*one)(worker *, size_t item, void *ctx),
                           void *ctx, motus_error *);
/* As stepper_advance, of the worker's stepper; where somebody watches, in pieces of some milliseconds. */
motus_status ensemble_advance(worker *, stepper_limit, stepper_stop *, motus_error *);
void ensemble_dismiss(motus_ensemble *); /* the workers */

#endif
