/* Checks what a model claims, when it is read and when its numbers change. See verify.h. */
#include "lang/read/verify.h"

#include "lang/graph/graph_walk.h"

/* Returns how many nodes the formulas have. */
static uint32_t size_of(model *m, const output *outputs, size_t count)
{
    uint32_t nodes = 0;
    for (size_t k = 0; k < count && nodes <= VERIFY_NODES_MAX; k++) {
        graph_walk w;
        if (!graph_order(m->graph, &outputs[k].value, 1, 0, true, &w)) return 0;
        nodes += w.count;
        give(&m->arena->allocator, w.nodes);
    }
    return nodes;
}

static bool make_tapes(model *m)
{
    verify *c = m->verify = arena_take(m->arena, sizeof *c);
    c->nodes = size_of(m, m->accel, m->accel_count) + size_of(m, m->exact, m->exact_count);
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (m->definitions[i].kind == DEFINED_INVARIANT)
            c->nodes += size_of(m, m->definitions[i].outputs, m->definitions[i].output_count);
    c->bounded = c->nodes <= VERIFY_NODES_MAX;
    c->boundary = m->boundary_count ? verify_tape(m, m->boundary, m->boundary_count) : NULL;
    c->force = verify_tape(m, m->accel, m->accel_count);
    if (c->bounded)
        c->force_rounding = verify_tape(m, verify_rounding(m, m->accel, m->accel_count, verify_leaf), m->accel_count);
    if (m->exact_given && !verify_exact_make(m)) return false;
    return verify_invariant_make(m) && !source_failed(&m->source);
}

/* Makes the checks. The graph keeps none of their formulas, since other code counts the operations of a model. */
static bool make(model *m)
{
    const uint32_t nodes = m->graph->count;
    const bool made = make_tapes(m);
    if (!m->graph->too_large) graph_cut(m->graph, nodes);
    return made;
}

static bool claims(const model *m)
{
    bool any = m->exact_given;
    for (uint32_t i = 0; i < m->definition_count; i++) any |= m->definitions[i].kind == DEFINED_INVARIANT;
    return any;
}

motus_status verify_claims(model *m)
{
    if (!claims(m)) return MOTUS_OK;
    if (!m->verify && !make(m)) return MOTUS_MEMORY;
    const verify *c = m->verify;
    tape *const tapes[] = {c->boundary, c->force, c->force_rounding};
    if (!verify_bind(m, tapes, sizeof tapes / sizeof *tapes)) return MOTUS_MEMORY;
    if (m->source.nudged) return MOTUS_OK; /* its claims are those of the text as written */
    return m->exact_given ? verify_exact(m) : MOTUS_OK;
}

motus_status verify_again(model *m, motus_error *err)
{
    if (!m->verify) return MOTUS_OK;
    m->source.error = err;
    const motus_status status = verify_claims(m);
    m->source.error = NULL;
    m->source.failed = false; /* the text has no error: the numbers contradict its claims */
    return status == MOTUS_MEMORY ? fail(err, MOTUS_MEMORY, "no memory to check the model's claims") : status;
}
