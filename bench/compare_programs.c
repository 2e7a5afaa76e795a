/* Whole programs, from start to exit: the founding examples against NumPy and numba, the first answer, and the memory
 * of a long sweep. */
#include "bench/bench.h"

#include <glob.h>
#include <math.h>
#include <string.h>

enum { ROUNDS = 7 };
static const char *const founding[] = {"models/projectile.motus", "models/spring.motus",
                                       "models/driven-oscillator.motus", "models/damped-cubic.motus"};
enum { FOUNDING = sizeof founding / sizeof *founding };

/* A program and what to make of it: the whole of it, or what it says about its loop. */
typedef struct program {
    const char *words[12];
    bool loop;
    double answer;
} program;

static double by_program(void *p)
{
    program *q = p;
    if (!q->words[0]) return NAN;
    process run = process_run(q->words);
    double loop = NAN;
    int read = sscanf(run.out, "%lf %lf", &q->answer, &loop);
    if (run.status != 0) return NAN;
    return !q->loop ? run.seconds : read == 2 ? loop : NAN;
}

static double by_our_loop(void *p)
{
    (void)p;
    ours *o = ours_open("models/damped-cubic.motus", NULL, "verlet", 0.001, 3000, "compiled", 1);
    double took = o ? ours_step(o, 3000) : NAN;
    ours_close(o);
    return took;
}

static void compare_notebook(void)
{
    const char *python = process_python(), *motus = process_motus();
    report_section("The founding examples, warm cache", "all of it");
    if (!python) report_note("no Python with NumPy");
    program ours = {.words = {motus, "run", "models/driven-oscillator.motus", "--json"}};
    program numpy = {.words = {python, "bench/peers/notebook.py", "driven"}},
            numba = {.words = {python, "bench/peers/numba_loops.py", "driven"}};
    side whole[] = {SIDE(by_program, &ours), SIDE(by_program, &numpy), SIDE_ROUNDS(by_program, &numba, 3)};
    measure(whole, 3, ROUNDS);
    report_at_least("driven oscillator, 1e5 steps: NumPy, whole program", &whole[0], &whole[1], 100, "ms");
    report_beside("driven oscillator, 1e5 steps: numba, whole program", &whole[0], &whole[2], "ms");
    if (whole[1].taken && fabs(numpy.answer - 0.0477823980718726) > 1e-11)
        report_note("NumPy's x(100) is %.15g", numpy.answer);

    numpy.words[2] = numba.words[2] = "damped";
    numpy.loop = numba.loop = true;
    side loops[] = {SIDE(by_our_loop, NULL), SIDE(by_program, &numpy), SIDE_ROUNDS(by_program, &numba, 3)};
    measure(loops, 3, ROUNDS);
    report_at_least("damped cubic, 3000 steps: NumPy, the loop alone", &loops[0], &loops[1], 50, "ms");
    report_beside("damped cubic, 3000 steps: numba, the loop alone", &loops[0], &loops[2], "ms");
    if (loops[1].taken && fabs(numpy.answer + 3.48944217720609) > 1e-10)
        report_note("NumPy's x(3) is %.15g", numpy.answer);
}

/* The median of some starts, each with the cache emptied before it or with what the one before left there. */
static double started(const char *model, const char *machine, bool cold, int rounds)
{
    const char *words[] = {process_motus(), "run", model, "--machine", machine, NULL};
    side s = {.taken = 0};
    if (!cold) process_run(words);
    for (int k = 0; k < rounds; k++) {
        if (cold) process_forget();
        process run = process_run(words);
        if (run.status != 0) return NAN;
        s.sample[s.taken++] = run.seconds;
    }
    return median(&s);
}

static double slowest(const char *const *models, size_t count, const char *machine, bool cold, int rounds,
                      const char **which)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) {
        double took = started(models[k], machine, cold, rounds);
        if (!(took <= most)) most = took, *which = models[k];
        if (isnan(took)) break;
    }
    return most;
}

static void compare_starts(void)
{
    const char *which[4] = {"", "", "", ""};
    report_section("The first answer, from start to exit, the slowest model", "all of it");
    report_value("founding models, empty cache", slowest(founding, FOUNDING, "auto", true, 5, &which[0]), 0.030, "ms");
    report_value("founding models, compiled the first time",
                 slowest(founding, FOUNDING, "compiled", true, 5, &which[1]), 0.150, "ms");
    report_value("founding models, compiled, from the cache",
                 slowest(founding, FOUNDING, "compiled", false, 9, &which[2]), 0.015, "ms");
    glob_t all;
    if (glob("models/*.motus", 0, NULL, &all) == 0) {
        report_value("any model, compiled the first time",
                     slowest((const char *const *)all.gl_pathv, all.gl_pathc, "compiled", true, 2, &which[3]), 0.300,
                     "ms");
        report_note("the slowest were %s, %s, %s, %s", which[0] + 7, which[1] + 7, which[2] + 7, which[3] + 7);
        globfree(&all);
    }
}

static void compare_sweep(void)
{
    report_section("A sweep of 1e7 trajectories, the final state recorded", "at most in memory");
    const char *words[] = {process_motus(),
                           "sweep",
                           "models/driven-oscillator.motus",
                           "--vary",
                           "F=0:0.1:10000000",
                           "--record",
                           "final",
                           "--until",
                           "0.004",
                           "-o",
                           "-",
                           NULL};
    const char *warm[] = {process_motus(),
                          "sweep",
                          "models/driven-oscillator.motus",
                          "--vary",
                          "F=0:0.1:10",
                          "--record",
                          "final",
                          "--until",
                          "0.004",
                          "--machine",
                          "compiled",
                          "-o",
                          "-",
                          NULL};
    process_run(warm); /* else the compiler's memory would be counted */
    process run = process_run(words);
    report_value("memory", run.status == 0 ? (double)run.kilobytes / 1024 : NAN, 200, "MB");
    if (run.status == 0) report_note("in %.1f s", run.seconds);
}

void compare_programs(void)
{
    compare_notebook();
    compare_starts();
    compare_sweep();
}
