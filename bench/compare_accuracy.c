/* Accuracy against time: problems whose exact motion is known, by every adaptive method of motus and by what one would
 * take instead, tolerance by tolerance.
 *
 * Times are the processor's, of one thread, with the objects that long runs get. A time "at 1e-9" lies between those of
 * two tolerances, on the line through the logarithms of time and true error; so libraries are compared at equal errors,
 * whatever they mean by a tolerance.
 */
#include "bench/bench.h"
#include "bench/peers/peers.h"
#include "bench/problems.h"
#include "motus.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TOLERANCES = 14, CODES_MAX = 32, TARGETS = 2, ROUNDS = 9 };
static const double targets[TARGETS] = {1e-6, 1e-9}, ODEINT_TOLERANCE = 1e-14;
static const double tolerances[TOLERANCES] = {1e-3,  1e-4,  1e-5,  1e-6,  1e-7,  1e-8,  1e-9,
                                              1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 5e-15, 1e-15};
/* Of 1e-3 the other libraries make no motion at all, and of less than 1e-14 no better one. */
enum { OTHERS_FROM = 2, OTHERS_TO = 12 };
/* A run that takes longer is the last of its code; a time is the least of so many runs, or of as many as take so
 * long. */
static const double SLOW = 0.4, ENOUGH = 0.1;
enum { REPEATS = 5 };

typedef struct point {
    double tolerance, seconds, error;
} point;

typedef struct code code;
struct code {
    const char *name;
    bool ours;
    double (*run)(const code *, int which, double tolerance, double *state); /* NaN: it cannot */
    int count;
    point points[TOLERANCES];
};

typedef struct work {
    const char *title, *file;
    double limit, error; /* against odeint: the part of its time, with at most this error */
} work;
static const work works[PROBLEMS] = {
    [PROBLEM_kepler] = {"Kepler, e = 0.6, 1000 periods", "models/kepler.motus", 0.45, 2.5e-10},
    [PROBLEM_arenstorf] = {"Arenstorf's orbit, one period", "models/arenstorf.motus", 0.5, 2e-13},
    [PROBLEM_henon] = {"Henon-Heiles, a regular orbit, t = 1000", "models/henon-heiles.motus", 0.25, 1e-13},
    [PROBLEM_pleiades] = {"Pleiades, t = 3", "bench/pleiades.motus", 0.7, 2e-12},
    [PROBLEM_solar] = {"The outer solar system, 10 000 years", "models/outer-solar-system.motus", 0.6, 4e-10}};

/* ---- the codes ---- */

static double by_ours(const code *c, int which, double tolerance, double *state)
{
    return ours_adaptive(works[which].file, &problems[which], c->name, tolerance, state).seconds;
}

#define TIMED(call)                                   \
    do {                                              \
        const double start = thread_seconds();        \
        const int good = (call);                      \
        const double took = thread_seconds() - start; \
        return good ? took : NAN;                     \
    } while (0)

static double by_odeint(const code *c, int which, double tolerance, double *state)
{
    (void)c;
    TIMED(peer_odeint_adaptive(which, tolerance, state));
}

static double by_gsl(const code *c, int which, double tolerance, double *state)
{
    TIMED(peer_gsl_adaptive(strchr(c->name, ' ') + 1, which, tolerance, state));
}

static double by_sundials(const code *c, int which, double tolerance, double *state)
{
    TIMED(peer_sundials_adaptive(strchr(c->name, ' ') + 1, which, tolerance, state));
}

static double by_scipy(const code *c, int which, double tolerance, double *state)
{
    const problem *p = &problems[which];
    char text[3 + 2 * POSITIONS_MAX][32];
    const char *words[8 + 2 * POSITIONS_MAX] = {process_python(), "bench/peers/adaptive_scipy.py", p->name};
    int count = 3;
    (void)c;
    if (!words[0] || (tolerance != 1e-6 && tolerance != 1e-9 && tolerance != 1e-12)) return NAN;
    snprintf(text[0], sizeof text[0], "%.17g", p->until);
    snprintf(text[1], sizeof text[1], "%.17g", tolerance);
    words[count++] = text[0], words[count++] = text[1];
    for (int k = 0; k < 2 * p->positions; k++) {
        snprintf(text[2 + k], sizeof text[2 + k], "%.17g", p->start[k]);
        words[count++] = text[2 + k];
    }
    process run = process_run(words);
    if (run.status != 0) return NAN;
    char *rest = run.out;
    const double took = strtod(rest, &rest);
    for (int k = 0; k < 2 * p->positions; k++) state[k] = strtod(rest, &rest);
    return took;
}

