/* Whether a step resolves the force: no operation of it changes from one regime to another, and back, within the step.
 *
 * Between two times at which a force is evaluated, exp(-z²) may have passed its peak unseen. Interval arithmetic over
 * all times and states of a step bounds the argument of every such operation; where the bounds are wider than the scale
 * on which the operation changes, the step is not resolved. The bounds hold for a straight way with a margin for its
 * curvature; they are not rounded outward, so this is a precaution and no proof.
 */
#ifndef LANG_MODEL_RESOLUTION_H
#define LANG_MODEL_RESOLUTION_H

#include "lang/base/interval.h"
#include "lang/model/model.h"

typedef struct resolution resolution;

/* For these outputs, which may read x and v alone, and of which those into X and V, if any, come first: they are cells
 * whose interval becomes wider where the output says so. switched: the model has switches. *out is NULL where no
 * operation can hide anything. Lives in the model's arena. False: no memory. */
bool resolution_create(model *, const output *, size_t count, bool switched, resolution **out);
/* Over all t, x and v in the intervals, with the numbers of the pool. */
bool resolution_fits(resolution *, interval t, interval *x, interval *v, const double *pool);

/* The values of outputs into OUT, of which place k is out[k]; these may read A, too, whose intervals are a. */
bool resolution_create_values(model *, const output *, size_t count, resolution **out);
/* Whether an output is something else than a polynomial of low degree of the time and the state. */
bool resolution_bends(const resolution *, size_t output);
void resolution_values(resolution *, interval t, interval *x, interval *v, interval *a, const double *pool,
                       interval *out);

/* Whether an operation that is no polynomial changes so slowly, without kinks, while its arguments go through the
 * intervals, that points which resolve these resolve its value. */
bool resolution_regular(operation, interval a, interval b);

/* The same for poles: a divisor of 0, or the base of a negative power; log at 0, tan at odd multiples of π/2. Whether
 * there may be one in the intervals. */
bool resolution_create_poles(model *, const output *, size_t count, resolution **out);
bool resolution_pole(resolution *, interval t, interval *x, interval *v, const double *pool);

/* The same for what intervals may leave open of a value, the worst that there is. resolution_values may be asked of it,
 * too. */
typedef enum doubt {
    DOUBT_NONE,
    DOUBT_STEEP, /* an operation is near a pole, or an infinite slope, so that its value may change by much */
    DOUBT_JUMP,  /* a comparison, if, floor, mod or sign whose side is not decided, the cut of atan2, or 0/0 */
    DOUBT_POLE   /* it may be infinite */
} doubt;
bool resolution_create_doubts(model *, const output *, size_t count, resolution **out);
doubt resolution_doubt(resolution *, interval t, interval *x, interval *v, const double *pool);

#endif
