/* Writes a program in Taylor series: a function that computes coefficient n of every value, by the recurrences of
 * step/series.h.
 *
 * Invariant: every value is a real, in the memory that lang/graph/expansion.h gives it, and every region walks through
 * that memory as the interpreter does. If all values lie in loops over a family's index, a real is a vector of WIDTH
 * values of that index (`series_wide`), and the states have copies there. The text grows with the graph, not with the
 * order. A region begins with the inner sums of all its recurrences, in one loop, so each coefficient is fetched once
 * for all of them.
 */
#include "lang/emit/emit_parts.h"

#include <stdio.h>
#include <string.h>

enum { OPERAND_MAX = 64 };

/* Operands --------------------------------------------------------------------------------------------------------- */

static void operand(const writer *w, node n, char out[OPERAND_MAX])
{
    const uint32_t home = plan_home(&w->plan, w->plan.g->nodes[n].deps, w->region), item = plan_find(&w->plan, n, home);
    const int last = home == AT_BIND ? 0 : w->expansion.values[item].last;
    if (home == AT_BIND)
        snprintf(out, OPERAND_MAX, "SERIES(&c%u, 0)", item);
    else if (last < EXPANSION_ALL)
        snprintf(out, OPERAND_MAX, "SERIES(z%u, %d)", item, last);
    else
        snprintf(out, OPERAND_MAX, "SERIES(z%u, SERIES_ALL)", item);
}

/* Writes what depends on parameters alone, as reals. */
static void write_bound(writer *w)
{
    const plan_region *bind = &w->plan.regions.at[AT_BIND];
    char number[EMIT_NUMBER];
    for (uint32_t k = 0; k < bind->item_count; k++) {
        const uint32_t item = w->plan.order[bind->items + k];
        const graph_node *n = &w->plan.g->nodes[w->plan.items.at[item].n];
        const bool wide = emit_wide(w, w->plan.items.at[item].n);
        if (n->op == OP_CONST)
            emit_line(w, "const real c%u = SERIES_NUMBER(%s);", item, emit_number(n->value, number));
        else
            emit_line(w, wide ? "const real c%u = AT(w, %u);" : "const real c%u = SERIES_NUMBER(u[%u]);", item,
                      w->fixed[item]);
    }
}

static bool in_lanes(const writer *w) { return w->e->lanes || w->e->series_wide; }

/* Inner sums ------------------------------------------------------------------------------------------------------- */

static const char *sums_of(unsigned op) { return operation_at((operation)op)->sums; }

static bool never_ends(const writer *w, node n)
{
    const uint32_t home = plan_home(&w->plan, w->plan.g->nodes[n].deps, w->region);
    return home != AT_BIND && w->expansion.values[plan_find(&w->plan, n, home)].last == EXPANSION_ALL;
}

/* Returns the operation whose recurrence an item has; for the update of a sum it is the product that it adds. */
static const graph_node *recurrence_of(const writer *w, uint32_t item)
{
    const graph *g = w->plan.g;
    const plan_item *i = &w->plan.items.at[item];
    const uint32_t whole = plan_updates(&w->plan, i);
    return &g->nodes[whole == NONE ? i->n : g->nodes[w->plan.items.at[whole].n].a];
}

/* Returns whether the inner sums of an item's recurrence are taken in advance: none of their series ends. */
static bool has_inner(const writer *w, uint32_t item)
{
    const graph_node *n = recurrence_of(w, item);
    const expansion_value *v = &w->expansion.values[item];
    const bool update = plan_updates(&w->plan, &w->plan.items.at[item]) != NONE;
    if (w->shared && !w->in_pairs && w->shared[item].role != ALONE) return false;
    if (!*sums_of(n->op) || (!update && (v->state || v->twin != NONE || v->last < EXPANSION_ALL))) return false;
    for (const char *s = sums_of(n->op); *s; s++)
        if (!(*s == 'r' || never_ends(w, *s == 'b' ? n->b : n->a))) return false;
    return true;
}

