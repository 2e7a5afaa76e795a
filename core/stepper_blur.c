/* Steps that are so short that the rounding of their times hides how the force changes. See stepper_parts.h.
 *
 * The times of stages are rounded, so a force that changes by Δa over a step by the time alone is off by a part of it,
 * and no velocity is known better than |Δa| times the rounding of the time. Where the motion begins out of rest, as on
 * a ramp of 1e-4 at t = 1, that is more than a small tolerance allows, in steps of every size. Error control then finds
 * no step; there, and nowhere else, candidates may be off by as much. The same goes for the rounding of the force: from
 * rest, 1 - cos(t) is a stair, whose jumps are more than a relative tolerance allows of what moves so far.
 */
#include "core/stepper_parts.h"

#include <string.h>

enum { TRIES = 96, SHORTEST = 1 << 20, SEVERAL = 8 /* stages, whose differences add up */ };
#define BLUR 32.0 /* roundings of the time: the weights of an error take those of several stages */

/* Evaluates the force at a time, where the motion is now. x, v: room. */
static bool accelerate(const stepper *s, double t, double *x, double *v, double *a)
{
    const problem *p = &s->problem;
    memcpy(x, s->work.x, p->nx * sizeof *x);
    memcpy(v, s->work.v, p->nv * sizeof *v);
    memset(a, 0, p->nv * sizeof *a);
    return !p->accel(p->ctx, t, x, v, a);
}

/* Adds to a what the blur of some velocities leaves of others, whose forces they move: a body at rest is carried along
 * by one whose force is a stair. later: the force at the end of the step; other, x, v: room. */
static void carry_on(const stepper *s, double h, double *a, const double *later, double *other, double *x, double *v)
{
    enum { BODIES = 32 };
    const problem *p = &s->problem;
    const size_t moving = p->nx - p->modes;
    bool more = true;
    for (int body = 0; body < BODIES && more; body++) {
        memcpy(x, s->work.x, p->nx * sizeof *x);
        memset(other, 0, p->nv * sizeof *other);
        for (size_t k = 0; k < moving && k < p->nv; k++) x[k] += fabs(h) * a[k];
        for (size_t k = 0; k < p->nv; k++) v[k] = s->work.v[k] + a[k];
        more = false;
        if (p->accel(p->ctx, s->work.t + h, x, v, other)) return;
        for (size_t k = 0; k < p->nv; k++) {
            const double by = SEVERAL * fabs(h) * fabs(other[k] - later[k]);
            more |= a[k] == 0 && by > 0;
            if (isfinite(by)) a[k] = fmax(a[k], by);
        }
    }
}

/* Computes in a what a candidate of size h may be off; the other arrays are room. rounding: of the force, before
 * two more arrays; or NULL: it does not count. */
static void find_blur(const stepper *s, double h, double *rounding, double *a, double *later, double *x, double *v)
{
    const problem *p = &s->problem;
    const double t = s->work.t, far = fmax(fabs(t), fabs(t + h)), ulp = nextafter(far, INFINITY) - far;
    const bool known = accelerate(s, t, x, v, a) && accelerate(s, t + h, x, v, later);
    double *const seen =
        rounding ? rounding + p->nv : NULL; /* the changes of the force beside the step, and in longer ones */
    for (size_t k = 0; k < p->nv; k++) {
        const double moved = fabs(later[k] - a[k]);
        a[k] = known && isfinite(moved) ? BLUR * ulp * moved : 0;
        if (!rounding || !known) continue;
        seen[k] = fmax(seen[k], moved);
        a[k] = fmax(a[k], fabs(h) * fmin(SEVERAL * seen[k], rounding[k]));
    }
    if (known && rounding) carry_on(s, h, a, later, seen + p->nv, x, v);
}

/* Finds the most that the time alone changes of the force between two times. */
static void find_change(const stepper *s, double from, double to, double *most, double *a, double *later, double *x,
                        double *v)
{
    enum { LOOKS = 16 };
    const double part = (to - from) / LOOKS;
    memset(most, 0, s->work.nv * sizeof *most);
    if (!isfinite(part) || !accelerate(s, from, x, v, a)) return;
    for (int look = 1; look <= LOOKS; look++) {
        const bool known = accelerate(s, from + look * part, x, v, later);
        for (size_t k = 0; k < s->work.nv && known; k++) {
            const double by = fabs(later[k] - a[k]);
            if (isfinite(by)) most[k] = fmax(most[k], by);
        }
    }
}

/* Bounds the rounding of the force by what the time alone changes of it from now to the end: 1 - cos(t) is rounded as 1
 * is, also where it is nearly 0. Behind it comes what is seen of it: the change beside now. */
static void find_rounding(const stepper *s, double *rounding, double *a, double *later, double *x, double *v)
{
    const work *w = &s->work;
    const double near = SHORTEST * (nextafter(fabs(w->t), INFINITY) - fabs(w->t));
    find_change(s, w->t, w->until, rounding, a, later, x, v);
    find_change(s, w->t - near, w->t + near, rounding + w->nv, a, later, x, v);
    for (size_t k = 0; k < w->nv; k++) rounding[k] *= BLUR * 0x1p-53;
}

