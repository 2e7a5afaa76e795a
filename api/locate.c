/* Steps that end where the force changes its formula. See locate.h.
 *
 * A step is first taken with the sides as they are. If every argument is on its side at the end and no argument can
 * have left it and come back, that is the step. Otherwise the pieces follow: the first root is bracketed by steps of
 * other lengths from the same state, until its time is known to rounding; the piece ends just beyond it, so that the
 * argument is on the new side; and the next piece leads on to the end of the step. So every state is that of a step of
 * the method with a smooth force, and the order of the method remains. Invariant: `x`, `v` at `t` is a state of the
 * trajectory, and `side` are the sides after it.
 *
 * Which derivative of the force jumps is found at each root: on both sides of it the force is evaluated with the old
 * sides and with the new ones, and their difference grows with a power of the distance.
 */
#include "api/locate.h"

#include "api/jump.h"
#include "machine/held.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum {
    PIECES_MAX =
        20000, /* in one step: more are friction that sticks, or a motion that comes to rest by ever shorter bounces */
    LOOK = 16, /* pieces between two looks at the clock */
    STILL_MAX = 64, /* sides changed one after the other while time hardly moves */
    HALVINGS_MAX = 200
};
#define NEAR 0x1p-32 /* of a step: a piece shorter than this hardly moves */
#define TOUCHED 1e-7 /* of an argument at the ends of a step: where it is least, this is 0 */
#define ALIKE 0.05   /* powers of a jump this near to one another are the same */
#define FORCES 8.0   /* how many roundings of a force may differ between one piece and two halves */
#define EDGE 0x1p-20 /* of a step: a touch nearer than this to its end is there */

typedef struct place {
    double t;
    double *x, *v, *a, *u;
} place;

struct locate {
    held *held;
    problem problem;
    size_t count;
    double *side, *old_side, *rate[2];
    double *slack; /* of an argument that was left just before its root: how far it may still be on the other side */
    double *size;
    place from, to, beyond; /* a piece's start, its end, and a trial between */
    place start;            /* of the step */
    place twice;            /* the end of two half pieces */
    place found;            /* where an argument is beyond in the middle of a step */
    interval *box;          /* nx, then nv, and nv for accelerations */
    interval *reach;        /* of the arguments, then of their rates */
    bool resolves;          /* pieces must resolve the force */
    bool careful;           /* pieces must show that no argument leaves its side and comes back */
    double next;            /* the size of the next piece to try; INFINITY: all that is left of the step */
    size_t touches;         /* that pieces must end at; the arguments at both ends of a step, and their rates */
    double *touch[2], *touch_rate[2], *room;
    double *start_side;
    bool known;    /* `from` is the stepper's state */
    bool away;     /* the stepper was used for trials, and is not on the run's leg */
    int64_t steps; /* of the run's leg, before the stepper's present one */
    int64_t located;
    double jump; /* the lowest power with which the force departed from a smooth one: jump.h; NaN: none */
    double jump_time;
    double rounding; /* of times at which the force changes fast: what it may have changed a velocity by, added up */
};

static size_t place_numbers(const problem *p, size_t count) { return p->nx + 2 * p->nv + count; }

static double *place_memory(place *s, const problem *p, size_t count, double *at)
{
    s->x = at;
    s->v = s->x + p->nx;
    s->a = s->v + p->nv;
    s->u = s->a + p->nv;
    return at + place_numbers(p, count);
}

static void place_copy(place *to, const place *from, const problem *p, size_t count)
{
    to->t = from->t;
    memcpy(to->x, from->x, place_numbers(p, count) * sizeof(double));
}

static void place_swap(place *p, place *q)
{
    const place kept = *p;
    *p = *q;
    *q = kept;
}

