/* The way of a stepper to a limit, and the way back from a failure. See stepper.h.
 *
 * Invariant: after a failure the stepper stands at its last good step: the state there is finite and, where a callback
 * computes the acceleration, can be observed. The stepper keeps the carried numbers every SNAPSHOT steps, at equal step
 * numbers on all machines. After a failure it goes back to them and repeats the good steps, to the same bits. For small
 * systems it keeps the snapshot before as well, from which a failure is explained (api/why/diagnosis.h).
 */
#include "core/stepper_parts.h"

#include <string.h>

enum { SNAPSHOT = 256 };

/* Failure --------------------------------------------------------------------------------------------------------- */

static int64_t next_snapshot(int64_t n) { return n - n % SNAPSHOT + SNAPSHOT; }

/* Makes the snapshot the earlier one. */
static void keep_earlier(stepper *s)
{
    if (!s->earlier) return;
    double *const kept = s->snapshot;
    s->snapshot = s->earlier, s->earlier = kept;
    s->earlier_at = s->at;
}

/* Forgets the snapshot after a failure, so that the next step begins with one. */
static void forget_snapshot(stepper *s)
{
    if (s->at.steps >= 0 && s->earlier_at.steps < 0) keep_earlier(s);
    s->at.steps = -1;
}

static void go_back(stepper *s) { stepper_put(s, s->at, s->snapshot); }

/* Evaluates a callback at the end of a step, where it may be undefined and some methods evaluate it only in the next
 * step: a step counts once the state after it can be observed. The next step reuses this evaluation. */
static int settle(stepper *s) { return s->problem.returned && s->work.waits ? s->body->observe(&s->work) : STEP_OK; }

/* Returns the number of finished steps that led to a finite state: all, or all but the last one. */
static int64_t good_steps(stepper *s, int bad)
{
    return s->work.n - (bad == STEP_DIVERGED && s->body->check(&s->work));
}

/* Repeats the steps from the snapshot to the last good one, which may itself end with STEP_STALLED. */
static void repeat(stepper *s, int64_t good)
{
    const int bad = stepper_repeat(s, good - s->work.n);
    if (bad && !(bad == STEP_STALLED && s->work.n == good)) go_back(s);
}

/* Goes from a failure after the snapshot back to the last good step, and reports the failure. */
static motus_status recover(stepper *s, int bad, motus_error *err)
{
    work *w = &s->work;
    double t = time_now(w);
    int64_t good = good_steps(s, bad);
    if (!w->check) { /* an infinity may be some steps old, and the cause of this failure */
        const size_t which = w->which;
        const bool in_v = w->in_v;
        const int64_t end = w->n;
        w->check = true;
        go_back(s);
        if (stepper_repeat(s, end - w->n) == STEP_DIVERGED) {
            bad = STEP_DIVERGED;
            t = time_now(w);
            good = good_steps(s, bad);
        } else {
            w->which = which;
            w->in_v = in_v;
        }
        w->check = false;
    }
    const motus_status status = stepper_report(s, bad, t, err);
    go_back(s);
    repeat(s, good);
    if (settle(s) && w->n > s->at.steps) { /* the last state cannot be observed; the state before it was evaluated */
        good = w->n - 1;
        go_back(s);
        repeat(s, good);
    }
    forget_snapshot(s);
    if (good == 0 && bad != STEP_CALLBACK && stepper_undefined(s, err)) return MOTUS_DIVERGED;
    return status;
}

/* Returns how many steps may follow before the next snapshot, after taking one that is due. */
static int64_t room_of(stepper *s)
{
    const work *w = &s->work;
    if (s->at.steps < 0 || w->n >= next_snapshot(s->at.steps)) {
        if (s->at.steps >= 0) keep_earlier(s);
        s->at = stepper_get(s, s->snapshot);
    }
    return next_snapshot(s->at.steps) - w->n;
}

/* Motion ---------------------------------------------------------------------------------------------------------- */

