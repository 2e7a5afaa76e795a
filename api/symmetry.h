/* Traits of a system that are found by sampling, once, when the answer is needed. */
#ifndef API_SYMMETRY_H
#define API_SYMMETRY_H

#include "api/system.h"

enum { SYMMETRY_STATES = 6 };

/* Whether the velocity term does no work, and whether the force is a gradient, with constant masses: into the traits.
 * False: there was no memory for the test. */
bool symmetry_gyroscopic(motus_system *);
bool symmetry_gradient(motus_system *);

#endif
