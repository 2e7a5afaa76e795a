/* Finds which log entries follow from a change, and runs them again. See vary.h. */
#include "lang/model/vary.h"

#include "lang/graph/graph_place.h"
#include "lang/model/table.h"
#include "lang/tape/tape.h"

#include <string.h>

struct vary {
    model *model;
    size_t count, *places;
    uint8_t *affected;
    vary_active *active;
    uint32_t active_count;
    double *kept; /* copies of cells that an entry overwrites but other lines set */
};

/* What is affected ------------------------------------------------------------------------------------------------- */

/* Marks the nodes in [from, to) whose value changes, in one pass, because operands come before the nodes that use
 * them. */
static void mark_nodes(const vary *v, uint8_t *changed, node from, node to)
{
    const graph *g = v->model->graph;
    for (node n = from; n < to; n++) {
        const graph_node *m = &g->nodes[n];
        int arity = operation_at(m->op)->arity;
        changed[n] = 0;
        if (m->op == OP_PARAM)
            changed[n] = v->affected[m->a];
        else if (m->op == OP_LOAD && g->arrays[g->references[m->a].array].space == SPACE_POOL)
            changed[n] = graph_marked(&g->arrays[g->references[m->a].array], v->affected);
        else if (m->op == OP_TABLE)
            changed[n] = graph_marked(&g->arrays[m->a], v->affected);
        else if (m->op == OP_SUM)
            changed[n] = changed[m->a] | (m->b ? changed[m->b] : 0);
        for (int i = 0; i < arity; i++) changed[n] |= changed[i == 0 ? m->a : i == 1 ? m->b : m->c];
    }
}

/* Returns the entry of a line; NULL: it is a number in a scalar slot. */
static const vary_entry *entry_of(const model *m, const struct vary_line *line)
{
    return line->value == VARY_ENTRY ? &m->log.entries[line->slot] : NULL;
}

static bool line_changes(const vary *v, const struct vary_line *line, const uint8_t *changed)
{
    const model *m = v->model;
    const vary_entry *e = entry_of(m, line);
    if (!e) return changed[line->value];
    if (e->table)
        return graph_marked(&m->arrays[e->table->list], v->affected) ||
               graph_marked(&m->arrays[e->table->points], v->affected);
    for (int k = 0; k < e->parts; k++)
        if (changed[e->outputs[k].value]) return true;
    return false;
}

/* Returns the place of component k of an entry: the beginning of its hull if it runs over an index, else its cell. */
static size_t place_of(const model *m, const vary_entry *e, int k)
{
    const output *o = &e->outputs[k];
    return o->loops ? m->arrays[o->to.array].base : graph_element(m->arrays, &o->to, NULL, m->ints);
}

static void mark_table(vary *v, const table *t)
{
    const array *a = &v->model->arrays[t->array];
    memset(v->affected + a->base, 1, (size_t)a->over->last[0] + 1);
}

static void mark_places(vary *v, const struct vary_line *line)
{
    const vary_entry *e = entry_of(v->model, line);
    if (!e) v->affected[line->slot] = 1;
    if (e && e->table) mark_table(v, e->table);
    for (int k = 0; e && k < e->parts; k++)
        memset(v->affected + place_of(v->model, e, k), 1, e->outputs[k].loops ? e->hull : 1);
}

/* Returns whether an entry is overridden. The first number tells, since a parameter or initial value is overridden as a
 * whole. */
static bool overridden(const model *m, const vary_entry *e)
{
    return m->overridden && !e->table && m->overridden[place_of(m, e, 0)];
}

static bool line_overridden(const model *m, const struct vary_line *line)
{
    const vary_entry *e = entry_of(m, line);
    return e ? overridden(m, e) : m->overridden && m->overridden[line->slot];
}

bool vary_override(model *m, size_t first, size_t count, bool yes)
{
    if (!m->overridden) m->overridden = arena_room(m->arena, m->pool_count + 1);
    if (!m->overridden) return false;
    memset(m->overridden + first, yes, count);
    return true;
}

