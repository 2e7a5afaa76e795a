/* The compiled machine: the model's acceleration, the row and the texts of step/ as one C text, compiled by the
 * system's compiler and loaded.
 *
 * Invariant: the object replaces only the loop that advances and the acceleration, so memory, errors, restart and
 * observation are the library's, and the bits are the interpreter's. Each row has an object of its own. It serves every
 * N, and all values of the parameters, except where a value makes an operation exact (emit_exact.c): such values stand
 * in the text.
 */
#include <time.h> /* before the texts define `clock` */
#include "machine/compiled.h"

#include "core/stepper_body.h"
#include "lang/graph/expansion.h"
#include "machine/cache.h"
#include "machine/compose.h"
#include "machine/least.h"
#include "machine/parallel.h"
#include "machine/tiles.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

enum { OBJECTS_MAX = 96, MAKINGS_MAX = 8, NOTE_MAX = 400, FEW_FUNCTIONS = 8 };

#include "machine/text/host.h"

/* What the text of an object depends on besides the model. */
typedef struct purpose {
    const row *row;
    double argument[2];
    int expands;          /* the order of its Taylor series follows from a tolerance */
    bool varies, written; /* written: it is the longer text */
} purpose;

/* A compiled text that is loaded. It has its own numbers, since their count and order depend on its programs. */
typedef struct object {
    purpose purpose;
    compiled_host host; /* the data that the text reads */
    double *u;
    int64_t *q;
    void (*bind)(const double *, const int64_t *, double *); /* computes u from the pool */
    int (*fits)(const double *u);                            /* tells whether it was compiled for such numbers */
    void (*accel)(const compiled_host *, double t, double *x, double *v, double *a); /* NULL: Taylor series alone */
    /* what compiled_rules computes; NULL: the text does not have it */
    void (*rules)(const compiled_host *, int number, double t, double *x, double *v, double *a, const double *dx,
                  const double *dv, double *out);
    void *handle;
    bool longer; /* there is a longer text */
    stepper_body body;
} object;

/* An object that a compiler is at work on, while somebody waits for it. */
typedef struct making {
    purpose purpose;
    emit e;
    cache_job *job;
    size_t waiting; /* how many wait for it; 0: the place is free */
} making;

struct compiled {
    model *model;
    const problem *interpreted; /* the interpreter's problem */
    problem problem;            /* that problem with the compiled acceleration */
    object objects[OBJECTS_MAX];
    int count;
    making makings[MAKINGS_MAX];
    const object *ruled; /* has the model's rules, for its present numbers; NULL: none */
    program *force, *boundary, *series, *boundary_series, *of_rules[RULED_NUMBERS];
    locality locality;
    const tiling *tiling; /* where the outer indices can be divided; else NULL */
    double *pairs;
    struct parallel_pool *thread_pool;
    char note[NOTE_MAX];
};

/* ---- the problem, for evaluations outside the steps ---- */

static const problem *of(void *ctx) { return ((compiled *)ctx)->interpreted; }

