/* Whether a step resolves the force: no operation changes from one regime to another and back within the step.
 *
 * Between two times at which a force is evaluated, exp(-z²) may pass its peak unseen. Interval arithmetic over all
 * times and states of a step bounds the argument of every such operation; where the bounds are wider than the scale on
 * which the operation changes, the step is not resolved. The bounds are those of a straight way with a margin for its
 * curvature, and are not rounded outward: this is a precaution, not a proof.
 */
#ifndef LANG_MODEL_RESOLUTION_H
#define LANG_MODEL_RESOLUTION_H

#include "lang/base/interval.h"
#include "lang/model/model.h"

typedef struct resolution resolution;

/* Makes a resolution of outputs that read x and v alone. Outputs into X and V come first: they are boundary cells,
 * whose intervals they widen. switched: the model has switches. *out NULL: no operation can hide anything. It lives in
 * the model's arena. False: no memory. */
bool resolution_create(model *, const output *, size_t count, bool switched, resolution **out);
/* Returns whether no operation hides anything at any t, x and v in the intervals, with the numbers of the pool. */
bool resolution_fits(resolution *, interval t, interval *x, interval *v, const double *pool);

/* Makes a resolution that computes values of outputs into OUT; these may read A, too. */
bool resolution_create_values(model *, const output *, size_t count, resolution **out);
/* Returns whether an output is no polynomial of low degree in time and state. */
bool resolution_bends(const resolution *, size_t output);
void resolution_values(resolution *, interval t, interval *x, interval *v, interval *a, const double *pool,
                       interval *out);

/* Returns whether an operation that is no polynomial changes without kinks, and so slowly while its arguments go
 * through the intervals that points which resolve them resolve its value. */
bool resolution_regular(operation, interval a, interval b);

/* Makes a resolution for poles: a divisor of 0, or the base of a negative power; log at 0, tan at odd multiples of π/2.
 * resolution_pole returns whether one may be in the intervals. */
bool resolution_create_poles(model *, const output *, size_t count, resolution **out);
bool resolution_pole(resolution *, interval t, interval *x, interval *v, const double *pool);

/* The worst that intervals may not decide about a value. A resolution for doubts serves resolution_values, too. */
typedef enum doubt {
    DOUBT_NONE,
    DOUBT_STEEP, /* an operation is near a pole or an infinite slope, so its value may change by much */
    DOUBT_JUMP,  /* a comparison, if, floor, mod or sign whose side is not decided, the cut of atan2, or 0/0 */
    DOUBT_POLE   /* it may be infinite */
} doubt;
bool resolution_create_doubts(model *, const output *, size_t count, resolution **out);
doubt resolution_doubt(resolution *, interval t, interval *x, interval *v, const double *pool);

#endif