/* Takes steps, and returns STEP_OK or what stopped them, before any recovery. */
static int take_steps(stepper *s, const stepper_body *body, int64_t steps)
{
    work *w = &s->work;
    w->finite = false;
    if (s->library.tracing) trace_begin(w);
    w->watch = s->watching ? &s->watch : NULL;
    int bad = body->run(w, steps);
    w->watch = NULL;
    /* a recovery repeats these steps, and must not trace them again */
    s->library.tracing = NULL;
    return !bad && !w->check && !w->finite ? body->check(w) : bad;
}

/* A run may crawl if, at the pace of the last STEPPER_PACE steps, 2^24 more would not lead to the end, and steps were
 * once 10^4 times as long; or if 2^30 more would not. If the force jumps, the run does crawl: where the force pushes
 * back from both sides of the jump, like dry friction that sticks, no step can follow. If the force is smooth, the run
 * may just be long, and ends only if the judge finds a cause. The judge is asked after 1, 2, 4, 8 … times STEPPER_PACE
 * steps. The number of steps alone decides when, so all machines give the same answer. */
enum { PACE_LEFT = 1 << 8, PACE_LEFT_ALWAYS = 1 << 14 };
static const double PACE_FALL = 1e4;

bool stepper_may_crawl(int64_t steps, double gone, double left, double longest, bool smooth)
{
    const int64_t paces = steps / STEPPER_PACE;
    if (!(left < INFINITY) || left <= PACE_LEFT * gone) return false;
    if (left <= PACE_LEFT_ALWAYS * gone && gone / STEPPER_PACE * PACE_FALL > longest) return false;
    return !smooth || !(paces & (paces - 1));
}

void stepper_judged(stepper *s, stepper_judge judge, void *ctx) { s->judge = judge, s->judge_ctx = ctx; }

static motus_status get_on(stepper *s, motus_error *err)
{
    const work *w = &s->work;
    const double now = stepper_time(s), gone = fabs(now - s->pace_t), left = fabs(w->until - now);
    const bool known = s->pace_n == w->n - STEPPER_PACE, smooth = s->problem.traits.smooth;
    s->pace_n = w->n, s->pace_t = now;
    if (!known || !stepper_may_crawl(w->n, gone, left, w->longest, smooth)) return MOTUS_OK;
    if (!smooth) return stepper_crawls(s, STEPPER_PACE, gone, err);
    return s->judge ? s->judge(s->judge_ctx, s, STEPPER_PACE, gone, err) : MOTUS_OK;
}

motus_status stepper_crawls(const stepper *s, int64_t steps, double gone, motus_error *err)
{
    char t[DECIMAL_MAX];
    const double now = stepper_time(s);
    fail(err, MOTUS_STEPS, "the run crawls: at t = %s its last %lld steps led %.1e further, and to the end it is %.1e",
         decimal_time(now, s->work.h, t), (long long)steps, gone, fabs(s->work.until - now));
    hint(err, "end the run before");
    if (err) err->time = now;
    return MOTUS_STEPS;
}

static motus_status whole_steps(stepper *s, int64_t steps, const stepper_body *body, motus_error *err)
{
    work *w = &s->work;
    const int64_t end = steps < INT64_MAX - w->n ? w->n + steps : INT64_MAX;
    while (w->n < end && !(w->carried && w->t == w->until) && !(s->watching && s->watch.met)) {
        const bool paced = w->carried && (s->judge || !s->problem.traits.smooth);
        const int64_t due = paced ? STEPPER_PACE - w->n % STEPPER_PACE : INT64_MAX, most = room_of(s),
                      room = most < due ? most : due, chunk = end - w->n < room ? end - w->n : room;
        if (s->left_steps != w->n) s->left = false;
        const whole before = w->n;
        int bad = w->rise == STEPPER_BLURS ? STEP_STALLED : take_steps(s, body, chunk);
        /* all steps are taken, and only the next one is too short */
        if (bad == STEP_STALLED && w->n == before + chunk && stepper_may_blur(s))
            bad = STEP_OK, w->rise = STEPPER_BLURS;
        if (bad == STEP_STALLED && stepper_blurred(s, body)) continue;
        if (!bad) bad = settle(s);
        if (bad) return recover(s, bad, err);
        if (!paced || w->n % STEPPER_PACE) continue;
        const motus_status status = get_on(s, err);
        if (status) return status;
    }
    return MOTUS_OK;
}

