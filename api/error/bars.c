/* When companions start, and where they land. See bars.h. */
#include "api/error/bars.h"

#include "api/request/choice.h"
#include "api/error/event_bars.h"
#include "api/motion/later.h"
#include "api/motion/run_events.h"
#include "api/system/system.h"
#include "api/system/vector.h"
#include "api/why/diagnosis.h"

#include <math.h>
#include <string.h>

static int tell(void *ctx, double now)
{
    motus_run *r = ctx;
    return r->pace.tell(r, now);
}

/* Moves a companion to its compiled machine; if that cannot be, it goes on in the interpreter. */
static motus_status take_machine(companion *c, compiled_state state, const machine *m)
{
    c->waits = state == COMPILED_WAIT;
    if (state != COMPILED_READY) return MOTUS_OK;
    motus_error why = motus_default_error();
    const motus_status status = c->stepper ? stepper_move(&c->stepper, m, &why) : MOTUS_OK;
    if (status == MOTUS_OK) c->machine = *m;
    return status == MOTUS_MEMORY ? MOTUS_OK : status;
}

/* Compiles the companion's system. It is not the run's, but usually has the same text, which is compiled already. */
static motus_status compile_half(motus_run *r, motus_error *err)
{
    companion *c = &r->bars->half;
    const char *why = NULL;
    compiled_state state;
    machine m;
    if (!c->system) return MOTUS_OK; /* the system is made later, for the run's machine */
    const chosen method = companion_method(&r->chosen, r->system);
    motus_status status = choice_begin(c->system, &method, &state, &m, &why, err);
    if (status == MOTUS_OK) status = take_machine(c, state, &m);
    if (c->waits) later_hurry(r);
    return status;
}

static motus_status go_compiled(motus_run *r, motus_error *err)
{
    r->bars->kept = false;
    motus_status status = compile_half(r, err);
    return status == MOTUS_OK ? take_machine(&r->bars->twin, COMPILED_READY, &r->machine) : status;
}

static bool waits(const motus_run *r) { return compiled_anywhere() && r->bars->half.waits; }

static motus_status look(motus_run *r, motus_error *err)
{
    const char *why = NULL;
    compiled_state state;
    machine m;
    if (!waits(r)) return MOTUS_OK;
    companion *c = &r->bars->half;
    const chosen method = companion_method(&r->chosen, r->system);
    motus_status status = choice_look(c->system, &method, &state, &m, &why, err);
    c->waits = state == COMPILED_WAIT;
    return status == MOTUS_OK ? take_machine(c, state, &m) : status;
}

static void destroy(motus_run *r)
{
    const chosen method = companion_method(&r->chosen, r->system);
    if (waits(r)) choice_leave(r->bars->half.system, &method);
    witness_destroy(r->bars->witness);
    companion_end(&r->bars->half, &r->allocator);
    companion_end(&r->bars->twin, &r->allocator);
    give(&r->allocator, r->bars->columns);
    give(&r->allocator, r->bars->whole);
    give(&r->allocator, r->bars->memory);
    give(&r->allocator, r->bars->room);
    give(&r->allocator, r->bars->steep);
    give(&r->allocator, r->bars->open_since);
    give(&r->allocator, r->bars->resumed);
    give(&r->allocator, r->bars);
}

void bars_move(motus_run *r)
{
    r->bars->half.pace = r->bars->twin.pace =
        (pace){.seconds = r->pace.seconds, .tell = r->pace.tell ? tell : NULL, .ctx = r};
}

/* ---- the start ---- */

/* Returns whether a callback gives the same acceleration twice; else two runs of it are two motions. */
static bool repeats(motus_run *r, const double *x, const double *v)
{
    const problem *p = &r->system->problem;
    if (r->system->model) return true;
    double *room = take(&r->allocator, 2 * p->nv + p->nx + p->nv, sizeof *room);
    if (!room) return true; /* bars_ready will report it */
    double *a = room, *again = a + p->nv, *at_x = again + p->nv, *at_v = at_x + p->nx;
    bool same = true;
    for (int i = 0; i < 2 && same; i++) {
        memcpy(at_x, x, p->nx * sizeof *x);
        memcpy(at_v, v, p->nv * sizeof *v);
        same = !p->accel(p->ctx, r->timing.t0, at_x, at_v, i ? again : a);
    }
    for (size_t k = 0; k < p->nv; k++) same = same && (a[k] == again[k] || (isnan(a[k]) && isnan(again[k])));
    give(&r->allocator, room);
    return same;
}

