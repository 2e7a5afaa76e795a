/* See whole.h. All modes are taken to count, until one has an assignment that is no count. */
#include "lang/model/whole.h"

#include "base/memory.h"
#include "lang/base/operation.h"
#include "lang/graph/graph_walk.h"

#include <math.h>

/* Returns whether an operation on whole numbers has a whole value. */
static bool keeps_whole(operation op)
{
    switch (op) {
    case OP_SUM:
    case OP_NEG:
    case OP_ABS:
    case OP_FLOOR:
    case OP_SIGN:
    case OP_ADD:
    case OP_SUB:
    case OP_MUL:
    case OP_MIN:
    case OP_MAX:
    case OP_MOD:
    case OP_SELECT: return true;
    default: return operation_is(op, DECIDES);
    }
}

/* up to this, every whole number is a double */
static const double EXACT = 0x1p53;
/* LARGE: a bound that is assumed on a mode, a place of a list, an index or the number of summands. ADDED: how much one
 * assignment may add to a mode; a mode that grows faster is no counter. */
static const double LARGE = 0x1p26, ADDED = 0x1p20;

/* Returns a bound on the value of an operation, from bounds on its operands. */
static double bound_of(operation op, const double *of)
{
    switch (op) {
    case OP_SUM: return LARGE * of[0];
    case OP_ADD:
    case OP_SUB: return of[0] + of[1];
    case OP_MUL: return of[0] * of[1];
    case OP_MIN:
    case OP_MAX: return fmax(of[0], of[1]);
    case OP_MOD: return of[1];
    case OP_SELECT: return fmax(of[1], of[2]);
    case OP_NEG:
    case OP_ABS:
    case OP_FLOOR: return of[0] + 1;
    default: return 1;
    }
}

static bool is_whole(double value) { return floor(value) == value && isfinite(value); }

static bool is_factor(const graph *g, node n)
{
    return graph_at(g, n)->op == OP_CONST && is_whole(graph_at(g, n)->value);
}

/* Returns whether a node only counts, and bounds it in w->most; the operands come first. */
static bool counts(const whole *w, const model *m, node n)
{
    const graph *g = m->graph;
    const graph_node *k = graph_at(g, n);
    const double exact = ldexp(EXACT, -w->places);
    double bound[3] = {0}, *most = &w->most[n];
    *most = LARGE;
    if (k->op == OP_CONST || k->op == OP_PARAM) {
        const double value = k->op == OP_CONST ? k->value : m->pool[k->a];
        *most = fabs(value);
        return ((k->op == OP_PARAM && !w->places) || is_whole(ldexp(value, w->places))) && *most <= exact;
    }
    if (k->op == OP_INDEX) return true;
    if (k->op == OP_LOAD) {
        *most = w->large[g->references[k->a].array];
        return w->array[g->references[k->a].array];
    }
    node of[3];
    bool is = keeps_whole((operation)k->op);
    for (int j = graph_operands(k, of) - 1; j >= 0 && is; j--) {
        is = of[j] < n && w->node[of[j]];
        bound[j] = is ? w->most[of[j]] : 0;
    }
    *most = bound_of((operation)k->op, bound);
    /* a product has the places of both factors */
    if (k->op == OP_MUL && w->places && is) is = is_factor(g, k->a) || is_factor(g, k->b);
    return is && *most <= exact;
}

/* Drops the modes whose assignments do not count, and widens the bounds of remainders. Returns whether anything
 * changed. */
static bool take_back(const whole *w, const model *m, const model_rule *endless)
{
    bool any = false;
    for (uint32_t i = 0; i < m->rule_count; i++)
        for (size_t k = 0; k < m->rules[i].assignments; k++) {
            const model_assignment *a = &m->rules[i].assignment[k];
            uint8_t *to = &w->array[a->to.array];
            const bool goes_on = &m->rules[i] == endless && graph_deps(m->graph, a->value.value) & DEP_MODE;
            double *large = &w->large[a->to.array];
            const double most = w->most[a->value.value];
            if (!*to || (w->node[a->value.value] && most <= *large + ADDED && !goes_on)) continue;
            if (w->node[a->value.value] && !goes_on && graph_at(m->graph, a->value.value)->op == OP_MOD)
                *large = most; /* a remainder stays below its modulus */
            else
                *to = 0;
            any = true;
        }
    return any;
}

bool whole_find(whole *w, const model *m, int places, const model_rule *endless, const motus_allocator *allocator)
{
    const graph *g = m->graph;
    *w = (whole){take(allocator, (size_t)g->count + 1, 1), take(allocator, (size_t)m->array_count + 1, 1),
                 take(allocator, (size_t)g->count + 1, sizeof *w->most),
                 take(allocator, (size_t)m->array_count + 1, sizeof *w->large), places};
    if (!w->node || !w->array || !w->most || !w->large) return false;
    for (uint32_t k = 0; k < m->array_count; k++) w->large[k] = LARGE;
    for (uint32_t k = 0; k < m->array_count; k++) w->array[k] = m->arrays[k].mode || m->arrays[k].space == SPACE_POOL;
    for (uint32_t k = 0; k < m->side_count; k++) { /* a side tells where the motion is, so it is no count */
        const model_state *s = &m->states[m->side_first + k];
        for (int c = 0; c < (s->components ? s->components : 1); c++) w->array[m->block[BLOCK_X] + s->array + c] = 0;
    }
    do
        for (node n = 0; n < g->count; n++) w->node[n] = counts(w, m, n);
    while (take_back(w, m, endless));
    return true;
}

void whole_end(whole *w, const motus_allocator *allocator)
{
    give(allocator, w->node);
    give(allocator, w->array);
    give(allocator, w->most);
    give(allocator, w->large);
}

whole_kind whole_of(const whole *w, const model *m, const model_definition *d)
{
    bool moves = false;
    for (size_t k = 0; k < d->output_count; k++) {
        if (!w->node[d->outputs[k].value]) return WHOLE_NOT;
        moves = moves || graph_deps(m->graph, d->outputs[k].value) & DEP_MODE;
    }
    return d->output_count == 0 ? WHOLE_NOT : moves ? WHOLE_COUNT : WHOLE_CONSTANT;
}
