/* Rows between long steps, so that straight lines from row to row are a smooth curve. */
#ifndef CLI_RUN_SMOOTH_H
#define CLI_RUN_SMOOTH_H

#include "cli/model/load.h"
#include "cli/run/walk.h"

typedef struct smooth {
    walk_parts parts; /* finds how many a step needs; its context is this struct */
    size_t count, *columns;
    double *low, *high, *values; /* the range of each number so far; the values in a step */
} smooth;

/* Begins at the start of a run. Call smooth_free() in any case. */
motus_status smooth_begin(smooth *, const load *, motus_run *, motus_error *);
void smooth_free(smooth *);

#endif
