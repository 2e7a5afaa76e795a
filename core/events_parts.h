/* What the files of events share: the struct, and what each file does with it.
 *
 * From the lowest, each uses only those above it on this list. events_at.c: functions at an instant, and true steps to
 * it. events_table.c: rows, kept numbers, accumulation. events_candidates.c: what may happen in a step, and its order.
 * events_errors.c: error bounds of functions and of the times of events. events_jump.c: functions that jump or have a
 * kink. events_place.c: where a root is by true steps. events_near.c: extrema near 0. events_narrow.c: roots that dense
 * output leaps. events_watch.c: steps in which nothing happens, by bounds. events_find.c: the roots of a step, by dense
 * output. events_swarm.c: switches that accumulate. events_growth.c: actions that come without end. events_fire.c: what
 * happens in one instant. events_state.c: restart states. events.c: life and steps.
 *
 * A true step is a step of the method itself from `left` to a time within the step; dense output interpolates.
 * Invariant: `left` is the state at which the present step began, and `side` are the sides of all functions there,
 * those of the events that have happened since included.
 */
#ifndef CORE_EVENTS_PARTS_H
#define CORE_EVENTS_PARTS_H

#include "core/events.h"
#include "core/roots.h"

/* Dense output errs by far less than this part of a function's largest value on the step; where a function comes nearer
 * to 0, or a root lies where it hardly leaves 0, true steps tell what happens. It costs time alone. */
#define EVENTS_SLACK 0x1p-13

/* A state of the trajectory, and the functions there. */
typedef struct instant {
    double t, lost; /* the state is that of time t + lost: stepper_lost */
    double *x, *v, *a;
    double *g, *rate, *bound; /* the functions, their rates, and bounds on the rounding errors of g */
    bool valued;              /* g is known; at the ends of a step only where something may happen in it */
} instant;

typedef enum candidate_kind { CANDIDATE_FALLS = -1, CANDIDATE_TOUCHES, CANDIDATE_RISES, CANDIDATE_TIME } candidate_kind;

/* What may happen within the present step. */
typedef struct candidate {
    candidate_kind kind; /* of a `near` one: the side of 0 on which the function is */
    size_t of;           /* function; CANDIDATE_TIME: rule */
    double at;           /* time since `left`: by dense output; by true steps where `located` */
    double low, high;    /* this is the function's only root between these times since `left` */
    bool located, gone;
    bool followed; /* it is gone because it has been followed; else nothing was there */
    bool idle;     /* its function changes its side, and nothing happens */
    bool sure;     /* the signs at `low` and `high` differ, and the values there far exceed the error of dense output */
    bool near;    /* an extremum near 0: true steps tell whether the function touches 0, crosses it twice, or neither */
    bool sampled; /* it was found between samples: events_jump.c */
    bool guessed; /* `at` is by the values and slopes at the ends of the step alone */
    bool leaves;  /* of a sampled one: the function has been 0 before it */
    bool jumps;   /* it is no root: the function jumps to this side; CANDIDATE_TOUCHES: it comes to 0 and stays */
} candidate;

/* A part of the step, too short to be divided, in which no polynomial fits a function, and its samples there. */
typedef struct events_cell {
    size_t of;                  /* function */
    int count;                  /* samples */
    double from;                /* the time since `left` at which the part begins */
    const double *time, *value; /* of the samples, in order; time since `left` */
    double bound;               /* values up to this size count as 0 */
    bool last;                  /* the run ends where the part does */
} events_cell;

typedef struct kept_state { /* the kept numbers from time t on */
    double t;
    size_t at; /* in `kept`, times rules.kept_count */
} kept_state;

/* The latest times of one instance of a rule, by levels: level k has the latest RECENT events whose numbers are
 * multiples of 2^k, the last one first. So the ratio of intervals is also known from long intervals, whose relative
 * rounding error is small. A rule of many instances has one level. */
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

/* The latest turns of a switch of the force, and how the cycles between them become shorter (events_swarm.c). */
enum { SWARMS = 8 };
typedef struct swarm_mark {
    double t, cycle;
} swarm_mark;
typedef struct swarm {
    size_t function;
    int count;       /* turns so far, 3: three or more; 0: of none */
    int64_t shorter; /* how many of the latest cycles were shorter than the one before */
    double t[2];     /* of the latest turns, the last one first */
    double cycle, longest;
    swarm_mark mark[2]; /* when the cycles were half as long as at the mark before */
    int marks;
    bool slows; /* they fell more slowly since the last mark than before */
    int parity; /* where the state of the latest turn is kept */
} swarm;

