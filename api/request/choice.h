/* The choice of the machine, the same for runs and ensembles. */
#ifndef API_REQUEST_CHOICE_H
#define API_REQUEST_CHOICE_H

#include "api/system/system.h"

/* Reads the name of a machine: "auto", "interpreter" (or NULL) or "compiled". */
motus_status choice_machine(const char *wanted, bool *automatic, bool *compiled, motus_error *);
/* Compiles the model for a method, or finds it compiled; with `kept` it only searches. *why: NULL, and *out is the
 * machine; or the reason why there is none, which is an error where the caller asked for it by name (`must`). */
motus_status choice_compile(motus_system *, const chosen *, bool must, bool kept, machine *out, const char **why,
                            motus_error *);
/* The same without waiting for a compiler: READY, and *out is the machine; FAILED, and *why says why; or WAIT: look
 * again, or leave. */
motus_status choice_begin(motus_system *, const chosen *, compiled_state *, machine *out, const char **why,
                          motus_error *);
motus_status choice_look(motus_system *, const chosen *, compiled_state *, machine *out, const char **why,
                         motus_error *);
void choice_leave(motus_system *, const chosen *);
/* The operations of the equations, in all cells and all terms of sums. MOTUS_MEMORY. */
motus_status choice_weigh(motus_system *, weight *, motus_error *);
/* Those of an evaluation, with what the method adds; of a step by a Taylor series to this order; and of a step, by
 * any method. */
double choice_evaluation(const problem *, const weight *, const motus_method *);
double choice_expansion(const problem *, const weight *, double order);
double choice_step(const problem *, const weight *, const chosen *, const motus_method *);
/* The work of so many steps relative to the compiler's. At 1 and more compiling pays; at CHOICE_KEPT and more it
 * pays to search for an object that was compiled before. */
double choice_worth(const motus_system *, const chosen *, const motus_method *, double steps);
#define CHOICE_KEPT 0.01

#endif
