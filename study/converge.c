/* Error against step, the observed order and its certificate: motus_converge.
 *
 * Every method runs over the same motion with steps T/8, T/16, … and is compared with the reference solution at the
 * same INTERVALS times; its error is the largest over these times and over all numbers of the state, each in units of
 * how far its variable moves. Where T/8 is so fine for a high order that too few points lie above round-off, the row
 * begins at T/4, T/2 or T, and is compared at that many times. Orders from 4 on also run with steps between these,
 * because few halvings lie between instability and round-off there. Steps are shortened until round-off is reached or
 * the work is spent; where the slope is not steady by then, there is more work. fit.c says which points the slope is
 * fitted to.
 *
 * If the motion has so many oscillations that low orders would need too many steps, only its beginning is taken, and
 * the result says so. Invariant: the result is one allocation, and the same on every machine: no decision depends on
 * a clock.
 */
#include "fit.h"
#include "paced.h"
#include "probe.h"
#include "solution.h"
#include "base/decimal.h"
#include <math.h>
#include <stdio.h>

#define INTERVALS 8 /* a power of 2 */
#define POINTS_MAX 80
#define POINTS_LEAST 7 /* points measured before the fit may end the row */
#define STEPS_LEAST 32 /* per interval: the bound on the work does not hold for runs with fewer */
#define FINE_ORDER 4   /* from this order on four points an octave */
/* The bound on the work (study_work) of a method is first that of 2^18 evaluations of one oscillator. A method that
 * has reached neither round-off nor a steady slope by then gets EXTENSION times as much. */
#define WORK 4.7e6
#define EXTENSION 8
#define STEADY 0.03        /* the largest slope_change of a steady slope */
#define COARSE_ENOUGH 1e-4 /* a row needs no coarser steps if its coarsest error is larger */
/* The bounds on the length of the motion, in radians. Of the motion itself: above PHASE_MOST it is cut to about
 * PHASE_GOOD. At the fastest rate of the linearised motion, excited or not: beyond STIFF_MOST explicit methods would
 * have no stable step. At the largest speed of the motion, where low orders need very short steps: PEAK_MOST. */
#define PHASE_MOST 12.0
#define PHASE_GOOD 8.0
#define STIFF_MOST 2000.0
#define PEAK_MOST 200.0
#define INCOMMENSURATE 0.95225424859373685603 /* 1 - (3 - √5)/16: badly approximated by fractions */
#define SURVEY 64                             /* intervals of the survey: a rough solution of the full motion */
#define SURVEY_PROBES 8                       /* states of the survey at which the fastest rate is computed */
#define SURVEY_TRUST 0.1 /* of the motion's size: with a larger error of the survey only its start is used */
#define REFERENCE_MAX (SOLUTION_TEXT_MAX + 320)
#define SHOWN_ORDER 8     /* the highest order for which a double has enough digits */
#define OVERALL_LARGE 0.1 /* larger errors tell no order, nor errors below OVERALL_CLEAR times round-off */
#define OVERALL_CLEAR 30.0
#define OVERALL_OCTAVES 6.0
#define LOST 0.5        /* of an order: how far below it the fall of errors over LOST_OCTAVES refutes a row */
#define LOST_PART 0.125 /* the same distance as a part of a high order */
#define LOST_OCTAVES 1.999
#define REFERENCE_SHARE 0.1 /* of the progress */

typedef struct row_text {
    char method[MOTUS_NAME_MAX], certificate[MOTUS_TEXT_MAX];
} row_text;

typedef struct result {
    motus_convergence seen; /* first, since it is the handle the user holds */
    motus_allocator allocator;
    char reference[REFERENCE_MAX];
    motus_converge_row *rows;
    motus_point *points;                 /* rows × POINTS_MAX */
    const motus_converge_row **row_list; /* pointers to the rows, for the user */
    const motus_point **point_list;
    row_text *texts;
} result;

typedef struct converge {
    study s;
    motus_study_def def;
    solution reference;
    study_grid grid;
    double uncut;   /* the end that was asked for */
    bool cut;       /* the motion ends far before `uncut` */
    double share;   /* of the motion, that fixed steps divide; the last step of all is shorter unless it is 1 */
    double allowed; /* the highest order that the smoothness of the force allows; 0: any */
    char why[MOTUS_TEXT_MAX / 2];
    double *table;   /* (INTERVALS + 1) × numbers */
    size_t *columns; /* of the numbers of a state */
    const char **methods;
    size_t count;
    result *out;
} converge;

