/* Restart states of runs with events: an interrupted run has the table of events of one that was not, every bit of it,
 * the same motion, and ends as it does; what was damaged is refused or does no harm.
 */
#include "test/saved.h"

#include <stdbool.h>

typedef struct motion {
    const char *text;
    double until;
} motion;

static const motion motions[] = {
    /* a ball that bounces, is watched, comes to rest by its accumulation, and rests in a mode */
    {"rest = 0; y'' = if(rest > 0, 0, -9.81 - 0.01 y' |y'|); y(0) = 0.1; y'(0) = 0; n = 0; "
     "when y = 0 falling as bounce: y' = -0.5 y', n = n + 1, record; when y' = 0 falling as top: record; "
     "when bounce accumulates: y = 0, y' = 0, rest = 1, record",
     0.53},
    /* conditions that hold and are released, and what events keep */
    {"x'' = -x + 0.1 cos(3 t); x(0) = 1; x'(0) = 0.1; g = 0; last = time(above, last); second = at(above, 2, x'); "
     "when x > 0.2 and x' > 0 as above: record; when x < -0.5: g = g + x', record; "
     "when x = 0.1 as pass: record",
     13.05},
    /* clocks, a kick, a function of time and one that stands at 0 from the start */
    {"x'' = -x; x(0) = 1; x'(0) = 0; when every 0.7 as kick: x' = x' + 0.1 sin(x), record; "
     "when every 1.3 as look: record; when sin(t) = 0: record; when x' = 0 as turn: record; "
     "when every 0.35 as often: record",
     6.3},
    /* families, several events of one instant, first-order variables */
    {"N = 3; x[i]'' = 0 for i = 1..N; x[i](0) = 2 i for i = 1..N; x[i]'(0) = -i for i = 1..N; s' = x[1]; s(0) = 0; "
     "when x[i] = 0 falling as wall: x[i]' = -x[i]', record for i = 1..N; "
     "when x[i] - x[i+1] = -1 as near: record for i = 1..N-1; when s = 4: s = 0, stop after 2, record",
     9.77},
    /* roots at the ends of steps: of the motion, by the rounding of its steps, and of the time */
    {"x'' = 0; x(0) = -1; x'(0) = 1; n = 0; when x = 0: record; when x = 0.5: n = n + 1, record; "
     "when t = 1.25 as at: record; when x > 0.25 and x < 0.75 as in: record",
     2},
};
enum { MOTIONS = sizeof motions / sizeof *motions };

static motus_run *made(motus_system *s, const char *method, double until, motus_bars error)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method;
    given_step(&def, 0.05);
    def.until = until;
    def.machine = "interpreter";
    def.error = error;
    must(motus_run_create(s, &def, &r, &err), &err, method);
    return r;
}

/* All that is told of row k; `errors`: with those of the time. */
static void row_text(motus_run *r, const motus_system *s, int64_t k, char *out, size_t size)
{
    motus_event_row row = motus_default_event_row();
    motus_error err = motus_default_error();
    const size_t count = motus_column_count(s);
    size_t *columns = calloc(count, sizeof *columns);
    double *values = calloc(count, sizeof *values);
    assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
    size_t at = (size_t)snprintf(out, size, "%s %s %lld %a %d %d", row.name, row.instance, (long long)row.count,
                                 row.time, row.touched != 0, row.changed != 0);
    for (size_t i = 0; i < count; i++) columns[i] = i;
    for (int after = 0; after < 2; after++) {
        must(motus_run_event_values(r, k, after, columns, count, values, &err), &err, "values of an event");
        for (size_t i = 0; i < count && at < size; i++) at += (size_t)snprintf(out + at, size - at, " %a", values[i]);
    }
    assert_true(at < size);
    free(columns);
    free(values);
}

