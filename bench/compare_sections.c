/* Poincare sections of ten thousand motions of Henon and Heiles' star, with all their points: an ensemble against a
 * loop over CVODE with its root finding, at equal errors.
 *
 * All motions have the energy 1/12, below which nearly all are regular, so that errors of section points grow with time
 * and not exponentially. The truth is extrapolation in long double, led to the section by Newton's method; it shares
 * nothing with either side.
 */
#define NUMBER long double
#define ABSOLUTE fabsl
#define POWER powl
#define ROOT sqrtl
#define FORCE(name) extended_##name
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/bench.h"
#include "bench/forces.h"
#include "bench/peers/peers.h"
#include "motus.h"

enum { COUNT = 10000, SAMPLE = 100, FEW = 20, ROUNDS = 5, MOST = 4, COLUMNS = 10, TARGETS = 2 };
#include "bench/extrapolation.h"

static const double UNTIL = 1000, LIMIT = 20, targets[TARGETS] = {1e-6, 1e-8};
/* Of the truth: short beside the time between two passages, so that none is missed. */
static const NUMBER PIECE = 0.5L;

/* ---- the motions and their truth ---- */

static void henon(const NUMBER *x, const NUMBER *v, NUMBER t, NUMBER *a) { extended_henon(x, v, t, a); }

static void starts(sections *s)
{
    for (size_t k = 0; k < s->count; k++) {
        const double y = -0.3 + 0.7 * ((double)k + 0.5) / (double)s->count, room = 1 / 6.0 - y * y + 2 * y * y * y / 3;
        s->y[k] = y;
        s->vy[k] = 0.9 * sqrt(room) * (2 * fmod(0.618033988749895 * (double)k, 1) - 1);
        s->vx[k] = sqrt(room - s->vy[k] * s->vy[k]);
    }
}

/* From y at t to x = 0 near by. */
static section_point cross(NUMBER t, const NUMBER *y)
{
    NUMBER at[MOST], length = -y[0] / y[2];
    for (int turn = 0; turn < 6; turn++) {
        memcpy(at, y, sizeof at);
        extrapolate(henon, 2, 0, at, length, COLUMNS);
        length -= at[0] / at[2];
    }
    return (section_point){(double)(t + length), (double)at[1], (double)at[3]};
}

static int truth_of(const sections *s, size_t trajectory, section_point *points)
{
    NUMBER y[MOST] = {0, s->y[trajectory], s->vx[trajectory], s->vy[trajectory]};
    int found = 0;
    for (int n = 0; (double)n * (double)PIECE < s->until; n++) {
        NUMBER next[MOST];
        memcpy(next, y, sizeof y);
        solve(henon, 2, PIECE, PIECE, next, COLUMNS, 1e-17L);
        if (y[0] < 0 && next[0] >= 0 && found < SECTION_MOST) points[found++] = cross(n * PIECE, y);
        memcpy(y, next, sizeof y);
    }
    return found;
}

static bool sections_open(sections *s, size_t count, size_t kept)
{
    *s = (sections){.count = count, .kept = kept, .until = UNTIL};
    s->y = calloc(count, sizeof(double)), s->vx = calloc(count, sizeof(double)), s->vy = calloc(count, sizeof(double));
    s->points = calloc(kept * SECTION_MOST, sizeof *s->points), s->found = calloc(kept, sizeof *s->found);
    if (!s->y || !s->vx || !s->vy || !s->points || !s->found) return false;
    starts(s);
    return true;
}

static void sections_close(sections *s) { free(s->y), free(s->vx), free(s->vy), free(s->points), free(s->found); }

/* Those of `all` that are kept, as motions of their own. */
static bool sections_of(sections *s, const sections *all, size_t kept)
{
    if (!sections_open(s, kept, kept)) return false;
    for (size_t k = 0; k < kept; k++) {
        const size_t from = k * (all->count / kept);
        s->y[k] = all->y[from], s->vx[k] = all->vx[from], s->vy[k] = all->vy[from];
    }
    return true;
}

/* ---- errors ---- */

/* The median over the motions of the largest error of a section point, in time and state; a motion with another number
 * of points counts as infinitely wrong. */
static double error_of(const sections *s, const sections *truth)
{
    double off[SAMPLE];
    for (size_t k = 0; k < s->kept; k++) {
        const size_t other = k * (truth->kept / s->kept);
        const section_point *p = s->points + k * SECTION_MOST, *is = truth->points + other * SECTION_MOST;
        off[k] = s->found[k] == truth->found[other] ? 0 : INFINITY;
        for (int i = 0; i < s->found[k] && isfinite(off[k]); i++)
            off[k] = fmax(off[k], fmax(fabs(p[i].t - is[i].t), fmax(fabs(p[i].y - is[i].y), fabs(p[i].v - is[i].v))));
    }
    return middle_of(off, s->kept);
}

