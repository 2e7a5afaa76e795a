/* The names of a model: what each stands for, and what an unknown one was probably meant to be. */
#ifndef LANG_MODEL_SYMBOLS_H
#define LANG_MODEL_SYMBOLS_H

#include "lang/model/model.h"

typedef struct symbol { model_state *state; model_definition *definition; } symbol;      /* one of them, or neither: unknown */

symbol symbols_find(const model *, const char *name);
/* A name that is not in the table yet. */
void symbols_enter(model *, const char *name, symbol);
/* The hint that goes with "NAME is not defined"; more: other names that are in sight there. */
void symbols_suggest(model *, const char *name, const char *const *more, uint32_t more_count);

#endif
