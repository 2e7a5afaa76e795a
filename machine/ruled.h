/* What supplies rules (core/rules.h) for a model: tapes of the functions that its events watch, and of what each does.
 */
#ifndef MACHINE_RULED_H
#define MACHINE_RULED_H

#include "core/rules.h"
#include "lang/model/model.h"

typedef struct ruled ruled;

/* In the model's arena, for a model that has rules. */
motus_status ruled_create(model *, ruled **, motus_error *);
const rules *ruled_rules(const ruled *);
/* To be called after the model's numbers have changed. False: no memory. */
bool ruled_rebind(ruled *);

#endif
