/* A step in pieces, each with one smooth formula that it resolves. See locate_parts.h. */
#include "api/motion/locate_parts.h"

#include <math.h>
#include <string.h>

enum {
    /* in one step: more are friction that sticks, or a motion that comes to rest by ever shorter bounces */
    PIECES_MAX = 20000,
    LOOK = 16 /* pieces between two looks at the clock */
};
#define NEAR 0x1p-32 /* of a step: a piece shorter than this hardly moves */
#define FORCES 8.0   /* how many roundings of a force may differ between one piece and two halves */

/* The times, positions, velocities and accelerations between two states, with a margin for the curve. */
typedef struct way {
    interval t, *x, *v, *a;
} way;

static interval between(double from, double to, double margin)
{
    return (interval){fmin(from, to) - margin, fmax(from, to) + margin};
}

static way way_of(const locate *l, const place *from, const place *to)
{
    const problem *p = &l->problem;
    const double h = to->t - from->t;
    const way w = {between(from->t, to->t, 0), l->box, l->box + p->nx, l->box + p->nx + p->nv};
    for (size_t k = 0; k < p->nx; k++) w.x[k] = between(from->x[k], to->x[k], fabs(h * (to->v[k] - from->v[k])) / 8);
    for (size_t k = 0; k < p->nv; k++) {
        const double bend = fabs(to->a[k] - from->a[k]) / 8;
        w.v[k] = between(from->v[k], to->v[k], fabs(h) * bend);
        w.a[k] = between(from->a[k], to->a[k], bend);
    }
    return w;
}

/* Returns whether the step from `from` to `to` resolves the force. */
static bool fits(const locate *l, const place *from, const place *to)
{
    if (!l->resolves) return true;
    const way w = way_of(l, from, to);
    return held_fits(l->held, w.t, w.x, w.v);
}

/* Returns whether the ends tell all: every argument stays on its side, or moves in one direction. */
bool locate_sure(const locate *l, const place *from, const place *to)
{
    if (l->count == 0) return true;
    const way w = way_of(l, from, to);
    interval *argument = l->reach, *rate = l->reach + l->count;
    held_reach(l->held, w.t, w.x, w.v, w.a, argument, rate);
    for (size_t k = 0; k < l->count; k++) {
        const operation op = held_operation(l->held, k);
        const double least =
            fmin(switches_gap(op, l->side[k], argument[k].low), switches_gap(op, l->side[k], argument[k].high)) +
            l->slack[k];
        if (least <= 0 && !(rate[k].low >= 0 || rate[k].high <= 0)) return false;
    }
    return true;
}

static double largest(const double *y, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) most = fmax(most, fabs(y[k]));
    return most;
}

/* Repeats the piece of size h that led to `to` in two halves, to `twice`. *same: both ways agree, nearly to the
 * rounding of the numbers and of the force. */
static motus_status halve(motus_run *r, double h, bool *same, motus_error *err)
{
    locate *l = r->locate;
    const problem *p = &l->problem;
    *same = false;
    motus_status status = locate_try(r, &l->from, h / 2, &l->beyond, err);
    if (status == MOTUS_OK) status = locate_try(r, &l->beyond, l->to.t - l->beyond.t, &l->twice, err);
    if (status != MOTUS_OK) return status == MOTUS_MEMORY ? status : MOTUS_OK;
    const double a = fmax(largest(l->from.a, p->nv), fmax(largest(l->beyond.a, p->nv), largest(l->to.a, p->nv))),
                 v = fmax(largest(l->from.v, p->nv), largest(l->to.v, p->nv)), way = fabs(h),
                 late = 0x1p-52 * fabs(l->to.t), /* rounding of the time, at which a force changes fast */
        force = FORCES * held_force_rounding(l->held, l->to.t, l->to.x, l->to.v, l->room);
    const double of_x = 1e-13 * (largest(l->to.x, p->nx) + way * v) + late * v + way * way * force + 1e-30,
                 of_v = 1e-13 * (v + way * a) + late * a + way * force + 1e-30; /* before a force sets in */
    *same = true;
    for (size_t k = 0; k < p->nv; k++) {
        if (k < p->nx && !(fabs(l->to.x[k] - l->twice.x[k]) <= of_x)) *same = false;
        if (!(fabs(l->to.v[k] - l->twice.v[k]) <= of_v)) *same = false;
    }
    if (*same) l->rounding += way * force / FORCES;
    return MOTUS_OK;
}

/* Returns how much the acceleration changes over a piece. */
static double change(const locate *l)
{
    double most = 0;
    for (size_t k = 0; k < l->problem.nv; k++) most = fmax(most, fabs(l->to.a[k] - l->from.a[k]));
    return most;
}

/* Takes the piece from `from` to `to`, of size *h at most; *h becomes shorter where the force is not resolved, or where
 * an argument may leave its side and come back. *failed: the piece cannot be computed. */
