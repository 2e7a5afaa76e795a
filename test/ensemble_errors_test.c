/* Errors of ensembles: the bars of a trajectory are those of a run with its values, to the bit, in lanes and one
 * trajectory at a time; they cover the distance from motions that are known better; nothing else of a trajectory
 * changes; and what has no bar is refused or says so. */
#include "test/ensemble_given.h"

#include <stdbool.h>

enum { COUNT = 21, NUMBERS_MAX = 12 };

typedef struct task {
    const char *text, *method, *vary;
    double step, tolerance; /* NaN: the other one holds */
    double from, to, until;
    const motus_record *records;
    size_t count;
    int64_t every;
    const char *machine;
    int lanes, threads;
    motus_bars error;
} task;

typedef struct told {
    outcome values, errors;
} told;

static void fill(const task *t, double values[COUNT])
{
    for (size_t i = 0; i < COUNT; i++) values[i] = t->from + (t->to - t->from) * (double)(i * 5 % COUNT) / (COUNT - 1);
}

static motus_ensemble_def definition(const task *t)
{
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = &t->vary;
    def.vary_count = 1;
    def.records = t->records;
    def.record_count = t->count;
    def.method = t->method;
    def.step = t->step;
    def.tolerance = t->tolerance;
    def.until = t->until;
    def.every = t->every;
    def.machine = t->machine ? t->machine : "compiled";
    def.lanes = t->lanes;
    def.threads = t->threads;
    def.error = t->error;
    return def;
}

static told compute(const task *t)
{
    double values[COUNT];
    const double *const list[] = {values};
    motus_error err = motus_default_error();
    motus_system *s = given_text(t->text);
    const motus_ensemble_def def = definition(t);
    fill(t, values);
    motus_ensemble *e = given_ensemble(s, &def, t->method);
    if (t->lanes && motus_ensemble_now(e).lanes != t->lanes) fail_msg("%s: %s", t->method, motus_ensemble_now(e).note);
    told o = {room_for(COUNT, t->count), room_for(COUNT, t->count)};
    must(motus_ensemble_run_errors(e, COUNT, list, o.values.at, o.errors.at, o.values.stopped, &err), &err, t->method);
    outcome plain = go(e, COUNT, t->count, list, t->method);
    same_outcome(&plain, &o.values, "with errors and without");
    forget(&plain);
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
    return o;
}

static void forget_told(told *o)
{
    forget(&o->values);
    forget(&o->errors);
}

static void set(const task *t, motus_system *s, double value)
{
    motus_error err = motus_default_error();
    must(motus_system_set(s, t->vary, &value, 1, &err), &err, t->vary);
}

static motus_run *run_of(const task *t, motus_system *s, motus_bars error, double longest)
{
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    def.method = t->method;
    def.step = t->step;
    def.tolerance = t->tolerance;
    def.until = t->until;
    def.longest_step = longest;
    def.machine = "interpreter";
    def.error = error;
    must(motus_run_create(s, &def, &r, &err), &err, t->method);
    return r;
}

/* The numbers at the end and their bars, of a run that is asked at every observation where something is reduced. */
static void as_runs(const task *t, const told *o)
{
    double values[COUNT], value, bar;
    bool reduced = false;
    motus_error err = motus_default_error();
    motus_system *s = given_text(t->text);
    fill(t, values);
    for (size_t k = 0; k < t->count; k++)
        reduced |= t->records[k].how != MOTUS_REDUCE_FINAL && t->records[k].how < MOTUS_REDUCE_STEPS;
    for (size_t i = 0; i < COUNT; i += 3) {
        set(t, s, values[i]);
        motus_run *r = run_of(t, s, t->error, 0);
        const size_t any = 1;
        while (reduced && !motus_run_done(r)) {
            must(motus_run_errors(r, &any, 1, NULL, &bar, &err), &err, t->method);
            must(motus_run_step(r, t->every, &err), &err, t->method);
        }
        finish(r);
        for (size_t k = 0; k < t->count; k++) {
            if (t->records[k].how != MOTUS_REDUCE_FINAL) continue;
            must(motus_run_errors(r, &t->records[k].column, 1, &value, &bar, &err), &err, t->method);
            if (!same_number(value, o->values.at[k][i]) || !same_number(bar, o->errors.at[k][i]))
                fail_msg("%s (%d), trajectory %zu, record %zu: %.17g ± %.17g; a run says %.17g ± %.17g", t->method,
                         (int)t->error, i, k, o->values.at[k][i], o->errors.at[k][i], value, bar);
        }
        motus_run_destroy(r);
    }
    motus_system_destroy(s);
}

