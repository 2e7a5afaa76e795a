/* See companion.h.
 *
 * For n steps of the run between two landings the companion takes 2 n + 1. Its error is then about 2^-p of the run's, p
 * the order, so their distance is nearly the run's error. With 2 n steps every second time would be one of the run's,
 * and both could fail alike: steps that pass a close encounter at the same times before and after lead to the same
 * wrong orbit, at every power of 2. With 2 n + 1 the grids share the landings alone.
 *
 * Adaptive steps: the companion takes each accepted step of the run in two halves, by a tolerance that accepts every
 * error, and with the order that the run's step chose.
 *
 * Forces with kinks or jumps: the companion controls its error by a tolerance of its own. By halves of the run's steps
 * both would often pass a jump in one step from the same state, with the same error: of 6000 numbers of three such
 * motions by Taylor series 2331 were beyond their bars; with a tolerance of its own, 13. The tolerance, 2^-(p + 1) of
 * the run's, makes steps half as long; it is at least 2^-10, since an error at a jump does not go with the order. Where
 * a step does not evaluate the force at its end, no estimate sees a jump behind the last abscissa, a fortieth of the
 * step by Gauss-Radau; the companion takes the last part of each step apart. Where a force holds the motion at a jump
 * (Coulomb friction), a smaller tolerance may want thousands of steps for one of the run's; the companion then gives
 * up.
 *
 * Taylor series: the companion's steps may be refused as the run's may. Half a step from a state that is off by
 * rounding leaves the circle of convergence where the run's steps are as short as its distance from a singularity, as
 * at the infinite slope of cbrt(x).
 *
 * Beeman's method: the companion is velocity Verlet, which has the same positions. Beeman's positions do not follow
 * from its velocities, so beginning anew at every landing would be an error of its own.
 *
 * The companion lands and does not interpolate, since the error of an interpolant of a method of high order is larger
 * than what is measured. A landing costs one more step, and compensated additions stay compensated.
 */
#include "api/error/companion.h"

#include "base/decimal.h"

#include "core/rows.h"
#include "api/motion/run_events.h"
#include "machine/differences.h"

#include <math.h>

#define USUAL 0x1p-55

enum { STRICTER_MOST = 10, STEPS_FIRST = 4096, STEPS_EACH = 8 }; /* steps in all, and more for each step of the run */
#define LAST_PART 0x1p-5

/* Returns whether the half controls its error. Steps that follow a time scale do not. */
static bool controls(const chosen *c, const motus_system *s)
{
    const bool kinks = s->model && (!s->problem.traits.smooth || system_located(s));
    return row_adaptive(c) && !row_reversible_steps(c) && kinks;
}

/* Returns whether every candidate for a step is compared with the force at its end. */
static bool sees_end(const row *r) { return r->expands || r->tableau.ending || r->tableau.closing; }

/* Returns the method with a tolerance that accepts every error. */
static chosen without_control(const chosen *c)
{
    chosen method = *c;
    if (!row_adaptive(c)) return method;
    if (method.relative == 0) method.relative = method.absolute; /* a Taylor series takes its order from it */
    method.absolute = DIFFERENCES_ANY_ERROR, method.least = 0, method.most = INFINITY, method.count = 0;
    return method;
}

static chosen with_less(const chosen *c)
{
    chosen method = *c;
    const int order = c->row->card.order + 1, power = order < STRICTER_MOST ? order : STRICTER_MOST;
    method.relative = ldexp(c->relative, -power), method.absolute = ldexp(c->absolute, -power);
    method.least = 0, method.most = INFINITY, method.count = 0;
    return method;
}

chosen companion_method(const chosen *c, const motus_system *s)
{
    chosen method = *c;
    if (controls(c, s)) return with_less(c);
    if (c->row->expands) {
        method.least = 0, method.most = INFINITY;
        return method;
    }
    if (c->row->alone && row_choose(c->row->alone, &method, NULL, NULL) == MOTUS_OK) {
        method.varies = c->varies;
        method.threads = c->threads;
    }
    return without_control(&method);
}

