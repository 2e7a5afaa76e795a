/* A motion followed by the embedded pair of orders 3 and 2 [BogackiShampine89], and its turning points counted.
 *
 * A number swings where its velocity changes its sign again and again; one that only goes on, as a pendulum that turns
 * over, where its acceleration does. Invariant: the same bits on every machine, and nothing about the system changes.
 */
#include "api/follow.h"

#include "api/vector.h"

#include <math.h>
#include <string.h>

#define TOLERANCE 1e-5      /* of a step, relative to the size of each number */
#define NEGLIGIBLE 1e-3     /* of the largest so far: a sign of less is none */
#define CHANGE_OF_STEP 11.8 /* `change` of a harmonic motion in its steps at this tolerance */
#define SWINGS 3            /* of each number, so many are waited for, */
#define SWINGS_MOST 100     /*   and so many of the fastest */
#define INFINITE 1e8        /* times the size of the start */
enum { SETTLED = 8 };       /* steps, until their length no longer follows from the first, or from a kink */

/* The sign of one number in time. */
typedef struct signal {
    double largest, time, value; /* the last value that was not negligible */
    double first, last;          /* changes of sign */
    uint32_t changes;
} signal;

typedef struct follower {
    const problem *problem;
    double t, way, rate, h, elapsed;
    double *x, *v, *a;         /* now */
    double *stage_x, *stage_v; /* of a stage, and at the end of the step */
    double *slope_x[4], *slope_v[4];
    double *largest_x, *largest_v;
    signal *signals;        /* of the velocity of each number of v, then of its acceleration */
    size_t falling;         /* the position with the largest force at the start, */
    double force, side;     /*   this force, and the sign of the position before it comes to 0 */
    double usual, shortest; /* a mean of the last steps, and the least that it was */
    uint32_t taken;
} follower;

static bool evaluate(follower *f, double t, double *x, double *v, double *a)
{
    const problem *p = f->problem;
    memset(a, 0, p->nv * sizeof *a);
    if (p->refresh) p->refresh(p->ctx, t, x, v);
    return p->accel(p->ctx, t, x, v, a) == 0 && isfinite(vector_largest(a, p->nv));
}

/* The end of a step of length h goes to the stage; its error in units of the tolerance, NaN: it is not finite. */
static double attempt(follower *f, double h)
{
    static const double row[3][3] = {{1.0 / 2}, {0, 3.0 / 4}, {2.0 / 9, 1.0 / 3, 4.0 / 9}},
                        at[] = {1.0 / 2, 3.0 / 4, 1}, error[] = {-5.0 / 72, 1.0 / 12, 1.0 / 9, -1.0 / 8};
    const size_t nx = f->problem->nx, nv = f->problem->nv;
    if (nx) memcpy(f->slope_x[0], f->v, nx * sizeof(double));
    memcpy(f->slope_v[0], f->a, nv * sizeof(double));
    for (int s = 0; s < 3; s++) {
        for (size_t k = 0; k < nx; k++) {
            double sum = 0;
            for (int i = 0; i <= s; i++) sum += row[s][i] * f->slope_x[i][k];
            f->stage_x[k] = f->x[k] + h * sum;
        }
        for (size_t k = 0; k < nv; k++) {
            double sum = 0;
            for (int i = 0; i <= s; i++) sum += row[s][i] * f->slope_v[i][k];
            f->stage_v[k] = f->v[k] + h * sum;
        }
        if (!evaluate(f, f->t + at[s] * h, f->stage_x, f->stage_v, f->slope_v[s + 1])) return NAN;
        if (nx) memcpy(f->slope_x[s + 1], f->stage_v, nx * sizeof(double));
    }
    /* Numbers that are 0 at first get the size that the largest acceleration gives them in a time 1/rate. */
    double worst = 0, largest_a = 0;
    for (int s = 0; s < 4; s++) largest_a = fmax(largest_a, vector_largest(f->slope_v[s], nx));
    const double of_x = fmax(NEGLIGIBLE * vector_largest(f->largest_x, nx), largest_a / (f->rate * f->rate)),
                 of_v = fmax(NEGLIGIBLE * vector_largest(f->largest_v, nv), largest_a / f->rate);
    for (size_t k = 0; k < nx + nv; k++) {
        double *const *slope = k < nx ? f->slope_x : f->slope_v, sum = 0;
        const size_t j = k < nx ? k : k - nx;
        for (int i = 0; i < 4; i++) sum += error[i] * slope[i][j];
        const double now = fabs(k < nx ? f->stage_x[j] : f->stage_v[j]);
        const double size = fmax(now, k < nx ? fmax(f->largest_x[j], of_x) : fmax(f->largest_v[j], of_v));
        if (sum != 0) worst = fmax(worst, fabs(h * sum) / (TOLERANCE * size));
    }
    return isfinite(worst) ? worst : NAN;
}

