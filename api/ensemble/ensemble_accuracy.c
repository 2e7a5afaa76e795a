/* An ensemble with an accuracy: every trajectory has its own tolerance, small enough that its bars are within the
 * accuracy.
 *
 * The ensemble itself computes all trajectories with one first tolerance. Those whose bars are too large are computed
 * again with smaller ones, chosen as for runs (search.h): one ensemble for each tolerance that is tried. Tolerances are
 * rounded, so that there are few.
 *
 * Invariant: the tolerance of a trajectory follows from its own bars alone, so its numbers do not depend on other
 * trajectories, calls, lanes or threads.
 */
#include "api/request/choice.h"
#include "api/ensemble/ensemble.h"
#include "api/search/goal.h"

#include <math.h>
#include <stdio.h>

typedef struct ensemble_other {
    struct ensemble_other *next;
    double tolerance;
    motus_ensemble *ensemble;
} other;

static int tell(void *context, double fraction)
{
    const ensemble_goal *g = context;
    return g->progress(g->context, g->from + fraction * g->size);
}

/* ---- the definition ---- */

/* Gives a request a tolerance in place of its accuracy. */
static motus_status ask(motus_system *s, request *q, double tolerance, motus_error *err)
{
    q->set.accuracy = NAN;
    q->set.tolerance = tolerance, q->set.tolerance_said = MOTUS_SAID_DEFAULT;
    return request_choose(s, q, err);
}

motus_status ensemble_accuracy_begin(motus_system *s, motus_ensemble_def *d, request *q, ensemble_goal **out,
                                     motus_error *err)
{
    const double wanted = q->set.accuracy;
    *out = NULL;
    if (isnan(wanted)) return MOTUS_OK;
    bool automatic, compiled;
    motus_status status = choice_machine(d->machine, &automatic, &compiled, err);
    if (status == MOTUS_OK) status = ask(s, q, search_by_tolerance(wanted, q->set.absolute).size, err);
    if (status != MOTUS_OK) return status;
    ensemble_goal *g = *out = take(&s->allocator, 1, sizeof *g);
    if (!g) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    *g = (ensemble_goal){.allocator = s->allocator,
                         .wanted = wanted,
                         .told = d->error != MOTUS_BARS_NONE,
                         .machine = automatic  ? "auto"
                                    : compiled ? "compiled"
                                               : "interpreter",
                         .progress = d->progress,
                         .context = d->context};
    if (!g->told) d->error = MOTUS_BARS_CHEAP;
    if (d->progress) d->progress = tell, d->context = g;
    g->def = *d;
    g->request = *q;
    return MOTUS_OK;
}

static void forget_others(ensemble_goal *g)
{
    for (other *o = g->others, *next; o; o = next) {
        next = o->next;
        ensemble_free(o->ensemble);
        give(&g->allocator, o);
    }
    g->others = NULL;
}

void ensemble_accuracy_end(ensemble_goal *g)
{
    if (!g) return;
    const motus_allocator a = g->allocator;
    forget_others(g);
    give(&a, g);
}

/* ---- a call ---- */

/* A trajectory whose bars are still too large. */
typedef struct open_one {
    size_t number;
    search search;
    double best; /* its smallest bar */
} open_one;

typedef struct attempt {
    motus_ensemble *e;
    ensemble_goal *goal;
    const double *const *values;
    double *const *results, *const *errors, *stopped, *reached; /* of the best trial of each trajectory */
    open_one *open;
    size_t count; /* open trajectories */
    size_t missed, first_missed;
} attempt;

static void miss(attempt *a, size_t number)
{
    if (!a->missed || number < a->first_missed) a->first_missed = number;
    a->missed++;
}

static void list_open(attempt *a, size_t count)
{
    const ensemble_goal *g = a->goal;
    search s = search_by_tolerance(g->wanted, g->request.set.absolute);
    search_set(&s, tally_tolerance(&a->e->chosen)); /* reversible rows take a smaller tolerance */
    s.few = true;
    for (size_t k = 0; k < count; k++) {
        if (!isnan(a->stopped[k]) || a->reached[k] <= g->wanted) continue;
        open_one o = {.number = k, .search = s, .best = a->reached[k]};
        if (!isnan(o.best) && search_next(&o.search, o.best, 1))
            a->open[a->count++] = o;
        else
            miss(a, k);
    }
}

static motus_status find_other(attempt *a, double tolerance, motus_ensemble **out, motus_error *err)
{
    ensemble_goal *g = a->goal;
    for (other *o = g->others; o; o = o->next)
        if (o->tolerance == tolerance) return *out = o->ensemble, MOTUS_OK;
    other *o = take(&g->allocator, 1, sizeof *o);
    if (!o) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    const motus_ensemble *e = a->e;
    motus_ensemble_def def = g->def;
    request q = g->request;
    def.machine = e->awaits ? "interpreter" : g->machine; /* a compiler is already at work for the text */
    def.records = e->records, def.record_count = e->record_count;
    def.event_columns = e->event_columns;
    *o = (other){.next = g->others, .tolerance = tolerance};
    motus_status status = ask(e->system, &q, tolerance, err);
    if (status == MOTUS_OK) status = ensemble_make(e->system, &def, &q, NULL, e, &o->ensemble, err);
    if (status != MOTUS_OK) {
        give(&g->allocator, o);
        return status;
    }
    g->others = o;
    *out = o->ensemble;
    return MOTUS_OK;
}

