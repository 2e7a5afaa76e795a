/* What the files of events share: the struct, and what each file does with it.
 *
 * Each file uses only those above it on this list. events_at.c: functions at an instant, and true steps to it.
 * events_table.c: rows, kept numbers, accumulation. events_candidates.c: what may happen in a step, and its order.
 * events_errors.c: error bounds of functions and of the times of events. events_jump.c: functions that jump or have a
 * kink. events_place.c: roots placed by true steps. events_near.c: extrema near 0. events_narrow.c: roots between the
 * samples of dense output. events_watch.c: steps in which bounds prove that nothing happens. events_find.c: the roots
 * of a step, by dense output. events_swarm.c: switches that accumulate. events_growth.c: actions without end.
 * events_fire.c: what happens in one instant. events_state.c: restart states. events.c: life and steps.
 *
 * A true step is a step of the method itself from `left` to a time within the step; dense output interpolates.
 * Invariant: `left` is the state at which the present step began, and `side` are the sides of all functions there,
 * those of the events that have happened since included.
 */
#ifndef CORE_EVENTS_PARTS_H
#define CORE_EVENTS_PARTS_H

#include "core/events.h"
#include "core/roots.h"

/* The error of dense output is far below this part of a function's largest value on the step. Where a function comes
 * nearer to 0, true steps decide what happens; a larger slack costs time and changes no result. */
#define EVENTS_SLACK 0x1p-13

/* A state of the trajectory, and the functions there. */
typedef struct instant {
    double t, lost; /* the state belongs to time t + lost; `lost` is the rounding of t, as stepper_lost tells it */
    double *x, *v, *a;
    double *g, *rate, *bound; /* the functions, their rates, and bounds on the rounding errors of g */
    bool valued; /* g is known; at the ends of a step it is computed only where something may happen in the step */
} instant;

typedef enum candidate_kind { CANDIDATE_FALLS = -1, CANDIDATE_TOUCHES, CANDIDATE_RISES, CANDIDATE_TIME } candidate_kind;

/* What may happen within the present step. */
typedef struct candidate {
    candidate_kind kind; /* where `near`: the side of 0 on which the function is */
    size_t of;           /* number of the function; of CANDIDATE_TIME: of the rule */
    double at;           /* time since `left`, by true steps where `located`, else by dense output */
    double low, high;    /* times since `left` between which the function has no other root */
    bool located, gone;
    bool followed; /* of a candidate that is gone: it happened; false: nothing was there */
    bool idle;     /* the function changes its side, and nothing happens */
    bool sure;     /* the signs at `low` and `high` differ, and the values there far exceed the error of dense output */
    bool near; /* an extremum near 0: true steps decide whether the function touches 0, crosses it twice or neither */
    bool sampled; /* it was found between samples: events_jump.c */
    bool guessed; /* `at` follows from the values and slopes at the ends of the step alone */
    bool leaves;  /* where `sampled`: the function was 0 before it */
    bool jumps;   /* not a root: the function jumps to the side `kind`; of CANDIDATE_TOUCHES: it comes to 0 and stays */
} candidate;

/* A part of the step that is too short to be divided, in which no polynomial fits the function; and samples there. */
typedef struct events_cell {
    size_t of;                  /* number of the function */
    int count;                  /* number of samples */
    double from;                /* the time since `left` at which the part begins */
    const double *time, *value; /* times since `left`, ascending along the run, and the values there */
    double bound;               /* values up to this size count as 0 */
    bool last;                  /* the run ends at the end of the part */
} events_cell;

/* The kept numbers from time t on: kept[at * rules.kept_count] and those that follow. */
typedef struct kept_state {
    double t;
    size_t at;
} kept_state;

/* The latest times of one instance of a rule, the last one first. Level k has the latest RECENT events whose numbers
 * are multiples of 2^k, since the relative rounding error of long intervals is small. A rule with more than
 * LEVELS_INSTANCES instances has level 0 alone. */
