/* What decimals say of a constant, beside what doubles make of it. See lower_parts.h.
 *
 * The shadow of a model (api/shadow.c) has every decimal as the double on its other side. In 1000.7 - 1000.6 both may
 * move by the same amount, of which the difference shows nothing; and the difference has finer doubles, so that its
 * error is known better than by their steps. So sums and differences of decimals, and of parameters that are such, are
 * computed as they are written, to twice the bits, and are in the shadow the double on the other side of that.
 */
#include "lang/lower/lower_parts.h"

#include "base/decimal.h"

#include <math.h>

#define KNOWN 0x1p-90 /* of the terms: what is computed of a sum of them is as exact as that */
enum { CLEARLY = 4 }; /* units in the last place: a smaller change of a formula's result is left to its terms */

static void keep(lowering *l, value *v, typed t)
{
    typed *const to = arena_take(l->model->arena, sizeof *to);
    if (l->model->arena->failed || !isfinite(t.plain)) return;
    *to = t;
    v->typed = to;
}

value lower_number(lowering *l, const tree *t)
{
    const source *const s = &l->model->source;
    value v = scalar(l, graph_const(l->model->graph, t->number));
    if (!s->nudged) return v;
    double number, other, rest;
    const char *const text = s->texts[t->at.text].bytes + t->at.from;
    if (!decimal_read_between(text, t->at.to - t->at.from, &number, &other, &rest) || other != t->number) return v;
    keep(l, &v, (typed){.plain = number, .read = other, .high = number, .low = rest});
    return v;
}

static double ulp_of(double x) { return nextafter(fabs(x), INFINITY) - fabs(x); }

/* The double on the other side of high + low, as seen from the plain one. */
static double beyond(const typed *t, double size)
{
    const double off = (t->high - t->plain) + t->low, way = off > 0 ? INFINITY : -INFINITY;
    if (!(fabs(off) > KNOWN * size)) return t->plain;
    return t->low == 0 || (t->low > 0) == (off < 0) ? t->high : nextafter(t->high, way); /* high is the nearest */
}

void lower_typed_sum(lowering *l, value *sum, const value *a, const value *b, bool add)
{
    if (!a->typed || !b->typed || failed(l)) return;
    graph *const g = l->model->graph;
    const typed x = *a->typed, y = *b->typed;
    const double sign = add ? 1 : -1, high = x.high + sign * y.high, of_y = high - x.high;
    const double low = (x.high - (high - of_y)) + (sign * y.high - of_y) + (x.low + sign * y.low);
    typed t = {.plain = x.plain + sign * y.plain, .read = x.read + sign * y.read, .high = high + low};
    t.low = low - (t.high - high);
    const double to = beyond(&t, fabs(x.plain) + fabs(y.plain)), by = to - t.read;
    const bool constant = graph_at(g, sum->item[0])->op == OP_CONST;
    if (constant) sum->item[0] = graph_const(g, to), t.read = to;
    if (!constant && fabs(by) > CLEARLY * ulp_of(to))
        sum->item[0] = binary(l, OP_ADD, sum->item[0], graph_const(g, by)), t.read += by;
    keep(l, sum, t);
}

void lower_typed_negative(lowering *l, value *v, const value *of)
{
    if (!of->typed || failed(l)) return;
    const typed t = *of->typed;
    keep(l, v, (typed){.plain = -t.plain, .read = -t.read, .high = -t.high, .low = -t.low});
}
