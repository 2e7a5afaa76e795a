/* The stepper's struct and internal functions. Each of its files uses only those that stand before it in this list:
 * stepper_state.c (time, carry, observation, reports of failures), stepper_start.c (legs), stepper.c (life),
 * stepper_blur.c (steps too short for the times of stages), stepper_advance.c (steps, the way back from a failure),
 * stepper_dense.c (dense output). */
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
    size_t all[2]; /* the one variable of a problem that names none */
    const stepper_body *body;
    double leg_h;   /* the step of the leg; work.h differs in a shorter last step, and where steps adapt */
    bool shortened; /* the last step was the shorter one up to `until`; the snapshot is the state before it */
    bool arrived;   /* the stepper stands at `until` */
    double until;
    double *arrays;     /* of work */
    size_t array_count; /* how many numbers they have */
    /* the carried numbers at `at`, and at the snapshot before, of this leg; steps < 0: there is none */
    double *snapshot, *earlier;
    stepper_count at, earlier_at;
    double *origin; /* x, v at the start of the leg, which is known unless its state was loaded */
    bool origin_known;
    double main_t0; /* when the leg began; work.t0 differs in a shorter last step */
    /* where steps adapt: the latest step number that is a multiple of STEPPER_PACE, and its time; < 0: not known */
    double pace_t;
    int64_t pace_n;
    stepper_judge judge; /* NULL: nobody judges whether the run crawls */
    void *judge_ctx;
    stepper_inspector inspector; /* NULL: steps stand as they are accepted */
    void *inspector_ctx;
    int64_t rest; /* how many steps are taken before the inspector is shown one */
    double *ends; /* for dense output: x, v, a at the left end, then at the right; NULL until asked for */
    double left_t, left_lost;
    int64_t left_steps; /* stepper_steps at the left end */
    bool left, right;   /* which of the two ends are valid */
    bool asked;      /* a sample has had to take the latest step again: from then on steps taken singly leave a mark */
    double *watched; /* x, v before and after a watched step, then `most`; NULL until asked for */
    watch watch;
    const stepper_watcher *watcher;
    bool watching;  /* the steps that are taken are watched */
    double *inside; /* the family's arrays and constants for dense output; NULL until asked for */
    dense_room room;
    bool extended; /* the arrays in `inside` are those of the last step */
};

/* stepper_state.c. Writes and returns the name of number k of x or v. */
const char *stepper_name(const stepper *, bool in_v, size_t k, char out[MOTUS_NAME_MAX]);
/* Tells what the rounding of the time of a step of the leg has left out, with fixed steps. */
double stepper_lost_at(const stepper *, int64_t step);
/* Returns the status, and writes the message, for a STEP_ status at time t. */
motus_status stepper_report(const stepper *, int bad, double t, motus_error *);
/* Tells whether the force has no finite value at the present state, before the first step; then this becomes the
 * message, in place of the failure of the first step. The error keeps its time, the end of that step. */
bool stepper_undefined(stepper *, motus_error *);
/* Copies the carried numbers into the main line; ends a shorter last step. */
void stepper_put(stepper *, stepper_count, const double *carry);
stepper_count stepper_get(const stepper *, double *carry);
bool stepper_ends(stepper *); /* takes the memory for dense output; false: there is none */
/* Keeps the right end of the last step, unless it is kept already. */
motus_status stepper_right_end(stepper *, motus_error *);

/* stepper_start.c. Begins a leg at a state, without checks. */
void stepper_begin(stepper *, double t0, double h, const double *x, const double *v);

/* stepper_blur.c. Takes a step where error control finds none because times are rounded, and a snapshot before it.
 * False: that is not why, and the caller goes back. Before such a step, and while rounded times may be why, `rise` is
 * STEPPER_BLURS, a little less than CONTROL_RISE. */
#define STEPPER_BLURS 2.25
bool stepper_blurred(stepper *, const stepper_body *);
bool stepper_may_blur(const stepper *);
/* Takes steps from a snapshot again, to equal bits. Returns STEP_OK or what stopped them. */
int stepper_repeat(stepper *, int64_t steps);

/* stepper_advance.c. Repeats the last step, with a mark before it. */
motus_status stepper_again(stepper *, motus_error *);

#endif
