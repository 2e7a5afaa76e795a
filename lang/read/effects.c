/* What events change: the places of their values, which modes are kept because only observers read them, and events
 * that would never happen. */
#include "lang/read/read_steps.h"

/* Makes places for the values of assignments. An event writes one for each value of the indices that number no
 * instances; what the event keeps (keep.c) has none of these indices. */
static bool place_values(model *m, model_rule *r)
{
    for (size_t k = 0; k < r->assignments; k++) {
        output *o = &r->assignment[k].value;
        const int loops = r->assignment[k].kept ? r->own : r->loops;
        if (!model_take_arrays(m, 1, &o->to.array)) return false;
        const size_t cells = graph_shape(m->arena, &m->arrays[o->to.array], SPACE_OUT, r->numbers, loops - r->own,
                                         r->first + r->own, r->last + r->own);
        r->numbers += cells;
        if (r->numbers > MODEL_NUMBERS_MAX) {
            source_complain(&m->source, MOTUS_LIMIT, &r->statement->at, "an event assigns at most %d numbers",
                            MODEL_NUMBERS_MAX);
            return false;
        }
        o->to.dims = (uint8_t)(loops - r->own);
        o->loops = loops;
        for (int d = 0; d < loops; d++) o->loop[d] = r->loop[d];
        for (int d = r->own; d < loops; d++)
            o->to.at[d - r->own] = (subscript){.level = (int8_t)d, .slot = -1, .modulus = -1};
    }
    return true;
}

static void note_mode(void *ctx, const reference *r, const range *sums, int first_level, int inside)
{
    model *m = ctx;
    (void)sums, (void)first_level, (void)inside;
    const model_state *s = model_state_of(m, r->array);
    if (s >= m->states + m->state_count) m->states[s - m->states].kept = false;
}

static void read_by(model *m, const output *o, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (graph_deps(m->graph, o[k].value) & DEP_MODE) graph_loads(m->graph, o[k].value, SPACE_X, note_mode, m);
}

/* Returns whether an assignment changes the motion, or what rules watch. */
static bool matters(const model *m, const model_assignment *a) { return !model_state_of(m, a->to.array)->kept; }

/* Finds the modes that only observers read: all but those that affect forces, functions of events, or what is assigned
 * to states and to such modes. */
static void find_kept(model *m)
{
    for (uint32_t i = 0; i < m->mode_count; i++) m->states[m->state_count + i].kept = true;
    read_by(m, m->accel, m->accel_count);
    read_by(m, m->boundary, m->boundary_count);
    for (uint32_t i = 0; i < m->rule_count; i++) read_by(m, m->rules[i].leaf, m->rules[i].leaves);
    for (uint32_t before = UINT32_MAX, kept = 0; kept != before;) {
        before = kept;
        for (uint32_t i = 0; i < m->rule_count; i++)
            for (size_t k = 0; k < m->rules[i].assignments; k++)
                if (matters(m, &m->rules[i].assignment[k])) read_by(m, &m->rules[i].assignment[k].value, 1);
        kept = 1;
        for (uint32_t i = 0; i < m->mode_count; i++) kept += m->states[m->state_count + i].kept;
    }
}

static bool judge_assignments(model *m, model_rule *r)
{
    for (size_t k = 0; k < r->assignments; k++) {
        const model_assignment *a = &r->assignment[k];
        if (!matters(m, a)) continue;
        r->assigns = true;
        if (!m->exact_given) continue;
        char text[80];
        COMPLAIN(m, &a->at, "the model gives its exact motion, which ends where %s is assigned",
                 quote(m, &a->at, text));
        HINT(m, "leave the exact lines out, or the assignment");
        return false;
    }
    r->keeps = r->assignments > 0 && !r->assigns;
    return true;
}

/* Complains about a function that jumps and is constant between: it never passes 0, so its event would never happen. */
static bool flat(model *m, const model_rule *r, node leaf)
{
    char text[80];
    if (!graph_jump(m->graph, leaf) || !graph_flat(m->graph, leaf)) return false;
    COMPLAIN(m, &r->occasion, "%s never happens: its sides change only by jumps, which do not pass through equality",
             quote(m, &r->occasion, text));
    HINT(m, "write >= or <= in place of =: a condition happens when it becomes true");
    return true;
}

/* Complains about a function of modes alone: it changes only at events and never passes 0, so its event would never
 * happen. */
static bool judge_functions(model *m, const model_rule *r)
{
    for (size_t k = 0; r->kind == RULE_ROOT && k < r->leaves; k++) {
        const unsigned deps = graph_deps(m->graph, r->leaf[k].value);
        if (flat(m, r, r->leaf[k].value)) return false;
        if (!(deps & DEP_MODE) || (deps & (DEP_TIME | (DEP_STATE & ~(unsigned)DEP_MODE)))) continue;
        char text[80];
        COMPLAIN(m, &r->occasion,
                 "%s never happens: its sides change only at events, by jumps, which do not pass through equality",
                 quote(m, &r->occasion, text));
        HINT(m, "write ==, >= or <= in place of =: a condition happens when it becomes true");
        return false;
    }
    return true;
}

bool effects_all(model *m)
{
    find_kept(m);
    for (uint32_t i = 0; i < m->rule_count; i++)
        if (!judge_functions(m, &m->rules[i]) || !place_values(m, &m->rules[i]) || !judge_assignments(m, &m->rules[i]))
            return false;
    return true;
}
