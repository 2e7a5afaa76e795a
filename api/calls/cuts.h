/* What becomes of a method's geometry where events assign. */
#ifndef API_CALLS_CUTS_H
#define API_CALLS_CUTS_H

#include "api/system/system.h"

/* Returns whether an event that assigns ends steps at a time that the state decides. */
bool cuts_by_state(const motus_system *);
/* Returns what events make of the geometry of a run's method, `cut` of motus_run_statistics. */
const char *cuts_sentence(const motus_run *);

#endif
