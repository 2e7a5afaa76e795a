/* The Jacobian matrices at the state of a run: motus_run_jacobian.
 *
 * Columns come one at a time: the exact derivative in the direction of one number, or the difference quotient that the
 * solver of implicit methods takes. Invariant: the run and its counts do not change.
 */
#include "api/system/linear.h"
#include "api/motion/run.h"

#include "core/solver.h"

#include <math.h>
#include <string.h>

typedef struct jacobian {
    motus_run *run;
    const problem *problem;
    double t;
    double *x, *v;                              /* the run's synchronised state, in the inside order */
    double *direction, *image, *base, *shifted; /* problem->nv numbers each */
    size_t *row;                                /* the place in v that each row has */
} jacobian;

static motus_status failed(const jacobian *j, motus_error *err)
{
    char t[DECIMAL_MAX];
    return fail(err, MOTUS_CALLBACK, "the derivative callback reported a failure at t = %s",
                decimal_time(j->t, j->t, t));
}

/* Computes image, the derivative with respect to number `at` of v (in_v) or of x. */
static motus_status column(const jacobian *j, bool in_v, size_t at, double size, motus_error *err)
{
    const problem *p = j->problem;
    if (p->jvp) {
        j->direction[at] = 1;
        const int bad =
            p->jvp(p->ctx, j->t, j->x, j->v, in_v ? NULL : j->direction, in_v ? j->direction : NULL, j->image);
        j->direction[at] = 0;
        return bad ? failed(j, err) : MOTUS_OK;
    }
    const double *y = in_v ? j->v : j->x;
    memcpy(j->shifted, y, (in_v ? p->nv : p->nx) * sizeof *y);
    j->shifted[at] = y[at] + solver_shift(y[at], size, in_v ? p->traits.linear_v : p->traits.affine);
    const double shift = j->shifted[at] - y[at];
    if (p->accel(p->ctx, j->t, in_v ? j->x : j->shifted, in_v ? j->shifted : j->v, j->image)) return failed(j, err);
    for (size_t k = 0; k < p->nv; k++) j->image[k] = (j->image[k] - j->base[k]) / shift;
    return MOTUS_OK;
}

static motus_status derive(const jacobian *j, bool in_v, double *out, motus_error *err)
{
    const motus_system *s = j->run->system;
    const problem *p = j->problem;
    const size_t rows = s->velocities, columns = in_v ? s->velocities : s->positions;
    if (p->jvp && p->prepare && !p->prepare(p->ctx, in_v))
        return fail(err, MOTUS_MEMORY, "no memory for the derivatives");
    double size = 0;
    for (size_t k = 0; k < (in_v ? p->nv : linear_positions(p)); k++) size = fmax(size, fabs((in_v ? j->v : j->x)[k]));
    if (size == 0 || !isfinite(size)) size = 1;
    for (size_t c = 0; c < columns; c++) {
        motus_status status = column(j, in_v, in_v ? j->row[c] : system_number(s, c, false), size, err);
        for (size_t r = 0; r < rows && status == MOTUS_OK; r++) out[r * columns + c] = j->image[j->row[r]];
        if (status != MOTUS_OK) return status;
    }
    return MOTUS_OK;
}

static motus_status jacobian_now(jacobian *j, double *da_dx, double *da_dv, motus_error *err)
{
    const problem *p = j->problem;
    motus_status status = run_sync(j->run, false, err);
    if (status != MOTUS_OK) return status;
    for (size_t r = 0; r < j->run->system->velocities; r++)
        j->row[r] = system_number(j->run->system, j->run->system->positions + r, true);
    if (p->refresh) p->refresh(p->ctx, j->t, j->x, j->v);
    if (!p->jvp && p->accel(p->ctx, j->t, j->x, j->v, j->base)) return failed(j, err);
    if (da_dx) status = derive(j, false, da_dx, err);
    if (da_dv && status == MOTUS_OK) status = derive(j, true, da_dv, err);
    return status;
}

motus_status motus_run_jacobian(motus_run *r, double *da_dx, double *da_dv, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r) return fail(err, MOTUS_ARGUMENT, "motus_run_jacobian needs a run");
    const motus_system *s = r->system;
    if (s->velocities > MOTUS_JACOBIAN_MAX) {
        fail(err, MOTUS_LIMIT, "a Jacobian of %zu velocities and first-order variables is too large; at most %d fit",
             s->velocities, MOTUS_JACOBIAN_MAX);
        hint(err, "linearise a smaller model of the same kind");
        return MOTUS_LIMIT;
    }
    const size_t n = s->problem.nv;
    double *room = take(&r->allocator, 4 * n + s->velocities + 1, sizeof *room);
    if (!room) return fail(err, MOTUS_MEMORY, "no memory for the derivatives");
    _Static_assert(sizeof(size_t) <= sizeof(double), "a row's place lies in the room of a number");
    jacobian j = {.run = r,
                  .problem = &s->problem,
                  .t = stepper_time(r->stepper),
                  .x = r->x,
                  .v = r->v,
                  .direction = room,
                  .image = room + n,
                  .base = room + 2 * n,
                  .shifted = room + 3 * n,
                  .row = (size_t *)(void *)(room + 4 * n)};
    modes m = modes_enter();
    motus_status status = jacobian_now(&j, da_dx, da_dv, err);
    modes_leave(m);
    give(&r->allocator, room);
    return status;
}
