/* See sides.h. */
#include "machine/sides.h"

#include "base/decimal.h"
#include "lang/model/switches.h"
#include "lang/tape/tape.h"
#include "machine/least.h"
#include "machine/rounding.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    NESTED = 16, /* switches within the arguments of others, at most, that change at once */
    AHEAD = 12   /* the order of the series that tell how an argument leaves 0 */
};

struct sides {
    const model *model;
    const switches *switches;
    const problem *problem;
    rules supplied, own;
    rule *rule;
    tape *argument, *rate, *rounding, *force_rounding, *least, *least_rates;
    tape *hold, *hold_rate, *hold_rounding; /* NULL: none can be held */
    tape *grip, *grip_rate, *grip_rounding; /* likewise */
    double *u, *du, *later;              /* of all switches: arguments, their rates, and the arguments a little later */
    double *kept, *before, *now, *bound; /* likewise, while sides are chosen; kept: by those who place all of them */
    double *p, *dp, *r, *dr; /* likewise: what holds them and how much that drives them, and the rates of both */
    double *a, *b, *x, *v;   /* room for two accelerations and a state */
    double *push;            /* and for what has moved velocities */
    double *xs, *vs;         /* the series of a motion; NULL: none was wanted */
    double *was;             /* of all switches: sides for a while */
    double way;              /* of the run: 1, or -1 backward */
    int8_t *beside;          /* likewise: the way in which a switch leaves 0 with another one, 0: it does not */
    bool *of, *covered;      /* likewise: switches that are to be held together, and those that are */
};

/* ---- functions ---- */

static operation op_of(const sides *s, size_t k) { return (operation)s->switches->op[k]; }

static void run(const sides *s, tape *t, double time, double *x, double *v, double *a, double *out)
{
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a, [SPACE_OUT] = out};
    for (size_t k = 0; k < s->switches->count; k++) out[k] = NAN; /* cells outside the ranges are written by none */
    tape_run(t, time, base);
}

static bool compares(operation op) { return op == OP_LT || op == OP_LE || op == OP_GT || op == OP_GE; }

/* The side of switch k where its argument is positive, way 1, or negative, way -1. */
static double side_of(const sides *s, size_t k, int way) { return switches_side(op_of(s, k), way, 0); }

/* Whether switch k is held; an integer part is 2 by itself. */
static bool is_held(const sides *s, const double *side, size_t k)
{
    return side[k] >= SWITCHES_HELD && !switches_counts(op_of(s, k));
}

/* Whether switch k stands at 0 beside one that is held, and the motion with both: its side then is a value of the sign
 * within (-1, 1), not 0, and it leaves with the other one. */
static bool is_pinned(const sides *s, const double *side, size_t k)
{
    return op_of(s, k) == OP_SIGN && fabs(side[k]) > 0 && fabs(side[k]) < 1;
}

/* The switch whose surface that of switch k is, and whether that is another one: then k changes its side with it, and
 * has no function of its own. */
static size_t first_of(const sides *s, size_t k)
{
    const switches *w = s->switches;
    if (!w->shared) return k;
    const size_t kind = switches_kind(w, k);
    return w->first[w->as[kind]] + (k - w->first[kind]);
}
static bool follows(const sides *s, size_t k) { return first_of(s, k) != k; }

/* The switches of a direction are those of its components, of which the first one has the function of all. */
typedef struct parts {
    size_t of[GRAPH_COMPONENTS];
    int count; /* 0: switch k is no direction */
} parts;

static parts parts_of(const sides *s, size_t k)
{
    const switches *w = s->switches;
    parts p = {.count = 0};
    if (!switches_directs(op_of(s, k))) return p;
    const size_t kind = switches_kind(w, k), cell = k - w->first[kind], first = w->leader[kind];
    for (; p.count < w->parts[kind]; p.count++) p.of[p.count] = w->first[first + (size_t)p.count] + cell;
    return p;
}

/* Whether it has no function of its own. */
static bool silent(const sides *s, size_t k)
{
    if (!switches_directs(op_of(s, k))) return follows(s, k);
    const size_t kind = switches_kind(s->switches, k);
    return s->switches->leader[kind] != kind;
}

/* Gives switch k, which follows none, a side; those that follow it have what belongs to that. */
static void put(const sides *s, double *side, size_t k, double value)
{
    const switches *w = s->switches;
    const size_t kind = switches_kind(w, k), cell = k - w->first[kind];
    side[k] = value;
    if (!w->shared) return;
    const bool held = is_held(s, side, k);
    const double way = compares(op_of(s, k)) ? (value == side_of(s, k, 1) ? 1 : -1) : value;
    for (size_t j = kind + 1; j < w->kinds; j++) {
        const size_t n = w->first[j] + cell;
        if (w->as[j] != kind) continue;
        const double own = w->turned[j] * way;
        side[n] = held ? value : op_of(s, n) == OP_SIGN ? own : switches_side(op_of(s, n), own, 0);
    }
}

/* Whether a switch that has the surface of k is a comparison, be it k itself. */
static bool chooses(const sides *s, size_t k)
{
    const switches *w = s->switches;
    const size_t kind = switches_kind(w, k);
    bool any = false;
    for (size_t j = kind; j < w->kinds; j++) any |= w->as[j] == kind && compares(op_of(s, w->first[j]));
    return any;
}

/* Whether any is; the tapes of what holds them are run only then. */
static bool any_held(const sides *s, const double *side)
{
    bool any = false;
    for (size_t k = 0; s->hold && k < s->switches->count && !any; k++) any = is_held(s, side, k);
    return any;
}

/* While a switch is held its function is positive: the value that holds it is within (-1, 1), and drives the argument
 * back to 0 from both sides. Where it falls to 0 the force does one of them no longer. */
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

/* With bounds on rounding in place of the rates, in units of 2^-53. */
static double grip_rounding_of(const sides *s, size_t k)
{
    const double p = fabs(s->p[k]);
    return (s->dr[k] + fabs(s->r[k])) * fabs((1 - p) * (1 + p)) + fabs(s->r[k]) * 2 * p * (s->dp[k] + 1);
}

/* What would have to hold every vector at 0 whose sides are held, to p; 0: what no force moves and none drives back. */
static void measure_hold(const sides *s, double t, double *x, double *v)
{
    run(s, s->hold, t, x, v, NULL, s->p), run(s, s->grip, t, x, v, NULL, s->r);
    for (size_t k = 0; k < s->switches->count; k++)
        if (switches_directs(op_of(s, k)) && isnan(s->p[k]) && s->r[k] == 0) s->p[k] = 0;
}

/* A part of the length within which a vector stays along its unit vector, about 75 degrees. */
#define TURNS 0.25

/* The sum of the products of two vectors' components. */
static double along(const parts *p, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < p->count; i++) sum += a[p->of[i]] * b[p->of[i]];
    return sum;
}

static void put_held(double *side, const parts *p, double way)
{
    for (int i = 0; i < p->count; i++) side[p->of[i]] = way > 0 ? SWITCHES_HELD : SWITCHES_HELD_BACKWARD;
}

/* The length from which a vector comes to rest along a way that is below the rounding of the largest place: so short
 * is it that the force changes no more. 0: it does not come to rest. */
#define SHORT 0x1p-24
static double short_of(const sides *s, const parts *p, double t, double *x, double *v)
{
    double *side = x + s->switches->slot, was[GRAPH_COMPONENTS], far = 0, back = -INFINITY;
    if (!s->hold || s->switches->slides[switches_kind(s->switches, p->of[0])] != SLIDES_HELD) return 0;
    for (int i = 0; i < p->count; i++) was[i] = side[p->of[i]];
    put_held(side, p, s->way);
    run(s, s->hold, t, x, v, NULL, s->p), run(s, s->grip, t, x, v, NULL, s->r);
    for (int i = 0; i < p->count; i++) side[p->of[i]] = was[i], back = fmax(back, s->way * s->r[p->of[i]]);
    for (size_t i = 0; i < s->problem->nx - s->problem->modes; i++) far = fmax(far, fabs(x[i]));
    const double slack = 1 - along(p, s->p, s->p);
    return back < 0 && slack > 0 ? SHORT * sqrt(far * -back * slack) : 0;
}

