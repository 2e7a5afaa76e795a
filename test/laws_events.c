/* LAWS OF EVENTS. Through an event that assigns, and through a switch of the force that is located, the error of its
 * time and of the state at a fixed time after it falls with the order of the row; by rows of fixed step the run is made
 * of steps that begin anew at the event and end on the grid; where steps adapt, the error falls with the tolerance. An
 * event that only records changes no bit, no step and no evaluation. Where a function has other signs at the ends of a
 * step, it has an odd number of events within, else an even one: none is lost, however coarse the step.
 *
 * Invariant: the event divides a step in the same part at all sizes of step, and errors are mean squares over
 * several starts; so an error is a power of the step and little else. Doubles show it from the step where the error is
 * far above their rounding to one three times as long. The margin is what the slope still changes between the two
 * halves of these steps, and twice its standard error; above order 7 they reach over less than two halvings, and the
 * slope is only to tell the order from what dense output or a start of low order would leave of it; that no order is
 * lost there is the law of parts, which is exact.
 */
#include "api/system/system.h"
#include "core/rows.h"
#include "test/fit.h"
#include "test/laws.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* THETA: of a step, before the event. SERIES: the order of Taylor series whose steps are given. */
enum { STARTS = 8, NUMBERS = 2, POINTS = 64, SERIES = 12, RECORDS = 32 };
#define THETA 0.375
#define FAR 12 /* a time after the event */

typedef struct motion {
    const char *name, *text;
    bool switches; /* no event acts: the force itself jumps, and steps end there (api/system/system.h) */
} motion;

/* A velocity jumps; a mode changes the force alone, so that an acceleration from before the event is wrong after it;
 * both, with a force that depends on the velocity. */
static const motion motions[] = {
    {"velocity jumps", "x'' = -x - x^2/4 + cos(t)/8; x(0) = 1; x'(0) = 0.25\nwhen x + 2 t > 17: x' = -0.75 x', record",
     false},
    {"force jumps", "k = 1; x'' = -k x + x^3/32 + cos(t)/8; x(0) = 1; x'(0) = 0.25\nwhen x + 2 t > 17: k = 0.5, record",
     false},
    {"drag jumps",
     "c = 0.25; x'' = -x - x^2/4 - c x'/2 - c x'^2/8 + cos(t)/8; x(0) = 1; x'(0) = 0.25\n"
     "when x + 2 t > 17: x' = -0.75 x', c = -0.25, record",
     false},
    {"force switches",
     "x'' = -x - x^2/4 + cos(t)/8 + if(x + 2 t > 17, 0.3 - x/4, 0); x(0) = 1; x'(0) = 0.25\nwhen x + 2 t > 17: record",
     true},
    {"force has a kink",
     "x'' = -x - x^3/32 + cos(t)/8 + max(0, x + 2 t - 17)/8; x(0) = 1; x'(0) = 0.25\nwhen x + 2 t > 17: record", true},
};
/* By long steps, on which dense output of a row of low order errs as much as the row does. */
static const char *const crossed = "x'' = -x - x^2/4 + cos(t)/8; x(0) = 1; x'(0) = 0.25\n"
                                   "when x = 0.25: record\nwhen x' = 0.1: record\nwhen x = x': record";
static const char *const recorded =
    "x'' = -x - x^2/4 + cos(t)/8; x(0) = 1; x'(0) = 0.25\n"
    "when x = 0.25: record\nwhen x' = 0 falling: record\nwhen x > x' and t > 3: record\n"
    "when every 0.3: record";

/* What is known of a run: its first event and the state on arrival and after it, and the state at the end. */
typedef struct outcome {
    size_t events;
    double t, before[2 * NUMBERS], after[2 * NUMBERS], end[2 * NUMBERS];
    int64_t steps, evaluations;
    double off_grid; /* the largest distance of a step's end from its grid, in units in the last place */
} outcome;

static motus_system *read(const char *text)
{
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.text = text;
    if (motus_system_from_text(&def, &s, &err)) printf("%s\n", err.message), abort();
    if (s->problem.nx > NUMBERS || s->problem.nv > NUMBERS) abort();
    return s;
}

/* The system whose steps end where its force switches; the other owns it. */
static motus_system *located(motus_system *s)
{
    motus_system *out;
    const char *why;
    if (located_of(s, MOTUS_SWITCHES_LOCATE, &out, &why, NULL) || !out) printf("%s\n", why), abort();
    if (out->problem.nx > NUMBERS || out->problem.nv > NUMBERS) abort();
    return out;
}

