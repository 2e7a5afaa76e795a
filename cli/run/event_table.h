/* The events of a run in print. */
#ifndef CLI_RUN_EVENT_TABLE_H
#define CLI_RUN_EVENT_TABLE_H

#include "cli/run/summary.h"
#include "cli/words/table.h"

/* The first events and the last, with the state on arrival. NULL: there are none, or no memory, as *status says. */
table *event_table_make(const summary *, motus_error *, motus_status *);
/* What goes below the table: where the rest is. */
void event_table_note(const summary *, FILE *);
/* Says where events may have been missed. */
void event_table_unseen(const summary *, FILE *out);
/* What ended the run before its time, and where events accumulate, a sentence each. */
void event_table_end(const summary *, FILE *);

#endif
