/* The compiled machine: the model's acceleration, the row and the texts of step/ as one C text, compiled by the
 * system's compiler and loaded.
 *
 * Invariant: the object replaces only the loop that advances and the acceleration, so memory, errors, restart and
 * observation are the library's, and the bits are the interpreter's. Each row has an object of its own, which serves
 * every N and every parameter but those that make an operation exact.
 */
#include "machine/compiled.h"

#include "core/stepper_body.h"
#include "lang/graph/expansion.h"
#include "machine/cache.h"
#include "machine/compose.h"
#include "machine/parallel.h"
#include "machine/tiles.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

enum { OBJECTS_MAX = 64, NOTE_MAX = 400 };

#include "machine/text/host.h"

typedef struct object {
    const row *row;
    double argument[2];
    int expands; /* the order of its Taylor series follows from a tolerance */
    bool varies;
    int (*fits)(const double *u); /* whether it was compiled for such numbers */
    void *handle;
    stepper_body body;
} object;

struct compiled {
    compiled_host host; /* what the objects read */
    model *model;
    const problem *interpreted; /* the interpreter's problem */
    problem problem;            /* the same with the compiled acceleration */
    object objects[OBJECTS_MAX];
    int count;
    program *force, *boundary, *series, *boundary_series;
    locality locality;
    const tiling *tiling; /* where the outer indices can be divided; else NULL */
    double *u, *pairs;
    int64_t *q;
    /* of the last object; all give the same bits */
    void (*accel)(const compiled_host *, double t, double *x, double *v, double *a);
    int (*fits)(const double *u);
    /* of the last object; all compute the same */
    void (*bind)(const double *, const int64_t *, double *);
    char note[NOTE_MAX];
};

/* ---- the problem, for evaluations outside the steps ---- */

static const problem *of(void *ctx) { return ((compiled *)ctx)->interpreted; }

static int accel(void *ctx, double t, double *x, double *v, double *a)
{
    const compiled *c = ctx;
    if (!c->accel || !c->fits(c->u)) return of(ctx)->accel(of(ctx)->ctx, t, x, v, a);
    c->accel(&c->host, t, x, v, a);
    return 0;
}
static int jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    return of(ctx)->jvp(of(ctx)->ctx, t, x, v, dx, dv, da);
}
static bool prepare(void *ctx, bool in_v) { return of(ctx)->prepare(of(ctx)->ctx, in_v); }
static void pattern(void *ctx, bool in_v, void (*emit)(void *, size_t, size_t), void *arg)
{
    of(ctx)->pattern(of(ctx)->ctx, in_v, emit, arg);
}
static size_t series_numbers(void *ctx, int length) { return of(ctx)->series_numbers(of(ctx)->ctx, length); }
static void series(void *ctx, int length, int n, double t, double *x, double *v, double *a, double *kept)
{
    of(ctx)->series(of(ctx)->ctx, length, n, t, x, v, a, kept);
}
static void refresh(void *ctx, double t, double *x, double *v) { of(ctx)->refresh(of(ctx)->ctx, t, x, v); }
static int exact(void *ctx, double t, double *x, double *v) { return of(ctx)->exact(of(ctx)->ctx, t, x, v); }
static bool exact_rounding(void *ctx, double t, double *x, double *v)
{
    return of(ctx)->exact_rounding(of(ctx)->ctx, t, x, v);
}
static void name(void *ctx, bool in_v, size_t k, char *out, size_t size)
{
    of(ctx)->name(of(ctx)->ctx, in_v, k, out, size);
}

motus_status compiled_create(model *m, const problem *interpreted, compiled **out, motus_error *err)
{
    compiled *c = arena_room(m->arena, sizeof *c);
    if (!c) return fail(err, MOTUS_MEMORY, "no memory for the model");
    memset(c, 0, sizeof *c);
    c->model = m;
    c->interpreted = interpreted;
    c->problem = (problem){.ctx = c,
                           .nx = m->nx,
                           .nv = m->nv,
                           .variables = interpreted->variables,
                           .variable_count = interpreted->variable_count,
                           .accel = accel,
                           .jvp = interpreted->jvp ? jvp : NULL,
                           .prepare = interpreted->prepare ? prepare : NULL,
                           .pattern = interpreted->pattern ? pattern : NULL,
                           .series_numbers = interpreted->series_numbers ? series_numbers : NULL,
                           .series = interpreted->series ? series : NULL,
                           .refresh = interpreted->refresh ? refresh : NULL,
                           .exact = interpreted->exact ? exact : NULL,
                           .exact_rounding = interpreted->exact_rounding ? exact_rounding : NULL,
                           .name = name};
    *out = c;
    return MOTUS_OK;
}

