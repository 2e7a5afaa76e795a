/* Runs a tape: one loop over instructions. Scalars are computed in place, blocks by kernels. Compiled for several
 * instruction sets (tape_isa.h), so that a scalar fma is an instruction, too.
 *
 * Invariant: the pointers of block registers never change, but for the current total of a sum, which its loop sets. The
 * instruction that makes a view or a target sets its pointer.
 */
#include "lang/tape/tape_isa.h"

#include <string.h>

#define REGISTER(f, x) ((f)->pointers[(x) & ~BLOCK_BIT])

static const double *operand_at(const frame *f, uint32_t x) { return x & BLOCK_BIT ? REGISTER(f, x) : f->scalars + x; }

/* Memory ----------------------------------------------------------------------------------------------------------- */

static int64_t wrapped(int64_t v, int64_t m)
{
    int64_t r = v % m;
    return r < 0 ? r + m : r;
}

static double *place_of(const frame *f, const site *s)
{
    int64_t at = s->offset;
    for (int k = 0; k < s->terms; k++) at += f->index[s->level[k]] * s->step[k];
    for (int k = 0; k < s->wraps; k++) {
        int64_t v = s->wrap[k].add + (s->wrap[k].level >= 0 ? f->index[s->wrap[k].level] : 0);
        at += wrapped(v, s->wrap[k].modulus) * s->wrap[k].step;
    }
    /* no output goes to the pool, so it is never written */
    return (s->space == SPACE_POOL ? (double *)(uintptr_t)f->binding->pool : f->base[s->space]) + at;
}

/* Returns how many lanes from the present one on, at most `limit`, come before a modular subscript wraps. */
static size_t stretch(const frame *f, const site *s, size_t limit)
{
    for (int k = 0; k < s->wraps; k++)
        if (s->wrap[k].level == s->lanes) {
            int64_t left = s->wrap[k].modulus - wrapped(s->wrap[k].add + f->index[s->lanes], s->wrap[k].modulus);
            if ((uint64_t)left < limit) limit = (size_t)left;
        }
    return limit;
}

static double *view(frame *f, const site *s, double *memory)
{
    size_t n = f->lanes, run = stretch(f, s, n);
    double *p = place_of(f, s);
    if (run == n && s->lane_step == 1) return p;
    int64_t first = f->index[s->lanes];
    for (size_t k = 0; k < n;) {
        for (size_t j = 0; j < run; j++) memory[k + j] = p[(int64_t)j * s->lane_step];
        k += run;
        f->index[s->lanes] = first + (int64_t)k;
        p = place_of(f, s);
        run = stretch(f, s, n - k);
    }
    f->index[s->lanes] = first;
    return memory;
}

static void scatter(frame *f, const site *s, const double *from, bool block)
{
    int64_t first = f->index[s->lanes];
    for (size_t k = 0, run; k < f->lanes; k += run) {
        f->index[s->lanes] = first + (int64_t)k;
        double *p = place_of(f, s);
        run = stretch(f, s, f->lanes - k);
        if (s->lane_step == 1 && block)
            memcpy(p, from + k, run * sizeof *p);
        else
            for (size_t j = 0; j < run; j++) p[(int64_t)j * s->lane_step] = block ? from[k + j] : *from;
    }
    f->index[s->lanes] = first;
}

/* Sums ------------------------------------------------------------------------------------------------------------- */

#define TERMS(value)                                                \
    do {                                                            \
        if (single) {                                               \
            for (size_t k = 0; k < n; k++) {                        \
                double total = part[0], next = value;               \
                part[0] = !mask || mask[k] != 0 ? next : total;     \
            }                                                       \
        } else {                                                    \
            for (size_t start = 0; start < n; start += PARTS) {     \
                size_t end = n - start < PARTS ? n - start : PARTS; \
                for (size_t j = 0; j < end; j++) {                  \
                    size_t k = start + j;                           \
                    double total = part[j], next = value;           \
                    part[j] = !mask || mask[k] != 0 ? next : total; \
                }                                                   \
            }                                                       \
        }                                                           \
    } while (0)

/* Adds the lanes of a block to the partial sums. Every block but the last has a multiple of PARTS lanes, so lane k
 * belongs to part k mod PARTS. */
static void add_terms(double part[PARTS], int op, const double *p, const double *q, const double *mask, size_t n,
                      bool single)
{
    switch (op) {
    case OP_FMA: TERMS(fma(p[k], q[k], total)); break;
    case OP_FNMA: TERMS(fma(-p[k], q[k], total)); break;
    default: TERMS(total + p[k]); break;
    }
}

static void terms(frame *f, const instruction *i)
{
    const total *t = &f->code->totals[i->r];
    double part[PARTS];
    for (int k = 0; k < PARTS; k++) part[k] = f->scalars[t->part[k]];
    const double *p = operand_at(f, i->a), *q = i->b == NONE ? p : operand_at(f, i->b);
    const double *mask = i->c == NONE ? NULL : operand_at(f, i->c);
    add_terms(part, i->kernel, p, q, mask, f->lanes, f->short_terms);
    for (int k = 0; k < PARTS; k++) f->scalars[t->part[k]] = part[k];
}

