/* The request: what a run, or the trajectories of an ensemble, are asked for, and who said it. It is settled once: the
 * caller's definition comes first, then the model, then a default.
 */
#ifndef API_REQUEST_REQUEST_H
#define API_REQUEST_REQUEST_H

#include "api/system/system.h"

typedef enum said {
    SAID_NOBODY,
    SAID_CALLER,
    SAID_MODEL,
    SAID_ASIDE, /* the model says it of its own method, and the caller names another one or wants another error */
    SAID_DEFAULT,
    SAID_SUGGESTED
} said;

typedef struct request {
    const char *method;         /* SYSTEM_AUTO, or the name of a row */
    double step;                /* NaN: none */
    double tolerance, accuracy; /* NaN: none; of one that is SAID_ASIDE likewise */
    bool absolute;              /* the tolerance, or the accuracy */
    double start, until;        /* until: NaN: none */
    said method_said, step_said, tolerance_said, accuracy_said, until_said;
    double shortest, longest; /* limits of the steps; 0: none */
    int64_t most_steps;       /* 0: any number */
    bool automatic;           /* the method is SYSTEM_AUTO */
    /* After request_choose: the row, with its tolerance and the limits of its steps, and its description. */
    chosen chosen;
    const motus_method *card;
} request;

request request_of_run(const motus_system *, const motus_run_def *);
/* The same; where nobody names a method, the library chooses it for an accuracy alone. */
request request_of_ensemble(const motus_system *, const motus_ensemble_def *);
/* Whether a number is asked for, and not left aside. */
static inline bool request_asks(said who) { return who == SAID_CALLER || who == SAID_MODEL; }
/* The row of a name, if it admits the system. Samples the velocity term first where the answer depends on it. */
motus_status request_row(motus_system *, const char *name, chosen *, const motus_method **card, motus_error *);
/* Finds the row of a request. MOTUS_ARGUMENT: it is asked for a number that the row does not take, or one out of its
 * range. */
motus_status request_choose(motus_system *, request *, motus_error *);
/* Whether the error can be asked for at all: `what` is "a tolerance" or "an accuracy". MOTUS_ARGUMENT. */
motus_status request_admits(const char *what, double value, bool absolute, motus_error *);

#endif
