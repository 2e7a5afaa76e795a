/* One trajectory of a problem by a row: the texts of step/ with real = double.
 *
 * A trajectory is made of legs: a leg begins at a state and a time, and takes steps of the row from there. A new leg
 * begins when the caller sets another state, and for the shorter last step before a limit that lies between two whole
 * steps. Invariant: the stepper alone holds the time. The main line is the numbers that lead from a step to the next.
 * Observing does not change it: `stepper_sync` computes in other arrays, so the bits of a trajectory do not depend on
 * when it was observed. The shorter step at the end of a leg does not change it either, so a saved state goes on beyond
 * the limit as if there had been none.
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

/* Creates a stepper at (t0, x, v) (nx, nv numbers, copied) with step h != 0 (negative: backward). The machine's problem
 * must outlive it. */
motus_status stepper_create(const machine *, const chosen *, double t0, double h, const double *x, const double *v,
                            const motus_allocator *, stepper **, motus_error *);
void stepper_destroy(stepper *);
/* Begins a new leg at another state and time, with step h; the counters go on. Forgets derivatives that were
 * computed. */
motus_status stepper_start(stepper *, double t0, double h, const double *x, const double *v, motus_error *);

/* Begins a new leg as stepper_start does; where steps adapt, the first candidate has size h, and the state belongs to
 * time t0 + lost. */
motus_status stepper_jump(stepper *, double t0, double lost, double h, const double *x, const double *v, motus_error *);

/* At the start of a leg on which the force has one formula up to a time: takes into account from the first step on that
 * times are rounded, if by that a tolerance would let steps crawl. */
void stepper_expect_blur(stepper *, double until);

/* Begins a new leg after an action as stepper_jump does, and keeps what reversible adaptive steps know of the lengths
 * of the motion (step/density.h). */
motus_status stepper_go_on(stepper *, double t0, double lost, double h, const double *x, const double *v,
                           motus_error *);

/* Begins a new leg as stepper_jump does. If the marked last step of `along`, a stepper with this machine and method,
 * began at this state, what that step computed there is not computed again. along: may be NULL. */
motus_status stepper_branch(stepper *, const stepper *along, double t0, double lost, double h, const double *x,
                            const double *v, motus_error *);

/* Begins a new leg at the present state, taken as that of time t, with step h, which is the first where steps adapt.
 * Where additions are compensated, the known rounding errors of the state are kept. */
motus_status stepper_turn(stepper *, double t, double h, motus_error *);
/* For rows that choose their order, used with a tolerance that allows any error: gives the next steps the order of the
 * last step of `like`. */
void stepper_follow(stepper *, const stepper *like);

/* How far to go: `steps` steps, or up to a time (NaN: no limit), whichever comes first. */
typedef struct stepper_limit {
    int64_t steps;
    double until;
} stepper_limit;
/* Why an advance stopped. */
typedef enum stepper_stop {
    STOP_STEPS,
    STOP_UNTIL,
    STOP_EVENT, /* core/events.h */
    STOP_HALT,  /* an inspector or a witness asked for it, perhaps before the limit */
    STOP_FAILED
} stepper_stop;

/* The number of whole steps of size h from t0 to `until`, and the size of a shorter last step; 0: there is none, as
 * where only a few roundings of the quotient are left. */
typedef struct stepper_way {
    int64_t whole;
    double last;
} stepper_way;
stepper_way stepper_way_of(double t0, double h, double until);

/* Takes steps up to the limit; the last one is shorter if the limit lies between two steps. DIVERGED, SOLVE and
 * CALLBACK give the time and the variable; the stepper then stands at the last good step. why may be NULL. */
motus_status stepper_advance(stepper *, stepper_limit, stepper_stop *why, motus_error *);
/* Takes one step towards `until`, with the bits of stepper_advance, and reports its events. */
motus_status stepper_trace(stepper *, double until, const tracer *, motus_error *);
/* Writes the state at the present time, with synchronised velocities: nx and nv numbers, and nv of the acceleration
 * there. a may be NULL. */
motus_status stepper_sync(stepper *, double *x, double *v, double *a, motus_error *);

/* Goes on with another machine of the problem, without a change of bits or counters. The stepper must stand at the end
 * of a step that was not a shorter last step. After a failure it stands as before. */
motus_status stepper_move(stepper **, const machine *, motus_error *);

/* Returns the largest tolerance that changes the method's steps: reversible adaptive steps are at most a part of the
 * time scale of the motion, whatever the tolerance. INFINITY for other methods. */
double stepper_tolerance_most(const chosen *);

enum { STEPPER_PACE = 1 << 16 };
/* Tells whether a run with adaptive steps may crawl after `steps` steps: the last STEPPER_PACE of them led `gone` on,
 * too little beside the way left to the end and beside the longest step so far. */
bool stepper_may_crawl(int64_t steps, double gone, double left, double longest, bool smooth);
/* Decides whether a run that may crawl ends, after `steps` steps from t - gone to t; a status other than MOTUS_OK ends
 * it. The number of steps alone decides when it is asked, so all machines ask at the same steps. */
typedef motus_status (*stepper_judge)(void *ctx, stepper *, int64_t steps, double gone, motus_error *);
/* Returns the status of a run that crawls, with its message. */
motus_status stepper_crawls(const stepper *, int64_t steps, double gone, motus_error *);
void stepper_judged(stepper *, stepper_judge, void *ctx);
/* What an inspector says of a marked step that it is shown. Only methods of which stepper_refuses is true repeat a
 * step. */