static chosen by_name(const char *name)
{
    chosen c;
    if (row_choose(name, &c, NULL, NULL)) abort();
    return c;
}

static bool admits(size_t m, const motus_system *s)
{
    const chosen c = by_name(row_card(m)->name);
    return methods_table[m].family != EXACT && row_admits(&c, &s->problem.traits, NULL) == MOTUS_OK;
}

/* A row that takes steps of size h whatever their error; of those that follow a time scale, steps that go with h. own:
 * room for a row of another order. */
static chosen by_step(size_t m, double h, row *own)
{
    chosen c = by_name(row_card(m)->name);
    if (!row_adaptive(&c)) return c;
    if (row_reversible_steps(&c)) {
        c.relative = stepper_tolerance_most(&c) * pow(h, row_card(m)->order + 1);
        return c;
    }
    if (c.row->expands) {
        *own = *c.row;
        own->series = SERIES + 1; /* velocities end one power before */
        c.row = own;
    }
    c.relative = 0, c.absolute = 1e300, c.least = 0, c.most = c.first = h;
    return c;
}

static void state_of(const motus_system *s, const double *x, const double *v, double *out)
{
    memset(out, 0, 2 * NUMBERS * sizeof *out);
    memcpy(out, x, s->problem.nx * sizeof *out);
    memcpy(out + NUMBERS, v, s->problem.nv * sizeof *out);
}

/* The start of this number: with others come other times of the event. */
static void start_of(const motus_system *s, int start, double *y)
{
    state_of(s, s->x0, s->v0, y);
    y[0] -= start / 16.0, y[NUMBERS] -= start / 8.0;
}

/* Follows the system to `until` with its rules, or without (alone). False: the method fails. */
static bool follow(motus_system *s, bool alone, int start, const chosen *c, double h, double until, outcome *out)
{
    const rules *r = NULL;
    stepper *st = NULL;
    events *e = NULL;
    stepper_stop why = STOP_STEPS;
    double y[2 * NUMBERS], x[NUMBERS] = {0}, v[NUMBERS] = {0};
    *out = (outcome){0};
    start_of(s, start, y);
    motus_status status = system_rules(s, &r, NULL);
    if (!status && alone && r->settle) status = r->settle(r->ctx, 1, 0, y, y + NUMBERS, NULL); /* and there they stay */
    if (!status) status = stepper_create(&s->machine, c, 0, h, y, y + NUMBERS, NULL, &st, NULL);
    if (!status && !alone) status = events_create(r, &s->machine, c, NULL, &e, NULL);
    if (!status && !alone) status = events_begin(e, st, until, NULL);
    while (!status && why == STOP_STEPS) {
        status =
            alone ? stepper_advance(st, (stepper_limit){1, until}, &why, NULL) : events_go(e, st, until, 1, &why, NULL);
        const double grid = (double)++out->steps * h, off = fabs(stepper_time(st) - grid) / events_ulp(grid);
        if (!row_adaptive(c) && why == STOP_STEPS) out->off_grid = fmax(out->off_grid, off);
    }
    if (!status) status = stepper_sync(st, x, v, NULL, NULL);
    const bool done = !status && why == STOP_UNTIL;
    if (done) {
        state_of(s, x, v, out->end);
        out->evaluations = stepper_evaluations(st);
        out->events = e ? events_rows(e) : 0;
    }
    for (int after = 0; out->events && after < 2; after++) {
        const double *at_x, *at_v;
        out->t = events_row(e, 0, after, &at_x, &at_v).t;
        state_of(s, at_x, at_v, after ? out->after : out->before);
    }
    events_destroy(e);
    stepper_destroy(st);
    return done;
}

static double distance(const double *one, const double *other)
{
    double most = 0;
    for (int k = 0; k < 2 * NUMBERS; k++) most = fmax(most, fabs(one[k] - other[k]));
    return most;
}

