/* The search for the tolerance, or the step, with which the error of an answer keeps to an accuracy: what each trial
 * says of the size of the next. Runs and the trajectories of ensembles are searched for by the same rule.
 */
#ifndef API_SEARCH_SEARCH_H
#define API_SEARCH_SEARCH_H

#include "base/error.h"

#include <stdbool.h>

typedef struct search {
    double wanted;
    bool absolute;
    double size;   /* of the trial in hand: a tolerance, or a step */
    double power;  /* errors go with this power of the size */
    double least;  /* size */
    double length; /* of a run whose steps have one size, else 0: its steps divide it */
    bool few;      /* tolerances are 1, 2 or 5 times a power of ten: those who have the same are computed together */
    /* So far, of trials that came to their end: the smallest of their bars, and how many of the latest have not made it
     * clearly smaller. */
    double smallest;
    int stuck;
    int trials;
} search;

/* Whether an accuracy can be asked for: not with a tolerance or a step. MOTUS_ARGUMENT. */
motus_status search_alone(bool tolerance, bool step, motus_error *);

/* By tolerances, from a tenth of what is wanted on. By steps, from this one on, over a way of this length. */
search search_by_tolerance(double wanted, bool absolute);
search search_by_step(double wanted, bool absolute, double step, double length, int order);
/* A trial has this size in place of the one it was to have. */
void search_set(search *, double size);
/* A trial had `bar` as its largest, INFINITY: it failed, and came as far as `done`, a part of the whole way. Whether
 * there is a smaller size to try, which `size` is then. */
bool search_next(search *, double bar, double done);
/* Whether a trial that goes on with such bars, in the unit of the accuracy and relative ones, need not end. */
bool search_hopeless(const search *, double bar, double relative);

#endif
