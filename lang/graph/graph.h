/* The expression graph: scalar nodes, shared, constants folded, with derivatives. It defines the bits of every result.
 *
 * A node is an index; node 0 is the constant 0. A vector is several nodes. Loops (families, sums) are not unrolled:
 * inside them a node refers to loop variables by LEVEL (0 is the outermost index of the family, and a sum opens the
 * next level). N, bounds and parameters are numbers at run time, in int slots and the pool, so the graph of a family
 * does not depend on N.
 */
#ifndef LANG_GRAPH_GRAPH_H
#define LANG_GRAPH_GRAPH_H

#include "lang/base/arena.h"
#include "lang/base/limits.h"
#include "lang/base/operation.h"
#include "lang/base/twofold.h"

typedef uint32_t node;

/* A subscript is (level >= 0 ? index[level] : 0) + literal + (slot >= 0 ? ints[slot] : 0), or, with this as base and
 * modulus >= 0, 1 + (base mod ints[modulus]), where mod is never negative. */
typedef struct subscript {
    int8_t level;
    int16_t slot, modulus;
    int32_t literal;
} subscript;
typedef struct range {
    subscript first, last;
} range; /* empty if last < first; bounds may use outer levels */

/* Where numbers live. X, V: the state; A: the acceleration there; DX, DV: a direction; POOL: parameters and initial
 * values. */
typedef enum space { SPACE_X, SPACE_V, SPACE_A, SPACE_DX, SPACE_DV, SPACE_POOL, SPACE_OUT, SPACES } space;

/* One component of a state, list or quantity, as an array over its indices. A machine binds the address of element base
 * + sum over d of (index[d] - first[d]) * stride[d]; the last dimension has stride 1. */
typedef struct extent {
    int64_t first[MAX_DIMS], last[MAX_DIMS], stride[MAX_DIMS];
} extent;
typedef struct array { /* a variable has eight of them, so it is small */
    uint8_t space;     /* enum space */
    uint8_t dims;
    bool mode; /* X: the numbers are modes */
    size_t base;
    const extent *over; /* NULL: it has no dimensions */
} array;

/* Lays an array out from `base` on over [first, last], the last index contiguous. Returns the number of its places. */
size_t graph_shape(arena *, array *, space, size_t base, int dims, const int64_t first[], const int64_t last[]);
/* Returns whether any place of an array is marked. */
bool graph_marked(const array *, const uint8_t *marks);

typedef struct reference {
    uint16_t array;
    uint8_t dims;
    subscript at[MAX_DIMS];
} reference;

/* What a node depends on, directly or by its operands. Bits 0 … MAX_LEVELS-1: loop variables bound outside the node. */
enum {
    DEP_TIME = 1 << 8,
    DEP_X = 1 << 9,
    DEP_V = 1 << 10,
    DEP_A = 1 << 11,
    DEP_D = 1 << 12 /* DX, DV */,
    DEP_PARAM = 1 << 13,
    DEP_MODE = 1 << 14, /* X, of arrays that are modes */
    DEP_LEVELS = (1 << MAX_LEVELS) - 1,
    DEP_STATE = DEP_X | DEP_V | DEP_A | DEP_MODE
};

typedef struct graph_node {
    uint8_t op;
    uint8_t level; /* INDEX, TOTAL: their level; SUM: the level it opens */
    uint16_t deps;
    /* The operands. LOAD: a is the number of the reference. PARAM: a is the pool slot. SUM: a is the body, b the
     * condition (0: none), c the number of the range. TABLE: a is the number of the array. */
    node a;
    union {
        struct {
            node b, c;
        };
        double value; /* CONST */
    };
} graph_node;

/* What is known of a constant in a shadow, whose decimals are the doubles on their other side (lang/text/source.h). */
typedef struct graph_typed {
    bool known;
    double plain;  /* its value in doubles where the text is read as usual */
    double spread; /* how far `plain` may be off, since a run may fuse products and sums */
    double read;   /* its value in doubles in this text */
    twofold is;    /* its exact value, by its decimals */
} graph_typed;

/* A node that a call in the text has made, which is written as that call: BEFORE argument AFTER. */
typedef struct graph_call {
    node n, argument;
    int component; /* 0: it is no component of a vector */
    const char *before, *after;
} graph_call;

