/* What a machine supplies, and what a run needs of it. A machine is one file; this header is the whole of what it must bring.
 *
 * Two things are asked of every machine: a `problem` it can evaluate (acceleration, directional derivative, exact motion), and an engine that
 * advances one trajectory of that problem by a row. The bits of both are fixed by the graph's normal form and the texts in step/.
 */
#ifndef RUN_RUN_H
#define RUN_RUN_H

#include "core/stepper.h"
#include "lang/model.h"

typedef struct engine engine;

typedef struct machine {
    const char *name;
    /* Contracts as in core/stepper.h. */
    motus_status (*open)(const problem *, const chosen *, double t0, double h, const double *x, const double *v, const motus_allocator *,
                         engine **, motus_error *);
    void (*close)(engine *);
    motus_status (*advance)(engine *, int64_t steps, motus_error *);
    motus_status (*trace)(engine *, const tracer *, motus_error *);
    motus_status (*sync)(engine *, double *x, double *v, double *a, motus_error *);
    int64_t (*steps)(const engine *), (*evaluations)(const engine *), (*iterations)(const engine *);
    size_t (*carry)(const engine *);
    void (*save)(const engine *, double *carry);
    motus_status (*load)(engine *, int64_t step, int64_t evaluations, int64_t iterations, const double *carry, motus_error *);
} machine;

extern const machine machine_interpreter, machine_callback;

/* The interpreter's problem for a model; everything lies in the model's arena. */
typedef struct interpreter interpreter;
motus_status interpreter_create(model *, interpreter **, problem *, motus_error *);
/* The numbers of a quantity or invariant at a state, into out (definition->numbers of them). False: no memory. */
bool interpreter_look(interpreter *, model_definition *, double t, double *x, double *v, double *out);

/* After the model's numbers have changed: everything that was computed from them, and the boundary's places at the start. False: no memory. */
bool interpreter_rebind(interpreter *);

/* A problem from a callback definition; both must outlive it. `zeros`, as many as there are velocities and companions, stand in for a direction
 * that is not given; needed where the definition has a derivative. */
typedef struct calling {
    const motus_callback_def *def;
    const double *zeros;
    size_t first, count;             /* by `block`: the trajectories that it is asked about; count 0: one, by `acceleration` if there is one */
    int returned;                    /* by the callback that failed last */
} calling;
motus_status callback_problem(calling *, problem *, motus_error *);
/* The problem of the `count` trajectories that the calling names, side by side. The calling must outlive it. */
problem callback_block(calling *, const problem *one);

#endif
