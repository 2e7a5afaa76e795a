/* One trajectory of a problem by a row: the texts of step/ with real = double.
 *
 * A trajectory is made of legs: a leg begins at a state and a time, and takes steps of the row from there. A new leg
 * begins when the caller sets another state, and for the shorter last step before a limit that lies between two whole
 * steps. Invariant: the stepper alone holds the time. The main line are the numbers that lead from a step to the next.
 * Observing does not change it: `stepper_sync` computes in other arrays, so the bits of a trajectory do not depend on
 * when it was observed. Nor does the shorter step at the end of a leg, so a saved state goes on beyond the limit as if
 * there had been none.
 */
#ifndef CORE_STEPPER_H
#define CORE_STEPPER_H

#include "core/trace.h"

typedef struct stepper stepper;
typedef struct stepper_body stepper_body; /* core/stepper_body.h */

/* A machine: a problem that it can evaluate, and the loop that advances it. The bits of both are fixed by the
 * problem's equations and the texts of step/, so machines differ in speed alone. */
typedef struct machine {
    const char *name;
    const problem *problem;
    const stepper_body *body;         /* NULL: the library's fastest */
    const struct compiled_host *host; /* of a compiled body: its own data */
} machine;

/* A stepper at (t0, x, v) (nx, nv numbers, copied) with step h != 0 (negative: backward). The machine's problem must
 * outlive it. */
motus_status stepper_create(const machine *, const chosen *, double t0, double h, const double *x, const double *v,
                            const motus_allocator *, stepper **, motus_error *);
void stepper_destroy(stepper *);
/* Begins a new leg at another state and time, with step h; the counters go on. Forgets derivatives that were
 * computed. */
motus_status stepper_start(stepper *, double t0, double h, const double *x, const double *v, motus_error *);

/* The same, and where steps adapt the first candidate has size h, and the state is that of time t0 + lost. */
motus_status stepper_jump(stepper *, double t0, double lost, double h, const double *x, const double *v, motus_error *);

/* The same after an action: what reversible steps that adapt know of the lengths of the motion (step/density.h) stays
 * known. */
motus_status stepper_go_on(stepper *, double t0, double lost, double h, const double *x, const double *v,
                           motus_error *);

/* As stepper_jump, of a stepper of the machine and the method of `along`, which may be NULL. Where the marked last step
 * of that began at this state, what it has computed there is not computed again. */
motus_status stepper_branch(stepper *, const stepper *along, double t0, double lost, double h, const double *x,
                            const double *v, motus_error *);

/* Begins a new leg at the present state, which counts as that of time t, with step h, of adaptive rows the first. Where
 * additions are compensated the rounding errors of the state stay known. */
motus_status stepper_turn(stepper *, double t, double h, motus_error *);
/* Of rows that choose their order, with a tolerance that allows any error: the next steps have the order of the last
 * step of `like`. */
void stepper_follow(stepper *, const stepper *like);

/* How far: so many steps, or up to a time (NaN: none), whichever comes first; and which it was. */
typedef struct stepper_limit {
    int64_t steps;
    double until;
} stepper_limit;
typedef enum stepper_stop {
    STOP_STEPS,
    STOP_UNTIL,
    STOP_EVENT, /* core/events.h */
    STOP_HALT,  /* an inspector has asked for it: fewer steps than the limit may have been taken */
    STOP_FAILED
} stepper_stop;

/* Whole steps of size h from t0 to `until`, and the size of the shorter one after them; 0: none, also where only a few
 * roundings of the quotient are left. */
typedef struct stepper_way {
    int64_t whole;
    double last;
} stepper_way;
stepper_way stepper_way_of(double t0, double h, double until);

/* Takes steps up to the limit; the last one is shorter if the limit lies between two steps. DIVERGED, SOLVE and
 * CALLBACK give the time and the variable; the stepper then stands at the last good step. why may be NULL. */
motus_status stepper_advance(stepper *, stepper_limit, stepper_stop *why, motus_error *);
/* Takes one step towards `until`, to the same bits, and reports its events. */
motus_status stepper_trace(stepper *, double until, const tracer *, motus_error *);
/* The state at the present time, velocities synchronised. x, v of nx, nv numbers; a (may be NULL): the acceleration
 * there. */
motus_status stepper_sync(stepper *, double *x, double *v, double *a, motus_error *);

/* Goes on, on another machine of the same problem, where the stepper stands: at the end of a step that was not the
 * shorter last one. The bits and the counters are the same. After a failure it stands as before. */
motus_status stepper_move(stepper **, const machine *, motus_error *);

/* The largest tolerance that changes the steps of the method: those of a reversible one are at most a part of the time
 * scale of the motion, whatever the tolerance. INFINITY of others. */
double stepper_tolerance_most(const chosen *);

/* Of an adaptive row, every STEPPER_PACE steps: whether a run that has taken `steps` may crawl, since the last
 * STEPPER_PACE of them led so little further beside what is left to the end, and beside the longest step so far. */
enum { STEPPER_PACE = 1 << 16 };
bool stepper_may_crawl(int64_t steps, double gone, double left, double longest, bool smooth);
/* Asked whether a run that may crawl is to end, when its last `steps` steps have led from t - gone to t: other than
 * MOTUS_OK ends it with that status. Asked at numbers of steps that are the same on all machines. */
