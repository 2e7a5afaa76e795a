/* Bars of event times: they cover the error in at least 99 % of the numbers, and in 95 % by problem. Where steps have
 * errors, at least 90 % of the bars are at most ten times the error, or 4 units in the last place; where the
 * acceleration is constant, and roundings are the only errors, half of them are: one companion is one sample of what
 * rounding does, and a bar that covers 99 % of the errors of a normal distribution is within ten times of 80 % at most.
 * Where motions separate, the table says from which event on no digit is left. The truths are closed forms, or of 28
 * digits. */
#include "given.h"
#include "test/share.h"

#include <stdbool.h>

typedef struct tally {
    int numbers, covered, tight;
} tally;

typedef struct motion {
    const char *name, *text, *event;
    double until;
    int most;                                          /* events whose truth is known */
    long double (*time)(const struct motion *, int k); /* of event k, from 0 */
    bool velocity;
    long double a, b, c; /* numbers of the closed form */
} motion;

/* From height a, gravity b, and c of the speed after each impact. */
static long double ball_time(const motion *m, int k)
{
    long double v = sqrtl(2 * m->a * m->b), t = v / m->b;
    for (; k > 0; k--) {
        v *= m->c;
        t += 2 * v / m->b;
    }
    return t;
}

static const long double impacts[] = {1.67342826210498117805025072070L, 3.01406938887196200883075732888L,
                                      3.92927159289860139617730243101L, 4.60591186327090975855926811612L,
                                      5.12373885465642749855106438208L, 5.52721893942831152667921653909L};
static long double air_time(const motion *m, int k) { return (void)m, impacts[k]; }

/* theta(0) = 2: zeros at a quarter of the period, then every half. */
static long double pendulum_time(const motion *m, int k)
{
    return (void)m, 8.34975292691849473440637164590L * (0.25L + 0.5L * k);
}

/* In a circle chords are equal. From (a, 0) with the velocity (b, c) of length 1. */
static long double billiard_time(const motion *m, int k)
{
    const long double along = m->a * m->b, momentum = m->a * m->c;
    return sqrtl(along * along + 1 - m->a * m->a) - along + k * 2 * sqrtl(1 - momentum * momentum);
}

static const long double zeros[] = {
    3.146126371519089563543618799L, 6.33871996271640648011776202L,  9.642644084488746690939382588L,
    13.18606336669535296143955121L, 17.31722771995645706816759923L, 21.39203715022197633513287579L,
    24.91396289908009393035922124L, 28.20368896104338093934710691L, 31.37300455084850691545310845L,
    34.13597712583383084755092755L, 34.82699058047161404077155746L, 37.74033531653721834303421747L};
static long double zero_time(const motion *m, int k) { return (void)m, zeros[k]; }

static const long double sections[] = {
    6.305060277593710935940563L, 12.36796712392794588351869L, 18.62428475347270523312171L, 24.85611048724269017452118L,
    31.21012002223483739648868L, 37.17875198365734451764153L, 43.53244106691717551012224L, 49.76324473977179797271114L,
    56.02282065084169614855783L, 62.08230338872012678226642L};
static long double section_time(const motion *m, int k) { return (void)m, sections[k]; }

