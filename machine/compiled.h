/* The compiled machine: the interpreter's problem, with the acceleration and the steps in machine code. */
#ifndef MACHINE_COMPILED_H
#define MACHINE_COMPILED_H

#include "machine/machine.h"

typedef struct compiled compiled;
/* Whether this build has such a machine; the page's has none. */
bool compiled_anywhere(void);
/* Compiles nothing yet. The interpreter's problem must outlive it. */
motus_status compiled_create(model *, const problem *interpreted, compiled **, motus_error *);
/* To be called after the model's numbers have changed. */
void compiled_rebind(compiled *);
/* Unloads the objects; the memory is the model's. */
void compiled_close(compiled *);
/* The C text that runs a row of this model, in the model's arena; NULL: no memory. */
const char *compiled_text(compiled *, const chosen *, size_t *length);
/* Loads the object of a row from the cache, or compiles it, unless `kept`. NULL, or why that failed. */
const char *compiled_prepare(compiled *, const chosen *, bool kept);
/* The same without waiting. WAIT: a compiler is at work, and the caller waits for it till it calls compiled_leave;
 * those who wait for the same object share one compiler, which is killed when nobody is left. FAILED: *why says why.
 * Only with READY does compiled_machine not wait. */
typedef enum { COMPILED_READY, COMPILED_WAIT, COMPILED_FAILED } compiled_state;
compiled_state compiled_begin(compiled *, const chosen *, const char **why);
compiled_state compiled_look(compiled *, const chosen *, const char **why); /* after WAIT */
void compiled_leave(compiled *, const chosen *);
void compiled_nap(void); /* between two looks of someone who waits after all */
/* The machine of a row, compiled now where that has not happened before. */
motus_status compiled_machine(compiled *, const chosen *, machine *, motus_error *);

#endif
