/* See truth.h.
 *
 * Two kinds of references are found. One is that of solution.h, whose steps have one size: exact, or found by halving.
 * The other is of adaptive methods, at the smallest tolerance: the two that are nearest to each other, of up to four of
 * high order; its error is the largest of three: the distance of the two, the distance of a run
 * from a start that is a rounding away, and the distance from the first reference, if their errors do not explain it.
 * The one with the smaller error is taken.
 *
 * Steps of one size spend most work where a close passage needs short steps, and rounding grows with their number; so
 * the adaptive methods know more digits of most motions. Where the force is not smooth they have no order, and the
 * first kind alone is taken, whose steps end where the force changes its formula.
 *
 * Invariant: a reference that is known has finite rows.
 */
#include "truth.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define TOLERANCE 1e-15 /* a smaller one is below rounding */
#define ORDER_LEAST 8
#define CANDIDATES 4
/* The bound on the work (study_work) of one run, as for a reference of fixed step. */
#define WORK 3e7
#define SHAKE 0x1p-53 /* of the largest values of the motion */
#define LOST 0.1      /* of the motion's size: with a larger error nothing is known */

static size_t kind_of(const study *s, size_t number) { return number < s->nx ? 0 : number < 2 * s->nx ? 1 : 2; }

/* Finds the largest number of each kind in one state. */
static void sizes_of(const study *s, const double *y, double size[TRUTH_KINDS])
{
    for (size_t k = 0; k < s->numbers; k++) size[kind_of(s, k)] = fmax(size[kind_of(s, k)], fabs(y[k]));
}

static truth_distance distance(const study *s, const double *p, const double *q, const double size[TRUTH_KINDS])
{
    truth_distance d = {0, 0};
    for (size_t k = 0; k < s->numbers; k++) {
        const double e = fabs(p[k] - q[k]), unit = size[kind_of(s, k)];
        d.absolute = study_larger(d.absolute, e);
        if (e != 0) d.relative = study_larger(d.relative, e / unit); /* NaN stays */
    }
    return d;
}

static void widen(truth_distance *d, truth_distance more)
{
    d->relative = study_larger(d->relative, more.relative);
    d->absolute = study_larger(d->absolute, more.absolute);
}

static const double *size_at(const truth *t, size_t row) { return t->size + row * TRUTH_KINDS; }

static void find_sizes(const study *s, truth *t, const double *rows)
{
    for (size_t r = 0; r <= t->grid.points; r++) {
        double *size = t->size + r * TRUTH_KINDS;
        for (size_t i = 0; i < TRUTH_KINDS; i++) size[i] = r ? (size - TRUTH_KINDS)[i] : 0;
        sizes_of(s, rows + r * s->numbers, size);
    }
}

/* Returns the largest distance of two tables, without the start. */
static truth_distance apart(const study *s, const truth *t, const double *p, const double *q)
{
    truth_distance most = {0, 0};
    for (size_t r = 1; r <= t->grid.points; r++)
        widen(&most, distance(s, p + r * s->numbers, q + r * s->numbers, size_at(t, r)));
    return most;
}

/* The reference of fixed step -------------------------------------------------------------------------------------- */

/* Returns the error of the reference of fixed step in the units of every row: one number serves for all numbers and
 * times; and adds what rounding of times and values does to a formula. */
static truth_distance error_of(const study *s, const truth *t)
{
    truth_distance most = {0, 0};
    double *way = t->room;
    memset(way, 0, s->numbers * sizeof *way);
    for (size_t r = 1; r <= t->grid.points; r++)
        for (size_t k = 0; k < s->numbers; k++) {
            const double *y = t->found.rows + r * s->numbers + k;
            way[k] += fabs(y[0] - *(y - s->numbers));
            const double rounding = DBL_EPSILON * (way[k] + fabs(y[0])),
                         e = fmax(rounding, fmin(t->found.error, t->found.scaled * s->scale[k]));
            const double unit = size_at(t, r)[kind_of(s, k)];
            if (unit > 0) widen(&most, (truth_distance){e / unit, e});
        }
    return most;
}

/* The adaptive reference ------------------------------------------------------------------------------------------- */

