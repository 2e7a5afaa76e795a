/* Lanes with own clocks: a lane whose trajectory is over takes the next one of the item. See lanes_parts.h.
 *
 * Invariant: a trajectory's bits depend neither on its lane nor on its neighbours, so the order in which lanes become
 * free changes none.
 */
#include "machine/lanes_parts.h"

#include "core/stepper.h"

#include <math.h>

void lanes_schedule_free(const lanes_block *b, size_t lane)
{
    b->number[lane] = NO_TRAJECTORY;
    *lanes_clock(b, lane, LANES_UNTIL) = *lanes_clock(b, lane, LANES_STOP) = NAN;
    b->stopped[lane] = 0;
}

int64_t lanes_schedule_pace(const lanes_block *b, size_t lane)
{
    const int64_t most = b->l->def.chosen->count, pace = (lanes_steps(b, lane) / STEPPER_PACE + 1) * STEPPER_PACE;
    return most > 0 && most < pace ? most : pace;
}

/* Fills free lanes with the trajectories that are left. True: some lane has a trajectory. */
static bool refill(const lanes_schedule *s)
{
    bool any = false;
    for (size_t i = 0; i < (size_t)s->block->l->block; i++) {
        while (!lanes_occupied(s->block, i) && !lanes_item_over(s->item) && s->fill(s->ctx, i)) continue;
        any |= lanes_occupied(s->block, i);
    }
    return any;
}

void lanes_schedule_run(const lanes_schedule *s)
{
    while (refill(s) && !lanes_item_over(s->item)) {
        s->run(s->ctx);
        for (size_t i = 0; i < (size_t)s->block->l->block; i++)
            if (lanes_occupied(s->block, i)) s->look(s->ctx, i);
        if (s->item->reports) lanes_item_report(s->item, 0);
    }
}
