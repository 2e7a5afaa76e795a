/* What the library takes from the operating system beyond C and POSIX. A port is another platform.c. */
#ifndef BASE_PLATFORM_H
#define BASE_PLATFORM_H

/* Returns how many processors this process may use, within the quota of its container; 1: that is not known. */
long platform_processors(void);

/* Returns how many processors the quotas of a process's control groups leave it, rounded up; 0: all. groups: a file as
 * /proc/self/cgroup, which names them; root: /sys/fs/cgroup, below which their files lie, of version 1 or 2. */
long platform_quota(const char *groups, const char *root);

#endif
