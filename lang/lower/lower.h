/* Lowering: trees become nodes. Shapes are checked, vectors split into components, and names resolved.
 *
 * An expression contains others, and may need the value of a parameter (resolve.h), the shape of a state (hull.h) or an
 * initial value (start.h), which come from other expressions. Each is computed when it is first needed; model.h bounds
 * the depth. So lower.c, which lowers such expressions, calls lower_tree.c by a pointer of the model, and is below all
 * files that lower_tree.c calls.
 *
 * Numbers in brackets are the rules of the language as test/language_test.c numbers them.
 */
#ifndef LANG_LOWER_LOWER_H
#define LANG_LOWER_LOWER_H

#include "lang/model/model.h"

typedef struct value {
    node *item;
    int count; /* 0: it is a scalar, item[0] */
    int rows;  /* 0: it is no matrix; else it has rows of `count` numbers: only a factor may be one */
    /* derived: diff has made it (see lower_tidy); joined: it begins with a product of vectors by a sign, a × b */
    bool boolean, derived, joined;
} value;

/* The name of an index that may be used: as a subscript, as a number, and its range. */
typedef struct index_name {
    const char *name;
    subscript at;
    node constant; /* the int slot of `at` as a node; 0: it has none */
    node number;
    int64_t first, last;
} index_name;

/* An argument of a function that is being expanded. Its expression is lowered where it is used, because sums inside the
 * function open levels of their own. */
typedef struct argument {
    const char *name;
    const tree *tree;            /* NULL: it is `known` at every level */
    struct lowering *caller;     /* the lowering whose names the expression may use */
    value known[MAX_LEVELS + 1]; /* its nodes, by level of use; item NULL: it has not been lowered there */
} argument;

typedef enum lower_place {
    PLACE_CONSTANT,
    PLACE_EXACT,
    PLACE_EQUATION,
    PLACE_BOUNDARY,
    PLACE_EVENT,
    PLACE_QUANTITY
} lower_place;

/* The equations whose right sides are being lowered, each inside the next (lower_rate.c). */
typedef struct lower_rates {
    const statement *line;
    const struct lower_rates *up;
} lower_rates;

typedef struct lowering {
    model *model;
    lower_place place;
    const char *what; /* for messages: "a parameter", "an initial value", "a boundary line" */
    index_name names[2 * MAX_LEVELS];
    int name_count, levels;
    argument *arguments; /* those of the function whose body is lowered; they hide all other names */
    uint32_t argument_count;
    int64_t low[MAX_LEVELS], high[MAX_LEVELS]; /* by level: its range */
    double terms;                              /* how often an evaluation of the model evaluates the expression */
    int chain;
    const lower_rates *rates;
    bool by_variable; /* the variable of a diff is being lowered */
} lowering;

/* Lowers any expression; the member `lower` of a model points to it. */
value lower_tree(lowering *, const tree *);

void lower_start(lowering *, model *, lower_place, const char *what);
value lower_expression(lowering *, const tree *);
value lower_matrix(lowering *, const tree *);
/* Makes the number of a condition, if(c, 1, 0), where a number is expected. Whatever is known of a choice, as where its
 * sides change, therefore is known of it. */
void lower_as_number(lowering *, value *);
/* Makes a condition of its number, so that if(x > 0, 1, 0) is x > 0 again and changes where x is 0. */
void lower_as_decided(lowering *, value *);
/* Makes a condition where one is expected: of its number, and of a number of modes and parameters alone, which is true
 * unless it is 0, as in if(stuck, 0, -x). */
void lower_as_condition(lowering *, value *);
/* Lowers a tree that is no condition, or that counts as a number. */
value lower_numbers(lowering *, const tree *);
/* Lowers a tree that must be a number, neither vector nor condition. */
node lower_scalar(lowering *, const tree *, const char *what);
/* Lowers a left side, `name[indices] … for loops`: fills to->dims, to->at and the loops of the output, and makes the
 * indices known to the lowering. */
bool lower_target(lowering *, const statement *, output *);
bool lower_subscript(lowering *, const tree *, subscript *, int64_t *first, int64_t *last);
/* Opens the indices of loops without a left side as levels 0, 1 …; `low` and `high` of the lowering are their hulls
 * then. */
bool lower_loops(lowering *, const loop *, uint32_t count, range *out);
bool lower_is_index(const lowering *, const char *name);

/* Finds the range of each index on the left side of a line. False: it complained, or there is no memory. */
bool lower_places(model *, const statement *, int64_t first[], int64_t last[]);
/* Finds the range of each index of a left side that lower_target has read. */
void lower_extent(const model *, const lowering *, const output *, int64_t first[], int64_t last[]);

#endif
