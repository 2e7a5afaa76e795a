/* A motion followed by the row bs32, with its turning points counted.
 *
 * Times of events lie within a step, by the cubic through its ends. A number swings if its velocity changes sign again
 * and again; one that only goes on, like a pendulum that turns over, if its acceleration does. Invariant: the bits are
 * the same on every machine, and the system does not change.
 */
#include "api/search/draft.h"

#include "api/system/linear.h"
#include "api/system/vector.h"
#include "api/why/evidence.h"

#include <math.h>
#include <string.h>

#define METHOD "bs32"
#define TOLERANCE 1e-5      /* of it */
#define LEAST 1e-4          /* of the size of the start: the least size of a number */
#define CHANGE_OF_STEP 11.8 /* `change` of a harmonic motion, in its steps at this tolerance */
#define SWINGS_MOST 100     /* of the fastest number */
#define INFINITE 1e8        /* times the size of the start */
#define KINK 3              /* steps: the force jumps if it changes within fewer */
#define STEEP 100           /* times the force of the start, that a singularity has at least */
#define RESTS 1e-12         /* part of the force of a displacement by the whole state, below which the start rests */
#define LATER 100           /* times the horizon, for which a fall is followed */
#define SPEED 0.05          /* of the largest in a fall: a slower number comes to rest and does not fall */
#define UNIT 0.2            /* of the size after 1/rate: a smaller start is no size to grow from */
#define NEAR_END 1e-6       /* part of the time before an end in which its cause shows */
enum { SETTLED = 8 };       /* steps until their length no longer follows from the first, or from a kink */

typedef struct follower {
    const problem *problem;
    trial trial;
    double from, way, rate, elapsed;
    double *x, *v, *a;             /* present state */
    double *end_x, *end_v, *end_a; /* after the next step */
    double *mid_x, *mid_v, *mid_a; /* within it */
    swings *signals;               /* of every number of v, then of every acceleration */
    size_t falling;                /* the position with the largest force at the start */
    double force, side;            /* force: on it at the start; side: its sign before it comes to 0 */
    double speed;                  /* the largest speed of `falling` in the present fall */
    double *first_a;               /* at the start */
    double *largest_a;
    double unit_x, unit_v, start_x, start_v; /* sizes of positions (x) and of first-order variables (v) */
    bool begun;                              /* the units are known */
    double fast[KINK], fastest;              /* rates of the last steps, and the largest that lasted */
    settled record;
    double usual, shortest; /* a mean of the last steps, and the least it was since steps ceased to grow */
    bool slows;             /* they ceased to grow: from a start at 0 they grow long */
    uint32_t taken;
} follower;

/* Returns whether a number takes part in the motion: modes, which are numbers of x, stand still. */
static bool moves(const problem *p, size_t k) { return k < linear_positions(p) || k >= p->nx; }

static bool evaluate(follower *f, double t, double *x, double *v, double *a)
{
    const problem *p = f->problem;
    memset(a, 0, p->nv * sizeof *a);
    if (p->refresh) p->refresh(p->ctx, t, x, v);
    return p->accel(p->ctx, t, x, v, a) == 0 && isfinite(vector_largest(a, p->nv));
}

static void note_all(follower *f)
{
    const problem *p = f->problem;
    for (size_t k = 0; k < p->nv; k++) {
        swings_note(&f->signals[k], f->elapsed, f->taken, k < p->nx ? f->v[k] : f->a[k]);
        if (k < p->nx) swings_note(&f->signals[p->nv + k], f->elapsed, f->taken, f->a[k]);
    }
}

/* Evaluates the cubic through both ends of a step of length h, at a part of it. */
static double between(double y0, double d0, double y1, double d1, double h, double part)
{
    const double q = 1 - part;
    return q * q * ((1 + 2 * part) * y0 + part * h * d0) + part * part * ((1 + 2 * q) * y1 - q * h * d1);
}

/* Returns number k, of positions and then of first-order variables, within the attempted step. */
static double number_between(const follower *f, size_t k, double h, double part)
{
    const size_t nx = f->problem->nx;
    h *= f->way;
    return k < nx ? between(f->x[k], f->v[k], f->end_x[k], f->end_v[k], h, part)
                  : between(f->v[k], f->a[k], f->end_v[k], f->end_a[k], h, part);
}

