/* motus check: what the program understood of a model, and which methods it admits.
 *
 * Invariant: the reasons are the library's own, the ones a run would give.
 */
#include "cli/complain.h"
#include "cli/file.h"
#include "cli/json.h"
#include "cli/load.h"
#include "cli/table.h"
#include "cli/text.h"
#include "cli/verbs.h"

#include <string.h>

/* The reason alone: which method and that it is refused stands beside it. */
static const char *reason(const char *message, const char *method)
{
    static const char words[] = " does not admit this model: ";
    size_t length = strlen(method);
    if (strncmp(message, method, length) == 0 && strncmp(message + length, words, sizeof words - 1) == 0)
        return message + length + sizeof words - 1;
    return message;
}

static void flag(json *j, const char *key, int value)
{
    json_key(j, key);
    json_bool(j, value != 0);
}

static void variables_json(json *j, motus_system *system)
{
    motus_variable v = motus_default_variable();
    json_key(j, "variables");
    json_open(j, '[');
    for (size_t k = 0; motus_variable_at(system, k, &v) == MOTUS_OK; k++) {
        json_open(j, '{');
        json_key(j, "name");
        json_string(j, v.name);
        json_key(j, "order");
        json_integer(j, v.order);
        json_key(j, "components");
        json_integer(j, v.components);
        json_key(j, "ranges");
        json_open(j, '[');
        for (int d = 0; d < v.dimensions; d++) {
            json_open(j, '[');
            json_integer(j, v.first[d]);
            json_integer(j, v.last[d]);
            json_close(j, ']');
        }
        json_close(j, ']');
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void print_json(const options *o, const load *m)
{
    motus_analysis a = motus_default_analysis();
    motus_analysis_of(m->system, &a);
    json j = json_begin(stdout);
    json_open(&j, '{');
    json_key(&j, "model");
    json_string(&j, o->operand);
    json_key(&j, "equations");
    json_open(&j, '[');
    const char *equation;
    for (size_t k = 0; (equation = motus_equation_text(m->system, k)) != NULL; k++)
        json_string(&j, equation);
    json_close(&j, ']');
    variables_json(&j, m->system);
    flag(&j, "velocity_dependent", a.velocity_dependent);
    flag(&j, "linear_in_velocity", a.linear_in_velocity);
    flag(&j, "time_dependent", a.time_dependent);
    flag(&j, "affine", a.affine);
    flag(&j, "constant", a.constant);
    flag(&j, "gyroscopic", a.gyroscopic);
    flag(&j, "gradient", a.gradient);
    flag(&j, "smooth", a.smooth);
    flag(&j, "exact_recognised", a.exact_recognised);
    json_key(&j, "explanation");
    const char *text = motus_explain(m->system);
    json_string(&j, text ? text : "");
    json_key(&j, "methods");
    json_open(&j, '[');
    for (size_t k = 0; k < motus_method_count(); k++) {
        motus_error why = motus_default_error();
        const char *name = motus_method_at(k)->name;
        motus_status status = motus_method_admits(m->system, name, &why);
        json_open(&j, '{');
        json_key(&j, "name");
        json_string(&j, name);
        json_key(&j, "admitted");
        json_bool(&j, status == MOTUS_OK);
        json_key(&j, "reason");
        json_string(&j, status ? reason(why.message, name) : "");
        json_close(&j, '}');
    }
    json_close(&j, ']');
    json_close(&j, '}');
    json_end(&j);
}

/* A text line by line, indented. */
static void print_lines(const char *text)
{
    while (*text) {
        char line[2048];
        size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)(length < sizeof line ? length : sizeof line - 1), text);
        text_wrap(stdout, line, 2, 100);
        text += length + (text[length] == '\n');
    }
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
    printf("\n%swhat they say%s\n", strong, plain);
    print_lines(text ? text : "");
    printf("\n%smethods%s\n", strong, plain);
    table *t = table_create("llrl");
    table_cell(t, "method");
    table_cell(t, "admitted");
    table_cell(t, "order");
    table_cell(t, "why not");
    for (size_t k = 0; k < motus_method_count(); k++) {
        motus_error why = motus_default_error();
        const motus_method *method = motus_method_at(k);
        motus_status status = motus_method_admits(m->system, method->name, &why);
        table_cell(t, method->name);
        table_cell(t, status ? "no" : "yes");
        table_integer(t, method->order);
        table_cell(t, status ? reason(why.message, method->name) : "");
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
    if (!status)
        status = file_flush_output(err);
    load_free(&m);
    return status;
}