enum { RECENT = 4, LEVELS = 12, LEVELS_INSTANCES = 256 };
typedef struct recent {
    double *t;
    int64_t number; /* of the latest event */
} recent;
static inline int recent_levels(const rule *r) { return r->instances <= LEVELS_INSTANCES ? LEVELS : 1; }
static inline int recent_count(const recent *r, int level)
{
    return r->number >> level < RECENT ? (int)(r->number >> level) : RECENT;
}

/* The latest turns of one switch of the force, and how the cycles from turn to turn shorten (events_swarm.c). */
enum { SWARMS = 8 };
typedef struct swarm_mark {
    double t, cycle;
} swarm_mark;
typedef struct swarm {
    size_t function;
    int count;       /* turns so far, at most 3; 0: this slot is free */
    int64_t shorter; /* how many cycles in a row were shorter than the one before */
    double t[2];     /* times of the latest two turns, the last one first */
    double cycle, longest;
    swarm_mark mark[2]; /* taken whenever cycles have become half as long as at the mark before */
    int marks;
    bool slows; /* cycles shorten more slowly since the last mark than before it */
    int parity; /* 0 or 1: which of the two states in swarm_state is that of the latest turn */
} swarm;

enum { GROWTH_MARKS = 6 }; /* marks after 2^k actions that are kept: events_growth.c */

struct events {
    rules rules;
    problem problem;
    machine machine;
    chosen method;
    motus_allocator allocator;
    stepper *probe;
    double start, until, way;     /* way: 1 forward, -1 backward */
    double grid_start, grid_step; /* fixed steps end at grid_start + n * grid_step */
    int64_t steps;                /* steps of the leg */
    bool broken;                  /* `left` lies within a fixed step, which the next steps lead to its end */
    int (*asks)(const void *ctx); /* see events_listen; NULL: nobody cancels */
    const void *asks_ctx;
    int64_t asked;          /* how often it was time to call `asks`, which is done at every 16th of them */
    bool cancelled, halted; /* the present step is */
    bool first;             /* no step has been taken since the start */
    bool marked;            /* the bounds at both ends of the step are known */
    events_end end;
    size_t end_rule;

