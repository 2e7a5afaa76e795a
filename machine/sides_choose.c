/* The side of one switch whose argument is 0: where the motion goes on, and what holds it there. See sides_parts.h. */
#include "machine/sides_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { AHEAD = 12 }; /* the order of the series that tell how an argument leaves 0 */

static const char not_unique[] = "the motion is not unique: the force drives it away to both sides";

/* Evaluates the rate of argument k along the run, with its switch on a side. */
static motus_status rate_on(sides *s, size_t k, double side, double way, double t, double *x, double *v, double *rate,
                            motus_error *err)
{
    double *sides = x + s->switches->slot;
    const double was = sides[k];
    sides_put(s, sides, k, side);
    const motus_status status = sides_accelerate(s, t, x, v, err);
    if (status == MOTUS_OK) sides_evaluate(s, s->rate, t, x, v, s->a, s->du);
    sides_put(s, sides, k, was);
    *rate = way * s->du[k];
    return status;
}

/* Computes the Taylor series of the motion from a state, to order AHEAD, in s->xs and s->vs. */
static motus_status expand(sides *s, double t, double *x, double *v, motus_error *err)
{
    enum { LENGTH = AHEAD + 1 };
    const problem *p = s->problem;
    const size_t kept = p->series_numbers(p->ctx, LENGTH);
    const size_t numbers = LENGTH * (p->nx + p->nv) + kept;
    if (!s->xs && kept) s->xs = arena_room(s->model->arena, (numbers + 1) * sizeof *s->xs);
    if (!s->xs || !kept) return fail(err, MOTUS_MEMORY, "no memory for the switches of the model");
    s->vs = s->xs + LENGTH * p->nx;
    memset(s->xs, 0, numbers * sizeof *s->xs);
    for (size_t i = 0; i < p->nx; i++) s->xs[i * LENGTH] = x[i], s->xs[i * LENGTH + 1] = v[i];
    for (size_t i = 0; i < p->nv; i++) s->vs[i * LENGTH] = v[i];
    memset(s->a, 0, p->nv * sizeof *s->a);
    for (int n = 0; n < AHEAD; n++) {
        p->series(p->ctx, LENGTH, n, t, s->xs, s->vs, s->a, s->vs + LENGTH * p->nv);
        for (size_t i = 0; i < p->nv; i++) s->vs[i * LENGTH + (size_t)n + 1] = s->a[i] / (n + 1);
        for (size_t i = 0; i < p->nx && n + 2 < LENGTH; i++)
            s->xs[i * LENGTH + (size_t)n + 2] = s->a[i] / ((n + 1) * (n + 2));
    }
    return MOTUS_OK;
}

/* Evaluates series at a distance h. False: h is so far that the last terms matter, or a sum is not finite. */
static bool reaches(const double *series, size_t count, double h, double *out)
{
    enum { LENGTH = AHEAD + 1 };
    for (size_t i = 0; i < count; i++) {
        const double *c = series + i * LENGTH;
        double power = 1, most = 0, last = 0, moved = 0;
        for (int n = 1; n < LENGTH; n++) {
            power *= h;
            const double term = c[n] * power;
            moved += term;
            most = fmax(most, fabs(term));
            if (n >= LENGTH - 2) last = fmax(last, fabs(term));
        }
        out[i] = c[0] + moved;
        if (!isfinite(out[i]) || last > 0x1p-20 * most) return false;
    }
    return true;
}

/* Finds the way in which an argument with the rate 0 leaves 0, with its switch on a side: its sign at the least
 * distance at which it exceeds its rounding and that of the force, without which derivatives would vanish. *leaves = 0:
 * it stays 0 as far as the series of the motion reach. */
