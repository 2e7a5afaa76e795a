/* The operations, one for each row of operations.def: number, spelling, arity, degree, nature and value. */
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

/* What is true of an operation, where it says so; a bend is a jump of the slope. */
typedef enum operation_nature {
    IS_WORD = 1 << 0,                 /* its spelling is a word of the language, before a bracket */
    OF_MANY = 1 << 1,                 /* and takes two arguments or more */
    BENDS = 1 << 2,                   /* its value or its slope jumps */
    JUMPS = 1 << 3,                   /* its value jumps */
    DECIDES = 1 << 4 | BENDS | JUMPS, /* it is 0 or 1 */
    HAS_POLE = 1 << 5,                /* it has infinite values */
    STEEP_AT_0 = 1 << 6,              /* its slope is infinite where its operand is 0, */
    STEEP_AT_ENDS = 1 << 7,           /*   or at the ends of its domain */
    HAS_DOMAIN = 1 << 8,              /* it has no value of some numbers, whatever they are the result of */
    WAVES = 1 << 9,                   /* it goes up and down while its operand moves by a few units; */
    HIDES = 1 << 10,                  /*   or changes within a part of its operand's way, which steps may pass */
    RISES = 1 << 11,                  /* it is monotonic in its only operand, upward, */
    SINKS = 1 << 12,                  /*   or downward, */
    IS_EVEN = 1 << 13                 /*   or in the operand's size, upward */
} operation_nature;

typedef struct operation_row {
    const char *spelling;
    uint16_t nature;
    uint8_t arity, degree, keeps;
    const char *sums; /* operations.def */
} operation_row;

const operation_row *operation_at(operation);
bool operation_is(operation, operation_nature);
/* The value of one operation: the bits that every machine computes. */
double operation_value(operation, double a, double b, double c);

#endif
