/* See event_bars.h.
 *
 * Row k of the run is compared with the companion's row of the same rule, indices and number. As at landings
 * (machine/differences.c), 2.5 times their distance bounds the error of truncation, where that dominates, and a part of
 * the largest distance of the neighbouring rows is added, since a distance may pass 0. If the companion lacks a row, or
 * has it at a time that is off by more than a quarter of the time since the event before, the two motions have
 * different events from there on, and no digit of them is significant.
 */
#include "api/error/event_bars.h"

#include "api/system/columns.h"

#include "lang/model/whole.h"

#include <math.h>

enum { BEFORE = 6, AFTER = 2, WINDOW = BEFORE + AFTER, NEARBY = 16 };
#define OTHERS 0.375
#define APART 0.25
#define CLOSE 256   /* units in the last place of the time: least room for a distance, where events accumulate */
#define CLOCK 1.5   /* units in the last place: the period, its multiple and the sum are rounded */
#define TIMED 4     /* units in the last place: rounding of a function of the time that may hide where it passes 0 */
#define ROUNDINGS 2 /* units in the last place of an event's time that run and companion share */
/* In place of BARS_LASTING at a limit of events, with and without a companion: flights of a ball have left up to 8 of
 * these parts (dop853, all of one sign). A companion shows most of them, since its steps are others. */
#define LASTING_LIMIT 4
#define LASTING_ALONE 8

/* Finds the companion's row for row k of the run; SIZE_MAX: there is none. */
static size_t partner(const events *run, const events *other, size_t k)
{
    const event row = events_row(run, k, false, NULL, NULL);
    const size_t rows = events_rows(other), first = k > NEARBY ? k - NEARBY : 0;
    for (size_t step = 0; step <= 2 * NEARBY; step++) { /* the likeliest first */
        const size_t at = step % 2 ? k + (step + 1) / 2 : k - step / 2;
        if (at < first || at >= rows) continue;
        const event their = events_row(other, at, false, NULL, NULL);
        if (their.rule == row.rule && their.instance == row.instance && their.count == row.count) return at;
    }
    return SIZE_MAX;
}

static double distance(const motus_run *r, const companion *c, size_t k)
{
    const size_t at = partner(r->events, c->events, k);
    if (at == SIZE_MAX) return INFINITY;
    return fabs(events_row(r->events, k, false, NULL, NULL).t - events_row(c->events, at, false, NULL, NULL).t);
}

/* Returns whether companions have come as far as row k. */
static bool known(const motus_run *r, size_t k)
{
    const bars *b = r->bars;
    if (!b || b->why[0] || !b->half.events) return false;
    const double way = r->timing.h < 0 ? -1 : 1, t = events_row(r->events, k, false, NULL, NULL).t;
    return b->half.over || way * (b->half.t - t) >= 0;
}

/* Returns the time of the instant before that of row k: rows of one instant are judged as one. */
static double instant_before(const motus_run *r, size_t k)
{
    const double t = events_row(r->events, k, false, NULL, NULL).t;
    while (k-- > 0) {
        const double before = events_row(r->events, k, false, NULL, NULL).t;
        if (fabs(t - before) > 4 * events_ulp(t)) return before;
    }
    return r->timing.t0;
}

/* Counts the significant rows that companions have come to. */
static size_t significant(motus_run *r)
{
    bars *b = r->bars;
    const size_t rows = events_rows(r->events);
    if (rows < b->rows) { /* the run has begun anew */
        b->rows = 0;
        b->rows_differ = false;
    }
    for (; !b->rows_differ && b->rows < rows && known(r, b->rows); b->rows++) {
        const size_t k = b->rows;
        const double t = events_row(r->events, k, false, NULL, NULL).t;
        const double room = fmax(APART * fabs(t - instant_before(r, k)), CLOSE * events_ulp(t));
        b->rows_differ = distance(r, &b->half, k) > room;
        if (b->rows_differ) break;
    }
    return b->rows;
}

/* Returns whether no further row is significant, or the motions themselves are too far apart. */
static bool ended(const bars *b) { return b->rows_differ || !isnan(b->differences.until); }

