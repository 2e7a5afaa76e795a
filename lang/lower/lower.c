/* Lowers expressions that other expressions contain. */
#include "lang/lower/lower_parts.h"

void lower_start(lowering *l, model *m, lower_place place, const char *what)
{
    *l = (lowering){.model = m, .place = place, .what = what, .terms = 1};
}

bool lower_no_matrix(lowering *l, const value *v, const tree *t)
{
    char text[80];
    if (failed(l) || !v->rows) return true;
    quote(l, &t->at, text);
    COMPLAIN(l, &t->at, "%s is a matrix, which can only be a factor", text);
    if (t->kind == TREE_NAME)
        HINT(l, "write %s x, or %s[1, 2] for an entry", text, text);
    else
        HINT(l, "write it before a vector");
    return false;
}

value lower_factor(lowering *l, const tree *t)
{
    model *m = l->model;
    if (!model_deeper(m, &t->at)) return wrong(l);
    value v = m->lower(l, t);
    m->depth--;
    return v;
}

value lower_expression(lowering *l, const tree *t)
{
    value v = lower_factor(l, t);
    return lower_no_matrix(l, &v, t) ? v : wrong(l);
}

value lower_numbers(lowering *l, const tree *t)
{
    value v = lower_expression(l, t);
    lower_as_number(l, &v);
    return v;
}

node lower_scalar(lowering *l, const tree *t, const char *what)
{
    value v = lower_numbers(l, t);
    char shape[40];
    if (!failed(l) && v.count > 0) COMPLAIN(l, &t->at, "%s is a number, but this is %s", what, shape_name(&v, shape));
    return failed(l) ? 0 : v.item[0];
}

/* Lowers a matrix, [[2, -1], [-1, 2]], by rule [18]: rows of numbers. */
value lower_matrix(lowering *l, const tree *t)
{
    const uint32_t columns = t->item[0]->count;
    if ((double)t->count * columns > MODEL_COMPONENTS_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at, "a matrix has at most %d numbers",
                        MODEL_COMPONENTS_MAX);
        return wrong(l);
    }
    value v = vector(l, (int)(t->count * columns));
    for (uint32_t i = 0; i < t->count; i++) {
        const tree *row = t->item[i];
        if (row->kind != TREE_LIST || row->count != columns) {
            COMPLAIN(l, &row->at, "the rows of a matrix are lists of one length");
            return wrong(l);
        }
        for (uint32_t k = 0; k < columns && !failed(l); k++)
            v.item[i * columns + k] = lower_scalar(l, row->item[k], "an entry of a matrix");
    }
    v.count = (int)columns;
    v.rows = (int)t->count;
    return v;
}

void lower_as_number(lowering *l, value *v)
{
    graph *g = l->model->graph;
    if (failed(l) || !v->boolean) return;
    *v = scalar(l, graph_op(g, OP_SELECT, v->item[0], graph_const(g, 1), graph_const(g, 0)));
}

static bool constant(const graph *g, node n, double is)
{
    const graph_node *const c = graph_at(g, n);
    return c->op == OP_CONST && c->value == is;
}

void lower_as_decided(lowering *l, value *v)
{
    const graph *g = l->model->graph;
    if (failed(l) || v->boolean || v->count || v->rows) return;
    const graph_node *const choice = graph_at(g, v->item[0]);
    if (choice->op == OP_SELECT && constant(g, choice->b, 1) && constant(g, choice->c, 0)) *v = condition(l, choice->a);
}

void lower_as_condition(lowering *l, value *v)
{
    lower_as_decided(l, v);
    if (failed(l) || v->boolean || v->count || v->rows) return;
    const unsigned deps = graph_deps(l->model->graph, v->item[0]), moves = DEP_TIME | DEP_D | (DEP_STATE & ~DEP_MODE);
    if (deps & (DEP_MODE | DEP_PARAM) && !(deps & moves))
        *v = condition(l, binary(l, OP_NE, v->item[0], graph_const(l->model->graph, 0)));
}
