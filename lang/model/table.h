/* Tables: what ENTRY and FIND of lang/base/operations.def read, made from lists of the pool.
 *
 * A table is an array of the pool. Its first number counts those that follow, row by row. Tables follow from lists as
 * parameters do from parameters: each has a line in the log of the model (vary_record.h).
 *
 * An interpolation over n points has n + 1 rows: row k stands for the interval from point k on, row 0 for what is
 * before the first point, row n for what is beyond the last. Where the end values do not hold, the outer intervals
 * reach TABLE_BEYOND units in the last place farther: 0.06 is 0 + 3 0.02 also where decimals are rounded otherwise.
 */
#ifndef LANG_MODEL_TABLE_H
#define LANG_MODEL_TABLE_H

#include "lang/model/model.h"

typedef enum table_kind {
    TABLE_LIST,   /* a column: row k is entry k of a list, row 0 is not a number */
    TABLE_POINTS, /* four columns, for FIND: see table_position */
    TABLE_LINEAR, /* three columns: point x, value c0, slope c1: c0 + c1 (u - x); x is the first point, or the second,
                   * where only there the value is 0 */
    TABLE_SPLINE  /* five columns: x, c0 … c3: the natural cubic spline, of second derivatives 0 at both ends */
} table_kind;
enum { TABLE_BEYOND = 16 };
int table_columns(table_kind);

/* What a table is made of; equal ones are one table. */
typedef struct table {
    table_kind kind;
    bool hold;             /* before and beyond the points the end values hold; else the values are not numbers */
    bool uniform;          /* the points are t0, t0 + dt, … */
    uint16_t list, points; /* the values, and the points where they are: arrays of the pool with one index */
    uint16_t array;        /* the table itself */
    const char *name;      /* its arguments as text: "T", "T, A"; equal tables need not have equal names */
    const char *values;    /* the text of `list`, for messages */
} table;

/* Finds or makes a table. False: no memory. */
bool table_make(model *, const table *want, uint16_t *array);
/* Computes the numbers of a table from those of its lists. */
void table_fill(const model *, const table *);
/* Returns where row k begins: its point, in the last row and the first a little farther. at: a TABLE_POINTS. */
double table_point(const double *at, size_t k);
/* Returns number `column` of a row. */
node table_entry(graph *, node row, table_kind, int column, node of);
/* Returns the value of an interpolation in a row of its table. */
node table_value(graph *, node u, node row, table_kind, node of);
/* Returns a smooth function of u, as long as the row is held, that is row k at point k and k + 1 at point k + 1. In the
 * last row and in row 0 it comes near to n + 1 and 0 far from the points. `points`: their TABLE_POINTS. */
node table_position(graph *, node u, node row, node points);

#endif