/* The function of a direction falls to 0 where the vector has turned away from its unit vector, or is short, and has
 * no kink where the motion stops without a turn. While the vector is held at 0 it is 1 - |p|^2. */
static double direction_of(const sides *s, const parts *p, const double *side, const double *u, double least)
{
    if (is_held(s, side, p->of[0])) return 1 - along(p, s->p, s->p);
    const double q = along(p, side, u);
    return q - copysign(TURNS, q) * sqrt(along(p, u, u)) - (1 - TURNS) * least;
}

static double direction_rate_of(const sides *s, const parts *p, const double *side, const double *du)
{
    if (is_held(s, side, p->of[0])) return -2 * along(p, s->p, s->dp);
    const double length = sqrt(along(p, s->u, s->u)), turns = copysign(TURNS, along(p, side, s->u));
    return along(p, side, du) - (length > 0 ? turns * along(p, s->u, du) / length : 0);
}

/* du: bounds on rounding. */
static double direction_rounding_of(const sides *s, const parts *p, const double *side, const double *du)
{
    double sum = 0;
    for (int i = 0; i < p->count; i++) {
        const size_t k = p->of[i];
        sum += is_held(s, side, k) ? 2 * fabs(s->p[k]) * (s->dp[k] + 1) : (1 + TURNS) * du[k] + 4 * fabs(s->u[k]);
    }
    return sum;
}

static int values(void *ctx, double t, double *x, double *v, double *out)
{
    const sides *s = ctx;
    const double *side = x + s->switches->slot;
    const int status = s->own.functions ? s->own.values(s->own.ctx, t, x, v, out) : 0;
    if (status) return status;
    out += s->own.functions;
    run(s, s->argument, t, x, v, NULL, s->u);
    const bool held = any_held(s, side);
    if (held) measure_hold(s, t, x, v);
    for (size_t k = 0; k < s->switches->count; k++) {
        const parts p = parts_of(s, k);
        const bool slides = p.count && !silent(s, k) && !is_held(s, side, k);
        const double least = slides ? short_of(s, &p, t, x, v) : 0;
        if (slides && held) measure_hold(s, t, x, v);
        out[k] = silent(s, k)                  ? 1
                 : p.count                     ? direction_of(s, &p, side, s->u, least)
                 : held && is_held(s, side, k) ? grip_of(s, side, k)
                 : is_pinned(s, side, k)       ? 1
                                               : switches_distance(op_of(s, k), side[k], s->u[k]);
    }
    return 0;
}

/* The arguments to u, and what `of` computes of them to out; where a switch is held, what holds it to p, and what
 * `of_hold` computes of that to dp; its grip to r, and what `of_grip` computes of that to dr. True: one is. */
static bool measure(const sides *s, tape *of, tape *of_hold, tape *of_grip, double t, double *x, double *v, double *a,
                    double *out)
{
    run(s, s->argument, t, x, v, NULL, s->u);
    run(s, of, t, x, v, a, out);
    const bool held = any_held(s, x + s->switches->slot);
    if (!held) return false;
    run(s, s->hold, t, x, v, NULL, s->p), run(s, of_hold, t, x, v, a, s->dp);
    run(s, s->grip, t, x, v, NULL, s->r), run(s, of_grip, t, x, v, a, s->dr);
    return true;
}

static int rates(void *ctx, double t, double *x, double *v, double *a, double *out)
{
    const sides *s = ctx;
    const double *side = x + s->switches->slot;
    const int status = s->own.functions ? s->own.rates(s->own.ctx, t, x, v, a, out) : 0;
    if (status) return status;
    out += s->own.functions;
    const bool held = measure(s, s->rate, s->hold_rate, s->grip_rate, t, x, v, a, s->du);
    for (size_t k = 0; k < s->switches->count; k++) {
        const parts p = parts_of(s, k);
        out[k] = silent(s, k)                  ? 0
                 : p.count                     ? direction_rate_of(s, &p, side, s->du)
                 : held && is_held(s, side, k) ? grip_rate_of(s, side, k)
                 : is_pinned(s, side, k)       ? 0
                                               : s->du[k] * switches_distance_slope(op_of(s, k), side[k], s->u[k]);
    }
    return 0;
}

static void rounding(void *ctx, double t, double *x, double *v, double *out)
{
    const sides *s = ctx;
    const double *side = x + s->switches->slot;
    if (s->own.functions) s->own.rounding(s->own.ctx, t, x, v, out);
    out += s->own.functions;
    const bool held = measure(s, s->rounding, s->hold_rounding, s->grip_rounding, t, x, v, NULL, s->du);
    for (size_t k = 0; k < s->switches->count; k++) {
        const parts p = parts_of(s, k);
        out[k] = 0x1p-53 * (silent(s, k)                  ? 0
                            : p.count                     ? direction_rounding_of(s, &p, side, s->du)
                            : held && is_held(s, side, k) ? grip_rounding_of(s, k)
                            : is_pinned(s, side, k)
                                ? 0
                                : s->du[k] * fabs(switches_distance_slope(op_of(s, k), side[k], s->u[k])));
    }
}

/* While an argument is 0 it is not known to move; and the value that holds one, and a direction, have no bound. */
static bool unknown(const sides *s, const double *side, size_t k)
{
    return switches_directs(op_of(s, k)) || is_held(s, side, k) ||
           switches_distance_slope(op_of(s, k), side[k], 0) == 0;
}

static void least_of(const sides *s, bool rates, double *x, double *v, double *dx, double *dv, double *out)
{
    const double *side = x + s->switches->slot;
    if (s->own.functions) (rates ? s->own.least_rates : s->own.least)(s->own.ctx, x, v, dx, dv, out);
    out += s->own.functions;
    for (size_t k = 0; k < s->switches->count; k++) out[k] = INFINITY; /* cells outside the ranges */
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_DX] = dx, [SPACE_DV] = dv, [SPACE_OUT] = out};
    tape_run(rates ? s->least_rates : s->least, NAN, base);
    for (size_t k = 0; k < s->switches->count; k++)
        if (silent(s, k) || is_pinned(s, side, k))
            out[k] = rates ? 0 : 1;
        else if (unknown(s, side, k))
            out[k] = -1;
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

/* Behind the own functions there is room for arguments of the switches, which need none. */
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

static void print(const sides *s, size_t k, char *out, size_t size)
{
    switches_surface(s->model, s->switches->original[switches_kind(s->switches, k)], out, size);
}

static void name(void *ctx, size_t number, size_t instance, char *out, size_t size)
{
    const sides *s = ctx;
    if (number < s->own.count)
        s->own.name(s->own.ctx, number, instance, out, size);
    else
        print(s, s->switches->first[number - s->own.count] + instance, out, size);
}

static const char not_unique[] = "the motion is not unique: the force drives it away to both sides";

/* The force leads no motion on from where a switch changes its side. */
static motus_status refuse(const sides *s, size_t k, const char *what, double t, motus_error *err)
{
    char text[120], at[DECIMAL_MAX];
    print(s, k, text, sizeof text);
    fail(err, MOTUS_SOLVE, "%s where %s, at t = %s", what, text, decimal(t, at));
    if (switches_directs(op_of(s, k)))
        hint(err, "let the run end before; or smooth the jump, r'/sqrt(|r'|^2 + 0.001^2) for r'/|r'|");
    else
        hint(err, "let the run end before; or smooth the jump, tanh(x'/0.001) for sign(x')");
    if (err) err->time = t, err->cause = MOTUS_CAUSE_DISCONTINUOUS;
    return MOTUS_SOLVE;
}