static void same_table(const motus_system *s, motus_run *a, motus_run *b, int64_t rows, const char *what)
{
    char one[4096], two[4096];
    if (motus_run_events(b) < rows || motus_run_events(a) < rows)
        fail_msg("%s, %s: %lld and %lld events", what, motus_run_now(a).method, (long long)motus_run_events(a),
                 (long long)motus_run_events(b));
    for (int64_t k = 0; k < rows; k++) {
        row_text(a, s, k, one, sizeof one);
        row_text(b, s, k, two, sizeof two);
        if (strcmp(one, two))
            fail_msg("%s, %s, event %lld:\n%s\n%s", what, motus_run_now(a).method, (long long)k, one, two);
    }
}

static void same_end(const motus_system *s, motus_run *a, motus_run *b, const char *what)
{
    int gathers[2];
    double time[2], error[2];
    assert_int_equal(motus_run_events(a), motus_run_events(b));
    same_table(s, a, b, motus_run_events(a), what);
    same_state(s, a, b, what);
    same_counts(a, b);
    assert_string_equal(motus_run_ended(a, &gathers[0], &time[0], &error[0]),
                        motus_run_ended(b, &gathers[1], &time[1], &error[1]));
    assert_int_equal(gathers[0], gathers[1]);
    if (gathers[0]) assert_true(time[0] == time[1] && error[0] == error[1]);
    assert_string_equal(motus_run_accumulates(a), motus_run_accumulates(b));
}

/* Through all steps, of which every one is an interruption: saved, and taken up by one of two other runs, in a system
 * of its own as by a new process. */
static void relay(const motion *m, const char *method, int64_t stride)
{
    motus_system *s = given_text(m->text), *other = given_text(m->text);
    motus_run *whole = made(s, method, m->until, MOTUS_BARS_NONE), *r[2];
    motus_error err = motus_default_error(), theirs = motus_default_error();
    motus_run_finish(whole, &err); /* it may fail: then both do */
    r[0] = made(s, method, m->until, MOTUS_BARS_NONE);
    r[1] = made(other, method, m->until, MOTUS_BARS_NONE);
    int turn = 0;
    while (!motus_run_step(r[turn], stride, &theirs) && !motus_run_done(r[turn])) {
        kept k = save(r[turn]);
        must(restore(r[!turn], k, &theirs), &theirs, "restore");
        free(k.text);
        turn = !turn;
    }
    assert_string_equal(err.message, theirs.message);
    same_end(s, whole, r[turn], m->text);
    motus_run_destroy(whole);
    motus_run_destroy(r[0]);
    motus_run_destroy(r[1]);
    motus_system_destroy(s);
    motus_system_destroy(other);
}

static void interrupted_at_every_step(void **state)
{
    (void)state;
    for (size_t i = 0; i < MOTIONS; i++) {
        motus_system *s = given_text(motions[i].text);
        for (size_t k = 0; k < motus_method_count(); k++) {
            const char *method = motus_method_at(k)->name;
            if (motus_method_admits(s, method, NULL) != MOTUS_OK) continue;
            motus_run_def def = motus_default_run();
            def.method = method, def.until = motions[i].until;
            given_step(&def, 0.05);
            motus_run *r = NULL;
            if (motus_run_create(s, &def, &r, NULL) != MOTUS_OK) continue; /* equal steps only */
            motus_run_destroy(r);
            relay(&motions[i], method, 1);
        }
        motus_system_destroy(s);
    }
}

