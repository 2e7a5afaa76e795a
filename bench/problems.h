/* THE PROBLEMS of the comparison of accuracy, with their exact motions.
 *
 * Invariant: every library gets the same doubles: start, end and constants; the exact motion is that of these doubles.
 */
#ifndef BENCH_PROBLEMS_H
#define BENCH_PROBLEMS_H

#ifdef __cplusplus
extern "C" {
#endif

enum { POSITIONS_MAX = 18 };
typedef struct problem {
    const char *name; /* of bench/problems.def */
    int positions;
    double until;        /* from t = 0 */
    const double *start; /* the positions, then the velocities */
    const double *truth; /* at the end */
    void (*force)(const double *x, const double *v, double t, double *a);
} problem;

enum {
#define PROBLEM(name, ...) PROBLEM_##name,
#include "bench/problems.def"
    PROBLEMS
};
extern const problem problems[PROBLEMS];

/* The largest difference from the truth of all positions. */
double problem_error(const problem *, const double *state);

#ifdef __cplusplus
}
#endif

#endif
