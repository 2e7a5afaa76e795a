/* What the files of sides share. Each uses only those before it in this list: sides_switch.c (one switch: its side,
 * its parts, its tapes), sides_timed.c (switches that change at known times), sides_choose.c (how a switch chooses
 * its side), sides_directions.c (how a direction r'/|r'| chooses its side), sides.c (the functions of all switches,
 * and how all of them change). `way` is 1 forward in time, -1 backward. */
#ifndef MACHINE_SIDES_PARTS_H
#define MACHINE_SIDES_PARTS_H

#include "lang/model/switches.h"
#include "lang/tape/tape.h"
#include "machine/sides.h"

enum { NESTED = 16 }; /* the most switches, each within the argument of the next, that change at once */

struct sides {
    const model *model;
    const switches *switches;
    const problem *problem;
    rules supplied, own;
    rule *rule;
    tape *argument, *rate, *rounding, *force_rounding, *least, *least_rates;
    struct timed *timed; /* the switches that change at known times (sides_timed.c) */
    size_t timed_count;
    uint8_t *is_timed;  /* by switch */
    bool nested;        /* some depend on the sides of others */
    tape *from, *rates; /* their arguments, and the rates of these */
    double *line;       /* both, at t = 0 */
    size_t *shown;      /* by function after those of the text: its switch; timed ones have none */
    size_t *kind_of;    /* by rule after those of the text: its kind */
    size_t shown_count, shown_kinds;
    tape *position;                         /* the arguments without sides; NULL: no switch is a search in a table */
    tape *rate_rounding;                    /* NULL: as above */
    tape *hold, *hold_rate, *hold_rounding; /* NULL: no switch can be held */
    tape *grip, *grip_rate, *grip_rounding; /* NULL: no switch can be held */
    /* an entry for each switch: */
    double *u, *du, *later;              /* arguments, their rates, and the arguments a little later */
    double *kept, *before, *now, *bound; /* arguments and bounds while sides are chosen; kept: where all are placed */
    double *found;                       /* the arguments by which sides are chosen */
    double *p, *dp, *r, *dr; /* the value that holds it, how much that drives it (its grip), and the rates of both */
    double *a, *b, *x, *v;   /* room for two accelerations and a state */
    double *push;            /* room for a change of the velocities */
    double *xs, *vs;         /* the series of a motion; NULL until wanted */
    double *was;             /* for each switch: its side for a while */
    double way;              /* of the run: 1 forward, -1 backward */
    int8_t *beside;          /* for each switch: the way in which it leaves 0 with another one, 0: it does not */
    bool *of, *covered;      /* for each switch: it is to be held together with others; it is held so */
};

static inline operation sides_op_of(const sides *s, size_t k) { return (operation)s->switches->op[k]; }

/* Tells whether switch k is held. The side of an integer part is a whole number, which does not mean that. */
static inline bool sides_is_held(const sides *s, const double *side, size_t k)
{
    return side[k] >= SWITCHES_HELD && !switches_counts(sides_op_of(s, k));
}

/* The switches of a direction: one for each component, of which the first has the function of the direction. */
typedef struct parts {
    size_t of[GRAPH_COMPONENTS];
    int count; /* 0: the switch is not a direction */
} parts;

/* ---- sides_switch.c ---- */

void sides_evaluate(const sides *s, tape *t, double time, double *x, double *v, double *a, double *out);
/* Returns the side of switch k where its argument is positive (way 1) or negative (way -1). */
double sides_side_of(const sides *s, size_t k, int way);
/* Returns the first switch with the surface of switch k. Where that is another switch, k follows it: it changes its
 * side with it and has no function of its own. */
size_t sides_first_of(const sides *s, size_t k);
static inline bool sides_follows(const sides *s, size_t k) { return sides_first_of(s, k) != k; }
parts sides_parts_of(const sides *s, size_t k);
/* Tells whether switch k has no function of its own. */
bool sides_silent(const sides *s, size_t k);
/* Gives a side to switch k, which follows none, and to the switches that follow it. */
void sides_put(const sides *s, double *side, size_t k, double value);
/* Tells whether switch k, or one that follows it, is a comparison. */
bool sides_chooses(const sides *s, size_t k);
/* Measures the values that hold switches, in p, and their grips, in r. p is 0 for a component of a direction that no
 * force moves and none drives back. */
