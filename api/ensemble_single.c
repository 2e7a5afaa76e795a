/* One trajectory after the other: what every method and every machine can do. See ensemble.h.
 *
 * Invariant: a trajectory is what motus_run would compute with these values; it is looked at where lanes would look. Afterwards the system is
 * what it was: its own numbers are back.
 */
#include "api/ensemble.h"

#include "run/reduction.h"

#include <math.h>
#include <string.h>

typedef struct single {
    motus_ensemble *e;
    double *x, *v, *kept, *now;
    size_t *columns;
    int64_t looks;
    engine *engine;
    size_t done, count;              /* trajectories */
    int64_t piece;                   /* steps between two looks at the clock */
} single;

static motus_status look(single *s, double t, motus_error *err)
{
    motus_ensemble *e = s->e;
    motus_status status = e->machine->sync(s->engine, s->x, s->v, NULL, err);
    if (status == MOTUS_OK)
        status = system_values(e->system, t, s->x, s->v, s->columns, e->record_count, s->now, err);
    for (size_t r = 0; r < e->record_count && status == MOTUS_OK; r++)
        if (s->looks == 0)
            reduce_first(s->kept + r * REDUCE_KEPT, s->now[r], t);
        else
            reduce_next(s->kept + r * REDUCE_KEPT, (int)e->records[r].how, s->now[r], t);
    s->looks++;
    return status;
}

/* A model's own numbers, which trajectories replace by theirs. */
static size_t numbers_kept(const motus_ensemble *e)
{
    const model *m = e->system->model;
    return m && e->vary_count ? m->pool_count + m->nx + m->nv : 0;
}

static void keep_numbers(const motus_ensemble *e, double *room)
{
    const model *m = e->system->model;
    memcpy(room, m->pool, m->pool_count * sizeof *room);
    memcpy(room + m->pool_count, m->x0, m->nx * sizeof *room);
    memcpy(room + m->pool_count + m->nx, m->v0, m->nv * sizeof *room);
}

/* What is bound a second time needs no memory, so this does not fail. */
static void put_back(motus_ensemble *e, const double *room)
{
    model *m = e->system->model;
    memcpy(m->pool, room, m->pool_count * sizeof *room);
    interpreter_rebind(e->system->interpreter);
    compiled_rebind(e->system->compiled);
    memcpy(m->x0, room + m->pool_count, m->nx * sizeof *room);
    memcpy(m->v0, room + m->pool_count + m->nx, m->nv * sizeof *room);
}

/* The values of trajectory k, and the state that follows. */
static motus_status start(single *s, const double *const *values, size_t k, motus_error *err)
{
    motus_ensemble *e = s->e;
    motus_system *y = e->system;
    for (size_t i = 0; i < e->vary_count; i++)
        s->now[i] = values[i][k];
    if (y->model) {
        if (e->vary_count && (!vary_apply(e->vary, s->now) || !interpreter_rebind(y->interpreter)))
            return fail(err, MOTUS_MEMORY, "no memory for a trajectory");
        if (e->vary_count)
            compiled_rebind(y->compiled);
    }
    if (y->problem.nx)
        memcpy(s->x, y->x0, y->problem.nx * sizeof(double));
    memcpy(s->v, y->v0, y->problem.nv * sizeof(double));
    for (size_t i = 0; i < e->vary_count && !y->model; i++)
        *(e->places[i] < y->problem.nx ? &s->x[e->places[i]] : &s->v[e->places[i] - y->problem.nx]) = s->now[i];
    for (size_t i = 0; i < y->problem.nv; i++)
        if (!isfinite(s->v[i]) || (i < y->problem.nx && !isfinite(s->x[i]))) {
            fail(err, MOTUS_DIVERGED, "the initial state is not finite");
            if (err)
                err->time = e->timing.t0;
            return MOTUS_DIVERGED;
        }
    return MOTUS_OK;
}

static motus_status open(single *s, double t, double h, motus_error *err)
{
    if (s->engine)
        s->e->machine->close(s->engine);
    s->engine = NULL;
    return s->e->machine->open(s->e->problem, &s->e->chosen, t, h, s->x, s->v, &s->e->allocator, &s->engine, err);
}

