/* diff(expression, variable) [17]: the partial derivative, as nodes of the graph.
 *
 * The variable is a leaf of the graph: a state, a velocity, t, a parameter, or a component of these; of a family it is
 * one cell (lower_cells.c). An argument of a function may be any expression, so the function is differentiated by a
 * leaf of its own, which the argument then replaces.
 */
#include "lang/lower/lower_diff.h"

#include "lang/model/symbols.h"
#include "lang/model/vary.h"

#include <string.h>

/* Seeds ------------------------------------------------------------------------------------------------------------ */

static const array *array_of(const graph *g, node leaf)
{
    const graph_node *n = graph_at(g, leaf);
    return &g->arrays[n->op == OP_TABLE ? n->a : g->references[n->a].array];
}

static bool in_pool(const graph *g, node n)
{
    const int op = graph_at(g, n)->op;
    return op == OP_PARAM || op == OP_TABLE || (op == OP_LOAD && array_of(g, n)->space == SPACE_POOL);
}

static node seed(graph *g, node leaf, void *differential_ctx);

/* Returns the derivative of a parameter that was computed from others, by its own expression. */
static node of_parameter(differential *d, uint32_t slot)
{
    model *m = d->l->model;
    if (!d->of_slot) {
        d->of_slot = arena_room(m->arena, m->scalar_slots * sizeof *d->of_slot);
        d->line = arena_room(m->arena, m->scalar_slots * sizeof *d->line);
        if (m->arena->failed) return 0;
        for (uint32_t k = m->log.count; k-- > 0;)
            if (m->log.lines[k].value != VARY_ENTRY) d->line[m->log.lines[k].slot] = k + 1;
    }
    if (d->of_slot[slot]) return d->of_slot[slot] - 1;
    if (!d->line[slot]) return 0;
    if (d->chain == MODEL_CHAIN_MAX) {
        source_complain(
            &m->source, MOTUS_LIMIT, &d->call->at,
            "more than %d parameters, each of which uses the next, lie between this expression and the variable",
            MODEL_CHAIN_MAX);
        return 0;
    }
    d->chain++;
    d->of_slot[slot] = 1 + graph_derivative(m->graph, m->log.lines[d->line[slot] - 1].value, seed, d);
    d->chain--;
    return d->of_slot[slot] - 1;
}

/* Returns the derivative of numbers in lists, families of parameters and initial values, which are not followed back:
 * 0, or a complaint. */
static node of_numbers(differential *d, const array *numbers)
{
    model *m = d->l->model;
    if (!d->affected) {
        const graph *g = m->graph;
        const graph_node *v = graph_at(g, d->variable);
        const array one = {.base = v->a}, *of = v->op == OP_PARAM ? &one : array_of(g, d->variable);
        d->affected = vary_follows(m, of);
        if (!d->affected) return 0;
    }
    if (!graph_marked(numbers, d->affected)) return 0;
    char text[80];
    COMPLAIN(d->l, &d->call->at, "a list or an initial value in this expression depends on %s",
             quote(d->l, &d->call->item[1]->at, text));
    HINT(d->l, "diff follows parameters that are numbers or vectors: write what the list contains");
    return 0;
}

static node seed(graph *g, node leaf, void *differential_ctx)
{
    differential *d = differential_ctx;
    const graph_node *n = graph_at(g, leaf), *v = graph_at(g, d->variable);
    if (n->op == OP_LOAD && v->op == OP_LOAD && g->references[n->a].array == g->references[v->a].array) {
        const reference of = g->references[n->a];
        return of.dims ? lower_cell(d, &of) : graph_const(g, 1);
    }
    if (leaf == d->variable) return graph_const(g, 1);
    if (!in_pool(g, d->variable) || !in_pool(g, leaf)) return 0;
    return n->op == OP_PARAM ? of_parameter(d, n->a) : of_numbers(d, array_of(g, leaf));
}

/* Derivatives ------------------------------------------------------------------------------------------------------ */

