/* The spectral radius of one step: motus_stability.
 *
 * It is measured with the rows themselves, by steps of size 1 on x'' = 2 s x' - (s² + w²) x. The results from the
 * starts (1, 0) and (0, 1) are the columns of the step's matrix over (x, v). One state holds several points, as
 * uncoupled equations.
 *
 * Two-step methods carry more than (x, v) from step to step. Verlet's d is a combination of x and v, so its step is
 * still a map of (x, v). Beeman's old acceleration is not; but after one step it is a linear map of the start, as (x,
 * v) are, so the matrix can be taken from step 1 to step 2. A trial tells these cases apart: in the first, two steps
 * are the square of one.
 *
 * Invariant: all memory is on the stack; a point without a result does not affect the others.
 */
#include "api/why/evidence.h"

#include <math.h>

/* Room for a stepper of POINTS points; gauss8, the largest, takes 16 KiB. */
enum { POINTS = 8, PLACES = 2 * POINTS, ROOM = 24 << 10 };
/* By rounding, two steps and the square of one differ by less; where a method carries more, by more than 1e-3. */
#define FORGETFUL 1e-6
#define GROWS 1e-9     /* a spectral radius above 1 by more is growth */
#define BOUND_MOST 1e3 /* largest step times rate of the BOUNDS points at which a bound is sought */
enum { BOUNDS = 64 };

typedef struct matrix {
    double xx, xv, vx, vv;
} matrix; /* x = xx x + xv v, v = vx x + vv v */

typedef struct plane {
    chosen chosen;
    bool remembers;                            /* the method carries more than (x, v), as Beeman's does */
    size_t count;                              /* points in the state */
    double damping[PLACES], stiffness[PLACES]; /* the coefficients of v and x in equation k */
    motus_allocator allocator;                 /* hands out `room`, and releases nothing */
    size_t used;
    _Alignas(64) char room[ROOM];
} plane;

static void *allocate(void *context, size_t bytes)
{
    plane *p = context;
    const size_t rounded = (bytes + 15) & ~(size_t)15;
    if (rounded < bytes || rounded > ROOM - p->used) return NULL;
    p->used += rounded;
    return p->room + p->used - rounded;
}

static void release(void *context, void *block) { (void)context, (void)block; }

/* ---- the equation ---- */

static int accel(void *ctx, double t, double *x, double *v, double *a)
{
    const plane *p = ctx;
    (void)t;
    for (size_t k = 0; k < 2 * p->count; k++) a[k] = p->damping[k] * v[k] + p->stiffness[k] * x[k];
    return 0;
}

static int jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    const plane *p = ctx;
    (void)t, (void)x, (void)v;
    for (size_t k = 0; k < 2 * p->count; k++)
        da[k] = (dv ? p->damping[k] * dv[k] : 0) + (dx ? p->stiffness[k] * dx[k] : 0);
    return 0;
}

/* Makes room for Taylor series of x and v, `length` numbers each, which give coefficient n of a. */
static size_t series_numbers(void *ctx, int length) { return (void)ctx, (size_t)length; }

static void series(void *ctx, int length, int n, double t, double *x, double *v, double *a, double *kept)
{
    const plane *p = ctx;
    (void)t, (void)kept;
    for (size_t k = 0; k < 2 * p->count; k++) {
        const size_t at = k * (size_t)length + (size_t)n;
        a[k] = p->damping[k] * v[at] + p->stiffness[k] * x[at];
    }
}

static void pattern(void *ctx, bool in_v, void (*emit)(void *arg, size_t row, size_t column), void *arg)
{
    const plane *p = ctx;
    (void)in_v;
    for (size_t k = 0; k < 2 * p->count; k++) emit(arg, k, k);
}

static void place(plane *p, size_t k, double re, double im)
{
    for (size_t i = 2 * k; i < 2 * k + 2; i++) {
        p->damping[i] = 2 * re;
        p->stiffness[i] = -(re * re + im * im);
    }
}

/* Returns whether the method admits the equation. On the imaginary axis the force does not depend on the velocity, so
 * every method that takes steps does; one that needs a gyroscopic term v × B gets a term that is 0. */
