/* What a run and an ensemble choose alike: the method, and the machine. */
#ifndef API_CHOICE_H
#define API_CHOICE_H

#include "api/system.h"

/* The method by its name (NULL: the model's, or verlet), if it admits the system; what only sampled states can tell
 * is found out first. */
motus_status choice_method(motus_system *, const char *name, chosen *, const motus_method **card, motus_error *);
/* "auto" (or NULL), "interpreter" or "compiled"? */
motus_status choice_machine(const char *wanted, bool *automatic, bool *compiled, motus_error *);
/* Compiles the model for a method, or finds it compiled; with `kept`, only finds. *why: NULL, and *out is the
 * machine; or why there is none: where it was asked for by name (`must`), that is an error. */
motus_status choice_compile(motus_system *, const chosen *, bool must, bool kept, machine *out, const char **why,
                            motus_error *);
/* Whether so many steps of a model are worth a compiler's time: 1 and more; from CHOICE_LOOK on it is worth a look
 * whether that was done before. */
double choice_worth(const motus_system *, const motus_method *, double steps);
#define CHOICE_LOOK 0.01

#endif
