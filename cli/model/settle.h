/* What a command asks of the motion: the library settles it from the options and the model (motus_run_settings), and
 * the command says what was suggested. */
#ifndef CLI_MODEL_SETTLE_H
#define CLI_MODEL_SETTLE_H

#include "cli/model/grid.h"
#include "cli/model/load.h"
#include "tell/json.h"

/* Puts into the definition of a run or an ensemble what the options ask of the motion. */
#define SETTLE_ASK(def, o)                                                                                \
    ((def)->method = (o)->method, (def)->step = (o)->step, (def)->until = (o)->until,                     \
     (def)->tolerance = (o)->tolerance, (def)->accuracy = (o)->accuracy, (def)->absolute = (o)->absolute, \
     (def)->shortest_step = (o)->shortest_step, (def)->longest_step = (o)->longest_step,                  \
     (def)->most_steps = (o)->most_steps, (def)->switches = options_switches(o),                          \
     (def)->machine = (o)->machine ? (o)->machine : "auto")

/* Settle what a definition asks for: the load has it then, and what is suggested is in the definition too. A note says
 * so, or that steps grow where nothing else would show it. What varies is in the definition of the ensemble already. */
motus_status settle_run(load *, const options *, motus_run_def *, motus_error *);
motus_status settle_sweep(load *, const options *, const grid *, motus_ensemble_def *, motus_error *);
/* {"suggested": {"step": 0.05}}: what was suggested. */
void settle_json(json *, const load *);

#endif
