/* Lanes: one block of trajectories. See lanes_parts.h.
 *
 * Invariant: the results of a trajectory do not depend on its block. A block in which a number is no longer finite
 * takes its last steps again, one by one, to find the time.
 */
#include "machine/lanes_parts.h"

#include <math.h>
#include <string.h>

/* ---- memory ---- */

/* Counts what a block has: parameters of its own, numbers that depend on them, carry, records, clocks, and the times at
 * which lanes stopped. */
size_t lanes_block_size(const lanes *l)
{
    return l->own_size + l->bound_size + l->carry_size + l->kept_size + l->clock_size + l->known_size + l->watch_size +
           lines(l, 1);
}

static size_t saved_size(const lanes *l)
{
    const size_t values = lines(l, l->def.place_count), saved = l->carry_size + l->clock_size;
    return saved > values ? saved : values;
}

/* Counts what the scratch has: workspaces, the observed state, linear systems, the saved carry, and two numbers for
 * each lane. */
size_t lanes_scratch_size(const lanes *l)
{
    return l->work_size + l->observed_size + l->solve_size + saved_size(l) + 2 * lines(l, 1);
}

void lanes_block_place(lanes_block *k, const lanes_item *b, size_t block)
{
    const lanes *l = b->l;
    lanes_job *j = &k->job;
    double *p = b->memory + block * b->call->block_size;
    j->host.own = p;
    j->host.bound = p + l->own_size;
    j->carry = p + l->own_size + l->bound_size;
    j->kept = j->carry + l->carry_size;
    j->clocks = l->clock_size ? j->kept + l->kept_size : NULL;
    if (b->call->keeps && l->known_size) {
        j->known = j->clocks + l->clock_size;
        j->fresh = (bool *)(void *)(j->known + lines(l, l->def.model->nv));
    }
    k->stopped = p + b->call->block_size - lines(l, 1);
    if (!l->watch_size) return;
    j->before = k->saved, j->before_clocks = k->saved + l->carry_size;
    j->bounds = k->stopped - l->watch_size;
    j->largest = j->bounds + lines(l, l->def.model->nv);
    j->shown = j->largest + lines(l, l->def.model->nx + l->def.model->nv);
    j->met = k->stopped - lines(l, 1);
}

lanes_block lanes_block_of(const lanes_item *b, size_t block)
{
    lanes *l = b->l;
    const model *m = l->def.model;
    const size_t n = (size_t)l->block;
    double *observed = b->scratch + l->work_size, *saved = observed + l->observed_size + l->solve_size;
    lanes_job j = {.nx = m->nx,
                   .nv = m->nv,
                   .stride = m->nv,
                   .t0 = b->t0,
                   .h = b->h,
                   .n = b->n,
                   .table = b->table,
                   .first_row = b->first_row,
                   .places = l->places,
                   .value_count = (int64_t)l->def.place_count,
                   .from_x = l->from_x,
                   .from_v = l->from_v,
                   .x0 = m->x0,
                   .v0 = m->v0,
                   .record_count = (int64_t)l->def.source_count,
                   .out_size = l->outs,
                   .first_observation = b->observations == 0,
                   .ends = b->ends,
                   .until = l->def.until};
    j.relative = l->plan.relative, j.absolute = l->plan.absolute;
    j.least = l->plan.least, j.most = l->plan.most;
    j.variables = l->plan.variables, j.variable = l->plan.variable;
    j.own_size = l->own_size ? m->pool_count : 0;
    j.bound_size = l->e.fixed_lanes;
    j.host = (compiled_host){.pool = m->pool, .u = l->u, .q = l->q};
    j.room = b->scratch;
    j.x = observed;
    j.v = observed + m->nx * n;
    j.a = l->needs_a ? observed + (m->nx + m->nv) * n : NULL;
    j.out = observed + (m->nx + 2 * m->nv) * n;
    j.solving = (char *)(observed + l->observed_size);
    j.lost = saved + saved_size(l);
    j.where = j.lost + lines(l, 1);
    lanes_block made = {.l = l, .job = j, .saved = saved};
    lanes_block_place(&made, b, block);
    return made;
}

void lanes_block_save(const lanes_block *k)
{
    const lanes *l = k->l;
    memcpy(k->saved, k->job.carry, l->carry_size * sizeof(double));
    if (k->job.clocks) memcpy(k->saved + l->carry_size, k->job.clocks, l->clock_size * sizeof(double));
}

void lanes_block_forget(const lanes_block *k, size_t lane)
{
    if (k->job.fresh) k->job.fresh[lane / (size_t)k->l->width] = false;
}

void lanes_block_put_back(const lanes_block *k, size_t lane)
{
    const lanes *l = k->l;
    lanes_block_forget(k, lane);
    lanes_copy(l, k->job.carry, lane, k->saved, lane, l->carried);
    if (k->job.clocks) lanes_copy(l, k->job.clocks, lane, k->saved + l->carry_size, lane, LANES_CLOCKS);
}

