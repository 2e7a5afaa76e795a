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

/* resolve.c, for start.c: room in the pool; an array's shape, returning its count; the hull of a left side; a statement's components run
 * into the pool as an array of that hull; the cells of a left side in a map over the hull, raised to `as`, or once only. */
bool resolve_pool(model *, size_t count, size_t *first);
size_t resolve_shape(array *, space, size_t base, int dims, const int64_t first[], const int64_t last[]);
void resolve_target(const model *, const lowering *, const output *, int64_t first[], int64_t last[]);
bool resolve_into_pool(model *, const output *, value, size_t base, const int64_t first[], const int64_t last[], size_t hull);
bool resolve_mark(model *, const model_state *, const statement *, const int64_t first[], const int64_t last[], uint8_t *map, uint8_t as, bool once);

#endif
