/* The step and the end of a model that gives none: motus_suggest.
 *
 * Two scales of time decide: the fastest rate and the longest period at the start. They come from the equations
 * linearised there (rate.h), from how fast the state changes, and from samples of the force in time; where the force is
 * constant, from the initial values. Invariant: the same system gives the same numbers on every machine, and nothing
 * about the system changes.
 */
#include "api/vector.h"
#include "api/suggest.h"

#include "api/choice.h"
#include "api/draft.h"
#include "api/pilot.h"
#include "api/linear.h"

#include <math.h>
#include <string.h>

#define TWO_PI 6.283185307179586
#define PERIODS 10.0        /* of the longest one, up to the end */
#define STEPS_A_PERIOD 80.0 /* at least, in the shortest one */
#define STEPS_LEAST 100.0   /* up to the end */
#define STEPS_MOST 1e6      /* up to the end; of large systems fewer, */
#define NUMBERS_MOST 1e9    /*   so that steps times numbers stay below this, */
#define STEPS_ALWAYS 1000.0 /*   but never fewer than these */
#define NOISE_EXACT 1e-6    /* slower than this part of the fastest rate: rounding, with exact derivatives, */
#define NOISE_QUOTIENT 1e-4 /*   and with difference quotients */
#define NO_RATE 1e-15       /* of a draft: no motion is so slow, it is rounding */
#define DECAY 0.05          /* an eigenvalue is real if its imaginary part is less than this part of it */

typedef struct scales {
    motus_system *system;
    linear at;                  /* the start */
    double way;                 /* 1, or -1 where the run goes backward */
    double size_a, size_moving; /* size_moving: of the velocities of positions */
    bool turns, lands;          /* the longest is one of an oscillation; the period is a flight's */
    size_t falling;             /* the position with the largest force */
    double rate, period;        /* the fastest, 0: the force is constant; and the longest */
} scales;

static bool evaluate(scales *s, double t, bool moved, double *a) { return linear_evaluate(&s->at, t, moved, a); }

/* ---- the linearised equations ---- */

/* Raises rate and period to those of the linearised motion. */
static void linearise(scales *s, double *basis)
{
    const problem *p = s->at.problem;
    const size_t n = p->nx + p->nv;
    const rate_map map = {n, linear_product, &s->at};
    const double rate = rate_fastest(&map, basis, basis + n);
    double re[RATE_MOTION_MAX], im[RATE_MOTION_MAX], most = isfinite(rate) ? rate : 0, size[RATE_MOTION_MAX];
    /* Position and velocity of the fastest oscillation get the same size, so that no root is lost beside the others. */
    if (most > 0 && p->nx) s->at.size_v = most * s->at.size_x;
    /* The motion's own direction, (v, a); at rest, all directions. */
    for (size_t k = 0; k < p->nx; k++) basis[k] = s->at.v[k] / s->at.size_x;
    const bool moves = evaluate(s, s->at.t, false, s->at.a) &&
                       (vector_largest(s->at.a, p->nv) > 0 || vector_largest(basis, p->nx) > 0);
    for (size_t k = 0; k < p->nv; k++) basis[p->nx + k] = s->at.a[k] / s->at.size_v;
    for (size_t k = 0; k < n && !moves; k++) basis[k] = rate_scatter(k);
    const int count = rate_motion(&map, p->jvp ? LINEAR_ROUNDING_EXACT : LINEAR_ROUNDING_QUOTIENT, basis, re, im);
    for (int k = 0; k < count; k++) {
        size[k] = sqrt(re[k] * re[k] + im[k] * im[k]);
        most = fmax(most, size[k]);
    }
    s->rate = most;
    for (int k = 0; k < count; k++) {
        const bool turns = fabs(im[k]) >= DECAY * size[k];
        const double period = (turns ? TWO_PI : 1) / size[k];
        if (size[k] > most * (p->jvp ? NOISE_EXACT : NOISE_QUOTIENT) && period > s->period)
            s->period = period, s->turns = turns;
    }
    if (most > 0 && s->period == 0) s->period = TWO_PI / most, s->turns = true;
}

/* ---- the force in time ---- */

