/* A program as C text: the bodies that a compiled machine puts between the texts of step/.
 *
 * No byte of the model's text reaches the C text: names are made here (r12, j0), and numbers are hexadecimal. What
 * depends on a size or a bound is read from `q` at run time, so one text serves every N, and every parameter but those
 * that make an operation exact (emit_exact.c).
 */
#ifndef LANG_EMIT_EMIT_H
#define LANG_EMIT_EMIT_H

#include "lang/graph/graph.h"

typedef struct emit_text { /* it grows in an arena, which is `failed` once there is no memory */
    arena *arena;
    char *bytes;
    size_t length, room;
} emit_text;
void emit_add(emit_text *, const char *format, ...) __attribute__((format(printf, 2, 3)));

typedef enum emit_int_kind { EMIT_OFFSET, EMIT_STRIDE, EMIT_SLOT } emit_int_kind;
typedef struct emit_int { /* the meaning of q[k] */
    emit_int_kind kind;
    reference ref;  /* OFFSET: the element where all loop variables are 0, without modular dimensions */
    uint16_t array; /* STRIDE */
    int dim;
    int slot; /* SLOT: an int of the model */
} emit_int;

typedef struct emit_assumed {
    uint32_t place;
    double value;
} emit_assumed;

#define OPERATION_BIT(id) ((uint64_t)1 << OP_##id)
_Static_assert(OPERATIONS <= 64, "a set of operations is a word");

typedef struct emit {
    emit_text text;
    emit_int *ints;
    uint32_t int_count, int_room;
    bool literal; /* sizes are fixed (no families), so places are written as numbers */
    const array *arrays;
    bool lanes;            /* `real` is one number for each of several trajectories */
    bool own_time;         /* time differs between lanes, too */
    const uint8_t *varied; /* by place of the pool: lanes have their own number, in `own`; NULL: no place */
    /* how many numbers are computed once, when parameters are bound: u[0 … fixed) and, for every lane, w[0 …
     * fixed_lanes) */
    uint32_t fixed, fixed_lanes;
    /* OPERATION_BIT of every operation that the programs so far call, over doubles and over reals */
    uint64_t used, used_lanes;
    bool wraps; /* the programs so far call `wrapped` */
    /* loops may take several values of their index at once, by machine/text/index_lanes.h */
    bool vectors;
    bool uses_vectors; /* some loop takes several values of its index at once */
    bool two;          /* divisions and roots of the next program are taken two at a time */
    bool uses_two;     /* some are, by machine/text/two.h */
    bool longer;       /* there is a text that takes a compiler longer, and is faster: this one or another */
    /* how many numbers the Taylor series of the next program have; 0: it is not in series */
    int series;
    uint64_t used_series;
    bool series_may_be_wide; /* lanes of series may run along an index of families */
    bool series_wide;        /* lanes of series run along an index of families */
    bool separate;           /* the next program is compiled once, and called */
    bool along;              /* the next program reads a direction or widths, two more arguments: dx, dv */
    /* the next program takes a window of outer indices, and PUT(k, value) stands for a[k] = value */
    bool windowed;
    /* The model's numbers; those that make an operation exact stand in the text, which then serves models with equal
     * u[place]. NULL: none stands there. */
    const double *pool;
    emit_assumed *assumed;
    uint32_t assumed_count, assumed_room;
    /* sums that take each pair once: how many at most are side by side, and their cells. `own` is room for 8 numbers a
     * sum and cell; NULL: they take every pair twice */
    uint32_t pair_sums;
    range pair_range;
    uint32_t terms; /* how many values depend on time alone: T[0 … terms) */
    int moments;    /* how many times a step evaluates them at */
} emit;

/* Appends
 *     NAME_bind(pool, q, u)                             u: what depends on parameters alone
 *     NAME_bind_lanes(pool, q, u, own, w)               w: what depends on parameters alone and differs between lanes;
 *                                                       only where there are lanes
 *     NAME_terms(pool, q, u, reals t, T)                what depends on time alone, at several times; only with
 *                                                       `terms`, and where e->terms > 0
 *     NAME(pool, q, u, w, own, n, t, x, v, p, a)        in series: coefficient n of the outputs, as series_pass of
 *                                                       lang/tape/ describes it; p: the memory, returned past its end
 *     NAME(pool, q, u, w, own, t, T, x, v, a, out)      outputs, from states; windowed: and `from`, `to`, `move` of
 *                                                       machine/text/window.h; along: and dx, dv
 * The text around it defines real, reals, MANY(a double) → reals and AT(array, element); with `vectors` also WIDTH, how
 * many doubles reals has. False: the arena failed. */
bool emit_program(emit *, const program *, const char *name, bool terms);
enum { EMIT_NUMBER = 40 };
/* Writes a double as C text that reads back to the same bits; returns out. */
const char *emit_number(double, char out[EMIT_NUMBER]);
/* Writes the recurrences that programs in series use as functions series_7(r, a, b, n) over reals, whose operations are
 * functions of that prefix. They read `length`, a constant. */
bool emit_series_operations(emit *, const char *prefix);
/* Writes a set of operations as functions PREFIX_7(a, b) … over a type. */
bool emit_operations(emit *, uint64_t set, const char *type, const char *prefix);
/* Returns the value of q[k] for a model's arrays and ints. */
int64_t emit_int_value(const emit_int *, const array *arrays, const int64_t *ints);

#endif
