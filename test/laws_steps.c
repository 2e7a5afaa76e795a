/* LAWS OF STEPS: the texts of step/ compute the tableaux of the proofs; the two-step recurrences are velocity
 * Verlet's map.
 *
 * Invariant: the acceleration is replaced by marks, 1 for one evaluation and 0 for all others, so that one run shows
 * how the step uses that evaluation. A step is linear in them and in the start, hence known for every force once
 * every mark has been tried. Times and steps are binary fractions: if the coefficients of a method are too, nothing
 * is rounded and the comparison is exact.
 */
#include "core/stepper_body.h"
#include "test/laws_proof.h"

#include <math.h>
#include <stdio.h>

static const quad step = Q(0.25), start = Q(0.5);

/* Mark 0 is the initial position, 1 the initial velocity, 2 + i the acceleration of evaluation i. The `expected`
 * times separate repeated implicit evaluations: the last one counts, and evaluations elsewhere, which begin an
 * iteration, must not matter. */
enum { MARKS_MAX = SCHEME_STAGES_MAX + 2 };
typedef struct record {
    quad c, x, v;
} record;
static struct {
    int mark, calls, expected;
    const quad *time;
    record seen[SCHEME_STAGES_MAX];
} probe;

static void marked(quad t, const quad *x, const quad *v, quad *a)
{
    int i = probe.time ? 0 : probe.calls++;
    while (probe.time && i < probe.expected && quad_abs(t - start - probe.time[i] * step) > Q(1e-20)) i++;
    a[0] = i >= probe.expected ? 7 : probe.mark == 2 + i;
    if (i < probe.expected) probe.seen[i] = (record){(t - start) / step, x[0], v[0]};
}

static void flat(quad t, const quad *x, const quad *v, const quad *dx, const quad *dv, quad *da)
{
    (void)t, (void)x, (void)v, (void)dx, (void)dv;
    da[0] = 0;
}

static bool takes_v(method m) { return row_card(m)->forces == MOTUS_FORCES_XVT; }

/* Newton's method, which `linear` would skip, has converged if the stages are those of the step. */
static struct {
    int line; /* of a row that finds its own order */
    quad_state off;
} extrapolated;
static quad_state run(method m, const double *argument, int mark, const quad *time, int expected, int steps)
{
    const quad_problem p = {"marks", 1, 1, .velocity = takes_v(m), .time = true, .accel = marked, .jvp = flat};
    quad_state s = {.x = {mark == 0}, .v = {mark == 1}};
    probe.mark = mark, probe.calls = 0, probe.expected = expected, probe.time = time;
    if (extrapolated.line)
        quad_line(m, extrapolated.line, &p, start, step, steps, &s, &extrapolated.off);
    else
        quad_run(m, argument, &p, start, step, steps, &s);
    return s;
}

static void widen(quad *most, quad miss)
{
    if (!(quad_abs(miss) <= *most)) *most = quad_abs(miss);
}

static bool recurrence(const row *r) { return r->family == VERLET || r->family == LITERAL || r->family == BEEMAN; }

/* Explicit evaluations are distinguished by their number: two stages of rk4 have the same time. */
static bool by_time(method m)
{
    const row *r = &methods_table[m];
    return r->family == IMPLICIT || r->family == RADAU || recurrence(r) || (r->family == SPLITTING && takes_v(m));
}

/* The tableau of one step, with stages at the places of `as`. Returns the largest violation of what holds for any
 * method: X[i] begins with x + c[i] h v, V[i] with v. */
static quad tableau_of(method m, const double *argument, const scheme *as, scheme *out)
{
    quad off = 0;
    *out = (scheme){.stages = as->stages};
    for (int mark = 0; mark < as->stages + 2; mark++) {
        const quad_state end = run(m, argument, mark, by_time(m) ? as->c : NULL, as->stages, 1);
        const int j = mark - 2;
        for (int i = 0; i < as->stages; i++) {
            const record *r = &probe.seen[i];
            if (mark == 0)
                out->c[i] = r->c, widen(&off, r->x - 1), widen(&off, takes_v(m) ? r->v : 0);
            else if (mark == 1)
                widen(&off, r->x - out->c[i] * step), widen(&off, takes_v(m) ? r->v - 1 : 0);
            else
                out->a[i][j] = r->x / (step * step), out->av[i][j] = r->v / step;
        }
        if (mark == 0)
            widen(&off, end.x[0] - 1), widen(&off, end.v[0]);
        else if (mark == 1)
            out->end = end.x[0] / step, widen(&off, end.v[0] - 1);
        else
            out->b[j] = end.x[0] / (step * step), out->bv[j] = end.v[0] / step;
    }
    return off;
}