static bool admitted(const plane *p, bool on_axis, traits *out)
{
    *out = (traits){.velocity = !on_axis,
                    .linear_v = true,
                    .constant_jv = true,
                    .affine = true,
                    .gradient = on_axis,
                    .smooth = true,
                    .series = true};
    if (row_admits(&p->chosen, out, NULL) == MOTUS_OK) return true;
    out->velocity = out->gyroscopic = on_axis;
    return on_axis && row_admits(&p->chosen, out, NULL) == MOTUS_OK;
}

/* ---- steps ---- */

/* Finds the matrices of one step, and of two unless `next` is NULL. */
static motus_status walk(plane *p, const traits *traits, matrix *first, matrix *next, motus_error *err)
{
    const size_t n = 2 * p->count;
    const problem problem = {.ctx = p,
                             .nx = n,
                             .nv = n,
                             .traits = *traits,
                             .accel = accel,
                             .jvp = jvp,
                             .pattern = pattern,
                             .series_numbers = series_numbers,
                             .series = series};
    double x[PLACES], v[PLACES];
    for (size_t k = 0; k < n; k++) {
        x[k] = k % 2 == 0;
        v[k] = k % 2 == 1;
    }
    p->used = 0;
    stepper *s = NULL;
    motus_status status =
        stepper_create(&(machine){.problem = &problem}, &p->chosen, 0, 1, x, v, &p->allocator, &s, err);
    for (matrix *out = first; out && status == MOTUS_OK; out = out == first ? next : NULL) {
        status = stepper_advance(s, (stepper_limit){1, NAN}, NULL, err);
        if (status == MOTUS_OK) status = stepper_sync(s, x, v, NULL, err);
        for (size_t k = 0; k < p->count && status == MOTUS_OK; k++)
            out[k] = (matrix){x[2 * k], x[2 * k + 1], v[2 * k], v[2 * k + 1]};
    }
    stepper_destroy(s);
    return status;
}

static double determinant(matrix m) { return m.xx * m.vv - m.xv * m.vx; }

static matrix product(matrix a, matrix b)
{
    return (matrix){a.xx * b.xx + a.xv * b.vx, a.xx * b.xv + a.xv * b.vv, a.vx * b.xx + a.vv * b.vx,
                    a.vx * b.xv + a.vv * b.vv};
}

/* Returns the matrix M with M first = next. */
static matrix quotient(matrix next, matrix first)
{
    const double d = determinant(first);
    return product(next, (matrix){first.vv / d, -first.xv / d, -first.vx / d, first.xx / d});
}

/* Returns the larger |eigenvalue|; `square` is the square of half their difference. */
static double radius_of(matrix m)
{
    const double half = (m.xx + m.vv) / 2, apart = (m.xx - m.vv) / 2, square = apart * apart + m.xv * m.vx;
    const double r = square < 0 ? sqrt(half * half - square) : fabs(half) + sqrt(square);
    return isfinite(r) ? r : INFINITY;
}

/* Finds out whether the method remembers, at z = i/2, where its step differs clearly from one without a force. */
static motus_status remember(plane *p, motus_error *err)
{
    traits traits;
    matrix first, next;
    if (!admitted(p, true, &traits)) {
        fail(err, MOTUS_METHOD, "%s takes no steps on an oscillator: it has no stability region", p->chosen.name);
        hint(err, "the exact motion grows by e^Re(z)");
        return MOTUS_METHOD;
    }
    p->count = 1;
    place(p, 0, 0, 0.5);
    motus_status status = walk(p, &traits, &first, &next, err);
    if (status != MOTUS_OK) return status;
    const matrix square = product(first, first);
    const double off = fmax(fmax(fabs(next.xx - square.xx), fabs(next.xv - square.xv)),
                            fmax(fabs(next.vx - square.vx), fabs(next.vv - square.vv)));
    p->remembers = off > FORGETFUL;
    return MOTUS_OK;
}

