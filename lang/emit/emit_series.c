/* Writes a program in Taylor series: a function that computes coefficient n of every value, by the recurrences of
 * step/series.h. See emit.h.
 *
 * Invariant: every value is a real, in the memory that lang/graph/expansion.h gives it, and every region walks through
 * that memory as the interpreter does. Where all values lie in loops over a family's index, a real is a vector of WIDTH
 * values of that index (`series_wide`), and the states have copies there. The text grows with the graph, not with the
 * order; but a short one is compiled for every order apart, since its loops over coefficients are then sequences.
 */
#include "lang/emit/emit_parts.h"

#include <stdio.h>

enum { OPERAND_MAX = 64 };

/* Operands ---------------------------------------------------------------------------------------------------------*/

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

/* What depends on parameters alone, as reals. */
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

/* Values -----------------------------------------------------------------------------------------------------------*/

static bool in_lanes(const writer *w) { return w->e->lanes || w->e->series_wide; }

static const char *prefix(const writer *w) { return in_lanes(w) ? "ops" : "op"; }

static void use(writer *w, operation op) { *(in_lanes(w) ? &w->e->used_lanes : &w->e->used) |= (uint64_t)1 << op; }

/* Whether a value differs from lane to lane of an index; its text then stands for lane l, within LANES_OF_INDEX. */
static bool along(const writer *w, node n) { return w->along >= 0 && w->plan.g->nodes[n].deps >> w->along & 1; }

/* A number of every lane as a real. */
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
    emit_line(w, "%sseries_%d(z%u, %s%s%s%s%s, n);", limit, n->op, item, text[0], arity > 1 ? ", " : "", text[1],
              arity > 2 ? ", " : "", text[2]);
}

