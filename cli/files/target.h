/* The files that rows and events are written into: what their names say, whether they may be written, their locks. */
#ifndef CLI_FILES_TARGET_H
#define CLI_FILES_TARGET_H

#include "cli/words/options.h"

bool target_npy(const char *path);
bool target_archive(const char *path);
/* The name of the .json beside a .npy, to be freed; NULL: no memory. */
char *target_beside(const char *path);

/* The endings of such files: the rows of shards that are being joined, those of a run that needs more room. The latter
 * ends as the names of archives do, since it is locked before it replaces one. Making one of these, and compressing an
 * archive, goes by way of ".new". */
#define ARCHIVE_JOINED ".joined"
#define ARCHIVE_GROWN ".grown.h5"
/* Whether an input has the name of a file that is made on the way to this archive. */
bool target_replaces(const char *archive, const char *input);
/* Removes what a killed program left beside an archive, which this program has locked. */
void target_tidy(const char *archive);

/* Whether the options allow to write this file, "-": standard output. */
motus_status target_check(const options *, const char *path, motus_error *);
/* Opens a regular file that no other program writes; *regular false: another one, for writing alone. */
motus_status target_lock(const char *path, int *descriptor, bool *regular, motus_error *);
/* Asks for the lock of the file of this name, by a descriptor of it; false: another program has it. Where the file
 * system has no locks, it is done without. */
bool target_take(const char *path, int descriptor);
/* Whether another program writes the file. */
bool target_busy(const char *path, int descriptor);
int target_bytes(int descriptor, const char *, size_t count, size_t *written); /* an errno, or 0 */

#endif
