/* A number compared with a sum may differ by the rounding of its terms: 16 roundings, relative to their sizes. Slopes
 * of explicit stages and kicks must be the acceleration to the bit; those of a solved equation, to some roundings of
 * the largest. */
#include "api/system/system.h"
#include "core/rows.h"

#include "test/trace_replay.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define ROUNDINGS 16
/* of the solution of an equation, whose residual is rounded term by term */
#define SOLVED (256 * DBL_EPSILON)

typedef struct step {
    const motus_system *system;
    const char *what, *method;
    const motus_trace_entry *entry, *start, *end;
    size_t count, nx, nv;
    double h;
    double *a; /* room of nv */
    /* of a compensated splitting: what one of its kicks or drifts takes so that they add up to h, in units of h: what
     * the row's digits lack of 1, and their roundings */
    double fit;
    bool apart; /* positions do not follow the tableau of the velocities: newmark, Nyström, Radau */
} step;

#define broken(s, ...)                                                                             \
    (print_error("%s, %s: ", (s)->what, (s)->method), print_error(__VA_ARGS__), print_error("\n"), \
     _fail(__FILE__, __LINE__))

/* ---- sums ---- */

typedef struct sum {
    long double value, size;
} sum;

static void add(sum *s, double c, double y)
{
    s->value += (long double)c * y;
    s->size += fabsl((long double)c * y);
}

static void reaches(const step *s, const char *name, size_t k, double got, sum expected, double extra)
{
    const long double off = fabsl(got - expected.value), margin = ROUNDINGS * (DBL_EPSILON / 2) * expected.size + extra;
    if (!(off <= margin))
        broken(s, "%s, number %zu, is %.17g and not %.17Lg: off by %.3Lg, not %.3Lg", name, k, got, expected.value, off,
               margin);
}

/* ---- slopes ---- */

static void acceleration(const step *s, double t, const double *x, const double *v)
{
    const problem *p = &s->system->problem;
    double *inner = calloc(p->nx + 2 * p->nv + 1, sizeof *inner);
    assert_non_null(inner);
    memcpy(inner, s->system->x0, p->nx * sizeof *inner);
    memcpy(inner + p->nx, s->system->v0, p->nv * sizeof *inner);
    system_inside(s->system, x, v, inner, inner + p->nx);
    assert_int_equal(p->accel(p->ctx, t, inner, inner + p->nx, inner + p->nx + p->nv), 0);
    system_outside(s->system, NULL, inner + p->nx + p->nv, NULL, s->a);
    free(inner);
}

static void is_slope(const step *s, const motus_trace_entry *e, const double *x, const double *v, double margin)
{
    double largest = 0;
    assert_non_null(e->a);
    acceleration(s, e->time, x, v);
    for (size_t k = 0; k < s->nv; k++) largest = fmax(largest, fabs(s->a[k]));
    /* a quadrature's rates may be means of several */
    const size_t count = s->system->problem.traits.quadrature && e->kind == MOTUS_TRACE_KICK ? s->nx : s->nv;
    for (size_t k = 0; k < count; k++)
        if (margin ? !(fabs(s->a[k] - e->a[k]) <= margin * largest) : s->a[k] != e->a[k])
            broken(s, "slope %zu of stage %d is %.17g, and the acceleration there %.17g", k, e->stage, e->a[k],
                   s->a[k]);
}

static void same(const step *s, const char *name, const double *a, const double *b, size_t n)
{
    assert_true(a && b);
    for (size_t k = 0; k < n; k++)
        if (memcmp(&a[k], &b[k], sizeof *a)) broken(s, "%s, number %zu: %.17g and %.17g", name, k, a[k], b[k]);
}

/* ---- kicks and drifts ---- */

static void kick(const step *s, const motus_trace_entry *e)
{
    const double *before = e[-1].v;
    same(s, "positions before and after a kick", e->x, e[-1].x, s->nx);
    for (size_t k = 0; k < s->nv; k++) {
        sum v = {0};
        add(&v, 1, before[k]);
        add(&v, e->coefficient * s->h, e->a[k]);
        reaches(s, "the velocity after a kick", k, e->v[k], v, s->fit * fabs(s->h * e->a[k]));
    }
    double *mean = calloc(s->nv + 1, sizeof *mean);
    assert_non_null(mean);
    for (size_t k = 0; k < s->nv; k++) mean[k] = (before[k] + e->v[k]) / 2;
    is_slope(s, e, e->x, mean, s->system->problem.traits.velocity ? SOLVED : 0);
    free(mean);
}

