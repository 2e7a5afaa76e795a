/* Follows rules (core/rules.h) around a stepper: finds every event of each step, takes true steps that end on events,
 * and does what the rules say.
 *
 * Dense output finds and counts: on each step a function is a polynomial, of which all roots and touches are known
 * (core/roots.h). Time and state of an event are those of a step of the method that begins where the step began and
 * ends on the event, so no interpolant lowers the order. A rule that does not assign leaves the motion as it is, bit
 * by bit: its steps are taken by another stepper.
 *
 * A function has a side: the sign that it had when it was last away from 0. It passes 0 where it moves to the other
 * side. After an event it stands at 0: that root is divided out, so the next one is found however near it is, and no
 * state is moved away from it.
 */
#ifndef CORE_EVENTS_H
#define CORE_EVENTS_H

#include "core/rules.h"
#include "core/stepper.h"

enum {
    EVENTS_AT_ONCE = 100,      /* actions in one instant, more are an error: MOTUS_EVENTS */
    EVENTS_IN_STEP = 1 << 13,  /* roots of a function in one step, more are an error */
    EVENTS_ROWS_MOST = 1 << 26 /* of the table */
};

typedef struct events events;

/* One row of the table: an event of a rule that records. */
typedef struct event {
    size_t rule, instance;
    int64_t count; /* events of this rule so far, this one included */
    double t;
    double lasting; /* the sum of the times since the actions before it, of all rules, and since turns of switches */
    double doubt;   /* how far off the time may be, because the function is flat there; 0: it is not */
    bool touched;   /* the function touched 0 and went back */
    bool changed;   /* the rule assigns: there is a state after it too */
} event;

/* What ended the run before its time. */
typedef enum events_end { EVENTS_END_NONE, EVENTS_END_STOP, EVENTS_END_ACCUMULATED } events_end;

/* Where the events of a rule accumulate: the limit of their times, and how far it may be off. */
typedef struct events_limit {
    size_t rule, instance;
    double t, error;
    double lasting; /* as in a row */
} events_limit;

/* Of a stepper on this machine by this method. The rules and the machine's problem must outlive it. */
motus_status events_create(const rules *, const machine *, const chosen *, const motus_allocator *, events **,
                           motus_error *);
void events_destroy(events *);

/* Others of the same rules, on the same machine, that have not begun. */
motus_status events_again(const events *, events **, motus_error *);

/* Begins at the state of a stepper that has taken no step, whose leg goes towards `until`. What holds there is no
 * event. */
motus_status events_begin(events *, stepper *, double until, motus_error *);
/* Forgets what has happened; events_begin must follow. */
void events_forget(events *);
/* Takes one step, of fixed steps to the next time of their grid, with all that happens in it. *why: STOP_EVENT where a
 * rule ended the run, or events accumulated. */
motus_status events_step(events *, stepper *, double until, stepper_stop *why, motus_error *);
/* The same, and up to `most` steps at once while bounds tell that nothing happens in them: events_steps says how many.
 */
motus_status events_go(events *, stepper *, double until, int64_t most, stepper_stop *why, motus_error *);

/* Steps that others take. Whether bounds alone may tell of the next steps of the stepper; whether nothing has happened
 * in such a step, of which other bounds leave something open; and that so many have been taken, at whose starts no
 * number was larger than `largest`, x and then v, up to where the stepper has been led. */
bool events_watchable(const events *, const stepper *);
/* The same where another watches steps, of one size too (stepper_bounded), and the time of the next tick of a clock,
 * infinite where there is none. */
bool events_bounded(const events *, const stepper *);
double events_next_time(const events *);
bool events_idle(events *, const stepper_shown *);
motus_status events_led(events *, stepper *, int64_t steps, const double *largest, motus_error *);

/* Where a step has many events, `asks` is asked on the way; other than 0: the step ends at the latest of them, and the
 * call with MOTUS_CANCELLED, without a message. It is asked for as long as it is not replaced; NULL: nobody cancels. */
void events_listen(events *, int (*asks)(const void *ctx), const void *ctx);
/* A fixed step has been cancelled on its way, and cannot be saved before another step has led to its end. */
bool events_partway(const events *);

/* After every action `jog` moves the numbers of the state, x and then v, by about their rounding; salt: of the event.
 * `switched`: no action has computed them, a switch of the force has let the motion go on. So a companion meets other
 * roundings at events than the run. */
typedef void (*events_jogger)(double *y, size_t count, uint32_t salt, bool switched);
void events_jog(events *, events_jogger);
/* Shown every step that is not watched, marked, and the time up to which it counts: an action that is to follow may be
 * before its end. Whether the advance ends here, with STOP_HALT. */
typedef bool (*events_witness)(void *ctx, stepper *, double until);
void events_witnessed(events *, events_witness, void *ctx);
/* The stepper has begun a new leg where it stands (stepper_turn): the grid of fixed steps begins there. */
void events_turn(events *, const stepper *);
/* The stepper was put into another state near by, at the same time. */
motus_status events_shift(events *, stepper *, motus_error *);

