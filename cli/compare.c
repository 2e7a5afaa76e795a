/* motus compare: every method side by side.
 *
 * Invariant: the numbers are the library's; here they are only laid out. A method that failed has a row that says why.
 */
#include "cli/complain.h"
#include "cli/file.h"
#include "cli/load.h"
#include "cli/overlay.h"
#include "cli/share.h"
#include "cli/stop.h"
#include "cli/table.h"
#include "cli/text.h"
#include "cli/verbs.h"
#include "tell/tell.h"

#include <math.h>
#include <string.h>

static void print_json(const options *o, const motus_comparison *c)
{
    json j = text_json(stdout);
    json_string(&j, "model", o->operand);
    tell_comparison(&j, c);
    json_end(&j);
}

static table *error_table(const motus_comparison *c)
{
    static const char *const heads[] = {"method", "order", "step", "steps", "evaluations", "time", "x error, max", "at the end",
                                        "v error, max", "at the end", "reversal"};
    table *t = table_create("lrrrrrrrrrr");
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++)
        table_cell(t, heads[i]);
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_compare_row *r = &c->rows[k];
        char spent[DECIMAL_MAX];
        text_seconds(r->seconds, spent);
        table_cell(t, r->method);
        table_integer(t, r->order);
        table_number(t, r->step, 4);
        table_integer(t, r->steps);
        table_integer(t, r->evaluations);
        table_cell(t, r->status ? "-" : spent);
        table_number(t, r->status ? NAN : r->error_max_x, -2);
        table_number(t, r->status ? NAN : r->error_final_x, -2);
        table_number(t, r->status ? NAN : r->error_max_v, -2);
        table_number(t, r->status ? NAN : r->error_final_v, -2);
        table_number(t, r->status ? NAN : r->reversal, -2);
    }
    return t;
}

/* Drift of the invariants, and whether it goes on. NULL where there are none. */
static table *drift_table(const motus_comparison *c)
{
    const motus_compare_row *widest = NULL;
    for (size_t k = 0; k < c->row_count; k++)
        if (!c->rows[k].status && c->rows[k].invariant_count > (widest ? widest->invariant_count : 0))
            widest = &c->rows[k];
    if (!widest)
        return NULL;
    enum { MOST = 6 };
    char align[2 * MOST + 2] = "l";
    size_t shown = widest->invariant_count < MOST ? widest->invariant_count : MOST;
    for (size_t i = 0; i < shown; i++)
        strcat(align, "rl");
    table *t = table_create(align);
    table_cell(t, "method");
    for (size_t i = 0; i < shown; i++) {
        char head[MOTUS_NAME_MAX + 16];
        snprintf(head, sizeof head, "%s drift", widest->invariants[i].name);
        table_cell(t, head);
        table_cell(t, "trend");
    }
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_compare_row *r = &c->rows[k];
        table_cell(t, r->method);
        for (size_t i = 0; i < shown; i++) {
            bool known = !r->status && i < r->invariant_count;
            char trend[DECIMAL_MAX] = "none";
            if (known && r->invariants[i].trending)
                text_brief(r->invariants[i].trend, -2, trend);
            table_number(t, known ? r->invariants[i].max_drift : NAN, -2);
            table_cell(t, known ? trend : "-");
        }
    }
    return t;
}

static motus_status print_tables(const load *m, const motus_comparison *c, motus_error *err)
{
    bool colours = complain_colours(1);
    table *errors = error_table(c), *drifts = drift_table(c);
    bool good = true;
    fprintf(stdout, "%s%s%s, errors against ", colours ? "\033[1m" : "", m->title, colours ? "\033[0m" : "");
    text_put(stdout, c->reference ? c->reference : "nothing");
    if (c->reference_error > 0)
        fprintf(stdout, " (itself good to %.1g)", c->reference_error);
    fputs("\n\n", stdout);
    good = table_print(errors, stdout, 2, colours);
    if (drifts) {
        putchar('\n');
        good = table_print(drifts, stdout, 2, colours) && good;
    }
    bool space = false;
    for (size_t k = 0; k < c->row_count; k++)
        if (c->rows[k].note && c->rows[k].note[0]) {
            char line[MOTUS_TEXT_MAX + MOTUS_NAME_MAX];
            bool named = strncmp(c->rows[k].note, c->rows[k].method, strlen(c->rows[k].method)) == 0;
            snprintf(line, sizeof line, "%s%s%s", named ? "" : c->rows[k].method, named ? "" : ": ", c->rows[k].note);
            fputs(space ? "" : "\n", stdout);
            text_wrap(stdout, line, 2, 100);
            space = true;
        }
    for (const char *s = c->remarks ? c->remarks : ""; *s; s += *s == '\n') {
        char line[1024];
        size_t length = strcspn(s, "\n");
        snprintf(line, sizeof line, "%.*s", (int)(length < sizeof line ? length : sizeof line - 1), s);
        fputs(s == c->remarks ? "\n" : "", stdout);
        text_wrap(stdout, line, 2, 100);
        s += length;
    }
    table_destroy(errors);
    table_destroy(drifts);
    return good ? MOTUS_OK : complain_memory(err);
}

/* The study, its picture, its tables: in this order, so that nothing is printed of what failed. */
static motus_status show(const options *o, load *m, const motus_comparison *c, motus_error *err)
{
    motus_status status = MOTUS_OK;
    file_out picture = {0};
    if (o->plot) {
        stop_progress progress = stop_progress_begin("plot", o->quiet);
        status = file_create(&picture, o->plot, err);
        if (!status)
            status = overlay_draw(m, c, o, &picture, &progress, err);
        stop_progress_end(&progress);
        if (!status)
            status = file_finish(&picture, err);
    }
    if (!status && o->json)
        print_json(o, c);
    else if (!status && !o->quiet)
        status = print_tables(m, c, err);
    if (!status)
        status = file_flush_output(err);
    if (!status)
        status = file_keep(&picture, err);
    file_drop(&picture);
    return status;
}

motus_status compare_verb(const options *o, motus_error *err)
{
    if (o->share)
        return share_verb(o, err);
    load m = {0};
    motus_comparison *c = NULL;
    motus_status status = o->plot ? plot_check(o->plot, err) : MOTUS_OK;
    if (!status && o->plot && o->operand && file_same(o->plot, o->operand))
        status = complain(err, MOTUS_ARGUMENT, "%s is read and would be overwritten", o->operand);
    if (!status)
        status = load_model(&m, o, err);
    if (!status) {
        stop_progress progress = stop_progress_begin("compare", o->quiet);
        motus_study_def def = motus_default_study();
        def.methods = o->methods.count ? o->methods.items : NULL;
        def.method_count = o->methods.count;
        def.step = o->step;
        def.until = o->until;
        def.evaluations = o->evaluations;
        def.progress = stop_progress_hook;
        def.context = &progress;
        status = motus_compare(m.system, &def, &c, err);
        stop_progress_end(&progress);
    }
    if (!status)
        status = show(o, &m, c, err);
    motus_comparison_destroy(c);
    load_free(&m);
    return status;
}