static void drift(const step *s, const motus_trace_entry *e)
{
    same(s, "velocities before and after a drift", e->v, e[-1].v, s->nv);
    for (size_t k = 0; k < s->nx; k++) {
        sum x = {0};
        add(&x, 1, e[-1].x[k]);
        add(&x, e->coefficient * s->h, e->v[k]);
        reaches(s, "the position after a drift", k, e->x[k], x, s->fit * fabs(s->h * e->v[k]));
    }
}

static double fit_of(const step *s, const motus_method *m)
{
    chosen c;
    sum kicks = {0}, drifts = {0};
    if (row_choose(m->name, &c, NULL, NULL) || !c.row->compensated) return 0;
    for (const motus_trace_entry *e = s->start + 1; e < s->end; e++)
        add(e->kind == MOTUS_TRACE_KICK ? &kicks : &drifts, 1, e->coefficient);
    const long double most = fmaxl(fabsl(kicks.value - 1), fabsl(drifts.value - 1));
    return (double)(most + DBL_EPSILON * fmaxl(kicks.size, drifts.size));
}

static void splitting(step *s, const motus_method *m)
{
    sum kicks = {0}, drifts = {0};
    int count = 0;
    s->fit = fit_of(s, m);
    for (const motus_trace_entry *e = s->start + 1; e < s->end; e++) {
        assert_true(e->kind == MOTUS_TRACE_KICK || e->kind == MOTUS_TRACE_DRIFT);
        sum time = {0};
        if (e->kind == MOTUS_TRACE_KICK) {
            kick(s, e);
            add(&kicks, 1, e->coefficient);
            count++;
        } else {
            drift(s, e);
            add(&drifts, 1, e->coefficient);
        }
        add(&time, 1, s->start->time);
        add(&time, (double)drifts.value, s->h);
        time.size += fabsl(s->h);
        reaches(s, "the time to which the drifts have come", (size_t)(e - s->start), e->time, time, 0);
    }
    sum one = {.value = 1, .size = 8};
    reaches(s, "the sum of the kicks", 0, (double)kicks.value, one, 0);
    reaches(s, "the sum of the drifts", 0, (double)drifts.value, one, 0);
    /* The last kick uses the acceleration with which the next step begins. Where steps adapt the force is evaluated
     * twice more, and a third time where no kick has its value at the start. */
    const bool closes = s->start[1].kind == MOTUS_TRACE_KICK && s->end[-1].kind == MOTUS_TRACE_KICK;
    const int others = m->evaluations - (count - closes);
    assert_true(m->adaptive ? others == 2 || others == 3 : others == 0);
    same(s, "positions at the end", s->end[-1].x, s->end->x, s->nx);
    for (size_t k = 0; k < s->nv; k++) {
        sum v = {0};
        add(&v, 1, s->end[-1].v[k]);
        reaches(s, "the velocity at the end", k, s->end->v[k], v, 0);
    }
}

/* ---- stages ---- */

/* What rounded weights lack of their sum `whole`, which compensated rows add to the first stage. */
static void residual(sum *out, double whole, const double *weights, int stages, double first)
{
    long double missing = whole;
    for (int j = 0; j < stages; j++) missing -= weights[j];
    add(out, (double)missing, first);
}

/* x₀ + c h v₀ + h² Σ row_x[j] a[j], and, where the positions follow the velocities' tableau, x₀ + h Σ row[j] v[j]. */
static void position(const step *s, const char *name, const double *x, double c, const double *row, const double *row_x,
                     const motus_trace_entry *stage, int stages, double whole)
{
    for (size_t k = 0; k < s->nx; k++) {
        sum by_v = {0}, by_a = {0};
        double rows = 1; /* the velocities of stages are rounded too, and multiplied by these */
        add(&by_v, 1, s->start->x[k]);
        add(&by_a, 1, s->start->x[k]);
        add(&by_a, c * s->h, s->start->v[k]);
        for (int j = 0; j < stages; j++) {
            rows += fabs(row[j]);
            add(&by_v, row[j] * s->h, stage[j].v[k]);
            add(&by_a, row_x[j] * s->h * s->h, stage[j].a[k]);
        }
        by_a.size += by_v.size;
        if (whole > 0) residual(&by_a, whole, row_x, stages, s->h * s->h * stage[0].a[k]);
        if (!s->apart) reaches(s, name, k, x[k], by_v, (double)by_a.size * rows * ROUNDINGS * DBL_EPSILON / 2);
        reaches(s, name, k, x[k], by_a, 0);
    }
}