/* The motion to twice the time of its event, by two methods that share no formula; they agree to `off`. */
static outcome truth(motus_system *s, int start, double *off)
{
    outcome one, other;
    chosen series = by_name("taylor");
    const chosen gauss = by_name("gauss16");
    series.relative = 1e-17, series.absolute = 0;
    if (!follow(s, false, start, &series, 0.1, FAR, &one) || one.events != 1) abort();
    const double until = 2 * one.t;
    if (!follow(s, false, start, &series, 0.1, until, &one) || !follow(s, false, start, &gauss, 0.05, until, &other))
        abort();
    if (one.events != 1 || other.events != 1) abort();
    *off = fmax(*off, fmax(fabs(one.t - other.t), distance(one.end, other.end)));
    return one;
}

/* Order ------------------------------------------------------------------------------------------------------------ */

typedef struct errors {
    double time, state; /* as usual over all starts */
    bool known;
} errors;

/* The mean square but for the largest: of a start where the control of reversible steps began anew. */
static double usual(const double *y, int n)
{
    int largest = 0;
    double sum = 0;
    for (int k = 1; k < n; k++)
        if (y[k] > y[largest]) largest = k;
    for (int k = 0; k < n; k++)
        if (n == 1 || k != largest) sum += y[k] * y[k];
    return sqrt(sum / fmax(1, n - 1));
}

/* With `steps` whole steps to the event. */
static errors errors_of(motus_system *s, const outcome *is, size_t m, int steps)
{
    errors e = {.known = true};
    const int starts = row_card(m)->order < 3 ? 2 : STARTS; /* errors of low order have one sign */
    double time[STARTS], state[STARTS];
    for (int start = 0; start < starts && e.known; start++) {
        row own;
        outcome out;
        const double h = is[start].t / (steps + THETA);
        const chosen c = by_step(m, h, &own);
        e.known = follow(s, false, start, &c, h, 2 * is[start].t, &out) && out.events == 1;
        time[start] = fabs(out.t - is[start].t);
        state[start] = distance(out.end, is[start].end);
    }
    if (e.known) e.time = usual(time, starts), e.state = usual(state, starts);
    return e;
}

/* Of points from the shortest step to the longest. */
static void slope(const motus_method *card, int order, const motion *w, const char *of, const double *x,
                  const double *y, int n)
{
    double twice, skip;
    const int half = n / 2;
    char law[64];
    snprintf(law, sizeof law, "%s, %s", w->name, of);
    const double all = line_slope(x, y, n, &twice), fine = line_slope(x, y, n - half, &skip),
                 coarse = line_slope(x + half, y + half, n - half, &skip);
    const double margin = fmin(1, fmax(0.5, twice + 1.5 * fabs(fine - coarse)));
    const bool few = order > 7;
    const double observed = few ? fmax(all, fine) : fine,
                 least = few ? fmin(order - 1.5, card->dense_order + 1) : order - margin;
    judge(observed >= least, card->name, law, "order %d: observed %.2f, at least %.2f, %d errors from %.1g to %.1g",
          order, observed, least, n, exp2(y[n - 1]), exp2(y[0]));
}

static void order_of(motus_system *s, const motion *w, const outcome *is, size_t m)
{
    const motus_method *card = row_card(m);
    const int order = methods_table[m].expands ? SERIES : card->order, most = order == 1   ? 1024
                                                                              : order == 2 ? 256
                                                                                           : 128;
    const double range = 3, above = 0x1p-42, below = 0.25;
    double x[POINTS], time[POINTS], state[POINTS];
    int n = 0, last = 1;
    for (int k = 1; k <= most; k += 1 + k / 3) {
        const errors e = errors_of(s, is, m, k);
        if (e.known && fmin(e.time, e.state) < above) break;
        last = k;
    }
    for (int k = last; k >= 1 && k >= last / range && n < POINTS; k -= 1 + k / 6) {
        const errors e = errors_of(s, is, m, k);
        if (!e.known || e.state > below || fmin(e.time, e.state) < above) continue;
        x[n] = -log2(k + THETA), time[n] = log2(e.time), state[n++] = log2(e.state);
    }
    if (n < 4) { /* the longest steps that it can take leave little more than rounding */
        judge(order > 10, card->name, w->name, "%d errors above rounding", n);
        return;
    }
    slope(card, order, w, "its time", x, time, n);
    slope(card, order, w, "after it", x, state, n);
}

/* Beginning anew -------------------------------------------------------------------------------------------------- */

