/* From trees to nodes: shapes are checked here, vectors become components, names become places. */
#ifndef LANG_LOWER_LOWER_H
#define LANG_LOWER_LOWER_H

#include "lang/model/model.h"

typedef struct value {
    node *item;
    int count;                       /* 0: a scalar, item[0] */
    bool boolean;
} value;

/* An index name in sight: the subscript it stands for, the same as a number, and where it ranges. */
typedef struct index_name {
    const char *name;
    subscript at;
    node constant;                   /* node of the slot part of `at`; 0 if there is none */
    node number;
    int64_t first, last;
} index_name;

typedef enum lower_place { PLACE_CONSTANT, PLACE_EXACT, PLACE_EQUATION, PLACE_BOUNDARY, PLACE_QUANTITY } lower_place;

typedef struct lowering {
    model *model;
    lower_place place;
    const char *what;                /* "a parameter", "an initial value", "a boundary line": for messages */
    index_name names[2 * MAX_LEVELS];
    int name_count, levels;
    int64_t low[MAX_LEVELS], high[MAX_LEVELS];       /* where each level ranges */
    double terms;                    /* how often the present expression is evaluated */
    int chain;
} lowering;

void lower_start(lowering *, model *, lower_place, const char *what);
value lower_expression(lowering *, const tree *);
/* A scalar that is not a condition. */
node lower_scalar(lowering *, const tree *, const char *what);
/* `name[indices] … for loops`: fills to->dims, to->at, the output's loops, and puts the indices in sight. */
bool lower_target(lowering *, const statement *, output *);
bool lower_subscript(lowering *, const tree *, subscript *, int64_t *first, int64_t *last);

/* Where a left side that lower_target has read ranges. */
void lower_extent(const model *, const lowering *, const output *, int64_t first[], int64_t last[]);

#endif
