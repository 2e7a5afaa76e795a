/* Another program as a child process. */
#ifndef CLI_FILES_SPAWN_H
#define CLI_FILES_SPAWN_H

#include <stdbool.h>
#include <sys/types.h>

/* Starts the program arguments[0], found by PATH unless it has a slash, with these descriptors as its standard input,
 * output and error. SIGPIPE, which motus ignores, has its default action there. apart: in a process group of its own,
 * so that Ctrl-C does not reach it. Returns 0 or an errno. */
int spawn_program(pid_t *, char *const arguments[], const int streams[3], bool apart);

/* Starts $BROWSER, else the system's program for opening addresses, without waiting for it or showing its output.
 * False: none could be started. */
bool browser_open(const char *url);

#endif
