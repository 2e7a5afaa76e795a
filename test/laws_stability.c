/* LAWS OF LONG RUNS: the stability limit measured on the oscillator is the one on the card; the energy of symplectic
 * rows has no trend, that of the others has.
 */
#include "core/rows.h"
#include "core/stepper.h"
#include "core/stepper_body.h"
#include "test/laws.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A motion is bounded if neither of these is positive [Jury's criterion]: det M - 1 and |trace M| - 1 - det M, where
 * M is one step's matrix over (x, v) on x'' = -x. Beeman's state holds more than x and v, but two successive
 * positions determine the next: M is over these. */
typedef struct growth {
    quad spiral, saddle;
} growth;
static growth growth_at(method m, quad z)
{
    const bool pairs = methods_table[m].family == BEEMAN;
    quad x[4][2], v[2][2], trace, determinant;
    for (int c = 0; c < 2; c++)
        for (int n = 1; n < (pairs ? 4 : 2); n++) {
            quad_state s = {.x = {c == 0}, .v = {c == 1}};
            quad_run(m, NULL, &quad_problems[OSCILLATOR], 0, z, n, &s);
            x[n][c] = s.x[0];
            v[1][c] = s.v[0];
        }
    if (pairs) {
        const quad old = x[1][0] * x[2][1] - x[1][1] * x[2][0];
        determinant = (x[2][0] * x[3][1] - x[2][1] * x[3][0]) / old;
        trace = (x[1][0] * x[3][1] - x[1][1] * x[3][0]) / old;
    } else {
        determinant = x[1][0] * v[1][1] - x[1][1] * v[1][0];
        trace = x[1][0] + v[1][1];
    }
    return (growth){determinant - 1, quad_abs(trace) - 1 - determinant};
}

/* Far above rounding, far below the growth that a run would show. */
static const quad visible = Q(1e-22);
static quad worse(growth g) { return g.spiral > g.saddle ? g.spiral : g.saddle; }
static quad either(growth g, int saddle) { return saddle ? g.saddle : g.spiral; }

/* Between a < b, where a is bounded and b is not: the last bounded step. */
static quad crossing(method m, quad a, quad b)
{
    while (b - a > Q(1e-20) * b) {
        const quad middle = (a + b) / 2;
        if (worse(growth_at(m, middle)) > visible)
            b = middle;
        else
            a = middle;
    }
    return a;
}

/* A range of unbounded motion may be narrower than the distance of two samples: where the middle of three is a
 * maximum, the maximum is refined by thirds. Returns its place, or 0 if the motion is bounded there too. */
static quad band(method m, int saddle, quad a, quad b)
{
    for (int i = 0; i < 160 && b - a > Q(1e-17) * b; i++) {
        const quad p = a + (b - a) / 3, q = b - (b - a) / 3;
        const growth at_p = growth_at(m, p), at_q = growth_at(m, q);
        if (worse(at_p) > visible) return p;
        if (worse(at_q) > visible) return q;
        if (either(at_p, saddle) < either(at_q, saddle))
            a = p;
        else
            b = q;
    }
    return 0;
}

/* The first step from 0 on at which the oscillator is unbounded, found without the card. An explicit method of s
 * evaluations has its limit at 2 s at most, since the trace is a polynomial of degree s in z² that starts like 2 - z²
 * (Chebyshev); implicit ones are tried up to 1e5. */
static quad limit_of(method m)
{
    const bool implicit = methods_table[m].family == IMPLICIT;
    const quad first = Q(0x1p-4), last = implicit ? Q(1e5) : 2 * row_card(m)->stages + 1;
    quad z[3] = {0};
    growth g[3] = {{0}};
    if (worse(growth_at(m, first)) > visible) return 0; /* no limit is so small: the motion grows at every step */
    for (quad at = first; at < last; at = implicit ? at * Q(1.01) : at + Q(0x1p-5)) {
        z[0] = z[1], z[1] = z[2], z[2] = at;
        g[0] = g[1], g[1] = g[2], g[2] = growth_at(m, at);
        if (worse(g[2]) > visible) return crossing(m, z[1], z[2]);
        for (int saddle = 0; saddle < 2 && z[0] > 0; saddle++) {
            /* a symplectic row has det M = 1 up to rounding */
            const quad f = either(g[1], saddle);
            const bool top = f >= either(g[0], saddle) && f >= either(g[2], saddle) && quad_abs(f) > visible;
            const quad peak = top ? band(m, saddle, z[0], z[2]) : 0;
            if (peak > 0) return crossing(m, z[0], peak);
        }
    }
    return (quad)INFINITY;
}

