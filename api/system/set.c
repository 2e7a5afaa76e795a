/* motus_system_set, which sets numbers of a system without reading its text again, and motus_system_clone.
 *
 * Invariant: a system whose numbers were set has, to the bit, the numbers of a system that was read with them in `set`;
 * a refusal changes nothing. lang/model/vary.h computes the numbers that depend on them.
 */
#include "api/system/system.h"
#include "api/system/parameters.h"

#include "lang/model/vary.h"
#include "lang/read/read.h"

#include <math.h>
#include <string.h>

/* What is computed again when one parameter or initial value changes. It is made at the first change, and kept, so that
 * setting the number again takes no more memory of the arena. */
struct setting {
    size_t first; /* its first place in the pool, which identifies it */
    vary *vary;
    struct setting *next;
};

/* ---- all numbers of a model ---- */

double *set_aside(const motus_system *s)
{
    const model *m = s->model;
    double *room = take(&s->allocator, m->pool_count + m->nx + m->nv + 1, sizeof *room);
    if (!room) return NULL;
    memcpy(room, m->pool, m->pool_count * sizeof *room);
    memcpy(room + m->pool_count, m->x0, m->nx * sizeof *room);
    memcpy(room + m->pool_count + m->nx, m->v0, m->nv * sizeof *room);
    return room;
}

/* Cannot fail, since binding again takes no memory. */
void set_back(motus_system *s, const double *room)
{
    model *m = s->model;
    memcpy(m->pool, room, m->pool_count * sizeof *room);
    system_rebind(s);
    memcpy(m->x0, room + m->pool_count, m->nx * sizeof *room);
    memcpy(m->v0, room + m->pool_count + m->nx, m->nv * sizeof *room);
}

/* ---- setting ---- */

static motus_status refuse_decision(const char *name, const char *what, motus_error *err)
{
    const char *quote = strchr(what, ' ') ? "" : "`"; /* what is a setting goes in quotes */
    fail(err, MOTUS_ARGUMENT, "%s decides %s%s%s, which is fixed when the text is read", name, quote, what, quote);
    hint(err, "read the text again, with the value in `set` of motus_text_def");
    return MOTUS_ARGUMENT;
}

/* Finds the setting of a target, or makes it. */
static motus_status setting_of(motus_system *s, const char *name, const parameters_target *t, struct setting **out,
                               motus_error *err)
{
    const char *what;
    for (*out = s->settings; *out; *out = (*out)->next)
        if ((*out)->first == t->first) return MOTUS_OK;
    if (!vary_decides(s->model, t->first, t->span, &s->allocator, &what))
        return fail(err, MOTUS_MEMORY, "no memory to find out what %s decides", name);
    if (what) return refuse_decision(name, what, err);
    struct setting *made = arena_take(&s->arena, sizeof *made);
    size_t *places = take(&s->allocator, t->count + 1, sizeof *places);
    if (!places || s->arena.failed) {
        give(&s->allocator, places);
        return fail(err, MOTUS_MEMORY, "no memory to set %s", name);
    }
    for (size_t k = 0; k < t->count; k++) places[k] = parameters_place(t, k);
    *made = (struct setting){.first = t->first};
    const motus_status status = vary_create(s->model, places, t->count, false, false, &made->vary, err);
    give(&s->allocator, places);
    if (status != MOTUS_OK) return status;
    made->next = s->settings;
    *out = s->settings = made;
    return MOTUS_OK;
}

/* Refuses what a text is refused for: dependent numbers that are not finite, an exact line that no longer obeys its
 * equation, and an invariant that is no longer one. */
static motus_status check(motus_system *s, const char *name, motus_error *err)
{
    const model *m = s->model;
    for (uint32_t i = 0; i < m->definition_count; i++) {
        if (m->definitions[i].kind != DEFINED_PARAMETER) continue;
        const parameters_target t = parameters_of(s, &m->definitions[i]);
        for (size_t k = 0; k < t.span; k++)
            if (!isfinite(m->pool[t.first + k]))
                return fail(err, MOTUS_ARGUMENT, "%s depends on %s, and would not be a finite number",
                            m->definitions[i].name, name);
    }
    for (uint32_t i = 0; i < s->state_count; i++)
        for (size_t c = 0; c < s->states[i].cells.count; c++)
            for (int k = 0; k < (s->states[i].components ? s->states[i].components : 1); k++) {
                const size_t at = system_place(&s->states[i], c, k);
                if (!isfinite(s->v0[at]) || (s->states[i].order == 2 && !isfinite(s->x0[at])))
                    return fail(err, MOTUS_ARGUMENT,
                                "an initial value of %s depends on %s, and would not be a finite number",
                                s->states[i].name, name);
            }
    const motus_status status = verify_again(s->model, err);
    return status == MOTUS_OK ? invariants_check(s, err) : status;
}

