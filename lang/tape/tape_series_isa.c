/* Runs the tasks of tape_series_code.h, one pass for each order. Compiled for several instruction sets (tape_isa.h), so
 * that a fused operation is one instruction.
 *
 * Invariant: every pass walks through memory in one way, so it sets its pointers to what they were in the pass before.
 * What depends on parameters alone is computed with order 0.
 */
#include "lang/tape/tape_isa.h"
#include "lang/tape/tape_series_code.h"

#define real double
#define coef double
#define FMA(a, b, c) fma(a, b, c)
#define PICK(where, a, b) ((where) ? (a) : (b))
#define SOME(where) (where)
#ifdef ONE_COPY /* where size counts more: the one copy of the functions, in operation.c */
#define SERIES_OF(f) copy_##f
#define COPY(id, name, operands, ...) \
    __attribute__((unused)) static double copy_##name operands { return operation_value(OP_##id, __VA_ARGS__, 0); }
#define COPY_1(id, name) COPY(id, name, (double x), x, 0)
#define COPY_2(id, name) COPY(id, name, (double x, double y), x, y)
#define OP(...)
#define FUNCTION(id, arity, name, texts, value) COPY_##arity(id, name)
#include "lang/base/operations.def"
#undef OP
#define copy_sqrt(x) operation_value(OP_SQRT, x, 0, 0)
#else
#define SERIES_OF(f) motus_##f
#endif
#define NO_SERIES 0.0
#include "step/reciprocals.h"
#include "step/series.h"

typedef struct running {
    tape_series *s;
    const series_pass *pass;
    double *next; /* the next free number of the memory */
    int64_t index[MAX_LEVELS];
    int part[MAX_LEVELS]; /* the partial sum that gets the present term */
} running;

static series operand_of(const tape_series *s, uint32_t item) { return (series){s->at[item], s->last[item]}; }

static __attribute__((noinline)) double coefficient(const running *run, const series_task *task, double *r)
{
    const tape_series *s = run->s;
    const series a = operand_of(s, task->a), b = operand_of(s, task->b), c = operand_of(s, task->c);
    const int n = run->pass->n, length = s->length;
    const double *const in = SERIES_NONE;
    if (n == 0 && !task->begins) return operation_value((operation)task->op, a.at[0], b.at[0], c.at[0]);
    switch (task->op) {
#define LEAF(...)
#define OP(id, arity, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    case OP_##id:                                                                           \
        return recurrence;
#include "lang/base/operations.def"
#undef OP
    default: return NAN;
    }
}

static void update(const running *run, const series_task *task)
{
    const tape_series *s = run->s;
    const series a = operand_of(s, task->a), b = operand_of(s, task->b);
    const int n = run->pass->n;
    double *total = &s->totals[task->r][run->part[task->at]];
    if (task->c != NONE && s->at[task->c][0] == 0) return;
    switch (task->op) {
    case OP_FMA: *total = n ? *total + series_product(a, b, n, SERIES_NONE) : fma(a.at[0], b.at[0], *total); break;
    case OP_FNMA: *total = n ? *total - series_product(a, b, n, SERIES_NONE) : fma(-a.at[0], b.at[0], *total); break;
    default: *total = *total + series_at(a, n);
    }
}

static size_t place_of(const running *run, const reference *r)
{
    const binding *b = &run->s->binding;
    return graph_element(b->arrays, r, run->index, b->ints);
}

static void put(const running *run, const series_task *task)
{
    const tape_series *s = run->s;
    const series_pass *p = run->pass;
    const output *o = &s->program->outputs[task->r];
    const double value = series_at(operand_of(s, task->a), p->n);
    const size_t place = place_of(run, &o->to), length = (size_t)s->length;
    switch (s->binding.arrays[o->to.array].space) {
    case SPACE_X: p->x[place * length + (size_t)p->n] = value; break;
    case SPACE_V: p->v[place * length + (size_t)p->n] = value; break;
    default: p->a[place] = value;
    }
}

static void state(const running *run, const series_task *task)
{
    const reference *r = &run->s->program->graph->references[task->a];
    double *from = run->s->binding.arrays[r->array].space == SPACE_X ? run->pass->x : run->pass->v;
    run->s->at[task->r] = from + place_of(run, r) * (size_t)run->s->length;
}

static double leaf(const running *run, const series_task *task)
{
    const tape_series *s = run->s;
    switch (task->what) {
    case SERIES_CONST: return s->constants[task->a];
    case SERIES_TIME: return run->pass->n ? 1 : run->pass->t;
    case SERIES_PARAM: return s->binding.pool[task->a];
    case SERIES_TABLE: return operation_table(s->binding.pool + s->binding.arrays[task->a].base);
    case SERIES_INDEX: return (double)run->index[task->a];
    default: return s->binding.pool[place_of(run, &s->program->graph->references[task->a])];
    }
}

/* Returns the value of a sum from its partial sums. */
static double total_of(const double *p, bool in_order)
{
    return in_order ? p[0] : ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7]));
}

static void run_region(running *, uint32_t region);

static void run_loop(running *run, uint32_t region)
{
    tape_series *s = run->s;
    const series_region *r = &s->regions[region];
    const int64_t first = graph_subscript(&r->range.first, run->index, s->binding.ints),
                  last = graph_subscript(&r->range.last, run->index, s->binding.ints);
    const bool in_order = last - first < SERIES_IN_ORDER;
    for (uint32_t k = 0; k < r->total_count; k++)
        for (int i = 0; i < SERIES_PARTS; i++) s->totals[r->first_total + k][i] = 0;
    for (int64_t j = first; j <= last; j++) {
        run->index[r->level] = j;
        run->part[r->level] = in_order ? 0 : (int)((j - first) % SERIES_PARTS);
        run_region(run, region);
    }
    for (uint32_t k = 0; k < r->total_count; k++) {
        double *p = s->totals[r->first_total + k];
        p[0] = total_of(p, in_order);
    }
}

/* Runs a region and the loops in it, at most MAX_LEVELS deep. */
static void run_region(running *run, uint32_t region)
{
    tape_series *s = run->s;
    const series_region *r = &s->regions[region];
    const int n = run->pass->n;
    double *frame = run->next;
    run->next += r->frame;
    for (const series_task *task = s->tasks + r->first, *end = task + r->count; task < end; task++) {
        switch (task->what) {
        case SERIES_LOOP:
            if (region != AT_BIND || n == 0) run_loop(run, task->a);
            continue;
        case SERIES_UPDATE: update(run, task); continue;
        case SERIES_PUT: put(run, task); continue;
        case SERIES_STATE: state(run, task); continue;
        case SERIES_TWIN: s->at[task->r] = s->at[task->a] + s->length; continue;
        default: break;
        }
        double *at = s->at[task->r] = frame + task->at;
        if (n > s->last[task->r]) continue;
        switch (task->what) {
        case SERIES_OPERATION: at[n] = coefficient(run, task, at); break;
        case SERIES_TOTAL: at[n] = s->totals[task->a][0]; break;
        default: at[n] = leaf(run, task);
        }
    }
}

void OF_ISA(tape_series_isa_)(tape_series *s, const series_pass *pass)
{
    running run = {.s = s, .pass = pass, .next = pass->memory};
    run_region(&run, AT_BIND);
    run.next = pass->memory + s->bound;
    run_region(&run, AT_RUN);
}
