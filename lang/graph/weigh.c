/* See weigh.h.
 *
 * A division or a root takes about as long as DIVISION additions, an elementary function as FUNCTION_CALL. Where the
 * bounds of a loop depend on an outer index, the run in the middle counts for all.
 */
#include "lang/graph/weigh.h"

#include "lang/graph/graph_place.h"
#include "lang/graph/plan.h"

enum { ENTRY = 2, DIVISION = 8, FUNCTION_CALL = 20 };

static double value_of(operation op)
{
    static const bool calls[OPERATIONS] = {
#define OP(id, ...)
#define FUNCTION(id, ...) [OP_##id] = true,
#include "lang/base/operations.def"
#undef OP
    };
    switch (op) {
    case OP_CONST:
    case OP_TIME:
    case OP_PARAM:
    case OP_INDEX:
    case OP_LOAD:
    case OP_TABLE:
    case OP_TOTAL: return 0;
    case OP_ENTRY: return ENTRY;
    case OP_FIND:
    case OP_DIV:
    case OP_SQRT:
    case OP_MOD: return DIVISION;
    default: return calls[op] ? FUNCTION_CALL : 1;
    }
}

/* Returns how many products of series the recurrence of an operation sums; 0: it is linear. */
static double products_of(const graph *g, const graph_node *n)
{
    const unsigned moving = DEP_STATE | DEP_TIME;
    const bool a = g->nodes[n->a].deps & moving, b = g->nodes[n->b].deps & moving;
    switch (operation_at(n->op)->degree) {
    case DEGREE_PRODUCT:
    case DEGREE_FUSED: return a && b;
    case DEGREE_QUOTIENT: return b;
    case DEGREE_CURVED: return operation_at(n->op)->keeps > 1 ? 2 : 1;
    default: return 0;
    }
}

/* Returns how often a region runs in an evaluation; `index` gets the middle of every loop around it. */
static double runs_of(const plan *p, uint32_t region, const int64_t *ints, int64_t *index)
{
    const plan_region *r = &p->regions.at[region];
    if (r->level < 0) return region == AT_RUN;
    const double outer = runs_of(p, r->parent, ints, index);
    const int64_t first = graph_subscript(&r->range.first, index, ints);
    const int64_t last = graph_subscript(&r->range.last, index, ints);
    index[r->level] = first + (last - first) / 2;
    return last < first ? 0 : outer * (double)(last - first + 1);
}

bool weigh(arena *a, const program *program, const int64_t *ints, weight *out)
{
    plan p;
    *out = (weight){0};
    const bool planned = plan_create(&p, a, program, false);
    for (uint32_t k = AT_RUN; planned && k < p.regions.count; k++) {
        int64_t index[MAX_LEVELS] = {0};
        const double runs = runs_of(&p, k, ints, index);
        const plan_region *r = &p.regions.at[k];
        for (uint32_t i = 0; i < r->item_count; i++) {
            const graph_node *n = &p.g->nodes[p.items.at[p.order[r->items + i]].n];
            const double products = products_of(p.g, n), value = value_of(n->op);
            out->values += runs * value;
            out->products += runs * products;
            out->sums += value > 0 && products == 0 ? runs : 0;
        }
    }
    plan_release(&p);
    return planned;
}
