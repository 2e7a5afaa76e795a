/* Writing a plan out as C. See emit.h; the order is the interpreter's, so are the bits.
 *
 * Invariant: a value is one `const` of the block in which the plan computes it; sums follow lang/program.c to the letter.
 */
#include "lang/emit.h"

#include "lang/operation.h"
#include "lang/tape_regions.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct writer {
    emit *e;
    plan plan;
    uint32_t region;
    int depth;
    bool binding;                    /* region AT_BIND is being written */
    uint32_t *fixed;                 /* by item of region AT_BIND: its place in u */
} writer;

/* Text ------------------------------------------------------------------------------------------------------------ */

void emit_add(emit_text *t, const char *format, ...)
{
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    int n = vsnprintf(NULL, 0, format, list);
    size_t need = t->length + (size_t)(n > 0 ? n : 0) + 1;
    if (need > t->room && !t->arena->failed) {
        size_t room = 2 * need + 1024;
        char *more = arena_grow(t->arena, t->bytes, t->length, room);
        if (more) {
            t->bytes = more;
            t->room = room;
        }
    }
    if (n > 0 && need <= t->room)
        t->length += (size_t)vsnprintf(t->bytes + t->length, t->room - t->length, format, again);
    va_end(again);
    va_end(list);
}

#define SAY(w, ...) emit_add(&(w)->e->text, __VA_ARGS__)

static void line(writer *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void line(writer *w, const char *format, ...)
{
    char buffer[512];
    va_list list;
    va_start(list, format);
    vsnprintf(buffer, sizeof buffer, format, list);
    va_end(list);
    SAY(w, "%*s%s\n", 4 * w->depth, "", buffer);
}

/* A double that reads back to the same bits. */
static void hexadecimal(double v, char out[40])
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    uint64_t fraction = bits & 0xFFFFFFFFFFFFFu;
    int exponent = (int)(bits >> 52 & 0x7FF);
    const char *sign = bits >> 63 ? "-" : "";
    if (exponent == 0x7FF)
        snprintf(out, 40, fraction ? "(0.0/0.0)" : "(%s1.0/0.0)", sign);
    else if (!exponent && !fraction)
        snprintf(out, 40, "%s0.0", sign);
    else
        snprintf(out, 40, "%s0x%d.%013" PRIx64 "p%+d", sign, exponent != 0, fraction, exponent ? exponent - 1023 : -1022);
}

/* Run-time integers ----------------------------------------------------------------------------------------------- */

static bool same_int(const emit_int *a, const emit_int *b)
{
    if (a->kind != b->kind)
        return false;
    if (a->kind == EMIT_SLOT)
        return a->slot == b->slot;
    if (a->kind == EMIT_STRIDE)
        return a->array == b->array && a->dim == b->dim;
    if (a->ref.array != b->ref.array)
        return false;
    for (int d = 0; d < a->ref.dims; d++) {
        const subscript *s = &a->ref.at[d], *t = &b->ref.at[d];
        if (s->slot != t->slot || s->literal != t->literal || s->modulus != t->modulus)
            return false;
    }
    return true;
}

static uint32_t integer(writer *w, const emit_int *want)
{
    emit *e = w->e;
    for (uint32_t k = 0; k < e->int_count; k++)
        if (same_int(&e->ints[k], want))
            return k;
    if (e->int_count == e->int_room) {
        uint32_t room = e->int_room ? 2 * e->int_room : 32;
        emit_int *more = arena_grow(e->text.arena, e->ints, e->int_room * sizeof *more, room * sizeof *more);
        if (!more)
            return 0;
        e->ints = more;
        e->int_room = room;
    }
    e->ints[e->int_count] = *want;
    return e->int_count++;
}

static uint32_t slot_integer(writer *w, int slot) { return integer(w, &(emit_int){.kind = EMIT_SLOT, .slot = slot}); }

int64_t emit_int_value(const emit_int *k, const array *arrays, const int64_t *ints)
{
    if (k->kind == EMIT_SLOT)
        return ints[k->slot];
    if (k->kind == EMIT_STRIDE)
        return arrays[k->array].stride[k->dim];
    const array *a = &arrays[k->ref.array];
    int64_t at = (int64_t)a->base;
    for (int d = 0; d < k->ref.dims; d++) {
        const subscript *s = &k->ref.at[d];
        int64_t fixed = s->modulus >= 0 ? 1 : s->literal + (s->slot >= 0 ? ints[s->slot] : 0);
        at += (fixed - a->first[d]) * a->stride[d];
    }
    return at;
}

