/* Lanes: the text, and the blocks it works on. See lanes.h.
 *
 * Invariant: the results of a trajectory depend neither on the block it is in nor on who computes that. Blocks are taken through time in
 * chunks of steps, so that what depends on time alone is computed once for all of them; a block in which a number stopped being finite is
 * taken through its chunk again, step by step, to see when.
 */
#include "run/lanes.h"

#include "run/cache.h"
#include "run/compose.h"
#include "run/parallel.h"
#include "run/reduction.h"

#include "step/host.h"
#include "step/lanes_job.h"

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { GROUPS_MAX = 12, STEPS_WRITTEN_MAX = 600 };      /* vectors in a block; operations in one step of all of them */
enum { CHUNK = 512, LOOKS_MAX = 32, ALIGNMENT = 64, BATCH_BYTES = 1 << 20, BLOCK_BYTES = 4 << 20 };

struct lanes {
    lanes_def def;
    int width, groups, block;        /* block: trajectories in one */
    emit e;
    const char *text;
    void *handle;
    void (*bind)(const double *, const int64_t *, double *);
    void (*table)(const lanes_job *, clock *, whole);
    void (*begin)(const lanes_job *);
    void (*set)(const lanes_job *);
    void (*first)(const lanes_job *);
    void (*run)(const lanes_job *, whole, whole);
    double *u;
    int64_t *q, *places, *from_x, *from_v;
    lanes_record *records;
    size_t outs, moments;            /* numbers of the definitions that are looked at */
    bool wants_a;
    size_t carried;                  /* elements of a group's carry */
    size_t own_size, bound_size, carry_size, kept_size, work_size, look_size;      /* of one block, in doubles, whole cache lines */
};

/* ---- the shape ---- */

static int best_width(void)
{
#if defined __x86_64__
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma"))
        return 8;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return 4;
    return 2;
#elif defined __aarch64__
    return 2;
#else
    return 1;
#endif
}

/* So many vectors side by side that their chains of operations hide one another's latency; where a step is long, one is company enough for
 * itself, and a compiler has enough to do. */
static int best_groups(const lanes_def *d)
{
    const size_t step = (size_t)(d->chosen->row->family == TWO_STEP ? 1 : stepper_plan(d->problem, d->chosen, 0, 1).stages) *
                        (d->model->graph->count + 4 * d->model->nv);
    const size_t groups = STEPS_WRITTEN_MAX / (step + 1);
    return groups < 1 ? 1 : groups > GROUPS_MAX ? GROUPS_MAX : (int)groups;
}

const char *lanes_refuse(const lanes_def *d)
{
    const row *r = d->chosen->row;
    const traits *t = &d->problem->traits;
    if (r->family == IMPLICIT || r->family == EXACT || r->gyroscopic || (r->family == TWO_STEP && t->velocity))
        return "this method solves an equation at every step, one trajectory at a time";
    if ((d->model->pool_count + 8 * d->model->nv) * sizeof(double) * 8 > BLOCK_BYTES)
        return "the model is large: its trajectories are computed one at a time";
    if (d->model->graph->count > OPERATIONS_MAX)
        return "the equations are too long for a compiler: trajectories are computed one at a time";
    uint32_t count;
    const vary_active *active = vary_entries(d->vary, &count);
    for (uint32_t k = 0; k < count; k++)
        if (active[k].entry->map)
            return "initial values of a family vary: trajectories are computed one at a time";
    return NULL;
}

/* ---- the text ---- */

typedef struct looked { const model_definition *definition; size_t first; } looked;

static size_t list_looks(const lanes_def *d, looked list[LOOKS_MAX], size_t *outs)
{
    size_t count = 0;
    *outs = 0;
    for (size_t i = 0; i < d->source_count; i++) {
        const lanes_source *s = &d->sources[i];
        bool known = s->kind != SOURCE_DEFINITION;
        for (size_t k = 0; k < count; k++)
            known |= s->definition == list[k].definition;
        if (known)
            continue;
        if (count == LOOKS_MAX)
            return SIZE_MAX;
        list[count++] = (looked){s->definition, *outs};
        *outs += s->definition->numbers;
    }
    return count;
}