static uint32_t hash(uint32_t z) /* Murmur3's finaliser */
{
    z = (z ^ z >> 16) * 0x85ebca6bu;
    z = (z ^ z >> 13) * 0xc2b2ae35u;
    return z ^ z >> 16;
}

/* Moves numbers by what the rounding of an action may be. An action moves each by up to a unit in the last place: with
 * fewer moves a chaotic motion of few numbers, whose first errors grow most, would have no error until the first of
 * them. A switch computes no number, and the motion goes on by other steps: a third of a unit, in the mean square. */
static void jog(double *y, size_t count, uint32_t salt, bool switched)
{
    for (size_t k = 0; k < count; k++)
        if (!switched || (hash((uint32_t)k + salt) >> 8 & 7) == 0) companion_move(y + k, 1, NULL, salt + (uint32_t)k);
}

motus_status companion_begin(companion *c, const motus_run *r, double t, const double *x, const double *v,
                             motus_error *err)
{
    const problem *p = &r->system->problem;
    if (!c->x) c->x = take(&r->allocator, p->nx + p->nv + 2, sizeof *c->x);
    if (!c->x) return fail(err, MOTUS_MEMORY, "no memory for a companion of the run");
    c->v = c->x + p->nx + 1;
    for (size_t k = 0; k < p->nx; k++) c->x[k] = x[k];
    for (size_t k = 0; k < p->nv; k++) c->v[k] = v[k];
    c->t = t;
    c->before = 0;
    c->room = STEPS_FIRST;
    c->controls = c->system && controls(&r->chosen, c->system);
    const chosen method = c->system ? companion_method(&r->chosen, c->system) : without_control(&r->chosen);
    c->over = false;
    motus_status status =
        c->stepper ? stepper_start(c->stepper, t, r->timing.h, x, v, err)
                   : stepper_create(&c->machine, &method, t, r->timing.h, x, v, &r->allocator, &c->stepper, err);
    if (status != MOTUS_OK || !r->rules) return status;
    const rules *rules;
    status = system_rules(c->system ? c->system : r->system, &rules, err);
    if (status == MOTUS_OK && !c->events)
        status = events_create(rules, &c->machine, &method, &r->allocator, &c->events, err);
    if (status == MOTUS_OK) events_jog(c->events, jog);
    return status == MOTUS_OK ? events_begin(c->events, c->stepper, r->timing.until, err) : status;
}

static motus_status see(companion *c, motus_error *err)
{
    const motus_status status = stepper_sync(c->stepper, c->x, c->v, NULL, err);
    if (status == MOTUS_OK && c->events) events_keep(c->events, stepper_time(c->stepper), c->x);
    return status;
}

/* Goes to t with all events on the way, from where a leg begins. */
static motus_status follow(companion *c, double t, motus_error *err)
{
    stepper_stop why = STOP_STEPS;
    char from[DECIMAL_MAX], to[DECIMAL_MAX];
    events_turn(c->events, c->stepper);
    const int64_t room = c->controls ? c->room : INT64_MAX;
    motus_status status = run_events_steps(c->events, c->stepper, &c->pace, room, t, &why, err);
    c->room -= events_steps(c->events);
    if (status == MOTUS_OK && why == STOP_STEPS)
        return fail(err, MOTUS_DIVERGED, "it needs far more steps than the run from t = %s to %s",
                    decimal(stepper_time(c->stepper), from), decimal(t, to));
    c->over = why == STOP_EVENT;
    if (status == MOTUS_OK) status = see(c, err);
    if (status == MOTUS_OK) c->t = stepper_time(c->stepper);
    return status;
}

