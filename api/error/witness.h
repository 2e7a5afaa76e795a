/* A witness of a run: holds its motion against the force as it is typed.
 *
 * Run and companion have the same force, often one that was rewritten for them: with sides in place of switches, values
 * that hold what sticks, series. Where that force is not the typed one, or where both step over what happens between
 * the places at which they evaluate it, they agree on a wrong motion. The witness shares none of it: it has the typed
 * equations, evaluated by the tape, along the dense output of every step that it looks at.
 *
 * What it finds missing of a step is looked at more closely, by a probe: a stepper of the method that takes the step
 * once more in as many parts as the force asks for. Where both ends are farther apart than the run's tolerance allows,
 * the run takes the step again as the probe did. Where they are farther apart than the errors told so far, the
 * companion is moved by the difference, so that the bars cover it from then on. Steps that are not found by their
 * errors stand; in their place the companion is led by a probe through what they do not show, and across switches.
 */
#ifndef API_ERROR_WITNESS_H
#define API_ERROR_WITNESS_H

#include "api/motion/run.h"
#include "machine/differences.h"

typedef struct witness witness;

/* Of a run that has its stepper, whose steps it looks at from now on, and what is known of the run's errors; many: it
 * is one of many, each of which is looked at less. *out NULL: the run is none that it can look at. witness_begin: of
 * another motion of the same run, which begins at its stepper. */
motus_status witness_create(const motus_run *, const differences *, bool many, witness **out, motus_error *);
void witness_begin(witness *, const motus_run *);
void witness_destroy(witness *);
/* Whether a companion is to be moved, where the run stands. */
bool witness_waits(const witness *);
/* How the companion is to be moved; false: it is not. `from` NaN: at the end of the step that the run has taken last,
 * by these nx and nv numbers in the inside order; else witness_lead takes that step, which began at `from`, in place of
 * the companion. And that this was done. */
typedef struct witness_move {
    double from;
    const double *x, *v;
} witness_move;
bool witness_moves(const witness *, witness_move *);
void witness_moved(witness *);
/* From the state x, v at t to that at `until`. False: no way leads there. */
bool witness_lead(witness *, double t, double until, double *x, double *v);
/* It leaves the companion as it is, from now on. */
void witness_leave(witness *);
/* Whether it has found that a step differs from what the force does within it by what counts; where it leaves the
 * companion, by more than that shows at the end of the step. The companion has come as far as the run. */
bool witness_objected(witness *);
/* The part of the run's steps that its witness has looked at, or need not; NaN: it has none. */
double witness_looked(const motus_run *);
/* The time from which on it could not look at steps, although it had just seen more in some than they show: of what the
 * force does there nothing is known. NaN: there is none. */
double witness_unseen(const witness *);
/* The time near which no step keeps to the typed force; NaN: there is none. *number: of the typed system, the velocity
 * on which another force acts from there on, whatever sides the switches have; SIZE_MAX: none is known. */
double witness_differs(const witness *, size_t *number);

#endif
