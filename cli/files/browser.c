/* The browser as a child process.
 *
 * Invariant: there is no shell, and the address is one argument that begins with its scheme, so that a file's name is
 * never taken for an option or a command.
 */
#define _XOPEN_SOURCE 700
#include "cli/files/browser.h"

#include "cli/files/spawn.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef __APPLE__
#define OPENER "open"
#else
#define OPENER "xdg-open"
#endif

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
    /* $BROWSER is a list of programs in order of preference. An entry with arguments, "firefox -P work %s", fails to
     * start here; the system's opener reads $BROWSER too and can run it. */
    for (char *name = list, *end; name && *name && !good; name = end) {
        end = name + strcspn(name, ":");
        if (*end) *end++ = 0;
        good = *name && start(name, url);
    }
    free(list);
    return good || start(OPENER, url);
}
