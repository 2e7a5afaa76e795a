/* See ladder.h.
 *
 * A ladder begins with STEPS_FIRST steps, or with a tolerance as large as the coarsest accuracy, and becomes finer as
 * the last error and the order of the method suggest, until its error is below the accuracy. Between the last point
 * above it and the first below it more settings are tried, chosen by interpolation in logarithms; every number of the
 * result was measured.
 *
 * Errors are taken at the ends of steps, the first at or after each of TRUTH_TIMES times, so nothing is interpolated.
 * Invariant: points are sorted from coarse to fine, no two have the same setting, and no clock decides anything.
 */
#include "ladder.h"
#include "base/decimal.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define STEPS_FIRST 4
#define TOLERANCE_LEAST 1e-15
#define TOLERANCE_MOST 0.1
#define CLOSE 0.66   /* of the accuracy: an error above this part is near enough to it */
#define AIM 0.82     /* of the accuracy: the error at which a point between two others aims */
#define NARROW 0.01  /* a bracket in which the work differs by less than this part needs no more points */
#define TRIES 6      /* most points between two others */
#define LEFT 10.0    /* relative: a run with a larger error has left the motion */
#define ROUNDED 1e-7 /* relative: a smaller error that no longer falls is rounding, where the force is smooth */
#define PLATEAU_TOLERANCES 100.0
#define PLATEAU_STEPS 2.0
#define FALLS 0.7
#define TIMES_MOST 10    /* most runs that time a short one */
#define TIMES_LEAST 1e-3 /* seconds: short runs are repeated until all of them took so long */
#define TIMES_LONG 0.05  /* seconds of all runs, above which a run is timed no more than twice */

double ladder_step(const ladder *l, const ladder_point *p) { return fabs(l->s->until - l->s->from) / p->setting; }

static bool adaptive(const ladder *l) { return l->card->adaptive; }

/* Returns how much finer q is than p, as a factor of steps or of tolerances. */
static double finer(const ladder *l, double p, double q) { return adaptive(l) ? p / q : q / p; }

static double raised(double base, double power) { return exp(power * log(base)); }

/* Rounds a tolerance to two digits, so that it can be given again. */
static double rounded(double tolerance)
{
    const int power = (int)floor(log(tolerance) / log(10)) - 1;
    return decimal_scaled(floor(tolerance / decimal_scaled(1, power) + 0.5), power);
}

static bool meets(const ladder *l, const ladder_point *p, double accuracy)
{
    return p->error + (l->absolute ? l->t->absolute : l->t->relative) <= accuracy;
}

/* Returns the cost of a run in evaluations; implicit equations need a Jacobian, which is one evaluation a column. */
static double cost(const ladder *l, double steps, double evaluations)
{
    return evaluations + (l->card->evaluations > 0 ? 0 : steps * (double)l->s->numbers);
}

/* Runs ------------------------------------------------------------------------------------------------------------- */

static motus_status create(ladder *l, double setting, motus_run **run, motus_error *e)
{
    study *s = l->s;
    s->tolerance = setting;
    return study_run(s, l->method, fabs(s->until - s->from) / setting, NAN, s->until, NULL, run, e);
}

/* Takes the run to the first end of a step at or after this part of the way. */
static motus_status go(const ladder *l, motus_run *run, int part, double setting, motus_error *e)
{
    const study *s = l->s;
    if (part == TRUTH_TIMES) return motus_run_finish(run, e);
    if (!adaptive(l)) {
        const int64_t to = (int64_t)ceil(setting * part / TRUTH_TIMES), left = to - motus_run_steps(run);
        return left > 0 ? motus_run_step(run, left, e) : MOTUS_OK;
    }
    const double way = fabs(s->until - s->from) * part / TRUTH_TIMES * (1 - 1e-12);
    motus_status status = MOTUS_OK;
    while (status == MOTUS_OK && !motus_run_done(run) && fabs(motus_run_time(run) - s->from) < way)
        status = motus_run_step(run, 1, e);
    return status;
}