motus_status locate_prepare(motus_run *r, motus_switches switches, motus_error *err)
{
    motus_system *s = r->system;
    if (switches == MOTUS_SWITCHES_STEP) return MOTUS_OK;
    if (switches != MOTUS_SWITCHES_LOCATE && switches != MOTUS_SWITCHES_RESOLVE)
        return fail(err, MOTUS_ARGUMENT, "there is no way to treat switches of number %d", (int)switches);
    r->locating = true;
    if (!s->model || !strcmp(r->card->family, "exact")) return MOTUS_OK;
    const motus_status status = system_switches(s, err);
    if (status != MOTUS_OK) return status;
    held *h = s->switches;
    const bool resolves = h && switches == MOTUS_SWITCHES_RESOLVE && held_resolves(h);
    const size_t touches = h && switches == MOTUS_SWITCHES_RESOLVE ? held_touches(h) : 0;
    if (!h || (!held_count(h) && !resolves && !touches)) return MOTUS_OK;
    const problem *p = held_problem(h);
    const size_t count = held_count(h), numbers = 7 * count + 6 * place_numbers(p, count) + 2 * (p->nx + 2 * p->nv) +
                                                  4 * count + 4 * touches + 3 * p->nv;
    locate *l = take(&r->allocator, 1, sizeof *l + numbers * sizeof(double));
    if (!l) return fail(err, MOTUS_MEMORY, "no memory for the run");
    *l = (locate){.held = h,
                  .problem = *p,
                  .count = count,
                  .touches = touches,
                  .next = INFINITY,

                  .jump = NAN,
                  .jump_time = NAN};
    l->problem.traits.gyroscopic = s->problem.traits.gyroscopic;
    double *at = (double *)(l + 1);
    l->side = at, l->old_side = l->side + count;
    l->rate[0] = l->old_side + count, l->rate[1] = l->rate[0] + count;
    l->slack = l->rate[1] + count, l->size = l->slack + count;
    l->start_side = l->size + count;
    at = place_memory(&l->start, p, count, l->start_side + count);
    at = place_memory(&l->from, p, count, at);
    at = place_memory(&l->to, p, count, at);
    at = place_memory(&l->beyond, p, count, at);
    at = place_memory(&l->twice, p, count, at);
    at = place_memory(&l->found, p, count, at);
    l->box = (interval *)(void *)at;
    l->reach = l->box + p->nx + 2 * p->nv;
    at += 2 * (p->nx + 2 * p->nv) + 4 * count;
    l->touch[0] = at, l->touch[1] = at + touches;
    l->touch_rate[0] = at + 2 * touches, l->touch_rate[1] = at + 3 * touches;
    l->room = at + 4 * touches;
    l->resolves = resolves;
    l->careful = count && switches == MOTUS_SWITCHES_RESOLVE;
    for (size_t k = 0; k < count; k++) l->side[k] = 1, l->slack[k] = 0;
    r->locate = l;
    r->note = "switches are located by the interpreter";
    r->machine = (machine){.name = "interpreter", .problem = &l->problem};
    if (!held_bind(h, l->side, true)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    return MOTUS_OK;
}

void locate_destroy(motus_run *r)
{
    give(&r->allocator, r->locate);
    r->locate = NULL;
}

void locate_statistics(const motus_run *r, motus_statistics *out)
{
    const locate *l = r->locate;
    const motus_system *s = r->system;
    const bool none = s->switches_known && !s->switches_refused && !(s->switches && held_count(s->switches));
    out->switches = l ? l->located : r->locating && none ? 0 : -1;
    out->jump = !l || isnan(l->jump) ? -1 : l->jump > 0 ? (int64_t)ceil(l->jump) : 0;
    out->jump_power = l ? l->jump : NAN;
    out->jump_time = l ? l->jump_time : NAN;
    out->jump_rounding = l ? l->rounding : 0;
}

/* States --------------------------------------------------------------------------------------------------------- */

/* The stepper's state, and the arguments of all switches there. */
static motus_status observe(motus_run *r, place *at, motus_error *err)
{
    locate *l = r->locate;
    for (size_t k = 0; k < l->problem.nv; k++) at->a[k] = 0; /* of cells without an equation, too */
    const motus_status status = stepper_sync(r->stepper, at->x, at->v, at->a, err);
    if (status != MOTUS_OK) return status;
    at->t = stepper_time(r->stepper);
    held_values(l->held, at->t, at->x, at->v, at->u);
    return MOTUS_OK;
}

/* Computes the acceleration of a place, on the sides bound. False: it cannot be evaluated. */
static bool accelerated(const locate *l, place *at)
{
    const problem *p = &l->problem;
    for (size_t k = 0; k < p->nv; k++) at->a[k] = 0;
    return p->accel(p->ctx, at->t, at->x, at->v, at->a) == 0;
}

/* A step of size h from `from` to `to`. */
static motus_status step_from(motus_run *r, const place *from, double h, place *to, motus_error *err)
{
    r->locate->away = true;
    motus_status status = stepper_start(r->stepper, from->t, h, from->x, from->v, err);
    if (status == MOTUS_OK) status = stepper_advance(r->stepper, (stepper_limit){1, NAN}, NULL, err);
    return status == MOTUS_OK ? observe(r, to, err) : status;
}

static double gap(const locate *l, size_t k, const place *at)
{
    return switches_gap(held_operation(l->held, k), l->side[k], at->u[k]) + l->slack[k];
}

/* The least gap of all, each in units of `size`; below 0: an argument has left its side. */
static double least_gap(const locate *l, const place *at, const double *size)
{
    double least = INFINITY;
    for (size_t k = 0; k < l->count; k++) {
        const double g = gap(l, k, at) / (size ? size[k] : 1);
        if (g < least) least = g;
    }
    return least;
}

/* Brackets --------------------------------------------------------------------------------------------------------- */

/* Fractions of a step at which a gap may be below 0, although it is not at the ends: where the tangents at both ends
 * meet, if they meet near 0 or below it (a convex gap lies above them; |r| - d lies near their meeting point), and
 * where the cubic through both ends is least. Returns how many, 0 to 2. */
static int dips(double g0, double s0, double g1, double s1, double at[2])
{
    int count = 0;
    if (!(s0 < 0 && s1 > 0)) return 0;
    const double meet = (g1 - s1 - g0) / (s0 - s1);
    if (!(meet > 0 && meet < 1 && g0 + s0 * meet < 0.25 * fmin(g0, g1))) return 0;
    at[count++] = meet;
    /* g(z) = g0 + s0 z + b z² + c z³ */
    const double c = 2 * (g0 - g1) + s0 + s1, b = 3 * (g1 - g0) - 2 * s0 - s1, z = -s0 / (b + sqrt(b * b - 3 * c * s0));
    if (z > 0 && z < 1) at[count++] = z;
    return count;
}

/* The end of the first part of the step in which an argument leaves its side and comes back: a fraction of the step at
 * which it is beyond, with `found` there; 1: there is none. */
static motus_status find_dip(motus_run *r, double h, double *fraction, motus_error *err)
{
    locate *l = r->locate;
    *fraction = 1;
    held_rates(l->held, l->from.t, l->from.x, l->from.v, l->from.a, l->rate[0]);
    held_rates(l->held, l->to.t, l->to.x, l->to.v, l->to.a, l->rate[1]);
    for (size_t k = 0; k < l->count; k++) {
        const operation op = held_operation(l->held, k);
        const double s0 = h * switches_gap_rate(op, l->side[k], l->from.u[k], l->rate[0][k]),
                     s1 = h * switches_gap_rate(op, l->side[k], l->to.u[k], l->rate[1][k]);
        double z[2];
        for (int i = dips(gap(l, k, &l->from), s0, gap(l, k, &l->to), s1, z); i-- > 0;) {
            if (!(z[i] < *fraction) || l->from.t + z[i] * h == l->from.t) continue;
            motus_status status = step_from(r, &l->from, z[i] * h, &l->beyond, err);
            if (status == MOTUS_MEMORY) return status;
            if (status != MOTUS_OK || !(gap(l, k, &l->beyond) < 0)) continue;
            *fraction = z[i];
            place_swap(&l->beyond, &l->found);
        }
    }
    return MOTUS_OK;
}

/* Shortens the step of size *h from `from` until it ends just beyond the first root, at `to`. failed: the step itself
 * failed, and `to` is not known. Illinois' method on the least gap, with a bisection now and then. At the end *failed
 * means that the first steps beyond the root fail; `to` is then the last state before it. */
static motus_status bracket(motus_run *r, double *h, bool *failed, motus_error *err)
{
    locate *l = r->locate;
    const place *from = &l->from;
    const double whole = *h;
    for (size_t k = 0; k < l->count; k++) {
        l->size[k] = fmax(fabs(gap(l, k, from)), *failed ? 0 : fabs(gap(l, k, &l->to)));
        if (!(l->size[k] > 0)) l->size[k] = 1;
    }
    double low = 0, high = 1, at_low = fmax(least_gap(l, from, l->size), 0);
    double at_high = *failed ? NAN : least_gap(l, &l->to, l->size);
    int moved = 0; /* which end moved last: an end that stays twice has its value halved */
    for (int turn = 0; turn < HALVINGS_MAX && high - low > 0x1p-51 * high && high > 0x1p-50; turn++) {
        if (fabs((high - low) * whole) <= 0x1p-54 * fabs(from->t)) break;
        double z = high - at_high * (high - low) / (at_high - at_low);
        if (*failed || turn % 4 == 3 || !(z > low && z < high)) z = 0.5 * (low + high);
        if (from->t + z * whole == from->t) {
            low = z;
            continue;
        }
        const motus_status status = step_from(r, from, z * whole, &l->beyond, err);
        if (status == MOTUS_MEMORY) return status;
        const double g = status == MOTUS_OK ? least_gap(l, &l->beyond, l->size) : NAN;
        if (g >= 0) {
            low = z;
            at_low = g;
            if (moved < 0) at_high /= 2;
            moved = -1;
            continue;
        }
        high = z;
        *failed = status != MOTUS_OK;
        at_high = g;
        if (moved > 0) at_low /= 2;
        moved = 1;
        if (!*failed) place_swap(&l->to, &l->beyond);
    }
    *h = (*failed ? low : high) * whole;
    if (!*failed) return MOTUS_OK;
    if (from->t + *h != from->t) return step_from(r, from, *h, &l->to, err);
    place_copy(&l->to, from, &l->problem, l->count);
    return MOTUS_OK;
}

/* Which derivative jumps ------------------------------------------------------------------------------------------- */

/* The state at a distance `way` in time from `at`, by Taylor's formula. */
static void follow(const problem *p, const place *at, double way, double *x, double *v)
{
    for (size_t k = 0; k < p->nv; k++) {
        if (k < p->nx) x[k] = at->x[k] + way * (at->v[k] + way / 2 * at->a[k]);
        v[k] = at->v[k] + way * at->a[k];
    }
}

/* The acceleration on these sides at `from`. False: it cannot be evaluated. */
static bool accelerate(const locate *l, const double *sides, double *a)
{
    const problem *p = &l->problem;
    memcpy(l->beyond.x, l->from.x, p->nx * sizeof(double));
    memcpy(l->beyond.v, l->from.v, p->nv * sizeof(double));
    for (size_t k = 0; k < p->nv; k++) a[k] = 0;
    return held_bind(l->held, sides, false) && p->accel(p->ctx, l->from.t, l->beyond.x, l->beyond.v, a) == 0;
}

/* The largest difference of the accelerations on the old and the new sides; 0 where one is not defined. */
static double leap(const locate *l)
{
    double *a = l->beyond.a, *b = l->to.a, most = 0;
    if (!accelerate(l, l->old_side, a) || !accelerate(l, l->side, b)) return 0;
    for (size_t k = 0; k < l->problem.nv; k++) most = fmax(most, fabs(a[k] - b[k]));
    return most <= DBL_MAX ? most : 0;
}

typedef struct near {
    const motus_run *run;
    const place *at;
    bool straight; /* the positions move evenly, so that powers of them are powers of the time */
} near;

/* The acceleration of the model itself, whose switches choose their sides. */
static bool force_near(void *ctx, double way, double *a)
{
    const near *n = ctx;
    const problem *p = &n->run->system->problem;
    place *beyond = &n->run->locate->beyond;
    follow(p, n->at, way, beyond->x, beyond->v);
    for (size_t k = 0; n->straight && k < p->nx; k++) beyond->x[k] = n->at->x[k] + way * n->at->v[k];
    for (size_t k = 0; k < p->nv; k++) a[k] = 0;
    return p->accel(p->ctx, n->at->t + way, beyond->x, beyond->v, a) == 0;
}

/* Records with which power of the time the force departs from a smooth one at a place, near a step of size h. */
static void note_jump(motus_run *r, const place *at, double h)
{
    locate *l = r->locate;
    near n = {r, at, false};
    if (l->jump <= 0) return;
    const problem *p = &l->problem;
    double rounding = fabs(at->t);
    rounding *= 0x1p-52;
    for (size_t k = 0; k < p->nx; k++) { /* the time in which x moves by its rounding */
        const double off = 0x1p-52 * fabs(at->x[k]), late = fmin(off / fabs(at->v[k]), sqrt(off / fabs(at->a[k])));
        if (late > rounding && late <= DBL_MAX) rounding = late;
    }
    double power = jump_power(force_near, &n, p->nv, h, rounding, l->room);
    n.straight = isnan(power);
    for (size_t k = 0; k < p->nx; k++) n.straight = n.straight && !(fabs(at->v[k]) < fabs(h * at->a[k]));
    if (n.straight) power = jump_power(force_near, &n, p->nv, h, rounding, l->room);
    if (isnan(power) || power >= l->jump - ALIKE) return; /* false where there was none */
    l->jump = power;
    l->jump_time = at->t;
}

/* Touches ---------------------------------------------------------------------------------------------------------- */

/* The rate of touch k after a part of the step, whose end is `beyond`; NaN: it cannot be computed. */
static double touch_rate(motus_run *r, size_t k, double h, double part, motus_status *status, motus_error *err)
{
    locate *l = r->locate;
    *status = step_from(r, &l->from, part * h, &l->beyond, err);
    if (*status != MOTUS_OK) return NAN;
    held_touch_rates(l->held, l->beyond.t, l->beyond.x, l->beyond.v, l->beyond.a, l->touch_rate[1]);
    return h * l->touch_rate[1][k];
}

/* The part of the step at which the argument of touch k is least, with the state there in `beyond`. Rates: at both
 * ends. */
static motus_status least_of(motus_run *r, size_t k, double h, double rate0, double rate1, double *part,
                             motus_error *err)
{
    double low = 0, high = 1;
    motus_status status = MOTUS_OK;
    *part = 1;
    for (int turn = 0, moved = 0; turn < HALVINGS_MAX && high - low > 0x1p-51 && status == MOTUS_OK; turn++) {
        double z = low + (high - low) * rate0 / (rate0 - rate1);
        if (turn % 4 == 3 || !(z > low && z < high)) z = 0.5 * (low + high);
        if (r->locate->from.t + z * h == r->locate->from.t) break;
        const double rate = touch_rate(r, k, h, *part = z, &status, err);
        if (rate == 0) break;
        if (rate < 0) {
            low = z, rate0 = rate;
            if (moved < 0) rate1 /= 2;
            moved = -1;
        } else {
            high = z, rate1 = rate;
            if (moved > 0) rate0 /= 2;
            moved = 1;
        }
    }
    return status;
}

/* As find_dip, for the first touch in the step: the force is not smooth there, although no argument changes its
 * side. */
static motus_status find_touch(motus_run *r, double h, double *fraction, motus_error *err)
{
    locate *l = r->locate;
    *fraction = 1;
    if (!l->touches) return MOTUS_OK;
    held_touch(l->held, l->from.t, l->from.x, l->from.v, l->touch[0]);
    held_touch(l->held, l->to.t, l->to.x, l->to.v, l->touch[1]);
    held_touch_rates(l->held, l->from.t, l->from.x, l->from.v, l->from.a, l->touch_rate[0]);
    for (size_t k = 0; k < l->touches; k++) {
        held_touch_rates(l->held, l->to.t, l->to.x, l->to.v, l->to.a, l->touch_rate[1]);
        const double u0 = l->touch[0][k], u1 = l->touch[1][k], s0 = h * l->touch_rate[0][k],
                     s1 = h * l->touch_rate[1][k], meet = (u1 - s1 - u0) / (s0 - s1);
        if (!(s0 < 0 && s1 >= 0 && u0 + s0 * meet < 0.25 * fmin(u0, u1))) continue; /* the tangents meet above 0 */
        double part;
        const motus_status status = least_of(r, k, h, s0, s1, &part, err);
        if (status == MOTUS_MEMORY) return status;
        if (status != MOTUS_OK) continue;
        double *u = l->touch_rate[1];
        held_touch(l->held, l->beyond.t, l->beyond.x, l->beyond.v, u);
        if (!(fabs(u[k]) <= TOUCHED * fmax(u0, u1))) continue;
        place_copy(&l->twice, &l->beyond, &l->problem, l->count);
        note_jump(r, &l->twice, r->timing.h);
        if (!(part > EDGE && part < 1 - EDGE && part < *fraction)) continue;
        *fraction = part;
        place_copy(&l->found, &l->twice, &l->problem, l->count);
    }
    return MOTUS_OK;
}

/* Pieces ----------------------------------------------------------------------------------------------------------- */

static motus_status slides(const motus_run *r, size_t k, motus_error *err)
{
    const locate *l = r->locate;
    char name[128], t[DECIMAL_MAX];
    held_name(l->held, k, name, sizeof name);
    fail(err, MOTUS_SOLVE,
         "from t = %s on the motion slides along %s = 0: the force drives it there from both sides, as dry friction "
         "that sticks",
         run_time_text(r, l->from.t, t), name);
    hint(err, "locate no switches in this model");
    return MOTUS_SOLVE;
}

/* Changes the sides of all arguments that have left theirs at `to`. Returns one of them, or `count`. */
static size_t change_sides(locate *l)
{
    size_t changed = l->count;
    memcpy(l->old_side, l->side, l->count * sizeof *l->side);
    for (size_t k = 0; k < l->count; k++) {
        const operation op = held_operation(l->held, k);
        if (gap(l, k, &l->to) < 0) {
            l->side[k] = switches_beyond(op, l->side[k], l->to.u[k]);
            changed = k;
        }
        l->slack[k] = fmax(0, -2 * switches_gap(op, l->side[k], l->to.u[k]));
    }
    return changed;
}

/* Where no step leads on from `to`, because the force is not defined beyond a root: changes the sides of the arguments
 * that reach their ends within the time `way`, and moves `to` beyond them by Taylor's formula. Returns one of them, or
 * `count`. */
static size_t change_sides_ahead(locate *l, double way)
{
    const problem *p = &l->problem;
    size_t changed = l->count;
    double part = 0; /* of `way`, until all have reached their ends */
    memcpy(l->old_side, l->side, l->count * sizeof *l->side);
    held_rates(l->held, l->to.t, l->to.x, l->to.v, l->to.a, l->rate[1]);
    for (size_t k = 0; k < l->count; k++) {
        const operation op = held_operation(l->held, k);
        const double ahead = way * switches_gap_rate(op, l->side[k], l->to.u[k], l->rate[1][k]),
                     left = gap(l, k, &l->to);
        if (!(left + ahead <= 0)) continue;
        part = fmax(part, left / -ahead);
        l->side[k] = switches_beyond(op, l->side[k], l->to.u[k]);
        changed = k;
    }
    if (changed == l->count) return changed;
    follow(p, &l->to, 2 * part * way, l->beyond.x, l->beyond.v);
    memcpy(l->to.x, l->beyond.x, p->nx * sizeof(double));
    memcpy(l->to.v, l->beyond.v, p->nv * sizeof(double));
    l->to.t += 2 * part * way;
    held_values(l->held, l->to.t, l->to.x, l->to.v, l->to.u);
    for (size_t k = 0; k < l->count; k++)
        l->slack[k] = fmax(0, -2 * switches_gap(held_operation(l->held, k), l->side[k], l->to.u[k]));
    return changed;
}

/* All times, positions, velocities and accelerations between two states, with a margin for the curve. */
typedef struct way {
    interval t, *x, *v, *a;
} way;

static interval between(double from, double to, double margin)
{
    return (interval){fmin(from, to) - margin, fmax(from, to) + margin};
}

static way way_of(const locate *l, const place *from, const place *to)
{
    const problem *p = &l->problem;
    const double h = to->t - from->t;
    const way w = {between(from->t, to->t, 0), l->box, l->box + p->nx, l->box + p->nx + p->nv};
    for (size_t k = 0; k < p->nx; k++) w.x[k] = between(from->x[k], to->x[k], fabs(h * (to->v[k] - from->v[k])) / 8);
    for (size_t k = 0; k < p->nv; k++) {
        const double bend = fabs(to->a[k] - from->a[k]) / 8;
        w.v[k] = between(from->v[k], to->v[k], fabs(h) * bend);
        w.a[k] = between(from->a[k], to->a[k], bend);
    }
    return w;
}

/* Whether the step from `from` to `to` resolves the force. */
static bool fits(const locate *l, const place *from, const place *to)
{
    if (!l->resolves) return true;
    const way w = way_of(l, from, to);
    return held_fits(l->held, w.t, w.x, w.v);
}

/* Whether every argument either stays on its side all the way, or moves one way, so that the end tells what it did. */
static bool sure(const locate *l, const place *from, const place *to)
{
    if (!l->careful) return true;
    const way w = way_of(l, from, to);
    interval *argument = l->reach, *rate = l->reach + l->count;
    held_reach(l->held, w.t, w.x, w.v, w.a, argument, rate);
    for (size_t k = 0; k < l->count; k++) {
        const operation op = held_operation(l->held, k);
        const double least =
            fmin(switches_gap(op, l->side[k], argument[k].low), switches_gap(op, l->side[k], argument[k].high)) +
            l->slack[k];
        if (least <= 0 && !(rate[k].low >= 0 || rate[k].high <= 0)) return false;
    }
    return true;
}

static double largest(const double *y, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) most = fmax(most, fabs(y[k]));
    return most;
}