#define CALL "(host->pool, host->q, host->u, host->bound, host->own, "

/* The functions of the text that call the programs, all of one kind in one. */
static char *write_glue(lanes *l, size_t entries, const looked *looks, size_t look_count)
{
    emit_text t = {.arena = l->def.model->arena};
    const bool bounded = l->def.model->boundary_count > 0;
    emit_add(&t, "static inline void lanes_bind(const double *pool, const int64_t *q, double *u)\n{\n    compiled_force_bind(pool, q, u);\n%s",
             bounded ? "    compiled_boundary_bind(pool, q, u);\n" : "");
    for (size_t k = 0; k < entries; k++)
        emit_add(&t, "    start_%zu_bind(pool, q, u);\n", k);
    for (size_t k = 0; k < look_count; k++)
        emit_add(&t, "    look_%zu_bind(pool, q, u);\n", k);
    emit_add(&t, "}\nstatic inline void lanes_start(const lanes_job *job, const compiled_host *host, const real *values)\n{\n    (void)host;\n");
    for (size_t k = 0; k <= entries; k++) {
        emit_add(&t, "    for (whole k = 0; k < job->value_count; k++) host->own[job->places[k]] = values[k];\n");
        if (k < entries)
            emit_add(&t, "    start_%zu_bind_lanes(host->pool, host->q, host->u, host->own, host->bound);\n    start_%zu" CALL
                         "0, (const clock *)0, (real *)0, (real *)0, (real *)0, host->own);\n", k, k);
    }
    emit_add(&t, "}\n\nstatic inline void lanes_bind_lanes(const compiled_host *host)\n{\n"
                 "    compiled_force_bind_lanes(host->pool, host->q, host->u, host->own, host->bound);\n%s",
             bounded ? "    compiled_boundary_bind_lanes(host->pool, host->q, host->u, host->own, host->bound);\n" : "");
    for (size_t k = 0; k < look_count; k++)
        emit_add(&t, "    look_%zu_bind_lanes(host->pool, host->q, host->u, host->own, host->bound);\n", k);
    emit_add(&t, "}\n\nstatic inline void lanes_looks(const compiled_host *host, clock t, real *x, real *v, real *a, real *out)\n{\n"
                 "    (void)host, (void)t, (void)x, (void)v, (void)a, (void)out;\n");
    for (size_t k = 0; k < look_count; k++)
        emit_add(&t, "    look_%zu" CALL "t, (const clock *)0, x, v, a, out + %zu);\n", k, looks[k].first);
    emit_add(&t, "}\n\n");
    return l->def.model->arena->failed ? NULL : t.bytes;
}

enum { PROGRAM_NAME = 32 };

static bool write_text(lanes *l)
{
    const lanes_def *d = &l->def;
    model *m = d->model;
    uint32_t entries;
    const vary_active *active = vary_entries(d->vary, &entries);
    looked looks[LOOKS_MAX];
    const size_t look_count = list_looks(d, looks, &l->outs), count = 2 + entries + look_count;
    composed_program *programs = arena_grow(m->arena, NULL, 0, count * sizeof *programs);
    char *names = arena_grow(m->arena, NULL, 0, count * PROGRAM_NAME);
    if (!programs || !names)
        return false;
    size_t n = 0;
    programs[n++] = (composed_program){program_create(m->graph, m->accel, m->accel_count), "compiled_force", true};
    if (m->boundary_count)
        programs[n++] = (composed_program){program_create(m->graph, m->boundary, m->boundary_count), "compiled_boundary", false};
    for (uint32_t k = 0; k < entries; k++) {
        snprintf(names + n * PROGRAM_NAME, PROGRAM_NAME, "start_%u", k);
        programs[n] = (composed_program){active[k].program, names + n * PROGRAM_NAME, false};
        n++;
    }
    for (size_t k = 0; k < look_count; k++) {
        const model_definition *definition = looks[k].definition;
        for (size_t i = 0; i < definition->output_count; i++)
            l->wants_a |= (graph_deps(m->graph, definition->outputs[i].value) & DEP_A) != 0;
        snprintf(names + n * PROGRAM_NAME, PROGRAM_NAME, "look_%zu", k);
        programs[n] = (composed_program){program_create(m->graph, definition->outputs, definition->output_count), names + n * PROGRAM_NAME, false};
        n++;
    }
    static const char *const last[] = {"step/lanes_ways.h", "step/look.h", "step/reduce.h", "step/lanes.h", NULL};
    l->e = (emit){.text = {.arena = m->arena}, .lanes = true, .varied = d->place_count ? vary_affected(d->vary) : NULL};
    const composition c = {.model = m, .problem = d->problem, .chosen = d->chosen, .programs = programs, .program_count = n, .width = l->width,
                           .groups = l->groups, .glue = write_glue(l, entries, looks, look_count), .last = last, .fast = d->fast};
    if (m->arena->failed || !compose(&l->e, &c))
        return false;
    l->text = l->e.text.bytes;
    return true;
}

