/* See resolution.h. Interval arithmetic over the nodes of a graph, in their order. */
#include "lang/model/resolution.h"

#include "lang/base/operation.h"
#include "lang/graph/graph_walk.h"

#include <math.h>
#include <string.h>

/* Scales, in units of the argument. */
#define WIDE 1.0   /* of exp, sinh, cosh, tanh, erf, atan */
#define WAVE 1.5   /* of sin, cos, tan: a quarter of a turn */
#define FLAT -50.0 /* exp is nothing below this */
#define EDGE 8.0   /* tanh, erf and atan hardly change beyond this */
#define RATIO 2.0  /* by which a divisor, or the base of a power, may change */
#define POLE 1e-3  /* a divisor that may become this part of itself, may become 0 */

typedef struct step {
    uint8_t op;
    uint32_t operand[3]; /* earlier steps */
    size_t at;           /* LOAD, PARAM: the place in its space */
    space space;
    double value;
} step;

struct resolution {
    step *steps;
    interval *values;
    uint32_t count;
};

/* Making it -------------------------------------------------------------------------------------------------- */

static size_t place_of(const model *m, const reference *r)
{
    const array *a = &m->arrays[r->array];
    int64_t at = (int64_t)a->base;
    for (int d = 0; d < r->dims; d++) {
        const subscript *s = &r->at[d];
        int64_t k = s->literal + (s->slot >= 0 ? m->ints[s->slot] : 0);
        if (s->modulus >= 0) k = 1 + (k % m->ints[s->modulus] + m->ints[s->modulus]) % m->ints[s->modulus];
        at += (k - a->over->first[d]) * a->over->stride[d];
    }
    return (size_t)at;
}

/* waves: sin, cos and tan count, since they may decide a switch. */
static bool hides(operation op, bool waves)
{
    switch (op) {
    case OP_SIN:
    case OP_COS:
    case OP_TAN: return waves;
    case OP_EXP:
    case OP_SINH:
    case OP_COSH:
    case OP_TANH:
    case OP_ERF:
    case OP_ATAN:
    case OP_DIV:
    case OP_POW: return true;
    default: return false;
    }
}

static bool hides_plain(operation op) { return hides(op, false); }
static bool hides_waves(operation op) { return hides(op, true); }

/* Whether an operation has poles. */
static bool has_poles(operation op) { return op == OP_DIV || op == OP_POW || op == OP_LOG || op == OP_TAN; }

static bool create(model *m, const output *outputs, size_t count, bool (*counts)(operation), resolution **out)
{
    graph *g = m->graph;
    graph_walk w;
    *out = NULL;
    node *roots = arena_room(m->arena, (count + 1) * sizeof *roots);
    if (!roots) return false;
    for (size_t i = 0; i < count; i++) {
        roots[i] = outputs[i].value;
        if (outputs[i].loops) return true;
    }
    if (!graph_order(g, roots, count, 0, false, &w)) return false;
    bool any = false, scalar = true;
    for (uint32_t k = 0; k < w.count; k++) {
        const graph_node *n = &g->nodes[w.nodes[k]];
        scalar &= n->op != OP_SUM && n->op != OP_INDEX && !(n->deps & (DEP_LEVELS | DEP_A | DEP_D));
        const node varies = n->op == OP_DIV ? n->b : n->a;
        any |= counts((operation)n->op) && g->nodes[varies].deps & (DEP_TIME | DEP_STATE);
    }
    if (any && scalar) {
        resolution *r = arena_take(m->arena, sizeof *r);
        step *steps = arena_room(m->arena, w.count * sizeof *steps);
        interval *values = arena_room(m->arena, w.count * sizeof *values);
        for (uint32_t k = 0; r && steps && values && k < w.count; k++) {
            const graph_node *n = &g->nodes[w.nodes[k]];
            node operand[3] = {0};
            step *s = &steps[k];
            *s = (step){.op = n->op, .value = n->op == OP_CONST ? n->value : 0};
            for (int j = graph_operands(n, operand); j-- > 0;) s->operand[j] = g->place[operand[j]];
            if (n->op == OP_PARAM) s->space = SPACE_POOL, s->at = n->a;
            if (n->op != OP_LOAD) continue;
            const reference *ref = &g->references[n->a];
            s->space = g->arrays[ref->array].space;
            s->at = place_of(m, ref);
        }
        if (r && steps && values) *r = (resolution){steps, values, w.count};
        *out = m->arena->failed ? NULL : r;
    }
    give(&g->arena->allocator, w.nodes);
    return !m->arena->failed;
}

