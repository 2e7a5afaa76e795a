/* The command line.
 *
 * Invariant: an option is one row of the table: its name, its argument, where it is stored, the verbs it belongs to,
 * its help. Numbers are checked here, so the verbs get only valid ones.
 */
#include "cli/options.h"

#include "base/near.h"
#include "base/error.h"
#include "cli/complain.h"
#include "cli/text.h"
#include "cli/typed.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MODEL = VERB_RUN | VERB_COMPARE | VERB_CONVERGE | VERB_CHECK | VERB_SWEEP | VERB_LAB,
    STUDY = VERB_COMPARE | VERB_CONVERGE,
    MOTION = VERB_RUN | STUDY | VERB_SWEEP | VERB_LAB,
    DRAWN = VERB_RUN | VERB_SWEEP | STUDY,
    ONE = VERB_RUN | VERB_SWEEP,
    SHARED = VERB_RUN | VERB_COMPARE,
    ANY = MODEL | VERB_METHODS | VERB_CACHE | VERB_MERGE | VERB_ARCHIVE
};

typedef enum kind {
    FLAG,
    WORD,
    STEP,
    LENGTH,
    TOLERANCE,
    ACCURACIES,
    UNTIL,
    COUNT,
    SEED,
    EVERY,
    KEEP,
    METHOD_LIST,
    NAMED,
    TEXTS
} kind;

typedef struct option {
    const char *name, *brief, *argument;
    kind kind;
    size_t place;
    unsigned verbs;
    const char *help;
} option;

