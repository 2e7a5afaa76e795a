/* Models of random motions for tests: forces as trees that are evaluated in 113 bits and written as texts of the
 * language. A tree and its text share nothing with the library, so that what they say of a motion is a judgement.
 *
 * Every motion has natural units, in which its numbers are about 1; its frame says in which units, from which origin
 * and in which direction of time its text has it.
 */
#ifndef TEST_MOTION_H
#define TEST_MOTION_H

#include "test/quad.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    MOTION_NODES = 320,
    MOTION_SWITCHES = 16,
    MOTION_VARIABLES = 6,
    MOTION_LAYERS = 4,
    MOTION_MODES = 2,
    MOTION_EVENTS = 4,
    MOTION_NAME = 16,
    MOTION_NUMBER = 64,
    MOTION_TEXT = 16384
};

/* From MOTION_ABS to MOTION_CROSS: switches, each with an argument that has a side. */
typedef enum motion_op {
    MOTION_NUMBER_OP,
    MOTION_TIME,
    MOTION_PLACE,
    MOTION_SPEED,
    MOTION_MODE,
    MOTION_ADD,
    MOTION_SUB,
    MOTION_MUL,
    MOTION_DIV,
    MOTION_SIN,
    MOTION_EXP,
    MOTION_SQRT,
    MOTION_CBRT,
    MOTION_IF,      /* a: a comparison */
    MOTION_ABS,     /* the argument: a */
    MOTION_SIGN,    /* a */
    MOTION_SIDE,    /* a - b, and the value is its sign */
    MOTION_MAX,     /* a - b */
    MOTION_GREATER, /* a - b */
    MOTION_MOD,     /* a/b, whose side is its integer part */
    MOTION_CROSS    /* a - b: the function of an event */
} motion_op;

typedef struct motion_node {
    motion_op op;
    int a, b, c;              /* operands; MOTION_ABS, MOTION_SIDE: c is the form in which the text has it */
    int which;                /* the variable, the mode or the switch */
    quad value;               /* of a number, as its decimals say */
    char text[MOTION_NUMBER]; /* of a number */
} motion_node;

/* Where a force changes fast: where the value of node u is between -reach and reach, or below reach. */
typedef struct motion_layer {
    int u;
    quad reach;
    bool below;
} motion_layer;

/* At a root of the function of node `cross`, a MOTION_CROSS, in one direction or in both (0): one variable's place or
 * speed, or a mode, becomes the value of node `becomes`. */
typedef struct motion_event {
    int cross, direction;
    motion_op changes; /* MOTION_PLACE, MOTION_SPEED, MOTION_MODE; MOTION_NUMBER_OP: the event only records */
    int which, becomes;
} motion_event;

typedef struct motion_frame {
    bool scaled, absolute;     /* absolute: the force has the time t itself, not t - t0 */
    bool backward, summed;     /* summed: `until` is written as a sum with t0 */
    int length, time;          /* the units are 10^length, 10^time of the text's */
    double origin, start;      /* of places; of the time; whole, or with three decimals */
    char until[MOTION_NUMBER]; /* how the end is written; "": as a number */
} motion_frame;

typedef struct motion {
    motion_node nodes[MOTION_NODES];
    int count, force[MOTION_VARIABLES], variables, switches;
    bool first_order[MOTION_VARIABLES];
    char place[MOTION_VARIABLES][MOTION_NAME], speed[MOTION_VARIABLES][MOTION_NAME]; /* columns */
    double x[MOTION_VARIABLES], v[MOTION_VARIABLES];                                 /* of at most three decimals */
    quad until; /* from the start, > 0, natural units */
    double step;
    motion_layer layers[MOTION_LAYERS];
    int layer_count;
    double mode[MOTION_MODES];
    int modes;
    motion_event events[MOTION_EVENTS];
    int event_count;
    /* In the plane: friction -slides v/|v| besides the forces, 0: none. */
    quad slides;
    quad gathers; /* the time at which events accumulate, beyond `until`; 0: they do not */
    motion_frame frame;
    char equations[MOTION_TEXT]; /* "": as the trees say; with what happens where it has a `when` */
    /* Of a family of two cells with the same force: as a cell is called there; NULL: none. Where its first cell starts;
     * the other as x and v say. */
    const char *index;
    double cell_x, cell_v;
    int kind;
} motion;

/* The state: places, then speeds, along the run; t: the time since the start. */
typedef struct motion_point {
    quad t, y[2 * MOTION_VARIABLES], mode[MOTION_MODES];
} motion_point;

/* ---- building ---- */

int motion_add(motion *, motion_op, int a, int b, int c);
int motion_switch(motion *, motion_op, int a, int b, int c); /* with a switch of its own */
int motion_again(motion *, int node, int form);              /* the same switch, in another form of text */
int motion_number(motion *, double);                         /* its shortest decimals */
int motion_written(motion *, const char *text, quad value);
int motion_variable(motion *, motion_op, int which);
void motion_layer_at(motion *, int u, double reach, bool below);
void motion_names(motion *, const char *const *places);

bool motion_is_switch(motion_op);
const motion_node *motion_switch_at(const motion *, int s);

/* ---- numbers ---- */

quad motion_absolute(quad);
quad motion_power_of_ten(int);
quad motion_read(const char *decimals); /* to the last of 113 bits */
quad motion_pi(void);
quad motion_root(quad);
/* As decimals, 26 of them. */
void motion_show(quad, char *out, size_t size);

/* ---- values ---- */

/* Whether numbers are the doubles nearest to their decimals; else they are what is written. */
void motion_round_numbers(bool);
quad motion_decimal(double value); /* of three decimals at most */
/* The values of all nodes. sides: 1, -1, or between where it is held (MOTION_MOD: the integer part); arguments: of
 * switches. along, unless NULL: the derivatives of the values along the motion with the accelerations a; of arguments
 * in rates. */
void motion_values(const motion *, const motion_point *, const quad *sides, quad *arguments, quad *values);
void motion_rates(const motion *, const motion_point *, const quad *sides, const quad *a, const quad *values,
                  quad *along, quad *rates);

/* ---- the text ---- */

void motion_print(const motion *, int node, char *out, size_t size);
void motion_text(const motion *, char *out, size_t size);
/* Time, place and speed in the units of the text. */
quad motion_time_of(const motion *, quad t);
quad motion_place_of(const motion *, int variable, quad x);
quad motion_speed_of(const motion *, quad v);
double motion_step_of(const motion *, double step);

#endif
