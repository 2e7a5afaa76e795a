/* A run whose system has rules: events on the way, their table, and what ended the run. */
#ifndef API_MOTION_RUN_EVENTS_H
#define API_MOTION_RUN_EVENTS_H

#include "api/motion/run.h"

/* Begins at the state of the run's stepper, where the system has rules. */
motus_status run_events_begin(motus_run *, motus_error *);
/* Takes up to n steps of the run, with their events. */
motus_status run_events_advance(motus_run *, int64_t n, stepper_stop *why, motus_error *);
/* Takes up to n steps of any stepper, with events. MOTUS_CANCELLED, without a message: `tell` cancels. */
motus_status run_events_steps(events *, stepper *, const pace *, int64_t n, double until, stepper_stop *why,
                              motus_error *);
/* Fills in a row of the table of events, for the caller. */
void run_events_row(const rules *, const event *, double error, motus_event_row *);
int64_t run_events_turns(const motus_run *);                           /* how often switches have changed sides */
void run_events_statistics(const motus_run *, motus_run_statistics *); /* events that may have been missed */
int64_t run_events_acted(const motus_run *); /* how often events and switches have changed the motion */
bool run_events_ended(const motus_run *);
/* Computes the state at a time within the last step. */
motus_status run_events_sample(motus_run *, double t, double *x, double *v, motus_error *);
/* Restores a stepper's numbers, and those of its events, from a restart state. After a failure the run is unchanged. */
motus_status run_events_load(motus_run *, stepper_count, const double *carry, const double *, size_t count,
                             motus_error *);

#endif
