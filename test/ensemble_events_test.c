/* Events of ensembles: the table of every trajectory is that of a run with its values, with its errors, whatever the
 * other trajectories and however many threads compute them.
 */
#include "test/given.h"

static const char ball[] =
    "e = 0.8; k = 0.1; T = 0.5; half = T/2; y'' = -9.81 - k y' |y'|; y(0) = 1; y'(0) = 0; n = 0; last = time(hit, "
    "last); "
    "energy = y'^2/2 + 9.81 y; "
    "when y = 0 falling as hit: y' = -e y', n = n + 1, record; when y' = 0 falling as top: record; "
    "when y > 0.5 as high: record, stop after 3; when every 2 half as tick: y' = y' + 0.001, record";

enum { COUNT = 7, VARIED = 4, COLUMNS = 5 };
static const char *const varied[VARIED] = {"e", "y(0)", "k", "T"};
static const double values[VARIED][COUNT] = {{0.5, 0.8, 0.9, 0.7, 0.95, 0.6, 0.85},
                                             {1, 2, 0.3, 0.75, 1.5, 0.4, 3},
                                             {0.1, 0, 0.3, 0.2, 0.05, 1, 0.15},
                                             {0.5, 0.7, 0.31, 0.43, 5, 0.17, 0.61}};

typedef struct flock {
    motus_system *s;
    motus_ensemble *e;
    size_t columns[COLUMNS];
    double result[COUNT], error[COUNT], stopped[COUNT], tolerance[COUNT], none[COUNT];
} flock;

static void columns_of(const motus_system *s, size_t out[COLUMNS])
{
    static const char *const names[COLUMNS] = {"y", "y'", "n", "energy", "last"};
    for (size_t k = 0; k < COLUMNS; k++) out[k] = column(s, names[k]);
}

typedef struct way {
    const char *method;
    double step, tolerance, accuracy;
    motus_bars error;
    double until;
} way;

static void make(flock *f, const way *w, int threads, const char *machine)
{
    motus_error err = motus_default_error();
    motus_ensemble_def def = motus_default_ensemble();
    f->s = given_text(ball);
    columns_of(f->s, f->columns);
    const motus_record record[] = {{MOTUS_REDUCE_FINAL, column(f->s, "y")}, {MOTUS_REDUCE_TOLERANCE, 0}};
    def.vary = varied;
    def.vary_count = VARIED;
    def.records = record;
    def.record_count = 2;
    def.method = w->method;
    def.step = w->step, def.tolerance = w->tolerance, def.accuracy = w->accuracy;
    def.until = w->until;
    def.threads = threads;
    def.machine = machine;
    def.error = w->error;
    def.events = 1;
    def.event_columns = f->columns;
    def.event_column_count = COLUMNS;
    must(motus_ensemble_create(f->s, &def, &f->e, &err), &err, "ensemble");
}

static void compute(flock *f, const way *w, size_t first, size_t count)
{
    motus_error err = motus_default_error();
    const double *given[VARIED];
    double *results[] = {f->result, f->tolerance}, *errors[] = {f->error, f->none};
    for (size_t k = 0; k < VARIED; k++) given[k] = values[k] + first;
    must(w->error ? motus_ensemble_run_errors(f->e, count, given, results, errors, f->stopped, &err)
                  : motus_ensemble_run(f->e, count, given, results, f->stopped, &err),
         &err, "run");
}

static void end(flock *f)
{
    motus_ensemble_destroy(f->e);
    motus_system_destroy(f->s);
}

/* Trajectory k as a run of its own; blind: it tells no errors, since its witness might refuse steps. */
static motus_run *alone(const way *w, size_t k, int blind, motus_system **s)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    *s = given_text(ball);
    for (size_t i = 0; i < VARIED; i++) must(motus_system_set(*s, varied[i], &values[i][k], 1, &err), &err, varied[i]);
    def.method = w->method;
    def.step = w->step, def.tolerance = w->tolerance, def.accuracy = w->accuracy;
    def.until = w->until;
    def.machine = "interpreter";
    def.error = blind ? MOTUS_BARS_NONE : w->error;
    must(motus_run_create(*s, &def, &r, &err), &err, "alone");
    must(motus_run_finish(r, &err), &err, "alone");
    motus_run_events_significant(r); /* its companion comes as far */
    return r;
}

static int same(double a, double b) { return a == b || (isnan(a) && isnan(b)); }

