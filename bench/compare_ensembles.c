/* Many small systems at once: driven oscillators by three methods and pendulums, on one core and on two. */
#include "bench/bench.h"
#include "bench/hand/hand.h"
#include "bench/peers/peers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT = 65536, STEPS = 1000, ROUNDS = 9, CHECKED = 9, FEW = 64 };
static const char *const oscillator_file = "models/driven-oscillator.motus", *const pendulum_file =
                                                                                 "models/pendulum.motus";
static const double STEP = 0.001, PENDULUM_STEP = 0.01;

/* Everything a side needs; each side has its own results, so that they can be compared afterwards. */
typedef struct job {
    const char *file, *method, *varied;
    hand_kind kind;
    size_t count;
    int threads, order4, block;
    double step;
    const double *values;
    oscillators hand;
    double *x, *v;
} job;

static double per_step(double seconds, const job *j) { return seconds / (double)j->count / STEPS; }

static double by_ours(void *p)
{
    job *j = p;
    return per_step(
        ours_ensemble(j->file, j->method, STEPS, j->step, j->varied, j->values, j->count, j->x, j->v, j->threads), j);
}

static double by_hand(void *p)
{
    job *j = p;
    double start = now();
    hand_oscillators(j->kind, &j->hand);
    return per_step(now() - start, j);
}

static double by_pendulum_hand(void *p)
{
    job *j = p;
    double start = now();
    return hand_pendulums(j->count, j->values, j->step, STEPS, j->x, j->v) ? per_step(now() - start, j) : NAN;
}

static double by_odeint(void *p)
{
    job *j = p;
    double start = now();
    return peer_odeint(j->order4, j->block, j->count, j->values, j->step, STEPS, j->x) ? per_step(now() - start, j)
                                                                                       : NAN;
}

static double by_gsl(void *p)
{
    job *j = p;
    double start = now();
    return peer_gsl(j->count, j->values, j->step, STEPS, j->x) ? per_step(now() - start, j) : NAN;
}

static double by_sundials(void *p)
{
    job *j = p;
    double start = now();
    return peer_sundials(j->count, j->values, j->step, STEPS, j->x) ? per_step(now() - start, j) : NAN;
}

static double by_scipy(void *p)
{
    job *j = p;
    const char *python = process_python(),
               *words[] = {python, "bench/peers/scipy_ensemble.py", "0.05", "0.1", "0.15", "0.1", "0.05", NULL};
    process run = python ? process_run(words) : (process){.status = -1};
    double took;
    return run.status == 0 && sscanf(run.out, "%lf %lf", &j->x[0], &took) == 2 ? took / STEPS : NAN;
}

static double *numbers(size_t count)
{
    double *p = NULL;
    if (posix_memalign((void **)&p, 64, count * sizeof *p)) abort();
    memset(p, 0, count * sizeof *p);
    return p;
}

static job job_with(job j, size_t count)
{
    j.count = count;
    j.x = numbers(COUNT);
    j.v = numbers(COUNT);
    j.hand.count = count;
    j.hand.x = j.x;
    j.hand.v = j.v;
    return j;
}

static void job_free(job *j) { free(j->x), free(j->v); }

/* The hand-written results against single runs of motus, which are the reference for every machine. */
static bool same_bits(const job *j, const double *x, const double *v)
{
    bool same = true;
    for (int c = 0; c < CHECKED && same; c++) {
        size_t k = (size_t)c * (j->count - 1) / (CHECKED - 1);
        char set[64];
        snprintf(set, sizeof set, "%s=%.17g", j->varied, j->values[k]);
        const char *const sets[] = {set, NULL};
        ours *o = ours_open(j->file, sets, j->method, j->step, STEPS, "interpreter", 1);
        double xs, vs;
        same = o && !isnan(ours_step(o, STEPS)) && ours_state(o, &xs, &vs) && !memcmp(&xs, &x[k], 8) &&
               !memcmp(&vs, &v[k], 8);
        ours_close(o);
    }
    return same;
}

static double distance(const double *x, const double *y, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) most = fmax(most, fabs(x[k] - y[k]));
    return most;
}

/* The block of odeint that is fastest here. */
static int odeint_block(job *j)
{
    int best = 0;
    double least = INFINITY;
    for (int try = 0; try < 3; try++)
        for (j->block = 64; j->block <= 256; j->block *= 2) {
            double took = by_odeint(j);
            if (took < least) least = took, best = j->block;
        }
    return best;
}

