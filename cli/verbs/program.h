/* The program: what motus and motus-mpi have in common. */
#ifndef CLI_VERBS_PROGRAM_H
#define CLI_VERBS_PROGRAM_H

#include "cli/words/team.h"

/* Before anything else, MPI included: opens the descriptors 0 to 2 where they are closed, so that no file gets one of
 * them and with it what is printed; and makes a limit of the size of files (ulimit -f) a failed write. */
void program_begin(void);
/* Does what the words say; returns the exit status. NULL: it is alone. */
int program_main(int argc, char **argv, const team *);

#endif
