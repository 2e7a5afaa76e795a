/* Operations that a number makes exact: a product with 1 or -1, a quotient by a power of two.
 *
 * Invariant: the bits are those of the operation. Such a number stands in the text as a constant, so that the compiler
 * omits the product, or multiplies in place of a division; e->assumed lists the numbers for which the text is right.
 */
#include "lang/emit/emit_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static uint32_t bound_item(const writer *w, node n)
{
    return plan_home(&w->plan, w->plan.g->nodes[n].deps, AT_RUN) == AT_BIND ? plan_find(&w->plan, n, AT_BIND) : NONE;
}

static double value_of(const writer *w, node n)
{
    const uint32_t item = bound_item(w, n);
    return item == NONE ? NAN : w->value[item];
}

/* Computes what is bound with the parameters, outside loops, for the present parameters. */
void emit_values(writer *w)
{
    const plan_region *bind = &w->plan.regions.at[AT_BIND];
    if (!w->e->pool || w->e->lanes) return;
    w->value = arena_room(w->e->text.arena, (w->plan.items.count + 1) * sizeof *w->value);
    for (uint32_t k = 0; w->value && k < w->plan.items.count; k++) w->value[k] = NAN;
    for (uint32_t k = 0; w->value && k < bind->item_count; k++) {
        const uint32_t item = w->plan.order[bind->items + k];
        const graph_node *n = &w->plan.g->nodes[w->plan.items.at[item].n];
        const int arity = operation_at(n->op)->arity;
        if (n->op == OP_CONST)
            w->value[item] = n->value;
        else if (n->op == OP_PARAM)
            w->value[item] = w->e->pool[n->a];
        else if (arity > 0)
            w->value[item] = operation_value(n->op, value_of(w, n->a), arity > 1 ? value_of(w, n->b) : 0,
                                             arity > 2 ? value_of(w, n->c) : 0);
    }
}

static void assume(emit *e, uint32_t place, double value)
{
    for (uint32_t k = 0; k < e->assumed_count; k++)
        if (e->assumed[k].place == place) return;
    if (!arena_more(e->text.arena, &e->assumed, e->assumed_count, &e->assumed_room, sizeof *e->assumed)) return;
    e->assumed[e->assumed_count++] = (emit_assumed){place, value};
}

static bool is_one(double x) { return fabs(x) == 1; }

/* Returns whether x is a power of two whose reciprocal is a double, too. */
static bool is_power_of_two(double x)
{
    int exponent;
    return fabs(frexp(x, &exponent)) == 0.5 && exponent > -1000 && exponent < 1000;
}

/* Returns whether an operand of the running function has a wanted value, and notes that the text relies on it. */
static bool relies(writer *w, node n, bool (*wanted)(double), double *value)
{
    const uint32_t item = bound_item(w, n);
    if (item == NONE || w->plan.g->nodes[n].op == OP_CONST || !wanted(w->value[item])) return false;
    *value = w->value[item];
    assume(w->e, w->fixed[item], *value);
    return true;
}

static void write_number(writer *w, node user, double value, char out[48])
{
    char number[EMIT_NUMBER];
    emit_number(value, number);
    snprintf(out, 48, emit_wide(w, user) ? "MANY(%s)" : "%s", number);
}

/* Writes a fused operation whose operand `factor` is 1 or -1 as a sum or a difference. */
static void write_sum_of(unsigned *op, int factor, double value, char operand[3][48])
{
    char product[48], third[48];
    const bool negative = (value < 0) != (*op == OP_FNMA);
    if (*op == OP_FMS && negative) return;
    memcpy(product, operand[1 - factor], sizeof product);
    memcpy(third, operand[2], sizeof third);
    memcpy(operand[0], negative ? third : product, sizeof product);
    memcpy(operand[1], negative ? product : third, sizeof product);
    *op = *op == OP_FMS || negative ? OP_SUB : OP_ADD;
}

void emit_exact(writer *w, node user, unsigned *op, char operand[3][48])
{
    const graph_node *n = &w->plan.g->nodes[user];
    const bool fused = n->op == OP_FMA || n->op == OP_FMS || n->op == OP_FNMA;
    double value;
    if (!w->value || w->part != RUNNING) return;
    if (n->op == OP_DIV) {
        if (relies(w, n->b, is_power_of_two, &value)) write_number(w, user, value, operand[1]);
        return;
    }
    if (n->op != OP_MUL && !fused) return;
    const int factor = relies(w, n->a, is_one, &value) ? 0 : relies(w, n->b, is_one, &value) ? 1 : -1;
    if (factor < 0) return;
    if (fused)
        write_sum_of(op, factor, value, operand);
    else
        write_number(w, user, value, operand[factor]);
}
