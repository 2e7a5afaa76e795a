/* Another program as a child process. */
#ifndef CLI_SPAWN_H
#define CLI_SPAWN_H

#include <stdbool.h>
#include <sys/types.h>

/* Starts the program of that name, by PATH unless it has a slash, with these descriptors as its input, output and
 * messages. SIGPIPE, which motus ignores, ends it as usual. apart: in a process group of its own, for which Ctrl-C
 * in the terminal is not meant. 0, or the number of the error. */
int spawn_program(pid_t *, char *const arguments[], const int streams[3], bool apart);

#endif
