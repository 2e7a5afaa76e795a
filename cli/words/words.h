/* Lists of words: those of a command line, as command_word() has written them, and of the value of an option. */
#ifndef CLI_WORDS_WORDS_H
#define CLI_WORDS_WORDS_H

#include "cli/words/options.h"

/* Words are separated by blanks; in one, what is between two ' is taken as it is, $'\xNN' is a byte, and \ takes the
 * next character so. The items point into *memory, and there is room for two more; the caller frees it and the list's
 * items, also after a failure. */
motus_status words_split(const char *text, char **memory, options_list *, motus_error *);

/* Splits "x,r.x,u[1,2]" at the commas outside brackets. */
motus_status words_part(const char *text, const char *option, options_list *, motus_error *);
motus_status words_add(options_list *, const char *, motus_error *);
void words_free(options_list *);

#endif
