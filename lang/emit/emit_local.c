/* See emit_local.h. The answers depend on the subscripts alone, not on sizes or parameters. */
#include "lang/emit/emit_local.h"

typedef struct seeing {
    const graph *g;
    const subscript *own;
    locality *l;
} seeing;

static bool plain(const subscript *s) { return s->modulus < 0; }

static void see(void *ctx, const reference *r, const range *sums, int first_level, int inside)
{
    (void)sums, (void)first_level, (void)inside;
    const seeing *s = ctx;
    const subscript *at = &r->at[0];
    if (r->dims == 0 || !plain(at) || at->level != s->own->level || at->slot != s->own->slot) {
        s->l->local = false;
        return;
    }
    const int64_t away = (int64_t)at->literal - s->own->literal, far = away < 0 ? -away : away;
    if (far > s->l->reach) s->l->reach = far;
    if (far > LOCAL_REACH_MAX) s->l->local = false;
}

/* Returns whether a sum over the state depends on no family index: it is computed once for all cells, but with windows
 * once for every window. */
static bool sums_of_all(const program *p)
{
    for (uint32_t n = 0; n < p->graph->count; n++) {
        const graph_node *m = &p->graph->nodes[n];
        if (m->op == OP_SUM && (m->deps & (DEP_STATE | DEP_TIME)) && !(m->deps & DEP_LEVELS)) return true;
    }
    return false;
}

locality emit_local(const program *p)
{
    locality l = {.divisible = !sums_of_all(p), .local = true};
    for (size_t k = 0; k < p->count; k++) {
        const output *o = &p->outputs[k];
        const subscript *own = &o->to.at[0];
        if (o->to.dims == 0 || !plain(own) || own->level != (o->loops ? 0 : -1) ||
            (o->loops && (own->slot >= 0 || own->literal))) {
            l.divisible = false;
            break;
        }
        seeing s = {p->graph, own, &l};
        graph_loads(p->graph, o->value, SPACE_X, see, &s);
        graph_loads(p->graph, o->value, SPACE_V, see, &s);
    }
    l.local &= l.divisible;
    return l;
}
