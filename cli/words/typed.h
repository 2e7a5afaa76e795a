/* Numbers on the command line. */
#ifndef CLI_WORDS_TYPED_H
#define CLI_WORDS_TYPED_H

#include "motus.h"

#include <stdbool.h>
#include <stdint.h>

/* A decimal number with or without a sign, and nothing else; it may be infinite. */
bool typed_decimal(const char *, double *);
/* An integer from 1 to INT64_MAX; *rest: what follows it. 1e6 is one. */
#define TYPED_COUNT_MAX 9e18
bool typed_count(const char *, int64_t *, const char **rest);
/* 0 … 2^64 - 1. */
bool typed_seed(const char *, uint64_t *);
/* A constant expression of the language, "2 pi/3". The error's message begins with `where`; its hint says what is wrong
 * with the expression. */
motus_status typed_constant(const char *expression, const char *where, double *, motus_error *);

#endif
