/* What may happen in a step: the list of candidates, and the order in which they come. See events_parts.h.
 *
 * Dense output tells the times of candidates; true steps locate them, one after the other, and move each by the error
 * of dense output. The next candidate is known where all others are later by more than that error.
 */
#include "core/events_parts.h"

#include <math.h>

bool events_add(events *e, candidate c)
{
    void *list = e->candidate;
    if (!events_grow(&e->allocator, &list, e->candidates, &e->candidate_room, 1, sizeof c)) return false;
    e->candidate = list;
    e->candidate[e->candidates++] = c;
    e->in_order = false;
    return true;
}

motus_status events_split(events *e, size_t k, double at, motus_error *err)
{
    candidate first = e->candidate[k];
    first.near = first.located = false;
    candidate second = first;
    first.kind = (candidate_kind)-first.kind;
    first.high = second.low = at;
    first.at = first.low + (at - first.low) / 2;
    second.at = at + (second.high - at) / 2;
    e->candidate[k] = first;
    return events_add(e, second) ? MOTUS_OK : events_no_memory(err);
}

/* Tells whether another candidate is so near to candidate k that a guessed time may put them in the wrong order. */
static bool has_neighbour(const events *e, size_t k)
{
    for (size_t j = 0; j < e->candidates; j++) {
        const candidate *other = &e->candidate[j];
        if (j != k && !other->idle && other->kind != CANDIDATE_TIME &&
            fabs(other->at - e->candidate[k].at) < fabs(e->span) / 8)
            return true;
    }
    return false;
}

/* Places a guessed candidate where its function is 0 by dense output, by false position with halved weights
 * [DowellJarratt71]. */
static motus_status place_guessed(events *e, stepper *s, candidate *c, motus_error *err)
{
    enum { TURNS = 60 };
    const double enough = 0x1p-40 * fabs(e->span);
    double low = 0, high = e->span, at_low = e->left.g[c->of], at_high = e->right.g[c->of];
    instant *at = &e->next;
    motus_status status = MOTUS_OK;
    for (int turn = 0, last = 0; turn < TURNS && !status && fabs(high - low) > enough; turn++) {
        const double inner = low + (high - low) * (at_low / (at_low - at_high));
        c->at = turn % 8 == 7 ? low + (high - low) / 2 : inner;
        at->t = events_place_in(e, c->at);
        status = stepper_sample(s, at->t, at->x, at->v, err);
        if (!status) status = events_value_of(e, c->of, at, err);
        const double g = at->g[c->of];
        if (status || g == 0 || !isfinite(g)) break;
        const bool before = (g > 0) != (c->kind > 0);
        *(before ? &low : &high) = c->at;
        *(before ? &at_low : &at_high) = g;
        if (last == (before ? -1 : 1)) *(before ? &at_high : &at_low) /= 2;
        last = before ? -1 : 1;
    }
    return status;
}

/* Tells whether a candidate is one certain crossing, so that locating it moves it by no more than dense output errs. */
static bool is_settled(const candidate *c)
{
    return c->kind != CANDIDATE_TIME && c->sure && !c->near && !c->sampled && !c->jumps;
}

static bool is_before(const events *e, const candidate *a, const candidate *b)
{
    return a->at == b->at ? a->of < b->of : e->way * (b->at - a->at) > 0;
}

/* Sorts the candidates by their times if they are many and all settled, by Shell's sort. */
static void put_in_order(events *e)
{
    enum { MANY = 16 };
    bool all = e->candidates >= MANY;
    size_t gap = 1;
    for (size_t k = 0; k < e->candidates && all; k++) all = is_settled(&e->candidate[k]);
    if (!all) return;
    while (gap < e->candidates / 3) gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (size_t k = gap; k < e->candidates; k++) {
            const candidate one = e->candidate[k];
            size_t to = k;
            for (; to >= gap && is_before(e, &one, &e->candidate[to - gap]); to -= gap)
                e->candidate[to] = e->candidate[to - gap];
            e->candidate[to] = one;
        }
    e->in_order = true;
    e->next_one = 0;
}

motus_status events_order(events *e, stepper *s, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t k = 0; k < e->candidates && !status; k++) {
        candidate *c = &e->candidate[k];
        if (c->guessed && has_neighbour(e, k)) status = place_guessed(e, s, c, err);
    }
    if (!status) put_in_order(e);
    return status;
}

double events_margin(const events *e)
{
    return fmax(16 * e->shift + 0x1p-20 * fabs(e->span), 4 * events_ulp(e->right.t));
}

candidate *events_earliest(events *e)
{
    const double margin = events_margin(e), far = margin + 2 * e->shift;
    candidate *best = NULL;
    double at = INFINITY;
    while (e->in_order && e->next_one < e->candidates && e->candidate[e->next_one].gone) e->next_one++;
    for (size_t k = e->in_order ? e->next_one : 0; k < e->candidates; k++) {
        candidate *c = &e->candidate[k];
        if (e->in_order && e->way * c->at - far > at) break;
        const bool rough = !c->located && !c->idle && c->kind != CANDIDATE_TIME;
        const double t = e->way * c->at - (rough ? margin : 0);
        if (c->gone || !(t < at || (t == at && !c->located))) continue;
        at = t;
        best = c;
    }
    return best;
}

void events_about(const events *e, double at, double far, size_t *first, size_t *end)
{
    *first = 0, *end = e->candidates;
    if (!e->in_order) return;
    far += 2 * e->shift;
    *first = *end = e->next_one;
    while (*first > 0 && e->way * (at - e->candidate[*first - 1].at) <= far) --*first;
    while (*end < e->candidates && e->way * (e->candidate[*end].at - at) <= far) ++*end;
}
