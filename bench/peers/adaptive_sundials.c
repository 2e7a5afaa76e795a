/* SUNDIALS with error control: ARKODE's explicit Runge-Kutta methods of order 8, and CVODE's Adams methods with
 * functional iteration. */
#include "bench/peers/peers.h"
#include "bench/problems.h"

#ifdef BENCH_SUNDIALS
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <string.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

enum { STEPS_MAX = 3000000 };

static int rates(realtype t, N_Vector state, N_Vector rate, void *context)
{
    const problem *p = context;
    const int n = p->positions;
    const realtype *y = NV_DATA_S(state);
    realtype *d = NV_DATA_S(rate);
    for (int k = 0; k < n; k++) d[k] = y[n + k];
    p->force(y, y + n, t, d + n);
    return 0;
}

static int by_erk(SUNContext context, const problem *p, double tolerance, N_Vector y)
{
    realtype t = 0;
    void *memory = ERKStepCreate(rates, 0, y, context);
    const int good = memory && !ERKStepSetOrder(memory, 8) && !ERKStepSStolerances(memory, tolerance, tolerance) &&
                     !ERKStepSetUserData(memory, (void *)p) && !ERKStepSetErrFile(memory, NULL) &&
                     !ERKStepSetMaxNumSteps(memory, STEPS_MAX) && !ERKStepSetStopTime(memory, p->until) &&
                     ERKStepEvolve(memory, p->until, y, &t, ARK_NORMAL) >= 0;
    if (memory) ERKStepFree(&memory);
    return good;
}

static int by_adams(SUNContext context, const problem *p, double tolerance, N_Vector y)
{
    realtype t = 0;
    void *memory = CVodeCreate(CV_ADAMS, context);
    SUNNonlinearSolver turns = SUNNonlinSol_FixedPoint(y, 0, context);
    const int good = memory && turns && !CVodeInit(memory, rates, 0, y) &&
                     !CVodeSStolerances(memory, tolerance, tolerance) && !CVodeSetUserData(memory, (void *)p) &&
                     !CVodeSetNonlinearSolver(memory, turns) && !CVodeSetErrFile(memory, NULL) &&
                     !CVodeSetMaxNumSteps(memory, STEPS_MAX) && !CVodeSetStopTime(memory, p->until) &&
                     CVode(memory, p->until, y, &t, CV_NORMAL) >= 0;
    if (turns) SUNNonlinSolFree(turns);
    if (memory) CVodeFree(&memory);
    return good;
}

/* Its complaints go nowhere: the result tells. */
int peer_sundials_adaptive(const char *solver, int which, double tolerance, double *state)
{
    const problem *p = &problems[which];
    const size_t size = 2 * (size_t)p->positions * sizeof *state;
    SUNContext context = NULL;
    if (SUNContext_Create(NULL, &context)) return 0;
    N_Vector y = N_VNew_Serial(2 * p->positions, context);
    memcpy(NV_DATA_S(y), p->start, size);
    const int good = !strcmp(solver, "erk") ? by_erk(context, p, tolerance, y) : by_adams(context, p, tolerance, y);
    memcpy(state, NV_DATA_S(y), size);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return good;
}
#else
int peer_sundials_adaptive(const char *solver, int which, double tolerance, double *state)
{
    (void)solver, (void)which, (void)tolerance, (void)state;
    return 0;
}
#endif
