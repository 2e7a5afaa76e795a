/* The machines: each supplies a problem that it can evaluate (acceleration, directional derivative, exact motion)
 * and, if it has a faster one than the library, the loop that advances a trajectory: `machine` of core/stepper.h. A
 * machine is one file.
 */
#ifndef MACHINE_MACHINE_H
#define MACHINE_MACHINE_H

#include "core/stepper.h"
#include "lang/model/model.h"

/* The interpreter's problem for a model; everything lies in the model's arena. */
typedef struct interpreter interpreter;
motus_status interpreter_create(model *, interpreter **, problem *, motus_error *);
/* The numbers of a quantity or invariant at a state, into out (definition->numbers of them). False: no memory. */
bool interpreter_look(interpreter *, model_definition *, double t, double *x, double *v, double *out);

/* The acceleration's derivative along a direction of v (in_v) or of x, as a program. NULL: the arena failed. */
program *interpreter_derivative(model *, bool in_v);

/* After the model's numbers have changed: everything that was computed from them, and the boundary's places at the
 * start. False: no memory. */
bool interpreter_rebind(interpreter *);

/* A problem from a callback definition; both must outlive it. `zeros`, as many as there are velocities and
 * first-order variables, stand in for a direction that is not given; needed where the definition has a derivative. */
typedef struct calling {
    const motus_callback_def *def;
    const double *zeros;
    /* by `block`: the trajectories that it is asked about; count 0: one, by `acceleration` if there is one */
    size_t first, count;
    int returned; /* by the callback that failed last */
} calling;
motus_status callback_problem(calling *, problem *, motus_error *);
/* The problem of the `count` trajectories that the calling names, side by side. The calling must outlive it. */
problem callback_block(calling *, const problem *one);

#endif
