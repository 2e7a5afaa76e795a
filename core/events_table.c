/* The table of events, the numbers that events keep, and events that accumulate. See events_parts.h. */
#include "core/events_parts.h"

#include <math.h>
#include <string.h>

#define FLIGHT_COUNTS 2
#define FLIGHTS_FEW 8

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

motus_status events_no_memory(motus_error *err)
{
    return fail(err, MOTUS_MEMORY, "no memory for the events of a step");
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

/* Adds a state after those of the rows. False: no memory. */
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

/* A flight between two switches leaves about twice the error of one between two actions. The distance of a companion
 * covers the error of few flights. */
double events_lasting(const events *e, double t)
{
    const double gone = t - e->start;
    const double flights = e->flights > FLIGHTS_FEW ? (double)e->flights * gone - e->flights_sum : 0;
    return fabs((double)e->acted * gone - e->acted_sum) + FLIGHT_COUNTS * fabs(flights);
}

bool events_note(events *e, size_t rule, size_t instance, bool touched, const instant *at)
{
    const size_t where = e->numbers;
    if (!grow_rows(e) || !add_state(e, at)) return false;
    e->row_at[e->rows] = where;
    e->row[e->rows++] = (event){.rule = rule,
                                .instance = instance,
                                .count = e->count[rule],
                                .t = at->t,
                                .lasting = events_lasting(e, at->t),
                                .doubt = e->doubt,
                                .touched = touched};
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

/* The time from an event to the limit of the events that follow, its error, and the ratio of successive intervals. */
typedef struct tail {
    double left, error, ratio;
} tail;

/* Extrapolates the limit by Aitken's formula from every 2^level-th event: if r is the ratio of the latest two
 * intervals, r/(1 - r) of the last one is left. Its error has three parts. Every time may be off by `noise`, which
 * enters by 1/(1 - r)^2, twice r/(1 - r)^2 and (r/(1 - r))^2. Where the ratio changes, the limit changes from one
 * triple of times to the next; what is left of such changes shrinks at least as the intervals do. Every event is
 * rounded by a part in 2^49 of the interval: dop853 leaves 14 * 2^-53 of the velocity of each flight of a ball, pefrl
 * and rk4 up to 25 * 2^-53. */
static bool extrapolate(const recent *r, int level, double noise, tail *out)
{
    const double *const t = r->t + RECENT * level;
    if (recent_count(r, level) < RECENT) return false;
    const double one = fabs(t[0] - t[1]), two = fabs(t[1] - t[2]), three = fabs(t[2] - t[3]);
    if (!(two > 0 && three > 0)) return false;
    const double now = one / two, before = two / three, rounding = 2 * noise / two, more = 1 - now;
    if (!(now + rounding < 1) || fabs(now - before) > 0.1 * before + 2 * rounding || !(before < 1)) return false;
    const double all = one * now / more, changed = fabs(all - (two * before / (1 - before) - one));
    const double acting = one * ldexp(now, level - 49);
    out->ratio = now;
    for (int k = 0; k < level; k++) out->ratio = sqrt(out->ratio);
    out->left = all - fabs(r->t[0] - t[0]);
    out->error = noise * ((1 + now) * (1 + now)) / (more * more) + changed * now / more + acting / (more * more);
    return true;
}

/* Finds the level with the least error. A level above 0 must agree with the latest interval, unless that is `lost`. */
static bool best_tail(const recent *r, int levels, double noise, bool lost, tail *best)
{
    const double one = recent_count(r, 0) > 1 ? fabs(r->t[0] - r->t[1]) : 0;
    best->error = INFINITY;
    for (int k = 0; k < levels; k++) {
        tail t;
        if (!extrapolate(r, k, noise, &t) || !(t.error < best->error)) continue;
        const double by_one = one * t.ratio / (1 - t.ratio), room = 2 * noise / (1 - t.ratio) + t.error;
        if (k > 0 && !lost && fabs(t.left - by_one) > 0.25 * by_one + room) continue;
        *best = t;
    }
    if (best->left < 0) best->left = 0;
    return best->error < INFINITY;
}

static void set_limit(events *e, size_t rule, size_t instance, double t, const tail *k)
{
    e->has_limit = true;
    e->limit_told = false;
    e->limit = (events_limit){rule, instance, t + e->way * k->left, k->error + 2 * events_ulp(t), events_lasting(e, t)};
}

/* Returns the function that has led to an event: of the leaves of a condition that are at 0, the one whose rounding
 * hides its time most. SIZE_MAX: none is. */
static size_t function_of(const events *e, size_t rule, size_t instance)
{
    const struct rule *of = &e->rules.rule[rule];
    const double *const rate = e->here.rate, *const bound = e->here.bound;
    size_t which = of->kind == RULE_ROOT ? of->first + instance : SIZE_MAX;
    for (size_t l = 0; of->kind == RULE_CONDITION && l < of->leaves; l++) {
        const size_t f = of->first + l * of->instances + instance;
        if (!e->zero[f] || !(fabs(rate[f]) > 0)) continue;
        if (which == SIZE_MAX || bound[f] / fabs(rate[f]) > bound[which] / fabs(rate[which])) which = f;
    }
    return which;
}

/* Returns how far the time of an event may be off by its own rounding and by that of the function. */
static double noise_of(const events *e, size_t f, double t)
{
    return events_ulp(t) + (f == SIZE_MAX ? 0 : e->here.bound[f] / fabs(e->here.rate[f]));
}

/* Tells whether a limit at t is one that a rule has answered to: its action has not ended the sequence. */
static bool is_told(const events *e, size_t rule, size_t instance, double t, double error)
{
    const bool same = e->has_limit && e->limit.rule == rule && e->limit.instance == instance;
    return same && fabs(t - e->limit.t) <= error + e->limit.error;
}

/* Tells whether events whose intervals shrink by a nearly constant ratio accumulate now: the time left before the limit
 * is below 512 units in its last place, or the next interval below 64, or rounding will soon hide the function between
 * two events. Rounding soon hides in which order such events would come. */
bool events_accumulate(events *e, size_t rule, size_t instance, double t)
{
    enum { ULPS = 512, ULPS_EACH = 64, HIDDEN = 1 << 18 };
    const struct rule *of = &e->rules.rule[rule];
    const int levels = recent_levels(of);
    recent *r = &e->recent[e->instances[rule] + instance];
    tail k = {0};
    r->number++;
    for (int level = 0; level < levels && (r->number & (((int64_t)1 << level) - 1)) == 0; level++) {
        double *const to = r->t + RECENT * level;
        memmove(to + 1, to, (RECENT - 1) * sizeof *to);
        to[0] = t;
    }
    e->tail /= 2; /* not 0 at once, because rounding may spoil the intervals of an event or two */
    if (e->tail < events_ulp(t)) e->tail = 0;
    if (r->number < RECENT || (e->has_limit && !e->limit_told)) return false;
    const size_t f = function_of(e, rule, instance);
    const double one = fabs(r->t[0] - r->t[1]), two = fabs(r->t[1] - r->t[2]), ulp = events_ulp(t),
                 noise = noise_of(e, f, t);
    if (!best_tail(r, levels, noise, false, &k)) {
        /* where an action leaves ever smaller parts of the speed, rounding may hide the next flight, on which the
         * function has turned back; two events in one instant are none */
        const bool flight = f != SIZE_MAX && one > 0 && e->left.rate[f] * e->here.rate[f] < 0;
        const bool low = flight && one < two / 2 && fabs(e->here.rate[f]) * one / 4 <= e->here.bound[f];
        if (!low || is_told(e, rule, instance, t, noise)) return false;
        events_end_here(e, rule, instance, t);
        e->limit_part = 0, e->limit_part_error = 1;
        return true;
    }
    /* two events in one instant, as when a ball meets two others at once, do not continue a sequence */
    if (one + 2 * noise < two * k.ratio / 4) return false;
    if (k.error < k.left / 4) e->tail = k.left;
    if (k.left > ULPS * ulp && one * k.ratio > ULPS_EACH * ulp) {
        /* a function's own rounding may hide it long before */
        if (f == SIZE_MAX) return false;
        const double top = fabs(e->here.rate[f]) * one * k.ratio / 4; /* on a parabola */
        if (!(top <= HIDDEN * e->here.bound[f])) return false;
        if (!(k.error < k.left)) return false; /* equal intervals end nowhere, and a function may stay 0 */
    }
    if (is_told(e, rule, instance, t + e->way * k.left, k.error)) return false;
    set_limit(e, rule, instance, t, &k);
    e->limit_part = k.ratio / (1 - k.ratio);
    e->limit_part_error = (k.error + noise * e->limit_part) / one;
    return true;
}

void events_end_here(events *e, size_t rule, size_t instance, double t)
{
    const struct rule *of = &e->rules.rule[rule];
    const recent *r = &e->recent[e->instances[rule] + instance];
    tail k = {0};
    const double all = noise_of(e, function_of(e, rule, instance), t), noise = isfinite(all) ? all : events_ulp(t);
    if (r->number >= RECENT && !best_tail(r, recent_levels(of), noise, false, &k)) {
        /* the latest intervals are mere rounding: the time left is as uncertain as it is long */
        const double one = fabs(r->t[0] - r->t[1]), two = fabs(r->t[1] - r->t[2]), ratio = one / two;
        if (!best_tail(r, recent_levels(of), noise, true, &k)) k.left = ratio < 1 ? one * ratio / (1 - ratio) : one;
        k.error = fmax(k.left + two, isfinite(k.error) ? k.error : 0);
    }
    k.error += noise;
    set_limit(e, rule, instance, t, &k);
    memset(e->limit_off, 0, (e->problem.nx + e->problem.nv) * sizeof *e->limit_off);
}

void events_limit_is_told(events *e)
{
    e->limit_told = true;
    e->recent[e->instances[e->limit.rule] + e->limit.instance].number = 0; /* another limit is that of other events */
}

void events_after(events *e, size_t rule, size_t instance)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv;
    memcpy(e->after, e->here.x, nx * sizeof *e->after);
    memcpy(e->after + nx, e->here.v, nv * sizeof *e->after);
    e->after_rule = rule;
    e->after_instance = instance;
}

/* Extrapolates numbers to the limit of a sequence whose differences have the ratio r: y + (y - y') r/(1 - r), where y'
 * is the number after the event before. */
static void to_limit(const events *e, double *y, const double *before, double *off, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        const double change = y[k] - before[k], to = y[k] + e->limit_part * change;
        off[k] = fabs(change) * e->limit_part_error + 2 * events_ulp(y[k]);
        y[k] = to;
    }
}

void events_to_limit(events *e)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv, moving = nx - e->problem.modes;
    const bool known = e->after_rule == e->limit.rule && e->after_instance == e->limit.instance;
    e->here.t = e->way * (e->limit.t - e->until) > 0 ? e->until : e->limit.t; /* either is a few roundings away */
    e->here.lost = 0;
    memset(e->limit_off, 0, (nx + nv) * sizeof *e->limit_off);
    if (!known) return;
    to_limit(e, e->here.x, e->after, e->limit_off, moving);
    for (size_t k = 0; k < moving && k < nv; k++) e->limit_off[k] += fabs(e->here.v[k]) * 2 * events_ulp(e->limit.t);
    to_limit(e, e->here.v, e->after + nx, e->limit_off + nx, nv);
}

double events_tail(const events *e) { return e->tail; }

const double *events_limit_off(const events *e) { return e->limit_off; }