static motus_status look_ahead(sides *s, size_t k, double side, double origin, double way, double t, double *x,
                               double *v, int *leaves, motus_error *err)
{
    enum { FACTOR = 16, TIMES = 64 };
    const size_t nv = s->problem->nv;
    double *sides = x + s->switches->slot;
    const double was = sides[k];
    *leaves = 0;
    sides_put(s, sides, k, side);
    memset(s->b, 0, nv * sizeof *s->b);
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = s->b};
    tape_run(s->force_rounding, t, base);
    motus_status status = expand(s, t, x, v, err);
    sides_put(s, sides, k, was);
    double h = way * 0x1p-120;
    for (int times = 0; times < TIMES && status == MOTUS_OK && !*leaves; times++, h *= FACTOR) {
        if (t + h == t && t != 0) continue;
        if (!reaches(s->xs, s->problem->nx, h, s->x) || !reaches(s->vs, nv, h, s->v)) break;
        sides_evaluate(s, s->argument, t + h, s->x, s->v, NULL, s->later);
        const double u = s->later[k] - origin;
        sides_evaluate(s, s->rounding, t + h, s->x, s->v, NULL, s->later);
        double hidden = 0x1p-52 * s->later[k];
        for (int pattern = 1; pattern <= 2; pattern++) { /* with one sign, and with both in turn */
            for (size_t i = 0; i < nv; i++)
                s->a[i] = s->v[i] + (i % (size_t)pattern ? -1 : 1) * 0x1p-52 * fabs(h) * fmin(s->b[i], 0x1p1000);
            sides_evaluate(s, s->argument, t + h, s->x, s->a, NULL, s->later);
            hidden += fabs(s->later[k] - origin - u);
        }
        if (fabs(u) > hidden) *leaves = u > 0 ? 1 : -1;
    }
    return status;
}

bool sides_solved(const sides *s, size_t k, size_t j)
{
    const output *rate = s->switches->rate;
    return s->switches->together && rate[switches_kind(s->switches, k)].loops == 0 &&
           rate[switches_kind(s->switches, j)].loops == 0;
}

/* Holds the argument of switch k at 0, on whose sides the rates are `above` and `below`. */
static motus_status hold(sides *s, size_t k, double above, double below, double t, double *x, double *v,
                         motus_error *err)
{
    enum { PASSES = 32 }; /* one, but for rounding, which leaves 2^-53 of it each time */
    static const char *const slides =
        "the motion slides along a jump of the force, which drives it back from both sides,";
    const size_t count = s->switches->count, nv = s->problem->nv;
    double *side = x + s->switches->slot, middle;
    char why[200];
    if (s->switches->slides[switches_kind(s->switches, k)] != SLIDES_HELD) {
        snprintf(why, sizeof why, "%s and no value between those of both sides is known to hold it,", slides);
        return sides_refuse(s, k, why, t, err);
    }
    motus_status status = MOTUS_OK;
    if (!sides_chooses(s, k)) { /* a comparison chooses between two values, between which the force is affine */
        status = rate_on(s, k, 0, 1, t, x, v, &middle, err);
        if (status != MOTUS_OK) return status;
        if (fabs(middle - (above + below) / 2) > 0x1p-30 * (fabs(above) + fabs(below))) {
            snprintf(why, sizeof why, "%s and no single value of the sign holds it,", slides);
            return sides_refuse(s, k, why, t, err);
        }
    }
    /* the force on both sides; refused where it moves another held argument, or the other's force moves this one */
    status = rate_on(s, k, sides_side_of(s, k, 1), 1, t, x, v, &middle, err);
    memcpy(s->b, s->a, nv * sizeof *s->b);
    memcpy(s->later, s->du, count * sizeof *s->du);
    if (status == MOTUS_OK) status = rate_on(s, k, sides_side_of(s, k, -1), 1, t, x, v, &middle, err);
    bool coupled = false;
    for (size_t j = 0; j < count; j++)
        coupled |=
            sides_first_of(s, j) != k && sides_is_held(s, side, j) && !sides_solved(s, k, j) && s->du[j] != s->later[j];
    for (size_t j = 0; j < count && status == MOTUS_OK && !coupled; j++) {
        double one = 0, other = 0;
        if (j == k || sides_follows(s, j) || !sides_is_held(s, side, j) || sides_solved(s, k, j)) continue;
        if (switches_directs(sides_op_of(s, j))) {
            coupled = true;
            break;
        }
        const double held = side[j], on = sides_side_of(s, k, 1);
        sides_put(s, side, j, sides_side_of(s, j, 1)), status = rate_on(s, k, on, 1, t, x, v, &one, err);
        sides_put(s, side, j, sides_side_of(s, j, -1));
        if (status == MOTUS_OK) status = rate_on(s, k, on, 1, t, x, v, &other, err);
        sides_put(s, side, j, held);
        coupled = one != other;
    }
    if (status != MOTUS_OK) return status;
    if (coupled) {
        snprintf(why, sizeof why, "%s together with another, whose force depends on it,", slides);
        return sides_refuse(s, k, why, t, err);
    }
    /* The argument is 0 but for rounding: it becomes 0 along the push that the switch exerts. */
    status = rate_on(s, k, sides_side_of(s, k, -1), 1, t, x, v, &middle, err);
    for (int pass = 0; pass < PASSES; pass++) {
        sides_evaluate(s, s->argument, t, x, v, NULL, s->u);
        if (s->u[k] == 0) break;
        const double way = -s->u[k] / (above - below);
        for (size_t i = 0; i < nv; i++) v[i] += way * (s->b[i] - s->a[i]);
    }
    sides_put(s, side, k, above < below ? SWITCHES_HELD : SWITCHES_HELD_BACKWARD);
    return status;
}

