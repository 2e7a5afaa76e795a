/* See course.h. */
#include "core/course.h"

motus_status course_run(const course *c, motus_error *err)
{
    stepper_stop why;
    /* advancing by 0 steps tells whether the course ends where it starts */
    motus_status status = c->advance(c->ctx, (stepper_limit){0, c->until}, &why, err);
    while (!status && why == STOP_STEPS) {
        const int64_t steps = c->every && !c->observes ? c->every : INT64_MAX;
        if (c->every) status = c->observe(c->ctx, err);
        if (!status) status = c->advance(c->ctx, (stepper_limit){steps, c->until}, &why, err);
    }
    return status ? status : c->observe(c->ctx, err);
}