/* After 2^k actions: events_growth.c. */
enum { GROWTH_MARKS = 6 };

struct events {
    rules rules;
    problem problem;
    machine machine;
    chosen method;
    motus_allocator allocator;
    stepper *probe;
    double start, until, way; /* way: 1 forward, -1 backward */
    double grid_start, grid_step;
    int64_t steps;                /* of the leg */
    bool broken;                  /* of fixed steps: `left` lies within one, which ends at the next time of the grid */
    int (*asks)(const void *ctx); /* events_listen; NULL: nobody cancels */
    const void *asks_ctx;
    int64_t asked;          /* events so far; `asks` is called at some of them */
    bool cancelled, halted; /* the present step */
    bool first;             /* no step has been taken since the start */
    bool marked;            /* the bounds at both ends of the step are known */
    events_end end;
    size_t end_rule;

    instant left, right, here, next;
    instant best;         /* of those at which a root was looked for */
    const stepper *along; /* whose step leads from `left` to `right`; NULL between steps */
    double *past; /* where the pieces of the present step began that ended in an action: t, lost, `acted`, x, v */
    size_t pasts, past_room;
    double past_end;    /* where the last of these pieces ended */
    int64_t acted_left; /* `acted` when the present piece began */
    /* the arrays are of every function: */
    int8_t *side;    /* -1, 1, 0: not known, since the function has been 0 from the start on */
    uint8_t *stands; /* it is 0 at `left` */
    uint8_t *open;   /* it is near 0 at `left`, and only the next step says whether it passes or touches 0 */
    int8_t *heads;   /* of one that stands at 0: the sign of its slope along the run, 0: not known */
    uint8_t *was;    /* side, stands, open and heads before the present step */
    double here_at;  /* the time from `left` to `here` */
    double whole;    /* the size of the step before it was shortened to tell how a function leaves 0; 0: it was not */
    double span;     /* from `left` to `right` */
    int shorter;     /* how often the present step may be taken anew, shorter, to resolve an internal function */
    bool hidden;     /* the step is so long that rounding hides how a function leaves 0 at its start */
    /* the arrays are of every function: */
    uint8_t *zero;  /* it is 0 at `here` */
    uint8_t *level; /* it stays at 0 after this instant, because its slope is 0 but for rounding */
    double doubt;   /* an error bound of the time of this instant: events_doubt */
    double blurred; /* the same, where it is rounding of the state that hides the root of a function that is not flat */
    bool awaits;    /* a switch of the force is to turn in this instant */
    uint8_t *touched; /* that it touches 0 has been told in this instant */
    /* candidate_kind + 2 of one that a turn has led to 0 in this instant, where the motion rests; 0: it has not */
    uint8_t *arrives;
    uint8_t *look;   /* the bounds on the step leave it open, so dense output is searched for its roots */
    uint8_t *passed; /* it has passed 0 in watched steps, which was no event; `side` does not know of it yet */
    int8_t *sign;    /* working space: the signs of a condition's leaves */
    double *before;  /* the functions at `here` before an action; while roots are sought, lower bounds on the step */
    bool boxed;      /* the present step's box is in `next` and `width`, its lower bounds are in `before` */
    int pause;       /* so many more steps are not watched, since watching was in vain; */
    int last_pause;  /*   how many in all */
    double *fired;   /* when it last passed or touched 0; NaN: never, or an action lets it do so again */
    uint32_t *rule_of;
    double *most;   /* the largest size of positions, then velocities, since the start */
    int64_t taken;  /* steps since the start */
    int64_t pieces; /* in which narrow events may still be looked for */
    /* steps where that was not possible; the time of the first, and a function there */
    int64_t unseen;
    double unseen_at;
    size_t unseen_function;
    double *width; /* of positions, then velocities: half widths of the step's box, or error bounds (events_errors.c) */
    double *samples;   /* of all functions at the points of the step, */
    double *arguments; /*   and there arguments of their operations (core/rules.h) */
    int samples_room;
    bool clocks;   /* there are rules of that kind */
    bool lingers;  /* a function stands at 0 or is open, at the start of the step or at its end */
    bool partial;  /* `here` has been fired with few of its functions evaluated */
    bool in_parts; /* the points do not resolve the function that is looked at: parts of the step do */
    /* of every instance of a condition, numbered by `instances`: */
    uint8_t *held;     /* it was true */
    uint8_t *steady;   /* it was true up to this instant, in which it has not happened */
    double *happened;  /* the time at which it last happened or was true already, and is not false since; NaN: none */
    size_t *instances; /* per rule: the number of its first instance */
    recent *recent;    /* per instance */
    double *recent_t;  /* their times */
    int64_t *count;    /* per rule */
    int64_t *ticks;    /* per rule: of a clock, how often it has happened */
    uint8_t *ticked;   /* per rule: of a clock, it has in this instant */
    candidate *candidate;
    size_t candidates, candidate_room;
    /* They are in the order of their times, but for what locating them moves these, and all before number `next_one`
     * are gone. */
    bool in_order;
    size_t next_one;

