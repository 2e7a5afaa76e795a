/* Numbers in the text, and pi. */
#include "lang/lower/lower_parts.h"

#include "base/decimal.h"

value lower_number(lowering *l, const tree *t)
{
    const source *const s = &l->model->source;
    graph *const g = l->model->graph;
    double number, other, rest;
    const char *const text = s->texts[t->at.text].bytes + t->at.from;
    if (!s->nudged || !decimal_read_between(text, t->at.to - t->at.from, &number, &other, &rest) ||
        other != t->number || other == number)
        return scalar(l, graph_const(g, t->number));
    return scalar(l, graph_decimal(g, other, number, (twofold){number, rest, twofold_unit(number) * 0x1p-53}));
}

/* pi, 3.14159265358979323846…, lies between the double and the next one. */
value lower_pi(lowering *l)
{
    static const twofold is = {0x1.921fb54442d18p1, 0x1.1a62633145c07p-53, 0x1p-106};
    return scalar(l, l->model->source.nudged ? graph_decimal(l->model->graph, 0x1.921fb54442d19p1, is.high, is)
                                             : graph_const(l->model->graph, is.high));
}