/* Writes one of the series of an inner sum, as operations.def names it. */
static void write_factor(const writer *w, uint32_t item, char which, char out[OPERAND_MAX])
{
    const graph_node *n = recurrence_of(w, item);
    if (which == 'a' || which == 'b') {
        const node x = which == 'a' ? n->a : n->b;
        snprintf(out, OPERAND_MAX, "z%u",
                 plan_find(&w->plan, x, plan_home(&w->plan, w->plan.g->nodes[x].deps, w->region)));
    } else if (which == 'r') {
        snprintf(out, OPERAND_MAX, "z%u", item);
    } else {
        snprintf(out, OPERAND_MAX, "(z%u + %d)", item, (which - '0') * w->expansion.length);
    }
}

typedef struct inner_sum {
    uint32_t item;
    int k; /* the number of the sum in its item */
    bool square;
    char f[OPERAND_MAX], g[OPERAND_MAX];
} inner_sum;

static void write_inner(writer *w, const inner_sum *sums, int count)
{
    OPEN(w, "if (n > 3) {");
    emit_line(w, "const int half = n / 2;");
    for (int k = 0; k < count; k++) {
        const inner_sum *s = &sums[k];
        emit_line(w, "real p%d = n %% 2 ? SERIES_NUMBER(0.0) : 0.5 * %s[half] * %s[half];", k, s->f, s->g);
        if (!s->square) emit_line(w, "real q%d = p%d;", k, k);
    }
    if (!in_lanes(w)) emit_line(w, "#pragma GCC unroll 2");
    OPEN(w, "for (int m = (n - 1) / 2, k = n - m; m >= 2; m--, k++) {");
    for (int k = 0; k < count; k++) {
        const inner_sum *s = &sums[k];
        emit_line(w, "p%d = SERIES_FMA(%s[m], %s[k], p%d);", k, s->f, s->g, k);
        if (!s->square) emit_line(w, "q%d = SERIES_FMA(%s[k], %s[m], q%d);", k, s->f, s->g, k);
    }
    CLOSE(w);
    for (int k = 0; k < count; k++)
        emit_line(w, "i%u[%d] = p%d + %c%d;", sums[k].item, sums[k].k, k, sums[k].square ? 'p' : 'q', k);
    CLOSE(w);
}

/* Writes the inner sums of a region, as many in one loop as registers hold. */
static void write_inner_sums(writer *w, const plan_region *r)
{
    enum { TOGETHER = 8 };
    inner_sum sums[TOGETHER];
    int count = 0;
    for (uint32_t j = 0; j < r->item_count; j++) {
        const uint32_t item = w->plan.order[r->items + j];
        if (!has_inner(w, item)) continue;
        const char *s = sums_of(recurrence_of(w, item)->op);
        emit_line(w, "real i%u[%zu];", item, strlen(s) / 2);
        for (int k = 0; s[2 * k]; k++) {
            inner_sum *sum = &sums[count];
            *sum = (inner_sum){.item = item, .k = k};
            write_factor(w, item, s[2 * k], sum->f);
            write_factor(w, item, s[2 * k + 1], sum->g);
            sum->square = !strcmp(sum->f, sum->g);
            emit_line(w, "i%u[%d] = SERIES_NUMBER(0.0);", item, k);
            if (++count < TOGETHER) continue;
            write_inner(w, sums, count);
            count = 0;
        }
    }
    if (count) write_inner(w, sums, count);
}

/* Values ----------------------------------------------------------------------------------------------------------- */

static const char *prefix(const writer *w) { return in_lanes(w) ? "ops" : "op"; }

static void use(writer *w, operation op) { *(in_lanes(w) ? &w->e->used_lanes : &w->e->used) |= (uint64_t)1 << op; }

/* Returns whether a value differs from lane to lane of an index; its text then stands for lane l, within
 * LANES_OF_INDEX. */
static bool along(const writer *w, node n) { return w->along >= 0 && w->plan.g->nodes[n].deps >> w->along & 1; }

/* Writes a number of every lane as a real. */
static void write_number(writer *w, uint32_t item, const char *at, const char *number)
{
    const char *spread = along(w, w->plan.items.at[item].n) ? "LANES_OF_INDEX" : "SERIES_NUMBER";
    emit_line(w, "%sz%u[%s] = %s(%s);", *at == 'n' ? "" : "if (n == 0) ", item, at, spread, number);
}

