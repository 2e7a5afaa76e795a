/* The program: what motus and motus-mpi share. */
#ifndef CLI_VERBS_PROGRAM_H
#define CLI_VERBS_PROGRAM_H

#include "cli/words/team.h"

/* Prepares the process, before anything else, MPI included: takes the descriptors 0 to 2 that are closed, so that no
 * file gets one of them and what is printed; and makes a write beyond the limit of `ulimit -f` fail and not kill. */
void program_begin(void);
/* Does what the command line says. Returns the exit status. A program that is alone has no team: NULL. */
int program_main(int argc, char **argv, const team *);

#endif
