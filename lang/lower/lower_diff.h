/* What lower_diff.c and lower_cells.c share: a derivative while it is made. */
#ifndef LANG_LOWER_LOWER_DIFF_H
#define LANG_LOWER_LOWER_DIFF_H

#include "lang/lower/lower_parts.h"

/* The derivative of a cell of a family by another, while it is not known yet what becomes of it: a leaf. */
typedef struct cell {
    node leaf;
    reference of;
} cell;

typedef struct differential {
    lowering *l;
    const tree *call;
    node variable;
    cell *cells; /* leaf k is number first_leaf + k of the model's */
    uint32_t cell_count, cell_room;
    int32_t first_leaf;
    node *of_slot;     /* of a parameter's slot: 1 + its derivative, 0 not known yet; NULL: not needed yet */
    uint32_t *line;    /* 1 + the line of the log that computed the parameter in a slot, 0 none */
    int chain;         /* parameters being differentiated, one within the other */
    uint8_t *affected; /* by place of the pool: whether it follows from the variable; NULL: not needed yet */
} differential;

/* A leaf that nothing else has, in place of what is not known yet. */
node lower_own_leaf(lowering *);

/* lower_cells.c: the derivative of a cell by the variable's cell, for the time being */
node lower_cell(differential *, const reference *of);
/* … and a derivative with what becomes of these leaves. */
node lower_cells(differential *, node);

#endif
