/* Whether the errors of the state leave open which events have happened. */
#ifndef API_ERROR_EVENT_COUNTS_H
#define API_ERROR_EVENT_COUNTS_H

#include "api/error/bars.h"

/* Finds out whether an event may have happened in the exact motion up to t that the run has not had, or the reverse: at
 * t, with the run's state x, v in the inside order, or at a touch before. */
motus_status event_counts_open(motus_run *, double t, const double *x, const double *v, bool *open, motus_error *);

/* Finds the rules whose functions may have touched 0 since the last landing. Call it at a landing. */
motus_status event_counts_touched(motus_run *, double t, const double *x, const double *v, motus_error *);
/* Returns since when such touches leave open how often a rule has happened; NaN: they do not. */
double event_counts_since(const bars *, size_t rule);
/* Notes that the number of a rule's events is open since t. False: no memory. */
bool event_counts_note(motus_run *, size_t rule, double t);

#endif
