/* See system.h. */
#include "api/system/system.h"

#include "core/rows.h"
#include "lang/model/switches.h"
#include "machine/sides.h"

bool located_kinks(const model *m)
{
    bool kinks = !m->traits.smooth;
    for (size_t k = 0; k < m->boundary_count && !kinks; k++) kinks = graph_kink(m->graph, m->boundary[k].value) != 0;
    return kinks;
}

static motus_status make(motus_system *s, motus_error *err)
{
    switches found;
    if (!switches_find(s->model, true, &found))
        return fail(err, MOTUS_MEMORY, "no memory for the switches of the model");
    if (found.refused) s->located_refused = "the switches of the model cannot be located";
    if (found.refused || found.kinds == 0) return MOTUS_OK;
    model_shape *shapes = take(&s->allocator, found.kinds, sizeof *shapes);
    if (!shapes) return fail(err, MOTUS_MEMORY, "no memory for the switches of the model");
    for (size_t k = 0; k < found.kinds; k++) shapes[k] = switches_shape(s->model, &found, k);
    const read_how how = {.sides = shapes, .side_count = (uint32_t)found.kinds};
    motus_status status = system_read(&s->text, &how, &s->located, err);
    give(&s->allocator, shapes);
    if (status == MOTUS_OK) status = shadow_numbers(s, s->located, err);
    if (status == MOTUS_OK && s->located->model->located) return MOTUS_OK;
    motus_system_destroy(s->located);
    s->located = NULL;
    s->located_refused = "the switches of the model cannot be located";
    return status;
}

/* Returns whether the force may be undefined beyond a switch. */
static bool has_domain(const model *m)
{
    bool domain = false;
    for (size_t k = 0; k < m->accel_count && !domain; k++) domain = graph_domain(m->graph, m->accel[k].value) != 0;
    for (size_t k = 0; k < m->boundary_count && !domain; k++)
        domain = graph_domain(m->graph, m->boundary[k].value) != 0;
    return domain;
}

bool located_may_leave(const motus_system *s)
{
    const model *m = s->located ? s->located->model : NULL;
    return m && switches_sought(m, m->located) <= LOCATED_MOST && has_domain(m);
}

/* Returns why a run does not locate switches unless asked; "": it does. */
static const char *unsuited(const model *m)
{
    if (switches_sought(m, m->located) > LOCATED_MOST)
        return "switches are not located unless asked for, since there are many";
    return has_domain(m) ? "switches are not located unless asked for, since the force may be undefined beyond one"
                         : "";
}

motus_status located_of(motus_system *s, motus_switches asked, motus_system **out, const char **why, motus_error *err)
{
    *out = NULL;
    *why = "";
    if (asked != MOTUS_SWITCHES_LOCATE && asked != MOTUS_SWITCHES_USUAL) return MOTUS_OK;
    if (!s->model || s->model->located) return MOTUS_OK;
    if (s->located && s->located_changes != s->changes) {
        motus_system_destroy(s->located);
        s->located = NULL;
        s->located_known = false;
        s->located_refused = NULL;
    }
    if (!s->located_known && located_kinks(s->model)) {
        const motus_status status = make(s, err);
        if (status != MOTUS_OK) return status;
    }
    s->located_known = true;
    s->located_changes = s->changes;
    if (s->located && asked == MOTUS_SWITCHES_USUAL) *why = unsuited(s->located->model);
    if (!s->located && s->located_refused) *why = s->located_refused;
    if (!**why) *out = s->located;
    return MOTUS_OK;
}

/* Refuses Taylor series where friction along a direction stops a motion that turns: they do not lead there yet. */
static motus_status check_series(motus_system *located, motus_error *err)
{
    const rules *rules;
    const motus_status status = system_rules(located, &rules, err);
    if (status != MOTUS_OK || !sides_rub(located->sides, located->start, located->x0, located->v0)) return status;
    fail(err, MOTUS_UNAVAILABLE,
         "Taylor series do not lead to where friction along a direction, r'/|r'|, stops the motion");
    hint(err, "take the method dop853, which does");
    return MOTUS_UNAVAILABLE;
}

motus_status located_for(motus_system *s, const chosen *method, motus_switches asked, motus_system **out,
                         const char **why, motus_error *err)
{
    *out = NULL;
    *why = "";
    if (row_adaptive(method)) {
        const motus_status found = located_of(s, asked, out, why, err);
        return found == MOTUS_OK && *out && method->row->expands ? check_series(*out, err) : found;
    }
    return asked == MOTUS_SWITCHES_LOCATE && !row_formula(method) ? located_of(s, asked, out, why, err) : MOTUS_OK;
}
