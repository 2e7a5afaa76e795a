/* Reads a model from its text: resolves names, computes constants, lowers equations to the graph and analyses them. */
#ifndef LANG_READ_READ_H
#define LANG_READ_READ_H

#include "lang/model/model.h"

/* Whether there is a method of this name, with its arguments; else the error says so. lang/ does not know the methods.
 */
typedef motus_status (*read_method)(const char *name, motus_error *);

/* On failure the error says what and where, and *out is NULL; the arena keeps what was taken. */
motus_status read_model(arena *, const motus_text_def *, read_method, model **out, motus_error *);

/* Checks the exact line again after numbers have changed; takes no memory. */
motus_status analysis_exact(model *, motus_error *);

/* Finds the traits of the model's equations that follow from their form, but for has_exact. */
void analysis_traits(model *);

#endif
