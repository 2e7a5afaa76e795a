/* Ghost cells: boundary cells whose line depends on a state, u[0] = u[1] [11].
 *
 * A ghost cell has no number in the state. Where it is read, the right side of its line stands instead, so derivatives,
 * structures of matrices and machines know nothing of it, and its value always fits the state. A family that reads
 * ghost cells for only some of its indices is divided: u[i-1] for i = 1..N reads u[0] for i = 1. Reading across the
 * border asks for a cut (lower_cut), and the equation, quantity or sum with that index then lowers its parts one by
 * one.
 */
#include "lang/lower/lower_ghost.h"

#include "lang/lower/lower_parts.h"
#include "lang/model/kept.h"
#include "lang/model/symbols.h"
#include "lang/text/foreign.h"

#include <string.h>

/* Which lines ------------------------------------------------------------------------------------------------------ */

static bool reads_state(model *m, const tree *t, const tree *applied);

static bool once(model *m, uint8_t *reads, const tree *t, const tree *applied)
{
    if (*reads == 0) {
        *reads = 1; /* a circle would end here; classify.c has refused it */
        *reads = reads_state(m, t, applied) ? 2 : 1;
    }
    return *reads == 2;
}

static bool name_reads(model *m, const tree *t, const tree *applied)
{
    for (uint32_t i = 1; applied && i < applied->count; i++)
        if (!strcmp(applied->item[i]->name, t->name)) return false;
    const symbol s = symbols_find(m, t->name);
    if (s.state) return true;
    if (s.definition && s.definition->mode) return true;
    if (!s.definition || s.definition->kind == DEFINED_PARAMETER) return false;
    return once(m, &s.definition->reads, s.definition->statement->value, NULL);
}

/* Returns whether a tree reads a state. Chains of operators lean left and may be long, so a loop follows the left
 * side. */
static bool reads_state(model *m, const tree *t, const tree *applied)
{
    for (;;) {
        if (t->kind == TREE_NAME && name_reads(m, t, applied)) return true;
        model_function *f = t->kind == TREE_APPLY ? symbols_find(m, t->item[0]->name).function : NULL;
        if (f && once(m, &f->reads, f->statement->value, f->statement->applied)) return true;
        if (t->kind == TREE_APPLY && kept_call(m, t)) return true;
        if (t->count == 0 || (t->kind == TREE_APPLY && !f)) return false; /* an initial value is constant */
        for (uint32_t i = 1; i < t->count; i++)
            if (reads_state(m, t->item[i], applied)) return true;
        if (f) return false;
        t = t->item[0];
    }
}

bool lower_is_ghost(model *m, const statement *s)
{
    return s->kind == STATEMENT_DEFINITION && reads_state(m, s->value, NULL);
}

bool lower_add_ghost(model *m, model_state *s, const statement *line, const int64_t first[], const int64_t last[])
{
    model_ghost *g = arena_take(m->arena, sizeof *g);
    if (!g) return false;
    g->line = line;
    memcpy(g->first, first, sizeof g->first);
    memcpy(g->last, last, sizeof g->last);
    g->next = s->ghosts;
    s->ghosts = g;
    return true;
}

bool lower_fits(model *m, const statement *s, const model_state *state, value v, const char *what)
{
    if (v.count == state->components) return true;
    char is[48], due[48] = "a number";
    snprintf(is, sizeof is, v.count ? "a vector of length %d" : "a number", v.count);
    if (state->components) snprintf(due, sizeof due, "a vector of length %d", state->components);
    source_complain(&m->source, MOTUS_SHAPE, &s->value->at, "%s is %s, but %s is %s by its initial value", what, is,
                    state->name, due);
    if (!state->components) foreign_decimal(&m->source, &s->value->at);
    if (v.count) source_hint(&m->source, "write %s(%g) = (…) for a vector", state->name, m->start);
    return false;
}

/* Cuts ------------------------------------------------------------------------------------------------------------- */

bool lower_cut(model *m, int first, int count, model_cut *out)
{
    if (!m->cut.wanted || m->cut.level < first || m->cut.level >= first + count) return false;
    *out = m->cut;
    m->cut.wanted = false;
    m->divided = true;
    return true;
}

/* Drops a level of one index: its name becomes a number, and the levels above move down. */
static void drop(lowering *l, output *o, int level, int64_t index)
{
    graph *g = l->model->graph;
    const subscript one = {.level = -1, .slot = -1, .modulus = -1, .literal = (int32_t)index};
    for (int k = 0; k < l->name_count; k++) {
        index_name *n = &l->names[k];
        if (n->at.level == level) {
            n->at = one;
            n->number = graph_const(g, (double)index);
        } else if (n->at.level > level) {
            n->number = graph_index(g, --n->at.level);
        }
    }
    for (int d = 0; d < o->to.dims; d++) {
        if (o->to.at[d].level == level)
            o->to.at[d] = one;
        else if (o->to.at[d].level > level)
            o->to.at[d].level--;
    }
    o->loops--;
    l->levels--;
    for (int k = level; k < o->loops; k++) {
        o->loop[k] = o->loop[k + 1];
        l->low[k] = l->low[k + 1];
        l->high[k] = l->high[k + 1];
    }
}