/* ---- the sides ---- */

typedef struct job {
    sections *s;
    const char *method;
    double tolerance;
    int threads;
    int64_t evaluations;
} job;

/* Both: of one motion. */
static double by_ours(void *p)
{
    job *j = p;
    return ours_sections(j->s, j->method, j->tolerance, j->threads) / (double)j->s->count;
}

static double by_sundials(void *p)
{
    job *j = p;
    const sections *s = j->s;
    const double start = now();
    const int good = peer_sundials_sections(j->method, j->tolerance, s->count, s->y, s->vx, s->vy, s->until,
                                            SECTION_MOST, &s->points->t, s->found, &j->evaluations);
    return good ? (now() - start) / (double)s->count : NAN;
}

/* The fastest of these tolerances with this error, in j; its time or, where none is as good, infinity. A code that has
 * become slower than `least` is given up. */
static double tune(job *j, double (*run)(void *), const sections *truth, double error, double least)
{
    job trial = *j;
    for (int k = 0; k < 20; k++) {
        trial.tolerance = (k % 2 ? 3e-6 : 1e-5) * pow(10, -(k / 2));
        const double took = fmin(run(&trial), run(&trial));
        if (!(took < least)) break;
        if (error_of(trial.s, truth) > error) continue;
        *j = trial;
        return took;
    }
    return INFINITY;
}

static bool choose_ours(job *best, sections *few, const sections *truth, double error)
{
    double least = INFINITY;
    for (size_t m = 0; m < motus_method_count(); m++) {
        const motus_method *card = motus_method_at(m);
        if (!card->adaptive || card->order < 5 || strstr(card->name, "reversible")) continue;
        job j = {few, card->name, 0, 1, 0};
        const double took = tune(&j, by_ours, truth, error, least);
        if (took < least) least = took, *best = j;
    }
    return isfinite(least);
}

static bool choose_sundials(job *best, sections *few, const sections *truth, double error)
{
    static const char *const solvers[] = {"adams", "bdf"};
    double least = INFINITY;
    for (size_t k = 0; k < 2; k++) {
        job j = {few, solvers[k], 0, 1, 0};
        const double took = tune(&j, by_sundials, truth, error, least);
        if (took < least) least = took, *best = j;
    }
    return isfinite(least);
}

static void compare(sections *all, sections *sample, sections *few, const sections *truth, double error)
{
    job ours = {0}, other = {0};
    char name[80];
    if (!choose_ours(&ours, few, truth, error) || !choose_sundials(&other, few, truth, error)) {
        report_note("%s never comes as near as %.0e", ours.method ? "CVODE" : "motus", error);
        return;
    }
    ours.s = all, other.s = sample;
    job both = ours;
    both.threads = 2;
    side sides[] = {SIDE(by_ours, &ours), SIDE(by_ours, &both), SIDE(by_sundials, &other)};
    measure(sides, 3, ROUNDS);
    report_text("  CVODE: %s, tolerance %.0e; ours: %s, tolerance %.0e\n", other.method, other.tolerance, ours.method,
                ours.tolerance);
    snprintf(name, sizeof name, "at %.0e: CVODE, one core each", error);
    report_at_least(name, &sides[0], &sides[2], LIMIT, "ms");
    snprintf(name, sizeof name, "at %.0e: CVODE, ours on two threads", error);
    report_at_least(name, &sides[1], &sides[2], LIMIT, "ms");
    report_error("its median error", error_of(all, truth), error_of(sample, truth), error);
    report_note("CVODE evaluates the force %.0f times for a motion", (double)other.evaluations / SAMPLE);
}

void compare_sections(void)
{
    sections all, sample, few, truth;
    report_section("Events: the section of 10 000 motions of a star, t = 1000", "per motion");
    const bool room = sections_open(&all, COUNT, SAMPLE), more = room && sections_of(&sample, &all, SAMPLE);
    const bool least = more && sections_of(&few, &all, FEW), last = least && sections_of(&truth, &all, SAMPLE);
    if (last) {
        int points = 0;
        for (size_t k = 0; k < SAMPLE; k++) {
            truth.found[k] = truth_of(&truth, k, truth.points + k * SECTION_MOST);
            points += truth.found[k];
        }
        report_note("%.1f points a motion; errors are those of %d motions, and so is CVODE's time",
                    points / (double)SAMPLE, SAMPLE);
        for (int k = 0; k < TARGETS; k++) compare(&all, &sample, &few, &truth, targets[k]);
    }
    if (room) sections_close(&all);
    if (more) sections_close(&sample);
    if (least) sections_close(&few);
    if (last) sections_close(&truth);
}