#define PENDULUM \
    "g = 0.1\nF = 1\nw = 2/3\nx'' = -g x' - sin(x) + F cos(w t)\nx(0) = 1.1\nx'(0) = 0\nenergy = x'^2/2 - cos(x)\n"
#define KEPLER                                                                                                     \
    "e = 0.1\nmu = 1/3 + 2/3\nr'' = -mu r/|r|^3\nr(0) = (1 - e, 0)\nr'(0) = (0, sqrt((1 + e)/(1 - e)))\nenergy = " \
    "|r'|^2/2 - mu/|r|\n"
#define DUFFING \
    "d = 0.3\nx'' = -d x' + x - x^3 + 0.3 cos(1.2 t)\nx(0) = 0.1\nx'(0) = 0\nenergy = x'^2/2 + x^4/4 - x^2/2\n"
#define CHAIN                                                                                                         \
    "N = 3\nk = 1.3\nu[i]'' = k (u[i+1] - 2 u[i] + u[i-1]) for i = 1..N\nu[0] = 0.2 sin(1.1 t)\nu[N+1] = 0\nu[i](0) " \
    "= "                                                                                                              \
    "0.1 i for i = 1..N\nu[i]'(0) = 0 for i = 1..N\n"

#define LATE "F = 1\nx'' = -x + F cos(t)\nx(1e6) = 1\nx'(1e6) = 0\ny = x^2\n"
#define SIDES "F = 1\nx'' = -x + F cos(t)\nx(0) = 1\nx'(0) = 0\nside = if(x > 0.3, 1, 0) + x\n"

static const motus_record finals[] = {
    {MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_STEPS, 0}, {MOTUS_REDUCE_FINAL, 2}, {MOTUS_REDUCE_FINAL, 3}};
static const motus_record reduced[] = {
    {MOTUS_REDUCE_MAX, 1}, {MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_MEAN, 3}, {MOTUS_REDUCE_MIN, 2}};

static void same_as_runs(void **state)
{
    (void)state;
    const task tasks[] = {
        {PENDULUM, "dopri5", "F", NAN, 1e-7, 0.5, 1.5, 9, finals, 4, 1, .lanes = 8},
        {PENDULUM, "dop853", "F", NAN, 1e-6, 0.5, 1.5, 9, reduced, 4, 3, .lanes = 8},
        {PENDULUM, "rk4", "F", 0.05, NAN, 0.5, 1.5, 9.03, finals, 4, 1, .lanes = 16},
        {PENDULUM, "rk4", "F", 0.05, NAN, 0.5, 1.5, 9.03, reduced, 4, 7, .lanes = 16},
        {PENDULUM, "verlet", "g", 0.02, NAN, 0, 0.2, 9, reduced, 4, 1, .lanes = 8},
        {KEPLER, "kahan-li8", "e", 0.1, NAN, 0.05, 0.5, 20, finals, 4, 1, .lanes = 8},
        {KEPLER, "dop853", "e", NAN, 1e-13, 0.05, 0.7, 20.3, finals, 4, 1, .lanes = 8},
        {LATE, "dop853", "F", NAN, 1e-10, 0.5, 1.5, 1000020.3, finals, 4, 1, .lanes = 0},
        {SIDES, "dop853", "F", NAN, 1e-10, 0.5, 1.5, 9, finals, 4, 1, .lanes = 0},
        {KEPLER, "dep6", "e", NAN, 1e-8, 0.05, 0.7, 20, finals, 4, 1, .lanes = 8},
        {CHAIN, "verner6", "k", NAN, 1e-8, 0.5, 1.5, 9, finals, 3, 1, .lanes = 8},
        {CHAIN, "gauss4", "k", 0.1, NAN, 0.5, 1.5, 9, finals, 3, 1, .lanes = 0},
    };
    for (size_t k = 0; k < sizeof tasks / sizeof *tasks; k++) {
        task t = tasks[k];
        t.error = MOTUS_BARS_CHEAP;
        const int lanes = t.lanes;
        t.machine = "interpreter", t.threads = 1, t.lanes = 0;
        told plain = compute(&t);
        as_runs(&t, &plain);
        for (int i = 0; i < 2; i++) {
            t.machine = "compiled", t.threads = 1 + i, t.lanes = i ? lanes : 0;
            told fast = compute(&t);
            same_outcome(&plain.values, &fast.values, t.method);
            same_outcome(&plain.errors, &fast.errors, t.method);
            forget_told(&fast);
        }
        if (k < 3) {
            t.machine = "interpreter", t.threads = 2, t.lanes = 0, t.error = MOTUS_BARS_FULL;
            told full = compute(&t);
            as_runs(&t, &full);
            forget_told(&full);
        }
        forget_told(&plain);
    }
}