motus_status companion_reach(companion *c, const companion_goal *to, double span, motus_error *err)
{
    enum { PARTS = 16 };
    const double t = c->t, h = span / PARTS;
    stepper_stop why = STOP_STEPS;
    if (!c->events || c->over || t + h == t) return MOTUS_OK;
    bool there = to->enough && events_acted(c->events) >= to->acted;
    if (there && !to->ends) return MOTUS_OK;
    motus_status status = there ? MOTUS_OK : stepper_turn(c->stepper, t, h, err);
    if (!there) events_turn(c->events, c->stepper);
    for (int k = 0; status == MOTUS_OK && k < STEPS_FIRST && why == STOP_STEPS && !there; k++) {
        status = run_events_steps(c->events, c->stepper, &c->pace, 1, t + span, &why, err);
        there = to->enough && events_acted(c->events) >= to->acted;
    }
    c->over = why == STOP_EVENT || (there && to->ends);
    if (status == MOTUS_OK) status = see(c, err);
    if (status == MOTUS_OK) c->t = stepper_time(c->stepper);
    return status;
}

/* Goes to t in `steps` equal steps. Adaptive steps are never refused, or only begin with this size; and the equation of
 * a step may need shorter ones. */
static motus_status go(companion *c, const motus_run *r, double t, int64_t steps, motus_error *err)
{
    const bool adaptive = row_adaptive(&r->chosen);
    double h = (t - c->t) / (double)steps;
    if (c->t + h == c->t) h = t - c->t, steps = 1; /* an event may lie just before t */
    const stepper_limit limit = {c->controls ? c->room : adaptive ? INT64_MAX : steps, adaptive ? t : NAN};
    stepper_stop why;
    if (c->over || (t - c->t) * r->timing.h <= 0) return MOTUS_OK; /* an event may have led it further */
    motus_status status = stepper_turn(c->stepper, c->t, h, err);
    if (!c->controls) stepper_follow(c->stepper, r->stepper);
    if (status == MOTUS_OK && c->events) return follow(c, t, err);
    const int64_t before = stepper_steps(c->stepper);
    if (status == MOTUS_OK) status = pace_advance(&c->pace, c->stepper, limit, &why, err);
    c->room -= stepper_steps(c->stepper) - before;
    if (status == MOTUS_OK && adaptive && stepper_time(c->stepper) != t)
        return fail(err, MOTUS_DIVERGED,
                    "it needs far more steps than the run, which the force keeps at a jump or kink");
    if (status == MOTUS_OK) status = see(c, err);
    if (status == MOTUS_OK) c->t = t;
    return status;
}

motus_status companion_land(companion *c, const motus_run *r, double t, int64_t steps, motus_error *err)
{
    if (!row_adaptive(&r->chosen)) return go(c, r, t, differences_steps(steps), err);
    if (!c->controls) return go(c, r, t, 2 * steps, err);
    motus_status status = MOTUS_OK;
    c->room += STEPS_EACH * steps;
    const bool apart = !sees_end(r->chosen.row) && !system_located(r->system);
    if (apart) status = go(c, r, t - LAST_PART * (t - c->t), 2 * steps, err);
    return status == MOTUS_OK ? go(c, r, t, apart ? 1 : 2 * steps, err) : status;
}

void companion_move(double *y, size_t count, const double *size, uint32_t salt)
{
    for (size_t k = 0; k < count; k++) {
        const double way = hash((uint32_t)k + salt) & 1 ? 1 : -1, to = y[k] + way * (size ? size[k] : 0);
        if (y[k] != 0) y[k] = to != y[k] ? to : nextafter(y[k], way * INFINITY);
    }
}

/* Moves a state by a quarter of the bound on the rounding of the exact formula, which is in units of 2^-53. */
motus_status companion_jog(companion *c, const motus_run *r, motus_error *err)
{
    const problem *p = &r->system->problem;
    double *size = take(&r->allocator, p->nx + p->nv + 1, sizeof *size);
    if (!size) return fail(err, MOTUS_MEMORY, "no memory for a companion of the run");
    const bool known = p->exact_rounding;
    if (known && !p->exact_rounding(p->ctx, c->t, size, size + p->nx)) {
        give(&r->allocator, size);
        return fail(err, MOTUS_MEMORY, "no memory for a companion of the run");
    }
    for (size_t k = 0; k < p->nx + p->nv; k++) size[k] = known ? size[k] * USUAL : 0;
    const uint32_t salt = (uint32_t)stepper_steps(r->stepper) * 0x9e3779b9u;
    companion_move(c->x, p->nx - p->modes, size, salt);
    companion_move(c->v, p->nv, size + p->nx, salt + (uint32_t)p->nx);
    give(&r->allocator, size);
    return MOTUS_OK;
}

