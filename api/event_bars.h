/* Bars of the rows of the table of events: how far times and states of events may be from those of the exact motion. */
#ifndef API_EVENT_BARS_H
#define API_EVENT_BARS_H

#include "api/bars.h"

/* Of the time of row k. NaN: not known; INFINITY: no digit is significant. */
double event_bars_time(motus_run *, size_t k);
/* Raises the bar of a number at t, where the run's state is x, v in the inside order, to what roundings at events leave
 * in every computation alike. */
motus_status event_bars_state(motus_run *, double t, const double *x, const double *v, size_t number, double *error,
                              motus_error *);
/* The bar of what run and companion differ by, in parts of their distance. */
double event_bars_part(const motus_run *);
/* By how much the state at t is late or early in run and companion alike: by what the times of events share, and by the
 * rounding of the run's end. */
double event_bars_late(const motus_run *, double t);
/* Of the limit of events that accumulate; the engine knows it to `error`, by the times of its own events. */
double event_bars_limit(motus_run *, const events_limit *);
/* Which of the numbers that are compared only count. */
motus_status event_bars_whole(motus_run *, motus_error *);

#endif
