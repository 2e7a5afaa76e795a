/* See resolution.h. Nodes are evaluated in interval arithmetic, each only when another one needs it, so a branch that
 * is not taken and a term that is left out hide nothing.
 */
#include "lang/model/resolution.h"

#include "lang/graph/graph_place.h"
#include "lang/graph/graph_walk.h"

#include <math.h>

/* Scales on which operations change, in units of their arguments. */
#define WIDE 1.0   /* the scale of exp, sinh, cosh, tanh, erf, atan */
#define WAVE 1.5   /* the scale of sin, cos, tan: a quarter of a turn */
#define FLAT -50.0 /* below this, exp counts as 0 */
#define EDGE 8.0   /* beyond this, tanh, erf and atan hardly change */
#define RATIO 2.0  /* by what factor a divisor, or the base of a power, may change */
#define STEEP 8.0  /* an exponent above this makes a peak where the power changes by more than e to this */
#define FAR 8.0    /* by what factor an argument may change that is far from a pole or branch point at 0 */
#define POLE 1e-3  /* a divisor that may shrink to this part of itself may become 0 */

/* What an operation within a value may hide. HIDING: something. GROWS: something that grows as exp does, which counts
 * for nothing if it is a large divisor. */
enum { HIDING = 1, GROWS = 2 };

#define NO_STEP UINT32_MAX

/* A node. Its interval is known while no loop variable that it depends on has changed; the innermost of these changes
 * whenever one further out does. */
typedef struct step {
    graph_node node;
    uint32_t operand[3]; /* earlier steps */
    uint8_t arity;       /* 0 for a sum, which evaluates its operands itself */
    bool counts;         /* it is an operation that is looked for */
    bool bends;          /* it is no polynomial of low degree in time and state */
    bool divides;        /* it is part of a divisor, or of the base of a power */
    uint8_t taint;       /* what it may hide, in the intervals */
    uint32_t base;       /* a product of powers of one step is base^power; else power is 1 */
    double power;
    int home;       /* 1 + the innermost level that it depends on; 0: none */
    uint64_t known; /* when the interval was computed */
    interval interval;
} step;

struct resolution {
    const model *model;
    const output *outputs;
    size_t count;
    step *steps;
    uint32_t step_count;
    bool straight;   /* every step is evaluated once, in order: there are no loops, sums or branches */
    uint32_t *root;  /* by output */
    uint32_t *stack; /* the steps that wait for their operands */
    uint32_t top;
    int64_t index[MAX_LEVELS];
    uint64_t now, changed[MAX_LEVELS + 1]; /* by home: when the loop variable changed */
    bool (*found)(operation, interval, interval);
    interval *part; /* room for a part of a box */
    /* the box that is looked at */
    interval t, *x, *v, *a, *out; /* a, out: for resolution_values alone */
    const double *pool;
};

/* Creating --------------------------------------------------------------------------------------------------------- */

/* waves: sin, cos and tan count, too, since they may decide a switch. */
static bool hides(operation op, bool waves) { return operation_is(op, HIDES) || (waves && operation_is(op, WAVES)); }

static bool hides_plain(operation op) { return hides(op, false); }
static bool hides_waves(operation op) { return hides(op, true); }

static bool has_poles(operation op) { return operation_is(op, HAS_POLE); }

static bool leaps(operation op) { return operation_is(op, JUMPS); }

/* Returns whether an operation may leave its value open, for an argument in an interval (see doubt). */
static bool doubtful(operation op)
{
    return operation_at(op)->nature & (JUMPS | HAS_POLE | STEEP_AT_0 | STEEP_AT_ENDS);
}

/* Returns whether an operation that counts has an argument that moves. */
static bool any_counts(const resolution *r, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++) {
        const step *s = &r->steps[k];
        unsigned deps = r->steps[s->operand[s->node.op == OP_DIV]].node.deps;
        if (s->node.op == OP_POW) deps |= r->steps[s->operand[1]].node.deps;
        if (s->counts && deps & (DEP_TIME | DEP_STATE)) return true;
    }
    return false;
}

