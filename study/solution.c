/* The reference solution: the exact motion where it is known, else a run of the most accurate method of high order, its
 * step halved until the change is round-off. Its error is estimated by that change and by a second method.
 *
 * Two runs of order p at steps h and h/2 differ by d; the error of the finer one is then about d/(r-1), where r is
 * the factor by which d fell at the last halving (2^p in theory, less where the force is not smooth enough for the
 * order). When d no longer falls, it is round-off, and d itself is the estimate. Halvings alone can agree by accident,
 * because all their steps have times in common; so another method judges the result at other times. Where the force
 * is not smooth, steps end at its switches, so that every step has a smooth force; where that cannot be done, the
 * estimate is never called round-off. Invariant: a solution that is `known` has finite rows and an error that two
 * methods agree on.
 */
#include "solution.h"
#include "base/decimal.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define NONE "none: " /* begins the text where nothing is known */
#define SOLUTION_CANDIDATES 3
/* Halved steps of a higher order reach rounding at once, so that their differences do not tell their error. */
#define SOLUTION_ORDER_MOST 8
#define SOLUTION_ORDERS_BELOW 2 /* candidates may be this far below the highest admitted order */
#define SOLUTION_LEVELS 24      /* halvings of an interval */
/* a difference that stops falling is round-off if it is smaller, else the motion is not yet resolved */
#define SOLUTION_SMALL 1e-6
#define SOLUTION_FALL 1.5 /* the smallest factor per halving that counts as a fall */
#define SOLUTION_GOOD \
    64                    /* times the rounding of the motion's size: below such an error dearer methods are not
                           * tried */
#define SOLUTION_LOST 0.1 /* of the motion's size: with a larger estimate nothing is known */
#define SOLUTION_FAR \
    100                   /* times the estimate of halvings: if a second method is farther away, the halvings agree by
                           * luck */
#define SOLUTION_ROUNDS 3 /* how often the first method then takes shorter steps */
#define SOLUTION_SHAKE 0x1p-53               /* of the largest values of the motion */
#define SOLUTION_SAME_TIME (8 * DBL_EPSILON) /* relative */
#define SOLUTION_UNEVEN 4 /* the factor that widens an estimate where steps cross jumps of the force */
/* The bound on the work (study_work): about a fifth of a second of a small model, or SOLUTION_PASSES evaluations for
 * each step of the methods under study, if that is more. */
#define SOLUTION_WORK 3e7
#define SOLUTION_PASSES 32

typedef struct candidate {
    const motus_method *card;
    double step;
    double x, v, scaled;         /* the estimated error; scaled: NaN if there is none */
    study_jump jump;             /* of the finest run */
    bool over;                   /* a run was given up, since it took too long */
    double work;                 /* of all its runs */
    double more;                 /* the cost of its last run, as a multiple of the cost of its steps */
    char failed[MOTUS_TEXT_MAX]; /* why its last run failed, or "" */
} candidate;

/* The work of the runs of one method, in units of study_work. */
typedef struct work {
    double done, most; /* most: the bound */
    double next;       /* what a run of half the step will cost */
    double more;       /* `more` of the last run, as in candidate */
} work;

study_grid solution_grid(const study *s, double step)
{
    int64_t per;
    if (isnan(step)) return study_grid_of(s, fabs(s->until - s->from) / STUDY_SAMPLES, STUDY_SAMPLES, 0, &per);
    return study_grid_of(s, step, s->total, s->last_step, &per);
}

static candidate untried(const motus_method *card)
{
    return (candidate){.card = card, .scaled = NAN, .jump = STUDY_NO_JUMP};
}

/* Returns whether halved steps of a method tell its error. */
static bool suits(const motus_method *m) { return !m->adaptive && m->order > 0 && m->order <= SOLUTION_ORDER_MOST; }

static size_t candidates(study *s, candidate *out)
{
    size_t count = 0;
    int highest = 0;
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < motus_method_count(); k++) {
            const motus_method *m = motus_method_at(k);
            if (!suits(m) || !study_admits(s, m->name)) continue;
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
            out[at] = untried(m);
        }
    return count;
}

static const char *exact_method(study *s)
{
    if (!motus_has_exact(s->system)) return NULL;
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *m = motus_method_at(k);
        if (m->order == 0 && study_admits(s, m->name)) return m->name;
    }
    return NULL;
}