static const char *space_name(space s)
{
    static const char *const names[SPACES] = {[SPACE_X] = "x", [SPACE_V] = "v", [SPACE_A] = "a", [SPACE_DX] = "dx", [SPACE_DV] = "dv",
                                              [SPACE_POOL] = "pool", [SPACE_OUT] = "out"};
    return names[s];
}

/* "x[q[3] + j0 + j1 * q[4]]". The last dimension has stride 1, which the compiler is told by leaving it out. */
static void address(writer *w, const reference *r, char *out, size_t size)
{
    const array *a = &w->plan.g->arrays[r->array];
    const emit_int offset = {.kind = EMIT_OFFSET, .ref = *r};
    size_t n;
    if (w->e->literal && r->dims == 0)
        n = (size_t)snprintf(out, size, "%s[%lld", space_name(a->space), (long long)emit_int_value(&offset, w->e->arrays, NULL));
    else
        n = (size_t)snprintf(out, size, "%s[q[%u]", space_name(a->space), integer(w, &offset));
    for (int d = 0; d < r->dims && n < size; d++) {
        const subscript *s = &r->at[d];
        char index[96];
        if (s->modulus >= 0) {
            char base[64] = "";
            size_t k = 0;
            if (s->level >= 0)
                k += (size_t)snprintf(base + k, sizeof base - k, "j%d + ", s->level);
            if (s->slot >= 0)
                k += (size_t)snprintf(base + k, sizeof base - k, "q[%u] + ", slot_integer(w, s->slot));
            snprintf(base + k, sizeof base - k, "%d", s->literal);
            w->e->wraps = true;
            snprintf(index, sizeof index, "wrapped(%s, q[%u])", base, slot_integer(w, s->modulus));
        } else if (s->level >= 0) {
            snprintf(index, sizeof index, "j%d", s->level);
        } else {
            continue;
        }
        if (d == r->dims - 1)
            n += (size_t)snprintf(out + n, size - n, " + %s", index);
        else
            n += (size_t)snprintf(out + n, size - n, " + %s * q[%u]", index, integer(w, &(emit_int){.kind = EMIT_STRIDE, .array = r->array, .dim = d}));
    }
    if (n < size)
        snprintf(out + n, size - n, "]");
}

static void bound(writer *w, const subscript *s, char *out, size_t size)
{
    size_t n = 0;
    if (s->level >= 0)
        n += (size_t)snprintf(out + n, size - n, "j%d + ", s->level);
    if (s->slot >= 0)
        n += (size_t)snprintf(out + n, size - n, "q[%u] + ", slot_integer(w, s->slot));
    snprintf(out + n, size - n, "%d", s->literal);
}

/* Values ---------------------------------------------------------------------------------------------------------- */

static bool moves(const writer *w, node n) { return w->plan.g->nodes[n].deps & (DEP_STATE | DEP_D); }

/* The name of a value where it is needed: what was computed once, when parameters were bound, stands in u. */
static void operand(writer *w, node n, char out[24])
{
    uint32_t home = plan_home(&w->plan, w->plan.g->nodes[n].deps, w->region);
    uint32_t item = plan_find(&w->plan, n, home);
    if (home == AT_BIND && !w->binding && w->plan.g->nodes[n].op != OP_CONST)
        snprintf(out, 24, "u[%u]", w->fixed[item]);
    else
        snprintf(out, 24, "r%u", item);
}

static void write_outputs(writer *w, uint32_t first)
{
    char value[24], where[256];
    for (uint32_t k = first; k != NONE; k = w->plan.next_output[k]) {
        const output *o = &w->plan.program->outputs[k];
        operand(w, o->value, value);
        address(w, &o->to, where, sizeof where);
        line(w, "%s = %s;", where, value);
    }
}