/* Recognises products that raise a number to a whole power. */
static void find_power(resolution *r, uint32_t k)
{
    step *s = &r->steps[k];
    const step *p = &r->steps[s->operand[0]], *q = &r->steps[s->operand[1]];
    s->base = k;
    s->power = 1;
    if (s->node.op != OP_MUL || p->base != q->base) return;
    s->base = p->base;
    s->power = p->power + q->power;
}

static int home_of(const graph_node *n)
{
    int home = 0;
    for (int level = 0; level < MAX_LEVELS; level++)
        if (n->deps >> level & 1) home = level + 1;
    return home;
}

/* Returns whether a step is no polynomial of low degree; its operands are known. */
static bool bends(const resolution *r, const step *s, int operands)
{
    const unsigned moves = DEP_TIME | DEP_STATE;
    const degree_rule rule = (degree_rule)operation_at((operation)s->node.op)->degree;
    if (!(s->node.deps & moves)) return false;
    bool any = rule == DEGREE_QUOTIENT ? r->steps[s->operand[1]].node.deps & moves : rule > DEGREE_PRODUCT;
    any |= s->power > STEEP;
    for (int j = 0; j < operands; j++) any |= r->steps[s->operand[j]].bends;
    return any;
}

static bool is_straight(const resolution *r)
{
    bool is = true;
    for (uint32_t k = 0; k < r->step_count && is; k++)
        is = r->steps[k].node.op != OP_SUM && r->steps[k].node.op != OP_SELECT && r->steps[k].home == 0;
    for (size_t k = 0; k < r->count && is; k++) {
        const space to = r->model->arrays[r->outputs[k].to.array].space;
        is = r->outputs[k].loops == 0 && to != SPACE_X && to != SPACE_V;
    }
    return is;
}

/* Marks the steps within a divisor or a base. */
static void find_divisors(resolution *r)
{
    for (uint32_t k = r->step_count; k-- > 0;) {
        const step *s = &r->steps[k];
        const int arity = s->node.op == OP_SUM ? 2 : s->arity;
        for (int j = 0; j < arity; j++) {
            const bool here = (s->node.op == OP_DIV && j == 1) || (s->node.op == OP_POW && j == 0);
            if ((here || s->divides) && s->operand[j] < k) r->steps[s->operand[j]].divides = true;
        }
    }
}

static void fill(resolution *r, graph *g, const graph_walk *w, bool (*counts)(operation))
{
    for (uint32_t k = 0; k < w->count; k++) {
        node operand[3] = {0};
        step *s = &r->steps[k];
        *s = (step){.node = g->nodes[w->nodes[k]]};
        s->home = home_of(&s->node);
        s->counts = counts && counts((operation)s->node.op);
        s->arity = s->node.op == OP_SUM ? 0 : operation_at((operation)s->node.op)->arity;
        const int operands = graph_operands(&s->node, operand);
        for (int j = 0; j < operands; j++) s->operand[j] = g->place[operand[j]];
        find_power(r, k);
        if (s->power > STEEP) s->counts = counts && counts(OP_POW);
        s->bends = bends(r, s, operands);
    }
    find_divisors(r);
    for (size_t k = 0; k < r->count; k++) r->root[k] = g->place[r->outputs[k].value];
    r->straight = is_straight(r);
}

/* Lets directions not count as poles: where its vector is 0, a direction jumps but has no pole. */
static void spare_directions(resolution *r, const graph *g, const graph_walk *w)
{
    for (uint32_t k = 0; k < w->count; k++) {
        graph_directed d;
        step *s = &r->steps[k];
        if (!graph_direction(g, w->nodes[k], &d)) continue;
        for (int j = 0; j < s->arity && s->node.op == OP_MUL; j++) {
            step *quotient = &r->steps[s->operand[j]];
            if (quotient->node.op == OP_DIV && quotient->node.b == d.divisor) quotient->counts = false;
        }
        if (s->node.op == OP_DIV) s->counts = false;
    }
}

