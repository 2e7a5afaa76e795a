/* Compressed rows, as chunks of HDF5: a block of a column is shuffled (the first bytes of all its numbers, then the
 * second ones, ...) and deflated. Part of the module that makes archives. */
#ifndef ARCHIVE_PACK_H
#define ARCHIVE_PACK_H

#include "archive/directory.h"

#include <hdf5.h>
#include <stdbool.h>

/* Makes `list`, of H5Dcreate2, that of compressed rows. */
bool pack_layout(hid_t list, int dimensions, const hsize_t *chunk);
/* Writes all blocks of a column, 1 + its number, or of the rows' numbers, 0, of d->from; and where each is.
 * MOTUS_STATE: one is missing. */
motus_status pack_rows(hid_t set, const motus_archive_def *d, size_t column, directory_piece *, const char *path,
                       motus_error *);
/* Reads the pieces of all blocks back, and compares the blocks with those of d->from. HDF5 may count places from behind
 * the `before` first bytes of the file: then they are set right. */
motus_status pack_check(const motus_archive_def *, directory_piece *, int descriptor, uint64_t before, const char *path,
                        motus_error *);

#endif
