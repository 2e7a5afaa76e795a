/* A witness of a run: holds its motion against the force as it is typed.
 *
 * Run and companion have the same force, often one that was rewritten for them: with sides in place of switches, values
 * that hold what sticks, series. Where that force is not the typed one, or both step over what happens between the
 * places at which they evaluate it, they agree on a wrong motion. The witness shares none of that: it evaluates the
 * typed equations by the tape, along the dense output of every step that it looks at.
 *
 * Where it finds something missing from a step, a probe looks more closely: a stepper of the method that takes the step
 * once more, in as many parts as the force asks for. If the ends are farther apart than the run's tolerance allows, the
 * run takes the step again. If they are farther apart than the errors so far, the companion is moved by the difference,
 * so that the bars cover it from then on. Steps that no error control refuses stand; in their place a probe leads the
 * companion through what they do not show, and across switches.
 */
#ifndef API_ERROR_WITNESS_H
#define API_ERROR_WITNESS_H

#include "api/motion/run.h"
#include "machine/differences.h"

typedef struct witness witness;

/* Makes the witness of a run that has its stepper, and looks at its steps from now on. differences: what is known of
 * the run's errors; many: the run is one of many, each of which is looked at less. *out NULL: it cannot look at such a
 * run. */
motus_status witness_create(const motus_run *, const differences *, bool many, witness **out, motus_error *);
/* Begins anew for another motion of the run, from the stepper's state. */
void witness_begin(witness *, const motus_run *);
void witness_destroy(witness *);
/* Returns whether the companion is to be moved where the run stands. */
bool witness_waits(const witness *);
/* How the companion is to be moved. */
typedef struct witness_move {
    double from;         /* NaN: by x and v; else where the run's last step began, which witness_lead is to take */
    const double *x, *v; /* nx and nv numbers in the inside order, for the end of the run's last step */
} witness_move;
/* Tells how the companion is to be moved. False: it is not. */
bool witness_moves(const witness *, witness_move *);
/* Notes that the companion was moved. */
void witness_moved(witness *);
/* Leads from the state x, v at t to that at `until`. False: no way leads there. */
bool witness_lead(witness *, double t, double until, double *x, double *v);
/* Leaves the companion as it is, from now on. */
void witness_leave(witness *);
/* Returns whether a step differs from what the force does within it by an amount that counts; where the companion is
 * left as it is, by more than the end of the step shows. The companion has come as far as the run. */
bool witness_objected(witness *);
/* Returns the part of the run's steps that the witness has looked at, or need not. NaN: the run has no witness. */
double witness_looked(const motus_run *);
/* Returns the time from which on the witness could not afford to look at steps, although steps before had hidden
 * something: what the force does there is not known. NaN: there is none. */
double witness_unseen(const witness *);
/* Returns the time near which no step keeps to the typed force; NaN: there is none. *number: the velocity of the typed
 * system on which another force acts from there on, whatever sides the switches have; SIZE_MAX: not known. */
double witness_differs(const witness *, size_t *number);

#endif
