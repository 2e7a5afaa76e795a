/* Systems: from a text or from a callback, and back to nothing. */
#include "api/system.h"

#include <math.h>
#include <string.h>

const motus_allocator *motus_system_allocator(const motus_system *s);
const motus_allocator *motus_system_allocator(const motus_system *s) { return &s->allocator; }

static motus_system *begin(const motus_allocator *a)
{
    motus_system *s = take(a, 1, sizeof *s);
    if (s) {
        s->allocator = *a;
        arena_init(&s->arena, a);
    }
    return s;
}

void motus_system_destroy(motus_system *s)
{
    if (!s)
        return;
    motus_allocator a = s->allocator;
    compiled_close(s->compiled);
    arena_release(&s->arena);
    give(&a, s->mathml);
    give(&a, s);
}

/* A definition as this library knows it: what an older caller does not have keeps its default. */
static void read_definition(void *ours, const void *given, uint32_t size)
{
    uint32_t theirs;
    memcpy(&theirs, given, sizeof theirs);
    memcpy(ours, given, theirs < size ? theirs : size);
}

/* The text is copied: names in messages and cards point into it. */
static bool keep_text(motus_system *s, motus_text_def *def)
{
    size_t n = def->length == SIZE_MAX ? strlen(def->text) : def->length;
    if (n > SOURCE_BYTES_MAX)
        return true;                 /* refused in a moment, by model_create */
    char *copy = arena_room(&s->arena, n + 1);
    const char **set = arena_room(&s->arena, (def->set_count + 1) * sizeof *set);
    if (!copy || !set)
        return false;
    memcpy(copy, def->text, n);
    copy[n] = 0;
    for (size_t i = 0; i < def->set_count; i++) {
        size_t m = strlen(def->set[i]) + 1;
        char *one = arena_room(&s->arena, m);
        if (!one)
            return false;
        memcpy(one, def->set[i], m);
        set[i] = one;
    }
    def->text = copy;
    def->length = n;
    def->set = set;
    if (def->file)
        def->file = arena_text(&s->arena, def->file, strlen(def->file));
    return !s->arena.failed;
}

motus_status motus_system_from_text(const motus_text_def *given, motus_system **out, motus_error *err)
{
    if (!out)
        return fail(err, MOTUS_ARGUMENT, "motus_system_from_text needs a place for the system");
    *out = NULL;
    if (!given || !given->text)
        return fail(err, MOTUS_ARGUMENT, "the definition has no text");
    motus_text_def def = motus_default_text();
    read_definition(&def, given, sizeof def);
    motus_system *s = begin(&def.allocator);
    if (!s)
        return fail(err, MOTUS_MEMORY, "no memory for the system");
    modes m = modes_enter();
    motus_status status = keep_text(s, &def) ? model_create(&s->arena, &def, &s->model, err) : fail(err, MOTUS_MEMORY, "no memory for the model");
    if (status == MOTUS_OK)
        status = interpreter_create(s->model, &s->interpreter, &s->problem, err);
    if (status == MOTUS_OK) {
        s->text = def;
        s->machine = &machine_interpreter;
        s->start = s->model->start;
        s->x0 = s->model->x0;
        s->v0 = s->model->v0;
        s->states = s->model->states;
        s->state_count = s->model->state_count;
        if (!system_number_columns(s))
            status = fail(err, MOTUS_MEMORY, "no memory for the model");
    }
    modes_leave(m);
    if (status != MOTUS_OK) {
        motus_system_destroy(s);
        return status;
    }
    *out = s;
    return MOTUS_OK;
}

/* x and s of a callback, as families without an equation of their own. */
static void stand_in(model_state *st, const char *name, int order, size_t count, size_t base)
{
    *st = (model_state){.name = name, .order = order, .dims = 1, .hull = count, .base = base, .cells = {.count = count}};
    st->last[0] = st->eq_last[0] = (int64_t)count - 1;
}

