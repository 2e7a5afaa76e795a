/* See undefined.h. All nodes of a formula are evaluated: at the state as in a run, and beside it with twice the bits.
 *
 * The limit of a term is sought on straight and bent ways that lead to the state from both sides. A limit counts only
 * if all of them agree in every digit of a double.
 */
#include "lang/model/undefined.h"

#include "base/decimal.h"
#include "base/memory.h"
#include "lang/graph/graph_place.h"
#include "lang/graph/graph_walk.h"
#include "lang/model/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    NODES_MOST = 4096,
    WAYS = 8,
    POINTS = 4,  /* on either side of a way, each half as far as the last */
    NEARER = -8, /* a power of 2: where the ways disagree, the farthest point comes so much nearer */
    NEAREST = -40,
    ROUNDED = 4 /* in units in the last place: how far equal numbers may differ */
};

typedef struct place {
    const model *model;
    const graph_walk *walk;
    double t;
    const double *x, *v;
    const int64_t *index; /* of the loops of the formula */
} place;

/* A way to the state, from the distance `by`. Numbers approach at rates of their own; on a bent way some go as the
 * square. */
typedef struct way {
    int which;
    bool bent;
    double by;
} way;

static twofold beside(double number, const way *w, size_t k)
{
    const uint32_t bits = (uint32_t)w->which * (uint32_t)(k + 1) * 2654435761u;
    const double rate = 1 + (bits >> 8 & 255) / 256.0, by = w->bent && bits >> 30 & 1 ? w->by * w->by : w->by;
    const twofold off = twofold_of(bits >> 31 ? -rate * by : rate * by);
    return w->by == 0 ? twofold_of(number) : twofold_value(OP_ADD, twofold_of(number), off, off);
}

static twofold leaf(const place *p, const graph_node *n, const way *w)
{
    const model *m = p->model;
    if (n->op == OP_CONST) return twofold_of(n->value);
    if (n->op == OP_PARAM) return twofold_of(m->pool[n->a]);
    if (n->op == OP_TIME) return beside(p->t, w, 0);
    if (n->op == OP_INDEX) return twofold_of((double)p->index[n->level]);
    if (n->op == OP_TABLE) return twofold_of(operation_table(m->pool + m->arrays[n->a].base));
    if (n->op != OP_LOAD) return twofold_of(NAN);
    const reference *ref = &m->graph->references[n->a];
    const size_t at = graph_element(m->arrays, ref, p->index, m->ints);
    switch (m->arrays[ref->array].space) {
    case SPACE_X: return beside(p->x[at], w, 1 + at);
    case SPACE_V: return beside(p->v[at], w, 1 + m->nx + at);
    case SPACE_POOL: return twofold_of(m->pool[at]);
    default: return twofold_of(NAN);
    }
}

/* Computes the values of all nodes up to this one, and returns the last. */
static twofold values(const place *p, size_t up_to, const way *w, twofold *out)
{
    const graph *g = p->model->graph;
    for (size_t k = 0; k <= up_to; k++) {
        node of[3];
        twofold a[3] = {twofold_of(0), twofold_of(0), twofold_of(0)};
        const graph_node *n = graph_at(g, p->walk->nodes[k]);
        const int count = graph_operands(n, of);
        for (int i = 0; i < count; i++) a[i] = out[g->place[of[i]]];
        if (count == 0)
            out[k] = leaf(p, n, w);
        else if (w->by == 0)
            out[k] = twofold_of(operation_value((operation)n->op, a[0].high, a[1].high, a[2].high));
        else
            out[k] = twofold_value((operation)n->op, a[0], a[1], a[2]);
    }
    return out[up_to];
}

/* Marks the nodes that a node reads, and returns how many of them move. value: that of all nodes, at a state in which
 * `if` reads only one side. */