/* counts NULL: nothing is looked for, and values are computed. */
static bool create(model *m, const output *outputs, size_t count, bool (*counts)(operation), resolution **out)
{
    graph *g = m->graph;
    graph_walk w;
    *out = NULL;
    node *roots = arena_room(m->arena, (count + 1) * sizeof *roots);
    if (!roots) return false;
    for (size_t i = 0; i < count; i++) roots[i] = outputs[i].value;
    if (!graph_order(g, roots, count, 0, true, &w)) return false;
    resolution *r = arena_take(m->arena, sizeof *r);
    step *steps = arena_room(m->arena, w.count * sizeof *steps);
    uint32_t *stack = arena_room(m->arena, (w.count + 1) * sizeof *stack);
    uint32_t *root = arena_room(m->arena, (count + 1) * sizeof *root);
    if (r && steps && stack && root) {
        *r = (resolution){.model = m,
                          .outputs = outputs,
                          .count = count,
                          .steps = steps,
                          .step_count = w.count,
                          .root = root,
                          .stack = stack};
        fill(r, g, &w, counts);
        if (counts == has_poles) spare_directions(r, g, &w);
        if (!counts || counts == doubtful || any_counts(r, w.count)) *out = r;
    }
    give(&g->arena->allocator, w.nodes);
    return !m->arena->failed;
}

bool resolution_create(model *m, const output *outputs, size_t count, bool switched, resolution **out)
{
    return create(m, outputs, count, switched ? hides_waves : hides_plain, out);
}

bool resolution_create_values(model *m, const output *outputs, size_t count, resolution **out)
{
    return create(m, outputs, count, NULL, out);
}

bool resolution_create_poles(model *m, const output *outputs, size_t count, resolution **out)
{
    return create(m, outputs, count, has_poles, out);
}

bool resolution_create_doubts(model *m, const output *outputs, size_t count, resolution **out)
{
    if (!create(m, outputs, count, doubtful, out)) return false;
    (*out)->part = arena_room(m->arena, (m->nx + m->nv + 1) * sizeof(interval));
    return (*out)->part != NULL;
}

/* What an operation may do ----------------------------------------------------------------------------------------- */

static bool changes(interval a)
{
    const interval m = interval_magnitude(a);
    return !(m.low > 0 && m.high <= RATIO * m.low);
}

/* Returns whether a high power of a hides a peak, unless the power counts as 0, like exp below FLAT. */
static bool steep(interval a, double power)
{
    const interval m = interval_magnitude(a);
    return power > STEEP && power * log(m.high) > FLAT && !(power * log(m.high / m.low) <= STEEP);
}

/* Returns whether a^b, whose exponent varies, may hide a peak, as exp(b log a) does. */
static bool hides_power(interval a, interval b)
{
    const interval m = interval_magnitude(a);
    const double low = log(m.low), high = log(m.high);
    if (!(b.low < b.high)) return false;
    if (!isfinite(low) || !isfinite(high)) return true;
    const double least = fmin(fmin(b.low * low, b.low * high), fmin(b.high * low, b.high * high)),
                 most = fmax(fmax(b.low * low, b.low * high), fmax(b.high * low, b.high * high));
    return !(most - least <= WIDE) && most > FLAT;
}

/* Returns whether an operation with these arguments may hide something. */
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
    case OP_POW: return (b.low < 0 && changes(a)) || steep(a, b.high) || hides_power(a, b);
    default: return operation_is(op, HIDES) && wide;
    }
}

static bool grows(operation op) { return op == OP_EXP || op == OP_SINH || op == OP_COSH || op == OP_POW; }

/* Returns whether the divisor or base of a step, which may hide something that grows, is so large that the step counts
 * as 0, like exp below FLAT. */
static bool vanishes(operation op, uint8_t taint, interval a, interval b)
{
    if (!(taint & GROWS)) return false;
    if (op == OP_DIV) return log(interval_magnitude(b).low) >= -FLAT;
    return op == OP_POW && b.high < 0 && -b.high * log(interval_magnitude(a).low) >= -FLAT;
}

