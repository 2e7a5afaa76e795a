/* Lowering: trees to nodes. It checks shapes, splits vectors into components and resolves names.
 *
 * An expression holds others, and may need a parameter's value (resolve.h), a state's shape (hull.h) or an initial
 * value (start.h), which come from other expressions. Each is computed when it is first needed; model.h bounds the
 * depth. So lower.c, which lowers an expression that is held or needed, calls lower_tree.c by a pointer of the model,
 * and is below all the files that lower_tree.c calls. Numbers in brackets are the rules of the language as
 * test/language_test.c numbers them.
 */
#ifndef LANG_LOWER_LOWER_H
#define LANG_LOWER_LOWER_H

#include "lang/model/model.h"

typedef struct value {
    node *item;
    int count;             /* 0: a scalar, item[0] */
    int rows;              /* 0: no matrix; else row by row, `count` numbers each: a factor alone may be one */
    bool boolean, derived; /* derived: made by diff, see lower_tidy */
} value;

/* A name of an index that may be used here: as a subscript, as a number, and its range. */
typedef struct index_name {
    const char *name;
    subscript at;
    node constant; /* the int slot of `at` as a node; 0 if it has none */
    node number;
    int64_t first, last;
} index_name;

/* An argument of a function that is being expanded. Its expression is lowered where it is used, because sums inside the
 * function open levels of their own. */
typedef struct argument {
    const char *name;
    const tree *tree;            /* NULL: it is `known` at every level */
    struct lowering *caller;     /* whose names the expression may use */
    value known[MAX_LEVELS + 1]; /* its nodes by the level of their use; item NULL: not lowered yet */
} argument;

typedef enum lower_place {
    PLACE_CONSTANT,
    PLACE_EXACT,
    PLACE_EQUATION,
    PLACE_BOUNDARY,
    PLACE_EVENT,
    PLACE_QUANTITY
} lower_place;

typedef struct lowering {
    model *model;
    lower_place place;
    const char *what; /* "a parameter", "an initial value", "a boundary line": for messages */
    index_name names[2 * MAX_LEVELS];
    int name_count, levels;
    argument *arguments; /* of the function whose body is lowered; its names hide all others */
    uint32_t argument_count;
    int64_t low[MAX_LEVELS], high[MAX_LEVELS]; /* the range of each level */
    double terms; /* the number of evaluations of the expression in one evaluation of the model */
    int chain;
    bool by_variable; /* the variable of a diff is lowered */
} lowering;

/* What the model's member `lower` is. */
value lower_tree(lowering *, const tree *);

void lower_start(lowering *, model *, lower_place, const char *what);
value lower_expression(lowering *, const tree *);
/* Rows of numbers. */
value lower_matrix(lowering *, const tree *);
/* Where a condition is expected a mode, or what depends on modes alone, is true if it is not 0: if(stuck, 0, -x). */
void lower_mode_truth(lowering *, value *);
/* The same for a tree that must be a number, neither vector nor condition. */
node lower_scalar(lowering *, const tree *, const char *what);
/* A left side, `name[indices] … for loops`: fills to->dims, to->at and the loops of the output, and makes the indices
 * known to the lowering. */
bool lower_target(lowering *, const statement *, output *);
bool lower_subscript(lowering *, const tree *, subscript *, int64_t *first, int64_t *last);
/* Opens the indices of loops that stand on no left side, as levels 0, 1 …; `low` and `high` of the lowering are their
 * hulls then. */
bool lower_loops(lowering *, const loop *, uint32_t count, range *out);
bool lower_is_index(const lowering *, const char *name);

/* The range of each index of a left side that lower_target has read. */
void lower_extent(const model *, const lowering *, const output *, int64_t first[], int64_t last[]);

#endif
