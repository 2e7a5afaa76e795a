/* What becomes of a method's geometry where events assign. */
#ifndef API_CUTS_H
#define API_CUTS_H

#include "api/system.h"

/* Whether an event that assigns ends steps at a time that the state decides. */
bool cuts_by_state(const motus_system *);

#endif
