/* Changing the sides of switches at a root. See locate_parts.h. */
#include "api/motion/locate_parts.h"

#include <math.h>
#include <string.h>

motus_status locate_slides(const motus_run *r, size_t k, motus_error *err)
{
    const locate *l = r->locate;
    char where[128], t[DECIMAL_MAX];
    held_surface(l->held, k, where, sizeof where);
    fail(err, MOTUS_SOLVE,
         "from t = %s on the motion slides along %s: the force drives it there from both sides, as dry friction "
         "that sticks",
         run_time_text(r, l->from.t, t), where);
    hint(err, "locate no switches in this model");
    return MOTUS_SOLVE;
}

/* Gives an argument that stopped just before its root slack: it may be twice as far on the other side as it is now. */
static void give_slack(locate *l, size_t k, const place *at)
{
    l->slack[k] = fmax(0, -2 * switches_gap(held_operation(l->held, k), l->side[k], at->u[k]));
}

/* Changes the sides of all arguments that have left theirs at `to`. Returns one of them, or `count`. */
size_t locate_change(locate *l)
{
    size_t changed = l->count;
    memcpy(l->old_side, l->side, l->count * sizeof *l->side);
    for (size_t k = 0; k < l->count; k++) {
        const operation op = held_operation(l->held, k);
        if (locate_gap(l, k, &l->to) < 0) {
            l->side[k] = switches_beyond(op, l->side[k], l->to.u[k]);
            changed = k;
        }
        give_slack(l, k, &l->to);
    }
    return changed;
}

/* Changes the sides of the arguments that reach their ends within the time `way`, and moves `to` beyond them by
 * Taylor's formula: where the force is not defined beyond a root, no step leads on from `to`. Returns one of these
 * arguments, or `count`. */
size_t locate_change_ahead(locate *l, double way)
{
    const problem *p = &l->problem;
    size_t changed = l->count;
    double part = 0; /* of `way`, until all have reached their ends */
    memcpy(l->old_side, l->side, l->count * sizeof *l->side);
    held_rates(l->held, l->to.t, l->to.x, l->to.v, l->to.a, l->rate[1]);
    for (size_t k = 0; k < l->count; k++) {
        const operation op = held_operation(l->held, k);
        const double ahead = way * switches_gap_rate(op, l->side[k], l->to.u[k], l->rate[1][k]),
                     left = locate_gap(l, k, &l->to);
        if (!(left + ahead <= 0)) continue;
        part = fmax(part, left / -ahead);
        l->side[k] = switches_beyond(op, l->side[k], l->to.u[k]);
        changed = k;
    }
    if (changed == l->count) return changed;
    locate_follow(p, &l->to, 2 * part * way, l->beyond.x, l->beyond.v);
    memcpy(l->to.x, l->beyond.x, p->nx * sizeof(double));
    memcpy(l->to.v, l->beyond.v, p->nv * sizeof(double));
    l->to.t += 2 * part * way;
    held_values(l->held, l->to.t, l->to.x, l->to.v, l->to.u);
    for (size_t k = 0; k < l->count; k++) give_slack(l, k, &l->to);
    return changed;
}

/* Returns how uncertain the time is at which the arguments that have just changed sides were 0: by the rounding of the
 * time, and by that of the arguments over their rates. */
double locate_lateness(locate *l, double h)
{
    const place *at = &l->from;
    double late = 0x1p-52 * fabs(at->t), *rounding = l->size;
    held_rounding(l->held, at->t, at->x, at->v, rounding);
    held_rates(l->held, at->t, at->x, at->v, at->a, l->rate[1]);
    for (size_t k = 0; k < l->count; k++) {
        const double own = rounding[k] / fabs(l->rate[1][k]);
        if (l->side[k] != l->old_side[k] && own > late && own < fabs(h)) late = own;
    }
    return late;
}

/* Changes sides until none is wrong: a switch that has just changed may move the arguments of others. */
motus_status locate_settle(motus_run *r, motus_error *err)
{
    locate *l = r->locate;
    place *at = &l->from;
    for (int turn = 0; turn < LOCATE_STILL_MAX; turn++) {
        bool changed = false;
        for (size_t k = 0; k < l->count; k++) {
            const operation op = held_operation(l->held, k);
            if (!(locate_gap(l, k, at) < 0)) continue;
            l->side[k] = switches_side(op, at->u[k], 0);
            give_slack(l, k, at);
            changed = true;
        }
        if (!changed) return MOTUS_OK;
        if (!held_bind(l->held, l->side, false)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
        if (!locate_accelerate(l, at)) break;
        held_values(l->held, at->t, at->x, at->v, at->u);
    }
    char t[DECIMAL_MAX];
    return fail(err, MOTUS_SOLVE, "the force cannot be evaluated at the switches at t = %s",
                run_time_text(r, at->t, t));
}
