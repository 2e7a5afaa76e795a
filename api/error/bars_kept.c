/* What a restart state has of bars of error: where the companions stand, and how they differed lately. See bars.h.
 *
 * So the bars of a restored run cover its errors from the very start. The companion goes on from its state, to the
 * rounding of its numbers; so does a twin, but not after a shorter last step that a restored run does not take.
 */
#include "api/error/bars.h"

#include "api/error/event_bars.h"

#include <math.h>
#include <string.h>

enum { LANDED, TWIN, HEAD }; /* the time of the last landing; 1 if there is a twin; then the companions */
/* After the differences, if there are events: whether there is a gap, and from what time; then, for each rule, whether
 * the number of its events is uncertain, and from what time. */
enum { GAP, SINCE, TAIL };
static size_t tail_of(const motus_run *r) { return r->events ? TAIL * (1 + r->rules->count) : 0; }

static size_t kept_of_differences(const motus_run *r, bool twin)
{
    differences_shape shape = r->bars->differences.shape;
    shape.full = twin;
    return differences_kept(&shape);
}

/* Counts the numbers but those of events. */
static size_t count_of(const motus_run *r, bool twin)
{
    const problem *p = &r->system->problem;
    return HEAD + (p->nx + p->nv) * (1 + (size_t)twin) + kept_of_differences(r, twin);
}

/* Counts the numbers of events: with each companion its time, which may differ from the landing's, and its events. */
static size_t count_of_events(const motus_run *r, bool twin)
{
    const bars *b = r->bars;
    if (!r->events) return 0;
    return tail_of(r) + 1 + companion_keep(&b->half, NULL) + (twin ? 1 + companion_keep(&b->twin, NULL) : 0);
}

/* Writes a state. A companion that has left the finite numbers is of no more use: 0. */
static double *put_state(double *at, const motus_run *r, const companion *c)
{
    const problem *p = &r->system->problem;
    if (r->events) *at++ = c->t;
    for (size_t k = 0; k < p->nx; k++) *at++ = isfinite(c->x[k]) ? c->x[k] : 0;
    for (size_t k = 0; k < p->nv; k++) *at++ = isfinite(c->v[k]) ? c->v[k] : 0;
    return at + companion_keep(c, at);
}

motus_status bars_keep(motus_run *r, double t, double **numbers, size_t *count, motus_error *err)
{
    *numbers = NULL;
    *count = 0;
    const bars *b = r->bars;
    if (!b || b->why[0]) return MOTUS_OK;
    differences seen = b->differences;
    const bool twin = seen.twin && (row_adaptive(&r->chosen) || t == run_time(r));
    if (!twin) seen.twin = NULL;
    const size_t all = count_of(r, twin) + count_of_events(r, twin);
    double *out = take(&r->allocator, all, sizeof *out);
    if (!out) return fail(err, MOTUS_MEMORY, "no memory for the restart state");
    out[LANDED] = b->landed;
    out[TWIN] = twin;
    double *at = put_state(out + HEAD, r, &b->half);
    if (twin) at = put_state(at, r, &b->twin);
    if (!differences_keep(&seen, at)) {
        give(&r->allocator, out);
        return MOTUS_OK;
    }
    if (r->events) {
        at += kept_of_differences(r, twin);
        at[GAP] = b->gap, at[SINCE] = b->gap ? b->gap_since : 0;
        for (size_t k = 0; k < r->rules->count; k++) {
            const double since = event_counts_since(b, k);
            at += TAIL;
            at[GAP] = !isnan(since), at[SINCE] = isnan(since) ? 0 : since;
        }
    }
    *numbers = out;
    *count = all;
    return MOTUS_OK;
}

/* Leads *at over the numbers of a companion. */
static bool skip(const motus_run *r, const double **at, const double *end)
{
    const size_t state = r->system->problem.nx + r->system->problem.nv + (r->events != NULL);
    if ((size_t)(end - *at) < state) return false;
    *at += state;
    return !r->events || companion_skip(at, end);
}

/* Returns whether there are as many numbers as this version keeps. */
static bool fits(const motus_run *r, const double *numbers, size_t count)
{
    const double *at = numbers + HEAD, *const end = numbers + count;
    const bool twin = numbers[TWIN] != 0;
    return skip(r, &at, end) && (!twin || skip(r, &at, end)) &&
           (size_t)(end - at) == kept_of_differences(r, twin) + tail_of(r);
}