/* ---- coverage ---- */

typedef struct count {
    long all, covered, tight, withheld;
} count;

/* The exact motion's records over the times at which the trajectory is observed. */
static void truth(const task *t, motus_system *s, double value, double *out)
{
    task better = *t;
    motus_error err = motus_default_error();
    double row[NUMBERS_MAX], most[NUMBERS_MAX], sum[NUMBERS_MAX] = {0};
    size_t columns[NUMBERS_MAX], times = 0;
    set(t, s, value);
    motus_run *r = run_of(t, s, MOTUS_BARS_NONE, 0);
    /* by steps so short that what lies between two of them is as exact */
    better.method = "dop853", better.step = NAN, better.tolerance = 1e-14;
    motus_run *known = run_of(&better, s, MOTUS_BARS_NONE, 0.01);
    for (size_t k = 0; k < t->count; k++) columns[k] = t->records[k].column;
    for (bool ends = false; !ends; times++) {
        ends = motus_run_done(r);
        const double now = motus_run_time(r);
        must(motus_run_sample(known, &now, 1, columns, t->count, row, &err), &err, "truth");
        for (size_t k = 0; k < t->count; k++) {
            const double sign = t->records[k].how == MOTUS_REDUCE_MIN ? -1 : 1;
            if (!times || sign * row[k] > sign * most[k]) most[k] = row[k];
            sum[k] += row[k];
        }
        must(motus_run_step(r, t->every, &err), &err, "truth");
    }
    for (size_t k = 0; k < t->count; k++)
        out[k] = t->records[k].how == MOTUS_REDUCE_FINAL  ? row[k]
                 : t->records[k].how == MOTUS_REDUCE_MEAN ? sum[k] / (double)times
                                                          : most[k];
    motus_run_destroy(known);
    motus_run_destroy(r);
}

static void compare(const task *t, count *c)
{
    double values[COUNT], exact[NUMBERS_MAX];
    motus_system *s = given_text(t->text);
    told o = compute(t);
    fill(t, values);
    for (size_t i = 0; i < COUNT; i++) {
        truth(t, s, values[i], exact);
        for (size_t k = 0; k < t->count; k++) {
            const double value = o.values.at[k][i], bar = o.errors.at[k][i], error = fabs(value - exact[k]);
            const double ulp = nextafter(fabs(value), INFINITY) - fabs(value);
            if (!isfinite(bar)) {
                c->withheld++;
                continue;
            }
            c->all++;
            c->covered += error <= bar;
            c->tight += bar <= 10 * error || bar <= 4 * ulp;
        }
    }
    forget_told(&o);
    motus_system_destroy(s);
}

