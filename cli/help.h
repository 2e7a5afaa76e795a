/* The text of --help. */
#ifndef CLI_HELP_H
#define CLI_HELP_H

#include <stdio.h>

void help_program(FILE *);
void help_verb(FILE *, unsigned verb);

#endif
