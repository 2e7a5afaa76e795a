/* Compilers that tests of waiting make: scripts, and what they leave behind. */
#ifndef TEST_LATER_H
#define TEST_LATER_H

#include "test/given.h"
#include "test/given_cache.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <sys/wait.h>
#include <time.h>

static char tools[] = "/tmp/motus-tools-XXXXXX";

UNUSED static void remove_tools(void)
{
    char command[100];
    snprintf(command, sizeof command, "rm -rf %s", tools);
    if (system(command)) print_message("%s stays\n", tools);
}

/* Makes `CC` a script, and empties the cache. */
UNUSED static void compile_by(const char *text)
{
    char path[200];
    snprintf(path, sizeof path, "%s/cc", tools);
    unlink(path);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fprintf(f, "#!/bin/sh\n%s\n", text);
    fclose(f);
    assert_int_equal(chmod(path, 0700), 0);
    setenv("CC", path, 1);
    motus_cache_clear();
}

/* A compiler that counts its calls. */
UNUSED static void compile_and_count(const char *more)
{
    char script[300];
    snprintf(script, sizeof script, "echo \"$@\" >> %s/calls\n%s\nexec cc \"$@\"", tools, more);
    compile_by(script);
}

/* How often it has compiled since the last question. */
UNUSED static int calls(void)
{
    char path[200], line[600];
    int n = 0;
    snprintf(path, sizeof path, "%s/calls", tools);
    FILE *f = fopen(path, "r");
    while (f && fgets(line, sizeof line, f)) n += strstr(line, "model.c") != NULL;
    if (f) fclose(f);
    unlink(path);
    return n;
}

/* A compiler that never ends, and starts another process that never ends. */
UNUSED static void compile_for_ever(void)
{
    char script[300];
    snprintf(script, sizeof script, "sleep 1000 &\necho $! > %s/new\nmv %s/new %s/child\nwait", tools, tools, tools);
    compile_by(script);
}

/* The number of that process. */
UNUSED static pid_t its_child(void)
{
    char path[200];
    int pid = 0;
    snprintf(path, sizeof path, "%s/child", tools);
    for (int i = 0; i < 5000 && pid == 0; i++) {
        FILE *f = fopen(path, "r");
        if (f && fscanf(f, "%d\n", &pid) != 1) pid = 0;
        if (f) fclose(f);
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    }
    unlink(path);
    assert_true(pid > 0 && kill(pid, 0) == 0);
    return pid;
}

/* A process that is gone, or that nobody has waited for yet. */
UNUSED static bool dead(pid_t pid)
{
    char path[64], state = 'R';
    for (int i = 0; i < 5000; i++) {
        snprintf(path, sizeof path, "/proc/%d/stat", (int)pid);
        FILE *f = fopen(path, "r");
        if (!f) return kill(pid, 0) != 0;
        if (fscanf(f, "%*d (%*[^)]) %c", &state) != 1) state = 'X';
        fclose(f);
        if (state == 'Z' || state == 'X') return true;
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    }
    return false;
}

/* Entries of the cache's folder that are not objects: folders of compilers. */
UNUSED static int folders(void)
{
    char path[600];
    snprintf(path, sizeof path, "%s/motus", given_cache);
    DIR *d = opendir(path);
    int n = 0;
    for (struct dirent *e; d && (e = readdir(d));) n += e->d_name[0] != '.' && !strstr(e->d_name, ".so");
    if (d) closedir(d);
    return n;
}

UNUSED static void nothing_is_left(const char *what)
{
    errno = 0;
    if (waitpid(-1, NULL, WNOHANG) != -1 || errno != ECHILD) fail_msg("%s: a process is left", what);
    if (folders()) fail_msg("%s: a folder is left", what);
}

#endif