/* Returns whether a is nowhere small beside its largest values, so that a pole or a branch point at 0 is far. */
static bool far_from_zero(interval a)
{
    const interval m = interval_magnitude(a);
    return m.low > 0 && m.high <= FAR * m.low;
}

/* Returns whether a may be 0, or small beside its largest values. */
static bool near_zero(interval a)
{
    const interval m = interval_magnitude(a);
    return !(m.low > POLE * m.high);
}

/* Returns whether an operation with these arguments may be at a pole. */
static bool pole(operation op, interval a, interval b)
{
    switch (op) {
    case OP_DIV: return near_zero(b);
    case OP_POW: return b.low < 0 && near_zero(a);
    case OP_LOG: return a.low <= 0 || near_zero(a);
    case OP_TAN: return isinf(interval_value(op, a, b, b, false).low);
    default: return false;
    }
}

/* Returns whether an operation with these arguments may lie on either side of a jump. */
static bool undecided(operation op, interval a, interval b)
{
    const bool zero = a.low <= 0 && a.high >= 0;
    const interval none = {0, 0};
    interval side;
    switch (op) {
    case OP_ATAN2: return zero && b.low < 0;
    case OP_SELECT: return zero && a.low < a.high;
    case OP_MOD: side = interval_value(OP_DIV, a, b, none, false); return !(floor(side.low) == floor(side.high));
    default: side = interval_value(op, a, b, none, false); return !(side.low == side.high);
    }
}

/* Returns whether an angle turns by little: one leg is far from 0, and the other changes by no more than that leg. */
static bool turns_little(interval far, interval other)
{
    return far_from_zero(far) && other.high - other.low <= interval_magnitude(far).low;
}

bool resolution_regular(operation op, interval a, interval b)
{
    switch (op) {
    case OP_ABS: return a.low > 0 || a.high < 0;
    case OP_MIN:
    case OP_MAX: return a.high < b.low || b.high < a.low;
    case OP_DIV: return far_from_zero(b);
    case OP_SQRT:
    case OP_LOG:
    case OP_CBRT: return far_from_zero(a);
    case OP_HYPOT: return far_from_zero(a) || far_from_zero(b);
    case OP_POW: return b.low == b.high && fabs(b.low) <= STEEP && far_from_zero(a);
    case OP_ATAN2: return turns_little(a, b) || (b.low > 0 && turns_little(b, a));
    case OP_ASIN:
    case OP_ACOS: return interval_magnitude(a).high < 1 - 1 / FAR;
    case OP_TAN: return !pole(op, a, b) && !hidden(op, a, b);
    default: return leaps(op) ? !undecided(op, a, b) : hides_waves(op) && !hidden(op, a, b);
    }
}

static bool single(interval a) { return a.low == a.high; }
static bool may_be_zero(interval a) { return a.low <= 0 && a.high >= 0; }

static bool may_divide_by_zero(operation op, interval b) { return op == OP_DIV && may_be_zero(b) && !single(b); }

static bool doubt_pole(operation op, interval a, interval b)
{
    switch (op) {
    case OP_DIV: return may_divide_by_zero(op, b) && !may_be_zero(a);
    case OP_POW: return b.low < 0 && may_be_zero(a) && !single(a);
    case OP_LOG: return may_be_zero(a) && !single(a);
    default: return op == OP_TAN && !single(a) && pole(op, a, b);
    }
}

/* Returns whether a pole shows. A dividend that is nearer to 0 than it changes may be 0 but for its rounding. */
static bool shows_pole(operation op, interval a, interval b)
{
    return may_divide_by_zero(op, b) && interval_magnitude(a).low > a.high - a.low;
}

static bool zero_by_zero(operation op, interval a, interval b)
{
    return may_divide_by_zero(op, b) && !shows_pole(op, a, b);
}

static bool doubt_jump(operation op, interval a, interval b)
{
    return op == OP_DIV ? may_divide_by_zero(op, b) : leaps(op) && undecided(op, a, b);
}

static bool doubt_steep(operation op, interval a, interval b)
{
    const bool moves = op == OP_DIV ? !single(b) : !single(a) || (op == OP_POW && !single(b));
    if (!moves || leaps(op) || (op == OP_POW && single(b) && b.low >= 1)) return false;
    return !resolution_regular(op, a, b);
}

