/* Lanes with companions: the differences of every trajectory. See lanes_parts.h and machine/differences.h.
 *
 * Invariant: the compared numbers belong to one lane, so a trajectory's bars depend on no other trajectory.
 */
#include "machine/lanes_parts.h"

#include <math.h>

enum { HEAD = (sizeof(lanes_companion) + sizeof(double) - 1) / sizeof(double) };

size_t lanes_companion_size(const lanes *l, size_t count)
{
    return (count * (HEAD + differences_size(&l->shape)) + 7) / 8 * 8;
}

lanes_companion *lanes_companion_place(const lanes *l, double *memory, size_t count)
{
    void *head = memory;
    lanes_companion *list = head;
    const size_t each = differences_size(&l->shape);
    double *numbers = memory + (count * sizeof *list + sizeof(double) - 1) / sizeof(double);
    for (size_t k = 0; k < count; k++) differences_place(&list[k].differences, &l->shape, numbers + k * each);
    return list;
}

void lanes_companion_begin(lanes_companion *c, double t0, double until)
{
    differences_begin(&c->differences, t0, until);
    c->landed = t0;
    c->failed = false;
}

/* Returns where compared number k lies in the seen numbers of a block; NULL: it is the time. *elements: as in lane_at.
 * */
static const double *seen_of(const lanes *l, const lanes_block *b, size_t k, size_t *elements)
{
    const lanes_job *j = &b->job;
    const model *m = b->l->def.model;
    switch (l->compared[k].from) {
    case LANES_X: *elements = m->nx; return j->x;
    case LANES_V: *elements = m->nv; return j->v;
    case LANES_OUT: *elements = l->outs; return j->out;
    default: return NULL;
    }
}

/* Copies the compared numbers, of the run or of its companion, of the lanes whose entry in `list` is not NULL. */
static void see(const lanes_block *b, const lanes *l, lanes_companion *const *list, int which)
{
    const size_t width = (size_t)l->width;
    for (size_t k = 1; k < l->shape.count; k++) {
        size_t elements = 0;
        const double *numbers = seen_of(l, b, k, &elements);
        for (size_t g = 0; g < (size_t)l->groups; g++) {
            const double *row = numbers ? numbers + (g * elements + (size_t)l->compared[k].element) * width : NULL;
            for (size_t i = 0; i < width; i++) {
                lanes_companion *c = list[g * width + i];
                if (c) c->differences.values[which][k] = row ? row[i] : c->landed;
            }
        }
    }
}

static bool state_finite(const lanes *l, const double *values)
{
    const size_t state = 1 + l->shape.positions + l->shape.velocities;
    double none = 0;
    for (size_t k = 1; k < state; k++) none += values[k] - values[k];
    return none == 0;
}

void lanes_companion_compare(const lanes_block *run, const lanes_block *half, lanes_companion **list,
                             const bool *observed)
{
    const lanes *l = run->l;
    const size_t lanes = (size_t)l->block;
    for (size_t i = 0; i < lanes; i++)
        if (list[i] && (list[i]->failed || !isnan(list[i]->differences.until))) list[i] = NULL;
    see(run, l, list, 0);
    see(half, l, list, 1);
    for (size_t i = 0; i < lanes; i++) {
        lanes_companion *c = list[i];
        if (!c || !state_finite(l, c->differences.values[0])) continue; /* the trajectory itself stops here */
        c->differences.values[0][0] = c->differences.values[1][0] = c->landed;
        c->failed = !state_finite(l, c->differences.values[1]);
        if (!c->failed) differences_take(&c->differences, c->landed, observed[i], false);
    }
}

void lanes_block_errors(const lanes_call *c, const lanes_companion *companion, bool stopped, size_t trajectory)
{
    const lanes *l = c->l;
    const size_t first = l->shape.count - l->def.source_count;
    for (size_t r = 0; r < l->def.source_count; r++)
        c->errors[l->def.sources[r].result][trajectory] =
            stopped || companion->failed ? NAN : differences_bar(&companion->differences, first + r);
    if (l->def.rounding && !stopped && !companion->failed)
        l->def.rounding(l->def.context, c->values, trajectory, companion->differences.values[0], c->errors);
    for (size_t k = 0; k < l->def.tally_count; k++) {
        const lanes_tally *t = &l->def.tallies[k];
        c->errors[t->result][trajectory] = stopped ? NAN : 0;
        if (t->which == TALLY_ACCURACY && !stopped && !companion->failed)
            c->results[t->result][trajectory] =
                differences_worst(&companion->differences, l->def.chosen->absolute > 0, false);
    }
}
