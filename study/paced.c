/* See paced.h.
 *
 * Three statements are certified. (1) The error goes with the power p of the mean step, p the order: where tolerances
 * are small the sizes of the steps become a fixed function of the time, times one number, and the error is that of a
 * method of fixed step along a stretched time. (2) The error goes with the tolerance at least proportionally, since the
 * estimate of a step's error, of a lower order, is kept at the tolerance, and the result is of the higher order. For
 * rows with reversible steps, whose tolerance is the error of a step on a circle, the power is p/(p + 1). (3) Between
 * the ends of steps, at the part PART of a step, the error goes with the power of the mean step that is due to dense
 * output, p or one more than dense_order, whichever is less.
 *
 * Every statement is the slope of a straight line through logarithms, with twice its standard error, over the finest
 * two octaves of steps whose errors are clear of round-off: the pattern of the steps changes a little with every
 * tolerance, so errors scatter about the line, and neighbours tell less than with steps of one size. A slope that is
 * not below what is due, but for MARGIN or its interval, certifies the row; one that is below by LOST, a whole order,
 * refutes it. In between, where the steps are not yet small or few points lie above round-off, nothing is said.
 */
#include "paced.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define TOLERANCE_FIRST 0.01
#define TOLERANCE_LAST 1e-12 /* a smaller one brings rounding into the estimates, and so into the steps */
#define FINE_ORDER 4         /* from this order on four points an octave of steps, below it one */
#define PART 0.4             /* of a step */
#define MARGIN 0.25
#define LOST 1.0       /* of an order: how far below its due a slope refutes */
#define LOST_PART 0.25 /* the distance as a part of a high order, which shows later */
#define CEILING 0.01   /* of the motion's size; errors above it, or below CLEARANCE times round-off, tell no order */
#define CLEARANCE 30.0
#define SUMMED 10.0
#define OCTAVES 4.001 /* two, as a factor of steps */
#define OCTAVES_LEAST 1.999
enum { POINTS_MOST = 128, POINTS_LEAST = 5 };

double paced_tolerance(const motus_method *card, size_t i)
{
    const double octaves = (double)i / (card->order < FINE_ORDER ? 2 : 4);
    const double tolerance = TOLERANCE_FIRST * exp(-octaves * card->order * log(2));
    return tolerance >= TOLERANCE_LAST ? tolerance : 0;
}

/* Measures the errors at the end of the last step, and within it. */
static motus_status judge(paced *p, motus_run *run, double before, motus_point *point, motus_error *e)
{
    study *s = p->s;
    double *y = p->room, *exact = y + s->numbers, now = motus_run_time(run), within = before + PART * (now - before);
    motus_status status = study_state(s, run, y, e);
    if (status == MOTUS_OK) status = solution_near(s, p->reference, p->grid, now, exact, e);
    if (status == MOTUS_OK) point->error = study_larger(point->error, study_measure(s, y, exact).scaled);
    if (status != MOTUS_OK) return status;
    if (motus_run_sample(run, &within, 1, p->columns, s->numbers, y, e) != MOTUS_OK) {
        point->error_between = NAN; /* the steps themselves are good */
        return e->status == MOTUS_MEMORY ? MOTUS_MEMORY : MOTUS_OK;
    }
    status = solution_near(s, p->reference, p->grid, within, exact, e);
    if (status == MOTUS_OK)
        point->error_between = study_larger(point->error_between, study_measure(s, y, exact).scaled);
    return status;
}

motus_status paced_measure(paced *p, const char *method, motus_point *point, int64_t *steps, motus_error *e,
                           motus_status *failed)
{
    study *s = p->s;
    const study_grid *g = p->grid;
    const double direction = g->until > g->from ? 1 : -1;
    motus_run *run = NULL;
    point->error = point->error_between = 0;
    s->tolerance = point->tolerance;
    motus_status status = study_run(s, method, NAN, NAN, g->until, NULL, &run, e);
    for (size_t mark = 1; mark <= g->points && status == MOTUS_OK; mark++) {
        const double to = solution_time(g, mark);
        double before = motus_run_time(run);
        while (status == MOTUS_OK && !motus_run_done(run) && (to - motus_run_time(run)) * direction > 0) {
            before = motus_run_time(run);
            status = motus_run_step(run, 1, e);
        }
        if (status == MOTUS_OK && before != motus_run_time(run)) status = judge(p, run, before, point, e);
    }
    *steps = run ? motus_run_steps(run) : 0;
    point->evaluations = run ? motus_run_now(run).evaluations : 0;
    point->step = *steps > 0 ? fabs(g->until - g->from) / (double)*steps : NAN;
    motus_run_destroy(run);
    if (s->cancelled || study_fatal(status)) return study_tell(s, status, e);
    if (status != MOTUS_OK) *failed = status;
    if (status != MOTUS_OK || !isfinite(point->error)) point->error = NAN;
    if (status != MOTUS_OK || !isfinite(point->error_between)) point->error_between = NAN;
    return MOTUS_OK;
}

