/* The files that rows and events are written to: their endings, whether they may be written, their locks. */
#ifndef CLI_FILES_TARGET_H
#define CLI_FILES_TARGET_H

#include "cli/words/options.h"

bool target_npy(const char *path);
bool target_archive(const char *path);
/* Returns the name of the .json beside a .npy; the caller frees it. NULL: no memory. */
char *target_beside(const char *path);

/* Endings of files beside an archive, which replace it: the joined rows of shards, and the rows of a run with more
 * room. The latter has the ending of an archive, since it is locked before it replaces one. These two, and
 * compressed archives, are made under their name and ".new". */
#define ARCHIVE_JOINED ".joined"
#define ARCHIVE_GROWN ".grown.h5"
/* Returns whether an input has the name of a file that is made on the way to this archive. */
bool target_replaces(const char *archive, const char *input);
/* Removes the files that a killed program left beside an archive, which this program has locked. */
void target_tidy(const char *archive);

/* Fails if the options do not allow writing this file ("-": standard output). Every file that a command names passes
 * here before anything is computed, unless the command goes on in it: without --force nothing is written over. */
motus_status target_check(const options *, const char *path, motus_error *);
/* Opens and locks a file; fails if another program writes it. *regular is false for a device or a pipe, which is open
 * for writing only. */
motus_status target_lock(const char *path, int *descriptor, bool *regular, motus_error *);
/* Locks an open file, whose name says which kind of lock. Returns false if another program has the lock; true if the
 * file system has no locks. */
bool target_take(const char *path, int descriptor);
/* Returns whether another program writes the file. */
bool target_busy(const char *path, int descriptor);
int target_bytes(int descriptor, const char *, size_t count, size_t *written); /* returns an errno, or 0 */

#endif
