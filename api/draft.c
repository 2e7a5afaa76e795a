/* What an editor proposes for a model that is being written. See draft.h.
 *
 * A picture wants to show a few swings, and each step in them. Invariant: the numbers have two digits, but where equal
 * steps must reach the end.
 */
#include "api/draft.h"

#include "api/follow.h"
#include "base/decimal.h"

#include <math.h>
#include <stdio.h>

#define TWO_PI 6.283185307179586
#define STEPS_A_SWING 60
#define STEPS_A_RATE 15 /* at least, in the period of the fastest rate at the start */
#define STEPS_A_FLIGHT 20
#define STEPS_MOST 1e4
#define HORIZON 200 /* of the scales of time at the start: so long the motion is followed */
#define SCALES 5    /* of what decays */
#define SHORT_OF 0.95

typedef enum rounding { NEAR, DOWN } rounding;

/* x > 0 with so many digits: the double of that decimal. */
static double rounded(double x, int count, rounding way)
{
    int exponent;
    const double least = decimal_scaled(1, count - 1), unit = (frexp(x, &exponent), 0.30103 * exponent);
    if (!(x > 1e-290 && x < 1e290)) return x;
    int power = (int)unit - count - 1; /* below, as the cast cuts towards 0 */
    while (10 * least * decimal_scaled(1, power) <= x) power++;
    const double digits = x / decimal_scaled(1, power);
    return decimal_scaled(way == DOWN ? floor(digits + 1e-9) : floor(digits + 0.5), power);
}

/* A proposal: numbers before they are rounded. */
typedef struct proposal {
    double step, duration;
    rounding end;
} proposal;

static const char *word_of(const motus_system *s, size_t number)
{
    const model_state *of = &s->states[0];
    for (uint32_t i = 1; i < s->state_count; i++)
        if (s->states[i].base <= number && (s->states[i].base > of->base || of->base > number)) of = &s->states[i];
    return of->order == 1 ? "cycle" : of->components > 1 ? "turn" : "swing";
}

static void of_swings(const motus_system *s, const draft_scales *d, const followed *m, proposal *p, motus_settings *set)
{
    const char *word = word_of(s, m->slowest);
    p->step = m->shortest / STEPS_A_SWING;
    p->duration = 3 * m->longest;
    snprintf(set->step_why, sizeof set->step_why, "%d to a %s", STEPS_A_SWING, word);
    snprintf(set->until_why, sizeof set->until_why, "three %ss", word);
    const double fast = fmin(TWO_PI / d->rate / STEPS_A_RATE, m->change > 0 ? m->change : INFINITY);
    if (p->step <= fast) return;
    p->step = fast;
    snprintf(set->step_why, sizeof set->step_why, "its fastest change");
}

static void of_bound(const draft_scales *d, const followed *m, proposal *p, motus_settings *set)
{
    char at[DECIMAL_MAX];
    p->duration = SHORT_OF * m->bound;
    p->end = DOWN;
    p->step = p->duration / STEPS_A_SWING;
    snprintf(set->step_why, sizeof set->step_why, "%d steps", STEPS_A_SWING);
    snprintf(set->until_why, sizeof set->until_why, "infinite at %s",
             decimal(d->from + rounded(m->bound, 3, DOWN), at));
}

static void of_growth(const followed *m, proposal *p, motus_settings *set)
{
    p->duration = m->grown;
    p->step = m->grown / STEPS_A_SWING;
    snprintf(set->step_why, sizeof set->step_why, "%d steps", STEPS_A_SWING);
    snprintf(set->until_why, sizeof set->until_why, "grown %d times", FOLLOW_GROWTH);
}

static void of_flight(double duration, bool lands, proposal *p, motus_settings *set)
{
    p->duration = duration;
    p->step = duration / STEPS_A_FLIGHT;
    snprintf(set->step_why, sizeof set->step_why, "%d steps", STEPS_A_FLIGHT);
    snprintf(set->until_why, sizeof set->until_why, "%s", lands ? "when it is at 0" : "");
}

/* What the motion does not tell, because it does nothing, or because it is too large to follow: the equations at the
 * start. */
static void of_rates(const draft_scales *d, proposal *p, motus_settings *set)
{
    p->duration = (d->turns ? 3 : SCALES) * d->period;
    p->step = TWO_PI / d->rate / STEPS_A_SWING;
    snprintf(set->step_why, sizeof set->step_why, "%d to its fastest swing", STEPS_A_SWING);
    snprintf(set->until_why, sizeof set->until_why,
             d->turns ? "three of its slowest swings" : "%d of its scales of time", SCALES);
    if (!d->turns) snprintf(set->step_why, sizeof set->step_why, "its fastest rate");
}

/* Makes both numbers plain, and keeps what is given. */
static void settle(const draft_scales *d, proposal *p, motus_settings *set)
{
    const bool ends = !isnan(set->until);
    if (!isnan(set->step))
        p->step = set->step;
    else if (ends && d->duration / p->step > STEPS_MOST)
        p->step = rounded(d->duration / STEPS_MOST, 2, NEAR);
    else
        p->step = rounded(fmin(p->step, d->duration > 0 ? d->duration / STEPS_A_FLIGHT : INFINITY), 2, NEAR);
    if (!ends && p->duration > STEPS_MOST * p->step) {
        p->duration = STEPS_MOST * p->step;
        snprintf(set->until_why, sizeof set->until_why, "%.0f steps", STEPS_MOST);
    }
    const double duration = ends ? d->duration : fmax(rounded(p->duration, 2, p->end), p->step);
    if (!isnan(set->step)) {
        set->step_why[0] = 0;
    } else {
        set->step = d->uniform && d->duration > 0 ? duration / ceil(duration / p->step) : p->step;
    }
    if (ends)
        set->until_why[0] = 0;
    else
        set->until = d->from + (d->uniform ? ceil(duration / set->step - 1e-9) * set->step : duration);
}

motus_status draft_choose(motus_system *s, const draft_scales *d, motus_settings *set, motus_error *err)
{
    followed m = {0};
    proposal p = {.end = NEAR};
    const double way = set->until < d->from ? -1 : 1, horizon = HORIZON * d->period;
    if (d->rate > 0 && !follow_motion(s, d->from, way, d->rate, horizon, &m))
        return fail(err, MOTUS_MEMORY, "no memory to follow the motion");
    if (d->rate == 0)
        of_flight(d->period, d->lands, &p, set);
    else if (m.shortest > 0)
        of_swings(s, d, &m, &p, set);
    else if (m.bound > 0)
        of_bound(d, &m, &p, set);
    else if (m.landed > 0)
        of_flight(m.landed, true, &p, set);
    else if (m.grown > 0)
        of_growth(&m, &p, set);
    else
        of_rates(d, &p, set);
    settle(d, &p, set);
    return MOTUS_OK;
}
