/* A model from its text: names are resolved, constants computed, equations lowered to the graph and analysed. */
#ifndef LANG_READ_READ_H
#define LANG_READ_READ_H

#include "lang/model/model.h"

/* On failure the error says what and where, and *out is NULL; the arena holds whatever was taken. */
motus_status read_model(arena *, const motus_text_def *, model **out, motus_error *);

#endif