/* Takes the piece of size h that led to `to` once more, in two halves, to `twice`. *same: both give the same, to
 * nearly the rounding of numbers of the largest size, and that of the force. */
static motus_status halve(motus_run *r, double h, bool *same, motus_error *err)
{
    locate *l = r->locate;
    const problem *p = &l->problem;
    *same = false;
    motus_status status = step_from(r, &l->from, h / 2, &l->beyond, err);
    if (status == MOTUS_OK) status = step_from(r, &l->beyond, l->to.t - l->beyond.t, &l->twice, err);
    if (status != MOTUS_OK) return status == MOTUS_MEMORY ? status : MOTUS_OK;
    const double a = fmax(largest(l->from.a, p->nv), fmax(largest(l->beyond.a, p->nv), largest(l->to.a, p->nv))),
                 v = fmax(largest(l->from.v, p->nv), largest(l->to.v, p->nv)), way = fabs(h),
                 late = 0x1p-52 * fabs(l->to.t), /* rounding of the time, at which a force changes fast */
        force = FORCES * held_force_rounding(l->held, l->to.t, l->to.x, l->to.v, l->room);
    const double of_x = 1e-13 * (largest(l->to.x, p->nx) + way * v) + late * v + way * way * force + 1e-30,
                 of_v = 1e-13 * (v + way * a) + late * a + way * force + 1e-30; /* before a force sets in */
    *same = true;
    for (size_t k = 0; k < p->nv; k++) {
        if (k < p->nx && !(fabs(l->to.x[k] - l->twice.x[k]) <= of_x)) *same = false;
        if (!(fabs(l->to.v[k] - l->twice.v[k]) <= of_v)) *same = false;
    }
    if (*same) l->rounding += way * force / FORCES;
    return MOTUS_OK;
}

