/* The variables, quantities and invariants of a callback. */
#ifndef API_SYSTEM_STAND_IN_H
#define API_SYSTEM_STAND_IN_H

#include "api/system/system.h"

/* Makes states and definitions from the callback definition, and copies the names. */
motus_status stand_in_make(motus_system *, motus_error *);

#endif
