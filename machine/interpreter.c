/* The interpreter, the portable machine: evaluates a model's programs as tapes, for the library's stepper. */
#include "machine/machine.h"

#include "lang/graph/graph_place.h"
#include "lang/graph/graph_walk.h"
#include "lang/read/read.h"
#include "lang/graph/expansion.h"
#include "lang/tape/tape.h"
#include "lang/tape/tape_series.h"
#include "machine/rounding.h"
#include "lang/model/resolution.h"

#include <string.h>

enum { LENGTHS = SERIES_ORDER_MOST + 2 }; /* a series has one number more than its order */
struct interpreter {
    model *model;
    tape *accel, *boundary, *exact;
    tape *jvp[4];        /* along dx (1), dv (2), or both (3) */
    tape **observed;     /* one per definition, made when it is first observed, and kept while there is room */
    tape **roundings;    /* bounds on the rounding of definitions, made when first needed; NULL for long ones */
    resolution **leaps;  /* of definitions that may jump, made when first needed */
    uint8_t *leaping;    /* per definition: 0 not known, else 1 + LEAPS + FLAT + SHARP */
    uint64_t operations; /* of the tapes in `observed` */
    struct expanded {    /* by the length of Taylor series, made when first needed */
        tape_series *equations, *boundary;
        bool known;
    } expanded[LENGTHS];
    double *acceleration; /* for quantities that contain x'' */
};

static tape *make_in(arena *a, model *m, const output *outputs, size_t count)
{
    tape *t = tape_of(a, m->graph, outputs, count);
    binding b = {m->arrays, m->ints, m->pool};
    return t && !m->arena->failed && tape_bind(t, &b) ? t : NULL;
}

static tape *make(model *m, const output *outputs, size_t count) { return make_in(m->arena, m, outputs, count); }

static int accel(void *ctx, double t, double *x, double *v, double *a)
{
    interpreter *in = ctx;
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a};
    if (in->model->driven) tape_run(in->boundary, t, base);
    tape_run(in->accel, t, base);
    return 0;
}

static void refresh(void *ctx, double t, double *x, double *v)
{
    interpreter *in = ctx;
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v};
    tape_run(in->boundary, t, base);
}

static int exact(void *ctx, double t, double *x, double *v)
{
    interpreter *in = ctx;
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v};
    if (in->boundary) tape_run(in->boundary, t, base);
    tape_run(in->exact, t, base);
    return 0;
}

static bool exact_rounding(void *ctx, double t, double *x, double *v)
{
    interpreter *in = ctx;
    return verify_exact_rounding(in->model, t, x, v);
}

/* ---- Taylor series ---- */

static tape_series *expand(model *m, const output *outputs, size_t count, int length)
{
    const program *p = expansion_program(m->arena, m->graph, outputs, count);
    tape_series *s = p ? tape_series_create(m->arena, p, length) : NULL;
    if (s) tape_series_bind(s, &(binding){m->arrays, m->ints, m->pool});
    return s;
}

static size_t series_numbers(void *ctx, int length)
{
    interpreter *in = ctx;
    model *m = in->model;
    if (length >= LENGTHS) return 0;
    struct expanded *e = &in->expanded[length];
    if (!e->known) {
        e->equations = expand(m, m->accel, m->accel_count, length);
        e->boundary = m->driven ? expand(m, m->boundary, m->boundary_count, length) : NULL;
        e->known = e->equations && (e->boundary || !m->driven);
    }
    if (!e->known) return 0;
    return 1 + tape_series_numbers(e->equations) + (e->boundary ? tape_series_numbers(e->boundary) : 0);
}

static void series(void *ctx, int length, int n, double t, double *x, double *v, double *a, double *kept)
{
    const interpreter *in = ctx;
    const struct expanded *e = &in->expanded[length];
    if (e->boundary)
        tape_series_run(e->boundary, &(series_pass){n, t, x, v, a, kept + tape_series_numbers(e->equations)});
    tape_series_run(e->equations, &(series_pass){n, t, x, v, a, kept});
}