static void write_leaf(writer *w, uint32_t item, const graph_node *n)
{
    const graph *g = w->plan.g;
    char place[PLACE_MAX];
    switch (n->op) {
    case OP_TIME: emit_line(w, "if (n <= 1) z%u[n] = n ? SERIES_NUMBER(1.0) : SERIES_NUMBER(t);", item); break;
    case OP_INDEX:
        snprintf(place, sizeof place, n->level == w->along ? "(double)(j%d + l)" : "(double)j%d", n->level);
        write_number(w, item, "0", place);
        break;
    default: emit_address(w, &g->references[n->a], g->references[n->a].dims, place); write_number(w, item, "0", place);
    }
}

static void write_operation(writer *w, uint32_t item, const graph_node *n)
{
    const expansion_value *v = &w->expansion.values[item];
    const int arity = operation_at(n->op)->arity;
    const node operands[3] = {n->a, n->b, n->c};
    char text[3][OPERAND_MAX] = {"", "", ""};
    for (int i = 0; i < arity; i++) operand(w, operands[i], text[i]);
    use(w, n->op);
    if (v->last == 0) {
        emit_line(w, "if (n == 0) z%u[0] = %s_%d(%s.at[0]%s%s%s%s%s%s);", item, prefix(w), n->op, text[0],
                  arity > 1 ? ", " : "", text[1], arity > 1 ? ".at[0]" : "", arity > 2 ? ", " : "", text[2],
                  arity > 2 ? ".at[0]" : "");
        return;
    }
    w->e->used_series |= (uint64_t)1 << n->op;
    char limit[40] = "";
    if (v->last < EXPANSION_ALL) snprintf(limit, sizeof limit, "if (n <= %d) ", v->last);
    char given[24] = "SERIES_NONE";
    if (has_inner(w, item)) snprintf(given, sizeof given, "i%u", item);
    emit_line(w, "%sseries_%d(z%u, %s%s%s%s%s, n, %s);", limit, n->op, item, text[0], arity > 1 ? ", " : "", text[1],
              arity > 2 ? ", " : "", text[2], given);
}

static void write_outputs(writer *w, uint32_t first)
{
    enum { STORES_TOGETHER = 64 }; /* as emit_value.c divides stores */
    char value[OPERAND_MAX], place[PLACE_MAX];
    for (uint32_t k = first; k != NONE; k = w->plan.next_output[k]) {
        const output *o = &w->plan.program->outputs[k];
        const uint8_t to = w->plan.g->arrays[o->to.array].space;
        operand(w, o->value, value);
        emit_element(w, &o->to, o->to.dims, place);
        if (w->e->series_wide)
            emit_line(w, "for (int l = 0; l < lanes; l++) AT(a, %s) = LANE_OF(series_at(%s, n), l);", place, value);
        else if (to == SPACE_X || to == SPACE_V)
            emit_line(w, "%s[(%s) * %d + n] = series_at(%s, n);", to == SPACE_X ? "x" : "v", place, w->expansion.length,
                      value);
        else
            emit_line(w, "AT(a, %s) = series_at(%s, n);", place, value);
        if (w->plan.regions.at[w->region].level < 0 && ++w->stores % STORES_TOGETHER == 0)
            emit_line(w, "__asm__ volatile(\"\" ::: \"memory\");");
    }
}

/* Writes where the series of a value begins; if the value passes, such that coefficient n is always in one place. */
static void write_place(writer *w, uint32_t item)
{
    const plan_item *i = &w->plan.items.at[item];
    const graph_node *n = &w->plan.g->nodes[i->n];
    const expansion_value *v = &w->expansion.values[item];
    if (plan_updates(&w->plan, i) != NONE) return;
    if (w->shared && i->region == w->sharing) {
        const shared_value *s = &w->shared[item];
        if (s->role == ALONE || s->role == FRONT)
            emit_line(w, "real *const z%u = g%u + %u%s;", item, i->region, s->own,
                      v->passing || s->role == FRONT ? " - n" : "");
    } else if (v->twin != NONE) {
        emit_line(w, "const real *const z%u = z%u + %d;", item, v->twin, w->expansion.length);
    } else if (v->state && !w->e->series_wide) {
        const reference *r = &w->plan.g->references[n->a];
        char place[PLACE_MAX];
        emit_element(w, r, r->dims, place);
        emit_line(w, "const real *const z%u = %s + (%s) * %d;", item,
                  w->plan.g->arrays[r->array].space == SPACE_X ? "x" : "v", place, w->expansion.length);
    } else {
        emit_line(w, "real *const z%u = g%u + %u%s;", item, i->region, v->at, v->passing ? " - n" : "");
    }
}

