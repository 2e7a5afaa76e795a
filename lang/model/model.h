/* A model, read from a text. Names are resolved, parameters are numbers, states have places in x and v, and the
 * equations, boundary lines, quantities, invariants and exact motions are outputs over one graph. lang/read/ makes it.
 *
 * Layout. A state, a variable with its indices and components, is stored component by component. Each component is an
 * array over the hull of the state's indices, the smallest box that holds its equations and boundary lines; the last
 * index is contiguous. x has the second-order states in the order of their first statements; v has their velocities at
 * equal places, then the first-order states.
 */
#ifndef LANG_MODEL_MODEL_H
#define LANG_MODEL_MODEL_H

#include "core/rules.h"
#include "lang/graph/graph.h"
#include "lang/tree/tree.h"

enum {
    MODEL_NUMBERS_MAX = 50000000, /* numbers of the state, with all components and boundary cells */
    MODEL_LIST_MAX = 50000000,    /* numbers in lists and families of parameters */
    MODEL_COMPONENTS_MAX = 4096,  /* length of a vector */
    MODEL_CHAIN_MAX = 400,        /* definitions or functions in a chain, each of which uses the next */
    MODEL_ARGUMENTS_MAX = 8,      /* arguments of a function */
    MODEL_KEEPS_MAX = 4096,       /* numbers and vectors that events keep */
    MODEL_DEPTH_MAX = 2000        /* nested brackets and definitions together, which bounds the C stack */
};
#define MODEL_CALLS_MAX 131072u      /* calls of functions by functions */
#define MODEL_LOWERED_MAX 50000000u  /* trees lowered; those of a quantity count at each use */
#define MODEL_TERMS_MAX 1e11         /* terms of nested sums and families, per evaluation */
#define MODEL_CONSTANT_TERMS_MAX 1e8 /* terms of all sums in constants, computed while the model is read */

typedef struct model_cells { /* the cells of a family that have an equation, in the order of their indices */
    size_t count;
    uint32_t *offset; /* places within the hull; NULL: 0 … count-1 */
} model_cells;

/* A boundary line that depends on a state (lower_ghost.c). */
typedef struct model_ghost {
    const statement *line;
    int64_t first[MAX_DIMS], last[MAX_DIMS]; /* its cells */
    bool expanding;                          /* its right side is being lowered */
    struct model_ghost *next;
} model_ghost;

/* A family must be divided before the index `at` of a level. */
typedef struct model_cut {
    bool wanted;
    int level;
    int64_t at;
} model_cut;

typedef struct model_state {
    const char *name;
    span at;
    int order;      /* 2 or 1 */
    int components; /* 0: it is a scalar */
    int dims;
    int64_t first[MAX_DIMS], last[MAX_DIMS];       /* the hull of equations and boundary lines */
    int64_t eq_first[MAX_DIMS], eq_last[MAX_DIMS]; /* the hull of equations */
    size_t hull;                                   /* cells in the hull */
    model_cells cells;
    bool kept;                /* it is a mode that only what observes the motion reads */
    uint8_t *owner;           /* by cell of the hull: 0 none, 1 equation, 2 boundary; NULL: it is a scalar */
    model_ghost *ghosts;      /* boundary lines that depend on a state, or NULL */
    size_t base;              /* the place of component 0 in x (order 2) and v */
    uint16_t array;           /* the number of component 0 within a block of state arrays */
    uint16_t start_array[2];  /* the POOL arrays of component 0 of x(0) and x'(0) */
    uint32_t line, last_line; /* 1 + number of the first and last statement about it */
    uint8_t progress;
    bool shaped, start_done; /* its components are known; all its initial values are known */
    bool supposed;           /* a draft has no line x'(0) = … for it, and it starts at rest */
    uint16_t log_array[2];   /* for vary_record.h: 1 + the arrays over the pool of x(0) and x'(0); 0: none */
    uint8_t *start_map[2];   /* by cell of the hull: the kind of line that gave x(0), x'(0); 0: none */
    uint32_t *start_own[2];  /* by cell of the hull: 1 + number of the line about it alone, 0: none; or NULL */
} model_state;

