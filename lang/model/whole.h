/* Numbers that only count: they are made of whole numbers, parameters, and modes whose assignments are all made so. The
 * motion affects them only by which events happen, and in which order, so if that is right, they have no error. This
 * holds while all numbers on the way are below 2^53, so each of them gets a bound, too, with modes taken to be below
 * 2^26. */
#ifndef LANG_MODEL_WHOLE_H
#define LANG_MODEL_WHOLE_H

#include "lang/model/model.h"

typedef enum whole_kind { WHOLE_NOT, WHOLE_CONSTANT, WHOLE_COUNT } whole_kind; /* COUNT: events change it */

typedef struct whole {
    uint8_t *node, *array; /* 1: it only counts; by node, and by number of the array of modes */
    double *most, *large;  /* bounds on nodes and on arrays */
    int places;            /* how many binary places after the point numbers may have; 0: they are whole */
} whole;

/* Finds what only counts. endless: NULL, or a rule whose events accumulate, so that what they count has no value.
 * False: no memory. whole_end follows in either case. */
bool whole_find(whole *, const model *, int places, const model_rule *endless, const motus_allocator *);
void whole_end(whole *, const motus_allocator *);
/* Classifies a quantity. */
whole_kind whole_of(const whole *, const model *, const model_definition *);

#endif
