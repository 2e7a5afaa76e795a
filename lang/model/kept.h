/* What events keep: count(NAME), time(NAME), time(NAME, 3), time(NAME, last), at(NAME, expr), at(NAME, 3, expr) and
 * at(NAME, last, expr). The words are names of functions in models that have events and define nothing of that name. */
#ifndef LANG_MODEL_KEPT_H
#define LANG_MODEL_KEPT_H

#include "lang/model/model.h"

typedef enum kept_kind { KEPT_NOT, KEPT_COUNT, KEPT_TIME, KEPT_AT } kept_kind;

/* Whether a TREE_APPLY is one of these calls, whatever its arguments. */
kept_kind kept_call(const model *, const tree *);
/* The rule that its first argument names; NULL: it names none. */
const model_rule *kept_rule(const model *, const tree *);
/* Which event it asks for, an expression or the word `last` (kept_is_last); NULL: none is written. */
const tree *kept_which(const model *, const tree *);
bool kept_is_last(const tree *which);
/* What `at` keeps; NULL: it is no `at`. */
const tree *kept_expression(const model *, const tree *);
/* Whether the number of arguments is right. */
bool kept_complete(const model *, const tree *);

#endif
