/* See sides.h. */
#include "machine/sides_parts.h"

#include "base/decimal.h"
#include "machine/least.h"
#include "machine/rounding.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Goes over the functions after those of the text: n counts them, k is the switch of each. */
#define EACH_SHOWN(s, n, k) for (size_t n = 0, k; n < (s)->shown_count && (k = (s)->shown[n], true); n++)

/* ---- functions ---- */

/* Tells whether switch k stands at 0 beside a switch that is held, with which it leaves: its side is then a value of
 * the sign within (-1, 1) other than 0. */
static bool is_pinned(const sides *s, const double *side, size_t k)
{
    return sides_op_of(s, k) == OP_SIGN && fabs(side[k]) > 0 && fabs(side[k]) < 1;
}

/* Tells whether any switch is held; the tapes of holding values are run only then. */
static bool any_held(const sides *s, const double *side)
{
    bool any = false;
    for (size_t k = 0; s->hold && k < s->switches->count && !any; k++) any = sides_is_held(s, side, k);
    return any;
}

/* Evaluates the function of a held switch. It is positive while the value that holds the switch is within (-1, 1) and
 * drives the argument back to 0 from both sides, and falls to 0 where one of these ends. */
static double grip_of(const sides *s, const double *side, size_t k)
{
    const double back = side[k] == SWITCHES_HELD ? -1 : 1;
    return back * s->r[k] * (1 - s->p[k]) * (1 + s->p[k]);
}

static double grip_rate_of(const sides *s, const double *side, size_t k)
{
    const double back = side[k] == SWITCHES_HELD ? -1 : 1;
    return back * (s->dr[k] * (1 - s->p[k]) * (1 + s->p[k]) - 2 * s->r[k] * s->p[k] * s->dp[k]);
}

/* Bounds the rounding of grip_of, in units of 2^-53; dp and dr hold bounds in place of rates. */
static double grip_rounding_of(const sides *s, size_t k)
{
    const double p = fabs(s->p[k]);
    return (s->dr[k] + fabs(s->r[k])) * fabs((1 - p) * (1 + p)) + fabs(s->r[k]) * 2 * p * (s->dp[k] + 1);
}

static motus_status undefined(void *ctx, size_t f, double last, double t, const double *x, const double *v,
                              motus_error *err)
{
    const sides *s = ctx;
    const bool own = f < s->own.functions && s->own.undefined;
    return own ? s->own.undefined(s->own.ctx, f, last, t, x, v, err) : MOTUS_OK;
}

static int values(void *ctx, double t, double *x, double *v, double *out)
{
    const sides *s = ctx;
    const double *side = x + s->switches->slot;
    const int status = s->own.functions ? s->own.values(s->own.ctx, t, x, v, out) : 0;
    if (status) return status;
    out += s->own.functions;
    if (!s->shown_count) return 0;
    sides_evaluate(s, s->argument, t, x, v, NULL, s->u);
    const bool held = any_held(s, side);
    if (held) sides_measure_hold(s, t, x, v);
    EACH_SHOWN(s, n, k)
    {
        const parts p = sides_parts_of(s, k);
        const bool slides = p.count && !sides_silent(s, k) && !sides_is_held(s, side, k);
        const double least = slides ? sides_short_of(s, &p, t, x, v) : 0;
        if (slides && held) sides_measure_hold(s, t, x, v);
        out[n] = sides_silent(s, k)                  ? 1
                 : p.count                           ? sides_direction_of(s, &p, side, s->u, least)
                 : held && sides_is_held(s, side, k) ? grip_of(s, side, k)
                 : is_pinned(s, side, k)             ? 1
                                                     : switches_distance(sides_op_of(s, k), side[k], s->u[k]);
    }
    return 0;
}

/* Evaluates the arguments to u and, by the tape `of`, their rates or rounding to `out`. If a switch is held: the values
 * that hold switches to p, by `of_hold` their rates or rounding to dp; the grips to r, by `of_grip` theirs to dr. True:
 * a switch is held. */
