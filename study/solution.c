/* The reference solution: the exact motion where it is known, else a run of the most accurate method of high order,
 * its step halved until the change is round-off.
 *
 * Two runs of order p at steps h and h/2 differ by d; the error of the finer one is then about d/(r-1), where r is
 * the factor by which d fell at the last halving (2^p in theory, less where the force is not smooth enough for the
 * order). When d no longer falls, it is round-off, and d itself is the estimate. Where a force is discontinuous, two
 * halvings may agree by accident; so the chosen method runs once more with steps of two thirds, and that difference
 * is a lower bound of the estimate. Invariant: a solution that is `known` has finite rows and a measured error.
 */
#include "solution.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define SOLUTION_CANDIDATES 3
#define SOLUTION_ORDERS_BELOW 2 /* candidates are at most this far below the highest admitted order */
#define SOLUTION_LEVELS 24      /* halvings of an interval */
/* a difference that stops falling is round-off if it is below this, else the motion is not yet resolved */
#define SOLUTION_SMALL 1e-6
#define SOLUTION_FALL 1.5 /* the smallest factor per halving that counts as a fall */
/* The bound on the work (study_work): about a fifth of a second of a small model, or SOLUTION_PASSES evaluations for
 * each step of the methods under study, if that is more. */
#define SOLUTION_WORK 3e7
#define SOLUTION_PASSES 32

typedef struct candidate {
    const motus_method *card;
    double step;
    double x, v, scaled; /* the estimated error; scaled is NaN where there is none */
} candidate;

study_grid solution_grid(const study *s, double step)
{
    int64_t per;
    if (isnan(step)) return study_grid_of(s, fabs(s->until - s->from) / STUDY_SAMPLES, STUDY_SAMPLES, 0, &per);
    return study_grid_of(s, step, s->total, s->last_step, &per);
}

static size_t candidates(study *s, candidate *out)
{
    size_t count = 0;
    int highest = 0;
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < motus_method_count(); k++) {
            const motus_method *m = motus_method_at(k);
            if (strcmp(m->family, "exact") == 0 || !study_admits(s, m->name)) continue;
            if (pass == 0) {
                highest = m->order > highest ? m->order : highest;
                continue;
            }
            if (m->order < highest - SOLUTION_ORDERS_BELOW) continue;
            /* Sorted by falling order, then by falling stages: more stages have smaller error constants. */
            size_t at = count;
            while (at > 0 && (out[at - 1].card->order < m->order ||
                              (out[at - 1].card->order == m->order && out[at - 1].card->stages < m->stages)))
                at--;
            if (at >= SOLUTION_CANDIDATES) continue;
            count = count < SOLUTION_CANDIDATES ? count + 1 : count;
            memmove(out + at + 1, out + at, (count - 1 - at) * sizeof *out);
            out[at] = (candidate){.card = m, .scaled = NAN};
        }
    return count;
}

static const char *exact_method(study *s)
{
    if (!motus_has_exact(s->system)) return NULL;
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *m = motus_method_at(k);
        if (strcmp(m->family, "exact") == 0 && study_admits(s, m->name)) return m->name;
    }
    return NULL;
}

static bool finite_rows(const study *s, const double *rows, size_t count)
{
    for (size_t k = 0; k < count * s->numbers; k++)
        if (!isfinite(rows[k])) return false;
    return true;
}

/* The largest differences of two tables; NaN where either holds NaN. */
static study_distance apart(const study *s, const double *p, const double *q, size_t rows)
{
    study_distance most = {0, 0, 0};
    for (size_t r = 0; r < rows; r++) {
        study_distance d = study_measure(s, p + r * s->numbers, q + r * s->numbers);
        most.x = study_larger(most.x, d.x);
        most.v = study_larger(most.v, d.v);
        most.scaled = study_larger(most.scaled, d.scaled);
    }
    return most;
}

static void estimate(candidate *c, study_distance d, double divisor, double step)
{
    c->step = step;
    c->x = d.x / divisor;
    c->v = d.v / divisor;
    c->scaled = d.scaled / divisor;
}

/* Halves the step until only round-off is left, or the error is below `enough`, or the work is spent. *now and
 * *before are tables with room for the points (without the start); at the end *now holds the best run. */