/* A run that was to end earlier, between two times of its grid or on one, leaves no trace in one to a later end. */
static void an_earlier_end_leaves_no_trace(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "velocity-verlet", "kahan-li8", "gauss6", "newmark", "rk4"};
    for (size_t i = 0; i < MOTIONS; i++) {
        for (size_t j = 0; j < sizeof methods / sizeof *methods; j++) {
            motus_system *s = given_text(motions[i].text);
            if (motus_method_admits(s, methods[j], NULL) != MOTUS_OK) {
                motus_system_destroy(s);
                continue;
            }
            motus_run *straight = made(s, methods[j], motions[i].until, MOTUS_BARS_NONE);
            finish(straight);
            for (int part = 1; part < 40; part++) {
                const double steps = motions[i].until / 0.05 * part / 41,
                             end = part % 4 ? 0.05 * steps : 0.05 * floor(steps);
                motus_run *early = made(s, methods[j], end, MOTUS_BARS_NONE),
                          *late = made(s, methods[j], motions[i].until, MOTUS_BARS_NONE);
                motus_error err;
                finish(early);
                kept k = save(early);
                must(restore(late, k, &err), &err, "a later end");
                finish(late);
                same_end(s, straight, late, "through an earlier end");
                motus_run *same = made(s, methods[j], end, MOTUS_BARS_NONE);
                must(restore(same, k, &err), &err, "the same end");
                finish(same);
                same_end(s, early, same, "to the same end");
                free(k.text);
                motus_run_destroy(early);
                motus_run_destroy(late);
                motus_run_destroy(same);
            }
            motus_run_destroy(straight);
            motus_system_destroy(s);
        }
    }
}

/* ---- callbacks, backward ---- */

static int fall(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)t, (void)x, (void)v;
    a[0] = -9.81;
    return 0;
}

static int heights(void *ctx, double t, const double *x, const double *v, double *out)
{
    (void)ctx, (void)t;
    out[0] = x[0];
    out[1] = v[0];
    return 0;
}

static int bounce(void *ctx, size_t event, double t, double *x, double *v)
{
    (void)ctx, (void)t, (void)x;
    if (event == 0) v[0] = -0.9 * v[0];
    return 0;
}

static motus_system *given_ball(const char *second)
{
    static const double x[] = {1}, v[] = {0};
    const motus_event_def events[] = {{.name = "bounce", .direction = -1, .assigns = 1},
                                      {.name = second, .direction = -1}};
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    motus_callback_def def = motus_default_callback();
    def.positions = 1;
    def.x = x, def.v = v;
    def.acceleration = fall;
    def.events = events;
    def.event_count = 2;
    def.event_functions = heights;
    def.event_action = bounce;
    must(motus_system_from_callback(&def, &s, &err), &err, "system");
    return s;
}

static void callbacks_restart_too(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "rk4", "dop853"};
    for (size_t i = 0; i < 3; i++) {
        motus_system *s = given_ball("top"), *named = given_ball("summit");
        motus_run *whole = made(s, methods[i], 3.03, MOTUS_BARS_NONE),
                  *half = made(s, methods[i], 3.03, MOTUS_BARS_NONE),
                  *again = made(s, methods[i], 3.03, MOTUS_BARS_NONE),
                  *other = made(named, methods[i], 3.03, MOTUS_BARS_NONE);
        motus_error err;
        finish(whole);
        take_steps(half, 31);
        kept k = save(half);
        must(restore(again, k, &err), &err, "restore");
        finish(again);
        assert_true(motus_run_events(whole) > 4);
        same_end(s, whole, again, "callback");
        assert_int_equal(restore(other, k, &err), MOTUS_STATE); /* another event */
        free(k.text);
        motus_run_destroy(whole);
        motus_run_destroy(half);
        motus_run_destroy(again);
        motus_run_destroy(other);
        motus_system_destroy(s);
        motus_system_destroy(named);
    }
}

static void backward_runs_restart_too(void **state)
{
    (void)state;
    relay(&(motion){motions[1].text, -7.01}, "rk4", 3);
    relay(&(motion){motions[2].text, -7.01}, "verlet", 3);
    relay(&(motion){motions[2].text, -7.01}, "dop853", 2);
}

/* A trace is of one step of the method, and refuses runs whose steps may be several. */
static void no_trace(void **state)
{
    (void)state;
    motus_system *s = given_text(motions[1].text);
    motus_run *r = made(s, "rk4", 3, MOTUS_BARS_NONE), *untouched = made(s, "rk4", 3, MOTUS_BARS_NONE);
    const motus_trace_entry *const *entries = NULL;
    size_t count = 0;
    motus_error err = motus_default_error();
    assert_int_equal(motus_run_trace(r, &entries, &count, &err), MOTUS_UNAVAILABLE);
    assert_true(strlen(err.hint) > 10);
    same_end(s, r, untouched, "after the refusal");
    motus_run_destroy(r);
    motus_run_destroy(untouched);
    motus_system_destroy(s);
}