/* Writes the copy of coefficient n of a state, in every lane. */
static void write_copy(writer *w, uint32_t item, const graph_node *n)
{
    const reference *r = &w->plan.g->references[n->a];
    char place[PLACE_MAX], number[PLACE_MAX + 40];
    emit_element(w, r, r->dims, place);
    snprintf(number, sizeof number, "%s[(%s) * %d + n]", w->plan.g->arrays[r->array].space == SPACE_X ? "x" : "v",
             place, w->expansion.length);
    write_number(w, item, "n", number);
}

static void write_item(writer *w, uint32_t item)
{
    const plan_item *i = &w->plan.items.at[item];
    const graph_node *n = &w->plan.g->nodes[i->n];
    const expansion_value *v = &w->expansion.values[item];
    if (w->shared && i->region == w->sharing && w->shared[item].role != ALONE) {
        if (w->shared[item].role == FRONT)
            emit_line(w, "z%u[n] = index_load(&both[((%u * n0 + j1 - f0) * v0 + (j0 - f0) / WIDTH) * WIDTH]);", item,
                      w->shared[item].front);
    } else if (v->state) {
        if (w->e->series_wide) write_copy(w, item, n);
    } else if (v->twin == NONE) {
        if (n->op == OP_SUM && v->last < EXPANSION_ALL)
            emit_line(w, "if (n <= %d) z%u[n] = r%u;", v->last, item, item);
        else if (n->op == OP_SUM)
            emit_line(w, "z%u[n] = r%u;", item, item);
        else if (operation_at(n->op)->arity == 0)
            write_leaf(w, item, n);
        else
            write_operation(w, item, n);
    }
    write_outputs(w, i->outputs);
}

/* Loops ------------------------------------------------------------------------------------------------------------ */

static void write_region(writer *w, uint32_t region);

static void write_update(writer *w, uint32_t item)
{
    const plan_item *update = &w->plan.items.at[item];
    const uint32_t whole = plan_updates(&w->plan, update);
    const graph_node *sum = &w->plan.g->nodes[w->plan.items.at[whole].n], *how = &w->plan.g->nodes[sum->a];
    char p[OPERAND_MAX], q[OPERAND_MAX], c[OPERAND_MAX], next[4 * OPERAND_MAX + 80];
    operand(w, how->op == OP_ADD ? how->b : how->a, p);
    if (how->op == OP_ADD) {
        snprintf(next, sizeof next, "s%u[k] + series_at(%s, n)", whole, p);
    } else {
        operand(w, how->b, q);
        const char *sign = how->op == OP_FNMA ? "-" : "";
        char given[24] = "SERIES_NONE";
        if (has_inner(w, item)) snprintf(given, sizeof given, "i%u", item);
        snprintf(next, sizeof next,
                 "n ? s%u[k] %s series_product(%s, %s, n, %s) : SERIES_FMA(%s%s.at[0], %s.at[0], s%u[k])", whole,
                 *sign ? sign : "+", p, q, given, sign, p, q, whole);
    }
    if (sum->b) {
        operand(w, sum->b, c);
        emit_line(w, "s%u[k] = SERIES_PICK(%s.at[0] != 0, (%s), s%u[k]);", whole, c, next, whole);
    } else {
        emit_line(w, "s%u[k] = %s;", whole, next);
    }
}

