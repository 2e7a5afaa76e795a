/* See whole.h. All modes are taken to count, until one has an assignment that does not. */
#include "lang/model/whole.h"

#include "base/memory.h"
#include "lang/base/operation.h"
#include "lang/graph/graph_walk.h"

#include <math.h>
#include <string.h>

/* Whether an operation makes whole numbers of whole numbers. */
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
    default: return operation_decides(op);
    }
}

/* Whether a node is, where its operands are known. They come before it. */
static bool counts(const whole *w, const graph *g, node n)
{
    const graph_node *k = graph_at(g, n);
    if (k->op == OP_CONST) return floor(k->value) == k->value && isfinite(k->value);
    if (k->op == OP_PARAM || k->op == OP_INDEX) return true;
    if (k->op == OP_LOAD) return w->array[g->references[k->a].array];
    node of[3];
    bool is = keeps_whole((operation)k->op);
    for (int j = graph_operands(k, of) - 1; j >= 0; j--) is = is && of[j] < n && w->node[of[j]];
    return is;
}

/* Takes back the modes whose assignments do not count; whether there were any. */
static bool take_back(const whole *w, const model *m, const model_rule *endless)
{
    bool any = false;
    for (uint32_t i = 0; i < m->rule_count; i++)
        for (size_t k = 0; k < m->rules[i].assignments; k++) {
            const model_assignment *a = &m->rules[i].assignment[k];
            uint8_t *to = &w->array[a->to.array];
            const bool goes_on = &m->rules[i] == endless && graph_deps(m->graph, a->value.value) & DEP_MODE;
            if (!*to || (w->node[a->value.value] && !goes_on)) continue;
            *to = 0;
            any = true;
        }
    return any;
}

bool whole_find(whole *w, const model *m, const model_rule *endless, const motus_allocator *allocator)
{
    const graph *g = m->graph;
    *w = (whole){take(allocator, (size_t)g->count + 1, 1), take(allocator, (size_t)m->array_count + 1, 1)};
    if (!w->node || !w->array) return false;
    for (uint32_t k = 0; k < m->array_count; k++) w->array[k] = m->arrays[k].mode || m->arrays[k].space == SPACE_POOL;
    for (uint32_t k = 0; k < m->side_count; k++) { /* a side is where the motion is */
        const model_state *s = &m->states[m->side_first + k];
        for (int c = 0; c < (s->components ? s->components : 1); c++) w->array[m->block[BLOCK_X] + s->array + c] = 0;
    }
    do
        for (node n = 0; n < g->count; n++) w->node[n] = counts(w, g, n);
    while (take_back(w, m, endless));
    return true;
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
