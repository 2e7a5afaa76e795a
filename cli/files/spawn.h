/* Another program as a child process. */
#ifndef CLI_FILES_SPAWN_H
#define CLI_FILES_SPAWN_H

#include <stdbool.h>
#include <sys/types.h>

/* Starts the program arguments[0], which PATH finds unless the name has a slash, with `streams` as its standard input,
 * output and error. SIGPIPE, which motus ignores, has its default action in it. `apart` puts it into a process group of
 * its own, which Ctrl-C does not reach. Returns 0 or an errno. */
int spawn_program(pid_t *, char *const arguments[], const int streams[3], bool apart);

/* Starts $BROWSER, or else the system's program that opens addresses, and does not wait for it or show its output.
 * Returns false if neither could be started. */
bool browser_open(const char *url);

#endif
