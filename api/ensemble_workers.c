/* The threads of an ensemble that is not computed in lanes. See ensemble.h.
 *
 * Invariant: workers share nothing that changes but two counters, so which of them computes an item is of no consequence.
 */
#include "api/ensemble.h"

#include "api/choice.h"

#include "run/parallel.h"

#include <math.h>

/* ---- who works ---- */

static motus_status hire(motus_ensemble *e, int number, motus_error *err)
{
    worker *w = &e->workers[number];
    motus_system *s = e->system;
    if (w->e)
        return MOTUS_OK;
    if (number > 0) {
        motus_status status = motus_system_clone(e->system, &s, err);
        if (status == MOTUS_OK && s->model)
            status = vary_create(s->model, e->places, e->vary_count, true, true, &w->vary, err);
        if (status == MOTUS_OK && !system_sample_gyroscopic(s))
            status = fail(err, MOTUS_MEMORY, "no memory to examine the velocity term");
        const char *why;
        if (status == MOTUS_OK && e->machine == &machine_compiled)
            status = choice_compile(s, &e->chosen, true, false, &why, err);
        if (status != MOTUS_OK) {
            motus_system_destroy(s == e->system ? NULL : s);
            return status;
        }
    } else {
        w->vary = e->vary;
    }
    w->e = e;
    w->system = s;
    w->problem = e->machine == &machine_compiled ? &s->compiled_problem : &s->problem;
    w->number = number;
    w->piece = 1;
    return MOTUS_OK;
}

void ensemble_dismiss(motus_ensemble *e)
{
    for (int i = 1; e->workers && i < e->threads; i++)
        motus_system_destroy(e->workers[i].system);
    give(&e->allocator, e->workers);
    e->workers = NULL;
}

/* ---- work ---- */

typedef struct work_list {
    motus_ensemble *e;
    motus_status (*one)(worker *, size_t item, void *ctx);
    void *ctx;
} work_list;

static void take_item(void *ctx, size_t item, int thread)
{
    const work_list *list = ctx;
    worker *w = &list->e->workers[thread];
    if (w->status != MOTUS_OK || atomic_load(&list->e->stop))
        return;
    w->status = list->one(w, item, list->ctx);
    w->failed_at = item;
    if (w->status != MOTUS_OK)
        atomic_store(&list->e->stop, true);
}

motus_status ensemble_each(motus_ensemble *e, size_t items, motus_status (*one)(worker *, size_t item, void *ctx), void *ctx, motus_error *err)
{
    const int threads = items < (size_t)e->threads ? (int)items : e->threads;
    if (!e->workers && !(e->workers = take(&e->allocator, (size_t)e->threads, sizeof *e->workers)))
        return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    for (int i = 0; i < threads; i++) {
        motus_status status = hire(e, i, err);
        if (status != MOTUS_OK)
            return status;
        e->workers[i].status = MOTUS_OK;
        e->workers[i].why = motus_default_error();
    }
    atomic_store(&e->done, 0);
    atomic_store(&e->stop, false);
    work_list list = {e, one, ctx};
    parallel_for(threads, items, take_item, &list);
    const worker *first = NULL;
    for (int i = 0; i < threads; i++) {
        const worker *w = &e->workers[i];
        /* Those that stopped because another did have nothing to say. */
        if (w->status != MOTUS_OK && (!first || (first->status == MOTUS_CANCELLED) > (w->status == MOTUS_CANCELLED) ||
                                      ((first->status == MOTUS_CANCELLED) == (w->status == MOTUS_CANCELLED) && w->failed_at < first->failed_at)))
            first = w;
    }
    if (!first)
        return MOTUS_OK;
    if (first->status == MOTUS_CANCELLED)
        return fail(err, MOTUS_CANCELLED, "cancelled after %zu of %zu trajectories", atomic_load(&e->done), e->count);
    if (err)
        motus_struct_write(MOTUS_DEF_ERROR, &first->why, err);
    return first->status;
}

motus_status ensemble_advance(worker *w, engine *engine, int64_t n, int64_t steps, size_t count, motus_error *err)
{
    motus_ensemble *e = w->e;
    motus_status status = MOTUS_OK;
    while (steps > 0 && status == MOTUS_OK) {
        const int64_t piece = !e->progress || steps < w->piece ? steps : w->piece;
        const double began = e->progress ? run_now() : 0;
        status = e->machine->advance(engine, piece, err);
        n += piece;
        steps -= piece;
        if (!e->progress || status != MOTUS_OK)
            continue;
        const double took = run_now() - began;
        if (took < 0.005 && piece == w->piece && piece < INT64_MAX / 4)
            w->piece *= 2;
        else if (took > 0.02 && w->piece > 1)
            w->piece /= 2;
        /* Only the caller's own thread tells; whoever finds that enough is enough stops all. */
        const double done = (double)atomic_load(&e->done) + (double)count * (double)n / (double)e->timing.total;
        if (w->number == 0 && ensemble_watched(e, done / (double)e->count))
            atomic_store(&e->stop, true);
        if (atomic_load(&e->stop))
            status = MOTUS_CANCELLED;
    }
    return status;
}
