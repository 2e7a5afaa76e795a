/* The models with events do what their comments say: times and states against closed forms and published digits, with
 * their own method and with others, and an end where their events accumulate. The truths are in 25 digits and more, or
 * recurrences in long double. */
#include "given.h"

static motus_run *finished(motus_system *s, const char *method, double size, double until)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method;
    *(given_adaptive(method) ? &def.tolerance : &def.step) = size;
    def.until = until;
    def.machine = "interpreter";
    def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, method ? method : "run");
    must(motus_run_finish(r, &err), &err, method ? method : "run");
    return r;
}

static motus_event_row row_of(motus_run *r, int64_t k)
{
    motus_event_row row = motus_default_event_row();
    assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
    return row;
}

static double at_event(const motus_system *s, motus_run *r, int64_t k, int after, const char *name)
{
    motus_error err = motus_default_error();
    const size_t of = column(s, name);
    double out = NAN;
    must(motus_run_event_values(r, k, after, &of, 1, &out, &err), &err, name);
    return out;
}

static double limit_of(motus_run *r, const char *name, double *error)
{
    int accumulates = 0;
    double limit = NAN;
    assert_string_equal(motus_run_ended(r, &accumulates, &limit, error), name);
    assert_true(accumulates);
    return limit;
}

/* ---- the ball ---- */

static const struct {
    const char *method;
    double size;
} ways[] = {{NULL, NAN},
            {"rk4", NAN},
            {"verlet", 0.001},
            {"symplectic-euler", NAN},
            {"gauss8", NAN},
            {"beeman", NAN},
            {"dop853", 1e-9},
            {"taylor", 1e-9},
            {"dep4", 1e-9},
            {"bs32", 1e-9},
            {"radau15", 1e-9},
            {"verner9", 1e-13},
            {"exact", NAN},
            {"verlet-reversible", 1e-6},
            {"blanes-moan4-reversible", 1e-6},
            {"blanes-moan6-reversible", 1e-6},
            {"kahan-li8-reversible", 1e-9},
            {"gauss8-reversible", 1e-6},
            {"gauss12-reversible", 1e-9}};

/* Of order 2 and more: the motion is a polynomial of degree 2, which they integrate exactly. */
static int is_exact(const char *method) { return !method || strcmp(method, "symplectic-euler") != 0; }

/* No point of the motion is below the floor by more than a unit in the last place of the height; of reversible rows,
 * which round in up to 17 substeps, by more than four. */
static void stays_above(motus_system *s, const char *method, double size)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    const size_t y = column(s, "y");
    const double least = method && strstr(method, "-reversible") ? -0x1p-50 : -0x1p-52;
    def.method = method;
    *(given_adaptive(method) ? &def.tolerance : &def.step) = size;
    def.machine = "interpreter";
    must(motus_run_create(s, &def, &r, &err), &err, "run");
    double from = motus_run_time(r), height;
    while (!motus_run_done(r)) {
        must(motus_run_step(r, 1, &err), &err, "step");
        enum { POINTS = 16 };
        const double to = motus_run_time(r);
        for (int k = 1; k <= POINTS; k++) {
            const double t = k == POINTS ? to : from + (to - from) * k / POINTS;
            must(motus_run_sample(r, &t, 1, &y, 1, &height, &err), &err, "sample");
            if (!(height >= least))
                fail_msg("%s: at t = %.17g the ball is at %.3g", motus_run_now(r).method, t, height);
        }
        from = to;
    }
    for (int64_t k = 0; k < motus_run_events(r); k++) assert_true(at_event(s, r, k, 0, "y") >= least);
    motus_run_destroy(r);
}