#define AT(member) offsetof(options, member)
static const option table[] = {
    {"--method", NULL, "M", WORD, AT(method), ONE | VERB_LAB,
     "the method, \"newmark(1/4, 1/2)\" (else the model's; run: else auto, others: else verlet)"},
    {"--methods", NULL, "A,B,C", METHOD_LIST, AT(methods), STUDY | VERB_LAB,
     "these methods (else every one the model admits; lab: else the model's)"},
    {"--step", NULL, "H", STEP, AT(step), MOTION, "time step: 0.01, 1/64, pi/100"},
    {"--accuracy", NULL, "E", TOLERANCE, AT(accuracy), VERB_RUN | VERB_SWEEP,
     "how far the answer may be off, 1e-9 of the motion's size, or \"1e-6 absolute\"; finds method and tolerance"},
    {"--tolerance", NULL, "E", TOLERANCE, AT(tolerance), ONE,
     "of an adaptive method: what one step may be off, 1e-9 of the motion's size, or \"1e-6 absolute\""},
    {"--shortest-step", NULL, "H", LENGTH, AT(shortest_step), ONE,
     "of an adaptive method: stop where a shorter one is needed"},
    {"--longest-step", NULL, "H", LENGTH, AT(longest_step), ONE, "of an adaptive method: take no longer one"},
    {"--most-steps", NULL, "N", COUNT, AT(most_steps), ONE,
     "of an adaptive method: stop after so many; sweep: each trajectory"},
    {"--until", NULL, "T", UNTIL, AT(until), MOTION, "end time; before the start: backward"},
    {"--set", NULL, "P=EXPR", NAMED, AT(set), MODEL,
     "replace a parameter or initial value: F=0.2, \"x(0)=1\"; repeatable"},
    {"--when", NULL, "EVENT", TEXTS, AT(when), ONE | VERB_CHECK,
     "add an event to the model: \"x = 0 rising: record\", \"y < 0: stop\"; repeatable"},
    {"--section", NULL, "WHERE", WORD, AT(section), ONE,
     "record where this happens, \"x = 0 rising\"; --plot draws those points"},
    {"--skip", NULL, "N", COUNT, AT(skip), ONE, "of a section: leave the first N points out of the plot"},
    {"--points", NULL, "N", COUNT, AT(most_points), ONE, "of a section: stop after N points, those skipped apart"},
    {"--evaluations", NULL, "N", COUNT, AT(evaluations), VERB_COMPARE,
     "equal work: each method's step is chosen to spend N evaluations"},
    {"--accuracies", NULL, "A:B", ACCURACIES, AT(coarsest), VERB_COMPARE,
     "the work of each method, adaptive ones too, for accuracies from A to B: 1e-3:1e-12, \"1e-3:1e-6 absolute\""},
    {"--output", "-o", "FILE", WORD, AT(output), ONE | VERB_LAB | VERB_MERGE | VERB_ARCHIVE,
     "write the CSV (or .h5; sweep: or .npy; archive: or its .motus; lab: the page) to FILE; - is standard output"},
    {"--error", NULL, "HOW", WORD, AT(error), VERB_RUN | VERB_SWEEP,
     "the error of every final number: cheap (else; by twice the work), full (three times), none"},
    {"--switches", NULL, "HOW", WORD, AT(switches), VERB_RUN | VERB_SWEEP,
     "where the force jumps or has a kink: locate (steps end there; else where they adapt), step (they lead across)"},
    {"--errors", NULL, NULL, FLAG, AT(errors), VERB_RUN | VERB_SWEEP,
     "add the errors to the CSV: x.error for every column, and whether any digit is significant"},
    {"--columns", NULL, "A,B,C", WORD, AT(columns), VERB_RUN,
     "columns of the CSV, and of --events: t, r, r'.x, x[3]', energy, \"exact x\""},
    {"--events", NULL, "FILE", WORD, AT(events), ONE,
     "write the table of events as CSV to FILE: what happened, when, and the numbers before and after"},
    {"--every", NULL, "T", EVERY, AT(every_time), ONE,
     "a row (sweep: a sample for min, max and mean) every time T, or every \"10 steps\""},
    {"--plot", NULL, "FIG", WORD, AT(plot), DRAWN, "draw with gnuplot; FIG ends in .svg, .png or .pdf"},
    {"--plot-of", NULL, "X,Y", WORD, AT(plot_of), ONE,
     "draw column Y against column X: \"x,x'\"; of a section its plane; sweep: X may be what varies"},
    {"--save-state", NULL, "FILE", WORD, AT(save_state), VERB_RUN, "write an exact restart state at the end"},
    {"--restart", NULL, "FILE", WORD, AT(restart), VERB_RUN, "continue from a restart state, to the same bits"},
    {"--checkpoint", NULL, "WHEN", KEEP, AT(keep_seconds), VERB_RUN,
     "how often a run into FILE.h5 keeps its state there: 10min (the default), 90s, 2h, \"1e6 steps\""},
    {"--machine", NULL, "NAME", WORD, AT(machine), ONE | VERB_COMPARE | VERB_ARCHIVE,
     "auto (compiles where the run is long enough), interpreter, compiled; compare: which --accuracies times"},
    {"--threads", NULL, "N", COUNT, AT(threads), ONE | VERB_ARCHIVE,
     "sweep: threads (else one for each processor); run: for one large system (else 1); the bits are the same"},
    {"--emit-c", NULL, NULL, FLAG, AT(emit_c), VERB_RUN, "print the C text that the compiled machine runs, and stop"},
    {"--share", NULL, NULL, FLAG, AT(share), SHARED,
     "print the part of a link to the lab that holds this model and its settings, and stop"},
    {"--no-open", NULL, NULL, FLAG, AT(no_open), VERB_LAB, "write the page and start no browser"},
    {"--clear", NULL, NULL, FLAG, AT(clear), VERB_CACHE, "remove every entry"},
    {"--vary", NULL, "P=RANGE", NAMED, AT(vary), VERB_SWEEP,
     "F=0:1:11, F=log:0.1:10:5, F=1,2,5, F=@values.csv:column, until=1,2; repeatable"},
    {"--random", NULL, "P=DIST", NAMED, AT(random), VERB_SWEEP,
     "\"x(0)=-1:1\" (uniform), m=normal:MEAN:DEVIATION; repeatable"},
    {"--count", NULL, "N", COUNT, AT(count), VERB_SWEEP, "draw N times (for each value of --vary, if there is one)"},
    {"--seed", NULL, "S", SEED, AT(seed), VERB_SWEEP, "seed of --random, an integer (else 0)"},
    {"--zip", NULL, NULL, FLAG, AT(zip), VERB_SWEEP, "pair the values of several --vary instead of combining all"},
    {"--record", NULL, "LIST", WORD, AT(record), VERB_SWEEP,
     "final, x, energy, min(x), max(x), mean(x), time_of_min(x), time_of_max(x)"},
    {"--shard", NULL, "K/N", WORD, AT(shard), VERB_SWEEP,
     "compute only the Kth of N shares, or slurm: that of the array's task; in names of files %K is its number"},
    {"--plan", NULL, NULL, FLAG, AT(plan), VERB_SWEEP,
     "compute a sample alone, and tell the sizes of memory and file, and the hours on 1 to 4096 ranks"},
    {"--resume", NULL, NULL, FLAG, AT(resume), ONE,
     "continue an interrupted sweep in FILE, or a run in FILE.h5, to the same bytes"},
    {"--verify", NULL, "PART", WORD, AT(verify), VERB_ARCHIVE,
     "compute this part of the blocks again, 1%, or all, and compare their bytes"},
    {"--compress", NULL, NULL, FLAG, AT(compress), ONE | VERB_MERGE,
     "compress FILE.h5 at the end; it is read as before, and what goes on makes a new one"},
    {"--partial", NULL, NULL, FLAG, AT(partial), VERB_MERGE,
     "of archives: join what is there; the sweep's command with --resume computes the rest"},
    {"--force", NULL, NULL, FLAG, AT(force), ONE | VERB_MERGE | VERB_ARCHIVE, "replace FILE if it exists"},
    {"--lanes", NULL, "N", COUNT, AT(lanes), VERB_SWEEP,
     "trajectories in one vector: 1, 2, 4, ... (for tests); the bits are the same"},
    {"--fast", NULL, NULL, FLAG, AT(fast), VERB_SWEEP,
     "let the compiler reorder operations: the last bits may differ between machines"},
    {"--points", NULL, NULL, FLAG, AT(points), VERB_CONVERGE, "below the table, the error at every step"},
    {"--markdown", NULL, NULL, FLAG, AT(markdown), VERB_METHODS, "the catalogue as a Markdown table"},
    {"--json", NULL, NULL, FLAG, AT(json), ANY, "one JSON object on standard output"},
    {"--quiet", "-q", NULL, FLAG, AT(quiet), ANY, "print nothing but errors and --json"},
    {"--help", "-h", NULL, FLAG, AT(help), ANY, "this text"},
};
enum { OPTIONS = sizeof table / sizeof *table };

