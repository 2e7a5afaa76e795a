/* Events of trajectories in lanes: results, tables and causes are those of trajectories computed one at a time, to the
 * bits, whatever the neighbours, by any number of lanes and threads.
 */
#include "test/given.h"
#include "test/share.h"

#include <stdbool.h>

enum { COUNT = 37, VARIED = 3, RECORDS = 7, ROWS_MOST = 8192, COLUMNS_MOST = 3 };

typedef struct subject {
    const char *text, *varied[VARIED], *columns[COLUMNS_MOST];
    double from[VARIED], to[VARIED];
    int64_t most_steps;
    int stopped;  /* at least so many trajectories stop */
    int64_t rows; /* at least so many events of all */
    bool damped;  /* the force reads velocities */
} subject;

#define STAR "x'' = -x - 2 x y\ny'' = -y - x^2 + y^2\nx(0) = 0\ny(0) = 0.1\nx'(0) = 0.3\ny'(0) = 0\n"
static const subject subjects[] = {
    {.text = STAR "step 0.013\nlast = time(up, last)\nwhen x = 0 rising as up: record\nwhen y = 0.1 falling: record\n"
                  "when y > 0.3 and x' < 0: record\nwhen x' = y rising: record\nuntil 60\n",
     .varied = {"y(0)", "x'(0)", "until"},
     .columns = {"x", "y'", "last"},
     .from = {-0.2, 0.05, -30},
     .to = {0.3, 0.4, 60},
     .rows = 300},
    /* it bounces, and comes to rest or ends at the third time that it is high */
    {.text = "step 0.02\ne = 0.8\nk = 0.1\ny'' = -9.81 - k y'\ny(0) = 1\ny'(0) = 0\nn = 0\nenergy = y'^2/2 + 9.81 y\n"
             "when y = 0 falling as hit: y' = -e y', n = n + 1, record\nwhen y' = 0 falling as top: record\n"
             "when y > 0.5 as high: record, stop after 3\nuntil 3\n",
     .varied = {"e", "y(0)", "k"},
     .columns = {"y", "energy", "n"},
     .from = {0.3, 0.2, 0},
     .to = {0.95, 3, 0.3},
     .damped = true,
     .rows = 100},
    /* clocks tick between its passages, at the times of passages, and where a step ends */
    {.text = STAR "step 0.0625\nn = 0\nwhen every 2.5: record\nwhen every 1: y' = 0.99 y', n = n + 1, record\n"
                  "when x = 0 rising: record\nuntil 20\n",
     .varied = {"y(0)", "x'(0)", "until"},
     .columns = {"x", "y'", "n"},
     .from = {-0.2, 0.05, -10},
     .to = {0.3, 0.4, 20},
     .rows = 100},
    /* some leave the finite numbers, and some take too many steps */
    {.text = "step 1/256\nw = 1\nx'' = x^2 - w y\ny'' = -400 w y\nx(0) = 1\nx'(0) = -0.5\ny(0) = 1\ny'(0) = 0\n"
             "when x' = 0 rising: record\nwhen y = 0: record\nuntil 4\n",
     .varied = {"x(0)", "w", "y(0)"},
     .columns = {"x", "y", "y'"},
     .from = {-1, 0.1, 0.5},
     .to = {3, 5, 2},
     .most_steps = 250,
     .stopped = 5,
     .rows = 100},
};

typedef struct outcome {
    double results[RECORDS][COUNT], stopped[COUNT], values[ROWS_MOST][2 * COLUMNS_MOST], times[ROWS_MOST];
    int64_t rows[COUNT], counts[ROWS_MOST], all;
    char names[ROWS_MOST][16];
    motus_cause causes[COUNT];
    int touched[ROWS_MOST];
} outcome;

