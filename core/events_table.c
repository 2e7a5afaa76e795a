/* The table of events, the numbers that events keep, and events that accumulate. See events_parts.h. */
#include "core/events_parts.h"

#include <math.h>
#include <string.h>

bool events_grow(const motus_allocator *a, void **items, size_t count, size_t *room, size_t more, size_t size)
{
    if (count + more <= *room) return true;
    const size_t wider = *room + *room / 2 + more + 16;
    if (wider > SIZE_MAX / 2 / size) return false;
    void *fresh = take(a, wider, size);
    if (!fresh) return false;
    if (count) memcpy(fresh, *items, count * size);
    give(a, *items);
    *items = fresh;
    *room = wider;
    return true;
}

static bool grow_rows(events *e)
{
    size_t room = e->row_room, also = e->row_room;
    void *row = e->row, *at = e->row_at;
    if (!events_grow(&e->allocator, &row, e->rows, &room, 1, sizeof *e->row)) return false;
    e->row = row;
    if (!events_grow(&e->allocator, &at, e->rows, &also, 1, sizeof *e->row_at)) return false;
    e->row_at = at;
    e->row_room = also;
    return true;
}

/* A state behind those of the rows. */
static bool add_state(events *e, const instant *at)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv;
    void *numbers = e->row_state;
    if (!events_grow(&e->allocator, &numbers, e->numbers, &e->number_room, nx + nv, sizeof *e->row_state)) return false;
    e->row_state = numbers;
    memcpy(e->row_state + e->numbers, at->x, nx * sizeof *at->x);
    memcpy(e->row_state + e->numbers + nx, at->v, nv * sizeof *at->v);
    e->numbers += nx + nv;
    return true;
}

bool events_note(events *e, size_t rule, size_t instance, bool touched, const instant *at)
{
    const size_t where = e->numbers;
    if (!grow_rows(e) || !add_state(e, at)) return false;
    e->row_at[e->rows] = where;
    e->row[e->rows++] = (event){rule, instance, e->count[rule], at->t, touched, false};
    return true;
}

bool events_note_after(events *e, const instant *at)
{
    e->row[e->rows - 1].changed = true;
    return add_state(e, at);
}

bool events_note_jump(events *e, const rule *r, const instant *at, bool after)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv, each = 2 + 2 * (nx + nv);
    void *jump = e->jump;
    if (!e->keeps_jumps) return true;
    if (!after && !events_grow(&e->allocator, &jump, e->jumps, &e->jump_room, 1, each * sizeof *e->jump)) return false;
    e->jump = jump;
    double *to = e->jump + e->jumps * each + 2 + (after ? nx + nv : 0);
    memcpy(to, at->x, nx * sizeof *to);
    memcpy(to + nx, at->v, nv * sizeof *to);
    if (!after) return true;
    e->jump[e->jumps * each] = at->t;
    e->jump[e->jumps++ * each + 1] = r->assigns;
    return true;
}

void events_keep_jumps(events *e, bool keep)
{
    e->keeps_jumps = keep;
    e->jumps = 0;
}

size_t events_jumps(const events *e) { return e->jumps; }

bool events_jump(const events *e, size_t k, double *t, const double **before, const double **after)
{
    const size_t state = e->problem.nx + e->problem.nv;
    const double *const jump = e->jump + k * (2 + 2 * state);
    *t = jump[0];
    *before = jump + 2;
    *after = jump + 2 + state;
    return jump[1] != 0;
}

size_t events_rows(const events *e) { return e->rows; }

event events_row(const events *e, size_t k, bool after, const double **x, const double **v)
{
    const size_t all = e->problem.nx + e->problem.nv;
    const double *state = e->row_state + e->row_at[k] + (after && e->row[k].changed ? all : 0);
    if (x) *x = state;
    if (v) *v = state + e->problem.nx;
    return e->row[k];
}

/* Kept numbers ----------------------------------------------------------------------------------------------------- */

static void overlay(const events *e, size_t k, double *x)
{
    const double *from = e->kept + e->kept_state[k].at * e->rules.kept_count;
    for (size_t j = 0; j < e->rules.kept_count; j++) x[e->rules.kept[j]] = from[j];
}

void events_overlay(const events *e, double *x)
{
    if (e->kept_states) overlay(e, e->kept_states - 1, x);
}

void events_keep(const events *e, double t, double *x)
{
    size_t k = e->kept_states;
    if (!k) return;
    while (k > 1 && e->way * (e->kept_state[k - 1].t - t) > 0) k--;
    overlay(e, k - 1, x);
}