/* The largest difference of two tableaux; without V if the force does not depend on the velocity. */
static quad difference(const scheme *p, const scheme *q, bool velocity)
{
    quad most = quad_abs(p->end - q->end);
    for (int i = 0; i < p->stages; i++) {
        widen(&most, p->c[i] - q->c[i]);
        widen(&most, p->b[i] - q->b[i]);
        widen(&most, p->bv[i] - q->bv[i]);
        for (int j = 0; j < p->stages; j++) {
            widen(&most, p->a[i][j] - q->a[i][j]);
            if (velocity) widen(&most, p->av[i][j] - q->av[i][j]);
        }
    }
    return most;
}

/* A row with coefficients steps as its tableau says: x and v are sums of at most 2 s numbers, each rounded a few
 * times. A compensated splitting gives what its printed digits lack of 1 to one kick and one drift, the factors of a
 * tableau's entry; a Runge-Kutta row gives to a weight of each stage what the printed digits of the others lack. */
static void as_tableau(method m)
{
    const coefficients c = coefficients_of(m);
    scheme said, done;
    coefficients_scheme(m, c.value, &said);
    quad off = tableau_of(m, NULL, &said, &done);
    quad size = 1;
    for (int i = 0; i < said.stages; i++)
        for (int j = 0; j < said.stages; j++) widen(&size, quad_abs(said.av[i][j]) > size ? said.av[i][j] : size);
    const quad miss = difference(&said, &done, takes_v(m));
    const quad given = quad_looseness(m) > 0 ? 2 * size * quad_looseness(m) : said.stages * coefficients_unit(m);
    const quad bound = 8 * said.stages * size * QUAD_EPSILON / (step * step) + given;
    if (miss > off) off = miss;
    judge(off <= bound, row_card(m)->name, "steps as its tableau", "%d stages, off by %.1e, rounding %.1e", said.stages,
          (double)off, (double)bound);
}

/* Velocity Verlet's map, the force taken at the new velocity too: x₁ = x + h v + h²/2 k, v₁ = v + h/2 (k + k₁). */
static const scheme verlet_map = {.stages = 2,
                                  .end = 1,
                                  .c = {0, 1},
                                  .a = {{0, 0}, {Q(0.5), 0}},
                                  .b = {Q(0.5), 0},
                                  .av = {{0, 0}, {Q(0.5), Q(0.5)}},
                                  .bv = {Q(0.5), Q(0.5)}};

/* Every step of a two-step method, the first included, is that map between x[n] and w[n] = (x[n+1] - x[n-1])/2h.
 * Verlet's velocity, also in the force, is w; Beeman's is w - h/6 (k[n] - k[n-1]), which differs from w by O(h²) and
 * does not change the positions. */
static void as_recurrence(method m)
{
    enum { STEPS = 6 };
    static const quad time[STEPS + 1] = {0, 1, 2, 3, 4, 5, 6};
    const bool beeman = methods_table[m].family == BEEMAN, velocity = takes_v(m);
    quad off = 0;
    for (int mark = 0; mark < STEPS + 3; mark++) {
        const quad_state end = run(m, NULL, mark, time, STEPS + 1, STEPS);
        quad x = mark == 0, w = mark == 1, v = w;
        for (int n = 0; n <= STEPS; n++) {
            const quad before = mark == n + 1, now = mark == n + 2;
            if (n > 0) {
                x += step * w + step * step / 2 * before;
                w += step / 2 * (before + now);
                v = beeman ? w - step / 6 * (now - before) : w;
            }
            widen(&off, probe.seen[n].x - x);
            if (velocity) widen(&off, probe.seen[n].v - w);
        }
        widen(&off, end.x[0] - x);
        widen(&off, end.v[0] - v);
    }
    /* Beeman's thirds and sixths are rounded a few times a step, and v carries the error to x. */
    const quad bound = beeman ? 4 * STEPS * STEPS * QUAD_EPSILON : 0;
    judge(off <= bound, row_card(m)->name, "is velocity Verlet's map", "%d steps, off by %.1e, rounding %.1e", STEPS,
          (double)off, (double)bound);
    proof_of_scheme(row_card(m)->name, velocity ? TREES_NYSTROM : TREES_SPECIAL, &verlet_map, row_card(m)->order);
}