/* Takes over trial i if it is the best of its trajectory. Returns whether the trajectory is to be tried again. */
static bool take_over(attempt *a, const places *tried, motus_ensemble *from, size_t i, open_one *o)
{
    const bool failed = !isnan(tried->stopped[i]);
    const size_t records = a->e->record_count;
    const double bar = failed ? INFINITY : tried->results[records - 1][i];
    if (bar <= o->best) {
        for (size_t r = 0; r < records; r++) {
            a->results[r][o->number] = tried->results[r][i];
            a->errors[r][o->number] = tried->errors[r][i];
        }
        a->stopped[o->number] = tried->stopped[i];
        ensemble_outcome_move(a->e, o->number, from, i);
        o->best = bar;
    }
    if (bar <= a->goal->wanted) return false;
    if (!isnan(bar) && search_next(&o->search, bar, failed ? 0 : 1)) return true;
    miss(a, o->number);
    return false;
}

/* Computes the open trajectories whose next tolerance is this one, side by side. */
static motus_status try(attempt *a, double tolerance, motus_error *err)
{
    const motus_allocator *allocator = &a->goal->allocator;
    const size_t given = a->e->given, records = a->e->record_count, arrays = given + 2 * records + 1;
    size_t count = 0, kept = 0, n = 0;
    motus_ensemble *e = NULL;
    for (size_t i = 0; i < a->count; i++) count += a->open[i].search.size == tolerance;
    motus_status status = find_other(a, tolerance, &e, err);
    if (status != MOTUS_OK) return status;
    double **at = take(allocator, arrays, sizeof *at + count * sizeof(double)); /* the arrays, and their numbers */
    if (!at) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    for (size_t k = 0; k < arrays; k++) at[k] = (double *)(void *)(at + arrays) + k * count;
    for (size_t i = 0; i < a->count; i++) {
        if (a->open[i].search.size != tolerance) continue;
        for (size_t k = 0; k < given; k++) at[k][n] = a->values[k][a->open[i].number];
        n++;
    }
    const places tried = {.results = at + given, .errors = at + given + records, .stopped = at[arrays - 1]};
    status = ensemble_run_all(e, count, (const double *const *)at, tried, err);
    n = 0;
    for (size_t i = 0; i < a->count && status == MOTUS_OK; i++) {
        const bool other_size = a->open[i].search.size != tolerance;
        if (other_size || take_over(a, &tried, e, n++, &a->open[i])) a->open[kept++] = a->open[i];
    }
    if (status == MOTUS_OK) a->count = kept;
    give(allocator, (void *)at);
    return status;
}

static motus_status say_missed(const attempt *a, size_t count, motus_error *err)
{
    char wanted[DECIMAL_MAX], which[128];
    const size_t k = a->first_missed;
    const double best = a->reached[k];
    decimal(a->goal->wanted, wanted);
    if (a->missed == 1)
        snprintf(which, sizeof which, "trajectory %zu", k);
    else
        snprintf(which, sizeof which, "%zu of %zu trajectories, the first of them %zu", a->missed, count, k);
    if (isnan(best))
        fail(err, MOTUS_ACCURACY, "no accuracy can be promised of %s: there is no companion", which);
    else if (isinf(best))
        fail(err, MOTUS_ACCURACY,
             "the accuracy %s is not reached by %s: no digit of it is known to be significant at the end", wanted,
             which);
    else
        fail(err, MOTUS_ACCURACY, "the accuracy %s is not reached by %s: its trials reached %.1e%s at best", wanted,
             which, best, a->goal->request.set.absolute ? "" : " of the motion's size");
    if (isinf(best))
        hint(err, "errors grow with the time: end earlier, with a smaller `until` of the definition");
    else
        hint(err, "the numbers are there, with the errors that they have; allow a larger error");
    return MOTUS_ACCURACY;
}

static motus_status search_all(attempt *a, size_t count, const places *p, motus_error *err)
{
    ensemble_goal *g = a->goal;
    g->from = 0;
    g->size = 0.5;
    motus_status status = ensemble_run_all(a->e, count, a->values, *p, err);
    if (status != MOTUS_OK || !count) return status;
    const double began = pace_now();
    list_open(a, count);
    while (status == MOTUS_OK && a->count) {
        double largest = 0;
        for (size_t i = 0; i < a->count; i++) largest = fmax(largest, a->open[i].search.size);
        g->from += g->size;
        g->size = (1 - g->from) / 2;
        status = try(a, largest, err);
    }
    if (a->e->awaits) forget_others(g); /* in the next call they may be compiled */
    a->e->seconds += pace_now() - began;
    return status == MOTUS_OK && a->missed ? say_missed(a, count, err) : status;
}

motus_status ensemble_accuracy_run(motus_ensemble *e, size_t count, const double *const *values, const places *given,
                                   motus_error *err)
{
    ensemble_goal *g = e->goal;
    const size_t records = e->record_count;
    const motus_allocator *allocator = &g->allocator;
    if (!given->results) return fail(err, MOTUS_ARGUMENT, "motus_ensemble_run needs room for results");
    double **at = take(allocator, 2 * records, sizeof *at), **errors = at + records;
    double *room = take(allocator, (records + 2) * count + 1, sizeof *room);
    open_one *open = take(allocator, count + 1, sizeof *open);
    motus_status status = MOTUS_OK;
    if (!at || !room || !open) {
        status = fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    } else {
        for (size_t r = 0; r < records; r++) {
            const bool own = r + 1 == records;
            at[r] = own ? room + records * count : given->results[r];
            errors[r] = own || !given->errors ? room + r * count : given->errors[r];
        }
        attempt a = {.e = e, .goal = g, .values = values, .results = at, .errors = errors, .open = open};
        a.reached = at[records - 1];
        a.stopped = given->stopped ? given->stopped : room + (records + 1) * count;
        status = search_all(&a, count, &(places){.results = at, .errors = errors, .stopped = a.stopped}, err);
    }
    give(allocator, (void *)at);
    give(allocator, room);
    give(allocator, open);
    return status;
}
