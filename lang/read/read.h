/* Reads a model from its text: resolves names, computes constants, lowers equations to the graph and analyses them. */
#ifndef LANG_READ_READ_H
#define LANG_READ_READ_H

#include "lang/model/model.h"

/* Whether there is a method of this name, with its arguments; else the error says so. lang/ does not know the methods.
 */
typedef motus_status (*read_method)(const char *name, motus_error *);

/* How a text is read. nudged, varied: as in source.h; a nudged text's claims are not judged. sides: the shapes of its
 * switches, in the order of switches_find; their sides are modes then, which the equations read in place of the
 * switches. NULL: no. */
typedef struct read_how {
    bool nudged;
    const uint8_t *varied;
    size_t varied_count;
    const model_shape *sides;
    uint32_t side_count;
} read_how;

/* On failure the error says what and where, and *out is NULL; the arena keeps what was taken. */
motus_status read_model(arena *, const motus_text_def *, const read_how *, read_method, model **out, motus_error *);

/* Checks exact lines and invariants again after numbers have changed. */
motus_status verify_again(model *, motus_error *);
/* How far rounding may carry the exact motion at time t off, in units of EXACT_ROUNDING, written to x and v. False: no
 * memory. */
bool verify_exact_rounding(model *, double t, double *x, double *v);

/* Finds the traits of the model's equations that follow from their form, but for has_exact. */
void analysis_traits(model *);

#endif
