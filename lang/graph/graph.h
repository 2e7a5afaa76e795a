/* The expression graph: scalar nodes, shared, constants folded, with derivatives. It defines the bits.
 *
 * A node is an index; node 0 is the constant 0. Vectors are several nodes. Loops (families, sums) are not unrolled:
 * inside them a node may refer to loop variables by LEVEL (0 = outermost family index, and so on inward; a sum opens
 * the next level). N, bounds and parameters are run-time numbers: int slots and the pool. So the graph of a family
 * does not depend on N.
 */
#ifndef LANG_GRAPH_GRAPH_H
#define LANG_GRAPH_GRAPH_H

#include "lang/base/arena.h"
#include "lang/base/limits.h"
#include "lang/base/operation.h"
#include "lang/base/twofold.h"

typedef uint32_t node;

/* Value of a subscript: base = (level >= 0 ? index[level] : 0) + literal + (slot >= 0 ? ints[slot] : 0);
 * if modulus >= 0: 1 + (base mod ints[modulus]), the mathematical mod (never negative). */
typedef struct subscript {
    int8_t level;
    int16_t slot, modulus;
    int32_t literal;
} subscript;
typedef struct range {
    subscript first, last;
} range; /* empty if last < first; bounds may use outer levels */

/* Where numbers live. X, V: the state (A: the acceleration there). DX, DV: a direction. POOL: parameters, initial
 * values. */
typedef enum space { SPACE_X, SPACE_V, SPACE_A, SPACE_DX, SPACE_DV, SPACE_POOL, SPACE_OUT, SPACES } space;

/* One component of one state, list or quantity, as an array over its indices. Addresses are run-time values
 * (a machine binds them): element = base + sum over d of (index[d] - first[d]) * stride[d]; the last dimension
 * has stride 1. */
typedef struct extent {
    int64_t first[MAX_DIMS], last[MAX_DIMS], stride[MAX_DIMS];
} extent;
typedef struct array { /* there are eight for every variable, so it is kept small */
    uint8_t space;     /* enum space */
    uint8_t dims;
    bool mode; /* of X: numbers that do not change along the motion */
    size_t base;
    const extent *over; /* NULL: no dims */
} array;

/* Lays an array out from `base` on over [first, last], the last index contiguous; returns how many places it has. */
size_t graph_shape(arena *, array *, space, size_t base, int dims, const int64_t first[], const int64_t last[]);
/* Whether any of an array's places, from its first to its last, is marked. */
bool graph_marked(const array *, const uint8_t *marks);

typedef struct reference {
    uint16_t array;
    uint8_t dims;
    subscript at[MAX_DIMS];
} reference;

/* What a node depends on, transitively. Bits 0 … MAX_LEVELS-1: loop variables bound outside the node. */
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
    uint8_t level; /* INDEX, TOTAL: which; SUM: the level it opens */
    uint16_t deps;
    /* operands. LOAD: a is the reference's number. PARAM: a is the pool slot. SUM: a body, b condition (0: none),
     * c the range's number */
    node a;
    union {
        struct {
            node b, c;
        };
        double value; /* CONST */
    };
} graph_node;

/* Of a constant of a text whose decimals are read as the doubles on their other side (lang/text/source.h). */
typedef struct graph_typed {
    bool known;
    double plain;  /* what doubles make of it where the text is read as usual ... */
    double spread; /*   but for so much, since a run may fuse products and sums */
    double read;   /* what they make of it in this text */
    twofold is;    /* what its decimals say */
} graph_typed;

typedef struct graph {
    arena *arena;
    graph_node *nodes;
    graph_typed *typed; /* by node; NULL: the text is read as usual */
    uint32_t count, capacity;
    reference *references;
    uint32_t reference_count;
    range *ranges;
    uint32_t range_count;
    const array *arrays; /* owned by the model; index = reference.array */
    node *table;
    uint32_t table_size; /* hash-consing */
    uint32_t *place;     /* scratch of graph_order; it stays when the graph grows */
    bool simplify;       /* x+0, 1*x, 0*x, x-x: on while derivatives are built, off otherwise */
    bool tidy;           /* like terms and powers are joined: on while the user's derivatives are built */
    bool too_large;      /* more than GRAPH_NODES_MAX: constructors return node 0 */
} graph;
enum { GRAPH_NODES_MAX = 1 << 21 };

