/* The machines, one file each. A machine supplies a problem (acceleration, directional derivative, exact motion) and
 * may supply a loop that advances a trajectory faster than the library's: `machine` of core/stepper.h. */
#ifndef MACHINE_MACHINE_H
#define MACHINE_MACHINE_H

#include "core/rules.h"
#include "core/stepper.h"
#include "lang/base/interval.h"
#include "lang/model/resolution.h"

/* Creates the interpreter of a model, with its problem, in the model's arena. */
typedef struct interpreter interpreter;
motus_status interpreter_create(model *, interpreter **, problem *, motus_error *);
/* Writes the numbers of a quantity or invariant at a state, definition->numbers of them, to `out`. False: no memory. */
bool interpreter_observe(interpreter *, model_definition *, double t, double *x, double *v, double *out);
/* Bounds the rounding error of these numbers, if time and state are known to half a unit in the last place; 0 where a
 * formula has more than 65 536 operations. False: no memory. */
bool interpreter_rounding(interpreter *, model_definition *, double t, double *x, double *v, double *out);

/* Tells whether a quantity or invariant may jump along the motion, if its formula can be examined: it reads no
 * acceleration and is not long. *flat: it changes by jumps alone. */
bool interpreter_leaps(interpreter *, model_definition *, bool *flat);
/* Tells whether the value or the slope of a quantity or invariant may be infinite, if its formula can be examined. */
bool interpreter_sharp(interpreter *, model_definition *);
/* For all states in the intervals, bounds the numbers of a quantity or invariant that leaps or is sharp, and tells what
 * the bounds do not decide. False: no memory. */
bool interpreter_doubt(interpreter *, model_definition *, double t, interval *x, interval *v, interval *out, doubt *);

/* Makes the program of the acceleration's derivative along a direction of v (in_v) or of x. NULL: no memory. */
program *interpreter_derivative(model *, bool in_v);

/* Takes over the model's numbers after they have changed: computes what depends on them, and the driven boundary cells
 * at the start. False: no memory. */
bool interpreter_rebind(interpreter *);

enum { CALLING_NUMBERS = 512 }; /* most numbers in one array of a block of several trajectories */
/* The calls of a callback definition. */
typedef struct calling {
    const motus_callback_def *def;
    const double *zeros; /* nv zeros, a direction for derivatives along dx alone or dv alone */
    /* NaN in place of the velocities of a trajectory or block; NULL: the acceleration reads the velocities */
    const double *unread;
    /* the trajectories that `block` computes; count 0: one trajectory, by `acceleration` where the definition has it */
    size_t first, count;
    /* the value of the callback that failed last; 0: it read the velocity, and its definition says that it does not */
    int returned;
    const char **rule_names;           /* the names of its events */
    const motus_event_def *own_events; /* copies of their definitions */
} calling;
/* Makes the problem of a callback; definition and calling must outlive it. */
motus_status callback_problem(calling *, problem *, motus_error *);
/* Makes the rules of a callback's events, in an arena that outlives them. *out is NULL where it has none. */
motus_status callback_rules(calling *, arena *, const rules **, motus_error *);
/* Makes the problem of a block: the calling's `count` trajectories side by side. The calling must outlive it. */
problem callback_block(calling *, const problem *one);

#endif
