/* Entries of a model's log. See vary_record.h. */
#include "lang/model/vary_record.h"

static vary_entry *new_entry(model *m)
{
    vary_log *log = &m->log;
    if (log->count == log->room) {
        uint32_t room = log->room ? 2 * log->room : 16;
        vary_entry *more = arena_replace(m->arena, log->entries, log->room * sizeof *more, room * sizeof *more);
        if (!more) return NULL;
        log->entries = more;
        log->room = room;
    }
    return &log->entries[log->count];
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
            graph_shape(&m->arrays[*array + k], SPACE_OUT, base + (size_t)k * hull, dims, first, last);
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
    m->log.count++;
    return true;
}

bool vary_record_scalar(model *m, node n, uint32_t slot)
{
    const int64_t first = 0, last = (int64_t)m->scalar_slots - 1;
    const output target = {
        .to = {.dims = 1, .at = {{.level = -1, .slot = -1, .modulus = -1, .literal = (int32_t)slot}}}};
    return vary_record(m, &target, &n, 1, 0, 1, &first, &last, m->scalar_slots, NULL, 0, &m->log.scalars);
}

void vary_freeze(model *m, node n, const char *what)
{
    vary_log *log = &m->log;
    if (!(graph_deps(m->graph, n) & DEP_PARAM)) return;
    if (log->frozen_count == log->frozen_room) {
        uint32_t room = log->frozen_room ? 2 * log->frozen_room : 16;
        struct vary_frozen *more =
            arena_replace(m->arena, log->frozen, log->frozen_room * sizeof *more, room * sizeof *more);
        if (!more) return;
        log->frozen = more;
        log->frozen_room = room;
    }
    log->frozen[log->frozen_count++] = (struct vary_frozen){n, what};
}