static motus_status refine(study *s, const study_grid *g, double budget, double enough, candidate *c, double **now,
                           double **before)
{
    double work = 0, cost = 0;
    study_distance d = {NAN, NAN, NAN};
    bool have = false; /* *before is a complete, finite table */
    for (int level = 0; level < SOLUTION_LEVELS && (level == 0 || work + 2 * cost <= budget); level++) {
        int64_t per = (int64_t)1 << level;
        study_cost spent;
        motus_error ignored = motus_default_error();
        motus_status status = study_walk(s, c->card->name, g, per, *now, &spent, &ignored);
        if (study_fatal(status)) {
            if (s->err && !s->cancelled) motus_struct_write(MOTUS_DEF_ERROR, &ignored, s->err);
            return status;
        }
        /* A run that failed early cost little; the next one may cost its full price. */
        double steps = (double)g->intervals * (double)per;
        cost = fmax(study_work(s, c->card, (double)spent.steps, (double)spent.evaluations),
                    study_work(s, c->card, steps, -1));
        work += cost;
        if (status == MOTUS_OK && finite_rows(s, *now, g->points)) {
            study_scale(s, *now, g->points);
            const study_distance last = d;
            d = have ? apart(s, *now, *before, g->points) : (study_distance){NAN, NAN, NAN};
            double fall = last.scaled / d.scaled, step = g->interval / (double)per;
            if (last.scaled < SOLUTION_SMALL && !(fall > SOLUTION_FALL)) {
                estimate(c, last, 1, 2 * step);
                double *swap = *now;
                *now = *before;
                *before = swap;
                return MOTUS_OK;
            }
            if (have) {
                double theory = ldexp(1, c->card->order);
                estimate(c, d, isnan(fall) ? 1 : fmin(fmax(fall, SOLUTION_FALL), theory) - 1, step);
                if (d.scaled <= fmax(2 * s->noise, enough)) {
                    estimate(c, d, 1, step);
                    return MOTUS_OK;
                }
            }
            have = true;
        } else {
            have = false;
            d = (study_distance){NAN, NAN, NAN};
        }
        double *swap = *now;
        *now = *before;
        *before = swap;
    }
    double *swap = *now; /* the loop has just moved the newest table to *before */
    *now = *before;
    *before = swap;
    if (!have) c->scaled = NAN;
    return MOTUS_OK;
}

/* The rounding that halving the step does not show: values are rounded when they are stored, and the method's
 * coefficients are rounded too, so their sums are off by an ulp or so at every step size; that error grows with the
 * distance which a number moves. */
static void own_rounding(const study *s, const study_grid *g, solution *r)
{
    for (size_t k = 0; k < s->numbers; k++) {
        double way = 0;
        for (size_t p = 1; p <= g->points; p++)
            way += fabs(r->rows[p * s->numbers + k] - r->rows[(p - 1) * s->numbers + k]);
        r->error = fmax(r->error, DBL_EPSILON * (way + s->magnitude));
        r->scaled = fmax(r->scaled, fmax(DBL_EPSILON * way / s->scale[k], s->noise));
    }
}

/* A run with steps of two thirds (a third, if an interval has one step): it shares no time within an interval with
 * the run that it checks. */
static motus_status check(study *s, const study_grid *g, const candidate *c, solution *r, double *room)
{
    study_cost spent;
    motus_error ignored = motus_default_error();
    int64_t per = (int64_t)llround(g->interval / c->step);
    motus_status status = study_walk(s, c->card->name, g, per % 2 ? 3 * per : per / 2 * 3, room, &spent, &ignored);
    if (study_fatal(status)) {
        if (s->err && !s->cancelled) motus_struct_write(MOTUS_DEF_ERROR, &ignored, s->err);
        return status;
    }
    study_distance d = apart(s, room, r->rows + s->numbers, g->points);
    if (status == MOTUS_OK && isfinite(d.scaled)) {
        r->error = fmax(r->error, fmax(d.x, d.v));
        r->scaled = fmax(r->scaled, d.scaled);
    }
    return MOTUS_OK;
}

