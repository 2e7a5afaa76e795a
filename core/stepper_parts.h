/* The stepper's struct and internal functions. From the lowest, each of its files uses only those above it on this
 * list: stepper_state.c (time, carry, observation, reports of failures), stepper_start.c (legs), stepper.c (life),
 * stepper_advance.c (steps, the way back from a failure), stepper_dense.c (dense output).
 */
#ifndef CORE_STEPPER_PARTS_H
#define CORE_STEPPER_PARTS_H

#include "core/stepper.h"
#include "core/stepper_body.h"
#include "core/trace_body.h"

struct stepper {
    problem problem;
    struct stepper_host library;
    motus_allocator allocator;
    chosen method;
    work work;
    size_t all[2]; /* the variable of a problem that names none */
    const stepper_body *body;
    /* step of the leg; work.h differs from it in a shorter last step, and where steps adapt */
    double leg_h;
    /* the last step was the shorter one up to `until`; the snapshot is the state before it */
    bool shortened;
    bool arrived; /* the stepper stands at `until` */
    double until;
    double *arrays;     /* those of work: */
    size_t array_count; /*   so many numbers */
    /* the carried numbers at `at`, and those of the snapshot before, of the same leg; steps < 0: none */
    double *snapshot, *earlier;
    stepper_count at, earlier_at;
    double *origin; /* x, v at the start of the leg, which is known unless its state was loaded */
    bool origin_known;
    double main_t0; /* of the leg, while the shorter last step has its own */
    /* where steps adapt: the time after the latest multiple of PACE steps, and that number; < 0: not known */
    double pace_t;
    int64_t pace_n;
    stepper_judge judge; /* NULL: nobody judges whether it crawls */
    void *judge_ctx;
    stepper_inspector inspector; /* NULL: steps stand as they are accepted */
    void *inspector_ctx;
    int64_t rest; /* steps before it is shown the next one */
    /* of dense output: x, v, a at the left end, then at the right; NULL until asked for */
    double *ends;
    double left_t, left_lost;
    int64_t left_steps; /* stepper_steps at the left end */
    bool left, right;   /* which of the two ends are valid */
    double *watched;    /* x, v before and after a watched step, then `most`; NULL until asked for */
    watch watch;
    const stepper_watcher *watcher;
    bool watching; /* the steps that are taken are watched */
    /* the family's arrays and constants, NULL until asked for; extended: the arrays are those of the last step */
    double *inside;
    dense_room room;
    bool extended;
};

/* stepper_state.c. The name of number k of x or v. */
const char *stepper_name(const stepper *, bool in_v, size_t k, char out[MOTUS_NAME_MAX]);
/* The status and message for a STEP_ status at time t. */
motus_status stepper_report(const stepper *, int bad, double t, motus_error *);
/* Whether the force has no finite value at the present state, where no step was made; then says so in place of what the
 * first step ran into. The error keeps its time, the end of that step. */
bool stepper_undefined(stepper *, motus_error *);
/* Copies the carried numbers into the main line; ends a shorter last step. */
void stepper_put(stepper *, stepper_count, const double *carry);
stepper_count stepper_get(const stepper *, double *carry);
bool stepper_ends(stepper *); /* takes the memory for dense output; false: there is none */
/* Keeps the right end of the last step, once. */
motus_status stepper_right_end(stepper *, motus_error *);

/* stepper_start.c. A leg's first state, without checks. */
void stepper_begin(stepper *, double t0, double h, const double *x, const double *v);

/* stepper_advance.c. Takes the last step once more, with a mark before it. */
motus_status stepper_again(stepper *, motus_error *);

#endif
