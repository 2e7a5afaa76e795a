/* The switches of a model: where the force has one smooth formula on one side and another beyond it.
 *
 * A switch is an operation abs, sign, min, max, floor, mod, cbrt, the search in a table, or a comparison, whose
 * argument depends on time or state. Its side is a number p that replaces it: |u| becomes p u, with p = 1 or -1. While
 * the sides are held, the force is smooth also beyond the place where a side would change; so a step can lead across
 * that place, and a root of the argument tells where it is. In a family there is a switch for each cell.
 *
 * A direction u/|u| of a vector of velocities can be a switch in each component. The side of a component is that of a
 * unit vector from which u is less than a right angle away, or SWITCHES_HELD, while u stays 0.
 *
 * A touch is a place where a formula has no derivative without changing: sqrt, cbrt, a power or hypot at 0, asin and
 * acos at ±1, atan2 on its cut. Its argument is positive elsewhere, and 0 there.
 */
#ifndef LANG_MODEL_SWITCHES_H
#define LANG_MODEL_SWITCHES_H

#include "lang/model/model.h"

/* The side of a sign whose argument the force holds at 0 (sliding.c), in a run forward and in a run backward. */
#define SWITCHES_HELD 2.0
#define SWITCHES_HELD_BACKWARD 3.0

enum { SWITCHES_MAX = 1 << 16, TOUCHES_MAX = 1 << 12 }; /* in a model, cells counted; more touches are not observed */

/* What becomes of a motion that the force drives back to a switch from both sides. SLIDES_NEVER: that cannot be, since
 * the switch does not jump, or does not move its argument. */
typedef enum switches_sliding { SLIDES_NEVER, SLIDES_HELD, SLIDES_REFUSED } switches_sliding;

typedef struct switches {
    size_t count;        /* switches, cells counted */
    const char *refused; /* why their sides cannot be held, as a part of a sentence; NULL: they can */
    node refused_at;     /* the operation with which there were too many; 0: none */
    uint8_t *op;         /* by switch: its operation */
    /* The sides are numbers slot … slot + count - 1 of the pool, after the model's own, or of x if they are modes. */
    size_t slot;
    output *accel;       /* accelerations, with sides in place of switches */
    output *boundary;    /* boundary lines, with sides in place of switches */
    size_t kinds;        /* kinds of switches: a family counts once */
    output *argument;    /* by kind: what the switch compares with 0, or takes the integer part of, to SPACE_OUT */
    output *held, *rate; /* the argument with sides in it, and its rate along the motion (reads SPACE_A) */
    node *original;      /* by kind: the operation, as the model has it */
    node *side;          /* by kind: the side, as the equations load it */
    node *within;        /* by kind: the operation's first operand, with sides in it */
    size_t *first;       /* by kind: the number of the first cell's switch */
    uint32_t *leader;    /* by kind: the kind of the first component of its direction; itself: it is no component */
    uint8_t *parts;      /* by kind: how many components its direction has, in consecutive kinds; 0: it is none */
    node *sliding;       /* by kind: the component over the length, while the vector is not 0 */
    /* If sides are modes: the values that hold arguments at 0 while their sides are SWITCHES_HELD, how much the rates
     * of the arguments grow with these values, and the rates of both along the motion; hold_kinds of them, to the
     * places of their arguments. */
    output *hold, *hold_rate, *grip, *grip_rate;
    size_t hold_kinds;
    bool together; /* kinds without families: these values are right when several are held that depend on each other */
    uint8_t *slides; /* by kind: enum switches_sliding */
    uint32_t *as;    /* by kind: the first kind of its surface, with which it is held and changes its side */
    bool shared;     /* some kinds share a surface */
    int8_t *turned;  /* by kind: 1: its argument has the sign of that of the first kind; -1: the opposite one */
    size_t touches, touch_kinds; /* touches, cells counted; kinds of them */
    output *touch, *touch_rate;  /* by kind: the argument of the touch, with sides in it, and its rate */
} switches;

/* Finds the switches of accelerations and boundary lines; directions: they are switches, too. False: no memory. */
bool switches_find(model *, bool directions, switches *);
/* Return how many switches a kind has, the kind of switch k, and the shape of a kind. */
size_t switches_cells(const switches *, size_t kind);
size_t switches_kind(const switches *, size_t k);
model_shape switches_shape(const model *, const switches *, size_t kind);

/* Returns whether a switch changes at times that are known beforehand: while all sides are held, what it depends on is
 * a + b t alone. */
bool switches_timed(graph *, const graph_node *);
/* Returns how many of a model's switches, cells counted, do not. */
size_t switches_sought(const model *, const switches *);
/* Return whether a node is a switch, and what one with the operands a and b compares with 0, or takes the integer part
 * of (switches_counts). */
bool switches_is(const graph *, const graph_node *);
node switches_argument(graph *, operation, node a, node b);
bool switches_counts(operation);
/* Returns whether the operation of a kind is a component of a direction. */
bool switches_directs(operation);

/* Returns the side of the value u of an argument; if u is 0, or at the lower end of a floor, the side towards which it
 * moves. */
double switches_side(operation, double u, double rate);
/* Returns whether the operation itself jumps where its argument is 0, or a whole number. */
bool switches_jumps(operation);
/* Writes where an operation changes its formula: "x' = 1", "t/2 = a whole number". */
void switches_surface(const model *, node original, char *out, size_t size);
/* Return a smooth function of u that is positive on the side and falls to 0 at its ends, and its derivative. On side 0
 * of a sign, where u has been 0, it falls from 0 both ways. */
double switches_distance(operation, double side, double u);
double switches_distance_slope(operation, double side, double u);
/* Returns how far the argument is from leaving its side; below 0: it has left it. */
double switches_gap(operation, double side, double u);
/* Returns the rate of the gap, from that of the argument. */
double switches_gap_rate(operation, double side, double u, double rate);
/* Returns the side beyond the end that u has reached. */
double switches_beyond(operation, double side, double u);

#endif
