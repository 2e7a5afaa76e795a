/* The rows and the texts of step/, compiled with `real` a number of 113 bits, so that the laws test the same
 * formulas.
 *
 * Invariant: this file supplies what an includer of step/ must supply (a dense linear solver among it) and no step
 * formula.
 */
#include "test/laws_proof.h"

#define K(x) Q(x)
typedef quad coef;
#define methods_table quad_methods_table
#define methods_count quad_methods_count
#define methods_newmark_damped quad_methods_newmark_damped
#include "core/methods.c"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define clock quad_clock
#define real quad
typedef quad clock;
typedef int64_t whole;
#define FMA(a, b, c) ((a) * (b) + (c))
#define ABS(x) ((x) < 0 ? -(x) : (x))
#define FINITE(x) ((x) - (x) == 0)
#define EPSILON QUAD_EPSILON
#define SQRT_EPSILON Q(0x1p-56)
#define SMALLEST Q(1e-300)
/* Logarithms of error control need the bits of a double only. */
typedef uint64_t clock_bits;
static uint64_t bits_of_quad(quad x)
{
    const double d = (double)x;
    uint64_t b;
    memcpy(&b, &d, sizeof b);
    return b;
}
static quad quad_of_bits(uint64_t b)
{
    double d;
    memcpy(&d, &b, sizeof d);
    return d;
}
#define PATTERN_OF(x) bits_of_quad(x)
#define CLOCK_OF(b) quad_of_bits(b)
#define EACH(k) for (size_t k = 0; k < w->nx; k++)
#define EACHV(k) for (size_t k = 0; k < w->nv; k++)
#define TRACE(w, i) ((void)(w), (void)(i))
#define ROWS
#include "step/work.h"
static void series_order(work *w, int n, quad t);

enum { UNKNOWNS = COUPLED_MAX * DIMENSIONS };
struct stepper_host {
    const quad_problem *problem;
    int n;
    quad inverse[UNKNOWNS][UNKNOWNS], jv[DIMENSIONS][DIMENSIONS];
};
typedef struct stepper_host dense;

static void series_order(work *w, int n, quad t)
{
    w->services->problem->series(w->expands + 1, n, t, w->xs, w->vs, w->a, w->ks);
}

static int accel(work *w, quad t, quad *x, quad *v, quad *a)
{
    w->evaluations++;
    w->services->problem->accel(t, x, v, a);
    return STEP_OK;
}

/* Gauss-Jordan with row pivoting; systems are tiny. */
static void invert(quad m[UNKNOWNS][UNKNOWNS], int n, quad inverse[UNKNOWNS][UNKNOWNS])
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) inverse[i][j] = i == j;
    for (int j = 0; j < n; j++) {
        int p = j;
        for (int i = j; i < n; i++)
            if (ABS(m[i][j]) > ABS(m[p][j])) p = i;
        for (int c = 0; c < n; c++) {
            const quad keep = m[j][c], kept = inverse[j][c];
            m[j][c] = m[p][c], inverse[j][c] = inverse[p][c];
            m[p][c] = keep, inverse[p][c] = kept;
        }
        const quad pivot = m[j][j];
        for (int c = 0; c < n; c++) m[j][c] /= pivot, inverse[j][c] /= pivot;
        for (int i = 0; i < n; i++) {
            const quad f = m[i][j];
            for (int c = 0; i != j && f != 0 && c < n; c++) m[i][c] -= f * m[j][c], inverse[i][c] -= f * inverse[j][c];
        }
    }
}

