/* See linear.h. */
#include "api/system/linear.h"
#include "api/system/vector.h"

#include <math.h>
#include <string.h>

#define OFFSET 1e-5 /* of difference quotients, in units of the size */
#define ROUNDING_EXACT 1e-13
#define ROUNDING_QUOTIENT 1e-8

size_t linear_room(const problem *p) { return 3 * p->nx + 5 * p->nv; }

void linear_place(linear *l, const problem *p, double *room)
{
    const size_t nx = p->nx, nv = p->nv;
    l->problem = p;
    l->x = room, l->moved_x = l->x + nx, l->dx = l->moved_x + nx;
    l->v = l->dx + nx, l->moved_v = l->v + nv, l->dv = l->moved_v + nv, l->a = l->dv + nv, l->other = l->a + nv;
}

double linear_rounding(const problem *p) { return p->jvp ? ROUNDING_EXACT : ROUNDING_QUOTIENT; }

size_t linear_positions(const problem *p) { return p->nx - p->modes; }

bool linear_evaluate(linear *l, double t, bool moved, double *a)
{
    const problem *p = l->problem;
    if (!moved) {
        if (p->nx) memcpy(l->moved_x, l->x, p->nx * sizeof *l->x);
        memcpy(l->moved_v, l->v, p->nv * sizeof *l->v);
    }
    memset(a, 0, p->nv * sizeof *a);
    if (p->refresh) p->refresh(p->ctx, t, l->moved_x, l->moved_v);
    if (p->accel(p->ctx, t, l->moved_x, l->moved_v, a)) l->failed = true;
    return !l->failed && isfinite(vector_largest(a, p->nv));
}

static bool quotient(linear *l)
{
    const problem *p = l->problem;
    for (int side = 0; side < 2; side++) {
        const double by = side ? -OFFSET : OFFSET;
        for (size_t k = 0; k < p->nx; k++) l->moved_x[k] = l->x[k] + by * l->dx[k];
        for (size_t k = 0; k < p->nv; k++) l->moved_v[k] = l->v[k] + by * l->dv[k];
        if (!linear_evaluate(l, l->t, true, side ? l->other : l->a)) return false;
    }
    for (size_t k = 0; k < p->nv; k++) l->a[k] = (l->a[k] - l->other[k]) / (2 * OFFSET);
    return true;
}

bool linear_product(void *ctx, const double *u, double *out)
{
    linear *l = ctx;
    const problem *p = l->problem;
    const size_t moving = linear_positions(p);
    for (size_t k = 0; k < p->nx; k++) l->dx[k] = k < moving ? l->size_x * u[k] : 0;
    for (size_t k = 0; k < p->nv; k++) l->dv[k] = k < moving || k >= p->nx ? l->size_v * u[p->nx + k] : 0;
    memset(l->a, 0, p->nv * sizeof *l->a);
    if (p->jvp && p->jvp(p->ctx, l->t, l->x, l->v, l->dx, l->dv, l->a)) {
        *(p->returned ? &l->failed : &l->no_memory) = true;
        return false;
    }
    if (!p->jvp && !quotient(l)) return false;
    for (size_t k = 0; k < p->nx; k++) out[k] = l->dv[k] / l->size_x;
    for (size_t k = 0; k < p->nv; k++) out[p->nx + k] = l->a[k] / l->size_v;
    return isfinite(vector_largest(out, p->nx + p->nv));
}

void linear_rates_of(linear *l, double *basis, linear_rates *out)
{
    const problem *p = l->problem;
    const size_t n = p->nx + p->nv;
    const rate_map map = {n, linear_product, l};
    const double rate = rate_fastest(&map, basis, basis + n);
    double most = isfinite(rate) ? rate : 0;
    /* Position and velocity of the fastest oscillation get equal sizes, so that no root is lost beside the others. */
    if (most > 0 && p->nx) l->size_v = most * l->size_x;
    /* The space is that of the motion's direction, (v, a); at rest, of a scattered one. */
    for (size_t k = 0; k < p->nx; k++) basis[k] = l->v[k] / l->size_x;
    const bool moves =
        linear_evaluate(l, l->t, false, l->a) && (vector_largest(l->a, p->nv) > 0 || vector_largest(basis, p->nx) > 0);
    for (size_t k = 0; k < p->nv; k++) basis[p->nx + k] = l->a[k] / l->size_v;
    for (size_t k = 0; k < n && !moves; k++) basis[k] = rate_scatter(k);
    out->count = rate_motion(&map, linear_rounding(p), basis, out->re, out->im);
    for (int k = 0; k < out->count; k++) most = fmax(most, sqrt(out->re[k] * out->re[k] + out->im[k] * out->im[k]));
    out->fastest = most;
}