    instant left, right, here, next;
    instant best;         /* where the function was nearest to 0 while a root was sought */
    const stepper *along; /* whose step leads from `left` to `right`; NULL between steps */
    /* where each piece of the present step that ended in an action began: t, lost, `acted`, x, v */
    double *past;
    size_t pasts, past_room;
    double past_end;    /* where the last of these pieces ended */
    int64_t acted_left; /* `acted` when the present piece began */
    /* an entry for each function: */
    int8_t *side;    /* -1, 1, 0: not known, since the function has been 0 from the start on */
    uint8_t *stands; /* it is 0 at `left` */
    uint8_t *open;   /* it is near 0 at `left`, and the next step decides whether it passes or touches 0 */
    int8_t *heads;   /* where it stands at 0: the sign of its slope along the run, 0: not known */
    uint8_t *was;    /* side, stands, open and heads before the present step */
    double here_at;  /* the time from `left` to `here` */
    double whole;    /* the step's size before it was shortened to show how a function leaves 0; 0: it was not */
    double span;     /* from `left` to `right` */
    int shorter;     /* how often the present step may still be repeated, shorter, to resolve an internal function */
    bool hidden;     /* the step is so long that rounding hides how a function leaves 0 at its start */
    uint8_t *zero;   /* for each function: it is 0 at `here` */
    uint8_t *level;  /* for each function: it stays at 0 after this instant, because its slope is 0 but for rounding */
    bool doubted;    /* rows are to have their doubt */
    double doubt;    /* an error bound of the time of this instant: events_doubt */
    double blurred;  /* the time within which rounding of the state hides the root of a function that is not flat */
    bool awaits;     /* a switch of the force is to turn in this instant */
    /* an entry for each function: */
    uint8_t *touched; /* what has happened to it in this instant: events_fire.c */
    uint8_t *arrives; /* a turn has led it to 0 in this instant, where the motion rests: candidate_kind + 2; else 0 */
    uint8_t *look;    /* the bounds do not exclude a root, so dense output is searched for roots */
    uint8_t *passed;  /* it has passed 0 in watched steps without an event; `side` does not know of it yet */
    int8_t *sign;     /* working space: the signs of a condition's leaves */
    double *before;   /* its value at `here` before an action; while roots are sought, a lower bound on the step */
    bool boxed;       /* the present step's box is in `next` and `width`, its lower bounds are in `before` */
    int pause;        /* how many more steps are not watched, because watching was in vain */
    int last_pause;   /* how many steps the latest pause had */
    double *fired; /* for each function: when it last passed or touched 0; NaN: never, or an action has undone that */
    uint32_t *rule_of;
    double *most;   /* the largest size of positions, then velocities, since the start */
    int64_t taken;  /* steps since the start */
    int64_t pieces; /* how many more parts of steps may be examined for narrow events */
    int64_t unseen; /* steps in which `pieces` did not suffice; the time of the first, and a function there: */
    double unseen_at;
    size_t unseen_function;
    double *width; /* of positions, then velocities: half widths of the step's box, or error bounds (events_errors.c) */
    double *samples;   /* the values of all functions at the points of the step */
    double *arguments; /* the arguments of their operations at these points (core/rules.h) */
    int samples_room;
    bool clocks;          /* some rule is a clock */
    double leg_end;       /* where all steps end, of which `until` is a part of the way */
    bool stopped;         /* the last step ended where switches change at a time that is known beforehand */
    int64_t passed_times; /* how many of these have changed */
    bool lingers;         /* a function stands at 0 or is open, at the start of the step or at its end */
    bool partial;         /* the rules were asked at `here` with only a few of the functions evaluated there */
    bool in_parts;        /* the points resolve the function only on parts of the step */
    /* for each instance of a condition, numbered by `instances`: */
    uint8_t *held;     /* it was true */
    uint8_t *steady;   /* it was true up to this instant, in which it has not happened */
    double *happened;  /* when it last happened or was true, if it has not been false since; else NaN */
    size_t *instances; /* for each rule: the number of its first instance */
    recent *recent;    /* for each instance */
    double *recent_t;  /* the times of all `recent` */
    int64_t *count;    /* for each rule: its events */
    int64_t *ticks;    /* for each rule: how often it has ticked, if it is a clock */
    uint8_t *ticked;   /* for each rule: it is a clock and has ticked in this instant */
    candidate *candidate;
    size_t candidates, candidate_room;
    bool in_order;   /* candidates are in the order of their times, but for what locating them has moved */
    size_t next_one; /* where they are in order: all before this number are gone */

    double at_once;         /* the time of the latest action */
    int actions;            /* how many actions that instant had */
    events_jogger jog;      /* NULL: none */
    events_witness witness; /* NULL: none */
    void *witness_ctx;
    int64_t acted;       /* actions since the start */
    double acted_sum;    /* the sum of their times since the start */
    double turned_at;    /* the time of the latest action of an internal rule */
    int64_t flights;     /* single steps that led from one such action to the next */
    double flights_sum;  /* the sum of the times, since the start, at which they ended */
    int64_t turned_step; /* `steps` at the latest action of an internal rule */
    size_t turns;        /* actions of internal rules in the instant turned_at */
    swarm swarm[SWARMS];
    double *swarm_state; /* for each swarm the states after its latest two turns */
    double pace;         /* the longest step after a turn, so that it sees the turns to come */
    double interval;     /* between the latest two instants with an action */
    double shift;        /* in this step, the largest distance from a located time to that of dense output */