/* A run of `steps` steps from y, or to `until`, of a stepper that remembers nothing; to y. */
static bool fresh(motus_system *s, const chosen *c, double t, double h, stepper_limit limit, double *y)
{
    stepper *st = NULL;
    double x[NUMBERS] = {0}, v[NUMBERS] = {0};
    motus_status status = stepper_create(&s->machine, c, t, h, y, y + NUMBERS, NULL, &st, NULL);
    if (!status) status = stepper_advance(st, limit, NULL, NULL);
    if (!status) status = stepper_sync(st, x, v, NULL, NULL);
    stepper_destroy(st);
    state_of(s, x, v, y);
    return status == MOTUS_OK;
}

/* A run through an event is the steps to the grid before it, a step that ends on it, one to the next time of the grid,
 * and the steps from there: each part by a stepper of its own. */
static void made_of_parts(motus_system *s, const motion *w, const outcome *is, size_t m)
{
    enum { STEPS = 200 };
    const chosen c = by_name(row_card(m)->name);
    const double h = is->t / (STEPS + THETA), until = 2 * is->t;
    const stepper_limit one = {1, NAN};
    outcome run = {0};
    double y[2 * NUMBERS], off = NAN;
    start_of(s, 0, y);
    bool known = follow(s, false, 0, &c, h, until, &run) && run.events == 1;
    const double before = floor(run.t / h), left = before * h, right = left + h;
    known = known && fresh(s, &c, 0, h, (stepper_limit){(int64_t)before, NAN}, y) &&
            fresh(s, &c, left, run.t - left, one, y);
    if (known) off = distance(y, run.before);
    known = known && fresh(s, &c, run.t, right - run.t, one, run.after) &&
            fresh(s, &c, right, h, (stepper_limit){INT64_MAX, until}, run.after);
    if (known) off = fmax(off, distance(run.after, run.end));
    judge(known && off <= 64 * 0x1p-52, row_card(m)->name, "begins anew at an event", "%s: off by %.1e", w->name, off);
    judge(known && run.off_grid <= 1, row_card(m)->name, "stays on its grid", "%s: off by %.1g ulp", w->name,
          run.off_grid);
}

/* Tolerance -------------------------------------------------------------------------------------------------------- */

/* The power of the tolerance with which the error at the end falls, with the event or (alone) without. */
static double power_of(motus_system *s, bool alone, const outcome *is, size_t m, double *twice)
{
    enum { SIZES = 13 };
    double x[SIZES], y[SIZES], ends[STARTS];
    int n = 0;
    for (int k = 0; k < SIZES; k++) {
        bool known = true;
        chosen c = by_name(row_card(m)->name);
        c.relative = 1e-4 * exp2(-1.5 * k), c.absolute = 0;
        for (int start = 0; start < STARTS && known; start++) {
            outcome out;
            known = follow(s, alone, start, &c, 0.1, 2 * is[start].t, &out) && out.events == !alone;
            ends[start] = distance(out.end, is[start].end);
        }
        const double error = known ? usual(ends, STARTS) : 0;
        if (error > 0x1p-40) x[n] = log2(c.relative), y[n++] = log2(error);
    }
    return n > 3 ? line_slope(x, y, n, twice) : NAN;
}

/* An error estimate goes with h^(p+1), so the error falls with the power p/(p + 1) of the tolerance at least; where it
 * falls with a smaller one without the event, with that. */
static void with_tolerance(motus_system *s, const motion *w, const outcome *is, const outcome *smooth, size_t m)
{
    const motus_method *card = row_card(m);
    double twice, twice_alone;
    const double power = power_of(s, false, is, m, &twice), alone = power_of(s, true, smooth, m, &twice_alone),
                 due = fmin(card->order / (card->order + 1.0), alone);
    judge(power >= due - twice - twice_alone, card->name, "error with tolerance",
          "%s: power %.2f ± %.2f, due %.2f ± %.2f", w->name, power, twice, due, twice_alone);
}

/* Recording -------------------------------------------------------------------------------------------------------- */

static void records(motus_system *s, size_t m)
{
    const motus_method *card = row_card(m);
    chosen c = by_name(card->name);
    if (row_adaptive(&c)) c.relative = fmin(1e-7, stepper_tolerance_most(&c)), c.absolute = 0;
    outcome run = {0}, alone = {0};
    const bool known = follow(s, true, 0, &c, 0.0625, 10, &alone) && follow(s, false, 0, &c, 0.0625, 10, &run);
    const bool same = known && !memcmp(run.end, alone.end, sizeof run.end);
    judge(same && run.steps == alone.steps && run.evaluations == alone.evaluations && run.events > RECORDS, card->name,
          "records without a trace", "%zu events, %lld steps and %lld, %lld evaluations and %lld", run.events,
          (long long)run.steps, (long long)alone.steps, (long long)run.evaluations, (long long)alone.evaluations);
}