static void write_outputs(writer *w, uint32_t first)
{
    enum { STORES_TOGETHER = 64 }; /* as emit_value.c divides them */
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

/* Where the series of a value begins; of a value that passes, such that coefficient n is always in the same place. */
static void write_place(writer *w, uint32_t item)
{
    const expansion_value *v = &w->expansion.values[item];
    emit_line(w, "real *const z%u = g%u + %u%s;", item, w->plan.items.at[item].region, v->at, v->passing ? " - n" : "");
}

static void write_item(writer *w, uint32_t item)
{
    const plan_item *i = &w->plan.items.at[item];
    const graph_node *n = &w->plan.g->nodes[i->n];
    const expansion_value *v = &w->expansion.values[item];
    if (v->state) {
        const reference *r = &w->plan.g->references[n->a];
        char place[PLACE_MAX];
        const char *array = w->plan.g->arrays[r->array].space == SPACE_X ? "x" : "v";
        emit_element(w, r, r->dims, place);
        if (w->e->series_wide) {
            char number[PLACE_MAX + 40];
            snprintf(number, sizeof number, "%s[(%s) * %d + n]", array, place, w->expansion.length);
            write_place(w, item);
            write_number(w, item, "n", number);
        } else {
            emit_line(w, "const real *const z%u = %s + (%s) * %d;", item, array, place, w->expansion.length);
        }
    } else if (v->twin != NONE) {
        emit_line(w, "const real *const z%u = z%u + %d;", item, v->twin, w->expansion.length);
    } else {
        write_place(w, item);
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

/* Loops ------------------------------------------------------------------------------------------------------------*/

static void write_region(writer *w, uint32_t region);

#define EACH_SUM(k, r) for (uint32_t k = (r)->sums; k != NONE; k = w->plan.sums.at[w->plan.items.at[k].sum].next)

static void write_update(writer *w, const plan_item *update)
{
    const uint32_t whole = plan_updates(&w->plan, update);
    const graph_node *sum = &w->plan.g->nodes[w->plan.items.at[whole].n], *how = &w->plan.g->nodes[sum->a];
    char p[OPERAND_MAX], q[OPERAND_MAX], c[OPERAND_MAX], next[4 * OPERAND_MAX + 80];
    operand(w, how->op == OP_ADD ? how->b : how->a, p);
    if (how->op == OP_ADD) {
        snprintf(next, sizeof next, "s%u[k] + series_at(%s, n)", whole, p);
    } else {
        operand(w, how->b, q);
        const char *sign = how->op == OP_FNMA ? "-" : "";
        snprintf(next, sizeof next,
                 "n ? s%u[k] %s series_product(%s, %s, n) : SERIES_FMA(%s%s.at[0], %s.at[0], s%u[k])", whole,
                 *sign ? sign : "+", p, q, sign, p, q, whole);
    }
    if (sum->b) {
        operand(w, sum->b, c);
        emit_line(w, "s%u[k] = SERIES_PICK(%s.at[0] != 0, (%s), s%u[k]);", whole, c, next, whole);
    } else {
        emit_line(w, "s%u[k] = %s;", whole, next);
    }
}

/* A loop over a family's index, WIDTH values at a time; `lanes` of them are in the family, and the others repeat the
 * last of these. */
static void write_wide_loop(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    const uint32_t around = w->region;
    const int level = r->level;
    char first[PLACE_MAX], last[PLACE_MAX];
    emit_bound(w, &r->range.first, first);
    emit_bound(w, &r->range.last, last);
    emit_line(w, "for (int64_t j%d = %s, e%d = %s; j%d <= e%d; j%d += WIDTH) {", level, first, level, last, level,
              level, level);
    w->depth++;
    emit_line(w, "const int lanes = e%d - j%d + 1 < WIDTH ? (int)(e%d - j%d) + 1 : WIDTH;", level, level, level, level);
    w->along = level, w->one_by_one = true;
    write_region(w, region);
    w->along = -1, w->one_by_one = false;
    w->region = around;
    w->depth--;
    emit_line(w, "}");
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
        w->plan.items.at[k].reg = 0; /* done */
    }
    emit_line(w, "{");
    w->depth++;
    emit_line(w, "const int64_t f%d = %s, n%d = %s - f%d + 1;", level, first, level, last, level);
    emit_line(w, "for (int64_t m%d = 0; m%d < n%d; m%d++) {", level, level, level, level);
    w->depth++;
    emit_line(w, "const int64_t j%d = f%d + m%d, k = n%d > 16 ? m%d & 7 : 0;", level, level, level, level, level);
    emit_line(w, "(void)k;");
    write_region(w, region);
    w->region = around;
    w->depth--;
    emit_line(w, "}");
    w->depth--;
    emit_line(w, "}");
    EACH_SUM(k, r)
    emit_total(w, k, "real", first, last);
}

static void write_region(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    w->region = region;
    emit_line(w, "real *const g%u = p;", region);
    emit_line(w, "p += %u;", w->expansion.frames[region]);
    write_outputs(w, r->outputs);
    for (uint32_t k = 0; k < r->item_count && !w->plan.failed; k++) {
        const uint32_t item = w->plan.order[r->items + k];
        const plan_item *i = &w->plan.items.at[item];
        const uint32_t inside = plan_inside(&w->plan, i);
        if (inside != NONE && i->reg == NONE) write_loop(w, inside);
        w->region = region;
        if (plan_updates(&w->plan, i) != NONE)
            write_update(w, i);
        else
            write_item(w, item);
    }
    for (uint32_t k = r->first_child; k != NONE && !w->plan.failed; k = w->plan.regions.at[k].next)
        if (!w->plan.regions.at[k].sum) {
            write_loop(w, k);
            w->region = region;
        }
}

/* The function ------------------------------------------------------------------------------------------------------*/

/* Whether all values lie in loops over the first index of families, whose bounds are the same for every value of it. */
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

static const char *const given = "pool, q, u, w, own, ", *const states = "t, x, v, p, a";

static void write_head(writer *w, const char *how, const char *name, const char *order)
{
    const char *real = w->e->series_wide ? "double" : "real";
    SAY(w,
        "%s static %s *%s(const double *restrict pool, const int64_t *restrict q, const double *restrict u, const %s "
        "*restrict w, %s *restrict own, %sconst clock t, %s *x, %s *v, %s *p, %s *a)\n",
        how, real, name, real, real, order, real, real, real, real);
}

static void write_body(writer *w)
{
    SAY(w, "{\n    (void)pool, (void)q, (void)u, (void)w, (void)own, (void)t, (void)x, (void)v, (void)a;\n");
    write_bound(w);
    if (w->e->series_wide) { /* they begin at a multiple of their size */
        emit_line(w, "double *const memory = p;");
        emit_line(w, "{");
        emit_line(w, "real *p = (real *)(((uintptr_t)memory + sizeof(real) - 1) & ~(uintptr_t)(sizeof(real) - 1));");
    }
    emit_line(w, "p += %d;", w->expansion.length); /* before it begins what passes */
    write_region(w, AT_RUN);
    if (w->e->series_wide) emit_line(w, "}");
    emit_line(w, "return p;");
    SAY(w, "}\n\n");
}

/* The orders apart, and the function that calls them. */
static void write_orders(writer *w, const char *name)
{
    char part[80];
    const int count = w->expansion.length - 2;
    for (int n = 0; n < count; n++) {
        snprintf(part, sizeof part, "%s_%d", name, n);
        write_head(w, "__attribute__((noinline))", part, "");
        SAY(w, "{ return %s_any(%s%d, %s); }\n", name, given, n, states);
    }
    write_head(w, "inline", name, "const int n, ");
    SAY(w, "{\n    switch (n) {\n");
    for (int n = 0; n < count - 1; n++) SAY(w, "    case %d: return %s_%d(%s%s);\n", n, name, n, given, states);
    SAY(w, "    default: return %s_%d(%s%s);\n    }\n}\n\n", name, count - 1, given, states);
}

void emit_series_pass(writer *w, const char *name)
{
    enum { APART_MAX = 64 }; /* values */
    char any[80];
    if (!expansion_place(&w->expansion, w->e->text.arena, &w->plan, w->e->series, true)) return;
    const bool apart = w->plan.items.count <= APART_MAX;
    w->along = -1;
    w->e->series_wide = w->e->series_may_be_wide && can_be_wide(w);
    w->e->uses_vectors |= w->e->series_wide;
    w->e->series_apart |= apart;
    snprintf(any, sizeof any, apart ? "%s_any" : "%s", name);
    if (w->e->series_wide) SAY(w, "#pragma push_macro(\"real\")\n#undef real\n#define real reals\n");
    write_head(w, apart ? "inline __attribute__((always_inline))" : "__attribute__((noinline))", any, "const int n, ");
    write_body(w);
    if (apart) write_orders(w, name);
    if (w->e->series_wide) SAY(w, "#pragma pop_macro(\"real\")\n");
}

/* The recurrences ---------------------------------------------------------------------------------------------------*/

static void write_recurrence(emit_text *t, const char *prefix, int op, int keeps, const char *recurrence,
                             const char *operands, const char *values)
{
    emit_add(t, "SERIES_FUNCTION void series_%d(real *r, %s, const int n) { ", op, operands);
    if (!keeps) emit_add(t, "if (n == 0) r[0] = %s_%d(%s); else ", prefix, op, values);
    emit_add(t, "r[n] = %s; }\n", recurrence);
}

bool emit_series_operations(emit *e, const char *prefix)
{
    emit_text *t = &e->text;
#define ROW(id, ...) \
    if (e->used_series & OPERATION_BIT(id)) write_recurrence(t, prefix, OP_##id, __VA_ARGS__);
#define LEAF(...)
#define UNARY(id, spelling, degree, smooth, value, derivative, keeps, recurrence) \
    ROW(id, keeps, #recurrence, "const series a", "a.at[0]")
#define BINARY(id, spelling, degree, smooth, value, derivative, keeps, recurrence) \
    ROW(id, keeps, #recurrence, "const series a, const series b", "a.at[0], b.at[0]")
#define TERNARY(id, spelling, degree, smooth, value, derivative, keeps, recurrence) \
    ROW(id, keeps, #recurrence, "const series a, const series b, const series c", "a.at[0], b.at[0], c.at[0]")
#include "lang/base/operations.def"
#undef ROW
    return !e->text.arena->failed;
}