/* ---- what does not fit ---- */

static void other_events_are_other_models(void **state)
{
    (void)state;
    static const char *const lines[] = {"when y = 0 falling as hit: y' = -0.8 y', record",
                                        "when y = 0 falling as hit: y' = -0.7 y', record",
                                        "when y = 0.1 falling as hit: y' = -0.8 y', record",
                                        "when y = 0 rising as hit: y' = -0.8 y', record",
                                        "when y = 0 falling as hip: y' = -0.8 y', record",
                                        "when y = 0 falling as hit: y' = -0.8 y'",
                                        "when y < 0 as hit: y' = -0.8 y', record",
                                        "when every 0.3 as hit: y' = -0.8 y', record",
                                        "when every 0.4 as hit: y' = -0.8 y', record",
                                        "when y = 0 falling as hit: y' = -0.8 y', record, stop after 9",
                                        ""};
    enum { LINES = sizeof lines / sizeof *lines };
    kept k[LINES];
    motus_system *s[LINES];
    motus_run *r[LINES];
    for (int i = 0; i < LINES; i++) {
        char text[256];
        snprintf(text, sizeof text, "y'' = -9.81; y(0) = 1; y'(0) = 0; %s", lines[i]);
        s[i] = given_text(text);
        r[i] = made(s[i], "rk4", 2, MOTUS_BARS_NONE);
        take_steps(r[i], 15);
        k[i] = save(r[i]);
    }
    for (int i = 0; i < LINES; i++)
        for (int j = 0; j < LINES; j++) {
            motus_error err;
            if (restore(r[i], k[j], &err) != (i == j ? MOTUS_OK : MOTUS_STATE)) fail_msg("%s: %s", lines[i], lines[j]);
        }
    for (int i = 0; i < LINES; i++) {
        free(k[i].text);
        motus_run_destroy(r[i]);
        motus_system_destroy(s[i]);
    }
}

static const char small[] = "y'' = -9.81; y(0) = 0.1; y'(0) = 0; n = 0; k = count(hit); when y = 0 falling as hit: "
                            "y' = -0.8 y', n = n + 1, record; when y > 0.05 as high: record; when every 0.2: record";

static void damage_is_seen(void **state)
{
    (void)state;
    motus_system *s = given_text(small);
    motus_run *r = made(s, "verlet", 1, MOTUS_BARS_NONE), *q = made(s, "verlet", 1, MOTUS_BARS_NONE);
    motus_error err;
    take_steps(r, 7);
    take_steps(q, 7);
    kept k = save(r);
    assert_true(motus_run_events(r) >= 3);
    no_damage_passes(q, k);
    same_end(s, r, q, "after all that");
    motus_run *early = made(s, "verlet", 0.2, MOTUS_BARS_NONE);
    assert_int_equal(restore(early, k, &err), MOTUS_STATE);
    assert_non_null(strstr(err.message, "beyond the end"));
    must(restore(q, k, &err), &err, "undamaged");
    free(k.text);
    motus_run_destroy(early);
    motus_run_destroy(r);
    motus_run_destroy(q);
    motus_system_destroy(s);
}

