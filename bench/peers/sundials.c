/* SUNDIALS' ERKStep, one trajectory after another with a fixed step and Kutta's tableau; its memory is made once and
 * reset. */
#include "bench/peers/peers.h"

#ifdef BENCH_SUNDIALS
#include <arkode/arkode_erkstep.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

static int rates(realtype t, N_Vector state, N_Vector rate, void *F)
{
    const realtype *y = NV_DATA_S(state);
    realtype *d = NV_DATA_S(rate);
    d[0] = y[1];
    d[1] = -y[0] + y[0] * y[0] * y[0] + *(const double *)F * cos(t);
    return 0;
}

int peer_sundials(size_t count, const double *F, double h, int64_t steps, double *x)
{
    realtype c[4] = {0, 0.5, 0.5, 1}, b[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    realtype a[16] = {0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1, 0};
    double amplitude;
    SUNContext context = NULL;
    if (SUNContext_Create(NULL, &context)) return 0;
    N_Vector y = N_VNew_Serial(2, context);
    N_VConst(0, y);
    void *memory = ERKStepCreate(rates, 0, y, context);
    ARKodeButcherTable table = ARKodeButcherTable_Create(4, 4, 0, c, a, b, NULL);
    int good = memory && table && !ERKStepSetTable(memory, table) && !ERKStepSetFixedStep(memory, h) &&
               !ERKStepSetUserData(memory, &amplitude) && !ERKStepSetMaxNumSteps(memory, (long)steps + 10);
    for (size_t k = 0; good && k < count; k++) {
        realtype t = 0, end = (double)steps * h;
        amplitude = F[k];
        N_VConst(0, y);
        good = !ERKStepReset(memory, 0, y) && !ERKStepSetStopTime(memory, end) &&
               ERKStepEvolve(memory, end, y, &t, ARK_NORMAL) >= 0;
        x[k] = NV_Ith_S(y, 0);
    }
    ARKodeButcherTable_Free(table);
    if (memory) ERKStepFree(&memory);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return good;
}
#else
int peer_sundials(size_t count, const double *F, double h, int64_t steps, double *x)
{
    (void)count, (void)F, (void)h, (void)steps, (void)x;
    return 0;
}
#endif
