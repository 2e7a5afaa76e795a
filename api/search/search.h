/* The search for the tolerance, or the step, with which the error of an answer keeps to an accuracy: each trial tells
 * the size of the next. Runs and trajectories of ensembles follow the same rule. */
#ifndef API_SEARCH_SEARCH_H
#define API_SEARCH_SEARCH_H

#include "base/error.h"

#include <stdbool.h>

typedef struct search {
    double wanted;
    bool absolute;
    double size;   /* of the present trial: a tolerance or a step */
    double power;  /* errors go with this power of the size */
    double least;  /* smallest size */
    double length; /* of the way of fixed steps, which divide it; else 0 */
    bool few; /* tolerances are 1, 2 or 5 times a power of ten: trajectories with equal ones are computed together */
    /* of trials that came to their end: the smallest bar, and how many of the latest are not clearly below it */
    double smallest;
    int stuck;
    int trials;
} search;

/* Checks that neither a tolerance nor a step is given beside an accuracy. MOTUS_ARGUMENT. */
motus_status search_alone(bool tolerance, bool step, motus_error *);

/* Begin a search: by tolerances, from a tenth of `wanted` on; by steps, from `step` on, over a way of this length. */
search search_by_tolerance(double wanted, bool absolute);
search search_by_step(double wanted, bool absolute, double step, double length, int order);
/* Sets the size of the present trial. */
void search_set(search *, double size);
/* Judges a trial by its largest bar (INFINITY: it failed) and the part of the way that it came, `done`. Returns whether
 * a smaller size is to be tried, which `size` is then. */
bool search_next(search *, double bar, double done);
/* Returns whether a trial with such bars, in the unit of the accuracy and relative ones, may as well end. */
bool search_hopeless(const search *, double bar, double relative);

#endif
