/* The compiled machine: the model's acceleration, the row and the texts of step/ as one C text, compiled by the system's compiler and loaded.
 *
 * Invariant: the object replaces only the function that advances, so memory, errors, restart and looking are the library's own, and the bits
 * are the interpreter's. One object serves every N and every parameter; the rows share nothing but the cache. What is never hot is never
 * compiled: a compiler's time is what a first run waits for.
 */
#include "run/compiled.h"

#include "core/stepper_body.h"
#include "lang/emit.h"
#include "run/cache.h"
#include "run/stepping.h"
#include "run/texts.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

enum {
    OBJECTS_MAX = 64, NOTE_MAX = 400,
    OPERATIONS_MAX = 20000           /* in one text: compilers take more than linear time, and minutes beyond this */
};

#include "step/host.h"

typedef struct object { const row *row; void *handle; stepper_body body; } object;

struct compiled {
    compiled_host host;              /* first: the object finds it through problem.ctx */
    model *model;
    problem interpreted;
    object objects[OBJECTS_MAX];
    int count;
    program *force, *boundary;
    double *u;
    int64_t *q;
    char note[NOTE_MAX];
};

/* ---- the problem, for everything that is not a step ---- */

static const problem *of(void *ctx) { return &((compiled *)ctx)->interpreted; }

static int accel(void *ctx, double t, double *x, double *v, double *a) { return of(ctx)->accel(of(ctx)->ctx, t, x, v, a); }
static int jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    return of(ctx)->jvp(of(ctx)->ctx, t, x, v, dx, dv, da);
}
static bool prepare(void *ctx, bool in_v) { return of(ctx)->prepare(of(ctx)->ctx, in_v); }
static void pattern(void *ctx, bool in_v, void (*emit)(void *, size_t, size_t), void *arg) { of(ctx)->pattern(of(ctx)->ctx, in_v, emit, arg); }
static void refresh(void *ctx, double t, double *x, double *v) { of(ctx)->refresh(of(ctx)->ctx, t, x, v); }
static int exact(void *ctx, double t, double *x, double *v) { return of(ctx)->exact(of(ctx)->ctx, t, x, v); }
static void name(void *ctx, bool in_v, size_t k, char *out, size_t size) { of(ctx)->name(of(ctx)->ctx, in_v, k, out, size); }

motus_status compiled_create(model *m, const problem *interpreted, compiled **out, problem *p, motus_error *err)
{
    compiled *c = arena_grow(m->arena, NULL, 0, sizeof *c);
    if (!c)
        return fail(err, MOTUS_MEMORY, "no memory for the model");
    memset(c, 0, sizeof *c);
    c->model = m;
    c->interpreted = *interpreted;
    *p = (problem){.ctx = c, .nx = m->nx, .nv = m->nv, .traits = interpreted->traits, .accel = accel, .jvp = interpreted->jvp ? jvp : NULL,
                   .prepare = interpreted->prepare ? prepare : NULL, .pattern = interpreted->pattern ? pattern : NULL,
                   .refresh = interpreted->refresh ? refresh : NULL, .exact = interpreted->exact ? exact : NULL, .name = name};
    *out = c;
    return MOTUS_OK;
}

void compiled_close(compiled *c)
{
    for (int i = 0; c && i < c->count; i++)
        dlclose(c->objects[i].handle);
    if (c)
        c->count = 0;
}

/* ---- the text ---- */

static void add_text(emit_text *t, const char *which)
{
    for (const embedded_text *e = texts_table; e->name; e++)
        if (!strcmp(e->name, which))
            emit_add(t, "%s\n", e->text);
}

/* Scalar models have as many numbers in every run; families do not. */
static bool sizes_are_structure(const model *m)
{
    for (uint32_t i = 0; i < m->state_count; i++)
        if (m->states[i].dims > 0)
            return false;
    return true;
}

/* What is known when the text is written, as the constants that ROW and FACT lead to. */
static void add_facts(emit_text *t, const row *r, const problem *p, bool structure)
{
    static const char *const families[] = {[SPLITTING] = "SPLITTING", [RUNGE_KUTTA] = "RUNGE_KUTTA", [TWO_STEP] = "TWO_STEP", [IMPLICIT] = "IMPLICIT",
                                           [EXACT] = "EXACT"};
    static const char *const recurrences[] = {[VERLET] = "VERLET", [VERLET_LITERAL] = "VERLET_LITERAL", [BEEMAN] = "BEEMAN"};
    emit_add(t, "#define ROW(w, member) ROW_##member\n#define ROW_family %s\n#define ROW_two_step %s\n#define ROW_compensated %d\n#define ROW_gyroscopic %d\n\n",
             families[r->family], recurrences[r->two_step], r->compensated, r->gyroscopic);
    emit_add(t, "#define FACT(w, member) FACT_##member\n#define FACT_velocity %d\n#define FACT_linear %d\n", p->traits.velocity, p->traits.linear_v);
    if (structure)
        emit_add(t, "#define FACT_nx %zu\n#define FACT_nv %zu\n", p->nx, p->nv);
    else
        emit_add(t, "#define FACT_nx w->nx\n#define FACT_nv w->nv\n");
}

