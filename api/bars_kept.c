/* What a restart state has of a run's bars of error: where the companions stand, and what they were lately. See bars.h.
 *
 * So the bars of a run that was restored cover its errors from the very start. The companion goes on from its state, to
 * the rounding of its numbers; a twin goes on likewise, but not after a shorter last step that a restored run does
 * not take.
 */
#include "api/bars.h"

#include <math.h>
#include <string.h>

enum { LANDED, TWIN, HEAD }; /* the time of the last landing; 1: there is a twin; then the states */

static size_t count_of(const motus_run *r, bool twin)
{
    const bars *b = r->bars;
    const problem *p = &r->system->problem;
    differences_shape shape = b->differences.shape;
    shape.full = twin;
    return HEAD + (p->nx + p->nv) * (1 + (size_t)twin) + differences_kept(&shape);
}

/* A companion that has left the finite numbers serves no more. */
static double *put_state(double *at, const motus_run *r, const companion *c)
{
    const problem *p = &r->system->problem;
    for (size_t k = 0; k < p->nx; k++) *at++ = isfinite(c->x[k]) ? c->x[k] : 0;
    for (size_t k = 0; k < p->nv; k++) *at++ = isfinite(c->v[k]) ? c->v[k] : 0;
    return at;
}

motus_status bars_keep(motus_run *r, double t, double **numbers, size_t *count, motus_error *err)
{
    *numbers = NULL;
    *count = 0;
    if (!r->bars) return MOTUS_OK;
    motus_status status = bars_land(r, err);
    const bars *b = r->bars;
    if (status != MOTUS_OK || b->why[0]) return status;
    differences seen = b->differences;
    const bool twin = seen.twin && (row_adaptive(&r->chosen) || t == motus_run_time(r));
    if (!twin) seen.twin = NULL;
    const size_t all = count_of(r, twin);
    double *out = take(&r->allocator, all, sizeof *out);
    if (!out) return fail(err, MOTUS_MEMORY, "no memory for the restart state");
    out[LANDED] = b->landed;
    out[TWIN] = twin;
    double *at = put_state(out + HEAD, r, &b->half);
    if (twin) at = put_state(at, r, &b->twin);
    if (!differences_keep(&seen, at)) {
        give(&r->allocator, out);
        return MOTUS_OK;
    }
    *numbers = out;
    *count = all;
    return MOTUS_OK;
}

bool bars_resume(motus_run *r, double *numbers, size_t count)
{
    bars *b = r->bars;
    if (count < HEAD || (numbers[TWIN] != 0 && numbers[TWIN] != 1)) return false;
    if (count != count_of(r, numbers[TWIN] != 0)) return false;
    bars_again(r, true);
    b->resumed = numbers;
    return true;
}

static motus_status begin(motus_run *r, companion *c, const double **at, motus_error *err)
{
    const problem *p = &r->system->problem;
    const double t = r->bars->landed;
    memcpy(r->mid_x, *at, p->nx * sizeof(double));
    memcpy(r->mid_v, *at + p->nx, p->nv * sizeof(double));
    *at += p->nx + p->nv;
    if (p->refresh) p->refresh(p->ctx, t, r->mid_x, r->mid_v);
    motus_status status = companion_begin(c, r, t, r->mid_x, r->mid_v, err);
    c->before = motus_run_steps(r);
    return status;
}

motus_status bars_kept_begin(motus_run *r, const double *x, const double *v, motus_error *err)
{
    bars *b = r->bars;
    differences *f = &b->differences;
    double *const kept = b->resumed, t = stepper_time(r->stepper);
    const double *at = kept + HEAD;
    const problem *p = &r->system->problem;
    b->resumed = NULL;
    b->landed = kept[LANDED];
    b->steps = motus_run_steps(r);
    b->ahead = b->landed != t;
    const bool twin = kept[TWIN] != 0 && b->kind == MOTUS_BARS_FULL;
    motus_status status = begin(r, &b->half, &at, err);
    if (status == MOTUS_OK && twin) status = begin(r, &b->twin, &at, err);
    if (!twin && kept[TWIN] != 0) at += p->nx + p->nv;
    if (!twin) { /* the state has none: the bars are those of one companion */
        b->kind = MOTUS_BARS_CHEAP;
        f->twin = NULL;
    }
    differences_begin(f, r->timing.t0, r->timing.until);
    differences_resume(f, b->landed, at);
    give(&r->allocator, kept);
    memcpy(r->mid_x, x, p->nx * sizeof *x);
    memcpy(r->mid_v, v, p->nv * sizeof *v);
    if (status == MOTUS_OK && b->ahead) return bars_see(r, r->system, t, r->mid_x, r->mid_v, 0, err);
    return status == MOTUS_OK ? bars_take(r, t, r->mid_x, r->mid_v, false, err) : status;
}
