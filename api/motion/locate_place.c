/* States of a located run, and trial steps between them. See locate_parts.h. */
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