static motus_status accelerate(sides *s, double t, double *x, double *v, motus_error *err)
{
    char at[DECIMAL_MAX];
    memset(s->a, 0, s->problem->nv * sizeof *s->a);
    if (!s->problem->accel(s->problem->ctx, t, x, v, s->a)) return MOTUS_OK;
    fail(err, MOTUS_CALLBACK, "the acceleration cannot be evaluated at t = %s", decimal(t, at));
    if (err) err->time = t;
    return MOTUS_CALLBACK;
}

/* The rate of argument k along the run, with its switch on a side. */
static motus_status rate_on(sides *s, size_t k, double side, double way, double t, double *x, double *v, double *rate,
                            motus_error *err)
{
    double *sides = x + s->switches->slot;
    const double was = sides[k];
    put(s, sides, k, side);
    const motus_status status = accelerate(s, t, x, v, err);
    if (status == MOTUS_OK) run(s, s->rate, t, x, v, s->a, s->du);
    put(s, sides, k, was);
    *rate = way * s->du[k];
    return status;
}

/* The Taylor series of the motion from a state, to order AHEAD, in s->xs and s->vs. */
static motus_status expand(sides *s, double t, double *x, double *v, motus_error *err)
{
    enum { LENGTH = AHEAD + 1 };
    const problem *p = s->problem;
    const size_t kept = p->series_numbers(p->ctx, LENGTH);
    const size_t numbers = LENGTH * (p->nx + p->nv) + kept;
    if (!s->xs && kept) s->xs = arena_room(s->model->arena, (numbers + 1) * sizeof *s->xs);
    if (!s->xs || !kept) return fail(err, MOTUS_MEMORY, "no memory for the switches of the model");
    s->vs = s->xs + LENGTH * p->nx;
    memset(s->xs, 0, numbers * sizeof *s->xs);
    for (size_t i = 0; i < p->nx; i++) s->xs[i * LENGTH] = x[i], s->xs[i * LENGTH + 1] = v[i];
    for (size_t i = 0; i < p->nv; i++) s->vs[i * LENGTH] = v[i];
    memset(s->a, 0, p->nv * sizeof *s->a);
    for (int n = 0; n < AHEAD; n++) {
        p->series(p->ctx, LENGTH, n, t, s->xs, s->vs, s->a, s->vs + LENGTH * p->nv);
        for (size_t i = 0; i < p->nv; i++) s->vs[i * LENGTH + (size_t)n + 1] = s->a[i] / (n + 1);
        for (size_t i = 0; i < p->nx && n + 2 < LENGTH; i++)
            s->xs[i * LENGTH + (size_t)n + 2] = s->a[i] / ((n + 1) * (n + 2));
    }
    return MOTUS_OK;
}

/* The series at a distance h. False: so far its last terms count, or it is not finite. */
static bool reaches(const double *series, size_t count, double h, double *out)
{
    enum { LENGTH = AHEAD + 1 };
    for (size_t i = 0; i < count; i++) {
        const double *c = series + i * LENGTH;
        double power = 1, most = 0, last = 0, moved = 0;
        for (int n = 1; n < LENGTH; n++) {
            power *= h;
            const double term = c[n] * power;
            moved += term;
            most = fmax(most, fabs(term));
            if (n >= LENGTH - 2) last = fmax(last, fabs(term));
        }
        out[i] = c[0] + moved;
        if (!isfinite(out[i]) || last > 0x1p-20 * most) return false;
    }
    return true;
}

/* The way in which an argument leaves 0 whose rate is 0, with its switch on a side: its sign at the least distance at
 * which it exceeds its rounding and that of the force, since a derivative that vanishes does so but for that. 0: it
 * stays 0 as far as the series of the motion tell. */
static motus_status look_ahead(sides *s, size_t k, double side, double origin, double way, double t, double *x,
                               double *v, int *leaves, motus_error *err)
{
    enum { FACTOR = 16, TIMES = 64 };
    const size_t nv = s->problem->nv;
    double *sides = x + s->switches->slot;
    const double was = sides[k];
    *leaves = 0;
    put(s, sides, k, side);
    memset(s->b, 0, nv * sizeof *s->b);
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = s->b};
    tape_run(s->force_rounding, t, base);
    motus_status status = expand(s, t, x, v, err);
    put(s, sides, k, was);
    double h = way * 0x1p-120;
    for (int times = 0; times < TIMES && status == MOTUS_OK && !*leaves; times++, h *= FACTOR) {
        if (t + h == t && t != 0) continue;
        if (!reaches(s->xs, s->problem->nx, h, s->x) || !reaches(s->vs, nv, h, s->v)) break;
        run(s, s->argument, t + h, s->x, s->v, NULL, s->later);
        const double u = s->later[k] - origin;
        run(s, s->rounding, t + h, s->x, s->v, NULL, s->later);
        double hidden = 0x1p-52 * s->later[k];
        for (int pattern = 1; pattern <= 2; pattern++) { /* with one sign, and with both in turn */
            for (size_t i = 0; i < nv; i++)
                s->a[i] = s->v[i] + (i % (size_t)pattern ? -1 : 1) * 0x1p-52 * fabs(h) * fmin(s->b[i], 0x1p1000);
            run(s, s->argument, t + h, s->x, s->a, NULL, s->later);
            hidden += fabs(s->later[k] - origin - u);
        }
        if (fabs(u) > hidden) *leaves = u > 0 ? 1 : -1;
    }
    return status;
}

/* Whether what holds both takes the other one into account. */
static bool solved(const sides *s, size_t k, size_t j)
{
    const output *rate = s->switches->rate;
    return s->switches->together && rate[switches_kind(s->switches, k)].loops == 0 &&
           rate[switches_kind(s->switches, j)].loops == 0;
}

/* Holds the argument of switch k at 0, on whose sides the rates are `above` and `below`. */
static motus_status hold(sides *s, size_t k, double above, double below, double t, double *x, double *v,
                         motus_error *err)
{
    enum { PASSES = 32 }; /* one, but for rounding, which leaves 2^-53 of it each time */
    static const char *const slides =
        "the motion slides along a jump of the force, which drives it back from both sides,";
    const size_t count = s->switches->count, nv = s->problem->nv;
    double *side = x + s->switches->slot, middle;
    char why[200];
    if (s->switches->slides[switches_kind(s->switches, k)] != SLIDES_HELD) {
        snprintf(why, sizeof why, "%s and no value between those of both sides is known to hold it,", slides);
        return refuse(s, k, why, t, err);
    }
    motus_status status = MOTUS_OK;
    if (!chooses(s, k)) { /* a comparison chooses, and its parts are affine */
        status = rate_on(s, k, 0, 1, t, x, v, &middle, err);
        if (status != MOTUS_OK) return status;
        if (fabs(middle - (above + below) / 2) > 0x1p-30 * (fabs(above) + fabs(below))) {
            snprintf(why, sizeof why, "%s and no single value of the sign holds it,", slides);
            return refuse(s, k, why, t, err);
        }
    }
    /* The force on both sides; what moves another argument that is held, or what that moves, is not known apart. */
    status = rate_on(s, k, side_of(s, k, 1), 1, t, x, v, &middle, err);
    memcpy(s->b, s->a, nv * sizeof *s->b);
    memcpy(s->later, s->du, count * sizeof *s->du);
    if (status == MOTUS_OK) status = rate_on(s, k, side_of(s, k, -1), 1, t, x, v, &middle, err);
    bool coupled = false;
    for (size_t j = 0; j < count; j++)
        coupled |= first_of(s, j) != k && is_held(s, side, j) && !solved(s, k, j) && s->du[j] != s->later[j];
    for (size_t j = 0; j < count && status == MOTUS_OK && !coupled; j++) {
        double one = 0, other = 0;
        if (j == k || follows(s, j) || !is_held(s, side, j) || solved(s, k, j)) continue;
        if (switches_directs(op_of(s, j))) {
            coupled = true;
            break;
        }
        const double held = side[j], on = side_of(s, k, 1);
        put(s, side, j, side_of(s, j, 1)), status = rate_on(s, k, on, 1, t, x, v, &one, err);
        put(s, side, j, side_of(s, j, -1));
        if (status == MOTUS_OK) status = rate_on(s, k, on, 1, t, x, v, &other, err);
        put(s, side, j, held);
        coupled = one != other;
    }
    if (status != MOTUS_OK) return status;
    if (coupled) {
        snprintf(why, sizeof why, "%s together with another, whose force depends on it,", slides);
        return refuse(s, k, why, t, err);
    }
    /* The argument is 0 but for rounding: it becomes 0 along the push that the switch exerts. */
    status = rate_on(s, k, side_of(s, k, -1), 1, t, x, v, &middle, err);
    for (int pass = 0; pass < PASSES; pass++) {
        run(s, s->argument, t, x, v, NULL, s->u);
        if (s->u[k] == 0) break;
        const double way = -s->u[k] / (above - below);
        for (size_t i = 0; i < nv; i++) v[i] += way * (s->b[i] - s->a[i]);
    }
    put(s, side, k, above < below ? SWITCHES_HELD : SWITCHES_HELD_BACKWARD);
    return status;
}

