/* What the library takes from the operating system beyond C and POSIX. A port is another platform.c. */
#ifndef BASE_PLATFORM_H
#define BASE_PLATFORM_H

/* How many processors this process may use: those it may run on, and no more than the quota of its container. 1 where
 * that is not known. */
long platform_processors(void);

/* How many processors the quotas of a process's control groups leave it, rounded up; 0: all. `groups` names its groups
 * as /proc/self/cgroup does; the files with their quotas, of version 1 or 2, lie below `root`, /sys/fs/cgroup. */
long platform_quota(const char *groups, const char *root);

#endif