static bool measure(const sides *s, tape *of, tape *of_hold, tape *of_grip, double t, double *x, double *v, double *a,
                    double *out)
{
    sides_evaluate(s, s->argument, t, x, v, NULL, s->u);
    sides_evaluate(s, of, t, x, v, a, out);
    const bool held = any_held(s, x + s->switches->slot);
    if (!held) return false;
    sides_evaluate(s, s->hold, t, x, v, NULL, s->p), sides_evaluate(s, of_hold, t, x, v, a, s->dp);
    sides_evaluate(s, s->grip, t, x, v, NULL, s->r), sides_evaluate(s, of_grip, t, x, v, a, s->dr);
    return true;
}

static int rates(void *ctx, double t, double *x, double *v, double *a, double *out)
{
    const sides *s = ctx;
    const double *side = x + s->switches->slot;
    const int status = s->own.functions ? s->own.rates(s->own.ctx, t, x, v, a, out) : 0;
    if (status) return status;
    out += s->own.functions;
    if (!s->shown_count) return 0;
    const bool held = measure(s, s->rate, s->hold_rate, s->grip_rate, t, x, v, a, s->du);
    EACH_SHOWN(s, n, k)
    {
        const parts p = sides_parts_of(s, k);
        out[n] = sides_silent(s, k)                  ? 0
                 : p.count                           ? sides_direction_rate_of(s, &p, side, s->du)
                 : held && sides_is_held(s, side, k) ? grip_rate_of(s, side, k)
                 : is_pinned(s, side, k)             ? 0
                                         : s->du[k] * switches_distance_slope(sides_op_of(s, k), side[k], s->u[k]);
    }
    return 0;
}

static void rounding(void *ctx, double t, double *x, double *v, double *out)
{
    const sides *s = ctx;
    const double *side = x + s->switches->slot;
    if (s->own.functions) s->own.rounding(s->own.ctx, t, x, v, out);
    out += s->own.functions;
    if (!s->shown_count) return;
    const bool held = measure(s, s->rounding, s->hold_rounding, s->grip_rounding, t, x, v, NULL, s->du);
    EACH_SHOWN(s, n, k)
    {
        const parts p = sides_parts_of(s, k);
        out[n] = 0x1p-53 * (sides_silent(s, k)                  ? 0
                            : p.count                           ? sides_direction_rounding_of(s, &p, side, s->du)
                            : held && sides_is_held(s, side, k) ? grip_rounding_of(s, k)
                            : is_pinned(s, side, k)
                                ? 0
                                : s->du[k] * fabs(switches_distance_slope(sides_op_of(s, k), side[k], s->u[k])));
    }
}

/* Tells whether the function of switch k has no lower bound: its argument may stay at 0, or the switch is held or is a
 * direction. */
static bool unknown(const sides *s, const double *side, size_t k)
{
    return switches_directs(sides_op_of(s, k)) || sides_is_held(s, side, k) ||
           switches_distance_slope(sides_op_of(s, k), side[k], 0) == 0;
}

static void least_of(const sides *s, bool rates, double *x, double *v, double *dx, double *dv, double *out)
{
    const double *side = x + s->switches->slot;
    if (s->own.functions) (rates ? s->own.least_rates : s->own.least)(s->own.ctx, x, v, dx, dv, out);
    out += s->own.functions;
    if (!s->shown_count) return;
    double *const least = s->later;
    for (size_t k = 0; k < s->switches->count; k++) least[k] = INFINITY; /* cells outside the ranges */
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_DX] = dx, [SPACE_DV] = dv, [SPACE_OUT] = least};
    tape_run(rates ? s->least_rates : s->least, NAN, base);
    EACH_SHOWN(s, n, k)
    {
        out[n] = least[k];
        if (sides_silent(s, k) || is_pinned(s, side, k))
            out[n] = rates ? 0 : 1;
        else if (unknown(s, side, k))
            out[n] = -1;
    }
}

static void least(void *ctx, double *x, double *v, double *dx, double *dv, double *out)
{
    least_of(ctx, false, x, v, dx, dv, out);
}