/* Whether what is seen at z is the error of a step, h^(order + 1), which at smaller steps is only too small to be seen:
 * then the motion grows at every step. */
static bool creeps(method m, quad z)
{
    const quad there = worse(growth_at(m, z)), half = worse(growth_at(m, z / 2));
    return there > 0 && half > 0 && fabs(quad_log2(there / half) - (row_card(m)->order + 1)) < 0.5;
}

static void limit(method m)
{
    const motus_method *card = row_card(m);
    const quad first = limit_of(m);
    const double found = isfinite((double)first) && first > 0 && creeps(m, first) ? 0 : (double)first,
                 stored = card->stability_limit;
    const bool same = found == stored || (isfinite(found) && fabs(found - stored) <= 2 * DBL_EPSILON * found);
    char right[40];
    snprintf(right, sizeof right, isinf(found) ? "INFINITY" : found == 0 ? "0.0" : "%.17g", found);
    judge(same, card->name, "stability", same ? "limit found %s, stored %.17g" : "the limit is %s; the card says %.17g",
          right, stored);
}

/* Energy in double, through the stepper: Hénon and Heiles' potential below chaos. */
static int force(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)t, (void)v;
    a[0] = -x[0] - 2 * x[0] * x[1];
    a[1] = -x[1] - x[0] * x[0] + x[1] * x[1];
    return 0;
}
static int slope(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    (void)ctx, (void)t, (void)v, (void)dv;
    da[0] = dx ? -dx[0] - 2 * (x[0] * dx[1] + dx[0] * x[1]) : 0;
    da[1] = dx ? -dx[1] - 2 * x[0] * dx[0] + 2 * x[1] * dx[1] : 0;
    return 0;
}
static double energy_of(const double *x, const double *v)
{
    return (v[0] * v[0] + v[1] * v[1] + x[0] * x[0] + x[1] * x[1]) / 2 + x[0] * x[0] * x[1] - x[1] * x[1] * x[1] / 3;
}

/* The row at a fixed step; an adaptive one may be off by any amount. */
static motus_status choose(const char *name, double h, chosen *c)
{
    const motus_status status = row_choose(name, c, NULL, NULL);
    c->relative = HUGE_VAL;
    c->first = c->most = h;
    return status;
}

/* The trend: a straight line through the mean energies of windows of many periods, and its standard error. */
static void energy(method m)
{
    enum { WINDOWS = 24 };
    const motus_method *card = row_card(m);
    const problem p = {.nx = 2, .nv = 2, .accel = force, .jvp = slope, .traits = {.gradient = true, .smooth = true}};
    const double start_x[2] = {0.1, -0.2}, start_v[2] = {0.25, 0.1}, first = energy_of(start_x, start_v);
    /* an adaptive row is so exact that only a long step shows its trend */
    const double h = methods_table[m].adaptive      ? (card->order > 5   ? 1
                                                       : card->order > 3 ? 0.3
                                                                         : 0.1)
                     : isinf(card->stability_limit) ? 0.4
                     : card->stability_limit == 0   ? 0.02
                                                    : card->stability_limit / 10;
    const int samples = (int)(60 * 2 * M_PI / h);
    chosen c;
    stepper *s = NULL;
    if (choose(card->name, h, &c) ||
        stepper_create(&(machine){.problem = &p}, &c, 0, h, start_x, start_v, NULL, &s, NULL)) {
        judge(false, card->name, "energy", "no stepper");
        return;
    }
    double mean[WINDOWS] = {0}, most = 0;
    bool lost = false;
    for (int w = 0; w < WINDOWS && !lost; w++)
        for (int i = 0; i < samples; i++) {
            double x[2], v[2];
            if (stepper_advance(s, (stepper_limit){1, NAN}, NULL, NULL) || stepper_sync(s, x, v, NULL, NULL)) {
                lost = true;
                break;
            }
            const double off = energy_of(x, v) - first;
            mean[w] += off / samples;
            most = fmax(most, fabs(off));
        }
    double centre = 0, top = 0, bottom = 0, rest = 0;
    for (int w = 0; w < WINDOWS; w++) centre += mean[w] / WINDOWS;
    for (int w = 0; w < WINDOWS; w++) {
        top += (w - (WINDOWS - 1) / 2.0) * (mean[w] - centre);
        bottom += (w - (WINDOWS - 1) / 2.0) * (w - (WINDOWS - 1) / 2.0);
    }
    for (int w = 0; w < WINDOWS; w++) {
        const double off = mean[w] - centre - top / bottom * (w - (WINDOWS - 1) / 2.0);
        rest += off * off;
    }
    const double trend = top / bottom * WINDOWS, error = sqrt(rest / (WINDOWS - 2) / bottom) * WINDOWS;
    /* Rounding is a random walk: each of n steps may change the energy by some epsilon. */
    const double walk = 4 * DBL_EPSILON * sqrt((double)samples * WINDOWS);
    const bool keeps = card->symplectic, clear = lost || fabs(trend) > 4 * error + walk;
    judge(keeps ? !lost && !clear : clear, card->name, keeps ? "energy without trend" : "energy with trend",
          "%s trend %.1e ± %.1e, largest error %.1e, rounding %.1e", lost ? "(left the finite numbers)" : "", trend,
          error, most, walk);
    stepper_destroy(s);
}

