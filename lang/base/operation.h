/* The rows of operations.def as data: what the graph, its printer and its analysis look up. */
#ifndef LANG_BASE_OPERATION_H
#define LANG_BASE_OPERATION_H

#include "lang/graph/graph.h"

typedef enum degree_rule {
    DEGREE_LEAF, DEGREE_SUM,
    DEGREE_LINEAR,      /* the larger */
    DEGREE_PRODUCT,     /* the sum */
    DEGREE_QUOTIENT,    /* the dividend's, if the divisor has none */
    DEGREE_FUSED,       /* product, then larger */
    DEGREE_CHOICE,      /* the larger of the branches, if the condition has none */
    DEGREE_CURVED       /* none only if no operand has any */
} degree_rule;

typedef struct operation_row {
    const char *spelling;
    uint8_t arity, degree, smooth;
} operation_row;

const operation_row *operation_at(operation);

#endif