static motus_status find_reference(study *s, const study_grid *g, int64_t steps, double enough, solution *r,
                                   double *kept, double *now, double *before)
{
    candidate list[SOLUTION_CANDIDATES + 1];
    size_t count = candidates(s, list);
    const candidate *best = NULL;
    double *best_table = NULL;
    double budget = count ? fmax(SOLUTION_WORK, study_work(s, list[0].card, 0, SOLUTION_PASSES * (double)steps)) : 0;
    double base = s->base, span = s->span;
    for (size_t k = 0; k < count && !(best && best->scaled <= enough); k++) {
        study_part(s, base + span * (double)k / (double)count, span / (double)count);
        motus_status status = refine(s, g, budget / (double)count, enough, &list[k], &now, &before);
        if (status != MOTUS_OK) return status;
        if (isfinite(list[k].scaled) && (!best || list[k].scaled < best->scaled)) {
            double *swap = kept;
            kept = now;
            now = swap;
            best = &list[k];
            best_table = kept;
        }
    }
    study_part(s, base, span);
    if (study_broken(s) != MOTUS_OK) return study_broken(s);
    if (!best) {
        snprintf(r->text, sizeof r->text, "none: every method of high order failed before the end");
        return MOTUS_OK;
    }
    r->known = true;
    r->order = best->card->order;
    r->step = best->step;
    snprintf(r->method, sizeof r->method, "%s", best->card->name);
    snprintf(r->text, sizeof r->text, "%s at step %.6g", best->card->name, best->step);
    memcpy(r->rows + s->numbers, best_table, g->points * s->numbers * sizeof(double));
    study_scale(s, r->rows + s->numbers, g->points);
    r->error = fmax(best->x, best->v);
    r->scaled = best->scaled;
    own_rounding(s, g, r);
    return check(s, g, best, r, now);
}

motus_status solution_find(study *s, const study_grid *g, int64_t steps, double enough, solution *r)
{
    *r = (solution){.error = NAN, .scaled = NAN};
    r->rows = take(s->allocator, (g->points + 1) * s->numbers, sizeof(double));
    if (!r->rows)
        return fail(s->err, MOTUS_MEMORY, "out of memory for %zu states of %zu numbers", g->points, s->numbers);
    memcpy(r->rows, s->start, s->numbers * sizeof(double));

    const char *exact = exact_method(s);
    if (exact) {
        study_cost cost;
        motus_error ignored = motus_default_error();
        motus_status status = study_walk(s, exact, g, 1, r->rows + s->numbers, &cost, &ignored);
        if (study_fatal(status)) {
            if (s->err && !s->cancelled) motus_struct_write(MOTUS_DEF_ERROR, &ignored, s->err);
            return status;
        }
        if (status == MOTUS_OK && finite_rows(s, r->rows, g->points + 1)) {
            study_scale(s, r->rows + s->numbers, g->points);
            r->known = r->exact = true;
            r->error = r->scaled = 0;
            snprintf(r->method, sizeof r->method, "%s", exact);
            snprintf(r->text, sizeof r->text, "exact");
            return MOTUS_OK;
        }
    }
    size_t table = g->points * s->numbers;
    double *room = take(s->allocator, 3 * table, sizeof(double));
    if (!room)
        return fail(s->err, MOTUS_MEMORY, "out of memory for %zu states of %zu numbers", 3 * g->points, s->numbers);
    motus_status status = find_reference(s, g, steps, enough, r, room, room + table, room + 2 * table);
    give(s->allocator, room);
    return status;
}

motus_status solution_on(study *s, const solution *r, const study_grid *g, double *rows)
{
    int64_t per = 1;
    while (!r->exact && per < (int64_t)1 << SOLUTION_LEVELS && g->interval / (double)per > r->step * (1 + 1e-9))
        per *= 2;
    study_cost cost;
    motus_error ignored = motus_default_error();
    motus_status status = study_walk(s, r->method, g, per, rows, &cost, &ignored);
    if (!study_fatal(status)) return MOTUS_OK; /* the rows are NaN from the failure on */
    if (s->err && !s->cancelled) motus_struct_write(MOTUS_DEF_ERROR, &ignored, s->err);
    return status;
}

void solution_free(study *s, solution *r)
{
    give(s->allocator, r->rows);
    r->rows = NULL;
}
