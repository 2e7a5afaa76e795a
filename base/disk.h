/* Files that survive a power cut, and names beside a file for what is not complete yet. */
#ifndef BASE_DISK_H
#define BASE_DISK_H

#include <stdbool.h>

/* Everything written is on the disk. False: errno says why not; a real failure to write reports EIO, ENOSPC or EDQUOT,
 * and a file system that cannot synchronise is no failure. */
bool disk_sync(int descriptor);
/* So is the name of the file, or of the file to which the link leads. A folder that cannot be opened is left alone. */
void disk_sync_name(const char *path);

/* Where a link leads; the path itself where there is no such file yet. The caller frees it; NULL: no memory. */
char *disk_real(const char *path);
/* The name with an ending, for a file in the same folder. The caller frees it; NULL: no memory. */
char *disk_beside(const char *name, const char *ending);
/* Puts a complete file in the place of another, atomically and for good. False: errno says why not. */
bool disk_replace(const char *from, const char *name);

/* A file in the folder of `name` that has no name, so that it is gone with its last descriptor, however the program
 * ends. -1: the system has none, or could not name it later. */
int disk_nameless(const char *name, int mode);
enum { DISK_PLACE = 40 };
/* By which name such a file can be opened as long as the descriptor is. Returns out. */
const char *disk_place(int descriptor, char out[DISK_PLACE]);
/* Gives it the name, in place of a file that has it, atomically and for good. False: errno says why not. */
bool disk_name(int descriptor, const char *name);

#endif
