/* A model: what a text means. Names are resolved, parameters are numbers, states have places in x and v, and the equations, boundary lines,
 * quantities, invariants and exact motions are outputs over one graph.
 *
 * Layout. A state (a variable with its indices and components) is stored component by component, each an array over the hull of its
 * indices, boundary cells included, last index contiguous. Second-order states lie in x, in the order of their first statement, and
 * their velocities at the same places of v; first-order states follow in v.
 */
#ifndef LANG_MODEL_H
#define LANG_MODEL_H

#include "lang/graph.h"
#include "lang/tree.h"

enum {
    MODEL_NUMBERS_MAX = 50000000,    /* state, all components and boundary cells */
    MODEL_LIST_MAX = 50000000,       /* numbers in parameters' lists and families */
    MODEL_COMPONENTS_MAX = 4096,     /* length of a vector */
    MODEL_CHAIN_MAX = 400,           /* definitions that use definitions that use … */
    MODEL_DEPTH_MAX = 2000           /* brackets and definitions within one another, all counted: what the C stack must bear */
};
#define MODEL_LOWERED_MAX 50000000u  /* trees lowered, all uses of quantities counted */
#define MODEL_TERMS_MAX 1e11         /* of nested sums and families, per evaluation */
#define MODEL_CONSTANT_TERMS_MAX 1e8 /* of all sums in constants together: they are computed while the model is read */

typedef struct model_cells {         /* the cells of a family that have an equation, in the order of their indices */
    size_t count;
    uint32_t *offset;                /* place within the hull; NULL: 0 … count-1 */
} model_cells;

typedef struct model_state {
    const char *name;
    span at;
    int order;                       /* 2 or 1 */
    int components;                  /* 0: scalar */
    int dims;
    int64_t first[MAX_DIMS], last[MAX_DIMS];         /* hull of equations and boundary lines */
    int64_t eq_first[MAX_DIMS], eq_last[MAX_DIMS];   /* hull of equations */
    size_t hull;                     /* cells in the hull */
    model_cells cells;
    uint8_t *owner;                  /* per hull cell: 0 none, 1 equation, 2 boundary; NULL for a scalar */
    size_t base;                     /* of component 0 in x (order 2) and v */
    uint16_t array;                  /* number within a block of state arrays, component 0 */
    uint16_t start_array[2];         /* POOL arrays of x(0) and x'(0), component 0 */
    uint32_t line, last_line;        /* 1 + number of the first and last statement about it */
    uint8_t progress;
    bool shaped, start_done;         /* components are known; every initial value is */
    uint16_t log_array[2];           /* vary.h: 1 + the arrays over the pool of x(0) and x'(0), 0 none */
    uint8_t *start_map[2];           /* per hull cell: has x(0), x'(0) a value, and from what kind of line */
    uint32_t *start_own[2];          /* per hull cell: 1 + number of the line about it alone, 0 none; NULL until asked for */
} model_state;

/* What was computed from parameters while the model was read: see vary.h. */
typedef struct vary_entry vary_entry;
typedef struct vary_log {
    vary_entry *entries; uint32_t count, room;
    struct vary_frozen { node n; const char *what; } *frozen; uint32_t frozen_count, frozen_room;
    uint16_t scalars;                /* 1 + the array over all scalar slots, 0 none */
} vary_log;

typedef enum definition_kind { DEFINED_UNKNOWN, DEFINED_PARAMETER, DEFINED_QUANTITY, DEFINED_INVARIANT } definition_kind;

typedef struct model_definition {
    const char *name;
    const statement *statement;
    definition_kind kind;
    uint8_t progress;                /* 0 not yet, 1 on the way (seeing it again is a cycle), 2 done */
    int components;                  /* 0: scalar */
    bool list;                       /* list or family: an array over indices */
    int dims;
    int64_t first[MAX_DIMS], last[MAX_DIMS];
    uint16_t log_array;              /* vary.h: 1 + its array over the pool, 0 none */
    uint32_t slot;                   /* parameter without indices: its first pool slot */
    uint16_t array;                  /* list: POOL array of component 0; quantity or invariant: OUT array */
    struct value **known;            /* quantity without indices: its nodes, by place and level where it is used */
    output *outputs; size_t output_count;            /* quantity, invariant: into OUT from 0 */
    size_t numbers;
} model_definition;