static const motion motions[] = {
    {"ball", "y'' = -9.81; y(0) = 1; y'(0) = 0; when y = 0 falling as hit: y' = -0.8 y', record", "hit", 4, 20,
     ball_time, false, 1, 9.81L, 0.8L},
    {"ball of 1/2", "y'' = -9.81; y(0) = 10; y'(0) = 0; when y = 0 falling as hit: y' = -0.5 y', record", "hit", 4.28,
     10, ball_time, false, 10, 9.81L, 0.5L},
    {"ball of 3/4", "y'' = -1.62; y(0) = 3; y'(0) = 0; when y = 0 falling as hit: y' = -0.75 y', record", "hit", 13, 15,
     ball_time, false, 3, 1.62L, 0.75L},
    {"ball of 9/10", "y'' = -9.8; y(0) = 50; y'(0) = 0; when y = 0 falling as hit: y' = -0.9 y', record", "hit", 50, 18,
     ball_time, false, 50, 9.8L, 0.9L},
    {"ball in air",
     "y'' = -9.81 - 0.1 y' |y'|; y(0) = 10; y'(0) = 0; when y = 0 falling as hit: y' = -0.8 y', record; "
     "when y' = 0 falling as top: record",
     "hit", 5.6, 6, air_time, true, 0, 0, 0},
    {"pendulum", "u'' = -sin(u); u(0) = 2; u'(0) = 0; when u = 0 as hit: record", "hit", 60, 14, pendulum_time, false,
     0, 0, 0},
    {"billiard",
     "r'' = (0, 0); r(0) = (0.5, 0); r'(0) = (0.6, 0.8); "
     "when |r|^2 = 1 rising as hit: r' = r' - 2 dot(r', r) r/dot(r, r), record",
     "hit", 60, 33, billiard_time, false, 0.5L, 0.6L, 0.8L},
    {"billiard 2",
     "r'' = (0, 0); r(0) = (0.3, 0); r'(0) = (0.8, 0.6); "
     "when |r|^2 = 1 rising as hit: r' = r' - 2 dot(r', r) r/dot(r, r), record",
     "hit", 60, 33, billiard_time, false, 0.3L, 0.8L, 0.6L},
    {"billiard 3",
     "r'' = (0, 0); r(0) = (0.7, 0); r'(0) = (0.28, 0.96); "
     "when |r|^2 = 1 rising as hit: r' = r' - 2 dot(r', r) r/dot(r, r), record",
     "hit", 60, 33, billiard_time, false, 0.7L, 0.28L, 0.96L},
    {"billiard 4",
     "r'' = (0, 0); r(0) = (0.2, 0); r'(0) = (0.96, 0.28); "
     "when |r|^2 = 1 rising as hit: r' = r' - 2 dot(r', r) r/dot(r, r), record",
     "hit", 60, 33, billiard_time, false, 0.2L, 0.96L, 0.28L},
    {"driven", "x'' = -x + x^3 + 0.1 cos(t); x(0) = 0; x'(0) = 0; when x = 0 as hit: record", "hit", 38, 12, zero_time,
     false, 0, 0, 0},
    {"section",
     "x'' = -x - 2 x y; y'' = -y - x^2 + y^2; x(0) = 0; y(0) = 0.1; x'(0) = 0.49; y'(0) = 0; "
     "when x = 0 rising as hit: record",
     "hit", 65, 10, section_time, false, 0, 0, 0},
};

static const struct way {
    const char *method;
    double from;
    int sizes;
    double factor;
    bool adaptive, velocity;
} by[] = {{"dop853", 1e-5, 5, 1e-2, true, true},      {"dopri5", 1e-5, 4, 1e-2, true, true},
          {"radau15", 1e-5, 5, 1e-2, true, true},     {"taylor", 1e-5, 5, 1e-2, true, true},
          {"tsit5", 1e-5, 4, 1e-2, true, true},       {"verner7", 1e-5, 4, 1e-2, true, true},
          {"dep6", 1e-5, 4, 1e-2, true, false},       {"rk4", 0.04, 4, 0.4, false, true},
          {"verlet", 0.02, 4, 0.4, false, true},      {"gauss8", 0.1, 3, 0.5, false, true},
          {"blanes-moan6", 0.1, 3, 0.5, false, false}};

