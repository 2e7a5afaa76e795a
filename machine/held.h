/* The interpreter with the switches of a model held on given sides: lang/model/switches.h.
 *
 * Its problem is smooth. Runs of one system share it; each binds its own sides before it computes.
 */
#ifndef MACHINE_HELD_H
#define MACHINE_HELD_H

#include "lang/model/resolution.h"
#include "lang/model/switches.h"
#include "machine/machine.h"

typedef struct held held;

/* In the model's arena. *out is NULL where there is nothing to hold and nothing that a step could fail to resolve, or
 * where the switches cannot be held; *refused then says why, a part of a sentence, or is NULL. */
motus_status held_create(model *, held **out, const char **refused, motus_error *);
const problem *held_problem(const held *);
size_t held_count(const held *); /* switches */
operation held_operation(const held *, size_t k);
/* Where switch k changes its side, as switches_surface tells it. */
void held_surface(const held *, size_t k, char *out, size_t size);

size_t held_touches(const held *); /* see switches.h */

/* Computes with these sides from now on. `fresh`: the model's numbers may have changed. False: no memory. */
bool held_bind(held *, const double *sides, bool fresh);
/* The arguments of all switches as the equations have them; as they are on the sides bound; and the rates of these
 * along the motion. NaN: not defined there. */
void held_arguments(held *, double t, double *x, double *v, double *out);
void held_values(held *, double t, double *x, double *v, double *out);
void held_rates(held *, double t, double *x, double *v, double *a, double *out);
/* The arguments of all touches on the sides bound, and their rates. */
void held_touch(held *, double t, double *x, double *v, double *out);
void held_touch_rates(held *, double t, double *x, double *v, double *a, double *out);
/* Whether a step over these times and states resolves the force: lang/model/resolution.h. */
bool held_resolves(const held *); /* there is something to resolve */
bool held_fits(held *, interval t, interval *x, interval *v);
/* Over the same, with accelerations a: between which values the arguments of all switches are, on the sides bound, and
 * their rates; NaN: not defined. */
void held_reach(held *, interval t, interval *x, interval *v, interval *a, interval *argument, interval *rate);
/* By how much rounding of the time, of a state and of the operations may have changed each argument. */
void held_rounding(held *, double t, double *x, double *v, double *out);
/* The same of the accelerations: the largest of all, half of its bound. room: nv numbers. */
double held_force_rounding(held *, double t, double *x, double *v, double *room);

#endif
