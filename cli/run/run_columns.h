/* The columns of a run in an archive. A family is one column, whose rows have its members, and their components.
 * Families of vectors in 2 or 3 dimensions, quantities and invariants have the names of H5MD 1.1 too (nongnu.org/h5md),
 * so that programs for the motion of particles read them. */
#ifndef CLI_RUN_RUN_COLUMNS_H
#define CLI_RUN_RUN_COLUMNS_H

#include "cli/run/csv.h"

#include <motus-archive.h>

typedef struct run_column {
    char name[MOTUS_NAME_MAX + 96];
    size_t from, width; /* where its numbers are in a row of the CSV, errors behind values; the last column is
                           `significant`, with from SIZE_MAX, where errors are told */
} run_column;

typedef struct run_columns {
    run_column *columns; /* as many as there are */
    motus_archive_column *described;
    size_t count;
    size_t width; /* of all columns together */
    motus_archive_link *links;
    size_t link_count;
    motus_archive_attribute *attributes;
    size_t attribute_count;
    char **texts; /* of links and attributes */
    size_t text_count;
} run_columns;

/* Call run_columns_free() in any case. */
motus_status run_columns_make(run_columns *, const csv *, motus_error *);
void run_columns_free(run_columns *);
/* Whether the archive has these columns. */
bool run_columns_fit(const run_columns *, const motus_archive *);
/* Room for so many rows of each column, to be freed by run_columns_drop(); NULL: no memory. */
double **run_columns_rooms(const run_columns *, size_t rows);
void run_columns_drop(const run_columns *, double **rooms);
/* Puts the values that a walk gives, of which row i is to consist, into the rooms. */
void run_columns_put(const run_columns *, const csv *, const double *values, double *const *rooms, size_t i);

#endif