static bool finite_rows(const study *s, const double *rows, size_t count)
{
    for (size_t k = 0; k < count * s->numbers; k++)
        if (!isfinite(rows[k])) return false;
    return true;
}

/* Returns the largest differences of two tables; NaN where either holds NaN. */
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

/* Walks a reference run, which is given up if it costs more than `limit`. If it fails, the study goes on, and the table
 * has NaN. */
static motus_status walk(study *s, const motus_method *card, const study_grid *g, int64_t per, double limit,
                         const double *from, double *table, study_cost *spent, work *w, char failed[MOTUS_TEXT_MAX])
{
    motus_error ignored = motus_default_error();
    const double steps = (double)g->intervals * (double)per, plain = study_work(s, card, steps, -1),
                 each = plain / study_evaluations(card, steps);
    s->limit = fmax(1, limit / each);
    const motus_status status = study_walk(s, card->name, g, per, from, table, spent, &ignored);
    s->limit = 0;
    if (study_fatal(status)) return study_tell(s, status, &ignored);
    snprintf(failed, MOTUS_TEXT_MAX, "%s", status == MOTUS_OK ? "" : ignored.message);
    /* A run that failed early cost little; the next one may cost its full price. Half the step costs twice as much,
     * apart from what it costs to locate switches. */
    const double cost = fmax(each * (double)spent->evaluations, plain);
    w->done += cost;
    w->next = cost + plain;
    w->more = cost / plain;
    return MOTUS_OK;
}

static void swap(double **p, double **q)
{
    double *kept = *p;
    *p = *q;
    *q = kept;
}

/* Halves the step, from 2^-level of an interval on, until only round-off is left, or the error is below `enough`, or
 * the work is spent. The first two runs, without which nothing is known, may take `total` each. *now and *before are
 * tables with room for the points without the start; at the end *now holds the best run. */
