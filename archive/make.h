/* The module that makes archives. It is loaded when the first archive is wanted, because HDF5 and its libraries take
 * ten times as long to load as the program. It is looked for beside the libraries of the calling program and of the
 * system.
 */
#ifndef ARCHIVE_MAKE_H
#define ARCHIVE_MAKE_H

#include "motus-archive.h"

#define MAKE_MODULE "motus-hdf5.so"
/* The number in each name changes with the layouts that both sides share, so that no module of another build is taken.
 * */
#define MAKE_FUNCTION "make_hdf5_3"
#define MAKE_UNPACK "unpack_piece_2"

/* Creates an archive as motus_archive_create() does, from a checked definition. */
typedef motus_status make_archive(const char *path, const motus_archive_def *, motus_error *);
__attribute__((visibility("default"))) make_archive make_hdf5_3;

/* Unpacks a compressed block into `count` bytes of `out`, numbers of `width` bytes each. The bytes may be damaged: it
 * returns 0 if they do not unpack to `count` bytes. */
typedef int unpack_archive(const void *bytes, size_t size, uint64_t left_out, size_t width, void *out, size_t count);
__attribute__((visibility("default"))) unpack_archive unpack_piece_2;

/* archive.c. Copies the hashes of the blocks or, with `slots`, the states to a place of another file. */
motus_status archive_copy(const motus_archive *, int slots, int descriptor, uint64_t place, motus_error *);

/* module.c. Returns a function of the module, which stays loaded; NULL: there is no module, or no HDF5 for it. */
void *module_find(const char *name);

#endif
