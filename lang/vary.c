/* See vary.h. */
#include "lang/vary.h"

#include "lang/operation.h"
#include "lang/tape.h"

#include <string.h>

struct vary {
    model *model;
    size_t count, *places;
    uint8_t *affected;
    vary_active *active;
    uint32_t active_count;
    double *kept;                    /* room for the cells that an entry must not touch */
};

/* ---- the log ---- */

static vary_entry *new_entry(model *m)
{
    vary_log *log = &m->log;
    if (log->count == log->room) {
        uint32_t room = log->room ? 2 * log->room : 16;
        vary_entry *more = arena_grow(m->arena, log->entries, log->room * sizeof *more, room * sizeof *more);
        if (!more)
            return NULL;
        log->entries = more;
        log->room = room;
    }
    return &log->entries[log->count];
}

bool vary_record(model *m, const output *target, const node *values, int parts, size_t base, int dims, const int64_t first[], const int64_t last[], size_t hull,
                 const uint8_t *map, uint8_t rank, uint16_t *array)
{
    unsigned deps = 0;
    for (int k = 0; k < parts; k++)
        deps |= graph_deps(m->graph, values[k]);
    if (!(deps & DEP_PARAM))
        return true;
    if (!*array) {
        if (!resolve_arrays(m, parts, array))
            return false;
        for (int k = 0; k < parts; k++)
            resolve_shape(&m->arrays[*array + k], SPACE_OUT, base + (size_t)k * hull, dims, first, last);
        ++*array;
    }
    vary_entry *e = new_entry(m);
    output *o = e ? arena_room(m->arena, (size_t)parts * sizeof *o) : NULL;
    if (!o)
        return false;
    for (int k = 0; k < parts; k++) {
        o[k] = *target;
        o[k].value = values[k];
        o[k].to.array = (uint16_t)(*array - 1 + k);
    }
    *e = (vary_entry){.outputs = o, .parts = parts, .base = base, .hull = hull, .map = target->loops ? map : NULL, .rank = rank};
    m->log.count++;
    return true;
}

bool vary_record_scalar(model *m, node n, uint32_t slot)
{
    const int64_t first = 0, last = (int64_t)m->scalar_slots - 1;
    const output target = {.to = {.dims = 1, .at = {{.level = -1, .slot = -1, .modulus = -1, .literal = (int32_t)slot}}}};
    return vary_record(m, &target, &n, 1, 0, 1, &first, &last, m->scalar_slots, NULL, 0, &m->log.scalars);
}

void vary_freeze(model *m, node n, const char *what)
{
    vary_log *log = &m->log;
    if (!(graph_deps(m->graph, n) & DEP_PARAM))
        return;
    if (log->frozen_count == log->frozen_room) {
        uint32_t room = log->frozen_room ? 2 * log->frozen_room : 16;
        struct vary_frozen *more = arena_grow(m->arena, log->frozen, log->frozen_room * sizeof *more, room * sizeof *more);
        if (!more)
            return;
        log->frozen = more;
        log->frozen_room = room;
    }
    log->frozen[log->frozen_count++] = (struct vary_frozen){n, what};
}

/* ---- what is affected ---- */

/* Marks every node whose value changes. Operands stand before what uses them. */
static void mark_nodes(const vary *v, uint8_t *changed)
{
    const graph *g = v->model->graph;
    for (node n = 0; n < g->count; n++) {
        const graph_node *m = &g->nodes[n];
        int arity = operation_at(m->op)->arity;
        changed[n] = 0;
        if (m->op == OP_PARAM)
            changed[n] = v->affected[m->a];
        else if (m->op == OP_LOAD && g->arrays[g->references[m->a].array].space == SPACE_POOL)
            changed[n] = graph_marked(&g->arrays[g->references[m->a].array], v->affected);
        else if (m->op == OP_SUM)
            changed[n] = changed[m->a] | (m->b ? changed[m->b] : 0);
        for (int i = 0; i < arity; i++)
            changed[n] |= changed[i == 0 ? m->a : i == 1 ? m->b : m->c];
    }
}

static bool entry_changes(const vary_entry *e, const uint8_t *changed)
{
    for (int k = 0; k < e->parts; k++)
        if (changed[e->outputs[k].value])
            return true;
    return false;
}

/* The places an entry writes: all of its hull where it runs over an index, else its cell. */
static void mark_places(vary *v, const vary_entry *e)
{
    const model *m = v->model;
    for (int k = 0; k < e->parts; k++) {
        const output *o = &e->outputs[k];
        const array *a = &m->arrays[o->to.array];
        int64_t at = (int64_t)a->base;
        for (int d = 0; d < o->to.dims && !o->loops; d++)
            at += (o->to.at[d].literal + (o->to.at[d].slot >= 0 ? m->ints[o->to.at[d].slot] : 0) - a->first[d]) * a->stride[d];
        size_t count = o->loops ? e->hull : 1;
        memset(v->affected + at, 1, count);
    }
}