/* Of all numbers 99 in 100 are covered, and 9 in 10 of the bars are at most ten times the error. */
static void covered(void **state)
{
    (void)state;
    static const motus_record recorded[2][3] = {
        {{MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_FINAL, 2}, {MOTUS_REDUCE_FINAL, 3}},
        {{MOTUS_REDUCE_MAX, 1}, {MOTUS_REDUCE_MEAN, 1}, {MOTUS_REDUCE_MIN, 2}}};
    static const struct {
        const char *label, *text, *vary;
        double from, to, until;
    } models[] = {{"pendulum over F", PENDULUM, "F", 0.5, 0.9, 20},
                  {"Kepler over e", KEPLER, "e", 0.05, 0.6, 25},
                  {"Duffing over d", DUFFING, "d", 0.2, 0.4, 20}};
    static const struct {
        const char *method;
        double step, tolerance;
    } ways[] = {{"dopri5", NAN, 1e-5}, {"dopri5", NAN, 1e-8}, {"dop853", NAN, 1e-6},     {"dop853", NAN, 1e-9},
                {"rk4", 0.05, NAN},    {"verlet", 0.01, NAN}, {"forest-ruth", 0.05, NAN}};
    count all = {0};
    for (int kind = 0; kind < 2; kind++) {
        for (size_t m = 0; m < sizeof models / sizeof *models; m++) {
            count c = {0};
            for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
                const task t = {models[m].text,
                                ways[w].method,
                                models[m].vary,
                                ways[w].step,
                                ways[w].tolerance,
                                models[m].from,
                                models[m].to,
                                models[m].until,
                                recorded[kind],
                                3,
                                kind ? 2 : 1,
                                "interpreter",
                                0,
                                2,
                                MOTUS_BARS_CHEAP};
                compare(&t, &c);
            }
            print_message("  %-20s %-10s %5ld numbers, %4ld withheld; covered %6.2f %%, tight %6.2f %%\n",
                          models[m].label, kind ? "reduced" : "final", c.all, c.withheld,
                          100. * (double)c.covered / (double)c.all, 100. * (double)c.tight / (double)c.all);
            all.all += c.all, all.covered += c.covered, all.tight += c.tight;
            assert_true((double)c.covered >= 0.97 * (double)c.all);
        }
        print_message("  %-31s %5ld numbers; covered %6.2f %%, tight %6.2f %%\n", "so far", all.all,
                      100. * (double)all.covered / (double)all.all, 100. * (double)all.tight / (double)all.all);
        assert_true((double)all.covered >= 0.99 * (double)all.all && (double)all.tight >= 0.9 * (double)all.all);
        all = (count){0};
    }
}

/* ---- what steps do not show ---- */

#define BUMP "k = 0.3\nx'' = -x + k exp(-((x - 0.2)/0.015)^2)\nx(0) = 0.9\nx'(0) = 0.1\nuntil 11\n"

/* A force with a bump that the steps of a series leap: a witness looks at each trajectory, so that the bars hold, and
 * all machines, threads and pieces have the same bits. The numbers without errors are those of the leaping steps. */