/* What was computed from parameters while the model was read (vary_record.h). */
#define VARY_ENTRY UINT32_MAX
typedef struct vary_log {
    struct vary_line {
        node value;    /* the number in a scalar slot; VARY_ENTRY: this is an entry */
        uint32_t slot; /* that slot, or the number of the entry */
    } * lines;
    uint32_t count, room;
    struct vary_entry *entries;
    uint32_t entry_count, entry_room;
    struct vary_frozen {
        node n;
        const char *what;
    } * frozen;
    uint32_t frozen_count, frozen_room;
    uint16_t scalars; /* 1 + the array over all scalar slots; 0: none */
} vary_log;

typedef enum definition_kind {
    DEFINED_UNKNOWN,
    DEFINED_PARAMETER,
    DEFINED_QUANTITY,
    DEFINED_INVARIANT
} definition_kind;

typedef struct model_definition {
    const char *name;
    const statement *statement;
    uint8_t kind;     /* definition_kind */
    uint8_t progress; /* 0 not computed, 1 being computed (if it is needed now, it depends on itself), 2 done */
    uint8_t reads;    /* for lower_ghost.c: 0 unknown, 1 it reads no state, 2 it does */
    uint32_t mode;    /* 1 + the number of the mode of a parameter that an event assigns; 0: no event does */
    bool list;        /* it is a list or family: an array over indices */
    uint8_t dims;
    int components;        /* 0: it is a scalar */
    uint32_t last_line;    /* 1 + number of its last line; each line of a family names the next */
    uint32_t slot;         /* a parameter without indices: its first pool slot */
    uint16_t log_array;    /* for vary_record.h: 1 + its array over the pool; 0: none */
    uint16_t array;        /* a list: the POOL array of component 0; a quantity or invariant: its OUT array */
    int64_t *first, *last; /* MAX_DIMS of each; definitions without indices share an array of zeros */
    struct value **known;  /* a quantity without indices: its nodes, by kind of place and level of use */
    output *outputs;
    size_t output_count; /* of a quantity or invariant, into OUT from 0 on */
    size_t numbers;
} model_definition;

/* A function of the model: its statement, which every call lowers with its arguments. */
typedef struct model_function {
    const char *name;
    const statement *statement;
    uint8_t progress; /* of its classification: 0 not yet, 1 now (if it is needed now, it calls itself), 2 done */
    uint8_t reads;    /* for lower_ghost.c: 0 unknown, 1 its body reads no state, 2 it does */
    bool moves;       /* its body uses a state or t, besides its arguments */
    struct expansions *calls; /* for lower_function.c: the calls that were lowered, or NULL */
} model_function;

/* An assignment of an event: its value, to SPACE_OUT, for all indices of its rule, and the number of x or v that gets
 * the value. */
typedef struct model_assignment {
    output value;
    reference to;
    span at;   /* its left side */
    bool kept; /* the event keeps it: one number for an instance */
} model_assignment;

/* A `when` statement; core/rules.h explains members that have no comment here. Its indices are the levels 0 … loops-1
 * of its formulas. The indices up to the last one that its functions read number the instances; every event runs over
 * the others. */
typedef struct model_rule {
    const char *name;
    const statement *statement;
    uint8_t kind; /* rule_kind */
    int8_t direction;
    bool records, assigns, keeps;
    uint8_t loops, own; /* own: how many indices number the instances */
    range loop[MAX_DIMS];
    int64_t first[MAX_DIMS], last[MAX_DIMS]; /* the hull of the indices */
    span occasion;                           /* the text of what it waits for */
    size_t instances;                        /* cells in the hull of its own indices */
    size_t leaf_first;                       /* the number of its first function */
    output *leaf;                            /* functions, to SPACE_OUT by their numbers */
    size_t leaves;
    int16_t *formula;
    int words;
    uint8_t *compares; /* by leaf */
    model_assignment *assignment;
    size_t assignments, numbers; /* numbers: how many of SPACE_OUT its assignments need */
    double period;               /* as it was read */
    output every;                /* the period, to SPACE_OUT by the number of the rule */
    size_t of;
    int64_t stop;
} model_rule;