static const char *const verb_names[] = {"run",   "compare", "converge", "check", "methods",
                                         "cache", "sweep",   "lab",      "merge", "archive"};

const char *options_verb(unsigned verb)
{
    for (size_t i = 0; i < sizeof verb_names / sizeof *verb_names; i++)
        if (verb == 1u << i) return verb_names[i];
    return "motus";
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
    for (size_t i = 0; i < OPTIONS; i++)
        if (strlen(table[i].name) == 2 + length && alike(table[i].name + 2, name, length)) return true;
    return false;
}

/* The option `name` of this verb, or an error that says why there is none. */
static motus_status find(const char *name, unsigned verb, const option **found, motus_error *err)
{
    const option *elsewhere = NULL, *near = NULL;
    int distance = 6;
    for (size_t i = 0; i < OPTIONS; i++) {
        const option *o = &table[i];
        if (matches(o, name) && o->verbs & verb) {
            *found = o;
            return MOTUS_OK;
        }
        if (matches(o, name)) elsewhere = o;
        const int d = near_distance(o->name, name, distance);
        if (o->verbs & verb && d < distance) {
            near = o;
            distance = d;
        }
    }
    if (elsewhere) {
        char verbs[64] = "";
        for (unsigned bit = 1; bit <= VERB_ARCHIVE; bit <<= 1)
            if (elsewhere->verbs & bit)
                snprintf(verbs + strlen(verbs), sizeof verbs - strlen(verbs), "%s%s", verbs[0] ? ", " : "",
                         options_verb(bit));
        fail(err, MOTUS_ARGUMENT, "motus %s takes no %s", options_verb(verb), elsewhere->name);
        const option *several = NULL; /* --methods for --method */
        for (size_t i = 0; i < OPTIONS; i++)
            if (table[i].verbs & verb && strncmp(table[i].name, elsewhere->name, strlen(elsewhere->name)) == 0 &&
                strcmp(table[i].name + strlen(elsewhere->name), "s") == 0)
                several = &table[i];
        if (several)
            hint(err, "write %s %s: %s", several->name, several->argument, several->help);
        else
            hint(err, "%s belongs to: %s", elsewhere->name, verbs);
        return MOTUS_ARGUMENT;
    }
    fail(err, MOTUS_ARGUMENT, "unknown option %s", name);
    if (strcmp(name, "--from") == 0)
        hint(err, "the start is the constant c in x(c) = ..., in the model");
    else if (near)
        hint(err, "did you mean %s?", near->name);
    else
        hint(err, "motus %s --help lists the options", options_verb(verb));
    return MOTUS_ARGUMENT;
}