/* Finds the largest error along a run; a run that leaves the motion is given up. */
static motus_status follow(ladder *l, motus_run *run, ladder_point *p, motus_error *e)
{
    truth_distance worst = {0, 0}, d;
    motus_status status = MOTUS_OK;
    for (int part = 1; part <= TRUTH_TIMES && status == MOTUS_OK; part++) {
        const int64_t before = motus_run_steps(run);
        l->s->walking = run;
        status = go(l, run, part, p->setting, e);
        l->s->walking = NULL;
        if (status != MOTUS_OK || motus_run_steps(run) == before) continue;
        if (cost(l, (double)motus_run_steps(run), (double)motus_run_now(run).evaluations) > l->most)
            return fail(e, MOTUS_SOLVE, "it takes too much work");
        status = study_state(l->s, run, l->y, e);
        if (status == MOTUS_OK) status = truth_measure(l->s, l->t, motus_run_time(run), l->y, &d, e);
        if (status != MOTUS_OK) continue;
        worst.relative = study_larger(worst.relative, d.relative);
        worst.absolute = study_larger(worst.absolute, d.absolute);
        if (!(worst.relative < LEFT)) return MOTUS_OK; /* the error stays INFINITY */
    }
    p->steps = motus_run_steps(run);
    p->evaluations = motus_run_now(run).evaluations;
    if (status == MOTUS_OK) p->error = l->absolute ? worst.absolute : worst.relative;
    return status;
}

/* Adds a point at its place. */
static motus_status add(ladder *l, double setting)
{
    study *s = l->s;
    ladder_point p = {.setting = setting, .error = INFINITY};
    motus_run *run = NULL;
    motus_error e = motus_default_error();
    s->limit = l->most;
    motus_status status = create(l, setting, &run, &e);
    if (status == MOTUS_OK) status = follow(l, run, &p, &e);
    s->limit = 0;
    motus_run_destroy(run);
    if (s->cancelled || status == MOTUS_MEMORY) return study_tell(s, status, &e);
    if (status != MOTUS_OK) {
        l->failed = status == MOTUS_CANCELLED ? MOTUS_SOLVE : status; /* by its limit */
        snprintf(l->failure, sizeof l->failure, "%.480s",
                 status == MOTUS_CANCELLED ? "it takes too much work" : e.message);
    }
    size_t at = l->count;
    while (at > 0 && finer(l, l->points[at - 1].setting, setting) < 1) at--;
    memmove(l->points + at + 1, l->points + at, (l->count - at) * sizeof *l->points);
    l->points[at] = p;
    l->count++;
    return MOTUS_OK;
}

/* From coarse to fine ---------------------------------------------------------------------------------------------- */

/* Returns whether errors no longer fall, by rounding or by kinks of the force: no point within a factor PLATEAU of the
 * finest is better than the best before. */
static bool stalled(const ladder *l)
{
    const double unit = l->absolute ? l->t->absolute / l->t->relative : 1; /* of relative errors */
    const double last = l->points[l->count - 1].setting, far = adaptive(l) ? PLATEAU_TOLERANCES : PLATEAU_STEPS;
    double before = INFINITY, after = INFINITY;
    for (size_t k = 0; k < l->count; k++) {
        double *best = finer(l, l->points[k].setting, last) >= far ? &before : &after;
        *best = fmin(*best, l->points[k].error);
    }
    return before < ROUNDED * unit && after > FALLS * before;
}

/* Returns the least error so far. */
static double least(const ladder *l)
{
    double best = INFINITY;
    for (size_t k = 0; k < l->count; k++) best = fmin(best, l->points[k].error);
    return best;
}

bool ladder_failed(const ladder *l) { return !isfinite(least(l)); }

static bool smooth(const ladder *l)
{
    motus_analysis analysis = motus_default_analysis();
    return motus_analysis_of(l->s->system, &analysis) == MOTUS_OK && analysis.smooth;
}

static double ended(ladder *l, double accuracy, double evaluations)
{
    char wanted[DECIMAL_MAX];
    l->ended = true;
    if (l->failed != MOTUS_OK && ladder_failed(l))
        snprintf(l->why, sizeof l->why, "%s", l->failure);
    else if (evaluations > 0)
        snprintf(l->why, sizeof l->why, "%s would take the work of about %.2g evaluations, above the limit of %.2g",
                 decimal(accuracy, wanted), evaluations, l->most);
    else if (adaptive(l) && l->points[l->count - 1].setting <= TOLERANCE_LEAST)
        snprintf(l->why, sizeof l->why, "its error is above %.1e, with the smallest tolerance too, %g", least(l),
                 TOLERANCE_LEAST);
    else if (stalled(l) && smooth(l))
        snprintf(l->why, sizeof l->why, "its error stays above %.1e, because of rounding", least(l));
    else
        snprintf(l->why, sizeof l->why, "the best of its %zu runs has the error %.1e", l->count, least(l));
    return 0;
}