/* Writes coefficient n of the positions or velocities that pairs read, side by side. */
static void write_cells(writer *w, const plan_region *r)
{
    char place[PLACE_MAX];
    for (uint32_t k = 0; k < r->item_count; k++) {
        const uint32_t item = w->plan.order[r->items + k];
        const graph_node *n = &w->plan.g->nodes[w->plan.items.at[item].n];
        if (w->shared[item].role != CELL) continue;
        const reference *from = &w->plan.g->references[n->a];
        emit_line(w, "double *const x%u = (double *)p;", item);
        emit_line(w, "p += v0;");
        emit_element(w, from, from->dims, place);
        emit_line(w, "for (int64_t j%d = f0; j%d < f0 + n0; j%d++) x%u[j%d - f0] = %s[(%s) * %d + n];", r->level,
                  r->level, r->level, item, r->level, w->plan.g->arrays[from->array].space == SPACE_X ? "x" : "v",
                  place, w->expansion.length);
    }
}

/* Writes the positions and velocities of the first or second cells of pairs. */
static void write_ends(writer *w, const plan_region *r)
{
    for (uint32_t k = 0; k < r->item_count; k++) {
        const uint32_t item = w->plan.order[r->items + k];
        if (w->shared[item].role != CELL) continue;
        emit_line(w, "real *const z%u = pair + %u - n;", item, w->shared[item].at);
        emit_line(w, "z%u[n] = LANES_OF_INDEX(x%u[a%d[l]]);", item, item, r->level);
    }
}

/* Writes which cells the pairs have, WIDTH pairs in a frame; order 0 finds them. */
static void write_which(writer *w)
{
    emit_line(w, "int64_t *const a0 = (int64_t *)p, *const a1 = a0 + WIDTH;");
    emit_line(w, "p += 2;");
    emit_line(w, "const int lanes = n0 * (n0 - 1) / 2 - j < WIDTH ? (int)(n0 * (n0 - 1) / 2 - j) : WIDTH;");
    emit_line(w, "for (int l = 0; n == 0 && l < lanes; l++) {");
    emit_line(w, "    a0[l] = i0, a1[l] = i1;");
    emit_line(w, "    if (++i1 == n0) i0++, i1 = i0 + 1;");
    emit_line(w, "}");
}

/* Writes the values of every pair, WIDTH pairs at a time, and the matrix of their fronts. */
static void write_pairs(writer *w, uint32_t family, const char *first, const char *last)
{
    const plan_region *f = &w->plan.regions.at[family], *r = &w->plan.regions.at[w->sharing];
    emit_line(w, "const int64_t f0 = %s, n0 = %s - f0 + 1, v0 = (n0 + WIDTH - 1) / WIDTH;", first, last);
    emit_line(w, "double *const both = (double *)p;");
    emit_line(w, "p += %u * n0 * v0;", w->fronts);
    write_cells(w, f);
    write_cells(w, r);
    emit_line(w, "int64_t i0 = 0, i1 = 1;");
    OPEN(w, "for (int64_t j = 0; j < n0 * (n0 - 1) / 2; j += WIDTH) {");
    write_which(w);
    emit_line(w, "real *const pair = p;");
    emit_line(w, "p += %u;", w->pair_frame);
    w->region = w->sharing;
    w->in_pairs = true;
    write_ends(w, f);
    write_ends(w, r);
    for (uint32_t k = 0; k < r->item_count; k++) {
        const uint32_t item = w->plan.order[r->items + k];
        const shared_value *s = &w->shared[item];
        if (s->role == PAIR || s->role == FRONT)
            emit_line(w, "real *const z%u = pair + %u%s;", item, s->at,
                      w->expansion.values[item].passing ? " - n" : "");
    }
    write_inner_sums(w, r);
    for (uint32_t k = 0; k < r->item_count; k++) {
        const uint32_t item = w->plan.order[r->items + k];
        if (w->shared[item].role < PAIR) continue;
        write_operation(w, item, &w->plan.g->nodes[w->plan.items.at[item].n]);
    }
    OPEN(w, "for (int l = 0; l < lanes; l++) {");
    for (uint32_t k = 0; k < r->item_count; k++) {
        const uint32_t item = w->plan.order[r->items + k], front = w->shared[item].front;
        if (w->shared[item].role != FRONT) continue;
        emit_line(w, "both[(%u * n0 + a1[l]) * v0 * WIDTH + a0[l]] = LANE_OF(z%u[n], l);", front, item);
        emit_line(w, "both[(%u * n0 + a0[l]) * v0 * WIDTH + a1[l]] = %sLANE_OF(z%u[n], l);", front,
                  emit_is_odd(w, w->plan.items.at[item].n) ? "-" : "", item);
    }
    CLOSE(w);
    w->in_pairs = false;
    CLOSE(w);
}