static void compare(job all, hand_kind kind, hand_kind free_kind)
{
    char name[80];
    const char *method = all.method;
    job ours = job_with(all, COUNT), hand = job_with(all, COUNT), loose = job_with(all, COUNT),
        other = job_with(all, COUNT / 8);
    job few = job_with(all, FEW), fewer = job_with(all, FEW), python = job_with(all, 1),
        position = job_with(all, COUNT), first = job_with(all, COUNT);
    hand.kind = kind, loose.kind = free_kind, position.kind = HAND_FREE_POSITION, first.kind = HAND_FIRST_RK4;
    other.order4 = kind == HAND_RK4;
    oscillators trial = hand.hand;
    trial.count = COUNT / 8;
    hand_oscillators_choose(kind, &trial);
    hand_oscillators_choose(free_kind, &trial);
    hand_oscillators_choose(HAND_FREE_POSITION, &trial);
    hand_oscillators_choose(HAND_FIRST_RK4, &trial);
    other.block = odeint_block(&other);
    side sides[] = {SIDE(by_ours, &ours),
                    SIDE(by_hand, &hand),
                    SIDE(by_hand, &loose),
                    SIDE(by_odeint, &other),
                    SIDE(by_gsl, &few),
                    SIDE(by_sundials, &fewer),
                    SIDE_ROUNDS(by_scipy, &python, 1),
                    SIDE(by_hand, &position)};
    measure(sides, kind == HAND_RK4 ? 7 : 4, ROUNDS);
    if (kind == HAND_VERLET) measure(&sides[7], 1, ROUNDS);

#define NAMED(...) (snprintf(name, sizeof name, __VA_ARGS__), name)
    report_bits(NAMED("%s: the hand-written bits are ours", method), true, same_bits(&hand, hand.x, hand.v));
    report_bits(NAMED("%s: so are the ensemble's, all of them", method), sides[0].taken > 0,
                !memcmp(ours.x, hand.x, COUNT * 8) && !memcmp(ours.v, hand.v, COUNT * 8));
    report_at_most(NAMED("%s: by hand, our bits", method), &sides[0], &sides[1], 1.15, "ns");
    report_at_most(NAMED("%s: by hand, the best that can be", method), &sides[0], &sides[2], 1.5, "ns");
    if (kind == HAND_VERLET)
        report_beside(NAMED("%s: by hand, in positions alone (more round-off)", method),
                      sides[0].taken ? &sides[0] : NULL, &sides[7], "ns");
    report_at_least(NAMED("%s: odeint, blocks of %d", method, other.block), &sides[0], &sides[3], 2.5, "ns");
    if (kind == HAND_RK4) {
        side forms[] = {SIDE(by_ours, &ours), SIDE(by_hand, &first)};
        measure(forms, 2, ROUNDS);
        report_at_most(NAMED("%s: by hand, as a system of first order", method), &forms[0], &forms[1], 0.6, "ns");
        report_at_least(NAMED("%s: GSL, one by one", method), &sides[0], &sides[4], 40, "ns");
        report_at_least(NAMED("%s: SUNDIALS, one by one", method), &sides[0], &sides[5], 40, "ns");
        report_at_least(NAMED("%s: SciPy, one by one", method), &sides[0], &sides[6], 40, "ns");
    }
    report_note("by hand: %s; the best: %s, off by %.0e", hand_oscillators_chosen(kind),
                hand_oscillators_chosen(free_kind), distance(hand.x, loose.x, COUNT));
    if (sides[3].taken && distance(hand.x, other.x, other.count) > 1e-12)
        report_note("odeint's answer differs by %.0e", distance(hand.x, other.x, other.count));
    if (sides[4].taken && distance(hand.x, few.x, FEW) > 1e-12)
        report_note("GSL's answer differs by %.0e", distance(hand.x, few.x, FEW));
    if (sides[5].taken && distance(hand.x, fewer.x, FEW) > 1e-12)
        report_note("SUNDIALS' answer differs by %.0e", distance(hand.x, fewer.x, FEW));
    job_free(&ours), job_free(&hand), job_free(&loose), job_free(&other), job_free(&few), job_free(&fewer),
        job_free(&python), job_free(&position), job_free(&first);
}

static void compare_pendulums(job all)
{
    job ours = job_with(all, COUNT), hand = job_with(all, COUNT / 4);
    side sides[] = {SIDE(by_ours, &ours), SIDE(by_pendulum_hand, &hand)};
    measure(sides, 2, ROUNDS);
    report_at_most("velocity-verlet: by hand, libmvec's sine", &sides[0], &sides[1], 1, "ns");
    job_free(&ours), job_free(&hand);
}

static void compare_threads(job all, const char *name)
{
    job one = job_with(all, COUNT), two = job_with(all, COUNT);
    two.threads = 2;
    side sides[] = {SIDE(by_ours, &one), SIDE(by_ours, &two)};
    measure(sides, 2, ROUNDS);
    report_at_least(name, &sides[1], &sides[0], 1.9, "ns");
    job_free(&one), job_free(&two);
}

void compare_ensembles(void)
{
    double *F = numbers(COUNT), *theta = numbers(COUNT), *whole = numbers(STEPS + 1), *half = numbers(STEPS + 1);
    for (size_t k = 0; k < COUNT; k++) {
        F[k] = 0.05 + 0.1 * (double)k / COUNT;
        theta[k] = 0.1 + 2.9 * (double)k / COUNT;
    }
    hand_cosines(STEP, STEPS, whole, half);
    job j = {.file = oscillator_file,
             .varied = "F",
             .threads = 1,
             .step = STEP,
             .values = F,
             .hand = {.F = F, .step = STEP, .steps = STEPS, .whole = whole, .half = half}};
    job verlet = j, leapfrog = j, rk4 = j, pendulum = j;
    verlet.method = "verlet", leapfrog.method = "velocity-verlet", rk4.method = "rk4";
    pendulum.method = "velocity-verlet", pendulum.file = pendulum_file, pendulum.varied = "theta(0)",
    pendulum.values = theta;
    pendulum.step = PENDULUM_STEP;

    report_section("An ensemble of 65536 driven oscillators, 1000 steps, one core", "per trajectory and step");
    compare(verlet, HAND_VERLET, HAND_FREE_LEAPFROG);
    compare(leapfrog, HAND_VELOCITY_VERLET, HAND_FREE_LEAPFROG);
    compare(rk4, HAND_RK4, HAND_FREE_RK4);
    report_section("An ensemble of 65536 pendulums, 1000 steps, one core", "per trajectory and step");
    compare_pendulums(pendulum);
    report_section("Two threads against one", "per trajectory and step");
    if (machine_cores() < 2) report_note("there is one core");
    compare_threads(verlet, "oscillators, verlet: one thread");
    compare_threads(leapfrog, "oscillators, velocity-verlet: one thread");
    compare_threads(rk4, "oscillators, rk4: one thread");
    compare_threads(pendulum, "pendulums, velocity-verlet: one thread");
    free(F), free(theta), free(whole), free(half);
}