/* A number of the block of events, in place of each, and the run goes on: it may go wrong, but it ends. */
static void forged_events_do_no_harm(void **state)
{
    (void)state;
    static const char *const numbers[] = {"nan",
                                          "inf",
                                          "-inf",
                                          "0x0p+0",
                                          "-0x1.0000000000000p+0",
                                          "0x1.8000000000000p+0",
                                          "0x1.0000000000000p+53",
                                          "0x1.0000000000000p+63",
                                          "0x1.0000000000000p-1022",
                                          "-0x1.0000000000000p+1000"};
    static const char *const methods[] = {"verlet", "dop853"};
    for (size_t m = 0; m < 2; m++) {
        motus_system *s = given_text(small);
        motus_run *r = made(s, methods[m], 1, MOTUS_BARS_NONE), *q = made(s, methods[m], 1, MOTUS_BARS_NONE);
        motus_error err;
        take_steps(r, 7);
        kept k = save(r);
        char *copy = malloc(k.length + 64);
        int refused = 0, taken = 0;
        assert_non_null(copy);
        for (const char *at = strstr(k.text, "\nevents "); at && *at; at = strchr(at + 1, '\n')) {
            const char *end = strchr(at + 1, '\n');
            for (size_t j = 0; end && j < sizeof numbers / sizeof *numbers; j++) {
                const int n =
                    snprintf(copy, k.length + 64, "%.*s%s%s", (int)(at + 1 - k.text), k.text, numbers[j], end);
                seal(copy, (size_t)n);
                if (restore(q, (kept){copy, (size_t)n}, &err) != MOTUS_OK) {
                    refused++;
                    assert_true(err.status == MOTUS_STATE);
                    continue;
                }
                taken++;
                motus_run_step(q, 20, &err);
                for (int64_t row = 0; row < motus_run_events(q); row++) {
                    motus_event_row out = motus_default_event_row();
                    assert_int_equal(motus_run_event(q, row, &out), MOTUS_OK);
                }
            }
        }
        assert_true(refused > 100 && taken > 10);
        must(restore(q, k, &err), &err, "undamaged");
        finish(q);
        finish(r);
        same_end(s, r, q, "after all that");
        assert_true(refuse_forgeries(q, k) > 100);
        free(copy);
        free(k.text);
        motus_run_destroy(r);
        motus_run_destroy(q);
        motus_system_destroy(s);
    }
}

/* ---- errors ---- */

/* The bars of a restored run cover the errors from the very start: they are those of a run that was not interrupted,
 * but for what another landing of its companion changes; and as many events are significant. */
static void bars_survive(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        int motion;
    } runs[] = {{"dop853", 0}, {"dopri5", 1}, {"rk4", 2}, {"verlet", 1}, {"tsit5", 2}};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++)
        for (motus_bars kind = MOTUS_BARS_CHEAP; kind <= MOTUS_BARS_FULL; kind++) {
            motus_system *s = given_text(motions[runs[i].motion].text);
            motus_run *whole = made(s, runs[i].method, motions[runs[i].motion].until, kind),
                      *first = made(s, runs[i].method, motions[runs[i].motion].until, kind),
                      *second = made(s, runs[i].method, motions[runs[i].motion].until, kind);
            motus_error err;
            finish(whole);
            take_steps(first, motus_run_steps(whole) / 2);
            kept k = save(first);
            must(restore(second, k, &err), &err, "restore");
            finish(second);
            same_end(s, whole, second, runs[i].method);
            assert_int_equal(motus_run_events_significant(whole), motus_run_events_significant(second));
            int alike = 0, rows = (int)motus_run_events(whole);
            for (int64_t n = 0; n < rows; n++) {
                motus_event_row a = motus_default_event_row(), b = motus_default_event_row();
                motus_run_event(whole, n, &a);
                motus_run_event(second, n, &b);
                assert_false(isnan(a.error) || isinf(a.error) != isinf(b.error));
                alike += b.error <= 2 * a.error && a.error <= 2 * b.error;
            }
            if (alike < 0.95 * rows) fail_msg("%s: %d of %d bars are alike", runs[i].method, alike, rows);
            free(k.text);
            motus_run_destroy(whole);
            motus_run_destroy(first);
            motus_run_destroy(second);
            motus_system_destroy(s);
        }
}

/* n, and whether it is undecided. */
static double counted(motus_run *r, const motus_system *s, bool *undecided)
{
    motus_error err = motus_default_error();
    size_t column, count;
    double value, error;
    must(motus_column_find(s, "n", &column, &count, &err), &err, "n");
    must(motus_run_errors(r, &column, 1, &value, &error, &err), &err, "n");
    assert_false(isnan(error));
    *undecided = error != 0;
    return value;
}