/* Newmark's only coefficients are its arguments: order 2 for every beta with gamma = 1/2, order 1 for any other
 * gamma. */
static void of_newmark(method m)
{
    static const struct {
        double argument[2];
        const char *name;
    } known[] = {
        {{0.25, 0.5}, "newmark"},
        {{0, 0.5}, "newmark(0, 1/2)"},
        {{1.0 / 12, 0.5}, "newmark(1/12, 1/2)"},
        {{1.0 / 6, 0.5}, "newmark(1/6, 1/2)"},
        {{1, 0.5}, "newmark(1, 1/2)"},
        {{0.25, 0.25}, "newmark(1/4, 1/4)"},
        {{0.3025, 0.6}, "newmark(0.3025, 0.6)"},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        scheme done;
        const quad off = tableau_of(m, known[i].argument, &verlet_map, &done);
        judge(off <= 64 * QUAD_EPSILON, known[i].name, "steps as a tableau", "off by %.1e", (double)off);
        proof_of_scheme(known[i].name, TREES_NYSTROM, &done, known[i].argument[1] == 0.5 ? 2 : 1);
    }
}

/* What is generated in double is what is generated in 113 bits, rounded once; so are the rests of the weights and of
 * the abscissae, which stand behind two squares of numbers. The reach of a density, before these, is measured:
 * laws_density.c. */
static void rounded_once(method m)
{
    const problem p = {.nx = 1, .nv = 1};
    chosen c = {.row = &methods_table[m]};
    quad constants[GENERATED_MAX], abscissae[COUPLED_MAX];
    coef memory[4 * GENERATED_MAX];
    const int s = quad_generated_of(m, constants, abscissae);
    const work w = stepper_plan(&p, &c, memory);
    const int density = methods_table[m].density, scaled = w.linears + w.squares, rest = scaled + density + 2 * s * s,
              place = scaled - s;
    int same = -density, all = (int)work_constants(&w) + s - density;
    for (int i = 0; i < (int)work_constants(&w); i++) {
        const int k = i - rest, of = k < s ? s * s + k : place + k - s;
        const bool left = w.kept && k >= 0 && k < 3 * s;
        const quad whole = k < 2 * s ? constants[left ? of : 0] : abscissae[left ? k - 2 * s : 0],
                   high = k < 2 * s ? w.unit[left ? of : 0] : w.c[left ? k - 2 * s : 0];
        const bool measured = density && i == scaled;
        same += left ? fabs((double)(whole - high - (quad)w.unit[i])) <= 0x1p-100
                     : measured || w.unit[i] == (double)constants[i];
    }
    for (int i = 0; i < s; i++) same += w.c[i] == (double)abscissae[i];
    judge(same == all, row_card(m)->name, "rounded once", "%d of %d coefficients", same, all);
}

/* The tableau of a row whose coefficients are generated is that of collocation; it is measured, so the step is proved
 * with it. */
static void as_collocation(method m)
{
    quad constants[GENERATED_MAX];
    scheme nodes = {0}, done;
    nodes.stages = quad_generated_of(m, constants, nodes.c);
    const quad off = tableau_of(m, NULL, &nodes, &done);
    judge(off <= 64 * QUAD_EPSILON, row_card(m)->name, "steps as a tableau", "%d stages, off by %.1e", done.stages,
          (double)off);
    proof_of_collocation(row_card(m)->name, &done, methods_table[m].family == RADAU, row_card(m)->order);
    if (trees_count(TREES_ROOTED, row_card(m)->order + 1))
        proof_of_scheme(row_card(m)->name, TREES_ROOTED, &done, row_card(m)->order);
    rounded_once(m);
}

