/* What `motus run` prints of a finished run: tables, or JSON. */
#ifndef CLI_RUN_SUMMARY_H
#define CLI_RUN_SUMMARY_H

#include "cli/run/deviation.h"
#include "cli/model/load.h"

#define SUMMARY_STATE_MAX ((size_t)1000000) /* numbers of the state in JSON */

typedef struct summary {
    const load *model;
    const options *options;
    motus_run *run;
    const deviation *deviation;
    double start, seconds;
    double singularity; /* where the run has passed one; NaN: nowhere */
    bool errors;        /* the run tells the errors of its numbers */
    motus_estimate estimate;
    const motus_error *singular; /* its status, if not 0: what the run passes unresolved */
    const motus_error *missed;   /* its status, if not 0: the run has not reached its accuracy */
} summary;

motus_status summary_print(const summary *, motus_error *);
motus_status summary_json(const summary *, motus_error *);

#endif
