/* How far invariants moved along a run. */
#ifndef CLI_DRIFT_H
#define CLI_DRIFT_H

#include "cli/load.h"
#include "cli/walk.h"

typedef struct drift {
    size_t count; /* numbers of all invariants */
    size_t *columns;
    double *initial, *final, *most;
} drift;

motus_status drift_begin(drift *, const load *, motus_run *, motus_error *);
walk_watcher drift_watcher(drift *, int64_t stride);
/* A stride at which looking costs little beside stepping: about a thousand looks, fewer where the state is large. */
int64_t drift_stride(const load *, int64_t steps);
void drift_free(drift *);

#endif