enum { ALONG_X = 1, ALONG_V = 2 };

typedef struct direction {
    graph_shift shift;
    int along;
} direction;

static node seed(graph *g, node leaf, void *ctx)
{
    direction *d = ctx;
    const graph_node *n = graph_at(g, leaf);
    if (n->op != OP_LOAD) return 0;
    space from = g->arrays[g->references[n->a].array].space;
    if ((from == SPACE_X && !(d->along & ALONG_X)) || (from == SPACE_V && !(d->along & ALONG_V))) return 0;
    return graph_seed_direction(g, leaf, &d->shift);
}

static output *derivatives(model *m, int along)
{
    output *o = arena_room(m->arena, m->accel_count * sizeof *o);
    if (!o) return NULL;
    direction d = {{(uint16_t)(3 * m->block_size), (uint16_t)(3 * m->block_size)}, along};
    for (size_t i = 0; i < m->accel_count; i++) {
        o[i] = m->accel[i];
        o[i].value = graph_derivative(m->graph, o[i].value, seed, &d);
    }
    return o;
}

/* Returns the tape of a derivative, made when a method first needs it: most methods do not. */
static tape *derive(interpreter *in, int along)
{
    if (in->jvp[along]) return in->jvp[along];
    const output *o = derivatives(in->model, along);
    return o ? in->jvp[along] = make(in->model, o, in->model->accel_count) : NULL;
}

program *interpreter_derivative(model *m, bool in_v)
{
    const output *o = derivatives(m, in_v ? ALONG_V : ALONG_X);
    return o ? program_create(m->graph, o, m->accel_count) : NULL;
}

static bool prepare(void *ctx, bool in_v)
{
    interpreter *in = ctx;
    return derive(in, in_v ? ALONG_V : ALONG_X) && !in->model->arena->failed;
}

static int jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    interpreter *in = ctx;
    tape *tp = derive(in, (dx ? ALONG_X : 0) | (dv ? ALONG_V : 0));
    if (!tp) return 1;
    double *base[SPACES] = {
        [SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = da, [SPACE_DX] = (double *)dx, [SPACE_DV] = (double *)dv};
    tape_run(tp, t, base);
    return 0;
}

/* ---- the structure of the derivatives ---- */

typedef struct structure {
    const model *model;
    const output *output;
    int64_t index[MAX_LEVELS];
    void (*emit)(void *arg, size_t row, size_t column);
    void *arg;
} structure;

static size_t at_place(const structure *s, const reference *r)
{
    return graph_element(s->model->arrays, r, s->index, s->model->ints);
}

/* Emits the entry for every combination of the loops' values from `level` on. */
static void emit_loops(structure *s, const range *sums, int first_sum, int level, int levels, const reference *r)
{
    if (level == levels) {
        s->emit(s->arg, at_place(s, &s->output->to), at_place(s, r));
        return;
    }
    const range *loop = level < s->output->loops ? &s->output->loop[level] : &sums[level - first_sum];
    int64_t first = graph_subscript(&loop->first, s->index, s->model->ints),
            last = graph_subscript(&loop->last, s->index, s->model->ints);
    for (s->index[level] = first; s->index[level] <= last; s->index[level]++)
        emit_loops(s, sums, first_sum, level + 1, levels, r);
}

static void visit_load(void *ctx, const reference *r, const range *sums, int first_level, int inside)
{
    structure *s = ctx;
    if (s->model->arrays[r->array].mode) return; /* it does not change within a step */
    emit_loops(s, sums, first_level, 0, inside ? first_level + inside : s->output->loops, r);
}

static void pattern(void *ctx, bool in_v, void (*emit)(void *arg, size_t row, size_t column), void *arg)
{
    const interpreter *in = ctx;
    const model *m = in->model;
    for (size_t i = 0; i < m->accel_count; i++) {
        structure s = {.model = m, .output = &m->accel[i], .emit = emit, .arg = arg};
        graph_loads(m->graph, m->accel[i].value, in_v ? SPACE_V : SPACE_X, visit_load, &s);
    }
}

