/* What a run is to reach: from "auto" and an accuracy to a method and a tolerance, or a step. */
#ifndef API_SEARCH_GOAL_H
#define API_SEARCH_GOAL_H

#include "api/search/accuracy.h"

struct goal {
    accuracy accuracy;
    char choice[256]; /* which method "auto" chose, and why; "" */
};

/* Makes the run of a definition, with what nobody gives: pilot runs name its method, trial runs find what reaches its
 * accuracy, and its step and its end are suggested. *out: NULL, after an error. */
motus_status goal_run(motus_system *, motus_run_def *, motus_run **out, motus_error *);
void goal_end(motus_run *); /* destroys it; NULL: nothing */
/* Which method "auto" chose for the run, and why; "". */
const char *goal_choice(const motus_run *);
/* Call it before the run moves by 1 to n steps. The best trial run has been at the end: a run that is to go there
 * from its start at one call takes its state over. Returns whether it did. */
bool goal_arrive(motus_run *, int64_t n);
/* MOTUS_ACCURACY, where the run is at its end and its accuracy was not reached. */
motus_status goal_judge(const motus_run *, motus_error *);
/* The run goes on from a restart state, whose errors no trial had: what it reaches, its own bars tell. */
void goal_restored(motus_run *);
void goal_statistics(const motus_run *, motus_statistics *);

#endif