/* All of them; those of motus that cannot integrate the model are left out. */
static int all_codes(code *codes, const motus_system *system)
{
    static const code peers[] = {
        {.name = "odeint rkf78", .run = by_odeint},     {.name = "GSL rk8pd", .run = by_gsl},
        {.name = "GSL msadams", .run = by_gsl},         {.name = "SUNDIALS erk", .run = by_sundials},
        {.name = "SUNDIALS adams", .run = by_sundials}, {.name = "SciPy DOP853", .run = by_scipy}};
    enum { PEERS = sizeof peers / sizeof *peers };
    int count = 0;
    for (size_t k = 0; k < motus_method_count() && count < CODES_MAX - PEERS; k++) {
        const motus_method *m = motus_method_at(k);
        if (!m->adaptive || motus_method_admits(system, m->name, NULL)) continue;
        codes[count++] = (code){.name = m->name, .ours = true, .run = by_ours};
    }
    for (int k = 0; k < PEERS; k++) codes[count++] = peers[k];
    return count;
}

/* ---- a code, tolerance by tolerance ---- */

static void sweep(code *c, int which)
{
    for (int k = c->ours ? 0 : OTHERS_FROM; k < (c->ours ? TOLERANCES : OTHERS_TO); k++) {
        const double tolerance = tolerances[k];
        double state[2 * POSITIONS_MAX], least = INFINITY, all = 0;
        for (int repeat = 0; repeat < REPEATS && (all < ENOUGH || repeat < 2) && all < SLOW; repeat++) {
            const double took = c->run(c, which, tolerance, state);
            if (isnan(took)) break;
            all += took;
            least = fmin(least, took);
        }
        if (isinf(least)) continue;
        const double error = problem_error(&problems[which], state);
        if (!isnan(error)) c->points[c->count++] = (point){tolerance, least, error};
        if (least > SLOW && c->run != by_scipy) break;
    }
}

/* The least time with this error; NaN: the code never comes so near. */
static double time_at(const code *c, double error)
{
    double least = INFINITY;
    for (int k = 0; k < c->count; k++) {
        const point *to = &c->points[k], *from = to - 1;
        if (to->error > error) continue;
        double took = to->seconds;
        if (k > 0 && from->error > error && to->error > 0)
            took = exp(log(from->seconds) +
                       log(to->seconds / from->seconds) * log(error / from->error) / log(to->error / from->error));
        least = fmin(least, took);
    }
    return isinf(least) ? NAN : least;
}

static const point *best(const code *c)
{
    const point *p = NULL;
    for (int k = 0; k < c->count; k++)
        if (!p || c->points[k].error < p->error) p = &c->points[k];
    return p;
}

static const char *milliseconds(double seconds, char out[16])
{
    if (isnan(seconds))
        snprintf(out, 16, "-");
    else
        snprintf(out, 16, "%.*f", seconds < 1e-3 ? 3 : seconds < 1e-2 ? 2 : seconds < 0.1 ? 1 : 0, 1e3 * seconds);
    return out;
}

static void print_table(const code *codes, int count)
{
    report_text("%-20s  %10s  %10s  %24s\n", "milliseconds", "at 1e-6", "at 1e-9", "at its smallest error");
    for (int k = 0; k < count; k++) {
        char a[16], b[16], c[16];
        const point *p = best(&codes[k]);
        if (!p)
            report_text("  %-18s  %10s  %10s  %24s\n", codes[k].name, "-", "-", "not measured");
        else
            report_text("  %-18s  %10s  %10s  %12s, %.1e, tolerance %.0e\n", codes[k].name,
                        milliseconds(time_at(&codes[k], targets[0]), a),
                        milliseconds(time_at(&codes[k], targets[1]), b), milliseconds(p->seconds, c), p->error,
                        p->tolerance);
    }
}

