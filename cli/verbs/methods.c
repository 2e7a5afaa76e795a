/* motus methods: the catalogue, or the card of one method. */
#include "cli/files/file.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"
#include "cli/words/text.h"
#include "tell/tell.h"

#include <math.h>
#include <string.h>

static void limit_text(double limit, char out[DECIMAL_MAX])
{
    if (isinf(limit))
        strcpy(out, "none");
    else if (limit == 0)
        strcpy(out, "never");
    else
        text_brief(limit, 4, out);
}

static void evaluations_text(int evaluations, char out[DECIMAL_MAX])
{
    if (evaluations > 0)
        snprintf(out, DECIMAL_MAX, "%d", evaluations);
    else
        strcpy(out, "solves");
}

static void print_json(const motus_method *only)
{
    json j = text_json(stdout);
    tell_methods(&j, only);
    json_end(&j);
}

static motus_status print_catalogue(const options *o, motus_error *err)
{
    static const char *const heads[] = {"name",       "order",      "between", "stages",      "evaluations", "forces",
                                        "symplectic", "reversible", "steps",   "limit of hω", "citation"};
    table *t = table_create("lrrrrllllrl");
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) table_cell(t, heads[i]);
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *m = motus_method_at(k);
        char limit[DECIMAL_MAX], evaluations[DECIMAL_MAX];
        limit_text(m->stability_limit, limit);
        evaluations_text(m->evaluations, evaluations);
        bool counted = m->order > 0; /* the exact motion has no order and no stages */
        table_cell(t, m->name);
        if (counted) {
            table_integer(t, m->order);
            table_integer(t, m->dense_order);
            table_integer(t, m->stages);
        } else {
            table_cell(t, "-");
            table_cell(t, "-");
            table_cell(t, "-");
        }
        table_cell(t, counted ? evaluations : "-");
        table_cell(t, tell_forces(m->forces));
        table_cell(t, m->symplectic ? "yes" : "no");
        table_cell(t, m->reversible ? "yes" : "no");
        table_cell(t, m->adaptive ? "adaptive" : "fixed");
        table_cell(t, limit);
        table_cell(t, m->cite ? m->cite : "");
    }
    bool good = o->markdown ? table_markdown(t, stdout) : table_print(t, stdout, 0, complain_colours(1));
    table_destroy(t);
    if (good && !o->markdown)
        text_wrap(
            stdout,
            "\nbetween: the order between steps. forces: what the force may depend on. symplectic: if the force is "
            "a gradient. limit: largest stable h ω for x'' = -ω² x. motus check MODEL shows what each method "
            "preserves in a model.\nmotus methods NAME shows the card of a method.",
            0);
    return good ? MOTUS_OK : complain_memory(err);
}

static void section(const char *title, const char *text, const char *strong, const char *plain)
{
    printf("\n%s%s%s\n", strong, title, plain);
    text_wrap(stdout, text, 2);
}

static void print_card(const motus_method *m)
{
    bool colours = complain_colours(1);
    const char *strong = colours ? "\033[1m" : "", *plain = colours ? "\033[0m" : "";
    char limit[DECIMAL_MAX], evaluations[DECIMAL_MAX], between[DECIMAL_MAX] = "as at steps", properties[512];
    limit_text(m->stability_limit, limit);
    evaluations_text(m->evaluations, evaluations);
    printf("%s%s%s, %s, order %d\n", strong, m->name, plain, m->family, m->order);
    if (m->aliases && m->aliases[0]) printf("also called: %s\n", m->aliases);
    section("formula", m->formula ? m->formula : "", strong, plain);
    if (m->dense_order < m->order) snprintf(between, sizeof between, "%d", m->dense_order);
    snprintf(properties, sizeof properties,
             "order between steps: %s\nstages: %d\nevaluations per step: %s\nforces may depend on: %s\nsymplectic: "
             "%s\nreversible: %s\n"
             "largest stable h ω: %s",
             between, m->stages, m->evaluations > 0 ? evaluations : "as many as the solver needs",
             tell_forces(m->forces), m->symplectic ? "yes, if the force is a gradient" : "no",
             m->reversible ? "yes" : "no", limit);
    section("properties", properties, strong, plain);
    section("reference", m->cite ? m->cite : "", strong, plain);
    printf("\n%swhen to use it%s\n  ", strong, plain);
    text_flow(stdout, m->use ? m->use : "", 2, 2, text_columns(stdout));
    putchar('\n');
}

static motus_status print_auto(motus_error *err)
{
    fputs("auto chooses the method of a run\n\n", stdout);
    text_wrap(
        stdout,
        "It compares those of taylor, dop853, dep12 and dep6 that admit the force, or dop853 and dopri5 if the force "
        "has kinks. Each integrates the first part of the motion; the one that needs the fewest operations is chosen. "
        "No clock is read, so the choice is the same on every machine. motus run prints the choice and its reason, and "
        "motus check MODEL prints them beforehand.",
        2);
    return file_flush_output(err);
}

motus_status methods_verb(const options *o, motus_error *err)
{
    if (o->operand && !strcmp(o->operand, "auto") && !o->json && !o->markdown) return print_auto(err);
    const motus_method *only = NULL;
    motus_status status = o->operand ? motus_method_find(o->operand, &only, err) : MOTUS_OK;
    if (status) return status;
    if (only && o->markdown) return fail(err, MOTUS_ARGUMENT, "--markdown prints the catalogue and takes no method");
    if (o->json)
        print_json(only);
    else if (only && !o->quiet)
        print_card(only);
    else if (!o->quiet)
        status = print_catalogue(o, err);
    return status ? status : file_flush_output(err);
}