static void take(const motion *m, const struct way *w, double size, tally *to)
{
    motus_error err = motus_default_error();
    motus_system *s = given_text(m->text);
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = w->method;
    *(w->adaptive ? &def.tolerance : &def.step) = size;
    def.until = m->until;
    def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, m->name);
    must(motus_run_finish(r, &err), &err, m->name);
    const int64_t rows = motus_run_events(r), known = motus_run_events_significant(r);
    int k = 0;
    for (int64_t i = 0; i < rows && i < known && k < m->most; i++) {
        motus_event_row row = motus_default_event_row();
        assert_int_equal(motus_run_event(r, i, &row), MOTUS_OK);
        if (strcmp(row.name, m->event)) continue;
        assert_false(isnan(row.error)); /* the companion came as far */
        const double off = (double)fabsl(row.time - m->time(m, k++)), ulp = nextafter(row.time, 1e300) - row.time;
        to->numbers++;
        to->covered += off <= row.error;
        to->tight += row.error <= fmax(10 * off, 4 * ulp);
        if (getenv("SHOW") && !(off <= row.error))
            printf("%s %s %g: event %d off %.2e, bar %.2e\n", m->name, w->method, size, k, off, row.error);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void bars_of_event_times(void **state)
{
    (void)state;
    tally all[2] = {{0, 0, 0}, {0, 0, 0}}; /* of constant accelerations, and of others */
    bool low = false;
    int turn = 0;
    for (size_t j = 0; j < sizeof motions / sizeof *motions; j++) {
        const bool constant = motions[j].a > 0;
        tally one = {0, 0, 0}, *sum = &all[!constant];
        for (size_t k = 0; k < sizeof by / sizeof *by; k++) {
            if (motions[j].velocity && !by[k].velocity) continue;
            double size = by[k].from;
            const int sizes = constant && by[k].adaptive ? 1 : by[k].sizes; /* the tolerance changes no step */
            for (int i = 0; i < sizes; i++, size *= by[k].factor)
                if (share_takes(&turn)) take(&motions[j], &by[k], size, &one);
        }
        printf("%-12s %5d event times: %.2f %% within their bar, %.2f %% tight\n", motions[j].name, one.numbers,
               100.0 * one.covered / one.numbers, 100.0 * one.tight / one.numbers);
        low |= one.covered < 0.95 * one.numbers;
        sum->numbers += one.numbers, sum->covered += one.covered, sum->tight += one.tight;
    }
    const int numbers = all[0].numbers + all[1].numbers, covered = all[0].covered + all[1].covered;
    printf("%d event times: %.2f %% within their bar; tight %.2f %% and %.2f %%\n", numbers, 100.0 * covered / numbers,
           100.0 * all[1].tight / all[1].numbers, 100.0 * all[0].tight / all[0].numbers);
    assert_false(low);
    assert_true(covered >= 0.99 * numbers);
    if (share_one_in() > 1) return; /* a few cases are no statistics of tightness */
    assert_true(all[1].tight >= 0.9 * all[1].numbers);
    assert_true(all[0].tight >= 0.5 * all[0].numbers);
}

/* The stadium: an error grows by exp(0.96) a hit, so a double has digits for some 38 hits. */
static void a_stadium_loses_all_digits(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = given_text("r'' = (0, 0); r(0) = (0.2, 0.1); r'(0) = (0.8, 0.6); "
                                 "n = (sign(r.x) max(|r.x| - 1, 0), r.y); "
                                 "when |n|^2 = 1 rising as hit: r' = r' - 2 dot(r', n) n/dot(n, n), record; until 120");
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "dop853";
    def.tolerance = 1e-14;
    def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, "stadium");
    must(motus_run_finish(r, &err), &err, "stadium");
    const int64_t known = motus_run_events_significant(r);
    static const struct {
        int hit;
        double t;
    } truths[] = {{1, 1.408492607088319165286287054},  {2, 3.065477821264957495858861161},
                  {3, 6.827046834481633646920640762},  {4, 9.207836957264900833297582029},
                  {5, 11.42964678421349371223357969},  {10, 16.94038997256210474277321781},
                  {20, 39.19316993526689108700000681}, {30, 54.99452047218082444317199932}};
    printf("stadium: %lld of %lld hits have digits\n", (long long)known, (long long)motus_run_events(r));
    for (int64_t i = 0; getenv("SHOW") && i < motus_run_events(r); i++) {
        motus_event_row row = motus_default_event_row();
        motus_run_event(r, i, &row);
        printf("  %lld t %.17g +- %.2e\n", (long long)i + 1, row.time, row.error);
    }
    for (size_t k = 0; k < sizeof truths / sizeof *truths; k++) {
        motus_event_row row = motus_default_event_row();
        assert_int_equal(motus_run_event(r, truths[k].hit - 1, &row), MOTUS_OK);
        printf("  hit %d: off %.1e, bar %.1e\n", truths[k].hit, fabs(row.time - truths[k].t), row.error);
        assert_true(fabs(row.time - truths[k].t) <= row.error);
    }
    assert_true(known >= 32 && known <= 44);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* ---- errors between steps ---- */

/* A ball let fall from 1, of which e of the speed is left: its height at t. */
static long double height(long double g, long double e, long double t)
{
    long double v = sqrtl(2 * g), from = v / g;
    if (t < from) return 1 - g * t * t / 2;
    for (v *= e; t >= from + 2 * v / g; v *= e) from += 2 * v / g;
    return v * (t - from) - g * (t - from) * (t - from) / 2;
}

/* Errors asked for between steps, as a plot does, go on through events, and leave those of the end and of events. */
static void bars_between_steps(void **state)
{
    (void)state;
    static const char *const methods[] = {"dop853", "taylor", "tsit5", "radau15", "rk4"};
    enum { TIMES = 300, WAYS = sizeof methods / sizeof *methods };
    int all = 0;
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        motus_error err = motus_default_error();
        motus_system *s =
            given_text("y'' = -9.81; y(0) = 1; y'(0) = 0; when y = 0 falling as hit: y' = -0.8 y', record");
        motus_run_def def = motus_default_run();
        motus_run *r = NULL;
        def.method = methods[m], def.until = 3, def.error = MOTUS_BARS_CHEAP;
        *(given_adaptive(methods[m]) ? &def.tolerance : &def.step) = given_adaptive(methods[m]) ? 1e-9 : 0.02;
        must(motus_run_create(s, &def, &r, &err), &err, methods[m]);
        const size_t y = column(s, "y");
        int covered = 0;
        for (int k = 1; k < TIMES; k++) {
            const double t = 3.0 * k / TIMES;
            double value, error;
            must(motus_run_sample_errors(r, &t, 1, &y, 1, &value, &error, &err), &err, methods[m]);
            assert_true(isfinite(error));
            const long double off = fabsl(value - height(9.81L, 0.8L, t));
            covered += off <= error;
            if (getenv("SHOW") && off > error)
                printf("%s at %g: off %.1e, bar %.1e\n", methods[m], t, (double)off, error);
        }
        printf("%s: %d of %d between steps\n", methods[m], covered, TIMES - 1);
        assert_true(covered >= 0.95 * (TIMES - 1));
        all += covered;
        must(motus_run_finish(r, &err), &err, methods[m]);
        double value, error;
        must(motus_run_errors(r, &y, 1, &value, &error, &err), &err, methods[m]);
        assert_true(fabsl(value - height(9.81L, 0.8L, 3)) <= error && error < 1e-12);
        assert_int_equal(motus_run_events_significant(r), motus_run_events(r));
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
    assert_true(all >= 0.99 * WAYS * (TIMES - 1));
}

/* ---- where bounces accumulate ---- */

/* sqrt(2 h/g) (1 + e)/(1 - e), with h = 2 and g = 9.81, or a ball that stays where it lands; and the limit of the state
 * is 0. No event is recorded, so that it is the actions that count. */
static void limits_of_balls(void **state)
{
    (void)state;
    static const struct {
        const char *e;
        long double value;
    } balls[] = {{"0", 0},        {"0.3", 0.3L},   {"0.6", 0.6L},   {"0.85", 0.85L},  {"0.93", 0.93L},
                 {"0.95", 0.95L}, {"0.98", 0.98L}, {"0.99", 0.99L}, {"0.995", 0.995L}};
    static const struct {
        const char *method;
        double size;
    } ways[] = {{"verlet", 0.125}, {"rk4", 0.05},    {"pefrl", 0.0625}, {"gauss8", 0.1},
                {"dop853", 1e-9},  {"dopri5", 1e-6}, {"taylor", 1e-12}, {"radau15", 1e-9}};
    int turn = 0;
    for (size_t b = 0; b < sizeof balls / sizeof *balls; b++) {
        for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
            if (!share_takes(&turn)) continue;
            motus_error err = motus_default_error();
            char text[200];
            snprintf(text, sizeof text, "y'' = -9.81; y(0) = 2; y'(0) = 0; e = %s; when y = 0 falling as b: y' = -e y'",
                     balls[b].e);
            motus_system *s = given_text(text);
            motus_run_def def = motus_default_run();
            motus_run *r = NULL;
            def.method = ways[w].method, def.until = 2000, def.error = MOTUS_BARS_CHEAP;
            *(given_adaptive(ways[w].method) ? &def.tolerance : &def.step) = ways[w].size;
            must(motus_run_create(s, &def, &r, &err), &err, ways[w].method);
            must(motus_run_finish(r, &err), &err, ways[w].method);
            int gathers;
            double limit, error, value[2], bar[2];
            assert_string_equal(motus_run_ended(r, &gathers, &limit, &error), "b");
            assert_true(gathers);
            const long double e = balls[b].value, want = sqrtl(4 / 9.81L) * (1 + e) / (1 - e);
            const size_t of[] = {column(s, "y"), column(s, "y'")};
            must(motus_run_errors(r, of, 2, value, bar, &err), &err, ways[w].method);
            if (getenv("SHOW"))
                printf("e = %s by %s: off %.1e, bar %.1e; y %.1e, bar %.1e; y' %.1e, bar %.1e\n", balls[b].e,
                       ways[w].method, (double)fabsl(limit - want), error, value[0], bar[0], value[1], bar[1]);
            assert_true(fabsl(limit - want) <= error);
            assert_true(error < 1e-13 * (double)(want / ((1 - e) * (1 - e)))); /* some roundings of every flight */
            for (int k = 0; k < 2; k++) assert_true(fabs(value[k]) <= bar[k] && bar[k] < 1e-6);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
    }
}

/* ---- rows of one instant, and clocks ---- */

/* x = cos t: two rules on one function, and one on the velocity. */
static void rows_of_one_instant(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = given_text("x'' = -x; x(0) = 1; x'(0) = 0; when x = 0.3 as a: record; "
                                 "when x = 0.3 falling as b: record; when x' = 0 as c: record");
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "dop853", def.tolerance = 1e-9, def.until = 60, def.error = MOTUS_BARS_FULL;
    must(motus_run_create(s, &def, &r, &err), &err, "rows");
    must(motus_run_finish(r, &err), &err, "rows");
    assert_int_equal(motus_run_events(r), 10 + 10 + 9 + 19); /* twice a period, and once; half periods */
    assert_int_equal(motus_run_events_significant(r), motus_run_events(r));
    const long double pi = 3.14159265358979323846L, at = acosl(0.3L);
    for (int64_t k = 0; k < motus_run_events(r); k++) {
        motus_event_row row = motus_default_event_row();
        assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
        const long double n = row.count, turn = row.count % 2 ? (n - 1) * pi + at : n * pi - at;
        const long double want = row.name[0] == 'c' ? n * pi : row.name[0] == 'b' ? 2 * (n - 1) * pi + at : turn;
        assert_true(fabsl(row.time - want) <= row.error);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A kicked rotor is chaotic: its states are lost, but the clock is not. */
static void clocks_stay_known(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s =
        given_text("x'' = 0; x(0) = 0.5; x'(0) = 0.3; when every 0.1 as kick: x' = x' + 80 sin(x), record");
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "dop853", def.tolerance = 1e-9, def.until = 20.05, def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, "rotor");
    must(motus_run_finish(r, &err), &err, "rotor");
    assert_int_equal(motus_run_events(r), 200);
    for (int64_t k = 0; k < 200; k++) {
        motus_event_row row = motus_default_event_row();
        assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
        assert_true(fabsl(row.time - (k + 1) / 10.0L) <= row.error && row.error < 1e-14);
    }
    const size_t x = column(s, "x");
    double error;
    must(motus_run_event_errors(r, 199, 0, &x, 1, NULL, &error, &err), &err, "rotor");
    assert_true(error == INFINITY);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A relay x'' = -a sign(x - b) from x, v, up to the time until. */
static const struct relay {
    const char *text;
    long double a, b, x, v, until;
} relays[] = {
    {"x'' = if(x > 0.2, -2.91, 2.91); x(0) = 0.64; x'(0) = 0.68; when x = 0.2 as hit: record", 2.91L, 0.2L, 0.64L,
     0.68L, 26.2L},
    {"x'' = -2.64 sign(x + 0.19); x(0) = 0.39; x'(0) = -0.82; when x = -0.19 as hit: record", 2.64L, -0.19L, 0.39L,
     -0.82L, 167.3L},
    {"x'' = -1.37 sign(x); x(0) = 1.1; x'(0) = 0.3; when x = 0 as hit: record", 1.37L, 0, 1.1L, 0.3L, 90.5L},
    {"x'' = if(x > -0.3, -0.73, 0.73); x(0) = 0.9; x'(0) = 0; when x = -0.3 as hit: record", 0.73L, -0.3L, 0.9L, 0,
     120.7L},
};

/* Its state at the time t behind turn k; k = -1: before the first. */
static void relay_state(const struct relay *m, long double speed, int k, long double t, long double *x, long double *v)
{
    const long double way = k % 2 == 0 ? -1 : 1;
    *x = k < 0 ? m->x + m->v * t - m->a * t * t / 2 : m->b + way * (speed * t - m->a * t * t / 2);
    *v = k < 0 ? m->v - m->a * t : way * (speed - m->a * t);
}

static void count_state(motus_run *r, motus_system *s, long double x, long double v, tally *to)
{
    motus_error err = motus_default_error();
    const size_t columns[] = {column(s, "x"), column(s, "x'")};
    double values[2], off[2];
    must(motus_run_errors(r, columns, 2, values, off, &err), &err, "state");
    to->numbers += 2;
    to->covered += (fabsl(values[0] - x) <= off[0]) + (fabsl(values[1] - v) <= off[1]);
}

static void take_relay(const struct relay *m, const char *method, tally *times, tally *states)
{
    motus_error err = motus_default_error();
    motus_system *s = given_text(m->text);
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method, def.tolerance = 1e-9, def.until = (double)m->until, def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, m->text);
    must(motus_run_finish(r, &err), &err, m->text);
    const long double speed = sqrtl(m->v * m->v + 2 * m->a * (m->x - m->b)), first = (m->v + speed) / m->a;
    const int64_t rows = motus_run_events(r);
    assert_int_equal(rows, 1 + (int64_t)((def.until - first) * m->a / (2 * speed)));
    for (int64_t k = 0; k < rows; k++) {
        motus_event_row row = motus_default_event_row();
        assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
        times->numbers++;
        times->covered += fabsl(row.time - (first + 2 * speed / m->a * k)) <= row.error;
    }
    long double x, v;
    relay_state(m, speed, (int)rows - 1, m->until - first - 2 * speed / m->a * (rows - 1), &x, &v);
    count_state(r, s, x, v, states);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* What the roundings of one flight leave adds up over all that follow. */
static void relays_of_many_turns(void **state)
{
    (void)state;
    static const char *const methods[] = {"dop853", "dopri5", "verner6", "verner7", "verner8",
                                          "taylor", "gragg",  "dep6",    "dep12",   "gauss12-reversible"};
    tally times = {0, 0, 0}, states = {0, 0, 0};
    for (size_t j = 0; j < sizeof relays / sizeof *relays; j++)
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
            take_relay(&relays[j], methods[k], &times, &states);
    printf("relays: %d of %d times and %d of %d numbers of the state within their bar\n", times.covered, times.numbers,
           states.covered, states.numbers);
    assert_true(times.covered >= 0.95 * times.numbers);
    assert_true(states.covered >= 0.95 * states.numbers);
}

/* The event that ends a run happens where the run ends; a mode that another one assigned is known there. */
static void modes_at_the_end(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "A = 0.75\ny'' = -A\ny(0) = 10\ny'(0) = 0\nwhen t = 1: A = 30\nwhen y = 1 falling: stop\nuntil 20",
        "A = 0\ny'' = -1\ny(0) = 10\ny'(0) = 0\nwhen y = 5 falling: A = 30\nwhen y = 1 falling: stop\nuntil 20",
        "A = 0\ny'' = -1\ny(0) = 10\ny'(0) = 0\nwhen y = 1 falling: A = 30, stop\nuntil 20"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        motus_system *s = given_text(texts[k]);
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *r = NULL;
        size_t column, count;
        double value, error;
        def.error = MOTUS_BARS_CHEAP, def.machine = "interpreter", def.accuracy = 1e-9;
        must(motus_run_create(s, &def, &r, &err), &err, texts[k]);
        must(motus_run_finish(r, &err), &err, texts[k]);
        must(motus_column_find(s, "A", &column, &count, &err), &err, texts[k]);
        must(motus_run_errors(r, &column, 1, &value, &error, &err), &err, texts[k]);
        if (value != 30 || error != 0) fail_msg("%s: A is %g ± %g", texts[k], value, error);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* A number at the end of a run. */
static double told(const char *text, const char *name, const char *method, double size, double until, double *error)
{
    motus_system *s = given_text(text);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    size_t column, count;
    double value;
    def.error = MOTUS_BARS_CHEAP, def.machine = "interpreter", def.method = method, def.until = until;
    *(given_adaptive(method) ? &def.tolerance : &def.step) = size;
    must(motus_run_create(s, &def, &r, &err), &err, text);
    must(motus_run_finish(r, &err), &err, text);
    must(motus_column_find(s, name, &column, &count, &err), &err, text);
    must(motus_run_errors(r, &column, 1, &value, error, &err), &err, text);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return value;
}

/* A counter; *error: 0 where it is known, at least 1 where it is not. */
static double counted(const char *text, const char *method, double size, double until, double *error)
{
    return told(text, "n", method, size, until, error);
}

#define QUARTER 1.5707963267948966

/* An event within the error of the run's end has happened or not; one that is farther off is decided, and so is one
 * that the motion would pass the other way. */
static void counts_near_the_end(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        double size;
    } ways[] = {{"rk4", 0.1},     {"rk4", 0.3},     {"verlet", 0.01}, {"explicit-euler", 0.01},
                {"dopri5", 1e-3}, {"dopri5", 1e-6}, {"dop853", 1e-9}, {"taylor", 1e-9}};
    static const char *const texts[] = {"x'' = -x; x(0) = 1; x'(0) = 0; n = 0; when x = 0: n = n + 1",
                                        "x'' = -x; x(0) = 1; x'(0) = 0; n = 0; when x < 0: n = n + 1, record"};
    double error, bar;
    for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
        const char *const method = ways[w].method;
        told(texts[0], "x", method, ways[w].size, QUARTER, &bar);
        for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
            for (int side = -1; side <= 1; side++) {
                counted(texts[k], method, ways[w].size, QUARTER + side * bar / 8, &error);
                if (!(error >= 1)) fail_msg("%s by %s: an event %g off is counted", texts[k], method, side * bar / 8);
            }
            for (int side = 0; side <= 1; side++) {
                const double value = counted(texts[k], method, ways[w].size, side ? 1.7 : 1.45, &error);
                if (value != side || error != 0)
                    fail_msg("%s by %s: %g ± %g for %d", texts[k], method, value, error, side);
            }
        }
        const double value = counted("x'' = -x; x(0) = 1; x'(0) = 0; n = 0; when x = 0 rising: n = n + 1", method,
                                     ways[w].size, QUARTER, &error);
        if (value != 0 || error != 0) fail_msg("by %s: %g ± %g for 0 events that rise", method, value, error);
    }
}

/* The largest x is 1, and a function has its extremum there: where it is nearer to 0 than the bar of the state, it
 * passes 0 twice or not at all; where it is farther, it is counted. */
static void counts_near_a_touch(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        double size;
    } ways[] = {{"rk4", 0.1},     {"rk4", 0.3},     {"verlet", 0.05}, {"leapfrog", 0.1}, {"explicit-euler", 0.01},
                {"dopri5", 1e-3}, {"dopri5", 1e-6}, {"dop853", 1e-6}};
    static const char *const occasions[] = {"when x = A", "when x - A = 0 rising", "when x > A"};
    for (size_t w = 0; w < sizeof ways / sizeof *ways; w++)
        for (size_t k = 0; k < sizeof occasions / sizeof *occasions; k++) {
            char text[256];
            double bar, error;
            const char *const form = "x'' = -x; x(0) = cos(2); x'(0) = sin(2); n = 0; A = %.17g; %s: n = n + 1";
            snprintf(text, sizeof text, form, 2.0, occasions[k]);
            told(text, "x", ways[w].method, ways[w].size, 2, &bar); /* where it is largest */
            const double at[] = {-bar / 32, bar / 1000, bar / 32};
            for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
                snprintf(text, sizeof text, form, 1 + at[i], occasions[k]);
                counted(text, ways[w].method, ways[w].size, 5, &error);
                if (!(error >= 1)) fail_msg("%s by %s: a touch %g off is counted", text, ways[w].method, at[i]);
            }
            for (int beyond = 0; beyond <= 1; beyond++) {
                snprintf(text, sizeof text, form, beyond ? 1.2 : 0.8, occasions[k]);
                const double want = beyond ? 0 : k == 0 ? 2 : 1;
                const double value = counted(text, ways[w].method, ways[w].size, 5, &error);
                if (value != want || error != 0) fail_msg("%s by %s: %g ± %g", text, ways[w].method, value, error);
            }
        }
}