static motus_status bad_value(const option *o, const char *value, const char *wanted, motus_error *err)
{
    fail(err, MOTUS_ARGUMENT, "%s %s: this is not %s", o->name, value, wanted);
    if (strchr(value, ',')) hint(err, "numbers are written with a point: 0.5");
    return MOTUS_ARGUMENT;
}

static motus_status read_every(options *o, const option *row, const char *value, motus_error *err)
{
    const char *rest;
    int64_t n;
    if (typed_count(value, &n, &rest)) {
        while (*rest == ' ') rest++;
        if (strcmp(rest, "steps") == 0 || strcmp(rest, "step") == 0) {
            o->every_steps = n;
            o->every_time = 0;
            return MOTUS_OK;
        }
    }
    double t;
    if (!typed_number(value, &t) || !(t > 0))
        return bad_value(row, value, "a time above 0, or a count as \"10 steps\"", err);
    o->every_time = t;
    o->every_steps = 0;
    return MOTUS_OK;
}

/* "1e6 steps", or a time with its unit. */
static motus_status read_keep(options *o, const option *row, const char *value, motus_error *err)
{
    static const struct {
        const char *word;
        double seconds;
    } units[] = {{"s", 1}, {"min", 60}, {"h", 3600}};
    const char *rest;
    char number[32] = "";
    double n;
    o->keep_steps = 0;
    o->keep_seconds = 0;
    const size_t digits = strspn(value, "0123456789.eE+-");
    rest = value + digits + strspn(value + digits, " ");
    if (digits < sizeof number) memcpy(number, value, digits);
    if (typed_number(number, &n) && n > 0 && (!strcmp(rest, "steps") || !strcmp(rest, "step"))) {
        if (n >= 1 && n <= 9e15 && n == floor(n)) {
            o->keep_steps = (int64_t)n;
            return MOTUS_OK;
        }
    } else if (typed_number(number, &n) && n > 0) {
        for (size_t k = 0; k < sizeof units / sizeof *units; k++)
            if (strcmp(rest, units[k].word) == 0) {
                o->keep_seconds = n * units[k].seconds;
                return MOTUS_OK;
            }
    }
    return bad_value(row, value, "a time with its unit, 10min, 90s, 2h, or a count as \"1e6 steps\"", err);
}

/* The text without the word relative or absolute at its end, which goes to o->absolute. False: it is too long. */
static bool read_unit(options *o, const char *value, char text[64])
{
    static const char *const words[] = {"relative", "absolute"};
    size_t length = strlen(value);
    o->absolute = false;
    for (int i = 0; i < 2; i++) {
        const size_t n = strlen(words[i]);
        if (length <= n + 1 || strcmp(value + length - n, words[i]) != 0 || value[length - n - 1] != ' ') continue;
        o->absolute = i == 1;
        length -= n;
        while (length > 0 && value[length - 1] == ' ') length--;
        break;
    }
    snprintf(text, 64, "%.*s", (int)length, value);
    return length < 64;
}

/* "1e-9", or with the word relative or absolute. */
static motus_status read_tolerance(options *o, const option *row, const char *value, motus_error *err)
{
    char number[64];
    double *const place = (double *)((char *)o + row->place);
    if (read_unit(o, value, number) && typed_number(number, place) && *place > 0) return MOTUS_OK;
    return bad_value(row, value, "a number above 0, or one as \"1e-6 absolute\"", err);
}

