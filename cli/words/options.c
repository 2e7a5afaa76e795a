/* The command line, read by the table of options. */
#include "cli/words/options.h"

#include "base/near.h"
#include "cli/words/complain.h"
#include "cli/words/words.h"

#include <math.h>
#include <string.h>

static bool matches(const option *o, const char *name)
{
    return strcmp(o->name, name) == 0 || (o->brief && strcmp(o->brief, name) == 0);
}

/* Makes the error for an option that only other verbs have. */
static motus_status not_here(const char *name, unsigned verb, motus_error *err)
{
    char its[128] = "";
    for (size_t i = 0; i < OPTION_COUNT; i++)
        for (unsigned bit = 1; bit < VERB_ALL && strcmp(options_row(i)->name, name) == 0; bit <<= 1)
            if (options_row(i)->verbs & bit)
                snprintf(its + strlen(its), sizeof its - strlen(its), "%s%s", its[0] ? ", " : "", options_verb(bit));
    fail(err, MOTUS_ARGUMENT, "motus %s takes no %s", options_verb(verb), name);
    hint(err, "%s belongs to: %s", name, its);
    const size_t length = strlen(name);
    for (size_t i = 0; i < OPTION_COUNT; i++) /* --methods for --method */
        if (options_row(i)->verbs & verb && strncmp(options_row(i)->name, name, length) == 0 &&
            !strcmp(options_row(i)->name + length, "s"))
            options_hint(options_row(i), err);
    return MOTUS_ARGUMENT;
}

/* Finds the row of this verb's option `name`. */
static motus_status find(const char *name, unsigned verb, size_t *found, motus_error *err)
{
    const char *elsewhere = NULL, *near = NULL;
    int distance = 6;
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const option *o = options_row(i);
        if (matches(o, name) && o->verbs & verb) {
            *found = i;
            return MOTUS_OK;
        }
        if (matches(o, name)) elsewhere = o->name;
        const int d = near_distance(o->name, name, distance);
        if (o->verbs & verb && d < distance) near = o->name, distance = d;
    }
    if (elsewhere) return not_here(elsewhere, verb, err);
    fail(err, MOTUS_ARGUMENT, "unknown option %s", name);
    if (strcmp(name, "--from") == 0)
        hint(err, "the start is the constant c in x(c) = ..., in the model");
    else if (near)
        hint(err, "did you mean %s?", near);
    else
        hint(err, "motus %s --help lists the options", options_verb(verb));
    return MOTUS_ARGUMENT;
}

static void forget(options *o, size_t k)
{
    const option *row = options_row(k);
    void *place = (char *)o + row->place;
    o->given[k] = NULL;
    if (row->kind >= NAMES) words_free(place);
    memset(place, 0, row->size);
    if (row->kind == NUMBER || row->kind == POSITIVE || row->kind == TOLERANCE || row->kind == ACCURACIES)
        *(double *)place = NAN;
}

void options_forget(options *o, unsigned settings)
{
    for (size_t k = 0; k < OPTION_COUNT; k++)
        if (options_row(k)->setting & settings) forget(o, k);
}

void options_take(options *o, const options *from, unsigned settings)
{
    for (size_t k = 0; k < OPTION_COUNT; k++)
        if (options_row(k)->setting & settings) {
            o->given[k] = from->given[k];
            memcpy((char *)o + options_row(k)->place, (const char *)from + options_row(k)->place, options_row(k)->size);
        }
}

void options_free(options *o)
{
    words_free(&o->files);
    options_forget(o, OF_MOTION);
}

motus_switches options_switches(const options *o)
{
    if (!o->switches) return MOTUS_SWITCHES_USUAL;
    return strcmp(o->switches, "locate") ? MOTUS_SWITCHES_STEP : MOTUS_SWITCHES_LOCATE;
}

motus_bars options_bars(const options *o)
{
    if (!o->error) return MOTUS_BARS_CHEAP;
    return !strcmp(o->error, "none") ? MOTUS_BARS_NONE : !strcmp(o->error, "full") ? MOTUS_BARS_FULL : MOTUS_BARS_CHEAP;
}

motus_status options_read(options *o, unsigned verb, int argc, char **argv, int first, motus_error *err)
{
    *o = (options){.verb = verb, .argc = argc, .argv = argv};
    for (size_t k = 0; k < OPTION_COUNT; k++) forget(o, k);
    bool only_operands = false;
    for (int i = first; i < argc; i++) {
        char *word = argv[i];
        if (!only_operands && strcmp(word, "--") == 0) {
            only_operands = true;
            continue;
        }
        if (only_operands || word[0] != '-' || !word[1]) {
            if (verb == VERB_MERGE) {
                const motus_status status = words_add(&o->files, word, err);
                if (status) return status;
                continue;
            }
            if (o->operand)
                return complain(err, MOTUS_ARGUMENT, "quote a name that has blanks", "%s after %s: motus takes one %s",
                                word, o->operand,
                                verb == VERB_METHODS   ? "method"
                                : verb == VERB_ARCHIVE ? "archive"
                                                       : "model");
            o->operand = word;
            continue;
        }
        char name[64];
        char *equals = word[1] == '-' ? strchr(word, '=') : NULL;
        size_t length = equals ? (size_t)(equals - word) : strlen(word);
        snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1), word);
        size_t k = 0;
        motus_status status = find(name, verb, &k, err);
        if (status) return status;
        const option *row = options_row(k);
        const char *value = equals ? equals + 1 : NULL;
        if (row->kind == FLAG && value) return fail(err, MOTUS_ARGUMENT, "%s takes no value", row->name);
        if (row->kind != FLAG && !value && i + 1 == argc) {
            fail(err, MOTUS_ARGUMENT, "%s: its value is missing", row->name);
            options_hint(row, err);
            return MOTUS_ARGUMENT;
        }
        if (row->kind != FLAG && !value) value = argv[++i];
        status = options_value(o, k, row->kind == FLAG ? "" : value, err);
        if (status) return status;
    }
    return MOTUS_OK;
}
