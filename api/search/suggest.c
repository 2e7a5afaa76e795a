/* The step and the end of a model that gives none: motus_suggest.
 *
 * Two scales of time decide: the fastest rate of the motion and the longest period at its start. They come from the
 * equations linearised along the motion (along.h) and at its start, from how fast the state changes, and from samples
 * of the force in time; where the force is constant, from the initial values. Invariant: the same system gives the same
 * numbers on every machine, and does not change.
 */
#include "api/search/suggest.h"

#include "api/search/along.h"
#include "api/search/draft.h"
#include "api/search/pilot.h"
#include "api/why/evidence.h"
#include "api/system/vector.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define TWO_PI 6.283185307179586
#define PERIODS 10.0        /* of the longest kind, up to the end */
#define STEPS_A_PERIOD 80.0 /* least, in the shortest period */
#define STEPS_LEAST 100.0   /* least, up to the end */
#define STEPS_MOST 1e6      /* most, up to the end */
#define NUMBERS_MOST 1e9    /* most steps times numbers */
#define STEPS_ALWAYS 1000.0 /* steps that a large system may have all the same */
#define NOISE_EXACT 1e-6    /* part of the fastest rate, below which a rate is rounding: with exact derivatives */
#define NOISE_QUOTIENT 1e-4 /* such a part with difference quotients */
#define NO_RATE 1e-15       /* in a draft a slower rate is rounding */
#define FASTER 1.05         /* factor by which the motion is faster than its start, beyond the pilot's errors */
#define FAR 100.0           /* factor beyond which the start tells no period */
#define STABLE 0.5          /* of the step up to which a method does not grow: most of a default step */
#define RADIANS 2.0         /* most radians of an oscillation in such a step */
#define DECAYS 1e-6         /* part of a rate, and of a step's growth, below which it is rounding */
#define SHORT 0.25          /* over the rate: most of a step where no stable one is known */

typedef struct scales {
    motus_system *system;
    linear at;                  /* the linearised equations at the start */
    double way;                 /* 1, or -1 where the run goes backward */
    double size_a, size_moving; /* size_moving: of the velocities of positions */
    bool turns, lands;          /* turns: the longest period is of an oscillation; lands: the period is of a flight */
    size_t falling;             /* the position with the largest force */
    double rate, period;        /* rate: the fastest, 0: the force is constant; period: the longest */
    double longest;             /* the way to the end, where no end is given */
    linear_rates first, fast;   /* at the start, and where the motion is fastest */
    const chosen *row;          /* the row whose steps are judged; NULL: none */
    double step, grown;         /* step: the size to judge; grown: powers of ten by which steps grow in a time of 1 */
} scales;

static double noise(const problem *p) { return p->jvp ? NOISE_EXACT : NOISE_QUOTIENT; }

static bool evaluate(scales *s, double t, bool moved, double *a) { return linear_evaluate(&s->at, t, moved, a); }

/* ---- the linearised equations ---- */

/* Raises rate and period to those of the linearised motion. */
static void linearise(scales *s, double *basis)
{
    linear_rates_of(&s->at, basis, &s->first);
    s->fast = s->first;
    s->rate = s->first.fastest;
    s->period = along_period(&s->first, noise(s->at.problem) * s->rate, &s->turns);
}

/* ---- the force in time ---- */

/* Returns how much the acceleration differs from that at the start, after `later`; below 0: it is not finite. */
static double change(scales *s, double later)
{
    if (!evaluate(s, s->at.t + s->way * later, false, s->at.other)) return -1;
    double most = 0;
    for (size_t k = 0; k < s->at.problem->nv; k++) most = fmax(most, fabs(s->at.other[k] - s->at.a[k]));
    return most;
}

/* Returns the rate of what depends on t, from its first four differences; 0: it is straight here, as between two points
 * of a table; NaN: they are rounding alone. */
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
    if (!(size[2] + size[3] > 64 * DBL_EPSILON * most)) return 0;
    return sqrt((size[2] + size[3]) / (size[0] + size[1])) / spacing;
}

/* Raises rate and period to those of a driving force. Its coarse scale is the time after which it first differs from
 * the start by half of its whole change; differences over ever shorter times find the fine scale. */
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

/* ---- the motion ---- */

/* Returns by how many powers of ten a step grows at rates that swing or decay. */
static double grows(const scales *s, const linear_rates *r)
{
    double re[RATE_MOTION_MAX], im[RATE_MOTION_MAX], radius[RATE_MOTION_MAX], most = 0;
    size_t count = 0;
    for (int k = 0; k < r->count; k++) {
        const double size = s->step * hypot(r->re[k], r->im[k]);
        if (s->way * r->re[k] > DECAYS * hypot(r->re[k], r->im[k]) || !(size > 0 && size <= MOTUS_STABILITY_FAR))
            continue;
        re[count] = s->step * fmin(s->way * r->re[k], 0);
        im[count++] = s->step * fabs(r->im[k]);
    }
    if (!count || motus_stability(s->row->name, count, re, im, radius, NULL) != MOTUS_OK) return 0;
    for (size_t k = 0; k < count; k++) most = fmax(most, isfinite(radius[k]) ? radius[k] : 0); /* NaN: not known */
    return most > 1 + DECAYS ? log10(most) : 0;
}

