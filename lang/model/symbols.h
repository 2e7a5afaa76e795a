/* The symbol table: the state, definition or function that a name means, and hints for an unknown name. */
#ifndef LANG_MODEL_SYMBOLS_H
#define LANG_MODEL_SYMBOLS_H

#include "lang/model/model.h"

/* One of them is set, or none if the name is unknown. */
typedef struct symbol {
    model_state *state;
    model_definition *definition;
    model_function *function;
} symbol;

symbol symbols_find(const model *, const char *name);
/* Adds a name that is not in the table yet. */
void symbols_enter(model *, const char *name, symbol);
/* Adds a hint to the complaint that a name is not defined; more: other names that may stand there. */
void symbols_suggest(model *, const char *name, const char *const *more, uint32_t more_count);
/* Adds the hint for a name with a bracket after it. */
void symbols_suggest_call(model *, const char *name);

#endif