/* By how much a differs from that at the start, after `later`; negative: it is not finite there. */
static double change(scales *s, double later)
{
    if (!evaluate(s, s->at.t + s->way * later, false, s->at.other)) return -1;
    double most = 0;
    for (size_t k = 0; k < s->at.problem->nv; k++) most = fmax(most, fabs(s->at.other[k] - s->at.a[k]));
    return most;
}

/* The rate of what depends on t, from its first four differences at a spacing; NaN: they are rounding alone. */
static double rate_at(scales *s, double spacing, double *samples)
{
    static const double differences[4][5] = {/* all about the third sample, so that phases do not differ */
                                             {0, -0.5, 0, 0.5, 0},
                                             {0, 1, -2, 1, 0},
                                             {-0.5, 1, 0, -1, 0.5},
                                             {1, -4, 6, -4, 1}};
    const size_t n = s->at.problem->nv;
    double size[4] = {0}, most = 0;
    for (int i = 0; i < 5; i++) {
        if (!evaluate(s, s->at.t + s->way * i * spacing, false, samples + (size_t)i * n)) return NAN;
        most = fmax(most, vector_largest(samples + (size_t)i * n, n));
    }
    for (int d = 0; d < 4; d++)
        for (size_t k = 0; k < n; k++) {
            double sum = 0;
            for (int i = 0; i < 5; i++) sum += differences[d][i] * samples[(size_t)i * n + k];
            size[d] = fmax(size[d], fabs(sum));
        }
    if (!(size[0] + size[1] > 1e-11 * most)) return NAN;
    return sqrt((size[2] + size[3]) / (size[0] + size[1])) / spacing;
}

/* Raises rate and period to those of the driving: where a first differs from the start by half of what it changes in
 * all is its coarse scale of time, and differences over ever shorter times find the fine one. */
static void drive(scales *s, double horizon, double *samples)
{
    enum { OCTAVES = 60, FINER = 30 };
    double changes[2 * OCTAVES + 1], most = 0, spacing = 0;
    if (!evaluate(s, s->at.t, false, s->at.a)) return;
    int count = 0;
    for (int k = 0; k <= 2 * OCTAVES && ldexp(1, k - OCTAVES) <= horizon; k++, count++) {
        changes[k] = change(s, ldexp(1, k - OCTAVES));
        if (changes[k] < 0) break;
        most = fmax(most, changes[k]);
    }
    if (!(most > 1e-12 * vector_largest(s->at.a, s->at.problem->nv))) return;
    for (int k = 0; k < count && spacing == 0; k++)
        if (changes[k] >= most / 2) spacing = ldexp(1, k - OCTAVES);
    double rate = 1 / spacing, before = NAN;
    for (int k = 3; k < 3 + FINER; k++) {
        const double now = rate_at(s, ldexp(spacing, -k), samples);
        if (isnan(now)) break;
        if (now > 0) rate = now;
        if (now * ldexp(spacing, -k) < 0.2 && fabs(now - before) <= 0.03 * now) break;
        before = now;
    }
    s->rate = fmax(s->rate, rate);
    s->period = fmax(s->period, TWO_PI / rate);
}

/* ---- the start ---- */

/* A ball falls until it has moved by a few times its height; what moves evenly, by ten times its distance. */
static double time_of_values(const scales *s)
{
    const size_t moving = linear_positions(s->at.problem);
    const double x = moving ? s->at.size_x : 0, v = s->size_moving, a = s->size_a;
    if (a > 0 && moving) {
        const double t = 2 * fmax(v / a, sqrt(vector_largest(s->at.x, moving) / a));
        return t > 0 ? t : PERIODS;
    }
    if (v > 0 && vector_largest(s->at.x, moving) > 0) return PERIODS * x / v;
    if (a > 0 && vector_largest(s->at.v, s->at.problem->nv) > 0)
        return PERIODS * vector_largest(s->at.v, s->at.problem->nv) / a;
    return PERIODS;
}