static size_t mark(const place *p, size_t root, const twofold *value, bool *taken)
{
    const graph *g = p->model->graph;
    size_t moving = 0;
    memset(taken, 0, p->walk->count * sizeof *taken);
    taken[root] = true;
    for (size_t k = root + 1; k-- > 0;) {
        node of[3];
        const graph_node *n = graph_at(g, p->walk->nodes[k]);
        const int count = graph_operands(n, of);
        if (!taken[k]) continue;
        moving += count == 0 && n->deps & (DEP_TIME | DEP_STATE);
        for (int i = 0; i < count; i++) {
            const double chosen = value && n->op == OP_SELECT && i > 0 ? value[g->place[of[0]]].high : NAN;
            if (isnan(chosen) || (i == 1) == (chosen != 0)) taken[g->place[of[i]]] = true;
        }
    }
    return moving;
}

/* Returns the first marked node that is no number although its operands are. */
static size_t first_undefined(const place *p, const twofold *value, const bool *taken)
{
    const graph *g = p->model->graph;
    for (size_t k = 0; k < p->walk->count; k++) {
        node of[3];
        const graph_node *n = graph_at(g, p->walk->nodes[k]);
        bool numbers = taken[k] && !isfinite(value[k].high);
        for (int i = graph_operands(n, of) - 1; i >= 0 && numbers; i--)
            numbers = !taken[g->place[of[i]]] || isfinite(value[g->place[of[i]]].high);
        if (numbers) return k;
    }
    return SIZE_MAX;
}

/* Returns the limit of numbers whose distance from it shrinks by a constant factor, as that of a power does. */
static double limit_of(const double f[3])
{
    const double first = f[1] - f[0], second = f[2] - f[1];
    return second == 0 || second == first ? f[2] : f[2] - second * (second / (second - first));
}

/* What a way shows: the limit of the quotient, how far rounding moves that, and by how much quotient and divisor differ
 * between both sides. */
typedef struct approach {
    double limit, rounded, slope, divisor;
} approach;

static bool come_near(const place *p, size_t at, way w, twofold *room, approach *out)
{
    const graph *g = p->model->graph;
    const size_t divisor = g->place[graph_at(g, p->walk->nodes[at])->b];
    double middle[POINTS];
    for (int k = 0; k < POINTS; k++, w.by /= 2) {
        const way back = {w.which, w.bent, -w.by};
        const twofold f = values(p, at, &w, room), d = room[divisor], of_f = values(p, at, &back, room),
                      of_d = room[divisor];
        const double most = fmax(fabs(f.high), fabs(of_f.high));
        middle[k] = ((f.high + of_f.high) + (f.low + of_f.low)) / 2;
        *out = (approach){.rounded = ROUNDED * twofold_unit(most),
                          .slope = (f.high - of_f.high) + (f.low - of_f.low),
                          .divisor = (d.high - of_d.high) + (d.low - of_d.low)};
        if (!(f.error + of_f.error <= out->rounded)) return false;
    }
    out->limit = limit_of(middle + 1);
    return fabs(out->limit - limit_of(middle)) <= out->rounded;
}

/* Returns whether two ways agree: in the limit and, where they show the slope of the quotient, in its ratio to that of
 * the divisor. Otherwise the quotient has another value elsewhere where the divisor is 0. */
static bool agree(const approach *a, const approach *b, double by)
{
    const double ab = a->slope * b->divisor, ba = b->slope * a->divisor;
    return fabs(a->limit - b->limit) <= fmax(a->rounded, b->rounded) && fabs(ab - ba) <= by * (fabs(ab) + fabs(ba));
}

/* Returns the number with the fewest digits that is so near. */
static double short_number(double number, double off)
{
    char text[DECIMAL_MAX];
    return fabs(number) <= off ? 0 : decimal_near(number, off, text);
}

/* Finds the limit of a quotient that depends on `moving` numbers of the state. False: the ways do not agree. */
static bool find_limit(const place *p, size_t at, size_t moving, twofold *room, double *limit)
{
    for (int power = 2 * NEARER; power >= NEAREST; power += NEARER) {
        approach first = {0}, next;
        bool all = true;
        for (int k = 0; k < WAYS && all; k++) {
            const way w = {k, moving > 1, ldexp(1, power)};
            all = come_near(p, at, w, room, k ? &next : &first) && (k == 0 || agree(&first, &next, w.by));
        }
        if (all) {
            *limit = short_number(first.limit, first.rounded);
            return true;
        }
    }
    return false;
}