typedef struct candidate {
    const motus_method *card;
    double *rows; /* as the rows of a solution; NULL: the run failed */
} candidate;

/* Lists the adaptive methods of highest order that the motion admits. */
static size_t candidates(study *s, candidate *out)
{
    size_t count = 0;
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *m = motus_method_at(k);
        /* reversible steps control no error */
        if (!m->adaptive || m->reversible || m->order < ORDER_LEAST || !study_admits(s, m->name)) continue;
        size_t at = count;
        while (at > 0 && out[at - 1].card->order < m->order) at--;
        if (at >= CANDIDATES) continue;
        count = count < CANDIDATES ? count + 1 : count;
        memmove(out + at + 1, out + at, (count - 1 - at) * sizeof *out);
        out[at] = (candidate){.card = m};
    }
    return count;
}

/* Computes the rows from the state in the first one. *bad: the run failed, or cost too much. */
static motus_status integrate(study *s, const truth *t, const motus_method *m, double *rows, bool *bad)
{
    const double most = WORK / study_work(s, m, 0, 1), base = s->base, span = s->span;
    int64_t spent = 0;
    motus_status status = MOTUS_OK;
    motus_error ignored = motus_default_error();
    s->tolerance = TOLERANCE;
    for (size_t r = 0; r < t->grid.points && status == MOTUS_OK; r++) {
        double *next = rows + (r + 1) * s->numbers;
        memcpy(next, rows + r * s->numbers, s->numbers * sizeof *next);
        study_part(s, base + span * (double)r / TRUTH_TIMES, span / TRUTH_TIMES);
        s->limit = fmax(1, most - (double)spent);
        status = study_leg(s, m->name, NAN, solution_time(&t->grid, r), solution_time(&t->grid, r + 1), next, &spent,
                           &ignored);
    }
    s->limit = 0;
    study_part(s, base, span);
    *bad = status != MOTUS_OK;
    return study_fatal(status) ? study_tell(s, status, &ignored) : MOTUS_OK;
}

/* Runs `best` from a start that is a rounding away. */
static motus_status shake(study *s, const truth *t, const candidate *best, double *room, truth_distance *d)
{
    bool bad;
    for (size_t k = 0; k < s->numbers; k++) {
        double most = 0;
        for (size_t r = 0; r <= t->grid.points; r++) most = fmax(most, fabs(best->rows[r * s->numbers + k]));
        room[k] = s->start[k] + (k % 2 ? -1 : 1) * SHAKE * most;
    }
    const motus_status status = integrate(s, t, best->card, room, &bad);
    if (status == MOTUS_OK) *d = bad ? (truth_distance){NAN, NAN} : apart(s, t, room, best->rows);
    return status;
}

/* Takes the two rows nearest to each other as the solution, if their error is smaller. */
static motus_status judge(study *s, truth *t, const candidate *list, size_t count, double *room)
{
    const candidate *best = NULL, *other = NULL;
    truth_distance error = {INFINITY, INFINITY}, shaken;
    for (size_t i = 0; i < count; i++) {
        if (!list[i].rows) continue;
        find_sizes(s, t, list[i].rows);
        for (size_t j = i + 1; j < count; j++) {
            if (!list[j].rows) continue;
            const truth_distance d = apart(s, t, list[i].rows, list[j].rows);
            if (!(d.relative < error.relative)) continue;
            error = d;
            best = &list[i];
            other = &list[j];
        }
    }
    if (!best) return MOTUS_OK;
    find_sizes(s, t, best->rows);
    const motus_status status = shake(s, t, best, room, &shaken);
    if (status != MOTUS_OK) return status;
    widen(&error, shaken);
    widen(&error, (truth_distance){2 * DBL_EPSILON, 2 * DBL_EPSILON * s->magnitude});
    if (t->found.known) {
        const truth_distance d = apart(s, t, t->found.rows, best->rows);
        if (!(d.relative <= t->relative + error.relative)) widen(&error, d);
    }
    if (!(error.relative < (t->found.known ? t->relative : LOST))) {
        if (t->found.known) find_sizes(s, t, t->found.rows);
        return MOTUS_OK;
    }
    solution *r = &t->found;
    r->known = true;
    r->order = best->card->order;
    r->step = 0;
    r->tolerance = TOLERANCE;
    r->error = error.absolute;
    snprintf(r->method, sizeof r->method, "%s", best->card->name);
    snprintf(r->text, sizeof r->text, "%s with tolerance %g, judged by %s", best->card->name, TOLERANCE,
             other->card->name);
    memcpy(r->rows, best->rows, (t->grid.points + 1) * s->numbers * sizeof(double));
    study_scale(s, r->rows + s->numbers, t->grid.points);
    t->relative = error.relative;
    t->absolute = error.absolute;
    return MOTUS_OK;
}