/* Evaluating ------------------------------------------------------------------------------------------------------- */

static bool is_zero(interval a) { return a.low == 0 && a.high == 0; }

static bool known(const resolution *r, uint32_t k) { return r->steps[k].known >= r->changed[r->steps[k].home]; }

static void set_index(resolution *r, int level, int64_t value)
{
    r->index[level] = value;
    r->changed[level + 1] = ++r->now;
}

/* Returns the operand that a step needs next; NO_STEP: it has all. */
static uint32_t lacks(const resolution *r, const step *s)
{
    const operation op = (operation)s->node.op;
    for (int j = 0; j < s->arity; j++) {
        if (op == OP_SELECT && j > 0) {
            const interval c = r->steps[s->operand[0]].interval;
            if (j == 1 ? is_zero(c) : !may_be_zero(c)) continue;
        }
        if (!known(r, s->operand[j])) return s->operand[j];
    }
    return NO_STEP;
}

static interval number(double value) { return (interval){value, value}; }

static interval place_in(const interval *of, size_t at) { return of ? of[at] : (interval){-INFINITY, INFINITY}; }

static interval load(const resolution *r, const graph_node *n)
{
    const reference *ref = &r->model->graph->references[n->a];
    const array *arrays = r->model->arrays;
    const size_t at = graph_element(arrays, ref, r->index, r->model->ints);
    switch (arrays[ref->array].space) {
    case SPACE_X: return place_in(r->x, at);
    case SPACE_V: return place_in(r->v, at);
    case SPACE_A: return place_in(r->a, at);
    case SPACE_POOL: return number(r->pool[at]);
    default: return place_in(NULL, at);
    }
}

static bool evaluate(resolution *, uint32_t root);

/* Evaluates a sum; its operands are its body and, if it has one, the condition on its terms. */
static bool sum(resolution *r, step *s)
{
    const graph_node *n = &s->node;
    const range *over = &r->model->graph->ranges[n->c];
    const int64_t *ints = r->model->ints;
    const int64_t last = graph_subscript(&over->last, r->index, ints);
    interval total = {0, 0};
    s->taint = 0;
    for (int64_t i = graph_subscript(&over->first, r->index, ints); i <= last; i++) {
        interval condition = {1, 1};
        set_index(r, n->level, i);
        if (n->b) {
            if (!evaluate(r, s->operand[1])) return false;
            condition = r->steps[s->operand[1]].interval;
            s->taint |= r->steps[s->operand[1]].taint;
        }
        if (is_zero(condition)) continue;
        if (!evaluate(r, s->operand[0])) return false;
        interval term = r->steps[s->operand[0]].interval;
        s->taint |= r->steps[s->operand[0]].taint;
        if (may_be_zero(condition)) term = interval_hull(term, number(0));
        total = interval_value(OP_ADD, total, term, total, false);
    }
    s->interval = total;
    return true;
}

/* Returns what the operands of a step may hide; a branch that is not taken hides nothing. */
static uint8_t taint_of(const resolution *r, const step *s)
{
    uint8_t taint = 0;
    for (int j = 0; j < s->arity; j++) {
        const interval c = r->steps[s->operand[0]].interval;
        if (s->node.op == OP_SELECT && (j == 1 ? is_zero(c) : j == 2 && !may_be_zero(c))) continue;
        taint |= r->steps[s->operand[j]].taint;
    }
    return taint;
}

/* Computes a step whose operands are known. False: what is looked for was found. A step within a divisor that may hide
 * something has a `taint` instead. */