typedef struct stepper_verdict {
    double again; /* the signed size of a candidate with which the step is repeated; 0: the step stands */
    int64_t rest; /* how many steps are taken before the next one is shown */
    bool halt;    /* the advance ends here */
} stepper_verdict;
typedef stepper_verdict (*stepper_inspector)(void *ctx, stepper *);
void stepper_inspected(stepper *, stepper_inspector, void *ctx);
/* Tells whether the method's steps can be refused: they adapt by their errors. */
bool stepper_refuses(const chosen *);
const chosen *stepper_method(const stepper *);
const problem *stepper_problem(const stepper *);
double stepper_limit_of(const stepper *); /* the `until` of the latest advance */
/* Writes the oldest state of the leg that is kept, some steps before the present one, without changing the motion.
 * False: there is none. */
bool stepper_earlier(stepper *, double *t, double *x, double *v);

double stepper_time(const stepper *);
double stepper_lost(const stepper *);               /* what the rounding of stepper_time has left out */
double stepper_time_of(const stepper *, int64_t n); /* of step n of the leg; NaN where steps adapt */
double stepper_step(const stepper *);               /* size of the present leg's steps, with its sign */
double stepper_next(const stepper *);               /* size of the next step, with its sign, unless it is cut */
double stepper_last_step(const stepper *);          /* size of the latest step, with its sign */
/* Tells the shortest and the longest step of the leg, without one that was cut short at its end; NaN: no step yet. */
void stepper_sizes(const stepper *, double *shortest, double *longest);
int64_t stepper_refused(const stepper *);
int64_t stepper_steps(const stepper *);       /* finished in this leg, a shorter last one included */
int64_t stepper_evaluations(const stepper *); /* by the method itself; observing is not counted */
int64_t stepper_iterations(const stepper *);

/* Keeps the present state as the left end of the next step, for dense output. */
motus_status stepper_mark(stepper *, motus_error *);
/* Returns the time of the mark, and tells what its rounding has left out, and the state there. */
double stepper_marked(const stepper *, double *lost, const double **x, const double **v);
/* Writes the state at a time within the last step, by dense output. Without a mark it first repeats the last step, from
 * the last snapshot, to the same bits. */
motus_status stepper_sample(stepper *, double t, double *x, double *v, motus_error *);
/* Bounds the size of every acceleration within the marked last step, nv numbers. Where the bound comes from stages
 * (step/swing.h), it holds if the stages show the motion. False: none is known. */
bool stepper_swing(stepper *, double *most);

/* Watching: stepper_watch takes steps until something may have happened in one. `quiet` is shown each step and says
 * whether nothing happened in it; a compiled loop asks the bounds of the model's own rules first, and `quiet` only
 * where these leave something open. */
typedef struct stepper_shown {
    double span, from_t, to_t, *from_x, *from_v, *to_x, *to_v;
    const double *most;
} stepper_shown;
typedef struct stepper_watcher {
    bool (*quiet)(void *ctx, const stepper_shown *);
    void *ctx;
    double *largest;                /* raised to the sizes of x, then v, at the start of every step */
    double *middle, *width, *least; /* room for a box, x and then v (step/box.h), and for a bound of each function */
    size_t functions;
} stepper_watcher;
/* Where the last watched step began, even if it failed. */
typedef struct stepper_left {
    int64_t steps; /* watched steps before it, in which nothing happened */
    double t, lost;
    const double *x, *v; /* NULL: no step was begun */
    bool shown;          /* the step was shown to `quiet` */
} stepper_left;
/* Tells whether stepper_watch can be called: the row can be watched (row_watched), or its fixed steps can by their ends
 * and are those of a small system, whose single steps a compiled model does not take faster; and the leg may take
 * steps. */
enum { STEPPER_WATCHED_MOST = 16 };
bool stepper_can_watch(const stepper *);
/* Tells whether the next steps have bounds on their accelerations: lanes watch fixed steps too, after the first step of
 * a leg. */
bool stepper_bounded(const stepper *);
/* Takes steps up to the limit, or until `quiet` says no, to the state that single steps would lead to. The last step is
 * marked. */
motus_status stepper_watch(stepper *, stepper_limit, const stepper_watcher *, stepper_left *, stepper_stop *why,
                           motus_error *);
/* Returns how many steps lead to the last time that is not after t; 0 where the stepper is there already, or where step
 * sizes are not known beforehand. */
int64_t stepper_steps_before(const stepper *, double t);

/* A saved state is `stepper_carry` numbers and the counters: all that the next step of the leg needs, so a stepper that
 * was created in the same way goes on from it to the same bits. Where steps adapt, the last STEPPER_CLOCKS numbers are
 * t, its rounding error, and what error control carries. After a shorter last step, the state before it is saved. */
enum { STEPPER_CLOCKS = 8 };
typedef struct stepper_count {
    int64_t steps, evaluations, iterations, refused;
} stepper_count;
size_t stepper_carry(const stepper *);
stepper_count stepper_save(const stepper *, double *carry);
double stepper_time_saved(const stepper *, stepper_count, const double *carry); /* the time of a saved state */
motus_status stepper_load(stepper *, stepper_count, const double *carry, motus_error *);
/* Loads a saved state of a leg that began at t0 with step h. */
motus_status stepper_load_leg(stepper *, double t0, double h, stepper_count, const double *carry, motus_error *);
double stepper_leg(const stepper *); /* the time at which the present leg began */
/* Writes the state at which the present leg began. False: it is not known. */
bool stepper_origin(const stepper *, double *x, double *v);

/* Gives a stepper another body before its first step, for tests that all bodies compute the same bits. */
void stepper_use_body(stepper *, const stepper_body *);

#endif