/* Returns the largest node that a line computes. */
static node last_node(const model *m, const struct vary_line *line)
{
    const vary_entry *e = entry_of(m, line);
    node last = e ? 0 : line->value;
    for (int k = 0; e && k < e->parts; k++)
        if (e->outputs[k].value > last) last = e->outputs[k].value;
    return last;
}

/* Returns whether each array of an entry has a marked place: then the loads of its cells are marked already. */
static bool array_marked(const vary *v, const vary_entry *e)
{
    bool all = !e->table || graph_marked(&v->model->arrays[e->table->array], v->affected);
    for (int k = 0; k < e->parts; k++) all &= graph_marked(&v->model->arrays[e->outputs[k].to.array], v->affected);
    return all;
}

/* Extends `affected` to all places that depend on those marked so far, and collects the entries that compute them in
 * `active`, if it is not NULL. The node of a parameter is younger than the line that computes it, so nodes are marked
 * once, as far as each line needs them. But a load of an array's cell may be older than the line of another cell. */
static void follow(vary *v, uint8_t *changed)
{
    const model *m = v->model;
    const vary_log *log = &m->log;
    node upto = 0;
    for (uint32_t k = 0; k < log->count; k++) {
        const struct vary_line *line = &log->lines[k];
        const vary_entry *e = entry_of(m, line);
        const node need = last_node(m, line) + 1;
        if (need > upto) mark_nodes(v, changed, upto, need);
        upto = need > upto ? need : upto;
        if (line_overridden(m, line) || !line_changes(v, line, changed)) continue;
        const bool again = e && !array_marked(v, e);
        mark_places(v, line);
        if (again) mark_nodes(v, changed, 0, upto);
        if (v->active) v->active[v->active_count++] = (vary_active){.entry = vary_record_entry(v->model, line)};
    }
    mark_nodes(v, changed, upto, m->graph->count);
}

static const char *decision(const struct vary_frozen *f) { return f->what ? f->what : "a size or an index"; }

bool vary_decides(const model *m, size_t first, size_t count, const motus_allocator *allocator, const char **what)
{
    const size_t nodes = m->graph->count;
    uint8_t *room = take(allocator, m->pool_count + nodes + 2, 1);
    *what = NULL;
    if (!room) return false;
    uint8_t *changed = room + m->pool_count + 1;
    vary v = {.model = (model *)m, .affected = room};
    memset(room + first, 1, count);
    follow(&v, changed);
    for (uint32_t k = 0; k < m->log.frozen_count; k++) {
        const struct vary_frozen *f = &m->log.frozen[k];
        if (changed[f->n] && !*what) *what = decision(f);
    }
    give(allocator, room);
    return true;
}

uint8_t *vary_follows(model *m, const array *of)
{
    vary v = {.model = m, .affected = arena_take(m->arena, m->pool_count + 1)};
    uint8_t *changed = arena_room(m->arena, m->graph->count + 1);
    if (m->arena->failed || !changed) return NULL;
    size_t count = 1;
    for (int d = 0; d < of->dims; d++) count *= (size_t)(of->over->last[d] - of->over->first[d] + 1);
    memset(v.affected + of->base, 1, count);
    follow(&v, changed);
    return v.affected;
}

bool vary_changed(const model *m, const uint8_t *affected, const motus_allocator *allocator, uint8_t **out)
{
    uint8_t *changed = take(allocator, m->graph->count + 1, 1);
    vary v = {.model = (model *)m, .affected = *out = take(allocator, m->pool_count + 1, 1)};
    if (changed && *out) {
        for (size_t k = 0; k < m->pool_count; k++)
            v.affected[k] = (affected && affected[k]) || (m->overridden && m->overridden[k]);
        follow(&v, changed);
    }
    const bool done = changed && *out;
    if (!done) give(allocator, *out);
    give(allocator, changed);
    return done;
}