/* Lets the stepper go on from the companion's state. */
static motus_status put(companion *c, const motus_run *r, motus_error *err)
{
    const motus_status status = stepper_start(c->stepper, c->t, r->timing.h, c->x, c->v, err);
    return status == MOTUS_OK && c->events ? events_shift(c->events, c->stepper, err) : status;
}

motus_status companion_shift(companion *c, const motus_run *r, const double *dx, const double *dv, motus_error *err)
{
    const problem *p = &r->system->problem;
    for (size_t k = 0; k < p->nx; k++) c->x[k] += dx[k];
    for (size_t k = 0; k < p->nv; k++) c->v[k] += dv[k];
    return put(c, r, err);
}

motus_status companion_led(companion *c, const motus_run *r, witness *w, double t, motus_error *err)
{
    if ((t - c->t) * r->timing.h <= 0) return MOTUS_OK;
    if (!witness_lead(w, c->t, t, c->x, c->v)) return companion_land(c, r, t, 1, err);
    c->t = t;
    return put(c, r, err);
}

motus_status companion_repeat(companion *c, const motus_run *r, motus_error *err)
{
    if (row_adaptive(&r->chosen)) return go(c, r, stepper_time(r->stepper), 1, err);
    const int64_t steps = stepper_steps(r->stepper) - c->before - stepper_steps(c->stepper);
    const stepper_limit limit = {steps, r->timing.until};
    stepper_stop why = STOP_STEPS;
    if (c->over) return MOTUS_OK;
    motus_status status =
        c->events ? run_events_steps(c->events, c->stepper, &c->pace,
                                     run_steps(r) - c->before - events_steps(c->events), limit.until, &why, err)
                  : pace_advance(&c->pace, c->stepper, limit, &why, err);
    c->over = why == STOP_EVENT;
    if (status == MOTUS_OK) status = see(c, err);
    if (status == MOTUS_OK) c->t = stepper_time(r->stepper);
    return status;
}

/* ---- restart ---- */

enum { OVER, ROOM, EVENTS, HEAD }; /* EVENTS: how many numbers the events have */

size_t companion_keep(const companion *c, double *out)
{
    if (!c->events) return 0;
    const size_t count = events_save(c->events, c->stepper, out ? out + HEAD : NULL);
    if (!out) return HEAD + count;
    out[OVER] = c->over;
    out[ROOM] = (double)c->room;
    out[EVENTS] = (double)count;
    return HEAD + count;
}

bool companion_skip(const double **at, const double *end)
{
    const double *in = *at;
    if (end - in < HEAD || !(in[EVENTS] >= 0 && in[EVENTS] <= (double)(end - in - HEAD))) return false;
    *at = in + HEAD + (size_t)in[EVENTS];
    return true;
}

motus_status companion_resume(companion *c, const motus_run *r, const double **at, const double *end, motus_error *err)
{
    const double *in = *at;
    const events_leg leg = {.start = r->timing.t0, .step = r->timing.h, .until = r->timing.until};
    if (!c->events) return MOTUS_OK;
    if (!companion_skip(at, end) || !(fabs(in[ROOM]) < 0x1p63))
        return fail(err, MOTUS_STATE, "what the restart state has of a companion is damaged");
    events *fresh = NULL;
    motus_status status = events_again(c->events, &fresh, err);
    if (status == MOTUS_OK) status = events_load(fresh, NULL, &leg, in + HEAD, (size_t)in[EVENTS], err);
    events_destroy(status == MOTUS_OK ? c->events : fresh);
    if (status != MOTUS_OK) return status;
    c->events = fresh;
    events_jog(fresh, jog);
    c->over = in[OVER] != 0;
    c->room = (int64_t)in[ROOM];
    return MOTUS_OK;
}

void companion_end(companion *c, const motus_allocator *a)
{
    stepper_destroy(c->stepper);
    events_destroy(c->events);
    give(a, c->x);
    motus_system_destroy(c->system);
}