static motus_status refine(study *s, const study_grid *g, double budget, double total, double enough, int level,
                           candidate *c, double **now, double **before)
{
    work w = {.most = budget};
    const int first = level;
    study_distance d = {NAN, NAN, NAN};
    bool have = false; /* *before is a complete, finite table */
    for (; level < SOLUTION_LEVELS; level++) {
        const double left = level <= first + 1 ? total : w.most - w.done;
        if (level > first && w.next > left) break;
        int64_t per = (int64_t)1 << level;
        study_cost spent;
        motus_status status =
            walk(s, c->card, g, per, level <= first + 1 ? total : left + w.most, NULL, *now, &spent, &w, c->failed);
        if (status != MOTUS_OK) return status;
        c->work = w.done;
        c->more = w.more;
        c->over = spent.over;
        if (spent.over && level == first) study_scale(s, *now, g->points); /* of the part that was reached */
        if (spent.over) break;
        if (finite_rows(s, *now, g->points)) {
            study_scale(s, *now, g->points);
            c->jump = spent.jump;
            const study_distance last = d;
            d = have ? apart(s, *now, *before, g->points) : (study_distance){NAN, NAN, NAN};
            double fall = last.scaled / d.scaled, step = g->interval / (double)per;
            if (last.scaled < SOLUTION_SMALL && !(fall > SOLUTION_FALL)) {
                estimate(c, last, 1, 2 * step);
                swap(now, before);
                return MOTUS_OK;
            }
            if (have) {
                double theory = ldexp(1, c->card->order);
                /* a fall far below the order of the method is uneven, and the next halving may have any fall */
                const double most = fall < theory / 4 ? 2 : theory;
                estimate(c, d, isnan(fall) ? 1 : fmin(fmax(fall, SOLUTION_FALL), most) - 1, step);
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
        swap(now, before);
    }
    swap(now, before); /* *before holds the newest table that is complete */
    if (!have) c->scaled = NAN;
    return MOTUS_OK;
}

/* Adds the rounding that halving the step does not show. Values are rounded when they are stored, and the method's
 * coefficients are rounded, so their sums are off by an ulp or so at every step size; that error grows with the
 * distance which a number moves. The times of switches are rounded alike in all runs. */
static void own_rounding(const study *s, const study_grid *g, const candidate *c, solution *r)
{
    for (size_t k = 0; k < s->numbers; k++) {
        double way = 0;
        for (size_t p = 1; p <= g->points; p++)
            way += fabs(r->rows[p * s->numbers + k] - r->rows[(p - 1) * s->numbers + k]);
        r->error = fmax(r->error, DBL_EPSILON * (way + s->magnitude));
        r->scaled = fmax(r->scaled, fmax(DBL_EPSILON * way / s->scale[k], s->noise));
        if (k < s->nx) continue;
        r->error = fmax(r->error, c->jump.rounding);
        r->scaled = fmax(r->scaled, c->jump.rounding / s->scale[k]);
    }
}

/* Judging by another method ---------------------------------------------------------------------------------------- */

/* Returns whether a run of `steps` steps costs more than `most`, switches not counted. */
static bool too_dear(const study *s, const motus_method *m, double steps, double most)
{
    return study_work(s, m, steps, -1) > most;
}

/* Returns the method that judges `best`, and can afford `steps` steps: of another family if one has nearly its order,
 * else another row, else itself. */
static const motus_method *judge_of(study *s, const motus_method *best, double steps, double most)
{
    const motus_method *judge = best;
    int rank = 0;
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *m = motus_method_at(k);
        if (m == best || !suits(m) || m->order < best->order - SOLUTION_ORDERS_BELOW) continue;
        const int other = strcmp(m->family, best->family) != 0 ? 2 : 1;
        if (rank > other || (rank == other && judge->order >= m->order)) continue;
        if (too_dear(s, m, steps, most) || !study_admits(s, m->name)) continue;
        judge = m;
        rank = other;
    }
    return judge;
}

/* Judges a run by its difference from one of another method, a lower bound of the error: nothing changes where both
 * methods are far more accurate than the difference of two halvings says. The steps of the two have no time in common
 * within an interval, so that what falls between the steps of one falls into the steps of the other. The other method
 * takes more steps as long as that brings it nearer. *found NaN: no run of it reached the end. */
static motus_status judge(study *s, const study_grid *g, double budget, candidate *c, const solution *r, double *room,
                          study_distance *found)
{
    const int64_t first = (int64_t)(1.5 * (double)llround(g->interval / c->step)) | 1;
    const motus_method *other = judge_of(s, c->card, (double)g->intervals * (double)first * c->more, budget);
    work w = {.most = budget};
    bool nearer = true, agree = false;
    *found = (study_distance){NAN, NAN, NAN};
    for (int64_t per = first; per > 0; per = 2 * per + 1) {
        study_cost spent;
        motus_status status = walk(s, other, g, per, 2 * w.most - w.done, NULL, room, &spent, &w, c->failed);
        if (status != MOTUS_OK) return status;
        c->over = spent.over;
        study_distance d = {NAN, NAN, NAN};
        if (!spent.over) d = apart(s, room, r->rows + s->numbers, g->points);
        nearer = isfinite(d.scaled) && !(d.scaled > found->scaled / SOLUTION_FALL);
        if (isfinite(d.scaled) && !(d.scaled >= found->scaled)) *found = d;
        agree = found->scaled <= fmax(2 * r->scaled, 2 * s->noise);
        if (agree || (isfinite(found->scaled) && !nearer) || spent.over || w.done + w.next > w.most) break;
    }
    return MOTUS_OK;
}

/* Widens an error where the force jumps and no step ends there, by a factor from experience: such an error depends on
 * where steps happen to lie, and falls unevenly. */
static void widen(solution *r)
{
    r->error *= SOLUTION_UNEVEN;
    r->scaled *= SOLUTION_UNEVEN;
}

static motus_status unknown(solution *r, const char *why)
{
    r->known = false;
    r->error = r->scaled = NAN;
    snprintf(r->text, sizeof r->text, NONE "%s", why);
    return MOTUS_OK;
}

static const char *why_unknown(const candidate *list, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (list[k].over) return "it would take too long, since the force changes its formula often or fast";
    for (size_t k = 0; k < count; k++)
        if (list[k].failed[0]) return list[k].failed;
    return "no method of high order applies";
}

/* Takes the run of `best` in `table` as the solution, with the error that its halvings tell. */
static void adopt(study *s, const study_grid *g, const candidate *best, const double *table, solution *r)
{
    r->known = true;
    r->order = best->card->order;
    r->step = best->step;
    r->jump = best->jump;
    snprintf(r->method, sizeof r->method, "%s", best->card->name);
    snprintf(r->text, sizeof r->text, "%s at step %.6g%s", best->card->name, best->step,
             best->jump.order >= 0 ? ", with steps that end where the force is not smooth" : "");
    memcpy(r->rows + s->numbers, table, g->points * s->numbers * sizeof(double));
    study_scale(s, r->rows + s->numbers, g->points);
    r->error = fmax(best->x, best->v);
    r->scaled = best->scaled;
    own_rounding(s, g, best, r);
}

/* Adds the distance of a run that begins a rounding away. All other runs begin at equal rounded numbers, and near a
 * place where the motion rests they round alike for long: their distances do not show that error. */
static motus_status shake(study *s, const study_grid *g, double budget, candidate *best, solution *r, double *room)
{
    double *from = s->work;
    work w = {.most = budget};
    for (size_t k = 0; k < s->numbers; k++) {
        double most = 0;
        for (size_t p = 0; p <= g->points; p++) most = fmax(most, fabs(r->rows[p * s->numbers + k]));
        from[k] = s->start[k] + (k % 2 ? -1 : 1) * SOLUTION_SHAKE * most;
    }
    study_cost spent;
    char failed[MOTUS_TEXT_MAX];
    const int64_t per = llround(g->interval / best->step);
    motus_status status = walk(s, best->card, g, per, 2 * budget, from, room, &spent, &w, failed);
    if (status != MOTUS_OK || !finite_rows(s, room, g->points)) return status;
    const study_distance d = apart(s, room, r->rows + s->numbers, g->points);
    if (!(d.scaled < SOLUTION_LOST)) return unknown(r, "rounding grows along this motion until no digit of it is left");
    r->error = fmax(r->error, fmax(d.x, d.v));
    r->scaled = fmax(r->scaled, d.scaled);
    return MOTUS_OK;
}

/* Judges the solution by a second method. Halvings of the first one may agree because all of them miss something; while
 * the second one is far from what they tell, the first one takes shorter steps. */
static motus_status agree(study *s, const study_grid *g, double budget, double enough, candidate *best, solution *r,
                          double *now, double *before)
{
    for (int turn = 0;; turn++) {
        study_distance d;
        motus_status status = judge(s, g, budget, best, r, now, &d);
        if (status != MOTUS_OK) return status;
        if (isnan(d.scaled)) return unknown(r, why_unknown(best, 1));
        const bool far = d.scaled > fmax(fmax(SOLUTION_FAR * r->scaled, 2 * s->noise), enough);
        const double own = r->scaled;
        r->error = fmax(r->error, fmax(d.x, d.v));
        r->scaled = fmax(r->scaled, d.scaled);
        if (!far || turn == SOLUTION_ROUNDS) return MOTUS_OK;
        candidate again = untried(best->card);
        const int level = ilogb(round(g->interval / best->step)) + 1;
        status = refine(s, g, budget, budget, enough, level, &again, &now, &before);
        if (status != MOTUS_OK) return status;
        if (!(again.step < best->step) || !(again.scaled <= fmax(own, d.scaled))) return MOTUS_OK;
        *best = again;
        adopt(s, g, best, now, r);
    }
}

static motus_status find_reference(study *s, const study_grid *g, int64_t steps, double enough, solution *r,
                                   double *kept, double *now, double *before)
{
    candidate list[SOLUTION_CANDIDATES + 1];
    size_t count = candidates(s, list);
    candidate *best = NULL;
    double *best_table = NULL;
    const double total =
        count ? fmax(SOLUTION_WORK, study_work(s, list[0].card, 0, SOLUTION_PASSES * (double)steps)) : 0;
    const double budget = total / (double)(count + (count == 0));
    double base = s->base, span = s->span / (double)(count + 1), work = 0;
    for (size_t k = 0; k < count && !(best && best->scaled <= enough); k++) {
        study_part(s, base + span * (double)k, span);
        const double most = best && best->scaled <= SOLUTION_GOOD * s->noise ? work : total;
        if (best && (work > total || too_dear(s, list[k].card, (double)g->intervals, most))) continue;
        motus_status status = refine(s, g, budget, total, enough, 0, &list[k], &now, &before);
        if (status != MOTUS_OK) return status;
        work += list[k].work;
        if (isfinite(list[k].scaled) && (!best || list[k].scaled < best->scaled)) {
            swap(&kept, &now);
            best = &list[k];
            best_table = kept;
        }
    }
    study_part(s, base + span * (double)count, span);
    if (study_broken(s) != MOTUS_OK) return study_broken(s);
    if (!best) return unknown(r, why_unknown(list, count));
    adopt(s, g, best, best_table, r);
    motus_status status = agree(s, g, total, enough, best, r, now, before);
    if (status == MOTUS_OK && r->known) status = shake(s, g, total, best, r, now);
    study_part(s, base, span * (double)(count + 1));
    if (status != MOTUS_OK || !r->known) return status;
    r->uneven = r->uneven && !(s->locate && s->locatable);
    if (r->uneven) widen(r);
    if (!(r->scaled < SOLUTION_LOST)) return unknown(r, "methods of high order end far from each other");
    return MOTUS_OK;
}

/* Finds the solution with steps that end at switches, and that resolve the force. */
static motus_status find_located(study *s, const study_grid *g, int64_t steps, double enough, solution *r, double *room)
{
    const size_t table = g->points * s->numbers;
    motus_analysis analysis = motus_default_analysis();
    study_note(s, motus_analysis_of(s->system, &analysis));
    if (study_broken(s) != MOTUS_OK) return study_broken(s);
    r->uneven = !analysis.smooth;
    s->locate = true;
    const motus_status status = find_reference(s, g, steps, enough, r, room, room + table, room + 2 * table);
    s->locate = false;
    return status;
}

/* Finds where the force is not smooth along an exact motion, by a run. */
static motus_status find_jump(study *s, const study_grid *g, solution *r)
{
    motus_analysis analysis = motus_default_analysis();
    candidate list[SOLUTION_CANDIDATES + 1];
    study_note(s, motus_analysis_of(s->system, &analysis));
    if (study_broken(s) != MOTUS_OK) return study_broken(s);
    if (!candidates(s, list)) return study_broken(s);
    double *room = take(s->allocator, g->points * s->numbers, sizeof(double));
    if (!room) return fail(s->err, MOTUS_MEMORY, "out of memory for %zu states of %zu numbers", g->points, s->numbers);
    study_cost cost;
    motus_error ignored = motus_default_error();
    s->locate = true;
    motus_status status = study_walk(s, list[0].card->name, g, 1, NULL, room, &cost, &ignored);
    s->locate = false;
    give(s->allocator, room);
    if (study_fatal(status)) return study_tell(s, status, &ignored);
    r->uneven = !analysis.smooth && (status != MOTUS_OK || !s->locatable);
    r->jump = cost.jump;
    return MOTUS_OK;
}

motus_status solution_find(study *s, const study_grid *g, int64_t steps, double enough, solution *r)
{
    *r = (solution){.error = NAN, .scaled = NAN, .jump = STUDY_NO_JUMP};
    r->rows = take(s->allocator, (g->points + 1) * s->numbers, sizeof(double));
    if (!r->rows)
        return fail(s->err, MOTUS_MEMORY, "out of memory for %zu states of %zu numbers", g->points, s->numbers);
    memcpy(r->rows, s->start, s->numbers * sizeof(double));

    const char *exact = exact_method(s);
    if (exact) {
        study_cost cost;
        motus_error ignored = motus_default_error();
        motus_status status = study_walk(s, exact, g, 1, NULL, r->rows + s->numbers, &cost, &ignored);
        if (study_fatal(status)) return study_tell(s, status, &ignored);
        if (status == MOTUS_OK && finite_rows(s, r->rows, g->points + 1)) {
            study_scale(s, r->rows + s->numbers, g->points);
            r->known = r->exact = true;
            r->error = r->scaled = 0;
            snprintf(r->method, sizeof r->method, "%s", exact);
            snprintf(r->text, sizeof r->text, "exact");
            return find_jump(s, g, r);
        }
    }
    size_t table = g->points * s->numbers;
    double *room = take(s->allocator, 3 * table, sizeof(double));
    if (!room)
        return fail(s->err, MOTUS_MEMORY, "out of memory for %zu states of %zu numbers", 3 * g->points, s->numbers);
    motus_status status = find_located(s, g, steps, enough, r, room);
    give(s->allocator, room);
    return status;
}

double solution_allows(const study *s, const solution *r, char *why, size_t size)
{
    char t[DECIMAL_MAX];
    motus_column time = motus_default_column();
    why[0] = 0;
    if (r->uneven) {
        snprintf(why, size, "the force is not smooth, and where it jumps could not be found");
        return 1;
    }
    if (r->jump.order < 0) return 0;
    const bool infinite = r->jump.power != (double)r->jump.order;
    decimal_time(r->jump.time, s->until - s->from, t);
    motus_column_at(s->system, 0, &time);
    if (r->jump.order == 0)
        snprintf(why, size, "the force %s at %s = %s", infinite ? "is infinite" : "jumps", time.name, t);
    else if (r->jump.order == 1)
        snprintf(why, size, "the slope of the force %s at %s = %s", infinite ? "is infinite" : "jumps", time.name, t);
    else
        snprintf(why, size, "derivative %d of the force %s at %s = %s", (int)r->jump.order,
                 infinite ? "is infinite" : "jumps", time.name, t);
    return fmax(r->jump.power + 1, 0.01);
}

const char *solution_lacks(const solution *r) { return r->text + strlen(NONE); }

motus_status solution_missing(study *s, const solution *r, double until)
{
    char text[DECIMAL_MAX];
    fail(s->err, MOTUS_DIVERGED, "there is no reference solution until %s: %s",
         decimal_time(until, until - s->from, text), solution_lacks(r));
    hint(s->err, "let the motion end earlier, or give its exact line");
    return MOTUS_DIVERGED;
}

motus_status solution_on(study *s, const solution *r, const study_grid *g, double *rows)
{
    s->locate = true;
    int64_t per = 1;
    while (!r->exact && per < (int64_t)1 << SOLUTION_LEVELS && g->interval / (double)per > r->step * (1 + 1e-9))
        per *= 2;
    study_cost cost;
    motus_error ignored = motus_default_error();
    motus_status status = study_walk(s, r->method, g, per, NULL, rows, &cost, &ignored);
    s->locate = false;
    if (!study_fatal(status)) return MOTUS_OK; /* the rows are NaN from the failure on */
    return study_tell(s, status, &ignored);
}

bool solution_same_time(double a, double b) { return fabs(a - b) <= SOLUTION_SAME_TIME * (fabs(a) + fabs(b)); }

static double direction_of(const study_grid *g) { return g->until > g->from ? 1 : -1; }

double solution_time(const study_grid *g, size_t row)
{
    return row == g->points ? g->until : g->from + direction_of(g) * (double)row * g->interval;
}

size_t solution_row(const study_grid *g, double t)
{
    double way = (t - g->from) * direction_of(g);
    if (solution_same_time(t, g->until) || !(way > 0)) return way > 0 ? g->points : 0;
    size_t row = (size_t)fmin(floor(way / g->interval), (double)g->intervals);
    if (row < g->intervals && solution_same_time(solution_time(g, row + 1), t)) row++;
    return row;
}

motus_status solution_near(study *s, const solution *r, const study_grid *g, double t, double *y, motus_error *err)
{
    size_t row = r->exact ? 0 : solution_row(g, t);
    if (!r->exact && row < g->points && fabs(solution_time(g, row + 1) - t) < fabs(t - solution_time(g, row))) row++;
    const double from = solution_time(g, row);
    memcpy(y, r->rows + row * s->numbers, s->numbers * sizeof *y);
    return solution_same_time(from, t) ? MOTUS_OK : solution_go(s, r, from, t, y, err);
}

motus_status solution_go(study *s, const solution *r, double from, double t, double *y, motus_error *err)
{
    const double way = fabs(t - from);
    const bool one = r->exact || r->tolerance > 0;
    const double step = one ? way : way / fmax(1, ceil(way / r->step * (1 - SOLUTION_SAME_TIME)));
    int64_t spent = 0;
    s->locate = !(r->tolerance > 0);
    s->tolerance = r->tolerance;
    const motus_status status = study_leg(s, r->method, step, from, t, y, &spent, err);
    s->locate = false;
    return status;
}

void solution_free(study *s, solution *r)
{
    give(s->allocator, r->rows);
    r->rows = NULL;
}