static bool compute(resolution *r, step *s)
{
    const graph_node *n = &s->node;
    const operation op = (operation)n->op;
    s->taint = 0;
    switch (op) {
    case OP_CONST: s->interval = number(n->value); return true;
    case OP_TIME: s->interval = r->t; return true;
    case OP_PARAM: s->interval = number(r->pool[n->a]); return true;
    case OP_INDEX: s->interval = number((double)r->index[n->level]); return true;
    case OP_LOAD: s->interval = load(r, n); return true;
    case OP_TABLE: s->interval = number(operation_table(r->pool + r->model->arrays[n->a].base)); return true;
    case OP_SUM: return sum(r, s);
    default: break;
    }
    const interval none = {0, 0}, a = r->steps[s->operand[0]].interval,
                   b = s->arity > 1 ? r->steps[s->operand[1]].interval : none,
                   c = s->arity > 2 ? r->steps[s->operand[2]].interval : none;
    const bool power = op == OP_MUL && s->power > STEEP;
    s->taint = taint_of(r, s);
    if (s->taint && vanishes(op, r->steps[s->operand[op == OP_DIV]].taint, a, b)) {
        s->taint = r->steps[s->operand[op == OP_POW]].taint;
    } else if (s->counts &&
               (power ? r->found(OP_POW, r->steps[s->base].interval, number(s->power)) : r->found(op, a, b))) {
        if (!s->divides || r->found != hidden) return false;
        s->taint |= grows(op) ? GROWS : HIDING;
    }
    s->interval = interval_value(op, a, b, c, s->arity > 1 && s->operand[0] == s->operand[1]);
    return true;
}

/* Makes a step known, with all that it needs. False: what is looked for was found. The stack has room for every path
 * through the graph. */
static bool evaluate(resolution *r, uint32_t root)
{
    const uint32_t base = r->top;
    r->stack[r->top++] = root;
    while (r->top > base) {
        step *s = &r->steps[r->stack[r->top - 1]];
        const bool done = s->known >= r->changed[s->home];
        const uint32_t next = done ? NO_STEP : lacks(r, s);
        if (next != NO_STEP) {
            r->stack[r->top++] = next;
            continue;
        }
        if (!done && !compute(r, s)) return false;
        s->known = r->now;
        r->top--;
    }
    return true;
}

/* Puts the value of an output into its place. A driven boundary cell may go further within a step than its ends
 * show. */
static void put(const resolution *r, const output *o, interval value)
{
    const array *arrays = r->model->arrays;
    const space space = arrays[o->to.array].space;
    const size_t at = graph_element(arrays, &o->to, r->index, r->model->ints);
    if (space == SPACE_X) r->x[at] = interval_hull(r->x[at], value);
    if (space == SPACE_V) r->v[at] = interval_hull(r->v[at], value);
    if (space == SPACE_OUT && r->out) r->out[at] = value;
}

/* Evaluates all cells of an output, from loop `level` on. False: what is looked for was found. */
static bool cells(resolution *r, size_t k, int level)
{
    const output *o = &r->outputs[k];
    if (level == o->loops) {
        if (!evaluate(r, r->root[k]) || r->steps[r->root[k]].taint) return false;
        put(r, o, r->steps[r->root[k]].interval);
        return true;
    }
    const int64_t *ints = r->model->ints, last = graph_subscript(&o->loop[level].last, r->index, ints);
    for (int64_t i = graph_subscript(&o->loop[level].first, r->index, ints); i <= last; i++) {
        set_index(r, level, i);
        if (!cells(r, k, level + 1)) return false;
    }
    return true;
}

static void begin(resolution *r, interval t, interval *x, interval *v, const double *pool,
                  bool (*found)(operation, interval, interval))
{
    r->t = t;
    r->x = x;
    r->v = v;
    r->a = r->out = NULL;
    r->pool = pool;
    r->found = found;
    r->top = 0;
    r->changed[0] = ++r->now;
}

/* Returns whether an operation is found with arguments in the intervals. */
static bool finds(resolution *r, interval t, interval *x, interval *v, const double *pool,
                  bool (*found)(operation, interval, interval))
{
    begin(r, t, x, v, pool, found);
    if (r->straight) {
        for (uint32_t k = 0; k < r->step_count; k++)
            if (!compute(r, &r->steps[k])) return true;
        for (size_t k = 0; k < r->count; k++)
            if (r->steps[r->root[k]].taint) return true;
        return false;
    }
    for (size_t k = 0; k < r->count; k++)
        if (!cells(r, k, 0)) return true;
    return false;
}

