/* Bars of the rows of the table of events: how far times and states of events may be from those of the exact motion. */
#ifndef API_ERROR_EVENT_BARS_H
#define API_ERROR_EVENT_BARS_H

#include "api/error/bars.h"

/* Of the time of row k. NaN: not known; INFINITY: no digit is significant. */
double event_bars_time(motus_run *, size_t k);
/* Raises the bar of a number at t, where the run's state is x, v in the inside order, to what roundings at events leave
 * in every computation alike. */
motus_status event_bars_state(motus_run *, double t, const double *x, const double *v, size_t number, double *error,
                              motus_error *);
/* Of the limit of events that accumulate; the engine knows it to `error`, by the times of its own events. */
double event_bars_limit(motus_run *, const events_limit *);
/* So many rows of the table have significant digits; the companion has come as far as the run. Without bars: all. */
size_t event_bars_rows(motus_run *);
/* The errors of columns at row k, as its event found the state or left it. NaN, INFINITY: as event_bars_time. */
motus_status event_bars_values(motus_run *, size_t k, bool after, const size_t *columns, size_t count, double *errors,
                               motus_error *);
/* Which of the numbers that are compared only count. */
motus_status event_bars_whole(motus_run *, motus_error *);

#endif