motus_status bars_ready(motus_run *r, const uint8_t *affected, motus_error *err)
{
    companion *c = &r->bars->half;
    if (c->system) return MOTUS_OK;
    motus_status status = shadow_create(r->system, affected, &c->system, err);
    if (status != MOTUS_OK) return status;
    const char *why = NULL;
    c->machine = c->system->machine;
    c->pace = (pace){.seconds = r->pace.seconds, .tell = r->pace.tell ? tell : NULL, .ctx = r};
    r->bars->twin.machine = r->machine;
    r->bars->twin.pace = c->pace;
    if (strcmp(r->machine.name, "compiled") != 0) return MOTUS_OK;
    if (compiled_anywhere() && r->later.automatic) return compile_half(r, err);
    const chosen method = companion_method(&r->chosen, r->system);
    return choice_compile(c->system, &method, false, r->bars->kept, &c->machine, &why, err);
}

/* Begins the half where the model says, with its decimals rounded the other way, or where the caller put the run. The
 * start time is such a decimal too, so the half begins earlier or later by its rounding. */
static motus_status begin_half(motus_run *r, double *x, double *v, motus_error *err)
{
    bars *b = r->bars;
    const motus_system *s = b->half.system;
    const problem *p = &s->problem;
    const double t = stepper_time(r->stepper);
    if (!b->given_x && p->nx) memcpy(x, s->x0, p->nx * sizeof *x);
    if (!b->given_v) memcpy(v, s->v0, p->nv * sizeof *v);
    if (p->refresh) p->refresh(p->ctx, t, x, v);
    const double off =
        b->given_x || b->given_v ? 0 : bars_time_rounding(t, s->model ? r->system->start : NAN, s->start);
    double *to_x = x, *to_v = v;
    motus_status status = MOTUS_OK;
    if (off != 0) status = bars_later(r, b->half.system, t, -off, x, v, &to_x, &to_v, err);
    return status == MOTUS_OK ? companion_begin(&b->half, r, t, to_x, to_v, err) : status;
}

/* Finds how far the rounding of the positions moves each acceleration; room: accelerations, then positions. Returns the
 * largest of these roundings; 0: not known. */
static double take_steep(const problem *p, double t, double *x, double *v, double *steep, double *room)
{
    double unit = 0, *const there = room, *const moved = there + p->nv;
    memcpy(moved, x, p->nx * sizeof *x);
    for (size_t k = 0; k < p->nx - p->modes; k++) {
        companion_move(moved + k, 1, NULL, (uint32_t)k);
        unit = fmax(unit, fabs(moved[k] - x[k]));
    }
    memset(steep, 0, p->nv * sizeof *steep);
    memset(there, 0, p->nv * sizeof *there);
    const bool known = !p->accel(p->ctx, t, x, v, steep) && !p->accel(p->ctx, t, moved, v, there);
    for (size_t k = 0; k < p->nv; k++) {
        const double apart = fabs(there[k] - steep[k]);
        steep[k] = known && isfinite(apart) ? apart : 0;
    }
    return known ? unit : 0;
}

static motus_status begin_steep(motus_run *r, motus_error *err)
{
    bars *b = r->bars;
    const problem *const p = &r->system->problem;
    if (!r->events) return MOTUS_OK;
    if (!b->steep) b->steep = take(&r->allocator, 3 * p->nv + p->nx + 1, sizeof *b->steep);
    if (!b->steep) return fail(err, MOTUS_MEMORY, "no memory for bars of error");
    take_steep(p, stepper_time(r->stepper), r->x, r->v, b->steep, b->steep + 2 * p->nv);
    return MOTUS_OK;
}

