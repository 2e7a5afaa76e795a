/* The tasks of every region of a plan, in their order: tape_series.c writes them, tape_series_isa.c runs them. */
#ifndef LANG_TAPE_TAPE_SERIES_CODE_H
#define LANG_TAPE_TAPE_SERIES_CODE_H

#include "lang/graph/expansion.h"
#include "lang/graph/plan.h"
#include "lang/tape/tape_code.h"
#include "lang/tape/tape_series.h"

typedef enum series_what {
    SERIES_OPERATION,
    SERIES_CONST, /* a: the number of the constant */
    SERIES_TIME,
    SERIES_PARAM,  /* a: the pool slot */
    SERIES_TABLE,  /* a: the array */
    SERIES_INDEX,  /* a: the level */
    SERIES_FETCH,  /* a: the reference, to the pool */
    SERIES_STATE,  /* a: the reference, to a position or a velocity */
    SERIES_TWIN,   /* a: the item whose first helper this is */
    SERIES_LOOP,   /* a: the region */
    SERIES_UPDATE, /* updates total r by op ADD, FMA or FNMA of a and b, where c holds (NONE: everywhere) */
    SERIES_TOTAL,  /* a: the total that a loop has made */
    SERIES_PUT     /* a: the item; r: the output */
} series_what;

typedef struct series_task {
    uint8_t what, op;
    bool begins; /* the recurrence computes coefficient 0, too */
    uint32_t r, a, b, c;
    uint32_t at; /* the place in the frame; UPDATE: the level of the loop */
} series_task;

typedef struct series_region {
    uint32_t first, count; /* its tasks */
    uint32_t frame;        /* the numbers that each run takes */
    uint32_t first_total, total_count;
    int level; /* -1: it is no loop */
    bool sum;
    range range;
} series_region;

enum { SERIES_PARTS = 8, SERIES_IN_ORDER = 16 }; /* as program.c defines sums */

struct tape_series {
    int length;
    const tape_machine *machine;
    const program *program;
    series_task *tasks;
    series_region *regions;
    int *last;   /* by item: the last coefficient */
    double **at; /* by item: its series, or its value if `last` is 0; each pass sets it */
    double *constants;
    double (*totals)[SERIES_PARTS];
    uint32_t region_count;
    size_t bound, numbers; /* the numbers in memory: what depends on parameters alone, and all */
    binding binding;
};

#endif
