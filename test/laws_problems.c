/* The test problems of the laws, and their exact motion.
 *
 * Together they have every term of the theory: several degrees of freedom, nonlinear coupling, explicit time,
 * velocity terms that are not diagonal. One-dimensional, autonomous or linear problems would let wrong coefficients
 * pass.
 */
#include "test/laws.h"

#include <string.h>

typedef const quad *in;

static void free_fall(quad t, in x, in v, quad *a)
{
    (void)t, (void)x, (void)v;
    a[0] = 0;
    a[1] = Q(-9.81);
}
static void free_fall_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    (void)t, (void)x, (void)v, (void)dx, (void)dv;
    da[0] = da[1] = 0;
}

static void oscillator(quad t, in x, in v, quad *a)
{
    (void)t, (void)v;
    a[0] = -x[0];
}
static void oscillator_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    (void)t, (void)x, (void)v, (void)dv;
    da[0] = -dx[0];
}

/* The gradient of a cubic potential. */
static void henon_heiles(quad t, in x, in v, quad *a)
{
    (void)t, (void)v;
    a[0] = -x[0] - 2 * x[0] * x[1];
    a[1] = -x[1] - x[0] * x[0] + x[1] * x[1];
}
static void henon_heiles_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    (void)t, (void)v, (void)dv;
    da[0] = -dx[0] - 2 * (x[0] * dx[1] + dx[0] * x[1]);
    da[1] = -dx[1] - 2 * x[0] * dx[0] + 2 * x[1] * dx[1];
}

/* The same, driven: time enters alone and multiplied with x. */
static void driven(quad t, in x, in v, quad *a)
{
    henon_heiles(t, x, v, a);
    a[0] += 1 / (1 + t * t);
    a[1] += Q(0.5) * t * x[0] - Q(0.25) * t * t;
}
static void driven_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    henon_heiles_jvp(t, x, v, dx, dv, da);
    da[1] += Q(0.5) * t * dx[0];
}

/* A first-order variable that acts on nothing: s' = f(x, t). */
static void rider(quad t, in x, in v, quad *a)
{
    driven(t, x, v, a);
    a[2] = x[0] * x[1] + t * x[1] - Q(0.5);
}
static void rider_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    driven_jvp(t, x, v, dx, dv, da);
    da[2] = dx[0] * x[1] + x[0] * dx[1] + t * dx[1];
}

/* One that acts on nothing but reads v, not as a polynomial. */
static void follower(quad t, in x, in v, quad *a)
{
    driven(t, x, v, a);
    a[2] = v[0] * v[0] + x[1] * v[1] / (1 + v[0] * v[0] + t * t) - t * x[0];
}
static void follower_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    const quad below = 1 + v[0] * v[0] + t * t;
    driven_jvp(t, x, v, dx, dv, da);
    da[2] = 2 * v[0] * dv[0] + (dx[1] * v[1] + x[1] * dv[1]) / below -
            x[1] * v[1] * 2 * v[0] * dv[0] / (below * below) - t * dx[0];
}

/* Linear in v, with coefficients that depend on x and t, and not symmetric. */
static void damped(quad t, in x, in v, quad *a)
{
    driven(t, x, v, a);
    a[0] += -Q(0.3) * v[0] + x[1] * v[1];
    a[1] += -(Q(0.2) + t * Q(0.1)) * v[1] - Q(0.4) * x[0] * v[0];
}
static void damped_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    driven_jvp(t, x, v, dx, dv, da);
    da[0] += -Q(0.3) * dv[0] + dx[1] * v[1] + x[1] * dv[1];
    da[1] += -(Q(0.2) + t * Q(0.1)) * dv[1] - Q(0.4) * (dx[0] * v[0] + x[0] * dv[0]);
}