/* Returns the i-th of the rows beside which row k is judged: itself, rows before, rows after. SIZE_MAX: none. */
static size_t row_of(size_t k, size_t i, size_t rows)
{
    if (i < BEFORE) return i <= k ? k - i : SIZE_MAX;
    const size_t row = k + 1 + (i - BEFORE);
    return row < rows ? row : SIZE_MAX;
}

static double bar_of(const motus_run *r, const double *d, size_t n)
{
    double others = 0;
    for (size_t i = 1; i < n; i++) others = fmax(others, d[i]);
    return bars_part(r) * d[0] + OTHERS * others;
}

/* Returns the error of a time that run and companion share. */
static double shared(double t, double lasting, double part)
{
    return ROUNDINGS * events_ulp(t) + part * 0x1p-52 * lasting;
}

/* Returns the error of the time of a function of the time alone: its rounding, and that of the numbers in it, which the
 * companion has with other roundings. The motion has no part in it. */
static double bar_of_timed(const motus_run *r, size_t k, const event *this)
{
    const double apart = known(r, k) ? distance(r, &r->bars->half, k) : 0;
    return TIMED * events_ulp(this->t) + this->doubt + (isfinite(apart) ? bars_part(r) * apart : 0);
}

double event_bars_time(motus_run *r, size_t k)
{
    double d[WINDOW];
    size_t n = 0;
    if (!r->bars) return NAN;
    const event this = events_row(r->events, k, false, NULL, NULL);
    if (r->rules->rule[this.rule].kind == RULE_CLOCK) return CLOCK * events_ulp(this.t); /* whatever the motion is */
    if (r->rules->rule[this.rule].timed) return bar_of_timed(r, k, &this);
    const size_t rows = significant(r);
    if (k >= rows) return ended(r->bars) ? INFINITY : NAN;
    if (this.doubt >= fabs(r->timing.until - r->timing.t0)) return INFINITY; /* it may be anywhere in the run */
    for (size_t i = 0; i < WINDOW; i++) {
        const size_t row = row_of(k, i, rows);
        if (row == SIZE_MAX) continue;
        d[n] = distance(r, &r->bars->half, row);
        if (r->bars->twin.events) d[n] = fmax(d[n], distance(r, &r->bars->twin, row));
        n++;
    }
    return fmax(bar_of(r, d, n) + events_ulp(this.t), shared(this.t, this.lasting, BARS_LASTING)) + this.doubt;
}

#define WHOLE_MOST 0x1p53
enum { ENDLESS = WHOLE_COUNT + 1 };

/* Finds which numbers only count; one that counts events of the rule `endless`, which accumulate, is ENDLESS. */
static bool judge_whole(motus_run *r, const model_rule *endless)
{
    const motus_system *s = r->system;
    const bars *b = r->bars;
    whole w;
    const bool found = whole_find(&w, s->model, 0, endless, &r->allocator);
    for (size_t k = 0; found && k < b->count; k++) {
        if (columns_range(s, b->columns[k])->kind != MOTUS_COLUMN_QUANTITY) continue;
        const whole_kind kind = whole_of(&w, s->model, system_definition(s, b->columns[k], &(size_t){0}));
        b->whole[k] = endless && b->whole[k] != kind ? ENDLESS : (uint8_t)kind;
    }
    whole_end(&w, &r->allocator);
    return found;
}

motus_status event_bars_whole(motus_run *r, motus_error *err)
{
    bars *b = r->bars;
    if (!r->system->model || r->system->model->rule_count == 0) return MOTUS_OK;
    b->whole = take(&r->allocator, b->count + 1, sizeof *b->whole);
    return b->whole && judge_whole(r, NULL) ? MOTUS_OK : fail(err, MOTUS_MEMORY, "no memory for bars of error");
}

/* Returns whether run and companion have different events up to t, or whether one of them may lie beyond t. Events of
 * the instant that ended the run do not count: the run ends there, wherever that is. */
static bool rows_unsure(motus_run *r, double t, bool ended)
{
    const size_t rows = significant(r), all = events_rows(r->events);
    if (r->bars->rows_differ || rows < all) return r->bars->rows_differ;
    for (size_t k = rows; k-- > 0;) {
        const event row = events_row(r->events, k, false, NULL, NULL);
        if ((ended && row.t == t) || r->rules->rule[row.rule].kind == RULE_CLOCK) continue;
        return fabs(t - row.t) <= event_bars_time(r, k);
    }
    return false;
}