void compiled_close(compiled *c)
{
    for (int i = 0; c && i < c->count; i++) dlclose(c->objects[i].handle);
    if (c) {
        parallel_pool_destroy(c->host.thread_pool);
        c->host.thread_pool = NULL;
        c->count = 0;
        c->accel = NULL;
        c->bind = NULL;
    }
}

/* ---- the text ---- */

static bool write_text(compiled *c, const chosen *chosen, emit *e)
{
    model *m = c->model;
    if (!c->force) {
        c->force = program_create(m->graph, m->accel, m->accel_count);
        if (c->force) c->locality = emit_local(c->force);
        if (c->locality.divisible) c->tiling = tiles_create(m, &c->locality);
    }
    if (!c->boundary && m->driven) c->boundary = program_create(m->graph, m->boundary, m->boundary_count);
    const bool expands = stepper_plan(c->interpreted, chosen, NULL).expands > 0;
    if (expands && !c->series) c->series = expansion_program(m->arena, m->graph, m->accel, m->accel_count);
    if (expands && m->driven && !c->boundary_series)
        c->boundary_series = expansion_program(m->arena, m->graph, m->boundary, m->boundary_count);
    if (m->arena->failed) return false;
    composed_program programs[4] = {{c->force, "compiled_force", !row_adaptive(chosen), false}};
    size_t count = 1;
    if (m->driven) programs[count++] = (composed_program){c->boundary, "compiled_boundary", false, false};
    if (expands) programs[count++] = (composed_program){c->series, "compiled_series", false, true};
    if (expands && m->driven)
        programs[count++] = (composed_program){c->boundary_series, "compiled_boundary_series", false, true};
    static const char *const last[] = {"machine/text/compiled_run.h", NULL};
    return compose(e, &(composition){.model = m,
                                     .problem = c->interpreted,
                                     .chosen = chosen,
                                     .programs = programs,
                                     .program_count = count,
                                     .locality = &c->locality,
                                     .last = last});
}

const char *compiled_text(compiled *c, const chosen *chosen, size_t *length)
{
    emit e = {.text = {.arena = c->model->arena}, .pool = chosen->varies ? NULL : c->model->pool};
    if (!write_text(c, chosen, &e)) return NULL;
    *length = e.text.length;
    return e.text.bytes;
}

/* ---- objects ---- */

enum { PAIR_CELLS_MAX = 1 << 16, LINE = 64 }; /* LINE: bytes of a line of the cache */

/* Room for the partial sums of all cells of a family whose pairs are taken once; NULL: they are taken twice. */
static double *pair_room(compiled *c, const emit *e)
{
    const model *m = c->model;
    if (!e->pair_sums) return NULL;
    const range *r = &e->pair_range;
    const int64_t first = r->first.literal + (r->first.slot >= 0 ? m->ints[r->first.slot] : 0),
                  last = r->last.literal + (r->last.slot >= 0 ? m->ints[r->last.slot] : 0), cells = last - first + 1;
    if (cells < 2 || cells > PAIR_CELLS_MAX) return NULL;
    if (!c->pairs) {
        char *room = arena_room(m->arena, 8 * e->pair_sums * ((size_t)cells + 7) * sizeof *c->pairs + LINE);
        c->pairs = room ? (double *)(void *)(room + (LINE - (uintptr_t)room % LINE) % LINE) : NULL;
    }
    return c->pairs;
}

/* The numbers that the text reads: bounds, strides, and values of parameters alone. They are the same for every row. */
static bool bind_numbers(compiled *c, const emit *e, void (*bind)(const double *, const int64_t *, double *))
{
    model *m = c->model;
    c->q = arena_room(m->arena, (e->int_count + 1) * sizeof *c->q);
    c->u = arena_room(m->arena, (e->fixed + 1) * sizeof *c->u);
    if (!c->q || !c->u) return false;
    for (uint32_t k = 0; k < e->int_count; k++) c->q[k] = emit_int_value(&e->ints[k], m->arrays, m->ints);
    double *pairs = pair_room(c, e);
    c->bind = bind;
    bind(m->pool, c->q, c->u);
    c->host = (compiled_host){.pool = m->pool,
                              .u = c->u,
                              .q = c->q,
                              .own = pairs,
                              .tiling = c->tiling,
                              .thread_pool = c->host.thread_pool,
                              .parallel = parallel_pool_for};
    return true;
}

