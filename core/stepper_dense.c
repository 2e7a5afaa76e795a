/* Dense output: the state at a time within the last step, and bounds on its accelerations. See stepper.h. */
#include "core/stepper_parts.h"

#include "step/swing.h"

#include <math.h>

/* Takes the room that the family's dense output needs besides the ends, and computes its constants. */
static motus_status make_room(stepper *s, motus_error *err)
{
    const work *w = &s->work;
    s->room = s->body->between(w, NULL);
    const size_t arrays = (size_t)s->room.arrays * w->stride;
    s->inside = take(&s->allocator, arrays + s->room.constants + 1, sizeof *s->inside);
    if (!s->inside) return fail(err, MOTUS_MEMORY, "out of memory for dense output");
    s->body->between(w, s->inside + arrays);
    return MOTUS_OK;
}

static dense_step last_step(const stepper *s)
{
    const size_t nx = s->work.nx, nv = s->work.nv, apart = nx + 2 * nv;
    const double *e = s->ends;
    return (dense_step){
        .end = {{s->left_t, e, e + nx, e + nx + nv}, {stepper_time(s), e + apart, e + apart + nx, e + apart + nx + nv}},
        .more = s->inside,
        .unit = s->inside + (size_t)s->room.arrays * s->work.stride};
}

/* Tells whether t lies between the mark and the present time. */
static bool marked(const stepper *s, double t)
{
    const double way = s->leg_h < 0 ? -1 : 1;
    return s->left && way * (t - s->left_t) >= 0 && way * (stepper_time(s) - t) >= 0;
}

static bool swing_by_ends(stepper *s, double *most)
{
    const work *w = &s->work;
    if (stepper_right_end(s, NULL)) return false;
    const size_t nx = w->nx, nv = w->nv;
    const double *from = s->ends, *to = from + nx + 2 * nv;
    swing_of_ends(nx, nv, w->h, from, from + nx, from + nx + nv, to, to + nx, to + nx + nv, most);
    return true;
}

bool stepper_swing(stepper *s, double *most)
{
    const work *w = &s->work;
    if (!s->left || s->left_steps != stepper_steps(s) - 1) return false;
    if (row_bounded_by_ends(&s->method)) return swing_by_ends(s, most);
    for (size_t k = 0; k < w->nv; k++) most[k] = w->expands ? 0 : fabs(s->ends[w->nx + w->nv + k]);
    return s->body->swing(w, most);
}

/* Makes ready for dense output at time t. */
static motus_status prepare(stepper *s, double t, motus_error *err)
{
    const bool again = !marked(s, t) && !(s->left && s->left_steps == stepper_steps(s) - 1);
    motus_status status = again ? stepper_again(s, err) : MOTUS_OK;
    if (status) return status;
    s->asked = s->asked || again;
    if (!marked(s, t)) {
        char a[DECIMAL_MAX], b[DECIMAL_MAX];
        fail(err, MOTUS_ARGUMENT, "the time %s lies before the last step of the run, which is at %s", decimal(t, a),
             decimal(stepper_time(s), b));
        hint(err, "give times within the last step or after it");
        return MOTUS_ARGUMENT;
    }
    status = stepper_right_end(s, err);
    if (!status && !s->inside) status = make_room(s, err);
    if (status || s->extended) return status;
    const dense_step step = last_step(s);
    s->extended = s->body->extend(&s->work, &step) == STEP_OK;
    return s->extended ? MOTUS_OK : stepper_report(s, STEP_CALLBACK, t, err);
}

motus_status stepper_sample(stepper *s, double t, double *x, double *v, motus_error *err)
{
    const bool ready = s->right && s->extended && marked(s, t);
    const motus_status status = ready ? MOTUS_OK : prepare(s, t, err);
    if (status) return status;
    const dense_step step = last_step(s);
    if (s->body->dense(&s->work, &step, t, x, v)) return stepper_report(s, STEP_CALLBACK, t, err);
    if (s->problem.refresh) s->problem.refresh(s->problem.ctx, t, x, v);
    return MOTUS_OK;
}
