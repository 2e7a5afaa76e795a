/* Bars of the rows of the table of events: how far times and states of events may be from those of the exact motion. */
#ifndef API_EVENT_BARS_H
#define API_EVENT_BARS_H

#include "api/bars.h"

/* Of the time of row k. NaN: not known; INFINITY: no digit is significant. */
double event_bars_time(motus_run *, size_t k);
/* Of the limit of events that accumulate; the engine knows it to `error`, by the times of its own events. */
double event_bars_limit(const motus_run *, const events_limit *);

#endif
