/* The C text of a compiled model: what it is made of, in order. Both compiled machines, for one trajectory and for
 * lanes, are made here. */
#ifndef MACHINE_COMPOSE_H
#define MACHINE_COMPOSE_H

#include "lang/emit/emit.h"
#include "lang/emit/emit_local.h"
#include "lang/model/model.h"
#include "core/methods.h"

/* of a graph, in one text: compilers take more than linear time, and minutes beyond this */
enum { OPERATIONS_MAX = 20000 };

typedef struct composed_program {
    const program *program;
    const char *name;
    bool terms;
    bool series; /* in Taylor series */
    bool along;  /* it reads a direction, or the widths of a box */
} composed_program;

typedef struct composition {
    const model *model;
    const problem *problem;
    const chosen *chosen;
    const composed_program *programs; /* "compiled_force" first, where the text has one */
    size_t program_count;
    const locality *locality; /* of the force, where it may be taken window by window; NULL */
    bool bounds;              /* "compiled_least" is among them: bounds of the functions of the model's rules */
    bool solves;              /* lanes: the row solves equations, by solve_text.h */
    bool own_clock;           /* lanes: each has a time and a step of its own */
    /* lanes: trajectories in one vector, vectors side by side; width 0: one trajectory */
    int width, groups;
    const char *glue;        /* C text between the programs and the texts of step/, or NULL */
    const char *const *last; /* the texts that stand last, up to a NULL */
} composition;

/* Whether a state has so few numbers, the same in every run, that they may stay in registers. */
bool compose_small(const model *);
/* Whether the functions of the model's rules are the same in every run. */
bool compose_bounds_are_structure(const model *);
/* Doubles in the widest vector that this machine has an instruction for: 1, 2, 4 or 8. */
int compose_width(void);
/* Writes into e->text, and e->moments; e->lanes and e->varied must be set. False: the arena failed. */
bool compose(emit *e, const composition *);

#endif
