/* Linux; elsewhere POSIX. See platform.h. */
#include "base/platform.h"

#include <limits.h>
#include <math.h>
#include <sched.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#ifdef __linux__
/* Reads the one or two numbers of a file below `root`; "max" becomes -1. Returns how many, below 1: none. */
static int read_numbers(const char *root, const char *group, const char *name, double *number)
{
    char path[PATH_MAX], text[64] = "";
    if ((size_t)snprintf(path, sizeof path, "%s%s/%s", root, group, name) >= sizeof path) return 0;
    FILE *f = fopen(path, "re");
    if (!f) return 0;
    const int there = fgets(text, sizeof text, f) != NULL;
    fclose(f);
    if (!strncmp(text, "max", 3)) return number[0] = -1, 1;
    return there ? sscanf(text, "%lf %lf", &number[0], &number[1]) : 0;
}

/* Finds the least quota of a group and those around it, which bound it. */
static double least_quota(const char *root, char *group, int version)
{
    double least = INFINITY;
    for (;;) {
        double quota[2] = {-1, 0};
        if (version == 1 && read_numbers(root, group, "cpu.cfs_quota_us", quota) == 1)
            read_numbers(root, group, "cpu.cfs_period_us", quota + 1);
        if (version == 2) read_numbers(root, group, "cpu.max", quota);
        if (quota[0] > 0 && quota[1] > 0) least = fmin(least, quota[0] / quota[1]);
        char *end = strrchr(group, '/');
        if (!end) return least;
        *end = 0;
    }
}

/* Reads the file of groups, whose lines are number:controllers:group; version 2 has no controllers. In a container the
 * group may be one that cannot be seen there; its files are then those of the root. */
long platform_quota(const char *groups, const char *root)
{
    double least = INFINITY;
    char line[PATH_MAX], place[PATH_MAX];
    FILE *f = fopen(groups, "re");
    while (f && fgets(line, sizeof line, f)) {
        line[strcspn(line, "\n")] = 0;
        char *what = strchr(line, ':'), *group = what ? strchr(what + 1, ':') : NULL;
        if (!group) continue;
        *what++ = *group++ = 0;
        if (!strcmp(group, "/")) group = "";
        char own[PATH_MAX];
        snprintf(own, sizeof own, "%s", group);
        const int version = *what ? 1 : 2;
        if (version == 1 && strcmp(what, "cpu") && strcmp(what, "cpu,cpuacct") && strcmp(what, "cpuacct,cpu")) continue;
        if ((size_t)snprintf(place, sizeof place, "%s%s", root, version == 1 ? "/cpu" : "") >= sizeof place) continue;
        least = fmin(least, least_quota(place, own, version));
    }
    if (f) fclose(f);
    return isinf(least) ? 0 : (long)ceil(fmin(least, 1e6));
}
#else
long platform_quota(const char *groups, const char *root) { return (void)groups, (void)root, 0; }
#endif

long platform_processors(void)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);
#ifdef __linux__
    cpu_set_t mine;
    if (!sched_getaffinity(0, sizeof mine, &mine)) count = CPU_COUNT(&mine);
#endif
    const long quota = platform_quota("/proc/self/cgroup", "/sys/fs/cgroup");
    if (quota && quota < count) count = quota;
    return count > 1 ? count : 1;
}