static void least_rates(void *ctx, double *x, double *v, double *dx, double *dv, double *out)
{
    least_of(ctx, true, x, v, dx, dv, out);
}

static bool may_be_narrow(void *ctx, size_t f)
{
    const sides *s = ctx;
    return f < s->own.functions && (!s->own.may_be_narrow || s->own.may_be_narrow(s->own.ctx, f));
}

static bool apart(void *ctx, size_t f, bool rate, const double t[2], const double *x, const double *v, const double *dx,
                  const double *dv, const double *most)
{
    const sides *s = ctx;
    return f < s->own.functions && s->own.apart && s->own.apart(s->own.ctx, f, rate, t, x, v, dx, dv, most);
}

/* Writes the arguments of the text's own functions; the switches after them need none. */
static void arguments_at(void *ctx, double t, double *x, double *v, double *out)
{
    const sides *s = ctx;
    const size_t own = s->own.functions, all = s->supplied.functions;
    s->own.arguments_at(s->own.ctx, t, x, v, out);
    for (size_t k = s->own.arguments; k-- > 1;) memmove(out + k * all, out + k * own, own * sizeof *out);
}

static bool regular(void *ctx, size_t f, const double *low, const double *high)
{
    const sides *s = ctx;
    return f < s->own.functions && s->own.regular(s->own.ctx, f, low, high);
}

static int act(void *ctx, size_t rule, size_t instance, double t, double *x, double *v, bool *in_v, size_t *which)
{
    const sides *s = ctx;
    return s->own.act(s->own.ctx, rule, instance, t, x, v, in_v, which);
}

/* ---- sides ---- */

static void name(void *ctx, size_t number, size_t instance, char *out, size_t size)
{
    const sides *s = ctx;
    if (number < s->own.count)
        s->own.name(s->own.ctx, number, instance, out, size);
    else
        sides_print(s, s->switches->first[s->kind_of[number - s->own.count]] + instance, out, size);
}

/* ---- all switches ---- */

/* Puts the true positions of values in tables beside the arguments. A side that may be any tells only of the points
 * around it. */
static void find_rows(const sides *s, double t, double *x, double *v, double *argument)
{
    if (!s->position) return;
    sides_evaluate(s, s->position, t, x, v, NULL, s->later);
    for (size_t k = 0; k < s->switches->count; k++)
        if (sides_op_of(s, k) == OP_FIND) argument[k] = s->later[k];
}

/* Sets the side of switch k by its argument u, whose rounding is at most `bound`. */
static motus_status place(sides *s, size_t k, double u, double bound, double way, double t, double *x, double *v,
                          motus_error *err)
{
    const operation op = sides_op_of(s, k);
    const double whole = switches_counts(op) ? round(u) : 0;
    if (isnan(u) || sides_silent(s, k)) return MOTUS_OK; /* a cell without a switch; another one places it */
    if (switches_directs(op)) return sides_choose_direction(s, k, false, way, t, &t, x, v, err);
    if (is_pinned(s, x + s->switches->slot, k) && fabs(u) <= bound) return MOTUS_OK; /* it leaves with another */
    if (isfinite(bound) ? fabs(u - whole) > bound : u != whole) { /* where its slope is infinite no bound is known */
        sides_put(s, x + s->switches->slot, k, switches_side(op, u, 0));
        return MOTUS_OK;
    }
    return switches_counts(op) ? sides_choose_count(s, k, false, whole, way, t, x, v, err)
                               : sides_choose(s, k, false, way, t, x, v, err);
}