static int solve_factor(work *w, mask *where, int s, const quad *ax, const quad *av, quad t, quad *x, quad *v)
{
    dense *d = w->services;
    const int nv = (int)w->nv;
    static quad m[UNKNOWNS][UNKNOWNS];
    (void)where;
    d->n = s * nv;
    for (int i = 0; i < d->n; i++)
        for (int j = 0; j < d->n; j++) m[i][j] = i == j;
    for (int c = 0; c < nv; c++) {
        quad zero[DIMENSIONS] = {0}, unit[DIMENSIONS] = {0}, jx[DIMENSIONS] = {0}, jv[DIMENSIONS] = {0};
        unit[c] = 1;
        if (c < (int)w->nx) d->problem->jvp(t, x, v, unit, zero, jx);
        d->problem->jvp(t, x, v, zero, unit, jv);
        for (int r = 0; r < nv; r++) {
            d->jv[r][c] = jv[r];
            for (int i = 0; i < s; i++)
                for (int j = 0; j < s; j++) m[i * nv + r][j * nv + c] -= ax[i * s + j] * jx[r] + av[i * s + j] * jv[r];
        }
    }
    invert(m, d->n, d->inverse);
    return STEP_OK;
}

static void solve_back(work *w, quad *r)
{
    const dense *d = w->services;
    quad right[UNKNOWNS];
    const int nv = (int)w->nv, n = d->n;
    for (int i = 0; i < n; i++) right[i] = r[(size_t)(i / nv) * w->stride + (size_t)(i % nv)];
    for (int i = 0; i < n; i++) {
        quad sum = 0;
        for (int j = 0; j < n; j++) sum += d->inverse[i][j] * right[j];
        r[(size_t)(i / nv) * w->stride + (size_t)(i % nv)] = sum;
    }
}

static void solve_apply(work *w, quad c, const quad *y, quad *out)
{
    const dense *d = w->services;
    EACHV(k) {
        out[k] = y[k];
        for (size_t j = 0; j < w->nv; j++) out[k] += c * d->jv[k][j] * y[j];
    }
}

static int exact_at(work *w, quad t, quad *x, quad *v)
{
    (void)w, (void)t, (void)x, (void)v;
    return STEP_CALLBACK;
}
static void refresh_at(work *w, quad t, quad *x, quad *v) { (void)w, (void)t, (void)x, (void)v; }

#include "core/texts.h"

traits quad_traits(const quad_problem *p)
{
    return (traits){.velocity = p->velocity,
                    .linear_v = p->linear,
                    .time = p->time,
                    .gyroscopic = p->gyroscopic,
                    .gradient = p->gradient,
                    .quadrature = p->quadrature,
                    .smooth = true,
                    .series = p->series != NULL,
                    .first_order = p->nv > p->nx,
                    .constant = p->nx == 0};
}

/* Decided as in the catalogue, for the row of the same name. */
bool quad_admits(method k, const quad_problem *p)
{
    chosen c;
    const traits t = quad_traits(p);
    return methods_table[k].family != EXACT && !row_choose(methods_table[k].card.name, &c, NULL, NULL) &&
           !row_admits(&c, &t, NULL);
}

enum { ARRAYS_MAX = 40, SERIES_ARRAYS = 8000, CONSTANTS_MAX = 1024, DENSE_CONSTANTS_MAX = 8192, WEIGHTS_ARRAYS = 48 };

/* The plan of the row, kept from one run to the next: a row may have to generate its coefficients. */
static const work *plan_of(const row *m, const double *argument, const quad_problem *p)
{
    static const double trapezoid[2] = {0.25, 0.5};
    static quad memory[CONSTANTS_MAX];
    static size_t all[2]; /* one variable */
    static double last[2];
    static work w;
    if (!argument) argument = trapezoid;
    if (w.row == m && !m->expands && !memcmp(argument, last, sizeof last) && w.nx == p->nx && w.nv == p->nv &&
        w.velocity == p->velocity && w.linear == p->linear && w.quadrature == p->quadrature)
        return &w;
    w = (work){.row = m,
               .nx = p->nx,
               .nv = p->nv,
               .stride = DIMENSIONS,
               .velocity = p->velocity,
               .linear = p->linear,
               .quadrature = p->quadrature,
               .between = m->card.dense_order,
               .variables = 1,
               .variable = all};
    all[1] = p->nv;
    memcpy(last, argument, sizeof last);
    if (m->expands) w.relative = (quad)INFINITY; /* no step is too long */
    work_plan(&w, argument, NULL);
    if (m->expands) w.series = (size_t)(p->keeps * (w.expands + 1));
    if (work_plan_size(&w) > CONSTANTS_MAX) abort();
    work_plan(&w, argument, memory);
    return &w;
}

