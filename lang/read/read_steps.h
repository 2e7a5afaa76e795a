/* The steps in which a model is read, in their order; each is a file of its name. They return false after a complaint
 * or without memory. After the fifth, read.c has parameters and initial values computed (lang/lower/). */
#ifndef LANG_READ_READ_STEPS_H
#define LANG_READ_READ_STEPS_H

#include "lang/read/read.h"

bool collect_all(model *, const motus_text_def *); /* statements, with those of --set; the symbol table */
bool rule_names_all(model *);                      /* names of events */
bool mode_find_all(model *);                       /* parameters that events assign */
const span *mode_assigned_at(const model *, const model_definition *); /* where an event assigns it first */
bool classify_all(model *);              /* parameters or quantities; complains about lines without a state */
bool names_all(model *);                 /* complains about names that are not defined */
bool settings_all(model *, read_method); /* method, step, until … */
bool mode_shape_all(model *);            /* their shapes, and places of their starts */
bool layout_all(model *);                /* places of the states in x and v */
bool equations_all(model *);             /* outputs over the graph */
bool mode_observe_all(model *);          /* modes as quantities */
bool rules_all(model *);                 /* events */
void analysis_all(model *);              /* traits of the equations */

#endif
