/* What the laws share: numbers of 33 digits, the test problems, runs of any row over them, and the function that
 * prints and counts the results.
 *
 * Invariant: a law prints what it measured and the bound, which follows from the theory or from the digits of the
 * row's coefficients.
 */
#ifndef TEST_LAWS_H
#define TEST_LAWS_H

#include "core/methods.h"
#include "test/quad.h"

/* A method is its place in the catalogue. The quad_… functions use its row in 33 digits. A file that needs the
 * members of the row includes core/rows.h and uses methods_table[m], where coefficients are double; so `row` has
 * another layout in laws_quad.c and laws_coefficients.c. */
typedef size_t method;

/* SPLITTING_MAX: stages of a splitting row; COUPLED_MAX: those of an implicit one, and GENERATED_MAX its constants */
enum { DIMENSIONS = 4, SPLITTING_MAX = 40, COUPLED_MAX = 8, GENERATED_MAX = 5 * COUPLED_MAX * (COUPLED_MAX + 1) };

/* x'' = a(x, v, t), then s' = f, over quads. Polynomial and rational, since no library function has 33 digits. */
typedef struct quad_problem {
    const char *name;
    size_t nx, nv;
    bool velocity, linear, time, gyroscopic, gradient, quadrature;
    quad x[DIMENSIONS], v[DIMENSIONS];
    void (*accel)(quad t, const quad *x, const quad *v, quad *a);
    void (*jvp)(quad t, const quad *x, const quad *v, const quad *dx, const quad *dv, quad *da);
    /* Coefficient n of the acceleration at time t, to a, from the series of x and v, `length` numbers each; it keeps
     * `keeps` series of that length. NULL: no formula is known. */
    void (*series)(int length, int n, quad t, const quad *x, const quad *v, quad *a, quad *kept);
    int keeps;
} quad_problem;

enum {
    FREE_FALL,
    OSCILLATOR,
    HENON_HEILES,
    DRIVEN,
    RIDER,
    DAMPED,
    TANGLED,
    MAGNET,
    CUBIC,
    PARTICLE,
    FOLLOWER,
    PROBLEMS
};
extern const quad_problem quad_problems[PROBLEMS];
/* Problems with series; laws_series.c. EVERYTHING: each operation that has a recurrence is in its acceleration. POLE:
 * x'' = 6 x², s' = x, whose motion is 1/(2.5 - t)² and 1/(2.5 - t). */
enum { EVERYTHING, POLE, EXPANDED };
extern const quad_problem quad_expanded[EXPANDED];
/* The traits that the program would find in the problem's equations. */
traits quad_traits(const quad_problem *);
bool quad_admits(method, const quad_problem *);

typedef struct quad_state {
    quad x[DIMENSIONS], v[DIMENSIONS];
} quad_state;
typedef struct quad_count {
    int64_t evaluations, iterations;
    int bad;
} quad_count;

/* Takes `steps` steps from *state at t0; sets *state to the synchronised state. */
quad_count quad_run(method, const double *argument, const quad_problem *, quad t0, quad h, int64_t steps,
                    quad_state *state);
/* The same of a row that finds its own order, at line `line` of its scheme (step/extrapolation.h), of order 2 line; off
 * (may be NULL): the last step's distance from one of the estimate's order. Its lines, 0 for other rows; and the
 * evaluations by which the row weighs a line. */
quad_count quad_line(method, int line, const quad_problem *, quad t0, quad h, int64_t steps, quad_state *state,
                     quad_state *off);
int quad_lines(method);
/* The same of Taylor series of this order, whose steps have the size that is given. */
quad_count quad_expand(method, int order, const quad_problem *, quad t0, quad h, int64_t steps, quad_state *state);
int quad_line_work(method, int line);
/* The same where steps adapt, by a tolerance, up to `until` or so many steps; no error is refused in between. control:
 * what the row carries besides the state; all zero at first. */
typedef struct quad_control {
    quad t, next, before, old[DIMENSIONS];
    int64_t refused;
} quad_control;
quad_count quad_adapt(method, const quad_problem *, quad tolerance, quad until, int64_t steps, quad_state *state,
                      quad_control *control);
/* The state at the fraction `part` of the step after `steps` steps from *state at t0, by dense output. An
 * interpolant through the ends of that step takes *end for its end; NULL: that of the method. */
quad_count quad_dense(method, const quad_problem *, quad t0, quad h, int64_t steps, quad part, const quad_state *end,
                      quad_state *state);
/* The acceleration of a planet around a mass of 1 at the origin, in the plane, in doubles. */
int laws_kepler(void *ctx, double t, double *x, double *v, double *a);
/* One step of Verlet's recursion from two given points. */
void quad_recursion(const quad_problem *, quad t, quad h, const quad *before, const quad *now, quad *after);
/* The motion by an extrapolated midpoint rule, which shares no code with step/. */
void quad_reference(const quad_problem *, quad t0, quad t1, quad_state *state);
void quad_reference_in(const quad_problem *, int pieces, quad t0, quad t1, quad_state *state);
/* The same from its start at 0 to t, found once for each problem and t in turn. */
quad_state quad_motion(const quad_problem *, quad t);
quad quad_distance(const quad_problem *, const quad_state *, const quad_state *);
/* Kicks and drifts in order, kick first; returns their number of stages, 0 for others. */
int quad_splitting_of(method, quad *kick, quad *drift);
/* The constants and abscissae of a row whose coefficients are generated, each of at most GENERATED_MAX numbers; returns
 * its number of stages, 0 for others. */
int quad_generated_of(method, quad *constants, quad *c);
/* By how much the sums of kicks and of drifts differ from 1, which measures the known digits. 0 for other rows. */
quad quad_looseness(method);

quad quad_abs(quad);
double quad_log2(quad); /* of a positive number */

/* Prints "ok" or "FAIL", the subject, the law and the measured values, and counts. */
void judge(bool ok, const char *subject, const char *law, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

void laws_of_order(void);
void laws_of_series(void);
void laws_of_structure(void);
void laws_of_stability(void);
void laws_of_verlet(void);
void laws_of_dense(void);
void laws_of_density(void);
void laws_of_events(void);

#endif
