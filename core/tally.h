/* The tally of a trajectory: its steps, and what they cost. */
#ifndef CORE_TALLY_H
#define CORE_TALLY_H

#include "core/stepper.h"

/* In the order of motus_reduction, from MOTUS_REDUCE_STEPS on. */
enum {
    TALLY_STEPS,
    TALLY_REFUSED,
    TALLY_SHORTEST,
    TALLY_LONGEST,
    TALLY_EVALUATIONS,
    TALLY_ACCURACY,
    TALLY_TOLERANCE,
    TALLIES
};

typedef struct tally {
    int64_t steps, refused, evaluations;
    double accuracy;          /* from the companion; NaN: there is no companion */
    double tolerance;         /* NaN: steps are fixed */
    double shortest, longest; /* steps of the leg, without one that was cut short at its end; NaN: there is none */
} tally;

/* Counts the stepper's present leg; `before`: what tally_begin returned when the leg began. */
tally tally_of(const stepper *, stepper_count before);
/* Returns the stepper's counters at the start of a leg, for `before` of tally_of. */
stepper_count tally_begin(const stepper *);
double tally_number(const tally *, int which);
/* Returns the tolerance of a method; NaN where steps are fixed. */
double tally_tolerance(const chosen *);

/* Computes the evaluations of a trajectory from the steps that it took and refused up to its end. False: they do not
 * follow from these numbers, because the row iterates or is not adaptive. */
struct work; /* step/work.h */
bool tally_evaluations(const struct work *plan, tally *);

#endif