static const stepper_body *body_of(compiled *c, const chosen *chosen, int how)
{
    const int expands = stepper_plan(c->interpreted, chosen, NULL).expands;
    for (int i = 0; i < c->count; i++)
        if (c->objects[i].row == chosen->row && c->objects[i].argument[0] == chosen->argument[0] &&
            c->objects[i].argument[1] == chosen->argument[1] && c->objects[i].expands == expands &&
            c->objects[i].varies == chosen->varies && c->objects[i].fits(c->u))
            return &c->objects[i].body;
    snprintf(c->note, sizeof c->note, "out of memory");
    if (c->count == OBJECTS_MAX) {
        snprintf(c->note, sizeof c->note, "%d methods of this model are compiled already", OBJECTS_MAX);
        return NULL;
    }
    if (c->model->graph->count > OPERATIONS_MAX) {
        snprintf(c->note, sizeof c->note,
                 "its equations are too long for a compiler: %u operations, and %d are the most",
                 c->model->graph->count, OPERATIONS_MAX);
        return NULL;
    }
    emit e = {.text = {.arena = c->model->arena}, .pool = chosen->varies ? NULL : c->model->pool};
    if (!write_text(c, chosen, &e)) return NULL;
    /* the loops of Taylor series are short, and their sums run in order */
    if (!compose_small(c->model) && !chosen->row->expands) how |= COMPILER_LOOPS;
    void *handle = cache_load(e.text.bytes, e.text.length, how, c->note, sizeof c->note);
    if (!handle) return NULL;
    void (*bind)(const double *, const int64_t *, double *);
    void (*accel)(const compiled_host *, double t, double *x, double *v, double *a);
    object *o = &c->objects[c->count];
    *o = (object){.row = chosen->row,
                  .argument = {chosen->argument[0], chosen->argument[1]},
                  .expands = expands,
                  .varies = chosen->varies,
                  .handle = handle,
                  .body = *stepper_best_body()};
    const stepper_body *library = stepper_best_body();
    o->body.name = "compiled";
    /* POSIX lets a void * hold the address of a function. */
    *(void **)&bind = dlsym(handle, "motus_bind");
    *(void **)&o->body.run = dlsym(handle, "motus_run");
    *(void **)&o->fits = dlsym(handle, "motus_fits");
    *(void **)&accel = dlsym(handle, "motus_accel");
    if (!bind || !o->body.run || !o->fits || !accel || !bind_numbers(c, &e, bind)) {
        snprintf(c->note, sizeof c->note, "the compiled object is not what was compiled");
        dlclose(handle);
        return NULL;
    }
    c->accel = accel;
    c->fits = o->fits;
    c->host.run = library->run;
    c->host.factor = library->factor;
    c->host.back = library->back;
    c->host.apply = library->apply;
    c->host.diagonal = library->diagonal;
    c->count++;
    return &o->body;
}

void compiled_rebind(compiled *c)
{
    if (c && c->bind) c->bind(c->model->pool, c->q, c->u);
}

const char *compiled_prepare(compiled *c, const chosen *chosen, bool kept)
{
    return body_of(c, chosen, kept ? CACHE_KEPT : 0) ? NULL : c->note;
}

motus_status compiled_machine(compiled *c, const chosen *chosen, machine *out, motus_error *err)
{
    const stepper_body *body = body_of(c, chosen, 0);
    if (!body) return fail(err, MOTUS_TOOL, "the model could not be compiled: %s", c->note);
    /* One pool of threads serves all runs of the model. Threads beyond the processors gain nothing. */
    const int processors = parallel_processors();
    if (chosen->threads > 1 && c->tiling && !c->host.thread_pool)
        c->host.thread_pool = parallel_pool_create(chosen->threads > processors ? chosen->threads : processors,
                                                   &c->model->arena->allocator);
    c->problem.traits = c->interpreted->traits;
    *out = (machine){.name = "compiled", .problem = &c->problem, .body = body, .host = &c->host};
    return MOTUS_OK;
}
