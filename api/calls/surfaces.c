/* The switching surfaces of a system: where its force changes its formula. */
#include "api/system/system.h"
#include "lang/model/switches.h"

enum { ROOM = 4096 }; /* of a text; a longer one is cut */

/* Finds the switches of a system that has no located one. NULL: no memory. */
static const switches *found_in(motus_system *s)
{
    switches *found = s->surfaces ? s->surfaces : arena_take(&s->arena, sizeof *found);
    if (!found) return NULL;
    if (!s->surfaces && !switches_find(s->model, true, found)) return NULL;
    return s->surfaces = found;
}

static motus_sliding sliding_of(const switches *w, size_t k)
{
    if (!w->slides || k >= w->kinds) return MOTUS_SLIDING_UNKNOWN;
    return w->slides[k] == SLIDES_NEVER  ? MOTUS_SLIDING_NEVER
           : w->slides[k] == SLIDES_HELD ? MOTUS_SLIDING_HELD
                                         : MOTUS_SLIDING_ENDS;
}

static motus_status surface_at(motus_system *s, size_t k, motus_switch *out)
{
    motus_system *located, *unasked;
    const char *why;
    motus_switch ours = motus_default_switch();
    if (located_of(s, MOTUS_SWITCHES_LOCATE, &located, &why, NULL) != MOTUS_OK) return MOTUS_MEMORY;
    const model *m = located ? located->model : s->model;
    const switches *w = located ? m->located : found_in(s);
    if (!w) return MOTUS_MEMORY;
    const size_t count = w->kinds + (w->refused != NULL);
    if (k >= count) return MOTUS_ARGUMENT;
    if (!s->surface_text) s->surface_text = arena_room(&s->arena, 2 * ROOM);
    if (!s->surface_text) return MOTUS_MEMORY;
    const node original = k < w->kinds ? w->original[k] : w->refused_at;
    model_print(m, original, s->surface_text, ROOM);
    switches_surface(m, original, s->surface_text + ROOM, ROOM);
    if (k < w->kinds) ours.count = switches_cells(w, k);
    ours.operation = s->surface_text;
    ours.surface = s->surface_text + ROOM;
    ours.sliding = sliding_of(w, k);
    if (located && located_of(s, MOTUS_SWITCHES_USUAL, &unasked, &why, NULL) != MOTUS_OK) return MOTUS_MEMORY;
    ours.located = located && unasked;
    if (!ours.located)
        ours.not_located = !located && w->refused ? w->refused
                           : why[0]               ? why
                                                  : "the force is continuous, with an infinite slope there";
    motus_struct_write(MOTUS_DEF_SWITCH, &ours, out);
    return MOTUS_OK;
}

motus_status motus_switch_at(motus_system *s, size_t k, motus_switch *out)
{
    if (!s || !s->model || !out || motus_struct_check(MOTUS_DEF_SWITCH, out, NULL) != MOTUS_OK) return MOTUS_ARGUMENT;
    modes m = modes_enter();
    const motus_status status = surface_at(s, k, out);
    modes_leave(m);
    return status;
}
