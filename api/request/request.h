/* A request: what a caller asks of a run or of the trajectories of an ensemble, and who said it. It is settled once:
 * first the caller's definition, then the model, then a default. */
#ifndef API_REQUEST_REQUEST_H
#define API_REQUEST_REQUEST_H

#include "api/system/system.h"

typedef enum said {
    SAID_NOBODY,
    SAID_CALLER,
    SAID_MODEL,
    SAID_ASIDE, /* the model says it for its own method or error, and the caller asks for another one */
    SAID_DEFAULT,
    SAID_SUGGESTED
} said;

typedef struct request {
    const char *method;         /* SYSTEM_AUTO, or the name of a row */
    double step;                /* NaN: none */
    double tolerance, accuracy; /* NaN: none, or SAID_ASIDE */
    bool absolute;              /* the tolerance or accuracy is absolute */
    double start, until;        /* until: NaN where nobody gives an end */
    said method_said, step_said, tolerance_said, accuracy_said, until_said;
    double shortest, longest; /* limits of the steps; 0: none */
    int64_t most_steps;       /* 0: any number */
    bool automatic;           /* the method is SYSTEM_AUTO */
    /* After request_choose: the row, with its tolerance and the limits of its steps, and its card. */
    chosen chosen;
    const motus_method *card;
} request;

/* Settles the request of a run. Where nobody names a method nor a step, the method is SYSTEM_AUTO. */
request request_of_run(const motus_system *, const motus_run_def *);
/* Settles the request of an ensemble. Where nobody names a method, it is SYSTEM_AUTO for an accuracy, else verlet. */
request request_of_ensemble(const motus_system *, const motus_ensemble_def *);
/* Returns whether somebody asks for a number, and it is not SAID_ASIDE. */
static inline bool request_asks(said who) { return who == SAID_CALLER || who == SAID_MODEL; }
/* Finds the row of a name, if it admits the system. Samples the velocity term first where the answer depends on it. */
motus_status request_row(motus_system *, const char *name, chosen *, const motus_method **card, motus_error *);
/* Finds the row of a request. MOTUS_ARGUMENT: a number is asked for that the row does not take, or is out of range. */
motus_status request_choose(motus_system *, request *, motus_error *);
/* Checks that the error can be asked for; `what`: "a tolerance" or "an accuracy". MOTUS_ARGUMENT. */
motus_status request_admits(const char *what, double value, bool absolute, motus_error *);

#endif
