/* The operations, one for each row of operations.def: number, spelling, arity, degree, smoothness and value. */
#ifndef LANG_BASE_OPERATION_H
#define LANG_BASE_OPERATION_H

#include <stdbool.h>
#include <stdint.h>

/* Leaves CONST TIME PARAM INDEX LOAD; SUM; NEG ADD SUB MUL DIV; FMA = a*b+c, FMS = a*b-c, FNMA = c-a*b and the leaf
 * TOTAL, which only the normal form makes (program.c); LT LE GT GE EQ NE (1.0 or 0.0); AND OR NOT; SELECT(c, a, b);
 * POW; and the functions SIN COS TAN ASIN ACOS ATAN ATAN2 SINH COSH TANH EXP LOG SQRT CBRT HYPOT ABS MIN MAX FLOOR MOD
 * SIGN ERF. */
typedef enum operation {
#define OP(id, ...) OP_##id,
#include "lang/base/operations.def"
#undef OP
    OPERATIONS
} operation;

/* How the degree in some variables follows from the operands' degrees. */
typedef enum degree_rule {
    DEGREE_LEAF,
    DEGREE_SUM,
    DEGREE_LINEAR,   /* the larger */
    DEGREE_PRODUCT,  /* the sum */
    DEGREE_QUOTIENT, /* the dividend's, if the divisor has none */
    DEGREE_FUSED,    /* product, then larger */
    DEGREE_CHOICE,   /* the larger of the branches, if the condition has none */
    DEGREE_CURVED    /* none only if no operand has any */
} degree_rule;

typedef struct operation_row {
    const char *spelling;
    uint8_t arity, degree, smooth, keeps;
    const char *sums; /* operations.def */
} operation_row;

const operation_row *operation_at(operation);
bool operation_decides(operation); /* its value is 0 or 1 */
/* The value of one operation: the bits that every machine computes. */
double operation_value(operation, double a, double b, double c);

#endif