/* A touch has no slope, however small the bars are: what is off by fewer digits than a value tells of the place of an
 * extremum is open, too. */
static void counts_near_a_close_touch(void **state)
{
    (void)state;
    static const double places[] = {0.999999999999998, 0.9999999999999999, 1.0000000000000002},
                        tolerances[] = {1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        for (size_t k = 0; k < sizeof tolerances / sizeof *tolerances; k++)
            for (int late = 0; late <= 1; late++) {
                char text[256];
                double error;
                const char *const method = late ? "dopri5" : "dop853";
                snprintf(text, sizeof text, "x'' = -x; x(0) = 1; x'(0) = 0; n = 0; when x = %.17g: n = n + 1",
                         places[i]);
                const double value = counted(text, method, tolerances[k], 7, &error), want = places[i] < 1 ? 3 : 0;
                if (!(error >= 1) && value != want)
                    fail_msg("%s by %s, tolerance %g: %g", text, method, tolerances[k], value);
            }
}

/* Where friction stops a block within rounding of a place, it has come there or not; that it has stopped is certain. */
static void counts_where_it_stops(void **state)
{
    (void)state;
    static const double off[] = {-2e-15, -4e-16, 0, 4e-16, 1.7e-15, 3e-15};
    static const char *const methods[] = {"taylor", "dop853", "dopri5", "rk4"};
    double error;
    for (size_t w = 0; w < sizeof methods / sizeof *methods; w++) {
        const double size = given_adaptive(methods[w]) ? 1e-10 : 0.01;
        for (size_t k = 0; k < sizeof off / sizeof *off; k++) {
            char text[256];
            snprintf(text, sizeof text, "x'' = -0.7 sign(x'); x(0) = 0; x'(0) = 1; n = 0; when x = %.17g: n = n + 1",
                     1 / 1.4 + off[k]);
            const double value = counted(text, methods[w], size, 5, &error);
            if (error == 0 && (off[k] == 0 || value != (off[k] < 0))) fail_msg("%s by %s: %g", text, methods[w], value);
        }
        if (!given_adaptive(methods[w])) continue; /* by whose own steps it slides to and fro */
        const double stopped = counted("x'' = -0.7 sign(x'); x(0) = 0; x'(0) = 1; n = 0; when x' = 0: n = n + 1",
                                       methods[w], size, 5, &error);
        if (stopped != 1 || error != 0) fail_msg("by %s: %g ± %g stops", methods[w], stopped, error);
    }
}

/* So many extrema near 0 between two landings that not all are looked at leave the counts open. */
static void counts_of_many_touches(void **state)
{
    (void)state;
    double error;
    counted("x[i]'' = -x[i] for i = 1..5000; x[i](0) = cos(2) for i = 1..5000; x[i]'(0) = sin(2) for i = 1..5000\n"
            "y'' = -y; y(0) = cos(2); y'(0) = sin(2); n = 0; m = 0\n"
            "when x[i] = 1: m = m + 1 for i = 1..5000\nwhen y = 1: n = n + 1",
            "verlet", 0.05, 5, &error);
    assert_true(error >= 1);
}

/* The run ends where an event ends it, whatever has happened in that instant; what rests at 0 has come there, and what
 * a clock does is done at its time. */
static void counts_that_are_decided(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double until, value;
    } known[] = {{"y'' = -9.81; y(0) = 1; y'(0) = 0; n = 0; when y = 0 falling: y' = -0.8 y', n = n + 1, record; when "
                  "n >= 4: stop",
                  9, 4},
                 {"x'' = -0.3 sign(x'); x(0) = 0; x'(0) = 1; n = 0; when x' = 0: n = n + 1", 5, 1},
                 {"x'' = -1; x(0) = 1; x'(0) = 1; n = 0; when every 0.125: x' = x' + 0.1, n = n + 1", 1, 8},
                 {"x'' = -x; x(0) = 1; x'(0) = 0; n = 0; when x > 0: n = n + 1", QUARTER, 0}};
    double error;
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        const double value = counted(known[k].text, "dop853", 1e-9, known[k].until, &error);
        if (value != known[k].value || error != 0) fail_msg("%s: %g ± %g", known[k].text, value, error);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_near_the_end),        cmocka_unit_test(counts_near_a_touch),
        cmocka_unit_test(counts_near_a_close_touch),  cmocka_unit_test(counts_of_many_touches),
        cmocka_unit_test(counts_where_it_stops),      cmocka_unit_test(counts_that_are_decided),
        cmocka_unit_test(modes_at_the_end),           cmocka_unit_test(bars_of_event_times),
        cmocka_unit_test(bars_between_steps),         cmocka_unit_test(limits_of_balls),
        cmocka_unit_test(rows_of_one_instant),        cmocka_unit_test(clocks_stay_known),
        cmocka_unit_test(a_stadium_loses_all_digits), cmocka_unit_test(relays_of_many_turns)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
