/* The compiled machine: the interpreter's problem, with the acceleration and the steps in machine code. */
#ifndef MACHINE_COMPILED_H
#define MACHINE_COMPILED_H

#include "machine/machine.h"
#include "machine/ruled.h"

typedef struct compiled compiled;
/* Tells whether this build has a compiled machine; that of the page has none. */
bool compiled_anywhere(void);
/* Creates the machine of a model, and compiles nothing yet. The interpreter's problem must outlive it. */
motus_status compiled_create(model *, const problem *interpreted, compiled **, motus_error *);
/* Takes over the model's numbers after they have changed. */
void compiled_rebind(compiled *);
/* Computes what ruled.h says of all functions of the model's rules, where an object has that. ctx: the machine. */
bool compiled_rules(void *ctx, ruled_number, double t, double *const base[SPACES]);
/* Unloads the objects; the memory is the model's. */
void compiled_close(compiled *);
/* Returns the C text that runs a row of this model, in the model's arena; NULL: no memory. */
const char *compiled_text(compiled *, const chosen *, size_t *length);
/* Loads the object of a row from the cache or, unless `kept`, compiles it. Returns NULL, or why that failed. */
const char *compiled_prepare(compiled *, const chosen *, bool kept);
/* Tells whether the object of a row is that of a text which has a longer one (chosen.written), whose object is faster.
 * Where the cache has that, it is loaded in place of the other. */
bool compiled_longer(compiled *, const chosen *);
typedef enum { COMPILED_READY, COMPILED_WAIT, COMPILED_FAILED } compiled_state;
/* Begins to load or compile the object of a row, without waiting. WAIT: a compiler is at work, and the caller waits for
 * it until it calls compiled_leave; all who wait for one object share a compiler, which is killed when none is left.
 * FAILED: *why gives the reason. After READY compiled_machine does not wait. */
compiled_state compiled_begin(compiled *, const chosen *, const char **why);
compiled_state compiled_look(compiled *, const chosen *, const char **why); /* after WAIT */
void compiled_leave(compiled *, const chosen *);
void compiled_nap(void); /* sleeps for a moment, between two looks */
/* Tells the machine of a row, which is compiled first if there is no object yet. */
motus_status compiled_machine(compiled *, const chosen *, machine *, motus_error *);

#endif
