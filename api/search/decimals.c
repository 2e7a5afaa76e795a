/* See accuracy.h.
 *
 * The run is made once more with the shadow of its system, and once more from a start that is a rounding away. Where
 * the shadow moves the answer several times as far, the decimals are the cause.
 */
#include "api/search/accuracy.h"

#include "api/error/bars.h"
#include "api/system/system.h"

#include <math.h>

enum { CHUNK = 256 };
#define CLEARLY 3 /* times as far as a rounding of the start moves the answer */

static motus_status move_start(motus_run *r, motus_error *err)
{
    const motus_system *s = r->system;
    const size_t nx = s->positions, nv = s->velocities;
    double *x = take(&r->allocator, nx + nv + 1, sizeof *x), *v = x + nx;
    if (!x) return fail(err, MOTUS_MEMORY, "no memory for the run");
    motus_status status = run_state(r, x, v, err);
    companion_move(x, nx, NULL, 0);
    companion_move(v, nv, NULL, (uint32_t)nx);
    if (status == MOTUS_OK) status = run_set_state(r, r->timing.t0, x, v, err);
    give(&r->allocator, x);
    return status;
}

static double distance(const motus_run *a, const double *of_a, const double *of_b, bool absolute)
{
    const motus_system *s = a->system;
    const differences *f = &a->bars->differences;
    double most = 0;
    for (size_t k = 0; k < s->positions + s->velocities; k++) {
        const int group = k < s->positions ? 0 : k < 2 * s->positions ? 1 : 2;
        const double far = fabs(of_a[k] - of_b[k]), scale = absolute ? 1 : f->scale[group];
        if (!(far <= INFINITY)) return NAN;
        if (scale > 0) most = fmax(most, far / scale);
    }
    return most;
}

/* Finds how far another run ends from this one; NaN: it does not come to its end. */
static motus_status other_run(motus_system *s, const motus_run_def *def, motus_run *run, bool moved, bool absolute,
                              double *far, motus_error *err)
{
    const size_t count = run->system->positions + run->system->velocities, nx = run->system->positions;
    const run_hint hint = {.steps = (double)run_steps(run)};
    motus_error why = motus_default_error();
    motus_run *r = NULL;
    double *numbers = take(&run->allocator, 2 * count + 1, sizeof *numbers);
    *far = NAN;
    if (!numbers) return fail(err, MOTUS_MEMORY, "no memory for the run");
    motus_run_def like = *def;
    like.error = MOTUS_BARS_NONE;
    motus_status status = run_create(s, &like, &hint, &r, &why);
    if (status == MOTUS_OK && moved) status = move_start(r, &why);
    while (status == MOTUS_OK && !r->arrived) status = run_step(r, CHUNK, &why);
    if (status == MOTUS_OK) status = run_state(r, numbers, numbers + nx, &why);
    if (status == MOTUS_OK) status = run_state(run, numbers + count, numbers + count + nx, &why);
    if (status == MOTUS_OK) *far = distance(run, numbers + count, numbers, absolute);
    run_destroy(r);
    give(&run->allocator, numbers);
    if (status == MOTUS_OK || (status != MOTUS_CANCELLED && status != MOTUS_MEMORY)) return MOTUS_OK;
    return fail(err, status, "%s", why.message);
}

motus_status decimals_part(const motus_run_def *def, motus_run *run, bool absolute, double *part, motus_error *err)
{
    double decimals, rounding;
    motus_system *shadow = NULL;
    *part = NAN;
    if (!run->system->model || !run->bars) return MOTUS_OK;
    motus_status status = shadow_create(run->system, NULL, &shadow, err);
    if (status == MOTUS_OK) status = other_run(shadow, def, run, false, absolute, &decimals, err);
    if (status == MOTUS_OK) status = other_run(run->system, def, run, true, absolute, &rounding, err);
    if (status == MOTUS_OK && decimals > CLEARLY * rounding) *part = decimals;
    motus_system_destroy(shadow);
    return status;
}
