/* See held.h. */
#include "machine/held.h"

#include "lang/read/read.h"
#include "lang/tape/tape.h"
#include "machine/rounding.h"

#include <float.h>
#include <math.h>
#include <string.h>

struct held {
    const model *model;
    struct model view; /* the model with the equations of held switches, and with numbers of its own */
    interpreter *interpreter;
    problem problem;
    switches switches;
    tape *argument, *held, *rate, *touch, *touch_rate; /* NULL: there are none */
    resolution *resolution;                            /* NULL: nothing to resolve */
    resolution *reach, *reach_rate; /* of the arguments as they are on the sides, and of their rates */
    tape *rounding, *force_rounding;
    double *sides; /* the bound sides: the last numbers of view.pool */
    bool bound;
};

static bool make_view(held *h, model *m)
{
    model *view = &h->view;
    const switches *s = &h->switches;
    *view = *m;
    view->accel = s->accel;
    view->boundary = s->boundary;
    view->exact_count = 0;
    analysis_traits(view);
    view->traits.velocity = m->traits.velocity; /* methods are admitted for the model itself */
    view->traits.time = m->traits.time;
    view->traits.quadrature = m->traits.quadrature;
    view->traits.has_exact = false;
    view->pool_count = s->slot + s->count;
    view->pool = arena_room(m->arena, view->pool_count * sizeof *view->pool);
    view->x0 = arena_room(m->arena, (m->nx + 1) * sizeof *view->x0);
    view->v0 = arena_room(m->arena, (m->nv + 1) * sizeof *view->v0);
    if (!view->pool || !view->x0 || !view->v0) return false;
    memset(view->x0, 0, (m->nx + 1) * sizeof *view->x0);
    memset(view->v0, 0, (m->nv + 1) * sizeof *view->v0);
    memcpy(view->pool, m->pool, s->slot * sizeof *view->pool);
    h->sides = view->pool + s->slot;
    for (size_t k = 0; k < s->count; k++) h->sides[k] = 1;
    return true;
}

/* Makes the tapes that tell how near a switch is, and how well its time is known. */
static bool make_reach(held *h, model *m)
{
    const switches *s = &h->switches;
    return (h->rounding = rounding_tape(m, s->held, s->kinds)) &&
           resolution_create_values(m, s->held, s->kinds, &h->reach) &&
           resolution_create_values(m, s->rate, s->kinds, &h->reach_rate);
}

