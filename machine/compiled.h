/* The compiled machine: the interpreter's problem, with the acceleration and the steps in machine code. */
#ifndef MACHINE_COMPILED_H
#define MACHINE_COMPILED_H

#include "machine/machine.h"

typedef struct compiled compiled;
/* Nothing is compiled yet: that happens when a row is asked for. The interpreter's problem must outlive it. */
motus_status compiled_create(model *, const problem *interpreted, compiled **, motus_error *);
/* After the model's numbers have changed. */
void compiled_rebind(compiled *);
/* Closes what was loaded; the memory is the model's. */
void compiled_close(compiled *);
/* The C text that runs a row of this model, in the model's arena; NULL: no memory. */
const char *compiled_text(compiled *, const chosen *, size_t *length);
/* Compiles (or finds; with `kept`, only finds) what a row needs. NULL, or why that failed. */
const char *compiled_prepare(compiled *, const chosen *, bool kept);
/* The machine of a row, compiled now if need be. */
motus_status compiled_machine(compiled *, const chosen *, machine *, motus_error *);

#endif