bool resolution_create(model *m, const output *outputs, size_t count, bool switched, resolution **out)
{
    return create(m, outputs, count, switched ? hides_waves : hides_plain, out);
}

bool resolution_create_poles(model *m, const output *outputs, size_t count, resolution **out)
{
    return create(m, outputs, count, has_poles, out);
}

/* Intervals --------------------------------------------------------------------------------------------------- */

static interval hull(interval a, interval b) { return (interval){fmin(a.low, b.low), fmax(a.high, b.high)}; }
static interval truth(bool may, bool must) { return (interval){must, may || must}; }

static interval product(interval a, interval b)
{
    const double p[4] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    interval r = {INFINITY, -INFINITY};
    for (int k = 0; k < 4; k++) {
        const double q = isnan(p[k]) ? 0 : p[k]; /* 0 times infinity */
        r = hull(r, (interval){q, q});
    }
    return r;
}

static interval magnitude(interval a)
{
    if (a.low >= 0) return a;
    if (a.high <= 0) return (interval){-a.high, -a.low};
    return (interval){0, fmax(-a.low, a.high)};
}

static interval even(operation op, interval a)
{
    const interval m = magnitude(a);
    return (interval){operation_value(op, m.low, 0, 0), operation_value(op, m.high, 0, 0)};
}

static bool passes(interval a, double at, double period) /* whether a contains at + k period */
{
    return floor((a.high - at) / period) > floor((a.low - at) / period) || a.low == at;
}

static const double half_turn = 3.14159265358979323846;

static interval wave(interval a, double top) /* 1 at top + 2πk, -1 between */
{
    if (!(a.high - a.low < 2 * half_turn)) return (interval){-1, 1};
    const double p = operation_value(OP_COS, a.low - top, 0, 0), q = operation_value(OP_COS, a.high - top, 0, 0);
    interval r = {fmin(p, q), fmax(p, q)};
    if (passes(a, top, 2 * half_turn)) r.high = 1;
    if (passes(a, top + half_turn, 2 * half_turn)) r.low = -1;
    return r;
}

static const interval anything = {-INFINITY, INFINITY};

static interval falling(operation op, interval a)
{
    return (interval){operation_value(op, a.high, 0, 0), operation_value(op, a.low, 0, 0)};
}

static interval rising(operation op, interval a)
{
    return (interval){operation_value(op, a.low, 0, 0), operation_value(op, a.high, 0, 0)};
}

static interval corners(operation op, interval a, interval b)
{
    interval r = {INFINITY, -INFINITY};
    for (int k = 0; k < 4; k++) {
        const double y = operation_value(op, k & 1 ? a.high : a.low, k & 2 ? b.high : b.low, 0);
        if (isnan(y)) return anything;
        r = hull(r, (interval){y, y});
    }
    return r;
}

/* The interval of one operation; same: both operands are the same node. */
static interval value(operation op, interval a, interval b, interval c, bool same)
{
    switch (op) {
    case OP_NEG: return (interval){-a.high, -a.low};
    case OP_ADD: return (interval){a.low + b.low, a.high + b.high};
    case OP_SUB: return (interval){a.low - b.high, a.high - b.low};
    case OP_MUL: return same ? product(magnitude(a), magnitude(a)) : product(a, b);
    case OP_DIV: return b.low > 0 || b.high < 0 ? product(a, (interval){1 / b.high, 1 / b.low}) : anything;
    case OP_LT:
    case OP_LE: return truth(a.low <= b.high, a.high < b.low);
    case OP_GT:
    case OP_GE: return truth(a.high >= b.low, a.low > b.high);
    case OP_EQ: return truth(a.low <= b.high && b.low <= a.high, false);
    case OP_NE: return truth(true, a.low > b.high || a.high < b.low);
    case OP_AND: return truth(a.high != 0 && b.high != 0, a.low != 0 && b.low != 0);
    case OP_OR: return truth(a.high != 0 || b.high != 0, a.low != 0 || b.low != 0);
    case OP_NOT: return truth(a.low == 0, a.high == 0);
    case OP_SELECT: return a.low > 0 || a.high < 0 ? b : a.low == 0 && a.high == 0 ? c : hull(b, c);
    case OP_SIN: return wave(a, half_turn / 2);
    case OP_COS: return wave(a, 0);
    case OP_TAN: return a.high - a.low >= half_turn || passes(a, half_turn / 2, half_turn) ? anything : rising(op, a);
    case OP_ACOS: return falling(op, a);
    case OP_COSH:
    case OP_ABS: return even(op, a);
    case OP_LOG: return a.low > 0 ? rising(op, a) : anything;
    case OP_SQRT: return a.low >= 0 ? rising(op, a) : anything;
    case OP_POW: return a.low > 0 ? corners(op, a, b) : anything;
    case OP_HYPOT: return corners(op, magnitude(a), magnitude(b));
    case OP_ATAN2: return b.low > 0 ? corners(op, a, b) : (interval){-half_turn, half_turn};
    case OP_MIN:
    case OP_MAX: return corners(op, a, b);
    case OP_MOD: {
        const interval q = value(OP_DIV, a, b, c, false);
        return floor(q.low) == floor(q.high) ? value(OP_SUB, a, product(b, rising(OP_FLOOR, q)), c, false)
                                             : hull((interval){0, 0}, b);
    }
    case OP_ASIN:
    case OP_ATAN:
    case OP_SINH:
    case OP_TANH:
    case OP_EXP:
    case OP_CBRT:
    case OP_FLOOR:
    case OP_SIGN:
    case OP_ERF: return rising(op, a);
    default: return anything;
    }
}

