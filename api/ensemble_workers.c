/* The workers of an ensemble that is not computed in lanes. See ensemble.h.
 *
 * Invariant: workers share no data that changes but `done` and `stop`, so the result of an item does not depend on
 * which worker computes it.
 */
#include "api/symmetry.h"
#include "api/ensemble.h"

#include "api/choice.h"

#include "machine/parallel.h"

/* ---- workers ---- */

/* Between two pieces of work: the caller's own thread calls the progress hook; every thread tests `stop`. */
int ensemble_tell(void *ctx, double now)
{
    const worker *w = ctx;
    motus_ensemble *e = w->e;
    (void)now;
    const timing *t = &w->timing;
    const double part = t->until != t->t0 ? (stepper_time(w->stepper) - t->t0) / (t->until - t->t0) : 1;
    const double done = (double)atomic_load(&e->done) + (double)w->trajectories * part;
    if (w->number == 0 && ensemble_report(e, done / (double)e->count)) atomic_store(&e->stop, true);
    return atomic_load(&e->stop);
}

static motus_status prepare_worker(motus_ensemble *e, int number, motus_error *err)
{
    worker *w = &e->workers[number];
    motus_system *s = e->system;
    if (w->e) return MOTUS_OK;
    if (number > 0) {
        motus_status status = motus_system_clone(e->system, &s, err);
        if (status == MOTUS_OK && s->model)
            status = vary_create(s->model, e->places, e->vary_count, true, true, &w->vary, err);
        if (status == MOTUS_OK && !symmetry_gyroscopic(s))
            status = fail(err, MOTUS_MEMORY, "no memory to examine the velocity term");
        const char *why;
        w->machine = s->machine;
        if (status == MOTUS_OK && e->machine.body)
            status = choice_compile(s, &e->chosen, true, false, &w->machine, &why, err);
        if (status != MOTUS_OK) {
            motus_system_destroy(s == e->system ? NULL : s);
            return status;
        }
    } else {
        w->vary = e->vary;
        w->machine = e->machine;
    }
    w->e = e;
    w->system = s;
    w->number = number;
    w->pace = (pace){.seconds = 0.005, .tell = e->progress ? ensemble_tell : NULL, .ctx = w};
    return MOTUS_OK;
}

void ensemble_workers_destroy(motus_ensemble *e)
{
    for (int i = 0; e->workers && i < e->threads; i++) {
        ensemble_errors_end(&e->workers[i]);
        stepper_destroy(e->workers[i].stepper);
        if (i > 0) motus_system_destroy(e->workers[i].system);
    }
    give(&e->allocator, e->workers);
    e->workers = NULL;
}

/* ---- items ---- */

typedef struct item_list {
    motus_ensemble *e;
    motus_status (*one)(worker *, size_t item, void *ctx);
    void *ctx;
} item_list;

static void take_item(void *ctx, size_t item, int thread)
{
    const item_list *list = ctx;
    worker *w = &list->e->workers[thread];
    if (w->status != MOTUS_OK || atomic_load(&list->e->stop)) return;
    w->status = list->one(w, item, list->ctx);
    w->failed_at = item;
    if (w->status != MOTUS_OK) atomic_store(&list->e->stop, true);
}

motus_status ensemble_each(motus_ensemble *e, size_t items, motus_status (*one)(worker *, size_t item, void *ctx),
                           void *ctx, motus_error *err)
{
    const int threads = items < (size_t)e->threads ? (int)items : e->threads;
    if (!e->workers && !(e->workers = take(&e->allocator, (size_t)e->threads, sizeof *e->workers)))
        return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    for (int i = 0; i < threads; i++) {
        motus_status status = prepare_worker(e, i, err);
        if (status != MOTUS_OK) return status;
        e->workers[i].status = MOTUS_OK;
        e->workers[i].why = motus_default_error();
    }
    atomic_store(&e->done, 0);
    atomic_store(&e->stop, false);
    item_list list = {e, one, ctx};
    parallel_for(threads, items, take_item, &list);
    const worker *first = NULL;
    for (int i = 0; i < threads; i++) {
        const worker *w = &e->workers[i];
        /* An error comes before a cancellation, which may be its consequence. */
        if (w->status != MOTUS_OK &&
            (!first || (first->status == MOTUS_CANCELLED) > (w->status == MOTUS_CANCELLED) ||
             ((first->status == MOTUS_CANCELLED) == (w->status == MOTUS_CANCELLED) && w->failed_at < first->failed_at)))
            first = w;
    }
    if (!first) return MOTUS_OK;
    if (first->status == MOTUS_CANCELLED)
        return fail(err, MOTUS_CANCELLED, "cancelled after %zu of %zu trajectories", atomic_load(&e->done), e->count);
    if (err) motus_struct_write(MOTUS_DEF_ERROR, &first->why, err);
    return first->status;
}

motus_status ensemble_advance(worker *w, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    return pace_advance(&w->pace, w->stepper, limit, why, err);
}