void lower_narrow(lowering *l, output *o, int level, int64_t low, int64_t high)
{
    const subscript none = {.level = -1, .slot = -1, .modulus = -1};
    l->terms *= (double)(high - low + 1) / (double)(l->high[level] - l->low[level] + 1);
    l->low[level] = low;
    l->high[level] = high;
    for (int k = 0; k < l->name_count; k++)
        if (l->names[k].at.level == level) {
            l->names[k].first = low;
            l->names[k].last = high;
        }
    o->loop[level] = (range){none, none};
    o->loop[level].first.literal = (int32_t)low;
    o->loop[level].last.literal = (int32_t)high;
    if (low == high) drop(l, o, level, low);
}

/* Reading ---------------------------------------------------------------------------------------------------------- */

typedef struct motion {
    const model *model;
    bool unknown; /* the rate of a velocity would be needed, which is not known here */
} motion;

/* Returns the rate of a leaf along the motion. */
static node along(graph *g, node leaf, void *motion_ctx)
{
    motion *c = motion_ctx;
    const graph_node n = *graph_at(g, leaf);
    if (n.op == OP_TIME) return graph_const(g, 1);
    if (n.op != OP_LOAD) return 0;
    reference r = g->references[n.a];
    if (g->arrays[r.array].mode) return 0;
    c->unknown |= g->arrays[r.array].space == SPACE_V || g->arrays[r.array].space == SPACE_A;
    if (g->arrays[r.array].space != SPACE_X) return 0;
    r.array = (uint16_t)(r.array + c->model->block[BLOCK_V] - c->model->block[BLOCK_X]);
    return graph_load(g, &r);
}

static value velocity(lowering *l, const tree *t, value of)
{
    motion c = {.model = l->model};
    value v = vector(l, of.count);
    for (int k = 0; k < (v.count ? v.count : 1) && !failed(l); k++)
        v.item[k] = graph_derivative(l->model->graph, of.item[k], along, &c);
    if (!c.unknown || failed(l)) return v;
    char text[80];
    COMPLAIN(l, &t->at, "%s is not known: the boundary line of %s uses a velocity or a first-order variable",
             quote(l, &t->at, text), t->name);
    return wrong(l);
}

/* Lowers the right side of a boundary line, with the subscripts in place of its indices. */
static value expand(lowering *l, const tree *t, const model_state *s, model_ghost *g, const reference *r,
                    const int64_t low[], const int64_t high[])
{
    const statement *line = g->line;
    if (g->expanding) {
        char text[80];
        source_complain(&l->model->source, MOTUS_NAME, &t->at, "%s follows from itself, in a circle of boundary lines",
                        quote(l, &t->at, text));
        HINT(l,
             "a boundary cell follows from cells that have an equation; give each cell of a circle a line of its own");
        return wrong(l);
    }
    lowering inner = *l;
    inner.place = PLACE_EQUATION;
    inner.what = "a boundary line";
    if (!lower_enter_line(&inner, t, line, r, low, high, "boundary lines")) return wrong(l);
    g->expanding = true;
    value v = lower_numbers(&inner, line->value);
    g->expanding = false;
    if (failed(l) || !lower_fits(l->model, line, s, v, "a boundary line")) return wrong(l);
    return t->primes == 1 && s->order == 2 ? velocity(l, t, v) : v;
}

void lower_ask_cut(lowering *l, const tree *t, int dims, const int64_t first[], const int64_t last[],
                   const reference *r, const int64_t low[], const int64_t high[])
{
    for (int d = 0; d < dims; d++) {
        if (low[d] >= first[d] && high[d] <= last[d]) continue;
        const int level = r->at[d].level;
        if (level < 0 || r->at[d].modulus >= 0) {
            COMPLAIN(l, &t->item[d]->at, "a wrapped index cannot reach cells that several lines give");
            return;
        }
        const int64_t border = low[d] < first[d] ? first[d] : last[d] + 1;
        l->model->cut = (model_cut){true, level, l->low[level] + border - low[d]};
        return;
    }
}

bool lower_ghost(lowering *l, const tree *t, const model_state *s, const reference *r, const int64_t low[],
                 const int64_t high[], value *out)
{
    for (model_ghost *g = s->ghosts; g; g = g->next) {
        bool apart = false, inside = true;
        for (int d = 0; d < s->dims; d++) {
            apart |= low[d] > high[d] || high[d] < g->first[d] || low[d] > g->last[d];
            inside &= low[d] >= g->first[d] && high[d] <= g->last[d];
        }
        if (apart) continue;
        if (l->by_variable) {
            char text[80];
            COMPLAIN(l, &t->at,
                     "%s follows from other cells by its boundary line, so nothing can be differentiated by it",
                     quote(l, &t->at, text));
        } else if (!inside) {
            lower_ask_cut(l, t, s->dims, g->first, g->last, r, low, high);
        }
        *out = failed(l) ? wrong(l) : expand(l, t, s, g, r, low, high);
        return true;
    }
    return false;
}