static void begin(work *w, dense *d, quad *memory, const row *m, const double *argument, const quad_problem *p, quad t0,
                  quad h)
{
    *w = *plan_of(m, argument, p);
    w->t0 = w->t = t0;
    w->services = d;
    d->problem = p;
    work_scale(w, h);
    const size_t arrays = work_place(w, NULL);
    if (arrays > (m->expands ? SERIES_ARRAYS : ARRAYS_MAX)) abort();
    memset(memory, 0, arrays * DIMENSIONS * sizeof *memory);
    work_place(w, memory);
}

/* Of an adaptive row: every candidate is a step, whatever its error, so that steps have one size; and one order where
 * it finds its own. */
static int candidates(work *w, quad h, int64_t steps)
{
    w->until = (quad)INFINITY;
    if (w->row->orders) w->absolute = Q(1e300);
    for (int64_t n = 0; n < steps; n++) {
        work_scale(w, h);
        w->next = w->most = h; /* of a row that finds its own size */
        const int bad = family_step(w);
        if (bad) return bad;
        if (!FINITE(w->error)) return STEP_SOLVE; /* it is refused at any tolerance */
        family_accept(w, true);
        time_tick(w, true);
    }
    return STEP_OK;
}

/* line: of a row that finds its own order; 0: that of the row's card. off: the error of the last step, by its
 * estimate; may be NULL. */
static quad_count run_line(const row *m, const double *argument, int line, const quad_problem *p, quad t0, quad h,
                           int64_t steps, quad_state *state, quad_state *off)
{
    work w;
    static dense d;
    static quad series[SERIES_ARRAYS * DIMENSIONS];
    quad memory[ARRAYS_MAX * DIMENSIONS];
    begin(&w, &d, m->expands ? series : memory, m, argument, p, t0, h);
    memcpy(w.x, state->x, p->nx * sizeof *w.x);
    memcpy(w.v, state->v, p->nv * sizeof *w.v);
    w.before = line;
    quad_count count = {.bad = m->adaptive ? candidates(&w, h, steps) : advance_run(&w, steps)};
    count.evaluations = w.evaluations;
    count.iterations = w.iterations;
    if (!count.bad) count.bad = advance_sync(&w, state->x, state->v, NULL);
    for (size_t i = 0; off && i < p->nx; i++) off->x[i] = w.xs[i];
    for (size_t i = 0; off && i < p->nv; i++) off->v[i] = w.vs[i];
    return count;
}

quad_count quad_run(method k, const double *argument, const quad_problem *p, quad t0, quad h, int64_t steps,
                    quad_state *state)
{
    return run_line(&methods_table[k], argument, 0, p, t0, h, steps, state, NULL);
}

quad_count quad_line(method k, int line, const quad_problem *p, quad t0, quad h, int64_t steps, quad_state *state,
                     quad_state *off)
{
    return run_line(&methods_table[k], NULL, line, p, t0, h, steps, state, off);
}

quad_count quad_expand(method k, int order, const quad_problem *p, quad t0, quad h, int64_t steps, quad_state *state)
{
    row own = methods_table[k];
    own.series = order;
    return run_line(&own, NULL, 0, p, t0, h, steps, state, NULL);
}

int quad_lines(method k) { return methods_table[k].orders ? EXTRAPOLATION_LINES : 0; }
int quad_line_work(method k, int line)
{
    return extrapolation_work(methods_table[k].family == STORMER ? &stormer_rule : &gragg_rule, line);
}

