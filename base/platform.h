/* What motus takes from the operating system beyond C and POSIX. A port is another platform.c; what a system cannot do
 * has an answer there with which motus goes on. */
#ifndef BASE_PLATFORM_H
#define BASE_PLATFORM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

/* ---- processors ---- */

/* Returns how many processors this process may use, within the quota of its container; 1: that is not known. */
long platform_processors(void);

/* Returns how many processors the quotas of a process's control groups leave it, rounded up; 0: all. groups: a file as
 * /proc/self/cgroup, which names them; root: /sys/fs/cgroup, below which their files lie, of version 1 or 2. */
long platform_quota(const char *groups, const char *root);

enum { PLATFORM_SET = 16 };
/* Writes the set of processors on which this process may run: bit k % 64 of word k / 64 is processor k. */
void platform_set(uint64_t set[PLATFORM_SET]);

/* Calls `line` with every line of text that tells kinds of processors apart. */
void platform_features(void (*line)(void *with, const char *text), void *with);

/* Tells the seconds of processor time of this thread, and how often it lost its processor although it could go on.
 * False: the system does not count that. */
bool platform_thread(double *computed, int64_t *displaced);

/* ---- files ---- */

/* Opens a file without a name in a folder; it is gone with its last descriptor, however the program ends. -1: the
 * system has no such files, or could not name them later. */
int platform_nameless(const char *folder, int mode);
enum { PLATFORM_PLACE = 40 };
/* Writes the name by which such a file can be opened while the descriptor is open. Returns out. */
const char *platform_place(int descriptor, char out[PLATFORM_PLACE]);

/* Finds the first byte from `at` on that is no hole, and the end of what is written from there on. -1: errno says why;
 * ENXIO: only a hole follows. */
off_t platform_written(int descriptor, off_t at, off_t *end);

/* Locks a file for this descriptor alone; `behind`: by a byte far behind its end, which leaves locks of the whole file
 * to others. False: another descriptor has the lock. True also where the file system has no locks. */
bool platform_lock(int descriptor, bool behind);
/* Returns whether another descriptor has the lock. */
bool platform_locked(int descriptor, bool behind);

/* ---- the terminal ---- */

/* Returns how many columns the terminal of a descriptor has; 0: it is none, or that is not known. */
int platform_columns(int descriptor);

/* ---- processes ---- */

#define PLATFORM_OPENER "xdg-open" /* the program that opens an address in the user's browser */

/* Writes the path of the program of this process. False: it is not known. */
bool platform_program(char *out, size_t size);

/* Starts a program without input, whose output goes to `log`, in a process group of its own, within limits of processor
 * time and memory. The group ends when this process ends, or closes *tie; *tie is -1 if the system has no such means.
 * Returns the process, or -1: errno says why. */
pid_t platform_start(const char *path, char *const *arguments, char *const *environment, int log, unsigned seconds,
                     size_t memory, int *tie);

#endif