/* Writes a loop over a family's index, WIDTH values at a time; `lanes` of them are in the family, and the others repeat
 * the last of these. */
static void write_wide_loop(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    const uint32_t around = w->region;
    const int level = r->level;
    char first[PLACE_MAX], last[PLACE_MAX];
    emit_bound(w, &r->range.first, first);
    emit_bound(w, &r->range.last, last);
    const bool shares = emit_series_shares(w, region);
    if (shares) {
        OPEN(w, "{");
        write_pairs(w, region, first, last);
    }
    OPEN(w, "for (int64_t j%d = %s, e%d = %s; j%d <= e%d; j%d += WIDTH) {", level, first, level, last, level, level,
         level);
    emit_line(w, "const int lanes = e%d - j%d + 1 < WIDTH ? (int)(e%d - j%d) + 1 : WIDTH;", level, level, level, level);
    w->along = level, w->one_by_one = true;
    write_region(w, region);
    w->along = -1, w->one_by_one = false;
    w->region = around;
    CLOSE(w);
    if (shares) {
        w->shared = NULL;
        CLOSE(w);
    }
}

static void write_loop(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    const uint32_t around = w->region;
    const int level = r->level;
    char first[PLACE_MAX], last[PLACE_MAX];
    if (w->e->series_wide && !r->sum && w->along < 0) {
        write_wide_loop(w, region);
        return;
    }
    emit_bound(w, &r->range.first, first);
    emit_bound(w, &r->range.last, last);
    EACH_SUM(k, r)
    {
        emit_line(w, in_lanes(w) ? "real s%u[8] = {{0}};" : "real s%u[8] = {0};", k);
        w->plan.items.at[k].reg = 0; /* it has been written */
    }
    OPEN(w, "{");
    emit_line(w, "const int64_t f%d = %s, n%d = %s - f%d + 1;", level, first, level, last, level);
    OPEN(w, "for (int64_t m%d = 0; m%d < n%d; m%d++) {", level, level, level, level);
    emit_line(w, "const int64_t j%d = f%d + m%d, k = n%d > 16 ? m%d & 7 : 0;", level, level, level, level, level);
    emit_line(w, "(void)k;");
    write_region(w, region);
    w->region = around;
    CLOSE(w);
    CLOSE(w);
    EACH_SUM(k, r)
    emit_total(w, k, "real", first, last);
}

static void write_region(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    w->region = region;
    emit_line(w, "real *const g%u = p;", region);
    emit_line(w, "p += %u;", w->shared && region == w->sharing ? w->own_frame : w->expansion.frames[region]);
    for (uint32_t k = 0; k < r->item_count; k++) write_place(w, w->plan.order[r->items + k]);
    write_inner_sums(w, r);
    write_outputs(w, r->outputs);
    for (uint32_t k = 0; k < r->item_count && !w->plan.failed; k++) {
        const uint32_t item = w->plan.order[r->items + k];
        const plan_item *i = &w->plan.items.at[item];
        const uint32_t inside = plan_inside(&w->plan, i);
        if (inside != NONE && i->reg == NONE) write_loop(w, inside);
        w->region = region;
        if (plan_updates(&w->plan, i) != NONE)
            write_update(w, item);
        else
            write_item(w, item);
    }
    for (uint32_t k = r->first_child; k != NONE && !w->plan.failed; k = w->plan.regions.at[k].next)
        if (!w->plan.regions.at[k].sum) {
            write_loop(w, k);
            w->region = region;
        }
}

/* The function ----------------------------------------------------------------------------------------------------- */