/* One unit in the last place of a time, whatever its sign. */
double events_ulp(double t);

events_end events_ended(const events *, size_t *rule);
/* False: the events of no rule have accumulated. */
bool events_accumulated(const events *, events_limit *);
/* How long after the latest action the events of its rule seem to accumulate; 0: they do not. */
double events_tail(const events *);
/* Where they did: how far the state at the limit, x and then v, may be from that to which they lead. */
const double *events_limit_off(const events *);
/* In how many steps since events_begin an event may have been missed because it is narrow beside the step: what the
 * points of dense output tell, no bound has confirmed. The rule, and the start of the first of these steps. */
int64_t events_unseen(const events *, size_t *rule, double *t);
int64_t events_steps(const events *); /* since events_begin */
size_t events_rule_of(const events *, size_t function);
double events_latest(const events *);        /* time of the latest action; NaN: there was none */
bool events_ticks(const events *, double t); /* whether that is a time of a clock */
/* Whether a function that is near 0 at the run's state leaves no event open: it has been 0 from the start on or has
 * come to rest at 0, or is 0 in the very instant in which an event has ended the run. */
bool events_settled(const events *, size_t function);
/* From now on the numbers of the state, x and then v, are off by so much: extrema of functions that come so near to 0
 * are kept, and those of before are forgotten. False: no memory. */
bool events_near(events *, const double *off);
/* By how much number k was told to be off last; 0: it was not told. */
double events_off(const events *, size_t k);
size_t events_extrema(const events *);
/* The end of a step, which may be no extremum; an extremum; where the motion comes to rest, and the function to 0. */
typedef enum events_near_kind { EVENTS_NEAR_END, EVENTS_NEAR_EXTREMUM, EVENTS_NEAR_REST } events_near_kind;
/* Its function, its kind, the time and the state. */
size_t events_extremum(const events *, size_t k, events_near_kind *, double *t, const double **x, const double **v);
/* Since when they had no room, of functions of a rule; NaN: all have been kept. */
double events_unkept(const events *, size_t rule);
int64_t events_acted(const events *);                  /* how often a rule has assigned */
int64_t events_acted_before(const events *, double t); /* and before a time within the last step */
int64_t events_turns(const events *);                  /* how often an internal rule has */
double events_lasting(const events *, double t);       /* the sum of the times since they did, or flights ended */
double events_interval(const events *); /* between the latest two instants at which one did; INFINITY: there are none */
size_t events_rows(const events *);
/* Row k; x and v, where not NULL: the state on arrival, or where `after` that which the action left. */
event events_row(const events *, size_t k, bool after, const double **x, const double **v);
/* The state at a time within the last step, of fixed steps within the last step of the grid; before an action by true
 * steps, else by dense output of the stepper. */
motus_status events_sample(events *, stepper *, double t, double *x, double *v, motus_error *);
/* Whether that is the state of t itself, not of what t and the start of the step have lost to rounding. */
bool events_sampled_exactly(const events *, double t);
/* Whether from now on what actions change is kept, of every rule; either forgets what was kept before. */
void events_keep_jumps(events *, bool keep);
size_t events_jumps(const events *);
/* Action k: its time, and the state, x and then v, before and after it. True: the motion or a rule depends on it. */
bool events_jump(const events *, size_t k, double *t, const double **before, const double **after);
/* Goes on by another machine of the same problem. */
void events_move(events *, const machine *);
/* Writes the kept numbers as they were at time t, which is within the last step or later, into a state. */
void events_keep(const events *, double t, double *x);

/* They may be saved: of fixed steps they keep the state before the last one. */
void events_may_save(events *);
/* What a restart state has of events, the table included: events_save tells how many numbers, and where `out` is not
 * NULL writes them. They may be NaN or infinite. events_save_stepper: as stepper_save, for the same instant, whose time
 * events_saved_time tells. That is before the last step where the events keep it. */
size_t events_save(events *, const stepper *, double *out);
stepper_count events_save_stepper(const events *, const stepper *, double *carry);
double events_saved_time(const events *, const stepper *);
/* The leg that events go on with, and what the state has of its stepper. */
typedef struct events_leg {
    double start, step, until;
    stepper_count then;
    const double *carry;
} events_leg;
/* Loads the numbers into events that have not begun; the stepper, which may be NULL, is the one that will go on with
 * them. MOTUS_STATE: they are not what events_save wrote of such events, which can then be destroyed alone. */
motus_status events_load(events *, const stepper *, const events_leg *, const double *, size_t count, motus_error *);
/* And then loads the stepper. After a failure it is unchanged. */
motus_status events_load_stepper(const events *, stepper *, const events_leg *, motus_error *);
double events_time(const events *); /* of the state from which the next step begins */

#endif
