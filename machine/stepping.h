/* An engine that is the library's stepper: what the interpreter and the callback machine share. */
#ifndef MACHINE_STEPPING_H
#define MACHINE_STEPPING_H

#include "machine/machine.h"

motus_status stepping_open(const problem *, const chosen *, double t0, double h, const double *x, const double *v, const motus_allocator *, engine **,
                           motus_error *);
void stepping_close(engine *);
motus_status stepping_advance(engine *, int64_t steps, motus_error *);
motus_status stepping_trace(engine *, const tracer *, motus_error *);
motus_status stepping_sync(engine *, double *x, double *v, double *a, motus_error *);
int64_t stepping_steps(const engine *);
int64_t stepping_evaluations(const engine *);
int64_t stepping_iterations(const engine *);
size_t stepping_carry(const engine *);
void stepping_save(const engine *, double *carry);
motus_status stepping_load(engine *, int64_t step, int64_t evaluations, int64_t iterations, const double *carry, motus_error *);

#define STEPPING_BUT_OPEN                                                                                                          \
    .close = stepping_close, .advance = stepping_advance, .trace = stepping_trace, .sync = stepping_sync, .steps = stepping_steps, \
    .evaluations = stepping_evaluations, .iterations = stepping_iterations, .carry = stepping_carry, .save = stepping_save,        \
    .load = stepping_load
#define STEPPING .open = stepping_open, STEPPING_BUT_OPEN

#endif