/* Returns the size of the state within the attempted step, in units of positions and of first-order variables. */
static double size_between(const follower *f, double h, double part)
{
    double most = 0;
    for (size_t k = 0; k < f->problem->nv; k++) {
        const double unit = k < f->problem->nx ? f->unit_x : f->unit_v;
        if (unit > 0 && moves(f->problem, k)) most = fmax(most, fabs(number_between(f, k, h, part)) / unit);
    }
    return most;
}

/* Returns the part of the step at which `below` ceases to hold. */
static double part_of(const follower *f, double h, bool (*below)(const follower *, double h, double part))
{
    double low = 0, high = 1;
    for (int i = 0; i < 40; i++) {
        const double middle = (low + high) / 2;
        if (below(f, h, middle))
            low = middle;
        else
            high = middle;
    }
    return high;
}

static bool is_up(const follower *f, double h, double part)
{
    return number_between(f, f->falling, h, part) * f->side > 0;
}

static bool is_small(const follower *f, double h, double part) { return size_between(f, h, part) < FOLLOW_GROWTH; }

/* Notes where in this step the falling number comes to 0, moving in the direction of its force at the start. */
static void land(follower *f, double h, followed *out)
{
    if (linear_positions(f->problem) == 0 || out->landed > 0) return;
    const size_t k = f->falling;
    const double x = f->end_x[k], speed = f->way * f->end_v[k];
    if (f->side == 0) f->side = x;
    f->speed = speed * f->force > 0 ? fmax(f->speed, fabs(speed)) : 0;
    if (!(x * f->side <= 0) || !(f->side * f->force < 0) || !(f->speed > 0) || !(fabs(speed) >= SPEED * f->speed))
        return;
    out->landed = f->elapsed + h * part_of(f, h, is_up);
}

/* Notes the sizes from which the state grows, and then where in this step it has grown. */
static void grow(follower *f, double h, followed *out)
{
    const size_t nx = f->problem->nx;
    if (!f->begun && (f->elapsed + h) * f->rate > 1) {
        double x = 0, v = 0;
        const double unit = 1 / f->rate, part = (unit - f->elapsed) / h;
        for (size_t k = 0; k < linear_positions(f->problem); k++) x = fmax(x, fabs(number_between(f, k, h, part)));
        for (size_t k = nx; k < f->problem->nv; k++) v = fmax(v, fabs(number_between(f, k, h, part)));
        const bool from_start = f->start_x >= UNIT * x && f->start_v >= UNIT * v;
        f->begun = true;
        f->unit_x = from_start ? f->start_x : x;
        f->unit_v = from_start ? f->start_v : v;
        out->since = from_start ? 0 : unit;
    }
    if (f->begun && out->grown == 0 && size_between(f, h, 1) >= FOLLOW_GROWTH)
        out->grown = f->elapsed + h * part_of(f, h, is_small);
}

/* Returns whether the step of length h may leap over a singularity although it meets the tolerance: the force has
 * grown, and its values at the ends and in the middle are far apart. Shorter steps resolve the force, or end there. */
static bool leaps(follower *f, double h)
{
    const size_t nx = f->problem->nx, nv = f->problem->nv;
    const double least = STEEP * vector_largest(f->first_a, nv);
    if (!(vector_largest(f->a, nv) > least)) return false;
    for (size_t k = 0; k < nv; k++) {
        if (k < nx) f->mid_x[k] = number_between(f, k, h, 0.5);
        f->mid_v[k] = between(f->v[k], f->a[k], f->end_v[k], f->end_a[k], f->way * h, 0.5);
    }
    bool far = !evaluate(f, f->from + f->way * (f->elapsed + h / 2), f->mid_x, f->mid_v, f->mid_a);
    for (size_t k = 0; k < nv && !far; k++) {
        const double a = f->a[k], low = fmin(a, fmin(f->mid_a[k], f->end_a[k])),
                     high = fmax(a, fmax(f->mid_a[k], f->end_a[k]));
        far = fabs(a) > least && fabs(a) >= f->largest_a[k] / 2 && high - low >= 0.75 * fabs(a);
    }
    return far;
}