/* By how much the acceleration changes over a piece. */
static double change(const locate *l)
{
    double most = 0;
    for (size_t k = 0; k < l->problem.nv; k++) most = fmax(most, fabs(l->to.a[k] - l->from.a[k]));
    return most;
}

/* The piece that begins at `from`, of size *h at most, which becomes shorter where the force is not resolved, or where
 * an argument may leave its side and come back; it leads to `to`. *failed: it cannot be computed. */
static motus_status piece(motus_run *r, double *h, bool *failed, motus_error *err)
{
    locate *l = r->locate;
    const double least = fmax(0x1p-24 * fabs(r->timing.h), 0x1p-48 * fabs(l->from.t));
    for (;;) {
        motus_status status = step_from(r, &l->from, *h, &l->to, err);
        if (status == MOTUS_MEMORY) return status;
        *failed = status != MOTUS_OK;
        if (!l->resolves && (*failed || !l->careful)) return MOTUS_OK;
        const bool small = fabs(*h) < 2 * least, resolved = !*failed && fits(l, &l->from, &l->to);
        if (small && (resolved || *failed)) return MOTUS_OK;
        if (small) {
            char t[DECIMAL_MAX];
            fail(err, MOTUS_SOLVE, "the force changes too fast to be resolved at t = %s; it may be singular there",
                 run_time_text(r, l->from.t, t));
            return MOTUS_SOLVE;
        }
        if (resolved && sure(l, &l->from, &l->to)) {
            bool same;
            if (!l->resolves) return MOTUS_OK;
            status = halve(r, *h, &same, err);
            if (status != MOTUS_OK) return status;
            if (same) {
                place_swap(&l->to, &l->twice);
                l->rounding += change(l) * 0x1p-52 * fabs(l->to.t);
                return MOTUS_OK;
            }
        }
        *h /= 2;
    }
}