static bool changes(interval a)
{
    const interval m = magnitude(a);
    return !(m.low > 0 && m.high <= RATIO * m.low);
}

/* Whether an operation with these arguments may hide something. */
static bool hidden(operation op, interval a, interval b)
{
    const bool wide = !(a.high - a.low <= WIDE);
    switch (op) {
    case OP_EXP: return wide && a.high > FLAT;
    case OP_SINH:
    case OP_COSH: return wide;
    case OP_TANH:
    case OP_ERF:
    case OP_ATAN: return wide && a.low < EDGE && a.high > -EDGE;
    case OP_SIN:
    case OP_COS:
    case OP_TAN: return !(a.high - a.low <= WAVE);
    case OP_DIV: return changes(b);
    case OP_POW: return b.low < 1 && changes(a);
    default: return false;
    }
}

/* Whether a may be 0, or so near to it as it is small beside its largest values. */
static bool near_zero(interval a)
{
    const interval m = magnitude(a);
    return !(m.low > POLE * m.high);
}

/* Whether an operation with these arguments may be at a pole. */
static bool pole(operation op, interval a, interval b)
{
    switch (op) {
    case OP_DIV: return near_zero(b);
    case OP_POW: return b.low < 0 && near_zero(a);
    case OP_LOG: return a.low <= 0 || near_zero(a);
    case OP_TAN: return !(a.high - a.low < half_turn) || passes(a, half_turn / 2, half_turn);
    default: return false;
    }
}

/* Whether an operation is found with arguments in the intervals. */
static bool finds(resolution *r, interval t, const interval *x, const interval *v, const double *pool,
                  bool (*found)(operation, interval, interval))
{
    for (uint32_t k = 0; k < r->count; k++) {
        const step *s = &r->steps[k];
        const interval none = {0, 0};
        switch ((operation)s->op) {
        case OP_CONST: r->values[k] = (interval){s->value, s->value}; continue;
        case OP_TIME: r->values[k] = t; continue;
        case OP_PARAM: r->values[k] = (interval){pool[s->at], pool[s->at]}; continue;
        case OP_LOAD:
            r->values[k] = s->space == SPACE_X   ? x[s->at]
                           : s->space == SPACE_V ? v[s->at]
                                                 : (interval){pool[s->at], pool[s->at]};
            continue;
        default: break;
        }
        const int arity = operation_at((operation)s->op)->arity;
        const interval a = r->values[s->operand[0]], b = arity > 1 ? r->values[s->operand[1]] : none,
                       c = arity > 2 ? r->values[s->operand[2]] : none;
        if (found((operation)s->op, a, b)) return true;
        r->values[k] = value((operation)s->op, a, b, c, arity > 1 && s->operand[0] == s->operand[1]);
    }
    return false;
}

bool resolution_fits(resolution *r, interval t, const interval *x, const interval *v, const double *pool)
{
    return !finds(r, t, x, v, pool, hidden);
}

bool resolution_pole(resolution *r, interval t, const interval *x, const interval *v, const double *pool)
{
    return finds(r, t, x, v, pool, pole);
}