/* The trajectories from `first` on. */
static void take_results(const motus_ensemble *e, size_t first, size_t count, outcome *out)
{
    for (size_t k = 0; k < count; k++) {
        out->causes[first + k] = motus_ensemble_stopped_by(e, k);
        out->rows[first + k] = motus_ensemble_events(e, k);
        for (int64_t i = 0; i < out->rows[first + k]; i++, out->all++) {
            motus_event_row row = motus_default_event_row();
            double *values = out->values[out->all];
            assert_true(out->all < ROWS_MOST);
            assert_int_equal(motus_ensemble_event(e, k, i, &row, values, values + COLUMNS_MOST), MOTUS_OK);
            out->times[out->all] = row.time;
            out->counts[out->all] = row.count;
            out->touched[out->all] = row.touched;
            snprintf(out->names[out->all], sizeof *out->names, "%s", row.name);
        }
    }
}

/* In two calls, of `part` trajectories and of the others. */
static outcome *compute(const subject *u, const char *method, const char *machine, int lanes, int threads, size_t part)
{
    motus_system *s = given_text(u->text);
    motus_ensemble *e = NULL;
    motus_error err = motus_default_error();
    motus_ensemble_def def = motus_default_ensemble();
    outcome *out = calloc(1, sizeof *out);
    assert_non_null(out);
    size_t columns[COLUMNS_MOST];
    for (size_t k = 0; k < COLUMNS_MOST; k++) columns[k] = column(s, u->columns[k]);
    const motus_record records[RECORDS] = {{MOTUS_REDUCE_FINAL, columns[0]}, {MOTUS_REDUCE_FINAL, columns[1]},
                                           {MOTUS_REDUCE_FINAL, columns[2]}, {MOTUS_REDUCE_STEPS, 0},
                                           {MOTUS_REDUCE_REFUSED, 0},        {MOTUS_REDUCE_SHORTEST_STEP, 0},
                                           {MOTUS_REDUCE_LONGEST_STEP, 0}};
    def.vary = (const char *const *)u->varied, def.vary_count = VARIED;
    def.records = records, def.record_count = RECORDS;
    def.method = method, def.machine = machine;
    def.lanes = lanes, def.threads = threads;
    def.events = 1, def.event_columns = columns, def.event_column_count = COLUMNS_MOST;
    def.causes = 1;
    def.most_steps = u->most_steps;
    must(motus_ensemble_create(s, &def, &e, &err), &err, u->text);
    if (lanes && motus_ensemble_now(e).lanes != lanes)
        fail_msg("%s: %d lanes, not %d: %s", method, motus_ensemble_now(e).lanes, lanes, motus_ensemble_now(e).note);
    double values[VARIED][COUNT];
    for (size_t i = 0; i < VARIED; i++)
        for (size_t k = 0; k < COUNT; k++) {
            const double part_of = fmod(0.618033988749895 * (double)(k + 1) * (double)(i + 1), 1);
            values[i][k] = u->from[i] + part_of * (u->to[i] - u->from[i]);
        }
    for (size_t first = 0; first < COUNT;) {
        const size_t count = first || !part ? COUNT - first : part;
        const double *given[VARIED];
        double *results[RECORDS];
        for (size_t i = 0; i < VARIED; i++) given[i] = values[i] + first;
        for (size_t r = 0; r < RECORDS; r++) results[r] = out->results[r] + first;
        must(motus_ensemble_run(e, count, given, results, out->stopped + first, &err), &err, u->text);
        take_results(e, first, count, out);
        first += count;
    }
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
    return out;
}

static void same(const subject *u, const char *method, int lanes, int threads, const outcome *a, const outcome *b)
{
    for (size_t k = 0; k < COUNT; k++)
        if (a->rows[k] != b->rows[k])
            fail_msg("%s by %s, %d lanes, %d threads: trajectory %zu has %lld events, not %lld", u->text, method, lanes,
                     threads, k, (long long)b->rows[k], (long long)a->rows[k]);
    for (int64_t i = 0; i < a->all; i++)
        if (memcmp(&a->times[i], &b->times[i], sizeof a->times[i]))
            fail_msg("%s by %s, %d lanes, %d threads: event %lld at %a, not %a", u->text, method, lanes, threads,
                     (long long)i, b->times[i], a->times[i]);
    for (size_t r = 0; r < RECORDS; r++)
        for (size_t k = 0; k < COUNT; k++)
            if (memcmp(&a->results[r][k], &b->results[r][k], sizeof(double)))
                fail_msg("%s by %s, %d lanes, %d threads: record %zu of %zu is %a, not %a", u->text, method, lanes,
                         threads, r, k, b->results[r][k], a->results[r][k]);
    assert_memory_equal(a, b, sizeof *a);
}