static motus_status sharpen(study *s, truth *t)
{
    candidate list[CANDIDATES + 1];
    const size_t count = candidates(s, list), table = (t->grid.points + 1) * s->numbers;
    if (study_broken(s) != MOTUS_OK || count < 2) return study_broken(s);
    double *room = take(s->allocator, (count + 1) * table, sizeof(double));
    if (!room)
        return fail(s->err, MOTUS_MEMORY, "out of memory for %zu states of %zu numbers", t->grid.points, s->numbers);
    const double base = s->base, span = s->span / (double)(count + 1);
    motus_status status = MOTUS_OK;
    for (size_t i = 0; i < count && status == MOTUS_OK; i++) {
        double *rows = room + i * table;
        bool bad;
        memcpy(rows, s->start, s->numbers * sizeof *rows);
        study_part(s, base + span * (double)i, span);
        status = integrate(s, t, list[i].card, rows, &bad);
        if (!bad) list[i].rows = rows;
    }
    study_part(s, base + span * (double)count, span);
    if (status == MOTUS_OK) status = judge(s, t, list, count, room + count * table);
    study_part(s, base, span * (double)(count + 1));
    give(s->allocator, room);
    return status;
}

/* What the others use ---------------------------------------------------------------------------------------------- */

motus_status truth_find(study *s, truth *t)
{
    *t = (truth){.relative = NAN, .absolute = NAN};
    t->grid = (study_grid){.from = s->from,
                           .until = s->until,
                           .interval = fabs(s->until - s->from) / TRUTH_TIMES,
                           .intervals = TRUTH_TIMES,
                           .points = TRUTH_TIMES};
    t->size = take(s->allocator, (TRUTH_TIMES + 1) * TRUTH_KINDS, sizeof *t->size);
    t->room = take(s->allocator, s->numbers, sizeof *t->room);
    if (!t->size || !t->room) return fail(s->err, MOTUS_MEMORY, "out of memory for a state of %zu numbers", s->numbers);
    motus_analysis analysis = motus_default_analysis();
    study_note(s, motus_analysis_of(s->system, &analysis));
    if (study_broken(s) != MOTUS_OK) return study_broken(s);
    const double base = s->base, span = s->span;
    study_part(s, base, span / 2);
    motus_status status = solution_find(s, &t->grid, 0, 0, &t->found);
    if (status != MOTUS_OK) return status;
    if (t->found.known) {
        find_sizes(s, t, t->found.rows);
        const truth_distance error = error_of(s, t);
        t->relative = error.relative;
        t->absolute = error.absolute;
    }
    study_part(s, base + span / 2, span / 2);
    if (!t->found.exact && analysis.smooth) status = sharpen(s, t);
    study_part(s, base, span);
    return status;
}

motus_status truth_measure(study *s, truth *t, double time, const double *y, truth_distance *d, motus_error *err)
{
    double size[TRUTH_KINDS];
    memcpy(size, size_at(t, solution_row(&t->grid, time)), sizeof size);
    *d = (truth_distance){NAN, NAN};
    const motus_status status = solution_near(s, &t->found, &t->grid, time, t->room, err);
    if (status != MOTUS_OK) return status;
    sizes_of(s, t->room, size);
    *d = distance(s, y, t->room, size);
    return MOTUS_OK;
}

void truth_free(study *s, truth *t)
{
    solution_free(s, &t->found);
    give(s->allocator, t->size);
    give(s->allocator, t->room);
    t->size = t->room = NULL;
}