/* Lets switches go that, after another switch has turned, the force no longer holds. */
static motus_status check_held(sides *s, double way, double t, double *x, double *v, motus_error *err)
{
    const double *side = x + s->switches->slot;
    motus_status status = MOTUS_OK;
    for (size_t k = 0; k < s->switches->count && status == MOTUS_OK; k++) {
        if (!s->hold || !sides_is_held(s, side, k) || sides_silent(s, k)) continue;
        if (switches_directs(sides_op_of(s, k))) {
            const parts p = sides_parts_of(s, k);
            sides_evaluate(s, s->hold, t, x, v, NULL, s->p);
            if (sides_along(&p, s->p, s->p) > 1 + 0x1p-40) status = sides_leave(s, &p, way, t, x, v, err);
            continue;
        }
        sides_evaluate(s, s->hold, t, x, v, NULL, s->p), sides_evaluate(s, s->hold_rounding, t, x, v, NULL, s->dp);
        sides_evaluate(s, s->grip, t, x, v, NULL, s->r), sides_evaluate(s, s->grip_rounding, t, x, v, NULL, s->dr);
        if (grip_of(s, side, k) < -0x1p-52 * grip_rounding_of(s, k))
            status = sides_choose(s, k, false, way, t, x, v, err);
    }
    return status;
}

/* Turns a switch, and then those whose arguments jump with it, as in mod(floor(t), 2). */
static motus_status turn(void *ctx, size_t number, size_t instance, double way, double until, double *at, double *x,
                         double *v, motus_error *err)
{
    sides *s = ctx;
    const size_t count = s->switches->count,
                 switched = s->switches->first[s->kind_of[number - s->own.count]] + instance;
    const double *side = x + s->switches->slot;
    s->way = way;
    sides_evaluate(s, s->argument, *at, x, v, NULL, s->kept);
    motus_status status = switches_directs(sides_op_of(s, switched))
                              ? sides_choose_direction(s, switched, true, way, until, at, x, v, err)
                              : sides_change(s, switched, way, *at, x, v, err);
    const double t = *at;
    for (size_t pass = 0; pass < NESTED && status == MOTUS_OK; pass++) {
        bool jumped = false;
        sides_evaluate(s, s->argument, t, x, v, NULL, s->now);
        sides_evaluate(s, s->rounding, t, x, v, NULL, s->bound);
        memcpy(s->found, s->now, count * sizeof *s->now);
        find_rows(s, t, x, v, s->found);
        for (size_t k = 0; k < count && status == MOTUS_OK; k++) {
            const double bound = 0x1p-53 * s->bound[k];
            if (sides_is_held(s, side, k) || is_pinned(s, side, k) || switches_directs(sides_op_of(s, k)) ||
                sides_is_timed(s, k))
                continue; /* its argument has been moved to 0 */
            if (!(fabs(s->now[k] - s->kept[k]) > bound + fabs(s->kept[k]) * 0x1p-40)) continue;
            jumped = true;
            status = place(s, k, s->found[k], bound, way, t, x, v, err);
        }
        if (!jumped) break;
        memcpy(s->kept, s->now, count * sizeof *s->now);
    }
    return status != MOTUS_OK ? status : check_held(s, way, t, x, v, err);
}

/* Holds the marked switches that can be held, with those beside them. *held: these are all marked switches. */
static motus_status stand_together(sides *s, const bool *of, double way, double t, double *x, double *v, bool *held,
                                   motus_error *err)
{
    const size_t count = s->switches->count;
    double *side = x + s->switches->slot;
    motus_status status = MOTUS_OK;
    memset(s->covered, 0, count * sizeof *s->covered);
    *held = true;
    for (size_t k = 0; k < count && status == MOTUS_OK && *held; k++) {
        size_t beside = 0;
        if (!of[k] || !s->hold || s->switches->slides[switches_kind(s->switches, k)] != SLIDES_HELD) continue;
        status = sides_find_beside(s, k, of, way, t, x, v, &beside, err);
        if (status != MOTUS_OK || !beside) continue;
        for (size_t n = 0; n < count && status == MOTUS_OK; n++)
            if (s->beside[n]) s->covered[n] = true, status = sides_move_to_zero(s, k, n, t, x, v, err);
        s->covered[k] = true;
        if (status == MOTUS_OK) status = sides_move_to_zero(s, k, k, t, x, v, err);
        if (status == MOTUS_OK) status = sides_stand_at_corner(s, k, 0, way, t, x, v, held, err);
        *held = *held && sides_is_held(s, side, k);
    }
    for (size_t k = 0; k < count; k++) *held = *held && (!of[k] || s->covered[k]);
    return status;
}