/* Returns whether all values lie in loops over the first index of families, with bounds that do not depend on it. */
static bool can_be_wide(const writer *w)
{
    bool any = false;
    if (!w->e->vectors || w->e->lanes || w->expansion.frames[AT_RUN]) return false;
    for (uint32_t k = AT_RUN + 1; k < w->plan.regions.count; k++) {
        const plan_region *r = &w->plan.regions.at[k];
        const int level = r->range.first.level, last = r->range.last.level;
        if (r->parent == AT_BIND) continue;
        if (r->parent == AT_RUN && (r->sum || r->level != 0)) return false;
        if (r->parent != AT_RUN && (level == 0 || last == 0)) return false;
        any |= r->parent == AT_RUN;
    }
    for (size_t k = 0; k < w->plan.program->count; k++) {
        const uint8_t to = w->plan.g->arrays[w->plan.program->outputs[k].to.array].space;
        if (to == SPACE_X || to == SPACE_V || !(w->plan.g->nodes[w->plan.program->outputs[k].value].deps & 1))
            return false;
    }
    return any;
}

/* Writes the head of the function. noclone: a copy for order 0 would be compiled as long as the function. */
static void write_head(writer *w, const char *name)
{
    const char *real = w->e->series_wide ? "double" : "real";
    SAY(w,
        "%sstatic %s *%s(const double *restrict pool, const int64_t *restrict q, const double *restrict u, const %s "
        "*restrict w, %s *restrict own, const int n, const clock t, %s *x, %s *v, %s *p, %s *a)\n",
        w->e->series_wide ? "__attribute__((noclone)) " : "", real, name, real, real, real, real, real, real);
}

static void write_body(writer *w)
{
    SAY(w, "{\n    (void)pool, (void)q, (void)u, (void)w, (void)own, (void)t, (void)x, (void)v, (void)a;\n");
    write_bound(w);
    if (w->e->series_wide) { /* vectors begin at a multiple of their size */
        emit_line(w, "double *const memory = p;");
        emit_line(w, "{");
        emit_line(w, "real *p = (real *)(((uintptr_t)memory + sizeof(real) - 1) & ~(uintptr_t)(sizeof(real) - 1));");
    }
    emit_line(w, "p += %d;", w->expansion.length); /* values that pass begin before that */
    write_region(w, AT_RUN);
    if (w->e->series_wide) emit_line(w, "}");
    emit_line(w, "return p;");
    SAY(w, "}\n\n");
}

void emit_series_pass(writer *w, const char *name)
{
    if (!expansion_place(&w->expansion, w->e->text.arena, &w->plan, w->e->series, true)) return;
    w->along = -1;
    w->e->series_wide = w->e->series_may_be_wide && can_be_wide(w);
    w->e->uses_vectors |= w->e->series_wide;
    if (w->e->series_wide) SAY(w, "#pragma push_macro(\"real\")\n#undef real\n#define real reals\n");
    write_head(w, name);
    write_body(w);
    if (w->e->series_wide) SAY(w, "#pragma pop_macro(\"real\")\n");
}

/* The recurrences -------------------------------------------------------------------------------------------------- */

static void write_recurrence(emit_text *t, const char *prefix, int op, int keeps, const char *recurrence,
                             const char *operands, const char *values)
{
    emit_add(t, "SERIES_FUNCTION void series_%d(real *r, %s, const int n, const real *in) { ", op, operands);
    if (!keeps) emit_add(t, "if (n == 0) r[0] = %s_%d(%s); else ", prefix, op, values);
    emit_add(t, "(void)in, r[n] = %s; }\n", recurrence);
}

bool emit_series_operations(emit *e, const char *prefix)
{
    emit_text *t = &e->text;
#define ROW(id, ...) \
    if (e->used_series & OPERATION_BIT(id)) write_recurrence(t, prefix, OP_##id, __VA_ARGS__);
#define LEAF(...)
#define UNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    ROW(id, keeps, #recurrence, "const series a", "a.at[0]")
#define BINARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    ROW(id, keeps, #recurrence, "const series a, const series b", "a.at[0], b.at[0]")
#define TERNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    ROW(id, keeps, #recurrence, "const series a, const series b, const series c", "a.at[0], b.at[0], c.at[0]")
#include "lang/base/operations.def"
#undef ROW
    return !e->text.arena->failed;
}