typedef struct graph {
    arena *arena;
    graph_node *nodes;
    graph_typed *typed; /* by node; NULL: this is no shadow */
    uint32_t count, capacity;
    reference *references;
    uint32_t reference_count;
    range *ranges;
    uint32_t range_count;
    const array *arrays; /* owned by the model; by reference.array */
    node *table;
    uint32_t table_size; /* a power of two */
    uint32_t *place;     /* scratch of graph_order, by node */
    graph_call *calls;
    uint32_t call_count, call_room;
    bool simplify;  /* x+0, 1*x, 0*x, x-x are simplified: while derivatives are built */
    bool tidy;      /* like terms and powers are joined: while derivatives that a model writes are built */
    bool too_large; /* it would exceed GRAPH_NODES_MAX; constructors return node 0 */
} graph;
enum { GRAPH_NODES_MAX = 1 << 21 };

/* Compare member by member, since the bytes between members may differ. */
bool graph_same_subscript(const subscript *, const subscript *);
bool graph_same_range(const range *, const range *);
bool graph_same_reference(const reference *, const reference *);

graph *graph_create(arena *);
/* Makes room for a number of nodes, so that the graph need not grow: its old copy and the new one would exist
 * together. */
bool graph_reserve(graph *, uint32_t nodes);
/* Gives back what only constructors need. No node can be made afterwards. */
void graph_complete(graph *);
/* Makes the graph a shadow's: it knows the exact values of constants (graph_typed.c). False: no memory. */
bool graph_keep_typed(graph *);
/* Returns the constant of a decimal: as it is read here, as it is usually read, and as it is written. */
node graph_decimal(graph *, double read, double plain, twofold is);
/* Returns what a place holds whose constant `value` computes `number`; a `leaf` that loads the place, if not 0, gets
 * what is known of it. */
double graph_holds(graph *, node value, node leaf, double number);
/* Returns which of two nodes stands for a sum of constants here: the sum, or the sum written out. */
node graph_written_out(graph *, node sum, node written);
/* Constructors. Operands must exist. Constants fold to what a machine would compute. Identical nodes are shared. */
node graph_const(graph *, double);
node graph_time(graph *);
node graph_param(graph *, uint32_t pool_slot);
node graph_index(graph *, int level); /* a loop variable as a number */
node graph_load(graph *, const reference *);
node graph_table(graph *, uint16_t array);                 /* the numbers of an array of the pool, as a table */
node graph_running_total(graph *, int level);              /* TOTAL, in the normal form alone */
node graph_op(graph *, operation, node a, node b, node c); /* unused operands are 0 */
/* Returns base^exponent, |exponent| <= 64, by a fixed chain: an even power is the square of its half, an odd one
 * chain(n-1)*base. */
node graph_power(graph *, node base, int exponent);
/* Returns a sum; condition 0: it has none. A condition that folds to false is node 0, too: the caller then writes
 * graph_const(g, 0), the empty sum. */
node graph_sum(graph *, int level, const range *, node condition, node body);
/* Adds terms: up to 16 from left to right; more in 8 interleaved partial sums, joined by a fixed tree. A SUM has the
 * same bits, but for the sign of a zero. */
node graph_total(graph *, const node *terms, size_t count);

/* Forgets all nodes but the first `count`. Programs made of them are copies, and stay. */
void graph_cut(graph *, uint32_t count);

const graph_node *graph_at(const graph *, node);
unsigned graph_deps(const graph *, node);
/* Returns 0 if a node does not depend on the spaces in `deps`, 1 if it is affine in them, 2 if it is neither or not
 * recognised as affine. */
int graph_degree(graph *, node, unsigned deps);
/* Returns the first node, if any, that is not smooth along the motion (ABS MIN MAX FLOOR MOD SIGN SELECT, a comparison,
 * a direction), or 0. */
node graph_kink(graph *, node);
/* A sum of components of a vector, with factors, over the length of the vector, which depends on velocities: factor
 * above/divisor. Each component of u/|u| and of cross(k, u)/|u| is such. `above` is linear in the components, and the
 * divisor is the length times what does not move. */
enum { GRAPH_COMPONENTS = 3 };
typedef struct graph_directed {
    node length, divisor, above, component[GRAPH_COMPONENTS];
    node factor; /* UINT32_MAX: 1 */
    int count;
} graph_directed;
/* Returns the number of the components; 0: the node is no such quotient. */
int graph_direction(const graph *, node, graph_directed *);
/* Returns `above` with other nodes in place of the components. */
bool graph_is_along(const graph *, node above, const graph_directed *); /* whether it has that form */
node graph_along(graph *, node above, const graph_directed *, const node *with);
/* Returns n over the other factors of the divisor, without the length. */
node graph_over(graph *, node n, node divisor, node length);
/* Returns the first node, if any, whose value may jump along the motion where its rate is bounded (FLOOR MOD SIGN
 * SELECT ATAN2, a comparison), or 0. */