/* Bounds the rounding of the rates `on` both sides of a switch that can be held. Where friction breaks loose, the value
 * that holds the switch has just reached 1, so one rate is 0 but for the rounding of that value and of the time. */
static double unsure(sides *s, size_t k, const double on[2], double t, double *x, double *v)
{
    if (!s->hold || s->switches->slides[switches_kind(s->switches, k)] != SLIDES_HELD) return 0;
    sides_evaluate(s, s->hold_rate, t, x, v, s->a, s->p);
    const double moved = fabs(s->p[k]) * (nextafter(fabs(t), INFINITY) - fabs(t));
    sides_evaluate(s, s->hold_rounding, t, x, v, NULL, s->dp);
    return fabs(on[0] - on[1]) * (0x1p-52 * (s->dp[k] + 1) + moved);
}

/* A switch k that the force can hold, and others beside it whose arguments it moves: x' and x, where both accumulate
 * (`x'' = -2 sign(x) - sign(x')` comes to rest at 0 by ever shorter swings). Both stay at 0 where the force drives the
 * motion back from either side of both: where k and those beside it, which leave with it, are all on one side, and
 * where all are on the other. */

/* Returns the way in which the argument of n moves when that of k becomes positive; 0: it does not move. s->a and s->b:
 * the accelerations with k on both sides; push: the difference of the rates of k's argument with them. *rate: how fast
 * s->b - s->a, as a velocity, moves the argument of n. */
static int moves_with(sides *s, size_t n, double push, double way, double t, double *x, double *v, double *rate)
{
    const size_t nv = s->problem->nv;
    for (size_t i = 0; i < nv; i++) s->v[i] = v[i] + (s->b[i] - s->a[i]);
    sides_evaluate(s, s->rate, t, x, v, s->a, s->du);
    *rate = -s->du[n];
    sides_evaluate(s, s->rate, t, x, s->v, s->a, s->du);
    *rate += s->du[n];
    const double along = way * *rate * push;
    return (along > 0) - (along < 0);
}

/* Evaluates the rate of argument k with its switch and those beside it on one side, 1 or -1. */
static motus_status rate_at_corner(sides *s, size_t k, int to, double way, double t, double *x, double *v, double *rate,
                                   motus_error *err)
{
    double *side = x + s->switches->slot;
    for (size_t n = 0; n < s->switches->count; n++) {
        if (!s->beside[n]) continue;
        s->was[n] = side[n];
        sides_put(s, side, n, s->beside[n] * to);
    }
    const motus_status status = rate_on(s, k, sides_side_of(s, k, to), way, t, x, v, rate, err);
    for (size_t n = 0; n < s->switches->count; n++)
        if (s->beside[n]) sides_put(s, side, n, s->was[n]);
    return status;
}

motus_status sides_find_beside(sides *s, size_t k, const bool *of, double way, double t, double *x, double *v,
                               size_t *found, motus_error *err)
{
    const double *side = x + s->switches->slot;
    double above, below, rate;
    *found = 0;
    motus_status status = rate_on(s, k, sides_side_of(s, k, 1), 1, t, x, v, &above, err);
    memcpy(s->b, s->a, s->problem->nv * sizeof *s->b);
    if (status == MOTUS_OK) status = rate_on(s, k, sides_side_of(s, k, -1), 1, t, x, v, &below, err);
    if (status != MOTUS_OK) return status;
    for (size_t n = 0; n < s->switches->count; n++) {
        const bool may =
            n != k && !sides_follows(s, n) &&
            (of ? of[n] && sides_op_of(s, n) == OP_SIGN : sides_op_of(s, n) == OP_SIGN && fabs(side[n]) < 1);
        s->beside[n] = (int8_t)(may ? moves_with(s, n, above - below, way, t, x, v, &rate) : 0);
        *found += s->beside[n] != 0;
    }
    return MOTUS_OK;
}