/* How far rounding may carry the rates `on` both sides of a switch that can be held. Where friction breaks loose, what
 * holds the switch has just reached 1, so that one of the rates is 0 but for rounding of that value and of the time. */
static double unsure(sides *s, size_t k, const double on[2], double t, double *x, double *v)
{
    if (!s->hold || s->switches->slides[switches_kind(s->switches, k)] != SLIDES_HELD) return 0;
    run(s, s->hold_rate, t, x, v, s->a, s->p);
    const double moved = fabs(s->p[k]) * (nextafter(fabs(t), INFINITY) - fabs(t));
    run(s, s->hold_rounding, t, x, v, NULL, s->dp);
    return fabs(on[0] - on[1]) * (0x1p-52 * (s->dp[k] + 1) + moved);
}

/* A switch k that the force can hold, and others beside it whose arguments it moves: x' and x, where both accumulate
 * (`x'' = -2 sign(x) - sign(x')` comes to rest at 0 by ever shorter swings). Both stay at 0 where the force drives the
 * motion back from either side of both: where k and those beside it, which leave with it, are all on one side, and
 * where all are on the other. */

/* The way of n's argument when k's becomes positive; 0: that does not move it. s->a and s->b: the accelerations with k
 * on both sides, whose rates differ by `push`. *rate: how fast s->b - s->a, as a velocity, moves it. */
static int moves_with(sides *s, size_t n, double push, double way, double t, double *x, double *v, double *rate)
{
    const size_t nv = s->problem->nv;
    for (size_t i = 0; i < nv; i++) s->v[i] = v[i] + (s->b[i] - s->a[i]);
    run(s, s->rate, t, x, v, s->a, s->du);
    *rate = -s->du[n];
    run(s, s->rate, t, x, s->v, s->a, s->du);
    *rate += s->du[n];
    const double along = way * *rate * push;
    return (along > 0) - (along < 0);
}

/* The rate of argument k with its switch and those beside it on one side, 1 or -1. */
static motus_status rate_at_corner(sides *s, size_t k, int to, double way, double t, double *x, double *v, double *rate,
                                   motus_error *err)
{
    double *side = x + s->switches->slot;
    for (size_t n = 0; n < s->switches->count; n++) {
        if (!s->beside[n]) continue;
        s->was[n] = side[n];
        put(s, side, n, s->beside[n] * to);
    }
    const motus_status status = rate_on(s, k, side_of(s, k, to), way, t, x, v, rate, err);
    for (size_t n = 0; n < s->switches->count; n++)
        if (s->beside[n]) put(s, side, n, s->was[n]);
    return status;
}

/* The switches beside k: of those that are marked in `of`, or else of those at 0. Their number. */
static motus_status find_beside(sides *s, size_t k, const bool *of, double way, double t, double *x, double *v,
                                size_t *found, motus_error *err)
{
    const double *side = x + s->switches->slot;
    double above, below, rate;
    *found = 0;
    motus_status status = rate_on(s, k, side_of(s, k, 1), 1, t, x, v, &above, err);
    memcpy(s->b, s->a, s->problem->nv * sizeof *s->b);
    if (status == MOTUS_OK) status = rate_on(s, k, side_of(s, k, -1), 1, t, x, v, &below, err);
    if (status != MOTUS_OK) return status;
    for (size_t n = 0; n < s->switches->count; n++) {
        const bool may = n != k && !follows(s, n) &&
                         (of ? of[n] && op_of(s, n) == OP_SIGN : op_of(s, n) == OP_SIGN && fabs(side[n]) < 1);
        s->beside[n] = (int8_t)(may ? moves_with(s, n, above - below, way, t, x, v, &rate) : 0);
        *found += s->beside[n] != 0;
    }
    return MOTUS_OK;
}

/* Moves the state to where the argument of k, or of n beside it, is 0, along the push that switch k exerts. */
static motus_status move_to_zero(sides *s, size_t k, size_t n, double t, double *x, double *v, motus_error *err)
{
    enum { PASSES = 32 }; /* as in `hold` */
    double above, below, rate;
    motus_status status = rate_on(s, k, side_of(s, k, 1), 1, t, x, v, &above, err);
    memcpy(s->b, s->a, s->problem->nv * sizeof *s->b);
    if (status == MOTUS_OK) status = rate_on(s, k, side_of(s, k, -1), 1, t, x, v, &below, err);
    if (status != MOTUS_OK) return status;
    moves_with(s, n, above - below, 1, t, x, v, &rate);
    for (int pass = 0; pass < PASSES; pass++) {
        run(s, s->argument, t, x, v, NULL, s->u);
        if (s->u[n] == 0) break;
        const double by = -s->u[n] / (n == k ? above - below : rate);
        double *to = n == k ? v : x;
        const size_t count = n == k ? s->problem->nv : s->problem->nx;
        for (size_t i = 0; i < count; i++) to[i] += by * (s->b[i] - s->a[i]);
    }
    return MOTUS_OK;
}

/* Gives those in s->beside the value c, and returns the one with which k is held then. */
static double pin(sides *s, size_t k, double c, double t, double *x, double *v)
{
    const double tiny = 0x1p-60;
    double *side = x + s->switches->slot;
    for (size_t n = 0; n < s->switches->count; n++)
        if (s->beside[n]) put(s, side, n, s->beside[n] * (fabs(c) < tiny ? tiny : c));
    run(s, s->hold, t, x, v, NULL, s->p);
    return s->p[k];
}

/* Switch k and those in s->beside, all of them at 0: *held, or they go on to one side. `going`: the way in which the
 * value that holds k has left its bounds, 0: it has not. While those beside it have one value, that of k tells what
 * changes; where it leaves they take as much of it as they can. */
static motus_status stand_at_corner(sides *s, size_t k, int going, double way, double t, double *x, double *v,
                                    bool *held, motus_error *err)
{
    const double most = 1 - 0x1p-50, near = 1 - 0x1p-40;
    double *side = x + s->switches->slot, above, below;
    motus_status status = rate_at_corner(s, k, 1, way, t, x, v, &above, err);
    if (status == MOTUS_OK) status = rate_at_corner(s, k, -1, way, t, x, v, &below, err);
    if (status != MOTUS_OK) return status;
    const double middle = below / (below - above) * 2 - 1; /* with this value of all signs the rate is 0 */
    *held = above < 0 && below > 0 && !(going && going * middle >= near);
    if (!*held) {
        if (above > 0 && below < 0) return refuse(s, k, not_unique, t, err);
        const int to = above < 0 && below > 0 ? going : above >= 0 ? 1 : -1;
        put(s, side, k, side_of(s, k, to));
        for (size_t n = 0; n < s->switches->count; n++)
            if (s->beside[n]) put(s, side, n, s->beside[n] * to);
        return MOTUS_OK;
    }
    double c = middle;
    if (going) {
        const double one = pin(s, k, 0.5, t, x, v), other = pin(s, k, -0.5, t, x, v);
        const double aim = (-0.75 * going - (one + other) / 2) / (one - other);
        if (isfinite(aim)) c = aim;
    }
    pin(s, k, fabs(c) > most ? copysign(most, c) : c, t, x, v);
    put(s, side, k, way > 0 ? SWITCHES_HELD : SWITCHES_HELD_BACKWARD);
    return MOTUS_OK;
}

