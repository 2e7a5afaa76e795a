/* The step and the end of a command: its options', else the model's, else those that the library suggests. */
#ifndef CLI_MODEL_SETTLE_H
#define CLI_MODEL_SETTLE_H

#include "cli/model/grid.h"
#include "cli/model/load.h"
#include "tell/json.h"

enum { SETTLE_STEP = 1, SETTLE_UNTIL = 2 };

/* Sets step and until of the load; what the command needs and nobody gives is suggested, and a note says so. method:
 * NULL: the model's. sweep: what varies, NULL: nothing; a step then suits the trajectories at its ends. */
motus_status settle_timing(load *, const options *, int needed, const char *method, const grid *sweep, motus_error *);
/* The accuracy that the command asks for: its option's, else the model's where that counts; NaN: none. */
double settle_accuracy(const load *, const options *);
/* {"suggested": {"step": 0.05}}: what was suggested. */
void settle_json(json *, const load *);

#endif
