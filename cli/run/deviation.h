/* The deviation of the invariants from their initial values during a run, which is printed as "drift". */
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
/* Observes the present state, for a restored run that is at its end already. */
motus_status deviation_here(deviation *, motus_run *, motus_error *);
walk_observer deviation_observer(deviation *, int64_t stride);
/* Returns a stride with about a thousand samples, or fewer if the state is large, so that observing costs little in
 * comparison with the steps. */
int64_t deviation_stride(const load *, int64_t steps);
void deviation_free(deviation *);

#endif