/* `steps` from step n on; where somebody watches, in pieces of some milliseconds. */
static motus_status advance(single *s, int64_t n, int64_t steps, motus_error *err)
{
    motus_ensemble *e = s->e;
    motus_status status = MOTUS_OK;
    while (steps > 0 && status == MOTUS_OK) {
        const int64_t piece = !e->progress || steps < s->piece ? steps : s->piece;
        const double began = e->progress ? ensemble_now() : 0;
        status = e->machine->advance(s->engine, piece, err);
        n += piece;
        steps -= piece;
        if (!e->progress || status != MOTUS_OK)
            continue;
        const double took = ensemble_now() - began;
        if (took < 0.005 && piece == s->piece && piece < INT64_MAX / 4)
            s->piece *= 2;
        else if (took > 0.02 && s->piece > 1)
            s->piece /= 2;
        if (ensemble_watched(e, ((double)s->done + (double)n / (double)e->timing.total) / (double)s->count))
            status = fail(err, MOTUS_CANCELLED, "cancelled in trajectory %zu of %zu", s->done + 1, s->count);
    }
    return status;
}

static motus_status whole_steps(single *s, bool looks, motus_error *err)
{
    const motus_ensemble *e = s->e;
    const timing *t = &e->timing;
    motus_status status = looks && t->total > 0 ? look(s, t->t0, err) : MOTUS_OK;
    for (int64_t n = 0; n < t->whole && status == MOTUS_OK;) {
        int64_t some = looks && e->every < t->whole - n ? e->every : t->whole - n;
        status = advance(s, n, some, err);
        n += some;
        if (status == MOTUS_OK && looks && n % e->every == 0 && (n < t->whole || t->last != 0))
            status = look(s, t->t0 + (double)n * t->h, err);
    }
    return status;
}

static motus_status trajectory(single *s, const double *const *values, size_t k, bool looks, motus_error *err)
{
    const timing *t = &s->e->timing;
    s->looks = 0;
    motus_status status = start(s, values, k, err);
    if (status == MOTUS_OK)
        status = open(s, t->t0, t->h, err);
    if (status == MOTUS_OK)
        status = whole_steps(s, looks, err);
    if (status == MOTUS_OK && t->last != 0) {
        status = s->e->machine->sync(s->engine, s->x, s->v, NULL, err);
        if (status == MOTUS_OK)
            status = open(s, t->t0 + (double)t->whole * t->h, t->last, err);
        if (status == MOTUS_OK)
            status = s->e->machine->advance(s->engine, 1, err);
    }
    return status == MOTUS_OK ? look(s, t->until, err) : status;
}

motus_status ensemble_singly(motus_ensemble *e, size_t count, const double *const *values, double *const *results, double *stopped, motus_error *err)
{
    const motus_system *y = e->system;
    const size_t nx = y->problem.nx + 1, nv = y->problem.nv + 1, records = e->record_count + 1, room = records > e->vary_count ? records : e->vary_count;
    const size_t kept = numbers_kept(e);
    double *memory = take(&e->allocator, nx + nv + records * REDUCE_KEPT + room + records + kept, sizeof(double));
    if (!memory)
        return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    single s = {.e = e, .count = count, .piece = 1, .x = memory, .v = memory + nx, .kept = memory + nx + nv, .now = memory + nx + nv + records * REDUCE_KEPT};
    s.columns = (size_t *)(void *)(s.now + room);
    double *own = s.now + room + records;
    if (kept)
        keep_numbers(e, own);
    _Static_assert(sizeof(size_t) <= sizeof(double), "columns lie where doubles would");
    bool looks = false;
    for (size_t r = 0; r < e->record_count; r++) {
        s.columns[r] = e->records[r].column;
        looks |= e->records[r].how != MOTUS_FINAL;
    }
    motus_status status = MOTUS_OK;
    motus_error why = motus_default_error();
    for (size_t k = 0; k < count && status == MOTUS_OK; k++) {
        s.done = k;
        motus_status one = trajectory(&s, values, k, looks, &why);
        const bool lost = one == MOTUS_DIVERGED || one == MOTUS_SOLVE;
        if (one != MOTUS_OK && !lost) {
            if (err)
                *err = why;
            status = one;
            break;
        }
        for (size_t r = 0; r < e->record_count; r++)
            results[r][k] = lost ? NAN : reduce_last(s.kept + r * REDUCE_KEPT, (int)e->records[r].how, (double)s.looks);
        if (stopped)
            stopped[k] = lost ? why.time : NAN;
        if (ensemble_watched(e, (double)(k + 1) / (double)count))
            status = fail(err, MOTUS_CANCELLED, "cancelled after %zu of %zu trajectories", k + 1, count);
    }
    if (s.engine)
        e->machine->close(s.engine);
    if (kept)
        put_back(e, own);
    give(&e->allocator, memory);
    return status;
}
