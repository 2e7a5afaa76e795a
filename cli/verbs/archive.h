/* motus archive: what its source files share. */
#ifndef CLI_VERBS_ARCHIVE_H
#define CLI_VERBS_ARCHIVE_H

#include "cli/files/file.h"
#include "cli/files/stop.h"
#include "cli/sweep/sweep.h"
#include "cli/words/options.h"

#include <motus-archive.h>

/* What --verify found (archive_verify.c). */
typedef struct archive_verified {
    uint64_t computed;       /* blocks of a sweep, or rows of a run */
    uint64_t differ;         /* blocks of a sweep; 1 for a run with a row that differs */
    char where[SWEEP_WHERE]; /* the first difference */
} archive_verified;

/* Reads the part that --verify names: "all", or a percentage above 0, up to 100, "1%". */
motus_status archive_verify_part(const char *text, double *part, motus_error *);
/* Computes a part of the `count` blocks again. They are spread over all, and are other ones at each call. */
motus_status archive_verify(motus_archive *, const options *, const uint64_t *blocks, uint64_t count,
                            archive_verified *, stop_progress *, motus_error *);
/* Computes the first rows of a run again, since rows can only be computed from the start; if blocks are `missing`, only
 * rows before the first of them. */
motus_status archive_verify_run(motus_archive *, const options *, uint64_t first_missing, bool missing,
                                archive_verified *, stop_progress *, motus_error *);
/* Makes the error for blocks or rows that differ. */
motus_status archive_verify_failed(const archive_verified *, const options *, bool run, motus_error *);

/* Returns whether the command in the archive is that of a run (archive_run.c). */
bool archive_run_is(const motus_archive *);
/* Writes the rows of a run as CSV, as the run would have written them, below a comment with the command and the
 * fingerprint. */
motus_status archive_run_csv(motus_archive *, const options *, file_out *, stop_progress *, motus_error *);
/* Returns whether `motus run` can continue the archive: it has a state whose rows are all there. */
bool archive_run_goes_on(motus_archive *, bool missing, uint64_t first_missing);
/* Writes the latest restart state, for --restart. */
motus_status archive_run_state(motus_archive *, const options *, file_out *, motus_error *);

#endif
