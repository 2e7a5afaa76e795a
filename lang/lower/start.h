/* Initial values, computed when they are first needed. */
#ifndef LANG_LOWER_START_H
#define LANG_LOWER_START_H

#include "lang/model/model.h"

/* Computes all initial values of a state, and decides its components. False: there was a complaint, or no memory. */
bool start_state(model *, model_state *);
/* Computes x(0) (primes 0) or x'(0) (primes 1) of the cells [low, high] into start_array. */
bool start_cells(model *, model_state *, int primes, const int64_t low[], const int64_t high[]);

#endif
