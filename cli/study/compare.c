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
#include <stdlib.h>
#include <string.h>

static void tell(json *j, const void *result) { tell_comparison(j, result); }

/* Returns the error by which methods are ranked; without a reference, that of the first invariant. NaN: neither. */
static double error_of(const motus_compare_row *r)
{
    if (r->status) return NAN;
    if (!isnan(r->error_max_x)) return r->error_max_x;
    if (!isnan(r->error_max_s)) return r->error_max_s;
    return r->invariant_count ? fabs(r->invariants[0]->max_drift) : NAN;
}

/* Makes the rows of the choice: the merit of a method is its error at equal work. NULL: no memory. */
static choose_row *choices(const motus_comparison *c, const studies *s, bool picture, size_t *shown)
{
    choose_row *rows = calloc(c->row_count + 1, sizeof *rows);
    double least = INFINITY, most = 1;
    for (size_t k = 0; k < c->row_count; k++) {
        const double error = error_of(c->rows[k]);
        if (error > 0) least = fmin(least, error);
        most = fmax(most, (double)c->rows[k]->evaluations);
    }
    if (isinf(least)) least = 0;
    for (size_t k = 0; rows && k < c->row_count; k++) {
        const motus_compare_row *r = c->rows[k];
        const double work = (double)r->evaluations, error = error_of(r);
        rows[k] =
            (choose_row){.method = r->method, .work = work, .merit = choose_merit(error, least, work, most, r->order)};
        if (isnan(error) && !r->status) rows[k].merit = 1 / (double)r->order; /* nothing tells errors */
    }
    if (rows) *shown = choose_methods(rows, c->row_count, s, picture);
    return rows;
}

static table *work_table(const motus_comparison *c, const choose_row *rows)
{
    static const char *const heads[] = {"method", "order", "step", "steps", "evaluations", "time"};
    table *t = table_create("lrrrrr");
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) table_cell(t, heads[i]);
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_compare_row *r = c->rows[k];
        char spent[DECIMAL_MAX];
        if (!rows[k].shown) continue;
        text_seconds(r->seconds, spent);
        table_cell(t, r->method);
        table_integer(t, r->order);
        table_number(t, r->step, 4);
        table_integer(t, r->steps);
        table_integer(t, r->evaluations);
        table_cell(t, r->status ? "-" : spent);
    }
    return t;
}

/* Makes the table of errors, with columns for what the model has: positions and velocities, first-order variables. */
static table *error_table(const motus_comparison *c, const choose_row *rows, bool positions, bool first_order)
{
    static const char *const heads[] = {"x, max", "x, end", "v, max", "v, end", "s, max", "s, end"};
    table *t = table_create(positions && first_order ? "lrrrrrrr" : positions ? "lrrrrr" : "lrrr");
    table_cell(t, "error of");
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++)
        if (i < 4 ? positions : first_order) table_cell(t, heads[i]);
    table_cell(t, "reversal");
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_compare_row *r = c->rows[k];
        const double errors[] = {r->error_max_x,   r->error_final_x, r->error_max_v,
                                 r->error_final_v, r->error_max_s,   r->error_final_s};
        if (!rows[k].shown) continue;
        table_cell(t, r->method);
        for (size_t i = 0; i < sizeof errors / sizeof *errors; i++)
            if (i < 4 ? positions : first_order) table_number(t, r->status ? NAN : errors[i], -2);
        table_number(t, r->status ? NAN : r->reversal, -2);
    }
    return t;
}

enum { TOGETHER = 2 }; /* invariants in one table, which is as wide as a terminal */

/* Returns how many invariants there are. */
static size_t invariants_of(const motus_comparison *c)
{
    size_t most = 0;
    for (size_t k = 0; k < c->row_count; k++)
        if (!c->rows[k]->status && c->rows[k]->invariant_count > most) most = c->rows[k]->invariant_count;
    return most;
}

/* Makes the table of the drift of invariants and its trend, from number `first` on. */
static table *drift_table(const motus_comparison *c, const choose_row *rows, size_t first, size_t count)
{
    const size_t shown = count - first < TOGETHER ? count - first : TOGETHER;
    const motus_compare_row *any = NULL;
    table *t = table_create(shown == TOGETHER ? "lrlrl" : "lrl");
    for (size_t k = 0; !any; k++)
        if (!c->rows[k]->status && c->rows[k]->invariant_count == count) any = c->rows[k];
    table_cell(t, "method");
    for (size_t i = 0; i < shown; i++) {
        char head[MOTUS_NAME_MAX + 16];
        snprintf(head, sizeof head, "%s drift", any->invariants[first + i]->name);
        table_cell(t, head);
        table_cell(t, "trend");
    }
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_compare_row *r = c->rows[k];
        if (!rows[k].shown) continue;
        table_cell(t, r->method);
        for (size_t i = first; i < first + shown; i++) {
            bool known = !r->status && i < r->invariant_count;
            char trend[DECIMAL_MAX] = "none";
            if (known && r->invariants[i]->trending) text_brief(r->invariants[i]->trend, -2, trend);
            table_number(t, known ? r->invariants[i]->max_drift : NAN, -2);
            table_cell(t, known ? trend : "-");
        }
    }
    return t;
}

static bool print_table(table *t, bool colours)
{
    putchar('\n');
    const bool good = table_print(t, stdout, 2, colours);
    table_destroy(t);
    return good;
}

static motus_status print_tables(const studies *s, const void *result, motus_error *err)
{
    const motus_comparison *c = result;
    bool colours = complain_colours(1);
    const motus_system *system = s->model.system;
    const size_t nx = motus_positions(system);
    size_t shown = 0;
    choose_row *rows = choices(c, s, false, &shown);
    if (!rows) return complain_memory(err);
    studies_title(s, c->reference, c->reference_error);
    bool good = print_table(work_table(c, rows), colours);
    good = print_table(error_table(c, rows, nx > 0, motus_velocities(system) > nx), colours) && good;
    const size_t invariants = invariants_of(c);
    for (size_t i = 0; i < invariants; i += TOGETHER)
        good = print_table(drift_table(c, rows, i, invariants), colours) && good;
    choose_tell(shown, c->row_count, "error at equal work");
    bool first = true;
    for (size_t k = 0; k < c->row_count; k++)
        if (rows[k].shown && c->rows[k]->note && c->rows[k]->note[0])
            studies_note(c->rows[k]->method, c->rows[k]->note, &first);
    if (c->remarks && *c->remarks) {
        putchar('\n');
        text_wrap(stdout, c->remarks, 2);
    }
    free(rows);
    return good ? MOTUS_OK : complain_memory(err);
}

static motus_status draw(studies *s, const void *result, file_out *file, motus_error *err)
{
    stop_progress progress = stop_progress_begin("plot", s->options->quiet);
    size_t shown = 0;
    choose_row *rows = choices(result, s, true, &shown);
    motus_status status = rows ? overlay_draw(s, result, rows, file, &progress, err) : complain_memory(err);
    free(rows);
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
