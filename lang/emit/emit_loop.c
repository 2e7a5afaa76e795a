/* Writes regions, loops and sums.
 *
 * Invariant: sums follow lang/graph/program.c exactly: up to 16 terms in order; more terms in turn to eight partial
 * sums, which a fixed tree adds. A loop that contains no other takes WIDTH values of its index at once, one in each
 * lane, and the rest one by one.
 */
#include "lang/emit/emit_parts.h"

#include <stdio.h>

/* Writes the addition of a term to a partial sum, as "s7[k]". */
static void write_update(writer *w, const plan_item *update, const char *partial)
{
    node whole = w->plan.items.at[plan_updates(&w->plan, update)].n;
    const graph_node *sum = &w->plan.g->nodes[whole], *how = &w->plan.g->nodes[sum->a];
    char p[48], q[48], c[48], next[160];
    bool fused = how->op != OP_ADD;
    const char *operation = emit_operation(w, whole, how->op);
    emit_operand(w, fused ? how->a : how->b, whole, p);
    if (fused) {
        emit_operand(w, how->b, whole, q);
        snprintf(next, sizeof next, "%s_%d(%s, %s, %s)", operation, how->op, p, q, partial);
    } else {
        snprintf(next, sizeof next, "%s_%d(%s, %s)", operation, how->op, partial, p);
    }
    if (sum->b && !w->skips) {
        emit_operation(w, whole, OP_SELECT);
        emit_operand(w, sum->b, whole, c);
        emit_line(w, "%s = %s_%d(%s, %s, %s);", partial, operation, OP_SELECT, c, next, partial);
    } else {
        emit_line(w, "%s = %s;", partial, next);
    }
}

/* Writes a loop over more than 16 terms, eight at a time: to the partial sums s or, in lanes, to v, which is then
 * copied to s. */
static void write_eights(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    const int level = r->level;
    const bool along = w->e->vectors && w->part == RUNNING;
    OPEN(w, "if (n%d > 16) {", level);
    if (along) EACH_SUM(k, r)
    emit_line(w, "reals v%u[8 / WIDTH] = {MANY(0.0)};", k);
    emit_line(w, "for (; m%d + 8 <= n%d; m%d += 8)", level, level, level);
    if (along) emit_line(w, "#pragma GCC unroll 8");
    OPEN(w, along ? "for (int k = 0; k < 8 / WIDTH; k++) {" : "for (int k = 0; k < 8; k++) {");
    emit_line(w, "const int64_t j%d = f%d + m%d + k%s;", level, level, level, along ? " * WIDTH" : "");
    w->along = along ? level : -1;
    emit_region(w, region);
    w->along = -1;
    CLOSE(w);
    if (along) EACH_SUM(k, r)
    emit_line(w, "for (int k = 0; k < 8; k++) s%u[k] = LANE_OF(v%u[k / WIDTH], k %% WIDTH);", k, k);
    CLOSE(w);
    w->e->uses_vectors |= along;
}

void emit_total(writer *w, uint32_t k, const char *type, const char *first, const char *last)
{
    emit_line(w,
              "const %s r%u = %s - (%s) + 1 > 16 ? ((s%u[0] + s%u[1]) + (s%u[2] + s%u[3])) + ((s%u[4] + s%u[5]) + "
              "(s%u[6] + s%u[7])) : s%u[0];",
              type, k, last, first, k, k, k, k, k, k, k, k, k);
}

/* Sums over pairs: see emit_pair.c
 * ---------------------------------------------------------------------------------- */

static void write_pairs_one_by_one(writer *w, uint32_t region)
{
    OPEN(w, "for (; m1 < e1; m1++) {");
    emit_line(w, "const int64_t j1 = f1 + m1, k = rows > 1 ? m1 & 7 : 0;");
    w->skips = true;
    emit_region(w, region);
    emit_pair_others(w, region);
    w->skips = false;
    CLOSE(w);
}

