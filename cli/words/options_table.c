/* The table of options, made from cli/words/options.def. */
#include "base/error.h"
#include "cli/words/options.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum {
    STUDY = VERB_COMPARE | VERB_CONVERGE,
    ONE = VERB_RUN | VERB_SWEEP,
    STEPS = ONE | VERB_COMPARE | VERB_LAB, /* converge has steps of its own */
    SOLVES = ONE | STUDY | VERB_LAB,
    MODEL = SOLVES | VERB_CHECK
};

static const option table[] = {
#define OPTION(type, member, ...) {.kind = type, offsetof(options, member), sizeof(TYPE_##type), __VA_ARGS__},
#define OPTION_AGAIN(type, member, ...) {.kind = type, offsetof(options, member), sizeof(TYPE_##type), __VA_ARGS__},
#include "cli/words/options.def"
};

const option *options_row(size_t k) { return &table[k]; }

const char *options_plain(const char *help, char out[OPTIONS_HELP])
{
    size_t n = 0;
    for (; *help && n + 1 < OPTIONS_HELP; help++)
        if (*help != '`') out[n++] = *help;
    out[n] = 0;
    return out;
}

void options_hint(const option *row, motus_error *err)
{
    char help[OPTIONS_HELP];
    hint(err, "%s%s%s: %s", row->name, row->argument ? " " : "", row->argument ? row->argument : "",
         options_plain(row->help, help));
}

static const char *const verbs[] = {
#define VERB(bit, name, ...) #name,
#include "cli/words/options.def"
};

const char *options_verb(unsigned verb)
{
    size_t k = 0;
    while (verb >> k > 1) k++;
    return verbs[k];
}

/* Compares an option with a member of a definition, which has '_' where the option has '-'. */
static bool alike(const char *option, const char *member, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (option[i] != (member[i] == '_' ? '-' : member[i])) return false;
    return true;
}

bool options_known(const char *name, size_t length)
{
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if (strlen(table[i].name) == 2 + length && alike(table[i].name + 2, name, length)) return true;
    return false;
}

bool options_has(const options *o, const option *row)
{
    const void *place = (const char *)o + row->place;
    switch (row->kind) {
    case FLAG: return *(const bool *)place;
    case CHOICE:
    case WORD: return *(const char *const *)place;
    case NUMBER:
    case POSITIVE:
    case TOLERANCE:
    case ACCURACIES: return !isnan(*(const double *)place);
    case LENGTH: return *(const double *)place > 0;
    case COUNT: return *(const int64_t *)place > 0;
    case SEED: return o->given[row - table];
    case EVERY:
    case STATES: return ((const options_period *)place)->time > 0 || ((const options_period *)place)->steps > 0;
    case NAMES:
    case NAMED:
    case TEXTS: return ((const options_list *)place)->count > 0;
    }
    return false;
}
