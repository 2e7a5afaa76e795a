/* One trajectory of a problem by a row, on one core, from a callback: the texts of step/ with real = double.
 *
 * Invariant: time is t0 + n h, never summed. The main line (merged kicks, increments d) is never touched by looking: `stepper_sync`
 * works on the side, so the bits of a trajectory do not depend on when it was looked at.
 */
#ifndef CORE_STEPPER_H
#define CORE_STEPPER_H

#include "core/trace.h"

typedef struct stepper stepper;

/* Starts at (t0, x, v) (nx, nv numbers, copied) with step h != 0 (negative: backward). */
motus_status stepper_create(const problem *, const chosen *, double t0, double h, const double *x, const double *v,
                            const motus_allocator *, stepper **, motus_error *);
void stepper_destroy(stepper *);

/* `steps` more steps. DIVERGED, SOLVE and CALLBACK name time and variable; the stepper then stays at the last good step. */
motus_status stepper_advance(stepper *, int64_t steps, motus_error *);
/* One step, to the same bits, and what happens in it is told. */
motus_status stepper_trace(stepper *, const tracer *, motus_error *);
/* The state at the present time, velocities synchronised. x, v of nx, nv numbers; a (may be NULL): the acceleration there. */
motus_status stepper_sync(stepper *, double *x, double *v, double *a, motus_error *);

double stepper_time(const stepper *);
int64_t stepper_steps(const stepper *);
int64_t stepper_evaluations(const stepper *);      /* by the method itself; looking is not counted */
int64_t stepper_iterations(const stepper *);

/* Everything that the next step needs, as `stepper_carry` numbers: saved and loaded into a stepper created alike, the run
 * goes on to the same bits. The counters travel too. */
size_t stepper_carry(const stepper *);
void stepper_save(const stepper *, double *carry);
motus_status stepper_load(stepper *, int64_t step, int64_t evaluations, int64_t iterations, const double *carry, motus_error *);

#endif