static void judge(scales *s, const along *a)
{
    double sum = 0, time = 0;
    for (size_t k = 1; k < a->count; k++) {
        sum += a->places[k].span / s->step * grows(s, &a->places[k].rates);
        time += a->places[k].span;
    }
    s->grown = time > 0 ? sum / time : 0;
}

/* Follows the motion: raises the rate to the motion's, and shortens a period that only the start has, as at an
 * inflection of the potential. Afterwards `at` is a state of the motion. */
static motus_status follow(scales *s, double horizon, double *work, motus_error *err)
{
    const problem *p = s->at.problem;
    if (s->row) s->grown = grows(s, &s->first) / s->step;
    if (s->system->text.draft || p->traits.constant || (p->traits.affine && !p->traits.time)) return MOTUS_OK;
    along *a = take(&s->system->allocator, 1, sizeof *a);
    if (!a) return fail(err, MOTUS_MEMORY, "no memory to follow the motion");
    const motus_status status = along_motion(s->system, s->way, horizon, &s->at, work, &s->first, a, err);
    const along_place *fastest = along_fastest(a);
    const double rate = fastest->rates.fastest, period = along_mean_period(a, noise(p));
    if (s->rate > 0 && rate > FAR * s->rate && period > 0 && s->period > FAR * period) {
        s->period = period;
        s->longest = PERIODS * period;
    }
    if (rate > FASTER * s->rate) s->rate = rate, s->fast = fastest->rates;
    if (s->row) judge(s, a);
    give(&s->system->allocator, a);
    return status;
}

/* Raises the rate once more, at a state of the motion: a driving force with a factor that is 0 at the start shows
 * there. */
static void drive_again(scales *s, double horizon, double *work)
{
    const double rate = s->rate, period = s->period;
    drive(s, horizon, work);
    if (!(s->rate > FASTER * rate)) s->rate = rate;
    s->period = period;
}

/* Returns the longest step that serves for a rate. An oscillation is also to be followed. Where the method has no bound
 * (the shortest steps of explicit Euler grow, too, and an iteration may not converge), SHORT is the bound. */
static double stable_for(const chosen *row, const motus_method *card, double re, double im)
{
    double bound = re == 0 ? card->stability_limit : stability_bound(row->name, re, im);
    if (!(bound > 0)) bound = SHORT;
    if (fabs(im) > fabs(re)) bound = fmin(bound, RADIANS);
    return STABLE * bound / hypot(re, im);
}

/* Returns the longest step that the method can take where the motion is fastest, with room to spare. */
static double stable_step(const scales *s, const chosen *row, const motus_method *card)
{
    const linear_rates *r = &s->fast;
    double step = INFINITY, known = 0;
    for (int k = 0; k < r->count; k++) {
        const double size = hypot(r->re[k], r->im[k]), re = s->way * r->re[k];
        known = fmax(known, size);
        if (size > noise(s->at.problem) * r->fastest)
            step = fmin(step, re < 0 ? stable_for(row, card, re, r->im[k]) : stable_for(row, card, 0, size));
    }
    return r->fastest > FASTER * known ? fmin(step, stable_for(row, card, 0, r->fastest)) : step;
}

/* ---- the start ---- */

/* Returns a time from the initial values: until a fall is a few times its height, or an even motion ten times its
 * distance. */
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

/* Returns when the number with the largest force is back at 0: x + v t + a t²/2 = 0. Else time_of_values. */
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
    s->longest = s->rate > 0 ? PERIODS * s->period : s->period;
    const double start = s->at.t;
    const motus_status status = s->at.failed ? MOTUS_OK : follow(s, duration > 0 ? duration : s->longest, work, err);
    const bool moved = s->at.t != start;
    s->at.t = start;
    if (status == MOTUS_OK && moved && p->traits.time) drive_again(s, horizon, work);
    give(&s->system->allocator, room);
    if (status != MOTUS_OK) return status;
    if (s->at.no_memory) return fail(err, MOTUS_MEMORY, "no memory for the derivatives");
    if (!s->at.failed) return MOTUS_OK;
    char t[DECIMAL_MAX];
    return fail(err, MOTUS_CALLBACK, "the acceleration callback reported a failure at t = %s",
                decimal_time(s->at.t, s->at.t, t));
}

/* ---- round numbers ---- */

/* Returns the largest of 1, 2 and 5 times a power of ten that is not above x. */
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