static void clear(frame *f, const total *t, int parts)
{
    for (int k = 0; k < parts; k++) {
        if (t->block)
            memset(REGISTER(f, t->part[k]), 0, f->lanes * sizeof(double));
        else
            f->scalars[t->part[k]] = 0;
    }
    if (t->current != NONE) {
        if (t->block)
            REGISTER(f, t->current) = REGISTER(f, t->part[0]);
        else
            f->scalars[t->current] = 0;
    }
}

/* Adds up partial sums: ((p0+p1)+(p2+p3))+((p4+p5)+(p6+p7)). */
static void combine(frame *f, const total *t)
{
    for (int width = 1; width < PARTS; width *= 2)
        for (int k = 0; k < PARTS; k += 2 * width) {
            if (t->block) {
                double *p = REGISTER(f, t->part[k]);
                OF_ISA(tape_kernels_)[OP_ADD * 8 + 3](p, p, REGISTER(f, t->part[k + width]), p, f->lanes);
            } else {
                f->scalars[t->part[k]] += f->scalars[t->part[k + width]];
            }
        }
}

/* Loops ------------------------------------------------------------------------------------------------------------ */

static const instruction *enter(frame *f, const loop *l)
{
    const instruction *text = f->code->instructions;
    const total *totals = f->code->totals + l->first_total;
    int64_t first = graph_subscript(&l->range.first, f->index, f->binding->ints);
    int64_t last = graph_subscript(&l->range.last, f->index, f->binding->ints);
    if (last < first) {
        for (uint32_t k = 0; k < l->total_count; k++) clear(f, &totals[k], 1);
        return text + l->end + 1;
    }
    f->index[l->level] = first;
    f->last[l->level] = last;
    f->term[l->level] = 0;
    f->short_sum[l->level] = last - first < IN_ORDER_MAX;
    if (l->kind == LOOP_TERMS) f->short_terms = f->short_sum[l->level];
    for (uint32_t k = 0; k < l->total_count; k++) clear(f, &totals[k], f->short_sum[l->level] ? 1 : PARTS);
    if (l->kind != LOOP_SERIAL) f->lanes = (uint64_t)(last - first) < f->width ? (size_t)(last - first + 1) : f->width;
    return text + l->body;
}

/* Stores the total of a pass in its partial sum, and loads that of the next pass. */
static void next_partial(frame *f, const loop *l, const total *t)
{
    int64_t m = f->term[l->level];
    if (t->block) {
        REGISTER(f, t->current) = REGISTER(f, t->part[(m + 1) % PARTS]);
    } else {
        f->scalars[t->part[m % PARTS]] = f->scalars[t->current];
        f->scalars[t->current] = f->scalars[t->part[(m + 1) % PARTS]];
    }
}

static const instruction *again(frame *f, const loop *l)
{
    const instruction *text = f->code->instructions;
    const total *totals = f->code->totals + l->first_total;
    bool brief = f->short_sum[l->level];
    if (l->kind == LOOP_SERIAL) {
        for (uint32_t k = 0; !brief && k < l->total_count; k++) next_partial(f, l, &totals[k]);
        f->term[l->level]++;
        if (f->index[l->level]++ < f->last[l->level]) return text + l->body;
        for (uint32_t k = 0; brief && k < l->total_count; k++)
            if (!totals[k].block) f->scalars[totals[k].part[0]] = f->scalars[totals[k].current];
    } else {
        f->index[l->level] += (int64_t)f->lanes;
        int64_t left = f->last[l->level] - f->index[l->level];
        if (left >= 0) {
            f->lanes = (uint64_t)left < f->width ? (size_t)left + 1 : f->width;
            return text + l->body;
        }
    }
    for (uint32_t k = 0; !brief && k < l->total_count; k++) combine(f, &totals[k]);
    return text + l->end + 1;
}

/* Instructions ----------------------------------------------------------------------------------------------------- */

/* Executes what is no scalar operation, and returns the next instruction. It is not inlined, because the loop below is
 * fast only while its variables fit the processor's registers. */