static motus_status begin_at(motus_run *r, bool observed, motus_error *err)
{
    bars *b = r->bars;
    motus_status status = bars_ready(r, NULL, err);
    if (status == MOTUS_OK) status = run_sync(r, false, err);
    if (status != MOTUS_OK) return status;
    const problem *p = &r->system->problem;
    if (!repeats(r, r->x, r->v)) {
        bars_give_up(r, "the callback gives another acceleration when it is called again with the same numbers");
        return MOTUS_OK;
    }
    status = begin_steep(r, err);
    if (status != MOTUS_OK) return status;
    if (b->resumed) return bars_kept_begin(r, r->x, r->v, err);
    double *x = r->mid_x, *v = r->mid_v;
    memcpy(x, r->x, p->nx * sizeof *x);
    memcpy(v, r->v, p->nv * sizeof *v);
    status = begin_half(r, x, v, err);
    if (status == MOTUS_OK && b->kind == MOTUS_BARS_FULL) {
        memcpy(x, r->x, p->nx * sizeof *x);
        memcpy(v, r->v, p->nv * sizeof *v);
        companion_move(x, p->nx - p->modes, NULL, 0);
        companion_move(v, p->nv, NULL, (uint32_t)p->nx);
        if (p->refresh) p->refresh(p->ctx, r->timing.t0, x, v);
        status = companion_begin(&b->twin, r, r->timing.t0, x, v, err);
    }
    differences_begin(&b->differences, r->timing.t0, r->timing.until);
    b->landed = stepper_time(r->stepper);
    b->steps = run_steps(r);
    if (status == MOTUS_OK) status = bars_take(r, b->landed, r->x, r->v, observed, err);
    return status == MOTUS_OK && b->whole ? event_counts_touched(r, b->landed, r->x, r->v, err) : status;
}

/* Turns an error of a companion into a reason for no bars. Only lack of memory and cancellation also end the run. */
static motus_status judge(motus_run *r, motus_status status, motus_error *theirs, motus_error *err)
{
    companion *const c = &r->bars->half;
    if (status == MOTUS_OK) return MOTUS_OK;
    if (c->system && c->system->model && c->system->model->table_count) /* it may have left one */
        diagnosis_add(&(diagnosed){c->system, NULL, r->diagnosed.leads}, c->stepper, theirs);
    bars_give_up(r, "a companion run failed: %s", theirs->message);
    if (status == MOTUS_MEMORY) return fail(err, status, "%s", theirs->message);
    if (status != MOTUS_CANCELLED) return MOTUS_OK;
    char t[DECIMAL_MAX];
    return fail(err, status, "cancelled at t = %s", run_time_text(r, stepper_time(r->stepper), t));
}

static motus_status start(motus_run *r, bool observed, motus_error *err)
{
    motus_error theirs = motus_default_error();
    const double began = pace_now();
    r->bars->started = true;
    if (r->locate) bars_give_up(r, "a run that locates switches has no companion");
    if (r->bars->why[0]) return MOTUS_OK;
    const motus_status status = begin_at(r, observed, &theirs);
    r->bars->seconds += pace_now() - began;
    return judge(r, status, &theirs, err);
}

void bars_forget_events(motus_run *r)
{
    bars *b = r->bars;
    if (b->half.events) events_forget(b->half.events);
    if (b->twin.events) events_forget(b->twin.events);
    b->gap = b->rows_differ = b->end_reached = false;
    b->rows = 0;
    give(&r->allocator, b->open_since);
    b->open_since = NULL;
}

static void begin_leg(motus_run *r) { bars_again(r, true); }

/* ---- landings ---- */

/* Returns whether a landing can still tell bars. */
static bool alive(const bars *b) { return !b->why[0] && isnan(b->differences.until); }

/* Returns the step at which the next landing is due. */
static int64_t due(const motus_run *r)
{
    const int64_t before = r->bars->steps;
    return row_adaptive(&r->chosen) ? before + 1 : differences_due(r->timing.total, before);
}

/* Units in the last place of the time. Events closer than this, as when they accumulate, need not have the same order
 * in two computations of one motion. */
#define CLOSE 1024
/* The part of a steep force's effect on roundings by which `spread` moves the companion. With 0.3, 1.1 % of 22 500
 * numbers of balls on stiff floors were beyond their bars, 0.2 per mille far beyond, and 81 % of the bars were tight;
 * with 0: 1.8 %, 0.9 per mille, 84 %. */
