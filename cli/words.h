/* The words of a command line, as csv_word() has written them. */
#ifndef CLI_WORDS_H
#define CLI_WORDS_H

#include "cli/options.h"

/* Words are separated by blanks; in one, what is between two ' is taken as it is, $'\xNN' is a byte, and \ takes the
 * next character so. The items point into *memory, and there is room for two more; the caller frees it and the list's
 * items, also after a failure. */
motus_status words_split(const char *text, char **memory, options_list *, motus_error *);

#endif
