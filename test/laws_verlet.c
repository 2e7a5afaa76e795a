/* LAWS OF VERLET: local error h^4 of the recursion, h^3 of the start, global error h^2; and the two founding
 * recurrences in 22 digits.
 */
#include "test/laws.h"

#include <math.h>
#include <stdio.h>

static method named(const char *name)
{
    const motus_method *card = NULL;
    method m = 0;
    if (!row_choose(name, &(chosen){0}, &card, NULL))
        while (m + 1 < row_count() && row_card(m) != card) m++;
    return m;
}

typedef quad (*error_at)(const quad_problem *, quad h);

/* Measured away from the start, where odd terms of Taylor's series vanish. */
static quad of_recursion(const quad_problem *p, quad h)
{
    quad_state s[3] = {0};
    quad after[DIMENSIONS], most = 0;
    for (int i = 0; i < 3; i++) {
        for (size_t k = 0; k < p->nx; k++) s[i].x[k] = p->x[k];
        for (size_t k = 0; k < p->nv; k++) s[i].v[k] = p->v[k];
        if (i) quad_reference(p, 0, i * h, &s[i]);
    }
    quad_recursion(p, h, h, s[0].x, s[1].x, after);
    for (size_t k = 0; k < p->nx; k++)
        if (quad_abs(after[k] - s[2].x[k]) > most) most = quad_abs(after[k] - s[2].x[k]);
    return most;
}

static quad over(const quad_problem *p, quad h, int64_t steps)
{
    quad_state reference = {0}, s = {0};
    for (size_t k = 0; k < p->nx; k++) s.x[k] = p->x[k];
    for (size_t k = 0; k < p->nv; k++) s.v[k] = p->v[k];
    reference = s;
    quad_reference(p, 0, h * (quad)steps, &reference);
    quad_run(named("verlet"), NULL, p, 0, h, steps, &s);
    quad most = 0;
    for (size_t k = 0; k < p->nx; k++)
        if (quad_abs(s.x[k] - reference.x[k]) > most) most = quad_abs(s.x[k] - reference.x[k]);
    return most;
}
static quad of_start(const quad_problem *p, quad h) { return over(p, h, 1); }
static quad of_whole(const quad_problem *p, quad h) { return over(p, h, (int64_t)(double)(1 / h + Q(0.5))); }

static void slope(const char *law, error_at error, int expected, const quad_problem *p)
{
    const quad h = Q(0.0078125);
    const double e0 = quad_log2(error(p, h)), e1 = quad_log2(error(p, h / 2)), e2 = quad_log2(error(p, h / 4));
    const double before = e0 - e1, last = e1 - e2, margin = 1.5 * fabs(last - before) + 0.01;
    char text[80];
    snprintf(text, sizeof text, "%s on %s", law, p->name);
    judge(fabs(last - expected) <= margin && margin < 0.2, "verlet", text, "slope %.4f, expected %d, margin %.4f", last,
          expected, margin);
}

/* cos by Taylor's series after subtracting multiples of 2 pi. */
static quad cosine(quad t)
{
    const quad turn = Q(6.283185307179586476925286766559005768);
    t -= turn * (quad)(int64_t)(double)(t / turn);
    quad term = 1, sum = 1;
    for (int k = 1; quad_abs(term) > Q(1e-34); k++) {
        term *= -t * t / ((2 * k - 1) * (2 * k));
        sum += term;
    }
    return sum;
}

static void driven_oscillator(quad t, const quad *x, const quad *v, quad *a)
{
    (void)v;
    a[0] = -x[0] + x[0] * x[0] * x[0] + cosine(t) / 10;
}
static void damped_cubic(quad t, const quad *x, const quad *v, quad *a)
{
    (void)t;
    a[0] = -v[0] - x[0] * x[0] * x[0];
}
static void damped_cubic_jvp(quad t, const quad *x, const quad *v, const quad *dx, const quad *dv, quad *da)
{
    (void)t, (void)v;
    da[0] = -dv[0] - 3 * x[0] * x[0] * dx[0];
}

/* Both recurrences of the notebook in exact arithmetic, h = 1/1000. */
static void founding(void)
{
    const quad_problem driven = {"driven oscillator", 1, 1, .time = true, .accel = driven_oscillator};
    const quad_problem cubic = {
        "damped cubic",         1, 1, .velocity = true, .linear = true, .x = {10}, .accel = damped_cubic,
        .jvp = damped_cubic_jvp};
    static const struct {
        bool cubic;
        int64_t steps;
        quad x;
    } known[] = {
        {false, 1000, Q(0.04207516760960441335731)},  {false, 10000, Q(-0.1738773821515826231245)},
        {false, 50000, Q(-0.8190196386833164899665)}, {false, 100000, Q(0.04778239807187257792945)},
        {true, 500, Q(-5.818576420328394541357)},     {true, 1000, Q(4.071615394297357525042)},
        {true, 2000, Q(4.921628363830870650900)},     {true, 3000, Q(-3.489442177206087865029)},
    };
    static const char *const rows[] = {"verlet", "verlet-literal"};
    for (int i = 0; i < 2; i++)
        for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
            quad_state s = {.x = {known[k].cubic ? 10 : 0}};
            /* cosines are slow, and the two rows agree in 33 digits */
            if (!known[k].cubic && known[k].steps > 10000 && i == 1) continue;
            quad_run(named(rows[i]), NULL, known[k].cubic ? &cubic : &driven, 0, Q(0.001), known[k].steps, &s);
            const quad off = quad_abs(s.x[0] - known[k].x);
            char law[80];
            snprintf(law, sizeof law, "%s, n = %lld", known[k].cubic ? "damped cubic" : "driven oscillator",
                     (long long)known[k].steps);
            /* The table has 22 digits; the recurrence multiplies rounding by about n². */
            judge(off < Q(2e-21), rows[i], law, "off the exact recurrence by %.1e", (double)off);
        }
}

void laws_of_verlet(void)
{
    slope("recursion", of_recursion, 4, &quad_problems[DRIVEN]);
    slope("start", of_start, 3, &quad_problems[DRIVEN]);
    slope("whole", of_whole, 2, &quad_problems[DRIVEN]);
    slope("recursion", of_recursion, 4, &quad_problems[DAMPED]);
    slope("start", of_start, 3, &quad_problems[DAMPED]);
    slope("whole", of_whole, 2, &quad_problems[DAMPED]);
    founding();
}
