/* The exact motion at one time, beside the force there. See verify.h. */
#include "lang/read/verify.h"

#include <math.h>
#include <string.h>

static bool bind(const model *m)
{
    const verify *c = m->verify;
    tape *const tapes[] = {c->motion,          c->motion_rounding, c->second,
                           c->second_rounding, c->boundary,        c->force_rounding};
    return verify_bind(m, tapes, sizeof tapes / sizeof *tapes);
}

bool verify_sample_take(model *m, verify_sample *s)
{
    enum { ARRAYS = 12 }; /* room has the last ones */
    const size_t n = m->nv + 1;
    double *const all = bind(m) ? take(&m->arena->allocator, ARRAYS * n, sizeof *all) : NULL;
    double **const arrays[] = {&s->x, &s->v, &s->e, &s->a, &s->of_x, &s->of_v, &s->of_a, &s->of_e, &s->room};
    if (!all) return false;
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) *arrays[k] = all + k * n;
    return true;
}

void verify_sample_move(const model *m, verify_sample *s, double t)
{
    const verify *c = m->verify;
    double *motion[SPACES] = {[SPACE_X] = s->x, [SPACE_V] = s->v};
    s->t = t;
    memcpy(s->x, m->x0, m->nx * sizeof *s->x);
    memcpy(s->v, m->v0, m->nv * sizeof *s->v);
    tape_run(c->motion, s->t, motion);
    if (c->boundary) tape_run(c->boundary, s->t, motion);
}

void verify_sample_bound(const model *m, verify_sample *s)
{
    const verify *c = m->verify;
    verify_size(m, verify_fastest(m, s->t, s->x, s->v, s->room), s->x, s->v, s->of_x, s->of_v);
    if (!c->motion_rounding) return;
    double *x = s->room, *v = x + m->nv, *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v};
    for (size_t k = 0; k < m->nv; k++) x[k] = v[k] = 0;
    tape_run(c->motion_rounding, s->t, base);
    for (size_t k = 0; k < m->nx; k++) s->of_x[k] += x[k];
    for (size_t k = 0; k < m->nv; k++) s->of_v[k] += v[k];
}

static void accelerate(const model *m, verify_sample *s)
{
    const verify *c = m->verify;
    double *second[SPACES] = {[SPACE_A] = s->e}, *rounded[SPACES] = {[SPACE_A] = s->of_e},
           *force[SPACES] = {
               [SPACE_X] = s->x, [SPACE_V] = s->v, [SPACE_A] = s->of_a, [SPACE_DX] = s->of_x, [SPACE_DV] = s->of_v};
    verify_force(m, s->t, s->x, s->v, s->a);
    for (size_t k = 0; k < m->nv; k++) s->e[k] = s->of_a[k] = s->of_e[k] = 0;
    tape_run(c->second, s->t, second);
    if (c->second_rounding) {
        tape_run(c->second_rounding, s->t, rounded);
        tape_run(c->force_rounding, s->t, force);
        return;
    }
    double most = 0;
    for (size_t k = 0; k < m->nv; k++) most = fmax(most, fabs(s->a[k]) + fabs(s->e[k]));
    for (size_t k = 0; k < m->nv; k++) s->of_a[k] = 1e5 * most;
}

size_t verify_sample_differs(const double *is, const double *due, const double *of, const double *more, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        const double allowed = EXACT_ROUNDING * (of[k] + (more ? more[k] : 0));
        if (!isfinite(is[k]) || !isfinite(due[k]) || fabs(is[k] - due[k]) > allowed) return k;
    }
    return n;
}

size_t verify_sample_at(const model *m, verify_sample *s, double t)
{
    verify_sample_move(m, s, t);
    verify_sample_bound(m, s);
    accelerate(m, s);
    return verify_sample_differs(s->e, s->a, s->of_a, s->of_e, m->nv);
}

bool verify_exact_rounding(model *m, double t, double *x, double *v)
{
    verify_sample s;
    if (!verify_sample_take(m, &s)) return false;
    verify_sample_move(m, &s, t);
    verify_sample_bound(m, &s);
    memcpy(x, s.of_x, m->nx * sizeof *x);
    memcpy(v, s.of_v, m->nv * sizeof *v);
    give(&m->arena->allocator, s.x);
    return true;
}