static motus_status set_model(motus_system *s, const char *name, const parameters_target *t, const double *values,
                              motus_error *err)
{
    model *m = s->model;
    const bool before = m->overridden && m->overridden[t->first];
    struct setting *one;
    motus_status status = setting_of(s, name, t, &one, err);
    if (status != MOTUS_OK) return status;
    double *own = set_aside(s);
    if (!own || !vary_override(m, t->first, t->span, true)) {
        give(&s->allocator, own);
        return fail(err, MOTUS_MEMORY, "no memory to set %s", name);
    }
    status = vary_apply(one->vary, values) && system_rebind(s) ? check(s, name, err)
                                                               : fail(err, MOTUS_MEMORY, "no memory to set %s", name);
    if (status == MOTUS_OK)
        s->judged_gyroscopic = s->judged_gradient = false; /* they were of other numbers */
    else
        set_back(s, own);
    if (status != MOTUS_OK && !before) vary_override(m, t->first, t->span, false);
    give(&s->allocator, own);
    return status;
}

static void set_callback(motus_system *s, const parameters_target *t, const double *values)
{
    const model_state *st = t->state;
    double *to = (st->order == 2 && !t->velocity ? s->x0 : s->v0) + st->base;
    memcpy(to, values, t->count * sizeof *to);
}

motus_status motus_system_set(motus_system *s, const char *name, const double *values, size_t count, motus_error *err)
{
    parameters_target t;
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s || !name || !values) return fail(err, MOTUS_ARGUMENT, "motus_system_set needs a system, a name and values");
    motus_status status = parameters_find(s, name, &t, err);
    if (status != MOTUS_OK) return status;
    if (count != t.count)
        return fail(err, MOTUS_SHAPE, "%s is %zu number%s, but the call gives %zu", name, t.count,
                    t.count == 1 ? "" : "s", count);
    for (size_t k = 0; k < count; k++)
        if (!isfinite(values[k]))
            return fail(err, MOTUS_ARGUMENT, "%s cannot be set: value %zu is not a finite number", name, k + 1);
    if (s->held) {
        fail(err, MOTUS_ARGUMENT, "%s cannot be set while %zu run%s, ensemble%s or reference%s use%s the system", name,
             s->held, s->held == 1 ? "" : "s", s->held == 1 ? "" : "s", s->held == 1 ? "" : "s",
             s->held == 1 ? "s" : "");
        hint(err, "destroy them first, or set it in a clone");
        return MOTUS_ARGUMENT;
    }
    if (!s->model) {
        set_callback(s, &t, values);
        return MOTUS_OK;
    }
    modes m = modes_enter();
    status = set_model(s, name, &t, values, err);
    modes_leave(m);
    return status;
}

/* ---- clones ---- */

/* Copies the numbers that were set into a system that was read from that text. */
static motus_status take_over(const motus_system *from, motus_system *to, motus_error *err)
{
    const model *m = from->model;
    if (!m || !m->overridden) return MOTUS_OK;
    double *numbers = set_aside(from);
    if (!numbers || !vary_override(to->model, 0, 0, true)) {
        give(&from->allocator, numbers);
        return fail(err, MOTUS_MEMORY, "no memory for a clone of the system");
    }
    memcpy(to->model->overridden, m->overridden, m->pool_count);
    set_back(to, numbers);
    give(&from->allocator, numbers);
    return MOTUS_OK;
}

motus_status motus_system_clone(const motus_system *s, motus_system **out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!out) return fail(err, MOTUS_ARGUMENT, "motus_system_clone needs a place for the clone");
    *out = NULL;
    if (!s) return fail(err, MOTUS_ARGUMENT, "motus_system_clone needs a system");
    motus_system *made = NULL;
    motus_callback_def def = s->callback;
    def.x = s->x0; /* copies, since the caller's arrays may be gone */
    def.v = s->v0;
    motus_status status =
        s->model ? system_again(s, false, NULL, &made, err) : motus_system_from_callback(&def, &made, err);
    if (status == MOTUS_OK) status = take_over(s, made, err);
    if (status != MOTUS_OK) {
        motus_system_destroy(made);
        return status;
    }
    made->problem.traits = s->problem.traits; /* with the results of sampling */
    made->judged_gyroscopic = s->judged_gyroscopic;
    made->judged_gradient = s->judged_gradient;
    made->sampled_gyroscopic = s->sampled_gyroscopic;
    made->sampled_gradient = s->sampled_gradient;
    made->energy = s->energy;
    *out = made;
    return MOTUS_OK;
}
