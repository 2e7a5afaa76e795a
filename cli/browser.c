/* The browser as a child process.
 *
 * Invariant: there is no shell, and the address is one argument that begins with its scheme, so that no name of a file is taken for
 * an option or a command.
 */
#define _XOPEN_SOURCE 700
#include "cli/browser.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

extern char **environ;

#ifdef __APPLE__
#define OPENER "open"
#else
#define OPENER "xdg-open"
#endif

/* A group of its own: Ctrl-C in the terminal is not meant for it. */
static bool prepare(posix_spawn_file_actions_t *actions, posix_spawnattr_t *attributes)
{
    static const char nothing[] = "/dev/null";
    sigset_t plain;
    sigemptyset(&plain);
    sigaddset(&plain, SIGPIPE);
    return posix_spawn_file_actions_addopen(actions, STDIN_FILENO, nothing, O_RDONLY, 0) == 0 &&
           posix_spawn_file_actions_addopen(actions, STDOUT_FILENO, nothing, O_WRONLY, 0) == 0 &&
           posix_spawn_file_actions_adddup2(actions, STDOUT_FILENO, STDERR_FILENO) == 0 &&
           posix_spawnattr_setsigdefault(attributes, &plain) == 0 && posix_spawnattr_setpgroup(attributes, 0) == 0 &&
           posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP) == 0;
}

static bool start(const char *program, const char *url)
{
    char *const arguments[] = {(char *)program, (char *)url, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    pid_t process;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return false;
    if (posix_spawnattr_init(&attributes) != 0) {
        posix_spawn_file_actions_destroy(&actions);
        return false;
    }
    bool good = prepare(&actions, &attributes) && posix_spawnp(&process, program, &actions, &attributes, arguments, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return good;
}

bool browser_open(const char *url)
{
    const char *wanted = getenv("BROWSER");
    char *list = strdup(wanted ? wanted : "");
    bool good = false;
    /* a list of programs, the best one first; what is more than the name of one, "firefox -P work %s", the opener understands */
    for (char *name = list, *end; name && *name && !good; name = end) {
        end = name + strcspn(name, ":");
        if (*end)
            *end++ = 0;
        good = *name && start(name, url);
    }
    free(list);
    return good || start(OPENER, url);
}
