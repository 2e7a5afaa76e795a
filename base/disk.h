/* Files that survive a power cut, and names beside a file for what is not yet complete. */
#ifndef BASE_DISK_H
#define BASE_DISK_H

#include <stdbool.h>

/* Brings everything written to the disk. False: errno says why not; a real failure is EIO, ENOSPC or EDQUOT, and a file
 * system that cannot synchronise is none. */
bool disk_sync(int descriptor);
/* Brings the name of the file, or of the file to which a link leads, to the disk. A folder that cannot be opened is
 * left alone. */
void disk_sync_name(const char *path);

/* Returns where a link leads, or the path if no such file exists yet. The caller frees it; NULL: no memory. */
char *disk_real(const char *path);
/* Returns the name with an ending, for a file in its folder. The caller frees it; NULL: no memory. */
char *disk_beside(const char *name, const char *ending);
/* Puts a complete file in the place of another, atomically and for good. False: errno says why not. */
bool disk_replace(const char *from, const char *name);

/* Opens a file without a name in the folder of `name`: see platform_nameless. */
int disk_nameless(const char *name, int mode);
/* Gives such a file its name, in place of a file that has it, atomically and for good. False: errno says why not. */
bool disk_name(int descriptor, const char *name);

#endif
