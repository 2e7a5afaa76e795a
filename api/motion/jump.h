/* With which power of the time a force departs from a smooth one. */
#ifndef API_MOTION_JUMP_H
#define API_MOTION_JUMP_H

#include <stdbool.h>
#include <stddef.h>

/* The acceleration, n numbers, at a distance `way` in time from the point, along the motion; false: there is none. */
typedef bool jump_force(void *ctx, double way, double *a);

/* p where the force departs from a smooth one as |way|^p, and its derivative p jumps: 0 the force itself, 1 its
 * slope; where p is no integer, the derivative above it is infinite: 1/3 of cbrt. Below 0 the force is infinite.
 * NaN: it is smooth as far as can be seen. h: a step of the run; rounding: of times near the point, and of states,
 * as a time. room: 3 n numbers. */
double jump_power(jump_force *, void *ctx, size_t n, double h, double rounding, double *room);

#endif
