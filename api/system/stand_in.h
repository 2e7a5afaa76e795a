/* The variables, quantities and invariants of a callback: see stand_in.c. */
#ifndef API_SYSTEM_STAND_IN_H
#define API_SYSTEM_STAND_IN_H

#include "api/system/system.h"

/* Fills in the system's states and definitions from its callback definition, and copies the names. */
motus_status stand_in_make(motus_system *, motus_error *);

#endif