/* The shorter last step begins a leg of its own from the synchronised state, so two-step methods take it in their
 * one-step form. */
static motus_status short_step(stepper *s, double last, const stepper_body *body, motus_error *err)
{
    work *w = &s->work;
    const size_t nx = w->nx;
    if (!stepper_ends(s)) return fail(err, MOTUS_MEMORY, "out of memory for the last step");
    double *x = s->ends + nx + 2 * w->nv, *v = x + nx;
    const double t = time_now(w);
    s->right = false;
    motus_status status = stepper_sync(s, x, v, NULL, err);
    if (status) return status;
    s->at = stepper_get(s, s->snapshot);
    stepper_begin(s, t, last, x, v);
    s->shortened = true;
    int bad = take_steps(s, body, 1);
    if (!bad) bad = settle(s);
    if (!bad) return MOTUS_OK;
    status = stepper_report(s, bad, time_now(w), err);
    go_back(s);
    forget_snapshot(s);
    return status;
}

stepper_way stepper_way_of(double t0, double h, double until)
{
    if (isnan(until)) return (stepper_way){INT64_MAX, 0};
    /* h and the quotient are rounded, so a remainder of a few roundings of q is no step of its own. */
    const double q = fabs(until - t0) / fabs(h), n = nearbyint(q);
    if (q > 0 && n == 0) return (stepper_way){0, until - t0}; /* a step longer than the way is cut to it */
    if (q >= 0x1p63) return (stepper_way){INT64_MAX, 0};
    if (fabs(q - n) <= 8 * 0x1p-52 * (q + 1)) return (stepper_way){(int64_t)n, 0};
    const double whole = floor(q);
    return (stepper_way){(int64_t)whole, until - (t0 + whole * h)};
}

int64_t stepper_steps_before(const stepper *s, double t)
{
    const work *w = &s->work;
    if (w->carried || s->arrived) return 0;
    const stepper_way way = stepper_way_of(w->t0, w->h, s->until);
    const double q = floor((t - w->t0) / w->h), sign = w->h < 0 ? -1 : 1;
    int64_t n = q >= (double)way.whole ? way.whole : (int64_t)q;
    if (sign * (stepper_time_of(s, n) - t) > 0) n--; /* the quotient was rounded up */
    return n > w->n ? n - w->n : 0;
}

/* Returns how many steps the leg may still take. */
static int64_t room_in_leg(const stepper *s)
{
    const int64_t most = s->work.carried && s->method.count > 0 ? s->method.count : INT64_MAX;
    return most > s->work.n ? most - s->work.n : 0;
}

static motus_status too_many(const stepper *s, motus_error *err)
{
    char t[DECIMAL_MAX];
    const double now = stepper_time(s);
    fail(err, MOTUS_STEPS, "the run is at t = %s after %lld steps, the most that it may take",
         decimal_time(now, s->work.h, t), (long long)s->work.n);
    hint(err,
         "allow more, `most_steps = %.0f` of the definition, or a larger error; a motion that comes near a "
         "singularity needs ever more",
         10.0 * (double)s->method.count);
    if (err) err->time = now;
    return MOTUS_STEPS;
}

static motus_status go(stepper *s, const stepper_limit *limit, const stepper_body *body, motus_error *err)
{
    work *w = &s->work;
    if (w->carried && w->t != limit->until) s->arrived = false; /* it was at an earlier end */
    if (s->arrived) return MOTUS_OK;
    s->until = limit->until;
    w->until = isnan(limit->until) ? INFINITY * w->h : limit->until;
    const stepper_way way = w->carried ? (stepper_way){INT64_MAX, 0} : stepper_way_of(w->t0, w->h, limit->until);
    const int64_t whole_way = way.whole > w->n ? way.whole - w->n : 0, room = room_in_leg(s);
    const int64_t left = whole_way < room ? whole_way : room, steps = limit->steps < left ? limit->steps : left;
    if (limit->steps > 0) { /* a mark is the left end of one step */
        s->left = s->left && limit->steps == 1 && s->left_steps == stepper_steps(s);
        s->right = false;
    }
    motus_status status = whole_steps(s, steps, body, err);
    if (!status && way.last != 0 && limit->steps > left) status = short_step(s, way.last, body, err);
    const bool whole = w->carried ? w->t == w->until : w->n >= way.whole && way.last == 0;
    s->arrived = !status && (whole || s->shortened);
    return !status && !s->arrived && limit->steps > room ? too_many(s, err) : status;
}

