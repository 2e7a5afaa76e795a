/* Bars of event times: they cover the error in at least 99 % of the numbers, by problem in at least 97 %, and at least
 * 85 % of them are at most ten times the error, or 4 units in the last place (of events whose only errors are
 * roundings, the ball and the billiard, fewer than of others); where motions separate, the table says from which
 * event on no digit is left. The truths are closed forms, or of 28 digits. */
#include "given.h"

#include <stdbool.h>

typedef struct tally {
    int numbers, covered, tight;
} tally;

typedef struct motion {
    const char *name, *text, *event;
    double until;
    int most;                   /* events whose truth is known */
    long double (*time)(int k); /* of event k, from 0 */
    bool velocity;
} motion;

static long double ball_time(int k)
{
    long double t = sqrtl(2 / 9.81L), v = sqrtl(2 * 9.81L);
    for (; k > 0; k--) {
        v *= 0.8L;
        t += 2 * v / 9.81L;
    }
    return t;
}

static const long double impacts[] = {1.67342826210498117805025072070L, 3.01406938887196200883075732888L,
                                      3.92927159289860139617730243101L, 4.60591186327090975855926811612L,
                                      5.12373885465642749855106438208L, 5.52721893942831152667921653909L};
static long double air_time(int k) { return impacts[k]; }

/* theta(0) = 2: zeros at a quarter of the period, then every half. */
static long double pendulum_time(int k) { return 8.34975292691849473440637164590L * (0.25L + 0.5L * k); }

/* In a circle chords are equal: 2 sqrt(1 - L^2), L = 0.4. */
static long double billiard_time(int k) { return 0.616515138991168001317609439L + k * 2 * sqrtl(0.84L); }

static const long double zeros[] = {
    3.146126371519089563543618799L, 6.33871996271640648011776202L,  9.642644084488746690939382588L,
    13.18606336669535296143955121L, 17.31722771995645706816759923L, 21.39203715022197633513287579L,
    24.91396289908009393035922124L, 28.20368896104338093934710691L, 31.37300455084850691545310845L,
    34.13597712583383084755092755L, 34.82699058047161404077155746L, 37.74033531653721834303421747L};
static long double zero_time(int k) { return zeros[k]; }

static const long double sections[] = {
    6.305060277593710935940563L, 12.36796712392794588351869L, 18.62428475347270523312171L, 24.85611048724269017452118L,
    31.21012002223483739648868L, 37.17875198365734451764153L, 43.53244106691717551012224L, 49.76324473977179797271114L,
    56.02282065084169614855783L, 62.08230338872012678226642L};
static long double section_time(int k) { return sections[k]; }

static const motion motions[] = {
    {"ball", "y'' = -9.81; y(0) = 1; y'(0) = 0; when y = 0 falling as hit: y' = -0.8 y', record", "hit", 4, 20,
     ball_time, false},
    {"ball in air",
     "y'' = -9.81 - 0.1 y' |y'|; y(0) = 10; y'(0) = 0; when y = 0 falling as hit: y' = -0.8 y', record; "
     "when y' = 0 falling as top: record",
     "hit", 5.6, 6, air_time, true},
    {"pendulum", "u'' = -sin(u); u(0) = 2; u'(0) = 0; when u = 0 as hit: record", "hit", 60, 14, pendulum_time, false},
    {"billiard",
     "r'' = (0, 0); r(0) = (0.5, 0); r'(0) = (0.6, 0.8); "
     "when |r|^2 = 1 rising as hit: r' = r' - 2 dot(r', r) r/dot(r, r), record",
     "hit", 60, 33, billiard_time, false},
    {"driven", "x'' = -x + x^3 + 0.1 cos(t); x(0) = 0; x'(0) = 0; when x = 0 as hit: record", "hit", 38, 12, zero_time,
     false},
    {"section",
     "x'' = -x - 2 x y; y'' = -y - x^2 + y^2; x(0) = 0; y(0) = 0.1; x'(0) = 0.49; y'(0) = 0; "
     "when x = 0 rising as hit: record",
     "hit", 65, 10, section_time, false},
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
        const double off = (double)fabsl(row.time - m->time(k++)), ulp = nextafter(row.time, 1e300) - row.time;
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
    tally all = {0, 0, 0};
    bool low = false;
    for (size_t j = 0; j < sizeof motions / sizeof *motions; j++) {
        tally one = {0, 0, 0};
        for (size_t k = 0; k < sizeof by / sizeof *by; k++) {
            if (motions[j].velocity && !by[k].velocity) continue;
            double size = by[k].from;
            for (int i = 0; i < by[k].sizes; i++, size *= by[k].factor) take(&motions[j], &by[k], size, &one);
        }
        printf("%-12s %5d event times: %.2f %% within their bar, %.2f %% tight\n", motions[j].name, one.numbers,
               100.0 * one.covered / one.numbers, 100.0 * one.tight / one.numbers);
        low |= one.covered < 0.97 * one.numbers;
        all.numbers += one.numbers, all.covered += one.covered, all.tight += one.tight;
    }
    printf("%-12s %5d event times: %.2f %% within their bar, %.2f %% tight\n", "all", all.numbers,
           100.0 * all.covered / all.numbers, 100.0 * all.tight / all.numbers);
    assert_false(low);
    assert_true(all.covered >= 0.99 * all.numbers);
    assert_true(all.tight >= 0.85 * all.numbers);
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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bars_of_event_times),
                                       cmocka_unit_test(a_stadium_loses_all_digits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
