/* With which power the force departs from a smooth one: at roots, and at touches. See locate_parts.h. */
#include "api/motion/locate_parts.h"

#include "api/motion/jump.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define TOUCHED 1e-7 /* of an argument at the ends of a step: where it is least, this is 0 */
#define ALIKE 0.05   /* powers of a jump this near to one another are the same */
#define EDGE 0x1p-20 /* of a step: a touch nearer than this to its end is there */

/* Computes the acceleration on these sides at `from`. False: it cannot be evaluated. */
static bool accelerate(const locate *l, const double *sides, double *a)
{
    const problem *p = &l->problem;
    memcpy(l->beyond.x, l->from.x, p->nx * sizeof(double));
    memcpy(l->beyond.v, l->from.v, p->nv * sizeof(double));
    for (size_t k = 0; k < p->nv; k++) a[k] = 0;
    return held_bind(l->held, sides, false) && p->accel(p->ctx, l->from.t, l->beyond.x, l->beyond.v, a) == 0;
}

/* Returns the largest difference of the accelerations on old and new sides; 0 where one of them is not defined. */
double locate_leap(const locate *l)
{
    double *a = l->beyond.a, *b = l->to.a, most = 0;
    if (!accelerate(l, l->old_side, a) || !accelerate(l, l->side, b)) return 0;
    for (size_t k = 0; k < l->problem.nv; k++) most = fmax(most, fabs(a[k] - b[k]));
    return most <= DBL_MAX ? most : 0;
}

typedef struct near {
    const motus_run *run;
    const place *at;
    bool straight; /* the positions move evenly, so that powers of them are powers of the time */
} near;

/* Computes the acceleration of the model itself, whose switches choose their sides. */
static bool force_near(void *ctx, double way, double *a)
{
    const near *n = ctx;
    const problem *p = &n->run->system->problem;
    place *beyond = &n->run->locate->beyond;
    locate_follow(p, n->at, way, beyond->x, beyond->v);
    for (size_t k = 0; n->straight && k < p->nx; k++) beyond->x[k] = n->at->x[k] + way * n->at->v[k];
    for (size_t k = 0; k < p->nv; k++) a[k] = 0;
    return p->accel(p->ctx, n->at->t + way, beyond->x, beyond->v, a) == 0;
}

/* Records with which power of the time the force departs from a smooth one at a place, near a step of size h. */
void locate_note(motus_run *r, const place *at, double h)
{
    locate *l = r->locate;
    near n = {r, at, false};
    if (l->jump <= 0) return;
    const problem *p = &l->problem;
    double rounding = 0x1p-52 * fabs(at->t);
    for (size_t k = 0; k < p->nx; k++) { /* the time in which x moves by its rounding */
        const double off = 0x1p-52 * fabs(at->x[k]), late = fmin(off / fabs(at->v[k]), sqrt(off / fabs(at->a[k])));
        if (late > rounding && late <= DBL_MAX) rounding = late;
    }
    double power = jump_power(force_near, &n, p->nv, h, rounding, l->room);
    n.straight = isnan(power);
    for (size_t k = 0; k < p->nx; k++) n.straight = n.straight && !(fabs(at->v[k]) < fabs(h * at->a[k]));
    if (n.straight) power = jump_power(force_near, &n, p->nv, h, rounding, l->room);
    if (isnan(power) || power >= l->jump - ALIKE) return; /* false where there was none */
    l->jump = power;
    l->jump_time = at->t;
}

/* ---- touches ---- */

/* Returns the rate of touch k after a part of the step, whose end is then `beyond`; NaN: it cannot be computed. */
static double touch_rate(motus_run *r, size_t k, double h, double part, motus_status *status, motus_error *err)
{
    locate *l = r->locate;
    *status = locate_try(r, &l->from, part * h, &l->beyond, err);
    if (*status != MOTUS_OK) return NAN;
    held_touch_rates(l->held, l->beyond.t, l->beyond.x, l->beyond.v, l->beyond.a, l->touch_rate[1]);
    return h * l->touch_rate[1][k];
}

/* Finds the part of the step at which the argument of touch k is least, and leaves the state there in `beyond`. rate0,
 * rate1: at both ends. */
static motus_status least_of(motus_run *r, size_t k, double h, double rate0, double rate1, double *part,
                             motus_error *err)
{
    double low = 0, high = 1;
    motus_status status = MOTUS_OK;
    *part = 1;
    for (int turn = 0, moved = 0; turn < LOCATE_HALVINGS_MAX && high - low > 0x1p-51 && status == MOTUS_OK; turn++) {
        double z = low + (high - low) * rate0 / (rate0 - rate1);
        if (turn % 4 == 3 || !(z > low && z < high)) z = 0.5 * (low + high);
        if (r->locate->from.t + z * h == r->locate->from.t) break;
        const double rate = touch_rate(r, k, h, *part = z, &status, err);
        if (rate == 0) break;
        if (rate < 0) {
            low = z, rate0 = rate;
            if (moved < 0) rate1 /= 2;
            moved = -1;
        } else {
            high = z, rate1 = rate;
            if (moved > 0) rate0 /= 2;
            moved = 1;
        }
    }
    return status;
}

/* Finds the first touch in the step, by its tangents at both ends: the force is not smooth at a touch, although no
 * argument changes its side. */
motus_status locate_touch(motus_run *r, double h, double *fraction, motus_error *err)
{
    locate *l = r->locate;
    *fraction = 1;
    if (!l->touches) return MOTUS_OK;
    held_touch(l->held, l->from.t, l->from.x, l->from.v, l->touch[0]);
    held_touch(l->held, l->to.t, l->to.x, l->to.v, l->touch[1]);
    held_touch_rates(l->held, l->from.t, l->from.x, l->from.v, l->from.a, l->touch_rate[0]);
    for (size_t k = 0; k < l->touches; k++) {
        held_touch_rates(l->held, l->to.t, l->to.x, l->to.v, l->to.a, l->touch_rate[1]);
        const double u0 = l->touch[0][k], u1 = l->touch[1][k], s0 = h * l->touch_rate[0][k],
                     s1 = h * l->touch_rate[1][k], meet = (u1 - s1 - u0) / (s0 - s1);
        if (!(s0 < 0 && s1 >= 0 && u0 + s0 * meet < 0.25 * fmin(u0, u1))) continue; /* the tangents meet above 0 */
        double part;
        const motus_status status = least_of(r, k, h, s0, s1, &part, err);
        if (status == MOTUS_MEMORY) return status;
        if (status != MOTUS_OK) continue;
        double *u = l->touch_rate[1];
        held_touch(l->held, l->beyond.t, l->beyond.x, l->beyond.v, u);
        if (!(fabs(u[k]) <= TOUCHED * fmax(u0, u1))) continue;
        locate_copy(&l->twice, &l->beyond, &l->problem, l->count);
        locate_note(r, &l->twice, r->timing.h);
        if (!(part > EDGE && part < 1 - EDGE && part < *fraction)) continue;
        *fraction = part;
        locate_copy(&l->found, &l->twice, &l->problem, l->count);
    }
    return MOTUS_OK;
}