/* The family's text, and for the others what lets the loop's text compile without them. */
static void add_family(emit_text *t, const row *r)
{
    static const struct { family family; const char *text, *without; } families[] = {
        {SPLITTING, "step/splitting.h", "#define splitting_step(w) STEP_OK\n"},
        {RUNGE_KUTTA, "step/runge_kutta.h", "#define runge_kutta_step(w) STEP_OK\n"},
        {TWO_STEP, "step/two_step.h", "#define verlet_step(w) STEP_OK\n#define beeman_step(w) STEP_OK\n#define literal_step(w) STEP_OK\n"},
        {IMPLICIT, "step/implicit.h", "#define implicit_step(w) STEP_OK\n"}};
    if (r->family == IMPLICIT)
        add_text(t, "step/runge_kutta.h");             /* its stages are summed the same way */
    for (size_t i = 0; i < sizeof families / sizeof *families; i++)
        if (families[i].family == r->family)
            add_text(t, families[i].text);
        else if (!(r->family == IMPLICIT && families[i].family == RUNGE_KUTTA))
            emit_add(t, "%s", families[i].without);
}

/* The texts of the functions, and the operations that need them. */
static void add_functions(emit *e)
{
#define ANY_OF(a, b, c, d) (OPERATION_BIT(a) | OPERATION_BIT(b) | OPERATION_BIT(c) | OPERATION_BIT(d))
    static const uint64_t hyperbolic = ANY_OF(SINH, SINH, COSH, TANH), circular = ANY_OF(SIN, SIN, COS, TAN),
                          inverse = ANY_OF(ASIN, ACOS, ATAN, ATAN2), root = ANY_OF(CBRT, CBRT, HYPOT, HYPOT), power = OPERATION_BIT(POW),
                          error = OPERATION_BIT(ERF), logarithm = OPERATION_BIT(LOG) | power,
                          exponential = OPERATION_BIT(EXP) | power | hyperbolic | error,
                          any = exponential | logarithm | circular | inverse | root;
    const struct { uint64_t needed_by; const char *text; } texts[] = {
        {any, "step/functions_core.h"}, {exponential, "step/functions_exponential.h"}, {logarithm, "step/functions_logarithm.h"},
        {power, "step/functions_power.h"}, {hyperbolic, "step/functions_hyperbolic.h"}, {circular, "step/functions_circular.h"},
        {inverse, "step/functions_inverse.h"}, {root, "step/functions_root.h"}, {error, "step/functions_error.h"}, {any, "step/functions_end.h"},
        {ANY_OF(SQRT, ABS, FLOOR, MOD) | ANY_OF(MIN, MIN, MAX, SIGN), "step/elementary.h"}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (e->used & texts[i].needed_by)
            add_text(&e->text, texts[i].text);
#undef ANY_OF
}

static bool write_text(compiled *c, const chosen *chosen, emit *e)
{
    model *m = c->model;
    emit_text *t = &e->text;
    const row *r = chosen->row;
    const bool structure = sizes_are_structure(m);
    e->literal = structure;
    e->arrays = m->arrays;
    if (!c->force)
        c->force = program_create(m->graph, m->accel, m->accel_count);
    if (!c->boundary && m->driven)
        c->boundary = program_create(m->graph, m->boundary, m->boundary_count);
    if (m->arena->failed)
        return false;
    emit_program(e, c->force, "compiled_force");
    if (m->driven)
        emit_program(e, c->boundary, "compiled_boundary");
    const emit_text bodies = *t;
    *t = (emit_text){.arena = bodies.arena};
    emit_add(t, "/* A model of motion, compiled by motus: its acceleration, a method, and the loop that advances them. */\n"
                "typedef double coef;\ntypedef struct row row;\n#define ROW_CARD\n");
    add_facts(t, r, &c->interpreted, structure);
    emit_add(t, "#define DRIVEN %d\n\n", m->driven);
    static const char *const before[] = {"step/freestanding.h", "step/row.h", "step/scalar.h", "step/work.h", "step/host.h"};
    for (size_t i = 0; i < sizeof before / sizeof *before; i++)
        add_text(t, before[i]);
    add_functions(e);
    emit_operations(e);
    emit_add(t, "\n%s", bodies.bytes ? bodies.bytes : "");
    add_text(t, "step/compiled.h");
    if (r->family == IMPLICIT || r->gyroscopic || (r->family == TWO_STEP && r->two_step != BEEMAN && c->interpreted.traits.velocity))
        add_text(t, "step/newton.h");
    else
        emit_add(t, "#define increment(w, g, s, u, t) STEP_OK\n");
    add_family(t, r);
    add_text(t, "step/advance.h");
    emit_add(t, "void motus_bind(const double *pool, const int64_t *q, double *u)\n{\n    compiled_force_bind(pool, q, u);\n%s}\n\n"
                "int motus_run(work *given, whole steps)\n{\n    work w = *given;\n    int bad = advance_run(&w, steps);\n    *given = w;\n    return bad;\n}\n",
             m->driven ? "    compiled_boundary_bind(pool, q, u);\n" : "");
    return !m->arena->failed;
}

const char *compiled_text(compiled *c, const chosen *chosen, size_t *length)
{
    emit e = {.text = {.arena = c->model->arena}};
    if (!write_text(c, chosen, &e))
        return NULL;
    *length = e.text.length;
    return e.text.bytes;
}

/* ---- engines ---- */

/* The numbers that the text reads: bounds, strides, and what depends on parameters alone. The same for every row. */
static bool bind_numbers(compiled *c, const emit *e, void (*bind)(const double *, const int64_t *, double *))
{
    model *m = c->model;
    c->q = arena_grow(m->arena, NULL, 0, (e->int_count + 1) * sizeof *c->q);
    c->u = arena_grow(m->arena, NULL, 0, (e->fixed + 1) * sizeof *c->u);
    if (!c->q || !c->u)
        return false;
    for (uint32_t k = 0; k < e->int_count; k++)
        c->q[k] = emit_int_value(&e->ints[k], m->arrays, m->ints);
    bind(m->pool, c->q, c->u);
    c->host = (compiled_host){.pool = m->pool, .u = c->u, .q = c->q};
    return true;
}

static const stepper_body *body_of(compiled *c, const chosen *chosen)
{
    for (int i = 0; i < c->count; i++)
        if (c->objects[i].row == chosen->row)
            return &c->objects[i].body;
    snprintf(c->note, sizeof c->note, "out of memory");
    if (c->count == OBJECTS_MAX) {
        snprintf(c->note, sizeof c->note, "%d methods of this model are compiled already", OBJECTS_MAX);
        return NULL;
    }
    if (c->model->graph->count > OPERATIONS_MAX) {
        snprintf(c->note, sizeof c->note, "its equations are too long for a compiler: %u operations, and %d are the most", c->model->graph->count, OPERATIONS_MAX);
        return NULL;
    }
    emit e = {.text = {.arena = c->model->arena}};
    if (!write_text(c, chosen, &e))
        return NULL;
    void *handle = cache_load(e.text.bytes, e.text.length, c->note, sizeof c->note);
    if (!handle)
        return NULL;
    void (*bind)(const double *, const int64_t *, double *);
    object *o = &c->objects[c->count];
    *o = (object){.row = chosen->row, .handle = handle, .body = *stepper_best_body()};
    o->body.name = "compiled";
    /* POSIX promises that a function's address survives the way through void *. */
    *(void **)&bind = dlsym(handle, "motus_bind");
    *(void **)&o->body.run = dlsym(handle, "motus_run");
    if (!bind || !o->body.run || !bind_numbers(c, &e, bind)) {
        snprintf(c->note, sizeof c->note, "the compiled object is not what was compiled");
        dlclose(handle);
        return NULL;
    }
    c->host.factor = o->body.factor;
    c->host.back = o->body.back;
    c->host.apply = o->body.apply;
    c->count++;
    return &o->body;
}

const char *compiled_prepare(compiled *c, const chosen *chosen) { return body_of(c, chosen) ? NULL : c->note; }

static motus_status open_engine(const problem *p, const chosen *chosen, double t0, double h, const double *x, const double *v, const motus_allocator *a,
                                engine **out, motus_error *err)
{
    const stepper_body *body = body_of(p->ctx, chosen);
    if (!body)
        return fail(err, MOTUS_TOOL, "the model could not be compiled: %s", ((compiled *)p->ctx)->note);
    motus_status status = stepping_open(p, chosen, t0, h, x, v, a, out, err);
    if (status == MOTUS_OK)
        stepper_use_body((stepper *)*out, body);
    return status;
}

const machine machine_compiled = {.name = "compiled", STEPPING_BUT_OPEN, .open = open_engine};