static value derivative(lowering *l, const tree *call, value of, value by)
{
    graph *g = l->model->graph;
    char a[40], b[40];
    if (of.count && by.count) {
        COMPLAIN(l, &call->at, "the derivative of %s by %s is a matrix", shape_name(&of, a), shape_name(&by, b));
        HINT(l, "take a component of one of them");
        return wrong(l);
    }
    value v = vector(l, of.count ? of.count : by.count);
    v.derived = true;
    for (int k = 0; k < (v.count ? v.count : 1) && !failed(l); k++) {
        differential d = {.l = l, .call = call, .variable = by.item[by.count ? k : 0]};
        lower_tidy(l, true);
        v.item[k] = graph_derivative(g, of.item[of.count ? k : 0], seed, &d);
        if (d.cell_count && !failed(l)) v.item[k] = lower_cells(&d, v.item[k]);
        lower_tidy(l, false);
        arena_drop(l->model->arena, d.of_slot, l->model->scalar_slots * sizeof *d.of_slot);
        arena_drop(l->model->arena, d.line, l->model->scalar_slots * sizeof *d.line);
    }
    return failed(l) ? wrong(l) : v;
}

typedef struct replacement {
    lowering *l;
    argument *argument;
    value leaves;
} replacement;

static node argument_for(graph *g, node load, int level, void *replacement_ctx)
{
    replacement *r = replacement_ctx;
    (void)g;
    for (int k = 0; k < (r->leaves.count ? r->leaves.count : 1); k++) {
        if (r->leaves.item[k] != load) continue;
        lowering at = *r->l;
        at.levels = level;
        const value v = lower_argument(&at, r->argument);
        return failed(r->l) ? 0 : v.item[k];
    }
    return load;
}

static value no_variable(lowering *l, const tree *t)
{
    char text[80];
    COMPLAIN(l, &t->at, "diff differentiates by a variable, and %s is not one", quote(l, &t->at, text));
    HINT(l,
         "a variable is a state x, its velocity x', t, a parameter, an argument of a function, or a component of them");
    return wrong(l);
}

/* Differentiates by an argument of the function that is being expanded. */
static value by_argument(lowering *l, const tree *call, argument *a)
{
    const value now = lower_argument(l, a);
    if (now.boolean) return no_variable(l, call->item[1]);
    if (failed(l)) return wrong(l);
    argument arguments[MODEL_ARGUMENTS_MAX];
    memcpy(arguments, l->arguments, l->argument_count * sizeof *arguments);
    replacement r = {.l = l, .argument = a, .leaves = vector(l, now.count)};
    for (int k = 0; k < (now.count ? now.count : 1); k++) r.leaves.item[k] = lower_own_leaf(l);
    arguments[a - l->arguments] = (argument){.name = a->name, .known = {r.leaves}};
    lowering inner = *l;
    inner.arguments = arguments;
    const value by = lower_expression(&inner, call->item[1]);
    const value of = failed(l) ? wrong(l) : lower_numbers(&inner, call->item[0]);
    value v = failed(l) ? wrong(l) : derivative(&inner, call, of, by);
    for (int k = 0; k < (v.count ? v.count : 1) && !failed(l); k++)
        v.item[k] = graph_replace(l->model->graph, v.item[k], DEP_D, l->levels, argument_for, &r);
    return failed(l) ? wrong(l) : v;
}

value lower_diff(lowering *l, const tree *call)
{
    const tree *by = call->item[1], *name = by->kind == TREE_COMPONENT ? by->item[0] : by;
    if (name->kind != TREE_NAME) return no_variable(l, by);
    argument *a = lower_find_argument(l, name->name);
    if (a) return by_argument(l, call, a);
    const symbol s = symbols_find(l->model, name->name);
    if (s.definition && s.definition->kind != DEFINED_PARAMETER) {
        COMPLAIN(l, &by->at, "diff differentiates by a variable, and %s is a quantity", name->name);
        HINT(l, "define what depends on it as a function, V(q) = …, and take diff(V(q), q) in another function");
        return wrong(l);
    }
    if (lower_find_index(l, name->name) || !strcmp(name->name, "pi")) return no_variable(l, by);
    lowering only = *l;
    only.by_variable = true;
    const value variable = lower_expression(&only, by);
    const value of = failed(l) ? wrong(l) : lower_numbers(l, call->item[0]);
    return failed(l) ? wrong(l) : derivative(l, call, of, variable);
}
