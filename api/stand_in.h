/* Variables, quantities and invariants of a callback, in place of a model's: see stand_in.c. */
#ifndef API_STAND_IN_H
#define API_STAND_IN_H

#include "api/system.h"

/* Fills the system's states and definitions by its callback definition, whose names are copied. */
motus_status stand_in_make(motus_system *, motus_error *);

#endif