typedef struct model {
    arena *arena;
    source source;
    statements statements;
    graph *graph;
    array *arrays; uint32_t array_count, array_capacity;
    int64_t *ints; node *int_nodes; uint32_t int_count, int_capacity;
    double *pool; size_t pool_count, pool_capacity;
    uint32_t scalar_slots, scalar_used;      /* pool slots [0, scalar_slots) are for scalars and vectors, whatever N is */

    vary_log log;
    double constant_terms;           /* of sums in constants so far */
    int depth;                       /* expressions within expressions, at present */
    int start_depth;                 /* initial values that use one another */
    uint64_t lowered;                /* trees lowered so far: bounds what quantities of quantities can cost */
    model_state *states; uint32_t state_count;
    model_definition *definitions; uint32_t definition_count;
    uint32_t *symbols; uint32_t symbol_size;         /* hash table: name → state or definition */
    uint16_t block[5], block_size;   /* array numbers of the X, V, A, DX, DV blocks */
    size_t nx, nv;
    double *x0, *v0;

    output *accel; size_t accel_count;
    output *boundary; size_t boundary_count;         /* into X and V */
    bool driven;                     /* a boundary line depends on t */
    output *exact; size_t exact_count;               /* into X and V */
    bool exact_given, exact_recognised;
    traits traits;                   /* gyroscopic and gradient are found on demand (run/) */

    double start, step, tolerance, until, every_time;
    bool start_known;
    int64_t every_steps;
    const char *method;
} model;

/* Reads a model. On failure the error says what and where, and *out is NULL; the arena holds whatever was taken. */
motus_status model_create(arena *, const motus_text_def *, model **out, motus_error *);

/* Name of x[k] (in_v: v[k]): "r[3].y", "x'". */
void model_name(const model *, bool in_v, size_t k, char *out, size_t size);
void model_state_name(const model_state *, size_t cell, int component, bool prime, char *out, size_t size);
/* Equation k as text, in normal form; returns false past the last. */
bool model_equation(const model *, size_t k, char *out, size_t size);
/* Text of a node with the model's names. */
void model_print(const model *, node, char *out, size_t size);

/* ---- within lang/ ---- */

typedef enum block { BLOCK_X, BLOCK_V, BLOCK_A, BLOCK_DX, BLOCK_DV } block;

/* resolve.c: constants, layout, initial values */
bool resolve_all(model *);
bool resolve_definition(model *, model_definition *);
/* The complaint that a line has not the indices that its state has; false. */
bool resolve_indices_wrong(model *, const model_state *, span at);
bool resolve_hull(model *, model_state *);       /* where its indices range, and which cells have equations */
bool resolve_start_time(model *);
/* what: "step", "the start" …, or NULL: a size or an index; must outlive the model */
bool resolve_number(model *, node, span at, const char *what, double *value);
int resolve_int(model *, node, span at, int64_t *value);        /* the int slot, or -1 */
/* Room for arrays, zeroed; their numbers begin at *first. */
bool resolve_arrays(model *, int count, uint16_t *first);
/* x0 and v0 from the initial values, wherever those changed. */
void resolve_start_state(model *);
bool resolve_run(model *, const output *, size_t count, double t, double *const base[SPACES]);

/* start.c: initial values */
bool start_state(model *, model_state *);
/* x(0) (primes 0) or x'(0) (1) at the cells [low, high]: afterwards in start_array. */
bool start_cells(model *, model_state *, int primes, const int64_t low[], const int64_t high[]);

/* equations.c */
bool equations_all(model *);
/* analysis.c */
void analysis_all(model *);

/* symbols.c: names */
typedef struct symbol { model_state *state; model_definition *definition; } symbol;
bool symbols_collect(model *, const motus_text_def *);
symbol symbols_find(const model *, const char *name);
void symbols_suggest(model *, const char *name, const char *const *more, uint32_t more_count);
bool symbols_classify(model *);

#endif
