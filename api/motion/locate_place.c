/* States of a resolving run, trial steps between them, and where in a step an argument leaves its side. See
 * locate_parts.h. */
#include "api/motion/locate_parts.h"

#include <math.h>
#include <string.h>

size_t locate_numbers(const problem *p, size_t count) { return p->nx + 2 * p->nv + count; }

void locate_copy(place *to, const place *from, const problem *p, size_t count)
{
    to->t = from->t;
    memcpy(to->x, from->x, locate_numbers(p, count) * sizeof(double));
}

void locate_swap(place *p, place *q)
{
    const place kept = *p;
    *p = *q;
    *q = kept;
}

motus_status locate_observe(motus_run *r, place *at, motus_error *err)
{
    locate *l = r->locate;
    for (size_t k = 0; k < l->problem.nv; k++) at->a[k] = 0; /* of cells without an equation, too */
    const motus_status status = stepper_sync(r->stepper, at->x, at->v, at->a, err);
    if (status != MOTUS_OK) return status;
    at->t = stepper_time(r->stepper);
    held_values(l->held, at->t, at->x, at->v, at->u);
    return MOTUS_OK;
}

bool locate_accelerate(const locate *l, place *at)
{
    const problem *p = &l->problem;
    for (size_t k = 0; k < p->nv; k++) at->a[k] = 0;
    return p->accel(p->ctx, at->t, at->x, at->v, at->a) == 0;
}

motus_status locate_try(motus_run *r, const place *from, double h, place *to, motus_error *err)
{
    r->locate->away = true;
    motus_status status = stepper_start(r->stepper, from->t, h, from->x, from->v, err);
    if (status == MOTUS_OK) status = stepper_advance(r->stepper, (stepper_limit){1, NAN}, NULL, err);
    return status == MOTUS_OK ? locate_observe(r, to, err) : status;
}

double locate_gap(const locate *l, size_t k, const place *at)
{
    return switches_gap(held_operation(l->held, k), l->side[k], at->u[k]) + l->slack[k];
}

double locate_least_gap(const locate *l, const place *at, const double *size)
{
    double least = INFINITY;
    for (size_t k = 0; k < l->count; k++) {
        const double g = locate_gap(l, k, at) / (size ? size[k] : 1);
        if (g < least) least = g;
    }
    return least;
}

void locate_follow(const problem *p, const place *at, double way, double *x, double *v)
{
    for (size_t k = 0; k < p->nv; k++) {
        if (k < p->nx) x[k] = at->x[k] + way * (at->v[k] + way / 2 * at->a[k]);
        v[k] = at->v[k] + way * at->a[k];
    }
}

/* Shortens the step of size *h from `from` until it ends just beyond the first root, at `to`. failed: the whole step
 * failed, and `to` is not known. Uses Illinois' method on the least gap, with bisections now and then. *failed
 * afterwards: steps beyond the root fail; `to` is then the last state before it. */
motus_status locate_root(motus_run *r, double *h, bool *failed, motus_error *err)
{
    locate *l = r->locate;
    const place *from = &l->from;
    const double whole = *h;
    for (size_t k = 0; k < l->count; k++) {
        l->size[k] = fmax(fabs(locate_gap(l, k, from)), *failed ? 0 : fabs(locate_gap(l, k, &l->to)));
        if (!(l->size[k] > 0)) l->size[k] = 1;
    }
    double low = 0, high = 1, at_low = fmax(locate_least_gap(l, from, l->size), 0);
    double at_high = *failed ? NAN : locate_least_gap(l, &l->to, l->size);
    int moved = 0; /* which end moved last: an end that stays twice has its value halved */
    for (int turn = 0; turn < LOCATE_HALVINGS_MAX && high - low > 0x1p-51 * high && high > 0x1p-50; turn++) {
        if (fabs((high - low) * whole) <= 0x1p-54 * fabs(from->t)) break;
        double z = high - at_high * (high - low) / (at_high - at_low);
        if (*failed || turn % 4 == 3 || !(z > low && z < high)) z = 0.5 * (low + high);
        if (from->t + z * whole == from->t) {
            low = z;
            continue;
        }
        const motus_status status = locate_try(r, from, z * whole, &l->beyond, err);
        if (status == MOTUS_MEMORY) return status;
        const double g = status == MOTUS_OK ? locate_least_gap(l, &l->beyond, l->size) : NAN;
        if (g >= 0) {
            low = z;
            at_low = g;
            if (moved < 0) at_high /= 2;
            moved = -1;
            continue;
        }
        high = z;
        *failed = status != MOTUS_OK;
        at_high = g;
        if (moved > 0) at_low /= 2;
        moved = 1;
        if (!*failed) locate_swap(&l->to, &l->beyond);
    }
    *h = (*failed ? low : high) * whole;
    if (!*failed) return MOTUS_OK;
    if (from->t + *h != from->t) return locate_try(r, from, *h, &l->to, err);
    locate_copy(&l->to, from, &l->problem, l->count);
    return MOTUS_OK;
}