    double at_once;         /* the time of the latest action */
    int actions;            /* in that instant */
    events_jogger jog;      /* NULL: none */
    events_witness witness; /* likewise */
    void *witness_ctx;
    int64_t acted;       /* in all, and */
    double acted_sum;    /*   the sum of their times, since the start */
    double turned_at;    /* the time of the latest action of an internal rule */
    int64_t flights;     /* between such actions, of one step, and */
    double flights_sum;  /* the sum of the times at their ends, since the start */
    int64_t turned_step; /* `steps` at the latest action of an internal rule */
    size_t turns;        /* in that instant */
    swarm swarm[SWARMS];
    double *swarm_state; /* of each the states after its latest two turns */
    double pace;         /* no step from a turn on is longer: it must see the turns to come */
    double interval;     /* from the instant of an action before */
    double shift;        /* the largest distance of a located time from that of dense output, of this step */

    event *row;
    double *row_state; /* of every row: the state on arrival, and after it where the action changed it */
    size_t *row_at;
    size_t rows, row_room, numbers, number_room;
    double *off; /* of positions, then velocities: how far they may be off (events_near.c); NULL: it is not known */
    double *extremum; /* of each its function, time, kind and state */
    size_t extrema, extremum_room;
    double *unkept; /* per rule: the time from which extrema had no room; NaN: all have been kept */
    bool keeps_jumps;
    double *jump; /* time, 1 where the rule assigns, the state before it and after it, of every action that is kept */
    size_t jumps, jump_room;
    double *kept;
    kept_state *kept_state;
    size_t kept_states, kept_room;
    double *after; /* the state after the latest event of `after_rule`, instance `after_instance` */
    size_t after_rule, after_instance;
    int growths; /* marks so far, and of the latest */
    double growth_t[GROWTH_MARKS];
    double *growth_most;        /*   the largest numbers, x and then v */
    bool has_limit, limit_told; /* events accumulate; a rule has answered to that */
    events_limit limit;
    double tail; /* what is left before a limit that the latest events seem to have; 0: they have none */
    double limit_part, limit_part_error; /* what is left before it, in intervals, and how far that may be off */
    double *limit_off;                   /* how far the state there may be off for that reason, x and then v */

    /* Of fixed steps, from the last one on: what a restart state takes in place of the present state, which is that
     * before this step: `saved_head` numbers, and then those of the stepper. Else NULL. */
    bool may_save;
    double *saved, saved_time;
    size_t saved_head, saved_rows;
    stepper_count saved_steps;
    double began; /* of a restart state: where the leg of its stepper began */
};

/* events_at.c. The acceleration, rates and bounds of an instant whose state and values are known. */
motus_status events_judge(events *, instant *, motus_error *);
/* The rates alone, and the bounds alone. */
motus_status events_rates(events *, instant *, motus_error *);
motus_status events_bounds(events *, instant *, motus_error *);
motus_status events_values(events *, instant *, motus_error *);
/* At both ends of the step. */
motus_status events_value_ends(events *, motus_error *);
/* The same of one function alone, where that costs less; the numbers of the others are then those of another instant.
 */
