/* The observed order of a method from its errors at a sequence of steps.
 *
 * The rule that chooses the points of the fit (points run coarse to fine; the declared order has no part in it):
 *
 * 1. A point counts if its run ended with an error below FIT_CEILING of the motion's size, and if its step is at most
 * half of the shortest step of a run that failed or had a larger error: close to its stability limit a method does not
 * show its order. 2. Round-off is at least the error of the reference solution. The rest is measured: the plateau
 * begins where the slope to the next point and to the one after it falls below FIT_FLAT, half of what order 1 would
 * show, while the error is below FIT_PLATEAU (or below n² roundings, the worst for a sum of sums); its first errors are
 * the round-off. Where no plateau was reached, round-off is taken for a random walk of n roundings, FIT_WALK sqrt(n) of
 * one. Points below FIT_CLEARANCE times it, or on the plateau, do not count: the remaining share of round-off, 1/30,
 * bends a local slope by less than the certificate's margin. 3. The order is a limit of small steps, so the finest
 * FIT_POINTS_MIN of these points are taken, and as many more as span an octave; then coarser ones as long as the local
 * slope stays within FIT_STEADY (FIT_STEADY_PART of a high order) of the slope across these. This leaves out coarse
 * points that are better than the order (superconvergent) and those that are worse (not yet asymptotic). 4. With at
 * least FIT_POINTS_MIN points, the order is the least-squares slope of log error against log step. If its standard
 * error is above FIT_ROUGHNESS, the errors follow no power of the step and there is no slope.
 *
 * A method is exact here if every error, at coarse and fine steps, is within what rounding n steps can explain.
 */
#include "fit.h"
#include <math.h>
#include <stdbool.h>

#define FIT_CEILING 0.1
#define FIT_PLATEAU 1e-8
#define FIT_FLAT 0.5
#define FIT_CLEARANCE 30.0
#define FIT_WALK 2.0
#define FIT_STEADY 0.05
#define FIT_STEADY_PART 0.02
#define FIT_ROUGHNESS 0.5
#define OCTAVE 1.999 /* 2, less the rounding of steps */
#define EXACT_STEPS 8.0
#define FIT_MARGIN 0.15 /* of the certificate */
#define FIT_POINTS_MAX 128

fit_result fit_line(const double *x, const double *y, size_t count)
{
    fit_result r = {NAN, NAN, NAN};
    if (count < 2) return r;
    double mx = 0, my = 0;
    for (size_t i = 0; i < count; i++) {
        mx += (x[i] - x[0]) / (double)count;
        my += (y[i] - y[0]) / (double)count;
    }
    mx += x[0];
    my += y[0];
    double sxx = 0, sxy = 0;
    for (size_t i = 0; i < count; i++) {
        sxx += (x[i] - mx) * (x[i] - mx);
        sxy += (x[i] - mx) * (y[i] - my);
    }
    if (!(sxx > 0)) return r;
    r.slope = sxy / sxx;
    r.intercept = my - r.slope * mx;
    double rest = 0;
    for (size_t i = 0; i < count; i++) {
        double e = (y[i] - my) - r.slope * (x[i] - mx);
        rest += e * e;
    }
    r.slope_error = count > 2 ? sqrt(rest / (double)(count - 2) / sxx) : 0;
    return r;
}

static double local_slope(const motus_point *p, const motus_point *q)
{
    return log(p->error / q->error) / log(p->step / q->step);
}

/* Returns whether a point's run ended with an error that is small and not zero. */
static bool counts(const motus_point *p) { return p->error > 0 && p->error < FIT_CEILING; /* false for NaN */ }

/* Returns the index where the plateau of round-off begins, or count. */
static size_t plateau(const motus_point *points, size_t count, double duration, double noise)
{
    for (size_t i = 0; i + 1 < count; i++) {
        if (points[i + 1].error == 0) return i + 1;
        double steps = duration / points[i].step;
        if (!counts(&points[i]) || !counts(&points[i + 1]) ||
            points[i].error > fmax(FIT_PLATEAU, noise * steps * steps))
            continue;
        if (local_slope(&points[i], &points[i + 1]) >= FIT_FLAT) continue;
        /* The error at the first point may be small because terms cancel; if the point after the next is no better
         * either, the flat stretch is round-off. */
        if (i + 2 == count || !counts(&points[i + 2]) || local_slope(&points[i], &points[i + 2]) < FIT_FLAT) return i;
    }
    return count;
}