/* Parity ----------------------------------------------------------------------------------------------------------- */

enum { CROSSED = 3 };

/* How often each function has crossed 0, by the table. */
static void crossings(const events *e, int64_t *count)
{
    memset(count, 0, CROSSED * sizeof *count);
    for (size_t k = 0; k < events_rows(e); k++) {
        const event row = events_row(e, k, false, NULL, NULL);
        if (!row.touched) count[row.rule]++;
    }
}

static void loses_none(motus_system *s, size_t m, double h)
{
    const double until = 40, hidden = 1e-12, far = 4;
    const rules *r = NULL;
    stepper *st = NULL;
    events *e = NULL;
    stepper_stop why = STOP_STEPS;
    row own;
    const chosen c = by_step(m, h, &own);
    int side[CROSSED] = {0};
    int64_t lost = 0, steps = 0, count[CROSSED];
    double x = s->x0[0], v = s->v0[0];
    motus_status status = system_rules(s, &r, NULL);
    if (!status) status = stepper_create(&s->machine, &c, 0, h, &x, &v, NULL, &st, NULL);
    if (!status) status = events_create(r, &s->machine, &c, NULL, &e, NULL);
    if (!status) status = events_begin(e, st, until, NULL);
    while (!status && why == STOP_STEPS) {
        status = events_go(e, st, until, 1, &why, NULL);
        if (!status) status = stepper_sync(st, &x, &v, NULL, NULL);
        if (status || !(fabs(x) < far && fabs(v) < far)) break; /* it leaves the well, as Euler's does */
        const double g[CROSSED] = {x - 0.25, v - 0.1, x - v};
        crossings(e, count);
        for (int k = 0; k < CROSSED; k++) {
            if (fabs(g[k]) < hidden) continue;
            const int now = (g[k] > 0 ? 1 : -1) * (count[k] % 2 ? -1 : 1); /* the same throughout */
            if (!side[k]) side[k] = now;
            lost += now != side[k];
            side[k] = now;
        }
        steps++;
    }
    judge(!status && !lost && events_rows(e) >= 4, row_card(m)->name, "loses no crossing",
          "h = %g: %lld of %lld steps, %zu events", h, (long long)lost, (long long)steps, e ? events_rows(e) : 0);
    events_destroy(e);
    stepper_destroy(st);
}

void laws_of_events(void)
{
    for (size_t j = 0; j < sizeof motions / sizeof *motions; j++) {
        const motion *w = &motions[j];
        motus_system *home = read(w->text), *s = w->switches ? located(home) : home;
        outcome is[STARTS], smooth[STARTS];
        double off = 0;
        chosen series = by_name("taylor");
        series.relative = 1e-17, series.absolute = 0;
        for (int k = 0; k < STARTS; k++) {
            is[k] = truth(s, k, &off);
            if (!follow(s, true, k, &series, 0.1, 2 * is[k].t, &smooth[k])) abort();
            smooth[k].t = is[k].t;
        }
        judge(off <= 32 * 0x1p-52, w->name, "two methods agree", "off by %.1e", off);
        for (size_t m = 0; m < row_count(); m++) {
            const chosen c = by_name(row_card(m)->name);
            if (!admits(m, s)) continue;
            if (methods_table[m].family != RADAU || !row_adaptive(&c)) order_of(s, w, is, m);
            if (!row_adaptive(&c) && !w->switches) made_of_parts(s, w, is, m);
            if (row_adaptive(&c) && !row_reversible_steps(&c)) with_tolerance(s, w, is, smooth, m);
        }
        motus_system_destroy(home);
    }
    motus_system *s = read(recorded);
    for (size_t m = 0; m < row_count(); m++)
        if (admits(m, s)) records(s, m);
    motus_system_destroy(s);
    s = read(crossed);
    for (size_t m = 0; m < row_count(); m++)
        for (double h = 0.0625; h < 1 && admits(m, s); h *= 2) loses_none(s, m, h);
    motus_system_destroy(s);
}
