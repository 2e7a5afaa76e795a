/* Reads a model from its text: resolves names, computes constants, lowers equations to the graph and analyses them. */
#ifndef LANG_READ_READ_H
#define LANG_READ_READ_H

#include "lang/model/model.h"

/* Judges the name of a method with its arguments, since lang/ does not know the methods. */
typedef motus_status (*read_method)(const char *name, motus_error *);

/* How a text is read. nudged, varied: as in source.h; the claims of a nudged text are not judged. sides: the shapes of
 * its switches, in the order of switches_find; modes then hold their sides, which the equations read in place of the
 * switches. NULL: they read the switches. */
typedef struct read_how {
    bool nudged;
    const uint8_t *varied;
    size_t varied_count;
    const model_shape *sides;
    uint32_t side_count;
} read_how;

/* Reads a model. On failure the error says what and where, and *out is NULL; the arena keeps what was taken. */
motus_status read_model(arena *, const motus_text_def *, const read_how *, read_method, model **out, motus_error *);

/* Checks exact lines and invariants again after numbers have changed. */
motus_status verify_again(model *, motus_error *);
/* Writes to x and v how far rounding may carry the exact motion at time t off, in units of EXACT_ROUNDING. False: no
 * memory. */
bool verify_exact_rounding(model *, double t, double *x, double *v);

/* Finds the traits that follow from the form of the equations, but for has_exact. */
void analysis_traits(model *);

#endif