static motus_status make_result(converge *c)
{
    size_t head = study_aligned(sizeof(result)), rows = study_aligned(c->count * sizeof(motus_converge_row));
    size_t points = study_aligned(c->count * POINTS_MAX * sizeof(motus_point)),
           texts = study_aligned(c->count * sizeof(row_text));
    size_t row_list = study_aligned(c->count * sizeof(void *)), point_list = c->count * POINTS_MAX * sizeof(void *);
    char *block = take(c->s.allocator, head + rows + points + texts + row_list + point_list, 1);
    c->table = take(c->s.allocator, (INTERVALS + 1) * c->s.numbers, sizeof(double));
    c->columns = take(c->s.allocator, c->s.numbers, sizeof *c->columns);
    for (size_t k = 0; c->columns && k < c->s.numbers; k++) c->columns[k] = k + 1;
    if (!block || !c->table || !c->columns) {
        give(c->s.allocator, block);
        return fail(c->s.err, MOTUS_MEMORY, "out of memory for the convergence of %zu methods", c->count);
    }
    result *r = c->out = (result *)(void *)block;
    r->allocator = *c->s.allocator;
    r->rows = (motus_converge_row *)(void *)(block + head);
    r->points = (motus_point *)(void *)(block + head + rows);
    r->texts = (row_text *)(void *)(block + head + rows + points);
    r->row_list = (const motus_converge_row **)(void *)(block + head + rows + points + texts);
    r->point_list = (const motus_point **)(void *)(block + head + rows + points + texts + row_list);
    for (size_t i = 0; i < c->count * POINTS_MAX; i++) r->point_list[i] = &r->points[i];
    r->seen = (motus_convergence){c->count, r->row_list, r->reference, NAN, 0};
    for (size_t k = 0; k < c->count; k++) {
        r->rows[k] = (motus_converge_row){.method = r->texts[k].method,
                                          .observed = NAN,
                                          .standard_error = NAN,
                                          .power = NAN,
                                          .power_error = NAN,
                                          .power_due = NAN,
                                          .between = NAN,
                                          .between_error = NAN,
                                          .points = r->point_list + k * POINTS_MAX,
                                          .certificate = r->texts[k].certificate};
        r->row_list[k] = &r->rows[k];
        snprintf(r->texts[k].method, sizeof r->texts[k].method, "%s", c->methods[k]);
    }
    return MOTUS_OK;
}

/* The motion ----------------------------------------------------------------------------------------------------- */

/* Makes a grid with equal intervals over the part `share` of the motion, and a shorter one over the rest. */
static study_grid grid_of(const study *s, double until, size_t intervals, double share)
{
    return (study_grid){.from = s->from,
                        .until = until,
                        .interval = share * fabs(until - s->from) / (double)intervals,
                        .intervals = intervals,
                        .points = share < 1 ? intervals + 1 : intervals};
}

