/* See problems.h. */
#include "bench/problems.h"
#include "bench/truths.h"

#include <math.h>

#define NUMBER double
#define ROOT sqrt
#define FORCE(name) force_##name
#include "bench/forces.h"

#define PROBLEM(name, positions, end, ...) static const double start_##name[] = {__VA_ARGS__};
#include "bench/problems.def"

const problem problems[PROBLEMS] = {
#define PROBLEM(name, positions, end, ...) {#name, positions, end, start_##name, truth_##name, force_##name},
#include "bench/problems.def"
};

double problem_error(const problem *p, const double *state)
{
    double most = 0;
    for (int k = 0; k < p->positions; k++) {
        const double off = fabs(state[k] - p->truth[k]);
        most = off <= most ? most : off; /* what is no number stays so */
    }
    return most;
}