/* The side on which the motion goes on where the argument of switch k is 0. */
static motus_status choose(sides *s, size_t k, bool left, double way, double t, double *x, double *v, motus_error *err)
{
    const operation op = op_of(s, k);
    double *all = x + s->switches->slot, on[2], side = all[k];
    const double above = switches_side(op, 1, 0), below = switches_side(op, -1, 0);
    motus_status status = rate_on(s, k, above, way, t, x, v, &on[0], err);
    if (status == MOTUS_OK) status = rate_on(s, k, below, way, t, x, v, &on[1], err);
    if (status != MOTUS_OK) return status;
    if (s->hold && s->switches->slides[switches_kind(s->switches, k)] == SLIDES_HELD) {
        size_t beside;
        bool held;
        status = find_beside(s, k, NULL, way, t, x, v, &beside, err);
        if (status == MOTUS_OK && beside) return stand_at_corner(s, k, 0, way, t, x, v, &held, err);
        if (status != MOTUS_OK) return status;
    }
    const double bound = unsure(s, k, on, t, x, v);
    for (int i = 0; i < 2; i++)
        if (fabs(on[i]) <= bound) on[i] = 0;
    if (on[0] > 0 && on[1] < 0) return refuse(s, k, not_unique, t, err);
    if (on[0] < 0 && on[1] > 0) return hold(s, k, way * on[0], way * on[1], t, x, v, err);
    if (on[0] == 0 && on[1] == 0 && left && (side == above || side == below)) {
        side = side == above ? below : above;
    } else if (on[0] == 0 && on[1] == 0) {
        int up, down, there = 0;
        status = look_ahead(s, k, above, 0, way, t, x, v, &up, err);
        if (!status) status = look_ahead(s, k, below, 0, way, t, x, v, &down, err);
        if (status != MOTUS_OK) return status;
        if (switches_jumps(op) && up > 0 && down < 0) return refuse(s, k, not_unique, t, err);
        if ((up > 0) != (down < 0)) {
            side = up > 0 ? above : below;
        } else if (switches_jumps(op)) {
            status = look_ahead(s, k, side, 0, way, t, x, v, &there, err);
            side = switches_side(op, 0, there);
        } else { /* while it is 0 its formulas agree */
            side = above;
        }
    } else {
        side = on[0] + on[1] > 0 ? above : below;
    }
    put(s, all, k, side);
    return status;
}

/* ---- directions ---- */

static void put_direction(double *side, const parts *p, const double *d, double length)
{
    for (int i = 0; i < p->count; i++) side[p->of[i]] = d[p->of[i]] / length;
}

/* The accelerations to `a`, the rates of all arguments to `du`. */
static motus_status push_of(sides *s, double t, double *x, double *v, double *a, double *du, motus_error *err)
{
    const motus_status status = accelerate(s, t, x, v, err);
    if (status != MOTUS_OK) return status;
    run(s, s->rate, t, x, v, s->a, du);
    if (a != s->a) memcpy(a, s->a, s->problem->nv * sizeof *a);
    return MOTUS_OK;
}

static const char no_disc[] =
    "the force along a direction drives its vector not straight back, and nothing is known to "
    "hold it,";

/* Moves the state to where the vector is 0, along the push of the force against it: the accelerations with the vector's
 * own direction and with the opposite one differ by twice that. Only a push that drives the vector straight back, by
 * the same rate in every direction, is one of friction that can hold it. */
static motus_status move_to_rest(sides *s, const parts *p, double way, double t, double *x, double *v, double *first,
                                 double *drives, motus_error *err)
{
    enum { PASSES = 32 };            /* as in `hold` */
    const double nothing = 0x1p-480; /* whose square is still a number */
    double *side = x + s->switches->slot, least = INFINITY;
    motus_status status = MOTUS_OK;
    for (int pass = 0; pass < PASSES && status == MOTUS_OK; pass++) {
        run(s, s->argument, t, x, v, NULL, s->now);
        const double length = sqrt(along(p, s->now, s->now));
        if (!(length > nothing && length < least)) break;
        least = length;
        put_direction(side, p, s->now, length);
        status = push_of(s, t, x, v, s->b, s->later, err);
        put_direction(side, p, s->now, -length);
        if (status == MOTUS_OK) status = push_of(s, t, x, v, s->a, s->du, err);
        if (status != MOTUS_OK) break;
        double back = 0, aside = 0;
        for (int i = 0; i < p->count; i++) s->later[p->of[i]] = (s->later[p->of[i]] - s->du[p->of[i]]) / 2;
        back = -along(p, s->later, s->now) / length;
        for (int i = 0; i < p->count; i++) aside += fabs(s->later[p->of[i]] + back * s->now[p->of[i]] / length);
        if (pass == 0 && !(way * back > 0 && aside <= 0x1p-20 * fabs(back)))
            return refuse(s, p->of[0], no_disc, t, err);
        if (pass == 0 && drives) *drives = way * back;
        for (size_t i = 0; i < s->problem->nv; i++) {
            const double by = length / back * (s->b[i] - s->a[i]) / 2;
            if (pass == 0 && first) first[i] = by;
            v[i] += by;
        }
    }
    for (size_t i = 0; i < s->problem->nv; i++)
        if (fabs(v[i]) <= nothing) v[i] = 0;
    return status;
}

/* The motion leaves 0 along what would have to hold it, where that is more than 1. The vector becomes as long as
 * rounding allows to tell its direction. */
static motus_status leave(sides *s, const parts *p, double way, double t, double *x, double *v, motus_error *err)
{
    double *side = x + s->switches->slot;
    const size_t nv = s->problem->nv;
    put_held(side, p, way);
    motus_status status = push_of(s, t, x, v, s->b, s->later, err);
    run(s, s->hold, t, x, v, NULL, s->p);
    const double length = sqrt(along(p, s->p, s->p));
    if (s->p[p->of[0]] != s->p[p->of[0]] || !(length > 0)) return refuse(s, p->of[0], no_disc, t, err);
    if (length <= 1 + 0x1p-20) { /* it breaks loose where it has been held so far */
        double across = 0;
        run(s, s->hold_rate, t, x, v, s->b, s->dp);
        const double grows = along(p, s->p, s->dp) / length, rate = sqrt(along(p, s->dp, s->dp));
        for (int i = 0; i < p->count; i++) {
            const double part = s->dp[p->of[i]] - grows * s->p[p->of[i]] / length;
            across += part * part;
        }
        if (!(sqrt(across) <= 0x1p-20 * rate))
            return refuse(s, p->of[0],
                          "the motion breaks loose along a direction that turns, which steps cannot follow,", t, err);
    }
    memcpy(s->before, s->p, s->switches->count * sizeof *s->p);
    put_direction(side, p, s->p, length);
    for (int i = 0; i < p->count; i++) s->now[p->of[i]] = side[p->of[i]];
    if (status == MOTUS_OK) status = push_of(s, t, x, v, s->a, s->du, err); /* without friction, at 0 */
    if (status != MOTUS_OK) return status;
    run(s, s->rounding, t, x, v, NULL, s->bound);
    double bound = 0, back = 0;
    for (int i = 0; i < p->count; i++) {
        const size_t k = p->of[i];
        bound += 0x1p-53 * s->bound[k];
        back += s->now[k] * (s->du[k] - s->later[k]) / length;
    }
    const double ulp = nextafter(fabs(t), INFINITY) - fabs(t);
    const double speed = fmax(64 * bound, fmax(64 * ulp, 0x1p-70) * fabs(back));
    if (!(back != 0)) return refuse(s, p->of[0], no_disc, t, err);
    for (size_t i = 0; i < nv; i++) v[i] -= speed / back * (s->b[i] - s->a[i]) / length;
    return MOTUS_OK;
}