static void write_pairs_by_eights(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    OPEN(w, "if (!rest && rows > 1) {");
    EACH_SUM(k, r)
    {
        emit_line(w, "reals v%u[8 / WIDTH];", k);
        emit_line(w, "for (int k = 0; k < 8 / WIDTH; k++) v%u[k] = index_load(&s%u[k * WIDTH]);", k, k);
    }
    emit_line(w, "for (; m1 + 8 <= n1; m1 += 8)");
    emit_line(w, "#pragma GCC unroll 8");
    OPEN(w, "for (int k = 0; k < 8 / WIDTH; k++) {");
    emit_line(w, "const int64_t j1 = f1 + m1 + k * WIDTH;");
    w->along = 1;
    w->skips = true;
    emit_region(w, region);
    emit_pair_others(w, region);
    w->along = -1;
    w->skips = false;
    CLOSE(w);
    EACH_SUM(k, r)
    emit_line(w, "for (int k = 0; k < 8 / WIDTH; k++) index_store(&s%u[k * WIDTH], v%u[k]);", k, k);
    CLOSE(w);
    w->e->uses_vectors = true;
}

static void start_pairs(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    char first[PLACE_MAX], last[PLACE_MAX];
    uint32_t sums = 0;
    EACH_SUM(k, r) sums++;
    emit_bound(w, &r->range.first, first);
    emit_bound(w, &r->range.last, last);
    emit_line(w, "const int64_t f1 = %s, n1 = %s - f1 + 1, rows = n1 > 16 ? 8 : 1, c1 = (n1 + 7) & ~(int64_t)7;", first,
              last);
    emit_line(w, "for (int64_t k = 0; k < %u * rows * c1; k++) own[k] = 0;", sums);
}

static void write_pair_sums(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    const uint32_t around = w->region;
    const bool skipping = w->skips;
    uint32_t c = 0;
    emit_line(w, "const int64_t i1 = j0 - f1;");
    EACH_SUM(k, r)
    {
        emit_line(w, "double s%u[8], *const t%u = own + (%u * rows + (rows > 1 ? i1 & 7 : 0)) * c1;", k, k, c);
        emit_line(w, "for (int64_t k = 0; k < rows; k++) s%u[k] = own[(%u * rows + k) * c1 + i1];", k, c++);
        w->plan.items.at[k].reg = 0; /* it has been written */
    }
    OPEN(w, "{");
    emit_line(w, "int64_t m1 = i1 + 1;");
    OPEN(w, "for (int rest = 0; rest <= (rows > 1); rest++) {");
    emit_line(w, "const int64_t up = (m1 + 7) & ~(int64_t)7, e1 = rest || rows == 1 || up > n1 ? n1 : up;");
    write_pairs_one_by_one(w, region);
    if (w->e->vectors) write_pairs_by_eights(w, region);
    CLOSE(w);
    CLOSE(w);
    w->region = around;
    w->skips = skipping;
    EACH_SUM(k, r)
    emit_line(w,
              "const double r%u = rows > 1 ? ((s%u[0] + s%u[1]) + (s%u[2] + s%u[3])) + ((s%u[4] + s%u[5]) + (s%u[6] + "
              "s%u[7])) : s%u[0];",
              k, k, k, k, k, k, k, k, k, k);
}

static void write_sum(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    const uint32_t around = w->region;
    char first[PLACE_MAX], last[PLACE_MAX];
    const int level = r->level;
    const bool skipping = w->skips;
    int equal[2];
    if (region == w->pairs) {
        write_pair_sums(w, region);
        return;
    }
    w->skips = false;
    emit_bound(w, &r->range.first, first);
    emit_bound(w, &r->range.last, last);
    EACH_SUM(k, r)
    {
        emit_line(w, emit_wide(w, w->plan.items.at[k].n) ? "reals s%u[8] = {{0}};" : "double s%u[8] = {0};", k);
        w->plan.items.at[k].reg = 0; /* it has been written */
    }
    OPEN(w, "{");
    emit_line(w, "const int64_t f%d = %s, n%d = %s - f%d + 1;", level, first, level, last, level);
    emit_line(w, "int64_t m%d = 0;", level);
    if (!r->holds_sums) /* a body without sums is cheap to write twice */
        write_eights(w, region);
    OPEN(w, "for (; m%d < n%d; m%d++) {", level, level, level);
    emit_line(w, "const int64_t j%d = f%d + m%d, k = n%d > 16 ? m%d & 7 : 0;", level, level, level, level, level);
    w->skips = emit_leaves_out(w, r, equal);
    if (w->skips) emit_line(w, "if (j%d == j%d) continue;", equal[0], equal[1]);
    emit_region(w, region);
    w->skips = skipping;
    w->region = around;
    CLOSE(w);
    CLOSE(w);
    EACH_SUM(k, r)
    emit_total(w, k, emit_type(w, w->plan.items.at[k].n), first, last);
}

