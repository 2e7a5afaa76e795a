/* A model, read from a text. Names are resolved, parameters are numbers, states have places in x and v, and the
 * equations, boundary lines, quantities, invariants and exact motions are outputs over one graph. lang/read/ makes it.
 *
 * Layout. A state (a variable with its indices and components) is stored component by component. Each component is an
 * array over the hull of the state's indices, which is the smallest box that holds its equations and boundary lines;
 * the last index is contiguous. x holds the second-order states in the order of their first statements; v holds their
 * velocities at the same places, then the first-order states.
 */
#ifndef LANG_MODEL_MODEL_H
#define LANG_MODEL_MODEL_H

#include "core/rules.h"
#include "lang/graph/graph.h"
#include "lang/tree/tree.h"

enum {
    MODEL_NUMBERS_MAX = 50000000, /* state, all components and boundary cells */
    MODEL_LIST_MAX = 50000000,    /* numbers in parameters' lists and families */
    MODEL_COMPONENTS_MAX = 4096,  /* length of a vector */
    MODEL_CHAIN_MAX = 400,        /* definitions or functions each of which uses the next */
    MODEL_ARGUMENTS_MAX = 8,      /* of a function */
    MODEL_KEEPS_MAX = 4096,       /* numbers and vectors that events keep */
    MODEL_DEPTH_MAX = 2000        /* brackets and definitions within one another, together: it bounds the C stack */
};
#define MODEL_CALLS_MAX 131072u      /* calls of functions by functions */
#define MODEL_LOWERED_MAX 50000000u  /* trees lowered, those of a quantity at each of its uses */
#define MODEL_TERMS_MAX 1e11         /* of nested sums and families, per evaluation */
#define MODEL_CONSTANT_TERMS_MAX 1e8 /* of all sums in constants together, which are computed while the model is read */

typedef struct model_cells { /* the cells of a family that have an equation, in the order of their indices */
    size_t count;
    uint32_t *offset; /* place within the hull; NULL: 0 … count-1 */
} model_cells;

/* A boundary line that depends on a state: lower_ghost.c. */
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
    int components; /* 0: scalar */
    int dims;
    int64_t first[MAX_DIMS], last[MAX_DIMS];       /* hull of equations and boundary lines */
    int64_t eq_first[MAX_DIMS], eq_last[MAX_DIMS]; /* hull of equations */
    size_t hull;                                   /* cells in the hull */
    model_cells cells;
    bool kept;                /* of a mode: only what observes the motion reads it */
    uint8_t *owner;           /* per hull cell: 0 none, 1 equation, 2 boundary; NULL for a scalar */
    model_ghost *ghosts;      /* boundary lines that depend on a state; NULL: none */
    size_t base;              /* of component 0 in x (order 2) and v */
    uint16_t array;           /* number within a block of state arrays, component 0 */
    uint16_t start_array[2];  /* POOL arrays of x(0) and x'(0), component 0 */
    uint32_t line, last_line; /* 1 + number of the first and last statement about it */
    uint8_t progress;
    bool shaped, start_done; /* its components are known; all its initial values are */
    bool supposed;           /* of a draft: there is no line x'(0) = …, and it starts at rest */
    uint16_t log_array[2];   /* vary_record.h: 1 + the arrays over the pool of x(0) and x'(0), 0 none */
    uint8_t *start_map[2];   /* per hull cell: the kind of line that gave x(0), x'(0), 0 none */
    uint32_t *start_own[2];  /* per hull cell: 1 + number of the line about it alone, 0 none; or NULL */
} model_state;

/* What was computed from parameters while the model was read: see vary_record.h. */
#define VARY_ENTRY UINT32_MAX
typedef struct vary_log {
    struct vary_line {
        node value;    /* of a number in a scalar slot; VARY_ENTRY: it is an entry */
        uint32_t slot; /* this slot, or the number of the entry */
    } * lines;
    uint32_t count, room;
    struct vary_entry *entries;
    uint32_t entry_count, entry_room;
    struct vary_frozen {
        node n;
        const char *what;
    } * frozen;
    uint32_t frozen_count, frozen_room;
    uint16_t scalars; /* 1 + the array over all scalar slots, 0 none */
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
    uint8_t progress; /* 0 not computed, 1 being computed (needed now, it depends on itself), 2 done */
    uint8_t reads;    /* lower_ghost.c: 0 unknown, 1 it reads no state, 2 it does */
    uint32_t mode;    /* of a parameter that an event assigns: 1 + the number of its mode in states; 0: none does */
    bool list;        /* list or family: an array over indices */
    uint8_t dims;
    int components;        /* 0: scalar */
    uint32_t last_line;    /* 1 + number of its last line: a family may have several, each naming the next */
    uint32_t slot;         /* parameter without indices: its first pool slot */
    uint16_t log_array;    /* vary_record.h: 1 + its array over the pool, 0 none */
    uint16_t array;        /* list: POOL array of component 0; quantity or invariant: OUT array */
    int64_t *first, *last; /* MAX_DIMS of each; those without indices share one array of zeros */
    struct value **known;  /* quantity without indices: its nodes, by kind of place and level of its use */
    output *outputs;
    size_t output_count; /* quantity, invariant: into OUT from 0 */
    size_t numbers;
} model_definition;