    event *row;
    double *row_state; /* for each row: the state on arrival, and the state after an action that changed it */
    size_t *row_at;    /* where the states of each row begin in row_state */
    size_t rows, row_room, numbers, number_room;
    double *off;      /* how far positions, then velocities, may be off (events_near.c); NULL: not known */
    double *extremum; /* for each extremum: its function, time, kind and state */
    size_t extrema, extremum_room;
    double *unkept; /* for each rule: the time from which extrema had no room; NaN: all have been kept */
    bool keeps_jumps;
    double *jump; /* for each action that is kept: time, 1 where the rule assigns, the states before and after it */
    size_t jumps, jump_room;
    double *kept;
    kept_state *kept_state;
    size_t kept_states, kept_room;
    double *after; /* the state after the latest event of `after_rule`, instance `after_instance` */
    size_t after_rule, after_instance;
    int growths;                   /* growth marks so far */
    double growth_t[GROWTH_MARKS]; /* the times of the latest marks */
    double *growth_most;           /* `most` at the latest marks */
    bool has_limit, limit_told;    /* events accumulate; a rule has answered to that */
    events_limit limit;
    double tail; /* the time from the latest event to the limit that events seem to have; 0: they have none */
    double limit_part, limit_part_error; /* the time to the limit in units of the latest interval; its error */
    double *limit_off;                   /* how far positions, then velocities, at the limit may be off by that error */

    /* With fixed steps: the state before the last step of a run, which its restart state takes in place of the present
     * one, so that a run to a later end takes whole steps; NULL before the last step. `saved_head` numbers are of the
     * events, the others of the stepper. */
    bool may_save;
    double *saved, saved_time;
    size_t saved_head, saved_rows;
    stepper_count saved_steps;
    double began; /* where the leg of a loaded stepper began */
};

/* events_at.c. Evaluates the rates and rounding bounds of all functions at an instant that has their values. */
motus_status events_judge(events *, instant *, motus_error *);
/* Evaluate the rates alone, for which the acceleration is computed first, or the bounds alone. */
motus_status events_rates(events *, instant *, motus_error *);
motus_status events_bounds(events *, instant *, motus_error *);
/* Evaluates all functions at the state of an instant. */
motus_status events_values(events *, instant *, motus_error *);
/* Evaluates all functions at both ends of the step, where that has not been done. */
motus_status events_value_ends(events *, motus_error *);
/* Fails where a function has lost its value in the step, which is behind, or has none at an instant, though it should
 * (rules.h). Overwrites `next`. */
motus_status events_keeps_values(events *, motus_error *);
motus_status events_has_values(events *, const instant *, motus_error *);
/* Evaluate one function, or its rate, bound, or both, where that costs less than all. The entries of other functions
 * then belong to another instant. */
motus_status events_value_of(events *, size_t function, instant *, motus_error *);
motus_status events_rate_of(events *, size_t function, instant *, motus_error *);
motus_status events_bound_of(events *, size_t function, instant *, motus_error *);
motus_status events_judge_of(events *, size_t function, instant *, motus_error *);
/* Returns MOTUS_CALLBACK, with the message that the callback for `which` returned `answer` at time t. */
motus_status events_refuse(const events *, const char *which, double t, int answer, motus_error *);
/* Tells the sign of a function's slope along the run at an instant; 0: the slope is too small to tell. */
int events_direction(const events *, const instant *, size_t function);
/* Copies time, state and functions, without rates and bounds. */
void events_copy(const events *, instant *to, const instant *from);
/* Returns the time h after `left`, kept within the step, which rounding of the times might leave. */
double events_place_in(const events *, double h);
/* Takes a step of size h from the state (x, v) of time `from` + `lost`; it ends at time *t + *rest. */
motus_status events_probe(events *, double from, double lost, const double *x, const double *v, double h, double *t,
                          double *rest, motus_error *);
/* Take a true step of size h from `left`, and evaluate all functions, or one function, at the state that it reaches. */
motus_status events_at(events *, double h, instant *, motus_error *);
motus_status events_at_of(events *, size_t function, double h, instant *, motus_error *);

