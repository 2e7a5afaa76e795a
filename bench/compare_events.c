/* What events cost: a run with the points of a section against the same run without, switches of the force that are
 * located against switches that are not, a billiard against a loop by hand; and compare_sections.c. */
#include "bench/bench.h"
#include "bench/hand/hand.h"

#include <math.h>
#include <stdlib.h>

enum { ROUNDS = 15, HITS = 1000, REPEATS = 20 };
static const char *const methods[] = {"taylor", "dop853"};
enum { METHODS = sizeof methods / sizeof *methods };

/* Of the whole run; the least of a few. */
static double by_run(void *p)
{
    double least = INFINITY;
    for (int k = 0; k < REPEATS; k++) {
        const double took = ours_watched(p);
        if (isnan(took)) return NAN;
        least = fmin(least, took);
    }
    return least;
}

/* ---- a section ---- */

static void compare_section(const char *method, const char *machine)
{
    static const double x[] = {0, 0.1}, v[] = {0.49, 0};
    const watched plain = {.file = "models/henon-heiles.motus",
                           .method = method,
                           .machine = machine,
                           .tolerance = NAN,
                           .step = NAN,
                           .until = 2000,
                           .x = x,
                           .v = v};
    watched with = plain, without = plain;
    with.when = "x = 0 rising: record";
    side sides[] = {SIDE(by_run, &with), SIDE(by_run, &without)};
    char name[80];
    measure(sides, 2, ROUNDS);
    snprintf(name, sizeof name, "%s, %s: without the section", method, machine);
    report_at_most(name, &sides[0], &sides[1], 1.6, "ms");
    report_note("%lld steps, %lld points: one true step to each point would make it %.2f times", (long long)with.steps,
                (long long)with.events, 1 + (double)with.events / (double)with.steps);
}

/* ---- switches ---- */

static double by_step(void *p)
{
    watched *w = p;
    const double took = by_run(w);
    return took / (double)w->steps;
}

static void compare_kink(const char *method)
{
    watched located = {.file = "bench/kink.motus",
                       .method = method,
                       .machine = "compiled",
                       .tolerance = NAN,
                       .step = NAN,
                       .until = NAN};
    watched across = located;
    across.across = 1;
    side sides[] = {SIDE(by_step, &located), SIDE(by_step, &across)};
    char name[80];
    measure(sides, 2, ROUNDS);
    snprintf(name, sizeof name, "%s: not located", method);
    report_beside(name, &sides[0], &sides[1], "ns");
    if (located.steps != across.steps)
        report_note("%lld steps, and %lld", (long long)located.steps, (long long)across.steps);
}

/* ---- a billiard ---- */

typedef struct table {
    double step, hits[HITS][3];
    int64_t found;
} table;

static double by_hand(void *p)
{
    table *t = p;
    double least = INFINITY;
    for (int k = 0; k < REPEATS; k++) {
        const double start = thread_seconds();
        t->found = hand_billiard(t->step, 1832, HITS, t->hits);
        least = fmin(least, thread_seconds() - start);
    }
    return least / HITS;
}

static double by_ours(void *p) { return by_run(p) / HITS; }

/* From hit 1000. */
static double off(const double *hit)
{
    static const double truth[] = {1831.81376284334483463390127, -0.167606338366116508261994,
                                   -0.985854003054966989062709};
    double most = 0;
    for (int k = 0; k < 3; k++) most = fmax(most, fabs(hit[k] - truth[k]));
    return most;
}

static void compare_billiard(void)
{
    table hand = {.step = 0.25};
    watched ours = {.file = "models/billiard.motus",
                    .method = "verlet",
                    .machine = "compiled",
                    .tolerance = NAN,
                    .step = hand.step,
                    .until = 1832,
                    .columns = {"r.x", "r.y"}};
    side sides[] = {SIDE(by_ours, &ours), SIDE(by_hand, &hand)};
    measure(sides, 2, ROUNDS);
    report_beside("verlet, steps of 0.25: by hand", &sides[0], &sides[1], "ns");
    report_error("hit 1000 is off", ours.events == HITS ? off(ours.last) : INFINITY,
                 hand.found == HITS ? off(hand.hits[HITS - 1]) : INFINITY, 1e-11);
    report_note("hits per second: ours %.3g, by hand %.3g; the loop by hand asks after one change of sign a step",
                1 / median(&sides[0]), 1 / median(&sides[1]));
}

void compare_events(void)
{
    report_section("Events: the section of a star's motion, t = 2000, all points", "the whole run");
    for (int k = 0; k < METHODS; k++) {
        compare_section(methods[k], "auto");
        compare_section(methods[k], "compiled");
    }
    report_section("Events: a switch of the force that is never met", "per step");
    for (int k = 0; k < METHODS; k++) compare_kink(methods[k]);
    report_section("Events: a thousand hits of a billiard", "per hit");
    compare_billiard();
    compare_sections();
}