/* "1e-3:1e-12", or one of them. */
static motus_status read_accuracies(options *o, const option *row, const char *value, motus_error *err)
{
    char text[64];
    const bool fits = read_unit(o, value, text);
    char *colon = strchr(text, ':');
    if (colon) *colon = 0;
    if (fits && typed_number(text, &o->coarsest) && o->coarsest > 0 &&
        typed_number(colon ? colon + 1 : text, &o->finest) && o->finest > 0)
        return MOTUS_OK;
    return bad_value(row, value, "a range of numbers above 0, as 1e-3:1e-12", err);
}

motus_status options_split(const char *text, const char *option_name, char **copy, options_list *list, motus_error *err)
{
    size_t length = strlen(text), most = 1;
    for (const char *s = text; *s; s++) most += *s == ',';
    char *parts = malloc(length + 1);
    const char **items = malloc(most * sizeof *items);
    if (!parts || !items) {
        free(parts);
        free(items);
        return complain_memory(err);
    }
    memcpy(parts, text, length + 1);
    size_t count = 0;
    int depth = 0;
    for (char *s = parts, *part = parts;; s++) {
        depth += (*s == '(' || *s == '[') - (*s == ')' || *s == ']');
        if (*s && !(*s == ',' && depth <= 0)) continue;
        bool last = !*s;
        *s = 0;
        part += strspn(part, " ");
        for (char *tail = s; tail > part && tail[-1] == ' ';) *--tail = 0;
        if (!*part) {
            free(parts);
            free(items);
            return fail(err, MOTUS_ARGUMENT, "%s %s: a name is missing", option_name, text);
        }
        items[count++] = part;
        if (last) break;
        part = s + 1;
    }
    *copy = parts;
    *list = (options_list){items, count};
    return MOTUS_OK;
}

static motus_status add_text(options_list *list, const char *value, motus_error *err)
{
    const char **items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (!items) return complain_memory(err);
    list->items = items;
    list->items[list->count++] = value;
    return MOTUS_OK;
}

static motus_status add_named(options_list *list, const option *row, const char *value, motus_error *err)
{
    if (!strchr(value, '=') || value[0] == '=') {
        fail(err, MOTUS_ARGUMENT, "%s %s: this is not NAME=VALUE", row->name, value);
        hint(err, "%s %s: %s", row->name, row->argument, row->help);
        return MOTUS_ARGUMENT;
    }
    return add_text(list, value, err);
}

static motus_status store(options *o, const option *row, const char *value, motus_error *err)
{
    void *place = (char *)o + row->place;
    const char *rest;
    double number;
    switch (row->kind) {
    case FLAG: *(bool *)place = true; return MOTUS_OK;
    case WORD:
        if (!*value) return fail(err, MOTUS_ARGUMENT, "%s: its value is empty", row->name);
        *(const char **)place = value;
        return MOTUS_OK;
    case STEP:
        o->step_typed = value;
        return typed_number(value, &o->step) && o->step > 0 ? MOTUS_OK : bad_value(row, value, "a number above 0", err);
    case LENGTH:
        return typed_number(value, place) && *(double *)place > 0 ? MOTUS_OK
                                                                  : bad_value(row, value, "a number above 0", err);
    case TOLERANCE: return read_tolerance(o, row, value, err);
    case ACCURACIES: return read_accuracies(o, row, value, err);
    case UNTIL:
        o->until_typed = value;
        return typed_number(value, &o->until) ? MOTUS_OK : bad_value(row, value, "a number", err);
    case COUNT:
        if (typed_count(value, place, &rest) && !*rest) return MOTUS_OK;
        if (typed_number(value, &number) && number >= TYPED_COUNT_MAX)
            return fail(err, MOTUS_ARGUMENT, "%s %s: at most %g", row->name, value, TYPED_COUNT_MAX);
        return bad_value(row, value, "an integer above 0", err);
    case EVERY: return read_every(o, row, value, err);
    case KEEP: return read_keep(o, row, value, err);
    case METHOD_LIST:
        free(o->methods_text);
        free(o->methods.items);
        o->methods_text = NULL;
        o->methods = (options_list){0};
        return options_split(value, row->name, &o->methods_text, &o->methods, err);
    case SEED: o->seeded = true; return typed_seed(value, place) ? MOTUS_OK : bad_value(row, value, "an integer", err);
    case NAMED: return add_named(place, row, value, err);
    case TEXTS: return add_text(place, value, err);
    }
    return MOTUS_OK;
}

