/* The command that makes a file of results, with every setting written out, and its fingerprint. */
#ifndef CLI_FILES_COMMAND_H
#define CLI_FILES_COMMAND_H

#include "cli/files/file.h"
#include "cli/words/options.h"

/* The command of these options, to be freed also after a failure: of settings those of the motion and of its rows. */
motus_status command_text(const options *, char **text, motus_error *);

/* A hash, FNV-1a of 64 bits: detects mistakes, not attacks. */
#define COMMAND_HASH UINT64_C(0xCBF29CE484222325)
void command_mix(uint64_t *hash, const void *bytes, size_t count);
void command_mix_text(uint64_t *hash, const char *); /* with its byte 0 */
void command_mix_count(uint64_t *hash, uint64_t);
/* Mixes the value of a row in, as its option_print says; a period counts steps. */
void command_mix_option(uint64_t *hash, const options *, const option *);

/* A blank and a word of a command, quoted for a shell, control characters as $'\xNN'; words_split() undoes it. */
motus_status command_word(file_out *, const char *word, motus_error *);

#endif
