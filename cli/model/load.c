/* The model that a command names.
 *
 * Invariant: at most FILE_MODEL_MAX bytes are read, and a text with a byte 0 never reaches the parser.
 */
#include "cli/model/load.h"

#include "cli/files/file.h"
#include "cli/files/stop.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"

#include <stdlib.h>
#include <string.h>

static motus_status no_model(const options *o, motus_error *err)
{
    const char *verb = options_verb(o->verb);
    fail(err, MOTUS_ARGUMENT, "motus %s needs a model", verb);
    hint(err, "motus %s model.motus, or - for standard input", verb);
    return MOTUS_ARGUMENT;
}

static const char *called(const char *path) { return strcmp(path, "-") == 0 ? "standard input" : path; }

motus_status load_complain(const char *text, const char *at, const char *path, const char *what, motus_error *err)
{
    int line = 1, column = 1;
    const char *start = text;
    for (const char *s = text; s < at; s++)
        if (*s == '\n') {
            line++;
            start = s + 1;
        }
    for (uint32_t c; start < at; column++) start += text_decode(start, &c);
    fail(err, MOTUS_SYNTAX, "%s", what);
    hint(err, "a model is a text file in UTF-8");
    text_safe(called(path), err->file, sizeof err->file);
    err->line = line;
    err->column = column;
    return MOTUS_SYNTAX;
}

static void name_of(const char *path, char *out, size_t size)
{
    const char *slash = strrchr(path, '/');
    const char *base = strcmp(path, "-") == 0 ? "model" : slash ? slash + 1 : path;
    text_safe(base, out, size);
    char *dot = strrchr(out, '.');
    if (dot && dot != out) *dot = 0;
}

static size_t numbers_of(const motus_system *system, load_naming *name)
{
    size_t all = 0, numbers;
    for (size_t k = 0; name(system, k, &numbers); k++) all += numbers;
    return all;
}

/* Returns the event of --section, which records, and ends the run after the last point that is wanted. The caller frees
 * it. */
static char *section_event(const options *o)
{
    const char *const where = o->section ? o->section : "";
    const size_t room = strlen(where) + 80;
    char *const text = malloc(room);
    if (!text) return NULL;
    snprintf(text, room, "%s as " LOAD_SECTION ": record", where);
    if (o->most_points > 0)
        snprintf(text + strlen(text), room - strlen(text), ", stop after %lld", (long long)(o->skip + o->most_points));
    return text;
}

/* Returns the number of characters in a text. */
static int characters(const char *text)
{
    int count = 0;
    for (; *text; text++) count += ((unsigned char)*text & 0xC0) != 0x80;
    return count;
}

/* Names the option that the text of an event came from in an error, and removes what section_event() has added. */
static void name_option(const options *o, const char *section, motus_error *err)
{
    if (err && strcmp(err->file, "motus_text_def.define") == 0) snprintf(err->file, sizeof err->file, "--record");
    if (!err || strcmp(err->file, "motus_text_def.when") != 0) return;
    const bool its = o->section && err->source[0] && strncmp(err->source, section, strlen(err->source)) == 0;
    snprintf(err->file, sizeof err->file, "%s", its ? "--section" : "--when");
    if (!its) return;
    if (err->column > characters(o->section)) {
        fail(err, MOTUS_SYNTAX, "--section \"%s\" is not what may stand before the colon of an event", o->section);
        hint(err, "write an equation or a comparison alone: --section \"x = 0 rising\"");
    } else if (strlen(o->section) < sizeof err->source) {
        err->source[strlen(o->section)] = 0;
    }
}

motus_status load_model(load *m, const options *o, motus_error *err)
{
    *m = (load){.set = motus_default_settings()};
    if (!o->operand) return no_model(o, err);
    name_of(o->operand, m->title, sizeof m->title);
    size_t length;
    motus_status status = MOTUS_OK;
    if (!o->text)
        status = file_read(o->operand, FILE_MODEL_MAX, &m->text, &length, err);
    else if (!(m->text = strdup(o->text)))
        status = complain_memory(err);
    if (status) return status;
    if (o->text) length = strlen(m->text);
    const char *zero = memchr(m->text, 0, length);
    if (zero) return load_complain(m->text, zero, o->operand, "this is not a text: it has a byte 0 here", err);
    motus_text_def def = motus_default_text();
    def.text = m->text;
    def.length = length;
    def.file = called(o->operand);
    status = defined_find(&m->defined, o->record, m->text, err);
    if (status) return status;
    def.define = (const char *const *)m->defined.line;
    def.define_count = m->defined.count;
    const char **set = malloc((o->set.count + 1) * sizeof *set), **when = malloc((o->when.count + 1) * sizeof *when);
    char *const section = section_event(o);
    if (set && when && section) {
        for (size_t k = 0; k < o->set.count; k++)
            if (!components_are(o->set.items[k])) set[def.set_count++] = o->set.items[k];
        for (size_t k = 0; k < o->when.count; k++) when[def.when_count++] = o->when.items[k];
        if (o->section) when[def.when_count++] = section;
        def.set = set;
        def.when = when;
        status = motus_system_from_text(&def, &m->system, err);
        name_option(o, section, err);
    } else {
        status = complain_memory(err);
    }
    free(set);
    free(when);
    free(section);
    if (!status) status = components_set(m->system, &o->set, err);
    if (status) return status;
    stop_catch_signals(); /* until now there was nothing to clean up, so signals could end the program at once */
    motus_column time = motus_default_column();
    if (motus_column_at(m->system, 0, &time) == MOTUS_OK) snprintf(m->time, sizeof m->time, "%s", time.name);
    m->positions = motus_positions(m->system);
    m->velocities = motus_velocities(m->system);
    m->quantities = numbers_of(m->system, motus_quantity_name);
    m->invariants = numbers_of(m->system, motus_invariant_name);
    return MOTUS_OK;
}

void load_free(load *m)
{
    motus_system_destroy(m->system);
    free(m->text);
    defined_free(&m->defined);
    *m = (load){0};
}

size_t load_quantity_column(const load *m) { return 1 + m->positions + m->velocities; }

size_t load_invariant_column(const load *m) { return load_quantity_column(m) + m->quantities; }
