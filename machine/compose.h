/* The C text of a compiled model: what it is made of, in order, for one trajectory and for lanes. */
#ifndef MACHINE_COMPOSE_H
#define MACHINE_COMPOSE_H

#include "lang/emit/emit.h"
#include "lang/emit/emit_local.h"
#include "lang/model/model.h"
#include "core/methods.h"

/* Most operations of a graph in one text: compilers take more than linear time, and minutes beyond this. */
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
    const locality *locality; /* of the force, if it may be computed window by window; else NULL */
    bool bounds;              /* a program is "compiled_least": bounds of the functions of the model's rules */
    bool rules;               /* programs are all that is computed of these functions (ruled.h) */
    bool written;             /* stages are written out even where that takes a compiler long */
    bool solves;              /* lanes: the row solves equations, by solve_text.h */
    bool own_clock;           /* lanes: each trajectory has a time and a step of its own */
    int width, groups;        /* lanes: trajectories in one vector, vectors side by side; width 0: one trajectory */
    const char *glue;         /* C text between the programs and the texts of step/, or NULL */
    const char *const *last;  /* the texts that stand last, up to a NULL */
} composition;

/* Tells whether a state has few numbers, and as many in every run, so that they may stay in registers. */
bool compose_small(const model *);
/* Tells whether the text asks after every step whether an event may have happened in it. */
bool compose_watched(const model *, const chosen *);
/* Tells whether the functions of the model's rules are the same in every run. */
bool compose_bounds_are_structure(const model *);
/* Returns the number of doubles in the widest vector of this processor: 1, 2, 4 or 8. */
int compose_width(void);
/* Writes the text into e->text and e->moments; e->lanes and e->varied must be set. False: no memory. */
bool compose(emit *e, const composition *);

#endif
