/* Programs: started without a shell, timed from before the start to after the end, with what memory they took at most.
 *
 * Invariant: motus' cache and numba's are in a directory of the bench's own, which goes with it.
 */
#include "bench/bench.h"

#include <fcntl.h>
#include <ftw.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static char directory[256];

static int drop(const char *path, const struct stat *s, int kind, struct FTW *where)
{
    (void)s, (void)kind;
    return where->level == 0 ? 0 : remove(path);
}

bool process_open(void)
{
    const char *base = getenv("TMPDIR");
    snprintf(directory, sizeof directory, "%s/motus-bench-XXXXXX", base && *base ? base : "/tmp");
    if (!mkdtemp(directory)) {
        directory[0] = 0;
        return false;
    }
    return !setenv("XDG_CACHE_HOME", directory, 1) && !setenv("NUMBA_CACHE_DIR", directory, 1) &&
           !setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
}

void process_forget(void)
{
    if (directory[0]) nftw(directory, drop, 16, FTW_DEPTH | FTW_PHYS);
}

void process_close(void)
{
    process_forget();
    if (directory[0]) rmdir(directory);
}

process process_run(const char *const *words)
{
    process p = {.status = -1};
    int ends[2];
    if (pipe(ends)) return p;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t pid;
    double start = now();
    int failed = posix_spawnp(&pid, words[0], &actions, NULL, (char *const *)words, environ);
    close(ends[1]);
    posix_spawn_file_actions_destroy(&actions);
    if (!failed) {
        char text[4096];
        size_t kept = 0;
        for (ssize_t n; (n = read(ends[0], text, sizeof text)) > 0;)
            for (ssize_t k = 0; k < n && kept + 1 < sizeof p.out; k++) p.out[kept++] = text[k];
        p.out[kept] = 0;
        p.out[strcspn(p.out, "\n")] = 0;
        struct rusage used;
        int status;
        if (wait4(pid, &status, 0, &used) == pid) {
            p.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
            p.kilobytes = used.ru_maxrss;
        }
        p.seconds = now() - start;
    }
    close(ends[0]);
    return p;
}

const char *process_motus(void)
{
    const char *given = getenv("MOTUS");
    return given && *given ? given : "build/motus";
}

const char *process_python(void)
{
    static const char *const names[] = {"python3", "/usr/bin/python3"};
    for (int k = 0; k < 2; k++) {
        const char *words[] = {names[k], "-c", "import numpy", NULL};
        if (process_run(words).status == 0) return names[k];
    }
    return NULL;
}