/* Refuses the last step, like one whose error is too large: nothing remains of it but the size of the next candidate.
 * Takes a snapshot, so that a recovery does not repeat the step. */
static motus_status take_back(stepper *s, double h, motus_error *err)
{
    work *w = &s->work;
    const int64_t before = w->n - 1, evaluations = w->evaluations, iterations = w->iterations, refused = w->refused;
    const double t = time_now(w);
    go_back(s);
    const int bad = stepper_repeat(s, before - w->n);
    if (bad) return stepper_report(s, bad, t, err);
    w->next = h, w->rise = 0;
    w->evaluations = evaluations, w->iterations = iterations, w->refused = refused + 1;
    s->at = stepper_get(s, s->snapshot);
    s->arrived = s->right = false;
    return MOTUS_OK;
}

void stepper_inspected(stepper *s, stepper_inspector inspector, void *ctx)
{
    s->inspector = inspector, s->inspector_ctx = ctx, s->rest = 0;
}

/* Takes a step and shows it to the inspector, until the step stands. */
static motus_status inspected_step(stepper *s, double until, bool *halt, motus_error *err)
{
    const stepper_limit one = {1, until};
    stepper_verdict verdict = {0};
    motus_status status = stepper_mark(s, err);
    if (!status) status = go(s, &one, s->body, err);
    while (!status && (verdict = s->inspector(s->inspector_ctx, s)).again != 0) {
        status = take_back(s, verdict.again, err);
        if (!status) status = go(s, &one, s->body, err);
    }
    s->rest = verdict.rest, *halt = verdict.halt;
    return status;
}

static motus_status inspected(stepper *s, stepper_limit limit, bool *halt, motus_error *err)
{
    motus_status status = MOTUS_OK;
    *halt = false;
    while (limit.steps > 0 && !status && !s->arrived && !*halt) {
        const int64_t rest = s->rest < limit.steps ? s->rest : limit.steps;
        status =
            rest ? go(s, &(stepper_limit){rest, limit.until}, s->body, err) : inspected_step(s, limit.until, halt, err);
        limit.steps -= rest ? rest : 1;
        if (rest) s->rest -= rest;
    }
    return status;
}

motus_status stepper_advance(stepper *s, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    const bool looks = s->inspector && !s->watching && limit.steps > 0;
    bool halt = false;
    motus_status status = s->asked && !looks && !s->watching && limit.steps == 1 ? stepper_mark(s, err) : MOTUS_OK;
    if (!status) status = looks ? inspected(s, limit, &halt, err) : go(s, &limit, s->body, err);
    if (why) *why = status ? STOP_FAILED : s->arrived ? STOP_UNTIL : halt ? STOP_HALT : STOP_STEPS;
    return status;
}

static bool show(watch *w)
{
    const stepper *s = w->ctx;
    const double span = s->work.carried ? watch_span(w) : s->work.h;
    return s->watcher->quiet(s->watcher->ctx,
                             &(stepper_shown){span, w->t, w->to_t, w->from_x, w->from_v, w->to_x, w->to_v, w->most});
}

/* Takes the memory for the ends of watched steps. False: there is none. */
static bool watch_room(stepper *s, const stepper_watcher *by)
{
    const size_t nx = s->work.nx, nv = s->work.nv;
    if (!s->watched) s->watched = take(&s->allocator, 2 * nx + 5 * nv, sizeof *s->watched);
    if (!s->watched) return false;
    watch *to = &s->watch;
    to->from_x = s->watched, to->from_v = to->from_x + nx;
    to->to_x = to->from_v + nv, to->to_v = to->to_x + nx;
    to->most = to->to_v + nv;
    to->from_a = to->most + nv, to->to_a = to->from_a + nv;
    to->largest_x = by->largest, to->largest_v = by->largest + nx;
    to->middle = by->middle, to->width = by->width;
    to->least = by->least, to->functions = by->functions;
    to->quiet = show, to->ctx = s;
    return true;
}