typedef motus_status (*stepper_judge)(void *ctx, stepper *, int64_t steps, double gone, motus_error *);
/* The status of a run that crawls, and what it says. */
motus_status stepper_crawls(const stepper *, int64_t steps, double gone, motus_error *);
void stepper_judged(stepper *, stepper_judge, void *ctx);
/* Shown a step, marked, and what it answers: the size, with its sign, of a candidate by which the step is taken again,
 * 0: it stands; how many steps are then taken before the next one is shown; and whether the advance ends here. Only
 * where stepper_refuses a step is taken again: rows that find their steps by their errors. */
typedef struct stepper_verdict {
    double again;
    int64_t rest;
    bool halt;
} stepper_verdict;
typedef stepper_verdict (*stepper_inspector)(void *ctx, stepper *);
void stepper_inspected(stepper *, stepper_inspector, void *ctx);
bool stepper_refuses(const chosen *);
const chosen *stepper_method(const stepper *);
const problem *stepper_problem(const stepper *);
double stepper_limit_of(const stepper *); /* the `until` of the latest advance */
/* A state some steps before the present one, in the same leg: the oldest that is kept. False: there is none. The
 * motion stays as it is. */
bool stepper_earlier(stepper *, double *t, double *x, double *v);

double stepper_time(const stepper *);
double stepper_lost(const stepper *);               /* what the rounding of this time has left out */
double stepper_time_of(const stepper *, int64_t n); /* of step n of the leg; NaN where steps adapt */
double stepper_step(const stepper *);               /* size of the present leg's steps, with its sign */
double stepper_last_step(const stepper *);          /* size of the latest step, with its sign */
/* The shortest and the longest step of the leg, without one that was cut short at its end; NaN before them. */
void stepper_sizes(const stepper *, double *shortest, double *longest);
int64_t stepper_refused(const stepper *);
/* finished since the start of the leg, a shorter last one included */
int64_t stepper_steps(const stepper *);
int64_t stepper_evaluations(const stepper *); /* by the method itself; observing is not counted */
int64_t stepper_iterations(const stepper *);

/* Dense output: the state at a time within the last step. stepper_mark keeps the present state as the left end of the
 * next step; without a mark stepper_sample takes the last step once more, from the last snapshot, to the same bits. */
motus_status stepper_mark(stepper *, motus_error *);
/* The time of the mark, what its rounding has left out, and the state there. */
double stepper_marked(const stepper *, double *lost, const double **x, const double **v);
motus_status stepper_sample(stepper *, double t, double *x, double *v, motus_error *);
/* A bound on the size of every acceleration within the marked last step, nv numbers; of stages (step/swing.h) it holds
 * where they show the motion. False: none is known. */
bool stepper_swing(stepper *, double *most);
/* Takes steps up to the limit, until something may have happened in one: `quiet` is shown the states at its ends and
 * the bounds of stepper_swing. The last step is marked, quiet or not; in those before it nothing has happened. So that
 * all is as if these had been taken one by one, `left` tells where the last step began, one that failed too. Where
 * stepper_can_watch: of rows that can be watched (row_watched), while the leg may take steps.
 * stepper_bounded: the stepper does not watch steps of one size, but lanes may, after the first step of a leg.
 *
 * A compiled loop asks of the model's own rules first, and `quiet` only where their bounds leave something open. */
typedef struct stepper_shown {
    double span, from_t, to_t, *from_x, *from_v, *to_x, *to_v;
    const double *most;
} stepper_shown;
typedef struct stepper_watcher {
    bool (*quiet)(void *ctx, const stepper_shown *);
    void *ctx;
    double *largest;                /* raised to the sizes of all states at which steps begin, x and then v */
    double *middle, *width, *least; /* room for a box, x and then v (step/box.h), and bounds of so many functions: */
    size_t functions;
} stepper_watcher;
typedef struct stepper_left {
    int64_t steps; /* before it */
    double t, lost;
    const double *x, *v; /* NULL: no step was begun */
    bool shown;          /* to `quiet` */
} stepper_left;
bool stepper_can_watch(const stepper *);
bool stepper_bounded(const stepper *);
motus_status stepper_watch(stepper *, stepper_limit, const stepper_watcher *, stepper_left *, stepper_stop *why,
                           motus_error *);
/* How many steps lead to the last time that is not after t; 0 where the stepper is there, or where sizes are not
 * known beforehand. */
int64_t stepper_steps_before(const stepper *, double t);

/* Everything that the next step of the leg needs, as `stepper_carry` numbers, and the counters. Of an adaptive row the
 * last ones are t, its rounding error, and what error control carries. Loaded into a stepper
 * that was created in the same way, it continues to the same bits. After a shorter last step this is the state before
 * it. */
enum { STEPPER_CLOCKS = 8 };
typedef struct stepper_count {
    int64_t steps, evaluations, iterations, refused;
} stepper_count;
size_t stepper_carry(const stepper *);
stepper_count stepper_save(const stepper *, double *carry);
double stepper_time_saved(const stepper *, stepper_count, const double *carry); /* the time of a saved state */
motus_status stepper_load(stepper *, stepper_count, const double *carry, motus_error *);
/* The same, of a leg that began at t0 with step h; and the start of the present leg. */
motus_status stepper_load_leg(stepper *, double t0, double h, stepper_count, const double *carry, motus_error *);
double stepper_leg(const stepper *);
/* The state at that start. False: it is not known. */
bool stepper_origin(const stepper *, double *x, double *v);

/* Gives a stepper another body before its first step, for tests that all bodies give the same bits. */
void stepper_use_body(stepper *, const stepper_body *);

#endif
