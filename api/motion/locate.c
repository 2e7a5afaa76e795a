/* Steps that end where the force changes its formula. See locate.h.
 *
 * A step is first taken with the sides as they are. If every argument is on its side at the end and no argument can
 * have left it and come back, that is the step. Otherwise the pieces follow: the first root is bracketed by steps of
 * other lengths from the same state, until its time is known to rounding; the piece ends just beyond it, so that the
 * argument is on the new side; and the next piece leads on to the end of the step. So every state is that of a step of
 * the method with a smooth force, and the order of the method remains. Invariant: `x`, `v` at `t` is a state of the
 * trajectory, and `side` are the sides after it.
 */
#include "api/motion/locate_parts.h"
#include "api/motion/run_events.h"

#include <math.h>
#include <string.h>

static double *place_memory(place *s, const problem *p, size_t count, double *at)
{
    s->x = at;
    s->v = s->x + p->nx;
    s->a = s->v + p->nv;
    s->u = s->a + p->nv;
    return at + locate_numbers(p, count);
}

motus_status locate_prepare(motus_run *r, motus_switches switches, motus_error *err)
{
    motus_system *s = r->system;
    if (switches == MOTUS_SWITCHES_STEP || switches == MOTUS_SWITCHES_USUAL) return MOTUS_OK;
    if (switches != MOTUS_SWITCHES_LOCATE && switches != MOTUS_SWITCHES_RESOLVE)
        return fail(err, MOTUS_ARGUMENT, "there is no way to treat switches of number %d", (int)switches);
    const bool fixed = s->model && !row_adaptive(&r->chosen) && !row_formula(&r->chosen);
    r->unswitched = fixed && switches == MOTUS_SWITCHES_LOCATE && !located_kinks(s->model);
    if (switches == MOTUS_SWITCHES_LOCATE) return MOTUS_OK; /* by events: api/system/located.c */
    if (row_adaptive(&r->chosen)) {
        fail(err, MOTUS_UNAVAILABLE, "steps of one size resolve switches, and %s adapts its steps", r->chosen.name);
        hint(err, "choose another method, or `switches = MOTUS_SWITCHES_STEP` of the definition");
        return MOTUS_UNAVAILABLE;
    }
    if (!fixed) return MOTUS_OK;
    const motus_status status = system_switches(s, err);
    if (status != MOTUS_OK) return status;
    held *h = s->switches;
    r->unswitched = !s->switches_refused && !(h && held_count(h));
    if (!h) return MOTUS_OK;
    const size_t touches = held_touches(h);
    const problem *p = held_problem(h);
    const size_t count = held_count(h), numbers = 7 * count + 6 * locate_numbers(p, count) + 2 * (p->nx + 2 * p->nv) +
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
    l->resolves = held_resolves(h);
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

void locate_statistics(const motus_run *r, motus_run_statistics *out)
{
    const locate *l = r->locate;
    out->switches = l ? l->located : r->unswitched ? 0 : -1;
    if (system_located(r->system)) out->switches = run_events_turns(r);
    out->jump = !l || isnan(l->jump) ? -1 : l->jump > 0 ? (int64_t)ceil(l->jump) : 0;
    out->jump_power = l ? l->jump : NAN;
    out->jump_time = l ? l->jump_time : NAN;
    out->jump_rounding = l ? l->rounding : 0;
}

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
        status = locate_observe(r, at, err);
        if (status != MOTUS_OK) break;
        const problem *own = &r->system->problem;
        if (pass == 0 && own->accel(own->ctx, at->t, at->x, at->v, at->a))
            return fail(err, MOTUS_CALLBACK, "the acceleration cannot be evaluated at t = %s",
                        run_time_text(r, at->t, t));
        const double way = r->timing.h * 0x1p-20;
        locate_follow(&l->problem, at, way, x, v);
        held_arguments(l->held, at->t, at->x, at->v, u);
        held_arguments(l->held, at->t + way, x, v, later);
        for (size_t k = 0; k < l->count; k++)
            l->side[k] = switches_side(held_operation(l->held, k), u[k], later[k] - u[k]);
    }
    return status;
}

bool locate_bind(motus_run *r) { return held_bind(r->locate->held, r->locate->side, false); }

int64_t locate_steps(const motus_run *r) { return r->locate->steps; }

/* Lets the stepper go on from `at`, which is `steps` steps after the start of the leg. */
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
    motus_status status = l->known ? MOTUS_OK : locate_observe(r, &l->from, err);
    if (status != MOTUS_OK) return status;
    status = stepper_advance(r->stepper, limit, why, err);
    if (status == MOTUS_MEMORY) return status;
    if (status == MOTUS_OK) status = locate_observe(r, &l->to, err);
    double part = 1;
    const bool tried =
        status != MOTUS_OK || l->resolves || locate_least_gap(l, &l->to, NULL) < 0 || !locate_sure(l, &l->from, &l->to);
    locate_copy(&l->start, &l->from, &l->problem, l->count);
    memcpy(l->start_side, l->side, l->count * sizeof *l->side);
    if (!tried && (status = locate_touch(r, l->to.t - l->from.t, &part, err)) != MOTUS_OK) return status;
    if (!tried && part == 1) {
        locate_swap(&l->from, &l->to);
        l->known = true;
        for (size_t k = 0; k < l->count; k++) l->slack[k] = 0;
        if (l->away && (status = resume(r, &l->from, steps + 1, err)) == MOTUS_OK)
            status = stepper_advance(r->stepper, (stepper_limit){0, r->timing.until}, why, err);
        return status;
    }
    status = locate_pieces(r, end, err);
    l->known = false;
    if (status == MOTUS_OK) status = resume(r, &l->from, steps + 1, err);
    if (status == MOTUS_OK) return stepper_advance(r->stepper, (stepper_limit){0, r->timing.until}, why, err);
    memcpy(l->side, l->start_side, l->count * sizeof *l->side);
    if (held_bind(l->held, l->side, false)) resume(r, &l->start, steps, NULL);
    return status;
}