const char *lanes_text(lanes *l) { return l->text; }
int lanes_in_block(const lanes *l) { return l->block; }

/* ---- memory ---- */

static size_t lines(const lanes *l, size_t elements) { return (elements * (size_t)l->block + 7) / 8 * 8; }

static bool prepare(lanes *l)
{
    const lanes_def *d = &l->def;
    model *m = d->model;
    arena *a = m->arena;
    l->q = arena_grow(a, NULL, 0, (l->e.int_count + 1) * sizeof *l->q);
    l->u = arena_grow(a, NULL, 0, (l->e.fixed + 1) * sizeof *l->u);
    l->places = arena_grow(a, NULL, 0, (d->place_count + 1) * sizeof *l->places);
    l->from_x = arena_grow(a, NULL, 0, (m->nx + 1) * sizeof *l->from_x);
    l->from_v = arena_grow(a, NULL, 0, (m->nv + 1) * sizeof *l->from_v);
    l->records = arena_grow(a, NULL, 0, (d->source_count + 1) * sizeof *l->records);
    if (a->failed)
        return false;
    for (uint32_t k = 0; k < l->e.int_count; k++)
        l->q[k] = emit_int_value(&l->e.ints[k], m->arrays, m->ints);
    l->bind(m->pool, l->q, l->u);
    for (size_t k = 0; k < d->place_count; k++)
        l->places[k] = (int64_t)d->places[k];
    const uint8_t *affected = vary_affected(d->vary);
    for (uint32_t i = 0; i < m->state_count; i++) {
        const model_state *s = &m->states[i];
        size_t numbers = s->hull * (size_t)(s->components ? s->components : 1);
        for (size_t k = 0; k < numbers; k++) {
            size_t first = m->arrays[s->start_array[0]].base + k, second = s->order == 2 ? m->arrays[s->start_array[1]].base + k : first;
            if (s->order == 2)
                l->from_x[s->base + k] = affected[first] ? (int64_t)first : -1;
            l->from_v[s->base + k] = affected[second] ? (int64_t)second : -1;
        }
    }
    looked looks[LOOKS_MAX];
    size_t outs, count = list_looks(d, looks, &outs);
    for (size_t i = 0; i < d->source_count; i++) {
        const lanes_source *s = &d->sources[i];
        size_t first = 0;
        for (size_t k = 0; k < count; k++)
            if (s->kind == SOURCE_DEFINITION && looks[k].definition == s->definition)
                first = looks[k].first;
        l->records[i] = (lanes_record){.how = s->how, .element = (int64_t)(first + s->place),
                                       .from = s->kind == SOURCE_TIME ? LANES_TIME : s->kind == SOURCE_X ? LANES_X : s->kind == SOURCE_V ? LANES_V : LANES_OUT};
    }
    const work plan = stepper_plan(d->problem, d->chosen, d->t0, d->h);
    l->moments = (size_t)plan.moments;
    work probe = plan;
    double *list[CARRY_MAX];
    l->carried = (size_t)work_carry(&probe, list) * m->nv;
    l->own_size = lines(l, d->place_count ? m->pool_count : 0);
    l->bound_size = lines(l, l->e.fixed_lanes);
    l->carry_size = lines(l, l->carried);
    l->kept_size = lines(l, d->source_count * REDUCE_KEPT);
    l->work_size = lines(l, work_place(&(work){.row = d->chosen->row, .stages = plan.stages, .velocity = plan.velocity}, NULL) * m->nv);
    l->look_size = lines(l, m->nx + m->nv + m->nv + l->outs);
    return true;
}

