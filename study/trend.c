/* The trend of an invariant: a drift that neither its oscillation nor rounding explains.
 *
 * Neighbouring samples of an oscillation are not independent, so a line through all of them believes itself far too
 * much. The run is cut into BLOCKS; their means average the oscillation away. There are two ways to be a trend:
 *   - the drift oscillates about its line (CROSSINGS or more), and the slope of the block means is beyond 4 of their
 *       standard errors;
 *   - no oscillation can be told, or growth is so uneven that a line does not fit it, but the means climb or fall
 *       practically without
 *     exception (nine pairs in ten agree).
 * Either way the trend must exceed what rounding explains. Invariant: the answer depends on the numbers given alone.
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

/* How often the residual goes from well above its line to well below or back. Half of its mean size is well: so
 * short, high swings with long rests between them count as well as even ones. */
static size_t swings(const double *t, const double *drift, size_t count, fit_result line)
{
    double mean = 0, before = 0;
    size_t crossings = 0;
    for (size_t i = 0; i < count; i++) {
        double e = drift[i] - line.intercept - line.slope * t[i];
        mean += fabs(e) / (double)count;
    }
    for (size_t i = 0; i < count; i++) {
        double e = drift[i] - line.intercept - line.slope * t[i];
        if (2 * fabs(e) <= mean) continue;
        crossings += before != 0 && (e > 0) != (before > 0);
        before = e;
    }
    return crossings;
}

trend_result trend_find(const double *t, const double *drift, size_t count, double roundoff)
{
    trend_result r = {NAN, 0};
    fit_result line = fit_line(t, drift, count);
    if (count < 2 || isnan(line.slope)) return r;
    r.trend = line.slope * (t[count - 1] - t[0]);
    if (count < TREND_SAMPLES_MIN || !(fabs(r.trend) > roundoff)) return r;

    size_t crossings = swings(t, drift, count, line);

    double mt[BLOCKS], md[BLOCKS];
    size_t blocks = count < BLOCKS ? count : BLOCKS;
    for (size_t b = 0; b < blocks; b++) {
        size_t first = b * count / blocks, end = (b + 1) * count / blocks;
        mt[b] = md[b] = 0;
        for (size_t i = first; i < end; i++) {
            mt[b] += t[i] / (double)(end - first);
            md[b] += drift[i] / (double)(end - first);
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