/* Nonlinear in v, with a first-order variable that enters the force: s' = f(x, v, s, t). */
static void tangled(quad t, in x, in v, quad *a)
{
    driven(t, x, v, a);
    a[0] += -Q(0.3) * v[0] * (1 + v[1] * v[1]) + Q(0.2) * v[2] * v[0];
    a[1] += -Q(0.1) * v[1] * v[1] * v[1] + Q(0.3) * x[0] * v[0] * v[1] + v[2];
    a[2] = v[0] * v[1] - Q(0.5) * v[2] + t * x[0];
}
static void tangled_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    driven_jvp(t, x, v, dx, dv, da);
    da[0] += -Q(0.3) * (dv[0] * (1 + v[1] * v[1]) + 2 * v[0] * v[1] * dv[1]) + Q(0.2) * (dv[2] * v[0] + v[2] * dv[0]);
    da[1] += -Q(0.3) * v[1] * v[1] * dv[1] +
             Q(0.3) * (dx[0] * v[0] * v[1] + x[0] * dv[0] * v[1] + x[0] * v[0] * dv[1]) + dv[2];
    da[2] = dv[0] * v[1] + v[0] * dv[1] - Q(0.5) * dv[2] + t * dx[0];
}

/* E(x, t) + v × B(x), B without divergence. */
static void field(in x, quad b[3])
{
    b[0] = x[1] * x[2] + Q(0.3);
    b[1] = x[0] * x[2] - Q(0.2);
    b[2] = 1 + x[0] * x[1];
}
static void magnet(quad t, in x, in v, quad *a)
{
    quad b[3];
    field(x, b);
    a[0] = v[1] * b[2] - v[2] * b[1] - x[0] + Q(0.2) * t;
    a[1] = v[2] * b[0] - v[0] * b[2] - x[1] * x[1];
    a[2] = v[0] * b[1] - v[1] * b[0] - x[2] + x[0] * x[1];
}
static void magnet_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    (void)t;
    quad b[3];
    field(x, b);
    const quad db[3] = {dx[1] * x[2] + x[1] * dx[2], dx[0] * x[2] + x[0] * dx[2], dx[0] * x[1] + x[0] * dx[1]};
    da[0] = dv[1] * b[2] - dv[2] * b[1] + v[1] * db[2] - v[2] * db[1] - dx[0];
    da[1] = dv[2] * b[0] - dv[0] * b[2] + v[2] * db[0] - v[0] * db[2] - 2 * x[1] * dx[1];
    da[2] = dv[0] * b[1] - dv[1] * b[0] + v[0] * db[1] - v[1] * db[0] - dx[2] + dx[0] * x[1] + x[0] * dx[1];
}

/* models/damped-cubic.motus and models/charged-particle.motus. */
static void cubic(quad t, in x, in v, quad *a)
{
    (void)t;
    a[0] = -v[0] - x[0] * x[0] * x[0];
}
static void cubic_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    (void)t, (void)v;
    da[0] = -dv[0] - 3 * x[0] * x[0] * dx[0];
}
static void particle(quad t, in x, in v, quad *a)
{
    (void)t, (void)x;
    a[0] = Q(0.5) + 2 * v[1];
    a[1] = -2 * v[0];
    a[2] = 0;
}
static void particle_jvp(quad t, in x, in v, in dx, in dv, quad *da)
{
    (void)t, (void)x, (void)v, (void)dx;
    da[0] = 2 * dv[1];
    da[1] = -2 * dv[0];
    da[2] = 0;
}

#define HH_START .x = {Q(0.12), Q(-0.25)}, .v = {Q(0.42), Q(0.1), Q(0.3)}
const quad_problem quad_problems[PROBLEMS] = {
    [FREE_FALL] = {"free fall", 2, 2, .gradient = true, .x = {0}, .v = {1, Q(4.5)}, .accel = free_fall,
                   .jvp = free_fall_jvp},
    [OSCILLATOR] = {"oscillator", 1, 1, .gradient = true, .x = {1}, .v = {0}, .accel = oscillator,
                    .jvp = oscillator_jvp},
    [HENON_HEILES] = {"henon-heiles", 2, 2, .gradient = true, HH_START, .accel = henon_heiles, .jvp = henon_heiles_jvp},
    [DRIVEN] = {"driven", 2, 2, .time = true, .gradient = false, HH_START, .accel = driven, .jvp = driven_jvp},
    [RIDER] = {"rider", 2, 3, .time = true, HH_START, .accel = rider, .jvp = rider_jvp},
    [DAMPED] = {"damped", 2, 2, .velocity = true, .linear = true, .time = true, HH_START, .accel = damped,
                .jvp = damped_jvp},
    [TANGLED] = {"tangled", 2, 3, .velocity = true, .time = true, HH_START, .accel = tangled, .jvp = tangled_jvp},
    [MAGNET] = {"magnet", 3, 3, .velocity = true, .linear = true, .time = true, .gyroscopic = true,
                .x = {Q(0.3), Q(-0.2), Q(0.1)}, .v = {Q(0.5), Q(0.4), Q(-0.3)}, .accel = magnet, .jvp = magnet_jvp},
    [FOLLOWER] = {"follower", 2, 3, .velocity = true, .time = true, .quadrature = true, HH_START, .accel = follower,
                  .jvp = follower_jvp},
    [CUBIC] = {"damped cubic", 1, 1, .velocity = true, .linear = true, .x = {10}, .accel = cubic, .jvp = cubic_jvp},
    [PARTICLE] = {"charged particle", 3, 3, .velocity = true, .linear = true, .gyroscopic = true, .v = {1, 0, Q(0.25)},
                  .accel = particle, .jvp = particle_jvp},
};