/* ---- the start ---- */

/* Writes the values that vary, and the pool of every lane that has its own. */
static inline void begin_values(const lanes_block *block, const lanes_item *b, const size_t *trajectories, size_t width)
{
    const lanes *l = block->l;
    const model *m = l->def.model;
    const size_t count = l->def.place_count, numbers = l->own_size ? m->pool_count : 0;
    double *restrict values = block->saved, *restrict own = block->job.host.own;
    for (size_t g = 0; g < (size_t)l->groups; g++) {
        for (size_t k = 0; k < count; k++, values += width)
            for (size_t i = 0; i < width; i++) values[i] = b->call->values[k][trajectories[g * width + i]];
        for (size_t k = 0; k < l->reads; k++) {
            double *restrict to = own + (g * numbers + l->read[k]) * width;
            const double number = m->pool[l->read[k]];
            for (size_t i = 0; i < width; i++) to[i] = number;
        }
    }
}

void lanes_block_number(const lanes_block *block, const lanes_item *b, const size_t *trajectories)
{
    const lanes *l = block->l;
    lanes_job j = block->job;
    double *values = block->saved;
    switch (l->width) { /* with a constant width a lane takes an instruction or less */
    case 8: begin_values(block, b, trajectories, 8); break;
    case 4: begin_values(block, b, trajectories, 4); break;
    case 2: begin_values(block, b, trajectories, 2); break;
    default: begin_values(block, b, trajectories, (size_t)l->width);
    }
    j.values = values;
    l->begin(&j);
}

void lanes_block_begin(const lanes_block *block, const lanes_item *b, const size_t *trajectories)
{
    lanes_block_number(block, b, trajectories);
    for (size_t i = 0; i < (size_t)block->l->block; i++) block->stopped[i] = NAN;
    block->l->set(&block->job);
}

/* ---- lanes that are no longer finite ---- */

/* Tells whether a number of a block, with `elements` numbers for each lane, is NaN or as large as the limit. */
static bool some_far(const lanes *l, const double *numbers, size_t elements, double limit)
{
    return l->far(numbers, elements * (size_t)l->groups, limit);
}

bool lanes_block_finite(const lanes *l, const double *numbers, size_t elements, size_t lane)
{
    double none = 0;
    for (size_t k = 0; k < elements; k++)
        none += numbers[lane_at(l, elements, k, lane)] - numbers[lane_at(l, elements, k, lane)];
    return none == 0;
}

double lanes_block_time(const lanes_block *b, size_t lane)
{
    const lanes_job *j = &b->job;
    work w = {.carried = b->l->plan.carried, .t0 = j->t0, .h = j->h, .n = j->n};
    if (j->clocks) {
        w.t0 = *lanes_clock(b, lane, LANES_T0), w.h = *lanes_clock(b, lane, LANES_H);
        w.n = lanes_steps(b, lane);
        w.t = *lanes_clock(b, lane, LANES_T), w.lost = *lanes_clock(b, lane, LANES_LOST);
    }
    return time_now(&w);
}

void lanes_block_stop(const lanes_block *b)
{
    const lanes *l = b->l;
    if (!some_far(l, b->job.carry, l->carried, INFINITY)) return;
    for (size_t i = 0; i < (size_t)l->block; i++)
        if (isnan(b->stopped[i]) && !lanes_block_finite(l, b->job.carry, l->carried, i))
            b->stopped[i] = lanes_block_time(b, i);
}

/* Observes the lanes. The observed state may stop being finite one step before the carry does; in lanes that are not
 * observed now it has no valid numbers. */
void lanes_block_observe(const lanes_block *b)
{
    const lanes *l = b->l;
    const lanes_job *j = &b->job;
    const size_t nx = l->def.model->nx, nv = l->def.model->nv;
    l->observe(j);
    if (!some_far(l, j->x, nx, INFINITY) && !some_far(l, j->v, nv, INFINITY)) return;
    for (size_t i = 0; i < (size_t)l->block; i++)
        if (isnan(b->stopped[i]) && (!j->clocks || j->where[i] != 0) &&
            !(lanes_block_finite(l, j->x, nx, i) && lanes_block_finite(l, j->v, nv, i)))
            b->stopped[i] = lanes_block_time(b, i);
}

/* Observed numbers may overflow before the carry does: Verlet's velocity is d/h. */
#define NEAR_OVERFLOW 1e200

bool lanes_block_diverged(const lanes_block *b)
{
    const lanes *l = b->l;
    const double *carry = b->job.carry;
    if (!some_far(l, carry, l->carried, NEAR_OVERFLOW)) return false;
    for (size_t i = 0; i < (size_t)l->block; i++)
        for (size_t k = 0; isnan(b->stopped[i]) && k < l->carried; k++)
            if (!(fabs(carry[lane_at(l, l->carried, k, i)]) < NEAR_OVERFLOW)) return true;
    return false;
}