/* A link has a model, its settings and methods, but no number of evaluations and no restart state; and --share
 * computes nothing that could be written. */
static motus_status check_share(const options *o, motus_error *err)
{
    const struct {
        const char *name;
        bool given;
    } others[] = {
        {"--output", o->output},
        {"--events", o->events},
        {"--plot", o->plot},
        {"--save-state", o->save_state},
        {"--restart", o->restart},
        {"--evaluations", o->evaluations > 0},
        {"--accuracies", !isnan(o->coarsest)},
        {"--emit-c", o->emit_c},
        {"--when", o->when.count > 0},
        {"--section", o->section},
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (others[i].given) {
            fail(err, MOTUS_ARGUMENT, "--share and %s exclude each other", others[i].name);
            hint(err, "--share computes nothing: it prints a link's model and settings");
            return MOTUS_ARGUMENT;
        }
    return MOTUS_OK;
}

/* What a comparison at equal accuracy finds itself, and what it alone reads. */
static motus_status check_accuracies(const options *o, motus_error *err)
{
    const bool given = !isnan(o->coarsest);
    if (given && (o->evaluations > 0 || !isnan(o->step))) {
        fail(err, MOTUS_ARGUMENT, "--accuracies and %s exclude each other",
             o->evaluations > 0 ? "--evaluations" : "--step");
        hint(err, "with --accuracies each method gets the step, or the tolerance, that it needs for them");
        return MOTUS_ARGUMENT;
    }
    if (!given && o->verb == VERB_COMPARE && o->machine) {
        fail(err, MOTUS_ARGUMENT, "--machine needs --accuracies");
        hint(err, "add --accuracies 1e-3:1e-12");
        return MOTUS_ARGUMENT;
    }
    return MOTUS_OK;
}

static motus_status check(const options *o, motus_error *err)
{
    const char *machine = o->machine;
    if (machine && strcmp(machine, "auto") != 0 && strcmp(machine, "interpreter") != 0 &&
        strcmp(machine, "compiled") != 0) {
        fail(err, MOTUS_ARGUMENT, "--machine %s: there is no such machine", machine);
        hint(err, "auto, interpreter or compiled");
        return MOTUS_ARGUMENT;
    }
    if (o->switches && strcmp(o->switches, "locate") != 0 && strcmp(o->switches, "step") != 0) {
        fail(err, MOTUS_ARGUMENT, "--switches %s: there is no such way to treat switches", o->switches);
        hint(err, "the ways are locate and step");
        return MOTUS_ARGUMENT;
    }
    if (o->error && strcmp(o->error, "none") != 0 && strcmp(o->error, "cheap") != 0 && strcmp(o->error, "full") != 0) {
        fail(err, MOTUS_ARGUMENT, "--error %s: there is no such way to tell the error", o->error);
        hint(err, "cheap, full or none");
        return MOTUS_ARGUMENT;
    }
    const bool none = o->error && strcmp(o->error, "none") == 0;
    if (o->errors && (none || (o->verb == VERB_RUN && !o->output))) {
        fail(err, MOTUS_ARGUMENT, none ? "--errors needs errors" : "--errors needs -o, which names the CSV");
        hint(err, none ? "leave --error none out" : "add -o traj.csv");
        return MOTUS_ARGUMENT;
    }
    if (o->verb == VERB_SWEEP && o->error && !none && !o->errors) {
        fail(err, MOTUS_ARGUMENT, "--error %s: a sweep tells errors in columns of their own", o->error);
        hint(err, "add --errors");
        return MOTUS_ARGUMENT;
    }
    if (o->threads > MOTUS_THREADS_MAX) {
        fail(err, MOTUS_ARGUMENT, "--threads %lld: at most %d", (long long)o->threads, MOTUS_THREADS_MAX);
        hint(err, "more threads than the computer has cores make nothing faster");
        return MOTUS_ARGUMENT;
    }
    if (!o->section && (o->skip > 0 || o->most_points > 0)) {
        fail(err, MOTUS_ARGUMENT, "%s needs --section", o->skip > 0 ? "--skip" : "--points");
        hint(err, "add --section \"x = 0 rising\"");
        return MOTUS_ARGUMENT;
    }
    if (o->plot_of && !o->plot) {
        fail(err, MOTUS_ARGUMENT, "--plot-of needs --plot, which names the file");
        hint(err, "add --plot fig.svg");
        return MOTUS_ARGUMENT;
    }
    const bool every = o->every_time > 0 || o->every_steps > 0, columns = o->columns && !o->events;
    if (o->verb == VERB_RUN && (columns || every) && !o->output) {
        fail(err, MOTUS_ARGUMENT, "%s needs -o, which names the CSV", columns ? "--columns" : "--every");
        hint(err, "add -o traj.csv");
        return MOTUS_ARGUMENT;
    }
    if (o->json && o->events && strcmp(o->events, "-") == 0) {
        fail(err, MOTUS_ARGUMENT, "--json and --events - both write to standard output");
        hint(err, "write the events to a file: --events events.csv");
        return MOTUS_ARGUMENT;
    }
    if (o->json && o->output && strcmp(o->output, "-") == 0) {
        fail(err, MOTUS_ARGUMENT, "--json and -o - both write to standard output");
        hint(err, "write %s to a file: -o %s", o->verb == VERB_LAB ? "the page" : "the CSV",
             o->verb == VERB_LAB ? "lab.html" : "traj.csv");
        return MOTUS_ARGUMENT;
    }
    if (o->json && o->markdown) return fail(err, MOTUS_ARGUMENT, "--json and --markdown exclude each other");
    const motus_status status = check_accuracies(o, err);
    if (status) return status;
    return o->share ? check_share(o, err) : MOTUS_OK;
}

motus_status options_read(options *o, unsigned verb, int argc, char **argv, int first, motus_error *err)
{
    *o = (options){.verb = verb,
                   .step = NAN,
                   .until = NAN,
                   .tolerance = NAN,
                   .accuracy = NAN,
                   .coarsest = NAN,
                   .finest = NAN,
                   .argc = argc,
                   .argv = argv};
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
        const option *row = NULL;
        motus_status status = find(name, verb, &row, err);
        if (status) return status;
        const char *value = equals ? equals + 1 : NULL;
        if (row->kind == FLAG && value) return fail(err, MOTUS_ARGUMENT, "%s takes no value", row->name);
        if (row->kind != FLAG && !value && i + 1 == argc) {
            fail(err, MOTUS_ARGUMENT, "%s: its value is missing", row->name);
            hint(err, "%s %s: %s", row->name, row->argument, row->help);
            return MOTUS_ARGUMENT;
        }
        if (row->kind != FLAG && !value) value = argv[++i];
        status = store(o, row, value, err);
        if (status) return status;
    }
    return o->help ? MOTUS_OK : check(o, err);
}

void options_free(options *o)
{
    free(o->files.items);
    free(o->set.items);
    free(o->when.items);
    free(o->vary.items);
    free(o->random.items);
    free(o->methods.items);
    free(o->methods_text);
}

motus_switches options_switches(const options *o)
{
    if (!o->switches) return MOTUS_SWITCHES_USUAL;
    return strcmp(o->switches, "locate") ? MOTUS_SWITCHES_STEP : MOTUS_SWITCHES_LOCATE;
}

void options_help(FILE *out, unsigned verb)
{
    for (size_t i = 0; i < OPTIONS; i++) {
        const option *o = &table[i];
        if (!(o->verbs & verb)) continue;
        char left[40];
        snprintf(left, sizeof left, "%s%s%s%s%s", o->brief ? o->brief : "", o->brief ? ", " : "", o->name,
                 o->argument ? " " : "", o->argument ? o->argument : "");
        fprintf(out, "  %-20s  %s\n", left, o->help);
    }
}
