/* What a run is to reach: from "auto" and an accuracy to a method and a tolerance, or a step. */
#ifndef API_GOAL_H
#define API_GOAL_H

#include "api/accuracy.h"

struct goal {
    accuracy accuracy;
    char choice[256]; /* which method "auto" chose, and why; "" */
};

/* What is asked for: by the caller's definition first, then by the model. */
typedef struct goal_wish {
    motus_settings set; /* of the model, as far as they count */
    bool automatic;     /* the method is to be chosen */
    double accuracy;    /* NaN: none */
    bool absolute;
} goal_wish;
goal_wish goal_wish_of(const motus_system *, const motus_run_def *);

/* Completes a definition: names its method, and finds what reaches its accuracy, by pilot and trial runs where they are
 * due. *goal: NULL, or the run's, to be given back by goal_destroy. */
motus_status goal_reach(motus_system *, motus_run_def *, run_hint *, struct goal **goal, motus_error *);
/* Call it before the run moves by at most n steps. The best trial run has been at the end: a run that is to go there
 * from its start at one call takes its state over. Returns whether it did. */
bool goal_arrive(motus_run *, int64_t n);
/* MOTUS_ACCURACY, where the run is at its end and its accuracy was not reached. */
motus_status goal_judge(const motus_run *, motus_error *);
/* The run goes on from a restart state, whose errors no trial had: what it reaches, its own bars tell. */
void goal_restored(motus_run *);
void goal_statistics(const motus_run *, motus_statistics *);
void goal_destroy(const motus_system *, struct goal *);

#endif