quad_count quad_adapt(method k, const quad_problem *p, quad tolerance, quad until, int64_t steps, quad_state *state,
                      quad_control *control)
{
    work w;
    static dense d;
    size_t all[2] = {0, p->nv};
    quad memory[ARRAYS_MAX * DIMENSIONS];
    begin(&w, &d, memory, &methods_table[k], NULL, p, control->t, 1);
    w.variables = 1, w.variable = all;
    memcpy(w.x, state->x, p->nx * sizeof *w.x);
    memcpy(w.v, state->v, p->nv * sizeof *w.v);
    w.relative = tolerance, w.most = (quad)INFINITY, w.rise = CONTROL_RISE;
    w.t = control->t, w.until = until, w.next = control->next, w.before = control->before;
    if (w.old) memcpy(w.old, control->old, p->nv * sizeof *w.old);
    quad_count count = {.bad = advance_run(&w, steps)};
    count.evaluations = w.evaluations;
    count.iterations = w.iterations;
    if (!count.bad) count.bad = advance_sync(&w, state->x, state->v, NULL);
    *control = (quad_control){.t = w.t, .next = w.next, .before = w.before, .refused = w.refused};
    if (w.old) memcpy(control->old, w.old, p->nv * sizeof *w.old);
    return count;
}

/* Whether the interpolant is made of the stages of the step, and so belongs to the end to which they lead. */
static bool of_stages(const row *m)
{
    const bool coupled = m->family == IMPLICIT || m->family == RADAU;
    return m->expands || m->tableau.dense.terms > 0 || (coupled && m->tableau.stages > 4);
}

quad_count quad_dense(method k, const quad_problem *p, quad t0, quad h, int64_t steps, quad part, const quad_state *end,
                      quad_state *state)
{
    static quad memory[SERIES_ARRAYS * DIMENSIONS], more[ARRAYS_MAX * DIMENSIONS], unit[DENSE_CONSTANTS_MAX];
    static dense d;
    work w;
    const row *m = &methods_table[k];
    quad_state ends[2] = {{.x = {0}}};
    quad a[2][DIMENSIONS] = {{0}};
    begin(&w, &d, memory, m, NULL, p, t0, h);
    memcpy(w.x, state->x, p->nx * sizeof *w.x);
    memcpy(w.v, state->v, p->nv * sizeof *w.v);
    quad_count count = {.bad = m->adaptive ? candidates(&w, h, steps) : advance_run(&w, steps)};
    const quad t = time_now(&w);
    if (!count.bad) count.bad = advance_sync(&w, ends[0].x, ends[0].v, a[0]);
    if (!count.bad) count.bad = m->adaptive ? candidates(&w, h, 1) : advance_run(&w, 1);
    if (!count.bad) count.bad = advance_sync(&w, ends[1].x, ends[1].v, a[1]);
    const bool through = end && !of_stages(m);
    if (through) {
        ends[1] = *end;
        p->accel(t + h, ends[1].x, ends[1].v, a[1]);
    }
    const dense_room room = family_between(&w, NULL);
    if (room.arrays > ARRAYS_MAX || room.constants > DENSE_CONSTANTS_MAX) abort();
    family_between(&w, unit);
    const dense_step step = {
        .end = {{t, ends[0].x, ends[0].v, a[0]}, {t + h, ends[1].x, ends[1].v, a[1]}}, .more = more, .unit = unit};
    const whole evaluations = w.evaluations;
    if (!count.bad) count.bad = through ? lift_extend(&w, &step) : family_extend(&w, &step);
    if (!count.bad) count.bad = family_dense(&w, &step, t + part * h, state->x, state->v);
    if (w.evaluations != evaluations) count.bad = STEP_CALLBACK; /* dense output counts none */
    return count;
}