void sides_measure_hold(const sides *s, double t, double *x, double *v);
/* Returns the scalar product of two vectors. */
double sides_along(const parts *p, const double *a, const double *b);
/* Writes the surface of switch k in words. */
void sides_print(const sides *s, size_t k, char *out, size_t size);
/* Returns MOTUS_SOLVE, with a message: `what` happens where switch k changes its side, and no motion leads on. */
motus_status sides_refuse(const sides *s, size_t k, const char *what, double t, motus_error *err);
motus_status sides_accelerate(sides *s, double t, double *x, double *v, motus_error *err);

/* ---- sides_timed.c ---- */

/* Finds the switches that change at known times, and computes these times again. False: no memory. */
bool sides_find_timed(sides *, model *);
void sides_bind_timed(sides *);
static inline bool sides_is_timed(const sides *s, size_t k) { return s->is_timed[k] != 0; }
/* See `next` of core/rules.h. */
double sides_next_time(void *sides, double way, double t, double *x);
/* Sets the sides of these switches for the motion from t on, and returns how many have changed. *jumps: the force may
 * have jumped. */
int64_t sides_pass_times(sides *, double way, double t, double *x, bool *jumps);

/* ---- sides_choose.c ---- */

/* Tells whether the values that hold switches k and j take each other into account. */
bool sides_solved(const sides *s, size_t k, size_t j);
/* Marks in s->beside the switches beside k, among those marked in `of` or, without `of`, among those at 0; *found is
 * their number. */
motus_status sides_find_beside(sides *s, size_t k, const bool *of, double way, double t, double *x, double *v,
                               size_t *found, motus_error *err);
/* Moves the state to where the argument of k, or of n beside it, is 0, along the push that switch k exerts. */
motus_status sides_move_to_zero(sides *s, size_t k, size_t n, double t, double *x, double *v, motus_error *err);
/* Holds switch k and those in s->beside, all of them at 0 (*held), or sends them on to one side. going: the way in
 * which the value that holds k has left its bounds, 0: it has not. The switches beside k keep one value while that of
 * k varies; where k leaves its bounds they take as much of its value as they can. */
motus_status sides_stand_at_corner(sides *s, size_t k, int going, double way, double t, double *x, double *v,
                                   bool *held, motus_error *err);
/* Chooses the side on which the motion goes on where the argument of switch k is 0. */
motus_status sides_choose(sides *s, size_t k, bool left, double way, double t, double *x, double *v, motus_error *err);
/* Chooses the side of an integer part, switch k, whose argument is at the whole number `at`. */
motus_status sides_choose_count(sides *s, size_t k, bool left, double at, double way, double t, double *x, double *v,
                                motus_error *err);
/* Gives switch k, whose argument has left its side, the new side. */
motus_status sides_change(sides *s, size_t k, double way, double t, double *x, double *v, motus_error *err);

/* ---- sides_directions.c ---- */

/* Returns the length from which on a vector comes to rest along a way that is below the rounding of the largest
 * position, so that the force no longer changes. 0: it does not come to rest. */
double sides_short_of(const sides *s, const parts *p, double t, double *x, double *v);
/* Evaluates the function of a direction. It falls to 0 where the vector has turned away from its unit vector or is
 * short, without a kink where the motion stops without a turn. While the vector is held at 0, it is 1 - |p|^2. */
double sides_direction_of(const sides *s, const parts *p, const double *side, const double *u, double least);
double sides_direction_rate_of(const sides *s, const parts *p, const double *side, const double *du);
/* Bounds the rounding of that function. du: bounds on the rounding of the arguments. */
double sides_direction_rounding_of(const sides *s, const parts *p, const double *side, const double *du);
/* Lets the motion leave 0 along the value that would hold it, which exceeds 1. The vector becomes long enough for
 * rounding to leave its direction. */
motus_status sides_leave(sides *s, const parts *p, double way, double t, double *x, double *v, motus_error *err);
/* Lets a vector that is 0, but for rounding, stay 0 if a value within the unit disc can hold it. */
motus_status sides_stand(sides *s, const parts *p, double way, double t, double *x, double *v, motus_error *err);
/* Chooses the side of a direction. left: the vector has turned away from the old side or is short, or the value that
 * holds it has left the unit disc. */
motus_status sides_choose_direction(sides *s, size_t k, bool left, double way, double until, double *t, double *x,
                                    double *v, motus_error *err);

#endif