quad quad_distance(const quad_problem *p, const quad_state *a, const quad_state *b)
{
    quad most = 0;
    for (size_t k = 0; k < p->nx + p->nv; k++) {
        quad d = k < p->nx ? a->x[k] - b->x[k] : a->v[k - p->nx] - b->v[k - p->nx];
        if (d < 0) d = -d;
        if (!(d <= most)) most = d;
    }
    return most;
}

/* Gragg's midpoint rule with n substeps: its error has even powers of 1/n only. */
static void gragg(const quad_problem *p, quad t, quad h, int n, const quad_state *from, quad_state *to)
{
    const quad d = h / n;
    quad_state last = *from, now, next;
    quad a[DIMENSIONS];
    p->accel(t, last.x, last.v, a);
    now = last;
    for (size_t k = 0; k < p->nx; k++) now.x[k] += d * last.v[k];
    for (size_t k = 0; k < p->nv; k++) now.v[k] += d * a[k];
    for (int i = 1; i < n; i++) {
        p->accel(t + i * d, now.x, now.v, a);
        next = last;
        for (size_t k = 0; k < p->nx; k++) next.x[k] += 2 * d * now.v[k];
        for (size_t k = 0; k < p->nv; k++) next.v[k] += 2 * d * a[k];
        last = now;
        now = next;
    }
    *to = now;
}

void quad_reference(const quad_problem *p, quad t0, quad t1, quad_state *state)
{
    quad_reference_in(p, 256, t0, t1, state);
}

void quad_reference_in(const quad_problem *p, int pieces, quad t0, quad t1, quad_state *state)
{
    enum { COLUMNS = 9 };
    const quad h = (t1 - t0) / pieces;
    for (int piece = 0; piece < pieces; piece++) {
        quad_state table[COLUMNS];
        for (int j = 0; j < COLUMNS; j++) {
            gragg(p, t0 + piece * h, h, 2 * (j + 1), state, &table[j]);
            for (int i = j - 1; i >= 0; i--) { /* Aitken and Neville's extrapolation in (1/n)² */
                const quad ratio = (quad)((j + 1) * (j + 1)) / ((i + 1) * (i + 1));
                for (size_t k = 0; k < DIMENSIONS; k++) {
                    table[i].x[k] = table[i + 1].x[k] + (table[i + 1].x[k] - table[i].x[k]) / (ratio - 1);
                    table[i].v[k] = table[i + 1].v[k] + (table[i + 1].v[k] - table[i].v[k]) / (ratio - 1);
                }
            }
        }
        *state = table[0];
    }
}

quad_state quad_motion(const quad_problem *p, quad t)
{
    enum { KNOWN = PROBLEMS + EXPANDED };
    static struct {
        const quad_problem *problem;
        quad t;
        quad_state state;
    } known[KNOWN];
    int i = 0;
    while (i < KNOWN && known[i].problem && (known[i].problem != p || known[i].t != t)) i++;
    if (i == KNOWN) i = 0;
    if (known[i].problem == p && known[i].t == t) return known[i].state;
    quad_state state = {0};
    for (size_t k = 0; k < p->nx; k++) state.x[k] = p->x[k];
    for (size_t k = 0; k < p->nv; k++) state.v[k] = p->v[k];
    quad_reference(p, 0, t, &state);
    known[i].problem = p, known[i].t = t, known[i].state = state;
    return state;
}
