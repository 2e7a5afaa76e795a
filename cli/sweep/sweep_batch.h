/* Trajectories of a sweep that are computed by one call, and the memory for them. */
#ifndef CLI_SWEEP_SWEEP_BATCH_H
#define CLI_SWEEP_SWEEP_BATCH_H

#include "cli/sweep/sweep.h"

typedef struct sweep_batch {
    size_t most, count,
        lanes; /* room for how many trajectories; how many take BATCH_MS; lanes of all threads together */
    double **values, **results, **errors, *stopped, *room; /* errors: NULL where none are told */
    double **shifted;                                      /* values, from some trajectory of the batch on */
} sweep_batch;

/* Lanes of all threads together: as many trajectories as advance at once. They may grow, when a compiler has ended. */
size_t sweep_batch_lanes(const sweep *);
/* Call sweep_batch_free() in any case. */
motus_status sweep_batch_make(sweep_batch *, const sweep *, motus_error *);
void sweep_batch_free(sweep_batch *);
/* Computes the `count` trajectories of the rows from `row` on, count <= most. `computing`: seconds of the integration
 * are added to it; NULL: they are not. MOTUS_ACCURACY: one does not reach its accuracy. */
motus_status sweep_batch_compute(sweep_batch *, const sweep *, uint64_t row, size_t count, double *computing,
                                 motus_error *);
/* What the last ones were. */
sweep_rows sweep_batch_rows(const sweep_batch *);
/* After a batch that took `seconds`: changes the count, a multiple of the lanes, towards BATCH_MS for a batch. */
void sweep_batch_adapt(sweep_batch *, const sweep *, double seconds);
/* The bytes of its memory. */
size_t sweep_batch_bytes(const sweep_batch *, const sweep *);

#endif