static motus_status gather(void *ctx, const size_t *functions, size_t number, double way, double t, double *x,
                           double *v, motus_error *err)
{
    sides *s = ctx;
    const size_t count = s->switches->count;
    char at[DECIMAL_MAX], text[3 * 100];
    size_t used = 0;
    bool held;
    memset(s->of, 0, count * sizeof *s->of);
    text[0] = 0;
    if (number == 1 && switches_directs(sides_op_of(s, s->shown[functions[0] - s->own.functions]))) {
        const parts p = sides_parts_of(s, s->shown[functions[0] - s->own.functions]);
        s->way = way;
        return sides_stand(s, &p, way, t, x, v, err);
    }
    for (size_t k = 0; k < number; k++) {
        const size_t f = s->shown[functions[k] - s->own.functions];
        char one[80];
        s->of[f] = true;
        sides_print(s, f, one, sizeof one);
        if (k < 3) used += (size_t)snprintf(text + used, sizeof text - used, k ? " and %s" : "%s", one);
    }
    const motus_status status = stand_together(s, s->of, way, t, x, v, &held, err);
    if (status != MOTUS_OK || held) return status;
    fail(err, MOTUS_EVENTS, "the switches %s accumulate at t = %s: they follow one another ever faster, without end",
         text, decimal(t, at));
    hint(err, "end the run before, or let the force hold the motion there");
    if (err) err->time = t;
    return MOTUS_EVENTS;
}

/* Sets the sides at a state that did not come by motion, in several passes: sides decide the acceleration, which
 * decides where an argument that is 0 moves, and switches may stand within one another. Switches that still change in
 * the last passes, as at rest at 0 under -2 sign(x) - sign(x'), are held together. */
static motus_status settle(void *ctx, double way, double t, double *x, double *v, motus_error *err)
{
    sides *s = ctx;
    const size_t count = s->switches->count;
    double *side = x + s->switches->slot;
    motus_status status = MOTUS_OK;
    bool settled = false, jumps;
    s->way = way;
    sides_pass_times(s, way, t, x, &jumps);
    memset(s->of, 0, count * sizeof *s->of);
    for (int pass = 0; pass < NESTED && status == MOTUS_OK && !settled; pass++) {
        memcpy(s->kept, side, count * sizeof *side);
        for (size_t k = 0; k < count && status == MOTUS_OK; k++) {
            if (sides_is_timed(s, k)) continue;
            sides_evaluate(s, s->argument, t, x, v, NULL, s->now);
            sides_evaluate(s, s->rounding, t, x, v, NULL, s->bound);
            find_rows(s, t, x, v, s->now);
            status = place(s, k, s->now[k], 0x1p-53 * s->bound[k], way, t, x, v, err);
        }
        settled = pass > 0 && memcmp(s->kept, side, count * sizeof *side) == 0;
        for (size_t k = 0; k < count; k++)
            s->of[k] |= pass >= NESTED - 6 && s->kept[k] != side[k] && !sides_follows(s, k);
    }
    return status != MOTUS_OK || settled ? status : stand_together(s, s->of, way, t, x, v, &settled, err);
}

static motus_status pass(void *ctx, double way, double t, double *x, double *v, int64_t *passed, motus_error *err)
{
    bool jumps;
    *passed = sides_pass_times(ctx, way, t, x, &jumps);
    return jumps && ((const sides *)ctx)->shown_count ? settle(ctx, way, t, x, v, err) : MOTUS_OK;
}

/* ---- making ---- */