/* Whether they are the same, member by member: the bytes between members say nothing. */
bool graph_same_subscript(const subscript *, const subscript *);
bool graph_same_range(const range *, const range *);
bool graph_same_reference(const reference *, const reference *);

graph *graph_create(arena *);
/* Room for so many nodes, so that the graph need not grow: its old copy and the new one would be there together. */
bool graph_reserve(graph *, uint32_t nodes);
/* Gives back what only constructors need; they must not be called any more. */
void graph_complete(graph *);
/* From now on the graph knows of constants what their decimals say: graph_typed.c. False: no memory. */
bool graph_keep_typed(graph *);
/* A decimal, as it is read here, as usual, and as it is written. */
node graph_decimal(graph *, double read, double plain, twofold is);
/* The number of a place that holds a constant, which is `number` by its nodes; says so of a leaf that is read from
 * there, if it is not 0. */
double graph_holds(graph *, node value, node leaf, double number);
/* A sum of constants is what it is written out: the one of both nodes that is to stand for it here. */
node graph_written_out(graph *, node sum, node written);
/* Constructors. Operands must exist. Constants fold to what the machine would compute. Identical nodes are shared. */
node graph_const(graph *, double);
node graph_time(graph *);
node graph_param(graph *, uint32_t pool_slot);
node graph_index(graph *, int level); /* the loop variable as a number */
node graph_load(graph *, const reference *);
node graph_running_total(graph *, int level);              /* TOTAL: only in the normal form */
node graph_op(graph *, operation, node a, node b, node c); /* unused operands 0 */
/* |exponent| <= 64: the fixed chain: even: square of the half; odd: chain(n-1)*x */
node graph_power(graph *, node base, int exponent);
/* condition 0: none. A condition that folds to false is node 0 too: the caller then writes graph_const(g, 0), the
 * empty sum. */
node graph_sum(graph *, int level, const range *, node condition, node body);
/* Left to right for up to 16, else 8 interleaved partials and the fixed tree: as a SUM would, but for the sign of a
 * zero total. */
node graph_total(graph *, const node *terms, size_t count);

/* Forgets all nodes but the first `count`. Programs made of them are copies and stay. */
void graph_cut(graph *, uint32_t count);

const graph_node *graph_at(const graph *, node);
unsigned graph_deps(const graph *, node);
/* 0: does not depend on the spaces in `deps`; 1: affine in them; 2: neither, or not recognised as affine. */
int graph_degree(graph *, node, unsigned deps);
/* The first node, if any, that is not smooth along the motion (ABS MIN MAX FLOOR MOD SIGN SELECT, a comparison, a
 * direction), or 0. */
node graph_kink(graph *, node);
/* A sum of components of a vector over the vector's length, which depends on velocities: factor above/divisor, where
 * `above` is linear in the components, as each component of u/|u| and of cross(k, u)/|u| is, and the divisor is the
 * length times what does not move. */
enum { GRAPH_COMPONENTS = 3 };
typedef struct graph_directed {
    node length, divisor, above, component[GRAPH_COMPONENTS];
    node factor; /* UINT32_MAX: 1 */
    int count;
} graph_directed;
/* The number of the components, 0: the node is no such quotient. */
int graph_direction(const graph *, node, graph_directed *);
/* What stands above the length, with others in place of the components. */
bool graph_is_along(const graph *, node above, const graph_directed *); /* whether it is one of that form */
node graph_along(graph *, node above, const graph_directed *, const node *with);
/* n over what is beside the length in the divisor. */
node graph_over(graph *, node n, node divisor, node length);
/* The first node, if any, whose value may jump along the motion where its rate is bounded (FLOOR MOD SIGN SELECT ATAN2,
 * a comparison), or 0. */
node graph_jump(graph *, node);
/* The first node, if any, that moves and whose value or slope may be infinite (a quotient, SQRT CBRT LOG POW TAN ASIN
 * ACOS), or 0. */