/* Returns the length of y, or of y - z unless z is NULL. */
static double length(const double *y, const double *z, size_t n)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++) sum = hypot(sum, z ? y[k] - z[k] : y[k]);
    return sum;
}

/* Notes the rate w at which the positions move, as for a harmonic motion, by velocity v, acceleration a and its change
 * j: w^4 v^2 + w^2 a^2 = j^2. It is at most the rate of a harmonic motion, and equals it where that is fastest. */
static void note_rate(follower *f, double h)
{
    const size_t nx = f->problem->nx;
    const double v = length(f->end_v, NULL, nx), a = length(f->end_a, NULL, nx), j = length(f->end_a, f->a, nx) / h;
    /* a rate of the motion, and not of a driving force */
    if (!(v > 0 && a > 0 && f->taken > SETTLED) || f->problem->traits.time) return;
    const double by = a / v, root = j / v; /* w^2 = (-by^2 + sqrt(by^4 + 4 root^2))/2, without cancellation */
    f->fast[f->taken % KINK] = sqrt(2 * root * root / (by * by + hypot(by * by, 2 * root)));
    double least = f->fast[0];
    for (int i = 1; i < KINK; i++) least = fmin(least, f->fast[i]);
    f->fastest = fmax(f->fastest, least);
}

static void accept(follower *f, double h)
{
    const size_t nx = f->problem->nx, nv = f->problem->nv;
    f->elapsed = fabs(stepper_time(f->trial.stepper));
    if (nx) memcpy(f->x, f->end_x, nx * sizeof(double));
    memcpy(f->v, f->end_v, nv * sizeof(double));
    memcpy(f->a, f->end_a, nv * sizeof(double));
    f->slows |= f->taken > SETTLED && h < f->usual;
    f->usual = f->taken++ < SETTLED ? h : f->usual + (h - f->usual) / SETTLED;
    if (f->slows) f->shortest = fmin(f->shortest, f->usual);
    for (size_t k = 0; k < nv; k++) f->largest_a[k] = fmax(f->largest_a[k], fabs(f->a[k]));
    note_all(f);
    settled_note(&f->record, f->elapsed, f->x, nx, f->v + nx);
}

/* Takes a step that meets the tolerance. False: none does, however short. */
static bool step(follower *f, followed *out)
{
    stepper *s = f->trial.stepper;
    for (;;) {
        bool arrived;
        if (trial_step(&f->trial, NAN, &arrived) != MOTUS_OK ||
            stepper_sync(s, f->end_x, f->end_v, f->end_a, NULL) != MOTUS_OK)
            return false;
        const double h = fabs(stepper_last_step(s)), start = f->way * f->elapsed;
        if (!(h > 1e-10 * f->elapsed)) return false;
        if (leaps(f, h)) {
            if (stepper_jump(s, start, 0, f->way * h / 4, f->x, f->v, NULL) != MOTUS_OK) return false;
            continue;
        }
        land(f, h, out);
        grow(f, h, out);
        note_rate(f, h);
        accept(f, h);
        return true;
    }
}

/* Returns the changes of sign that tell the swings of number k. */
static const swings *telling(const follower *f, size_t k)
{
    const swings *s = &f->signals[k], *a = s + f->problem->nv;
    return k < f->problem->nx && s->changes < 3 && a->changes > 3 ? a : s;
}

/* Finds the swings. True: every number has swung often enough, or the fastest so often that the others do not swing. */
static bool judge(const follower *f, followed *out)
{
    bool all = true;
    size_t slowest = 0;
    out->shortest = out->longest = 0;
    out->irregular = false;
    for (size_t k = 0; k < f->problem->nv; k++) {
        if (!moves(f->problem, k)) continue;
        const swings *signs = telling(f, k);
        const double one = swings_length(signs);
        all &= swings_often(signs);
        if (one > 0 && (out->shortest == 0 || one < out->shortest)) out->shortest = one, out->fastest = k;
        out->irregular |= one > 0 && swings_uneven(signs);
        if (one > out->longest) out->longest = one, slowest = k;
    }
    out->slowest = slowest;
    return all || (out->shortest > 0 && f->elapsed > SWINGS_MOST * out->shortest);
}

