/* Whether the errors of the state leave open which events have happened. */
#ifndef API_ERROR_EVENT_COUNTS_H
#define API_ERROR_EVENT_COUNTS_H

#include "api/error/bars.h"

/* *open: at t, where the run's state is x, v in the inside order, or at a touch before, a function of an event may have
 * passed 0 or not. */
motus_status event_counts_open(motus_run *, double t, const double *x, const double *v, bool *open, motus_error *);

/* At a landing: finds the rules whose functions may have touched 0 or not since the last one. */
motus_status event_counts_touched(motus_run *, double t, const double *x, const double *v, motus_error *);
/* Since when it is open how often a rule has happened, by such touches; NaN: it is not. And notes that it is since t.
 * False: no memory. */
double event_counts_since(const bars *, size_t rule);
bool event_counts_note(motus_run *, size_t rule, double t);

#endif