/* Whether the vector is driven back along each component, as much as by that alone: of two that are held by one force,
 * the second has no rate of its own. */
static bool drives_back(sides *s, const parts *p, double way, double t, double *x, double *v)
{
    double *side = x + s->switches->slot;
    measure_hold(s, t, x, v);
    memcpy(s->was, side, s->switches->count * sizeof *side);
    for (size_t k = 0; k < s->switches->count; k++)
        if (switches_directs(op_of(s, k)) && k != p->of[0]) side[k] = 0;
    run(s, s->grip, t, x, v, NULL, s->before);
    memcpy(side, s->was, s->switches->count * sizeof *side);
    bool back = true;
    for (int i = 0; i < p->count; i++)
        back = back && way * s->r[p->of[i]] < 0 && fabs(s->r[p->of[i]]) > 0x1p-20 * fabs(s->before[p->of[0]]);
    return back;
}

static const char two_forms[] = "the force has one direction in two forms, which nothing shows to be one,";

/* How much the force along a direction drives its vector alone, to `alone`, and with another one held as well, to r. */
static void measure_both(sides *s, const parts *p, const parts *other, double way, double t, double *x, double *v,
                         double *alone)
{
    double *side = x + s->switches->slot;
    put_held(side, p, way);
    for (int i = 0; i < other->count; i++) side[other->of[i]] = 0;
    run(s, s->grip, t, x, v, NULL, alone);
    put_held(side, other, way);
    run(s, s->grip, t, x, v, NULL, s->r);
}

/* Whether another vector may be this one in another form, which nothing has shown: with one of them held the force no
 * longer drives the other one. short: only one that is 0, too, of which the force drives a part no longer. */
static bool is_twice(sides *s, const parts *p, bool is_short, double way, double t, double *x, double *v)
{
    double *side = x + s->switches->slot;
    bool twice = false;
    if (!s->hold) return false;
    run(s, s->argument, t, x, v, NULL, s->now);
    run(s, s->rounding, t, x, v, NULL, s->bound);
    memcpy(s->was, side, s->switches->count * sizeof *side);
    for (size_t k = 0; k < s->switches->count && !twice; k++) {
        const parts o = parts_of(s, k);
        double bound = 0;
        if (!o.count || silent(s, k) || k == p->of[0]) continue;
        for (int i = 0; i < o.count; i++) bound += 0x1p-53 * s->bound[o.of[i]];
        if (is_short && !(along(&o, s->now, s->now) <= 0x1p20 * bound * bound))
            continue; /* rounding of the other form */
        for (int both = 0; both < 2 && !twice; both++) {
            const parts *one = both ? p : &o, *other = both ? &o : p;
            int lost = 0;
            measure_both(s, one, other, way, t, x, v, s->before);
            for (int i = 0; i < one->count && s->before[one->of[0]] != 0; i++)
                lost += !(fabs(s->r[one->of[i]]) > 0x1p-20 * fabs(s->before[one->of[0]]));
            twice = is_short ? lost > 0 : lost == one->count;
            memcpy(side, s->was, s->switches->count * sizeof *side);
        }
    }
    return twice;
}

/* Whether what holds `of` depends on the sides of `by`, which then are not solved for. */
static bool depends(sides *s, const parts *of, const parts *by, double t, double *x, double *v)
{
    double *side = x + s->switches->slot, was[GRAPH_COMPONENTS];
    bool differs = false;
    for (int i = 0; i < by->count; i++) was[i] = side[by->of[i]], side[by->of[i]] = 0;
    run(s, s->hold, t, x, v, NULL, s->before);
    for (int i = 0; i < by->count; i++) side[by->of[i]] = 1;
    run(s, s->hold, t, x, v, NULL, s->later);
    for (int i = 0; i < by->count; i++) side[by->of[i]] = was[i];
    for (int i = 0; i < of->count; i++) {
        const double before = s->before[of->of[i]], later = s->later[of->of[i]];
        differs = differs || (before != later && !(isnan(before) && isnan(later)));
    }
    return differs;
}

/* Whether what holds this vector, or another one that is held, depends on a side that is not known while both are. */
static bool is_coupled(sides *s, const parts *p, double t, double *x, double *v)
{
    const double *side = x + s->switches->slot;
    bool coupled = false;
    for (size_t k = 0; k < s->switches->count && !coupled; k++) {
        parts o = parts_of(s, k);
        const bool held = is_held(s, side, k);
        if (silent(s, k) || k == p->of[0] || solved(s, k, p->of[0]) || !(o.count || held)) continue;
        if (!o.count) o = (parts){.of = {k}, .count = 1};
        coupled = depends(s, p, &o, t, x, v) || (held && depends(s, &o, p, t, x, v));
    }
    return coupled;
}

/* The vector is 0, but for rounding: it stays 0 where no more than the whole of the disc is needed for that. */
static motus_status stand(sides *s, const parts *p, double way, double t, double *x, double *v, motus_error *err)
{
    double *side = x + s->switches->slot;
    if (!s->hold || s->switches->slides[switches_kind(s->switches, p->of[0])] != SLIDES_HELD)
        return refuse(s, p->of[0], "the motion stops, and nothing is known to hold it,", t, err);
    put_held(side, p, way);
    measure_hold(s, t, x, v);
    bool acts = false;
    for (int i = 0; i < p->count; i++) acts |= s->r[p->of[i]] != 0;
    if (!acts) { /* friction is switched off */
        for (int i = 0; i < p->count; i++) side[p->of[i]] = i == 0;
        motus_status status = push_of(s, t, x, v, s->a, s->du, err);
        const double pull = sqrt(along(p, s->du, s->du));
        if (status == MOTUS_OK && pull > 0) put_direction(side, p, s->du, way * pull);
        if (!(pull > 0)) put_held(side, p, way);
        return status;
    }
    const motus_status status = move_to_rest(s, p, way, t, x, v, NULL, NULL, err);
    if (status != MOTUS_OK) return status;
    put_held(side, p, way);
    if (!drives_back(s, p, way, t, x, v)) return refuse(s, p->of[0], no_disc, t, err);
    if (is_twice(s, p, true, way, t, x, v)) return refuse(s, p->of[0], two_forms, t, err);
    if (is_coupled(s, p, t, x, v))
        return refuse(s, p->of[0], "the motion stops together with others, more than are held at once,", t, err);
    measure_hold(s, t, x, v);
    return along(p, s->p, s->p) <= 1 ? MOTUS_OK : leave(s, p, way, t, x, v, err);
}

/* The way on to rest of a short vector u, and the time that it takes; not *rests: it rests after `until`. With the
 * force constant, F without friction and -c u/|u| by it, c|u| + F u falls by c^2 - F^2 in a time, and so do quadratic
 * forms in u whose rates are linear in u: where the motion stops, how far it goes and when are known in closed form,
 * though no power of the time leads there. */
