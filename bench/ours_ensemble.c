/* An ensemble through the public library: the place where the bench and the ensembles of motus.h meet.
 *
 * Contract: `file` is a model with one position; trajectory k has `varied` ("F", "theta(0)") set to values[k], all else as the model
 * says; `steps` steps of `step` by `method` on `threads` threads. x[k] and v[k] receive the final state (v at the time of x). Returns
 * the seconds of the integration alone, without the parsing and compiling, or NaN where the library cannot do this.
 */
#include "bench/bench.h"

#include <math.h>

double ours_ensemble(const char *file, const char *method, int64_t steps, double step, const char *varied, const double *values,
                     size_t count, double *x, double *v, int threads)
{
    (void)file, (void)method, (void)steps, (void)step, (void)varied, (void)values, (void)count, (void)x, (void)v, (void)threads;
    return NAN;                  /* the library has no ensembles yet */
}
