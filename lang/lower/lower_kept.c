/* What events keep (lang/model/kept.h). A call becomes a load of a mode that the event assigns; the counter of events
 * chooses NaN before the event. Equal calls share a mode. */
#include "lang/lower/lower_parts.h"

#include "lang/lower/resolve.h"
#include "lang/model/kept.h"

#include <math.h>
#include <string.h>

static node load(lowering *l, const model_keep *k, int component)
{
    reference r = {.array = (uint16_t)(k->array + component)};
    return graph_load(l->model->graph, &r);
}

/* Finds or makes the mode that keeps these nodes. NULL: there was a complaint, or no memory. */
static const model_keep *keep(lowering *l, const tree *t, uint32_t rule, int64_t which, const value *v)
{
    model *m = l->model;
    const int parts = v && v->count ? v->count : 1;
    for (model_keep *k = m->keeps; k; k = k->next)
        if (k->rule == rule && k->which == which &&
            (!v || (k->components == v->count && !memcmp(k->is, v->item, (size_t)parts * sizeof *k->is))))
            return k;
    if (m->keep_count == MODEL_KEEPS_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, &t->at, "events keep at most %d numbers", MODEL_KEEPS_MAX);
        return NULL;
    }
    model_keep *k = arena_take(m->arena, sizeof *k);
    *k = (model_keep){.rule = rule, .which = which, .components = v ? v->count : 0, .at = t->at};
    k->is = arena_room(m->arena, (size_t)parts * sizeof *k->is);
    if (!k->is || !model_take_arrays(m, parts, &k->array)) return NULL;
    if (v) memcpy(k->is, v->item, (size_t)parts * sizeof *k->is);
    for (int i = 0; i < parts; i++) {
        graph_shape(m->arena, &m->arrays[k->array + i], SPACE_X, 0, 0, NULL, NULL);
        m->arrays[k->array + i].mode = true;
    }
    if (m->last_keep)
        m->last_keep->next = k;
    else
        m->keeps = k;
    m->last_keep = k;
    m->keep_count++;
    return k;
}

/* Reads the number of the event that a call is about. */
static bool find_which(lowering *l, const tree *t, int64_t *which)
{
    const tree *written = kept_which(l->model, t);
    double k = 1;
    if (written && kept_is_last(written)) {
        *which = KEEP_LAST;
        return true;
    }
    if (written && !resolve_constant(l->model, written, "the number of an event", &k)) return false;
    if (k < 1 || k != floor(k) || k > 9e15) {
        source_complain(&l->model->source, MOTUS_ARGUMENT, &written->at,
                        "events are numbered 1, 2, 3 …, and this is %g", k);
        HINT(l, "the latest one is `last`");
        return false;
    }
    *which = (int64_t)k;
    return true;
}

/* Returns what an event keeps: the time, or an expression of the state on its arrival. */
static value kept_value(lowering *l, const tree *t, const model_rule *rule)
{
    const tree *of = kept_expression(l->model, t);
    if (!of) return scalar(l, graph_time(l->model->graph));
    lowering inner = *l;
    inner.place = PLACE_EVENT;
    inner.what = "what an event keeps";
    inner.levels = rule->statement->loop_count; /* sums open levels after the indices of the event */
    inner.chain++;
    value v = lower_numbers(&inner, of);
    if (failed(l)) return wrong(l);
    for (int k = 0; k < (v.count ? v.count : 1); k++)
        if (graph_deps(l->model->graph, v.item[k]) & DEP_LEVELS) {
            COMPLAIN(l, &of->at, "what an event keeps cannot depend on an index");
            HINT(l, "name the cell: x[1]");
            return wrong(l);
        }
    return v;
}

value lower_kept(lowering *l, const tree *t)
{
    model *m = l->model;
    graph *g = m->graph;
    char text[80];
    if (l->place == PLACE_CONSTANT || l->place == PLACE_EXACT) {
        COMPLAIN(l, &t->at, "%s cannot depend on an event, as %s does", l->what ? l->what : "this",
                 quote(l, &t->at, text));
        return wrong(l);
    }
    const model_rule *rule = kept_rule(m, t);
    const uint32_t number = (uint32_t)(rule - m->rules);
    const model_keep *counter = keep(l, t, number, KEEP_COUNT, NULL);
    if (!counter) return wrong(l);
    const node count = load(l, counter, 0);
    if (kept_call(m, t) == KEPT_COUNT) return scalar(l, count);
    int64_t which;
    if (!find_which(l, t, &which)) return wrong(l);
    const value is = kept_value(l, t, rule);
    if (failed(l)) return wrong(l);
    const model_keep *k = keep(l, t, number, which, &is);
    if (!k) return wrong(l);
    const node happened = binary(l, OP_GE, count, graph_const(g, which == KEEP_LAST ? 1 : (double)which));
    value v = vector(l, is.count);
    for (int i = 0; i < (v.count ? v.count : 1); i++)
        v.item[i] = graph_op(g, OP_SELECT, happened, load(l, k, i), graph_const(g, NAN));
    return v;
}
