/* GSL's odeiv2, one trajectory after another with a fixed step. Its rk4 estimates an error by halving every step,
 * asked or not: three steps' work for one, which is what a user of it gets. */
#include "bench/peers/peers.h"

#ifdef BENCH_GSL
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

static int rates(double t, const double y[], double d[], void *F)
{
    d[0] = y[1];
    d[1] = -y[0] + y[0] * y[0] * y[0] + *(const double *)F * cos(t);
    return GSL_SUCCESS;
}

int peer_gsl(size_t count, const double *F, double h, int64_t steps, double *x)
{
    double amplitude;
    gsl_odeiv2_system system = {rates, NULL, 2, &amplitude};
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk4, h, 1e-9, 0);
    int good = driver != NULL;
    for (size_t k = 0; good && k < count; k++) {
        double t = 0, y[2] = {0, 0};
        amplitude = F[k];
        good = gsl_odeiv2_driver_reset(driver) == GSL_SUCCESS &&
               gsl_odeiv2_driver_apply_fixed_step(driver, &t, h, (unsigned long)steps, y) == GSL_SUCCESS;
        x[k] = y[0];
    }
    if (driver) gsl_odeiv2_driver_free(driver);
    return good;
}
#else
int peer_gsl(size_t count, const double *F, double h, int64_t steps, double *x)
{
    (void)count, (void)F, (void)h, (void)steps, (void)x;
    return 0;
}
#endif