/* Returns the setting that is to follow the finest; 0: none is. */
static double next(ladder *l, double accuracy)
{
    const ladder_point *p = &l->points[l->count - 1];
    const double order = l->card->order;
    if (stalled(l) || l->count == LADDER_MOST) return ended(l, accuracy, 0);
    const bool known = isfinite(p->error) && p->error > 0;
    const double fall = known ? 0.6 * accuracy / p->error : 1; /* the factor by which the error is to fall */
    const double each =
        cost(l, 1, p->evaluations > 0 ? (double)p->evaluations / (double)p->steps : study_evaluations(l->card, 1));
    if (adaptive(l)) {
        if (p->setting <= TOLERANCE_LEAST) return ended(l, accuracy, 0);
        const double factor = known ? fmin(fmax(fall, 1e-2), 0.5) : 0.1;
        if (each * (double)p->steps * raised(factor, -1 / order) > l->most)
            return ended(l, accuracy, each * (double)p->steps * raised(fmin(fall, factor), -1 / order));
        return fmax(TOLERANCE_LEAST, rounded(p->setting * factor));
    }
    const double factor = known ? fmin(fmax(raised(fall, -1 / order), 1.25), 4) : 2, n = ceil(p->setting * factor);
    if (n * each > l->most) return ended(l, accuracy, p->setting * each * fmax(factor, raised(fall, -1 / order)));
    return n;
}

/* Returns a setting between the points k - 1, which does not meet the accuracy, and k, which does; 0: they are near
 * enough. */
static double between(const ladder *l, size_t k, double accuracy)
{
    const ladder_point *p = &l->points[k - 1], *q = &l->points[k];
    const double ratio = finer(l, p->setting, q->setting), order = l->card->order;
    if (q->error >= CLOSE * accuracy || (adaptive(l) ? raised(ratio, 1 / (order + 1)) : ratio) < 1 + NARROW) return 0;
    double part = 0.5;
    if (p->error < LEFT && q->error > 0) part = log(p->error / (AIM * accuracy)) / log(p->error / q->error);
    part = fmin(fmax(isnan(part) ? 0.5 : part, 0.1), 0.9);
    if (adaptive(l)) {
        const double tolerance = rounded(p->setting * raised(ratio, -part));
        return tolerance < p->setting && tolerance > q->setting ? tolerance : 0;
    }
    const double n = floor(p->setting * raised(ratio, part) + 0.5);
    return n > p->setting && n < q->setting ? n : q->setting > p->setting + 1 ? p->setting + 1 : 0;
}

static size_t first_that_meets(const ladder *l, double accuracy)
{
    size_t k = 0;
    while (k < l->count && !meets(l, &l->points[k], accuracy)) k++;
    return k;
}

motus_status ladder_reach(ladder *l, double accuracy, const ladder_point **found)
{
    motus_status status = MOTUS_OK;
    *found = NULL;
    if (l->count == 0)
        status = add(l, adaptive(l) ? rounded(fmin(fmax(accuracy, TOLERANCE_LEAST), TOLERANCE_MOST)) : STEPS_FIRST);
    while (status == MOTUS_OK && first_that_meets(l, accuracy) == l->count) {
        const double setting = l->ended ? 0 : next(l, accuracy);
        if (setting == 0) return MOTUS_OK;
        status = add(l, setting);
    }
    for (int i = 0; i < TRIES && status == MOTUS_OK && l->count < LADDER_MOST; i++) {
        const size_t k = first_that_meets(l, accuracy);
        double setting = k > 0 ? between(l, k, accuracy) : 0;
        /* nothing coarser was tried */
        if (k == 0 && adaptive(l) && l->points[0].setting < TOLERANCE_MOST && l->points[0].error < CLOSE * accuracy)
            setting = fmin(TOLERANCE_MOST, rounded(l->points[0].setting * 10));
        if (setting == 0) break;
        status = add(l, setting);
    }
    for (size_t k = 0; k < l->count && status == MOTUS_OK; k++)
        if (meets(l, &l->points[k], accuracy) && (!*found || l->points[k].evaluations < (*found)->evaluations))
            *found = &l->points[k];
    return status;
}

motus_status ladder_time(ladder *l, const ladder_point *p, double *seconds)
{
    double all = 0;
    *seconds = INFINITY;
    for (int i = 0; i < (all > TIMES_LONG ? 2 : l->repeats) || (i < TIMES_MOST && all < TIMES_LEAST); i++) {
        motus_run *run = NULL;
        motus_error e = motus_default_error();
        motus_status status = create(l, p->setting, &run, &e);
        const double began = study_processor_seconds();
        if (status == MOTUS_OK) status = motus_run_finish(run, &e);
        const double took = study_processor_seconds() - began;
        motus_run_destroy(run);
        if (l->s->cancelled || status != MOTUS_OK) return study_tell(l->s, status, &e);
        *seconds = fmin(*seconds, took);
        all += took;
    }
    return MOTUS_OK;
}
