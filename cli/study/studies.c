/* What the studies share.
 *
 * Invariant: a picture that cannot be drawn, or would overwrite the model, is an error before anything is computed.
 */
#include "cli/study/studies.h"

#include "cli/draw/plot.h"
#include "cli/files/target.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"

#include <math.h>
#include <string.h>

motus_status studies_begin(studies *s, const char *what, bool steps, const options *o, motus_study_def *def,
                           motus_error *err)
{
    *s = (studies){.options = o};
    motus_status status = o->plot ? plot_check(o->plot, err) : MOTUS_OK;
    if (!status && o->plot) status = target_check(o, o->plot, err);
    if (!status) status = load_model(&s->model, o, err);
    /* these methods admit all forces; the model's own method need not be among those that are studied */
    motus_run_def run = motus_default_run();
    run.method = steps ? "explicit-euler" : "dop853";
    if (steps) run.step = o->step;
    run.until = o->until;
    if (!status) status = settle_run(&s->model, o, &run, err);
    if (status) return status;
    *def = motus_default_study();
    def->machine = "auto";
    def->methods = o->methods.count ? o->methods.items : NULL;
    def->method_count = o->methods.count;
    def->step = steps ? run.step : o->step;
    def->until = run.until;
    def->evaluations = o->evaluations;
    def->progress = stop_progress_hook;
    def->context = &s->progress;
    s->def = *def;
    s->progress = stop_progress_begin(what, o->quiet);
    return MOTUS_OK;
}

void studies_title(const studies *s, const char *reference, double error)
{
    const bool colours = complain_colours(1);
    char line[MOTUS_TEXT_MAX], own[32] = "";
    printf("%s%s%s", colours ? "\033[1m" : "", s->model.title, colours ? "\033[0m" : "");
    if (error > 0) snprintf(own, sizeof own, " (error %.1g)", error);
    if (reference && !isnan(error))
        snprintf(line, sizeof line, ", errors against %.200s%s", reference, own);
    else
        snprintf(line, sizeof line, ", without errors: there is no reference solution");
    text_flow(stdout, line, text_width(s->model.title), 4, text_columns(stdout));
    putchar('\n');
}

void studies_note(const char *method, const char *text, bool *first)
{
    char line[2 * MOTUS_TEXT_MAX + MOTUS_NAME_MAX], note[2 * MOTUS_TEXT_MAX];
    const bool named = strncmp(text, method, strlen(method)) == 0;
    complain_named(text, note, sizeof note);
    snprintf(line, sizeof line, "%s%s%s", named ? "" : method, named ? "" : ": ", note);
    fputs(*first ? "\n" : "", stdout);
    text_wrap(stdout, line, 2);
    *first = false;
}

static void print_json(const studies *s, const studies_ways *ways, const void *result)
{
    json j = text_json(stdout);
    json_string(&j, "model", s->options->operand);
    settle_json(&j, &s->model);
    ways->tell(&j, result);
    json_end(&j);
    *s->options->answered = true;
}

motus_status studies_show(studies *s, const studies_ways *ways, const void *result, motus_error *err)
{
    const options *o = s->options;
    motus_status status = MOTUS_OK;
    file_out picture = {0};
    if (o->plot) {
        status = file_create(&picture, o->plot, err);
        if (!status) status = ways->draw(s, result, &picture, err);
        if (!status) status = file_finish(&picture, err);
    }
    if (!status && o->json)
        print_json(s, ways, result);
    else if (!status && !o->quiet)
        status = ways->tables(s, result, err);
    if (!status) status = file_flush_output(err);
    if (!status) status = file_keep(&picture, err);
    file_drop(&picture);
    return status;
}