static __attribute__((noinline)) const instruction *other(frame *f, const instruction *i)
{
    double *const R = f->scalars;
    switch (i->code) {
    case CODE_CONST: R[i->r] = f->code->constants[i->a]; break;
    case CODE_PARAM: R[i->r] = f->binding->pool[i->a]; break;
    case CODE_TABLE: R[i->r] = operation_table(f->binding->pool + f->binding->arrays[i->a].base); break;
    case CODE_INDEX: R[i->r] = (double)f->index[i->a]; break;
    case CODE_FETCH: R[i->r] = *place_of(f, &f->code->sites[i->a]); break;
    case CODE_PUT: *place_of(f, &f->code->sites[i->b]) = R[i->a]; break;
    case CODE_IOTA: {
        double *r = REGISTER(f, i->r);
        const int64_t first = f->index[i->a];
        for (size_t k = 0; k < f->lanes; k++) r[k] = (double)(first + (int64_t)k);
        break;
    }
    case CODE_FILL: {
        double *r = REGISTER(f, i->r);
        const double a = R[i->a];
        for (size_t k = 0; k < f->lanes; k++) r[k] = a;
        break;
    }
    case CODE_VIEW: REGISTER(f, i->r) = view(f, &f->code->sites[i->a], i->b == NONE ? NULL : REGISTER(f, i->b)); break;
    case CODE_TARGET: REGISTER(f, i->r) = place_of(f, &f->code->sites[i->a]); break;
    case CODE_WRITE: scatter(f, &f->code->sites[i->b], operand_at(f, i->a), (i->a & BLOCK_BIT) != 0); break;
    case CODE_LOOP: return enter(f, &f->code->loops[i->a]);
    case CODE_NEXT: return again(f, &f->code->loops[i->a]);
    case CODE_TERMS: terms(f, i); break;
    default: break;
    }
    return i + 1;
}

static __attribute__((noinline)) void block(const frame *f, const instruction *i)
{
    OF_ISA(tape_kernels_)
    [i->kernel](REGISTER(f, i->r), operand_at(f, i->a), operand_at(f, i->b), operand_at(f, i->c), f->lanes);
}

static __attribute__((noinline)) double function(const instruction *i, const double *R)
{
    const double a = R[i->a], b = R[i->b];
    switch (i->code) {
#define OP(...)
#define FUNCTION(id, arity, name, texts, value) \
    case OP_##id:                               \
        return CALLED(id, value);
#include "lang/base/operations.def"
#undef OP
    default: return NAN;
    }
}

/* Each instruction jumps to the label of the next (labels as values, a GNU extension that gcc and clang share). A
 * switch would send all of them through one jump, which costs a third of the time. */
#pragma GCC diagnostic ignored "-Wpedantic"
#define NEXT goto *label[(++i)->code]

static void execute(frame *f, const instruction *i)
{
    static const void *const label[CODE_END + 1] = {
#define LEAF(id, ...) [OP_##id] = &&l_other,
#define FUNCTION(id, ...) [OP_##id] = &&l_function,
#define OP(id, ...) [OP_##id] = &&l_##id,
#include "lang/base/operations.def"
#undef OP
        [CODE_CONST] = &&l_other,
        [CODE_TIME] = &&l_time,
        [CODE_PARAM] = &&l_other,
        [CODE_TABLE] = &&l_other,
        [CODE_INDEX] = &&l_other,
        [CODE_FETCH_FIXED] = &&l_fetch,
        [CODE_FETCH] = &&l_fetch_along,
        [CODE_PUT_FIXED] = &&l_put,
        [CODE_PUT] = &&l_other,
        [CODE_BLOCK] = &&l_block,
        [CODE_IOTA] = &&l_other,
        [CODE_FILL] = &&l_other,
        [CODE_VIEW] = &&l_other,
        [CODE_TARGET] = &&l_other,
        [CODE_WRITE] = &&l_other,
        [CODE_LOOP] = &&l_other,
        [CODE_NEXT] = &&l_other,
        [CODE_TERMS] = &&l_other,
        [CODE_END] = &&l_end};
    double *const R = f->scalars;
    goto *label[i->code];
#define LEAF(...)
#define FUNCTION(...)
#define UNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    l_##id:                                                                             \
    {                                                                                   \
        const double a = R[i->a];                                                       \
        R[i->r] = value;                                                                \
        NEXT;                                                                           \
    }
#define BINARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    l_##id:                                                                              \
    {                                                                                    \
        const double a = R[i->a], b = R[i->b];                                           \
        R[i->r] = value;                                                                 \
        NEXT;                                                                            \
    }
#define TERNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    l_##id:                                                                               \
    {                                                                                     \
        const double a = R[i->a], b = R[i->b], c = R[i->c];                               \
        R[i->r] = value;                                                                  \
        NEXT;                                                                             \
    }
#include "lang/base/operations.def"
l_function:
    R[i->r] = function(i, R);
    NEXT;
l_time:
    R[i->r] = f->t;
    NEXT;
l_fetch : {
    const site *s = &f->code->sites[i->a];
    R[i->r] = f->base[s->space][s->offset];
    NEXT;
}
l_fetch_along : {
    const site *s = &f->code->sites[i->a];
    if (s->terms > 1 || s->wraps || s->space == SPACE_POOL) goto l_other;
    R[i->r] = f->base[s->space][s->offset + f->index[s->level[0]] * s->step[0]];
    NEXT;
}
l_put : {
    const site *s = &f->code->sites[i->b];
    f->base[s->space][s->offset] = R[i->a];
    NEXT;
}
l_block:
    block(f, i);
    NEXT;
l_other:
    i = other(f, i);
    goto *label[i->code];
l_end:
    return;
}

const tape_machine OF_ISA(tape_run_) = {TEXT(ISA), execute, OF_ISA(tape_series_isa_)};
