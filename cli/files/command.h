/* The command that makes a file of results, with every setting written out, and its fingerprint. */
#ifndef CLI_FILES_COMMAND_H
#define CLI_FILES_COMMAND_H

#include "cli/files/file.h"
#include "cli/words/options.h"

/* Writes a command with the settings of the motion and of its rows. The caller frees *text, also after a failure. */
motus_status command_text(const options *, char **text, motus_error *);

/* Mix values into a hash, FNV-1a of 64 bits, which detects mistakes, not attacks. */
#define COMMAND_HASH UINT64_C(0xCBF29CE484222325)
void command_mix(uint64_t *hash, const void *bytes, size_t count);
void command_mix_text(uint64_t *hash, const char *); /* with its byte 0 */
void command_mix_count(uint64_t *hash, uint64_t);
/* Mixes in the value of an option, as its option_print says; of a period, the steps. */
void command_mix_option(uint64_t *hash, const options *, const option *);

/* Writes a blank and a word, quoted for a shell, with control characters as $'\xNN'. words_split() reads it. */
motus_status command_word(file_out *, const char *word, motus_error *);

#endif
