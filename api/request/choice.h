/* The choice of the machine, for runs and ensembles. */
#ifndef API_REQUEST_CHOICE_H
#define API_REQUEST_CHOICE_H

#include "api/system/system.h"

/* Reads the name of a machine: "auto", "interpreter" (or NULL) or "compiled". */
motus_status choice_machine(const char *wanted, bool *automatic, bool *compiled, motus_error *);
/* Compiles the model for a method, or finds it compiled; with `kept` it only searches. *why: NULL, and *out is the
 * machine; or why there is none, which is an error if `must`. */
motus_status choice_compile(motus_system *, const chosen *, bool must, bool kept, machine *out, const char **why,
                            motus_error *);
/* Begins to compile, and does not wait: READY, *out is the machine; FAILED, *why says why; WAIT: call choice_look
 * again, or choice_leave. */
motus_status choice_begin(motus_system *, const chosen *, compiled_state *, machine *out, const char **why,
                          motus_error *);
motus_status choice_look(motus_system *, const chosen *, compiled_state *, machine *out, const char **why,
                         motus_error *);
void choice_leave(motus_system *, const chosen *);
/* Counts the operations of the equations, in all cells and all terms of sums. MOTUS_MEMORY. */
motus_status choice_weigh(motus_system *, weight *, motus_error *);
/* Estimate the operations of one evaluation, with those of the method; of one step by a Taylor series of this order;
 * and of one step by any method. */
double choice_evaluation(const problem *, const weight *, const motus_method *);
double choice_expansion(const problem *, const weight *, double order);
double choice_step(const problem *, const weight *, const chosen *, const motus_method *);
/* Divides the work of `steps` steps by that of the compiler. From 1 on compiling pays; from CHOICE_KEPT on it pays to
 * search for an object that was compiled before. */
double choice_worth(const motus_system *, const chosen *, const motus_method *, double steps);
#define CHOICE_KEPT 0.01

#endif
