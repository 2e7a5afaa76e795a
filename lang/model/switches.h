/* The switches of a model: where the force follows one smooth formula on one side and another beyond it.
 *
 * A switch is an operation abs, sign, min, max, floor, mod, cbrt or a comparison, whose argument depends on the time or
 * the state. Its side is a number p that stands in its place: |u| becomes p u, with p = 1 or -1. While the sides are
 * held, the force is smooth, also beyond the place where a switch would change its side; so a step can lead across that
 * place, and a root of the argument tells where it is. In a family there is a switch for each cell.
 *
 * A direction u/|u| of a vector of velocities is a switch in each component, where that is asked for. The side of a
 * component is that of a unit vector from which u is less than a right angle away, or SWITCHES_HELD, while u stays 0.
 *
 * A touch is a place where a formula has no derivative without changing: sqrt, cbrt, a power or hypot at 0, asin and
 * acos at ±1, atan2 on its cut. Its argument is positive elsewhere, and 0 there.
 */
#ifndef LANG_MODEL_SWITCHES_H
#define LANG_MODEL_SWITCHES_H

#include "lang/model/model.h"

/* The side of a sign whose argument the force holds at 0, in a run that goes forward and in one that goes backward:
 * sliding.c. */
#define SWITCHES_HELD 2.0
#define SWITCHES_HELD_BACKWARD 3.0

enum { SWITCHES_MAX = 1 << 16, TOUCHES_MAX = 1 << 12 }; /* of one model, cells counted; more touches are not observed */

/* What becomes of a motion that the force drives back to a switch from both sides. SLIDES_NEVER: it cannot, since the
 * switch does not jump, or does not move its argument. */
typedef enum switches_sliding { SLIDES_NEVER, SLIDES_HELD, SLIDES_REFUSED } switches_sliding;

typedef struct switches {
    size_t count;        /* switches, cells counted */
    const char *refused; /* why they cannot be held: a part of a sentence; NULL: they can */
    node refused_at;     /* the operation with which there were too many; 0: none */
    uint8_t *op;         /* count: the operation of each */
    /* The sides are numbers slot … slot + count - 1 of the pool, behind the model's own; of a model that has them as
     * modes, of x. */
    size_t slot;
    output *accel;       /* the model's outputs, with sides in place of the switches */
    output *boundary;    /* likewise */
    size_t kinds;        /* switches, families counted once */
    output *argument;    /* kinds: what the switch compares with 0, or takes the integer part of, to SPACE_OUT */
    output *held, *rate; /* the same with sides in it, and its rate of change along the motion (reads SPACE_A) */
    node *original;      /* kinds: the operation, as the model has it */
    node *side;          /* kinds: the side as the equations load it */
    size_t *first;       /* kinds: the number of the first cell's switch */
    uint32_t *leader;    /* kinds: of a component of a direction that of the first one, otherwise itself */
    uint8_t *parts;      /* kinds: how many components that direction has, one kind behind the other, 0: it is none */
    node *sliding;       /* kinds: the component over the length, while the vector is not 0 */
    /* Of a model that has modes for sides: the value that holds each argument at 0 while its side is SWITCHES_HELD, how
     * much the rate of the argument grows with that value, and the rates of both along the motion; hold_kinds of them,
     * to the places of their arguments. */
    output *hold, *hold_rate, *grip, *grip_rate;
    size_t hold_kinds;
    bool
        together; /* of kinds that are no families these values are right when several are held that depend on others */
    uint8_t *slides; /* kinds: enum switches_sliding */
    uint32_t *as;    /* kinds: the first one of the same surface, with which it is held and changes its side */
    bool shared;     /* some kind has the surface of another */
    int8_t *turned;  /* kinds: 1 where its argument has the sign of that one's, -1 the other */
    size_t touches, touch_kinds; /* touches, cells counted; families counted once */
    output *touch, *touch_rate;  /* touch_kinds: the arguments, with sides in them, and their rates */
} switches;

/* Finds the switches of accelerations and boundary lines, and `directions` as such. False: no memory. */
bool switches_find(model *, bool directions, switches *);
/* How many switches are of a kind, and their shape. */
size_t switches_cells(const switches *, size_t kind);
size_t switches_kind(const switches *, size_t k); /* of switch k */
model_shape switches_shape(const model *, const switches *, size_t kind);

/* Whether a node is a switch, and what it compares with 0, or takes the integer part of (switches_counts), with the
 * operands a and b. */
bool switches_is(const graph *, const graph_node *);
node switches_argument(graph *, operation, node a, node b);
bool switches_counts(operation);
/* Whether the operation of a kind is a component of a direction. */
bool switches_directs(operation);

/* The side that belongs to the value u of the argument; where u is 0, or at the lower end of a floor, to the side
 * towards which it moves. */
double switches_side(operation, double u, double rate);
/* Whether the operation itself jumps where its argument is 0, or a whole number. */
bool switches_jumps(operation);
/* Where the operation changes its formula, as text: "x' = 1", "t/2 = a whole number". */
void switches_surface(const model *, node original, char *out, size_t size);
/* A smooth function of u that is positive on the side and falls to 0 at its ends, and its derivative; on side 0 of a
 * sign, where u has been 0, it falls from 0 both ways. */
double switches_distance(operation, double side, double u);
double switches_distance_slope(operation, double side, double u);
/* How far the argument is from leaving its side; below 0: it has left it. */
double switches_gap(operation, double side, double u);
/* The rate of the gap, from that of the argument. */
double switches_gap_rate(operation, double side, double u, double rate);
/* The side beyond the end which u has reached. */
double switches_beyond(operation, double side, double u);

#endif
