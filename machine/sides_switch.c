/* One switch: its side and its parts, what follows it, what its tapes say, and how it is refused. See sides_parts.h. */
#include "machine/sides_parts.h"

#include "base/decimal.h"

#include <math.h>
#include <string.h>

void sides_evaluate(const sides *s, tape *t, double time, double *x, double *v, double *a, double *out)
{
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a, [SPACE_OUT] = out};
    for (size_t k = 0; k < s->switches->count; k++) out[k] = NAN; /* cells outside the ranges are written by none */
    tape_run(t, time, base);
}

static bool compares(operation op) { return op == OP_LT || op == OP_LE || op == OP_GT || op == OP_GE; }

double sides_side_of(const sides *s, size_t k, int way) { return switches_side(sides_op_of(s, k), way, 0); }

size_t sides_first_of(const sides *s, size_t k)
{
    const switches *w = s->switches;
    if (!w->shared) return k;
    const size_t kind = switches_kind(w, k);
    return w->first[w->as[kind]] + (k - w->first[kind]);
}

parts sides_parts_of(const sides *s, size_t k)
{
    const switches *w = s->switches;
    parts p = {.count = 0};
    if (!switches_directs(sides_op_of(s, k))) return p;
    const size_t kind = switches_kind(w, k), cell = k - w->first[kind], first = w->leader[kind];
    for (; p.count < w->parts[kind]; p.count++) p.of[p.count] = w->first[first + (size_t)p.count] + cell;
    return p;
}

bool sides_silent(const sides *s, size_t k)
{
    if (!switches_directs(sides_op_of(s, k))) return sides_follows(s, k);
    const size_t kind = switches_kind(s->switches, k);
    return s->switches->leader[kind] != kind;
}

void sides_put(const sides *s, double *side, size_t k, double value)
{
    const switches *w = s->switches;
    const size_t kind = switches_kind(w, k), cell = k - w->first[kind];
    side[k] = value;
    if (!w->shared) return;
    const bool held = sides_is_held(s, side, k);
    const double way = compares(sides_op_of(s, k)) ? (value == sides_side_of(s, k, 1) ? 1 : -1) : value;
    for (size_t j = kind + 1; j < w->kinds; j++) {
        const size_t n = w->first[j] + cell;
        if (w->as[j] != kind) continue;
        const double own = w->turned[j] * way;
        side[n] = held ? value : sides_op_of(s, n) == OP_SIGN ? own : switches_side(sides_op_of(s, n), own, 0);
    }
}

bool sides_chooses(const sides *s, size_t k)
{
    const switches *w = s->switches;
    const size_t kind = switches_kind(w, k);
    bool any = false;
    for (size_t j = kind; j < w->kinds; j++) any |= w->as[j] == kind && compares(sides_op_of(s, w->first[j]));
    return any;
}

void sides_measure_hold(const sides *s, double t, double *x, double *v)
{
    sides_evaluate(s, s->hold, t, x, v, NULL, s->p), sides_evaluate(s, s->grip, t, x, v, NULL, s->r);
    for (size_t k = 0; k < s->switches->count; k++)
        if (switches_directs(sides_op_of(s, k)) && isnan(s->p[k]) && s->r[k] == 0) s->p[k] = 0;
}

double sides_along(const parts *p, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < p->count; i++) sum += a[p->of[i]] * b[p->of[i]];
    return sum;
}

void sides_print(const sides *s, size_t k, char *out, size_t size)
{
    switches_surface(s->model, s->switches->original[switches_kind(s->switches, k)], out, size);
}

motus_status sides_refuse(const sides *s, size_t k, const char *what, double t, motus_error *err)
{
    char text[120], at[DECIMAL_MAX];
    sides_print(s, k, text, sizeof text);
    fail(err, MOTUS_SOLVE, "%s where %s, at t = %s", what, text, decimal(t, at));
    if (switches_directs(sides_op_of(s, k)))
        hint(err, "let the run end before; or smooth the jump, r'/sqrt(|r'|^2 + 0.001^2) for r'/|r'|");
    else
        hint(err, "let the run end before; or smooth the jump, tanh(x'/0.001) for sign(x')");
    if (err) err->time = t, err->cause = MOTUS_CAUSE_DISCONTINUOUS;
    return MOTUS_SOLVE;
}

motus_status sides_accelerate(sides *s, double t, double *x, double *v, motus_error *err)
{
    char at[DECIMAL_MAX];
    memset(s->a, 0, s->problem->nv * sizeof *s->a);
    if (!s->problem->accel(s->problem->ctx, t, x, v, s->a)) return MOTUS_OK;
    fail(err, MOTUS_CALLBACK, "the acceleration cannot be evaluated at t = %s", decimal(t, at));
    if (err) err->time = t;
    return MOTUS_CALLBACK;
}