static void leapt(void **state)
{
    (void)state;
    static const motus_record finals[] = {{MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_FINAL, 2}};
    static const char *const machines[] = {"interpreter", "compiled", "auto"};
    double values[COUNT], exact[NUMBERS_MAX];
    const double *const list[] = {values};
    motus_error err = motus_default_error();
    task t = {BUMP, "taylor", "k", NAN, 1e-9, 0.25, 0.35, 11, finals, 2, 1, NULL, 0, 1, MOTUS_BARS_CHEAP};
    fill(&t, values);
    told first = {{0}, {0}};
    for (int m = 0; m < 3; m++) {
        motus_system *s = given_text(BUMP);
        motus_ensemble_def def = definition(&t);
        def.machine = machines[m];
        def.threads = 1 + m % 2;
        motus_ensemble *e = given_ensemble(s, &def, "a bump");
        told o = {room_for(COUNT, t.count), room_for(COUNT, t.count)};
        if (m == 2) must(motus_ensemble_pilots(e, COUNT, list, &err), &err, "pilots");
        for (size_t from = 0, n = m == 2 ? 8 : COUNT; from < COUNT; from += n, n = COUNT - from) {
            const double *const piece[] = {values + from};
            double *const results[] = {o.values.at[0] + from, o.values.at[1] + from};
            double *const errors[] = {o.errors.at[0] + from, o.errors.at[1] + from};
            must(motus_ensemble_run_errors(e, n, piece, results, errors, o.values.stopped + from, &err), &err,
                 "a bump");
        }
        if (m) same_outcome(&first.values, &o.values, machines[m]), same_outcome(&first.errors, &o.errors, machines[m]);
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
        if (m)
            forget_told(&o);
        else
            first = o;
    }
    motus_system *s = given_text(BUMP);
    for (size_t i = 0; i < COUNT; i++) {
        truth(&t, s, values[i], exact);
        for (size_t k = 0; k < t.count; k++) {
            const double error = fabs(first.values.at[k][i] - exact[k]), bar = first.errors.at[k][i];
            if (!(error <= bar && bar < 1e-8))
                fail_msg("k = %g: %.17g, is %.17g, bar %.3g", values[i], first.values.at[k][i], exact[k], bar);
        }
    }
    forget_told(&first);
    motus_system_destroy(s);
}

/* ---- what has no bar ---- */

static void refused(void **state)
{
    (void)state;
    double values[COUNT] = {1};
    const double *const list[] = {values};
    const motus_record when = {MOTUS_REDUCE_TIME_OF_MAX, 1};
    task t = {PENDULUM, "rk4", "F", 0.05, NAN, 0.5, 1.5, 1, &when, 1, 1, "interpreter", 0, 1, MOTUS_BARS_CHEAP};
    motus_error err = motus_default_error();
    motus_system *s = given_text(t.text);
    motus_ensemble *e = NULL;
    motus_ensemble_def def = definition(&t);
    assert_int_equal(motus_ensemble_create(s, &def, &e, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "is the time of a maximum, which has no error"));
    def.records = finals;
    def.error = (motus_bars)7;
    assert_int_equal(motus_ensemble_create(s, &def, &e, &err), MOTUS_ARGUMENT);
    def.error = MOTUS_BARS_NONE;
    must(motus_ensemble_create(s, &def, &e, &err), &err, "without errors");
    outcome o = room_for(1, 1), errors = room_for(1, 1);
    assert_int_equal(motus_ensemble_run_errors(e, 1, list, o.at, errors.at, NULL, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "tells no errors"));
    motus_ensemble_destroy(e);
    forget(&o);
    forget(&errors);
    motus_system_destroy(s);
}

/* A trajectory that leaves the finite numbers has no bar; one that is chaotic has no digit; the others are as alone. */
static void neighbours(void **state)
{
    (void)state;
    static const char text[] = "k = 1\nx'' = k x^3 - 0.1 x\nx(0) = 1.1\nx'(0) = 0\n";
    static const motus_record one[] = {{MOTUS_REDUCE_FINAL, 1}};
    for (int adaptive = 0; adaptive < 2; adaptive++) {
        task t = {text,
                  adaptive ? "dopri5" : "rk4",
                  "k",
                  adaptive ? NAN : 0.01,
                  adaptive ? 1e-8 : NAN,
                  -1,
                  1,
                  4,
                  one,
                  1,
                  1,
                  "interpreter",
                  0,
                  1,
                  MOTUS_BARS_CHEAP};
        told plain = compute(&t);
        int stopped = 0;
        for (size_t i = 0; i < COUNT; i++) {
            stopped += !isnan(plain.values.stopped[i]);
            assert_true(isnan(plain.errors.at[0][i]) == !isnan(plain.values.stopped[i]));
        }
        assert_in_range(stopped, 1, COUNT - 1);
        t.machine = "compiled", t.lanes = 8;
        told fast = compute(&t);
        same_outcome(&plain.values, &fast.values, t.method);
        same_outcome(&plain.errors, &fast.errors, t.method);
        forget_told(&fast);
        forget_told(&plain);
    }
}

