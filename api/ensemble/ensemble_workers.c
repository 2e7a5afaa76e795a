/* The workers of an ensemble that lanes do not compute. See ensemble.h.
 *
 * Invariant: workers share no data that changes but atomic flags and counts, so the result of an item does not depend
 * on which worker computes it.
 */
#include "api/request/choice.h"
#include "api/ensemble/ensemble.h"
#include "api/system/system.h"

#include "machine/parallel.h"

#include <math.h>

/* ---- progress ---- */

int ensemble_report(void *context, double fraction)
{
    motus_ensemble *e = context;
    const double t = e->progress ? pace_now() : 0;
    if (!e->progress || t - e->reported < 0.01) return 0;
    e->reported = t;
    if (fraction > e->fraction) e->fraction = fraction; /* it never falls, though trajectories may begin anew */
    return e->progress(e->context, e->fraction);
}

bool ensemble_look(motus_ensemble *e)
{
    if (e->awaits == AWAITS_LANES) {
        const bool there = lanes_look(e->lanes);
        return (!e->half_lanes || lanes_look(e->half_lanes)) && there;
    }
    if (e->awaits == AWAITS_NOTHING || e->found.name || e->missing) return true;
    compiled_state state;
    motus_error ignored = motus_default_error();
    const char *why = NULL;
    const motus_status status = choice_look(e->system, &e->chosen, &state, &e->found, &why, &ignored);
    if (status == MOTUS_OK && state == COMPILED_WAIT) return false;
    if (status != MOTUS_OK || state == COMPILED_FAILED) {
        e->missing = why ? why : "there is no memory for the compiled model";
        e->found.name = NULL;
    }
    return true;
}

/* Lets a compiler go first while its object is awaited, and looks whether the object is there. */
static void rest(worker *w)
{
    motus_ensemble *e = w->e;
    if (!e->awaits || e->exactly) return;
    if (w->number == 0 && ensemble_look(e)) atomic_store(&e->over, true);
    if (!atomic_load(&e->over)) beside_rest(&w->beside);
}

/* Calls the progress hook from the caller's own thread, and tests `stop` in every thread. */
int ensemble_tell(void *ctx, double now)
{
    worker *w = ctx;
    motus_ensemble *e = w->e;
    (void)now;
    const timing *t = &w->timing;
    const double part = t->until != t->t0 ? (stepper_time(w->stepper) - t->t0) / (t->until - t->t0) : 1;
    const double done = (double)atomic_load(&e->done) + (double)w->trajectories * part;
    if (w->number == 0 && ensemble_report(e, done / (double)e->count)) atomic_store(&e->stop, true);
    rest(w);
    return atomic_load(&e->stop) || atomic_load(&e->over);
}

/* ---- workers ---- */

