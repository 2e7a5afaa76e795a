/* Systems: made from a text or from a callback, described, and destroyed. */
#include "api/system/columns.h"
#include "api/system/system.h"
#include "lang/read/read.h"
#include "machine/held.h"
#include "machine/ruled.h"
#include "machine/sides.h"

#include <math.h>
#include <string.h>

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
    if (!s) return;
    s->ended = true;
    if (s->held) return;
    motus_allocator a = s->allocator;
    motus_system_destroy(s->located);
    compiled_close(s->compiled);
    arena_release(&s->arena);
    give(&a, s->events_text);
    give(&a, s->mathml);
    give(&a, s);
}

void motus_system_hold(motus_system *s, bool on)
{
    s->held += on ? 1 : (size_t)-1;
    if (s->ended) motus_system_destroy(s);
}

/* Copies `count` texts. NULL: no memory. */
static const char *const *keep_list(arena *a, const char *const *texts, size_t count)
{
    const char **copies = arena_room(a, (count + 1) * sizeof *copies);
    for (size_t i = 0; copies && i < count; i++) {
        copies[i] = arena_text(a, texts[i], strlen(texts[i]));
        if (!copies[i]) return NULL;
    }
    return copies;
}

/* Copies the text, because messages and descriptions point into it. */
static bool keep_text(motus_system *s, motus_text_def *def)
{
    size_t n = def->length == SIZE_MAX ? strlen(def->text) : def->length;
    if (n > SOURCE_BYTES_MAX) return true; /* read_model refuses it */
    char *copy = arena_room(&s->arena, n + 1);
    def->set = keep_list(&s->arena, def->set, def->set_count);
    def->when = keep_list(&s->arena, def->when, def->when_count);
    def->define = keep_list(&s->arena, def->define, def->define_count);
    if (!copy || !def->set || !def->when || !def->define) return false;
    memcpy(copy, def->text, n);
    copy[n] = 0;
    def->text = copy;
    def->length = n;
    if (def->file) def->file = arena_text(&s->arena, def->file, strlen(def->file));
    return !s->arena.failed;
}

bool system_auto(const char *method)
{
    static const char word[] = SYSTEM_AUTO;
    size_t k = 0;
    while (method && word[k] && (method[k] | ('a' ^ 'A')) == word[k]) k++;
    return method && !word[k] && !method[k];
}

static motus_status known_method(const char *name, motus_error *err)
{
    return system_auto(name) ? MOTUS_OK : row_choose(name, NULL, NULL, err);
}

motus_status system_read(const motus_text_def *given, const read_how *how, motus_system **out, motus_error *err)
{
    *out = NULL;
    motus_text_def def;
    motus_status status = motus_struct_read(MOTUS_DEF_TEXT, given, &def, err);
    if (status != MOTUS_OK) return status;
    if (!def.text) return fail(err, MOTUS_ARGUMENT, "the definition has no text");
    motus_system *s = begin(&def.allocator);
    if (!s) return fail(err, MOTUS_MEMORY, "no memory for the system");
    modes m = modes_enter();
    status = keep_text(s, &def) ? read_model(&s->arena, &def, how, known_method, &s->model, err)
                                : fail(err, MOTUS_MEMORY, "no memory for the model");
    if (status == MOTUS_OK) status = interpreter_create(s->model, &s->interpreter, &s->problem, err);
    if (status == MOTUS_OK) {
        s->text = def;
        s->machine = (machine){.name = "interpreter", .problem = &s->problem};
        s->start = s->model->start;
        s->x0 = s->model->x0;
        s->v0 = s->model->v0;
        s->states = s->model->states;
        s->state_count = s->model->state_count;
        s->definitions = s->model->definitions;
        s->definition_count = s->model->definition_count;
        if (!system_number_columns(s) || !column_names_enter(s))
            status = fail(err, MOTUS_MEMORY, "no memory for the model");
    }
    if (status == MOTUS_OK) status = invariants_check(s, err);
    modes_leave(m);
    if (status != MOTUS_OK) {
        motus_system_destroy(s);
        return status;
    }
    *out = s;
    return MOTUS_OK;
}