/* Bounds the distance of an integer part p from leaving its side, (u - p) (p + 1 - u), by bounds of both factors. */
static node least_count(model *m, node u, node side)
{
    graph *g = m->graph;
    const node radius = least_radius(m, u), none = graph_const(g, 0), one = graph_const(g, 1);
    const node above = graph_op(g, OP_SUB, u, side, 0), below = graph_op(g, OP_SUB, one, above, 0);
    return graph_op(g, OP_MUL, graph_op(g, OP_MAX, graph_op(g, OP_SUB, above, radius, 0), none, 0),
                    graph_op(g, OP_MAX, graph_op(g, OP_SUB, below, radius, 0), none, 0), 0);
}

static bool make_least(sides *s, model *m)
{
    const switches *w = m->located;
    output *nearest = arena_room(m->arena, 2 * w->kinds * sizeof *nearest), *slowest = nearest + w->kinds;
    if (!nearest) return false;
    for (size_t k = 0; k < w->kinds; k++) {
        const bool counts = switches_counts(sides_op_of(s, w->first[k]));
        nearest[k] = w->held[k], slowest[k] = w->rate[k];
        nearest[k].value = counts ? least_count(m, w->held[k].value, w->side[k]) : least_size(m, w->held[k].value);
        slowest[k].value = counts ? graph_const(m->graph, -1) : least_rate(m, w->held[k].value, w->rate[k].value);
    }
    s->least = tape_of(m->arena, m->graph, nearest, w->kinds);
    s->least_rates = tape_of(m->arena, m->graph, slowest, w->kinds);
    return s->least && s->least_rates;
}

static bool make(sides *s, model *m)
{
    const switches *w = m->located;
    const size_t nx = s->problem->nx, nv = s->problem->nv, own = s->own.count;
    double *room = arena_room(m->arena, (13 * w->count + nx + 4 * nv + 1) * sizeof *room);
    s->rule = arena_room(m->arena, (own + w->kinds) * sizeof *s->rule);
    s->beside = arena_room(m->arena, w->count + 1);
    s->of = arena_room(m->arena, 2 * (w->count + 1) * sizeof *s->of);
    if (!room || !s->rule || !s->beside || !s->of) return false;
    s->covered = s->of + w->count;
    s->shown = arena_room(m->arena, (w->count + w->kinds + 1) * sizeof *s->shown);
    if (!s->shown || !sides_find_timed(s, m)) return false;
    s->kind_of = s->shown + w->count;
    s->u = room, s->du = s->u + w->count, s->later = s->du + w->count;
    s->before = s->later + w->count, s->now = s->before + w->count, s->bound = s->now + w->count;
    s->found = s->bound + w->count;
    s->p = s->found + w->count, s->dp = s->p + w->count;
    s->r = s->dp + w->count, s->dr = s->r + w->count, s->kept = s->dr + w->count;
    s->a = s->kept + w->count, s->b = s->a + nv, s->v = s->b + nv, s->push = s->v + nv;
    s->x = s->push + nv, s->was = s->x + nx;
    s->way = 1;
    for (size_t k = 0; k < w->kinds; k++) {
        if (sides_is_timed(s, w->first[k])) continue;
        s->kind_of[s->shown_kinds] = k;
        s->rule[own + s->shown_kinds++] = (rule){.name = "a switch",
                                                 .kind = RULE_ROOT,
                                                 .direction = -1,
                                                 .first = s->own.functions + s->shown_count,
                                                 .leaves = 1,
                                                 .instances = switches_cells(w, k),
                                                 .assigns = true,
                                                 .internal = true};
        for (size_t i = 0; i < switches_cells(w, k); i++) s->shown[s->shown_count++] = w->first[k] + i;
    }
    s->supplied = s->own;
    s->supplied.ctx = s;
    s->supplied.rule = s->rule;
    s->supplied.count = own + s->shown_kinds;
    s->supplied.functions = s->own.functions + s->shown_count;
    if (s->timed_count) s->supplied.next = sides_next_time, s->supplied.pass = pass;
    s->supplied.values = values;
    s->supplied.rates = rates;
    s->supplied.rates_without_a = false;
    s->supplied.rounding = rounding;
    s->supplied.undefined = undefined;
    s->supplied.least = least;
    s->supplied.least_rates = least_rates;
    s->supplied.alone = NULL;
    s->supplied.apart = apart;
    s->supplied.may_be_narrow = may_be_narrow;
    s->supplied.arguments_at = arguments_at;
    s->supplied.regular = regular;
    s->supplied.act = act;
    s->supplied.name = name;
    s->supplied.turn = turn;
    s->supplied.settle = settle;
    s->supplied.gather = gather;
    s->argument = tape_of(m->arena, m->graph, w->held, w->kinds);
    s->rate = tape_of(m->arena, m->graph, w->rate, w->kinds);
    bool finds = false;
    for (size_t k = 0; k < w->kinds; k++) finds |= sides_op_of(s, w->first[k]) == OP_FIND;
    if (finds) {
        s->position = tape_of(m->arena, m->graph, w->argument, w->kinds);
        s->rate_rounding = rounding_tape(m, w->rate, w->kinds);
        if (!s->position || !s->rate_rounding) return false;
    }
    s->rounding = rounding_tape(m, w->held, w->kinds);
    s->force_rounding = rounding_tape(m, w->accel, m->accel_count);
    if (w->hold_kinds) {
        s->hold = tape_of(m->arena, m->graph, w->hold, w->hold_kinds);
        s->hold_rate = tape_of(m->arena, m->graph, w->hold_rate, w->hold_kinds);
        s->hold_rounding = rounding_tape(m, w->hold, w->hold_kinds);
        s->grip = tape_of(m->arena, m->graph, w->grip, w->hold_kinds);
        s->grip_rate = tape_of(m->arena, m->graph, w->grip_rate, w->hold_kinds);
        s->grip_rounding = rounding_tape(m, w->grip, w->hold_kinds);
        if (!s->hold || !s->hold_rate || !s->hold_rounding || !s->grip || !s->grip_rate || !s->grip_rounding)
            return false;
    }
    return s->argument && s->rate && s->rounding && s->force_rounding && make_least(s, m) && sides_rebind(s);
}

