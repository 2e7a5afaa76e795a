/* A program as C text: the bodies that a compiled machine puts between the texts of step/.
 *
 * No byte of the model reaches the text: names are made here (r12, j0), numbers are hexadecimal, and everything that a size or a bound decides
 * is read at run time from `q`, so one text serves every N and every parameter.
 */
#ifndef LANG_EMIT_H
#define LANG_EMIT_H

#include "lang/graph.h"

typedef struct emit_text {              /* grows in an arena; `failed` once there is no memory */
    arena *arena;
    char *bytes;
    size_t length, room;
} emit_text;
void emit_add(emit_text *, const char *format, ...) __attribute__((format(printf, 2, 3)));

typedef enum emit_int_kind { EMIT_OFFSET, EMIT_STRIDE, EMIT_SLOT } emit_int_kind;
typedef struct emit_int {            /* what q[k] is */
    emit_int_kind kind;
    reference ref;                   /* OFFSET: element where all loop variables are 0; modular dimensions left out */
    uint16_t array;                  /* STRIDE */
    int dim;
    int slot;                        /* SLOT: an int of the model */
} emit_int;

#define OPERATION_BIT(id) ((uint64_t)1 << OP_##id)
_Static_assert(OPERATIONS <= 64, "a set of operations is a word");

typedef struct emit {
    emit_text text;
    emit_int *ints; uint32_t int_count, int_room;
    bool literal;                    /* sizes are structure (no families): places are written as numbers */
    const array *arrays;
    uint32_t fixed;                  /* numbers computed once, when parameters are bound: u[0 … fixed) */
    uint64_t used;                   /* OPERATION_BIT of every operation that the programs so far call */
    bool wraps;                      /* they call `wrapped` */
} emit;

/* Appends
 *     static void NAME_bind(const double *pool, const int64_t *q, double *u)
 *     static inline void NAME(const double *pool, const int64_t *q, const double *u, double t, SPACES…)
 * False: the arena failed. */
bool emit_program(emit *, const program *, const char *name);
/* The operations in `used` as functions op_7(a, b) …, for real = double, and `wrapped` where it is called. */
bool emit_operations(emit *);
/* The value of q[k] for a model's arrays and ints. */
int64_t emit_int_value(const emit_int *, const array *arrays, const int64_t *ints);

#endif
