/* The hull of a state's indices, and its cells that have an equation or a boundary line. */
#include "lang/lower/hull.h"

#include "lang/lower/lower_ghost.h"

bool hull_indices_wrong(model *m, const model_state *s, span at)
{
    static const char *const indices[] = {"", "[i]", "[i,j]", "[i,j,k]", "[i,j,k,l]"};
    if (s->dims == 0)
        source_complain(&m->source, MOTUS_SHAPE, &at, "%s is not a family and has no index", s->name);
    else
        source_complain(&m->source, MOTUS_SHAPE, &at, "%s is a family and needs %d ind%s", s->name, s->dims,
                        s->dims == 1 ? "ex" : "ices");
    source_hint(&m->source, "by its equation in line %d it is written %s%s", source_line(&m->source, &s->at), s->name,
                indices[s->dims]);
    return false;
}

#define EACH_LINE(m, s, one)                                                                  \
    for (const statement *one = (s)->line ? &(m)->statements.item[(s)->line - 1] : NULL; one; \
         one = one->next ? &(m)->statements.item[one->next - 1] : NULL)

bool hull_mark(model *m, const model_state *s, const statement *from, const int64_t first[], const int64_t last[],
               uint8_t *map, uint8_t as, bool once)
{
    int64_t at[MAX_DIMS];
    for (int d = 0; d < s->dims; d++) at[d] = first[d];
    do {
        const size_t offset = model_cell(s->dims, s->first, s->last, at);
        if (once && map[offset]) {
            char name[MOTUS_NAME_MAX + 64];
            model_state_name(s, offset, 0, false, name, sizeof name);
            source_complain(&m->source, MOTUS_NAME, &from->at, "%s%.*s has two equations or boundary lines",
                            s->components ? "a component of " : "", 100, name);
            source_hint(&m->source, "each index has exactly one equation or boundary line");
            return false;
        }
        if (map[offset] < as) map[offset] = as;
    } while (model_next_cell(s->dims, first, last, at));
    return true;
}

static bool gather_hull(model *m, model_state *s, bool boundary)
{
    bool any = false;
    EACH_LINE(m, s, one)
    {
        if (one->kind != STATEMENT_EQUATION && !(boundary && one->kind == STATEMENT_DEFINITION)) continue;
        if ((int)one->index_count != s->dims) { return hull_indices_wrong(m, s, one->at); }
        int64_t first[MAX_DIMS], last[MAX_DIMS];
        if (!lower_places(m, one, first, last)) return false;
        for (int d = 0; d < s->dims; d++) {
            int64_t *lo = boundary ? &s->first[d] : &s->eq_first[d], *hi = boundary ? &s->last[d] : &s->eq_last[d];
            if (!any || first[d] < *lo) *lo = first[d];
            if (!any || last[d] > *hi) *hi = last[d];
        }
        any = true;
    }
    return true;
}

static bool mark_owners(model *m, model_state *s)
{
    EACH_LINE(m, s, one)
    {
        if (one->kind != STATEMENT_EQUATION && one->kind != STATEMENT_DEFINITION) continue;
        int64_t first[MAX_DIMS], last[MAX_DIMS];
        if (!lower_places(m, one, first, last)) return false;
        if (!hull_mark(m, s, one, first, last, s->owner, one->kind == STATEMENT_EQUATION ? 1 : 2, true)) return false;
        if (lower_is_ghost(m, one) && !lower_add_ghost(m, s, one, first, last)) return false;
    }
    size_t count = 0;
    bool gap = false;
    for (size_t k = 0; k < s->hull; k++) {
        if (s->owner[k] == 1) gap |= k != count++;
    }
    s->cells.count = count;
    if (!gap) return true;
    s->cells.offset = arena_room(m->arena, count * sizeof *s->cells.offset);
    if (!s->cells.offset) return false;
    count = 0;
    for (size_t k = 0; k < s->hull; k++)
        if (s->owner[k] == 1) s->cells.offset[count++] = (uint32_t)k;
    return true;
}

bool hull_find(model *m, model_state *s)
{
    if (s->progress >= 2) return true;
    if (s->progress == 1) {
        source_complain(&m->source, MOTUS_NAME, &s->at, "%s is defined by itself, in a circle", s->name);
        return false;
    }
    s->progress = 1;
    s->hull = 1;
    s->cells.count = 1;
    if (s->dims > 0) {
        if (!gather_hull(m, s, true) || !gather_hull(m, s, false)) return false;
        double numbers = 1;
        for (int d = 0; d < s->dims; d++) numbers *= (double)(s->last[d] - s->first[d] + 1);
        if (numbers > MODEL_NUMBERS_MAX) {
            source_complain(&m->source, MOTUS_LIMIT, &s->at, "%s would have %.4g places; at most %d fit", s->name,
                            numbers, MODEL_NUMBERS_MAX);
            return false;
        }
        s->hull = (size_t)numbers;
        s->owner = arena_room(m->arena, s->hull);
        if (!s->owner) return false;
        if (!mark_owners(m, s)) return false;
    }
    s->progress = 2;
    return true;
}
