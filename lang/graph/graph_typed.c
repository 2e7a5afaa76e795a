/* The exact value of a constant, by its decimals, beside its value in doubles.
 *
 * In the shadow of a model every decimal is the double on its other side. In 1000.7 - 1000.6 both may move by one
 * amount, so the difference does not move, and in sqrt(2)^2 - 2 nothing moves. So every constant expression, of
 * literals and of parameters that are constant expressions, is computed to twice the bits, and the shadow has the
 * double on the other side of that value.
 */
#include "lang/graph/graph_walk.h"

#include <math.h>

enum { CLEARLY = 4 }; /* in units in the last place; a smaller error of the shadow's formula is not corrected */

bool graph_keep_typed(graph *g)
{
    g->typed = arena_room(g->arena, g->capacity * sizeof *g->typed);
    if (g->typed) g->typed[0].known = false;
    return g->typed != NULL;
}

static graph_typed exactly(double value)
{
    return (graph_typed){.known = true, .plain = value, .read = value, .is = twofold_of(value)};
}

/* Returns what is known of a constant: at least that it is exactly its number. */
static graph_typed known(const graph *g, node n)
{
    const graph_node *const of = &g->nodes[n];
    return g->typed[n].known || of->op != OP_CONST ? g->typed[n] : exactly(of->value);
}

node graph_decimal(graph *g, double read, double plain, twofold is)
{
    if (!g->typed) return graph_const(g, read);
    return graph_typed_const(g, read, &(graph_typed){.known = true, .plain = plain, .read = read, .is = is});
}

/* Returns the shadow's value of a constant: beyond the exact value, as seen from the plain one. The spread counts three
 * times: that of the run, that of the shadow, and the distance of the exact value. */
static double beyond(const graph_typed *t)
{
    const double off = (t->is.high - t->plain) + t->is.low, far = fabs(off) + t->is.error + 3 * t->spread;
    const double way = off > 0 || (off == 0 && t->read > t->plain) ? 1 : -1;
    if (!isfinite(far)) return t->plain != 0 ? 2 * t->plain : 1; /* the exact value is not known, as of 0/0 */
    if (!(far > TWOFOLD_KNOWN * fabs(t->plain))) return t->plain;
    const double to = t->plain + way * far;
    return fabs(to - t->plain) < far ? nextafter(to, way * INFINITY) : to;
}

node graph_written_out(graph *g, node sum, node written)
{
    if (!g->typed || g->arena->failed || g->too_large || !known(g, written).known) return sum;
    const graph_typed t = known(g, written);
    if (fabs(beyond(&t) - t.plain) > CLEARLY * twofold_unit(t.plain)) return written;
    g->typed[sum] = t;
    return sum;
}

double graph_holds(graph *g, node value, node leaf, double number)
{
    if (!g->typed || g->arena->failed || g->too_large || !known(g, value).known) return number;
    graph_typed t = known(g, value);
    t.read = beyond(&t);
    if (leaf) g->typed[leaf] = t;
    return t.read;
}

static bool is_exact(const graph_typed *t)
{
    return t->is.high == t->plain && t->is.low == 0 && t->is.error == 0 && t->spread == 0;
}

/* Returns half a unit in the last place of a product: a run that fuses it with a sum leaves out its rounding. */
static double of_product(const graph *g, node n, const graph_typed *t)
{
    const graph_node *const of = &g->nodes[n];
    const bool product = of->op == OP_MUL || (of->op == OP_NEG && g->nodes[of->a].op == OP_MUL);
    return product && !is_exact(t) ? twofold_unit(t->plain) / 2 : 0;
}

static double spread_of(const graph *g, operation op, const node *operand, const graph_typed t[3], double plain)
{
    double all = 0;
    twofold by[3];
    for (int k = 0; k < 3; k++) {
        double spread = t[k].spread;
        if (op == OP_ADD || op == OP_SUB) spread += of_product(g, operand[k], &t[k]);
        by[k] = (twofold){t[k].plain, 0, spread};
        all += spread;
    }
    if (all == 0) return 0;
    const twofold r = twofold_value(op, by[0], by[1], by[2]);
    return r.error + fabs((r.high - plain) + r.low) + twofold_unit(plain);
}

/* Returns 0 for a sum that is smaller, beside its terms, than decimals can be. */
static twofold without_noise(operation op, twofold is, const graph_typed t[3])
{
    if (op != OP_ADD && op != OP_SUB) return is;
    const double size = fabs(t[0].is.high) + fabs(t[1].is.high);
    return fabs(is.high) + is.error <= TWOFOLD_KNOWN * size ? twofold_of(0) : is;
}

double graph_typed_op(graph *g, node *n, operation op, const node operand[3], graph_typed *of)
{
    const int arity = operation_at(op)->arity;
    graph_typed t[3] = {exactly(0), exactly(0), exactly(0)};
    bool exact = true;
    of->known = false;
    if (g->arena->failed || g->too_large) return 0;
    for (int k = 0; k < arity; k++) {
        if (*n == operand[k]) return 0;
        t[k] = known(g, operand[k]);
        if (!t[k].known) return 0;
        exact &= is_exact(&t[k]);
    }
    const bool constant = g->nodes[*n].op == OP_CONST;
    graph_typed r = {.known = true,
                     .plain = operation_value(op, t[0].plain, t[1].plain, t[2].plain),
                     .read = operation_value(op, t[0].read, t[1].read, t[2].read),
                     .is = without_noise(op, twofold_value(op, t[0].is, t[1].is, t[2].is), t)};
    if (!isfinite(r.plain)) return 0;
    if (!constant) r.spread = spread_of(g, op, operand, t, r.plain);
    if (exact && is_exact(&r)) {
        r.known = !constant;
        *of = r;
        return 0;
    }
    const double to = beyond(&r), by = to - r.read;
    if (constant) {
        r.read = to;
        *n = graph_typed_const(g, to, &r);
        return 0;
    }
    const double short_of = fabs(to - r.plain) - fabs(r.read - r.plain), unit = twofold_unit(to);
    const bool adds = short_of > unit || fabs(by) > CLEARLY * unit;
    if (adds) r.read += by;
    *of = r;
    return adds ? by : 0;
}