static void the_same_bits(void **state)
{
    (void)state;
    static const char *const methods[] = {"dop853", "dopri5",      "taylor",   "verlet",
                                          "rk4",    "forest-ruth", "yoshida8", "symplectic-euler"};
    int turn = 0;
    enum { ADAPTIVE = 3, READ_VELOCITIES = 7 }; /* so many of them admit forces that do */
    for (size_t m = 0; m < sizeof subjects / sizeof *subjects; m++)
        for (size_t k = 0; k < (subjects[m].damped ? READ_VELOCITIES : sizeof methods / sizeof *methods); k++) {
            subject of = subjects[m];
            const subject *u = &of;
            if (k >= ADAPTIVE) of.most_steps = 0;
            outcome *one = compute(u, methods[k], "interpreter", 0, 1, 0);
            int stopped = 0;
            for (size_t i = 0; i < COUNT; i++) stopped += !isnan(one->stopped[i]);
            if (one->all < u->rows || stopped < u->stopped)
                fail_msg("%s by %s: %lld rows, %d stopped", u->text, methods[k], (long long)one->all, stopped);
            for (int lanes = 1; lanes <= 16; lanes *= k < ADAPTIVE ? 2 : 4)
                for (int threads = 1; threads <= 2; threads++) {
                    if (!share_takes(&turn)) continue;
                    outcome *many = compute(u, methods[k], "compiled", lanes, threads, lanes == 4 ? 5 : 0);
                    same(u, methods[k], lanes, threads, one, many);
                    free(many);
                }
            free(one);
        }
}

/* What lanes do not follow is computed one at a time, and says why. */
static void others(void **state)
{
    (void)state;
    static const struct {
        const char *method, *text, *why;
        motus_reduction how;
    } all[] = {
        {"radau15", STAR "when x = 0: record\n", "by this method", MOTUS_REDUCE_FINAL},
        {"gauss4", STAR "step 0.1\nwhen x = 0: record\n", "by this method", MOTUS_REDUCE_FINAL},
        {"dop853", STAR "when every 2: record\n", "clocks", MOTUS_REDUCE_FINAL},
        {"dop853", STAR "when x = sin(t): record\n", "depend on the time", MOTUS_REDUCE_FINAL},
        {"dop853", STAR "when x = 0: record\n", "on the way", MOTUS_REDUCE_MAX},
        {"dop853", STAR "when x = 0: record\n", "evaluations", MOTUS_REDUCE_EVALUATIONS},
        {"dop853", "x'' = -sign(x)\nx(0) = 1\nx'(0) = 0\nwhen x = 0.5: record\n", "switches", MOTUS_REDUCE_FINAL},
        {"dop853",
         "q[i]'' = -q[i] for i = 1..3\nq[i](0) = i for i = 1..3\nq[i]'(0) = 0 for i = 1..3\nwhen q[i] = 0.5: record "
         "for i = 1..3\n",
         "families", MOTUS_REDUCE_FINAL},
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        motus_system *s = given_text(all[k].text);
        motus_ensemble *e = NULL;
        motus_error err = motus_default_error();
        motus_ensemble_def def = motus_default_ensemble();
        const motus_record record = {all[k].how, 1};
        def.records = &record, def.record_count = 1;
        def.method = all[k].method, def.machine = "compiled", def.until = 3;
        must(motus_ensemble_create(s, &def, &e, &err), &err, all[k].text);
        assert_int_equal(motus_ensemble_now(e).lanes, 1);
        if (!strstr(motus_ensemble_now(e).note, all[k].why))
            fail_msg("%s: %s", all[k].text, motus_ensemble_now(e).note);
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_bits),
        cmocka_unit_test(others),
    };
    return cmocka_run_group_tests_name("events in lanes", tests, NULL, NULL);
}