/* Computes the points at[0 … count); if that fails, each of them by itself. */
static motus_status ask(plane *p, const traits *traits, const size_t *at, size_t count, const double *re,
                        const double *im, double *radius, motus_error *err)
{
    matrix first[POINTS], next[POINTS];
    p->count = count;
    for (size_t k = 0; k < count; k++) place(p, k, re[at[k]], im[at[k]]);
    motus_status status = walk(p, traits, first, p->remembers ? next : NULL, NULL);
    if (status == MOTUS_DIVERGED || status == MOTUS_SOLVE) {
        for (size_t k = 0; k < count && count > 1; k++)
            if ((status = ask(p, traits, at + k, 1, re, im, radius, err)) != MOTUS_OK) return status;
        if (count == 1) radius[*at] = INFINITY;
        return MOTUS_OK;
    }
    if (status != MOTUS_OK)
        return fail(err, status, "the stability of %s could not be computed: %s", p->chosen.name,
                    motus_status_text(status));
    for (size_t k = 0; k < count; k++) radius[at[k]] = radius_of(p->remembers ? quotient(next[k], first[k]) : first[k]);
    return MOTUS_OK;
}

static motus_status ask_all(plane *p, bool on_axis, size_t count, const double *re, const double *im, double *radius,
                            motus_error *err)
{
    traits traits;
    const bool asked = admitted(p, on_axis, &traits);
    size_t at[POINTS], waiting = 0;
    for (size_t k = 0; k <= count; k++) {
        if (k < count && (re[k] == 0) == on_axis) {
            if (asked)
                at[waiting++] = k;
            else
                radius[k] = NAN;
        }
        if (waiting == POINTS || (k == count && waiting)) {
            motus_status status = ask(p, &traits, at, waiting, re, im, radius, err);
            if (status != MOTUS_OK) return status;
            waiting = 0;
        }
    }
    return MOTUS_OK;
}

static motus_status check(size_t count, const double *re, const double *im, motus_error *err)
{
    for (size_t k = 0; k < count; k++)
        if (!(hypot(re[k], im[k]) <= MOTUS_STABILITY_FAR))
            return fail(err, MOTUS_ARGUMENT, "point %zu, %g + %g i, is not a finite number within %g of 0", k + 1,
                        re[k], im[k], MOTUS_STABILITY_FAR);
    return MOTUS_OK;
}

motus_status motus_stability(const char *method, size_t count, const double *re, const double *im, double *radius,
                             motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!method || (count && (!re || !im || !radius)))
        return fail(err, MOTUS_ARGUMENT, "motus_stability needs a method, points and a place for the radii");
    plane p;
    p.allocator = (motus_allocator){allocate, release, &p};
    modes m = modes_enter();
    motus_status status = row_choose(method, &p.chosen, NULL, err);
    p.chosen.relative = HUGE_VAL; /* an adaptive method accepts every error, so each step is 1 */
    p.chosen.first = p.chosen.least = p.chosen.most = 1;
    if (status == MOTUS_OK) status = check(count, re, im, err);
    if (status == MOTUS_OK) status = remember(&p, err);
    if (status == MOTUS_OK) status = ask_all(&p, true, count, re, im, radius, err);
    if (status == MOTUS_OK) status = ask_all(&p, false, count, re, im, radius, err);
    modes_leave(m);
    return status;
}

double stability_bound(const char *method, double re, double im)
{
    double at_re[BOUNDS], at_im[BOUNDS], radius[BOUNDS], bound = 0;
    const double size = hypot(re, im);
    for (int i = 0; i < BOUNDS; i++) {
        const double z = BOUND_MOST * exp2(-10.0 * (BOUNDS - 1 - i) / (BOUNDS - 1));
        at_re[i] = z * re / size, at_im[i] = z * fabs(im) / size;
    }
    if (motus_stability(method, BOUNDS, at_re, at_im, radius, NULL) != MOTUS_OK) return 0;
    if (isinf(radius[0])) return NAN;
    for (int i = 0; i < BOUNDS && radius[i] <= 1 + GROWS; i++) bound = hypot(at_re[i], at_im[i]);
    return bound;
}
