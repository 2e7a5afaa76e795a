/* Follows rules (core/rules.h) along the motion of a stepper: finds every event of each step, takes true steps that end
 * on events, and does what the rules say.
 *
 * Dense output finds and counts events: on each step a function is a polynomial, of which all roots and touches are
 * known (core/roots.h). The time and state of an event come from a step of the method that begins where the step began
 * and ends on the event, so interpolation does not lower the order. A rule that does not assign changes no bit of the
 * motion: another stepper takes the steps to its events.
 *
 * The side of a function is the sign that it had when it was last away from 0. It passes 0 where it moves to the other
 * side. After an event it stands at 0: that root is divided out, so the next root is found however near it is, and no
 * state need be moved away from it.
 */
#ifndef CORE_EVENTS_H
#define CORE_EVENTS_H

#include "core/rules.h"
#include "core/stepper.h"

enum {
    EVENTS_AT_ONCE = 100,      /* most actions in one instant; beyond: MOTUS_EVENTS */
    EVENTS_IN_STEP = 1 << 13,  /* most roots of a function in one step; beyond: an error */
    EVENTS_ROWS_MOST = 1 << 26 /* most rows of the table */
};

typedef struct events events;

/* One row of the table: an event of a rule that records. */
typedef struct event {
    size_t rule, instance;
    int64_t count; /* events of this rule so far, with this one */
    double t;
    double lasting; /* events_lasting at t */
    double
        doubt; /* how far off the time may be because the function is flat there; 0: it is not flat, or nobody asks */
    bool touched; /* the function touched 0 and went back */
    bool changed; /* the rule assigns, so there is a state after the event too */
} event;

/* What ended the run before its time. */
typedef enum events_end { EVENTS_END_NONE, EVENTS_END_STOP, EVENTS_END_ACCUMULATED } events_end;

/* Where the events of a rule accumulate: the limit of their times, and how far it may be off. */
typedef struct events_limit {
    size_t rule, instance;
    double t, error;
    double lasting; /* events_lasting at the latest event */
} events_limit;

/* Makes the events for a stepper with this machine and this method. The rules and the machine's problem must outlive
 * them. */
motus_status events_create(const rules *, const machine *, const chosen *, const motus_allocator *, events **,
                           motus_error *);
void events_destroy(events *);

/* Makes events that have not begun, with the rules, the machine and the method of these. */
motus_status events_again(const events *, events **, motus_error *);

/* Begins at the state of a stepper that has taken no step, whose leg leads towards `until`. A function that is 0 there,
 * or a condition that already holds, is not an event. */
motus_status events_begin(events *, stepper *, double until, motus_error *);
/* Forgets what has happened; events_begin must follow. */
void events_forget(events *);
/* Takes one step with all that happens in it; with fixed steps, to the next time of their grid. Takes up to `most`
 * steps while bounds prove that nothing happens in them; events_steps tells how many. *why is STOP_EVENT where a rule
 * ended the run or events accumulated. */
motus_status events_go(events *, stepper *, double until, int64_t most, stepper_stop *why, motus_error *);

/* Tell whether bounds may prove that nothing happens in the next steps: in steps that the stepper itself watches
 * (stepper_can_watch), or that another loop takes, which may be fixed steps (stepper_bounded). */
bool events_watchable(const events *, const stepper *);
bool events_bounded(const events *, const stepper *);
/* Returns the time of the next tick of any clock; infinite where there is none. */
double events_next_time(const events *);
/* Tells whether nothing has happened in a step for which cheaper bounds did not prove it. */
bool events_idle(events *, const stepper_shown *);
/* Notes that another loop has led the stepper on by `steps` steps, in which nothing happened. largest: bounds on the
 * sizes of x, then v, at the starts of these steps. */
motus_status events_led(events *, stepper *, int64_t steps, const double *largest, motus_error *);

/* Lets `asks`, which is called now and then between the events of a step, cancel the step. If it returns nonzero, the
 * step ends at the latest event, and the call returns MOTUS_CANCELLED without a message. NULL: nobody cancels. */
void events_listen(events *, int (*asks)(const void *ctx), const void *ctx);
/* Tells whether a fixed step was cancelled on its way; it cannot be saved before another step has led to its end. */
bool events_partway(const events *);

/* Moves the numbers of the state, x and then v, by about their rounding, after every action, so that a companion has
 * other roundings at events than the run. salt: differs from event to event. switched: no action has computed these
 * numbers: a switch of the force changed its side, and the motion goes on. */
typedef void (*events_jogger)(double *y, size_t count, uint32_t salt, bool switched);
void events_jog(events *, events_jogger);
/* Says whether rows are to have their `doubt`, which bars of error need; it costs many evaluations for every event. */
void events_doubted(events *, bool);
/* A witness is shown every step that is not watched, with its mark. until: the time up to which the step counts: that
 * of an action, or the step's end. True: the advance ends here, with STOP_HALT. */
typedef bool (*events_witness)(void *ctx, stepper *, double until);
void events_witnessed(events *, events_witness, void *ctx);
/* Begins the grid of fixed steps where the stepper stands, because it has begun a leg there (stepper_turn). */
void events_turn(events *, const stepper *);
/* Goes on from the stepper's state, which the caller has moved a little without changing the time. */
motus_status events_shift(events *, stepper *, motus_error *);