/* How long the number with the largest force takes to be back at 0: x + v t + a t²/2 = 0. Else time_of_values. */
static double time_of_flight(scales *s)
{
    const size_t moving = linear_positions(s->at.problem);
    size_t most = 0;
    for (size_t k = 1; k < moving; k++)
        if (fabs(s->at.a[k]) > fabs(s->at.a[most])) most = k;
    if (moving == 0 || s->at.a[most] == 0) return time_of_values(s);
    const double x = s->at.x[most], v = s->at.v[most], a = s->at.a[most], under = v * v - 2 * a * x;
    const double root = sqrt(fmax(under, 0)), one = (-v - root) / a, two = (-v + root) / a, t = fmax(one, two);
    s->lands = under >= 0 && t > 0;
    s->falling = most;
    return s->lands ? t : time_of_values(s);
}

static void measure_sizes(scales *s)
{
    const problem *p = s->at.problem;
    const bool known = evaluate(s, s->at.t, false, s->at.a);
    const double x = vector_largest(s->at.x, linear_positions(p)), v = vector_largest(s->at.v, p->nv);
    s->size_a = known ? vector_largest(s->at.a, p->nv) : 0;
    s->size_moving = vector_largest(s->at.v, p->nx);
    s->at.size_x = x > 0 ? x : 1;
    s->at.size_v = v > 0 ? v : s->size_a > 0 ? sqrt(s->size_a * s->at.size_x) : 1;
}

static motus_status measure(scales *s, double duration, motus_error *err)
{
    const problem *p = s->at.problem;
    const size_t nx = p->nx, nv = p->nv, n = nx + nv;
    const size_t numbers = linear_room(p) + (RATE_MOTION_MAX + 1) * n;
    double *room = take(&s->system->allocator, numbers, sizeof *room);
    if (!room) return fail(err, MOTUS_MEMORY, "no memory to find a step");
    linear_place(&s->at, p, room);
    double *work = s->at.other + nv;
    if (nx) memcpy(s->at.x, s->system->x0, nx * sizeof *room);
    memcpy(s->at.v, s->system->v0, nv * sizeof *room);
    if (p->refresh) p->refresh(p->ctx, s->at.t, s->at.x, s->at.v);
    measure_sizes(s);
    linearise(s, work);
    const double horizon = duration > 0 ? duration : s->period > 0 ? PERIODS * s->period : INFINITY;
    if (p->traits.time || p->refresh) drive(s, horizon, work);
    if (s->rate < NO_RATE && s->system->text.draft) s->rate = 0;
    if (s->rate == 0 && s->system->text.draft && evaluate(s, s->at.t, false, s->at.a))
        s->period = time_of_flight(s);
    else if (s->rate == 0)
        s->period = time_of_values(s);
    else if (vector_largest(s->at.x, linear_positions(p)) > 0 && s->size_moving > 0)
        s->rate = fmax(s->rate, fmin(s->size_moving / s->at.size_x, s->size_a / s->size_moving));
    give(&s->system->allocator, room);
    if (s->at.no_memory) return fail(err, MOTUS_MEMORY, "no memory for the derivatives");
    if (!s->at.failed) return MOTUS_OK;
    char t[DECIMAL_MAX];
    return fail(err, MOTUS_CALLBACK, "the acceleration callback reported a failure at t = %s",
                decimal_time(s->at.t, s->at.t, t));
}

/* ---- round numbers ---- */

/* The largest of 1, 2 and 5 times a power of ten that is not above x. */
static double round_down(double x)
{
    static const int digits[] = {5, 2, 1};
    int exponent;
    x = fmin(fmax(x, 1e-290), 1e290);
    frexp(x, &exponent);
    for (int power = (int)(0.30103 * exponent) + 1;; power--)
        for (int i = 0; i < 3; i++)
            if (decimal_scaled(digits[i], power) <= x) return decimal_scaled(digits[i], power);
}

static double round_up(double x)
{
    const double below = round_down(x);
    if (below >= x) return below;
    const double above = round_down(2.1 * below); /* from 2 to 4: not far enough */
    return above > below ? above : round_down(2.6 * below);
}

static double round_near(double x)
{
    const double below = round_down(x), above = round_up(x);
    return x / below < above / x ? below : above;
}

