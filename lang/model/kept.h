/* What events keep: count(NAME), time(NAME), time(NAME, 3), time(NAME, last), at(NAME, expr), at(NAME, 3, expr) and
 * at(NAME, last, expr). These words name functions in models that have events and define nothing of that name. */
#ifndef LANG_MODEL_KEPT_H
#define LANG_MODEL_KEPT_H

#include "lang/model/model.h"

typedef enum kept_kind { KEPT_NOT, KEPT_COUNT, KEPT_TIME, KEPT_AT } kept_kind;

/* Returns which of these calls a TREE_APPLY is, whatever its arguments. */
kept_kind kept_call(const model *, const tree *);
/* Returns the rule that its first argument names, or NULL. */
const model_rule *kept_rule(const model *, const tree *);
/* Returns which event it is about, an expression or the word `last` (kept_is_last); NULL: that is not written. */
const tree *kept_which(const model *, const tree *);
bool kept_is_last(const tree *which);
/* Returns the expression that `at` keeps; NULL: it is no `at`. */
const tree *kept_expression(const model *, const tree *);
/* Returns whether the number of arguments is right. */
bool kept_complete(const model *, const tree *);

#endif
