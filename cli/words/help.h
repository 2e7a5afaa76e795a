/* The text of --help. */
#ifndef CLI_WORDS_HELP_H
#define CLI_WORDS_HELP_H

#include <stdio.h>

void help_program(FILE *);
void help_verb(FILE *, unsigned verb);
/* The table of verbs and options, for programs, a row a line, with tabs between:
 *     verb, name, operands, what it does
 *     option, --name, -n, argument, verbs, of what it is a setting, words for its value, help, more; - for nothing */
void help_table(FILE *);

#endif