#define STEEP 0.3
/* A companion need not be moved by less than this multiple of its distance from the run. */
#define SHOWN 2.0

/* Returns whether a companion has had the run's events up to t: the time of its state, or one within its last step. */
static bool along(const motus_run *r, const companion *c, double t, bool between)
{
    if (!r->events || !c->events) return true;
    if (between) return !c->over && events_acted_before(r->events, t) == events_acted(c->events);
    if (c->over != run_events_ended(r)) return false;
    /* where events accumulate, each has had as many of them as it could tell apart */
    return events_acted(r->events) == events_acted(c->events) || events_accumulated(r->events, NULL);
}

static motus_status reach_both(bars *b, const companion_goal *to, double span, motus_error *err)
{
    const motus_status status = companion_reach(&b->half, to, span, err);
    return status == MOTUS_OK && b->twin.events ? companion_reach(&b->twin, to, span, err) : status;
}

/* Where the run stands at an event, leads the companions to theirs, which may come later. */
static motus_status reach(motus_run *r, double t, motus_error *err)
{
    bars *b = r->bars;
    const bool ends = run_events_ended(r);
    double interval = events_interval(r->events);
    const double way = r->timing.until - r->timing.t0;
    const double least = CLOSE * events_ulp(t), most = fabs(way) / 8;
    if (interval / 4 < least) interval = 4 * least;
    const double span = copysign(!ends && interval / 4 < most ? interval / 4 : most, way);
    if (!ends && events_latest(r->events) != t) return MOTUS_OK;
    /* Where events accumulate, a step much longer than the time left before the limit would not tell the events in it
     * apart. And the companion may be too far off to end at its limit: it is then enough that it has had as many
     * actions. */
    const bool limit = ends && events_accumulated(r->events, NULL);
    const double tail = limit ? copysign(8 * events_tail(r->events), way) : 0;
    companion_goal to = {events_acted(r->events), ends, !ends};
    motus_status status = MOTUS_OK;
    if (tail != 0 && fabs(tail) < fabs(span)) status = reach_both(b, &to, tail, err);
    to.enough |= limit;
    return status == MOTUS_OK ? reach_both(b, &to, span, err) : status;
}

/* Notes a gap. Where run and companion differ in events for half the time between events, they are different motions;
 * but before events accumulate they may have had different numbers of them. */
static void notice_gap(motus_run *r, double t, bool between)
{
    bars *b = r->bars;
    const bool gap = !along(r, &b->half, t, between) || (!between && b->twin.events && !along(r, &b->twin, t, false));
    if (gap && !b->gap) b->gap_since = t;
    b->gap = gap;
    const double least = CLOSE * events_ulp(t), half = events_interval(r->events) / 2;
    const bool gathers = events_tail(r->events) != 0, lasts = !gathers && fabs(t - b->gap_since) > fmax(half, least);
    if (gap && (lasts || (run_events_ended(r) && !between))) b->differences.until = b->gap_since;
}

/* Returns whether the distance of a companion at t already covers how far it is to be moved. */
static bool shows(const companion *c, const problem *p, const double *x, const double *v, const witness_move *to)
{
    double apart[2] = {0, 0};
    for (size_t k = 0; k < p->nx; k++) apart[0] = fmax(apart[0], fabs(c->x[k] - x[k]));
    for (size_t k = 0; k < p->nv; k++) apart[1] = fmax(apart[1], fabs(c->v[k] - v[k]));
    return SHOWN * apart[0] >= vector_largest(to->x, p->nx) && SHOWN * apart[1] >= vector_largest(to->v, p->nv);
}

/* Moves the companion away from the run where a force is steep. Such a force turns the rounding δ of positions into a
 * change of velocity, about ω δ for a contact of rate ω. In one contact the roundings are so few that run and companion
 * often differ by a tenth of that or less. With these moves they part as in a random walk of such changes. */