/* What an event keeps, as count(NAME), time(NAME, 3), at(NAME, last, expr), for all formulas with this call: a mode
 * without a name in the text. Its state is made after everything has been lowered. */
enum { KEEP_COUNT = -1, KEEP_LAST = 0 };
typedef struct model_keep {
    struct model_keep *next;
    uint32_t rule;
    int64_t which;  /* the number of the event, from 1, or KEEP_LAST, or KEEP_COUNT: it is a count */
    int components; /* 0: it is a scalar */
    node *is;       /* the nodes that are kept, unless it is a count */
    uint16_t array; /* the array of component 0, in X */
    span at;        /* its first call, which names it */
} model_keep;

/* The numbers of a list without a name, which stands in the text, or of the points of a uniform grid. */
typedef struct model_unnamed {
    const tree *of;
    struct model_unnamed *next;
    uint16_t array;
    int components;
} model_unnamed;

/* The shape of a family of numbers; dims 0: it is one number. */
typedef struct model_shape {
    int dims;
    int64_t first[MAX_DIMS], last[MAX_DIMS];
} model_shape;

struct value;
struct lowering;

typedef enum block { BLOCK_X, BLOCK_V, BLOCK_A, BLOCK_DX, BLOCK_DV } block;

typedef struct model {
    arena *arena;
    source source;
    statements statements;
    graph *graph;
    array *arrays;
    uint32_t array_count, array_capacity;
    int64_t *ints;
    node *int_nodes;
    uint32_t int_count, int_capacity;
    double *pool;
    size_t pool_count, pool_capacity;
    uint32_t scalar_slots, scalar_used; /* pool slots [0, scalar_slots) are for scalars and vectors */
    /* By slot: 1 + d for definition d. By array: 2 d + 1 for definition d, 2 s + 2 for variable s. 0: none. */
    uint32_t *slot_owner, *array_owner;
    int64_t no_extent[MAX_DIMS];

    vary_log log;
    uint8_t *overridden;   /* for vary.h, by place of the pool: 1: motus_system_set has set it; NULL: none */
    struct verify *verify; /* for verify.h: the checks of exact lines and invariants, or NULL */
    struct table **tables; /* for table.h: what has been made of lists */
    uint32_t table_count, table_room;
    model_unnamed *unnamed; /* for lower_table.c */
    double constant_terms;  /* terms of sums in constants so far */
    double terms;           /* terms of the largest nest of families and sums that moves */
    uint32_t singles;       /* cells and terms made single, which bounds their cost (evaluate.h) */
    uint16_t leaf_array;    /* for lower_diff.c: the array of its own leaves; 0: none */
    int32_t leaf_count;     /* how many leaves it has */
    struct value (*lower)(struct lowering *, const tree *); /* lower_tree of lang/lower/lower.h */
    int depth;                                              /* the present depth of nested expressions */
    int start_depth;  /* the present depth of initial values that use one another */
    uint64_t lowered; /* trees lowered so far, which bounds the cost of nested quantities */
    uint64_t calls;   /* calls of functions by functions so far, which bounds their cost */
    model_cut cut;    /* for lower_ghost.c: what is being lowered must be divided */
    bool divided;     /* something was divided */
    /* Modes, numbers that only events change, are positions without velocity and acceleration, after all others of x.
     * They are states [state_count, state_count + mode_count), which most code need not know. */
    model_state *states;
    uint32_t state_count, mode_count;
    /* The modes that are sides of switches (lang/model/switches.h): states [side_first, side_first + side_count). */
    uint32_t side_first, side_count;
    struct switches *located; /* the switches whose sides they are, or NULL */
    model_definition *definitions;
    uint32_t definition_count;
    model_function *functions;
    uint32_t function_count;
    model_rule *rules;
    uint32_t rule_count;
    size_t rule_functions; /* functions of all rules and instances */
    model_keep *keeps, *last_keep;
    uint32_t keep_count;
    uint32_t *symbols;
    uint32_t symbol_size;          /* a hash table: name → state or definition */
    uint16_t block[5], block_size; /* the array numbers of the X, V, A, DX, DV blocks */
    size_t nx, nv, modes;          /* modes: how many of the last numbers of x are modes */
    size_t *variables;             /* the first number in v of every state, in the order of x and v, then nv */
    double *x0, *v0;

    output *accel;
    size_t accel_count;
    output *boundary;
    size_t boundary_count; /* into X and V */
    bool driven;           /* a boundary line depends on t */
    output *exact;
    size_t exact_count; /* into X and V */
    bool exact_given, exact_recognised;
    bool exact_between; /* for verify.h: the exact line was checked at and between sampled times */
    traits traits;      /* without gyroscopic and gradient, which api/system/symmetry.c judges when they are needed */

    double tolerance, accuracy; /* NaN: none is set */
    bool absolute;              /* whichever of the two is set is absolute; at most one is */
    double start, step, until, every_time;
    bool start_known, draft; /* draft: as in motus_text_def */
    int64_t every_steps;
    const char *method;
    const char *time; /* the name of the time: t, unless the model says another one */
} model;

