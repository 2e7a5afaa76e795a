/* The rules of a model (core/rules.h): tapes of the functions that its events watch, and of their actions. */
#ifndef MACHINE_RULED_H
#define MACHINE_RULED_H

#include "core/rules.h"
#include "lang/model/model.h"

typedef struct ruled ruled;

/* Creates the rules of a model that has some, in its arena. */
motus_status ruled_create(model *, ruled **, motus_error *);
const rules *ruled_rules(const ruled *);
/* Takes over the model's numbers after they have changed. False: no memory. */
bool ruled_rebind(ruled *);

#endif