/* Returns whether rounding explains the error at every step: each step rounds once or twice, a recursion of second
 * order sums its sums, and the reference solution has its own error. */
static bool exact_everywhere(const motus_point *points, size_t count, double duration, double noise,
                             double reference_error)
{
    size_t finite = 0;
    for (size_t i = 0; i < count; i++) {
        if (isnan(points[i].error)) continue;
        double steps = duration / points[i].step, sums = steps / EXACT_STEPS;
        if (points[i].error > 4 * noise * (EXACT_STEPS + steps + sums * sums) + 4 * reference_error) return false;
        finite++;
    }
    return finite >= FIT_POINTS_MIN;
}

/* Finds the points that count and lie clear of round-off, coarse to fine; sets r->floor to the round-off found. */
static size_t find_clear(motus_point *points, size_t count, double duration, double noise, fit_order_result *r,
                         motus_point **clear)
{
    size_t flat = plateau(points, count, duration, noise), n = 0;
    /* A flat stretch of the last two points may still be a cancellation. */
    r->settled = flat + 2 < count;
    if (flat < count) {
        double level = 0;
        for (size_t i = flat; i < count && i < flat + 3; i++) level += isnan(points[i].error) ? 0 : points[i].error / 3;
        r->floor = fmax(r->floor, level);
    }
    double longest = INFINITY;
    for (size_t i = 0; i < count && i <= flat && n < FIT_POINTS_MAX; i++) {
        double walk = r->settled ? 0 : noise * (1 + FIT_WALK * sqrt(duration / points[i].step));
        if (points[i].error >= FIT_CEILING || (n == 0 && isnan(points[i].error))) {
            n = 0; /* the errors at coarser steps were small by accident */
            longest = points[i].step / OCTAVE;
        } else if (counts(&points[i]) && points[i].step <= longest &&
                   points[i].error >= FIT_CLEARANCE * fmax(r->floor, walk)) {
            clear[n++] = &points[i];
        }
    }
    return n;
}

fit_order_result fit_order(motus_point *points, size_t count, double duration, double noise, double reference_error)
{
    fit_order_result r = {
        .verdict = FIT_FEW, .observed = NAN, .standard_error = NAN, .fall = NAN, .slope_change = INFINITY};
    for (size_t i = 0; i < count; i++) points[i].used = 0;
    r.floor = fmax(noise, reference_error);
    if (exact_everywhere(points, count, duration, noise, reference_error)) {
        r.verdict = FIT_EXACT;
        return r;
    }

    motus_point *clear[FIT_POINTS_MAX];
    size_t n = find_clear(points, count, duration, noise, &r, clear);
    r.above = n;
    if (n > 1) r.fall = local_slope(clear[0], clear[n - 1]);
    if (n < FIT_POINTS_MIN) return r;

    size_t least = n - FIT_POINTS_MIN;
    while (least > 0 && clear[least]->step < OCTAVE * clear[n - 1]->step) least--;
    double middle = local_slope(clear[least], clear[n - 1]), steady = fmax(FIT_STEADY, FIT_STEADY_PART * fabs(middle));
    r.slope_change = fabs(local_slope(clear[n - 2], clear[n - 1]) - local_slope(clear[n - 3], clear[n - 2]));
    while (least > 0 && fabs(local_slope(clear[least - 1], clear[least]) - middle) <= steady) least--;

    double lx[FIT_POINTS_MAX] = {0}, ly[FIT_POINTS_MAX] = {0};
    for (size_t i = least; i < n; i++) {
        lx[i - least] = log(clear[i]->step);
        ly[i - least] = log(clear[i]->error);
    }
    fit_result line = fit_line(lx, ly, n - least);
    if (!(line.slope_error <= FIT_ROUGHNESS)) {
        r.verdict = FIT_ROUGH;
        return r;
    }
    for (size_t i = least; i < n; i++) clear[i]->used = 1;
    r.verdict = FIT_SLOPE;
    r.octaves = log(clear[least]->step / clear[n - 1]->step) / log(2);
    r.observed = line.slope;
    r.standard_error = line.slope_error;
    return r;
}

int fit_passes(double observed, double standard_error, int declared)
{
    double margin = FIT_MARGIN;
    /* From order 6 on few points lie above round-off, so the slope is as uncertain as its standard error. */
    if (declared >= 6) margin = fmax(margin, 2 * standard_error);
    return observed >= declared - margin;
}