bool events_keep_now(events *e, double t, const double *x)
{
    const size_t n = e->rules.kept_count;
    if (!n) return true;
    void *states = e->kept_state, *numbers = e->kept;
    size_t room = e->kept_room, also = e->kept_room * n;
    if (!events_grow(&e->allocator, &states, e->kept_states, &room, 1, sizeof *e->kept_state)) return false;
    e->kept_state = states;
    if (!events_grow(&e->allocator, &numbers, e->kept_states * n, &also, (room - e->kept_states) * n, sizeof *e->kept))
        return false;
    e->kept = numbers;
    e->kept_room = room;
    for (size_t j = 0; j < n; j++) e->kept[e->kept_states * n + j] = x[e->rules.kept[j]];
    e->kept_state[e->kept_states] = (kept_state){t, e->kept_states};
    e->kept_states++;
    return true;
}

void events_kept_forget(events *e)
{
    const size_t n = e->rules.kept_count, last = e->kept_states - 1;
    if (!n || e->kept_states < 2) return;
    memmove(e->kept, e->kept + last * n, n * sizeof *e->kept);
    e->kept_state[0].t = e->kept_state[last].t;
    e->kept_states = 1;
}

/* Accumulation ----------------------------------------------------------------------------------------------------- */

/* The limit of times whose intervals shrink by a nearly constant ratio, by Aitken's formula. It is due when all that is
 * left before it is below 512 units in the last place of the time, or the function goes no farther than 512 times its
 * rounding: rounding soon hides in which order such events would come. */
bool events_accumulate(events *e, size_t rule, size_t instance, double t)
{
    enum { ULPS = 512 };
    recent *r = &e->recent[e->instances[rule] + instance];
    memmove(r->t + 1, r->t, (RECENT - 1) * sizeof *r->t);
    r->t[0] = t;
    if (r->count < RECENT) r->count++;
    const bool same = e->limit.rule == rule && e->limit.instance == instance;
    if (r->count < RECENT || (e->has_limit && (same || !e->limit_told))) return false;
    const double one = fabs(r->t[0] - r->t[1]), two = fabs(r->t[1] - r->t[2]), three = fabs(r->t[2] - r->t[3]);
    const double now = one / two, before = two / three, ulp = events_ulp(t);
    /* the times are rounded, and the shorter the intervals are the less their ratio is known */
    const double rounding = 2 * ulp / two;
    /* two events of one instant, as of a ball that meets two others at once, are no shorter interval of a sequence */
    if (!(two > 0) || !(three > 0) || !(now + rounding < 1) || !(before < 1)) return false;
    if (fabs(now - before) > 0.1 * before + 2 * rounding) return false;
    const double left = one * now / (1 - now);
    double error = left;
    if (left > ULPS * ulp) { /* a function may be hidden by its own rounding long before */
        const struct rule *of = &e->rules.rule[rule];
        const size_t f = of->first + instance;
        const double rate = fabs(e->here.rate[f]), bound = e->here.bound[f];
        const double top = rate * one * now / 4; /* how far it would go until the next event, on a parabola */
        if (of->kind != RULE_ROOT || !(top <= ULPS * bound)) return false;
        error = (one * fabs(now - before) + 2 * (bound / rate + ulp) * (1 + now)) / ((1 - now) * (1 - now));
        if (!(error < left)) return false; /* equal intervals end nowhere, and a function may stay 0 after its action */
    }
    e->has_limit = true;
    e->limit_told = false;
    e->limit = (events_limit){rule, instance, t + e->way * left, error + 4 * ulp};
    return true;
}

void events_end_here(events *e, size_t rule, size_t instance, double t)
{
    const recent *r = &e->recent[e->instances[rule] + instance];
    double left = 0;
    if (r->count >= 3) {
        const double one = fabs(r->t[0] - r->t[1]), ratio = one / fabs(r->t[1] - r->t[2]);
        left = ratio < 1 ? one * ratio / (1 - ratio) : one;
    }
    e->has_limit = true;
    e->limit_told = false;
    e->limit = (events_limit){rule, instance, t, left + 4 * events_ulp(t)};
}

void events_after(events *e, size_t rule, size_t instance)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv;
    memcpy(e->after, e->here.x, nx * sizeof *e->after);
    memcpy(e->after + nx, e->here.v, nv * sizeof *e->after);
    e->after_rule = rule;
    e->after_instance = instance;
}

/* y + (y - y') r/(1 - r), y' the number after the event before: where a sequence with differences of the ratio r
 * ends. */
void events_to_limit(events *e, size_t rule, size_t instance)
{
    const recent *r = &e->recent[e->instances[rule] + instance];
    const double one = fabs(r->t[0] - r->t[1]), left = fabs(e->limit.t - r->t[0]), part = one > 0 ? left / one : 0;
    const size_t nx = e->problem.nx, nv = e->problem.nv, moving = nx - e->problem.modes;
    e->here.t = e->way * (e->limit.t - e->until) > 0 ? e->until : e->limit.t; /* both are a few roundings away */
    e->here.lost = 0;
    if (e->after_rule != rule || e->after_instance != instance) return;
    for (size_t k = 0; k < moving; k++) e->here.x[k] += part * (e->here.x[k] - e->after[k]);
    for (size_t k = 0; k < nv; k++) e->here.v[k] += part * (e->here.v[k] - e->after[nx + k]);
}