/* Returns whether the latest action, which need not have a row, may lie beyond t. */
static bool action_unsure(const motus_run *r, double t, bool ended)
{
    const companion *half = &r->bars->half;
    const double latest = events_latest(r->events);
    if (isnan(latest) || !half->events || (ended && latest == t) || events_ticks(r->events, latest)) return false;
    const double off = bars_part(r) * fabs(latest - events_latest(half->events));
    return fabs(t - latest) <= off + shared(latest, events_lasting(r->events, latest), BARS_LASTING);
}

/* Finds out whether it is uncertain which events have happened up to t. */
static motus_status unsure_at(motus_run *r, double t, const double *x, const double *v, bool *unsure, motus_error *err)
{
    const bool ended = events_ended(r->events, NULL) != EVENTS_END_NONE && t == run_time(r);
    *unsure = rows_unsure(r, t, ended) || action_unsure(r, t, ended);
    return *unsure ? MOTUS_OK : event_counts_open(r, t, x, v, unsure, err);
}

/* Tells the error of a number that only counts: 0 where the companion has the same number; INFINITY where it has
 * different events, or counts events without end. *told: the number only counts. */
static motus_status counts(motus_run *r, double t, const double *x, const double *v, size_t number, double *error,
                           bool *told, motus_error *err)
{
    bars *b = r->bars;
    events_limit limit;
    const bool accumulated = events_accumulated(r->events, &limit);
    const size_t endless = accumulated && limit.rule < r->system->model->rule_count ? limit.rule + 1 : 0;
    *told = false;
    if (!b->whole) return MOTUS_OK;
    if (endless != b->endless) {
        if (!judge_whole(r, NULL) || (endless && !judge_whole(r, &r->system->model->rules[limit.rule])))
            return fail(err, MOTUS_MEMORY, "no memory for bars of error");
        b->endless = endless;
    }
    const double value = fabs(b->differences.values[0][number]);
    const int kind = b->whole[number];
    if (kind == WHOLE_NOT || isnan(*error) || floor(value) != value || value > WHOLE_MOST) return MOTUS_OK;
    if (b->differences.d[number] != 0 && kind != ENDLESS) return MOTUS_OK;
    bool unsure = false;
    const motus_status status = kind == WHOLE_COUNT ? unsure_at(r, t, x, v, &unsure, err) : MOTUS_OK;
    *told = true;
    *error = isinf(*error) || kind == ENDLESS || unsure ? INFINITY : 0;
    return status;
}

/* Raises an error for what events do: the state may be late or early by the error that their times share. And no number
 * is known better than the larger ones from which it was added up: a motion that sticks, or was led to a place, has
 * their rounding. */
motus_status event_bars_state(motus_run *r, double t, const double *x, const double *v, size_t number, double *error,
                              motus_error *err)
{
    const bars *b = r->bars;
    bool told;
    motus_status status = counts(r, t, x, v, number, error, &told, err);
    if (status != MOTUS_OK || told) return status;
    if ((events_acted(r->events) == 0 && events_turns(r->events) == 0) || !(*error > 0) || b->columns[number] == 0)
        return MOTUS_OK;
    const double late = bars_events_late(r, t);
    double value[2];
    for (int k = 0; k < 2 && status == MOTUS_OK; k++) {
        double *to_x, *to_v;
        status = bars_later(r, r->system, t, k ? late : 0, x, v, &to_x, &to_v, err);
        if (status == MOTUS_OK)
            status = system_values(r->system, t, to_x, to_v, b->columns + number, 1, value + k, err);
    }
    if (status != MOTUS_OK) return status;
    const double moved = fabs(value[1] - value[0]);
    const double part = events_turns(r->events) > 0 ? 1 : 0.5; /* what holds it in place was added up as well */
    *error = fmax(*error, part * events_ulp(b->differences.size[number]));
    if (isfinite(moved)) *error = fmax(*error, moved);
    return MOTUS_OK;
}