/* From the places that are affected to all that follows from them; the entries among it to `active`, where there is one. */
static void follow(vary *v, uint8_t *changed)
{
    const vary_log *log = &v->model->log;
    mark_nodes(v, changed);
    for (uint32_t k = 0; k < log->count; k++) {
        if (!entry_changes(&log->entries[k], changed))
            continue;
        mark_places(v, &log->entries[k]);
        mark_nodes(v, changed);
        if (v->active)
            v->active[v->active_count++] = (vary_active){.entry = &log->entries[k]};
    }
}

static const char *decision(const struct vary_frozen *f) { return f->what ? f->what : "a size or an index"; }

bool vary_decides(const model *m, size_t first, size_t count, const motus_allocator *allocator, const char **what)
{
    const size_t nodes = m->graph->count;
    uint8_t *room = take(allocator, m->pool_count + nodes + 2, 1);
    *what = NULL;
    if (!room)
        return false;
    uint8_t *changed = room + m->pool_count + 1;
    vary v = {.model = (model *)m, .affected = room};
    memset(room + first, 1, count);
    follow(&v, changed);
    for (uint32_t k = 0; k < m->log.frozen_count; k++) {
        const struct vary_frozen *f = &m->log.frozen[k];
        if (changed[f->n] && !*what)
            *what = decision(f);
    }
    give(allocator, room);
    return true;
}

static motus_status refuse(const model *m, const uint8_t *changed, bool own_step, bool own_until, motus_error *err)
{
    for (uint32_t k = 0; k < m->log.frozen_count; k++) {
        const struct vary_frozen *f = &m->log.frozen[k];
        bool step = f->what && !strcmp(f->what, "step"), until = f->what && !strcmp(f->what, "until");
        if (!changed[f->n] || (step && own_step) || (until && own_until))
            continue;
        fail(err, MOTUS_ARGUMENT, "what varies decides %s%s, which must be the same for all trajectories", step || until ? "the " : "",
             until ? "end" : decision(f));
        if (step || until)
            hint(err, "give a step and an end of its own: --step and --until");
        return MOTUS_ARGUMENT;
    }
    return MOTUS_OK;
}

motus_status vary_create(model *m, const size_t *places, size_t count, bool own_step, bool own_until, vary **out, motus_error *err)
{
    arena *a = m->arena;
    vary *v = arena_take(a, sizeof *v);
    if (a->failed)
        return fail(err, MOTUS_MEMORY, "no memory for what varies");
    *v = (vary){.model = m, .count = count, .places = arena_room(a, (count + 1) * sizeof *places),
                .affected = arena_room(a, m->pool_count + 1),
                .active = arena_room(a, (m->log.count + 1) * sizeof *v->active)};
    size_t nodes = m->graph->count;
    uint8_t *changed = arena_room(a, nodes + 1);
    if (!v->places || !v->affected || !v->active || !changed)
        return fail(err, MOTUS_MEMORY, "no memory for what varies");
    memset(v->affected, 0, m->pool_count + 1);
    for (size_t k = 0; k < count; k++) {
        v->places[k] = places[k];
        v->affected[places[k]] = 1;
    }
    follow(v, changed);
    size_t largest = 0;
    for (uint32_t k = 0; k < v->active_count; k++) {
        const vary_entry *e = v->active[k].entry;
        if (e->map && e->hull * (size_t)e->parts > largest)
            largest = e->hull * (size_t)e->parts;
    }
    motus_status status = refuse(m, changed, own_step, own_until, err);
    if (status != MOTUS_OK)
        return status;
    for (uint32_t k = 0; k < v->active_count; k++) {
        vary_active *e = &v->active[k];
        e->program = program_create(m->graph, e->entry->outputs, (size_t)e->entry->parts);
        e->tape = e->program && !a->failed ? tape_create(a, e->program) : NULL;
    }
    v->kept = arena_room(a, (largest + 1) * sizeof *v->kept);
    if (a->failed)
        return fail(err, MOTUS_MEMORY, "no memory for what varies");
    *out = v;
    return MOTUS_OK;
}

/* ---- doing it ---- */

static void put_values(const vary *v, const double *values)
{
    for (size_t k = 0; k < v->count; k++)
        v->model->pool[v->places[k]] = values[k];
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
        memcpy(v->kept, m->pool + e->base, all * sizeof(double));
        if (!tape_bind(v->active[k].tape, &b))
            return false;
        tape_run(v->active[k].tape, 0, base);
        for (size_t i = 0; i < all; i++)
            if (e->map[i % e->hull] > e->rank)
                m->pool[e->base + i] = v->kept[i];
        put_values(v, values);
    }
    resolve_start_state(m);
    return true;
}

const vary_active *vary_entries(const vary *v, uint32_t *count)
{
    *count = v->active_count;
    return v->active;
}

const uint8_t *vary_affected(const vary *v) { return v->affected; }