motus_status sides_move_to_zero(sides *s, size_t k, size_t n, double t, double *x, double *v, motus_error *err)
{
    enum { PASSES = 32 }; /* as in `hold` */
    double above, below, rate;
    motus_status status = rate_on(s, k, sides_side_of(s, k, 1), 1, t, x, v, &above, err);
    memcpy(s->b, s->a, s->problem->nv * sizeof *s->b);
    if (status == MOTUS_OK) status = rate_on(s, k, sides_side_of(s, k, -1), 1, t, x, v, &below, err);
    if (status != MOTUS_OK) return status;
    moves_with(s, n, above - below, 1, t, x, v, &rate);
    for (int pass = 0; pass < PASSES; pass++) {
        sides_evaluate(s, s->argument, t, x, v, NULL, s->u);
        if (s->u[n] == 0) break;
        const double by = -s->u[n] / (n == k ? above - below : rate);
        double *to = n == k ? v : x;
        const size_t count = n == k ? s->problem->nv : s->problem->nx;
        for (size_t i = 0; i < count; i++) to[i] += by * (s->b[i] - s->a[i]);
    }
    return MOTUS_OK;
}

/* Gives the switches in s->beside the value c, and returns the value that then holds k. */
static double pin(sides *s, size_t k, double c, double t, double *x, double *v)
{
    const double tiny = 0x1p-60;
    double *side = x + s->switches->slot;
    for (size_t n = 0; n < s->switches->count; n++)
        if (s->beside[n]) sides_put(s, side, n, s->beside[n] * (fabs(c) < tiny ? tiny : c));
    sides_evaluate(s, s->hold, t, x, v, NULL, s->p);
    return s->p[k];
}

motus_status sides_stand_at_corner(sides *s, size_t k, int going, double way, double t, double *x, double *v,
                                   bool *held, motus_error *err)
{
    const double most = 1 - 0x1p-50, near = 1 - 0x1p-40;
    double *side = x + s->switches->slot, above, below;
    motus_status status = rate_at_corner(s, k, 1, way, t, x, v, &above, err);
    if (status == MOTUS_OK) status = rate_at_corner(s, k, -1, way, t, x, v, &below, err);
    if (status != MOTUS_OK) return status;
    const double middle = below / (below - above) * 2 - 1; /* with this value of all signs the rate is 0 */
    *held = above < 0 && below > 0 && !(going && going * middle >= near);
    if (!*held) {
        if (above > 0 && below < 0) return sides_refuse(s, k, not_unique, t, err);
        const int to = above < 0 && below > 0 ? going : above >= 0 ? 1 : -1;
        sides_put(s, side, k, sides_side_of(s, k, to));
        for (size_t n = 0; n < s->switches->count; n++)
            if (s->beside[n]) sides_put(s, side, n, s->beside[n] * to);
        return MOTUS_OK;
    }
    double c = middle;
    if (going) {
        const double one = pin(s, k, 0.5, t, x, v), other = pin(s, k, -0.5, t, x, v);
        const double aim = (-0.75 * going - (one + other) / 2) / (one - other);
        if (isfinite(aim)) c = aim;
    }
    pin(s, k, fabs(c) > most ? copysign(most, c) : c, t, x, v);
    sides_put(s, side, k, way > 0 ? SWITCHES_HELD : SWITCHES_HELD_BACKWARD);
    return MOTUS_OK;
}