static const table *table_at(const model *m, node of)
{
    const table *found = NULL;
    for (uint32_t k = 0; k < m->table_count && !found; k++)
        if (m->tables[k]->array == graph_at(m->graph, of)->a) found = m->tables[k];
    return found;
}

/* Writes which entry a list or a table does not have. */
static void outside(model *m, const graph_node *entry, double now, const twofold *value, undefined_term *out)
{
    const graph *g = m->graph;
    const table *const t = table_at(m, entry->b);
    char u[UNDEFINED_TEXT / 4] = "", end[DECIMAL_MAX], other[DECIMAL_MAX];
    if (!t) return;
    const array *const points = &m->arrays[t->points];
    const int64_t first = points->over->first[0], last = points->over->last[0];
    const double *const number = m->pool + points->base;
    if (t->kind == TABLE_LIST) {
        if (!(graph_deps(g, entry->a) & DEP_STATE)) out->time = now;
        snprintf(out->outside, sizeof out->outside, "%s has the entries %lld to %lld, and %g is asked for", t->name,
                 (long long)first, (long long)last, value[g->place[entry->a]].high + (double)(first - 1));
        return;
    }
    node row = entry->a;
    while (graph_at(g, row)->op == OP_ADD || graph_at(g, row)->op == OP_MUL) {
        const graph_node *n = graph_at(g, row);
        row = graph_at(g, n->a)->op == OP_CONST ? n->b : n->a;
    }
    const bool finds = graph_at(g, row)->op == OP_FIND; /* else it is held as a side */
    if (!finds && graph_at(g, row)->op != OP_LOAD) return;
    const bool before = value[g->place[row]].high == 0;
    const node argument = finds ? graph_at(g, row)->a : row;
    const bool moves = !finds || graph_deps(g, argument) & (DEP_TIME | DEP_STATE);
    if (finds) model_print(m, argument, u, sizeof u);
    const char *const the = finds && moves ? "" : finds ? "the argument " : "the argument";
    const double point = number[before ? 0 : last - first];
    if (graph_at(g, argument)->op == OP_TIME) out->time = point;
    snprintf(out->outside, sizeof out->outside, "%s%s %s %s %s, the %s point of the table %s", the, u,
             moves ? "goes" : "is", before ? "before" : "beyond", decimal(point, end), before ? "first" : "last",
             t->values);
    if (!moves)
        snprintf(out->points, sizeof out->points, "%s to %s", decimal(number[0], other),
                 decimal(number[last - first], end));
    out->holds = t->kind == TABLE_SPLINE ? "spline" : "interp";
}

/* Returns whether an `if` chooses a node directly, as it does for what an event keeps before the event. */
static bool chosen(const place *p, size_t at)
{
    bool found = false;
    for (size_t k = at; k < p->walk->count && !found; k++) {
        const graph_node *n = graph_at(p->model->graph, p->walk->nodes[k]);
        found = n->op == OP_SELECT && (n->b == p->walk->nodes[at] || n->c == p->walk->nodes[at]);
    }
    return found;
}

/* Describes an undefined term. A limit is given of a quotient only if it depends on no number that its divisor does not
 * depend on: otherwise there may be one for each value of that number. */
