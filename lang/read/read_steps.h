/* The steps in which a model is read, in their order; each is a file of its name. They return false after a complaint
 * or without memory. After names_all, read.c computes parameters and initial values (lang/lower/). */
#ifndef LANG_READ_READ_STEPS_H
#define LANG_READ_READ_STEPS_H

#include "lang/read/read.h"

bool collect_all(model *, const motus_text_def *); /* statements, with those of --set, and the symbol table */
bool rule_names_all(model *);                      /* names of events */
bool mode_find_all(model *);                       /* parameters that events assign */
bool mode_add_sides(model *, const read_how *);    /* sides of switches */
bool classify_all(model *);              /* what is a parameter, and what a quantity; refuses lines without a state */
bool names_all(model *);                 /* complaints about names that are not defined */
bool settings_all(model *, read_method); /* method, step, until … */
bool mode_shape_all(model *);            /* the shapes of modes, and places of their starts */
bool layout_all(model *);                /* places of the states in x and v */
bool equations_all(model *);             /* outputs over the graph */
bool mode_observe_all(model *);          /* modes as quantities */
bool when_all(model *);                  /* events */
bool keep_all(model *);                  /* the modes in which events keep numbers, and their assignments */
bool effects_all(model *);               /* what events change */
bool equations_start(model *);           /* boundary cells at the start */
void analysis_all(model *);              /* traits of the equations */

#define COMPLAIN(m, at, ...) (source_complain(&(m)->source, MOTUS_SHAPE, (at), __VA_ARGS__))
#define HINT(m, ...) (source_hint(&(m)->source, __VA_ARGS__))

static inline const char *quote(const model *m, const span *at, char out[80])
{
    return source_excerpt(&m->source, at, out, 80);
}

/* Parts of the steps. */
const span *mode_assigned_at(const model *, const model_definition *); /* where an event first assigns it */
bool layout_finish(model *);                                           /* what follows from the places of the states */
/* Complains that there is no event of a name, and hints at a likely one; name NULL: the place has none. */
bool rule_names_unknown(model *, const span *at, const char *name);
bool when_add(model *, model_rule *, const model_assignment *);

#endif