/* A function of one's own: its statement, which every call lowers with its arguments. */
typedef struct model_function {
    const char *name;
    const statement *statement;
    uint8_t progress;         /* of classifying: 0 not yet, 1 now (needed now, it calls itself), 2 done */
    uint8_t reads;            /* lower_ghost.c: 0 unknown, 1 its body reads no state, 2 it does */
    bool moves;               /* its body uses a state or t, besides its arguments */
    struct expansions *calls; /* lower_function.c: those that were lowered; NULL: none */
} model_function;

/* An assignment of an event: its value, to SPACE_OUT, for all indices of its rule; and the number of x or v that it
 * becomes. */
typedef struct model_assignment {
    output value;
    reference to;
    span at;   /* its left side */
    bool kept; /* it is what the event keeps: one number, whatever the indices that number no instances */
} model_assignment;

/* A `when` statement (core/rules.h). Its indices are the levels 0 … loops-1 of its formulas. Those that its functions
 * read, and those before them, number the instances; over the others every event runs. */
typedef struct model_rule {
    const char *name;
    const statement *statement;
    uint8_t kind;     /* rule_kind */
    int8_t direction; /* as in core/rules.h, and so all that is not explained here */
    bool records, assigns, keeps;
    uint8_t loops, own; /* own: those that number the instances */
    range loop[MAX_DIMS];
    int64_t first[MAX_DIMS], last[MAX_DIMS]; /* the hull of each index */
    span occasion;                           /* what it waits for, in the text */
    size_t instances;                        /* cells of the hull of its own indices */
    size_t leaf_first;                       /* number of its first function */
    output *leaf;                            /* to SPACE_OUT, by the number of the function */
    size_t leaves;
    int16_t *formula;
    int words;
    uint8_t *compares; /* for each leaf */
    model_assignment *assignment;
    size_t assignments, numbers; /* numbers: of SPACE_OUT, that its assignments need */
    double period;               /* as it was read; */
    output every;                /*   to SPACE_OUT, by the number of the rule */
    size_t of;
    int64_t stop;
} model_rule;

/* What an event keeps, count(NAME), time(NAME, 3), at(NAME, last, expr), for all who ask for it: a mode that the text
 * does not name. Its state is made when all has been lowered. */
enum { KEEP_COUNT = -1, KEEP_LAST = 0 };
typedef struct model_keep {
    struct model_keep *next;
    uint32_t rule;
    int64_t which;  /* of the event: 1, 2 …, KEEP_LAST; KEEP_COUNT: it counts them */
    int components; /* 0: a scalar */
    node *is;       /* what is kept; of a count nothing */
    uint16_t array; /* in X, of component 0 */
    span at;        /* the first call, for its name */
} model_keep;

