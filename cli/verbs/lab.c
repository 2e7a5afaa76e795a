/* motus lab: writes the page of the lab with a model in it, and opens it.
 *
 * Invariant: the model and the options are checked before anything is written; the page is then written completely or
 * not at all. Only one empty meta element of the built page changes: it gets the start, the fragment of a link with the
 * model. The only character of the start with a meaning in HTML is &, which is written &amp;.
 */
#include "base/platform.h"
#include "cli/files/file.h"
#include "cli/files/spawn.h"
#include "cli/files/stop.h"
#include "cli/files/target.h"
#include "cli/model/load.h"
#include "cli/model/share.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"
#include "cli/words/text.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- the page, as `make lab` builds it ---- */

typedef struct lab_page {
    char *path, *text;
    size_t length, place; /* the start is inserted before the byte `place` */
} lab_page;

#define PAGE_MAX ((size_t)16 << 20) /* bytes of a page */
enum { PATH_ROOM = 4096 };

/* Finds the folder of the program, by the system or else by the name with which it was called. */
static bool program_folder(const char *called, char out[PATH_ROOM])
{
    char found[PATH_ROOM];
    if (!platform_program(out, PATH_ROOM)) {
        const char *name = strchr(called, '/') ? called : file_program(called, found, sizeof found) ? found : NULL;
        char *real = name ? realpath(name, NULL) : NULL;
        bool fits = real && strlen(real) < PATH_ROOM;
        if (fits) strcpy(out, real);
        free(real);
        if (!fits) return false;
    }
    char *slash = strrchr(out, '/');
    if (slash) *slash = 0;
    return slash != NULL;
}

static motus_status find(char **path, const char *program, motus_error *err)
{
    static const char *const places[] = {"lab/motus-lab.html", MOTUS_LAB_INSTALLED};
    const char *named = getenv("MOTUS_LAB_PAGE");
    char folder[PATH_ROOM], candidate[PATH_ROOM + 256];
    if (named && *named) {
        *path = strdup(named);
        return *path ? MOTUS_OK : complain_memory(err);
    }
    bool known = program_folder(program, folder);
    for (size_t i = 0; known && i < sizeof places / sizeof *places; i++) {
        int n = snprintf(candidate, sizeof candidate, "%s/%s", folder, places[i]);
        if (n < 0 || (size_t)n >= sizeof candidate || access(candidate, F_OK) != 0) continue;
        *path = strdup(candidate);
        return *path ? MOTUS_OK : complain_memory(err);
    }
    return complain(err, MOTUS_FILE, "make lab builds it; MOTUS_LAB_PAGE may name another place",
                    "the page of the lab is missing: there is neither %s nor %s in %s", places[0], places[1],
                    known ? folder : "the folder of the program");
}

static motus_status not_a_page(const lab_page *p, const char *why, motus_error *err)
{
    return complain(err, MOTUS_FILE, "make lab builds it again", "%s is not the page of the lab: %s", p->path, why);
}

/* Reads the page that $MOTUS_LAB_PAGE names, or that beside the program, or the installed one. `program` is argv[0].
 * Call page_free() also after a failure. */
static motus_status page_read(lab_page *p, const char *program, motus_error *err)
{
    static const char meta[] = "<meta name=\"motus-start\"", empty[] = " content=\"\">";
    *p = (lab_page){0};
    motus_status status = find(&p->path, program, err);
    if (!status) status = file_read(p->path, PAGE_MAX, &p->text, &p->length, err);
    if (status) return status;
    if (memchr(p->text, 0, p->length)) return not_a_page(p, "it has a byte 0", err);
    const char *found = strstr(p->text, meta);
    if (!found) return not_a_page(p, "it has no <meta name=\"motus-start\">", err);
    const char *rest = found + sizeof meta - 1;
    if (strstr(rest, meta)) return not_a_page(p, "it has two <meta name=\"motus-start\">", err);
    if (strncmp(rest, empty, sizeof empty - 1) != 0) return not_a_page(p, "its motus-start is not empty", err);
    p->place = (size_t)(rest - p->text) + strlen(" content=\"");
    return MOTUS_OK;
}

static void page_free(lab_page *p)
{
    free(p->path);
    free(p->text);
    *p = (lab_page){0};
}

