/* The functions into which core/stepper_body.c is compiled, once per instruction set, and their workspace: step/work.h
 * with real = double. */
#ifndef CORE_STEPPER_BODY_H
#define CORE_STEPPER_BODY_H

#include "core/rows.h"
#include "core/solver.h"

#include <float.h>
#include <math.h>

#include "core/scalar.h"
#define ROWS
#include "step/work.h"

/* The data that the library's own bodies find through work.services. */
struct stepper_host {
    const problem *problem;
    solver *solver;
    const struct tracing *tracing; /* while a step is traced, else NULL: core/trace_body.h */
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
    dense_room (*between)(const work *, coef *unit); /* between, extend, dense and swing are those of the family */
    int (*extend)(work *, const dense_step *);
    int (*dense)(work *, const dense_step *, clock t, real *x, real *v);
    bool (*swing)(const work *, real *most);
    void (*branch)(work *, const work *from, const real *a); /* advance_branch */
    /* A compiled body has these from the library's body: */
    int (*factor)(work *, mask *where, int s, const clock *ax, const clock *av, clock t, real *x, real *v);
    void (*back)(work *, real *r);
    void (*apply)(work *, clock c, const real *y, real *out);
    const real *(*diagonal)(const work *); /* solver_diagonal */
    int (*accel)(work *, clock t, real *x, real *v, real *a);
} stepper_body;

/* Returns the fastest body for this processor. */
const stepper_body *stepper_best_body(void);
extern const stepper_body stepper_body_base;
#if defined __x86_64__
extern const stepper_body stepper_body_avx2, stepper_body_avx512;
#endif

/* Makes a workspace without arrays, from the row, its arguments and the problem. memory: the caller's room for
 * work_plan_size constants; NULL: the constants are left out. */
work stepper_plan(const problem *, const chosen *, coef *memory);
/* Tells whether the matrix of the plan's linear systems is constant. */
bool stepper_fixed(const problem *, const work *plan);
/* Tell how many arrays a planned workspace needs, and how many of them lead from a step to the next. */
size_t stepper_arrays(work plan);
size_t stepper_carried(work plan);

#endif
