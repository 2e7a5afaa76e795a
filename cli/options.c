/* The command line.
 *
 * Invariant: all that is known of an option is its row in cli/options.def. Values are checked here, so the verbs get
 * only valid ones.
 */
#include "cli/options.h"

#include "base/near.h"
#include "base/error.h"
#include "cli/complain.h"
#include "cli/constant.h"
#include "cli/text.h"
#include "cli/typed.h"

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

static void hint_help(const option *row, motus_error *err)
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

static motus_status not_here(const char *name, unsigned verb, motus_error *err)
{
    char verbs[128] = "";
    for (size_t i = 0; i < OPTION_COUNT; i++)
        for (unsigned bit = 1; bit < VERB_ALL && strcmp(table[i].name, name) == 0; bit <<= 1)
            if (table[i].verbs & bit)
                snprintf(verbs + strlen(verbs), sizeof verbs - strlen(verbs), "%s%s", verbs[0] ? ", " : "",
                         options_verb(bit));
    fail(err, MOTUS_ARGUMENT, "motus %s takes no %s", options_verb(verb), name);
    hint(err, "%s belongs to: %s", name, verbs);
    const size_t length = strlen(name);
    for (size_t i = 0; i < OPTION_COUNT; i++) /* --methods for --method */
        if (table[i].verbs & verb && strncmp(table[i].name, name, length) == 0 && !strcmp(table[i].name + length, "s"))
            hint_help(&table[i], err);
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

/* ---- values ---- */

/* A constant expression of the language; `inner` says why it is none. */
static bool read_number(const char *text, double *number, motus_error *inner)
{
    return constant_read(text, "", number, inner) == MOTUS_OK;
}

static bool read_above(const char *text, double *number, motus_error *inner)
{
    return read_number(text, number, inner) && *number > 0;
}

/* An integer above 0; one in digits is exact. */
static bool read_count(const char *text, int64_t *count, motus_error *inner)
{
    const char *rest;
    double number;
    if (typed_count(text, count, &rest) && !*rest) return true;
    if (!read_number(text, &number, inner) || number < 1 || number != trunc(number)) return false;
    if (number >= TYPED_COUNT_MAX) {
        hint(inner, "at most %g", TYPED_COUNT_MAX);
        return false;
    }
    *count = (int64_t)number;
    return true;
}

/* The text without the word at its end and the blanks before that; false: it has no such word, or is too long. */
enum { SHORT = 256 };
static bool cut_word(const char *text, const char *word, char out[SHORT])
{
    const size_t n = strlen(word);
    size_t length = strlen(text);
    if (length < n || length - n >= SHORT || strcmp(text + length - n, word) != 0) return false;
    for (length -= n; length > 0 && text[length - 1] == ' ';) length--;
    snprintf(out, SHORT, "%.*s", (int)length, text);
    return true;
}

static bool read_steps(const char *text, int64_t *steps, motus_error *inner)
{
    char number[SHORT];
    return (cut_word(text, "steps", number) || cut_word(text, "step", number)) && read_count(number, steps, inner);
}

/* A time, or "10 steps". */
static bool read_every(options_period *p, const char *text, motus_error *inner)
{
    *p = (options_period){0};
    return read_steps(text, &p->steps, inner) || read_above(text, &p->time, inner);
}

/* A time with its unit, or "1e6 steps". */
static bool read_states(options_period *p, const char *text, motus_error *inner)
{
    static const struct {
        const char *word;
        double seconds;
    } units[] = {{"s", 1}, {"min", 60}, {"h", 3600}};
    char number[SHORT];
    *p = (options_period){0};
    if (read_steps(text, &p->steps, inner)) return true;
    for (size_t k = 0; k < sizeof units / sizeof *units; k++)
        if (cut_word(text, units[k].word, number) && read_above(number, &p->time, inner)) {
            p->time *= units[k].seconds;
            return true;
        }
    return false;
}

/* The text without the word relative or absolute, which goes to o->absolute. False: it is too long. */
static bool read_unit(options *o, const char *text, char number[SHORT])
{
    o->absolute = cut_word(text, " absolute", number);
    if (o->absolute || cut_word(text, " relative", number)) return true;
    snprintf(number, SHORT, "%s", text);
    return strlen(text) < SHORT;
}

/* "1e-3:1e-12", or one of them. */
static bool read_accuracies(options *o, options_range *r, const char *text, motus_error *inner)
{
    char number[SHORT];
    if (!read_unit(o, text, number)) return false;
    char *colon = strchr(number, ':');
    if (colon) *colon = 0;
    return read_above(number, &r->coarsest, inner) && read_above(colon ? colon + 1 : number, &r->finest, inner);
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

static motus_status add_text(options_list *list, const char *value, motus_error *err)
{
    const char **items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (!items) return complain_memory(err);
    list->items = items;
    list->items[list->count++] = value;
    return MOTUS_OK;
}

/* Whether a word is among the choices of a row. */
static bool is_choice(const option *row, const char *word)
{
    const size_t length = strlen(word);
    for (const char *s = row->choices; *s; s += strspn(s, " ")) {
        const size_t n = strcspn(s, " ");
        if (n == length && strncmp(s, word, n) == 0) return true;
        s += n;
    }
    return false;
}

/* What the value of a kind has to be, where it is not just any text. */
static const char *const wanted[] = {
    [NUMBER] = "a number",
    [POSITIVE] = "a number above 0",
    [LENGTH] = "a number above 0",
    [TOLERANCE] = "a number above 0, or one as \"1e-6 absolute\"",
    [ACCURACIES] = "a range of numbers above 0, as 1e-3:1e-12",
    [COUNT] = "an integer above 0",
    [SEED] = "an integer",
    [EVERY] = "a time above 0, or a count as \"10 steps\"",
    [STATES] = "a time with its unit, 10min, 90s, 2h, or a count as \"1e6 steps\"",
    [NAMED] = "NAME=VALUE",
    [TEXTS] = NULL,
};

/* False: the value is not what the kind wants, or memory ran out (`inner`). */
static bool store(options *o, const option *row, const char *value, motus_error *inner)
{
    void *place = (char *)o + row->place;
    char number[SHORT];
    switch (row->kind) {
    case FLAG: return *(bool *)place = true;
    case CHOICE:
    case WORD: *(const char **)place = value; return true;
    case NUMBER: return read_number(value, place, inner);
    case POSITIVE:
    case LENGTH: return read_above(value, place, inner);
    case TOLERANCE: return read_unit(o, value, number) && read_above(number, place, inner);
    case ACCURACIES: return read_accuracies(o, place, value, inner);
    case COUNT: return read_count(value, place, inner);
    case SEED: return typed_seed(value, place) || read_count(value, place, inner);
    case EVERY: return read_every(place, value, inner);
    case STATES: return read_states(place, value, inner);
    case NAMES: options_list_free(place); return !options_split(value, row->name, place, inner);
    case NAMED: return strchr(value, '=') && value[0] != '=' && !add_text(place, value, inner);
    case TEXTS: return !add_text(place, value, inner);
    }
    return false;
}

static motus_status read_value(options *o, size_t k, const char *value, motus_error *err)
{
    const option *row = &table[k];
    motus_error inner = motus_default_error();
    o->given[k] = value;
    if (row->kind != FLAG && row->kind <= CHOICE && !*value)
        return fail(err, MOTUS_ARGUMENT, "%s: its value is empty", row->name);
    if (row->kind == CHOICE && !is_choice(row, value)) {
        fail(err, MOTUS_ARGUMENT, "%s %s: this is none of its words", row->name, value);
        hint(err, "write one of: %s", row->choices);
        return MOTUS_ARGUMENT;
    }
    if (store(o, row, value, &inner)) return MOTUS_OK;
    if (inner.status == MOTUS_MEMORY || !wanted[row->kind]) {
        *err = inner;
        return inner.status;
    }
    fail(err, MOTUS_ARGUMENT, "%s %s: this is not %s", row->name, value, wanted[row->kind]);
    if (inner.hint[0])
        hint(err, "%s", inner.hint);
    else
        hint_help(row, err);
    return MOTUS_ARGUMENT;
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

motus_status options_judge(const options_rule *rules, size_t count, motus_error *err)
{
    for (size_t k = 0; k < count; k++)
        if (rules[k].broken) {
            fail(err, MOTUS_ARGUMENT, "%s", rules[k].what);
            if (rules[k].right) hint(err, "%s", rules[k].right);
            return MOTUS_ARGUMENT;
        }
    return MOTUS_OK;
}

static motus_status check(const options *o, motus_error *err)
{
    static const char each[] = "with --accuracies each method gets the step, or the tolerance, that it needs for them";
    const bool run = o->verb == VERB_RUN, none = options_bars(o) == MOTUS_BARS_NONE, lab = o->verb == VERB_LAB;
    const bool accuracies = o->given[OPTION_accuracies];
    const options_rule rules[] = {
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
        {o->json && o->markdown, "--json and --markdown exclude each other", NULL},
    };
    const motus_status status = options_judge(rules, sizeof rules / sizeof *rules, err);
    return status || !o->share ? status : check_share(o, err);
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
                const motus_status status = add_text(&o->files, word, err);
                if (status) return status;
                continue;
            }
            if (o->operand) {
                fail(err, MOTUS_ARGUMENT, "%s after %s: motus takes one %s", word, o->operand,
                     verb == VERB_METHODS   ? "method"
                     : verb == VERB_ARCHIVE ? "archive"
                                            : "model");
                hint(err, "quote a name that has blanks");
                return MOTUS_ARGUMENT;
            }
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
            hint_help(row, err);
            return MOTUS_ARGUMENT;
        }
        if (row->kind != FLAG && !value) value = argv[++i];
        status = read_value(o, k, row->kind == FLAG ? "" : value, err);
        if (status) return status;
    }
    return o->help ? MOTUS_OK : check(o, err);
}
