/* motus check: the equations that the program read, their properties, and which methods the model admits.
 *
 * Invariant: the reasons are the library's, the same that a run would give.
 */
#include "cli/complain.h"
#include "cli/file.h"
#include "cli/load.h"
#include "cli/table.h"
#include "cli/text.h"
#include "cli/verbs.h"
#include "tell/tell.h"

#include <string.h>

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
    tell_admissions(&j, m->system);
    json_end(&j);
}

static motus_status print_text(const load *m, motus_error *err)
{
    bool colours = complain_colours(1);
    const char *strong = colours ? "\033[1m" : "", *plain = colours ? "\033[0m" : "", *equation;
    printf("%s%s%s\n\n%sequations%s\n", strong, m->title, plain, strong, plain);
    for (size_t k = 0; (equation = motus_equation_text(m->system, k)) != NULL; k++) {
        fputs("  ", stdout);
        text_put(stdout, equation);
        putchar('\n');
    }
    const char *text = motus_explain(m->system);
    printf("\n%sanalysis%s\n", strong, plain);
    text_wrap(stdout, text ? text : "", 2, 100);
    printf("\n%smethods%s\n", strong, plain);
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
        table_cell(t, status ? tell_reason(why.message, method->name) : "");
    }
    bool good = table_print(t, stdout, 2, colours);
    table_destroy(t);
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
