/* Writes and reads the log of a model. */
#include "lang/model/vary_record.h"

static bool add_line(model *m, node value, uint32_t slot)
{
    vary_log *log = &m->log;
    if (!arena_more(m->arena, &log->lines, log->count, &log->room, sizeof *log->lines)) return false;
    log->lines[log->count++] = (struct vary_line){value, slot};
    return true;
}

static vary_entry *new_entry(model *m)
{
    vary_log *log = &m->log;
    const bool fits = arena_more(m->arena, &log->entries, log->entry_count, &log->entry_room, sizeof *log->entries);
    return fits ? &log->entries[log->entry_count] : NULL;
}

bool vary_record(model *m, const output *target, const node *values, int parts, size_t base, int dims,
                 const int64_t first[], const int64_t last[], size_t hull, const uint8_t *map, uint8_t rank,
                 uint16_t *array)
{
    unsigned deps = 0;
    for (int k = 0; k < parts; k++) deps |= graph_deps(m->graph, values[k]);
    if (!(deps & DEP_PARAM)) return true;
    if (!*array) {
        if (!model_take_arrays(m, parts, array)) return false;
        for (int k = 0; k < parts; k++)
            graph_shape(m->arena, &m->arrays[*array + k], SPACE_OUT, base + (size_t)k * hull, dims, first, last);
        ++*array;
    }
    vary_entry *e = new_entry(m);
    output *o = e ? arena_room(m->arena, (size_t)parts * sizeof *o) : NULL;
    if (!o) return false;
    for (int k = 0; k < parts; k++) {
        o[k] = *target;
        o[k].value = values[k];
        o[k].to.array = (uint16_t)(*array - 1 + k);
    }
    *e = (vary_entry){
        .outputs = o, .parts = parts, .base = base, .hull = hull, .map = target->loops ? map : NULL, .rank = rank};
    return add_line(m, VARY_ENTRY, m->log.entry_count++);
}

bool vary_record_scalar(model *m, node n, uint32_t slot)
{
    if (!(graph_deps(m->graph, n) & DEP_PARAM)) return true;
    if (!m->log.scalars) {
        const int64_t first = 0, last = (int64_t)m->scalar_slots - 1;
        if (!model_take_arrays(m, 1, &m->log.scalars)) return false;
        graph_shape(m->arena, &m->arrays[m->log.scalars++], SPACE_OUT, 0, 1, &first, &last);
    }
    return add_line(m, n, slot);
}

bool vary_record_table(model *m, const struct table *t)
{
    vary_entry *e = new_entry(m);
    if (!e) return false;
    *e = (vary_entry){.table = t};
    return add_line(m, VARY_ENTRY, m->log.entry_count++);
}

const vary_entry *vary_record_entry(model *m, const struct vary_line *line)
{
    if (line->value == VARY_ENTRY) return &m->log.entries[line->slot];
    vary_entry *e = arena_room(m->arena, sizeof *e);
    output *o = arena_room(m->arena, sizeof *o);
    if (!e || !o) return NULL;
    *o = (output){.value = line->value,
                  .to = {.array = (uint16_t)(m->log.scalars - 1),
                         .dims = 1,
                         .at = {{.level = -1, .slot = -1, .modulus = -1, .literal = (int32_t)line->slot}}}};
    *e = (vary_entry){.outputs = o, .parts = 1, .hull = m->scalar_slots};
    return e;
}

void vary_freeze(model *m, node n, const char *what)
{
    vary_log *log = &m->log;
    if (!(graph_deps(m->graph, n) & DEP_PARAM)) return;
    if (!arena_more(m->arena, &log->frozen, log->frozen_count, &log->frozen_room, sizeof *log->frozen)) return;
    log->frozen[log->frozen_count++] = (struct vary_frozen){n, what};
}