static void velocity(const step *s, const char *name, const double *v, const double *row,
                     const motus_trace_entry *stage, int stages, double whole)
{
    for (size_t k = 0; k < s->nv; k++) {
        sum sum = {0};
        add(&sum, 1, s->start->v[k]);
        for (int j = 0; j < stages; j++) add(&sum, row[j] * s->h, stage[j].a[k]);
        if (whole > 0) residual(&sum, whole, row, stages, s->h * stage[0].a[k]);
        reaches(s, name, k, v[k], sum, 0);
    }
}

enum { STAGES_MAX = 24 };
static void tableau(const step *s, const motus_method *m, bool implicit)
{
    const motus_trace_entry *stage = s->start + 1 + implicit;
    const int stages = m->stages;
    assert_int_equal(s->count, 2 + implicit + stages);
    if (implicit) assert_int_equal(s->start[1].kind, MOTUS_TRACE_SOLVE);
    if (implicit) assert_true(s->start[1].iterations > 0);
    double b[STAGES_MAX], bb[STAGES_MAX], products = 0;
    sum weights = {0}, weights_x = {0};
    assert_true(stages <= STAGES_MAX);
    for (int i = 0; i < stages; i++) {
        const motus_trace_entry *e = &stage[i];
        assert_int_equal(e->kind, MOTUS_TRACE_STAGE);
        assert_int_equal(e->stages, stages);
        add(&weights, 1, b[i] = e->weight);
        add(&weights_x, 1, bb[i] = e->weight_x);
        sum node = {0}, time = {0};
        for (int j = 0; j < stages; j++) add(&node, 1, e->row[j]), products += fabs(e->weight * e->row[j]);
        if (m->forces == MOTUS_FORCES_XVT) /* else no velocity is formed at a stage */
            reaches(s, "the node of a stage", (size_t)i, e->coefficient, node, DBL_EPSILON);
        add(&time, 1, s->start->time);
        add(&time, e->coefficient, s->h);
        reaches(s, "the time of a stage", (size_t)i, e->time, time, 0);
        position(s, "the position of a stage", e->x, e->coefficient, e->row, e->row_x, stage, stages, 0);
        velocity(s, "the velocity of a stage", e->v, e->row, stage, stages, 0);
        is_slope(s, e, e->x, e->v, implicit ? SOLVED : 0);
    }
    reaches(s, "the sum of the weights", 0, 1, weights, DBL_EPSILON);
    /* every weight of positions is a sum of products of two rounded numbers */
    if (m->order > 1)
        reaches(s, "the sum of the weights of positions", 0, 0.5, weights_x, DBL_EPSILON * (1 + products));
    position(s, "the position at the end", s->end->x, 1, b, bb, stage, stages, m->adaptive ? 0.5 : 0);
    velocity(s, "the velocity at the end", s->end->v, b, stage, stages, m->adaptive ? 1 : 0);
}

/* ---- recurrences ---- */

static void stormer(const step *s, const motus_trace_entry *e, const double *before_x)
{
    const bool first = e->kind == MOTUS_TRACE_TAYLOR, literal = !strcmp(s->method, "verlet-literal");
    assert_int_equal(first, before_x == NULL);
    assert_int_equal(first, e->before_x == NULL);
    /* verlet-literal's velocities are differences of positions, and its first-order variables differences of
     * integrals since the start: this is the rounding of these, and so of the velocities at which accelerations are
     * evaluated. */
    double around = 0;
    for (size_t k = 0; literal && k < s->nv; k++)
        around = fmax(around, ROUNDINGS * DBL_EPSILON *
                                  ((k < s->nx ? fabs(e->x[k]) : 0) + (fabs(e->time) + 1) * fabs(e->v[k])) / fabs(s->h));
    for (size_t k = 0; k < s->nv; k++) {
        sum x = {0}, v = {0}, end = {0};
        if (k < s->nx) {
            if (first) {
                add(&x, 1, s->start->x[k]);
                add(&x, s->h, s->start->v[k]);
                add(&x, s->h * s->h / 2, e->a[k]);
            } else {
                add(&x, 2, s->start->x[k]);
                add(&x, -1, e->before_x[k]);
                add(&x, s->h * s->h, e->a[k]);
                sum kept = {.value = before_x[k], .size = fabsl((long double)before_x[k]) + fabs(s->start->x[k])};
                reaches(s, "the position of the step before", k, e->before_x[k], kept, 0);
            }
            reaches(s, "the position of the recurrence", k, e->x[k], x, 0);
        }
        add(&v, 1, s->start->v[k]);
        add(&v, s->h / 2, e->a[k]);
        reaches(s, "the velocity in the middle", k, e->v[k], v, around);
        add(&end, 1, e->v[k]);
        add(&end, s->h / 2, s->end->a[k]);
        reaches(s, "the velocity at the end", k, s->end->v[k], end, around);
    }
}