motus_status events_value_of(events *, size_t function, instant *, motus_error *);
motus_status events_rate_of(events *, size_t function, instant *, motus_error *);
motus_status events_bound_of(events *, size_t function, instant *, motus_error *);
motus_status events_judge_of(events *, size_t function, instant *, motus_error *); /* rate and bound */
/* MOTUS_CALLBACK: the callback for `which` returned `answer` at time t. */
motus_status events_refuse(const events *, const char *which, double t, int answer, motus_error *);
/* The direction in which a function moves at an instant along the run; 0: too small to tell. */
int events_direction(const events *, const instant *, size_t function);
void events_copy(const events *, instant *to, const instant *from); /* time, state and functions */
/* The time so long after `left`; what times have lost to rounding leads out of the step where it is short. */
double events_place_in(const events *, double h);
/* A step of size h from the state of time `from` + `lost`; the end is at *t + *rest. */
motus_status events_probe(events *, double from, double lost, const double *x, const double *v, double h, double *t,
                          double *rest, motus_error *);
/* The state after a step of size h from `left`; with values, or that of one function. */
motus_status events_at(events *, double h, instant *, motus_error *);
motus_status events_at_of(events *, size_t function, double h, instant *, motus_error *);

/* events_table.c. Room for `more` items behind `count` of them. False: no memory. */
bool events_grow(const motus_allocator *, void **items, size_t count, size_t *room, size_t more, size_t size);
bool events_note(events *, size_t rule, size_t instance, bool touched, const instant *); /* a row */
bool events_note_jump(events *, const rule *, const instant *, bool after); /* before an action, then after it */
bool events_note_after(events *, const instant *);                          /* its state after it */
void events_overlay(const events *, double *x);                             /* the newest kept numbers */
bool events_keep_now(events *, double t, const double *x);
void events_kept_forget(events *); /* those before the newest */
/* An event of a rule that assigns; true: they accumulate, at events.limit. */
bool events_accumulate(events *, size_t rule, size_t instance, double t);
/* Events of the rule follow one another at t too fast to be told apart: they accumulate there, or as long after it as
 * the latest intervals let more of them come. */
void events_end_here(events *, size_t rule, size_t instance, double t);
/* The state after an action, beside which the next one of the same rule is judged; and its limit, to `here`. */
void events_after(events *, size_t rule, size_t instance);
void events_to_limit(events *);
motus_status events_no_memory(motus_error *);

/* events_candidates.c. Adds one. False: no memory. */
bool events_add(events *, candidate);
/* An extremum on the other side of 0: replaces a near candidate by the two crossings, before and after that time. */
motus_status events_split(events *, size_t candidate, double at, motus_error *);
/* Places the candidates of a step so well that their order can be told, and orders them where they are many. */
motus_status events_order(events *, stepper *, motus_error *);
/* The candidate that comes next; those of dense output may be as far off as the ones that have been located. NULL:
 * there is none. */
candidate *events_earliest(events *);
/* How far a candidate that is not located may be from its time by dense output. */
double events_margin(const events *);
/* The candidates from *first to before *end are all whose times are no farther than `far` from this one. */
void events_about(const events *, double at, double far, size_t *first, size_t *end);

/* events_errors.c. Whether the size of a function at an instant exceeds that at both ends of the step, as beside a
 * pole: then it does not pass 0 there. */
bool events_far(const events *, const instant *, size_t function);
/* Whether rounding hides the sign of a function at neither end of the step; their bounds are known. */
bool events_clear(const events *, size_t function);
/* An error bound of a function at `here`, a time h after `left`, whose rates and bounds are known: from the rounding
 * since the start and, where h is not 0, from the estimated error of the true step to `here`. */
motus_status events_error_of(events *, size_t function, double h, double *bound, motus_error *);
/* An error bound of the function's rate there. */
motus_status events_slope_error_of(events *, size_t function, double h, double *bound, motus_error *);
/* An error bound of the time of a root or touch at `here`, a time h after `left`, where the function is flat: the time
 * within which the error of the function hides its root, or that of its rate hides the touch. 0: it is not flat, and
 * the time of the companion's event alone tells the error. */
motus_status events_doubt(events *, size_t function, double h, bool touches, double *doubt, motus_error *);

