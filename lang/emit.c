/* Writing a plan out as C. See emit.h; the order is the interpreter's, so are the bits.
 *
 * Invariant: a value is one `const` of the block in which the plan computes it; sums follow lang/program.c to the letter. A value is `wide`,
 * different in every lane, or a plain double that all lanes share; where both meet, the plain one is spread by MANY.
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
    enum { BINDING, BINDING_LANES, TERMS, RUNNING } part;      /* of the program's functions: which one is being written */
    uint32_t *fixed;                 /* by item of region AT_BIND: its place in u, or in w where it is wide */
    uint8_t *nature;                 /* by node: NATURE_ */
    uint32_t *term;                  /* by node: its place in T, or NONE */
    bool apart;                      /* what a condition selects is left to a loop of its own */
} writer;

enum { WIDE = 1,                     /* differs from lane to lane */
       PLAIN_TIME = 2,               /* a function of time and of what all lanes share, without sums */
       CLOSED = 4 };                 /* no sum in it, no index */

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

const char *emit_number(double v, char out[EMIT_NUMBER])
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    uint64_t fraction = bits & 0xFFFFFFFFFFFFFu;
    int exponent = (int)(bits >> 52 & 0x7FF);
    const char *sign = bits >> 63 ? "-" : "";
    if (exponent == 0x7FF)
        snprintf(out, EMIT_NUMBER, fraction ? "(0.0/0.0)" : "(%s1.0/0.0)", sign);
    else if (!exponent && !fraction)
        snprintf(out, EMIT_NUMBER, "%s0.0", sign);
    else
        snprintf(out, EMIT_NUMBER, "%s0x%d.%013" PRIx64 "p%+d", sign, exponent != 0, fraction, exponent ? exponent - 1023 : -1022);
    return out;
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
                                              [SPACE_POOL] = "own", [SPACE_OUT] = "out"};
    return names[s];
}

/* Whether one of the lanes' own numbers lies in an array of the pool. */
static bool varies(const writer *w, const array *a)
{
    size_t last = a->base;
    for (int d = 0; d < a->dims; d++)
        last += (size_t)((a->last[d] - a->first[d]) * a->stride[d]);
    for (size_t k = a->base; w->e->varied && k <= last; k++)
        if (w->e->varied[k])
            return true;
    return false;
}

/* "q[3] + j0 * q[4] + j1". The last dimension has stride 1, which the compiler is told by leaving it out. */
static void element(writer *w, const reference *r, char *out, size_t size)
{
    const emit_int offset = {.kind = EMIT_OFFSET, .ref = *r};
    size_t n = 0;
    if (w->e->literal && r->dims == 0)
        n += (size_t)snprintf(out + n, size - n, "%lld", (long long)emit_int_value(&offset, w->e->arrays, NULL));
    else
        n += (size_t)snprintf(out + n, size - n, "q[%u]", integer(w, &offset));
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
}