static void beeman(const step *s, const motus_trace_entry *e, const double *before_a)
{
    assert_int_equal(e->kind, MOTUS_TRACE_STEP);
    same(s, "the acceleration of the step before", e->before_a, before_a ? before_a : e->a, s->nv);
    for (size_t k = 0; k < s->nv; k++) {
        sum x = {0}, v = {0};
        add(&v, 1, s->start->v[k]);
        add(&v, s->h / 3, s->end->a[k]);
        add(&v, s->h * 5 / 6, e->a[k]);
        add(&v, -s->h / 6, e->before_a[k]);
        reaches(s, "the velocity", k, e->v[k], v, 0);
        if (k >= s->nx) continue;
        add(&x, 1, s->start->x[k]);
        add(&x, s->h, s->start->v[k]);
        add(&x, s->h * s->h * 2 / 3, e->a[k]);
        add(&x, -s->h * s->h / 6, e->before_a[k]);
        reaches(s, "the position", k, e->x[k], x, 0);
    }
    same(s, "velocities at the end", e->v, s->end->v, s->nv);
}

static void recurrence(const step *s, const double *before_x, const double *before_a)
{
    const motus_trace_entry *e = s->start + 1;
    assert_int_equal(s->count, 3);
    assert_true(e->time == s->start->time);
    is_slope(s, e, s->start->x, s->start->v, 0);
    if (!strcmp(s->method, "beeman"))
        beeman(s, e, before_a);
    else
        stormer(s, e, before_x);
    same(s, "positions at the end", e->x, s->end->x, s->nx);
}

void trace_replay(const motus_system *system, const motus_method *m, const motus_trace_entry *const *entries,
                  size_t count, const double *before_x, const double *before_a, const char *what)
{
    assert_true(count >= 2);
    /* contiguous: each is compared with its neighbours */
    motus_trace_entry *entry = calloc(count, sizeof *entry);
    assert_non_null(entry);
    size_t taken = 0; /* all but what was refused */
    for (size_t i = 0; i < count; i++)
        if (entries[i]->kind != MOTUS_TRACE_REFUSED) entry[taken++] = *entries[i];
    count = taken;
    step s = {.system = system,
              .what = what,
              .method = m->name,
              .apart = !strcmp(m->name, "newmark") || !strcmp(m->family, "nystrom") || !strcmp(m->family, "radau"),
              .entry = entry,
              .start = entry,
              .end = entry + count - 1,
              .count = count,
              .nx = motus_positions(system),
              .nv = motus_velocities(system),
              .h = entry->step};
    s.a = calloc(s.nv + 1, sizeof *s.a);
    assert_non_null(s.a);
    assert_int_equal(s.start->kind, MOTUS_TRACE_START);
    assert_int_equal(s.end->kind, MOTUS_TRACE_END);
    for (size_t i = 0; i < count; i++) {
        assert_true(entry[i].step == s.h && entry[i].x && entry[i].v);
        assert_int_equal(entry[i].stages, s.end->stages);
        assert_true(entry[i].stage >= 0 && entry[i].stage <= entry[i].stages);
        assert_true(i == 0 || entry[i].iterations >= entry[i - 1].iterations);
    }
    is_slope(&s, s.start, s.start->x, s.start->v, 0);
    is_slope(&s, s.end, s.end->x, s.end->v, 0);
    if (!strcmp(m->family, "splitting"))
        splitting(&s, m);
    else if (!strcmp(m->family, "runge-kutta") || !strcmp(m->family, "nystrom"))
        tableau(&s, m, false);
    else if (!strcmp(m->family, "implicit") || !strcmp(m->family, "radau"))
        tableau(&s, m, true);
    else if (!strcmp(m->family, "two-step"))
        recurrence(&s, before_x, before_a);
    else
        assert_int_equal(count, 2);
    free(s.a);
    free(entry);
}