node graph_sharp(graph *, node);
/* Whether the value only jumps along the motion, or stays what it is (floor(x), sign(x) + 1). */
bool graph_flat(graph *, node);
/* The first operation, if any, whose operands depend on modes and that is not smooth for all of them: sqrt, a power
 * that is not whole, log, asin, acos; or 0. */
node graph_domain(graph *, node);
/* Operands of the operations below a node that have an infinite slope where the operand is 0: of a root, a logarithm, a
 * power between 0 and 1; the u of |u| where that is the operand. Those that move, and not within sums; at most `most`.
 * Returns how many. */
size_t graph_steep(graph *, node, size_t most, node *of);
/* Derivative: `seed` gives the derivative of a leaf (TIME, LOAD, PARAM) as a node; all else follows by the rules of
 * calculus. */
typedef node (*graph_seed)(graph *, node leaf, void *ctx);
node graph_derivative(graph *, node, graph_seed, void *ctx);
/* Seeds for the common cases: directional (X → DX, V → DV; arrays for DX/DV are the state's array number + the given
 * offset); modes have none. */
/* array number of the image = array number + shift, by space of the source */
typedef struct graph_shift {
    uint16_t x_to, v_to;
} graph_shift;
node graph_seed_direction(graph *, node leaf, void *graph_shift_ctx);
node graph_seed_time(graph *, node leaf, void *unused); /* d/dt where only t moves */
/* A bound on how far rounding carries the value of a node, in units of the rounding 2^-53; what is infinite is not
 * known. `leaf` gives the error of a TIME, LOAD or PARAM in these units, 0: it is exact. */
node graph_rounding(graph *, node, graph_seed leaf, void *ctx);
/* A bound on how far the value of a node at the points of a box may be from its value at the centre, the rounding of
 * that value included; what is infinite or no number is not known. `leaf` gives the half width of a TIME, LOAD or
 * PARAM, 0: none. */
node graph_radius(graph *, node, graph_seed leaf, void *ctx);
/* The node with other nodes in place of some of its loads, indices and sums: `with` gives the one for each at a level
 * (inside a sum that opens level l it is l + 1), or itself. Only those that depend on something in `deps` are asked
 * for. */
typedef node (*graph_substitute)(graph *, node, int level, void *ctx);
node graph_replace(graph *, node, unsigned deps, int level, graph_substitute with, void *ctx);

/* graph_choices.c: the node with choices among u > w, u < w and u = w, of what moves, as choices between two sides. */
node graph_choices(graph *, node);
/* Leaves LOAD of the given space that the node can reach: calls visit for each distinct reference, once for every
 * nest of sums around it. sums[k] is the range of level first_level + k, k < inside. */
void graph_loads(graph *, node, space,
                 void (*visit)(void *ctx, const reference *, const range *sums, int first_level, int inside),
                 void *ctx);
/* Infix text in the language. `name` writes the name of a PARAM slot or LOAD reference; it is also asked for INDEX
 * nodes (level < MAX_LEVELS: a loop variable; level MAX_LEVELS: the int slot a) and may leave those empty: i, j, k …
 * and n0, n1 … then stand in. Returns the length it wanted (like snprintf), at most GRAPH_TEXT_MAX: a longer text
 * ends there in "...". */
enum { GRAPH_TEXT_MAX = 1 << 20 };
typedef void (*graph_namer)(void *ctx, const graph_node *, char *out, size_t size);
size_t graph_print(const graph *, node, graph_namer, void *ctx, char *out, size_t size);

/* A program: what is to be computed and where it goes, in normal form (fused multiply-adds chosen by use count over
 * the whole program). */
typedef struct output {
    node value;
    reference to; /* subscripts over the levels 0 … loops-1 */
    int loops;
    range loop[MAX_DIMS]; /* innermost last */
} output;
typedef struct program {
    graph *graph;
    output *outputs;
    size_t count;
} program;
/* A copy in normal form, in the same arena. In it a SUM's body a is the update of its running total: ADD(TOTAL, body),
 * FMA(p, q, TOTAL) or FNMA(p, q, TOTAL). NULL: the arena failed or the graph is too large. */
program *program_create(graph *, const output *, size_t count);
/* The same in an arena of its own, for a program that is run once. Where that has no memory, the graph's fails too. */
program *program_create_in(arena *, graph *, const output *, size_t count);

#endif