bool quad_continuous_of(method k, quad part, scheme *out)
{
    static quad memory[WEIGHTS_ARRAYS * DIMENSIONS], more[WEIGHTS_ARRAYS * DIMENSIONS], unit[DENSE_CONSTANTS_MAX];
    const row *m = &methods_table[k];
    if (m->tableau.dense.terms == 0) return false;
    work w = *plan_of(m, NULL, &quad_problems[OSCILLATOR]);
    const int s = w.stages, first = continuous_first(&w), n = continuous_columns(&w);
    if (n > SCHEME_STAGES_MAX || s + m->tableau.dense.more + m->tableau.dense.terms + 8 > WEIGHTS_ARRAYS) abort();
    work_place(&w, memory);
    continuous_between(&w, unit);
    w.h = 1;
    *out = (scheme){.stages = n, .end = 1};
    for (int i = 0; i < n; i++) {
        const bool inner = i < s, end = i == s && first > s;
        out->c[i] = inner ? w.c[i] : end ? 1 : m->tableau.dense.c[i - first];
        for (int j = 0; j < i; j++) {
            const bool known = j < s;
            out->av[i][j] = continuous_entry(&w, i, j);
            out->a[i][j] = inner ? w.unit[tableau_aa(&w, i) + j]
                           : end ? (known ? w.unit[tableau_bb(&w) + j] : 0)
                                 : unit[continuous_aa(&w, i - first) + j];
        }
    }
    for (int j = 0; j < n; j++) { /* the state that one acceleration alone leads to */
        quad none = 0, x = 0, v = 0, ends[2] = {0, 0};
        memset(memory, 0, sizeof memory);
        memset(more, 0, sizeof more);
        const dense_step step = {
            .end = {{0, &none, &none, &ends[0]}, {1, &none, &none, &ends[1]}}, .more = more, .unit = unit};
        if (j == 0 || (j == s && first > s))
            ends[j > 0] = 1;
        else if (j < s)
            w.ks[(size_t)j * w.stride] = 1;
        else
            more[(size_t)(2 + j - first) * w.stride] = 1;
        continuous_add(&w, &step);
        continuous_state(&w, &step, part, &x, &v);
        out->b[j] = x;
        out->bv[j] = v;
    }
    out->part = part;
    return true;
}

bool quad_slopes_of(method k, bool end, quad *slope, quad *size)
{
    static quad unit[DENSE_CONSTANTS_MAX];
    const row *m = &methods_table[k];
    if (m->tableau.dense.terms == 0) return false;
    const work w = *plan_of(m, NULL, &quad_problems[OSCILLATOR]);
    const int n = continuous_columns(&w);
    continuous_between(&w, unit);
    for (int j = 0; j < n; j++) {
        slope[j] = size[j] = 0;
        for (int i = 0; i < m->tableau.dense.terms; i++) { /* Legendre's polynomials are ±1 at the ends */
            const quad term = unit[i * n + j];
            slope[j] += end || i % 2 == 0 ? term : -term;
            size[j] += quad_abs(term);
        }
    }
    return true;
}

int quad_generated_of(method k, quad *constants, quad *c)
{
    const row *m = &methods_table[k];
    if (m->family != RADAU && (m->family != IMPLICIT || m->newmark)) return 0;
    const work *w = plan_of(m, NULL, &quad_problems[FREE_FALL]);
    memcpy(constants, w->unit, work_constants(w) * sizeof *constants);
    memcpy(c, w->c, (size_t)w->stages * sizeof *c);
    return w->stages;
}

void quad_recursion(const quad_problem *p, quad t, quad h, const quad *before, const quad *now, quad *after)
{
    work w;
    dense d;
    quad memory[ARRAYS_MAX * DIMENSIONS];
    begin(&w, &d, memory, &methods_table[0], NULL, p, t - h, h);
    w.n = 1;
    for (size_t k = 0; k < p->nx; k++) {
        w.x[k] = now[k];
        w.v[k] = now[k] - before[k];
    }
    advance_run(&w, 1);
    memcpy(after, w.x, p->nx * sizeof *after);
}

int quad_splitting_of(method k, quad *kick, quad *drift)
{
    const row *m = &methods_table[k];
    if (m->family != SPLITTING) return 0;
    work w = {.row = m};
    quad memory[CONSTANTS_MAX];
    work_plan(&w, NULL, memory);
    for (int i = 0; i < w.stages; i++) {
        kick[i] = kick_unit(&w, i);
        drift[i] = drift_unit(&w, i);
    }
    return w.stages;
}

quad quad_looseness(method k)
{
    quad kick[SPLITTING_MAX], drift[SPLITTING_MAX], kicks = -1, drifts = -1;
    const int n = quad_splitting_of(k, kick, drift);
    if (!n) return 0;
    for (int i = 0; i < n; i++) {
        kicks += kick[i];
        drifts += drift[i];
    }
    return quad_abs(kicks) > quad_abs(drifts) ? quad_abs(kicks) : quad_abs(drifts);
}