/* What a touch has left open stays open, whether it was before the state was saved or comes soon after it. */
static void open_counts_survive(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        double off;
    } runs[] = {{"verlet", 4e-5}, {"dopri5", 1e-6}, {"rk4", 1e-8}};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++)
        for (int early = 0; early <= 1; early++) {
            char text[128];
            snprintf(text, sizeof text, "x'' = -x; x(0) = 1; x'(0) = 0; n = 0; when x = %.17g: n = n + 1",
                     1 - runs[i].off);
            motus_system *s = given_text(text);
            motus_run *whole = made(s, runs[i].method, 8, MOTUS_BARS_CHEAP),
                      *first = made(s, runs[i].method, early ? 6 : 6.5, MOTUS_BARS_CHEAP),
                      *second = made(s, runs[i].method, 8, MOTUS_BARS_CHEAP);
            motus_error err;
            bool open, still;
            finish(whole);
            finish(first);
            kept k = save(first);
            must(restore(second, k, &err), &err, "restore");
            finish(second);
            counted(whole, s, &open);
            const double value = counted(second, s, &still);
            if (open != still) fail_msg("%s, %d: %g, undecided %d, and before %d", text, early, value, still, open);
            free(k.text);
            motus_run_destroy(whole);
            motus_run_destroy(first);
            motus_run_destroy(second);
            motus_system_destroy(s);
        }
}

/* A state of another version, which has fewer numbers of errors, tells no error, and is not damaged. */
static void states_of_other_versions(void **state)
{
    (void)state;
    for (int bars = MOTUS_BARS_CHEAP; bars <= MOTUS_BARS_FULL; bars++) {
        motus_system *s = given_text(small);
        motus_run *r = made(s, "dop853", 1, (motus_bars)bars), *q = made(s, "dop853", 1, (motus_bars)bars);
        motus_estimate estimate = motus_default_estimate();
        motus_error err;
        take_steps(r, 7);
        kept k = save(r);
        char *copy = malloc(k.length + 1), *end;
        assert_non_null(copy);
        const char *const block = strstr(k.text, "\nbars "), *const numbers = block ? strchr(block + 1, '\n') : NULL;
        assert_non_null(numbers);
        const long count = strtol(block + 6, &end, 10);
        const char *rest = numbers;
        for (long i = 0; i < count; i++) rest = strchr(rest + 1, '\n');
        const char *before = rest; /* the last number is left out */
        while (*--before != '\n') {}
        const int n = snprintf(copy, k.length + 1, "%.*s\nbars %ld%.*s%s", (int)(block - k.text), k.text, count - 1,
                               (int)(before - numbers), numbers, rest);
        seal(copy, (size_t)n);
        must(restore(q, (kept){copy, (size_t)n}, &err), &err, "another version");
        finish(q);
        must(motus_run_estimate(q, &estimate, &err), &err, "estimate");
        if (!strstr(estimate.reason, "restored from a state without its error")) fail_msg("%s", estimate.reason);
        free(copy);
        free(k.text);
        motus_run_destroy(r);
        motus_run_destroy(q);
        motus_system_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interrupted_at_every_step),
        cmocka_unit_test(an_earlier_end_leaves_no_trace),
        cmocka_unit_test(callbacks_restart_too),
        cmocka_unit_test(backward_runs_restart_too),
        cmocka_unit_test(other_events_are_other_models),
        cmocka_unit_test(damage_is_seen),
        cmocka_unit_test(open_counts_survive),
        cmocka_unit_test(states_of_other_versions),
        cmocka_unit_test(forged_events_do_no_harm),
        cmocka_unit_test(bars_survive),
        cmocka_unit_test(no_trace),
    };
    return cmocka_run_group_tests_name("restart states with events", tests, NULL, NULL);
}
