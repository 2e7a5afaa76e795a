/* A system behind the public handle: a problem, its machine, and the numbering of what can be looked at.
 *
 * Two orders of the same numbers: inside, x and v as lang/model/model.h lays them out (component by component,
 * boundary cells included); outside, variable by variable, cell by cell, component by component, without boundary
 * cells.
 */
#ifndef API_SYSTEM_H
#define API_SYSTEM_H

#include "api/check.h"
#include "base/modes.h"
#include "machine/compiled.h"

typedef struct column_group { /* columns of one name */
    motus_column_kind kind;
    bool prime;    /* velocity of a variable, exact or not */
    uint32_t item; /* number of the state or definition */
    size_t first, count;
} column_group;

struct motus_system {
    motus_allocator allocator;
    arena arena;
    model *model; /* NULL: a callback */
    interpreter *interpreter;
    motus_text_def text; /* what it was read from, in the arena */
    motus_callback_def callback;
    calling calling;
    problem problem;
    machine machine;    /* the interpreter, or the callback */
    compiled *compiled; /* once a run asks for it */
    double start;
    double *x0, *v0;
    model_state *states;
    uint32_t state_count; /* the model's, or stand-ins for a callback's numbers */
    model_definition *definitions;
    uint32_t definition_count; /* likewise */
    size_t positions, velocities;
    column_group *groups;
    size_t group_count, column_count;
    double *look; /* room for any one quantity or invariant; of a callback, for all of either */
    double *exact_x, *exact_v;
    bool sampled_gyroscopic, sampled_gradient;
    size_t held; /* by so many: set.c */
    struct setting *settings;
    const char *explanation[2][2]; /* by what sampling found: gyroscopic, gradient */
    char *equation;
    char *mathml; /* of the statement asked for last, from the hooks */
};

/* Finds out what needs sampled states; called when someone asks. False: no memory, and it is not known yet. */
bool system_sample_gyroscopic(motus_system *);
/* defaults.c. Structs with a size; and how one fits that says its own, where versions had these, the last one
 * today's. */
typedef enum defaults_fit { SIZE_FITS, SIZE_MISSING, SIZE_UNKNOWN, SIZE_ASKS_MORE } defaults_fit;
defaults_fit defaults_judge(const uint32_t *sizes, size_t count, const void *made);
/* Between the two orders. */
void system_outside(const motus_system *, const double *x, const double *v, double *out_x, double *out_v);
void system_inside(const motus_system *, const double *in_x, const double *in_v, double *x, double *v);
/* Values of columns at a state (inside order; boundary cells may be refreshed). */
motus_status system_values(motus_system *, double t, double *x, double *v, const size_t *columns, size_t count,
                           double *out, motus_error *);
bool system_number_columns(motus_system *);
/* The place in x, or in v, of column 1 + outer. */
size_t system_number(const motus_system *, size_t outer, bool of_v);
/* The quantity or invariant of a column, and which of its numbers, in the inside order, that is. */
const model_definition *system_definition(const motus_system *, size_t column, size_t *number);
size_t system_place(const model_state *, size_t cell, int component);

#endif
