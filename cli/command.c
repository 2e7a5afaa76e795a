/* See command.h. */
#include "cli/command.h"

#include "base/decimal.h"
#include "cli/csv.h"

#include <string.h>

motus_status command_option(file_out *f, const char *name, const char *value, motus_error *err)
{
    motus_status status = csv_word(f, name, err);
    return status || !value ? status : csv_word(f, value, err);
}

motus_status command_number(file_out *f, const char *name, double value, motus_error *err)
{
    char text[DECIMAL_MAX];
    decimal(value, text);
    return command_option(f, name, text, err);
}

motus_status command_whole(file_out *f, const char *name, uint64_t value, motus_error *err)
{
    char text[DECIMAL_MAX];
    decimal_write_whole(value, text);
    return command_option(f, name, text, err);
}

void command_mix(uint64_t *hash, const void *bytes, size_t count)
{
    const unsigned char *s = bytes;
    for (size_t i = 0; i < count; i++) *hash = (*hash ^ s[i]) * 0x100000001B3;
}

void command_mix_text(uint64_t *hash, const char *text) { command_mix(hash, text, strlen(text) + 1); }
