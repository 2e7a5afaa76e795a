/* Traits of a system that are proved or sampled when a caller first needs them. */
#ifndef API_SYSTEM_SYMMETRY_H
#define API_SYSTEM_SYMMETRY_H

#include "api/system/system.h"

enum { SYMMETRY_STATES = 32, SYMMETRY_LEAST = 6 }; /* states at which a symmetry is sampled; of large systems fewer */

/* Find out whether the velocity term does no work, and whether the force is a gradient (with constant masses), and note
 * it in the traits. False: there is no memory for the test. */
bool symmetry_gyroscopic(motus_system *);
bool symmetry_gradient(motus_system *);

#endif