static void name(void *ctx, bool in_v, size_t k, char *out, size_t size)
{
    const interpreter *in = ctx;
    model_name(in->model, in_v, k, out, size);
}

motus_status interpreter_create(model *m, interpreter **out, problem *p, motus_error *err)
{
    interpreter *in = arena_take(m->arena, sizeof *in);
    if (m->arena->failed) return fail(err, MOTUS_MEMORY, "no memory for the model");
    in->model = m;
    in->accel = make(m, m->accel, m->accel_count);
    in->boundary = m->boundary_count ? make(m, m->boundary, m->boundary_count) : NULL;
    in->exact = m->exact_count && m->traits.has_exact ? make(m, m->exact, m->exact_count) : NULL;
    in->observed = arena_room(m->arena, (m->definition_count + 1) * sizeof *in->observed);
    in->roundings = arena_room(m->arena, (m->definition_count + 1) * sizeof *in->roundings);
    in->leaps = arena_room(m->arena, (m->definition_count + 1) * sizeof *in->leaps);
    in->leaping = arena_room(m->arena, m->definition_count + 1);
    if (m->arena->failed || !in->accel || !in->observed || !in->roundings || !in->leaps || !in->leaping)
        return fail(err, MOTUS_MEMORY, "no memory for the model");
    *p = (problem){.ctx = in,
                   .nx = m->nx,
                   .nv = m->nv,
                   .modes = m->modes,
                   .variables = m->variables,
                   .variable_count = (int)(m->state_count + m->mode_count),
                   .traits = m->traits,
                   .accel = accel,
                   .jvp = jvp,
                   .prepare = prepare,
                   .pattern = pattern,
                   .series_numbers = series_numbers,
                   .series = series,
                   .refresh = m->driven ? refresh : NULL,
                   .exact = in->exact ? exact : NULL,
                   .exact_rounding = m->exact_given ? exact_rounding : NULL,
                   .name = name};
    *out = in;
    return MOTUS_OK;
}

static uint64_t operations_of(const model *m, const model_definition *d)
{
    uint64_t count = 0;
    for (size_t k = 0; k < d->output_count; k++) {
        graph_walk w;
        if (!graph_order(m->graph, &d->outputs[k].value, 1, 0, true, &w)) return 0;
        count += w.count;
        give(&m->arena->allocator, w.nodes);
    }
    return count;
}

/* Returns the tape of a definition, in the model's arena, or in `once` where the kept tapes are large already: n
 * quantities, each of which uses the one before, have about n^2 operations together. */
static tape *observed(interpreter *in, const model_definition *d, arena *once)
{
    enum { OPERATIONS_KEPT = 1 << 25 }; /* a gigabyte */
    tape **kept = &in->observed[d - in->model->definitions];
    if (*kept) return *kept;
    const uint64_t operations = operations_of(in->model, d);
    if (in->operations + operations > OPERATIONS_KEPT) return make_in(once, in->model, d->outputs, d->output_count);
    in->operations += operations;
    return *kept = make(in->model, d->outputs, d->output_count);
}

static bool observe(interpreter *in, tape *t, bool needs_a, double time, double *x, double *v, double *out)
{
    const model *m = in->model;
    if (needs_a && !in->acceleration) in->acceleration = arena_room(m->arena, (m->nv + 1) * sizeof(double));
    if (!t || (needs_a && !in->acceleration)) return false;
    if (needs_a) {
        memset(in->acceleration, 0, m->nv * sizeof(double));
        accel(in, time, x, v, in->acceleration);
    }
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = in->acceleration, [SPACE_OUT] = out};
    tape_run(t, time, base);
    return true;
}

static bool needs_a(const interpreter *in, const model_definition *d)
{
    bool needs = false;
    for (size_t k = 0; k < d->output_count; k++)
        needs |= (graph_deps(in->model->graph, d->outputs[k].value) & DEP_A) != 0;
    return needs;
}