static int cancel_at;
static int cancels(void *context, double fraction)
{
    int *calls = context;
    assert_true(fraction >= 0 && fraction <= 1);
    return ++*calls == cancel_at;
}

static void cancelled(void **state)
{
    (void)state;
    for (int lanes = 0; lanes < 2; lanes++) {
        task t = {PENDULUM,
                  "rk4",
                  "F",
                  1e-4,
                  NAN,
                  0.5,
                  1.5,
                  200,
                  finals,
                  4,
                  1,
                  lanes ? "compiled" : "interpreter",
                  lanes ? 8 : 0,
                  1,
                  MOTUS_BARS_CHEAP};
        int calls = 0;
        double values[COUNT];
        const double *const list[] = {values};
        motus_error err = motus_default_error();
        motus_system *s = given_text(t.text);
        motus_ensemble_def def = definition(&t);
        def.progress = cancels;
        def.context = &calls;
        cancel_at = 3;
        fill(&t, values);
        motus_ensemble *e = given_ensemble(s, &def, "cancelled");
        told o = {room_for(COUNT, t.count), room_for(COUNT, t.count)};
        assert_int_equal(motus_ensemble_run_errors(e, COUNT, list, o.values.at, o.errors.at, o.values.stopped, &err),
                         MOTUS_CANCELLED);
        forget_told(&o);
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
    }
}

/* A callback, of one trajectory or of blocks, whose force depends on the number of the trajectory. */
static int block(void *context, size_t first, size_t count, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)v, (void)t;
    for (size_t j = 0; j < count; j++) a[j] = -(1 + 0.1 * (double)(first + j)) * x[j];
    return 0;
}

static void callbacks(void **state)
{
    (void)state;
    static const char *const vary[] = {"x(0)"};
    static const motus_record one[] = {{MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_MEAN, 2}};
    const double start[] = {1}, rest[] = {0};
    double values[] = {1, 1, 1, 2, 3, 1};
    const double *const list[] = {values};
    enum { SIX = 6 };
    motus_callback_def def = motus_default_callback();
    motus_system *s = NULL;
    motus_error err = motus_default_error();
    def.positions = 1;
    def.block = block;
    def.x = start;
    def.v = rest;
    def.depends_on_velocity = def.depends_on_time = 0;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    motus_ensemble_def wanted = motus_default_ensemble();
    wanted.vary = vary;
    wanted.vary_count = 1;
    wanted.records = one;
    wanted.record_count = 2;
    wanted.method = "rk4";
    wanted.step = 0.05;
    wanted.until = 5;
    wanted.error = MOTUS_BARS_CHEAP;
    motus_ensemble *e = given_ensemble(s, &wanted, "callback");
    told o = {room_for(SIX, 2), room_for(SIX, 2)};
    must(motus_ensemble_run_errors(e, SIX, list, o.values.at, o.errors.at, o.values.stopped, &err), &err, "callback");
    outcome plain = go(e, SIX, 2, list, "callback");
    same_outcome(&plain, &o.values, "callback");
    for (size_t i = 0; i < SIX; i++) {
        const double w = sqrt(1 + 0.1 * (double)i), error = fabs(o.values.at[0][i] - values[i] * cos(5 * w));
        assert_true(error <= o.errors.at[0][i] && o.errors.at[0][i] < 100 * error);
    }
    forget(&plain);
    forget_told(&o);
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
}

int main(void)
{
    open_shared_cache();
    const struct CMUnitTest tests[] = {cmocka_unit_test(refused),   cmocka_unit_test(callbacks),
                                       cmocka_unit_test(cancelled), cmocka_unit_test(neighbours),
                                       cmocka_unit_test(covered),   cmocka_unit_test(same_as_runs),
                                       cmocka_unit_test(leapt)};
    const int failed = cmocka_run_group_tests_name("errors of ensembles", tests, NULL, NULL);
    close_cache();
    return failed;
}
