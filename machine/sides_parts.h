/* What the files of sides share. Each uses only those above it on this list: sides_switch.c (one switch: its side, its
 * parts, what its tapes say), sides_choose.c (how one switch chooses its side), sides_directions.c (how a direction
 * does, r'/|r'|), sides.c (the functions of all switches, and how all of them change). `way` is 1 forward in time, -1
 * backward.
 */
#ifndef MACHINE_SIDES_PARTS_H
#define MACHINE_SIDES_PARTS_H

#include "lang/model/switches.h"
#include "lang/tape/tape.h"
#include "machine/sides.h"

struct sides {
    const model *model;
    const switches *switches;
    const problem *problem;
    rules supplied, own;
    rule *rule;
    tape *argument, *rate, *rounding, *force_rounding, *least, *least_rates;
    tape *hold, *hold_rate, *hold_rounding; /* NULL: none can be held */
    tape *grip, *grip_rate, *grip_rounding; /* likewise */
    double *u, *du, *later;              /* of all switches: arguments, their rates, and the arguments a little later */
    double *kept, *before, *now, *bound; /* likewise, while sides are chosen; kept: by those who place all of them */
    double *p, *dp, *r, *dr; /* likewise: what holds them and how much that drives them, and the rates of both */
    double *a, *b, *x, *v;   /* room for two accelerations and a state */
    double *push;            /* and for what has moved velocities */
    double *xs, *vs;         /* the series of a motion; NULL: none was wanted */
    double *was;             /* of all switches: sides for a while */
    double way;              /* of the run: 1, or -1 backward */
    int8_t *beside;          /* likewise: the way in which a switch leaves 0 with another one, 0: it does not */
    bool *of, *covered;      /* likewise: switches that are to be held together, and those that are */
};

static inline operation sides_op_of(const sides *s, size_t k) { return (operation)s->switches->op[k]; }

/* Whether switch k is held; an integer part is 2 by itself. */
static inline bool sides_is_held(const sides *s, const double *side, size_t k)
{
    return side[k] >= SWITCHES_HELD && !switches_counts(sides_op_of(s, k));
}

/* The switches of a direction are those of its components, of which the first one has the function of all. */
typedef struct parts {
    size_t of[GRAPH_COMPONENTS];
    int count; /* 0: switch k is no direction */
} parts;

/* ---- sides_switch.c ---- */

void sides_evaluate(const sides *s, tape *t, double time, double *x, double *v, double *a, double *out);
/* The side of switch k where its argument is positive, way 1, or negative, way -1. */
double sides_side_of(const sides *s, size_t k, int way);
/* The switch whose surface that of switch k is, and whether that is another one: then k changes its side with it, and
 * has no function of its own. */
size_t sides_first_of(const sides *s, size_t k);
static inline bool sides_follows(const sides *s, size_t k) { return sides_first_of(s, k) != k; }
parts sides_parts_of(const sides *s, size_t k);
/* Whether it has no function of its own. */
bool sides_silent(const sides *s, size_t k);
/* Gives switch k, which follows none, a side; those that follow it have what belongs to that. */
void sides_put(const sides *s, double *side, size_t k, double value);
/* Whether a switch that has the surface of k is a comparison, be it k itself. */
bool sides_chooses(const sides *s, size_t k);
/* What would have to hold every vector at 0 whose sides are held, to p; 0: what no force moves and none drives back. */
void sides_measure_hold(const sides *s, double t, double *x, double *v);
/* The sum of the products of two vectors' components. */
double sides_along(const parts *p, const double *a, const double *b);
/* Its surface, in words. */
void sides_print(const sides *s, size_t k, char *out, size_t size);
/* The force leads no motion on from where a switch changes its side. */
motus_status sides_refuse(const sides *s, size_t k, const char *what, double t, motus_error *err);
motus_status sides_accelerate(sides *s, double t, double *x, double *v, motus_error *err);

/* ---- sides_choose.c ---- */

/* Whether what holds both takes the other one into account. */
bool sides_solved(const sides *s, size_t k, size_t j);
/* The switches beside k: of those that are marked in `of`, or else of those at 0. Their number. */
motus_status sides_find_beside(sides *s, size_t k, const bool *of, double way, double t, double *x, double *v,
                               size_t *found, motus_error *err);
/* Moves the state to where the argument of k, or of n beside it, is 0, along the push that switch k exerts. */
motus_status sides_move_to_zero(sides *s, size_t k, size_t n, double t, double *x, double *v, motus_error *err);
/* Switch k and those in s->beside, all of them at 0: *held, or they go on to one side. `going`: the way in which the
 * value that holds k has left its bounds, 0: it has not. While those beside it have one value, that of k tells what
 * changes; where it leaves they take as much of it as they can. */
motus_status sides_stand_at_corner(sides *s, size_t k, int going, double way, double t, double *x, double *v,
                                   bool *held, motus_error *err);
/* The side on which the motion goes on where the argument of switch k is 0. */
motus_status sides_choose(sides *s, size_t k, bool left, double way, double t, double *x, double *v, motus_error *err);
/* The integer side likewise; u is at the whole number `at`. */
motus_status sides_choose_count(sides *s, size_t k, bool left, double at, double way, double t, double *x, double *v,
                                motus_error *err);
/* The new side of switch k, whose argument has left the old one. */
motus_status sides_change(sides *s, size_t k, double way, double t, double *x, double *v, motus_error *err);

/* ---- sides_directions.c ---- */

/* The length from which a vector comes to rest along a way that is below the rounding of the largest place: so short
 * is it that the force changes no more. 0: it does not come to rest. */
double sides_short_of(const sides *s, const parts *p, double t, double *x, double *v);
/* The function of a direction falls to 0 where the vector has turned away from its unit vector, or is short, and has
 * no kink where the motion stops without a turn. While the vector is held at 0 it is 1 - |p|^2. */
double sides_direction_of(const sides *s, const parts *p, const double *side, const double *u, double least);
double sides_direction_rate_of(const sides *s, const parts *p, const double *side, const double *du);
/* du: bounds on rounding. */
double sides_direction_rounding_of(const sides *s, const parts *p, const double *side, const double *du);
/* The motion leaves 0 along what would have to hold it, where that is more than 1. The vector becomes as long as
 * rounding allows to tell its direction. */
motus_status sides_leave(sides *s, const parts *p, double way, double t, double *x, double *v, motus_error *err);
/* The vector is 0, but for rounding: it stays 0 where no more than the whole of the disc is needed for that. */
motus_status sides_stand(sides *s, const parts *p, double way, double t, double *x, double *v, motus_error *err);
/* The side of a direction. left: the vector has turned away from the old one, or is short, or what holds it has left
 * the disc. */
motus_status sides_choose_direction(sides *s, size_t k, bool left, double way, double until, double *t, double *x,
                                    double *v, motus_error *err);

#endif
