/* The values that --vary and --random give to each trajectory of a sweep. */
#ifndef CLI_MODEL_GRID_H
#define CLI_MODEL_GRID_H

#include "cli/model/range.h"
#include "cli/words/options.h"

typedef enum axis_kind { AXIS_RANGE, AXIS_LIST, AXIS_UNIFORM, AXIS_NORMAL } axis_kind;

typedef struct axis {
    const char *spec; /* "F=0:1:11", as given */
    char *name;       /* "F" */
    char *path;       /* of the file with the list, or NULL */
    axis_kind kind;
    range range; /* AXIS_UNIFORM: from and to are its ends; AXIS_NORMAL: mean and deviation */
    double *list;
    uint64_t count; /* of values; 1 for AXIS_UNIFORM and AXIS_NORMAL */
} axis;

typedef struct grid {
    axis *axes;
    size_t count;
    const char **names; /* of the axes, for the library */
    bool zip;
    uint64_t draws, seed, total; /* draws: trajectories for each point of --vary; total: all trajectories */
} grid;

#define GRID_MOST ((uint64_t)1 << 53) /* trajectories; so their numbers are exact as doubles */

motus_status grid_read(grid *, const options *, motus_error *);
/* Sets values[axis][i] for `count` trajectories from number `first`. Draws change fastest, then the last --vary. */
void grid_values(const grid *, uint64_t first, size_t count, double *const *values);
/* Returns the axis of this name; grid.count: there is none. */
size_t grid_find(const grid *, const char *name);
/* Copies up to `count` different values of one axis, from number `first` on. Returns how many. */
size_t grid_axis_values(const grid *, size_t axis, uint64_t first, size_t count, double *values);
void grid_free(grid *);

/* Makes the values[axis][row] of the trajectories that are furthest apart: all of a few, or corners, or, if there are
 * many axes, one end after the other. They are those of the whole sweep, whatever part of it is computed. */
motus_status grid_extremes(const grid *, double ***values, size_t *rows, motus_error *);
void grid_extremes_free(double **values);

/* Reads the value of --vary or --random. Call axis_free() also after a failure. */
motus_status axis_read(axis *, const char *option, const char *spec, motus_error *);
void axis_free(axis *);

#endif
