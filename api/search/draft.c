/* What an editor proposes for a model that is being written. See draft.h.
 *
 * A picture wants to show a few swings, and each step in them. Invariant: the numbers have two digits, but where equal
 * steps must reach the end.
 */
#include "api/search/draft.h"

#include "base/decimal.h"

#include <math.h>
#include <stdio.h>

#define TWO_PI 6.283185307179586
#define STEPS_A_SWING 60
#define STEPS_A_RATE 15 /* least, in the period of the fastest rate at the start */
#define STEPS_A_FLIGHT 20
#define STEPS_MOST 1e4
#define HORIZON 200 /* of the time scales at the start: how long the motion is followed */
#define SCALES 5    /* of decay */
#define SHORT_OF 0.95
#define SEVERAL 1.15        /* the slowest swing over the fastest, from which they are told apart */
#define START "for a start" /* the reason of a number that does not follow from the motion */

typedef enum rounding { NEAR, DOWN } rounding;

/* Rounds x > 0 to `count` digits: to the double of that decimal. */
static double rounded(double x, int count, rounding way)
{
    int exponent;
    const double least = decimal_scaled(1, count - 1), unit = (frexp(x, &exponent), 0.30103 * exponent);
    if (!(x > 1e-290 && x < 1e290)) return x;
    int power = (int)unit - count - 1; /* below the power, as the cast cuts towards 0 */
    while (10 * least * decimal_scaled(1, power) <= x) power++;
    const double digits = x / decimal_scaled(1, power);
    return decimal_scaled(way == DOWN ? floor(digits + 1e-9) : floor(digits + 0.5), power);
}

/* A proposal, before its numbers are rounded. */
typedef struct proposal {
    double step, duration;
    int digits; /* of the duration */
    rounding end;
    bool counts; /* the reason of the step is the number of steps */
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
    const bool several = m->longest > SEVERAL * m->shortest;
    const char *mean = m->irregular ? ", on average" : "";
    p->step = m->shortest / STEPS_A_SWING;
    p->duration = 3 * m->longest;
    snprintf(set->step_why, sizeof set->step_why, several ? "%d to its fastest %s%s" : "%d to a %s%s", STEPS_A_SWING,
             word_of(s, m->fastest), mean);
    snprintf(set->until_why, sizeof set->until_why, several ? "three of its slowest %ss%s" : "three %ss%s",
             word_of(s, m->slowest), mean);
    const double fast = fmin(TWO_PI / fmax(d->rate, m->fast) / STEPS_A_RATE, m->change > 0 ? m->change : INFINITY);
    if (p->step <= fast) return;
    p->step = fast;
    snprintf(set->step_why, sizeof set->step_why, "its fastest change");
}

/* Proposes `steps` equal steps, which settle() counts; shorter ones where the draft was cut short. */
static void even_steps(const followed *m, int steps, double rate, proposal *p)
{
    p->step = p->duration / steps;
    if (rate > 0) p->step = fmin(p->step, TWO_PI / rate / STEPS_A_RATE);
    if (m && m->cut) p->step = fmin(p->step, m->step / 2);
    p->counts = true;
}

static void of_bound(const draft_scales *d, const followed *m, proposal *p, motus_settings *set)
{
    char at[DECIMAL_MAX];
    p->duration = SHORT_OF * m->bound;
    p->end = DOWN;
    even_steps(m, STEPS_A_SWING, d->rate, p);
    if (m->end == FOLLOW_UNDEFINED)
        snprintf(set->until_why, sizeof set->until_why, "near where its force is undefined");
    else
        snprintf(set->until_why, sizeof set->until_why, "%s at %s", m->end == FOLLOW_INFINITE ? "infinite" : "singular",
                 decimal(d->from + d->way * rounded(m->bound, 3, NEAR), at));
}

static void of_growth(const draft_scales *d, const followed *m, proposal *p, motus_settings *set)
{
    char at[DECIMAL_MAX];
    p->duration = m->grown;
    even_steps(m, STEPS_A_SWING, d->rate, p);
    if (m->since == 0)
        snprintf(set->until_why, sizeof set->until_why, "grown %d times", FOLLOW_GROWTH);
    else
        snprintf(set->until_why, sizeof set->until_why, "%d times its size at %s", FOLLOW_GROWTH,
                 decimal(d->from + d->way * rounded(m->since, 3, NEAR), at));
}

static void of_settling(const draft_scales *d, const followed *m, proposal *p, motus_settings *set)
{
    char to[DECIMAL_MAX];
    p->duration = 1.1 * m->settled;
    even_steps(m, STEPS_A_SWING, d->rate, p);
    snprintf(set->until_why, sizeof set->until_why, "settled to 1 %% of its range, followed to %s",
             decimal(d->from + d->way * rounded(m->elapsed, 2, DOWN), to));
}

