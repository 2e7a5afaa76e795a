/* motus archive: what its source files share. */
#ifndef CLI_VERBS_ARCHIVE_H
#define CLI_VERBS_ARCHIVE_H

#include "cli/files/file.h"
#include "cli/files/stop.h"
#include "cli/sweep/sweep.h"
#include "cli/words/options.h"

#include <motus-archive.h>

/* archive_verify.c: blocks of an archive are computed again. */
typedef struct archive_verified {
    uint64_t computed, differ; /* blocks; of a run rows, and whether one differs */
    char where[SWEEP_WHERE];   /* the first difference */
} archive_verified;

/* Whether the text of --verify is a part: "all", or a percentage from above 0 to 100, "1%". */
motus_status archive_verify_part(const char *text, double *part, motus_error *);
/* Computes a part of the `count` blocks, spread over them, other ones each time. MOTUS_STATE: the archive does not say
 * how. */
motus_status archive_verify(motus_archive *, const options *, const uint64_t *blocks, uint64_t count,
                            archive_verified *, stop_progress *, motus_error *);
/* Of a run: its first rows, since there is no other way to a row than from the start; where blocks are missing
 * (`missing`), those before the first of them. */
motus_status archive_verify_run(motus_archive *, const options *, uint64_t first_missing, bool missing,
                                archive_verified *, stop_progress *, motus_error *);
/* What to tell of blocks, or rows, that differ. */
motus_status archive_verify_failed(const archive_verified *, const options *, bool run, motus_error *);

/* archive_run.c: whether the command in the archive is that of a run. */
bool archive_run_is(const motus_archive *);
/* Its rows as CSV, as the run would have written them, below a comment with the command and the fingerprint. */
motus_status archive_run_csv(motus_archive *, const options *, file_out *, stop_progress *, motus_error *);
/* Whether one of its states has all the rows before it: the first block that is missing, where one is. */
bool archive_run_goes_on(motus_archive *, bool missing, uint64_t first_missing);
/* The latest restart state, for --restart. */
motus_status archive_run_state(motus_archive *, const options *, file_out *, motus_error *);

#endif
