/* The run that a command asks for. */
#ifndef CLI_RUN_RUN_MAKE_H
#define CLI_RUN_RUN_MAKE_H

#include "cli/model/load.h"
#include "cli/files/stop.h"
#include "cli/run/walk.h"

/* The definition of a run with the settings that the options have. */
motus_run_def run_make_asked(const options *);
/* Settles step and end of the model, which is loaded, and creates the run; *def is its definition. Names in the notes
 * of the run are told unless the command is quiet. */
motus_status run_make(const options *, load *, stop_progress *, motus_bars, motus_run_def *def, motus_run **,
                      motus_error *);
/* When rows are taken: as the options say, else the model, else every step. Stride or period, of which the other is
 * 0. */
walk_observer run_make_rows(const options *, const load *, const motus_run *);

#endif
