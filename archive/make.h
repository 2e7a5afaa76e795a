/* Where an archive is made: in a module that is loaded when the first is wanted, since it needs HDF5 and whatever that
 * needs, which takes ten times as long to load as the program.
 *
 * The module is looked for where the program that calls has its libraries, and where the system has them.
 */
#ifndef ARCHIVE_MAKE_H
#define ARCHIVE_MAKE_H

#include "motus-archive.h"

#define MAKE_MODULE "motus-hdf5.so"
#define MAKE_FUNCTION "make_hdf5"

/* As motus_archive_create(), of a definition that was checked. */
typedef motus_status make_archive(const char *path, const motus_archive_def *, motus_error *);
__attribute__((visibility("default"))) make_archive make_hdf5;

#endif