motus_status held_create(model *m, held **out, const char **refused, motus_error *err)
{
    *out = NULL;
    *refused = NULL;
    held *h = arena_take(m->arena, sizeof *h);
    if (!h || !switches_find(m, false, &h->switches))
        return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    const switches *s = &h->switches;
    *refused = s->refused;
    if (s->refused) return MOTUS_OK;
    const size_t boundaries = m->boundary_count, accels = boundaries + m->accel_count, all = accels + s->kinds;
    output *reads = arena_room(m->arena, (all + 1) * sizeof *reads); /* what decides the motion */
    if (!reads) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    if (boundaries) memcpy(reads, s->boundary, boundaries * sizeof *reads);
    if (accels > boundaries) memcpy(reads + boundaries, s->accel, m->accel_count * sizeof *reads);
    if (s->kinds) memcpy(reads + accels, s->held, s->kinds * sizeof *reads);
    if (!resolution_create(m, reads, all, s->count > 0, &h->resolution))
        return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    if (s->count == 0 && s->touches == 0 && !h->resolution) return MOTUS_OK;
    h->model = m;
    if (!make_view(h, m)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    motus_status status = interpreter_create(&h->view, &h->interpreter, &h->problem, err);
    if (status != MOTUS_OK) return status;
    const struct {
        tape **made;
        const output *of;
        size_t count;
    } tapes[] = {{&h->argument, s->argument, s->kinds},
                 {&h->held, s->held, s->kinds},
                 {&h->rate, s->rate, s->kinds},
                 {&h->touch, s->touch, s->touch_kinds},
                 {&h->touch_rate, s->touch_rate, s->touch_kinds}};
    for (size_t k = 0; k < sizeof tapes / sizeof *tapes; k++) {
        if (tapes[k].count == 0) continue;
        *tapes[k].made = tape_of(m->arena, m->graph, tapes[k].of, tapes[k].count);
        if (!*tapes[k].made) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    }
    if ((s->kinds && !make_reach(h, m)) || !(h->force_rounding = rounding_tape(m, s->accel, m->accel_count)))
        return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    *out = h;
    return MOTUS_OK;
}

const problem *held_problem(const held *h) { return &h->problem; }
size_t held_count(const held *h) { return h->switches.count; }
size_t held_touches(const held *h) { return h->switches.touches; }
operation held_operation(const held *h, size_t k) { return (operation)h->switches.op[k]; }

void held_surface(const held *h, size_t k, char *out, size_t size)
{
    switches_surface(h->model, h->switches.original[switches_kind(&h->switches, k)], out, size);
}

bool held_bind(held *h, const double *sides, bool fresh)
{
    const size_t bytes = h->switches.count * sizeof *sides;
    if (h->bound && !fresh && memcmp(h->sides, sides, bytes) == 0) return true;
    memcpy(h->sides, sides, bytes);
    if (fresh || !h->bound) memcpy(h->view.pool, h->model->pool, h->switches.slot * sizeof *sides);
    const binding b = {h->view.arrays, h->view.ints, h->view.pool};
    tape *const tapes[] = {h->argument, h->held, h->rate, h->touch, h->touch_rate, h->rounding, h->force_rounding};
    h->bound = interpreter_rebind(h->interpreter);
    for (size_t k = 0; k < sizeof tapes / sizeof *tapes; k++)
        if (tapes[k]) h->bound = h->bound && tape_bind(tapes[k], &b);
    return h->bound;
}

/* Runs a tape. NaN stays in cells outside its loops. */
static void run(const held *h, tape *t, size_t count, double time, double *x, double *v, double *a, double *out)
{
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a, [SPACE_OUT] = out};
    for (size_t k = 0; k < count; k++) out[k] = NAN;
    if (h->problem.refresh) h->problem.refresh(h->problem.ctx, time, x, v);
    if (t) tape_run(t, time, base);
}

void held_arguments(held *h, double t, double *x, double *v, double *out)
{
    run(h, h->argument, h->switches.count, t, x, v, NULL, out);
}

void held_values(held *h, double t, double *x, double *v, double *out)
{
    run(h, h->held, h->switches.count, t, x, v, NULL, out);
}

void held_rates(held *h, double t, double *x, double *v, double *a, double *out)
{
    run(h, h->rate, h->switches.count, t, x, v, a, out);
}

void held_touch(held *h, double t, double *x, double *v, double *out)
{
    run(h, h->touch, h->switches.touches, t, x, v, NULL, out);
}

void held_touch_rates(held *h, double t, double *x, double *v, double *a, double *out)
{
    run(h, h->touch_rate, h->switches.touches, t, x, v, a, out);
}

bool held_resolves(const held *h) { return h->resolution != NULL; }

bool held_fits(held *h, interval t, interval *x, interval *v)
{
    return !h->resolution || resolution_fits(h->resolution, t, x, v, h->view.pool);
}

void held_reach(held *h, interval t, interval *x, interval *v, interval *a, interval *argument, interval *rate)
{
    const interval none = {NAN, NAN};
    for (size_t k = 0; k < h->switches.count; k++) argument[k] = rate[k] = none;
    resolution_values(h->reach, t, x, v, NULL, h->view.pool, argument);
    resolution_values(h->reach_rate, t, x, v, a, h->view.pool, rate);
}

void held_rounding(held *h, double t, double *x, double *v, double *out)
{
    run(h, h->rounding, h->switches.count, t, x, v, NULL, out);
    for (size_t k = 0; k < h->switches.count; k++) out[k] *= 0x1p-53;
}

double held_force_rounding(held *h, double t, double *x, double *v, double *room)
{
    const size_t n = h->problem.nv;
    double most = 0, *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = room};
    for (size_t k = 0; k < n; k++) room[k] = 0;
    if (h->problem.refresh) h->problem.refresh(h->problem.ctx, t, x, v);
    tape_run(h->force_rounding, t, base);
    for (size_t k = 0; k < n; k++)
        if (room[k] <= DBL_MAX) most = fmax(most, room[k]);
    return 0x1p-54 * most;
}
