/* Another program as a child process.
 *
 * Invariant: there is no shell, so each argument arrives unchanged.
 */
#define _XOPEN_SOURCE 700
#include "cli/files/spawn.h"

#include <errno.h>
#include <signal.h>
#include <spawn.h>

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
