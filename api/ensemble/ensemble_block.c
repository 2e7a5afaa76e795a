/* Blocks of a callback: several trajectories side by side, as one problem of the library's stepper. See ensemble.h.
 *
 * Invariant: an explicit method applies equal operations to every number, so a trajectory has the bits that it has
 * alone. A block in which a trajectory stops is computed again in halves, down to that trajectory.
 */
#include "api/ensemble/ensemble.h"

#include "core/course.h"
#include "machine/reduction.h"

#include <math.h>
#include <string.h>

/* Most trajectories in a block. An array has at most CALLING_NUMBERS numbers, so that a method's fit the first-level
 * cache. */
enum { BLOCK_MOST = 256 };

size_t ensemble_block_size(const motus_system *s, const chosen *c)
{
    /* A method that solves equations, or adapts its steps, does so for one trajectory. */
    if (row_formula(c) || c->row->adaptive || stepper_plan(&s->problem, c, NULL).solves) return 0;
    const size_t fits = CALLING_NUMBERS / s->problem.nv;
    return fits < 2 ? 0 : fits > BLOCK_MOST ? BLOCK_MOST : fits;
}

typedef struct trajectory_block {
    worker *w;
    const places *places;
    calling calling;
    problem problem;
    size_t first, count;
    double *x, *v, *kept, *one_x, *one_v; /* one_x, one_v: the observed state of one trajectory */
    int64_t observations;
    tally taken; /* by each trajectory */
} trajectory_block;

/* ---- observations ---- */

/* Returns a column's numbers in every trajectory: a row of the state, or NULL where they must be computed. */
static const double *row_of(const trajectory_block *b, size_t column)
{
    const motus_system *s = b->w->system;
    motus_column c = motus_default_column();
    if (motus_column_at(s, column, &c) != MOTUS_OK ||
        (c.kind != MOTUS_COLUMN_POSITION && c.kind != MOTUS_COLUMN_VELOCITY && c.kind != MOTUS_COLUMN_FIRST_ORDER))
        return NULL;
    const bool of_v = c.kind != MOTUS_COLUMN_POSITION;
    return (of_v ? b->v : b->x) + system_number(s, column - 1, of_v) * b->count;
}

static motus_status compute(trajectory_block *b, size_t column, size_t j, double t, double *out, motus_error *err)
{
    const problem *p = &b->w->system->problem;
    for (size_t k = 0; k < p->nv; k++) {
        if (k < p->nx) b->one_x[k] = b->x[k * b->count + j];
        b->one_v[k] = b->v[k * b->count + j];
    }
    return system_values(b->w->system, t, b->one_x, b->one_v, &column, 1, out, err);
}

static motus_status observe(void *ctx, motus_error *err)
{
    trajectory_block *b = ctx;
    const motus_ensemble *e = b->w->e;
    const double t = stepper_time(b->w->stepper);
    motus_status status = stepper_sync(b->w->stepper, b->x, b->v, NULL, err);
    for (size_t r = 0; r < e->record_count && status == MOTUS_OK; r++) {
        if (ensemble_tallies(&e->records[r])) continue;
        const double *numbers = row_of(b, e->records[r].column);
        double *kept = b->kept + r * b->count * REDUCE_KEPT;
        for (size_t j = 0; j < b->count && status == MOTUS_OK; j++, kept += REDUCE_KEPT) {
            double now = numbers ? numbers[j] : t;
            if (!numbers && e->records[r].column) status = compute(b, e->records[r].column, j, t, &now, err);
            if (b->observations == 0)
                reduce_first(kept, now, t);
            else
                reduce_next(kept, (int)e->records[r].how, now, t);
        }
    }
    b->observations++;
    return status;
}

/* ---- a block ---- */

static motus_status start(trajectory_block *b, motus_error *err)
{
    const motus_ensemble *e = b->w->e;
    const motus_system *s = b->w->system;
    const size_t nx = s->problem.nx, nv = s->problem.nv, n = b->count;
    for (size_t k = 0; k < nv; k++)
        for (size_t j = 0; j < n; j++) {
            if (k < nx) b->x[k * n + j] = s->x0[k];
            b->v[k * n + j] = s->v0[k];
        }
    for (size_t i = 0; i < e->vary_count; i++) {
        double *numbers = e->places[i] < nx ? b->x + e->places[i] * n : b->v + (e->places[i] - nx) * n;
        memcpy(numbers, b->places->values[i] + b->first, n * sizeof *numbers);
    }
    int bad = 0;
    for (size_t k = 0; k < nv * n; k++) bad |= !isfinite(b->v[k]) || (k < nx * n && !isfinite(b->x[k]));
    err->time = e->timing.t0;
    return bad ? MOTUS_DIVERGED : MOTUS_OK;
}

