/* Options that do not go together.
 *
 * Invariant: rows of the table say which options need or exclude others; here is what depends on their values, too.
 */
#include "cli/words/complain.h"
#include "cli/words/options.h"

#include <math.h>
#include <string.h>

/* Returns the row of the next of the verb's options in a list of names, and moves the list behind it; NULL: there is
 * none. */
static const option *next(const char **names, unsigned verb)
{
    while (**names) {
        const char *name = *names += strspn(*names, " ");
        const size_t length = strcspn(name, " ");
        *names += length;
        for (size_t k = 0; k < OPTION_COUNT; k++) {
            const option *row = options_row(k);
            if (row->verbs & verb && strncmp(row->name, name, length) == 0 && !row->name[length]) return row;
        }
    }
    return NULL;
}

static const char *shortly(const option *row) { return row->brief ? row->brief : row->name; }

static motus_status check_needs(const options *o, const option *row, const char *names, motus_error *err)
{
    char list[128] = "";
    const option *wanted, *first = NULL;
    while ((wanted = next(&names, o->verb)) != NULL) {
        if (options_has(o, wanted)) return MOTUS_OK;
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", first ? " or " : "", shortly(wanted));
        if (!first) first = wanted;
    }
    fail(err, MOTUS_ARGUMENT, "%s needs %s", row->name, list);
    if (first) options_hint(first, err);
    return MOTUS_ARGUMENT;
}

static motus_status check_excludes(const options *o, const option *row, const char *names, motus_error *err)
{
    const option *other;
    while ((other = next(&names, o->verb)) != NULL) {
        if (!options_has(o, other)) continue;
        fail(err, MOTUS_ARGUMENT, "%s and %s exclude each other", row->name, shortly(other));
        options_hint(row, err);
        return MOTUS_ARGUMENT;
    }
    return MOTUS_OK;
}

/* Checks an option that prints something instead of the results: nothing else is written, and a link holds no other
 * settings than its own. */
static motus_status check_instead(const options *o, const option *instead, motus_error *err)
{
    for (size_t k = 0; k < OPTION_COUNT; k++) {
        const option *row = options_row(k);
        const bool link = instead == options_row(OPTION_share);
        if (!o->given[k] || row == instead || row->setting == OF_MACHINE || row->verbs == VERB_ALL) continue;
        if (link ? row->link : row->setting == OF_MOTION) continue;
        return complain(err, MOTUS_ARGUMENT,
                        link ? "--share computes nothing: it prints a link's model and settings"
                             : "--emit-c computes nothing: it prints a text",
                        "%s and %s exclude each other", instead->name, shortly(row));
    }
    return MOTUS_OK;
}

/* What depends on values. */
typedef struct rule {
    bool broken;
    const char *what, *right;
} rule;

static motus_status check_values(const options *o, motus_error *err)
{
    const bool none = options_bars(o) == MOTUS_BARS_NONE;
    const rule rules[] = {
        {o->errors && none, "--errors and --error none exclude each other", "leave one out"},
        {o->verb == VERB_SWEEP && o->error && !none && !o->errors, "--error needs --errors in a sweep",
         "add --errors, which adds the columns of errors"},
        {o->fast && o->machine && strcmp(o->machine, "interpreter") == 0,
         "--fast and --machine interpreter exclude each other", "it is the compiler that is let free"},
        {o->threads > MOTUS_THREADS_MAX, "--threads is too large",
         "more threads than the computer has cores make nothing faster"},
        {o->json && o->events && strcmp(o->events, "-") == 0, "--json and --events - both write to standard output",
         "write the events to a file: --events events.csv"},
        {o->json && o->output && strcmp(o->output, "-") == 0, "--json and -o - both write to standard output",
         o->verb == VERB_LAB ? "write the page to a file: -o lab.html" : "write the CSV to a file: -o traj.csv"},
        {o->json && o->markdown, "--json and --markdown exclude each other", "leave one out"},
    };
    for (size_t k = 0; k < sizeof rules / sizeof *rules; k++)
        if (rules[k].broken) return complain(err, MOTUS_ARGUMENT, rules[k].right, "%s", rules[k].what);
    return MOTUS_OK;
}

motus_status options_check(const options *o, motus_error *err)
{
    motus_status status = o->share    ? check_instead(o, options_row(OPTION_share), err)
                          : o->emit_c ? check_instead(o, options_row(OPTION_emit_c), err)
                                      : MOTUS_OK;
    for (size_t k = 0; !status && k < OPTION_COUNT; k++) {
        const option *row = options_row(k);
        if (!o->given[k]) continue;
        if (row->excludes) status = check_excludes(o, row, row->excludes, err);
        for (size_t n = 0; !status && n < OPTION_NEEDS; n++)
            if (row->needs[n].verbs & o->verb) status = check_needs(o, row, row->needs[n].options, err);
    }
    return status ? status : check_values(o, err);
}
