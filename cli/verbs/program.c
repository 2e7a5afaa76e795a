/* The program, which calls the verb.
 *
 * Invariant: an error is printed once, here, and decides the exit status.
 */
#include "base/near.h"
#include "cli/files/file.h"
#include "cli/files/stop.h"
#include "cli/model/columns.h"
#include "cli/verbs/program.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"
#include "cli/words/text.h"

#include <stdio.h>
#include <string.h>

typedef struct verb {
    const char *name;
    unsigned bit;
    motus_status (*go)(const options *, motus_error *);
} verb;

static const verb verbs[] = {
#define VERB(bit, name, ...) {#name, VERB_##bit, name##_verb},
#include "cli/words/options.def"
};

static const verb *find(const char *name)
{
    for (size_t i = 0; i < VERB_COUNT; i++)
        if (strcmp(verbs[i].name, name) == 0) return &verbs[i];
    return NULL;
}

static motus_status unknown(const char *name, motus_error *err)
{
    size_t length = strlen(name);
    int best = 6;
    const char *near = NULL;
    for (size_t i = 0; i < VERB_COUNT; i++) {
        const int d = near_distance(verbs[i].name, name, best);
        if (d < best) near = verbs[i].name, best = d;
    }
    fail(err, MOTUS_ARGUMENT, "unknown %s %s", name[0] == '-' ? "option" : "verb", name);
    if (length > 6 && strcmp(name + length - 6, ".motus") == 0)
        hint(err, "to integrate it: motus run %s", name);
    else if (near)
        hint(err, "did you mean motus %s?", near);
    else
        hint(err, "motus --help lists the verbs");
    return MOTUS_ARGUMENT;
}

static void print_version(bool as_json)
{
    if (!as_json) {
        printf("motus %s\n", motus_version());
        return;
    }
    json j = text_json(stdout);
    json_string(&j, "version", motus_version());
    json_end(&j);
}

/* Does motus [--help | --version | --options | help [VERB]]. Returns whether the words were one of these. */
static bool general(int argc, char **argv, bool as_json)
{
    const char *word = argc > 1 ? argv[1] : "";
    const verb *v = argc > 2 ? find(argv[2]) : NULL;
    if (strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0 || strcmp(word, "version") == 0)
        print_version(as_json);
    else if (strcmp(word, "help") == 0 && v)
        help_verb(stdout, v->bit);
    else if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0)
        help_program(stdout);
    else if (strcmp(word, "--options") == 0)
        help_table(stdout);
    else
        return false;
    return true;
}

static motus_status dispatch(int argc, char **argv, bool as_json, bool *answered, const team *t, motus_error *err)
{
    int first = 1;
    while (first < argc && strcmp(argv[first], "--json") == 0) first++;
    if (!team_first(t) && (first == argc || strcmp(argv[first], options_verb(VERB_SWEEP)) != 0)) return MOTUS_OK;
    if (general(argc, argv, as_json)) return file_flush_output(err);
    if (first == argc)
        return complain(err, MOTUS_ARGUMENT, "motus run model.motus; motus --help lists the others",
                        "a verb is missing");
    const verb *v = find(argv[first]);
    if (!v) return unknown(argv[first], err);
    options o;
    motus_status status = options_read(&o, v->bit, argc, argv, first + 1, err);
    o.json = o.json || as_json;
    if (!status && !o.help) status = options_check(&o, err);
    o.answered = answered;
    o.team = t;
    /* if standard output is closed, nobody wants a report besides a file */
    const bool file = o.output || o.plot || o.events || o.save_state;
    o.quiet = o.quiet || !team_first(t) || (file && file_output_closed());
    if (!status && o.help) {
        if (team_first(t)) help_verb(stdout, v->bit);
        status = file_flush_output(err);
    } else if (!status) {
        columns files;
        status = columns_set(&files, &o, err);
        if (!status) status = v->go(&o, err);
        if (status) columns_tell(&files, err);
        columns_free(&files);
    }
    options_free(&o);
    return status;
}

void program_begin(void)
{
    file_open_standard();
    stop_file_limit();
}

int program_main(int argc, char **argv, const team *t)
{
    bool as_json = false, answered = false;
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) as_json = as_json || strcmp(argv[i], "--json") == 0;
    motus_error err = motus_default_error();
    motus_status status = dispatch(argc, argv, as_json, &answered, t, &err);
    err.status = status;
    if (status && !err.message[0] && !t) fail(&err, status, "%s", motus_status_text(status));
    const bool tells = team_tells(t, status, &err);
    if (!t) stop_obey();
    int exit = status ? motus_status_exit(status) : 0;
    if (tells) exit = complain_show(&err, as_json && !answered);
    return t ? t->largest(t->context, exit) : exit;
}

/* motus cache: the compiled models kept between runs. */
motus_status cache_verb(const options *o, motus_error *err)
{
    if (o->operand || !o->clear)
        return complain(err, MOTUS_ARGUMENT, "motus cache --clear removes every entry",
                        o->operand ? "motus cache takes no model" : "motus cache needs --clear");
    int count = motus_cache_clear();
    if (count < 0) return fail(err, MOTUS_FILE, "cannot read the folder of the cache");
    if (o->json) {
        json j = text_json(stdout);
        json_integer(&j, "removed", count);
        json_end(&j);
    } else if (!o->quiet) {
        printf("%d compiled model%s removed\n", count, count == 1 ? "" : "s");
    }
    return MOTUS_OK;
}