static bool nothing(operation op, interval a, interval b)
{
    (void)op, (void)a, (void)b;
    return false;
}

bool resolution_bends(const resolution *r, size_t output) { return r->steps[r->root[output]].bends; }

void resolution_values(resolution *r, interval t, interval *x, interval *v, interval *a, const double *pool,
                       interval *out)
{
    begin(r, t, x, v, pool, nothing);
    r->a = a;
    r->out = out;
    for (size_t k = 0; k < r->count; k++) cells(r, k, 0);
}

bool resolution_fits(resolution *r, interval t, interval *x, interval *v, const double *pool)
{
    return !finds(r, t, x, v, pool, hidden);
}

bool resolution_pole(resolution *r, interval t, interval *x, interval *v, const double *pool)
{
    return finds(r, t, x, v, pool, pole);
}

/* A line through a box, on which a pole is sought: 0/0 is a pole where the divisor is 0 and the dividend is not. Parts
 * of the line in which both may be 0 are halved while doubles tell their ends apart. */
typedef struct line {
    interval *x, *v; /* the box */
    uint32_t which;  /* 0: it goes from corner to corner */
} line;

static double fraction(uint32_t *random)
{
    *random = *random * 1664525u + 1013904223u;
    return (*random >> 8) * 0x1p-24;
}

/* Takes the part of a line between `from` and `to` of its length. False: it is too short. */
static bool part_of(const resolution *r, const line *l, double from, double to)
{
    enum { TELLS = 16 }; /* in units in the last place */
    const size_t nx = r->model->nx, n = nx + r->model->nv;
    uint32_t random = l->which * 2654435761u;
    bool wide = false;
    for (size_t k = 0; k < n; k++) {
        const interval in = k < nx ? l->x[k] : l->v[k - nx];
        double low = in.low, wide_by = in.high - in.low;
        if (l->which) {
            const double first = fraction(&random) / 4, last = 1 - fraction(&random) / 4;
            const bool back = fraction(&random) < 0.5;
            low += wide_by * (back ? last : first);
            wide_by *= back ? first - last : last - first;
        }
        r->part[k] = interval_hull(number(low + from * wide_by), number(low + to * wide_by));
        const double size = interval_magnitude(in).high, least = TELLS * (nextafter(size, INFINITY) - size);
        if (!(fabs(wide_by) > least)) continue;
        if (!(r->part[k].high - r->part[k].low > least)) return false;
        wide = true;
    }
    return wide;
}

static bool pole_on(resolution *r, interval t, const line *l, const double *pool, double from, double to, int *visits)
{
    interval *const v = r->part + r->model->nx;
    if (--*visits < 0 || !part_of(r, l, from, to)) return false;
    if (finds(r, t, r->part, v, pool, shows_pole)) return true;
    if (!part_of(r, l, from, to) || !finds(r, t, r->part, v, pool, zero_by_zero)) return false;
    const double middle = from + (to - from) / 2;
    if (!(from < middle && middle < to)) return false;
    return pole_on(r, t, l, pool, from, middle, visits) || pole_on(r, t, l, pool, middle, to, visits);
}

static bool hidden_pole(resolution *r, interval t, interval *x, interval *v, const double *pool)
{
    enum { LINES = 8, VISITS = 256 };
    if (!finds(r, t, x, v, pool, zero_by_zero)) return false;
    for (uint32_t k = 0; k < LINES; k++) {
        int visits = VISITS;
        if (pole_on(r, t, &(line){x, v, k}, pool, 0, 1, &visits)) return true;
    }
    return false;
}

doubt resolution_doubt(resolution *r, interval t, interval *x, interval *v, const double *pool)
{
    if (finds(r, t, x, v, pool, doubt_pole) || hidden_pole(r, t, x, v, pool)) return DOUBT_POLE;
    if (finds(r, t, x, v, pool, doubt_jump)) return DOUBT_JUMP;
    return finds(r, t, x, v, pool, doubt_steep) ? DOUBT_STEEP : DOUBT_NONE;
}