/* Writes the page with a start: a fragment (cli/model/share.h) without its #, or "" for none. */
static motus_status page_write(const lab_page *p, const char *start, file_out *f, motus_error *err)
{
    motus_status status = file_write(f, p->text, p->place, err);
    while (!status && *start) {
        size_t plain = strcspn(start, "&");
        status = file_write(f, start, plain, err);
        start += plain;
        if (!status && *start) {
            status = file_text(f, "&amp;", err);
            start++;
        }
    }
    return status ? status : file_write(f, p->text + p->place, p->length - p->place, err);
}

/* ---- the verb ---- */

typedef struct job {
    const options *options;
    load model;
    char *fragment; /* NULL: no model */
    lab_page page;
    char name[MOTUS_NAME_MAX + 16];
    const char *output;
    file_out file;
} job;

/* Refuses options that need a model when there is none. */
static motus_status check_alone(const options *o, motus_error *err)
{
    for (size_t k = 0; k < OPTION_COUNT; k++)
        if (o->given[k] && options_row(k)->link)
            return complain(err, MOTUS_ARGUMENT, "motus lab model.motus, or - for standard input",
                            "%s needs a model, which is missing", options_row(k)->name);
    return MOTUS_OK;
}

static motus_status read_model(job *j, motus_error *err)
{
    const options *o = j->options;
    motus_status status = load_model(&j->model, o, err);
    if (!status && o->method) status = motus_method_admits(j->model.system, o->method, err);
    for (size_t k = 0; !status && k < o->methods.count; k++)
        status = motus_method_admits(j->model.system, o->methods.items[k], err);
    return status ? status : share_fragment(&j->model, o, &j->fragment, err);
}

static motus_status name_output(job *j, motus_error *err)
{
    const options *o = j->options;
    snprintf(j->name, sizeof j->name, "%s-lab.html", o->operand ? j->model.title : "motus");
    j->output = o->output ? o->output : j->name;
    const char *const read[] = {o->operand, j->page.path};
    for (size_t i = 0; i < 2; i++)
        if (read[i] && strcmp(j->output, "-") != 0 && file_same(j->output, read[i]))
            return fail(err, MOTUS_ARGUMENT, "%s is read and would be overwritten", read[i]);
    /* a page with the name that motus gives is replaced: it holds only what the model says */
    return o->output ? target_check(o, o->output, err) : MOTUS_OK;
}

static motus_status print_path(const job *j, motus_error *err)
{
    if (strcmp(j->output, "-") == 0) return file_flush_output(err);
    if (j->options->json) {
        json out = text_json(stdout);
        json_string(&out, "output", j->output);
        json_end(&out);
    } else if (!j->options->quiet) {
        /* a script needs the exact name; a terminal must not get its control characters */
        if (isatty(STDOUT_FILENO))
            text_put(stdout, j->output);
        else
            fputs(j->output, stdout);
        putchar('\n');
    }
    return file_flush_output(err);
}

static void show(const job *j)
{
    char *path = realpath(j->output, NULL), *url = path ? share_file_url(path) : NULL;
    if (!(url && browser_open(url)) && !j->options->quiet)
        complain_note("no browser could be started: open %s", path ? path : j->output);
    free(url);
    free(path);
}

static motus_status write_page(job *j, motus_error *err)
{
    stop_catch_signals();
    motus_status status = file_create(&j->file, j->output, err);
    if (!status) status = page_write(&j->page, j->fragment ? j->fragment + 1 : "", &j->file, err);
    if (!status) status = file_finish(&j->file, err);
    if (!status && stop_requested()) status = fail(err, MOTUS_CANCELLED, "cancelled");
    if (!status) status = print_path(j, err);
    bool regular = !j->file.direct; /* not a device or a pipe */
    if (!status) status = file_keep(&j->file, err);
    if (!status && regular && !j->options->no_open) show(j);
    return status;
}

motus_status lab_verb(const options *o, motus_error *err)
{
    job j = {.options = o};
    motus_status status = o->operand ? read_model(&j, err) : check_alone(o, err);
    if (!status) status = page_read(&j.page, o->argv[0], err);
    if (!status) status = name_output(&j, err);
    if (!status) status = write_page(&j, err);
    file_drop(&j.file);
    page_free(&j.page);
    free(j.fragment);
    load_free(&j.model);
    return status;
}
