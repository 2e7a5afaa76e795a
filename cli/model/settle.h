/* What a command asks of the motion. The library settles it from the options and the model (motus_run_settings), and
 * the command prints what was suggested. */
#ifndef CLI_MODEL_SETTLE_H
#define CLI_MODEL_SETTLE_H

#include "cli/model/grid.h"
#include "cli/model/load.h"
#include "tell/json.h"

/* Copies what the options ask of the motion to the definition of a run or an ensemble. */
#define SETTLE_ASK(def, o)                                                                                \
    ((def)->method = (o)->method, (def)->step = (o)->step, (def)->until = (o)->until,                     \
     (def)->tolerance = (o)->tolerance, (def)->accuracy = (o)->accuracy, (def)->absolute = (o)->absolute, \
     (def)->shortest_step = (o)->shortest_step, (def)->longest_step = (o)->longest_step,                  \
     (def)->most_steps = (o)->most_steps, (def)->switches = options_switches(o),                          \
     (def)->machine = (o)->machine ? (o)->machine : "auto")

/* Settle what a definition asks for, and store it in load.set; what is suggested goes to the definition too. Print a
 * note of what was suggested, or of steps that grow, which nothing else would show. The definition of an ensemble
 * has what varies. */
motus_status settle_run(load *, const options *, motus_run_def *, motus_error *);
motus_status settle_sweep(load *, const options *, const grid *, motus_ensemble_def *, motus_error *);
/* Writes what was suggested: "suggested": {"step": 0.05}. */
void settle_json(json *, const load *);

#endif
