/* The machines. Each supplies a problem (acceleration, directional derivative, exact motion) and may supply a faster
 * loop that advances a trajectory than the library's: `machine` of core/stepper.h. A machine is one file.
 */
#ifndef MACHINE_MACHINE_H
#define MACHINE_MACHINE_H

#include "core/rules.h"
#include "core/stepper.h"
#include "lang/base/interval.h"
#include "lang/model/resolution.h"

/* The interpreter's problem for a model, in the model's arena. */
typedef struct interpreter interpreter;
motus_status interpreter_create(model *, interpreter **, problem *, motus_error *);
/* Writes the numbers of a quantity or invariant at a state, definition->numbers of them, to `out`. False: no memory. */
bool interpreter_observe(interpreter *, model_definition *, double t, double *x, double *v, double *out);
/* The same of a bound on how far rounding carries these numbers off, their operands known to half a unit in the last
 * place; 0 where a formula has more than 65 536 operations. */
bool interpreter_rounding(interpreter *, model_definition *, double t, double *x, double *v, double *out);

/* Whether a quantity or invariant may jump along the motion by a formula that can be examined: it reads no
 * acceleration, and is not long. `flat`: it does nothing else. */
bool interpreter_leaps(interpreter *, model_definition *, bool *flat);
/* The same of one whose value or slope may be infinite. */
bool interpreter_sharp(interpreter *, model_definition *);
/* Of such ones: between which bounds its numbers lie where the state is anywhere in the intervals, and what these leave
 * open. False: no memory. */
bool interpreter_doubt(interpreter *, model_definition *, double t, interval *x, interval *v, interval *out, doubt *);

/* The acceleration's derivative along a direction of v (in_v) or of x, as a program. NULL: the arena failed. */
program *interpreter_derivative(model *, bool in_v);

/* To be called after the model's numbers have changed: computes again what depends on them, and the driven boundary
 * cells at the start. False: no memory. */
bool interpreter_rebind(interpreter *);

/* A problem from a callback definition; definition and calling must outlive it. `zeros` is the direction of a
 * derivative along dx alone or dv alone: as many zeros as there are velocities and first-order variables. */
enum { CALLING_NUMBERS = 512 }; /* in one array of a block of several trajectories, at most */
typedef struct calling {
    const motus_callback_def *def;
    const double *zeros;
    /* NULL: the acceleration reads the velocity. Else NaN, for all numbers of a trajectory and of a block */
    const double *unread;
    /* the trajectories that `block` computes; count 0: one trajectory, by `acceleration` where the definition has it */
    size_t first, count;
    /* the value of the callback that failed last; 0: it read the velocity, and its definition says that it does not */
    int returned;
    const char **rule_names; /* of its events, whose definitions are copied */
    const motus_event_def *own_events;
} calling;
motus_status callback_problem(calling *, problem *, motus_error *);
/* The rules of a callback's events, in an arena that outlives them, with copies of their names; NULL: it has none. */
motus_status callback_rules(calling *, arena *, const rules **, motus_error *);
/* The problem of a block: the calling's `count` trajectories side by side. The calling must outlive it. */
problem callback_block(calling *, const problem *one);

#endif