static int fall(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)t, (void)x, (void)v;
    a[0] = -9.81;
    return 0;
}
static int no_slope(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    (void)ctx, (void)t, (void)x, (void)v, (void)dx, (void)dv;
    da[0] = 0;
    return 0;
}

/* Many small steps of free fall, in double. With compensated addition the speed is off by the rounding of the
 * coefficients at most, epsilon for each stage; a plain sum loses half a unit in the last place at each step, always
 * in the same direction. */
static void compensation(method m)
{
    const motus_method *card = row_card(m);
    const problem p = {.nx = 1, .nv = 1, .accel = fall, .jvp = no_slope, .traits = {.gradient = true, .affine = true}};
    const double zero = 0, h = 0.0001, speed = 9.81 * 200000 * h;
    double x = 0, v = 0;
    chosen c;
    stepper *s = NULL;
    if (choose(card->name, h, &c) || stepper_create(&(machine){.problem = &p}, &c, 0, h, &zero, &zero, NULL, &s, NULL))
        return;
    const bool ran =
        !stepper_advance(s, (stepper_limit){200000, NAN}, NULL, NULL) && !stepper_sync(s, &x, &v, NULL, NULL);
    stepper_destroy(s);
    /* products with weights above 1 are rounded as much more; generated ones are positive, and their sum is 1 */
    const coef *b = methods_table[m].tableau.b;
    double weights = b ? 0 : 1;
    for (int i = 0; b && i < methods_table[m].tableau.stages; i++) weights += fabs(b[i]);
    const double miss = fabs(v + speed) / speed, bound = (card->stages + 2) * weights * DBL_EPSILON;
    const bool words = methods_table[m].compensated;
    judge(ran && (words ? miss <= bound : miss > bound), card->name, words ? "compensated" : "not compensated",
          "speed off by %.1e of itself, bound %.1e", miss, bound);
}

/* The kicks of a compensated splitting add up to the step, and so do its drifts, but for the rounding of the smallest,
 * by half a unit, below h/4, and that twice; the sums of its drifts are exact. */
