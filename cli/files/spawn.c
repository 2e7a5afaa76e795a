/* Another program as a child process, without a shell, so that each argument arrives unchanged. */
#include "cli/files/spawn.h"

#include "base/platform.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

extern char **environ;

int spawn_program(pid_t *process, char *const arguments[], const int streams[3], bool apart)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&actions) != 0) return ENOMEM;
    if (posix_spawnattr_init(&attributes) != 0) {
        posix_spawn_file_actions_destroy(&actions);
        return ENOMEM;
    }
    sigset_t plain;
    sigemptyset(&plain);
    sigaddset(&plain, SIGPIPE);
    sigaddset(&plain, SIGXFSZ);
    int code = posix_spawnattr_setsigdefault(&attributes, &plain);
    for (int i = 0; !code && i < 3; i++) code = posix_spawn_file_actions_adddup2(&actions, streams[i], i);
    const int group = apart ? POSIX_SPAWN_SETPGROUP : 0;
    if (!code && apart) code = posix_spawnattr_setpgroup(&attributes, 0);
    if (!code) code = posix_spawnattr_setflags(&attributes, (short)(POSIX_SPAWN_SETSIGDEF | group));
    if (!code) code = posix_spawnp(process, arguments[0], &actions, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return code;
}

/* ---- the browser: its address begins with a scheme, so that no file name is taken for an option ---- */

static bool start(const char *program, const char *url)
{
    char *const arguments[] = {(char *)program, (char *)url, NULL};
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    pid_t process;
    const bool good = nothing >= 0 && spawn_program(&process, arguments, (int[]){nothing, nothing, nothing}, true) == 0;
    if (nothing >= 0) close(nothing);
    return good;
}

bool browser_open(const char *url)
{
    const char *wanted = getenv("BROWSER");
    char *list = strdup(wanted ? wanted : "");
    bool good = false;
    /* $BROWSER is a list of programs in order of preference. An entry with arguments, "firefox -P work %s", cannot
     * start here; the system's opener reads $BROWSER too and can start it. */
    for (char *name = list, *end; name && *name && !good; name = end) {
        end = name + strcspn(name, ":");
        if (*end) *end++ = 0;
        good = *name && start(name, url);
    }
    free(list);
    return good || start(PLATFORM_OPENER, url);
}
