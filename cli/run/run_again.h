/* Computes the first rows of the archive of a run once more. */
#ifndef CLI_RUN_RUN_AGAIN_H
#define CLI_RUN_RUN_AGAIN_H

#include "cli/words/options.h"
#include "cli/files/stop.h"

#include <motus-archive.h>

enum { RUN_WHERE = 256 };
/* Whether the first `rows` rows have the bytes that the run of the options has; `where`, where they have not: which row
 * and which number. progress: NULL, none is told. MOTUS_STATE: the archive
 * has other columns. */
motus_status run_again_rows(const options *, motus_archive *, uint64_t rows, bool *same, char where[RUN_WHERE],
                            stop_progress *, motus_error *);

#endif
