/* motus lab: the page of the lab with a model in it, written and opened.
 *
 * Invariant: the model and the options are checked before anything is written; the page is then written completely or
 * not at all.
 */
#define _XOPEN_SOURCE 700
#include "cli/files/browser.h"
#include "cli/words/complain.h"
#include "cli/files/file.h"
#include "cli/verbs/lab_page.h"
#include "cli/model/load.h"
#include "cli/model/share.h"
#include "cli/files/stop.h"
#include "cli/words/text.h"
#include "cli/words/options.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
    return MOTUS_OK;
}

static motus_status print_path(const job *j, motus_error *err)
{
    if (strcmp(j->output, "-") == 0) return file_flush_output(err);
    if (j->options->json) {
        json out = text_json(stdout);
        json_string(&out, "output", j->output);
        json_end(&out);
    } else if (!j->options->quiet) {
        /* a script needs the exact name; a terminal must not get control characters in it */
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
    if (!status) status = lab_page_write(&j->page, j->fragment ? j->fragment + 1 : "", &j->file, err);
    if (!status) status = file_finish(&j->file, err);
    if (!status && stop_requested()) status = fail(err, MOTUS_CANCELLED, "cancelled");
    if (!status) status = print_path(j, err);
    bool regular = !j->file.direct; /* not a device or pipe */
    if (!status) status = file_keep(&j->file, err);
    if (!status && regular && !j->options->no_open) show(j);
    return status;
}

motus_status lab_verb(const options *o, motus_error *err)
{
    job j = {.options = o};
    motus_status status = o->operand ? read_model(&j, err) : check_alone(o, err);
    if (!status) status = lab_page_read(&j.page, o->argv[0], err);
    if (!status) status = name_output(&j, err);
    if (!status) status = write_page(&j, err);
    file_drop(&j.file);
    lab_page_free(&j.page);
    free(j.fragment);
    load_free(&j.model);
    return status;
}
