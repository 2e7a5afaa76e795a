/* motus archive of the archive of a run. */
#ifndef CLI_VERBS_ARCHIVE_RUN_H
#define CLI_VERBS_ARCHIVE_RUN_H

#include "cli/files/file.h"
#include "cli/words/options.h"
#include "cli/files/stop.h"

#include <motus-archive.h>

/* Whether the command in the archive is that of a run. */
bool archive_run_is(const motus_archive *);
/* Its rows as CSV, as the run would have written them, below a comment with the command and the fingerprint. */
motus_status archive_run_csv(motus_archive *, const options *, file_out *, stop_progress *, motus_error *);
/* Whether one of its states has all the rows before it: the first block that is missing, where one is. */
bool archive_run_goes_on(motus_archive *, bool missing, uint64_t first_missing);
/* The latest restart state, for --restart. */
motus_status archive_run_state(motus_archive *, const options *, file_out *, motus_error *);

#endif