static motus_status come_to_rest(sides *s, const parts *p, double way, double until, double *t, double *x, double *v,
                                 bool *rests, motus_error *err)
{
    double *side = x + s->switches->slot, u[GRAPH_COMPONENTS], F[GRAPH_COMPONENTS], back = 0;
    const size_t nv = s->problem->nv, moving = s->problem->nx - s->problem->modes;
    run(s, s->argument, *t, x, v, NULL, s->now);
    const double length = sqrt(along(p, s->now, s->now));
    for (int i = 0; i < p->count; i++) u[i] = s->now[p->of[i]];
    memset(s->push, 0, nv * sizeof *s->push);
    memcpy(s->v, v, nv * sizeof *v);
    motus_status status = move_to_rest(s, p, way, *t, x, v, s->push, &back, err);
    if (status != MOTUS_OK) return status;
    for (int i = 0; i < p->count; i++) side[p->of[i]] = u[i] / length;
    status = push_of(s, *t, x, v, s->a, s->du, err); /* without friction, at 0 */
    put_held(side, p, way);
    if (status == MOTUS_OK) status = push_of(s, *t, x, v, s->b, s->later, err);
    measure_hold(s, *t, x, v);
    double pull = 0, with = 0;
    for (int i = 0; i < p->count; i++) F[i] = back * s->p[p->of[i]], pull += F[i] * F[i], with += F[i] * u[i];
    pull = sqrt(pull);
    if (status != MOTUS_OK || !(pull < back)) return status;
    const double ahead = pull > 0 ? with / pull : 0; /* the part of u along F */
    const double time = (back * length + with) / (back * back - pull * pull);
    if (!(time <= way * (until - *t))) { /* the run ends before */
        memcpy(v, s->v, nv * sizeof *v);
        for (int i = 0; i < p->count; i++) side[p->of[i]] = u[i] / length;
        *rests = false;
        return MOTUS_OK;
    }
    const double turned = (2 * back * length + with) / (4 * back * back - pull * pull);
    const double far =
        (back * length * ahead + pull * (ahead * ahead + length * length) / 2) / (2 * (back * back - pull * pull));
    /* the push for u has been found by its own direction, that along F by what holds the vector */
    const double of_u = turned, of_hold = pull > 0 ? (far - turned * ahead) / pull : 0;
    for (size_t i = 0; i < moving; i++) {
        const double friction = -of_u * s->push[i] - of_hold * (s->b[i] - s->a[i]);
        x[i] += way * (v[i] * time + friction) + s->b[i] * time * time / 2;
    }
    for (size_t i = 0; i < nv; i++) v[i] += way * s->b[i] * time;
    *t += way * time;
    return MOTUS_OK;
}

/* The side of a direction. left: the vector has turned away from the old one, or is short, or what holds it has left
 * the disc. */
static motus_status choose_direction(sides *s, size_t k, bool left, double way, double until, double *t, double *x,
                                     double *v, motus_error *err)
{
    const parts p = parts_of(s, k);
    double *side = x + s->switches->slot, bound = 0;
    run(s, s->argument, *t, x, v, NULL, s->now);
    const double length = sqrt(along(&p, s->now, s->now));
    if (left && is_held(s, side, k)) return leave(s, &p, way, *t, x, v, err);
    run(s, s->rounding, *t, x, v, NULL, s->bound);
    for (int i = 0; i < p.count; i++) bound += 0x1p-53 * s->bound[p.of[i]];
    if (length <= bound) return stand(s, &p, way, *t, x, v, err);
    put_direction(side, &p, s->now, length);
    if (is_twice(s, &p, false, way, *t, x, v)) return refuse(s, k, two_forms, *t, err);
    if (!left) return MOTUS_OK;
    const double ulp = nextafter(fabs(*t), INFINITY) - fabs(*t), least = short_of(s, &p, *t, x, v);
    motus_status status = MOTUS_OK;
    bool rests = true;
    if (length <= 1.25 * least) {
        status = come_to_rest(s, &p, way, until, t, x, v, &rests, err);
    } else { /* what is left of the motion is less than times can tell */
        status = push_of(s, *t, x, v, s->a, s->du, err);
        if (status != MOTUS_OK || !(length <= -0x1p13 * ulp * way * along(&p, s->du, s->now) / length)) return status;
    }
    return status == MOTUS_OK && rests ? stand(s, &p, way, *t, x, v, err) : status;
}

/* ---- all switches ---- */

/* The integer side likewise; u is at the whole number `at`. */
static motus_status choose_count(sides *s, size_t k, bool left, double at, double way, double t, double *x, double *v,
                                 motus_error *err)
{
    double *side = x + s->switches->slot + k, on[2];
    motus_status status = rate_on(s, k, at, way, t, x, v, &on[0], err);
    if (status == MOTUS_OK) status = rate_on(s, k, at - 1, way, t, x, v, &on[1], err);
    if (status != MOTUS_OK) return status;
    if (on[0] > 0 && on[1] < 0) return refuse(s, k, not_unique, t, err);
    if (on[0] < 0 && on[1] > 0)
        return refuse(s, k, "the motion slides along a jump of the force, which drives it back from both sides,", t,
                      err);
    if (on[0] == 0 && on[1] == 0 && left) {
        *side = switches_beyond(op_of(s, k), *side, s->u[k]);
    } else if (on[0] == 0 && on[1] == 0) {
        int up;
        status = look_ahead(s, k, at, at, way, t, x, v, &up, err);
        *side = up < 0 ? at - 1 : at;
    } else {
        *side = on[0] + on[1] < 0 ? at - 1 : at;
    }
    return status;
}

/* The side that belongs to the argument of switch k as it is in `u`; rounding may have carried it by `bound`. */
static motus_status place(sides *s, size_t k, double u, double bound, double way, double t, double *x, double *v,
                          motus_error *err)
{
    const operation op = op_of(s, k);
    const double whole = switches_counts(op) ? round(u) : 0;
    if (isnan(u) || silent(s, k)) return MOTUS_OK; /* a cell without a switch; another one places it */
    if (switches_directs(op)) return choose_direction(s, k, false, way, t, &t, x, v, err);
    if (is_pinned(s, x + s->switches->slot, k) && fabs(u) <= bound) return MOTUS_OK; /* it leaves with another */
    if (isfinite(bound) ? fabs(u - whole) > bound : u != whole) { /* where its slope is infinite no bound is known */
        put(s, x + s->switches->slot, k, switches_side(op, u, 0));
        return MOTUS_OK;
    }
    return switches_counts(op) ? choose_count(s, k, false, whole, way, t, x, v, err)
                               : choose(s, k, false, way, t, x, v, err);
}

/* Whether switch k, which was held, is held no longer since its value drives the argument no longer back to 0, but for
 * rounding; that value to p. */
static bool lost_grip(sides *s, size_t k, double t, double *x, double *v)
{
    if (accelerate(s, t, x, v, NULL) != MOTUS_OK) return false;
    run(s, s->hold, t, x, v, NULL, s->p);
    run(s, s->grip, t, x, v, NULL, s->r);
    run(s, s->grip_rate, t, x, v, s->a, s->dr);
    const double moved = fabs(s->dr[k]) * (nextafter(fabs(t), INFINITY) - fabs(t));
    run(s, s->grip_rounding, t, x, v, NULL, s->dr);
    return !(fabs(s->p[k]) > 1 - 0x1p-20) || fabs(s->r[k]) <= 4 * (0x1p-53 * s->dr[k] + moved);
}

/* The new side of switch k, whose argument has left the old one. */
static motus_status change(sides *s, size_t k, double way, double t, double *x, double *v, motus_error *err)
{
    const operation op = op_of(s, k);
    double *side = x + s->switches->slot + k;
    run(s, s->argument, t, x, v, NULL, s->u);
    if (s->hold && is_held(s, x + s->switches->slot, k)) {
        size_t beside;
        bool held;
        if (lost_grip(s, k, t, x, v)) return refuse(s, k, not_unique, t, err);
        const int to = s->p[k] > 0 ? 1 : -1;
        const motus_status status = find_beside(s, k, NULL, way, t, x, v, &beside, err);
        if (status != MOTUS_OK) return status;
        if (beside) return stand_at_corner(s, k, to, way, t, x, v, &held, err);
        put(s, x + s->switches->slot, k, side_of(s, k, to));
        return MOTUS_OK;
    }
    if (switches_counts(op)) return choose_count(s, k, true, round(s->u[k]), way, t, x, v, err);
    if (*side == 0 && (op == OP_ABS || op == OP_SIGN || op == OP_CBRT)) return choose(s, k, true, way, t, x, v, err);
    if (switches_jumps(op)) return choose(s, k, true, way, t, x, v, err);
    *side = switches_beyond(op, *side, 0);
    return MOTUS_OK;
}

