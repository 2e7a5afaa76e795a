/* The operations of lang/base/operations.def over numbers of 113 bits: their values, and the recurrences of their
 * Taylor series, compiled from step/series.h.
 */
#ifndef TEST_SERIES_QUAD_H
#define TEST_SERIES_QUAD_H

#include "lang/base/operation.h"
#include "test/quad.h"

/* helpers: the series that a recurrence may keep, the result's included */
enum { SERIES_QUAD_HELPERS = 5, SERIES_QUAD_ALL = 1 << 20 };
/* An operand's coefficients, and the number of the last that may differ from 0: SERIES_QUAD_ALL where there is none. */
typedef struct series_quad {
    const quad *at;
    int last;
} series_quad;

bool series_quad_moves(operation); /* it has a recurrence, so it is not constant between kinks */
const char *series_quad_text(operation);
/* To some tens of units in the last of 113 bits. */
quad series_quad_value(operation, quad a, quad b, quad c);
/* Coefficient n of the result; r: those below it, `length` numbers, and its helpers after them. */
quad series_quad_next(operation, quad *r, int length, series_quad a, series_quad b, series_quad c, int n);

#endif
