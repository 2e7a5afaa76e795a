/* The command line.
 *
 * Invariant: all that is known of an option is its row in cli/options.def.
 */
#include "cli/options.h"

#include "base/near.h"
#include "cli/complain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    STUDY = VERB_COMPARE | VERB_CONVERGE,
    ONE = VERB_RUN | VERB_SWEEP,
    SOLVES = ONE | STUDY | VERB_LAB,
    MODEL = SOLVES | VERB_CHECK
};

static const option table[] = {
#define OPTION(type, member, ...) {.kind = type, offsetof(options, member), sizeof(TYPE_##type), __VA_ARGS__},
#define OPTION_AGAIN(type, member, ...) {.kind = type, offsetof(options, member), sizeof(TYPE_##type), __VA_ARGS__},
#include "cli/options.def"
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
    hint(err, "%s %s: %s", row->name, row->argument, options_plain(row->help, help));
}

static const char *const verbs[] = {
#define VERB(bit, name, ...) #name,
#include "cli/options.def"
};

const char *options_verb(unsigned verb)
{
    size_t k = 0;
    while (verb >> k > 1) k++;
    return verbs[k];
}

static bool matches(const option *o, const char *name)
{
    return strcmp(o->name, name) == 0 || (o->brief && strcmp(o->brief, name) == 0);
}

/* Members of a definition have '_' where options have '-'. */
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

/* Another verb has the option. */
static motus_status not_here(const char *name, unsigned verb, motus_error *err)
{
    char its[128] = "";
    for (size_t i = 0; i < OPTION_COUNT; i++)
        for (unsigned bit = 1; bit < VERB_ALL && strcmp(table[i].name, name) == 0; bit <<= 1)
            if (table[i].verbs & bit)
                snprintf(its + strlen(its), sizeof its - strlen(its), "%s%s", its[0] ? ", " : "", options_verb(bit));
    fail(err, MOTUS_ARGUMENT, "motus %s takes no %s", options_verb(verb), name);
    hint(err, "%s belongs to: %s", name, its);
    const size_t length = strlen(name);
    for (size_t i = 0; i < OPTION_COUNT; i++) /* --methods for --method */
        if (table[i].verbs & verb && strncmp(table[i].name, name, length) == 0 && !strcmp(table[i].name + length, "s"))
            options_hint(&table[i], err);
    return MOTUS_ARGUMENT;
}

