/* Numbers that only count: made of whole numbers, parameters and modes whose every assignment is made of such. The
 * motion has no other way into them than which events happen, and in which order; where that is right, and they are
 * whole, no error is left in them. That holds while all numbers on the way are below 2^53, so a bound on each of them
 * is asked for too, where modes are below 2^26. */
#ifndef LANG_MODEL_WHOLE_H
#define LANG_MODEL_WHOLE_H

#include "lang/model/model.h"

typedef enum whole_kind { WHOLE_NOT, WHOLE_CONSTANT, WHOLE_COUNT } whole_kind; /* COUNT: events change it */

typedef struct whole {
    uint8_t *node, *array; /* 1: it only counts; of modes, by the number of their array */
    double *most, *large;  /* bounds on the size of nodes and of arrays */
    int places;            /* binary places after the point that numbers may have; 0: they are whole */
} whole;

/* endless: NULL, or a rule whose events have no number, as they accumulate: what goes on counting by it then does not
 * count. False: no memory. End it in either case. */
bool whole_find(whole *, const model *, int places, const model_rule *endless, const motus_allocator *);
void whole_end(whole *, const motus_allocator *);
/* Of a quantity. */
whole_kind whole_of(const whole *, const model *, const model_definition *);

#endif