/* Certificates ----------------------------------------------------------------------------------------------------- */

typedef enum verdict { PASSED, FAILED, UNCERTAIN } verdict;

typedef struct slopes {
    fit_result by_step, by_tolerance; /* slope NaN: too few points */
} slopes;

/* Returns whether an error is clear of round-off: of what the fit has found; and, where a sum is not compensated and
 * round-off is equal in every step, of one rounding per step, of which a tenth of the error is left. */
static bool clear(const paced_noise *noise, const motus_point *p, double error)
{
    if (!(p->step > 0)) return false;
    const double steps = noise->duration / p->step;
    return error < CEILING && error >= fmax(CLEARANCE * noise->floor, SUMMED * steps * noise->number);
}

/* Fits slopes over the finest octaves, of errors at the ends of steps, whose points become `used`, or between. */
static slopes slopes_of(const paced_noise *noise, motus_point *points, size_t count, bool between)
{
    double step[POINTS_MOST], tolerance[POINTS_MOST], error[POINTS_MOST], finest = 0, coarsest = 0;
    size_t n = 0;
    for (size_t i = count; i-- > 0 && n < POINTS_MOST;) {
        const double e = between ? points[i].error_between : points[i].error;
        if (!clear(noise, &points[i], e)) continue;
        if (n == 0) finest = points[i].step;
        if (points[i].step > OCTAVES * finest) break;
        coarsest = points[i].step;
        step[n] = log(points[i].step);
        tolerance[n] = log(points[i].tolerance);
        error[n++] = log(e);
        if (!between) points[i].used = 1;
    }
    const fit_result none = {NAN, NAN, NAN};
    if (n < POINTS_LEAST || coarsest < OCTAVES_LEAST * finest) return (slopes){none, none};
    return (slopes){fit_line(step, error, n), fit_line(tolerance, error, n)};
}

static verdict judge_slope(const fit_result *line, double due)
{
    const double interval = fmax(MARGIN, 2 * line->slope_error);
    if (!(interval < LOST)) return UNCERTAIN; /* NaN: there is no line */
    return line->slope >= due - interval                                             ? PASSED
           : line->slope + 2 * line->slope_error < due - fmax(LOST, LOST_PART * due) ? FAILED
                                                                                     : UNCERTAIN;
}

static void write_slope(char *text, size_t size, const char *what, const fit_result *line, verdict v, double due)
{
    size_t length = strlen(text);
    if (isnan(line->slope))
        snprintf(text + length, size - length, "%s: no slope, due %.3g", what, due);
    else
        snprintf(text + length, size - length, "%s: %.2f ± %.2f, due %.3g", what, line->slope, 2 * line->slope_error,
                 due);
    length = strlen(text);
    if (v == UNCERTAIN) snprintf(text + length, size - length, " (not certified)");
    if (v == FAILED) snprintf(text + length, size - length, " (FAILED)");
}

void paced_certify(const motus_method *card, const paced_noise *noise, bool exact, motus_point *points,
                   motus_converge_row *row, char *text, size_t size)
{
    const int dense = card->dense_order + 1;
    row->between_due = card->order < dense ? card->order : dense;
    row->power_due = card->reversible ? (double)card->order / (card->order + 1) : 1;
    row->exact_here = exact;
    if (row->exact_here) {
        row->passed = 1;
        snprintf(text, size, "exact here, declared %d", card->order);
        return;
    }
    for (size_t i = 0; i < row->point_count; i++) points[i].used = 0;
    const slopes ends = slopes_of(noise, points, row->point_count, false),
                 between = slopes_of(noise, points, row->point_count, true);
    const fit_result lines[] = {ends.by_step, ends.by_tolerance, between.by_step};
    const double due[] = {card->order, row->power_due, row->between_due};
    static const char *const what[] = {"order", "; power of the tolerance", "; order between steps"};
    bool failed = false, uncertain = false;
    text[0] = 0;
    for (int i = 0; i < 3; i++) {
        const verdict v = judge_slope(&lines[i], due[i]);
        failed = failed || v == FAILED;
        uncertain = uncertain || v == UNCERTAIN;
        write_slope(text, size, what[i], &lines[i], v, due[i]);
    }
    row->observed = lines[0].slope;
    row->standard_error = lines[0].slope_error;
    row->power = lines[1].slope;
    row->power_error = lines[1].slope_error;
    row->between = lines[2].slope;
    row->between_error = lines[2].slope_error;
    row->passed = !failed && !uncertain;
    row->uncertain = !failed && uncertain;
    if (failed) row->status = MOTUS_ORDER;
}
