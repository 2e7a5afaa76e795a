/* The command that makes a file of results, with every setting written out, and its fingerprint. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include "cli/file.h"
#include "cli/options.h"

/* The command of these options, to be freed also after a failure: of settings those of the motion and of its rows. */
motus_status command_text(const options *, char **text, motus_error *);

/* A hash, FNV-1a of 64 bits: detects mistakes, not attacks. */
#define COMMAND_HASH UINT64_C(0xCBF29CE484222325)
void command_mix(uint64_t *hash, const void *bytes, size_t count);
void command_mix_text(uint64_t *hash, const char *); /* with its byte 0 */
void command_mix_count(uint64_t *hash, uint64_t);
/* Mixes the value of a row in, as its option_print says; a period counts steps. */
void command_mix_option(uint64_t *hash, const options *, const option *);

#endif