motus_status lanes_create(const lanes_def *d, lanes **out, char *note, size_t size, motus_error *err)
{
    model *m = d->model;
    looked looks[LOOKS_MAX];
    size_t outs;
    lanes *l = arena_take(m->arena, sizeof *l);
    if (m->arena->failed)
        return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    *l = (lanes){.def = *d, .width = best_width()};
    if (list_looks(d, looks, &outs) == SIZE_MAX) {
        snprintf(note, size, "more than %d quantities are recorded", LOOKS_MAX);
        return MOTUS_TOOL;
    }
    if (d->lanes && d->lanes < l->width)
        l->width = d->lanes;
    l->groups = d->lanes ? d->lanes / l->width : best_groups(d);
    l->block = l->width * l->groups;
    if (!write_text(l))
        return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    l->handle = cache_load(l->text, l->e.text.length, note, size);
    if (!l->handle)
        return MOTUS_TOOL;
    /* POSIX promises that a function's address survives the way through void *. */
    *(void **)&l->bind = dlsym(l->handle, "motus_lanes_bind");
    *(void **)&l->table = dlsym(l->handle, "motus_lanes_table");
    *(void **)&l->begin = dlsym(l->handle, "motus_lanes_begin");
    *(void **)&l->set = dlsym(l->handle, "motus_lanes_set");
    *(void **)&l->first = dlsym(l->handle, "motus_lanes_first");
    *(void **)&l->run = dlsym(l->handle, "motus_lanes_run");
    if (!l->bind || !l->table || !l->begin || !l->set || !l->first || !l->run) {
        snprintf(note, size, "the compiled object is not what was compiled");
        lanes_destroy(l);
        return MOTUS_TOOL;
    }
    if (!prepare(l)) {
        lanes_destroy(l);
        return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    }
    *out = l;
    return MOTUS_OK;
}

void lanes_destroy(lanes *l)
{
    if (l && l->handle)
        dlclose(l->handle);
    if (l)
        l->handle = NULL;
}

/* ---- a block ---- */

typedef struct batch {               /* blocks that go through time together */
    lanes *l;
    size_t first, count, blocks;     /* trajectories; lanes too many in the last block repeat the last one */
    const double *const *values;
    double *const *results, *stopped;
    double *memory, *threads, *table;        /* of blocks, of threads */
    size_t block_size, thread_size;
    work plan;                       /* of the present leg; n: steps taken */
    int64_t first_row, steps, every; /* the present chunk */
    int64_t looks;                   /* recorded so far */
    bool looking;                    /* on the way, not at the end alone */
    bool ends;                       /* the look to come is the last */
} batch;

/* Element k of lane i of a block, where a group has so many elements. */
static size_t at(const lanes *l, size_t elements, size_t k, size_t i)
{
    const size_t width = (size_t)l->width;
    return (i / width * elements + k) * width + i % width;
}

static size_t trajectory(const batch *b, size_t block, size_t lane)
{
    size_t k = block * (size_t)b->l->block + lane;
    return b->first + (k < b->count ? k : b->count - 1);
}

/* A block's memory: its own parameters, what follows from them, the state, what is kept, when a lane stopped. */
static double *stopped_of(const batch *b, size_t block) { return b->memory + (block + 1) * b->block_size - lines(b->l, 1); }