static void note(signal *s, double time, double value)
{
    const double size = fabs(value);
    if (size > s->largest) s->largest = size;
    if (!(size > NEGLIGIBLE * s->largest)) return;
    if (value * s->value < 0) {
        const double crossed = s->time + (time - s->time) * (s->value / (s->value - value));
        if (s->changes++ == 0) s->first = crossed;
        s->last = crossed;
    }
    s->time = time;
    s->value = value;
}

static void note_all(follower *f)
{
    const problem *p = f->problem;
    for (size_t k = 0; k < p->nx; k++) f->largest_x[k] = fmax(f->largest_x[k], fabs(f->x[k]));
    for (size_t k = 0; k < p->nv; k++) {
        f->largest_v[k] = fmax(f->largest_v[k], fabs(f->v[k]));
        note(&f->signals[k], f->elapsed, k < p->nx ? f->v[k] : f->a[k]);
        if (k < p->nx) note(&f->signals[p->nv + k], f->elapsed, f->a[k]);
    }
}

/* Whether the falling number has come to 0 in a step of length h, and when. False: it fell into a singularity, where
 * the force has grown beyond all bounds. */
static bool land(const follower *f, double x_before, double h, double *landed)
{
    const double x = f->x[f->falling], now = f->a[f->falling] / f->force;
    if (*landed > 0 || !(x * f->side < 0) || !(f->side * f->force < 0)) return true;
    if (now > 0.05) *landed = f->elapsed - h * (x / (x - x_before));
    return now < 100;
}

/* One step that meets the tolerance. False: none does, however short. */
static bool step(follower *f, size_t *evaluations, size_t most, double *landed)
{
    for (;;) {
        if (*evaluations + 3 > most) return true;
        *evaluations += 3;
        const double error = attempt(f, f->way * f->h), h = f->h;
        if (!(h > 1e-10 * f->elapsed) || !(h > 1e-290)) return false;
        f->h *= isnan(error) ? 0.1 : fmin(4, fmax(0.2, 0.9 / sqrt(sqrt(error))));
        if (!(error <= 1)) continue;
        const double before = f->problem->nx ? f->x[f->falling] : 0;
        f->t += f->way * h;
        f->elapsed += h;
        if (f->problem->nx) memcpy(f->x, f->stage_x, f->problem->nx * sizeof(double));
        memcpy(f->v, f->stage_v, f->problem->nv * sizeof(double));
        memcpy(f->a, f->slope_v[3], f->problem->nv * sizeof(double));
        f->usual = f->taken++ < SETTLED ? h : f->usual + (h - f->usual) / SETTLED;
        if (f->taken > SETTLED) f->shortest = fmin(f->shortest, f->usual);
        note_all(f);
        if (f->problem->nx == 0) return true;
        if (f->side == 0) f->side = f->x[f->falling];
        return land(f, before, h, landed);
    }
}

/* The swing of number k, and whether it has swung often enough. */
static double swing(const follower *f, size_t k, bool *often)
{
    const problem *p = f->problem;
    const signal *s = &f->signals[k];
    if (k < p->nx && s->changes < 3 && s[p->nv].changes > 3) s += p->nv;
    *often = s->changes > 2 * SWINGS || s->largest == 0;
    return s->changes < 3 ? 0 : 2 * (s->last - s->first) / (s->changes - 1);
}

/* True: every number has swung often enough, or the fastest so often that the others do not swing. */
static bool judge(const follower *f, followed *out)
{
    bool all = true;
    size_t slowest = 0;
    out->shortest = out->longest = 0;
    for (size_t k = 0; k < f->problem->nv; k++) {
        bool often;
        const double one = swing(f, k, &often);
        all &= often;
        if (one > 0 && (out->shortest == 0 || one < out->shortest)) out->shortest = one;
        if (one > out->longest) out->longest = one, slowest = k;
    }
    out->slowest = slowest;
    return all || (out->shortest > 0 && f->elapsed > SWINGS_MOST * out->shortest);
}

