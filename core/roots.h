/* All roots of a smooth function g on one step, tau in [0, 1]: found and counted by inequalities, not by samples.
 *
 * The caller evaluates g at Chebyshev points (roots_point). roots_fit turns the values into the coefficients c of
 * p(tau) = sum c_k T_k(2 tau - 1), and says whether they fall off to rounding; if not, the caller may double the
 * degree, where every other point is an old one. roots_none is a cheap test that most steps pass. roots_find finds the
 * roots.
 *
 * What is proved. Let |p - g| <= `noise` on the step. roots_find adds a bound of its own rounding and calls the sum N
 * (roots_found.noise). It divides the step into pieces on which p is monotone, by bounds on p, p' and p'' over cells
 * that are halved until a bound decides. So it knows the places where |p| > N, where the sign of g is certain, and the
 * intervals between them, where it is not. Each such interval is one place:
 *   - g is certain on both sides, with opposite signs: a crossing. g has an odd number of sign changes there.
 *   - g is certain on both sides, with one sign: a touch. g may have no root there, a double one, or two.
 * There is no other root, and two roots are two places if |p| exceeds 9/8 N between them. Multiple roots need no rule
 * of their own: t^3 is a crossing, t^4 a touch. An interval [from, to] holds all the roots that its place stands for.
 * That p is g up to `noise` is not a theorem, since finitely many values bound no function: it rests on the falling off
 * of the coefficients, as all interpolation of smooth functions does. A function that is not resolved (ROOTS_FIT_ROUGH)
 * is as far from p as `unseen` says, if its coefficients go on as a slow geometric series. So before the degree is
 * doubled, ask roots_none and roots_find with noise + unseen: if they find no place, or only places that are `single`,
 * more points would find the same places. A function that is still rough at ROOTS_DEGREE_MOST has a kink, a jump or a
 * pole near the step: divide the step, or else the result holds for the polynomial through the points alone.
 *
 * Consecutive steps. `before` says what the caller knows about tau = 0:
 *   - 1 or -1: the sign that g had last. A place whose interval begins at 0 is then reported.
 *   - 0: the caller stands on a root, since it has just handled an event there, or since the start lies on one. That
 *     root is divided out: p - p(0) (1 - tau) has the noise N min(2, (2 n^2 + 1) tau) by Markov's inequality, |p(0)|
 *     counted to N, so the next root is seen however near, if the slope at 0 is certain (two roots are then told apart
 *     where |p| exceeds twice that noise). `after` is the sign that g has next.
 * `last` is the `before` of a next step that starts where this one ends. An interval that reaches tau = 1 is an `open`
 * place, whose kind is a guess by the slope at 1: hold the event back until the next step. That step reports the place
 * first, with an interval that begins at 0, and its kind; if it does not, the place was a touch. (After an action at an
 * open place pass before = 0.) So every root is reported once, on whichever side of the ends rounding puts it.
 *
 * Bounds: 32 kB of stack, no allocation, at most ROOTS_CELLS_MOST cells; equal bits on every machine.
 */
#ifndef CORE_ROOTS_H
#define CORE_ROOTS_H

#include <stdbool.h>
#include <stddef.h>

enum {
    ROOTS_DEGREE_LEAST = 8,
    ROOTS_DEGREE_MOST = 256, /* degrees of roots_fit are 8, 16, 32 … 256 */
    ROOTS_CELLS_MOST = 8192
};

/* Returns point k of 0 to degree, ascending from 0 to 1: sin^2(pi k / (2 degree)), with a relative error of at most
 * 1.5 2^-52. Point 2 k of degree 2 n is point k of degree n. */
double roots_point(int k, int degree);

typedef enum roots_fit_status {
    ROOTS_FIT_SMOOTH,    /* the last coefficients are below the noise, rounding or 2^-50 of the largest value */
    ROOTS_FIT_ROUGH,     /* the last coefficients are larger: double the degree */
    ROOTS_FIT_NOT_FINITE /* a value is not finite or above 2^1000, or the degree is not one of 8, 16 … 256 */
} roots_fit_status;

typedef struct roots_fitted {
    int degree;    /* the coefficients beyond it are 0 */
    double noise;  /* bound on |p - g| by rounding, the noise of the values and the last coefficients */
    double unseen; /* of a rough function: bound on the sum of the further coefficients, or infinite; else 0 */
} roots_fitted;

/* Fits the polynomial through the values of g at the points: value k is values[k * stride], wrong by at most `noise`.
 * Writes degree + 1 coefficients. */
roots_fit_status roots_fit(const double *values, size_t stride, int degree, double noise, double *coefficients,
                           roots_fitted *fitted);

/* Returns true only where |p| exceeds `slack` everywhere, so there is no root and no near one. False says nothing. */
bool roots_none(const double *coefficients, int degree, double slack);

typedef enum roots_kind {
    ROOTS_FALLING = -1,
    ROOTS_TOUCH = 0,
    ROOTS_RISING = 1,
    ROOTS_NEAR = 2 /* an extremum, N < |p| <= slack: no root of p, and p turns back there */
} roots_kind;

/* A place, or for ROOTS_NEAR an extremum between two places: there the caller decides by the sign of the true g. Where
 * this is not the sign of `value`, g has two roots beside the extremum and p none, or p has two and g none. */
typedef struct roots_root {
    double tau;      /* where p is 0, or |p| is extreme (touches and ROOTS_NEAR); else the middle of the interval */
    double from, to; /* the interval, |p| <= N; of ROOTS_NEAR: tau */
    double error;    /* how far the roots may be from tau: the larger of tau - from and to - tau */
    double value;    /* of p at tau */
    roots_kind kind;
    int side;    /* sign of g before it */
    bool single; /* a crossing with exactly one root: the slope of g is certain there, not only its signs */
    bool open;   /* the interval reaches tau = 1: the next step decides */
} roots_root;

typedef enum roots_status {
    ROOTS_COMPLETE,
    ROOTS_CUT,       /* roots up to `reach` are reported; then `out` was full, or the cells were used up */
    ROOTS_NOT_FINITE /* a coefficient is not finite, or noise or slack is NaN: no root is reported */
} roots_status;

typedef struct roots_found {
    size_t count;
    int after;     /* where before = 0: the sign with which g leaves 0; 0: it stays within the noise */
    double leaves; /* from where on the sign `after` is certain: about 0 if g leaves 0 at once; 1 if it never does */
    int last;      /* last certain sign, `before` of the next step; 0: there was none */
    double noise;  /* N */
    double reach;  /* 1, unless cut */
} roots_found;

/* Finds the roots, in order, and extrema with |p| <= slack as ROOTS_NEAR; a slack up to the noise finds no extrema. */
roots_status roots_find(const double *coefficients, int degree, int before, double noise, double slack, roots_root *out,
                        size_t most, roots_found *found);

#endif