static lanes_job job_of(const batch *b, size_t block, int thread)
{
    const lanes *l = b->l;
    const model *m = l->def.model;
    const size_t n = (size_t)l->block;
    double *p = b->memory + block * b->block_size, *mine = b->threads + (size_t)thread * b->thread_size, *look = mine + l->work_size;
    lanes_job j = {.plan = &b->plan, .table = b->table, .first = b->first_row, .places = l->places, .value_count = (int64_t)l->def.place_count,
                   .from_x = l->from_x, .from_v = l->from_v, .x0 = m->x0, .v0 = m->v0, .records = l->records, .record_count = (int64_t)l->def.source_count, .out_size = l->outs,
                   .first_look = b->looks == 0, .ends = b->ends, .until = l->def.until};
    j.own_size = l->own_size ? m->pool_count : 0;
    j.bound_size = l->e.fixed_lanes;
    j.host = (compiled_host){.pool = m->pool, .u = l->u, .q = l->q, .own = p, .bound = p + l->own_size};
    j.carry = p + l->own_size + l->bound_size;
    j.kept = j.carry + l->carry_size;
    j.room = mine;
    j.x = look;
    j.v = look + m->nx * n;
    j.a = l->wants_a ? look + (m->nx + m->nv) * n : NULL;
    j.out = look + (m->nx + 2 * m->nv) * n;
    return j;
}

static double *spare_of(const batch *b, int thread) { return b->threads + (size_t)thread * b->thread_size + b->l->work_size + b->l->look_size; }

static void begin_block(void *ctx, size_t block, int thread)
{
    const batch *b = ctx;
    const lanes *l = b->l;
    const model *m = l->def.model;
    lanes_job j = job_of(b, block, thread);
    double *values = spare_of(b, thread), *stopped = stopped_of(b, block);
    const size_t width = (size_t)l->width, count = l->def.place_count;
    for (size_t g = 0; g < (size_t)l->groups; g++) {
        for (size_t k = 0; k < count; k++)
            for (size_t i = 0; i < width; i++)
                values[(g * count + k) * width + i] = b->values[k][trajectory(b, block, g * width + i)];
        for (size_t k = 0; l->own_size && k < m->pool_count; k++)
            for (size_t i = 0; i < width; i++)
                j.host.own[(g * m->pool_count + k) * width + i] = m->pool[k];
    }
    for (size_t i = 0; i < (size_t)l->block; i++)
        stopped[i] = NAN;
    j.values = values;
    l->begin(&j);
    l->set(&j);
}

static bool all_finite(const double *numbers, size_t count)
{
    int bad = 0;
    for (size_t k = 0; k < count; k++)
        bad |= !(numbers[k] - numbers[k] == 0);
    return !bad;
}

static bool lane_finite(const lanes *l, const double *numbers, size_t elements, size_t lane)
{
    double none = 0;
    for (size_t k = 0; k < elements; k++)
        none += numbers[at(l, elements, k, lane)] - numbers[at(l, elements, k, lane)];
    return none == 0;
}

/* Lanes of an array of `elements` that are not finite stop at t, if they have not stopped before. */
static void stop_lanes(const lanes *l, const double *numbers, size_t elements, double t, double *stopped)
{
    if (all_finite(numbers, elements * (size_t)l->block))
        return;
    for (size_t i = 0; i < (size_t)l->block; i++)
        if (isnan(stopped[i]) && !lane_finite(l, numbers, elements, i))
            stopped[i] = t;
}

/* The state as one sees it may be infinite a step before the main line is. */
static void stop_looked(const lanes *l, const lanes_job *j, double *stopped)
{
    stop_lanes(l, j->x, l->def.model->nx, time_of(j->plan, j->plan->n), stopped);
    stop_lanes(l, j->v, l->def.model->nv, time_of(j->plan, j->plan->n), stopped);
}