motus_status sides_choose(sides *s, size_t k, bool left, double way, double t, double *x, double *v, motus_error *err)
{
    const operation op = sides_op_of(s, k);
    double *all = x + s->switches->slot, on[2], side = all[k];
    const double above = switches_side(op, 1, 0), below = switches_side(op, -1, 0);
    motus_status status = rate_on(s, k, above, way, t, x, v, &on[0], err);
    if (status == MOTUS_OK) status = rate_on(s, k, below, way, t, x, v, &on[1], err);
    if (status != MOTUS_OK) return status;
    if (s->hold && s->switches->slides[switches_kind(s->switches, k)] == SLIDES_HELD) {
        size_t beside;
        bool held;
        status = sides_find_beside(s, k, NULL, way, t, x, v, &beside, err);
        if (status == MOTUS_OK && beside) return sides_stand_at_corner(s, k, 0, way, t, x, v, &held, err);
        if (status != MOTUS_OK) return status;
    }
    const double bound = unsure(s, k, on, t, x, v);
    for (int i = 0; i < 2; i++)
        if (fabs(on[i]) <= bound) on[i] = 0;
    if (on[0] > 0 && on[1] < 0) return sides_refuse(s, k, not_unique, t, err);
    if (on[0] < 0 && on[1] > 0) return hold(s, k, way * on[0], way * on[1], t, x, v, err);
    if (on[0] == 0 && on[1] == 0 && left && (side == above || side == below)) {
        side = side == above ? below : above;
    } else if (on[0] == 0 && on[1] == 0) {
        int up, down, there = 0;
        status = look_ahead(s, k, above, 0, way, t, x, v, &up, err);
        if (!status) status = look_ahead(s, k, below, 0, way, t, x, v, &down, err);
        if (status != MOTUS_OK) return status;
        if (switches_jumps(op) && up > 0 && down < 0) return sides_refuse(s, k, not_unique, t, err);
        if ((up > 0) != (down < 0)) {
            side = up > 0 ? above : below;
        } else if (switches_jumps(op)) {
            status = look_ahead(s, k, side, 0, way, t, x, v, &there, err);
            side = switches_side(op, 0, there);
        } else { /* both formulas agree while the argument is 0 */
            side = above;
        }
    } else {
        side = on[0] + on[1] > 0 ? above : below;
    }
    sides_put(s, all, k, side);
    return status;
}

/* Returns whether the force has a value, as it has none beyond the ends of a table. */
static bool has_force(const sides *s)
{
    for (size_t i = 0; i < s->problem->nv; i++)
        if (!isfinite(s->a[i])) return false;
    return true;
}

/* Bounds the rounding of the rate of argument k, which s->du has, by accelerations in s->a. */
static double rate_rounding(sides *s, size_t k, double t, double *x, double *v)
{
    const size_t nv = s->problem->nv;
    const double rate = s->du[k];
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = s->b};
    memset(s->b, 0, nv * sizeof *s->b);
    tape_run(s->force_rounding, t, base);
    sides_evaluate(s, s->rate_rounding, t, x, v, s->a, s->later);
    double hidden = 0x1p-52 * s->later[k];
    for (int pattern = 1; pattern <= 2; pattern++) { /* as in look_ahead */
        for (size_t i = 0; i < nv; i++)
            s->v[i] = s->a[i] + (i % (size_t)pattern ? -1 : 1) * 0x1p-52 * fmin(s->b[i], 0x1p1000);
        sides_evaluate(s, s->rate, t, x, v, s->v, s->later);
        hidden += fabs(s->later[k] - rate);
    }
    return hidden;
}

/* Chooses the side of a value in a table, at a point where two rows meet. Both have one value there, but for rounding,
 * so the motion is unique, and its rate is that of both sides. Where rounding hides the rate, the first derivative
 * that shows tells. */
static motus_status choose_row(sides *s, size_t k, bool left, double at, const double on[2], double way, double t,
                               double *x, double *v, motus_error *err)
{
    double *side = x + s->switches->slot + k;
    const double bound = rate_rounding(s, k, t, x, v);
    int up, down = 0;
    if (fmin(fabs(on[0]), fabs(on[1])) > bound && (on[0] > 0) == (on[1] > 0)) {
        *side = on[0] < 0 ? at - 1 : at;
        return MOTUS_OK;
    }
    motus_status status = look_ahead(s, k, at, at, way, t, x, v, &up, err);
    if (status == MOTUS_OK && up <= 0) status = look_ahead(s, k, at - 1, at, way, t, x, v, &down, err);
    if (status != MOTUS_OK) return status;
    if (up || down || !left)
        *side = up <= 0 && (up || down < 0) ? at - 1 : at;
    else
        *side = switches_beyond(OP_FIND, *side, s->u[k]);
    return status;
}

