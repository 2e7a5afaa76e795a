/* Numbers as people type them on a command line. */
#ifndef CLI_TYPED_H
#define CLI_TYPED_H

#include <stdbool.h>
#include <stdint.h>

/* A decimal number with or without a sign, alone; it may be infinite. */
bool typed_decimal(const char *, double *);
/* [number] [*] [pi] [/ number]: a step or an end. */
bool typed_number(const char *, double *);
/* A whole number from 1 to what an int64_t holds, and what follows it. 1e6 is one. */
bool typed_count(const char *, int64_t *, const char **rest);
/* 0 … 2^64 - 1. */
bool typed_seed(const char *, uint64_t *);

#endif