motus_status ensemble_worker_prepare(motus_ensemble *e, worker *w, int number, motus_error *err)
{
    motus_system *s = e->system;
    if (w->e) return MOTUS_OK;
    if (number > 0) {
        motus_status status = motus_system_clone(e->system, &s, err);
        if (status == MOTUS_OK && s->model)
            status = vary_create(s->model, e->places, e->vary_count, true, true, &w->vary, err);
        if (status == MOTUS_OK && !symmetry_gyroscopic(s))
            status = fail(err, MOTUS_MEMORY, "no memory to examine the velocity term");
        const char *why;
        if (status == MOTUS_OK) w->machine = s->machine;
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
    w->diagnosed = (diagnosed){s, NULL, run_leads};
    w->number = number;
    w->pace = (pace){.seconds = 0.005, .tell = e->progress || e->awaits ? ensemble_tell : NULL, .ctx = w};
    return MOTUS_OK;
}

void ensemble_worker_end_run(worker *w)
{
    if (!w->run) return;
    w->run->stepper = NULL; /* stepper and events are the worker's */
    w->run->events = NULL;
    run_destroy(w->run);
    w->run = NULL;
    w->half_vary = w->home_vary = NULL;
    motus_system_destroy(w->home);
    w->home = NULL;
}

motus_status ensemble_done(worker *w, size_t count)
{
    motus_ensemble *e = w->e;
    atomic_fetch_add(&e->done, count);
    if (w->number || !ensemble_report(e, (double)atomic_load(&e->done) / (double)e->count)) return MOTUS_OK;
    atomic_store(&e->stop, true);
    return MOTUS_CANCELLED;
}

bool ensemble_stopped(motus_status status, const motus_error *why)
{
    return status == MOTUS_DIVERGED || status == MOTUS_SOLVE || status == MOTUS_STEPS || status == MOTUS_EVENTS ||
           (status == MOTUS_CALLBACK && why->returned > 0);
}

motus_status ensemble_timing(const motus_ensemble *e, const places *p, size_t k, timing *t, motus_error *err)
{
    *t = e->timing;
    if (p->until && isnan(p->until[k])) return fail(err, MOTUS_ARGUMENT, "the end is not a number");
    return p->until ? run_timing(&e->chosen, e->step, p->until[k], e->system->start, t, err) : MOTUS_OK;
}

void ensemble_number_calls(motus_system *s, size_t k, size_t count)
{
    if (s->model || !s->callback.block) return;
    s->calling.first = k;
    s->calling.count = count;
}

void ensemble_workers_destroy(motus_ensemble *e)
{
    for (int i = 0; e->workers && i < e->threads; i++) {
        ensemble_worker_end_run(&e->workers[i]);
        stepper_destroy(e->workers[i].stepper);
        events_destroy(e->workers[i].events);
        if (i > 0) motus_system_destroy(e->workers[i].system);
    }
    give(&e->allocator, e->workers);
    e->workers = NULL;
}

/* ---- items ---- */

typedef struct item_list {
    motus_ensemble *e;
    size_t first;
    motus_status (*one)(worker *, size_t item, void *ctx);
    void *ctx;
} item_list;

/* Notes the first item that is left. Items are taken in order, so all before it are done. */
static void leave(motus_ensemble *e, size_t item)
{
    size_t left = atomic_load(&e->left);
    while (item < left && !atomic_compare_exchange_weak(&e->left, &left, item)) continue;
}

static void take_item(void *ctx, size_t number, int thread)
{
    const item_list *list = ctx;
    motus_ensemble *e = list->e;
    worker *w = &e->workers[thread];
    const size_t item = list->first + number;
    if (w->status != MOTUS_OK || atomic_load(&e->stop)) return;
    rest(w);
    if (atomic_load(&e->over) || (e->exactly && item + 1 >= e->exactly)) {
        leave(e, item);
        return;
    }
    w->status = list->one(w, item, list->ctx);
    w->failed_at = item;
    if (w->status == MOTUS_CANCELLED && atomic_load(&e->over) && !atomic_load(&e->stop)) {
        leave(e, item);
        w->status = MOTUS_OK;
    }
    if (w->status != MOTUS_OK) atomic_store(&e->stop, true);
}

static motus_status prepare(motus_ensemble *e, int threads, motus_error *err)
{
    if (!e->workers && !(e->workers = take(&e->allocator, (size_t)e->threads, sizeof *e->workers)))
        return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    for (int i = 0; i < threads; i++) {
        motus_status status = ensemble_worker_prepare(e, &e->workers[i], i, err);
        if (status != MOTUS_OK) return status;
        e->workers[i].status = MOTUS_OK;
        e->workers[i].why = motus_default_error();
    }
    return MOTUS_OK;
}

/* Returns the status of the workers, each of which has stopped at its first item that failed. */
static motus_status judge(const motus_ensemble *e, int threads, motus_error *err)
{
    const worker *failed = NULL;
    for (int i = 0; i < threads; i++) {
        const worker *w = &e->workers[i];
        /* An error goes before a cancellation, which may follow from it. */
        if (w->status != MOTUS_OK && (!failed || (failed->status == MOTUS_CANCELLED) > (w->status == MOTUS_CANCELLED) ||
                                      ((failed->status == MOTUS_CANCELLED) == (w->status == MOTUS_CANCELLED) &&
                                       w->failed_at < failed->failed_at)))
            failed = w;
    }
    if (!failed) return MOTUS_OK;
    if (failed->status == MOTUS_CANCELLED)
        return fail(err, MOTUS_CANCELLED, "cancelled after %zu of %zu trajectories", atomic_load(&e->done), e->count);
    if (err) motus_struct_write(MOTUS_DEF_ERROR, &failed->why, err);
    return failed->status;
}

motus_status ensemble_each(motus_ensemble *e, size_t first, size_t items,
                           motus_status (*one)(worker *, size_t item, void *ctx), void *ctx, motus_error *err)
{
    const bool replaces = e->system->model && e->vary_count; /* trajectories overwrite the model's own numbers */
    double *own = replaces ? set_aside(e->system) : NULL;
    if (replaces && !own) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    int threads = items < (size_t)e->threads ? (int)items : e->threads;
    /* One processor is for the compiler that is awaited, since its object computes many times as fast. */
    if (e->awaits && threads > 1 && threads >= parallel_processors()) threads = parallel_processors() - 1;
    if (threads < 1 || e->system->allocator.allocate) threads = 1; /* one thread alone calls the hooks */
    atomic_store(&e->done, first);
    atomic_store(&e->stop, false);
    atomic_store(&e->over, false);
    atomic_store(&e->left, SIZE_MAX);
    motus_status status = prepare(e, threads, err);
    if (status == MOTUS_OK) {
        parallel_for(threads, items, take_item, &(item_list){e, first, one, ctx});
        status = judge(e, threads, err);
    }
    if (replaces) {
        set_back(e->system, own);
        e->system->judged_gyroscopic = false;
    }
    give(&e->allocator, own);
    return status;
}
