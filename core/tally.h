/* What a trajectory took: its steps and what they cost. */
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
    double accuracy;          /* by its companion; NaN: it has none */
    double tolerance;         /* NaN: steps have one size */
    double shortest, longest; /* steps of the leg, without one that was cut short at its end; NaN: there is none */
} tally;

/* Of the stepper's present leg; `before`: its counters when the leg began. */
tally tally_of(const stepper *, stepper_count before);
/* The counters so far, for `before`. */
stepper_count tally_begin(const stepper *);
double tally_number(const tally *, int which);
/* Of a method: NaN where steps have one size. */
double tally_tolerance(const chosen *);

/* The evaluations of a trajectory that has come to its end by so many taken and refused steps. False: they do not
 * follow from these numbers, since the row iterates, or is not adaptive. */
struct work; /* step/work.h */
bool tally_evaluations(const struct work *plan, tally *);

#endif