static void fitted(method m)
{
    enum { SIZES = 64, CONSTANTS_MAX = 256 };
    const problem p = {.nx = 1, .nv = 1, .accel = fall, .jvp = no_slope};
    double memory[CONSTANTS_MAX];
    chosen c;
    if (!methods_table[m].compensated || methods_table[m].family != SPLITTING) return;
    if (row_choose(row_card(m)->name, &c, NULL, NULL)) return;
    work w = stepper_plan(&p, &c, NULL);
    if (work_plan_size(&w) > CONSTANTS_MAX) abort();
    w = stepper_plan(&p, &c, memory);
    const int n = w.stages;
    quad off = 0, miss = 0;
    for (int size = 0; size < SIZES; size++) {
        const double h = 0.01 * (1 + size) / (size % 2 ? -7 : 3);
        quad kicks = 0, drifts = 0;
        work_scale(&w, h);
        for (int i = 0; i < n; i++) {
            kicks += w.scaled[i];
            drifts += w.scaled[n + i];
            const quad sum = (quad)w.scaled[2 * n + 1 + i] + w.scaled[3 * n + 1 + i];
            if (quad_abs(sum - drifts) > miss * quad_abs((quad)h)) miss = quad_abs((sum - drifts) / h);
        }
        const quad k = quad_abs(kicks / h - 1), d = quad_abs(drifts / h - 1);
        off = k > off ? k : off;
        off = d > off ? d : off;
    }
    judge(off <= DBL_EPSILON / 4 && miss <= DBL_EPSILON * DBL_EPSILON, row_card(m)->name, "adds up to the step",
          "off by %.1e, sums of drifts by %.1e", (double)off, (double)miss);
}

int laws_kepler(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)t, (void)v;
    const double square = x[0] * x[0] + x[1] * x[1], cube = square * sqrt(square);
    a[0] = -x[0] / cube;
    a[1] = -x[1] / cube;
    return 0;
}

/* The energy of a planet, which is -1/2, off by these numbers after so many steps and after SPREAD times as many. */
static bool energies(method m, double e, int steps, int spread, double off[2])
{
    const problem p = {.nx = 2, .nv = 2, .accel = laws_kepler, .traits = {.gradient = true, .smooth = true}};
    const double h = 2 * M_PI / 40, x[2] = {1 - e, 0}, v[2] = {0, sqrt((1 + e) / (1 - e))};
    const double first = (v[0] * v[0] + v[1] * v[1]) / 2 - 1 / x[0];
    chosen c;
    stepper *s = NULL;
    bool ran =
        !choose(row_card(m)->name, h, &c) && !stepper_create(&(machine){.problem = &p}, &c, 0, h, x, v, NULL, &s, NULL);
    for (int i = 0; ran && i < 2; i++) {
        double at[2], speed[2];
        ran = !stepper_advance(s, (stepper_limit){i ? (int64_t)steps * (spread - 1) : steps, NAN}, NULL, NULL) &&
              !stepper_sync(s, at, speed, NULL, NULL);
        off[i] = (speed[0] * speed[0] + speed[1] * speed[1]) / 2 - 1 / hypot(at[0], at[1]) - first;
    }
    stepper_destroy(s);
    return ran;
}

/* Brouwer's law: where nothing but rounding is left, without bias, the energy errs like a random walk, as the square
 * root of time. The root mean square of n numbers is known to 1/√(2n) of itself; a bias would give the power 1. */
static void brouwer(method m)
{
    enum { STARTS = 64, STEPS = 1024, SPREAD = 32 };
    double square[2] = {0, 0};
    bool ran = true;
    for (int i = 0; i < STARTS && ran; i++) {
        double off[2];
        ran = energies(m, 0.1 + 0.1 * i / STARTS, STEPS, SPREAD, off);
        for (int k = 0; k < 2; k++) square[k] += off[k] * off[k] / STARTS;
    }
    const double power = log(square[1] / square[0]) / 2 / log(SPREAD),
                 margin = 3 * sqrt(2.0 / (2 * STARTS)) / log(SPREAD);
    judge(ran && fabs(power - 0.5) < margin, row_card(m)->name, "Brouwer's law",
          "energy off by %.1e, then %.1e: the power %.3f of time, margin %.3f", sqrt(square[0]), sqrt(square[1]), power,
          margin);
}

void laws_of_stability(void)
{
    for (method m = 0; m < row_count(); m++) {
        const motus_method *card = row_card(m);
        /* boris needs a velocity term; without one it is leapfrog */
        if (methods_table[m].family == EXACT || methods_table[m].gyroscopic || methods_table[m].expands) continue;
        limit(m);
        fitted(m);
        if (card->order >= 6 || card->order == 4) compensation(m);
        /* Newmark and Beeman are conjugate to symplectic maps: they are not declared symplectic, and have no trend
         * either. */
        if (methods_table[m].family == RUNGE_KUTTA || row_card(m)->symplectic) energy(m);
        if (methods_table[m].family == RADAU || (methods_table[m].family == IMPLICIT && card->order > 12)) brouwer(m);
    }
}
