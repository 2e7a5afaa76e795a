/* Where an archive is made: in a module that is loaded when the first is wanted, since it needs HDF5 and whatever that
 * needs, which takes ten times as long to load as the program.
 *
 * The module is looked for where the program that calls has its libraries, and where the system has them.
 */
#ifndef ARCHIVE_MAKE_H
#define ARCHIVE_MAKE_H

#include "motus-archive.h"

#define MAKE_MODULE "motus-hdf5.so"
/* The number changes with whatever crosses the border, motus_archive too: a module of another build is not taken. */
#define MAKE_FUNCTION "make_hdf5_3"
#define MAKE_UNPACK "unpack_piece_2"

/* As motus_archive_create(), of a definition that was checked. */
typedef motus_status make_archive(const char *path, const motus_archive_def *, motus_error *);
__attribute__((visibility("default"))) make_archive make_hdf5_3;

/* Fills `out` with the numbers of a compressed block, `count` bytes in units of `width`, whatever the bytes are.
 * Returns 0 if these are not so many numbers. */
typedef int unpack_archive(const void *bytes, size_t size, uint64_t left_out, size_t width, void *out, size_t count);
__attribute__((visibility("default"))) unpack_archive unpack_piece_2;

/* archive.c: copies the hashes of the blocks, or (`slots` 1) the states, to a place of another file. */
motus_status archive_copy(const motus_archive *, int slots, int descriptor, uint64_t place, motus_error *);

/* module.c: a function of the module; NULL: there is no module, or no HDF5 for it. It stays loaded. */
void *module_find(const char *name);

#endif
