/* The words of a command that makes a file of results, with every setting written out. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include "cli/file.h"

/* An option and its value; NULL: it has none. */
motus_status command_option(file_out *, const char *name, const char *value, motus_error *);
motus_status command_number(file_out *, const char *name, double value, motus_error *);
motus_status command_whole(file_out *, const char *name, uint64_t value, motus_error *);

/* A hash, FNV-1a of 64 bits: detects mistakes, not attacks. */
#define COMMAND_HASH UINT64_C(0xCBF29CE484222325)
void command_mix(uint64_t *hash, const void *bytes, size_t count);
void command_mix_text(uint64_t *hash, const char *); /* with its byte 0 */

#endif