/* Proposes the length of a flight. number: of v; its name is shown if there are several. */
static void of_flight(const motus_system *s, double duration, bool lands, size_t number, const followed *m, double rate,
                      proposal *p, motus_settings *set)
{
    char name[MOTUS_NAME_MAX] = "it";
    const problem *q = &s->problem;
    p->duration = duration;
    p->digits = lands ? 3 : 2;
    even_steps(m, STEPS_A_FLIGHT, rate, p);
    if (q->nv > 1 && q->name) q->name(q->ctx, false, number, name, sizeof name);
    if (lands) snprintf(set->until_why, sizeof set->until_why, "when %.40s is at 0", name);
}

/* Proposes by the equations at the start, where nothing moves or the motion shows nothing. */
static void of_rates(const draft_scales *d, const followed *m, proposal *p, motus_settings *set)
{
    p->duration = (d->turns ? 3 : SCALES) * d->period;
    p->step = TWO_PI / d->rate / STEPS_A_SWING;
    if (m->cut && m->step / 2 < p->step) {
        p->step = m->step / 2;
        snprintf(set->step_why, sizeof set->step_why, START);
    } else if (d->turns) {
        snprintf(set->step_why, sizeof set->step_why, "%d to its fastest %sswing", STEPS_A_SWING,
                 m->rests ? "small " : "");
    } else {
        snprintf(set->step_why, sizeof set->step_why, "its fastest rate at the start");
    }
    if (m->rests)
        snprintf(set->until_why, sizeof set->until_why,
                 d->turns ? "at rest; three of its slowest small swings" : "at rest, " START);
    else
        snprintf(set->until_why, sizeof set->until_why, START);
}

static double step_of(const draft_scales *d, bool ends, proposal *p)
{
    const double within = d->duration > 0 ? d->duration : INFINITY;
    if (ends && within < INFINITY && within / p->step > STEPS_MOST) {
        p->counts = true;
        return fmin(rounded(within / STEPS_MOST, 2, NEAR), rounded(d->stable, 2, DOWN));
    }
    if (within / STEPS_A_FLIGHT < p->step) p->counts = true;
    return rounded(fmin(p->step, within / STEPS_A_FLIGHT), 2, NEAR);
}

/* Rounds both numbers, keeps what is given, and counts the steps. */
static void settle(const draft_scales *d, proposal *p, motus_settings *set)
{
    const bool ends = !isnan(set->until), given = !isnan(set->step);
    p->step = given ? set->step : step_of(d, ends, p);
    if (!ends && p->duration > STEPS_MOST * p->step) {
        p->duration = STEPS_MOST * p->step;
        snprintf(set->until_why, sizeof set->until_why, "%.0f steps", STEPS_MOST);
    }
    const double duration = ends ? d->duration : fmax(rounded(p->duration, p->digits, p->end), p->step);
    if (!given) set->step = d->uniform && ends && duration > 0 ? duration / ceil(duration / p->step) : p->step;
    const double steps = ceil(duration / set->step - 1e-9);
    if (given)
        set->step_why[0] = 0;
    else if (p->counts)
        snprintf(set->step_why, sizeof set->step_why, "%.0f steps", steps);
    if (ends)
        set->until_why[0] = 0;
    else
        set->until = d->from + (d->uniform ? steps * set->step : duration);
}

/* Proposes by the first of these that the motion shows. */
static void of_motion(motus_system *s, const draft_scales *d, const followed *m, bool even, proposal *p,
                      motus_settings *set)
{
    if (m->shortest > 0)
        of_swings(s, d, m, p, set);
    else if (m->landed > 0)
        of_flight(s, m->landed, true, m->falling, m, even ? 0 : d->rate, p, set);
    else if (m->bound > 0)
        of_bound(d, m, p, set);
    else if (m->settled > 0)
        of_settling(d, m, p, set);
    else if (m->grown > 0)
        of_growth(d, m, p, set);
    else if (even)
        of_flight(s, d->period, false, 0, NULL, 0, p, set);
    else
        of_rates(d, m, p, set);
}

motus_status draft_choose(motus_system *s, draft_scales *d, motus_settings *set, motus_error *err)
{
    followed m = {0};
    proposal p = {.end = NEAR, .digits = 2};
    /* A force without a rate at the start may still change: it is followed at the pace of the flight. */
    const bool even = d->rate == 0;
    const double horizon = HORIZON * d->period;
    if (even) d->rate = 1 / d->period;
    d->way = set->until < d->from ? -1 : 1;
    if (even && s->problem.traits.constant)
        of_flight(s, d->period, d->lands, d->falling, NULL, 0, &p, set);
    else if (follow_motion(s, d->from, d->way, d->rate, horizon, &m))
        of_motion(s, d, &m, even, &p, set);
    else
        return fail(err, MOTUS_MEMORY, "no memory to follow the motion");
    settle(d, &p, set);
    return MOTUS_OK;
}
