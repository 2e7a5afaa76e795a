/* See tally.h. */
#include "core/tally.h"

#include "core/stepper_parts.h"

#include <math.h>

stepper_count tally_begin(const stepper *s)
{
    return (stepper_count){.evaluations = stepper_evaluations(s), .refused = stepper_refused(s)};
}

double tally_tolerance(const chosen *c) { return !row_adaptive(c) ? NAN : c->absolute > 0 ? c->absolute : c->relative; }

tally tally_of(const stepper *s, stepper_count before)
{
    tally t = {.steps = stepper_steps(s),
               .refused = stepper_refused(s) - before.refused,
               .evaluations = stepper_evaluations(s) - before.evaluations,
               .accuracy = NAN,
               .tolerance = tally_tolerance(&s->method)};
    stepper_sizes(s, &t.shortest, &t.longest);
    return t;
}

double tally_number(const tally *t, int which)
{
    const double numbers[TALLIES] = {
        [TALLY_STEPS] = (double)t->steps, [TALLY_REFUSED] = (double)t->refused,         [TALLY_SHORTEST] = t->shortest,
        [TALLY_LONGEST] = t->longest,     [TALLY_EVALUATIONS] = (double)t->evaluations, [TALLY_ACCURACY] = t->accuracy,
        [TALLY_TOLERANCE] = t->tolerance,
    };
    return numbers[which];
}

/* A step evaluates its first stage once for all its candidates, or not at all where the step before ended with it; a
 * candidate evaluates the other stages. A Taylor series takes an evaluation for every order but the last two once a
 * step, one for each refused candidate, and one for the size of the first step. */
bool tally_evaluations(const work *plan, tally *t)
{
    if (plan->expands) {
        t->evaluations = t->steps * (plan->expands - 1) + t->refused + (t->steps > 0);
        return true;
    }
    if (!row_has(plan->row, COUNTS) || !plan->row->adaptive) return false;
    const bool last_is_first = plan->ending || plan->closing;
    const int64_t starts = last_is_first && t->steps > 0 ? 1 : t->steps;
    t->evaluations = starts + (t->steps + t->refused) * (plan->stages - 1 + plan->ending);
    return true;
}