static void the_ball(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        motus_system *s = given_model("bouncing-ball.motus", NULL, 0);
        motus_run *r = finished(s, ways[k].method, ways[k].size, NAN);
        const char *const method = motus_run_now(r).method;
        double error, worst = 0, bar = 0;
        const int64_t known = motus_run_events_significant(r);
        const double limit = limit_of(r, "bounce", &error);
        long double t = sqrtl(2 / 9.81L), v = sqrtl(2 * 9.81L);
        for (int n = 0; n < 100 && is_exact(ways[k].method); n++) {
            const double ulp = nextafter((double)t, 10) - (double)t;
            assert_int_equal(row_of(r, n).count, n + 1);
            worst = fmax(worst, fabs((double)(row_of(r, n).time - t)) / ulp);
            bar += fabs((double)(row_of(r, n).time - t)) <= row_of(r, n).error;
            v *= 0.8L;
            t += 2 * v / 9.81L;
        }
        printf("%s: %lld bounces, worst %.2f ulp, %g of 100 within their bar, limit %.17g ± %.1e\n", method,
               (long long)motus_run_events(r), worst, bar, limit, error);
        if (!ways[k].method) assert_true(worst <= 4); /* as the model says it; other steps round more often */
        if (is_exact(ways[k].method)) {
            assert_true(motus_run_events(r) >= 130 && known >= 130);
            assert_true(bar >= 99);
            assert_true(fabs(limit - 4.06371276887157814) <= error && error < 1e-11);
        } else {
            assert_true(error == INFINITY); /* its companion has another motion */
        }
        motus_run_destroy(r);
        stays_above(s, ways[k].method, ways[k].size);
        motus_system_destroy(s);
    }
}

/* A ball that stays where it lands: whatever the rule does it falls again in the same instant, so its events accumulate
 * there, and lead into a mode where the model says so. */