motus_status sides_create(model *m, const rules *own, const problem *p, sides **out, motus_error *err)
{
    *out = NULL;
    sides *s = arena_take(m->arena, sizeof *s);
    if (s) {
        *s = (sides){.model = m, .switches = m->located, .problem = p};
        if (own) s->own = *own;
    }
    if (!s || !make(s, m)) return fail(err, MOTUS_MEMORY, "no memory for the switches of the model");
    *out = s;
    return MOTUS_OK;
}

bool sides_rub(sides *s, double t, const double *x, const double *v)
{
    const problem *p = s->problem;
    bool rubs = false;
    if (!s->grip) return false;
    memcpy(s->x, x, p->nx * sizeof *x);
    memcpy(s->v, v, p->nv * sizeof *v);
    sides_evaluate(s, s->grip, t, s->x, s->v, NULL, s->r);
    for (size_t k = 0; k < s->switches->count && !rubs; k++) {
        const parts of = sides_parts_of(s, k);
        rubs = of.count && !sides_silent(s, k);
        for (int i = 0; i < of.count; i++) rubs &= s->r[of.of[i]] < 0;
    }
    return rubs;
}

const rules *sides_rules(const sides *s) { return &s->supplied; }

bool sides_rebind(sides *s)
{
    const binding b = {s->model->arrays, s->model->ints, s->model->pool};
    tape *const tapes[] = {s->argument,    s->position,  s->from,           s->rates,
                           s->rate,        s->rounding,  s->force_rounding, s->least,
                           s->least_rates, s->hold,      s->hold_rate,      s->hold_rounding,
                           s->grip,        s->grip_rate, s->grip_rounding,  s->rate_rounding};
    for (size_t k = 0; k < sizeof tapes / sizeof *tapes; k++)
        if (tapes[k] && !tape_bind(tapes[k], &b)) return false;
    sides_bind_timed(s);
    /* the periods of clocks depend on parameters */
    if (s->own.count) memcpy(s->rule, s->own.rule, s->own.count * sizeof *s->rule);
    return true;
}