static int degree;
static void monomial(quad t, const quad *x, const quad *v, quad *a)
{
    (void)x, (void)v;
    a[0] = 1;
    for (int i = 0; i < degree; i++) a[0] *= t;
}

/* Line j integrates polynomials in time: of degree 2 j - 1 once, and of degree 2 j - 2 twice, without error, and no
 * longer ones. This is the proof of the longest lines, whose trees are too many. */
static void quadrature(method m)
{
    const quad_problem p = {"a power of time", 1, 1, .time = true, .accel = monomial, .jvp = flat};
    char name[64];
    for (int line = 2; line <= quad_lines(m); line++) {
        quad most = 0, next = 0, size = 1;
        for (degree = 0; degree <= 2 * line; degree++) {
            quad_state s = {.x = {0}};
            quad_line(m, line, &p, 0, 1, 1, &s, NULL);
            const quad v = s.v[0] - 1 / (quad)(degree + 1), x = s.x[0] - 1 / (quad)((degree + 1) * (degree + 2));
            if (degree < 2 * line) widen(&most, v);
            if (degree < 2 * line - 1) widen(&most, x);
            if (degree == 2 * line) next = quad_abs(v);
        }
        /* a step of the scheme multiplies roundings by at most (j² + m²)/(j² - m²), m = j - 1 at the worst */
        for (int j = 2; j <= line; j++) size *= (quad)(j * j + (j - 1) * (j - 1)) / (2 * j - 1);
        const quad bound = 4 * line * size * QUAD_EPSILON;
        snprintf(name, sizeof name, "%s, line %d", row_card(m)->name, line);
        judge(most <= bound && next > bound, name, "integrates polynomials", "off by %.1e, bound %.1e; degree %d: %.1e",
              (double)most, (double)bound, 2 * line, (double)next);
    }
}

/* Every line of a scheme of extrapolation whose tableau is not too large: its evaluations, its order, and that of its
 * estimate, the method that the step is off by. */
static void as_lines(method m)
{
    char name[64];
    for (int line = 2; trees_count(TREES_SPECIAL, 2 * line + 1); line++) {
        const scheme sizes = {.stages = quad_line_work(m, line)};
        const trees_kind kind = takes_v(m) && trees_count(TREES_ROOTED, 2 * line + 1) ? TREES_ROOTED : TREES_SPECIAL;
        scheme done, estimate;
        extrapolated.line = line;
        snprintf(name, sizeof name, "%s, line %d", row_card(m)->name, line);
        const quad off = tableau_of(m, NULL, &sizes, &done);
        judge(off <= 64 * QUAD_EPSILON && probe.calls == done.stages, name, "steps as a tableau",
              "%d evaluations, off by %.1e", probe.calls, (double)off);
        proof_of_scheme(name, kind, &done, 2 * line);
        estimate = done;
        for (int j = 0; j < done.stages; j++) {
            run(m, NULL, 2 + j, NULL, done.stages, 1);
            estimate.b[j] -= extrapolated.off.x[0] / (step * step);
            estimate.bv[j] -= extrapolated.off.v[0] / step;
        }
        snprintf(name, sizeof name, "%s, estimate of line %d", row_card(m)->name, line);
        proof_of_scheme(name, kind, &estimate, 2 * line - 2);
    }
    extrapolated.line = 0;
}

void laws_of_steps(void)
{
    for (method m = 0; m < row_count(); m++) {
        if (methods_table[m].newmark)
            of_newmark(m);
        else if (methods_table[m].family == IMPLICIT || methods_table[m].family == RADAU)
            as_collocation(m);
        else if (recurrence(&methods_table[m]))
            as_recurrence(m);
        else if (methods_table[m].orders)
            as_lines(m), quadrature(m);
        else if (methods_table[m].family != EXACT && !methods_table[m].expands)
            as_tableau(m);
    }
}
