/* Straight lines through points, and the observed order of a method. fit.c states the rule that chooses the points. */
#ifndef STUDY_FIT_H
#define STUDY_FIT_H

#include "motus.h"

/* Fits y = intercept + slope x by least squares; slope_error is the standard error of the slope (0 for two points). */
typedef struct fit_result {
    double slope, intercept, slope_error;
} fit_result;
fit_result fit_line(const double *x, const double *y, size_t count);

typedef enum fit_verdict {
    FIT_SLOPE, /* observed and standard_error are set */
    FIT_EXACT, /* nothing but round-off at every step */
    FIT_FEW,   /* fewer than FIT_POINTS_MIN points between instability and round-off */
    FIT_ROUGH  /* the errors follow no power of the step */
} fit_verdict;

#define FIT_POINTS_MIN 4

typedef struct fit_order_result {
    fit_verdict verdict;
    double observed, standard_error; /* NaN unless FIT_SLOPE */
    size_t above;                    /* points between instability and round-off */
    double floor;                    /* the round-off found, in units of the errors */
    double fall;                     /* the slope from the first point above to the last; NaN: fewer than two */
    double slope_change;             /* difference of the two finest local slopes in use */
    double octaves;                  /* of steps, from the first point of the fit to the last */
    int settled;                     /* the plateau of round-off is reached: finer steps add nothing */
} fit_order_result;

/* Fits the order to points from coarse to fine, and sets their `used`. Their errors are relative to the size of the
 * motion, NaN where a run failed; duration: of the runs; noise: the rounding of one number; reference_error: of the
 * reference solution. */
fit_order_result fit_order(motus_point *points, size_t count, double duration, double noise, double reference_error);

/* Returns whether an observed order meets the declared one. */
int fit_passes(double observed, double standard_error, int declared);

#endif
