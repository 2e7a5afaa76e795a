/* Bars of the table of events: how far times and states of its rows may be from those of the exact motion. */
#ifndef API_ERROR_EVENT_BARS_H
#define API_ERROR_EVENT_BARS_H

#include "api/error/bars.h"

/* Returns the bar of the time of row k. NaN: not known; INFINITY: no digit is significant. */
double event_bars_time(motus_run *, size_t k);
/* Raises the bar of a number at t, where the run's state is x, v in the inside order, to what roundings at events leave
 * in run and companion alike. */
motus_status event_bars_state(motus_run *, double t, const double *x, const double *v, size_t number, double *error,
                              motus_error *);
/* Returns the bar of the limit of events that accumulate. limit->error: how well the run's own events tell it. */
double event_bars_limit(motus_run *, const events_limit *);
/* Returns how many rows have significant digits. Call it after bars_land. Without bars: all. */
size_t event_bars_rows(motus_run *);
/* Computes the errors of columns at row k, before or after its event. NaN, INFINITY: as for event_bars_time. */
motus_status event_bars_values(motus_run *, size_t k, bool after, const size_t *columns, size_t count, double *errors,
                               motus_error *);
/* Finds which of the compared numbers only count (lang/model/whole.h). */
motus_status event_bars_whole(motus_run *, motus_error *);

/* ---- event_counts.c: whether the errors of the state leave it uncertain which events have happened ---- */

/* Finds out whether an event may have happened in the exact motion up to t that the run has not had, or the reverse: at
 * t, with the run's state x, v in the inside order, or at a touch before. */
motus_status event_counts_open(motus_run *, double t, const double *x, const double *v, bool *open, motus_error *);

/* Finds the rules whose functions may have touched 0 since the last landing. Call it at a landing. */
motus_status event_counts_touched(motus_run *, double t, const double *x, const double *v, motus_error *);
/* Returns the time from which such touches make the number of a rule's events uncertain; NaN: they do not. */
double event_counts_since(const bars *, size_t rule);
/* Notes that the number of a rule's events is uncertain from t on. False: no memory. */
bool event_counts_note(motus_run *, size_t rule, double t);

#endif
