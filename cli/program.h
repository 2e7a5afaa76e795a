/* The program: what motus and motus-mpi have in common. */
#ifndef CLI_PROGRAM_H
#define CLI_PROGRAM_H

#include "cli/team.h"

/* Does what the words say; returns the exit status. NULL: it is alone. */
int program_main(int argc, char **argv, const team *);

#endif