static void address(writer *w, const reference *r, char *out, size_t size)
{
    const array *a = &w->plan.g->arrays[r->array];
    char place[240];
    element(w, r, place, sizeof place);
    if (a->space == SPACE_POOL && !varies(w, a))
        snprintf(out, size, "pool[%s]", place);
    else
        snprintf(out, size, "AT(%s, %s)", space_name(a->space), place);
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

/* The nature of every node. Sums of parameters that share a loop with a wide one are made wide as well: `loops` says that there is one. */
static bool find_natures(writer *w, bool loops)
{
    const graph *g = w->plan.g;
    bool wide_loops = false;
    for (node n = 0; n < g->count; n++) {
        const graph_node *m = &g->nodes[n];
        uint8_t a = 0, all = CLOSED, *own = &w->nature[n];
        int arity = operation_at(m->op)->arity;
        if (m->op == OP_SUM) {
            a = (uint8_t)(w->nature[m->a] | (m->b ? w->nature[m->b] : 0));
            all = 0;
        }
        if (arity > 0) a |= w->nature[m->a], all &= w->nature[m->a];
        if (arity > 1) a |= w->nature[m->b], all &= w->nature[m->b];
        if (arity > 2) a |= w->nature[m->c], all &= w->nature[m->c];
        *own = (uint8_t)((a & WIDE) | (all & CLOSED));
        if (m->op == OP_TOTAL || m->op == OP_INDEX)
            *own = 0;
        if (m->op == OP_PARAM && w->e->varied && w->e->varied[m->a])
            *own |= WIDE;
        if (m->op == OP_LOAD) {
            const array *from = &g->arrays[g->references[m->a].array];
            *own = from->space == SPACE_POOL ? CLOSED : WIDE;
            if (from->space == SPACE_POOL && varies(w, from))
                *own |= WIDE;
        }
        bool of_parameters = m->op == OP_SUM && !(m->deps & (DEP_STATE | DEP_D | DEP_TIME));
        wide_loops |= of_parameters && *own & WIDE;
        if (of_parameters && loops)
            *own |= WIDE;
        if (*own & CLOSED && !(*own & WIDE) && m->deps & DEP_TIME && !(m->deps & DEP_LEVELS) && m->op != OP_TIME)
            *own |= PLAIN_TIME;
    }
    return wide_loops;
}

/* The values of time alone that others need get places in T. */
static void find_terms(writer *w)
{
    const graph *g = w->plan.g;
    for (uint32_t k = 0; k < w->plan.items.count; k++) {
        const plan_item *item = &w->plan.items.at[k];
        const graph_node *m = &g->nodes[item->n];
        const node operands[3] = {m->a, m->b, m->c};
        int arity = operation_at(m->op)->arity;
        if (w->nature[item->n] & PLAIN_TIME) {
            if (item->outputs != NONE && w->term[item->n] == NONE)
                w->term[item->n] = w->e->terms++;
            continue;
        }
        for (int i = 0; i < arity; i++)
            if (w->nature[operands[i]] & PLAIN_TIME && w->term[operands[i]] == NONE)
                w->term[operands[i]] = w->e->terms++;
        if (m->op == OP_SUM && m->b && w->nature[m->b] & PLAIN_TIME && w->term[m->b] == NONE)
            w->term[m->b] = w->e->terms++;
    }
    for (uint32_t k = 0; k < w->plan.program->count; k++) {
        node n = w->plan.program->outputs[k].value;
        if (w->nature[n] & PLAIN_TIME && w->term[n] == NONE)
            w->term[n] = w->e->terms++;
    }
}

/* In the function that computes the terms, a lane is a time. */
static bool wide(const writer *w, node n)
{
    const graph_node *m = &w->plan.g->nodes[n];
    if (w->part == TERMS)
        return (m->deps & DEP_TIME) != 0;
    return (w->e->lanes && w->nature[n] & WIDE) != 0;
}

static const char *type_of(const writer *w, node n) { return wide(w, n) ? "reals" : "double"; }
/* The name of an operation's function, which is then used. */
static const char *operation_of(const writer *w, node n, unsigned op)
{
    bool lanes = wide(w, n);
    *(lanes ? &w->e->used_lanes : &w->e->used) |= (uint64_t)1 << op;
    return lanes ? "ops" : "op";
}

/* The name of a value where it is needed, as wide as `user`: what was computed once, when parameters were bound, stands in u. */
static void operand(writer *w, node n, node user, char out[48])
{
    uint32_t home = plan_home(&w->plan, w->plan.g->nodes[n].deps, w->region);
    uint32_t item = plan_find(&w->plan, n, home);
    bool spread = wide(w, user) && !wide(w, n);
    const char *open = spread ? "MANY(" : "", *close = spread ? ")" : "";
    bool mine = w->part == BINDING || (w->part == BINDING_LANES && wide(w, n));      /* computed in this function */
    if (home != AT_BIND || mine || w->plan.g->nodes[n].op == OP_CONST)
        snprintf(out, 48, "%sr%u%s", open, item, close);
    else if (wide(w, n))
        snprintf(out, 48, "AT(w, %u)", w->fixed[item]);
    else
        snprintf(out, 48, "%su[%u]%s", open, w->fixed[item], close);
}

/* What becomes of an acceleration is the window's affair; one cell that has an equation of its own may lie outside of it. */
static void write_put(writer *w, const output *o, const char *value)
{
    char guard[200] = "", index[80], place[240];
    if (o->loops == 0) {
        bound(w, &o->to.at[0], index, sizeof index);
        snprintf(guard, sizeof guard, "if (%s >= from && %s < to) ", index, index);
    }
    element(w, &o->to, place, sizeof place);
    line(w, "%sPUT(%s, %s);", guard, place, value);
}

static void write_outputs(writer *w, uint32_t first)
{
    char value[48], where[256];
    for (uint32_t k = first; k != NONE && w->part == RUNNING; k = w->plan.next_output[k]) {
        const output *o = &w->plan.program->outputs[k];
        operand(w, o->value, o->value, value);
        if (w->e->windowed) {
            write_put(w, o, value);
            continue;
        }
        address(w, &o->to, where, sizeof where);
        line(w, w->e->lanes && !wide(w, o->value) ? "%s = MANY(%s);" : "%s = %s;", where, value);
    }
}

static void write_item(writer *w, uint32_t k)
{
    const plan_item *item = &w->plan.items.at[k];
    const graph_node *n = &w->plan.g->nodes[item->n];
    const char *type = type_of(w, item->n);
    char a[48], b[48], c[48], text[256];
    bool term = w->part == RUNNING && w->nature[item->n] & PLAIN_TIME;
    if (term && w->term[item->n] == NONE)
        return;                      /* only other terms need it */
    if (term)
        line(w, "const double r%u = T[%u];", k, w->term[item->n]);
    else
    switch (n->op) {
    case OP_CONST:
        emit_number(n->value, text);
        line(w, "const double r%u = %s;", k, text);
        break;
    case OP_TIME: line(w, "const %s r%u = t;", type, k); break;
    case OP_PARAM: line(w, wide(w, item->n) ? "const reals r%u = AT(own, %u);" : "const double r%u = pool[%u];", k, n->a); break;
    case OP_INDEX:
        w->e->indices = true;
        line(w, "const double r%u = index_number(j%d);", k, n->level);
        break;
    case OP_LOAD:
        address(w, &w->plan.g->references[n->a], text, sizeof text);
        line(w, "const %s r%u = %s;", type, k, text);
        break;
    case OP_SUM: break;              /* its loop has made it */
    default: {
        int arity = operation_at(n->op)->arity;
        operand(w, n->a, item->n, a);
        if (arity > 1) operand(w, n->b, item->n, b);
        if (arity > 2) operand(w, n->c, item->n, c);
        line(w, "const %s r%u = %s_%d(%s%s%s%s%s);", type, k, operation_of(w, item->n, n->op), n->op, a, arity > 1 ? ", " : "", arity > 1 ? b : "",
             arity > 2 ? ", " : "", arity > 2 ? c : "");
    }
    }
    if (w->region == AT_BIND && w->part == (wide(w, item->n) ? BINDING_LANES : BINDING))
        line(w, wide(w, item->n) ? "AT(w, %u) = r%u;" : "u[%u] = r%u;", w->fixed[k], k);
    if (w->part == TERMS && w->term[item->n] != NONE)
        line(w, "T[%u] = r%u;", w->term[item->n], k);
    write_outputs(w, item->outputs);
}

/* Sums ------------------------------------------------------------------------------------------------------------ */

static void write_update(writer *w, const plan_item *update)
{
    uint32_t total = update->sum;
    node whole = w->plan.items.at[total].n;
    const graph_node *sum = &w->plan.g->nodes[whole], *how = &w->plan.g->nodes[sum->a];
    char p[48], q[48], c[48];
    bool fused = how->op != OP_ADD;
    const char *operation = operation_of(w, whole, how->op);
    if (sum->b)
        operation_of(w, whole, OP_SELECT);
    operand(w, fused ? how->a : how->b, whole, p);
    if (fused)
        operand(w, how->b, whole, q);
    if (sum->b)
        operand(w, sum->b, whole, c);
    char next[160];
    if (fused)
        snprintf(next, sizeof next, "%s_%d(%s, %s, s%u[k])", operation, how->op, p, q, total);
    else
        snprintf(next, sizeof next, "%s_%d(s%u[k], %s)", operation, how->op, total, p);
    if (sum->b && w->apart)
        line(w, "t%u[k] = %s, c%u[k] = %s;", total, next, total, c);
    else if (sum->b)
        line(w, "s%u[k] = %s_%d(%s, %s, s%u[k]);", total, operation, OP_SELECT, c, next, total);
    else
        line(w, "s%u[k] = %s;", total, next);
}

static void write_region(writer *, uint32_t);

/* Eight terms, one to each partial: what the compiler turns into lanes. It would make a branch of a condition, so that is met afterwards. */
static void write_eight(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    const graph_node *nodes = w->plan.g->nodes;
    const bool lanes = w->e->lanes;
    line(w, "for (; m%d + 8 <= n%d; m%d += 8) {", r->level, r->level, r->level);
    w->depth++;
    for (uint32_t k = r->sums; k != NONE && !lanes; k = w->plan.items.at[k].next_sum)
        if (nodes[w->plan.items.at[k].n].b)
            line(w, "double t%u[8], c%u[8];", k, k);
    if (!lanes)
        line(w, "#pragma GCC unroll 1");
    line(w, "for (int k = 0; k < 8; k++) {");
    w->depth++;
    line(w, "const int64_t j%d = f%d + m%d + k;", r->level, r->level, r->level);
    w->apart = !lanes;
    write_region(w, region);
    w->apart = false;
    w->depth--;
    line(w, "}");
    for (uint32_t k = r->sums; k != NONE && !lanes; k = w->plan.items.at[k].next_sum)
        if (nodes[w->plan.items.at[k].n].b) {
            line(w, "#pragma GCC unroll 1");
            line(w, "for (int k = 0; k < 8; k++)");
            line(w, "    s%u[k] = op_%d(c%u[k], t%u[k], s%u[k]);", k, OP_SELECT, k, k, k);
        }
    w->depth--;
    line(w, "}");
}

/* Terms in turn to eight partials, or all to the first. */
static void write_sum(writer *w, uint32_t region)
{
    plan_region *r = &w->plan.regions.at[region];
    char first[80], last[80];
    int level = r->level;
    bound(w, &r->range.first, first, sizeof first);
    bound(w, &r->range.last, last, sizeof last);
    for (uint32_t k = r->sums; k != NONE; k = w->plan.items.at[k].next_sum) {
        line(w, wide(w, w->plan.items.at[k].n) ? "reals s%u[8] = {{0}};" : "double s%u[8] = {0};", k);
        w->plan.items.at[k].reg = 0;                       /* done */
    }
    line(w, "{");
    w->depth++;
    line(w, "const int64_t f%d = %s, n%d = %s - f%d + 1;", level, first, level, last, level);
    uint32_t around = w->region;
    if (!r->holds_sums) {            /* a body without sums of its own is cheap to write twice */
        line(w, "int64_t m%d = 0;", level);
        line(w, "if (n%d > 16)", level);
        w->depth++;
        write_eight(w, region);
        w->depth--;
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
             type_of(w, w->plan.items.at[k].n), k, last, first, k, k, k, k, k, k, k, k, k);
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
    if (r->level == 0 && w->e->windowed)
        line(w, "for (int64_t j0 = window_later(%s, from), e0 = window_sooner(%s, to - 1); j0 <= e0; j0++) {", first, last);
    else
        line(w, "for (int64_t j%d = %s, e%d = %s; j%d <= e%d; j%d++) {", r->level, first, r->level, last, r->level, r->level, r->level);
    w->depth++;
    write_region(w, region);
    w->depth--;
    line(w, "}");
    w->region = around;
}

/* Whether the function that is being written computes an item of its region itself. */
static bool belongs(const writer *w, const plan_item *i, uint32_t region)
{
    if (w->part == TERMS)
        return (w->nature[i->n] & PLAIN_TIME) || w->plan.g->nodes[i->n].op == OP_TIME;
    if (region != AT_BIND || w->part == RUNNING)
        return true;
    return wide(w, i->n) == (w->part == BINDING_LANES) && w->plan.g->nodes[i->n].op != OP_CONST;
}

static void write_region(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    w->region = region;
    write_outputs(w, r->outputs);
    for (uint32_t k = 0; k < r->item_count && !w->plan.failed; k++) {
        uint32_t item = w->plan.order[r->items + k];
        plan_item *i = &w->plan.items.at[item];
        if (!belongs(w, i, region))
            continue;
        if (i->inside != NONE && i->reg == NONE)
            write_loop(w, i->inside);
        w->region = region;
        if (i->sum != NONE)
            write_update(w, i);
        else
            write_item(w, item);
    }
    for (uint32_t k = r->first_child; k != NONE && !w->plan.failed; k = w->plan.regions.at[k].next)
        if (!w->plan.regions.at[k].sum && region != AT_BIND && w->part == RUNNING) {
            write_loop(w, k);
            w->region = region;
        }
}

/* The whole ------------------------------------------------------------------------------------------------------- */

/* Constants stand in the text where they are used. */
static void write_constants(writer *w)
{
    const plan_region *bind = &w->plan.regions.at[AT_BIND];
    char number[EMIT_NUMBER];
    for (uint32_t k = 0; k < bind->item_count; k++) {
        uint32_t item = w->plan.order[bind->items + k];
        const graph_node *n = &w->plan.g->nodes[w->plan.items.at[item].n];
        if (n->op != OP_CONST)
            continue;
        emit_number(n->value, number);
        line(w, "const double r%u = %s; (void)r%u;", item, number, item);
    }
}

static const char parameters[] = "const double *restrict pool, const int64_t *restrict q, ";
static const char silence[] = "    (void)pool, (void)q, (void)u";

static void write_functions(writer *w, const char *name, bool terms)
{
    SAY(w, "static inline void %s_bind(%sdouble *restrict u)\n{\n%s;\n", name, parameters, silence);
    w->part = BINDING;
    write_constants(w);
    write_region(w, AT_BIND);
    SAY(w, "}\n\n");
    if (w->e->lanes) {
        SAY(w, "static inline void %s_bind_lanes(%sconst double *restrict u, const real *restrict own, real *restrict w)\n{\n%s, (void)own, (void)w;\n",
            name, parameters, silence);
        w->part = BINDING_LANES;
        write_constants(w);
        write_region(w, AT_BIND);
        SAY(w, "}\n\n");
    }
    if (terms && w->e->terms) {
        SAY(w, "static inline void %s_terms(%sconst double *restrict u, const reals t, reals *restrict T)\n{\n%s, (void)t;\n", name, parameters, silence);
        w->part = TERMS;
        write_constants(w);
        write_region(w, AT_RUN);
        SAY(w, "}\n\n");
    }
    SAY(w, "%s void %s(%sconst double *restrict u, const real *restrict w, real *restrict own, double t, const double *restrict T, "
           "real *restrict x, real *restrict v, real *restrict a, real *restrict out%s)\n{\n%s, (void)w, (void)own, (void)t, (void)T, (void)x, (void)v, (void)a, "
           "(void)out;\n", w->e->separate ? "__attribute__((noinline)) static" : "static inline", name, parameters,
        w->e->windowed ? ", const whole from, const whole to, const window_put *move" : "", silence);
    w->part = RUNNING;
    write_constants(w);
    write_region(w, AT_RUN);
    SAY(w, "}\n\n");
}

bool emit_program(emit *e, const program *p, const char *name, bool terms)
{
    writer w = {.e = e, .region = AT_BIND, .depth = 1};
    if (plan_create(&w.plan, e->text.arena, p, false)) {
        const plan_region *bind = &w.plan.regions.at[AT_BIND];
        w.fixed = arena_grow(e->text.arena, NULL, 0, (w.plan.items.count + 1) * sizeof *w.fixed);
        w.nature = arena_grow(e->text.arena, NULL, 0, (w.plan.g->count + 1) * sizeof *w.nature);
        w.term = arena_grow(e->text.arena, NULL, 0, (w.plan.g->count + 1) * sizeof *w.term);
        if (w.fixed && w.nature && w.term) {
            if (find_natures(&w, false) && e->lanes)
                find_natures(&w, true);
            for (uint32_t k = 0; k < w.plan.g->count; k++) {
                w.term[k] = NONE;
                if (!terms)
                    w.nature[k] &= (uint8_t)~PLAIN_TIME;
            }
            if (terms)
                find_terms(&w);
            w.part = RUNNING;
            for (uint32_t k = 0; k < bind->item_count; k++) {
                uint32_t item = w.plan.order[bind->items + k];
                w.fixed[item] = wide(&w, w.plan.items.at[item].n) ? e->fixed_lanes++ : e->fixed++;
            }
            write_functions(&w, name, terms);
        }
    }
    plan_release(&w.plan);
    return !e->text.arena->failed;
}

/* OF, FUSE and WHEN are the text's: they mean one thing for doubles and another for lanes. */
#define OF(f) OF(f)
#define FUSE(a, b, c) FUSE(a, b, c)
#define WHEN(condition, a, b) WHEN(condition, a, b)

bool emit_operations(emit *e, uint64_t set, const char *type, const char *prefix)
{
    emit_text *t = &e->text;
#define LEAF(...)
#define IN_SET(id) if (set & OPERATION_BIT(id))
#define UNARY(id, spelling, degree, smooth, value, derivative) \
    IN_SET(id) emit_add(t, "static inline %s %s_%d(%s a) { return %s; }\n", type, prefix, OP_##id, type, #value);
#define BINARY(id, spelling, degree, smooth, value, derivative) \
    IN_SET(id) emit_add(t, "static inline %s %s_%d(%s a, %s b) { return %s; }\n", type, prefix, OP_##id, type, type, #value);
#define TERNARY(id, spelling, degree, smooth, value, derivative) \
    IN_SET(id) emit_add(t, "static inline %s %s_%d(%s a, %s b, %s c) { return %s; }\n", type, prefix, OP_##id, type, type, type, #value);
#include "lang/operations.def"
#undef IN_SET
    return !e->text.arena->failed;
}
