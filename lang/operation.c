/* What an operation is: its row, and its value.
 *
 * Invariant: operation_value is the same C expression as every kernel's, so a folded constant has the bits that running would give.
 */
#include "lang/operation.h"
#include "lang/tape.h"

#include <math.h>
#include "lang/functions.h"

static const operation_row rows[OPERATIONS] = {
#define OP(id, arity, spelling, degree, smooth, value, derivative) [OP_##id] = { spelling, arity, DEGREE_##degree, smooth },
#include "lang/operations.def"
#undef OP
};

const operation_row *operation_at(operation op)
{
    return &rows[op < OPERATIONS ? op : OP_CONST];
}

double operation_value(operation op, double a, double b, double c)
{
    switch (op) {
#define OP(id, arity, spelling, degree, smooth, value, derivative) case OP_##id: return value;
#include "lang/operations.def"
#undef OP
    case OPERATIONS: break;
    }
    return NAN;
}
