/* See pace.h. */
#include "api/motion/pace.h"

#include <time.h>

double pace_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

motus_status pace_advance(pace *p, stepper *s, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    if (!p->tell) return stepper_advance(s, limit, why, err);
    if (p->piece < 1) p->piece = 1;
    for (;;) {
        const int64_t piece = limit.steps < p->piece ? limit.steps : p->piece;
        const double began = pace_now();
        const motus_status status = stepper_advance(s, (stepper_limit){piece, limit.until}, why, err);
        const double now = pace_now(), took = now - began;
        limit.steps -= piece;
        if (status != MOTUS_OK) return status;
        if (took < p->seconds && piece == p->piece && piece < INT64_MAX / 4)
            p->piece *= 2;
        else if (took > 4 * p->seconds && p->piece > 1)
            p->piece /= 2;
        if (p->tell(p->ctx, now)) {
            *why = STOP_FAILED;
            return MOTUS_CANCELLED;
        }
        if (*why != STOP_STEPS || limit.steps <= 0) return MOTUS_OK;
    }
}
