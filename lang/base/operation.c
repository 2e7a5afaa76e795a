/* The rows of the operations and their values.
 *
 * Invariant: operation_value and every kernel evaluate the same C expression, so folded constants have the bits of a
 * run.
 */
#include "lang/base/operation.h"

#include <math.h>
#include "lang/base/functions.h"

static const operation_row rows[OPERATIONS] = {
#define OP(id, arity, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    [OP_##id] = {spelling, nature, arity, DEGREE_##degree, keeps, sums},
#include "lang/base/operations.def"
#undef OP
};

const operation_row *operation_at(operation op) { return &rows[op < OPERATIONS ? op : OP_CONST]; }

bool operation_is(operation op, operation_nature of) { return (operation_at(op)->nature & of) == of; }

double operation_table(const double *numbers) { return motus_table_of(numbers); }

double operation_value(operation op, double a, double b, double c)
{
    switch (op) {
#define OP(id, arity, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    case OP_##id:                                                                           \
        return value;
#include "lang/base/operations.def"
#undef OP
    case OPERATIONS: break;
    }
    return NAN;
}
