/* Linux, and behind #else what POSIX alone can do. See platform.h. */
#ifdef __linux__
#define _GNU_SOURCE
#endif
#include "base/platform.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#endif

/* ---- processors ---- */

static void all_processors(uint64_t set[PLATFORM_SET])
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    memset(set, 0, PLATFORM_SET * sizeof *set);
    for (long k = 0; k < 64 * PLATFORM_SET && (k < 1 || k < count); k++) set[k / 64] |= (uint64_t)1 << k % 64;
}

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

void platform_set(uint64_t set[PLATFORM_SET])
{
    cpu_set_t mine;
    all_processors(set);
    if (sched_getaffinity(0, sizeof mine, &mine)) return;
    memset(set, 0, PLATFORM_SET * sizeof *set);
    for (int k = 0; k < 64 * PLATFORM_SET && k < CPU_SETSIZE; k++)
        if (CPU_ISSET(k, &mine)) set[k / 64] |= (uint64_t)1 << k % 64;
}

void platform_features(void (*line)(void *with, const char *text), void *with)
{
    static const char *const wanted[] = {"flags", "model", "cpu family", "vendor_id", "stepping", "Features", "CPU "};
    char text[4096];
    FILE *f = fopen("/proc/cpuinfo", "re");
    while (f && fgets(text, sizeof text, f) && text[0] != '\n') /* all cores are alike */
        for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++)
            if (!strncmp(text, wanted[k], strlen(wanted[k]))) line(with, text);
    if (f) fclose(f);
}

static double seconds_of(struct timeval t) { return (double)t.tv_sec + 1e-6 * (double)t.tv_usec; }

bool platform_thread(double *computed, int64_t *displaced)
{
    struct rusage used;
    if (getrusage(RUSAGE_THREAD, &used)) return false;
    *computed = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    *displaced = used.ru_nivcsw;
    return true;
}
#else
long platform_quota(const char *groups, const char *root) { return (void)groups, (void)root, 0; }

void platform_set(uint64_t set[PLATFORM_SET]) { all_processors(set); }
void platform_features(void (*line)(void *with, const char *text), void *with) { (void)line, (void)with; }
bool platform_thread(double *computed, int64_t *displaced) { return (void)computed, (void)displaced, false; }
#endif

long platform_processors(void)
{
    uint64_t set[PLATFORM_SET];
    long count = 0;
    platform_set(set);
    for (int k = 0; k < 64 * PLATFORM_SET; k++) count += set[k / 64] >> k % 64 & 1;
    const long quota = platform_quota("/proc/self/cgroup", "/sys/fs/cgroup");
    return quota && quota < count ? quota : count;
}

/* ---- files ---- */

#ifdef __linux__
int platform_nameless(const char *folder, int mode)
{
    char place[PLATFORM_PLACE];
    const int descriptor = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
    if (descriptor < 0 || access(platform_place(descriptor, place), F_OK) == 0) return descriptor;
    close(descriptor);
    return -1;
}

const char *platform_place(int descriptor, char out[PLATFORM_PLACE])
{
    snprintf(out, PLATFORM_PLACE, "/proc/self/fd/%d", descriptor);
    return out;
}

off_t platform_written(int descriptor, off_t at, off_t *end)
{
    const off_t begin = lseek(descriptor, at, SEEK_DATA);
    *end = begin < 0 ? begin : lseek(descriptor, begin, SEEK_HOLE);
    return *end < 0 ? -1 : begin;
}

static struct flock lock_behind(void)
{
    return (struct flock){.l_type = F_WRLCK, .l_whence = SEEK_SET, .l_start = (off_t)1 << 62, .l_len = 1};
}

bool platform_lock(int descriptor, bool behind)
{
    struct flock lock = lock_behind();
    const int failed = behind ? fcntl(descriptor, F_OFD_SETLK, &lock) : flock(descriptor, LOCK_EX | LOCK_NB);
    return !failed || !(errno == EWOULDBLOCK || (behind && errno == EACCES));
}

bool platform_locked(int descriptor, bool behind)
{
    struct flock lock = lock_behind();
    if (behind) return fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
    return flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

int platform_columns(int descriptor)
{
    struct winsize size = {0};
    return ioctl(descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}
#else
int platform_nameless(const char *folder, int mode) { return (void)folder, (void)mode, -1; }
const char *platform_place(int descriptor, char out[PLATFORM_PLACE]) { return (void)descriptor, *out = 0, out; }

off_t platform_written(int descriptor, off_t at, off_t *end)
{
    *end = lseek(descriptor, 0, SEEK_END);
    return *end < 0 ? -1 : at;
}

bool platform_lock(int descriptor, bool behind) { return (void)descriptor, (void)behind, true; }
bool platform_locked(int descriptor, bool behind) { return (void)descriptor, (void)behind, false; }
int platform_columns(int descriptor) { return (void)descriptor, 0; }
#endif

/* ---- processes ---- */

/* The tie is a pipe that this process holds open at one end and the group at the other. When the process ends, however
 * it does, the system closes its end, and kills the group.
 *
 * vfork copies no page tables, and a model may hold gigabytes. The child runs on the memory of this process until it
 * executes the program, so it changes no variable of it. */
enum { GROUP, PROCESS };
#ifdef __linux__
#define FORK vfork
bool platform_program(char *out, size_t size)
{
    const ssize_t length = readlink("/proc/self/exe", out, size);
    if (length <= 0 || (size_t)length >= size) return false;
    out[length] = 0;
    return true;
}

static bool open_tie(int tie[2]) { return pipe2(tie, O_CLOEXEC) == 0; }

/* Ties the child's process group to this process's end of the pipe; called in the child. */
static void tie_group(int end)
{
    if (end < 0) return;
    fcntl(end, F_SETFD, 0); /* every process that the program starts holds it */
    fcntl(end, F_SETOWN, -getpid());
    fcntl(end, F_SETSIG, SIGKILL);
    fcntl(end, F_SETFL, O_ASYNC);
}
#else
#define FORK fork
bool platform_program(char *out, size_t size) { return (void)out, (void)size, false; }
static bool open_tie(int tie[2]) { return (void)tie, false; }
static void tie_group(int end) { (void)end; }
#endif

/* Limits a resource of the child, in which only calls are made that are safe after fork. */
static void limit(int what, rlim_t most) { setrlimit(what, &(struct rlimit){most, most}); }

pid_t platform_start(const char *path, char *const *arguments, char *const *environment, int log, unsigned seconds,
                     size_t memory, int *tie)
{
    int ends[2];
    if (!open_tie(ends)) ends[GROUP] = ends[PROCESS] = -1;
    const pid_t parent = getpid(), child = FORK();
    if (child == 0) {
        setpgid(0, 0);
        tie_group(ends[GROUP]);
        if (getppid() != parent) _exit(127); /* it ended before */
        limit(RLIMIT_CPU, seconds);
        limit(RLIMIT_AS, memory);
        limit(RLIMIT_CORE, 0);
        const int none = open("/dev/null", O_RDWR);
        if (none >= 0) dup2(none, 0);
        dup2(log, 1);
        dup2(log, 2);
        execve(path, arguments, environment);
        _exit(127);
    }
    const int code = errno;
    if (ends[GROUP] >= 0) close(ends[GROUP]);
    if (child < 0 && ends[PROCESS] >= 0) close(ends[PROCESS]);
    *tie = child < 0 ? -1 : ends[PROCESS];
    errno = code;
    return child;
}
