/* LAWS OF LONG RUNS: the stability limit on the oscillator, found by bisection, is the one on the card; the energy of symplectic rows
 * has no trend, that of the others has.
 */
#include "core/rows.h"
#include "core/stepper.h"
#include "test/laws.h"

#include <math.h>
#include <stdio.h>

/* Spectral radius of one step's matrix over (x, v), less 1, at step z on x'' = -x. */
static quad excess(method m, quad z)
{
    const quad_problem *p = &quad_problems[OSCILLATOR];
    quad j[2][2];
    for (int c = 0; c < 2; c++) {
        quad_state s = {.x = {c == 0}, .v = {c == 1}};
        quad_run(m, NULL, p, 0, z, 1, &s);
        j[0][c] = s.x[0];
        j[1][c] = s.v[0];
    }
    const quad half = (j[0][0] + j[1][1]) / 2, determinant = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    const double square = (double)(half * half - determinant);
    return square <= 0 ? determinant - 1 : (quad)(fabs((double)half) - 1 + sqrt(square));      /* sign is what counts */
}

/* Methods whose first step is not their rule: does the motion stay bounded over many steps? A double eigenvalue splits like a square
 * root, so 1e-5 beyond the limit the growth is e^(8000 * 0.004). */
static bool explodes(method m, quad z)
{
    quad_state s = {.x = {1}, .v = {Q(0.3)}};
    quad_run(m, NULL, &quad_problems[OSCILLATOR], 0, z, 8000, &s);
    return !(quad_abs(s.x[0]) < Q(1e8));
}

static bool unstable(method m, quad z)
{
    const bool one_step = methods_table[m].family != BEEMAN;
    return one_step ? excess(m, z) > Q(1e-12) : explodes(m, z);
}

static void limit(method m)
{
    const motus_method *card = row_card(m);
    const bool coarse = methods_table[m].family == BEEMAN;
    if (isinf(card->stability_limit)) {
        double worst = 0;
        for (double z = 0.01; z < 1e5; z *= 1.7) worst = fmax(worst, (double)excess(m, (quad)z));
        judge(worst < 1e-12, card->name, "stability", "never grows by more than %.1e a step, up to hω = 1e5", worst);
        return;
    }
    /* Stable on a grid up to the stored limit; then the crossing itself, which may be a narrow window, by bisection around it. */
    const quad stored = (quad)card->stability_limit;
    quad low = 0, high = stored == 0 ? Q(0.05) : stored * (coarse ? Q(1.001) : Q(1.00002));
    int early = 0;
    for (int i = 1; i < (coarse ? 20 : 600) && stored > 0; i++) early += unstable(m, stored * i / (coarse ? 20 : 600));
    if (stored > 0) low = stored * Q(0.999);
    const bool bracketed = early == 0 && unstable(m, high) && (stored == 0 || !unstable(m, low));
    while (bracketed && high - low > (coarse ? Q(1e-4) : Q(1e-14))) {
        const quad middle = (low + high) / 2;
        if (unstable(m, middle)) high = middle;
        else low = middle;
    }
    /* A limit of 0: growth from the smallest step on, which the matrix shows down to where z^4/8 drowns in the threshold. */
    const double found = stored == 0 && low < Q(0.003) ? 0 : (double)low, margin = coarse ? 2e-4 : 1e-9;
    judge(bracketed && fabs(found - card->stability_limit) <= margin, card->name, "stability", "limit found %.12g, stored %.12g%s", found,
          card->stability_limit, bracketed ? "" : " (no crossing there)");
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

/* The run is cut into windows of many periods; a straight line through their mean energies, and its standard error. */
static void energy(method m)
{
    enum { WINDOWS = 24 };
    const motus_method *card = row_card(m);
    const problem p = {.nx = 2, .nv = 2, .accel = force, .jvp = slope, .traits = {.gradient = true, .smooth = true}};
    const double start_x[2] = {0.1, -0.2}, start_v[2] = {0.25, 0.1}, first = energy_of(start_x, start_v);
    const double h = isinf(card->stability_limit) ? 0.4 : card->stability_limit == 0 ? 0.02 : card->stability_limit / 10;
    const int samples = (int)(60 * 2 * M_PI / h);
    chosen c;
    stepper *s = NULL;
    if (row_choose(card->name, &c, NULL, NULL) || stepper_create(&(machine){.problem = &p}, &c, 0, h, start_x, start_v, NULL, &s, NULL)) {
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
    /* Rounding walks: each of n steps may change the energy by some epsilon. */
    const double walk = 4 * DBL_EPSILON * sqrt((double)samples * WINDOWS);
    const bool keeps = card->symplectic, clear = lost || fabs(trend) > 4 * error + walk;
    judge(keeps ? !lost && !clear : clear, card->name, keeps ? "energy without trend" : "energy with trend",
          "%s trend %.1e ± %.1e, largest error %.1e, rounding %.1e", lost ? "(left the finite numbers)" : "", trend, error, most, walk);
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

/* Many small steps of free fall, in double. With error words the speed is off by the rounding of the coefficients at most, epsilon for
 * each stage; a plain sum loses half a unit in the last place again and again, all in the same direction. */
static void compensation(method m)
{
    const motus_method *card = row_card(m);
    const problem p = {.nx = 1, .nv = 1, .accel = fall, .jvp = no_slope, .traits = {.gradient = true, .affine = true}};
    const double zero = 0, h = 0.0001, speed = 9.81 * 200000 * h;
    double x = 0, v = 0;
    chosen c;
    stepper *s = NULL;
    if (row_choose(card->name, &c, NULL, NULL) || stepper_create(&(machine){.problem = &p}, &c, 0, h, &zero, &zero, NULL, &s, NULL)) return;
    const bool ran = !stepper_advance(s, (stepper_limit){200000, NAN}, NULL, NULL) && !stepper_sync(s, &x, &v, NULL, NULL);
    stepper_destroy(s);
    const double miss = fabs(v + speed) / speed, bound = (card->stages + 2) * DBL_EPSILON;
    const bool words = methods_table[m].compensated;
    judge(ran && (words ? miss <= bound : miss > bound), card->name, words ? "compensated" : "not compensated", "speed off by %.1e of itself, bound %.1e", miss, bound);
}

void laws_of_stability(void)
{
    for (method m = 0; m < row_count(); m++) {
        const motus_method *card = row_card(m);
        if (methods_table[m].family == EXACT || methods_table[m].gyroscopic) continue;      /* boris needs a velocity term; without one it is leapfrog */
        limit(m);
        if (card->order >= 6 || card->order == 4) compensation(m);
        /* Newmark and Beeman are conjugate to symplectic maps: no claim, and no trend to be seen either. */
        if (methods_table[m].family == RUNGE_KUTTA || row_card(m)->symplectic) energy(m);
    }
}
