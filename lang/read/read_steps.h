/* The steps in which a model is read. Each is a file of its name, and each returns false after a complaint or where there is no memory.
 * Between the second and the third, read.c has the parameters and the initial values computed (lang/lower/). */
#ifndef LANG_READ_READ_STEPS_H
#define LANG_READ_READ_STEPS_H

#include "lang/model/model.h"

bool collect_all(model *, const motus_text_def *);     /* text → statements, states and definitions by name */
bool classify_all(model *);                            /* definition → parameter or quantity */
bool settings_all(model *);                            /* method, step, until … */
bool layout_all(model *);                              /* places in x and v */
bool equations_all(model *);                           /* statements → outputs over the graph */
void analysis_all(model *);                            /* what follows from the equations' form */

#endif