bool interpreter_observe(interpreter *in, model_definition *d, double t, double *x, double *v, double *out)
{
    arena once;
    arena_init(&once, &in->model->arena->allocator);
    const bool known = observe(in, observed(in, d, &once), needs_a(in, d), t, x, v, out);
    arena_release(&once);
    return known;
}

bool interpreter_rounding(interpreter *in, model_definition *d, double t, double *x, double *v, double *out)
{
    enum { OPERATIONS_MOST = 1 << 16 };
    tape **kept = &in->roundings[d - in->model->definitions];
    memset(out, 0, d->numbers * sizeof *out);
    if (!*kept && operations_of(in->model, d) > OPERATIONS_MOST) return true;
    if (!*kept) {
        binding b = {in->model->arrays, in->model->ints, in->model->pool};
        tape *made = rounding_tape(in->model, d->outputs, d->output_count);
        *kept = made && tape_bind(made, &b) ? made : NULL;
    }
    if (!*kept || !observe(in, *kept, needs_a(in, d), t, x, v, out)) return false;
    for (size_t k = 0; k < d->numbers; k++) out[k] *= 0x1p-53;
    return true;
}

enum { LEAPS = 1, FLAT = 2, SHARP = 4 };

static uint8_t kind_of(interpreter *in, model_definition *d)
{
    enum { OPERATIONS_MOST = 1 << 16 };
    graph *g = in->model->graph;
    uint8_t *known = &in->leaping[d - in->model->definitions];
    if (!*known) {
        bool leaps = false, sharp = false, all = true;
        for (size_t k = 0; k < d->output_count; k++) {
            leaps |= graph_jump(g, d->outputs[k].value) != 0;
            sharp |= graph_sharp(g, d->outputs[k].value) != 0;
            all &= graph_flat(g, d->outputs[k].value);
        }
        const bool examined = !needs_a(in, d) && operations_of(in->model, d) <= OPERATIONS_MOST;
        *known = (uint8_t)(1 + (examined && leaps ? LEAPS : 0) + (examined && sharp ? SHARP : 0) + (all ? FLAT : 0));
    }
    return (uint8_t)(*known - 1);
}

bool interpreter_leaps(interpreter *in, model_definition *d, bool *flat)
{
    const uint8_t kind = kind_of(in, d);
    *flat = kind & FLAT;
    return kind & LEAPS;
}

bool interpreter_sharp(interpreter *in, model_definition *d) { return kind_of(in, d) & SHARP; }

bool interpreter_doubt(interpreter *in, model_definition *d, double t, interval *x, interval *v, interval *out,
                       doubt *open)
{
    resolution **kept = &in->leaps[d - in->model->definitions];
    if (!*kept && !resolution_create_doubts(in->model, d->outputs, d->output_count, kept)) return false;
    const interval now = {t, t};
    resolution_values(*kept, now, x, v, NULL, in->model->pool, out);
    *open = resolution_doubt(*kept, now, x, v, in->model->pool);
    return true;
}

bool interpreter_rebind(interpreter *in)
{
    model *m = in->model;
    binding b = {m->arrays, m->ints, m->pool};
    tape *const tapes[] = {in->accel, in->boundary, in->exact, in->jvp[0], in->jvp[1], in->jvp[2], in->jvp[3]};
    for (size_t k = 0; k < sizeof tapes / sizeof *tapes; k++)
        if (tapes[k] && !tape_bind(tapes[k], &b)) return false;
    for (uint32_t k = 0; k < m->definition_count; k++)
        if ((in->observed[k] && !tape_bind(in->observed[k], &b)) ||
            (in->roundings[k] && !tape_bind(in->roundings[k], &b)))
            return false;
    for (int k = 0; k < LENGTHS; k++) {
        if (in->expanded[k].known) tape_series_bind(in->expanded[k].equations, &b);
        if (in->expanded[k].known && m->driven) tape_series_bind(in->expanded[k].boundary, &b);
    }
    double *base[SPACES] = {[SPACE_X] = m->x0, [SPACE_V] = m->v0};
    if (in->boundary) tape_run(in->boundary, m->start, base);
    return true;
}