static void describe(model *m, const place *p, size_t at, twofold *value, bool *taken, undefined_term *out)
{
    const graph *g = m->graph;
    const graph_node n = *graph_at(g, p->walk->nodes[at]);
    const bool divides = n.op == OP_DIV && value[g->place[n.b]].high == 0;
    out->infinite = isinf(value[at].high);
    out->both = divides && value[g->place[n.a]].high == 0;
    const size_t moving = mark(p, at, NULL, taken);
    if (out->both && moving == mark(p, g->place[n.b], NULL, taken))
        out->has_limit = find_limit(p, at, moving, value, &out->limit);
    model_print(m, p->walk->nodes[at], out->term, sizeof out->term);
    if (n.op == OP_ENTRY) outside(m, &n, p->t, value, out);
    if (divides) model_print(m, n.b, out->divisor, sizeof out->divisor);
    if (n.op == OP_CONST && m->keeps && chosen(p, at))
        snprintf(out->says, sizeof out->says, "the event that it tells of has not happened");
    else if (out->outside[0])
        snprintf(out->says, sizeof out->says, "%s", out->outside);
    else if (n.op == OP_CONST)
        snprintf(out->says, sizeof out->says, "a constant of it is not a finite number");
    else if (divides)
        snprintf(out->says, sizeof out->says, "%s is %s there, since %s is 0", out->term,
                 out->both ? "0/0" : "a division by 0", out->divisor);
    else
        snprintf(out->says, sizeof out->says, "%s is %s there", out->term, out->infinite ? "infinite" : "not a number");
}

/* Returns whether all nodes can be evaluated singly. */
static bool single(const graph *g, const graph_walk *w)
{
    bool all = w->count <= NODES_MOST;
    for (size_t k = 0; k < w->count && all; k++)
        all = !(graph_deps(g, w->nodes[k]) & DEP_D) && graph_at(g, w->nodes[k])->op != OP_SUM;
    return all;
}

/* Finds the indices with which an output becomes element `which`; those before `level` are set. */
static bool cell_of(const model *m, const output *o, size_t which, int level, int64_t *index)
{
    if (level == o->loops) return graph_element(m->arrays, &o->to, index, m->ints) == which;
    const int64_t first = graph_subscript(&o->loop[level].first, index, m->ints),
                  last = graph_subscript(&o->loop[level].last, index, m->ints);
    for (index[level] = first; index[level] <= last; index[level]++)
        if (cell_of(m, o, which, level + 1, index)) return true;
    return false;
}

bool undefined_of(model *m, const output *o, const int64_t *index, double t, const double *x, const double *v,
                  undefined_term *out)
{
    graph_walk w;
    *out = (undefined_term){.time = NAN};
    if (!graph_order(m->graph, &o->value, 1, 0, false, &w)) return false;
    const place p = {m, &w, t, x, v, index};
    twofold *const value = take(&m->arena->allocator, w.count, sizeof *value);
    bool *const taken = take(&m->arena->allocator, w.count, sizeof *taken);
    bool found = value && taken && single(m->graph, &w);
    if (found) {
        values(&p, w.count - 1, &(way){0}, value);
        mark(&p, w.count - 1, value, taken);
        const size_t at = first_undefined(&p, value, taken);
        found = at != SIZE_MAX;
        if (found) describe(m, &p, at, value, taken, out);
    }
    give(&m->arena->allocator, taken);
    give(&m->arena->allocator, value);
    give(&m->arena->allocator, w.nodes);
    return found;
}

bool undefined_find(model *m, const output *outputs, size_t count, size_t which, double t, const double *x,
                    const double *v, undefined_term *out)
{
    int64_t index[MAX_LEVELS] = {0};
    for (const output *o = outputs; o < outputs + count; o++)
        if (cell_of(m, o, which, 0, index)) return undefined_of(m, o, index, t, x, v, out);
    return false;
}

double undefined_until(const undefined_term *u, double last, double start)
{
    char text[DECIMAL_MAX];
    const double off = isnan(u->time) ? 1e-9 * (last - start) : 0;
    return off == 0 ? last : decimal_near(last - 2 * off, fabs(off), text);
}

void undefined_hint(const undefined_term *u, double until, bool start, motus_error *err)
{
    char text[DECIMAL_MAX], holds[64] = "";
    if (u->holds) snprintf(holds, sizeof holds, "let the end values hold: %s(…, hold)", u->holds);
    if (u->points[0])
        hint(err, "take an argument from %s, or %s", u->points, holds);
    else if (start)
        hint(err, "begin %s%s", u->holds ? "within the points of the table, or " : "elsewhere", holds);
    else
        hint(err, "end the run there, `until = %s` of the definition%s%s", decimal(until, text),
             u->holds ? ", or " : "", holds);
}
