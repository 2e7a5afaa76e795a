/* What lower_diff.c and lower_cells.c share: a derivative while it is made. */
#ifndef LANG_LOWER_LOWER_DIFF_H
#define LANG_LOWER_LOWER_DIFF_H

#include "lang/lower/lower_parts.h"

/* A leaf for the derivative of a cell of a family by another cell, until that is known. */
typedef struct cell {
    node leaf;
    reference of;
} cell;

typedef struct differential {
    lowering *l;
    const tree *call;
    node variable;
    cell *cells; /* leaf k is leaf first_leaf + k of the model */
    uint32_t cell_count, cell_room;
    int32_t first_leaf;
    node *of_slot;     /* by slot of a parameter: 1 + its derivative, 0: not known yet; NULL: not needed yet */
    uint32_t *line;    /* by slot of a parameter: 1 + the line of the log that computed it, 0: none */
    int chain;         /* how many nested parameters are being differentiated */
    uint8_t *affected; /* by place of the pool: whether it follows from the variable; NULL: not needed yet */
} differential;

/* Makes a new leaf, which stands for what is not known yet. */
node lower_own_leaf(lowering *);

/* lower_cells.c: lower_cell returns the leaf for the derivative of a cell; lower_cells replaces these leaves in a
 * derivative. */
node lower_cell(differential *, const reference *of);
node lower_cells(differential *, node);

#endif