/* Makes the state before the last watched step the mark of dense output. */
static motus_status mark_watched(stepper *s, motus_error *err)
{
    work *w = &s->work;
    const size_t nx = w->nx, nv = w->nv;
    double *x = s->ends, *v = x + nx;
    memcpy(x, s->watch.from_x, nx * sizeof *x);
    memcpy(v, s->watch.from_v, nv * sizeof *v);
    s->left = true, s->right = false;
    s->left_t = s->watch.t;
    s->left_lost = s->watch.lost;
    s->left_steps = s->watch.n;
    if (w->expands) return MOTUS_OK;
    const int64_t evaluations = w->evaluations;
    const int bad = s->body->accel(w, s->left_t, x, v, v + nv);
    w->evaluations = evaluations;
    return bad ? stepper_report(s, bad, s->left_t, err) : MOTUS_OK;
}

bool stepper_can_watch(const stepper *s)
{
    const bool fixed = row_bounded_by_ends(&s->method) && s->work.nv <= STEPPER_WATCHED_MOST && !s->shortened;
    return (row_watched(&s->method) || fixed) && !s->problem.refresh && !s->arrived && room_in_leg(s) > 0;
}

bool stepper_bounded(const stepper *s)
{
    if (!row_bounded_by_ends(&s->method)) return stepper_can_watch(s);
    return !s->problem.refresh && !s->arrived && !s->shortened && s->work.n > 0;
}

motus_status stepper_watch(stepper *s, stepper_limit limit, const stepper_watcher *by, stepper_left *left,
                           stepper_stop *why, motus_error *err)
{
    watch *w = &s->watch;
    const int64_t before = stepper_steps(s), room = room_in_leg(s);
    *left = (stepper_left){0};
    if (!stepper_ends(s) || !watch_room(s, by)) return fail(err, MOTUS_MEMORY, "out of memory for dense output");
    if (limit.steps > room) limit.steps = room; /* the next step reports that there is no more room */
    s->watcher = by;
    w->met = w->known = false, w->n = -1;
    s->watching = true;
    const motus_status status = stepper_advance(s, limit, why, err);
    s->watching = false;
    if (w->n < 0) return status;
    /* where a failure was found late, the run may stand before the last step that was begun */
    const bool earlier = w->n > stepper_steps(s);
    motus_status marked = MOTUS_OK;
    if (earlier) marked = stepper_sync(s, w->from_x, w->from_v, NULL, NULL);
    if (earlier) w->n = stepper_steps(s), w->t = stepper_time(s), w->lost = stepper_lost(s);
    if (!earlier && !s->work.carried) w->lost = stepper_lost_at(s, w->n);
    *left = (stepper_left){w->n - before, w->t, w->lost, w->from_x, w->from_v, w->shown && !earlier};
    if (!marked) marked = mark_watched(s, status ? NULL : err);
    return status ? status : marked;
}

motus_status stepper_again(stepper *s, motus_error *err)
{
    work *w = &s->work;
    const int64_t end = w->n;
    const double last = w->h;
    const bool shortened = s->shortened, arrived = s->arrived;
    /* no step has been taken since the start or a restart */
    if (s->at.steps < 0 || (!shortened && s->at.steps >= end)) return MOTUS_OK;
    s->arrived = false;
    go_back(s);
    int bad = shortened ? STEP_OK : stepper_repeat(s, end - 1 - w->n);
    motus_status status = bad ? stepper_report(s, bad, time_now(w), err) : stepper_mark(s, err);
    if (status) return status;
    if (shortened)
        status = short_step(s, last, s->body, err);
    else if ((bad = stepper_repeat(s, 1)))
        status = stepper_report(s, bad, time_now(w), err);
    s->arrived = arrived && !status;
    return status;
}

motus_status stepper_trace(stepper *s, double until, const tracer *to, motus_error *err)
{
    const tracing tracing = {.to = to, .iterations = s->work.iterations};
    s->library.tracing = &tracing;
    const motus_status status = go(s, &(stepper_limit){1, until}, &trace_body, err);
    s->library.tracing = NULL;
    return status;
}