static void a_ball_that_stays(void **state)
{
    (void)state;
    static const char text[] = "y'' = -9.81; y(0) = 1; y'(0) = 0; when y = 0 falling as land: y' = 0, record; "
                               "step 0.125; until 3";
    static const char rests[] = "rest = 0; y'' = if(rest > 0, 0, -9.81); y(0) = 1; y'(0) = 0; "
                                "when y = 0 falling as land: y' = 0, record; "
                                "when land accumulates: y = 0, y' = 0, rest = 1; step 0.125; until 3";
    static const char *const methods[] = {"verlet", "rk4", "dop853", "symplectic-euler", "taylor"};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        motus_system *s = given_text(text);
        const double size = given_adaptive(methods[k]) ? 1e-9 : NAN;
        motus_run *r = finished(s, methods[k], size, NAN);
        double error;
        assert_int_equal(motus_run_events(r), 1);
        assert_true(limit_of(r, "land", &error) == row_of(r, 0).time && motus_run_time(r) == row_of(r, 0).time);
        motus_run_destroy(r);
        motus_system_destroy(s);
        s = given_text(rests);
        r = finished(s, methods[k], size, NAN);
        assert_int_equal(motus_run_events(r), 1);
        assert_true(motus_run_time(r) == 3 && value(s, r, "y") == 0 && value(s, r, "y'") == 0);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* ---- the billiard ---- */

static void the_billiard(void **state)
{
    (void)state;
    static const struct {
        int hit;
        double t, x, y;
    } truths[] = {{1, 0.616515138991168001317609439, 0.869909083394700800790566, 0.493212111192934401054088},
                  {2, 2.44954541697350400395282832, -0.953167270022092288284604, 0.302443639970543615620528},
                  {10, 17.1137876408321920250345793, -0.820598105201600312246973, 0.571505686532989194337369},
                  {100, 182.086512659242432262204278, -0.753877846057603726258227, -0.657014606552661002444287},
                  {1000, 1831.81376284334483463390127, -0.167606338366116508261994, -0.985854003054966989062709}};
    const char *const methods[] = {NULL, "rk4", "symplectic-euler", "dop853", "taylor"};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        motus_system *s = given_model("billiard.motus", NULL, 0);
        motus_run *r = finished(s, methods[k], given_adaptive(methods[k]) ? 1e-9 : NAN, 1832);
        double worst = 0;
        assert_int_equal(motus_run_events(r), 1000);
        for (size_t i = 0; i < sizeof truths / sizeof *truths; i++) {
            const int64_t n = truths[i].hit - 1;
            worst = fmax(worst, fabs(row_of(r, n).time - truths[i].t));
            worst = fmax(worst, fabs(at_event(s, r, n, 0, "r.x") - truths[i].x));
            worst = fmax(worst, fabs(at_event(s, r, n, 0, "r.y") - truths[i].y));
        }
        /* every chord has the length 2 sqrt(1 - L^2), L = 0.4 */
        const long double first = 0.616515138991168001317609439L, chord = 2 * sqrtl(0.84L);
        for (int n = 0; n < 1000; n++) worst = fmax(worst, (double)fabsl(row_of(r, n).time - (first + n * chord)));
        printf("%s: 1000 hits, worst %.1e\n", motus_run_now(r).method, worst);
        assert_true(worst <= 1e-11);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* ---- the cradle ---- */

static void the_cradle(void **state)
{
    (void)state;
    const char *const methods[] = {NULL, "rk4", "symplectic-euler", "dop853", "taylor"};
    const char *const two[] = {"places=[0, 1, 3, 4]", "speeds=[1, 1, 0, 0]"};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
        for (size_t come = 1; come <= 2; come++) {
            motus_system *s = given_model("newtons-cradle.motus", two, 2 * (come - 1));
            motus_run *r = finished(s, methods[k], given_adaptive(methods[k]) ? 1e-9 : NAN, NAN);
            char name[16];
            if (come == 1) assert_int_equal(motus_run_events(r), 3);
            for (int64_t i = 0; i < motus_run_events(r) && come == 1; i++) near(row_of(r, i).time, 1, 0x1p-51, "t");
            for (int i = 1; i <= 4; i++) { /* as many roll away as come */
                snprintf(name, sizeof name, "x[%d]'", i);
                near(value(s, r, name), i > 4 - (int)come, 0x1p-50, name);
            }
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* A number that has become 0 has the bar of what it was before, and none of 2e-323. */
static void the_bar_of_a_zero(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = given_model("newtons-cradle.motus", NULL, 0);
    motus_run *r = finished(s, NULL, NAN, NAN);
    const size_t of[] = {column(s, "x[1]'"), column(s, "x[2]'")};
    double values[2], errors[2];
    must(motus_run_errors(r, of, 2, values, errors, &err), &err, "errors");
    assert_true(values[0] == 0 && errors[0] == 0x1p-50); /* 4 units in the last place of 1 */
    assert_true(values[1] == 0 && errors[1] == 0);       /* at rest whenever the companion was compared */
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Masses 1 and 100^n before a wall: as many contacts as the first digits of pi say. */
static void counting_pi(void **state)
{
    (void)state;
    static const int64_t expected[] = {3, 31, 314, 3141};
    const char *const methods[] = {"verlet", "rk4", "symplectic-euler", "dop853"};
    char text[512];
    double m = 1;
    for (int n = 0; n < 4; n++, m *= 100)
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
            snprintf(text, sizeof text,
                     "m = %g; a'' = 0; b'' = 0; a(0) = 1; b(0) = 2; a'(0) = 0; b'(0) = -1; "
                     "when b - a = 0 falling as clack: a' = ((1 - m) a' + 2 m b')/(1 + m), "
                     "b' = ((m - 1) b' + 2 a')/(1 + m), record; "
                     "when a = 0 falling as wall: a' = -a', record; until 20",
                     m);
            motus_system *s = given_text(text);
            motus_run *r = finished(s, methods[k], given_adaptive(methods[k]) ? 1e-9 : 0.25, NAN);
            assert_int_equal(motus_run_events(r), expected[n]);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* ---- the belt ---- */

/* Slips and sticks at the times of the closed form, with the period to 1e-13 by rows of high order. */
static void the_belt(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        double tolerance, within;
    } rows[] = {{"taylor", 1e-13, 1e-13},  {"radau15", 1e-13, 1e-13}, {"gragg", 1e-13, 1e-13},
                {"dop853", 1e-14, 1e-13},  {"verner9", 1e-13, 1e-13}, {"verner7", 1e-13, 1e-13},
                {"fine5", 1e-13, 1e-13},   {"fine4", 1e-13, 1e-13},   {NULL, NAN, 1e-11},
                {"tsit5", 1e-11, 1e-10},   {"dopri5", 1e-11, 1e-10},  {"verner6", 1e-11, 1e-10},
                {"verner8", 1e-11, 1e-10}, {"bs32", 1e-9, 1e-8},      {"gauss12-reversible", 1e-13, 1e-13}};
    const long double pi = 3.14159265358979323846264338327950288L, b = 0.8L, slips = 2 * (pi - atanl(b)),
                      period = 2 * b + slips;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        motus_system *s = given_model("stick-slip.motus", NULL, 0);
        motus_run *r = finished(s, rows[k].method, rows[k].tolerance, NAN);
        const double within = rows[k].within;
        assert_int_equal(motus_run_events(r), 9);
        for (int64_t n = 0; n < 9; n++) {
            const motus_event_row row = row_of(r, n);
            const long double t = 2 + (long double)(n / 2) * period + (n % 2 ? slips : 0);
            assert_string_equal(row.name, n % 2 ? "stick" : "slip");
            near(row.time, (double)t, within * (double)(n + 1), "t");
            near(at_event(s, r, n, 0, "x"), n % 2 ? 0.2 : 1, within, "x");
            near(at_event(s, r, n, 1, "x'"), 0.5, n % 2 ? 0 : 0x1p-53, "x'");
            if (n >= 2) near(row.time - row_of(r, n - 2).time, (double)period, within, "the period");
        }
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* Equal periods end nowhere, though what tells the sticking is 0 right after it, by rounding or for good: every
 * slip and every stick up to t = 1000 happens, by any method. */
static void the_belt_goes_on(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "rk4", NULL, "dop853", "taylor"};
    motus_system *s = given_model("stick-slip.motus", NULL, 0);
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        motus_run *r = finished(s, methods[k], given_adaptive(methods[k]) ? 1e-9 : NAN, 1000);
        assert_string_equal(motus_run_accumulates(r), "");
        assert_true(motus_run_time(r) == 1000);
        /* slips at 2 + k T, k = 0 .. 152; it sticks 4.93 later, the last time at 1000.06 */
        assert_int_equal(motus_run_events(r), 153 + 152);
        assert_int_equal(motus_run_events_significant(r), 153 + 152); /* its companion has had the same events */
        motus_run_destroy(r);
    }
    motus_system_destroy(s);
}

/* ---- the rotor ---- */

static void the_rotor(void **state)
{
    (void)state;
    const char *const methods[] = {NULL, "rk4", "symplectic-euler", "dop853", "taylor"};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        motus_system *s = given_model("kicked-rotor.motus", NULL, 0);
        motus_run *r = finished(s, methods[k], given_adaptive(methods[k]) ? 1e-9 : NAN, NAN);
        long double x = 1, p = 0;
        assert_int_equal(motus_run_events(r), 100);
        near(at_event(s, r, 0, 1, "x'"), 0.8414709848078965066525, 0x1p-53, "the velocity after the first kick");
        for (int n = 1; n <= 100; n++) {
            x += p;
            p += sinl(x);
            assert_true(row_of(r, n - 1).time == n);
            near(at_event(s, r, n - 1, 0, "x"), (double)x, 1e-10, "x"); /* neighbours separate */
            near(at_event(s, r, n - 1, 1, "x'"), (double)p, 1e-10, "p");
        }
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* ---- steps that can be taken backward ---- */

/* Steps that follow a time scale go on after an action as before it: a ball that leaves the floor, where its height
 * says nothing of the scale, and one that no force pushes, whose steps stay as long as without walls. */
static void reversible_steps(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet-reversible",    "blanes-moan4-reversible", "blanes-moan6-reversible",
                                          "kahan-li8-reversible", "gauss8-reversible",       "gauss12-reversible"};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        motus_system *s = given_text("y'' = -1; y(0) = 1; y'(0) = 0; when y = 0 falling: y' = -0.9 y', record");
        motus_run *r = finished(s, methods[k], 1e-6, 12);
        double t = sqrt(2), flight = 1.8 * sqrt(2);
        for (int64_t n = 0; t < 12; n++, t += flight, flight *= 0.9) near(row_of(r, n).time, t, 1e-12, methods[k]);
        motus_run_destroy(r);
        motus_system_destroy(s);
        int64_t steps[2];
        for (int walls = 0; walls < 2; walls++) {
            s = given_text(walls ? "x'' = 0; x(0) = 0.3; x'(0) = 1; when x = 1 rising: x' = -x', record; "
                                   "when x = 0 falling: x' = -x', record"
                                 : "x'' = 0; x(0) = 0.3; x'(0) = 1");
            r = finished(s, methods[k], 1e-6, 20);
            steps[walls] = motus_run_steps(r);
            assert_int_equal(motus_run_events(r), walls ? 20 : 0);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
        assert_in_range(steps[1], steps[0], steps[0] + 2 * 20);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_ball),         cmocka_unit_test(a_ball_that_stays), cmocka_unit_test(the_billiard),
        cmocka_unit_test(the_cradle),       cmocka_unit_test(the_bar_of_a_zero), cmocka_unit_test(counting_pi),
        cmocka_unit_test(reversible_steps), cmocka_unit_test(the_rotor),         cmocka_unit_test(the_belt),
        cmocka_unit_test(the_belt_goes_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