static void choose(const scales *s, const chosen *row, const motus_method *card, double from, double duration,
                   motus_settings *set)
{
    const problem *p = s->at.problem;
    const double steps = fmin(STEPS_MOST, fmax(STEPS_ALWAYS, NUMBERS_MOST / (double)(p->nx + p->nv)));
    const bool ends = !isnan(set->until);
    if (!(duration > 0)) duration = round_near(s->longest);
    if (isnan(set->step)) {
        double step = duration / STEPS_LEAST;
        if (s->rate > 0) step = fmin(step, TWO_PI / s->rate / STEPS_A_PERIOD);
        set->step = round_down(step);
        if (!ends && duration > steps * set->step) duration = round_down(steps * set->step);
        if (ends && duration > steps * set->step)
            set->step = fmin(round_up(duration / steps), round_down(stable_step(s, row, card)));
        if (ends && row_uniform(row)) set->step = duration / ceil(duration / set->step);
    } else if (!ends) {
        duration = fmin(fmax(duration, set->step), steps * set->step);
        if (row_uniform(row)) duration = ceil(duration / set->step) * set->step;
    }
    if (!ends) set->until = from + duration;
}

static motus_status suggest(motus_system *system, motus_settings *set, motus_error *err)
{
    chosen row;
    const motus_method *card;
    if (!set->method) set->method = "verlet";
    const char *const name = system_auto(set->method) ? PILOT_FIRST : set->method;
    motus_status status = request_row(system, name, &row, &card, err);
    if (status != MOTUS_OK || (!isnan(set->step) && !isnan(set->until))) return status;
    const double from = isnan(set->from) ? system->start : set->from;
    const double duration = isnan(set->until) ? 0 : fabs(set->until - from);
    scales s = {.system = system, .at = {.problem = &system->problem, .t = from}, .way = set->until < from ? -1 : 1};
    status = measure(&s, duration, err);
    if (status != MOTUS_OK) return status;
    if (system->text.draft) {
        draft_scales d = {.rate = s.rate, .period = s.period, .lands = s.lands, .falling = s.falling, .turns = s.turns};
        d.from = from, d.duration = duration, d.uniform = row_uniform(&row);
        d.stable = isnan(set->step) && duration > 0 ? stable_step(&s, &row, card) : INFINITY;
        status = draft_choose(system, &d, set, err);
        if (status != MOTUS_OK) return status;
    } else {
        choose(&s, &row, card, from, duration, set);
    }
    set->rate = s.rate;
    set->period = s.period;
    return MOTUS_OK;
}

motus_status suggest_growth(motus_system *system, const motus_settings *set, double *powers, motus_error *err)
{
    chosen row;
    const motus_method *card;
    *powers = 0;
    motus_status status = request_row(system, set->method, &row, &card, err);
    if (status != MOTUS_OK || row_adaptive(&row)) return status;
    const double from = isnan(set->from) ? system->start : set->from, duration = fabs(set->until - from);
    scales s = {.system = system, .at = {.problem = &system->problem, .t = from}, .way = set->until < from ? -1 : 1};
    s.row = &row, s.step = set->step;
    status = measure(&s, duration, err);
    if (status == MOTUS_OK) *powers = s.grown * duration;
    return status;
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
    const bool no_step = isnan(ours.step), no_end = isnan(ours.until);
    const modes m = modes_enter();
    status = suggest(s, &ours, err);
    modes_leave(m);
    if (status != MOTUS_OK) return status;
    if (no_step) ours.step_said = MOTUS_SAID_SUGGESTED;
    if (no_end) ours.until_said = MOTUS_SAID_SUGGESTED;
    motus_struct_write(MOTUS_DEF_SETTINGS, &ours, set);
    return MOTUS_OK;
}

bool suggest_lacks_step(const motus_system *s, const request *q)
{
    return s->model && !row_adaptive(&q->chosen) && isnan(q->set.step) && isnan(q->set.accuracy);
}

motus_status suggest_missing(motus_system *s, request *q, motus_error *err)
{
    motus_settings *const given = &q->set, set = q->set;
    const bool no_step = suggest_lacks_step(s, q), no_end = isnan(set.until) && !q->ends;
    const bool sound = !isinf(set.step) && !(set.step <= 0) && !isinf(set.until) && !isinf(set.from);
    if (!s->model || !sound || (!no_step && !no_end)) return MOTUS_OK; /* run_timing refuses the rest */
    const motus_status status = motus_suggest(s, &set, err);
    if (status != MOTUS_OK) return status;
    if (no_step) given->step = set.step, given->step_said = MOTUS_SAID_SUGGESTED;
    if (no_end) given->until = set.until, given->until_said = MOTUS_SAID_SUGGESTED;
    if (!(given->rate > 0)) given->rate = set.rate; /* else it is that of a step which is known already */
    if (set.period > 0) given->period = set.period;
    return MOTUS_OK;
}
