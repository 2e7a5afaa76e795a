/* The command that makes the rows of a run, and a run from the command that an archive has. */
#ifndef CLI_RUN_RUN_COMMAND_H
#define CLI_RUN_RUN_COMMAND_H

#include "cli/model/load.h"

#include <motus-archive.h>

/* The command with every setting written out, to be freed also after a failure: the method and the steps are those that
 * the run has found. */
motus_status run_command_text(const options *, const motus_run *, double until, char **text, motus_error *);
/* The hash of all that the rows depend on. Returns out. */
enum { RUN_FINGERPRINT = 17 };
const char *run_command_fingerprint(const char *version, const char *model, const char *command,
                                    char out[RUN_FINGERPRINT]);

/* The options of the archive's command, and of those that are given now what is not the motion itself. */
typedef struct run_command {
    options options;
    options_list argv;
    char *words, *model;
} run_command;
/* The command of an archive alone, with threads and machine of the one that asks. MOTUS_STATE: it is not that of a run.
 * Call run_command_free() in any case. */
motus_status run_command_of(run_command *, motus_archive *, const options *, motus_error *);
/* Of the archive that the options name, for a run that goes on; MOTUS_ARGUMENT: an option that the archive decides. */
motus_status run_command_read(run_command *, const options *, motus_error *);
void run_command_free(run_command *);

#endif
