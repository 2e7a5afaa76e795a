/* The trend of an invariant: a change that neither its oscillation nor rounding explains.
 *
 * Neighbouring samples of an oscillation are not independent, so the standard error of a line through all of them is
 * far too small. The run is cut into BLOCKS, whose means average the oscillation away. There is a trend if
 *   - the deviation oscillates about its line (CROSSINGS or more), and the slope of the block means is more than
 *     TREND_ERRORS of their standard errors; or
 *   - the block means rise or fall nearly always (TREND_AGREEMENT of the pairs): this finds growth without an
 *     oscillation, or too uneven for a line.
 * Either way the trend must exceed what rounding explains.
 */
#include "trend.h"
#include "fit.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#define BLOCKS 16
#define CROSSINGS 6
#define TREND_ERRORS 4.0
#define TREND_AGREEMENT 0.9
#define TREND_SAMPLES_MIN 8

/* Counts how often the residual goes from more than half its mean size above the line to as much below it, or back.
 * With this threshold short high peaks count as even swings do. */
static size_t swings(const double *t, const double *deviation, size_t count, fit_result line)
{
    double mean = 0, before = 0;
    size_t crossings = 0;
    for (size_t i = 0; i < count; i++) {
        double e = deviation[i] - line.intercept - line.slope * t[i];
        mean += fabs(e) / (double)count;
    }
    for (size_t i = 0; i < count; i++) {
        double e = deviation[i] - line.intercept - line.slope * t[i];
        if (2 * fabs(e) <= mean) continue;
        crossings += before != 0 && (e > 0) != (before > 0);
        before = e;
    }
    return crossings;
}

trend_result trend_find(const double *t, const double *deviation, size_t count, double roundoff)
{
    trend_result r = {NAN, 0};
    fit_result line = fit_line(t, deviation, count);
    if (count < 2 || isnan(line.slope)) return r;
    r.trend = line.slope * (t[count - 1] - t[0]);
    if (count < TREND_SAMPLES_MIN || !(fabs(r.trend) > roundoff)) return r;

    size_t crossings = swings(t, deviation, count, line);

    double mt[BLOCKS], md[BLOCKS];
    size_t blocks = count < BLOCKS ? count : BLOCKS;
    for (size_t b = 0; b < blocks; b++) {
        size_t first = b * count / blocks, end = (b + 1) * count / blocks;
        mt[b] = md[b] = 0;
        for (size_t i = first; i < end; i++) {
            mt[b] += t[i] / (double)(end - first);
            md[b] += deviation[i] / (double)(end - first);
        }
    }
    fit_result means = fit_line(mt, md, blocks);
    bool clear = crossings >= CROSSINGS && fabs(means.slope) > TREND_ERRORS * means.slope_error;
    long agree = 0, pairs = (long)(blocks * (blocks - 1) / 2);
    for (size_t i = 0; i < blocks; i++)
        for (size_t j = i + 1; j < blocks; j++) agree += (md[j] > md[i]) - (md[j] < md[i]);
    bool steady = (double)labs(agree) >= TREND_AGREEMENT * (double)pairs;
    r.trending = clear || steady;
    return r;
}
