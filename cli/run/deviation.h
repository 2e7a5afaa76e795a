/* The deviation of the invariants from their initial values along a run (printed as "drift"). */
#ifndef CLI_RUN_DEVIATION_H
#define CLI_RUN_DEVIATION_H

#include "cli/model/load.h"
#include "cli/run/walk.h"

typedef struct deviation {
    size_t count; /* numbers of all invariants */
    size_t *columns;
    double *initial, *final, *most;
} deviation;

motus_status deviation_begin(deviation *, const load *, motus_run *, motus_error *);
/* Observes where the run stands, which a run that is restored need not come to otherwise. */
motus_status deviation_here(deviation *, motus_run *, motus_error *);
walk_observer deviation_observer(deviation *, int64_t stride);
/* A stride at which observing costs little beside stepping: about a thousand samples, fewer where the state is
 * large. */
int64_t deviation_stride(const load *, int64_t steps);
void deviation_free(deviation *);

#endif
