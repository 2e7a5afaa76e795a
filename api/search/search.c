/* See accuracy.h.
 *
 * The error of the answer is proportional to the tolerance, or to a power of the step, up to a factor that no formula
 * knows: how the motion amplifies errors, and how they cancel. So one trial tells the size of the next. A trial that is
 * far off is not taken to its end; its bar there is guessed, with the square of the time.
 *
 * Where bars no longer fall with the tolerance, rounding decides, and no tolerance helps. One trial does not prove
 * that, since the bar before may have been small by chance; two do.
 */
#include "api/search/accuracy.h"

#include "base/decimal.h"
#include "lang/base/operation.h"

#include <math.h>

enum { TRIALS = 6, STUCK = 2 };
#define MARGIN 0.3            /* of the accuracy: what the next trial aims at */
#define HOPELESS 30           /* times the accuracy: a trial with such a bar ends early */
#define ROUNDED 1e-8          /* no trial ends early with a bar below this, relative to the motion */
#define WRECKED 0.05          /* a trial with such a bar says no more than that the tolerance was far too large */
#define NEARER 1e-2           /* factor of the next tolerance after a wrecked trial */
#define FARTHEST 1e-6         /* smallest factor from one trial to the next */
#define FALLS 0.7             /* a bar falls if it is below this part of the smallest before */
#define TOLERANCE_TRIED 5e-15 /* a smaller relative tolerance is rounding */
#define STEPS_TRIED 1e8       /* most steps of a fixed size */

static motus_status refuse(const char *what, const char *instead, motus_error *err)
{
    fail(err, MOTUS_ARGUMENT, "%s", what);
    hint(err, "%s", instead);
    return MOTUS_ARGUMENT;
}

motus_status search_alone(bool tolerance, bool step, motus_error *err)
{
    if (tolerance)
        return refuse("an accuracy and a tolerance are given",
                      "give one of them: the accuracy is the error of the answer, the tolerance that of one step", err);
    if (step)
        return refuse("a step and an accuracy are given", "give one of them: the accuracy decides how long steps are",
                      err);
    return MOTUS_OK;
}

/* Sets the size: fixed steps divide the way; a tolerance has two digits, so that it can be given again. */
void search_set(search *s, double size)
{
    int power = 0;
    if (s->length > 0) {
        s->size = s->length / ceil(s->length / size * (1 - 1e-12));
        return;
    }
    for (; size < 10 && power > -300; power--) size *= 10;
    for (; size >= 100; power++) size /= 10;
    double digits = floor(size * (1 + 1e-12));
    if (s->few) digits = digits >= 50 ? 50 : digits >= 20 ? 20 : 10;
    s->size = decimal_scaled(digits, power);
}

search search_by_tolerance(double wanted, bool absolute)
{
    search s = {.wanted = wanted,
                .absolute = absolute,
                .power = 1,
                .least = absolute ? 0 : TOLERANCE_TRIED,
                .smallest = INFINITY};
    search_set(&s, fmax(s.least, wanted / 10));
    return s;
}

search search_by_step(double wanted, bool absolute, double step, double length, int order)
{
    search s = {.wanted = wanted,
                .absolute = absolute,
                .power = order > 0 ? order : 1,
                .least = length / STEPS_TRIED,
                .length = length,
                .smallest = INFINITY};
    search_set(&s, step);
    return s;
}

static double next_size(const search *s, double bar, double done)
{
    const double whole = done > 0 ? bar / (done * done) : INFINITY;
    double factor = fmax(FARTHEST, fmin(1, MARGIN * s->wanted / whole));
    if (!(bar < WRECKED) && !s->absolute) factor = fmin(fmax(factor, NEARER / 10), NEARER);
    if (!isfinite(bar)) factor = NEARER;
    return fmax(s->least, s->size * operation_value(OP_POW, factor, 1 / s->power, 0));
}

bool search_next(search *s, double bar, double done)
{
    const double next = next_size(s, bar, done);
    const bool whole = done >= 1;
    s->trials++;
    if (whole) {
        s->stuck = bar < FALLS * s->smallest ? 0 : s->stuck + 1;
        s->smallest = fmin(bar, s->smallest);
    }
    if (s->smallest <= s->wanted || s->stuck == STUCK || !(next < s->size) || s->trials == TRIALS) return false;
    search_set(s, next);
    return true;
}

/* Bars near the rounding are no reason to stop: they may be the best that there is. */
bool search_hopeless(const search *s, double bar, double relative)
{
    return bar > HOPELESS * s->wanted && relative > ROUNDED;
}
