/* The code of the interpreter: tape_code.c writes it, tape_registers.c completes it, tape_run.c executes it.
 *
 * There are two kinds of registers. SCALARS hold one double. BLOCKS hold a value for each lane: for a cell of the
 * innermost family index, or a term of a sum. A block is reached through a pointer, so it may be part of the state
 * itself. The number of lanes belongs to the frame; the code does not depend on it.
 */
#ifndef LANG_TAPE_TAPE_CODE_H
#define LANG_TAPE_TAPE_CODE_H

#include "lang/graph/graph_place.h"
#include "lang/graph/plan.h"
#include "lang/tape/tape.h"
#include "lang/tape/tape_series.h"

enum { PARTS = 8, IN_ORDER_MAX = 16 };
#define BLOCK_BIT (1u << 31) /* marks an operand that is a block register */

/* The codes below OPERATIONS are scalar operations. */
typedef enum tape_op {
    CODE_CONST = OPERATIONS, /* r = constants[a] */
    CODE_TIME,               /* r = t */
    CODE_PARAM,              /* r = pool[a] */
    CODE_TABLE,              /* r = array a of the pool, as a table */
    CODE_INDEX,              /* r = the index of level a */
    CODE_FETCH_FIXED,        /* r = memory at site a, outside the pool, at an address that no index moves */
    CODE_FETCH,              /* r = memory at site a */
    CODE_PUT_FIXED,          /* memory at site b = a, at an address that no index moves */
    CODE_PUT,
    /* block r = kernel(a, b, c); kernel: operation * 8 + mask, mask bit k: operand k is a block */
    CODE_BLOCK,
    CODE_IOTA, /* block r = the index of level a, lane by lane */
    CODE_FILL, /* block r = scalar a in every lane */
    /* pointer r = memory at site a, gathered into block b where it is not contiguous (NONE: it always is) */
    CODE_VIEW,
    CODE_TARGET, /* pointer r = memory at site a, which the next instruction writes */
    CODE_WRITE,  /* memory at site b, lane by lane = a (block or scalar) */
    CODE_LOOP,   /* begins loop a, or skips it */
    CODE_NEXT,   /* ends loop a: repeats it, or continues */
    /* adds the lanes of a (FMA, FNMA: of a b) in turn to total r, where c holds (NONE: everywhere); kernel: ADD, FMA or
     * FNMA */
    CODE_TERMS,
    CODE_END
} tape_op;

typedef struct instruction {
    uint16_t code, kernel;
    uint32_t r, a, b, c;
} instruction;

/* A place in memory: a reference with its numbers bound. The address is offset + sum of index[level] * step over the
 * terms, plus the modular dimensions. Many operations have one, so it is small. */
typedef struct site {
    reference ref;
    int8_t lanes; /* the level that runs along the lanes; -1: the access is scalar */
    uint8_t space, terms, wraps;
    int8_t level[MAX_DIMS];
    int64_t step[MAX_DIMS];
    int64_t offset, lane_step; /* lane_step: elements between lanes while nothing wraps */
    struct wrap {
        int8_t level;
        int64_t add, modulus, step;
    } * wrap; /* MAX_DIMS of them; NULL: no dimension is modular */
} site;

/* The running total of a sum, in interleaved partial sums; part[0] becomes the result. */
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
    uint32_t body, end; /* the instruction after LOOP, and the instruction NEXT */
} loop;

typedef struct code {
    instruction *instructions;
    uint32_t count, bind_count; /* the first bind_count run once, at bind, up to a CODE_END */
    site *sites;
    uint32_t site_count;
    loop *loops;
    uint32_t loop_count;
    total *totals;
    uint32_t total_count;
    double *constants;
    uint32_t scalars, blocks, pointers; /* how many registers there are; `pointers` is without those of blocks */
} code;

typedef void block_kernel(double *r, const double *a, const double *b, const double *c, size_t n);

typedef struct frame {
    const code *code;
    const binding *binding;
    double t;
    double *const *base; /* the spaces of this run; the binding has the pool */
    double *scalars;
    double **pointers; /* those of blocks, then those of views */
    size_t width, lanes;
    int64_t index[MAX_LEVELS], last[MAX_LEVELS], term[MAX_LEVELS];
    /* the sum has at most IN_ORDER_MAX terms; short_terms is of the sum along the lanes */
    bool short_sum[MAX_LEVELS], short_terms;
} frame;

typedef struct tape_machine {
    const char *name; /* "avx2" */
    void (*execute)(frame *, const instruction *from);
    void (*expand)(tape_series *, const series_pass *); /* tape_series_isa.c */
} tape_machine;

/* tape_code.c: writes the code of a program; with_blocks false: with scalars alone. NULL: the arena failed. */
code *tape_code_create(arena *, const program *, bool with_blocks);

/* tape_registers.c: a virtual register lives from instruction `first` to `last`. Every operation has one, so it is
 * small. */
typedef enum register_kind { SCALAR_REGISTER, BLOCK_REGISTER, POINTER_REGISTER, REGISTER_KINDS } register_kind;
typedef struct virtual_register {
    uint8_t kind;
    uint32_t first, last;
    union {
        struct {
            uint32_t region, until; /* for tape_code.c: where it is made, and the loop that it must outlive */
        } made;
        struct {
            uint32_t number, next; /* the number that it gets, and another register that ends with it */
        } given;
    };
    uint32_t memory; /* for tape_code.c: the block after a view */
} virtual_register;
/* Numbers all registers, which are in the order of `first`; counts[kind] is how many numbers a kind needs. False: no
 * memory. */
bool tape_registers_assign(const motus_allocator *, virtual_register *, uint32_t count, uint32_t instructions,
                           uint32_t counts[REGISTER_KINDS]);

/* The choices of a test; width 0 and machine NULL: as tape_create and tape_bind choose. */
typedef struct tape_choice {
    size_t width;
    const char *machine;
    int blocks; /* -1: by size; 0: never; 1: always */
} tape_choice;
tape *tape_create_as(arena *, const program *, const tape_choice *);
/* Returns the k-th best machine that this processor runs; NULL: there is none. */
const tape_machine *tape_machine_at(int k);

#endif