/* events_table.c. Makes room for `more` items after `count` items. False: no memory. */
bool events_grow(const motus_allocator *, void **items, size_t count, size_t *room, size_t more, size_t size);
/* Adds a row to the table. False: no memory. */
bool events_note(events *, size_t rule, size_t instance, bool touched, const instant *);
/* Keeps the state before an action (`after`: the state after it), if jumps are kept. False: no memory. */
bool events_note_jump(events *, const rule *, const instant *, bool after);
/* Adds to the latest row the state after its action. False: no memory. */
bool events_note_after(events *, const instant *);
/* Writes the newest kept numbers into x. */
void events_overlay(const events *, double *x);
/* Keeps the kept numbers of x from time t on. False: no memory. */
bool events_keep_now(events *, double t, const double *x);
/* Forgets all kept numbers but the newest. */
void events_kept_forget(events *);
/* Counts an event of a rule that assigns. True: its events accumulate, at events.limit. */
bool events_accumulate(events *, size_t rule, size_t instance, double t);
/* Sets the limit of a rule whose events at t follow one another too fast to be distinguished: t, or as long after t as
 * the latest intervals let more events come. */
void events_end_here(events *, size_t rule, size_t instance, double t);
/* Notes that a rule answers to the limit. */
void events_limit_is_told(events *);
/* Keeps the state at `here` after an action, with which the next action of the rule is compared. */
void events_after(events *, size_t rule, size_t instance);
/* Moves `here` to the limit: its time, and the state to which the latest two states lead. */
void events_to_limit(events *);
motus_status events_no_memory(motus_error *);

/* events_candidates.c. Adds a candidate. False: no memory. */
bool events_add(events *, candidate);
/* Replaces a near candidate, whose extremum lies beyond 0, by the crossings before and after the time `at`. */
motus_status events_split(events *, size_t candidate, double at, motus_error *);
/* Places the candidates of a step well enough for their order to be known, and sorts them where they are many. */
motus_status events_order(events *, stepper *, motus_error *);
/* Returns the candidate that comes next. A candidate that is not located may come earlier by events_margin, so it is
 * returned first where that matters. NULL: there is none. */
candidate *events_earliest(events *);
/* Tells how far a candidate that is not located may be from its time by dense output. */
double events_margin(const events *);
/* Tells a range of candidates, from *first to before *end, with all whose times are within `far` of the time `at`. */
void events_about(const events *, double at, double far, size_t *first, size_t *end);

/* events_errors.c. Tells whether a function is larger at an instant than at both ends of the step, as beside a pole:
 * then it does not pass 0 there. */
bool events_far(const events *, const instant *, size_t function);
/* Tells whether the function's sign is certain at both ends of the step, whose bounds are known. */
bool events_clear(const events *, size_t function);
/* Bounds the error of a function at `here`, a time h after `left`, whose rates and bounds are known: from rounding
 * since the start and, where h is not 0, from the estimated error of the true step to `here`. */
motus_status events_error_of(events *, size_t function, double h, double *bound, motus_error *);
/* Tells whether a function moves, from the start of the step to its middle and its end, by no more than the error of
 * the step. */
motus_status events_step_keeps(events *, size_t function, bool *does, motus_error *);
/* Bounds the error of a function's rate at `here`, a time h after `left`. */
motus_status events_slope_error_of(events *, size_t function, double h, double *bound, motus_error *);
/* Bounds the error of the time of a root or touch at `here`, a time h after `left`, where the function is flat: the
 * time within which the error of the function hides the root, or the error of its rate hides the touch. *doubt = 0:
 * the function is not flat, and the time of the companion's event alone tells the error. */
motus_status events_doubt(events *, size_t function, double h, bool touches, double *doubt, motus_error *);

/* events_jump.c. Adds the candidate of a cell, from its samples. *sign is first the sign of the function before the
 * cell, 0 where it stands at 0, and afterwards its sign at the end of the cell. *told false: the samples change their
 * sign more than once. */
motus_status events_sampled(events *, const events_cell *, int *sign, bool *told, motus_error *);
/* Does what events_locate does, for a sampled candidate. */
motus_status events_locate_sampled(events *, size_t candidate, motus_error *);

/* events_place.c. Locates a candidate by true steps, with the state in `here`. The candidate may turn out to be gone,
 * and a near one may become two. */
