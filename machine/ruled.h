/* The rules of a model (core/rules.h): tapes of the functions that its events watch, and of their actions. */
#ifndef MACHINE_RULED_H
#define MACHINE_RULED_H

#include "core/rules.h"
#include "lang/model/model.h"

typedef struct ruled ruled;

/* What is computed of all functions. LEAST and LEAST_RATES are lower bounds on the sizes of values and rates on a box;
 * ROUNDING is in units of 2^-53. */
typedef enum ruled_number {
    RULED_VALUES,
    RULED_RATES,
    RULED_ROUNDING,
    RULED_LEAST,
    RULED_LEAST_RATES,
    RULED_NUMBERS
} ruled_number;
/* Makes the outputs of them, in the model's arena. False: no memory. */
bool ruled_outputs(model *, output *of[RULED_NUMBERS], size_t *count);

/* Creates the rules of a model that has some, in its arena. */
motus_status ruled_create(model *, ruled **, motus_error *);
const rules *ruled_rules(const ruled *);
/* Lets something faster than tapes compute them, to the same bits. False: it does not now, and a tape does. */
typedef bool (*ruled_faster)(void *ctx, ruled_number, double t, double *const base[SPACES]);
void ruled_use(ruled *, ruled_faster, void *ctx);
/* Takes over the model's numbers after they have changed. False: no memory. */
bool ruled_rebind(ruled *);

#endif
