/* Compressed rows, as chunks of HDF5: a block of a column is shuffled (the first bytes of all its numbers, then the
 * second ones, ...) and deflated. Part of the module that makes archives. */
#ifndef ARCHIVE_PACK_H
#define ARCHIVE_PACK_H

#include "archive/directory.h"

#include <hdf5.h>
#include <stdbool.h>

/* Sets the property list of a data set, for H5Dcreate2, to compressed rows. */
bool pack_layout(hid_t list, int dimensions, const hsize_t *chunk);
/* Writes all blocks of d->from of column number `column` - 1, or of the rows' numbers if it is 0, and tells where each
 * block is. MOTUS_STATE: a block is missing. */
motus_status pack_rows(hid_t set, const motus_archive_def *d, size_t column, directory_piece *, const char *path,
                       motus_error *);
/* Reads the pieces of all blocks back, and compares the blocks with those of d->from. Corrects places that HDF5 counts
 * from behind the first `before` bytes of the file. */
motus_status pack_check(const motus_archive_def *, directory_piece *, int descriptor, uint64_t before, const char *path,
                        motus_error *);

#endif