static int accel(void *ctx, double t, double *x, double *v, double *a)
{
    const compiled *c = ctx;
    const object *o = c->count ? &c->objects[c->count - 1] : NULL; /* all give the same bits */
    if (!o || !o->accel || !o->fits(o->u)) return of(ctx)->accel(of(ctx)->ctx, t, x, v, a);
    o->accel(&o->host, t, x, v, a);
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

bool compiled_anywhere(void) { return true; }

motus_status compiled_create(model *m, const problem *interpreted, compiled **out, motus_error *err)
{
    compiled *c = arena_room(m->arena, sizeof *c);
    if (!c) return fail(err, MOTUS_MEMORY, "no memory for the model");
    c->model = m;
    c->interpreted = interpreted;
    c->problem = *interpreted;
    c->problem.ctx = c;
    c->problem.accel = accel;
    if (interpreted->jvp) c->problem.jvp = jvp;
    if (interpreted->prepare) c->problem.prepare = prepare;
    if (interpreted->pattern) c->problem.pattern = pattern;
    if (interpreted->series_numbers) c->problem.series_numbers = series_numbers;
    if (interpreted->series) c->problem.series = series;
    if (interpreted->refresh) c->problem.refresh = refresh;
    if (interpreted->exact) c->problem.exact = exact;
    if (interpreted->exact_rounding) c->problem.exact_rounding = exact_rounding;
    c->problem.name = name;
    *out = c;
    return MOTUS_OK;
}

void compiled_close(compiled *c)
{
    for (int i = 0; c && i < c->count; i++) dlclose(c->objects[i].handle);
    for (int i = 0; c && i < MAKINGS_MAX; i++) {
        cache_stop(c->makings[i].job);
        c->makings[i] = (making){.waiting = 0};
    }
    if (c) {
        parallel_pool_destroy(c->thread_pool);
        c->thread_pool = NULL;
        c->ruled = NULL;
        c->count = 0;
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
    const bool bounded = compose_watched(m, chosen) && least_bounded(m),
               longer = row_adaptive(chosen) && compose_small(m);
    const bool bounds = bounded && (chosen->written || !longer); /* the interpreter's do for a first text */
    e->longer = bounded && longer;
    /* where functions are few they are compiled with all that events ask of them */
    const bool rules =
        bounds && m->rule_functions <= FEW_FUNCTIONS && compose_small(m) && compose_bounds_are_structure(m);
    if (bounds && !c->of_rules[RULED_LEAST]) {
        output *of[RULED_NUMBERS];
        size_t functions;
        for (int k = 0; ruled_outputs(m, of, &functions) && k < RULED_NUMBERS; k++)
            if (rules || k == RULED_LEAST) c->of_rules[k] = program_create(m->graph, of[k], functions);
    }
    if (m->arena->failed) return false;
    composed_program programs[4 + RULED_NUMBERS];
    size_t count = 0;
    if (!expands)
        programs[count++] =
            (composed_program){.program = c->force, .name = "compiled_force", .terms = !row_adaptive(chosen)};
    if (m->driven) programs[count++] = (composed_program){.program = c->boundary, .name = "compiled_boundary"};
    if (expands)
        programs[count++] = (composed_program){.program = c->series, .name = "compiled_series", .series = true};
    if (expands && m->driven)
        programs[count++] =
            (composed_program){.program = c->boundary_series, .name = "compiled_boundary_series", .series = true};
    static const char *const names[RULED_NUMBERS] = {"compiled_values", "compiled_rates", "compiled_rounding",
                                                     "compiled_least", "compiled_least_rates"};
    for (int k = 0; k < RULED_NUMBERS; k++)
        if (rules || (bounds && k == RULED_LEAST))
            programs[count++] =
                (composed_program){.program = c->of_rules[k], .name = names[k], .along = k >= RULED_LEAST};
    static const char *const last[] = {"machine/text/compiled_run.h", NULL};
    return compose(e, &(composition){.model = m,
                                     .problem = c->interpreted,
                                     .chosen = chosen,
                                     .programs = programs,
                                     .program_count = count,
                                     .locality = &c->locality,
                                     .bounds = bounds,
                                     .rules = rules,
                                     .written = chosen->written,
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

/* Takes room for the partial sums of all cells, with which each pair of cells is computed once. NULL: pairs are
 * computed twice. */
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

/* Binds the numbers that the text reads: bounds, strides, and values of parameters alone. */
static bool bind_numbers(compiled *c, object *o, const emit *e)
{
    model *m = c->model;
    const stepper_body *library = stepper_best_body();
    o->q = arena_room(m->arena, (e->int_count + 1) * sizeof *o->q);
    o->u = arena_room(m->arena, (e->fixed + 1) * sizeof *o->u);
    if (!o->q || !o->u) return false;
    for (uint32_t k = 0; k < e->int_count; k++) o->q[k] = emit_int_value(&e->ints[k], m->arrays, m->ints);
    o->bind(m->pool, o->q, o->u);
    o->host = (compiled_host){.pool = m->pool,
                              .u = o->u,
                              .q = o->q,
                              .own = pair_room(c, e),
                              .tiling = c->tiling,
                              .thread_pool = c->thread_pool,
                              .parallel = parallel_pool_for,
                              .run = library->run,
                              .factor = library->factor,
                              .back = library->back,
                              .apply = library->apply,
                              .diagonal = library->diagonal,
                              .accel = library->accel};
    return true;
}

static purpose purpose_of(const compiled *c, const chosen *chosen)
{
    return (purpose){.row = chosen->row,
                     .argument = {chosen->argument[0], chosen->argument[1]},
                     .expands = stepper_plan(c->interpreted, chosen, NULL).expands,
                     .varies = chosen->varies,
                     .written = chosen->written};
}

static bool same(const purpose *a, const purpose *b)
{
    return a->row == b->row && a->argument[0] == b->argument[0] && a->argument[1] == b->argument[1] &&
           a->expands == b->expands && a->varies == b->varies && a->written == b->written;
}

static object *find_text(compiled *c, const purpose *p)
{
    for (object *o = c->objects; o < c->objects + c->count; o++)
        if (same(&o->purpose, p) && o->fits(o->u)) return o;
    return NULL;
}

/* Finds a loaded object, that of the longer text first. */
static object *find(compiled *c, const purpose *p)
{
    purpose longer = *p;
    longer.written = true;
    object *o = find_text(c, &longer);
    return o || p->written ? o : find_text(c, p);
}

/* Writes the text; NULL: it failed, and c->note says why. */
static const char *text_of(compiled *c, const chosen *chosen, emit *e)
{
    *e = (emit){.text = {.arena = c->model->arena}, .pool = chosen->varies ? NULL : c->model->pool};
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
    return write_text(c, chosen, e) ? e->text.bytes : NULL;
}

/* Returns COMPILER_LOOPS where loops gain from vectors. Those of Taylor series are short, and their sums keep their
 * order. */
static int loops_of(const compiled *c, const purpose *p)
{
    return !compose_small(c->model) && !p->row->expands ? COMPILER_LOOPS : 0;
}

/* Finds an object that has the model's rules for its present numbers. */
static void find_rules(compiled *c)
{
    c->ruled = NULL;
    for (const object *o = c->objects; o < c->objects + c->count; o++)
        if (o->rules && o->fits(o->u)) c->ruled = o;
}

bool compiled_rules(void *ctx, ruled_number number, double t, double *const base[SPACES])
{
    const compiled *c = ctx;
    const object *o = c->ruled;
    if (!o) return false;
    o->rules(&o->host, number, t, base[SPACE_X], base[SPACE_V], base[SPACE_A], base[SPACE_DX], base[SPACE_DV],
             base[SPACE_OUT]);
    return true;
}

/* Takes an object that was loaded; NULL: it is not sound, and c->note says why. */
static object *adopt(compiled *c, const purpose *p, const emit *e, void *handle)
{
    object *o = &c->objects[c->count];
    if (c->count < OBJECTS_MAX) {
        *o = (object){.purpose = *p, .handle = handle, .longer = e->longer, .body = *stepper_best_body()};
        o->body.name = "compiled";
        /* POSIX lets a void * hold the address of a function. */
        *(void **)&o->bind = dlsym(handle, "motus_bind");
        *(void **)&o->body.run = dlsym(handle, "motus_run");
        *(void **)&o->fits = dlsym(handle, "motus_fits");
        *(void **)&o->accel = dlsym(handle, "motus_accel");
        *(void **)&o->rules = dlsym(handle, "motus_rules");
    }
    if (c->count == OBJECTS_MAX || !o->bind || !o->body.run || !o->fits || (!o->accel && !p->expands) ||
        !bind_numbers(c, o, e)) {
        snprintf(c->note, sizeof c->note, "the compiled object is not what was compiled");
        dlclose(handle);
        return NULL;
    }
    c->count++;
    find_rules(c);
    return o;
}

/* Writes the text to compile: the longer one, if it is asked for. If another asks and the cache has the longer one, its
 * object is loaded instead. NULL: it is loaded, or c->note says what failed. */
static const char *wanted_text(compiled *c, const chosen *asked, emit *e, object **loaded)
{
    chosen longer = *asked;
    longer.written = true;
    const char *text = text_of(c, &longer, e);
    *loaded = NULL;
    if (!text || !e->longer) return text; /* then there is one text */
    if (asked->written) return text;
    const purpose p = purpose_of(c, &longer);
    void *handle = cache_load(text, e->text.length, CACHE_KEPT | loops_of(c, &p), c->note, sizeof c->note);
    *loaded = handle ? adopt(c, &p, e, handle) : NULL;
    if (*loaded) return NULL;
    text = text_of(c, asked, e);
    e->longer = true;
    return text;
}

static object *object_of(compiled *c, const chosen *chosen, int how)
{
    const purpose p = purpose_of(c, chosen);
    object *o = find(c, &p);
    emit e;
    if (o || !wanted_text(c, chosen, &e, &o)) return o;
    void *handle = cache_load(e.text.bytes, e.text.length, how | loops_of(c, &p), c->note, sizeof c->note);
    return handle ? adopt(c, &p, &e, handle) : NULL;
}

bool compiled_longer(compiled *c, const chosen *chosen)
{
    const purpose p = purpose_of(c, chosen);
    const object *o = find(c, &p);
    return o && o->longer && !o->purpose.written;
}

/* ---- objects in the making ---- */

static making *making_of(compiled *c, const purpose *p)
{
    for (int i = 0; i < MAKINGS_MAX; i++)
        if (c->makings[i].waiting && same(&c->makings[i].purpose, p)) return &c->makings[i];
    return NULL;
}

static compiled_state answer(compiled *c, const purpose *p, const emit *e, void *handle)
{
    return handle && adopt(c, p, e, handle) ? COMPILED_READY : COMPILED_FAILED;
}

compiled_state compiled_begin(compiled *c, const chosen *chosen, const char **why)
{
    const purpose p = purpose_of(c, chosen);
    making *m = making_of(c, &p);
    *why = c->note;
    if (find(c, &p)) return COMPILED_READY;
    if (m) {
        m->waiting++;
        return COMPILED_WAIT;
    }
    for (m = c->makings; m < c->makings + MAKINGS_MAX && m->waiting; m++) continue;
    if (m == c->makings + MAKINGS_MAX) {
        snprintf(c->note, sizeof c->note, "%d methods of this model are being compiled", MAKINGS_MAX);
        return COMPILED_FAILED;
    }
    void *handle;
    object *loaded;
    if (!wanted_text(c, chosen, &m->e, &loaded)) return loaded ? COMPILED_READY : COMPILED_FAILED;
    const cache_state state = cache_begin(m->e.text.bytes, m->e.text.length, loops_of(c, &p),
                                          &c->model->arena->allocator, &m->job, &handle, c->note, sizeof c->note);
    if (state != CACHE_WAIT) return answer(c, &p, &m->e, handle);
    m->purpose = p;
    m->waiting = 1;
    return COMPILED_WAIT;
}

compiled_state compiled_look(compiled *c, const chosen *chosen, const char **why)
{
    const purpose p = purpose_of(c, chosen);
    making *m = making_of(c, &p);
    void *handle = NULL;
    *why = c->note;
    if (m && m->job) {
        if (cache_look(&m->job, &handle, c->note, sizeof c->note) == CACHE_WAIT) return COMPILED_WAIT;
        const compiled_state state = answer(c, &p, &m->e, handle);
        if (state == COMPILED_FAILED) return state;
    }
    if (find(c, &p)) return COMPILED_READY;
    if (!c->note[0]) snprintf(c->note, sizeof c->note, "it was compiled for other numbers");
    return COMPILED_FAILED;
}

void compiled_nap(void) { nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL); }

void compiled_leave(compiled *c, const chosen *chosen)
{
    const purpose p = purpose_of(c, chosen);
    making *m = making_of(c, &p);
    if (!m || --m->waiting) return;
    cache_stop(m->job);
    m->job = NULL;
}

void compiled_rebind(compiled *c)
{
    for (int i = 0; c && i < c->count; i++) c->objects[i].bind(c->model->pool, c->objects[i].q, c->objects[i].u);
    if (c) find_rules(c);
}

const char *compiled_prepare(compiled *c, const chosen *chosen, bool kept)
{
    return object_of(c, chosen, kept ? CACHE_KEPT : 0) ? NULL : c->note;
}

motus_status compiled_machine(compiled *c, const chosen *chosen, machine *out, motus_error *err)
{
    object *o = object_of(c, chosen, 0);
    if (!o) return fail(err, MOTUS_TOOL, "the model could not be compiled: %s", c->note);
    /* One pool of threads serves all runs of the model. Threads beyond the processors gain nothing. */
    if (chosen->threads > 1 && c->tiling && !c->thread_pool) {
        const int processors = parallel_processors();
        c->thread_pool = parallel_pool_create(chosen->threads > processors ? chosen->threads : processors,
                                              &c->model->arena->allocator);
    }
    o->host.thread_pool = c->thread_pool;
    c->problem.traits = c->interpreted->traits;
    *out = (machine){.name = "compiled", .problem = &c->problem, .body = &o->body, .host = &o->host};
    return MOTUS_OK;
}