/* Tells whether a blur is more than the tolerance allows over a step of size h, at whose end the force is `later`. */
static bool exceeds(const stepper *s, double h, const double *blur, const double *later)
{
    const work *w = &s->work;
    const problem *p = &s->problem;
    const size_t whole[2] = {0, p->nv}, *const variable = p->variables ? p->variables : whole;
    bool more = false;
    for (int g = 0; g < (p->variables ? p->variable_count : 1); g++) {
        double off = 0, size = 0;
        for (size_t k = variable[g]; k < variable[g + 1]; k++)
            off = fmax(off, blur[k]), size = fmax(size, fabs(w->v[k]) + fabs(h * later[k]));
        more |= off > w->relative * size + w->absolute;
    }
    return more;
}

bool stepper_may_blur(const stepper *s) { return s->problem.traits.time && stepper_refuses(&s->method); }

void stepper_expect_blur(stepper *s, double until)
{
    work *w = &s->work;
    const double ulp = nextafter(fabs(w->t), INFINITY) - fabs(w->t), h = until - w->t;
    if (!stepper_may_blur(s) || !(fabs(h) * w->relative < BLUR * ulp)) return;
    double *room = take(&s->allocator, 3 * w->nv + w->nx + 1, sizeof *room);
    if (!room) return; /* then error control takes more steps */
    double *const blur = room, *const later = room + w->nv;
    find_blur(s, h, NULL, blur, later, later + 2 * w->nv, later + w->nv);
    if (exceeds(s, h, blur, later)) w->rise = STEPPER_BLURS;
    give(&s->allocator, room);
}

/* Returns the size that a candidate of size h has, since no step passes `until`. */
static double within(const work *w, double h)
{
    const double left = (w->until - w->t) - w->lost;
    if (fabs(h) >= fabs(left)) return left;
    return 2 * fabs(h) > fabs(left) ? left / 2 : h;
}

/* Takes a step by candidates from the size that error control tries first. False: there is none, or no memory. */
static bool take_step(stepper *s, const stepper_body *body)
{
    work *w = &s->work;
    double *const rounding = take(&s->allocator, 6 * w->nv + w->nx + 1, sizeof *rounding);
    if (!rounding) return false;
    double *const a = rounding + 3 * w->nv, *const later = a + w->nv, *const v = later + w->nv, *const x = v + w->nv;
    const whole good = w->n;
    const double ulp = nextafter(fabs(w->t), INFINITY) - fabs(w->t);
    int bad = STEP_STALLED;
    if (w->t + w->next == w->t) w->next = copysign(SHORTEST * ulp, w->until - w->t);
    double *const by =
        s->problem.modes ? NULL : rounding; /* where switches change, nobody knows what it does to them */
    if (by) find_rounding(s, by, a, later, x, v);
    for (int k = 0; k < TRIES && bad == STEP_STALLED && w->n == good && w->t + w->next != w->t; k++) {
        find_blur(s, within(w, w->next), by, a, later, x, v);
        w->blur = a;
        w->watch = s->watching ? &s->watch : NULL;
        bad = body->run(w, 1);
        w->watch = NULL;
        w->blur = NULL;
    }
    const bool more = fabs(w->h) * w->relative < BLUR * ulp || (by && w->n > good && exceeds(s, w->h, a, later));
    w->rise = more ? STEPPER_BLURS : CONTROL_RISE;
    give(&s->allocator, rounding);
    return w->n > good && !s->body->check(w);
}

int stepper_repeat(stepper *s, int64_t steps)
{
    work *w = &s->work;
    const whole end = w->n + steps;
    while (w->n < end && w->rise == STEPPER_BLURS)
        if (!take_step(s, w->host ? stepper_best_body() : s->body)) return STEP_STALLED;
    return w->n < end ? s->body->run(w, end - w->n) : STEP_OK;
}

bool stepper_blurred(stepper *s, const stepper_body *body)
{
    work *w = &s->work;
    const stepper_count now = {w->n, w->evaluations, w->iterations, w->refused};
    if (!stepper_may_blur(s) || fabs(w->next) < w->least) return false; /* a shortest step is the caller's limit */
    stepper_put(s, s->at, s->snapshot); /* a candidate that is refused changes the size of the next one */
    const int bad = stepper_repeat(s, now.steps - w->n);
    if (bad && !(bad == STEP_STALLED && w->n == now.steps)) return false;
    w->evaluations = now.evaluations, w->iterations = now.iterations, w->refused = now.refused;
    w->rise = STEPPER_BLURS;
    s->at = stepper_get(s, s->snapshot); /* from which the step can be repeated */
    return stepper_mark(s, NULL) == MOTUS_OK && take_step(s, w->host ? stepper_best_body() : body);
}