static void write_item(writer *w, uint32_t k)
{
    const plan_item *item = &w->plan.items.at[k];
    const graph_node *n = &w->plan.g->nodes[item->n];
    const char *type = moves(w, item->n) ? "real" : "double";
    char a[24], b[24], c[24], text[256];
    switch (n->op) {
    case OP_CONST:
        hexadecimal(n->value, text);
        line(w, "const double r%u = %s;", k, text);
        break;
    case OP_TIME: line(w, "const double r%u = t;", k); break;
    case OP_PARAM: line(w, "const double r%u = pool[%u];", k, n->a); break;
    case OP_INDEX: line(w, "const double r%u = (double)j%d;", k, n->level); break;
    case OP_LOAD:
        address(w, &w->plan.g->references[n->a], text, sizeof text);
        line(w, "const %s r%u = %s;", type, k, text);
        break;
    case OP_SUM: break;              /* its loop has made it */
    default: {
        int arity = operation_at(n->op)->arity;
        w->e->used |= (uint64_t)1 << n->op;
        operand(w, n->a, a);
        if (arity > 1) operand(w, n->b, b);
        if (arity > 2) operand(w, n->c, c);
        line(w, "const %s r%u = op_%d(%s%s%s%s%s);", type, k, n->op, a, arity > 1 ? ", " : "", arity > 1 ? b : "", arity > 2 ? ", " : "", arity > 2 ? c : "");
    }
    }
    if (w->region == AT_BIND)
        line(w, "u[%u] = r%u;", w->fixed[k], k);
    write_outputs(w, item->outputs);
}

/* Sums ------------------------------------------------------------------------------------------------------------ */

static void write_update(writer *w, const plan_item *update)
{
    uint32_t total = update->sum;
    const graph_node *sum = &w->plan.g->nodes[w->plan.items.at[total].n], *how = &w->plan.g->nodes[sum->a];
    char p[24], q[24], c[24];
    bool fused = how->op != OP_ADD;
    operand(w, fused ? how->a : how->b, p);
    if (fused)
        operand(w, how->b, q);
    if (sum->b)
        operand(w, sum->b, c);
    char next[128];
    w->e->used |= (uint64_t)1 << how->op | (sum->b ? OPERATION_BIT(SELECT) : 0);
    if (fused)
        snprintf(next, sizeof next, "op_%d(%s, %s, s%u[k])", how->op, p, q, total);
    else
        snprintf(next, sizeof next, "op_%d(s%u[k], %s)", how->op, total, p);
    if (sum->b)
        line(w, "s%u[k] = op_%d(%s, %s, s%u[k]);", total, OP_SELECT, c, next, total);
    else
        line(w, "s%u[k] = %s;", total, next);
}

static void write_region(writer *, uint32_t);

/* Terms in turn to eight partials, or all to the first: the inner loop over k is what the compiler turns into lanes. */
static void write_sum(writer *w, uint32_t region)
{
    plan_region *r = &w->plan.regions.at[region];
    char first[80], last[80];
    int level = r->level;
    bound(w, &r->range.first, first, sizeof first);
    bound(w, &r->range.last, last, sizeof last);
    for (uint32_t k = r->sums; k != NONE; k = w->plan.items.at[k].next_sum) {
        line(w, "%s s%u[8] = {0};", moves(w, w->plan.items.at[k].n) ? "real" : "double", k);
        w->plan.items.at[k].reg = 0;                       /* done */
    }
    line(w, "{");
    w->depth++;
    line(w, "const int64_t f%d = %s, n%d = %s - f%d + 1;", level, first, level, last, level);
    uint32_t around = w->region;
    if (!r->holds_sums) {            /* a body without sums of its own is cheap to write twice */
        line(w, "int64_t m%d = 0;", level);
        line(w, "if (n%d > 16)", level);
        line(w, "    for (; m%d + 8 <= n%d; m%d += 8)", level, level, level);
        w->depth += 2;
        line(w, "for (int k = 0; k < 8; k++) {");
        w->depth++;
        line(w, "const int64_t j%d = f%d + m%d + k;", level, level, level);
        write_region(w, region);
        w->depth--;
        line(w, "}");
        w->depth -= 2;
        line(w, "for (; m%d < n%d; m%d++) {", level, level, level);
    } else {
        line(w, "for (int64_t m%d = 0; m%d < n%d; m%d++) {", level, level, level, level);
    }
    w->depth++;
    line(w, "const int64_t j%d = f%d + m%d, k = n%d > 16 ? m%d & 7 : 0;", level, level, level, level, level);
    write_region(w, region);
    w->region = around;
    w->depth--;
    line(w, "}");
    w->depth--;
    line(w, "}");
    for (uint32_t k = r->sums; k != NONE; k = w->plan.items.at[k].next_sum)
        line(w, "const %s r%u = %s - (%s) + 1 > 16 ? ((s%u[0] + s%u[1]) + (s%u[2] + s%u[3])) + ((s%u[4] + s%u[5]) + (s%u[6] + s%u[7])) : s%u[0];",
             moves(w, w->plan.items.at[k].n) ? "real" : "double", k, last, first, k, k, k, k, k, k, k, k, k);
}