/* events_jump.c. Adds the candidate of a cell, from its samples. *sign is the sign of the function before the cell, 0
 * where it stands at 0, and then that at its end. *told false: the samples change their sign more than once. */
motus_status events_sampled(events *, const events_cell *, int *sign, bool *told, motus_error *);
/* events_locate for a sampled candidate. */
motus_status events_locate_sampled(events *, size_t candidate, motus_error *);

/* events_place.c. Finds where the candidate is, and the state there, in `here`. It may be gone; a near one may become
 * two. */
motus_status events_locate(events *, size_t candidate, motus_error *);
/* Whether a function has stayed at 0, but for its error, since it touched 0 the last time; `here` is left elsewhere. */
motus_status events_lingered(events *, const candidate *, bool *same, motus_error *);

/* Of a function on a part of the step, where `from` and `to` are parts of it: a polynomial, and how far it is off. */
typedef struct events_piece {
    double from, to, noise;
    const double *c; /* Chebyshev coefficients */
    int degree;
} events_piece;
/* events_near.c. p(tau), of Chebyshev coefficients. */
double events_polynomial(const double *coefficients, int degree, double tau);
/* Keeps the extrema near 0 of function f on a part of the step. */
motus_status events_note_extrema(events *, stepper *, size_t f, const events_piece *, motus_error *);
/* A switch has turned at `here`: keeps the functions that come to rest there, at 0 or near it. */
motus_status events_note_rest(events *, motus_error *);
/* Forgets those behind a time at which an action has cut the step; and all. */
void events_cut_extrema(events *, double end);
void events_forget_extrema(events *);
/* Widens the box of a step by what the motion may be off by. */
void events_widen(events *);

/* events_narrow.c. `degree`: of the samples of the step; `failed`: the points do not tell the roots of the function.
 * Bounds tell of more roots of a function than its candidates from number `first` on, *more: they take
 * the place of these. */
motus_status events_narrow(events *, stepper *, size_t function, size_t first, int degree, bool failed, bool *more,
                           motus_error *);
/* So many more steps have been taken, in which narrow events may be looked for. */
void events_may_look(events *, int64_t steps);

/* events_watch.c. The time of the next tick of a clock. */
double events_tick(const events *, size_t rule);
/* Takes steps that bounds alone tell of until they do not, or up to the limit. The last one leads from `left`. */
motus_status events_watch(events *, stepper *, stepper_limit, stepper_stop *why, motus_error *);
/* A state of the motion, where a step begins, counts in `most`. */
void events_extend(events *, const double *x, const double *v);
/* The box of the present step, its middle in `next`, its half widths in `width`, and in `before` a lower bound on the
 * size of every function in it. False: no bounds are known. */
bool events_box(events *, stepper *);

/* events_find.c. What may happen in the step from `left` to `right`, whose dense output the stepper has. */
motus_status events_find(events *, stepper *, motus_error *);
/* The next tick of a clock. False: it is not within the step. */
bool events_next_tick(const events *, size_t rule, candidate *);

/* events_fire.c. All that happens at `here`, to which the candidate leads. */
motus_status events_fire(events *, const candidate *, bool *assigned, motus_error *);
/* Of the instant that was last fired, evaluates the functions that have not been asked for. */
motus_status events_complete(events *, motus_error *);
/* The sides and roots with which the motion goes on from `here`, where the step ends. */
void events_stand(events *);
/* The truth of conditions from the sides, without events. */
void events_suppose(events *);

/* events_swarm.c. A switch has turned at `here`, which is moved on to where it and others accumulate, if they do. */
motus_status events_swarm(events *, size_t function, motus_error *);
void events_swarm_forget(events *);

/* events_growth.c. A rule has acted. MOTUS_DIVERGED, MOTUS_EVENTS: there is no end of such actions before a time that
 * the run is to pass. */
motus_status events_growth(events *, size_t rule, size_t instance, motus_error *);
/* Actions accumulate at events.limit. MOTUS_DIVERGED: a number grows without bound on the way there. */
motus_status events_unbounded(const events *, motus_error *);

/* events_state.c. Keeps the present state for a restart state; false: no memory. And forgets it. */
bool events_save_here(events *, const stepper *);
void events_unsave(events *);

#endif