/* The chunk once more, step by step: when did which lane stop being finite? */
static void trace(const batch *b, lanes_job j, double *before, double *stopped)
{
    const lanes *l = b->l;
    work plan = b->plan;
    j.plan = &plan;
    j.carry = before;
    j.record_count = 0;
    stop_lanes(l, before, l->carried, time_of(&plan, plan.n), stopped);
    for (int64_t n = 0; n < b->steps; n++) {
        if (b->looking && plan.n % l->def.every == 0) {
            l->run(&j, 0, 1);
            stop_looked(l, &j, stopped);
        }
        if (plan.n == 0)
            l->first(&j);
        else
            l->run(&j, 1, 0);
        plan.n++;
        stop_lanes(l, before, l->carried, time_of(&plan, plan.n), stopped);
    }
}

/* Whether a lane is no longer finite that has not stopped before: those that have are so for good, and cost their neighbours no time. */
static bool lost_another(const lanes *l, const double *numbers, size_t elements, const double *stopped)
{
    if (all_finite(numbers, elements * (size_t)l->block))
        return false;
    bool any = false;
    for (size_t i = 0; i < (size_t)l->block; i++)
        any |= isnan(stopped[i]) && !lane_finite(l, numbers, elements, i);
    return any;
}

static void run_block(void *ctx, size_t block, int thread)
{
    const batch *b = ctx;
    const lanes *l = b->l;
    lanes_job j = job_of(b, block, thread);
    double *before = spare_of(b, thread), *stopped = stopped_of(b, block);
    memcpy(before, j.carry, l->carry_size * sizeof(double));
    if (b->plan.n == 0)
        l->first(&j);
    else
        l->run(&j, b->steps, b->every);
    if (lost_another(l, j.carry, l->carried, stopped))
        trace(b, j, before, stopped);
}

static void look_at_block(void *ctx, size_t block, int thread)
{
    const batch *b = ctx;
    lanes_job j = job_of(b, block, thread);
    b->l->run(&j, 0, 1);
    stop_looked(b->l, &j, stopped_of(b, block));
}

/* The shorter last step is a leg of its own, from the state at the end of the whole ones. */
static void turn_block(void *ctx, size_t block, int thread)
{
    const batch *b = ctx;
    lanes_job j = job_of(b, block, thread);
    j.record_count = 0;
    b->l->run(&j, 0, 1);
    b->l->set(&j);
}

static void end_block(const batch *b, size_t block)
{
    const lanes *l = b->l;
    const lanes_job j = job_of(b, block, 0);
    const double *stopped = stopped_of(b, block);
    for (size_t i = 0; i < (size_t)l->block && block * (size_t)l->block + i < b->count; i++) {
        const size_t k = trajectory(b, block, i), all = l->def.source_count * REDUCE_KEPT;
        for (size_t r = 0; r < l->def.source_count; r++) {
            const double kept[REDUCE_KEPT] = {j.kept[at(l, all, r * REDUCE_KEPT, i)], j.kept[at(l, all, r * REDUCE_KEPT + 1, i)]};
            b->results[r][k] = isnan(stopped[i]) ? reduce_last(kept, l->records[r].how, (double)b->looks) : NAN;
        }
        if (b->stopped)
            b->stopped[k] = stopped[i];
    }
}

/* ---- all of them ---- */

/* What depends on time alone, from the present step on. */
static void fill_table(batch *b, int64_t steps)
{
    const lanes_job j = job_of(b, 0, 0);
    b->first_row = b->plan.n;
    b->l->table(&j, b->table, steps + 1);
}

static void each_block(batch *b, void (*body)(void *, size_t, int)) { parallel_for(b->l->def.threads, b->blocks, body, b); }

/* The next chunk: steps to take, and how often to look on the way. The first step is a chunk of its own; the look at the end is not among them. */
static void next_chunk(batch *b)
{
    const lanes_def *d = &b->l->def;
    const int64_t left = d->whole - b->plan.n, every = d->every, due = every - b->plan.n % every;
    b->steps = b->plan.n == 0 ? 1 : left < CHUNK ? left : CHUNK;
    b->every = 0;
    if (!b->looking || due > b->steps || b->plan.n == 0)
        return;
    const bool end = d->last == 0 && due == left;
    if (due < every || end) {
        b->steps = due;
        b->every = end ? 0 : due;
        return;
    }
    b->steps -= b->steps % every;
    if (d->last == 0 && b->steps == left)
        b->steps -= every;
    b->every = every;
}

