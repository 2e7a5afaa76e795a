/* The interpreter's code: what tape_code.c writes, tape_registers.c completes and tape_run.c executes.
 *
 * Two kinds of registers. SCALARS hold one double. BLOCKS hold a value for each lane, n of them: n cells of the
 * innermost family index, or n terms of a sum; they are reached through pointers, so that a block may be part of the
 * state itself. The number of lanes belongs to the frame; the code does not depend on it.
 */
#ifndef LANG_TAPE_TAPE_CODE_H
#define LANG_TAPE_TAPE_CODE_H

#include "lang/graph/graph_place.h"
#include "lang/graph/plan.h"
#include "lang/tape/tape.h"
#include "lang/tape/tape_series.h"

enum { PARTS = 8, IN_ORDER_MAX = 16 };
#define BLOCK_BIT (1u << 31) /* in an operand: a block register, not a scalar */

/* Codes below OPERATIONS are the scalar operations themselves. */
typedef enum tape_op {
    CODE_CONST = OPERATIONS, /* r = constants[a] */
    CODE_TIME,               /* r = t */
    CODE_PARAM,              /* r = pool[a] */
    CODE_INDEX,              /* r = index of level a */
    CODE_FETCH_FIXED,        /* r = memory at site a, whose address no index moves, and which is not the pool */
    CODE_FETCH,              /* the same, with indices */
    CODE_PUT_FIXED,          /* memory at site b = a */
    CODE_PUT,
    /* block r = kernel(a, b, c); kernel: operation * 8 + mask, mask bit k: operand k is a block */
    CODE_BLOCK,
    CODE_IOTA, /* block r = index of level a, lane by lane */
    CODE_FILL, /* block r = scalar a in every lane */
    /* pointer r = memory at site a; gathered into block b where it is not contiguous (NONE: it always is) */
    CODE_VIEW,
    CODE_TARGET, /* pointer r = memory at site a, to be written by the next instruction */
    CODE_WRITE,  /* memory at site b, lane by lane = a (block or scalar) */
    CODE_LOOP,   /* begin loop a, or skip it */
    CODE_NEXT,   /* end of loop a: repeat it, or continue */
    /* the lanes of a (FMA, FNMA: a b) go to total r in turn, where c (NONE: everywhere); kernel: ADD FMA FNMA */
    CODE_TERMS,
    CODE_END
} tape_op;

typedef struct instruction {
    uint16_t code, kernel;
    uint32_t r, a, b, c;
} instruction;

/* A place in memory: a reference with its numbers bound. The address is offset + sum of index[level] * step over the
 * terms, plus the modular dimensions. There may be one for every operation, so it is kept small. */
typedef struct site {
    reference ref;
    int8_t lanes; /* the level that runs along the lanes, -1: a scalar access */
    uint8_t space, terms, wraps;
    int8_t level[MAX_DIMS];
    int64_t step[MAX_DIMS];
    int64_t offset, lane_step; /* lane_step: elements from lane to lane while nothing wraps */
    struct wrap {
        int8_t level;
        int64_t add, modulus, step;
    } * wrap; /* MAX_DIMS of them; NULL: no dimension is modular */
} site;

/* The running total of a sum: eight interleaved partials. part[0] becomes the result. */
typedef struct total {
    bool block;
    uint32_t current, part[PARTS];
} total;

typedef enum loop_kind { LOOP_SERIAL, LOOP_CELLS, LOOP_TERMS } loop_kind;
typedef struct loop {
    loop_kind kind;
    uint8_t level;
    range range;
    uint32_t first_total, total_count;
    uint32_t body, end; /* instruction after LOOP; instruction NEXT */
} loop;

typedef struct code {
    instruction *instructions;
    uint32_t count, bind_count; /* the first bind_count run once, at bind, and end in CODE_END */
    site *sites;
    uint32_t site_count;
    loop *loops;
    uint32_t loop_count;
    total *totals;
    uint32_t total_count;
    double *constants;
    uint32_t scalars, blocks, pointers; /* registers; pointers: blocks, then those without memory of their own */
} code;

typedef void block_kernel(double *r, const double *a, const double *b, const double *c, size_t n);

typedef struct frame {
    const code *code;
    const binding *binding;
    double t;
    double *const *base; /* of the spaces, for this run; the pool comes from the binding */
    double *scalars;
    double **pointers; /* of blocks, then views */
    size_t width, lanes;
    int64_t index[MAX_LEVELS], last[MAX_LEVELS], term[MAX_LEVELS];
    /* up to IN_ORDER_MAX terms; short_terms: of the sum that runs along the lanes */
    bool short_sum[MAX_LEVELS], short_terms;
} frame;

typedef struct tape_machine {
    const char *name; /* "avx2" */
    void (*execute)(frame *, const instruction *from);
    void (*expand)(tape_series *, const series_pass *); /* tape_series_isa.c */
} tape_machine;

/* tape_code.c: the code of a program; with_blocks false: scalars alone. NULL: the arena failed. */
code *tape_code_create(arena *, const program *, bool with_blocks);

/* tape_registers.c: a virtual register lives from instruction `first` to `last`. There is one for every operation, so
 * it is kept small. */
typedef enum register_kind { SCALAR_REGISTER, BLOCK_REGISTER, POINTER_REGISTER, REGISTER_KINDS } register_kind;
typedef struct virtual_register {
    uint8_t kind;
    uint32_t first, last;
    union {
        struct {
            uint32_t region, until; /* tape_code.c: where it is made; the loop it must outlive */
        } made;
        struct {
            uint32_t number, next; /* what it is given; another one that ends where it does */
        } given;
    };
    uint32_t memory; /* tape_code.c: the block behind a view */
} virtual_register;
/* Numbers all registers, given in the order of `first`; counts[kind] is how many there must be. False: no memory. */
bool tape_registers_assign(const motus_allocator *, virtual_register *, uint32_t count, uint32_t instructions,
                           uint32_t counts[REGISTER_KINDS]);

/* For tests, which choose themselves. width 0 and machine NULL: as tape_create and tape_bind choose. */
typedef struct tape_choice {
    size_t width;
    const char *machine;
    int blocks; /* -1 by size, 0 never, 1 always */
} tape_choice;
tape *tape_create_as(arena *, const program *, const tape_choice *);
/* Machine k that this processor can run, best first; NULL past the last. */
const tape_machine *tape_machine_at(int k);

#endif
