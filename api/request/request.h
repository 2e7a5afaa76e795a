/* A request: what a caller asks of a run or of the trajectories of an ensemble, and who said it. It is settled once:
 * first the caller's definition, then the model, then a default. */
#ifndef API_REQUEST_REQUEST_H
#define API_REQUEST_REQUEST_H

#include "api/system/system.h"

typedef struct request {
    /* What is asked for, and who says it. method: SYSTEM_AUTO, or the name of a row; tolerance, accuracy: NaN where
     * they are MOTUS_SAID_ASIDE. */
    motus_settings set;
    double shortest, longest; /* limits of the steps; 0: none */
    int64_t most_steps;       /* 0: any number */
    bool ensemble;            /* it is asked of trajectories, not of a run */
    bool ends;                /* every trajectory has an end of its own */
    /* After request_choose: the row, with its tolerance and the limits of its steps, and its card. */
    chosen chosen;
    const motus_method *card;
} request;

/* Settle what is asked of a run or an ensemble: nothing is judged yet. Where nobody names a method nor a step, a run
 * has SYSTEM_AUTO; trajectories have verlet, with an accuracy dop853. */
request request_of_run(const motus_system *, const motus_run_def *);
request request_of_ensemble(const motus_system *, const motus_ensemble_def *);
/* Returns whether somebody asks for a number, and it is not MOTUS_SAID_ASIDE. */
static inline bool request_asks(motus_said who) { return who == MOTUS_SAID_CALLER || who == MOTUS_SAID_MODEL; }
/* Finds the row of a name, if it admits the system. Samples the velocity term first where the answer depends on it. */
motus_status request_row(motus_system *, const char *name, chosen *, const motus_method **card, motus_error *);
/* Finds the row of a request. MOTUS_ARGUMENT: a number is asked for that the row does not take, or is out of range. */
motus_status request_choose(motus_system *, request *, motus_error *);
/* Checks that the error can be asked for; `what`: "a tolerance" or "an accuracy". MOTUS_ARGUMENT. */
motus_status request_admits(const char *what, double value, bool absolute, motus_error *);

#endif
