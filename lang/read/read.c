/* Reads a model from its text, by the steps of read_steps.h. */
#include "lang/read/read.h"

#include "lang/lower/lower.h"
#include "lang/lower/resolve.h"
#include "lang/lower/start.h"
#include "lang/model/sliding.h"
#include "lang/read/read_steps.h"
#include "lang/read/verify.h"

#include <string.h>

static bool constants(model *m)
{
    /* parameters get their slots before their shapes are known: one for each name, and two for each comma, which may
     * stand in a vector */
    m->scalar_slots = m->definition_count + 8;
    for (uint32_t t = 0; t < m->source.count; t++)
        for (uint32_t i = 0; i < m->source.texts[t].length; i++)
            m->scalar_slots += m->source.texts[t].bytes[i] == ',' ? 2 : 0;
    size_t first;
    m->slot_owner = arena_room(m->arena, m->scalar_slots * sizeof *m->slot_owner);
    if (!m->slot_owner || !model_take_numbers(m, m->scalar_slots, &first) || !resolve_start_time(m)) return false;
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (!resolve_definition(m, &m->definitions[i])) return false;
    for (uint32_t i = 0; i < m->state_count; i++)
        if (!start_state(m, &m->states[i])) return false;
    return true;
}

/* Gives back the trees, which took more memory than the rest: nothing is lowered any more. */
static void forget_trees(model *m)
{
    m->arena->failed |= m->source.trees->failed;
    arena_release(m->source.trees);
    m->source.trees = NULL;
    for (uint32_t i = 0; i < m->statements.count; i++) {
        statement *s = &m->statements.item[i];
        s->value = s->applied = NULL;
        s->loops = NULL;
        if (s->replaced) s->replaced->value = NULL;
        if (s->kind != STATEMENT_METHOD) s->index = NULL;
    }
}

/* Makes the equations read the sides of their switches. */
static void locate(model *m)
{
    const bool exact = m->traits.has_exact;
    sliding_locate(m);
    analysis_traits(m);
    m->traits.has_exact = exact;
}

static motus_status build(model *m, const motus_text_def *def, const read_how *how, read_method method)
{
    const bool lowered = collect_all(m, def) && rule_names_all(m) && mode_find_all(m) && mode_add_sides(m, how) &&
                         classify_all(m) && names_all(m) && graph_reserve(m->graph, m->statements.operations + 64) &&
                         model_reserve_arrays(m, 8 * m->state_count + 64) && constants(m) && settings_all(m, method) &&
                         mode_shape_all(m) && layout_all(m) && equations_all(m) && mode_observe_all(m) && when_all(m) &&
                         keep_all(m) && effects_all(m) && equations_start(m);
    forget_trees(m);
    if (lowered) analysis_all(m);
    if (!source_failed(&m->source) && !m->graph->too_large && verify_claims(m) == MOTUS_MEMORY) m->arena->failed = true;
    if (lowered && !m->source.failed && m->side_count) locate(m);
    if (m->source.failed) return m->source.status;
    if (m->arena->failed) return MOTUS_MEMORY;
    if (m->graph->too_large)
        return fail(m->source.error, MOTUS_LIMIT, "the model's expressions are too large: more than %d operations",
                    GRAPH_NODES_MAX);
    return MOTUS_OK;
}

/* What can be added to the text of a model. */
typedef struct added {
    const char *what, *file;
    bool event;
} added;
static const added kinds[] = {{"a setting", "motus_text_def.set", false},
                              {"an event", "motus_text_def.when", true},
                              {"a quantity", "motus_text_def.define", false}};

motus_status read_model(arena *a, const motus_text_def *def, const read_how *how, read_method method, model **out,
                        motus_error *err)
{
    *out = NULL;
    if (!def->text) return fail(err, MOTUS_ARGUMENT, "the definition has no text");
    size_t length = def->length == SIZE_MAX ? strlen(def->text) : def->length;
    if (length > SOURCE_BYTES_MAX)
        return fail(err, MOTUS_LIMIT, "the model has %zu bytes; at most %d are read", length, SOURCE_BYTES_MAX);
    model *m = arena_room(a, sizeof *m);
    if (!m) return fail(err, MOTUS_MEMORY, "no memory for the model");
    m->arena = a;
    m->lower = lower_tree;
    m->time = "t";
    m->draft = def->draft > 0;
    const size_t sets = def->set_count, whens = sets + def->when_count, texts = 1 + whens + def->define_count;
    m->source = (source){.arena = a,
                         .error = err,
                         .count = (uint32_t)texts,
                         .nudged = how->nudged,
                         .varied = how->varied,
                         .varied_count = how->varied_count};
    m->source.texts = arena_room(a, texts * sizeof *m->source.texts);
    m->graph = graph_create(a);
    if (m->graph && how->nudged) graph_keep_typed(m->graph);
    if (!m->source.texts || !m->graph || a->failed) return fail(err, MOTUS_MEMORY, "no memory for the model");
    m->source.texts[0] = (struct source_text){def->text, (uint32_t)length, def->file, false};
    for (size_t i = 0; i + 1 < texts; i++) {
        const added *const a = &kinds[i < sets ? 0 : i < whens ? 1 : 2];
        const char *const line = i < sets ? def->set[i] : i < whens ? def->when[i - sets] : def->define[i - whens];
        const size_t n = strlen(line);
        if (n > SOURCE_BYTES_MAX)
            return fail(err, MOTUS_LIMIT, "%s has %zu bytes; at most %d are read", a->what, n, SOURCE_BYTES_MAX);
        m->source.texts[i + 1] = (struct source_text){line, (uint32_t)n, a->file, a->event};
    }
    arena trees;
    arena_init(&trees, &a->allocator);
    m->source.trees = &trees;
    motus_status status = build(m, def, how, method);
    if (status != MOTUS_OK) return status == MOTUS_MEMORY ? fail(err, MOTUS_MEMORY, "no memory for the model") : status;
    m->source.error = NULL; /* the error is the caller's, and does not outlive this call */
    *out = m;
    return MOTUS_OK;
}