motus_status motus_system_from_callback(const motus_callback_def *given, motus_system **out, motus_error *err)
{
    if (!out)
        return fail(err, MOTUS_ARGUMENT, "motus_system_from_callback needs a place for the system");
    *out = NULL;
    if (!given)
        return fail(err, MOTUS_ARGUMENT, "there is no definition");
    motus_callback_def def = motus_default_callback();
    read_definition(&def, given, sizeof def);
    motus_system *s = begin(&def.allocator);
    if (!s)
        return fail(err, MOTUS_MEMORY, "no memory for the system");
    s->callback = def;
    s->calling.def = &s->callback;
    motus_status status = callback_problem(&s->calling, &s->problem, err);
    if (status == MOTUS_OK) {
        size_t nx = s->problem.nx, nv = s->problem.nv;
        s->machine = &machine_callback;
        s->start = def.start;
        s->x0 = arena_room(&s->arena, (nx + 1) * sizeof(double));
        s->v0 = arena_room(&s->arena, (nv + 1) * sizeof(double));
        s->states = arena_room(&s->arena, 2 * sizeof *s->states);
        if (def.derivative)
            s->calling.zeros = arena_room(&s->arena, (nv + 1) * sizeof(double));
        if (s->x0 && s->v0 && s->states) {
            if (nx)
                memcpy(s->x0, def.x, nx * sizeof(double));
            memcpy(s->v0, def.v, nv * sizeof(double));
            if (nx)
                stand_in(&s->states[s->state_count++], "x", 2, nx, 0);
            if (nv > nx)
                stand_in(&s->states[s->state_count++], "s", 1, nv - nx, nx);
        }
        if (s->arena.failed || !system_number_columns(s))
            status = fail(err, MOTUS_MEMORY, "no memory for the system");
        for (size_t k = 0; status == MOTUS_OK && k < nv; k++)
            if (!isfinite(s->v0[k]) || (k < nx && !isfinite(s->x0[k])) || !isfinite(def.start))
                status = fail(err, MOTUS_ARGUMENT, "the initial values are not all finite");
    }
    if (status != MOTUS_OK) {
        motus_system_destroy(s);
        return status;
    }
    *out = s;
    return MOTUS_OK;
}

motus_status system_again(const motus_system *s, motus_system **out, motus_error *err)
{
    motus_callback_def def = s->callback;
    def.x = s->x0;                   /* what the caller gave was copied, and may be gone */
    def.v = s->v0;
    motus_status status = s->model ? motus_system_from_text(&s->text, out, err) : motus_system_from_callback(&def, out, err);
    if (status == MOTUS_OK)
        (*out)->problem.traits = s->problem.traits;
    return status;
}

size_t motus_positions(const motus_system *s) { return s ? s->positions : 0; }
size_t motus_velocities(const motus_system *s) { return s ? s->velocities : 0; }
size_t motus_variable_count(const motus_system *s) { return s ? s->state_count : 0; }
int motus_has_exact(const motus_system *s) { return s && s->problem.traits.has_exact; }

motus_status motus_variable_at(const motus_system *s, size_t k, motus_variable *v)
{
    if (!s || !v || k >= s->state_count)
        return MOTUS_ARGUMENT;
    const model_state *st = &s->states[k];
    *v = (motus_variable){.name = st->name, .order = st->order, .components = st->components, .dimensions = st->dims,
                          .count = st->cells.count * (size_t)(st->components ? st->components : 1)};
    memcpy(v->first, st->eq_first, sizeof v->first);
    memcpy(v->last, st->eq_last, sizeof v->last);
    return MOTUS_OK;
}

void motus_settings_of(const motus_system *s, motus_settings *out)
{
    *out = (motus_settings){.step = NAN, .tolerance = NAN, .from = NAN, .until = NAN, .every_time = NAN};
    if (!s)
        return;
    out->from = s->start;
    if (!s->model)
        return;
    const model *m = s->model;
    *out = (motus_settings){.method = m->method, .step = m->step, .tolerance = m->tolerance, .from = m->start, .until = m->until,
                            .every_time = m->every_time, .every_steps = m->every_steps};
}