static motus_status piece(motus_run *r, double *h, bool *failed, motus_error *err)
{
    locate *l = r->locate;
    const double least = fmax(0x1p-24 * fabs(r->timing.h), 0x1p-48 * fabs(l->from.t));
    for (;;) {
        motus_status status = locate_try(r, &l->from, *h, &l->to, err);
        if (status == MOTUS_MEMORY) return status;
        *failed = status != MOTUS_OK;
        if (!l->resolves && *failed) return MOTUS_OK;
        const bool small = fabs(*h) < 2 * least, resolved = !*failed && fits(l, &l->from, &l->to);
        if (small && (resolved || *failed)) return MOTUS_OK;
        if (small) {
            char t[DECIMAL_MAX];
            fail(err, MOTUS_SOLVE, "the force changes too fast to be resolved at t = %s; it may be singular there",
                 run_time_text(r, l->from.t, t));
            return MOTUS_SOLVE;
        }
        if (resolved && locate_sure(l, &l->from, &l->to)) {
            bool same;
            if (!l->resolves) return MOTUS_OK;
            status = halve(r, *h, &same, err);
            if (status != MOTUS_OK) return status;
            if (same) {
                locate_swap(&l->to, &l->twice);
                l->rounding += change(l) * 0x1p-52 * fabs(l->to.t);
                return MOTUS_OK;
            }
        }
        *h /= 2;
    }
}

/* Moves from `from` to `to` by Taylor's formula, over a time so short that its error is far below rounding. False: the
 * force is not defined there. */
static bool nudge(locate *l, double way)
{
    const problem *p = &l->problem;
    place *to = &l->to;
    locate_follow(p, &l->from, way, to->x, to->v);
    to->t = l->from.t + way;
    if (!locate_accelerate(l, to)) return false;
    for (size_t k = 0; k < p->nv; k++)
        if (!isfinite(to->a[k])) return false;
    held_values(l->held, to->t, to->x, to->v, to->u);
    return true;
}

/* Changing the sides of switches at a root ------------------------------------------------------------------------- */

static motus_status refuse_sliding(const motus_run *r, size_t k, motus_error *err)
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
static size_t change_sides(locate *l)
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
static size_t change_ahead(locate *l, double way)
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
static double lateness(locate *l, double h)
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
static motus_status settle(motus_run *r, motus_error *err)
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

/* All pieces ------------------------------------------------------------------------------------------------------- */

/* Takes pieces from `from` to the time `end`; `from` is then the state there. */
motus_status locate_pieces(motus_run *r, double end, motus_error *err)
{
    locate *l = r->locate;
    char t[DECIMAL_MAX];
    for (int count = 0, still = 0; count < PIECES_MAX; count++) {
        if (count % LOOK == LOOK - 1 && r->pace.tell && r->pace.tell(r->pace.ctx, pace_now())) return MOTUS_CANCELLED;
        const double left = end - l->from.t;
        double h = fabs(l->next) < fabs(left) ? copysign(l->next, left) : left, part = 1;
        if (l->from.t + left == l->from.t) return MOTUS_OK;
        bool failed;
        motus_status status = piece(r, &h, &failed, err);
        if (status != MOTUS_OK) return status;
        if (!failed && !(locate_least_gap(l, &l->to, NULL) < 0)) {
            status = locate_touch(r, h, &part, err);
            if (status != MOTUS_OK) return status;
            const bool touched = part < 1;
            locate_swap(&l->from, touched ? &l->found : &l->to);
            if (l->resolves && (h != left || touched || fabs(2 * h) > fabs(l->next))) l->next = 2 * h * part;
            if (h != left || touched) continue;
            l->from.t = end;
            return MOTUS_OK;
        }
        const double tried = h;
        const bool lost = failed;
        status = locate_root(r, &h, &failed, err);
        if (status != MOTUS_OK) return status;
        size_t changed = change_sides(l);
        if (changed == l->count && failed) {
            const bool moves = l->from.t + h != l->from.t;
            const double least = fmin(0x1p-10 * fabs(tried), 0x1p-30 * fabs(r->timing.h)),
                         late = copysign(0x1p-46 * fabs(l->to.t) + (moves ? 0 : least), tried);
            changed = change_ahead(l, late);
            /* A stage was beyond a root that is further ahead, or behind. */
            if (changed == l->count && (moves || (still++ < LOCATE_STILL_MAX && nudge(l, late)))) {
                locate_swap(&l->from, &l->to);
                continue;
            }
        }
        if (changed == l->count) {
            if (lost) return locate_try(r, &l->from, tried, &l->to, err); /* the failure is another one */
            return fail(err, MOTUS_SOLVE, "a switch near t = %s was not found", run_time_text(r, l->from.t, t));
        }
        if (l->resolves) l->next = tried;
        l->located++;
        still = fabs(h) <= NEAR * fabs(r->timing.h) ? still + 1 : 0;
        locate_swap(&l->from, &l->to);
        if (still > LOCATE_STILL_MAX) return refuse_sliding(r, changed, err);
        const double late = lateness(l, tried);
        l->rounding += locate_leap(l) * late;
        if (!held_bind(l->held, l->side, false)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
        if (!locate_accelerate(l, &l->from))
            return fail(err, MOTUS_CALLBACK, "the acceleration cannot be evaluated at t = %s",
                        run_time_text(r, l->from.t, t));
        held_values(l->held, l->from.t, l->from.x, l->from.v, l->from.u);
        status = settle(r, err);
        if (status != MOTUS_OK) return status;
        locate_note(r, &l->from, r->timing.h);
    }
    return fail(err, MOTUS_SOLVE,
                "one step has more than %d pieces, since the force changes so often or so fast at t = %s", PIECES_MAX,
                run_time_text(r, l->from.t, t));
}