static void write_loop(writer *w, uint32_t region)
{
    plan_region *r = &w->plan.regions.at[region];
    if (r->sum) {
        write_sum(w, region);
        return;
    }
    char first[80], last[80];
    bound(w, &r->range.first, first, sizeof first);
    bound(w, &r->range.last, last, sizeof last);
    uint32_t around = w->region;
    if (r->innermost)
        line(w, "#pragma GCC ivdep");
    line(w, "for (int64_t j%d = %s, e%d = %s; j%d <= e%d; j%d++) {", r->level, first, r->level, last, r->level, r->level, r->level);
    w->depth++;
    write_region(w, region);
    w->depth--;
    line(w, "}");
    w->region = around;
}

static void write_region(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    w->region = region;
    write_outputs(w, r->outputs);
    for (uint32_t k = 0; k < r->item_count && !w->plan.failed; k++) {
        uint32_t item = w->plan.order[r->items + k];
        plan_item *i = &w->plan.items.at[item];
        if (i->inside != NONE && i->reg == NONE)
            write_loop(w, i->inside);
        w->region = region;
        if (i->sum != NONE)
            write_update(w, i);
        else
            write_item(w, item);
    }
    for (uint32_t k = r->first_child; k != NONE && !w->plan.failed; k = w->plan.regions.at[k].next)
        if (!w->plan.regions.at[k].sum && region != AT_BIND) {
            write_loop(w, k);
            w->region = region;
        }
}

/* The whole ------------------------------------------------------------------------------------------------------- */

bool emit_program(emit *e, const program *p, const char *name)
{
    writer w = {.e = e, .region = AT_BIND, .depth = 1};
    if (plan_create(&w.plan, e->text.arena, p, false)) {
        w.fixed = arena_grow(e->text.arena, NULL, 0, (w.plan.items.count + 1) * sizeof *w.fixed);
        const plan_region *bind = &w.plan.regions.at[AT_BIND];
        for (uint32_t k = 0; w.fixed && k < bind->item_count; k++)
            w.fixed[w.plan.order[bind->items + k]] = e->fixed++;
        if (w.fixed) {
            SAY(&w, "static void %s_bind(const double *restrict pool, const int64_t *restrict q, double *restrict u)\n{\n    (void)pool, (void)q, (void)u;\n", name);
            w.binding = true;
            write_region(&w, AT_BIND);
            w.binding = false;
            SAY(&w, "}\n\nstatic inline void %s(const double *restrict pool, const int64_t *restrict q, const double *restrict u, double t, real *restrict x, "
                    "real *restrict v, real *restrict a)\n{\n    (void)pool, (void)q, (void)u, (void)t, (void)x, (void)v, (void)a;\n", name);
            for (uint32_t k = 0; k < bind->item_count; k++) {      /* constants stand in the text where they are used */
                uint32_t item = w.plan.order[bind->items + k];
                const graph_node *n = &w.plan.g->nodes[w.plan.items.at[item].n];
                char number[40];
                hexadecimal(n->value, number);
                if (n->op == OP_CONST)
                    line(&w, "const double r%u = %s; (void)r%u;", item, number, item);
            }
            write_region(&w, AT_RUN);
            SAY(&w, "}\n\n");
        }
    }
    plan_release(&w.plan);
    return !e->text.arena->failed;
}

bool emit_operations(emit *e)
{
    emit_text *t = &e->text;
#define LEAF(...)
#define USED(id) if (e->used & OPERATION_BIT(id))
#define UNARY(id, spelling, degree, smooth, value, derivative) USED(id) emit_add(t, "static inline double op_%d(double a) { return %s; }\n", OP_##id, #value);
#define BINARY(id, spelling, degree, smooth, value, derivative) USED(id) emit_add(t, "static inline double op_%d(double a, double b) { return %s; }\n", OP_##id, #value);
#define TERNARY(id, spelling, degree, smooth, value, derivative) \
    USED(id) emit_add(t, "static inline double op_%d(double a, double b, double c) { return %s; }\n", OP_##id, #value);
#include "lang/operations.def"
#undef USED
    if (e->wraps)
        emit_add(t, "static inline int64_t wrapped(int64_t k, int64_t n) { return (k %% n + n) %% n; }\n");
    return !e->text.arena->failed;
}
