/* One trajectory, ten million steps: against the loop one would write, and against the time that the recursion needs
 * by itself. Then every model of models/ against the plain loop of a physicist. */
#include "bench/bench.h"
#include "bench/hand/hand.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 10000000, ROUNDS = 5 };
static const double STEP = 0.001;
static double ours_x, plain_x;
static latencies last;

static double by_ours(void *p)
{
    (void)p;
    ours *o = ours_open("models/driven-oscillator.motus", NULL, "verlet", STEP, STEPS, "compiled", 1);
    double took = o ? ours_step(o, STEPS) : NAN;
    if (o) ours_state(o, &ours_x, NULL);
    ours_close(o);
    return took / STEPS;
}

static double by_plain_loop(void *p)
{
    (void)p;
    double start = now();
    plain_x = hand_plain_loop(0.1, STEP, STEPS);
    return (now() - start) / STEPS;
}

static double by_bound(void *p)
{
    (void)p;
    last = hand_latencies();
    return (last.multiply + 3 * last.fused + last.add) * 1e-9;
}

/* ---- every model ---- */

enum { EACH_STEPS = 20000, EACH_ROUNDS = 31 };
typedef struct each_job {
    const hand_single *hand;
    volatile double kept;
} each_job;

static double by_hand(void *p)
{
    each_job *j = p;
    double start = now();
    j->kept = j->hand->run(j->hand->step, EACH_STEPS);
    return (now() - start) / EACH_STEPS;
}

static double by_motus(void *p)
{
    const each_job *j = p;
    char file[128];
    snprintf(file, sizeof file, "models/%s.motus", j->hand->model);
    ours *o = ours_open(file, NULL, j->hand->method, j->hand->step, EACH_STEPS, "compiled", 1);
    double took = o ? ours_step(o, EACH_STEPS) : NAN;
    ours_close(o);
    return took / EACH_STEPS;
}

static void compare_each(void)
{
    report_section("One trajectory of every model, against the plain loop in C, -O2", "per step");
    for (const hand_single *h = hand_singles; h->model; h++) {
        each_job job = {.hand = h};
        side sides[] = {SIDE(by_motus, &job), SIDE(by_hand, &job)};
        char name[128];
        measure(sides, 2, EACH_ROUNDS);
        snprintf(name, sizeof name, "%s, %s", h->model, h->method);
        report_at_most(name, &sides[0], &sides[1], 1.05, "ns");
    }
}

void compare_single(void)
{
    report_section("One driven oscillator, 1e7 steps of verlet", "per step");
    side sides[] = {SIDE(by_ours, NULL), SIDE(by_plain_loop, NULL), SIDE(by_bound, NULL)};
    measure(sides, 3, ROUNDS);
    report_at_least("a plain loop in C, -O3", &sides[0], &sides[1], 1.5, "ns");
    report_at_most("the recursion's own latency", &sides[0], &sides[2], 1.5, "ns");
    report_note("from x to the next x lie a product (%.2f ns), three fused operations (%.2f each) and a sum (%.2f);",
                last.multiply, last.fused, last.add);
    report_note("the recursion alone, its drive held constant, takes %.2f ns. The two answers differ by %.0e.",
                last.chain, fabs(ours_x - plain_x));
    compare_each();
}