static motus_status refuse(const model *m, const uint8_t *changed, bool own_step, bool own_until, motus_error *err)
{
    for (uint32_t k = 0; k < m->log.frozen_count; k++) {
        const struct vary_frozen *f = &m->log.frozen[k];
        bool step = f->what && !strcmp(f->what, "step"), until = f->what && !strcmp(f->what, "until");
        if (!changed[f->n] || (step && own_step) || (until && own_until)) continue;
        fail(err, MOTUS_ARGUMENT, "a number that varies decides %s%s, which must be the same for all trajectories",
             step || until ? "the " : "", until ? "end" : decision(f));
        if (step || until) hint(err, "give `step` of the definition and `until` of the definition");
        return MOTUS_ARGUMENT;
    }
    return MOTUS_OK;
}

motus_status vary_create(model *m, const size_t *places, size_t count, bool own_step, bool own_until, vary **out,
                         motus_error *err)
{
    arena *a = m->arena;
    vary *v = arena_take(a, sizeof *v);
    if (a->failed) return fail(err, MOTUS_MEMORY, "no memory for what varies");
    *v = (vary){.model = m,
                .count = count,
                .places = arena_room(a, (count + 1) * sizeof *places),
                .affected = arena_room(a, m->pool_count + 1),
                .active = arena_room(a, (m->log.count + 1) * sizeof *v->active)};
    size_t nodes = m->graph->count;
    uint8_t *changed = arena_room(a, nodes + 1);
    if (!v->places || !v->affected || !v->active || !changed)
        return fail(err, MOTUS_MEMORY, "no memory for what varies");
    for (size_t k = 0; k < count; k++) {
        v->places[k] = places[k];
        v->affected[places[k]] = 1;
    }
    follow(v, changed);
    if (a->failed) return fail(err, MOTUS_MEMORY, "no memory for what varies");
    size_t largest = 0;
    for (uint32_t k = 0; k < v->active_count; k++) {
        const vary_entry *e = v->active[k].entry;
        if (e->map && e->hull * (size_t)e->parts > largest) largest = e->hull * (size_t)e->parts;
    }
    motus_status status = refuse(m, changed, own_step, own_until, err);
    if (status != MOTUS_OK) return status;
    for (uint32_t k = 0; k < v->active_count; k++) {
        vary_active *e = &v->active[k];
        if (e->entry->table) continue;
        e->program = program_create(m->graph, e->entry->outputs, (size_t)e->entry->parts);
        e->tape = e->program && !a->failed ? tape_create(a, e->program) : NULL;
    }
    v->kept = arena_room(a, (largest + 1) * sizeof *v->kept);
    if (a->failed) return fail(err, MOTUS_MEMORY, "no memory for what varies");
    *out = v;
    return MOTUS_OK;
}

/* Computing again -------------------------------------------------------------------------------------------------- */

static void put_values(const vary *v, const double *values)
{
    for (size_t k = 0; k < v->count; k++) v->model->pool[v->places[k]] = values[k];
}

bool vary_apply(vary *v, const double *values)
{
    model *m = v->model;
    const binding b = {m->arrays, m->ints, m->pool};
    double *base[SPACES] = {[SPACE_OUT] = m->pool};
    put_values(v, values);
    for (uint32_t k = 0; k < v->active_count; k++) {
        const vary_entry *e = v->active[k].entry;
        const size_t all = e->map ? e->hull * (size_t)e->parts : 0;
        if (overridden(m, e)) continue;
        if (e->table) {
            table_fill(m, e->table);
            continue;
        }
        memcpy(v->kept, m->pool + e->base, all * sizeof(double));
        if (!tape_bind(v->active[k].tape, &b)) return false;
        tape_run(v->active[k].tape, 0, base);
        for (size_t i = 0; i < all; i++)
            if (e->map[i % e->hull] > e->rank) m->pool[e->base + i] = v->kept[i];
        put_values(v, values);
    }
    model_start_state(m);
    return true;
}

const vary_active *vary_entries(const vary *v, uint32_t *count)
{
    *count = v->active_count;
    return v->active;
}

const uint8_t *vary_affected(const vary *v) { return v->affected; }