static motus_status spread(motus_run *r, double t, double *x, double *v, motus_error *err)
{
    bars *b = r->bars;
    companion *const c = &b->half;
    const problem *const p = &r->system->problem;
    double *const before = b->steep, *const now = before + p->nv, *const room = now + p->nv;
    double *const dv = room, *const dx = dv + p->nv;
    const double unit = take_steep(p, t, x, v, now, room), h = fabs(t - b->landed);
    bool moves = false;
    memset(dv, 0, (p->nv + p->nx) * sizeof *dv);
    for (size_t k = 0; k < p->nx - p->modes; k++) {
        const double most = fmax(before[k], now[k]), size = STEEP * fmin(h * most, sqrt(unit * most));
        const double apart = c->v[k] - v[k];
        if (!(size > events_ulp(v[k]))) continue; /* less than the velocity's rounding */
        dv[k] = copysign(hypot(apart, size), apart) - apart;
        moves = true;
    }
    memcpy(before, now, p->nv * sizeof *before);
    return moves ? companion_shift(c, r, dx, dv, err) : MOTUS_OK;
}

static motus_status land(motus_run *r, double t, double *x, double *v, bool between, bool observed, motus_error *err)
{
    bars *b = r->bars;
    const int64_t now = run_steps(r), taken = now - b->steps;
    const double began = pace_now();
    witness_move move = {NAN, NULL, NULL};
    const bool moves = witness_moves(b->witness, &move), leads = moves && !isnan(move.from);
    motus_status status = companion_land(&b->half, r, leads ? move.from : t, taken > 1 ? taken - leads : 1, err);
    if (status == MOTUS_OK && leads) status = companion_led(&b->half, r, b->witness, t, err);
    const bool shifts = moves && !leads && !between && !shows(&b->half, &r->system->problem, x, v, &move);
    if (status == MOTUS_OK && shifts) status = companion_shift(&b->half, r, move.x, move.v, err);
    if (moves && !between) witness_moved(b->witness);
    if (status == MOTUS_OK && row_formula(&r->chosen)) status = companion_jog(&b->half, r, err);
    if (status == MOTUS_OK && b->kind == MOTUS_BARS_FULL && !between) status = companion_repeat(&b->twin, r, err);
    const double differs = witness_differs(b->witness, NULL);
    char at[DECIMAL_MAX];
    if (!isnan(differs))
        bars_give_up(r, "near t = %s the force changes more within every step than the step shows",
                     run_time_text(r, differs, at));
    else if (!isnan(witness_unseen(b->witness)))
        bars_give_up(r, "the force has so many narrow peaks that from t = %s on not all steps were searched for them",
                     run_time_text(r, witness_unseen(b->witness), at));
    if (status == MOTUS_OK && r->events && !between) status = reach(r, t, err);
    if (status == MOTUS_OK && r->events) notice_gap(r, t, between);
    const bool together = r->events && !between && !b->gap && !b->half.over && b->half.t == t;
    if (status == MOTUS_OK && together) status = spread(r, t, x, v, err);
    b->differences.between = between;
    if (status == MOTUS_OK && !b->gap) status = bars_take(r, t, x, v, observed, err);
    b->landed = t;
    if (status == MOTUS_OK && together && b->whole) status = event_counts_touched(r, t, x, v, err);
    b->steps = between ? now - 1 : now;
    b->seconds += pace_now() - began;
    return status;
}

/* Refuses a motion that the typed force does not make. */
static motus_status refute(const motus_run *r, motus_error *err)
{
    size_t k;
    const double t = witness_differs(r->bars->witness, &k);
    char at[DECIMAL_MAX], name[MOTUS_NAME_MAX] = "";
    if (isnan(t) || k == SIZE_MAX) return MOTUS_OK;
    const problem *const p = &r->home->problem;
    if (p->name) p->name(p->ctx, true, k, name, sizeof name);
    fail(
        err, MOTUS_SOLVE,
        "from t = %s on the run has another force on %s than the one that is written, whatever sides its switches have "
        "there",
        run_time_text(r, t, at), name);
    hint(err, "lead across the switches, with `switches = MOTUS_SWITCHES_STEP` of the definition");
    return MOTUS_SOLVE;
}

