/* Whether the invariants of a model hold along its motion: checked when it is read, and when its numbers change. */
#ifndef API_SYSTEM_INVARIANTS_H
#define API_SYSTEM_INVARIANTS_H

#include "api/system/system.h"

/* Checks the invariants of a model. MOTUS_ARGUMENT: the error says where and how fast one changes. */
motus_status invariants_check(motus_system *, motus_error *);

#endif