static bool lies_in(const writer *w, uint32_t inner, uint32_t region)
{
    while (inner != NONE && inner != region && inner > AT_RUN) inner = w->plan.regions.at[inner].parent;
    return inner == region;
}

/* Writes a loop over a family's index twice: over all pairs once, where the loop is over all cells and has room for
 * their sums, and over every cell by itself. */
static void write_pairs(writer *w, uint32_t region, uint32_t pairs, const char *first, const char *last)
{
    OPEN(w, "if (own && j0 == %s && e0 == %s) {", first, last);
    start_pairs(w, pairs);
    OPEN(w, "for (; j0 <= e0; j0++) {");
    w->pairs = pairs;
    emit_region(w, region);
    w->pairs = NONE;
    CLOSE(w);
    CLOSE(w);
    /* the sums are written once more */
    for (uint32_t k = 0; k < w->plan.items.count; k++)
        if (plan_inside(&w->plan, &w->plan.items.at[k]) != NONE && lies_in(w, w->plan.items.at[k].region, region))
            w->plan.items.at[k].reg = NONE;
}

static void write_loop(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    const uint32_t around = w->region;
    const int level = r->level;
    char first[PLACE_MAX], last[PLACE_MAX];
    if (r->sum) {
        write_sum(w, region);
        return;
    }
    emit_bound(w, &r->range.first, first);
    emit_bound(w, &r->range.last, last);
    OPEN(w, "{");
    emit_line(w,
              level == 0 && w->e->windowed ? "int64_t j%d = window_later(%s, from), e%d = window_sooner(%s, to - 1);"
                                           : "int64_t j%d = %s, e%d = %s;",
              level, first, level, last);
    const uint32_t pairs = emit_pairs(w, region);
    if (pairs != NONE) write_pairs(w, region, pairs, first, last);
    if (w->e->vectors && r->innermost && !r->holds_sums) {
        w->e->uses_vectors = true;
        OPEN(w, "for (; j%d + WIDTH - 1 <= e%d; j%d += WIDTH) {", level, level, level);
        w->along = level;
        emit_region(w, region);
        w->along = -1;
        CLOSE(w);
        emit_line(w, "for (; j%d <= e%d; j%d++) {", level, level, level);
        emit_line(w, "    INDEX_REST;");
    } else {
        emit_line(w, "for (; j%d <= e%d; j%d++) {", level, level, level);
    }
    w->depth++;
    emit_region(w, region);
    CLOSE(w);
    CLOSE(w);
    w->region = around;
}

/* Returns whether the function that is being written computes an item of its region. */
static bool belongs(const writer *w, const plan_item *i, uint32_t region)
{
    if (w->part == TERMS) return (w->nature[i->n] & PLAIN_TIME) || w->plan.g->nodes[i->n].op == OP_TIME;
    if (region != AT_BIND || w->part == RUNNING) return true;
    return emit_wide(w, i->n) == (w->part == BINDING_LANES) && w->plan.g->nodes[i->n].op != OP_CONST;
}

void emit_region(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    char partial[24];
    w->region = region;
    emit_outputs(w, r->outputs);
    for (uint32_t k = 0; k < r->item_count && !w->plan.failed; k++) {
        uint32_t item = w->plan.order[r->items + k];
        plan_item *i = &w->plan.items.at[item];
        if (!belongs(w, i, region)) continue;
        if (w->twos && region == AT_RUN && w->part == RUNNING && emit_two(w, k)) continue;
        const uint32_t inside = plan_inside(&w->plan, i), total = plan_updates(&w->plan, i);
        if (inside != NONE && i->reg == NONE) write_loop(w, inside);
        w->region = region;
        if (total != NONE) {
            snprintf(partial, sizeof partial, w->along < 0 ? "s%u[k]" : "v%u[k]", total);
            write_update(w, i, partial);
        } else {
            emit_item(w, item);
        }
    }
    for (uint32_t k = r->first_child; k != NONE && !w->plan.failed; k = w->plan.regions.at[k].next)
        if (!w->plan.regions.at[k].sum && region != AT_BIND && w->part == RUNNING) {
            write_loop(w, k);
            w->region = region;
        }
}
