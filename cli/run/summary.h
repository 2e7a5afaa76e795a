/* What `motus run` prints of a finished run: tables, or JSON. */
#ifndef CLI_RUN_SUMMARY_H
#define CLI_RUN_SUMMARY_H

#include "cli/model/load.h"
#include "cli/run/deviation.h"
#include "cli/words/text.h"

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

/* answer.c: what the errors of a finished run rest on, in words. */
void answer_print(const summary *, FILE *);
/* Why "auto" chose its method; nothing where it did not. */
void answer_choice(const summary *, FILE *);

/* event_table.c: the first events and the last, with the state on arrival. NULL: there are none, or no memory, as
 * *status says. */
table *event_table_make(const summary *, motus_error *, motus_status *);
/* What goes below the table: where the rest is. */
void event_table_note(const summary *, FILE *);
/* Says where events may have been missed. */
void event_table_unseen(const summary *, FILE *out);
/* What ended the run before its time, and where events accumulate, a sentence each. */
void event_table_end(const summary *, FILE *);

#endif