/* ---- against each other ---- */

static const code *fastest(const code *codes, int count, double error)
{
    const code *found = NULL;
    double least = INFINITY;
    for (int k = 0; k < count; k++)
        if (codes[k].ours && time_at(&codes[k], error) < least) found = &codes[k], least = time_at(found, error);
    return found;
}

static void at_equal_errors(const code *codes, int count)
{
    for (int t = 0; t < TARGETS; t++) {
        const code *ours = fastest(codes, count, targets[t]);
        for (int k = 0; k < count; k++) {
            char name[80];
            const code *c = &codes[k];
            if (c->ours) continue;
            if (c->count && isnan(time_at(c, targets[t]))) {
                report_note("%s never comes as near as %.0e", c->name, targets[t]);
                continue;
            }
            snprintf(name, sizeof name, "at %.0e: %s, ours %s", targets[t], c->name, ours ? ours->name : "none");
            report_times(name, ours ? time_at(ours, targets[t]) : NAN, time_at(c, targets[t]),
                         c->run == by_scipy ? 200 : 2.5, "ms");
        }
    }
}

typedef struct duel {
    const code *code;
    int which;
    double tolerance, error;
} duel;

static double by_duel(void *p)
{
    duel *d = p;
    double state[2 * POSITIONS_MAX];
    const double took = d->code->run(d->code, d->which, d->tolerance, state);
    d->error = problem_error(&problems[d->which], state);
    return took;
}

/* The fastest of ours whose error is within the limit, and where none is, the one with the smallest error. */
static void against_odeint(const code *codes, int count, int which)
{
    const code odeint = {.name = "odeint rkf78", .run = by_odeint};
    const work *w = &works[which];
    duel ours = {.which = which}, other = {.code = &odeint, .which = which, .tolerance = ODEINT_TOLERANCE};
    double least = INFINITY, nearest = INFINITY;
    for (int k = 0; k < count; k++)
        for (int t = 0; codes[k].ours && t < codes[k].count; t++) {
            const point *p = &codes[k].points[t];
            const bool within = p->error <= w->error;
            if (within ? p->seconds >= least : !isinf(least) || p->error >= nearest) continue;
            if (within) least = p->seconds;
            nearest = fmin(nearest, p->error);
            ours.code = &codes[k], ours.tolerance = p->tolerance;
        }
    if (!ours.code) return;
    side sides[] = {SIDE(by_duel, &ours), SIDE(by_duel, &other)};
    char name[80];
    measure(sides, 2, ROUNDS);
    snprintf(name, sizeof name, "odeint, tolerance 1e-14; ours %s, tolerance %.0e", ours.code->name, ours.tolerance);
    report_at_most(name, &sides[0], &sides[1], w->limit, "ms");
    report_error("its error", ours.error, other.error, w->error);
}

static void compare(int which)
{
    const work *w = &works[which];
    motus_error error = motus_default_error();
    motus_text_def text = motus_default_text();
    motus_system *system = NULL;
    char *words = read_text(w->file), title[128];
    code codes[CODES_MAX];
    double state[2 * POSITIONS_MAX];
    snprintf(title, sizeof title, "Accuracy: %s", w->title);
    report_text("\n%s\n", title);
    text.text = words;
    if (!words || motus_system_from_text(&text, &system, &error)) {
        report_note("%s: %s", w->file, words ? error.message : "cannot be read");
        free(words);
        return;
    }
    const int count = all_codes(codes, system);
    const double compiled = ours_adaptive(w->file, &problems[which], "taylor", 1e-14, state).created;
    for (int k = 0; k < count; k++) {
        if (codes[k].ours) ours_prepare(w->file, &problems[which], codes[k].name, 1e-9);
        sweep(&codes[k], which);
    }
    print_table(codes, count);
    report_section(title, "all of it, without reading and compiling the model");
    against_odeint(codes, count, which);
    at_equal_errors(codes, count);
    report_note("to read and compile it the first time, by taylor: %.0f ms", 1e3 * compiled);
    motus_system_destroy(system);
    free(words);
}

void compare_accuracy(void)
{
    for (int which = 0; which < PROBLEMS; which++) compare(which);
    compare_driven_pendulums();
}