/* Moves on from `from` to `to` by Taylor's formula, over a time so short that its error is far below rounding. False:
 * the force is not defined there. */
static bool nudge(locate *l, double way)
{
    const problem *p = &l->problem;
    place *to = &l->to;
    follow(p, &l->from, way, to->x, to->v);
    to->t = l->from.t + way;
    if (!accelerated(l, to)) return false;
    for (size_t k = 0; k < p->nv; k++)
        if (!isfinite(to->a[k])) return false;
    held_values(l->held, to->t, to->x, to->v, to->u);
    return true;
}

/* How uncertain the time is at which the arguments that have just changed sides, at `from`, were 0: by the rounding of
 * the time, and of the arguments over their rates. */
static double lateness(locate *l, double h)
{
    const place *at = &l->from;
    double late = 0x1p-52 * fabs(at->t), *rounding = l->size;
    held_rounding(l->held, at->t, at->x, at->v, rounding);
    held_rates(l->held, at->t, at->x, at->v, at->a, l->rate[1]);
    for (size_t k = 0; k < l->count; k++) {
        const double own = rounding[k] / fabs(l->rate[1][k]);
        if (l->side[k] != l->old_side[k] && own > late && own < fabs(h)) late = own;
    }
    return late;
}

/* A switch that has just changed its side may move the arguments of others, which then change theirs at once. */
static motus_status settle(motus_run *r, motus_error *err)
{
    locate *l = r->locate;
    place *at = &l->from;
    for (int turn = 0; turn < STILL_MAX; turn++) {
        bool changed = false;
        for (size_t k = 0; k < l->count; k++) {
            const operation op = held_operation(l->held, k);
            if (!(gap(l, k, at) < 0)) continue;
            l->side[k] = switches_side(op, at->u[k], 0);
            l->slack[k] = fmax(0, -2 * switches_gap(op, l->side[k], at->u[k]));
            changed = true;
        }
        if (!changed) return MOTUS_OK;
        if (!held_bind(l->held, l->side, false)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
        if (!accelerated(l, at)) break;
        held_values(l->held, at->t, at->x, at->v, at->u);
    }
    char t[DECIMAL_MAX];
    return fail(err, MOTUS_SOLVE, "the force cannot be evaluated at the switches at t = %s",
                run_time_text(r, at->t, t));
}

/* From `from` to the time `end`, which is ahead; the state there is then `from`. */
static motus_status pieces(motus_run *r, double end, motus_error *err)
{
    locate *l = r->locate;
    char t[DECIMAL_MAX];
    for (int count = 0, still = 0; count < PIECES_MAX; count++) {
        if (count % LOOK == LOOK - 1 && r->pace.tell && r->pace.tell(r->pace.ctx, pace_now())) return MOTUS_CANCELLED;
        const double left = end - l->from.t;
        double h = fabs(l->next) < fabs(left) ? copysign(l->next, left) : left, part = 1;
        if (l->from.t + left == l->from.t) return MOTUS_OK;
        bool failed, touched = false;
        motus_status status = piece(r, &h, &failed, err);
        if (status != MOTUS_OK) return status;
        if (!failed && !(least_gap(l, &l->to, NULL) < 0)) {
            status = find_dip(r, h, &part, err);
            if (status != MOTUS_OK) return status;
            if (part == 1) {
                status = find_touch(r, h, &part, err);
                if (status != MOTUS_OK) return status;
                touched = part < 1;
            }
            if (touched) place_swap(&l->to, &l->found);
            if (part == 1 || touched) {
                place_swap(&l->from, &l->to);
                if (l->resolves && (h != left || touched || fabs(2 * h) > fabs(l->next))) l->next = 2 * h * part;
                if (h != left || touched) continue;
                l->from.t = end;
                return MOTUS_OK;
            }
            h *= part;
            place_swap(&l->to, &l->found);
        }
        const double tried = h;
        const bool lost = failed;
        status = bracket(r, &h, &failed, err);
        if (status != MOTUS_OK) return status;
        size_t changed = change_sides(l);
        if (changed == l->count && failed) {
            const bool moves = l->from.t + h != l->from.t;
            const double least = fmin(0x1p-10 * fabs(tried), 0x1p-30 * fabs(r->timing.h)),
                         late = copysign(0x1p-46 * fabs(l->to.t) + (moves ? 0 : least), tried);
            changed = change_sides_ahead(l, late);
            /* A stage was beyond a root that is further ahead, or behind. */
            if (changed == l->count && (moves || (still++ < STILL_MAX && nudge(l, late)))) {
                place_swap(&l->from, &l->to);
                continue;
            }
        }
        if (changed == l->count) {
            if (lost) return step_from(r, &l->from, tried, &l->to, err); /* the failure is another one */
            return fail(err, MOTUS_SOLVE, "a switch near t = %s was not found", run_time_text(r, l->from.t, t));
        }
        if (l->resolves) l->next = tried;
        l->located++;
        still = fabs(h) <= NEAR * fabs(r->timing.h) ? still + 1 : 0;
        place_swap(&l->from, &l->to);
        if (still > STILL_MAX) return slides(r, changed, err);
        const double late = lateness(l, tried);
        l->rounding += leap(l) * late;
        if (!held_bind(l->held, l->side, false)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
        if (!accelerated(l, &l->from))
            return fail(err, MOTUS_CALLBACK, "the acceleration cannot be evaluated at t = %s",
                        run_time_text(r, l->from.t, t));
        held_values(l->held, l->from.t, l->from.x, l->from.v, l->from.u);
        status = settle(r, err);
        if (status != MOTUS_OK) return status;
        note_jump(r, &l->from, r->timing.h);
    }
    return fail(err, MOTUS_SOLVE,
                "one step has more than %d pieces, since the force changes so often or so fast at t = %s", PIECES_MAX,
                run_time_text(r, l->from.t, t));
}

/* Steps ------------------------------------------------------------------------------------------------------------ */

motus_status locate_begin(motus_run *r, motus_error *err)
{
    locate *l = r->locate;
    place *at = &l->from;
    double *u = l->to.u, *later = l->beyond.u, *x = l->beyond.x, *v = l->beyond.v;
    motus_status status = MOTUS_OK;
    char t[DECIMAL_MAX];
    l->steps = 0;
    l->known = false;
    for (size_t k = 0; k < l->count; k++) l->slack[k] = 0;
    /* The sides decide the acceleration, which decides where an argument moves that is 0 now. The stepper begins anew,
     * since it keeps an acceleration that was observed. */
    for (int pass = 0; pass < 3 && status == MOTUS_OK; pass++) {
        if (!held_bind(l->held, l->side, false)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
        if (pass > 0) status = stepper_start(r->stepper, at->t, r->timing.h, at->x, at->v, err);
        if (pass == 2 || status != MOTUS_OK) break;
        status = observe(r, at, err);
        if (status != MOTUS_OK) break;
        const problem *own = &r->system->problem;
        if (pass == 0 && own->accel(own->ctx, at->t, at->x, at->v, at->a))
            return fail(err, MOTUS_CALLBACK, "the acceleration cannot be evaluated at t = %s",
                        run_time_text(r, at->t, t));
        const double way = r->timing.h * 0x1p-20;
        follow(&l->problem, at, way, x, v);
        held_arguments(l->held, at->t, at->x, at->v, u);
        held_arguments(l->held, at->t + way, x, v, later);
        for (size_t k = 0; k < l->count; k++)
            l->side[k] = switches_side(held_operation(l->held, k), u[k], later[k] - u[k]);
    }
    return status;
}

bool locate_bind(motus_run *r) { return held_bind(r->locate->held, r->locate->side, false); }

int64_t locate_steps(const motus_run *r) { return r->locate->steps; }

/* The stepper goes on from `at`, which is `steps` steps of the run's leg after its start. */
static motus_status resume(motus_run *r, const place *at, int64_t steps, motus_error *err)
{
    r->locate->steps = steps;
    return stepper_start(r->stepper, at->t, r->timing.h, at->x, at->v, err);
}

motus_status locate_step(motus_run *r, stepper_stop *why, motus_error *err)
{
    locate *l = r->locate;
    const stepper_limit limit = {1, r->timing.until};
    const int64_t steps = l->steps + stepper_steps(r->stepper);
    double end = stepper_time_of(r->stepper, stepper_steps(r->stepper) + 1);
    if (steps + 1 >= r->timing.total) end = r->timing.until;
    if (!held_bind(l->held, l->side, false)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    l->away = false;
    motus_status status = l->known ? MOTUS_OK : observe(r, &l->from, err);
    if (status != MOTUS_OK) return status;
    status = stepper_advance(r->stepper, limit, why, err);
    if (status == MOTUS_MEMORY) return status;
    if (status == MOTUS_OK) status = observe(r, &l->to, err);
    double part = 1;
    const bool tried =
        status != MOTUS_OK || l->resolves || least_gap(l, &l->to, NULL) < 0 || !sure(l, &l->from, &l->to);
    place_copy(&l->start, &l->from, &l->problem, l->count);
    memcpy(l->start_side, l->side, l->count * sizeof *l->side);
    if (!tried && (status = find_dip(r, l->to.t - l->from.t, &part, err)) != MOTUS_OK) return status;
    if (!tried && part == 1 && (status = find_touch(r, l->to.t - l->from.t, &part, err)) != MOTUS_OK) return status;
    if (!tried && part == 1) {
        place_swap(&l->from, &l->to);
        l->known = true;
        for (size_t k = 0; k < l->count; k++) l->slack[k] = 0;
        if (l->away && (status = resume(r, &l->from, steps + 1, err)) == MOTUS_OK)
            status = stepper_advance(r->stepper, (stepper_limit){0, r->timing.until}, why, err);
        return status;
    }
    status = pieces(r, end, err);
    l->known = false;
    if (status == MOTUS_OK) status = resume(r, &l->from, steps + 1, err);
    if (status == MOTUS_OK) return stepper_advance(r->stepper, (stepper_limit){0, r->timing.until}, why, err);
    memcpy(l->side, l->start_side, l->count * sizeof *l->side);
    if (held_bind(l->held, l->side, false)) resume(r, &l->start, steps, NULL);
    return status;
}