static void same_table(const flock *f, size_t at, const way *w, size_t k, int blind)
{
    motus_system *s;
    motus_run *r = alone(w, k, blind, &s);
    const int64_t rows = motus_run_events(r);
    if (motus_ensemble_events(f->e, at) != rows)
        fail_msg("%s, trajectory %zu: %lld events, alone %lld", w->method, k,
                 (long long)motus_ensemble_events(f->e, at), (long long)rows);
    assert_true(rows > 0);
    assert_string_equal(motus_ensemble_ended(f->e, at), motus_run_ended(r, NULL, NULL, NULL));
    for (int64_t i = 0; i < rows; i++) {
        motus_event_row a = motus_default_event_row(), b = motus_default_event_row();
        double of[2][COLUMNS], alone_of[COLUMNS];
        motus_error err = motus_default_error();
        assert_int_equal(motus_ensemble_event(f->e, at, i, &a, of[0], of[1]), MOTUS_OK);
        assert_int_equal(motus_run_event(r, i, &b), MOTUS_OK);
        assert_string_equal(a.name, b.name);
        assert_string_equal(a.instance, b.instance);
        assert_int_equal(a.count, b.count);
        assert_int_equal(a.touched, b.touched);
        assert_int_equal(a.changed, b.changed);
        if (!same(a.time, b.time)) fail_msg("%s %zu: %s at %a, alone %a", w->method, k, a.name, a.time, b.time);
        if (w->error && !blind && !same(a.error, b.error))
            fail_msg("%s %zu: %s at %.9g is known to %g, alone to %g", w->method, k, a.name, a.time, a.error, b.error);
        assert_true(w->error ? !isnan(a.error) : isnan(a.error));
        for (int after = 0; after < 2; after++) {
            must(motus_run_event_values(r, i, after, f->columns, COLUMNS, alone_of, &err), &err, "values");
            for (size_t c = 0; c < COLUMNS; c++)
                if (!same(of[after][c], alone_of[c]))
                    fail_msg("%s %zu: column %zu of %s at %g is %a, alone %a", w->method, k, c, a.name, a.time,
                             of[after][c], alone_of[c]);
        }
    }
    double y = value(s, r, "y");
    assert_true(same(y, f->result[at]));
    if (w->error && !blind) {
        double error = NAN;
        motus_error err = motus_default_error();
        must(motus_run_errors(r, &f->columns[0], 1, &y, &error, &err), &err, "error");
        if (!same(error, f->error[at])) fail_msg("%s %zu: error %g, alone %g", w->method, k, f->error[at], error);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static const way ways[] = {
    {"verlet", 0.01, NAN, NAN, MOTUS_BARS_NONE, 3},  {"rk4", 0.013, NAN, NAN, MOTUS_BARS_NONE, 3},
    {"dop853", NAN, 1e-9, NAN, MOTUS_BARS_NONE, 3},  {"taylor", NAN, 1e-12, NAN, MOTUS_BARS_NONE, 3},
    {"dopri5", NAN, 1e-8, NAN, MOTUS_BARS_CHEAP, 3}, {"rk4", 0.01, NAN, NAN, MOTUS_BARS_CHEAP, 3},
    {"dop853", NAN, 1e-9, NAN, MOTUS_BARS_FULL, 3}};

static void tables_are_those_of_runs(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
        for (int threads = 1; threads <= 2; threads++) {
            const way *w = &ways[i];
            if (w->method[0] == 't' && threads == 2) continue;
            flock f;
            make(&f, w, threads, "interpreter");
            compute(&f, w, 0, COUNT);
            for (size_t k = 0; k < COUNT; k++) same_table(&f, k, w, k, 0);
            compute(&f, w, 4, 2); /* other neighbours */
            assert_int_equal(motus_ensemble_events(f.e, 2), 0);
            for (size_t k = 0; k < 2; k++) same_table(&f, k, w, 4 + k, 0);
            end(&f);
        }
}

/* With an accuracy each trajectory has the table of the tolerance that was found for it. */
static void an_accuracy_has_its_tables(void **state)
{
    (void)state;
    const way w = {"dopri5", NAN, NAN, 1e-11, MOTUS_BARS_CHEAP, 3};
    flock f;
    make(&f, &w, 2, "interpreter");
    compute(&f, &w, 0, COUNT);
    int other = 0;
    for (size_t k = 0; k < COUNT; k++) {
        way found = w;
        found.accuracy = NAN, found.tolerance = f.tolerance[k];
        same_table(&f, k, &found, k, 1);
        other += f.tolerance[k] != motus_ensemble_now(f.e).tolerance;
    }
    assert_true(other > 0); /* some were computed again */
    end(&f);
}

/* A stop, a stop after some, an accumulation and nothing: each is what ends the run. A trajectory that fails has no
 * end, and one without a beginning has no events of its neighbour. */
static void what_ended(void **state)
{
    (void)state;
    static const char text[] = "e = 0.5; c = 0; y'' = -1; y(0) = sqrt(1 - c); y'(0) = 0; "
                               "s'' = 6 c s^2; s(0) = 1; s'(0) = 2; "
                               "when y = 0 falling as bounce: y' = -e y', record; "
                               "when y' = 0 falling as top: record, stop after 2; when y < -0.1 as below: stop; "
                               "when t = 9 as late: record";
    enum { ENDS = 7 };
    static const double restitution[ENDS] = {0.5, 0.9, 0, -1, 0.9, 0.9, 1e-3}, c[ENDS] = {0, 0, 0, 0, 2, 0.9, 0};
    static const char *const want[ENDS] = {"top", "top", "bounce", "below", "", "", ""};
    static const char *const kinds[] = {"bounce", "top", "below", "late"};
    const double until[ENDS] = {30, 30, 30, 30, 30, 30, 1};
    const double *const given[] = {restitution, c, until};
    const char *const vary[] = {"e", "c", "until"};
    for (int threads = 1; threads <= 2; threads++) {
        double result[ENDS], stopped[ENDS];
        double *const results[] = {result};
        motus_error err = motus_default_error();
        motus_ensemble *e = NULL;
        motus_system *s = given_text(text);
        const motus_record record = {MOTUS_REDUCE_FINAL, 0};
        motus_ensemble_def def = motus_default_ensemble();
        def.vary = vary, def.vary_count = 3, def.records = &record, def.record_count = 1;
        def.method = "dop853", def.tolerance = 1e-9, def.threads = threads, def.machine = "interpreter";
        def.events = 1;
        must(motus_ensemble_create(s, &def, &e, &err), &err, "ensemble");
        assert_string_equal(motus_ensemble_ended(e, 0), "");
        must(motus_ensemble_run(e, ENDS, given, results, stopped, &err), &err, "run");
        for (size_t k = 0; k < ENDS; k++) {
            if (strcmp(motus_ensemble_ended(e, k), want[k]) != 0)
                fail_msg("trajectory %zu is ended by '%s'", k, motus_ensemble_ended(e, k));
            assert_int_equal(!isnan(stopped[k]), k == 4 || k == 5);
        }
        assert_int_equal(motus_ensemble_events(e, 4), 0); /* sqrt(-1): it has no beginning */
        assert_string_equal(motus_ensemble_ended(e, ENDS), "");
        assert_string_equal(motus_ensemble_ended(NULL, 0), "");
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
            assert_string_equal(motus_ensemble_kind(e, k), kinds[k]);
        assert_null(motus_ensemble_kind(e, 4));
        assert_null(motus_ensemble_kind(NULL, 0));
        must(motus_ensemble_run(e, 1, given, results, stopped, &err), &err, "run");
        assert_string_equal(motus_ensemble_ended(e, 0), "top");
        assert_string_equal(motus_ensemble_ended(e, 1), ""); /* of the last call */
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
    }
}

static void what_there_is_not(void **state)
{
    (void)state;
    flock f;
    motus_error err = motus_default_error();
    motus_event_row row = motus_default_event_row();
    make(&f, &ways[0], 1, "interpreter");
    assert_int_equal(motus_ensemble_events(f.e, 0), 0);
    assert_int_equal(motus_ensemble_event(f.e, 0, 0, &row, NULL, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_events(NULL, 0), 0);
    compute(&f, &ways[0], 0, 1);
    assert_true(motus_ensemble_events(f.e, 0) > 0);
    assert_int_equal(motus_ensemble_event(f.e, 0, 0, &row, NULL, NULL), MOTUS_OK);
    assert_int_equal(motus_ensemble_event(f.e, 0, -1, &row, NULL, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_event(f.e, 0, motus_ensemble_events(f.e, 0), &row, NULL, NULL), MOTUS_ARGUMENT);
    const double bad[] = {0.5, 0, -1, NAN}, same_of[] = {0.5, 0.5, 0.5, 0.5};
    for (size_t k = 1; k < 4; k++) {
        const double *given[VARIED] = {same_of, same_of, same_of, bad + k};
        double *results[] = {f.result, f.tolerance};
        assert_int_equal(motus_ensemble_run(f.e, 1, given, results, f.stopped, &err), MOTUS_ARGUMENT);
        assert_non_null(strstr(err.message, "tick happens every"));
    }
    motus_ensemble_def def = motus_default_ensemble();
    motus_ensemble *none = NULL;
    const motus_record record = {MOTUS_REDUCE_FINAL, 1};
    const size_t beyond = 1000;
    def.records = &record, def.record_count = 1, def.method = "rk4", def.step = 0.1, def.until = 1;
    def.events = 1, def.event_columns = &beyond, def.event_column_count = 1;
    assert_int_equal(motus_ensemble_create(f.s, &def, &none, &err), MOTUS_ARGUMENT);
    def.event_columns = NULL;
    assert_int_equal(motus_ensemble_create(f.s, &def, &none, &err), MOTUS_ARGUMENT);
    end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_are_those_of_runs),
        cmocka_unit_test(an_accuracy_has_its_tables),
        cmocka_unit_test(what_ended),
        cmocka_unit_test(what_there_is_not),
    };
    return cmocka_run_group_tests_name("events of ensembles", tests, NULL, NULL);
}