bool bars_resume(motus_run *r, double *numbers, size_t count)
{
    bars *b = r->bars;
    if (count < HEAD || (numbers[TWIN] != 0 && numbers[TWIN] != 1) || !fits(r, numbers, count)) return false;
    for (size_t k = 0; k < count && !r->events; k++)
        if (!isfinite(numbers[k])) return false;
    bars_again(r, true);
    b->resumed = numbers;
    b->resumed_count = count;
    return true;
}

static motus_status damaged(motus_error *err)
{
    return fail(err, MOTUS_STATE, "what the restart state has of the errors is damaged");
}

/* Begins a companion from the numbers at *at, which end at `end`. */
static motus_status begin(motus_run *r, companion *c, const double **at, const double *end, motus_error *err)
{
    const problem *p = &r->system->problem;
    const double t = r->events ? *(*at)++ : r->bars->landed;
    memcpy(r->mid_x, *at, p->nx * sizeof(double));
    memcpy(r->mid_v, *at + p->nx, p->nv * sizeof(double));
    *at += p->nx + p->nv;
    if (p->refresh) p->refresh(p->ctx, t, r->mid_x, r->mid_v);
    motus_status status = companion_begin(c, r, t, r->mid_x, r->mid_v, err);
    if (status == MOTUS_OK) status = companion_resume(c, r, at, end, err);
    c->before = run_steps(r) - (c->events ? events_steps(c->events) : 0);
    return status;
}

/* Reads what follows the companions. */
static motus_status resume(motus_run *r, bool was_twin, const double *at, motus_error *err)
{
    bars *b = r->bars;
    const size_t count = kept_of_differences(r, was_twin), tail = tail_of(r);
    bool ok = true, memory = true;
    for (size_t k = 0; ok && k < count + tail; k++) ok = isfinite(at[k]);
    if (!ok) return damaged(err);
    differences_begin(&b->differences, r->timing.t0, r->timing.until);
    differences_resume(&b->differences, b->landed, at);
    at += count;
    if (tail) b->gap = at[GAP] != 0, b->gap_since = at[SINCE];
    for (size_t k = 0; tail && memory && k < r->rules->count; k++) {
        at += TAIL;
        if (at[GAP] != 0) memory = event_counts_note(r, k, at[SINCE]);
    }
    return memory ? MOTUS_OK : fail(err, MOTUS_MEMORY, "no memory for bars of error");
}

motus_status bars_kept_begin(motus_run *r, const double *x, const double *v, motus_error *err)
{
    bars *b = r->bars;
    double *const kept = b->resumed, t = stepper_time(r->stepper);
    const double *at = kept + HEAD, *const end = kept + b->resumed_count;
    const problem *p = &r->system->problem;
    b->resumed = NULL;
    b->landed = kept[LANDED];
    b->steps = run_steps(r);
    b->ahead = b->landed != t;
    const bool was_twin = kept[TWIN] != 0, twin = was_twin && b->kind == MOTUS_BARS_FULL;
    motus_status status = begin(r, &b->half, &at, end, err);
    if (status == MOTUS_OK && twin) status = begin(r, &b->twin, &at, end, err);
    if (status == MOTUS_OK && was_twin && !twin && !skip(r, &at, end)) status = damaged(err);
    if (!twin) { /* the state has no twin: the bars are those of one companion */
        b->kind = MOTUS_BARS_CHEAP;
        b->differences.twin = NULL;
    }
    if (status == MOTUS_OK) status = resume(r, was_twin, at, err);
    give(&r->allocator, kept);
    if (status != MOTUS_OK) return status;
    memcpy(r->mid_x, x, p->nx * sizeof *x);
    memcpy(r->mid_v, v, p->nv * sizeof *v);
    status = b->ahead ? bars_see(r, r->system, t, r->mid_x, r->mid_v, 0, err)
                      : bars_take(r, t, r->mid_x, r->mid_v, false, err);
    return status == MOTUS_OK && b->whole ? event_counts_touched(r, t, x, v, err) : status;
}