/* Rounds down to 1, 2 or 5 times a power of ten. */
static double round_down(double duration)
{
    double above = 1, below = 1;
    while (10 * above <= duration) above *= 10;
    while (1 / below > duration) below *= 10;
    double power = above / below, digit = duration / power;
    return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

/* Bounds the length of the motion by its speed along a survey and by the fastest rate of the linearised motion. */
static motus_status bound_length(converge *c, bool smooth, double *until)
{
    study *s = &c->s;
    study_grid g = grid_of(s, s->until, SURVEY, 1);
    solution survey;
    motus_status status = solution_find(s, &g, SURVEY, SURVEY_TRUST / 100, &survey);
    double phase_rate = 0, peak = 0, stiff = 0, direction = s->until > s->from ? 1 : -1;
    bool trusted = survey.known && survey.scaled < SURVEY_TRUST;
    for (size_t r = 0; r <= (trusted ? SURVEY : 0) && status == MOTUS_OK; r++) {
        double t = s->from + direction * (double)r * g.interval;
        const double *y = survey.rows + r * s->numbers;
        double speed = 2 * probe_speed(s, t, y);
        peak = fmax(peak, speed); /* NaN does not count */
        phase_rate += isnan(speed) ? 0 : speed / (trusted ? SURVEY + 1 : 1);
        if (r % (SURVEY / SURVEY_PROBES) == 0) stiff = fmax(stiff, probe_rate(s, t, y));
    }
    solution_free(s, &survey);
    if (status == MOTUS_OK) status = study_broken(s);
    if (status != MOTUS_OK) return status;
    double duration = fabs(s->until - s->from);
    double longest = duration;
    if (phase_rate * duration > PHASE_MOST) longest = PHASE_GOOD / phase_rate;
    if (smooth && peak * longest > PEAK_MOST) longest = PEAK_MOST / peak;
    /* Where a force jumps, its derivative is no rate of the motion. */
    if (smooth && stiff * longest > STIFF_MOST) longest = STIFF_MOST / stiff;
    if (longest == duration) return MOTUS_OK;
    c->cut = true;
    *until = s->from + direction * round_down(longest);
    return MOTUS_OK;
}

/* Chooses the end. A force that is not smooth often jumps at a simple fraction of the run, as at half of it, and steps
 * that end there by chance would show an order that no other step has. So the steps divide an irrational part of such a
 * motion, and the last step of all is shorter. */
static motus_status choose_end(converge *c, double *until)
{
    study *s = &c->s;
    motus_analysis analysis = motus_default_analysis();
    study_note(s, motus_analysis_of(s->system, &analysis));
    if (study_broken(s) != MOTUS_OK) return study_broken(s);
    *until = c->uncut = s->until;
    c->share = analysis.smooth ? 1 : INCOMMENSURATE;
    return isnan(c->def.until) ? bound_length(c, analysis.smooth, until) : MOTUS_OK; /* else the user chose the end */
}

/* One method ----------------------------------------------------------------------------------------------------- */

/* Returns the steps per interval at point i: 1, 2, 4, …, or for high orders 1 to 8, 10, 12, 14, 16, 20, … */
static int64_t steps_per_interval(int64_t i, int order)
{
    int64_t octave = order < FINE_ORDER ? 1 : 4;
    if (i < octave - 1) return i + 1;
    i -= octave - 1;
    return (octave + i % octave) << (i / octave);
}

static motus_status measure(converge *c, const motus_method *card, const char *method, const study_grid *g, int64_t per,
                            motus_point *point, double *spent, motus_error *e, motus_status *failed)
{
    study *s = &c->s;
    study_cost cost;
    *point = (motus_point){.step = g->interval / (double)per, .error = NAN, .tolerance = NAN, .error_between = NAN};
    motus_status status = study_walk(s, method, g, per, NULL, c->table, &cost, e);
    point->evaluations = cost.evaluations;
    *spent = study_work(s, card, (double)cost.steps, (double)cost.evaluations);
    if (study_fatal(status)) return study_tell(s, status, e);
    if (status != MOTUS_OK) {
        *failed = status;
        return MOTUS_OK;
    }
    double error = 0;
    for (size_t p = 0, every = INTERVALS / g->intervals; p < g->points; p++) {
        const size_t row = p < g->intervals ? (p + 1) * every : c->grid.points;
        const double *at = c->reference.rows + row * s->numbers;
        error = study_larger(error, study_measure(s, c->table + p * s->numbers, at).scaled);
    }
    point->error = isfinite(error) ? error : NAN;
    return MOTUS_OK;
}

/* Measures the points of a row, the coarsest with `intervals` steps, and fits its order. */
static motus_status measure_all(converge *c, const motus_method *card, const char *method, size_t intervals,
                                motus_converge_row *row, motus_point *points, fit_order_result *fit, motus_error *e,
                                motus_status *failed)
{
    study *s = &c->s;
    study_grid g = grid_of(s, c->grid.until, intervals, c->share);
    double work = 0, bound = WORK, base = s->base, span = s->span, duration = fabs(g.until - g.from);
    *fit = (fit_order_result){.verdict = FIT_FEW, .observed = NAN, .standard_error = NAN, .fall = NAN};
    for (size_t i = 0; i < POINTS_MAX; i++) {
        int64_t per = steps_per_interval((int64_t)i, row->declared);
        double next = study_work(s, card, (double)intervals * (double)per, -1), spent;
        if (per > STEPS_LEAST && work + next > bound) {
            bool shown =
                fit->settled || fit->verdict == FIT_EXACT || (fit->verdict == FIT_SLOPE && fit->slope_change < STEADY);
            if (shown || bound > WORK || work + next > EXTENSION * WORK) break;
            bound = EXTENSION * WORK;
        }
        study_part(s, base + span * fmin(1, work / bound), span * fmin(1, next / bound));
        motus_status status = measure(c, card, method, &g, per, &points[i], &spent, e, failed);
        /* the method takes equal steps only */
        if (status == MOTUS_OK && *failed == MOTUS_METHOD && g.points > g.intervals) {
            *failed = MOTUS_OK;
            g.points = g.intervals;
            g.until = g.from + c->share * (g.until - g.from);
            status = measure(c, card, method, &g, per, &points[i], &spent, e, failed);
        }
        if (status != MOTUS_OK) return status;
        work += fmax(next, spent);
        row->point_count = i + 1;
        *fit = fit_order(points, row->point_count, duration, s->noise, c->reference.scaled);
        if (row->point_count > POINTS_LEAST && (fit->settled || fit->verdict == FIT_EXACT)) break;
    }
    return MOTUS_OK;
}

/* Returns the order by which errors fall from the first to the last step that shows one; NaN: over too few octaves. */
static double overall(const converge *c, const motus_converge_row *row, double floor)
{
    const motus_point *first = NULL, *last = NULL;
    for (size_t k = 0; k < row->point_count; k++) {
        const motus_point *p = row->points[k];
        if (!(p->error < OVERALL_LARGE && p->error > OVERALL_CLEAR * fmax(floor, c->reference.scaled))) continue;
        if (!first) first = p;
        last = p;
    }
    const double octaves = first ? log(first->step / last->step) / log(2) : 0;
    return octaves >= OVERALL_OCTAVES ? log(first->error / last->error) / log(2) / octaves : NAN;
}

/* Returns whether a row of high order reaches round-off before its slope settles, and falls there as fast as the
 * highest order that a double shows. */
static bool falls(const converge *c, const motus_converge_row *row, const fit_order_result *fit)
{
    return row->declared > SHOWN_ORDER && c->allowed == 0 && fit->settled && fit->fall >= SHOWN_ORDER;
}

/* Returns whether steady slopes over some octaves are clearly below the order. Otherwise round-off came before they
 * settled, or they have not settled yet, and the row neither passes nor fails. For an order that a double cannot show,
 * the highest that it can show is due; where the force allows less, the order that it leaves. */
static bool refutes(const converge *c, const fit_order_result *fit, int declared)
{
    const double most = c->allowed > 0 ? fmin(c->allowed, SHOWN_ORDER) : SHOWN_ORDER, due = fmin(declared, most);
    return fit->verdict == FIT_SLOPE && fit->octaves >= LOST_OCTAVES &&
           fit->observed + 2 * fit->standard_error < due - fmax(LOST, LOST_PART * due);
}

static void certify(const converge *c, motus_converge_row *row, const fit_order_result *fit, char *text, size_t size)
{
    row->observed = fit->observed;
    row->standard_error = fit->standard_error;
    row->exact_here = fit->verdict == FIT_EXACT;
    const bool allowed = c->allowed == 0 || row->declared <= c->allowed;
    /* Where the force allows just this order, errors at the jump are of that order as well, and depend on where in a
     * step the jump lies: neighbours in the table differ, and only the fall over many octaves tells the order. */
    if (c->allowed > 0 && allowed && row->declared + 1 > c->allowed && fit->verdict == FIT_SLOPE &&
        !fit_passes(fit->observed, fit->standard_error, row->declared)) {
        const double order = overall(c, row, fit->floor);
        if (order > row->observed) row->observed = order;
    }
    row->passed = row->exact_here || (allowed && fit->verdict == FIT_SLOPE &&
                                      fit_passes(row->observed, fit->standard_error, row->declared));
    if (!row->passed && falls(c, row, fit)) {
        row->passed = true;
        row->observed = fit->fall;
        row->standard_error = NAN;
        snprintf(text, size, "observed %.2f, down to round-off, declared %d", row->observed, row->declared);
        return;
    }
    row->uncertain = !row->passed && !refutes(c, fit, row->declared);
    const char *const colon = allowed ? "" : ": ", *const why = allowed ? "" : c->why;
    const char *const uncertain = row->uncertain ? " (not certified)" : "";
    switch (fit->verdict) {
    case FIT_EXACT: snprintf(text, size, "exact here, declared %d", row->declared); break;
    case FIT_SLOPE:
        if (allowed)
            snprintf(text, size, "observed %.2f, declared %d%s", row->observed, row->declared, uncertain);
        else
            snprintf(text, size, "observed %.2f, declared %d: %s, which allows order %.3g", row->observed,
                     row->declared, why, c->allowed);
        if (!row->passed && !row->uncertain) row->status = MOTUS_ORDER;
        break;
    case FIT_ROUGH:
        snprintf(text, size, "no slope: the errors follow no power of the step, declared %d%s%s%s", row->declared,
                 colon, why, uncertain);
        break;
    case FIT_FEW:
        snprintf(text, size,
                 "no slope: %zu of the %d steps needed lie between instability and round-off, declared %d%s%s%s",
                 fit->above, FIT_POINTS_MIN, row->declared, colon, why, uncertain);
        break;
    }
}

/* Returns whether every run failed; the row then has the message of the last. */
static bool all_failed(motus_converge_row *row, const motus_point *points, motus_status failed, const motus_error *e,
                       char *text)
{
    for (size_t i = 0; i < row->point_count; i++)
        if (!isnan(points[i].error)) return false;
    if (failed == MOTUS_OK) return false;
    row->status = failed;
    row->uncertain = 0;
    snprintf(text, MOTUS_TEXT_MAX, "%s", e->message);
    return true;
}

/* Measures the points of an adaptive row, and writes its certificates. */
static motus_status make_paced(converge *c, const motus_method *card, motus_converge_row *row, motus_point *points,
                               char *text, motus_error *e, motus_status *failed)
{
    study *s = &c->s;
    paced p = {.s = s, .reference = &c->reference, .grid = &c->grid, .room = c->table, .columns = c->columns};
    const double duration = fabs(c->grid.until - c->grid.from), base = s->base, span = s->span;
    double work = 0, next = 0;
    fit_order_result fit = {.verdict = FIT_FEW, .observed = NAN, .standard_error = NAN, .fall = NAN};
    for (size_t i = 0; i < POINTS_MAX && work + next <= EXTENSION * WORK; i++) {
        int64_t steps = 0;
        points[i] = (motus_point){.step = NAN, .error = NAN, .error_between = NAN};
        points[i].tolerance = paced_tolerance(card, i);
        if (points[i].tolerance == 0) break;
        study_part(s, base + span * (double)i / POINTS_MAX, span / POINTS_MAX);
        motus_status status = paced_measure(&p, row->method, &points[i], &steps, e, failed);
        if (status != MOTUS_OK) return status;
        const double spent = study_work(s, card, (double)steps, (double)points[i].evaluations);
        work += spent;
        next = card->order < FINE_ORDER ? 1.5 * spent : 1.2 * spent;
        row->point_count = i + 1;
        fit = fit_order(points, row->point_count, duration, s->noise, c->reference.scaled);
        if (row->point_count > POINTS_LEAST && (fit.settled || fit.verdict == FIT_EXACT)) break;
    }
    if (c->allowed > 0) {
        row->uncertain = 1;
        snprintf(text, MOTUS_TEXT_MAX, "declared %d: %s", row->declared, c->why);
        return MOTUS_OK;
    }
    if (card->any_order && fit.verdict != FIT_EXACT) {
        row->uncertain = 1;
        snprintf(text, MOTUS_TEXT_MAX, "its order follows the tolerance, so the error has no one power");
        return MOTUS_OK;
    }
    const paced_noise noise = {fit.floor, s->noise, duration};
    paced_certify(card, &noise, fit.verdict == FIT_EXACT, points, row, text, MOTUS_TEXT_MAX);
    return MOTUS_OK;
}

static motus_status make_row(converge *c, size_t k)
{
    study *s = &c->s;
    motus_converge_row *row = &c->out->rows[k];
    motus_point *points = c->out->points + k * POINTS_MAX;
    char *text = c->out->texts[k].certificate;
    const char *method = c->methods[k];
    const motus_method *card;
    motus_error e = motus_default_error();
    motus_status status = motus_method_find(method, &card, &e), failed = MOTUS_OK;
    if (status == MOTUS_OK) {
        row->declared = card->order;
        status = motus_method_admits(s->system, method, &e);
    }
    if (study_fatal(status)) return study_tell(s, status, &e);
    if (status != MOTUS_OK) {
        row->status = status;
        snprintf(text, MOTUS_TEXT_MAX, "%s", e.message);
        return MOTUS_OK;
    }
    row->adaptive = card->adaptive;
    if (card->adaptive) {
        status = make_paced(c, card, row, points, text, &e, &failed);
        if (status != MOTUS_OK) return status;
        all_failed(row, points, failed, &e, text);
        return MOTUS_OK;
    }
    fit_order_result fit;
    double base = s->base, span = s->span;
    for (size_t intervals = INTERVALS; intervals > 0; intervals /= 2) {
        study_part(s, base, span);
        status = measure_all(c, card, method, intervals, row, points, &fit, &e, &failed);
        if (status != MOTUS_OK) return status;
        if (fit.verdict != FIT_FEW || !(points[0].error < COARSE_ENOUGH)) break;
    }
    if (all_failed(row, points, failed, &e, text)) return MOTUS_OK;
    certify(c, row, &fit, text, MOTUS_TEXT_MAX);
    return MOTUS_OK;
}

/* All methods ---------------------------------------------------------------------------------------------------- */

static void describe(converge *c)
{
    result *r = c->out;
    char until[DECIMAL_MAX], uncut[DECIMAL_MAX];
    const double span = c->uncut - c->s.from;
    int n = snprintf(r->reference, sizeof r->reference, "%s", c->reference.text);
    if (c->cut && n > 0 && (size_t)n < sizeof r->reference)
        snprintf(r->reference + n, sizeof r->reference - (size_t)n,
                 "; until %s, not %s: over a longer motion low orders would need too many steps to converge",
                 decimal_time(c->grid.until, span, until), decimal_time(c->uncut, span, uncut));
    r->seen.reference_error = c->reference.scaled;
}

static motus_status converge_all(converge *c)
{
    study *s = &c->s;
    double until = NAN;
    study_part(s, 0, REFERENCE_SHARE / 2);
    motus_status status = choose_end(c, &until);
    if (status != MOTUS_OK) return status;
    c->grid = grid_of(s, until, INTERVALS, c->share);
    study_part(s, REFERENCE_SHARE / 2, REFERENCE_SHARE / 2);
    if ((status = solution_find(s, &c->grid, INTERVALS, 0, &c->reference)) != MOTUS_OK) return status;
    if (!c->reference.known) return solution_missing(s, &c->reference, c->uncut);
    c->allowed = solution_allows(&c->s, &c->reference, c->why, sizeof c->why);
    bool passed = true;
    for (size_t k = 0; k < c->count; k++) {
        double share = (1 - REFERENCE_SHARE) / (double)c->count;
        study_part(s, REFERENCE_SHARE + share * (double)k, share);
        if ((status = make_row(c, k)) != MOTUS_OK) return status;
        passed = passed && (c->out->rows[k].passed || c->out->rows[k].uncertain);
    }
    c->out->seen.passed = passed;
    describe(c);
    return MOTUS_OK;
}

motus_status motus_converge(motus_system *system, const motus_study_def *given, motus_convergence **convergence,
                            motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!system || !convergence)
        return fail(err, MOTUS_ARGUMENT, "motus_converge needs a system and a place for its result");
    *convergence = NULL;
    converge c = {.uncut = NAN};
    motus_settings settings;
    const modes host = modes_enter();
    motus_status status = study_read(given, &c.def, err);
    if (status == MOTUS_OK) status = study_settings(system, &c.def, &settings, err);
    if (status == MOTUS_OK) status = study_open(&c.s, system, &c.def, &settings, 0, err);
    if (status == MOTUS_OK) status = study_methods(&c.s, &c.def, true, &c.methods, &c.count);
    if (status == MOTUS_OK) status = make_result(&c);
    if (status == MOTUS_OK) status = converge_all(&c);
    if (c.s.allocator) {
        solution_free(&c.s, &c.reference);
        give(c.s.allocator, c.table);
        give(c.s.allocator, c.columns);
        give(c.s.allocator, (void *)c.methods);
        if (status == MOTUS_OK)
            *convergence = &c.out->seen;
        else
            give(c.s.allocator, c.out);
        study_close(&c.s);
    }
    modes_leave(host);
    return status;
}

void motus_convergence_destroy(motus_convergence *c)
{
    if (c) study_drop(c, ((result *)(void *)c)->allocator);
}