motus_status system_again(const motus_system *s, bool nudged, const uint8_t *varied, motus_system **out,
                          motus_error *err)
{
    const model *m = s->model;
    read_how how = {.nudged = nudged, .varied = varied, .varied_count = m->pool_count, .side_count = m->side_count};
    model_shape *shapes = take(&s->allocator, m->side_count + 1, sizeof *shapes);
    if (!shapes) return fail(err, MOTUS_MEMORY, "no memory for a system");
    for (uint32_t k = 0; k < m->side_count; k++) {
        const model_state *side = &m->states[m->side_first + k];
        shapes[k].dims = side->dims;
        memcpy(shapes[k].first, side->first, sizeof side->first);
        memcpy(shapes[k].last, side->last, sizeof side->last);
    }
    how.sides = shapes;
    const motus_status status = system_read(&s->text, &how, out, err);
    give(&s->allocator, shapes);
    return status;
}

motus_status motus_system_from_text(const motus_text_def *given, motus_system **out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!out) return fail(err, MOTUS_ARGUMENT, "motus_system_from_text needs a place for the system");
    return system_read(given, &(read_how){0}, out, err);
}

/* Copies the initial values, and checks that they are finite. */
static motus_status take_start(motus_system *s, const motus_callback_def *def, motus_error *err)
{
    const size_t nx = s->problem.nx, nv = s->problem.nv;
    s->start = def->start;
    s->x0 = arena_room(&s->arena, (nx + 1) * sizeof(double));
    s->v0 = arena_room(&s->arena, (nv + 1) * sizeof(double));
    if (!s->x0 || !s->v0) return fail(err, MOTUS_MEMORY, "no memory for the system");
    if (nx) memcpy(s->x0, def->x, nx * sizeof(double));
    memcpy(s->v0, def->v, nv * sizeof(double));
    for (size_t k = 0; k < nv; k++)
        if (!isfinite(s->v0[k]) || (k < nx && !isfinite(s->x0[k])) || !isfinite(def->start))
            return fail(err, MOTUS_ARGUMENT, "the initial values and the start must be finite numbers");
    return MOTUS_OK;
}

/* Makes the velocities, all NaN, for a callback that does not read them. */
static void keep_unread(motus_system *s)
{
    const size_t count = s->problem.nv > CALLING_NUMBERS ? s->problem.nv : CALLING_NUMBERS;
    double *unread = arena_room(&s->arena, count * sizeof *unread);
    for (size_t k = 0; unread && k < count; k++) unread[k] = NAN;
    s->calling.unread = unread;
}

motus_status motus_system_from_callback(const motus_callback_def *given, motus_system **out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!out) return fail(err, MOTUS_ARGUMENT, "motus_system_from_callback needs a place for the system");
    *out = NULL;
    if (!given) return fail(err, MOTUS_ARGUMENT, "motus_system_from_callback needs a definition");
    motus_callback_def def;
    motus_status status = motus_struct_read(MOTUS_DEF_CALLBACK, given, &def, err);
    if (status != MOTUS_OK) return status;
    motus_system *s = begin(&def.allocator);
    if (!s) return fail(err, MOTUS_MEMORY, "no memory for the system");
    s->callback = def;
    s->calling.def = &s->callback;
    status = callback_problem(&s->calling, &s->problem, err);
    if (status == MOTUS_OK) {
        s->machine = (machine){.name = "callback", .problem = &s->problem};
        if (def.derivative) s->calling.zeros = arena_room(&s->arena, (s->problem.nv + 1) * sizeof(double));
        if (!def.depends_on_velocity) keep_unread(s);
        status = s->arena.failed ? fail(err, MOTUS_MEMORY, "no memory for the system") : take_start(s, &def, err);
    }
    if (status == MOTUS_OK) status = callback_rules(&s->calling, &s->arena, &s->rules, err);
    if (status == MOTUS_OK) status = stand_in_make(s, err);
    if (status == MOTUS_OK && (!system_number_columns(s) || !column_names_enter(s) || s->arena.failed))
        status = fail(err, MOTUS_MEMORY, "no memory for the system");
    if (status != MOTUS_OK) {
        motus_system_destroy(s);
        return status;
    }
    *out = s;
    return MOTUS_OK;
}

