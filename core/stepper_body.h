/* The functions that core/stepper_body.c compiles to, once per instruction set, and their workspace: step/work.h with
 * real = double. */
#ifndef CORE_STEPPER_BODY_H
#define CORE_STEPPER_BODY_H

#include "core/rows.h"
#include "core/solver.h"

#include <float.h>
#include <math.h>

#include "core/scalar.h"
#define ROWS
#include "step/work.h"

/* The data of the library's own bodies, found through work.services. tracing: core/trace_body.h, while a step is
 * traced. */
struct stepper_host {
    const problem *problem;
    solver *solver;
    const struct tracing *tracing;
};

typedef struct stepper_body {
    const char *name;
    void (*plan)(work *, const double argument[2], coef *memory);
    size_t (*place)(work *, real *memory);
    int (*carry)(const work *, real *list[CARRY_MAX]);
    int (*run)(work *, whole steps);                 /* advance_run */
    int (*sync)(work *, real *x, real *v, real *a);  /* advance_sync */
    int (*check)(work *);                            /* advance_check */
    int (*observe)(work *);                          /* advance_observe */
    dense_room (*between)(const work *, coef *unit); /* the family's, as dense and extend are */
    int (*extend)(work *, const dense_step *);
    int (*dense)(work *, const dense_step *, clock t, real *x, real *v);
    bool (*swing)(const work *, real *most);
    void (*branch)(work *, const work *from, const real *a); /* advance_branch */
    /* A compiled body calls these of the library's. */
    int (*factor)(work *, mask *where, int s, const clock *ax, const clock *av, clock t, real *x, real *v);
    void (*back)(work *, real *r);
    void (*apply)(work *, clock c, const real *y, real *out);
    const real *(*diagonal)(const work *); /* solver_diagonal */
    int (*accel)(work *, clock t, real *x, real *v, real *a);
} stepper_body;

/* The fastest one here. */
const stepper_body *stepper_best_body(void);
extern const stepper_body stepper_body_base;
#if defined __x86_64__
extern const stepper_body stepper_body_avx2, stepper_body_avx512;
#endif

/* A workspace without arrays: what follows from the row, its arguments and the problem. With memory for work_plan_size
 * numbers, which the caller keeps, its constants too. */
work stepper_plan(const problem *, const chosen *, coef *memory);
/* Whether the matrix of the plan's linear systems is the same at every state and time. */
bool stepper_fixed(const problem *, const work *plan);
/* How many arrays a planned workspace needs, and how many of them lead from a step to the next. */
size_t stepper_arrays(work plan);
size_t stepper_carried(work plan);

#endif
