/* See command.h. */
#include "cli/files/command.h"

#include "base/decimal.h"
#include "base/utf8.h"
#include "cli/words/complain.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

motus_status command_word(file_out *f, const char *word, motus_error *err)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
    bool quote = !*word || word[strspn(word, plain)];
    motus_status status = file_text(f, quote ? " '" : " ", err);
    while (!status && *word) {
        uint32_t c = 0;
        char bytes[16];
        size_t n = utf8_read(word, SIZE_MAX, &c);
        const bool good = n > 0;
        n += !good;
        if (c == '\'')
            status = file_text(f, "'\\''", err);
        else if (!good || !utf8_visible(c))
            for (size_t i = 0; !status && i < n; i++) {
                snprintf(bytes, sizeof bytes, "'$'\\x%02x''", (unsigned)(unsigned char)word[i]);
                status = file_text(f, bytes, err);
            }
        else
            status = file_write(f, word, n, err);
        word += n;
    }
    return status || !quote ? status : file_text(f, "'", err);
}

static motus_status put_texts(file_out *f, const option *row, const options_list *list, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t i = 0; !status && i < list->count; i++) {
        status = command_word(f, row->name, err);
        if (!status) status = command_word(f, list->items[i], err);
    }
    return status;
}

/* Writes an option and its value. */
static motus_status put(file_out *f, const options *o, const option *row, motus_error *err)
{
    const void *const place = (const char *)o + row->place;
    char number[DECIMAL_MAX], text[DECIMAL_MAX + 16];
    const char *value = text;
    switch (row->kind) {
    case FLAG: return command_word(f, row->name, err);
    case CHOICE:
    case WORD: value = *(const char *const *)place; break;
    case NUMBER:
    case POSITIVE:
    case LENGTH: decimal(*(const double *)place, text); break;
    case TOLERANCE:
        snprintf(text, sizeof text, "%s%s", decimal(*(const double *)place, number), o->absolute ? " absolute" : "");
        break;
    case COUNT:
    case SEED: decimal_write_whole(*(const uint64_t *)place, text); break;
    case EVERY:
        if (((const options_period *)place)->steps > 0)
            snprintf(text, sizeof text, "%" PRId64 " steps", ((const options_period *)place)->steps);
        else
            decimal(((const options_period *)place)->time, text);
        break;
    case NAMED:
    case TEXTS: return put_texts(f, row, place, err);
    case STATES:
    case ACCURACIES:
    case NAMES: value = o->given[row - options_row(0)]; break;
    }
    const motus_status status = command_word(f, row->name, err);
    return status ? status : command_word(f, value, err);
}

motus_status command_text(const options *o, char **text, motus_error *err)
{
    file_memory m;
    motus_status status = file_memory_open(&m, err);
    if (!status) status = file_text(&m.file, "motus ", err);
    if (!status) status = file_text(&m.file, options_verb(o->verb), err);
    if (!status) status = command_word(&m.file, o->operand, err);
    for (size_t k = 0; !status && k < OPTION_COUNT; k++) {
        const option *row = options_row(k);
        if (row->verbs & o->verb && row->setting & (OF_MOTION | OF_ROWS) && options_has(o, row))
            status = put(&m.file, o, row, err);
    }
    status = file_memory_close(&m, status, err);
    *text = m.text;
    return status;
}

void command_mix(uint64_t *hash, const void *bytes, size_t count)
{
    const unsigned char *s = bytes;
    for (size_t i = 0; i < count; i++) *hash = (*hash ^ s[i]) * 0x100000001B3;
}

void command_mix_text(uint64_t *hash, const char *text) { command_mix(hash, text, strlen(text) + 1); }

void command_mix_count(uint64_t *hash, uint64_t value) { command_mix(hash, &value, sizeof value); }

void command_mix_option(uint64_t *hash, const options *o, const option *row)
{
    const void *const place = (const char *)o + row->place;
    const options_list *const list = place;
    const bool mixed = row->print == PRINT_ALWAYS     ? true
                       : row->print == PRINT_ADAPTIVE ? !isnan(o->tolerance)
                                                      : row->print != PRINT_ELSEWHERE && options_has(o, row);
    if (!mixed) return;
    if (row->print == PRINT_NAMED) command_mix_text(hash, row->name);
    switch (row->kind) {
    case FLAG: command_mix_count(hash, *(const bool *)place); break;
    case CHOICE:
    case WORD: command_mix_text(hash, *(const char *const *)place); break;
    case EVERY:
    case STATES: command_mix_count(hash, (uint64_t)((const options_period *)place)->steps); break;
    case NAMES:
    case NAMED:
    case TEXTS:
        for (size_t i = 0; i < list->count; i++) command_mix_text(hash, list->items[i]);
        break;
    default: command_mix(hash, place, row->size);
    }
    if (row->print == PRINT_ADAPTIVE && row->kind == TOLERANCE) command_mix_count(hash, o->absolute);
}
