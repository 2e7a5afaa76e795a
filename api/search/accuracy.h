/* The search for an accuracy: trials find the tolerance, or the step, with which the bars of a run keep to it. */
#ifndef API_SEARCH_ACCURACY_H
#define API_SEARCH_ACCURACY_H

#include "api/motion/run.h"

#include <stdbool.h>

/* ---- search.c: each trial tells the size of the next; runs and trajectories of ensembles follow one rule ---- */

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

/* ---- steep.c: where a motion passes an infinite slope of its force, as of cbrt(x) at x = 0 ----
 *
 * There no method has the errors of its order, and Taylor series end. */

typedef struct steep {
    bool known;                /* it has been looked for */
    char text[MOTUS_TEXT_MAX]; /* "the force has an infinite slope where x - 1 is 0, first at t = 2.5"; "": nowhere */
} steep;

/* Finds the first such place on the motion of a definition with an end, once. MOTUS_CANCELLED, MOTUS_MEMORY. */
motus_status steep_find(motus_system *, const motus_run_def *, steep *, motus_error *);

/* ---- decimals.c: what the rounding of a model's decimals does to an answer ---- */

/* Finds how far the answer moves where every decimal is read as the double on its other side: the largest change of a
 * number of the state at the end, relative to the largest number of its kind, or absolute. `run` is at its end; `def`
 * is its definition, whose hook may cancel. NaN: not known, or not clearly more than rounding. */
motus_status decimals_part(const motus_run_def *def, motus_run *run, bool absolute, double *part, motus_error *);

/* ---- accuracy.c ---- */

typedef struct accuracy {
    /* The accuracy, NaN: none; and the largest bar of the best trial, in the same unit, INFINITY: no trial came to its
     * end with digits. */
    double wanted, reached;
    bool absolute;
    int trials;
    motus_run *best; /* the best trial */
    /* missed: no trial kept to the accuracy; by_step: trials differed in their step, not their tolerance */
    bool missed, by_step;
    bool failed;     /* no trial came to its end, and the last one failed for no reason of the motion */
    double size;     /* the step or tolerance of the best trial */
    double time;     /* the time to which the best trial went */
    double rounding; /* the part of `reached` that the model's decimals make; NaN: less than `wanted` */
    steep steep;     /* what the motion passes, where the accuracy was missed or trials failed */
} accuracy;

/* Completes a definition that names its method by the tolerance or step of the best trial; without located switches,
 * where these would have another force than the typed one. The hint is what is known of the run, and gets what the
 * trials tell. */
motus_status accuracy_find(motus_system *, motus_run_def *, run_hint *, accuracy *, motus_error *);
/* Returns whether another method may reach what this one did not: it failed for no reason of the motion, or the motion
 * passes an infinite slope. */
bool accuracy_wants_another(const accuracy *, const motus_error *);
void accuracy_end(accuracy *);
/* Returns the largest error of a run at its end, by the run's own bars where the best trial has none. */
double accuracy_reached(const accuracy *, const motus_run *);
/* Reports what a run has reached that missed its accuracy. MOTUS_ACCURACY. */
motus_status accuracy_refuse(const accuracy *, const motus_run *, motus_error *);

#endif