/* The row of the option `name` of this verb, or an error that says why there is none. */
static motus_status find(const char *name, unsigned verb, size_t *found, motus_error *err)
{
    const char *elsewhere = NULL, *near = NULL;
    int distance = 6;
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const option *o = &table[i];
        if (matches(o, name) && o->verbs & verb) {
            *found = i;
            return MOTUS_OK;
        }
        if (matches(o, name)) elsewhere = o->name;
        const int d = near_distance(o->name, name, distance);
        if (o->verbs & verb && d < distance) {
            near = o->name;
            distance = d;
        }
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

void options_list_free(options_list *list)
{
    free(list->items);
    free(list->text);
    *list = (options_list){0};
}

motus_status options_split(const char *text, const char *option_name, options_list *list, motus_error *err)
{
    size_t most = 1;
    int depth = 0;
    for (const char *s = text; *s; s++) most += *s == ',';
    *list = (options_list){.items = malloc(most * sizeof *list->items), .text = strdup(text)};
    motus_status status = list->items && list->text ? MOTUS_OK : complain_memory(err);
    for (char *s = list->text, *part = s, last = 1; !status && last; s++) {
        depth += (*s == '(' || *s == '[') - (*s == ')' || *s == ']');
        if (*s && !(*s == ',' && depth <= 0)) continue;
        last = *s;
        *s = 0;
        part += strspn(part, " ");
        for (char *tail = s; tail > part && tail[-1] == ' ';) *--tail = 0;
        if (!*part) status = fail(err, MOTUS_ARGUMENT, "%s %s: a name is missing", option_name, text);
        list->items[list->count++] = part;
        part = s + 1;
    }
    if (status) options_list_free(list);
    return status;
}

motus_status options_add(options_list *list, const char *value, motus_error *err)
{
    const char **items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (!items) return complain_memory(err);
    list->items = items;
    list->items[list->count++] = value;
    return MOTUS_OK;
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

static void forget(options *o, size_t k)
{
    const option *row = &table[k];
    void *place = (char *)o + row->place;
    o->given[k] = NULL;
    if (row->kind >= NAMES) options_list_free(place);
    memset(place, 0, row->size);
    if (row->kind == NUMBER || row->kind == POSITIVE || row->kind == TOLERANCE || row->kind == ACCURACIES)
        *(double *)place = NAN;
}

void options_forget(options *o, unsigned settings)
{
    for (size_t k = 0; k < OPTION_COUNT; k++)
        if (table[k].setting & settings) forget(o, k);
}

void options_take(options *o, const options *from, unsigned settings)
{
    for (size_t k = 0; k < OPTION_COUNT; k++)
        if (table[k].setting & settings) {
            o->given[k] = from->given[k];
            memcpy((char *)o + table[k].place, (const char *)from + table[k].place, table[k].size);
        }
}

void options_free(options *o)
{
    options_list_free(&o->files);
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

/* ---- options that do not go together ---- */

/* A link has a model, its settings and methods; and --share computes nothing that could be written. */
static motus_status check_share(const options *o, motus_error *err)
{
    for (size_t k = 0; k < OPTION_COUNT; k++) {
        const option *row = &table[k];
        if (!o->given[k] || row->link || k == OPTION_share || row->setting == OF_MACHINE || row->verbs == VERB_ALL)
            continue;
        fail(err, MOTUS_ARGUMENT, "--share and %s exclude each other", row->name);
        hint(err, "--share computes nothing: it prints a link's model and settings");
        return MOTUS_ARGUMENT;
    }
    return MOTUS_OK;
}

/* What is said where options do not go together, and what would be right. */
typedef struct rule {
    bool broken;
    const char *what, *right;
} rule;

static motus_status check(const options *o, motus_error *err)
{
    static const char each[] = "with --accuracies each method gets the step, or the tolerance, that it needs for them";
    const bool run = o->verb == VERB_RUN, none = options_bars(o) == MOTUS_BARS_NONE, lab = o->verb == VERB_LAB;
    const bool accuracies = o->given[OPTION_accuracies];
    const rule rules[] = {
        {accuracies && o->evaluations, "--accuracies and --evaluations exclude each other", each},
        {accuracies && !isnan(o->step), "--accuracies and --step exclude each other", each},
        {!accuracies && o->verb == VERB_COMPARE && o->machine, "--machine needs --accuracies",
         "add --accuracies 1e-3:1e-12"},
        {o->errors && none, "--errors needs errors", "leave --error none out"},
        {o->errors && run && !o->output, "--errors needs -o, which names the CSV", "add -o traj.csv"},
        {o->verb == VERB_SWEEP && o->error && !none && !o->errors,
         "--error: a sweep tells errors in columns of their own", "add --errors"},
        {o->threads > MOTUS_THREADS_MAX, "--threads: there are too many",
         "more threads than the computer has cores make nothing faster"},
        {!o->section && o->skip, "--skip needs --section", "add --section \"x = 0 rising\""},
        {!o->section && o->most_points, "--points needs --section", "add --section \"x = 0 rising\""},
        {o->plot_of && !o->plot, "--plot-of needs --plot, which names the file", "add --plot fig.svg"},
        {run && o->columns && !o->events && !o->output, "--columns needs -o, which names the CSV", "add -o traj.csv"},
        {run && o->given[OPTION_every] && !o->output, "--every needs -o, which names the CSV", "add -o traj.csv"},
        {o->json && o->events && strcmp(o->events, "-") == 0, "--json and --events - both write to standard output",
         "write the events to a file: --events events.csv"},
        {o->json && o->output && strcmp(o->output, "-") == 0, "--json and -o - both write to standard output",
         lab ? "write the page to a file: -o lab.html" : "write the CSV to a file: -o traj.csv"},
        {o->json && o->markdown, "--json and --markdown exclude each other", "leave one out"},
    };
    for (size_t k = 0; k < sizeof rules / sizeof *rules; k++)
        if (rules[k].broken) return complain(err, MOTUS_ARGUMENT, rules[k].right, "%s", rules[k].what);
    return o->share ? check_share(o, err) : MOTUS_OK;
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
                const motus_status status = options_add(&o->files, word, err);
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
        const option *row = &table[k];
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
    return o->help ? MOTUS_OK : check(o, err);
}