/* Returns one unit in the last place of a time, whatever its sign. */
double events_ulp(double t);

events_end events_ended(const events *, size_t *rule);
/* Tells the limit where events have accumulated. False: the events of no rule have. */
bool events_accumulated(const events *, events_limit *);
/* Tells how long after the latest action the events of its rule seem to accumulate; 0: they do not. */
double events_tail(const events *);
/* Tells how far the state at the limit of events, x and then v, may be from the true limit. */
const double *events_limit_off(const events *);
/* Counts the steps since events_begin in which an event may have been missed because it is narrow beside the step: no
 * bound has confirmed what dense output shows at its points. Tells the start of the first such step, and a rule of
 * which that is true. */
int64_t events_unseen(const events *, size_t *rule, double *t);
/* Counts the rules that have not happened because their condition has held from the start on, and tells the first. */
size_t events_held(const events *, size_t *rule);
int64_t events_steps(const events *); /* since events_begin */
size_t events_rule_of(const events *, size_t function);
double events_latest(const events *);        /* time of the latest action; NaN: there was none */
bool events_ticks(const events *, double t); /* whether t is a tick of a clock */
/* Tells whether a function that is near 0 at the run's state leaves no doubt about its events: it has been 0 from the
 * start on, has come to rest at 0, or is 0 in the instant in which an event has ended the run. */
bool events_settled(const events *, size_t function);
/* Notes how far the numbers of the state, x and then v, may be off from now on. From then on extrema are kept whose
 * sign this may hide; earlier ones are forgotten. False: no memory. */
bool events_near(events *, const double *off);
/* Returns the error of number k that events_near got last; 0: it got none. */
double events_off(const events *, size_t k);
size_t events_extrema(const events *);
/* The end of a step, which need not be an extremum; an extremum; a function that comes to 0 as the motion comes to
 * rest. */
typedef enum events_near_kind { EVENTS_NEAR_END, EVENTS_NEAR_EXTREMUM, EVENTS_NEAR_REST } events_near_kind;
/* Returns the function of extremum k, and tells its kind, time and state. */
size_t events_extremum(const events *, size_t k, events_near_kind *, double *t, const double **x, const double **v);
/* Tells the time from which on there was no room for the extrema of a rule's functions; NaN: all have been kept. */
double events_unkept(const events *, size_t rule);
int64_t events_acted(const events *); /* how often a rule has assigned */
/* Tells how often a rule has assigned before t, a time within the last step. */
int64_t events_acted_before(const events *, double t);
int64_t events_turns(const events *); /* how often an internal rule has assigned */
/* Sums up the times from every action, and from the end of every flight between two switches, to t. */
double events_lasting(const events *, double t);
/* Returns the time between the latest two instants with an action; INFINITY: there are no two. */
double events_interval(const events *);
size_t events_rows(const events *);
/* Returns row k. x and v, where not NULL, get the state on arrival or, with `after`, the state that the action left. */
event events_row(const events *, size_t k, bool after, const double **x, const double **v);
/* Computes the state at a time within the last step; with fixed steps, within the last step of the grid. Before an
 * action it takes true steps, else it takes the stepper's dense output. */
motus_status events_sample(events *, stepper *, double t, double *x, double *v, motus_error *);
/* Tells whether events_sample gives the state of t itself, without the rounding of t and of the step's start. */
bool events_sampled_exactly(const events *, double t);
/* Says whether the states around the actions of all rules are kept from now on. Forgets those kept before. */
void events_keep_jumps(events *, bool keep);
size_t events_jumps(const events *);
/* Tells the time of kept action k, and the state, x and then v, before and after it. True: the motion or a rule depends
 * on what it changed. */
bool events_jump(const events *, size_t k, double *t, const double **before, const double **after);
/* Goes on with another machine of the problem. */
void events_move(events *, const machine *);
/* Writes into x the kept numbers as they were at time t, which is within the last step or later. */
void events_keep(const events *, double t, double *x);

/* Prepares for saving: with fixed steps, the state before the last step is kept. */
void events_may_save(events *);
/* Returns how many numbers of a restart state belong to events, the table included, and writes them where `out` is not
 * NULL. They may be NaN or infinite. */
size_t events_save(events *, const stepper *, double *out);
/* Saves the stepper, as stepper_save does, at the instant of events_save: before the last step, where events_may_save
 * has kept that state. */
stepper_count events_save_stepper(const events *, const stepper *, double *carry);
/* Returns the time of the instant that events_save and events_save_stepper save. */
double events_saved_time(const events *, const stepper *);
/* The leg with which events go on, and the stepper's part of the restart state. */
typedef struct events_leg {
    double start, step, until;
    stepper_count then;
    const double *carry;
} events_leg;
/* Loads the numbers of a restart state into events that have not begun. The stepper, which may be NULL, is the one that
 * will go on with them. MOTUS_STATE: events_save has not written these numbers for such events, which can then only be
 * destroyed. */
motus_status events_load(events *, const stepper *, const events_leg *, const double *, size_t count, motus_error *);
/* Loads the stepper, after events_load. After a failure the stepper is unchanged. */
motus_status events_load_stepper(const events *, stepper *, const events_leg *, motus_error *);
double events_time(const events *); /* of the state from which the next step begins */

#endif
