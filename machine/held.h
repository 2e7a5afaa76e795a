/* The interpreter with the switches of a model held on given sides (lang/model/switches.h), so that its problem is
 * smooth. Runs of one system share it; each binds its own sides before it computes. */
#ifndef MACHINE_HELD_H
#define MACHINE_HELD_H

#include "lang/model/switches.h"
#include "machine/machine.h"

typedef struct held held;

/* Creates it in the model's arena. *out is NULL where there is nothing to hold and nothing that a step could fail to
 * resolve, and where the switches cannot be held: *refused is then the reason, a part of a sentence, else NULL. */
motus_status held_create(model *, held **out, const char **refused, motus_error *);
const problem *held_problem(const held *);
size_t held_count(const held *); /* how many switches there are */
operation held_operation(const held *, size_t k);
/* Writes where switch k changes its side, as switches_surface does. */
void held_surface(const held *, size_t k, char *out, size_t size);

size_t held_touches(const held *); /* see lang/model/switches.h */

/* Binds the sides with which all calls compute from now on. fresh: the model's numbers may have changed. False: no
 * memory. */
bool held_bind(held *, const double *sides, bool fresh);
/* Computes the arguments of all switches with the model's own equations. NaN: undefined there. */
void held_arguments(held *, double t, double *x, double *v, double *out);
/* Compute the arguments of all switches on the bound sides, and their rates along the motion. NaN: undefined there. */
void held_values(held *, double t, double *x, double *v, double *out);
void held_rates(held *, double t, double *x, double *v, double *a, double *out);
/* Compute the arguments of all touches on the bound sides, and their rates. */
void held_touch(held *, double t, double *x, double *v, double *out);
void held_touch_rates(held *, double t, double *x, double *v, double *a, double *out);
bool held_resolves(const held *); /* whether held_fits has anything to judge */
/* Tells whether a step over these times and states resolves the force: lang/model/resolution.h. */
bool held_fits(held *, interval t, interval *x, interval *v);
/* Computes the ranges of the arguments of all switches, and of their rates, on the bound sides over these times, states
 * and accelerations. NaN: undefined. */
void held_reach(held *, interval t, interval *x, interval *v, interval *a, interval *argument, interval *rate);
/* Computes by how much rounding of the time, of a state and of the operations may have changed each argument. */
void held_rounding(held *, double t, double *x, double *v, double *out);
/* Returns half the bound on the rounding of the accelerations, the largest of all. room: nv numbers. */
double held_force_rounding(held *, double t, double *x, double *v, double *room);

#endif
