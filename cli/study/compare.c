/* motus compare: every method side by side.
 *
 * Invariant: the library computes the numbers. A method that failed has a row, and a note that says why.
 */
#include "cli/model/share.h"
#include "cli/study/studies.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"
#include "cli/words/text.h"
#include "tell/tell.h"

#include <math.h>
#include <string.h>

static void tell(json *j, const void *result) { tell_comparison(j, result); }

/* Makes the table of errors, with columns for what the model has: positions and velocities, first-order variables. */
static table *error_table(const motus_comparison *c, bool positions, bool first_order)
{
    static const char *const heads[] = {"method", "order", "step", "steps", "evaluations", "time"};
    enum { HEADS = sizeof heads / sizeof *heads };
    table *t = table_create(positions && first_order ? "lrrrrrrrrrrrr" : positions ? "lrrrrrrrrrr" : "lrrrrrrrr");
    for (size_t i = 0; i < HEADS; i++) table_cell(t, heads[i]);
    const char *const names[] = {"x error, max", "v error, max", "first-order error, max"};
    for (size_t i = 0; i < 3; i++)
        if (i < 2 ? positions : first_order) {
            table_cell(t, names[i]);
            table_cell(t, "at the end");
        }
    table_cell(t, "reversal");
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_compare_row *r = c->rows[k];
        const double errors[][2] = {
            {r->error_max_x, r->error_final_x}, {r->error_max_v, r->error_final_v}, {r->error_max_s, r->error_final_s}};
        char spent[DECIMAL_MAX];
        text_seconds(r->seconds, spent);
        table_cell(t, r->method);
        table_integer(t, r->order);
        table_number(t, r->step, 4);
        table_integer(t, r->steps);
        table_integer(t, r->evaluations);
        table_cell(t, r->status ? "-" : spent);
        for (size_t i = 0; i < 3; i++)
            for (size_t at = 0; (i < 2 ? positions : first_order) && at < 2; at++)
                table_number(t, r->status ? NAN : errors[i][at], -2);
        table_number(t, r->status ? NAN : r->reversal, -2);
    }
    return t;
}

/* Makes the table of the drift of invariants and its trend. Returns NULL if there are no invariants. */
static table *drift_table(const motus_comparison *c)
{
    const motus_compare_row *widest = NULL;
    for (size_t k = 0; k < c->row_count; k++)
        if (!c->rows[k]->status && c->rows[k]->invariant_count > (widest ? widest->invariant_count : 0))
            widest = c->rows[k];
    if (!widest) return NULL;
    enum { MOST = 6 };
    char align[2 * MOST + 2] = "l";
    size_t shown = widest->invariant_count < MOST ? widest->invariant_count : MOST;
    for (size_t i = 0; i < shown; i++) strcat(align, "rl");
    table *t = table_create(align);
    table_cell(t, "method");
    for (size_t i = 0; i < shown; i++) {
        char head[MOTUS_NAME_MAX + 16];
        snprintf(head, sizeof head, "%s drift", widest->invariants[i]->name);
        table_cell(t, head);
        table_cell(t, "trend");
    }
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_compare_row *r = c->rows[k];
        table_cell(t, r->method);
        for (size_t i = 0; i < shown; i++) {
            bool known = !r->status && i < r->invariant_count;
            char trend[DECIMAL_MAX] = "none";
            if (known && r->invariants[i]->trending) text_brief(r->invariants[i]->trend, -2, trend);
            table_number(t, known ? r->invariants[i]->max_drift : NAN, -2);
            table_cell(t, known ? trend : "-");
        }
    }
    return t;
}

static motus_status print_tables(const studies *s, const void *result, motus_error *err)
{
    const motus_comparison *c = result;
    bool colours = complain_colours(1);
    const motus_system *system = s->model.system;
    const size_t nx = motus_positions(system);
    table *errors = error_table(c, nx > 0, motus_velocities(system) > nx), *drifts = drift_table(c);
    studies_title(s, c->reference, c->reference_error);
    fputs("\n", stdout);
    bool good = table_print(errors, stdout, 2, colours);
    if (drifts) {
        putchar('\n');
        good = table_print(drifts, stdout, 2, colours) && good;
    }
    bool first = true;
    for (size_t k = 0; k < c->row_count; k++)
        if (c->rows[k]->note && c->rows[k]->note[0]) studies_note(c->rows[k]->method, c->rows[k]->note, &first);
    if (c->remarks && *c->remarks) {
        putchar('\n');
        text_wrap(stdout, c->remarks, 2, 100);
    }
    table_destroy(errors);
    table_destroy(drifts);
    return good ? MOTUS_OK : complain_memory(err);
}

static motus_status draw(studies *s, const void *result, file_out *file, motus_error *err)
{
    stop_progress progress = stop_progress_begin("plot", s->options->quiet);
    motus_status status = overlay_draw(&s->model, result, s->options, file, &progress, err);
    stop_progress_end(&progress);
    return status;
}

motus_status compare_verb(const options *o, motus_error *err)
{
    static const studies_ways ways = {draw, tell, print_tables};
    if (o->share) return share_verb(o, err);
    if (!isnan(o->accuracies.coarsest)) return rank_verb(o, err);
    studies s;
    motus_study_def def;
    motus_comparison *c = NULL;
    motus_status status = studies_begin(&s, "compare", o->evaluations == 0, o, &def, err);
    if (!status) status = motus_compare(s.model.system, &def, &c, err);
    if (status == MOTUS_UNAVAILABLE) hint(err, "with --accuracies 1e-3:1e-12 adaptive methods are compared too");
    stop_progress_end(&s.progress);
    if (!status) status = studies_show(&s, &ways, c, err);
    motus_comparison_destroy(c);
    load_free(&s.model);
    return status;
}