/* Writes the name of x[k] (in_v: of v[k]): "r[3].y", "x'". */
void model_name(const model *, bool in_v, size_t k, char *out, size_t size);
void model_state_name(const model_state *, size_t cell, int component, bool prime, char *out, size_t size);
/* Writes equation k as text, in normal form. False: k is past the last. */
bool model_equation(const model *, size_t k, char *out, size_t size);
/* Writes the name of what a reference means: "x[i]'", "r.y". */
void model_reference_name(const model *, const reference *, char *out, size_t size);
/* Writes a node as text with the names of the model. */
void model_print(const model *, node, char *out, size_t size);

/* model_storage.c: take room for `count` numbers in the pool, or for arrays, zeroed; they begin at *first. False: there
 * was a complaint, or no memory. */
bool model_take_numbers(model *, size_t count, size_t *first);
bool model_take_arrays(model *, int count, uint16_t *first);
/* Makes room for a larger number of arrays. The old ones are not given back, since programs refer to them. */
bool model_reserve_arrays(model *, uint32_t room);
/* Returns the derivative of a leaf along the motion: t moves by 1, x by v, v by a. */
node model_seed_motion(graph *, node leaf, void *model);
/* Returns whether a state or mode is a family. */
static inline bool model_has_families(const model *m)
{
    bool any = false;
    for (uint32_t i = 0; i < m->state_count + m->mode_count; i++) any |= m->states[i].dims > 0;
    return any;
}
/* Returns how many numbers a state or mode has in v, and in x if it is of second order. */
static inline size_t model_numbers(const model_state *s)
{
    return s->hull * (size_t)(s->components ? s->components : 1);
}
/* Returns the number of a cell in a box of indices; the last index is contiguous. */
static inline size_t model_cell(int dims, const int64_t first[], const int64_t last[], const int64_t at[])
{
    size_t cell = 0;
    for (int d = 0; d < dims; d++) cell = cell * (size_t)(last[d] - first[d] + 1) + (size_t)(at[d] - first[d]);
    return cell;
}
/* Moves to the next cell of a box. False: `at` was the last one, and is now the first. */
static inline bool model_next_cell(int dims, const int64_t first[], const int64_t last[], int64_t at[])
{
    for (int d = dims - 1; d >= 0; d--) {
        if (++at[d] <= last[d]) return true;
        at[d] = first[d];
    }
    return false;
}
/* Raises `depth` for an expression within another one; the caller lowers it again. False: it complained that this is
 * too deep. */
bool model_deeper(model *, const span *at);
/* Returns the variable whose blocks or initial values have this array, or NULL. */
const model_state *model_state_of(const model *, uint16_t array);
/* Takes separate room for the ranges of a definition's indices. */
bool model_take_extent(model *, model_definition *);
/* Copies the initial values from the pool into x0 and v0, as is due after every change of them. */
void model_start_state(model *);
/* Gives the sides of a located model values from which the force and boundary cells can be computed, until they are
 * found: row 0 of a table may not be a number. */
void model_start_sides(model *);

#endif