/* Returns whether the force has no value a little further along the motion. */
static bool undefined_ahead(follower *f)
{
    const size_t nx = f->problem->nx, nv = f->problem->nv;
    for (double late = NEAR_END * fmax(f->elapsed, 1 / f->rate); late > NEAR_END * NEAR_END * f->elapsed; late /= 16) {
        for (size_t k = 0; k < nv; k++) {
            if (k < nx) f->mid_x[k] = f->x[k] + f->way * late * f->v[k];
            f->mid_v[k] = f->v[k] + f->way * late * f->a[k];
        }
        if (!evaluate(f, f->from + f->way * (f->elapsed + late), f->mid_x, f->mid_v, f->mid_a)) return true;
    }
    return false;
}

/* Returns how a motion ends that no step can follow further. */
static follow_end end_of(follower *f, double size)
{
    const size_t nx = f->problem->nx, nv = f->problem->nv;
    const double state = fmax(vector_largest(f->x, linear_positions(f->problem)), vector_largest(f->v + nx, nv - nx));
    const double slope = fmax(vector_largest(f->v, nx), vector_largest(f->a + nx, nv - nx));
    const double now = vector_largest(f->a, nv), first = vector_largest(f->first_a, nv);
    /* An exponential ends with the range of the numbers, but needs equal times for equal factors. */
    if (size >= INFINITE) return slope * f->elapsed > 1e4 * state ? FOLLOW_INFINITE : FOLLOW_GOES_ON;
    if (now > STEEP * first) return FOLLOW_SINGULAR;
    return undefined_ahead(f) ? FOLLOW_UNDEFINED : FOLLOW_GOES_ON;
}

/* Returns whether the falling number is on its way to 0, and near enough to be followed there. */
static bool falls(const follower *f, double horizon, const followed *out)
{
    if (linear_positions(f->problem) == 0 || out->landed > 0 || f->elapsed > LATER * horizon) return false;
    const double x = f->x[f->falling], v = f->way * f->v[f->falling];
    return x * v < 0 && v * f->force > 0 && fabs(x / v) < LATER * horizon;
}

static void follow(follower *f, double horizon, size_t most, followed *out)
{
    const size_t nx = f->problem->nx;
    static const double marks[] = {1e2, 1e4, INFINITE};
    double times[3] = {0}, size = 0;
    const int64_t room = (int64_t)most - 4; /* evaluations of the start and of a step */
    bool steps = true, done = false;
    while (steps && !done && stepper_evaluations(f->trial.stepper) <= room &&
           (f->elapsed < horizon || falls(f, horizon, out))) {
        steps = step(f, out);
        size = f->begun ? size_between(f, 0, 1) : 0;
        for (int i = 0; i < 3; i++)
            if (size >= marks[i] && times[i] == 0) times[i] = f->elapsed;
        /* An exponential needs twice as long from 1e4 to 1e8 as from 1e2 to 1e4; towards a pole, less and less. */
        const bool pole = times[2] > 0 && times[2] - times[1] < times[1] - times[0];
        done = (size >= INFINITE && !pole) || judge(f, out);
    }
    judge(f, out);
    out->change = isfinite(f->shortest) ? CHANGE_OF_STEP * f->shortest : 0;
    out->step = f->usual;
    out->fast = f->fastest;
    out->elapsed = f->elapsed;
    out->cut = steps && !done && stepper_evaluations(f->trial.stepper) > room;
    out->falling = f->falling;
    if (!steps) out->end = end_of(f, size);
    if (out->end != FOLLOW_GOES_ON) out->bound = f->elapsed;
    if (steps && size < INFINITE) out->settled = settled_since(&f->record, f->elapsed, f->x, nx, f->v + nx);
}

