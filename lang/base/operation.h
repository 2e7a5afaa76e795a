/* The operations, one for each row of operations.def: number, spelling, arity, degree, nature and value. */
#ifndef LANG_BASE_OPERATION_H
#define LANG_BASE_OPERATION_H

#include <stdbool.h>
#include <stdint.h>

/* FMA is a*b + c, FMS a*b - c and FNMA c - a*b; these and the leaf TOTAL are made by the normal form alone (program.c).
 * Comparisons are 1.0 or 0.0. SELECT is (condition, then, otherwise). */
typedef enum operation {
#define OP(id, ...) OP_##id,
#include "lang/base/operations.def"
#undef OP
    OPERATIONS
} operation;

/* How the degree in some variables follows from the degrees of the operands. */
typedef enum degree_rule {
    DEGREE_LEAF,
    DEGREE_SUM,
    DEGREE_LINEAR,   /* the larger degree */
    DEGREE_PRODUCT,  /* the sum of the degrees */
    DEGREE_QUOTIENT, /* the dividend's degree, if the divisor has none */
    DEGREE_FUSED,    /* as a product, then as a sum */
    DEGREE_CHOICE,   /* the larger degree of the branches, if the condition has none */
    DEGREE_CURVED    /* no degree if no operand has one */
} degree_rule;

/* What a row says of its operation. A bend is a jump of the slope. */
typedef enum operation_nature {
    IS_WORD = 1 << 0,                           /* its spelling is a word of the language, before a bracket */
    OF_MANY = 1 << 1,                           /* it takes two arguments or more */
    BENDS = 1 << 2,                             /* its value or its slope jumps */
    JUMPS = 1 << 3,                             /* its value jumps */
    IS_FLAT = 1 << 15,                          /* its value is constant between its kinks */
    DECIDES = 1 << 4 | BENDS | JUMPS | IS_FLAT, /* it is 0 or 1 */
    HAS_POLE = 1 << 5,                          /* it has infinite values */
    STEEP_AT_0 = 1 << 6,                        /* its slope is infinite where its operand is 0 */
    STEEP_AT_ENDS = 1 << 7,                     /* its slope is infinite at the ends of its domain */
    HAS_DOMAIN = 1 << 8,                        /* it has no value for whole ranges of its operand */
    WAVES = 1 << 9,                             /* it rises and falls while its operand moves by a few units */
    HIDES = 1 << 10,   /* it may change within a small part of its operand's way, which a step may pass over */
    RISES = 1 << 11,   /* it never falls as its only operand rises */
    SINKS = 1 << 12,   /* it never rises as its only operand rises */
    IS_EVEN = 1 << 13, /* it never falls as the size of its only operand rises */
    IN_PAIRS = 1 << 14 /* its series has another function beside it, which shares the evaluation */
} operation_nature;

typedef struct operation_row {
    const char *spelling;
    uint16_t nature;
    uint8_t arity, degree, keeps;
    const char *sums; /* see operations.def */
} operation_row;

const operation_row *operation_at(operation);
bool operation_is(operation, operation_nature);
/* Returns the value of one operation: the bits that every machine computes. */
double operation_value(operation, double a, double b, double c);
/* Returns the value of a TABLE whose numbers begin here. */
double operation_table(const double *numbers);

#endif
