/* CVODE with its root finding, one motion after another; its memory is made once and begun anew. */
#include "bench/peers/peers.h"

#ifdef BENCH_SUNDIALS
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

enum { STEPS_MAX = 3000000 };

static int rates(realtype t, N_Vector state, N_Vector rate, void *context)
{
    const realtype *y = NV_DATA_S(state);
    realtype *d = NV_DATA_S(rate);
    (void)t, (void)context;
    d[0] = y[2];
    d[1] = y[3];
    d[2] = -y[0] - 2 * y[0] * y[1];
    d[3] = -y[1] - y[0] * y[0] + y[1] * y[1];
    return 0;
}

static int jacobian(realtype t, N_Vector state, N_Vector rate, SUNMatrix J, void *context, N_Vector a, N_Vector b,
                    N_Vector c)
{
    const realtype *y = NV_DATA_S(state);
    (void)t, (void)rate, (void)context, (void)a, (void)b, (void)c;
    SUNMatZero(J);
    SM_ELEMENT_D(J, 0, 2) = SM_ELEMENT_D(J, 1, 3) = 1;
    SM_ELEMENT_D(J, 2, 0) = -1 - 2 * y[1];
    SM_ELEMENT_D(J, 2, 1) = SM_ELEMENT_D(J, 3, 0) = -2 * y[0];
    SM_ELEMENT_D(J, 3, 1) = -1 + 2 * y[1];
    return 0;
}

static int section(realtype t, N_Vector state, realtype *value, void *context)
{
    (void)t, (void)context;
    *value = NV_DATA_S(state)[0];
    return 0;
}

/* What solves the implicit equation. */
typedef struct solver {
    SUNNonlinearSolver turns;
    SUNMatrix matrix;
    SUNLinearSolver linear;
} solver;

static int attach(void *memory, int adams, N_Vector y, SUNContext context, solver *s)
{
    if (adams) return (s->turns = SUNNonlinSol_FixedPoint(y, 0, context)) && !CVodeSetNonlinearSolver(memory, s->turns);
    s->matrix = SUNDenseMatrix(4, 4, context);
    s->linear = SUNLinSol_Dense(y, s->matrix, context);
    return s->matrix && s->linear && !CVodeSetLinearSolver(memory, s->linear, s->matrix) &&
           !CVodeSetJacFn(memory, jacobian);
}

static void detach(solver *s)
{
    if (s->turns) SUNNonlinSolFree(s->turns);
    if (s->linear) SUNLinSolFree(s->linear);
    if (s->matrix) SUNMatDestroy(s->matrix);
}

/* To `until`; how many places there were, or -1. */
static int one(void *memory, N_Vector y, double until, int most, double *points)
{
    realtype t = 0;
    int found = 0, status;
    while ((status = CVode(memory, until, y, &t, CV_NORMAL)) == CV_ROOT_RETURN)
        if (found++ < most) {
            double *p = points + 3 * (found - 1);
            p[0] = t, p[1] = NV_DATA_S(y)[1], p[2] = NV_DATA_S(y)[3];
        }
    return status >= 0 ? found : -1;
}

int peer_sundials_sections(const char *name, double tolerance, size_t count, const double *y0, const double *vx,
                           const double *vy, double until, int most, double *points, int *found, int64_t *evaluations)
{
    const int adams = !strcmp(name, "adams");
    int rising = 1;
    SUNContext context = NULL;
    solver parts = {0};
    if (SUNContext_Create(NULL, &context)) return 0;
    N_Vector y = N_VNew_Serial(4, context);
    N_VConst(0, y);
    void *memory = CVodeCreate(adams ? CV_ADAMS : CV_BDF, context);
    int good = memory && !CVodeInit(memory, rates, 0, y) && !CVodeSStolerances(memory, tolerance, tolerance) &&
               !CVodeSetErrFile(memory, NULL) && !CVodeSetMaxNumSteps(memory, STEPS_MAX) &&
               !CVodeRootInit(memory, 1, section) && !CVodeSetRootDirection(memory, &rising) &&
               attach(memory, adams, y, context, &parts);
    *evaluations = 0;
    for (size_t k = 0; good && k < count; k++) {
        const double start[4] = {0, y0[k], vx[k], vy[k]};
        long calls = 0;
        memcpy(NV_DATA_S(y), start, sizeof start);
        good = !CVodeReInit(memory, 0, y) && !CVodeSetStopTime(memory, until);
        if (good) found[k] = one(memory, y, until, most, points + 3 * (size_t)most * k);
        good = good && found[k] >= 0 && !CVodeGetNumRhsEvals(memory, &calls);
        *evaluations += calls;
    }
    if (memory) CVodeFree(&memory);
    detach(&parts);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return good;
}
#else
int peer_sundials_sections(const char *name, double tolerance, size_t count, const double *y0, const double *vx,
                           const double *vy, double until, int most, double *points, int *found, int64_t *evaluations)
{
    (void)name, (void)tolerance, (void)count, (void)y0, (void)vx, (void)vy, (void)until, (void)most, (void)points;
    (void)found, (void)evaluations;
    return 0;
}
#endif