static motus_status advance(void *ctx, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    trajectory_block *b = ctx;
    return pace_advance(&b->w->pace, b->w->stepper, limit, why, err);
}

static motus_status run(trajectory_block *b, motus_error *err)
{
    const motus_ensemble *e = b->w->e;
    timing *t = &b->w->timing; /* where ends vary, a block has one trajectory */
    const machine m = {.name = b->w->machine.name, .problem = &b->problem};
    motus_status status = start(b, err);
    stepper_destroy(b->w->stepper); /* made by trajectories that went one at a time */
    b->w->stepper = NULL;
    if (status == MOTUS_OK) status = ensemble_timing(e, b->places, b->first, t, err);
    if (status == MOTUS_OK)
        status = stepper_create(&m, &e->chosen, t->t0, t->h, b->x, b->v, &e->allocator, &b->w->stepper, err);
    const course course = {.ctx = b,
                           .until = t->until,
                           .every = b->places->observes ? e->every : 0,
                           .advance = advance,
                           .observe = observe};
    if (status == MOTUS_OK) status = course_run(&course, err);
    if (status == MOTUS_OK) b->taken = tally_of(b->w->stepper, (stepper_count){0});
    stepper_destroy(b->w->stepper);
    b->w->stepper = NULL;
    return status;
}

static double result(const trajectory_block *b, size_t r, size_t j)
{
    const motus_record *record = &b->w->e->records[r];
    if (ensemble_tallies(record)) return tally_number(&b->taken, ensemble_tally(record));
    return reduce_last(b->kept + (r * b->count + j) * REDUCE_KEPT, (int)record->how, (double)b->observations);
}

static void write_results(const trajectory_block *b, bool stopped, double when)
{
    const motus_ensemble *e = b->w->e;
    /* A callback that stops a trajectory is itself the cause. */
    const bool open = stopped && b->w->why.returned <= 0;
    for (size_t j = 0; open && j < b->count; j++) e->outcomes[b->first + j].left = LANES_STOPPED;
    for (size_t r = 0; r < e->record_count; r++)
        for (size_t j = 0; j < b->count; j++) b->places->results[r][b->first + j] = stopped ? NAN : result(b, r, j);
    for (size_t j = 0; b->places->stopped && j < b->count; j++) b->places->stopped[b->first + j] = stopped ? when : NAN;
}

/* Computes a block, or its halves where a trajectory stops; `memory` is enough for the whole block. */
static motus_status run_halving(worker *w, const places *p, size_t first, size_t count, double *memory)
{
    const size_t nx = w->system->problem.nx, nv = w->system->problem.nv;
    trajectory_block b = {.w = w,
                          .places = p,
                          .first = first,
                          .count = count,
                          .one_x = memory,
                          .one_v = memory + nx,
                          .x = memory + nx + nv};
    b.v = b.x + nx * count;
    b.kept = b.v + nv * count;
    b.calling =
        (calling){.def = &w->system->callback, .unread = w->system->calling.unread, .first = first, .count = count};
    b.problem = callback_block(&b.calling, &w->system->problem);
    w->trajectories = count;
    motus_status status = run(&b, &w->why);
    const bool stopped = ensemble_stopped(status, &w->why);
    if (status != MOTUS_OK && !stopped) return status;
    if (stopped && count > 1) {
        status = run_halving(w, p, first, count / 2, memory);
        return status == MOTUS_OK ? run_halving(w, p, first + count / 2, count - count / 2, memory) : status;
    }
    write_results(&b, stopped, w->why.time);
    return ensemble_done(w, count);
}

static motus_status one_block(worker *w, size_t item, void *ctx)
{
    const motus_ensemble *e = w->e;
    const size_t first = item * e->block, count = e->count - first < e->block ? e->count - first : e->block;
    const size_t numbers = w->system->problem.nx + w->system->problem.nv;
    double *memory = take(&e->allocator, numbers + (numbers + e->record_count * REDUCE_KEPT) * count, sizeof *memory);
    if (!memory) return fail(&w->why, MOTUS_MEMORY, "no memory for %zu trajectories", count);
    motus_status status = run_halving(w, ctx, first, count, memory);
    give(&e->allocator, memory);
    return status;
}

motus_status ensemble_blocks(motus_ensemble *e, const places *p, motus_error *err)
{
    return ensemble_each(e, 0, (e->count + e->block - 1) / e->block, one_block, (void *)p, err);
}