motus_status events_locate(events *, size_t candidate, motus_error *);
/* Tells whether a function has stayed at 0, but for its error, since it last touched 0. Overwrites `here`. */
motus_status events_lingered(events *, const candidate *, bool *same, motus_error *);

/* A polynomial for a function on a part of the step, from `from` to `to` as fractions of the step, and its error. */
typedef struct events_piece {
    double from, to, noise;
    const double *c; /* Chebyshev coefficients */
    int degree;
} events_piece;
/* events_near.c. Evaluates the polynomial of these Chebyshev coefficients at tau in [0, 1]. */
double events_polynomial(const double *coefficients, int degree, double tau);
/* Keeps the extrema near 0 of function f on a part of the step. */
motus_status events_note_extrema(events *, stepper *, size_t f, const events_piece *, motus_error *);
/* Keeps the functions that come to rest at 0 or near it where a switch has turned at `here`. */
motus_status events_note_rest(events *, motus_error *);
/* Forgets the extrema after the time `end`, at which an action has cut the step. */
void events_cut_extrema(events *, double end);
void events_forget_extrema(events *);
/* Widens the box of a step by the possible error of the motion. */
void events_widen(events *);

/* events_narrow.c. Searches a step, by bounds, for roots of a function between the samples of dense output. *more: it
 * found roots besides the candidates from number `first` on, and has replaced these. degree: of the samples. failed:
 * the samples do not tell the roots of the function. */
motus_status events_narrow(events *, stepper *, size_t function, size_t first, int degree, bool failed, bool *more,
                           motus_error *);
/* Allows the search of events_narrow more parts of steps, because `steps` more steps have been taken. */
void events_may_look(events *, int64_t steps);

/* events_watch.c. Returns the time of the next tick of a clock. */
double events_tick(const events *, size_t rule);
/* Takes steps, up to the limit, while bounds prove that nothing happens in them. The last step leads from `left`. */
motus_status events_watch(events *, stepper *, stepper_limit, stepper_stop *why, motus_error *);
/* Raises `most` to the sizes of the numbers of a state at which a step begins. */
void events_extend(events *, const double *x, const double *v);
/* Computes the box of the present step, its middle in `next`, its half widths in `width`, and in `before` a lower bound
 * on the size of every function in it. False: no bounds are known. */
bool events_box(events *, stepper *);

/* events_find.c. Lists what may happen in the step from `left` to `right`, from the stepper's dense output. */
motus_status events_find(events *, stepper *, motus_error *);
/* Makes the candidate of a clock's next tick. False: it is not within the step. */
bool events_next_tick(const events *, size_t rule, candidate *);

/* events_fire.c. Does all that happens at `here`, to which the candidate leads. *assigned: the motion was changed. */
motus_status events_fire(events *, const candidate *, bool *assigned, motus_error *);
/* Evaluates the functions that events_fire left out at its last instant. */
motus_status events_complete(events *, motus_error *);
/* Sets the sides with which the motion goes on from `here`, where the step ends. */
void events_stand(events *);
/* Sets the truth of all conditions from the sides of their functions, without events. */
void events_suppose(events *);

/* events_swarm.c. Counts a turn of a switch at `here`, and where it and other switches accumulate moves `here` to the
 * limit. */
motus_status events_swarm(events *, size_t function, motus_error *);
void events_swarm_forget(events *);

/* events_growth.c. Counts an action of a rule. Returns MOTUS_DIVERGED or MOTUS_EVENTS where actions never end before a
 * time that the run is to pass. */
motus_status events_growth(events *, size_t rule, size_t instance, motus_error *);
/* Returns MOTUS_DIVERGED where a number grows without bound on the way to events.limit, where actions accumulate. */
motus_status events_unbounded(const events *, motus_error *);

/* events_state.c. Keeps the present state for a restart state. False: no memory. */
bool events_save_here(events *, const stepper *);
/* Forgets the state that events_save_here has kept. */
void events_unsave(events *);

#endif
