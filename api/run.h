/* A run: a stepper on its way from the start to `until`.
 *
 * Invariant: what happened to the motion is the stepper's to know (time, steps, whether it has arrived); the run
 * keeps what was read of it.
 */
#ifndef API_RUN_H
#define API_RUN_H

#include "api/pace.h"
#include "api/system.h"

struct motus_run {
    motus_system *system;
    machine machine;
    const char *note;
    motus_allocator allocator;
    chosen chosen;
    const motus_method *card;
    double t0, h, until;
    int64_t whole, total; /* whole steps up to `until`, and with the short one */
    double last;          /* size of the short one, 0: none */
    stepper *stepper;
    bool arrived;
    int legs;          /* a leg begins at the start and at every motus_run_set_state */
    int64_t before;    /* steps taken in earlier legs */
    double first_step; /* size of the first step of all; NaN before it */
    int (*observer)(void *context, motus_run *);
    bool observing;    /* the observer is at work */
    double *x, *v, *a; /* the synchronised state, valid while `synchronised` */
    bool synchronised, with_a;
    double *mid_x, *mid_v; /* a state between two steps */
    int (*progress)(void *context, double fraction);
    void *context;
    pace pace;
    double told; /* when `progress` was last called */
    char *saved;
    size_t saved_room;
    struct trace *trace; /* of the last step that was traced; NULL */
};

/* From the start to the end: whole steps, and a shorter last one. NaN: the model's. */
typedef struct timing {
    double t0, h, until, last;
    int64_t whole, total;
} timing;
motus_status run_timing(const motus_system *, const chosen *, double step, double until, double start, timing *,
                        motus_error *);
motus_status run_sync(motus_run *, bool with_a, motus_error *);
/* The stepper stands elsewhere: what was read of it no longer holds, and it may stand at the end. */
motus_status run_moved(motus_run *, motus_error *);
/* Takes over when the run's leg begins, and how long it is. */
void run_leg(motus_run *, const timing *);

#endif
