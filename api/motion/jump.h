/* The power of the time with which a force departs from a smooth one. */
#ifndef API_MOTION_JUMP_H
#define API_MOTION_JUMP_H

#include <stdbool.h>
#include <stddef.h>

/* Computes the acceleration, n numbers, at the time `way` from the point, along the motion. False: it cannot. */
typedef bool jump_force(void *ctx, double way, double *a);

/* Returns p where the force departs from a smooth one as |way|^p. 0: the force jumps; 1: its slope jumps; 1/3, as of
 * cbrt: its slope is infinite; below 0: the force is infinite. NaN: the force is smooth as far as can be seen. h: a
 * step of the run; rounding: of times near the point, and of states there, as a time. room: 3 n numbers. */
double jump_power(jump_force *, void *ctx, size_t n, double h, double rounding, double *room);

#endif