void lanes_block_trace(const lanes_block *block, bool first, int64_t steps, int64_t n, int64_t every)
{
    const lanes *l = block->l;
    lanes_block b = *block;
    b.job.carry = b.saved;
    if (b.job.clocks) b.job.clocks = b.saved + l->carry_size;
    b.job.record_count = 0;
    b.job.ends = false;
    lanes_block_stop(&b);
    for (int64_t k = 0; k < steps; k++) {
        if (every && (n + k) % every == 0) lanes_block_observe(&b);
        double before[BLOCK_MAX];
        for (size_t i = 0; l->plan.solves && i < (size_t)l->block; i++) before[i] = lanes_block_time(&b, i);
        if (first)
            l->first(&b.job);
        else
            l->run(&b.job, 1, 0);
        /* an equation that could not be solved stops its lane before the step */
        for (size_t i = 0; l->plan.solves && i < (size_t)l->block; i++)
            if (isnan(b.stopped[i]) && isnan(b.job.lost[i])) b.stopped[i] = before[i];
        b.job.n++;
        lanes_block_stop(&b);
    }
}

/* ---- the end ---- */

/* Returns the tally of a trajectory that has come to its end by `steps` steps. */
static tally tally_of_lane(const lanes_block *b, size_t lane, int64_t steps)
{
    const lanes *l = b->l;
    tally t = {.steps = steps, .accuracy = NAN, .shortest = NAN, .longest = NAN};
    t.tolerance = tally_tolerance(l->def.chosen);
    if (!l->plan.carried) {
        if (steps > 0) t.shortest = t.longest = fabs(l->def.h);
        return t;
    }
    t.refused = (int64_t)*lanes_clock(b, lane, LANES_REFUSED);
    if (*lanes_clock(b, lane, LANES_LONGEST) > 0)
        t.shortest = *lanes_clock(b, lane, LANES_SHORTEST), t.longest = *lanes_clock(b, lane, LANES_LONGEST);
    tally_evaluations(&l->plan, &t);
    return t;
}

/* Writes the numbers of one record. A group's lanes lie side by side. */
static void write_record(const lanes_block *b, size_t r, size_t from, size_t to, double *results, int64_t observations)
{
    const lanes *l = b->l;
    const size_t elements = l->def.source_count * REDUCE_KEPT, width = (size_t)l->width;
    const int how = l->def.sources[r].how;
    for (size_t i = from; i < to;) {
        const double *at = &b->job.kept[lane_at(l, elements, r * REDUCE_KEPT, i)];
        size_t count = width - (i & (width - 1));
        if (count > to - i) count = to - i;
        for (size_t k = 0; how == REDUCE_FINAL && k < count; k++) results[k] = at[k];
        for (size_t k = 0; how != REDUCE_FINAL && k < count; k++)
            results[k] = reduce_last((double[REDUCE_KEPT]){at[k], at[k + width]}, how, (double)observations);
        i += count;
        results += count;
    }
}

void lanes_block_results(const lanes_block *b, const lanes_call *c, size_t from, size_t to, size_t trajectory,
                         int64_t observations, int64_t steps)
{
    const lanes_def *d = &b->l->def;
    for (size_t r = 0; r < d->source_count; r++)
        write_record(b, r, from, to, c->results[d->sources[r].result] + trajectory, observations);
    for (size_t i = from; d->tally_count && i < to; i++) {
        const tally taken = tally_of_lane(b, i, steps);
        for (size_t k = 0; k < d->tally_count; k++)
            c->results[d->tallies[k].result][trajectory + i - from] = tally_number(&taken, d->tallies[k].which);
    }
    for (size_t i = from; i < to; i++) {
        if (isnan(b->stopped[i])) continue;
        for (size_t r = 0; r < d->source_count; r++) c->results[d->sources[r].result][trajectory + i - from] = NAN;
        for (size_t k = 0; k < d->tally_count; k++) c->results[d->tallies[k].result][trajectory + i - from] = NAN;
        d->left(d->context, trajectory + i - from, LANES_STOPPED);
    }
    if (c->stopped) memcpy(c->stopped + trajectory, b->stopped + from, (to - from) * sizeof *c->stopped);
}

void lanes_block_see(const lanes_block *b, bool ends, double t)
{
    lanes_job j = b->job;
    j.record_count = 0;
    j.ends = ends;
    j.until = t;
    b->l->observe(&j);
}

void lanes_item_report(lanes_item *b, double more)
{
    lanes_call *c = b->call;
    const lanes_def *d = &b->l->def;
    const double fraction = ((double)atomic_load(&c->done) + more) / (double)c->count;
    if (d->progress(d->context, fraction < 1 ? fraction : 1)) atomic_store(&c->cancelled, true);
}

bool lanes_item_over(const lanes_item *b) { return atomic_load(&b->call->cancelled) || atomic_load(&b->call->refused); }
