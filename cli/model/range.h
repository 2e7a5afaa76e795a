/* Linearly or logarithmically spaced values, each rounded once. */
#ifndef CLI_MODEL_RANGE_H
#define CLI_MODEL_RANGE_H

#include <stdbool.h>
#include <stdint.h>

/* A number of 106 bits: the sum of two doubles. */
typedef struct range_pair {
    double high, low;
} range_pair;

typedef struct range {
    double from, to;
    uint64_t last; /* the index of the last value; the first is 0 */
    bool logarithmic;
    range_pair low, high; /* the ends as typed decimals; if logarithmic, the smaller |end| and the ratio */
} range;

range range_linear(double from, double to, uint64_t count);
/* `from` and `to` have one sign, are not 0, and are at most 300 decades apart. */
range range_log(double from, double to, uint64_t count);
double range_value(const range *, uint64_t k);

#endif
