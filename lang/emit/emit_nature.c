/* The nature of values: which are wide, and which depend on time alone. */
#include "lang/emit/emit_parts.h"

/* Finds the nature of every node. Sums of parameters that share a loop with a wide one become wide, too: `loops` says
 * that there is one. */
bool emit_natures(writer *w, bool loops)
{
    const graph *g = w->plan.g;
    bool wide_loops = false;
    for (node n = 0; n < g->count; n++) {
        const graph_node *m = &g->nodes[n];
        uint8_t a = 0, all = CLOSED, *own = &w->nature[n];
        int arity = operation_at(m->op)->arity;
        if (m->op == OP_SUM) {
            a = (uint8_t)(w->nature[m->a] | (m->b ? w->nature[m->b] : 0));
            all = 0;
        }
        if (arity > 0) a |= w->nature[m->a], all &= w->nature[m->a];
        if (arity > 1) a |= w->nature[m->b], all &= w->nature[m->b];
        if (arity > 2) a |= w->nature[m->c], all &= w->nature[m->c];
        *own = (uint8_t)((a & WIDE) | (all & CLOSED));
        if (m->op == OP_TOTAL || m->op == OP_INDEX) *own = 0;
        if (m->op == OP_TIME && w->e->own_time) *own |= WIDE;
        if (m->op == OP_PARAM && w->e->varied && w->e->varied[m->a]) *own |= WIDE;
        if (m->op == OP_LOAD) {
            const array *from = &g->arrays[g->references[m->a].array];
            *own = from->space == SPACE_POOL ? CLOSED : WIDE;
            if (from->space == SPACE_POOL && emit_varies(w, from)) *own |= WIDE;
        }
        bool of_parameters = m->op == OP_SUM && !(m->deps & (DEP_STATE | DEP_D | DEP_TIME));
        wide_loops |= of_parameters && *own & WIDE;
        if (of_parameters && loops) *own |= WIDE;
        if (*own & CLOSED && !(*own & WIDE) && m->deps & DEP_TIME && !(m->deps & DEP_LEVELS) && m->op != OP_TIME)
            *own |= PLAIN_TIME;
    }
    return wide_loops;
}

/* Gives places in T to values of time alone that others need. */
void emit_terms(writer *w)
{
    const graph *g = w->plan.g;
    for (uint32_t k = 0; k < w->plan.items.count; k++) {
        const plan_item *item = &w->plan.items.at[k];
        const graph_node *m = &g->nodes[item->n];
        const node operands[3] = {m->a, m->b, m->c};
        int arity = operation_at(m->op)->arity;
        if (w->nature[item->n] & PLAIN_TIME) {
            if (item->outputs != NONE && w->term[item->n] == NONE) w->term[item->n] = w->e->terms++;
            continue;
        }
        for (int i = 0; i < 3 && i < arity; i++)
            if (w->nature[operands[i]] & PLAIN_TIME && w->term[operands[i]] == NONE)
                w->term[operands[i]] = w->e->terms++;
        if (m->op == OP_SUM && m->b && w->nature[m->b] & PLAIN_TIME && w->term[m->b] == NONE)
            w->term[m->b] = w->e->terms++;
    }
    for (uint32_t k = 0; k < w->plan.program->count; k++) {
        node n = w->plan.program->outputs[k].value;
        if (w->nature[n] & PLAIN_TIME && w->term[n] == NONE) w->term[n] = w->e->terms++;
    }
}

/* Returns whether a value is wide. In the function that computes terms a lane is a time; in a loop with lanes it is a
 * value of the index. */
bool emit_wide(const writer *w, node n)
{
    const graph_node *m = &w->plan.g->nodes[n];
    if (w->part == TERMS) return (m->deps & DEP_TIME) != 0;
    if (w->along >= 0) return m->deps >> w->along & 1 || (m->op == OP_SUM && m->level == w->along);
    return (w->e->lanes && w->nature[n] & WIDE) != 0;
}

const char *emit_type(const writer *w, node n) { return emit_wide(w, n) ? "reals" : "double"; }

/* Returns the name of an operation's function, and notes its use. */
const char *emit_operation(const writer *w, node n, unsigned op)
{
    bool lanes = emit_wide(w, n);
    *(lanes ? &w->e->used_lanes : &w->e->used) |= (uint64_t)1 << op;
    return lanes ? "ops" : "op";
}
