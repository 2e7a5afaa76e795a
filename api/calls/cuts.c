/* How events that assign, and so end a step, affect a symplectic or reversible method. See explain.h.
 *
 * A step of a given size, or to a given time, is a symplectic map; one whose size depends on the state is not. Fixed
 * steps of a reversible method stay reversible: the way back divides the step at the event, too. Error control begins
 * anew after an event, so with adaptive steps the way back has other steps.
 */
#include "api/calls/explain.h"

#include "api/motion/run.h"

bool cuts_by_state(const motus_system *s)
{
    const model *m = s->model;
    for (uint32_t k = 0; m && k < m->rule_count; k++) {
        const model_rule *r = &m->rules[k];
        if (r->assigns && r->kind == RULE_ACCUMULATES) return true;
        for (size_t i = 0; r->assigns && i < r->leaves; i++)
            if (graph_deps(m->graph, r->leaf[i].value) & DEP_STATE) return true;
    }
    return false;
}

/* Returns whether a rule that assigns is an event, and not a switch of the force. */
static bool has_assigning_event(const rules *of)
{
    for (size_t k = 0; of && k < of->count; k++)
        if (of->rule[k].assigns && !of->rule[k].internal) return true;
    return false;
}

const char *cuts_sentence(const motus_run *r)
{
    motus_geometry kept = MOTUS_GEOMETRY_NONE;
    if (!has_assigning_event(r->rules)) return "";
    if (row_reversible_steps(&r->chosen))
        return "the control of steps begins anew after an event that assigns, so the run is "
               "reversible only between such events";
    if (!cuts_by_state(r->system) || motus_method_geometry(r->system, r->chosen.name, &kept, NULL) != MOTUS_OK ||
        kept != MOTUS_GEOMETRY_SYMPLECTIC)
        return "";
    return "the state decides where an event that assigns ends a step, so that step is not symplectic, while those "
           "between are";
}