motus_status sides_choose_count(sides *s, size_t k, bool left, double at, double way, double t, double *x, double *v,
                                motus_error *err)
{
    double *side = x + s->switches->slot + k, on[2];
    bool has[2];
    motus_status status = MOTUS_OK;
    for (int i = 0; i < 2 && status == MOTUS_OK; i++)
        status = rate_on(s, k, at - i, way, t, x, v, &on[i], err), has[i] = has_force(s);
    if (status != MOTUS_OK) return status;
    if (has[0] != has[1]) { /* an end of a table: the motion that leads to it may turn back there */
        const double inside = has[0] ? at : at - 1, outside = has[0] ? at - 1 : at;
        int goes;
        status = look_ahead(s, k, inside, at, way, t, x, v, &goes, err);
        *side = goes && (goes > 0) == (outside == at) ? outside : inside;
        return status;
    }
    if (sides_op_of(s, k) == OP_FIND) return choose_row(s, k, left, at, on, way, t, x, v, err);
    if (on[0] > 0 && on[1] < 0) return sides_refuse(s, k, not_unique, t, err);
    if (on[0] < 0 && on[1] > 0)
        return sides_refuse(s, k, "the motion slides along a jump of the force, which drives it back from both sides,",
                            t, err);
    if (on[0] == 0 && on[1] == 0 && left) {
        *side = switches_beyond(sides_op_of(s, k), *side, s->u[k]);
    } else if (on[0] == 0 && on[1] == 0) {
        int up;
        status = look_ahead(s, k, at, at, way, t, x, v, &up, err);
        *side = up < 0 ? at - 1 : at;
    } else {
        *side = on[0] + on[1] < 0 ? at - 1 : at;
    }
    return status;
}

/* Tells whether a held switch k is let go because its value, but for rounding, no longer drives the argument back to 0.
 * Writes the value to p. */
static bool lost_grip(sides *s, size_t k, double t, double *x, double *v)
{
    if (sides_accelerate(s, t, x, v, NULL) != MOTUS_OK) return false;
    sides_evaluate(s, s->hold, t, x, v, NULL, s->p);
    sides_evaluate(s, s->grip, t, x, v, NULL, s->r);
    sides_evaluate(s, s->grip_rate, t, x, v, s->a, s->dr);
    const double moved = fabs(s->dr[k]) * (nextafter(fabs(t), INFINITY) - fabs(t));
    sides_evaluate(s, s->grip_rounding, t, x, v, NULL, s->dr);
    return !(fabs(s->p[k]) > 1 - 0x1p-20) || fabs(s->r[k]) <= 4 * (0x1p-53 * s->dr[k] + moved);
}

motus_status sides_change(sides *s, size_t k, double way, double t, double *x, double *v, motus_error *err)
{
    const operation op = sides_op_of(s, k);
    double *side = x + s->switches->slot + k;
    sides_evaluate(s, s->argument, t, x, v, NULL, s->u);
    if (s->hold && sides_is_held(s, x + s->switches->slot, k)) {
        size_t beside;
        bool held;
        if (lost_grip(s, k, t, x, v)) return sides_refuse(s, k, not_unique, t, err);
        const int to = s->p[k] > 0 ? 1 : -1;
        const motus_status status = sides_find_beside(s, k, NULL, way, t, x, v, &beside, err);
        if (status != MOTUS_OK) return status;
        if (beside) return sides_stand_at_corner(s, k, to, way, t, x, v, &held, err);
        sides_put(s, x + s->switches->slot, k, sides_side_of(s, k, to));
        return MOTUS_OK;
    }
    if (switches_counts(op)) return sides_choose_count(s, k, true, round(s->u[k]), way, t, x, v, err);
    if (*side == 0 && (op == OP_ABS || op == OP_SIGN || op == OP_CBRT))
        return sides_choose(s, k, true, way, t, x, v, err);
    if (switches_jumps(op)) return sides_choose(s, k, true, way, t, x, v, err);
    *side = switches_beyond(op, *side, 0);
    return MOTUS_OK;
}