/* The shape of a family of numbers; dims 0: one number. */
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
    /* A scalar slot belongs to definition d, 1 + d; an array to definition d, 2 d + 1, or to variable s, 2 s + 2; 0: to
     * none. */
    uint32_t *slot_owner, *array_owner;
    int64_t no_extent[MAX_DIMS];

    vary_log log;
    uint8_t *overridden;   /* vary.h: by place of the pool, 1: set by motus_system_set; NULL: none is */
    struct verify *verify; /* verify.h: the checks of exact lines and invariants; NULL: there are none */
    double constant_terms; /* of sums in constants so far */
    double terms;          /* of the largest nest of families and sums that moves */
    uint32_t singles;      /* cells and terms that were made single, which bounds the cost of those: evaluate.h */
    uint16_t leaf_array;   /* lower_diff.c: the array of the leaves of its own, 0 none */
    int32_t leaf_count;    /* how many there are */
    struct value (*lower)(struct lowering *, const tree *); /* lower_tree: lang/lower/lower.h */
    int depth;                                              /* present depth of expressions within expressions */
    int start_depth;                                        /* present depth of initial values that use one another */
    uint64_t lowered; /* trees lowered so far, which bounds the cost of quantities of quantities */
    uint64_t calls;   /* of functions by functions that were lowered, which bounds the cost of those */
    model_cut cut;    /* lower_ghost.c: what is lowered just now must be divided */
    bool divided;     /* something was */
    /* Modes, numbers that events alone change, are positions without velocity and acceleration, behind all others of x;
     * they are states [state_count, state_count + mode_count), which most code need not know. */
    model_state *states;
    uint32_t state_count, mode_count;
    /* Of the modes: sides of switches (lang/model/switches.h), states [side_first, side_first + side_count). */
    uint32_t side_first, side_count;
    struct switches *located; /* with them: the switches whose sides they are; NULL: there are none */
    model_definition *definitions;
    uint32_t definition_count;
    model_function *functions;
    uint32_t function_count;
    model_rule *rules;
    uint32_t rule_count;
    size_t rule_functions; /* of all rules, instances counted */
    model_keep *keeps, *last_keep;
    uint32_t keep_count;
    uint32_t *symbols;
    uint32_t symbol_size;          /* hash table: name → state or definition */
    uint16_t block[5], block_size; /* array numbers of the X, V, A, DX, DV blocks */
    size_t nx, nv, modes;          /* modes: numbers of x that are modes, the last */
    size_t *variables;             /* the first number in v of every state in the order of x and v, then nv */
    double *x0, *v0;

    output *accel;
    size_t accel_count;
    output *boundary;
    size_t boundary_count; /* into X and V */
    bool driven;           /* a boundary line depends on t */
    output *exact;
    size_t exact_count; /* into X and V */
    bool exact_given, exact_recognised;
    bool exact_between; /* verify.h: the exact line was checked at and between sampled times */
    traits traits;      /* but gyroscopic and gradient, which api/system/symmetry.c judges when they are needed */

    double tolerance, accuracy; /* NaN: none is set */
    bool absolute;              /* that of the two which is set; they are never both */
    double start, step, until, every_time;
    bool start_known, draft; /* draft: as in motus_text_def */
    int64_t every_steps;
    const char *method;
} model;

/* Name of x[k] (in_v: v[k]): "r[3].y", "x'". */
void model_name(const model *, bool in_v, size_t k, char *out, size_t size);
void model_state_name(const model_state *, size_t cell, int component, bool prime, char *out, size_t size);
/* Equation k as text, in normal form; returns false past the last. */
bool model_equation(const model *, size_t k, char *out, size_t size);
/* Name of what a reference means: "x[i]'", "r.y". */
void model_reference_name(const model *, const reference *, char *out, size_t size);
/* Text of a node with the names of the model. */
void model_print(const model *, node, char *out, size_t size);

/* model_storage.c. Room for `count` numbers in the pool, and for arrays, zeroed; they begin at *first. False: no
 * memory, or complained. */
bool model_take_numbers(model *, size_t count, size_t *first);
bool model_take_arrays(model *, int count, uint16_t *first);
/* Room for so many arrays in all, more than there is; nothing is given back, since programs refer to the old ones. */
bool model_reserve_arrays(model *, uint32_t room);
/* The derivative of a leaf along the motion: t moves by 1, x by v, v by a. */
node model_seed_motion(graph *, node leaf, void *model);
/* Whether the numbers of a state depend on the model's parameters. */
static inline bool model_has_families(const model *m)
{
    bool any = false;
    for (uint32_t i = 0; i < m->state_count + m->mode_count; i++) any |= m->states[i].dims > 0;
    return any;
}
/* All numbers of a state or mode in v, and of one of second order in x. */
static inline size_t model_numbers(const model_state *s)
{
    return s->hull * (size_t)(s->components ? s->components : 1);
}
/* The variable that an array of its blocks, or of its initial values, belongs to; NULL: none. */
const model_state *model_state_of(const model *, uint16_t array);
/* Room of its own for the ranges of a definition's indices. */
bool model_take_extent(model *, model_definition *);
/* Copies the initial values from the pool into x0 and v0; due after every change of them. */
void model_start_state(model *);

#endif