/* Returns whether nothing moves, since the force at the start is rounding. */
static bool rests(const follower *f)
{
    const problem *p = f->problem;
    const size_t nx = p->nx, ns = p->nv - nx;
    return !p->traits.time && !p->refresh && vector_largest(f->v, nx) == 0 &&
           vector_largest(f->a, nx) <= RESTS * f->rate * f->rate * vector_largest(f->x, linear_positions(p)) &&
           vector_largest(f->a + nx, ns) <= RESTS * f->rate * vector_largest(f->v + nx, ns);
}

static void start(follower *f)
{
    const size_t nx = f->problem->nx, nv = f->problem->nv;
    memcpy(f->first_a, f->a, nv * sizeof *f->a);
    memcpy(f->largest_a, f->a, nv * sizeof *f->a);
    for (size_t k = 0; k < nv; k++) f->largest_a[k] = fabs(f->a[k]);
    f->start_x = vector_largest(f->x, linear_positions(f->problem));
    f->start_v = vector_largest(f->v + nx, nv - nx);
    note_all(f);
    settled_note(&f->record, 0, f->x, nx, f->v + nx);
    for (size_t k = 1; k < nx; k++)
        if (fabs(f->a[k]) > fabs(f->a[f->falling])) f->falling = k;
    f->force = f->a[f->falling];
    f->side = nx ? f->x[f->falling] : 0;
    for (size_t k = 0; k < 2 * nv; k++) /* at rest: a turning point */
        if (f->signals[k].value == 0) f->signals[k].changes = 1;
}

/* Returns the least size that a kind of number has at the start: positions, velocities, first-order variables. */
static double size_of_start(const follower *f)
{
    const double x = fmax(f->start_x, vector_largest(f->v, f->problem->nx) / f->rate), v = x * f->rate, s = f->start_v;
    const double of_x = x > 0 ? fmin(x, v) : s;
    return s > 0 ? fmin(of_x, s) : of_x;
}

bool follow_motion(motus_system *s, double from, double way, double rate, double horizon, followed *out)
{
    const problem *p = &s->problem;
    const size_t nx = p->nx, nv = p->nv, most = s->text.draft / (nv ? nv : 1);
    *out = (followed){0};
    follower f = {.problem = p, .from = from, .way = way, .rate = rate, .shortest = INFINITY};
    const size_t samples = most / 3 + 1 < SETTLED_SAMPLES ? most / 3 + 1 : SETTLED_SAMPLES, state = 3 * nx + 8 * nv;
    double *room = take(&s->allocator, state + samples * (nv + 1), sizeof *room);
    f.signals = take(&s->allocator, 2 * nv, sizeof *f.signals);
    if (room && f.signals) {
        double **of_x[] = {&f.x, &f.end_x, &f.mid_x};
        double **of_v[] = {&f.v, &f.end_v, &f.mid_v, &f.a, &f.end_a, &f.mid_a, &f.first_a, &f.largest_a};
        memset(room, 0, state * sizeof *room);
        f.record = (settled){room + state, room + state + samples, nv, samples, 0, 0.01 / rate};
        memset(f.signals, 0, 2 * nv * sizeof *f.signals);
        for (size_t i = 0; i < 3; i++) *of_x[i] = room + i * nx;
        for (size_t i = 0; i < 8; i++) *of_v[i] = room + 3 * nx + i * nv;
        if (nx) memcpy(f.x, s->x0, nx * sizeof *room);
        memcpy(f.v, s->v0, nv * sizeof *room);
        chosen row;
        if (evaluate(&f, from, f.x, f.v, f.a) && row_choose(METHOD, &row, NULL, NULL) == MOTUS_OK) {
            start(&f);
            out->rests = rests(&f);
            row.relative = TOLERANCE;
            row.absolute = TOLERANCE * LEAST * size_of_start(&f);
            row.first = 0.01 / rate;
            if (!out->rests && trial_begin(&f.trial, p, &s->allocator, &row, from, way, f.x, f.v, INT64_MAX))
                follow(&f, horizon, most, out);
            trial_end(&f.trial);
        }
    }
    const bool memory = room && f.signals;
    give(&s->allocator, f.signals);
    give(&s->allocator, room);
    return memory;
}
