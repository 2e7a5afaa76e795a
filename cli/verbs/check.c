/* motus check: the equations that the program read, their properties, which methods the model admits, and which one
 * `auto` takes.
 *
 * Invariant: the reasons are those of the library, which a run gives too.
 */
#include "cli/files/file.h"
#include "cli/model/load.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"
#include "cli/words/text.h"
#include "tell/tell.h"

#include <stdio.h>
#include <string.h>

enum { REASONS = 9 };
#define TOLERANCE 1e-10 /* the first that is tried for the accuracy 1e-9, the default of a run */

/* Makes the run that `auto` would choose. Returns NULL if there is none; the error says why. */
static motus_run *auto_run(const load *m, motus_error *why)
{
    motus_run *run = NULL;
    motus_run_def def = motus_default_run();
    def.method = "auto";
    def.tolerance = TOLERANCE;
    def.machine = "interpreter";
    motus_run_create(m->system, &def, &run, why);
    return run;
}

static void auto_json(json *j, const load *m)
{
    motus_error why = motus_default_error();
    motus_run *run = auto_run(m, &why);
    json_open(j, "auto", '{');
    json_string(j, "method", run ? motus_run_now(run).method : NULL);
    json_string(j, "why", run ? motus_run_now(run).choice : why.message);
    json_close(j, '}');
    motus_run_destroy(run);
}

static void print_auto(const load *m, const char *strong, const char *plain)
{
    char line[MOTUS_TEXT_MAX + 64];
    motus_error why = motus_default_error();
    motus_run *run = auto_run(m, &why);
    if (run)
        snprintf(line, sizeof line, "%s (at tolerance %g)", motus_run_now(run).choice, TOLERANCE);
    else
        snprintf(line, sizeof line, "none: %s", why.message);
    printf("\n%sauto%s\n", strong, plain);
    text_wrap(stdout, line, 2);
    motus_run_destroy(run);
}

static void print_json(const options *o, const load *m)
{
    json j = text_json(stdout);
    json_string(&j, "model", o->operand);
    json_open(&j, "equations", '[');
    const char *equation;
    for (size_t k = 0; (equation = motus_equation_text(m->system, k)) != NULL; k++) json_string(&j, NULL, equation);
    json_close(&j, ']');
    tell_variables(&j, m->system);
    tell_analysis(&j, m->system);
    const char *explanation = motus_explain(m->system);
    json_string(&j, "explanation", explanation ? explanation : "");
    json_string(&j, "events", motus_explain_events(m->system));
    tell_switches(&j, m->system);
    auto_json(&j, m);
    tell_admissions(&j, m->system);
    json_end(&j);
}

/* Prints lines such as "x' = 0, where sign(x') changes: adaptive methods end their steps there; …" */
static void print_switches(const load *m, const char *strong, const char *plain)
{
    static const char *const sliding[] = {"", "",
                                          "; where the force pushes back from both sides, the motion is held there",
                                          "; where the force pushes back from both sides, a run ends"};
    motus_switch s = motus_default_switch();
    for (size_t k = 0; motus_switch_at(m->system, k, &s) == MOTUS_OK; k++) {
        char line[2 * MOTUS_TEXT_MAX], number[48] = "";
        if (k == 0) printf("\n%sswitching surfaces%s\n", strong, plain);
        if (s.count > 1) snprintf(number, sizeof number, " (%zu of them)", s.count);
        snprintf(line, sizeof line, "%.400s, where %.400s%s changes: %s%s%s", s.surface, s.operation, number,
                 s.located ? "adaptive methods end their steps there" : "steps cross it, since ", s.not_located,
                 s.located ? sliding[s.sliding] : "");
        text_wrap(stdout, line, 2);
    }
}

static motus_status print_text(const load *m, motus_error *err)
{
    bool colours = complain_colours(1);
    const char *strong = colours ? "\033[1m" : "", *plain = colours ? "\033[0m" : "", *equation;
    printf("%s%s%s\n\n%sequations%s\n", strong, m->title, plain, strong, plain);
    for (size_t k = 0; (equation = motus_equation_text(m->system, k)) != NULL; k++) {
        fputs("  ", stdout);
        text_flow(stdout, equation, 2, 6, text_columns(stdout));
        putchar('\n');
    }
    const char *text = motus_explain(m->system);
    printf("\n%sanalysis%s\n", strong, plain);
    text_wrap(stdout, text ? text : "", 2);
    const char *events = motus_explain_events(m->system);
    if (*events) {
        printf("\n%sevents%s\n", strong, plain);
        text_wrap(stdout, events, 2);
    }
    print_switches(m, strong, plain);
    printf("\n%smethods%s\n", strong, plain);
    char number[32], text_of[REASONS][MOTUS_TEXT_MAX]; /* methods that are not admitted share few reasons */
    size_t reasons = 0;
    table *t = table_create("llrll");
    table_cell(t, "method");
    table_cell(t, "admitted");
    table_cell(t, "order");
    table_cell(t, "preserves");
    table_cell(t, "why not");
    for (size_t k = 0; k < motus_method_count(); k++) {
        motus_error why = motus_default_error();
        const motus_method *method = motus_method_at(k);
        motus_geometry geometry = MOTUS_GEOMETRY_NONE;
        motus_status status = motus_method_geometry(m->system, method->name, &geometry, &why);
        table_cell(t, method->name);
        table_cell(t, status ? "no" : "yes");
        table_integer(t, method->order);
        table_cell(t, tell_geometry(geometry));
        const char *const reason = status ? tell_reason(why.message, method->name) : "";
        size_t r = 0;
        while (r < reasons && strcmp(reason, text_of[r]) != 0) r++;
        if (status && r == reasons && reasons < REASONS) snprintf(text_of[reasons++], MOTUS_TEXT_MAX, "%s", reason);
        snprintf(number, sizeof number, "(%zu)", r + 1);
        table_cell(t, status ? r < reasons ? number : reason : "");
    }
    bool good = table_print(t, stdout, 2, colours);
    table_destroy(t);
    if (reasons > 0) putchar('\n');
    for (size_t r = 0; r < reasons; r++) {
        printf("  (%zu) ", r + 1);
        text_flow(stdout, text_of[r], 6, 6, text_columns(stdout));
        putchar('\n');
    }
    print_auto(m, strong, plain);
    return good ? MOTUS_OK : complain_memory(err);
}

motus_status check_verb(const options *o, motus_error *err)
{
    load m = {0};
    motus_status status = load_model(&m, o, err);
    if (!status && o->json)
        print_json(o, &m);
    else if (!status && !o->quiet)
        status = print_text(&m, err);
    if (!status) status = file_flush_output(err);
    load_free(&m);
    return status;
}