static motus_status land_here(motus_run *r, bool observed, motus_error *err)
{
    bars *b = r->bars;
    const double t = stepper_time(r->stepper), way = r->timing.h < 0 ? -1 : 1;
    motus_error theirs = motus_default_error();
    motus_status status = b->started ? MOTUS_OK : start(r, observed, err);
    const double gone = way * (t - b->landed);
    /* of events that accumulate the last may have the time of the one before it */
    const bool ends = gone == 0 && !b->ahead && !b->end_reached && run_events_ended(r);
    if (status != MOTUS_OK || !alive(b) || (b->ahead ? gone < 0 : gone <= 0 && !ends)) return status;
    status = run_sync(r, false, &theirs);
    b->end_reached = run_events_ended(r);
    if (status == MOTUS_OK && (gone > 0 || ends)) status = land(r, t, r->x, r->v, false, observed, &theirs);
    if (status == MOTUS_OK && gone == 0 && !ends) {
        status = bars_take(r, t, r->x, r->v, observed, &theirs);
        b->steps = run_steps(r);
    }
    b->ahead = false;
    status = judge(r, status, &theirs, err);
    return status ? status : refute(r, err);
}

motus_status bars_land(motus_run *r, motus_error *err) { return land_here(r, false, err); }
motus_status bars_observe(motus_run *r, motus_error *err) { return land_here(r, true, err); }

static motus_status ask_room(motus_run *r, int64_t *steps, motus_error *err)
{
    bars *b = r->bars;
    const int64_t now = run_steps(r);
    motus_status status = b->started ? MOTUS_OK : start(r, false, err);
    *steps = INT64_MAX;
    if (status == MOTUS_OK && alive(b) && (now >= due(r) || witness_waits(b->witness))) status = bars_land(r, err);
    if (status == MOTUS_OK && alive(b)) *steps = due(r) > now ? due(r) - now : 1;
    return status;
}

motus_status bars_land_between(motus_run *r, double t, double *x, double *v, motus_error *err)
{
    bars *b = r->bars;
    const double way = r->timing.h < 0 ? -1 : 1;
    motus_error theirs = motus_default_error();
    if (!b->started || !alive(b) || way * (t - b->landed) <= 0) return MOTUS_OK;
    return judge(r, land(r, t, x, v, true, false, &theirs), &theirs, err);
}

/* ---- the company of a run ---- */

static motus_status begin(motus_run *r, motus_error *err)
{
    return witness_create(r, &r->bars->differences, false, &r->bars->witness, err);
}

static void run_failed(motus_run *r) { bars_give_up(r, "the run failed"); }

/* `before` lands when a landing is due and not earlier, because the caller may ask for times within the last step. */
static const run_company company = {.begin = begin,
                                    .leg = begin_leg,
                                    .before = ask_room,
                                    .failed = run_failed,
                                    .compile = go_compiled,
                                    .waits = waits,
                                    .look = look,
                                    .end = destroy};

motus_status bars_make(motus_run *r, motus_bars kind, const size_t *columns, const int *how, size_t count,
                       motus_error *err)
{
    const differences_shape shape = bars_shape(r->system, r->card, kind, how, count);
    bars *b = r->bars = take(&r->allocator, 1, sizeof *b);
    if (!b) return fail(err, MOTUS_MEMORY, "no memory for bars of error");
    *b = (bars){.kind = kind, .count = count};
    r->company = &company;
    b->columns = take(&r->allocator, count, sizeof *b->columns);
    b->memory = take(&r->allocator, differences_size(&shape), sizeof *b->memory);
    b->room = take(&r->allocator, bars_moved_room(r->system, count), sizeof *b->room);
    if (!b->columns || !b->memory || !b->room) return fail(err, MOTUS_MEMORY, "no memory for bars of error");
    for (size_t k = 0; k < count; k++) b->columns[k] = columns ? columns[k] : k;
    differences_place(&b->differences, &shape, b->memory);
    return event_bars_whole(r, err);
}

motus_status bars_prepare(motus_run *r, const motus_run_def *def, motus_error *err)
{
    if ((unsigned)def->error > MOTUS_BARS_FULL)
        return fail(err, MOTUS_ARGUMENT, "there is no kind of bars %d", (int)def->error);
    if (def->error == MOTUS_BARS_NONE) return MOTUS_OK;
    motus_status status = bars_make(r, def->error, NULL, NULL, r->system->column_count, err);
    if (status != MOTUS_OK) return status;
    r->bars->kept = r->kept;
    r->bars->given_x = def->x, r->bars->given_v = def->v;
    return MOTUS_OK;
}
