/* The sides of a model's switches as internal rules, which events follow so that every step of a method ends where the
 * force changes its formula.
 *
 * The model has been read with modes for its sides (lang/model/switches.h). Behind the rules of its text there is an
 * internal rule for each kind of switch, with an instance for each cell. Its function is positive while the argument is
 * on its side, and falls to 0 where the argument leaves it.
 */
#ifndef MACHINE_SIDES_H
#define MACHINE_SIDES_H

#include "core/rules.h"
#include "lang/model/model.h"

typedef struct sides sides;

/* Creates the sides of a model that has some, in its arena. own: the rules of its text, NULL: it has none. The rules
 * and the model's problem must outlive the sides. */
motus_status sides_create(model *, const rules *own, const problem *, sides **, motus_error *);
const rules *sides_rules(const sides *);
/* Tells whether a direction at this state is that of friction, which drives its vector to 0. */
bool sides_rub(sides *, double t, const double *x, const double *v);
/* Takes over the model's numbers after they have changed. False: no memory. */
bool sides_rebind(sides *);

#endif
