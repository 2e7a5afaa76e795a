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
    double singularity; /* the time of a singularity that the run has passed; NaN: there is none */
    bool errors;        /* the run has the errors of its numbers */
    motus_estimate estimate;
    const motus_error *singular; /* status not 0: the run has passed something that its steps do not resolve */
    const motus_error *missed;   /* status not 0: the run has not reached its accuracy */
    const char *from;            /* the file that the run continues */
    double went_on;              /* at this time; NaN: it begins */
    int64_t stride;              /* of the rows of the file, in steps, or else */
    double period;               /* in time */
    int64_t rows;                /* in the file */
    bool smooth;                 /* rows between steps are among them */
    int64_t jumps;               /* both sides of so many are among them, if the file is CSV */
} summary;

motus_status summary_print(const summary *, motus_error *);
motus_status summary_json(const summary *, motus_error *);

/* Prints what the errors of a finished run rest on (answer.c). */
void answer_print(const summary *, FILE *);
/* Prints why "auto" chose its method, if it did. */
void answer_choice(const summary *, FILE *);

/* Makes the table of the first and the last events, with the state on arrival (event_table.c). Returns NULL if there
 * are none, or if memory runs out, which *status says. */
table *event_table_make(const summary *, motus_error *, motus_status *);
/* Prints below the table what it does not show. */
void event_table_note(const summary *, FILE *);
/* Prints where events may have been missed. */
void event_table_unseen(const summary *, FILE *out);
/* Says which events never happened because their condition held from the start on. */
void event_table_held(const summary *, FILE *out);
/* Prints a sentence for what ended the run before its time, and one for where events accumulate. */
void event_table_end(const summary *, FILE *);

#endif