static motus_status through_time(batch *b, double from, double share, motus_error *err)
{
    lanes *l = b->l;
    const lanes_def *d = &l->def;
    b->looking = false;
    for (size_t r = 0; r < d->source_count; r++)
        b->looking |= d->sources[r].how != REDUCE_FINAL;
    b->plan = stepper_plan(d->problem, d->chosen, d->t0, d->h);
    b->plan.stride = b->plan.nv;
    b->looks = 0;
    b->ends = false;
    each_block(b, begin_block);
    if (b->looking && (d->whole > 0 || d->last != 0)) {
        fill_table(b, 0);
        each_block(b, look_at_block);
        b->looks++;
    }
    while (b->plan.n < d->whole) {
        next_chunk(b);
        fill_table(b, b->steps);
        each_block(b, run_block);
        b->plan.n += b->steps;
        b->looks += b->every ? b->steps / b->every : 0;
        if (b->plan.n == 1 && b->looking && d->every == 1 && (d->whole > 1 || d->last != 0)) {
            fill_table(b, 0);
            each_block(b, look_at_block);
            b->looks++;
        }
        if (d->progress && d->progress(d->context, from + share * (double)b->plan.n / (double)(d->whole + 1)))
            return fail(err, MOTUS_CANCELLED, "cancelled");
    }
    if (d->last != 0) {
        fill_table(b, 0);
        each_block(b, turn_block);
        b->plan = stepper_plan(d->problem, d->chosen, time_of(&b->plan, b->plan.n), d->last);
        b->plan.stride = b->plan.nv;
        b->steps = 1;
        b->every = 0;
        fill_table(b, 1);
        each_block(b, run_block);
        b->plan.n = 1;
    }
    b->ends = true;
    fill_table(b, 0);
    each_block(b, look_at_block);
    b->looks++;
    for (size_t k = 0; k < b->blocks; k++)
        end_block(b, k);
    return MOTUS_OK;
}

motus_status lanes_run(lanes *l, size_t count, const double *const *values, double *const *results, double *stopped, motus_error *err)
{
    const lanes_def *d = &l->def;
    const size_t spare = l->carry_size > lines(l, d->place_count) ? l->carry_size : lines(l, d->place_count);
    batch b = {.l = l, .values = values, .results = results, .stopped = stopped};
    b.block_size = l->own_size + l->bound_size + l->carry_size + l->kept_size + lines(l, 1);
    b.thread_size = l->work_size + l->look_size + spare;
    const size_t block = (size_t)l->block, all = (count + block - 1) / block;
    size_t most = BATCH_BYTES / sizeof(double) / b.block_size;
    most = most < (size_t)d->threads * 4 ? (size_t)d->threads * 4 : most;
    most = most > all ? all : most;
    const size_t table = l->moments * l->e.terms * (CHUNK + 1 + 8 + 8);
    double *memory = take(d->allocator, most * b.block_size + (size_t)d->threads * b.thread_size + table + ALIGNMENT / sizeof(double), sizeof(double));
    if (!memory)
        return fail(err, MOTUS_MEMORY, "no memory for %zu trajectories", most * block);
    b.memory = memory + (ALIGNMENT - (uintptr_t)memory % ALIGNMENT) % ALIGNMENT / sizeof(double);
    b.threads = b.memory + most * b.block_size;
    b.table = b.threads + (size_t)d->threads * b.thread_size;
    motus_status status = MOTUS_OK;
    for (size_t first = 0; first < all && status == MOTUS_OK; first += most) {
        b.first = first * block;
        b.blocks = all - first < most ? all - first : most;
        b.count = count - b.first < b.blocks * block ? count - b.first : b.blocks * block;
        status = through_time(&b, (double)b.first / (double)count, (double)b.count / (double)count, err);
    }
    give(d->allocator, memory);
    return status;
}