const motus_allocator *motus_system_allocator(const motus_system *s) { return s ? &s->allocator : NULL; }
size_t motus_positions(const motus_system *s) { return s ? s->positions : 0; }
size_t motus_velocities(const motus_system *s) { return s ? s->velocities : 0; }
size_t motus_variable_count(const motus_system *s) { return s ? s->state_count : 0; }
int motus_has_exact(const motus_system *s) { return s && s->problem.traits.has_exact; }

motus_status system_switches(motus_system *s, motus_error *err)
{
    if (s->switches_known) return MOTUS_OK;
    const motus_status status = held_create(s->model, &s->switches, &s->switches_refused, err);
    s->switches_known = status == MOTUS_OK;
    return status;
}

bool system_located(const motus_system *s) { return s->model && s->model->located; }

motus_status system_rules(motus_system *s, const rules **out, motus_error *err)
{
    *out = s->rules;
    if (!s->model) return MOTUS_OK;
    motus_status status = MOTUS_OK;
    if (s->model->rule_count && !s->ruled) status = ruled_create(s->model, &s->ruled, err);
    if (s->ruled && s->compiled) ruled_use(s->ruled, compiled_rules, s->compiled);
    if (status == MOTUS_OK && s->ruled) *out = ruled_rules(s->ruled);
    if (status != MOTUS_OK || !s->model->located) return status;
    if (!s->sides) status = sides_create(s->model, *out, &s->problem, &s->sides, err);
    *out = s->sides ? sides_rules(s->sides) : NULL;
    return status;
}

bool system_rebind(motus_system *s)
{
    const bool bound = interpreter_rebind(s->interpreter) && (!s->ruled || ruled_rebind(s->ruled)) &&
                       (!s->sides || sides_rebind(s->sides));
    s->changes++;
    if (bound) compiled_rebind(s->compiled);
    return bound;
}

motus_status motus_variable_at(const motus_system *s, size_t k, motus_variable *v)
{
    if (!s || !v || k >= s->state_count || motus_struct_check(MOTUS_DEF_VARIABLE, v, NULL) != MOTUS_OK)
        return MOTUS_ARGUMENT;
    const model_state *st = &s->states[k];
    motus_variable ours = {.name = st->name,
                           .order = st->order,
                           .components = st->components,
                           .dimensions = st->dims,
                           .count = st->cells.count * (size_t)(st->components ? st->components : 1)};
    memcpy(ours.first, st->eq_first, sizeof ours.first);
    memcpy(ours.last, st->eq_last, sizeof ours.last);
    motus_struct_write(MOTUS_DEF_VARIABLE, &ours, v);
    return MOTUS_OK;
}

motus_settings system_settings(const motus_system *s)
{
    motus_settings set = motus_default_settings();
    set.from = s->start, set.from_said = MOTUS_SAID_MODEL;
    if (!s->model) return set;
    const model *m = s->model;
    set.method = m->method;
    set.step = m->step;
    set.until = m->until;
    set.tolerance = m->tolerance;
    set.accuracy = m->accuracy;
    set.absolute = m->absolute;
    set.every_time = m->every_time;
    set.every_steps = m->every_steps;
#define SAYS(number) (isnan(number) ? MOTUS_SAID_NOBODY : MOTUS_SAID_MODEL)
    set.method_said = m->method ? MOTUS_SAID_MODEL : MOTUS_SAID_NOBODY;
    set.step_said = SAYS(m->step), set.until_said = SAYS(m->until);
    set.tolerance_said = SAYS(m->tolerance), set.accuracy_said = SAYS(m->accuracy);
    return set;
}
