/* GSL's odeiv2 with error control: the pair of Prince and Dormand of orders 8 and 7, and Adams' multistep method. */
#include "bench/peers/peers.h"
#include "bench/problems.h"

#ifdef BENCH_GSL
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <string.h>

static int rates(double t, const double y[], double d[], void *context)
{
    const problem *p = context;
    const int n = p->positions;
    for (int k = 0; k < n; k++) d[k] = y[n + k];
    p->force(y, y + n, t, d + n);
    return GSL_SUCCESS;
}

enum { STEPS_MAX = 3000000 };

int peer_gsl_adaptive(const char *stepper, int which, double tolerance, double *state)
{
    const problem *p = &problems[which];
    const gsl_odeiv2_step_type *type = !strcmp(stepper, "rk8pd") ? gsl_odeiv2_step_rk8pd : gsl_odeiv2_step_msadams;
    gsl_odeiv2_system system = {rates, NULL, 2 * (size_t)p->positions, (void *)p};
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&system, type, p->until * 1e-6, tolerance, tolerance);
    double t = 0;
    memcpy(state, p->start, 2 * (size_t)p->positions * sizeof *state);
    const int good = driver && gsl_odeiv2_driver_set_nmax(driver, STEPS_MAX) == GSL_SUCCESS &&
                     gsl_odeiv2_driver_apply(driver, &t, p->until, state) == GSL_SUCCESS;
    if (driver) gsl_odeiv2_driver_free(driver);
    return good;
}
#else
int peer_gsl_adaptive(const char *stepper, int which, double tolerance, double *state)
{
    (void)stepper, (void)which, (void)tolerance, (void)state;
    return 0;
}
#endif