/* Where another switch has turned, what is held may be no longer. */
static motus_status check_held(sides *s, double way, double t, double *x, double *v, motus_error *err)
{
    const double *side = x + s->switches->slot;
    motus_status status = MOTUS_OK;
    for (size_t k = 0; k < s->switches->count && status == MOTUS_OK; k++) {
        if (!s->hold || !is_held(s, side, k) || silent(s, k)) continue;
        if (switches_directs(op_of(s, k))) {
            const parts p = parts_of(s, k);
            run(s, s->hold, t, x, v, NULL, s->p);
            if (along(&p, s->p, s->p) > 1 + 0x1p-40) status = leave(s, &p, way, t, x, v, err);
            continue;
        }
        run(s, s->hold, t, x, v, NULL, s->p), run(s, s->hold_rounding, t, x, v, NULL, s->dp);
        run(s, s->grip, t, x, v, NULL, s->r), run(s, s->grip_rounding, t, x, v, NULL, s->dr);
        if (grip_of(s, side, k) < -0x1p-52 * grip_rounding_of(s, k)) status = choose(s, k, false, way, t, x, v, err);
    }
    return status;
}

/* A switch within the argument of another one may let that jump: mod(floor(t), 2). */
static motus_status turn(void *ctx, size_t number, size_t instance, double way, double until, double *at, double *x,
                         double *v, motus_error *err)
{
    sides *s = ctx;
    const size_t count = s->switches->count, switched = s->switches->first[number - s->own.count] + instance;
    const double *side = x + s->switches->slot;
    s->way = way;
    run(s, s->argument, *at, x, v, NULL, s->kept);
    motus_status status = switches_directs(op_of(s, switched))
                              ? choose_direction(s, switched, true, way, until, at, x, v, err)
                              : change(s, switched, way, *at, x, v, err);
    const double t = *at;
    for (size_t pass = 0; pass < NESTED && status == MOTUS_OK; pass++) {
        bool jumped = false;
        run(s, s->argument, t, x, v, NULL, s->now);
        run(s, s->rounding, t, x, v, NULL, s->bound);
        for (size_t k = 0; k < count && status == MOTUS_OK; k++) {
            const double bound = 0x1p-53 * s->bound[k];
            if (is_held(s, side, k) || is_pinned(s, side, k) || switches_directs(op_of(s, k)))
                continue; /* what holds it moved it to 0 */
            if (!(fabs(s->now[k] - s->kept[k]) > bound + fabs(s->kept[k]) * 0x1p-40)) continue;
            jumped = true;
            status = place(s, k, s->now[k], bound, way, t, x, v, err);
        }
        if (!jumped) break;
        memcpy(s->kept, s->now, count * sizeof *s->now);
    }
    return status != MOTUS_OK ? status : check_held(s, way, t, x, v, err);
}

/* Holds those of the marked switches that can be, with those beside them; *held: that is all of the marked ones. */
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
        status = find_beside(s, k, of, way, t, x, v, &beside, err);
        if (status != MOTUS_OK || !beside) continue;
        for (size_t n = 0; n < count && status == MOTUS_OK; n++)
            if (s->beside[n]) s->covered[n] = true, status = move_to_zero(s, k, n, t, x, v, err);
        s->covered[k] = true;
        if (status == MOTUS_OK) status = move_to_zero(s, k, k, t, x, v, err);
        if (status == MOTUS_OK) status = stand_at_corner(s, k, 0, way, t, x, v, held, err);
        *held = *held && is_held(s, side, k);
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
    if (number == 1 && switches_directs(op_of(s, functions[0] - s->own.functions))) {
        const parts p = parts_of(s, functions[0] - s->own.functions);
        s->way = way;
        return stand(s, &p, way, t, x, v, err);
    }
    for (size_t k = 0; k < number; k++) {
        const size_t f = functions[k] - s->own.functions;
        char one[80];
        s->of[f] = true;
        print(s, f, one, sizeof one);
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

/* Sides of a state that did not come by motion. They decide the acceleration, which decides where an argument moves
 * that is 0; and they may stand within one another. Where they find no end, as at rest at 0 under -2 sign(x) -
 * sign(x'), those that change are held together. */
static motus_status settle(void *ctx, double way, double t, double *x, double *v, motus_error *err)
{
    sides *s = ctx;
    const size_t count = s->switches->count;
    double *side = x + s->switches->slot;
    motus_status status = MOTUS_OK;
    bool settled = false;
    s->way = way;
    memset(s->of, 0, count * sizeof *s->of);
    for (int pass = 0; pass < NESTED && status == MOTUS_OK && !settled; pass++) {
        memcpy(s->kept, side, count * sizeof *side);
        for (size_t k = 0; k < count && status == MOTUS_OK; k++) {
            run(s, s->argument, t, x, v, NULL, s->now);
            run(s, s->rounding, t, x, v, NULL, s->bound);
            status = place(s, k, s->now[k], 0x1p-53 * s->bound[k], way, t, x, v, err);
        }
        settled = pass > 0 && memcmp(s->kept, side, count * sizeof *side) == 0;
        for (size_t k = 0; k < count; k++) s->of[k] |= pass >= NESTED - 6 && s->kept[k] != side[k] && !follows(s, k);
    }
    return status != MOTUS_OK || settled ? status : stand_together(s, s->of, way, t, x, v, &settled, err);
}

/* ---- making ---- */

/* The distance of a whole part from leaving its side is (u - p) (p + 1 - u), of which both factors are bounded. */
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
        const bool counts = switches_counts(op_of(s, w->first[k]));
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
    double *room = arena_room(m->arena, (12 * w->count + nx + 4 * nv + 1) * sizeof *room);
    s->rule = arena_room(m->arena, (own + w->kinds) * sizeof *s->rule);
    s->beside = arena_room(m->arena, w->count + 1);
    s->of = arena_room(m->arena, 2 * (w->count + 1) * sizeof *s->of);
    if (!room || !s->rule || !s->beside || !s->of) return false;
    s->covered = s->of + w->count;
    s->u = room, s->du = s->u + w->count, s->later = s->du + w->count;
    s->before = s->later + w->count, s->now = s->before + w->count, s->bound = s->now + w->count;
    s->p = s->bound + w->count, s->dp = s->p + w->count;
    s->r = s->dp + w->count, s->dr = s->r + w->count, s->kept = s->dr + w->count;
    s->a = s->kept + w->count, s->b = s->a + nv, s->v = s->b + nv, s->push = s->v + nv;
    s->x = s->push + nv, s->was = s->x + nx;
    s->way = 1;
    for (size_t k = 0; k < w->kinds; k++)
        s->rule[own + k] = (rule){.name = "a switch",
                                  .kind = RULE_ROOT,
                                  .direction = -1,
                                  .first = s->own.functions + w->first[k],
                                  .leaves = 1,
                                  .instances = switches_cells(w, k),
                                  .assigns = true,
                                  .internal = true};
    s->supplied = s->own;
    s->supplied.ctx = s;
    s->supplied.rule = s->rule;
    s->supplied.count = own + w->kinds;
    s->supplied.functions = s->own.functions + w->count;
    s->supplied.values = values;
    s->supplied.rates = rates;
    s->supplied.rates_without_a = false;
    s->supplied.rounding = rounding;
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
    run(s, s->grip, t, s->x, s->v, NULL, s->r);
    for (size_t k = 0; k < s->switches->count && !rubs; k++) {
        const parts of = parts_of(s, k);
        rubs = of.count && !silent(s, k);
        for (int i = 0; i < of.count; i++) rubs &= s->r[of.of[i]] < 0;
    }
    return rubs;
}

const rules *sides_rules(const sides *s) { return &s->supplied; }

bool sides_rebind(sides *s)
{
    const binding b = {s->model->arrays, s->model->ints, s->model->pool};
    tape *const tapes[] = {s->argument,      s->rate,        s->rounding,  s->force_rounding,
                           s->least,         s->least_rates, s->hold,      s->hold_rate,
                           s->hold_rounding, s->grip,        s->grip_rate, s->grip_rounding};
    for (size_t k = 0; k < sizeof tapes / sizeof *tapes; k++)
        if (tapes[k] && !tape_bind(tapes[k], &b)) return false;
    /* the periods of clocks depend on parameters */
    if (s->own.count) memcpy(s->rule, s->own.rule, s->own.count * sizeof *s->rule);
    return true;
}