/* Finds the companion's limit: its own or, once it has had as many events as the run, the one to which these lead. */
static bool other_limit(const companion *c, const events_limit *limit, events_limit *other, double way)
{
    if (!c->events) return false;
    if (events_accumulated(c->events, other)) return other->rule == limit->rule && other->instance == limit->instance;
    other->t = events_latest(c->events) + way * events_tail(c->events);
    return c->over && isfinite(other->t);
}

double event_bars_limit(motus_run *r, const events_limit *limit)
{
    events_limit other;
    const bars *const b = r->bars;
    if (!b) return limit->error + shared(limit->t, limit->lasting, LASTING_ALONE);
    const double gone = b->differences.until, way = r->timing.h < 0 ? -1 : 1;
    if (!isnan(gone) && way * (limit->t - gone) > limit->error) return INFINITY; /* the bars ended long before */
    if (b->why[0] || !other_limit(&b->half, limit, &other, way)) return NAN;
    return bars_part(r) * fabs(limit->t - other.t) + limit->error + shared(limit->t, limit->lasting, LASTING_LIMIT);
}

size_t event_bars_rows(motus_run *r)
{
    const size_t all = r->events ? events_rows(r->events) : 0;
    if (!r->events || !r->bars) return all;
    const size_t rows = significant(r);
    return ended(r->bars) ? rows : all;
}

static motus_status values_of(motus_run *r, motus_system *s, const events *e, size_t k, bool after,
                              const size_t *columns, size_t count, double *out, motus_error *err)
{
    const double *x, *v;
    const event row = events_row(e, k, after, &x, &v);
    return system_values_of(s, row.t, x, v, r->mid_x, columns, count, out, err);
}

/* Computes |run - companion| of columns at row k, to d; room: count numbers. */
static motus_status differ(motus_run *r, companion *c, size_t k, bool after, const size_t *columns, size_t count,
                           double *d, double *room, motus_error *err)
{
    const size_t at = partner(r->events, c->events, k);
    motus_system *const s = c->system ? c->system : r->system;
    if (at == SIZE_MAX) {
        for (size_t j = 0; j < count; j++) d[j] = INFINITY;
        return MOTUS_OK;
    }
    motus_status status = values_of(r, r->system, r->events, k, after, columns, count, d, err);
    if (status == MOTUS_OK) status = values_of(r, s, c->events, at, after, columns, count, room, err);
    for (size_t j = 0; j < count; j++) d[j] = fabs(d[j] - room[j]);
    return status;
}

motus_status event_bars_values(motus_run *r, size_t k, bool after, const size_t *columns, size_t count, double *out,
                               motus_error *err)
{
    bars *b = r->bars;
    const size_t rows = significant(r);
    for (size_t j = 0; j < count; j++) out[j] = ended(b) ? INFINITY : NAN;
    if (k >= rows) return MOTUS_OK;
    double *room = take(&r->allocator, (WINDOW + 2) * (count + 1), sizeof *room);
    if (!room) return fail(err, MOTUS_MEMORY, "no memory for the errors of an event");
    motus_status status = MOTUS_OK;
    size_t n = 0;
    for (size_t i = 0; i < WINDOW && status == MOTUS_OK; i++) {
        const size_t row = row_of(k, i, rows);
        if (row == SIZE_MAX) continue;
        double *const half = room + (n + 1) * count, *const twin = half + count;
        status = differ(r, &b->half, row, after, columns, count, half, room, err);
        if (status == MOTUS_OK && b->twin.events) {
            status = differ(r, &b->twin, row, after, columns, count, twin, room, err);
            for (size_t j = 0; j < count; j++) half[j] = fmax(half[j], twin[j]);
        }
        n++;
    }
    for (size_t j = 0; j < count && status == MOTUS_OK; j++) {
        double d[WINDOW];
        for (size_t i = 0; i < n; i++) d[i] = room[(i + 1) * count + j];
        out[j] = bar_of(r, d, n);
    }
    if (status == MOTUS_OK) status = values_of(r, r->system, r->events, k, after, columns, count, room, err);
    for (size_t j = 0; j < count && status == MOTUS_OK;
         j++) /* where both have the same number, it may still be rounded */
        if (out[j] > 0) out[j] += events_ulp(room[j]);
    give(&r->allocator, room);
    return status;
}