/* How large the state is, positions and velocities each in units of their own first size. */
static double size_of(const follower *f, double unit_x, double unit_v)
{
    const problem *p = f->problem;
    const double x = p->nx ? vector_largest(f->x, p->nx) / unit_x : 0;
    return p->nv > p->nx ? fmax(x, vector_largest(f->v + p->nx, p->nv - p->nx) / unit_v) : x;
}

static void follow(follower *f, double rate, double horizon, size_t most, followed *out)
{
    const problem *p = f->problem;
    double unit_x = 0, unit_v = 0,
           times[3] = {0}; /* of growth: to its 4th root of INFINITE, its square root, INFINITE */
    size_t evaluations = 1;
    bool steps = true, done = false;
    while (steps && !done && evaluations + 3 <= most && f->elapsed < horizon) {
        steps = step(f, &evaluations, most, &out->landed);
        if (f->elapsed * rate <= 1 || unit_x + unit_v == 0) {
            unit_x = vector_largest(f->largest_x, p->nx);
            unit_v = vector_largest(f->largest_v + p->nx, p->nv - p->nx);
        }
        const double size = size_of(f, unit_x, unit_v);
        if (size >= FOLLOW_GROWTH && out->grown == 0) out->grown = f->elapsed;
        const double marks[] = {1e2, 1e4, INFINITE};
        for (int i = 0; i < 3; i++)
            if (size >= marks[i] && times[i] == 0) times[i] = f->elapsed;
        done = size >= INFINITE || judge(f, out);
    }
    judge(f, out);
    out->change = f->taken > SETTLED ? CHANGE_OF_STEP * f->shortest : 0;
    /* What grows as an exponential needs twice as long from 1e4 to 1e8 as from 1e2 to 1e4; towards a pole, less and
     * less. */
    if (!steps || (times[2] > 0 && times[2] - times[1] < times[1] - times[0])) out->bound = f->elapsed;
}

bool follow_motion(motus_system *s, double from, double way, double rate, double horizon, followed *out)
{
    const problem *p = &s->problem;
    const size_t nx = p->nx, nv = p->nv, most = s->text.draft / (nv ? nv : 1);
    *out = (followed){0};
    follower f = {.problem = p, .t = from, .way = way, .rate = rate, .h = 0.01 / rate, .shortest = INFINITY};
    double *room = take(&s->allocator, 7 * nx + 8 * nv, sizeof *room);
    f.signals = take(&s->allocator, 2 * nv, sizeof *f.signals);
    if (room && f.signals) {
        double **of_x[] = {&f.x, &f.stage_x, &f.largest_x, &f.slope_x[0], &f.slope_x[1], &f.slope_x[2], &f.slope_x[3]};
        double **of_v[] = {&f.v,          &f.stage_v,    &f.largest_v,  &f.slope_v[0],
                           &f.slope_v[1], &f.slope_v[2], &f.slope_v[3], &f.a};
        memset(room, 0, (7 * nx + 8 * nv) * sizeof *room);
        memset(f.signals, 0, 2 * nv * sizeof *f.signals);
        for (size_t i = 0; i < 7; i++) *of_x[i] = room + i * nx;
        for (size_t i = 0; i < 8; i++) *of_v[i] = room + 7 * nx + i * nv;
        if (nx) memcpy(f.x, s->x0, nx * sizeof *room);
        memcpy(f.v, s->v0, nv * sizeof *room);
        if (evaluate(&f, f.t, f.x, f.v, f.a)) {
            note_all(&f);
            for (size_t k = 1; k < nx; k++)
                if (fabs(f.a[k]) > fabs(f.a[f.falling])) f.falling = k;
            f.force = f.a[f.falling];
            f.side = nx ? f.x[f.falling] : 0;
            for (size_t k = 0; k < 2 * nv; k++) /* at rest: a turning point */
                if (f.signals[k].value == 0) f.signals[k].changes = 1;
            follow(&f, rate, horizon, most, out);
        }
    }
    const bool memory = room && f.signals;
    give(&s->allocator, f.signals);
    give(&s->allocator, room);
    return memory;
}