node graph_jump(graph *, node);
/* Returns the first node, if any, that moves and whose value or slope may be infinite (a quotient, SQRT CBRT LOG POW
 * TAN ASIN ACOS), or 0. */
node graph_sharp(graph *, node);
/* Returns whether the value is constant along the motion but for jumps (floor(x), sign(x) + 1). */
bool graph_flat(graph *, node);
/* Returns the first operation, if any, whose operands depend on modes and that is not smooth for all of them (sqrt, a
 * power that is not whole, log, asin, acos), or 0. */
node graph_domain(graph *, node);
/* Finds moving operands of operations within a node, outside sums, where the slope is infinite if the operand is 0: of
 * a root, a logarithm, a power between 0 and 1; u for the operand |u|. Returns how many, at most `most`. */
size_t graph_steep(graph *, node, size_t most, node *of);
/* Returns the derivative, by the rules of calculus from the derivatives that `seed` gives of the leaves (TIME, LOAD,
 * PARAM, TABLE). */
typedef node (*graph_seed)(graph *, node leaf, void *ctx);
node graph_derivative(graph *, node, graph_seed, void *ctx);
/* The seed of the derivative along a direction: X → DX, V → DV; modes have none. The array of an image is that of its
 * source plus a shift, which depends on the space. */
typedef struct graph_shift {
    uint16_t x_to, v_to;
} graph_shift;
node graph_seed_direction(graph *, node leaf, void *graph_shift_ctx);
node graph_seed_time(graph *, node leaf, void *unused); /* the seed of d/dt where only t moves */
/* Returns a bound on what rounding adds to the value of a node, in units of 2^-53; infinite: it is not known. `leaf`
 * gives the error of a TIME, LOAD or PARAM in these units; 0: it is exact. */
node graph_rounding(graph *, node, graph_seed leaf, void *ctx);
/* Returns a bound on how far the value of a node, at the points of a box, may be from its value at the centre, with the
 * rounding of that value; infinite or NaN: it is not known. `leaf` gives the half width of a TIME, LOAD or PARAM; 0:
 * none. */
node graph_radius(graph *, node, graph_seed leaf, void *ctx);
/* Returns a node with other nodes in place of some of its loads, indices and sums. `with` gives the replacement of each
 * that depends on something in `deps`, or the node itself, at a level: inside a sum that opens level l it is l + 1. */
typedef node (*graph_substitute)(graph *, node, int level, void *ctx);
node graph_replace(graph *, node, unsigned deps, int level, graph_substitute with, void *ctx);

/* graph_choices.c: returns a node whose choices among u > w, u < w and u = w, of what moves, are choices between two
 * sides. */
node graph_choices(graph *, node);
/* Visits the LOADs of a space that a node can reach: each distinct reference once for every nest of sums around it.
 * sums[k] is the range of level first_level + k, k < inside. */
void graph_loads(graph *, node, space,
                 void (*visit)(void *ctx, const reference *, const range *sums, int first_level, int inside),
                 void *ctx);
/* Notes that a call in the text has made a node; the texts must outlive the graph. */
void graph_name(graph *, node, node argument, const char *before, const char *after, int component);
/* Writes infix text in the language. `name` writes the name of a PARAM slot, a LOAD reference, the TIME or an INDEX
 * (level < MAX_LEVELS: a loop variable; MAX_LEVELS: the int slot a). It may leave the last two empty: t, i, j, k … and
 * n0, n1 … then stand in. Returns the length that it wanted, like snprintf, at most GRAPH_TEXT_MAX: a longer text ends
 * there in "...". */
enum { GRAPH_TEXT_MAX = 1 << 20 };
typedef void (*graph_namer)(void *ctx, const graph_node *, char *out, size_t size);
size_t graph_print(const graph *, node, graph_namer, void *ctx, char *out, size_t size);

/* A program: what is computed and where it goes, in normal form (fused multiply-adds chosen by use count over the whole
 * program). */
typedef struct output {
    node value;
    reference to; /* its subscripts use the levels 0 … loops-1 */
    int loops;
    range loop[MAX_DIMS]; /* innermost last */
} output;
typedef struct program {
    graph *graph;
    output *outputs;
    size_t count;
} program;
/* Makes a copy in normal form, in the arena of the graph. The body a of a SUM is then the update of its running total:
 * ADD(TOTAL, body), FMA(p, q, TOTAL) or FNMA(p, q, TOTAL). NULL: the arena failed, or the graph is too large. */
program *program_create(graph *, const output *, size_t count);
/* Makes the program in another arena, for a program that runs once. Where that arena has no memory, the graph's fails,
 * too. */
program *program_create_in(arena *, graph *, const output *, size_t count);

#endif