/* ---- the suggestion ---- */

static void choose(const scales *s, bool uniform, double from, double duration, motus_settings *set)
{
    const problem *p = s->at.problem;
    const double steps = fmin(STEPS_MOST, fmax(STEPS_ALWAYS, NUMBERS_MOST / (double)(p->nx + p->nv)));
    const double longest = s->rate > 0 ? PERIODS * s->period : s->period;
    const bool ends = !isnan(set->until);
    if (!(duration > 0)) duration = round_near(longest);
    if (isnan(set->step)) {
        double step = duration / STEPS_LEAST;
        if (s->rate > 0) step = fmin(step, TWO_PI / s->rate / STEPS_A_PERIOD);
        set->step = round_down(step);
        if (!ends && duration > steps * set->step) duration = round_down(steps * set->step);
        if (ends && duration > steps * set->step) set->step = round_up(duration / steps);
        if (ends && uniform) set->step = duration / ceil(duration / set->step);
    } else if (!ends) {
        duration = fmin(fmax(duration, set->step), steps * set->step);
        if (uniform) duration = ceil(duration / set->step) * set->step;
    }
    if (!ends) set->until = from + duration;
}

static motus_status suggest(motus_system *system, motus_settings *set, motus_error *err)
{
    chosen row;
    const motus_method *card;
    if (!set->method) set->method = "verlet";
    const char *const name = choice_is_auto(set->method) ? PILOT_FIRST : set->method;
    motus_status status = choice_method(system, name, &row, &card, err);
    if (status != MOTUS_OK || (!isnan(set->step) && !isnan(set->until))) return status;
    const double from = isnan(set->from) ? system->start : set->from;
    const double duration = isnan(set->until) ? 0 : fabs(set->until - from);
    scales s = {.system = system, .at = {.problem = &system->problem, .t = from}, .way = set->until < from ? -1 : 1};
    status = measure(&s, duration, err);
    if (status != MOTUS_OK) return status;
    if (system->text.draft) {
        draft_scales d = {.rate = s.rate, .period = s.period, .lands = s.lands, .falling = s.falling, .turns = s.turns};
        d.from = from, d.duration = duration, d.uniform = row_uniform(&row);
        status = draft_choose(system, &d, set, err);
        if (status != MOTUS_OK) return status;
    } else {
        choose(&s, row_uniform(&row), from, duration, set);
    }
    set->rate = s.rate;
    set->period = s.period;
    return MOTUS_OK;
}

motus_status motus_suggest(motus_system *s, motus_settings *set, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s || !set) return fail(err, MOTUS_ARGUMENT, "motus_suggest needs a system and settings to fill in");
    motus_settings ours;
    motus_status status = motus_struct_read(MOTUS_DEF_SETTINGS, set, &ours, err);
    if (status != MOTUS_OK) return status;
    if (isinf(ours.step) || ours.step <= 0 || isinf(ours.until) || isinf(ours.from))
        return fail(err, MOTUS_ARGUMENT, "the step is a positive number, and start and end are finite");
    const modes m = modes_enter();
    status = suggest(s, &ours, err);
    modes_leave(m);
    if (status == MOTUS_OK) motus_struct_write(MOTUS_DEF_SETTINGS, &ours, set);
    return status;
}

motus_status suggest_missing(motus_system *s, const chosen *chosen, const char *method, double start, double *step,
                             double *until, motus_error *err)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    const bool no_step = !row_adaptive(chosen) && isnan(*step) && isnan(set.step),
               no_end = isnan(*until) && isnan(set.until);
    const bool sound = !isinf(*step) && !(*step <= 0) && !isinf(*until) && !isinf(start); /* else run_timing says so */
    if (!s->model || !sound || (!no_step && !no_end)) return MOTUS_OK;
    if (!isnan(*step)) set.step = *step;
    if (!isnan(*until)) set.until = *until;
    if (!isnan(start)) set.from = start;
    if (method) set.method = method;
    motus_status status = motus_suggest(s, &set, err);
    if (no_step && status == MOTUS_OK) *step = set.step;
    if (no_end && status == MOTUS_OK) *until = set.until;
    return status;
}
