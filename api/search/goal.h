/* The goal of a run: from "auto" and an accuracy to a method and its tolerance or step. */
#ifndef API_SEARCH_GOAL_H
#define API_SEARCH_GOAL_H

#include "api/search/accuracy.h"

struct goal {
    accuracy accuracy;
    char choice[256]; /* which method "auto" chose, and why; "" */
};

/* Judges a request, and finds its row: that of the first pilot, where pilots are to choose the method. Call
 * suggest_missing then. */
motus_status goal_admits(motus_system *, request *, motus_error *);
/* Makes the run of a definition, and settles what nobody gives: pilots choose its method, trials find what reaches its
 * accuracy, and its step and end are suggested. *out: NULL after an error. */
motus_status goal_run(motus_system *, motus_run_def *, motus_run **out, motus_error *);
void goal_end(motus_run *); /* destroys the run; NULL: nothing */
/* Lets a run that is to go from its start to its end in one call take over the state of the best trial, which is there.
 * Call it before the run moves by up to n steps. Returns whether it did so. */
bool goal_arrive(motus_run *, int64_t n);
/* Judges a run at its end. MOTUS_ACCURACY: it did not reach its accuracy. */
motus_status goal_judge(const motus_run *, motus_error *);
/* Forgets what the trials reached: after a restart state only the run's own bars tell its error. */
void goal_restored(motus_run *);
void goal_statistics(const motus_run *, motus_run_statistics *);

#endif
