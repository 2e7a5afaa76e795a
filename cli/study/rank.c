/* motus compare --accuracies: work against accuracy.
 *
 * Invariant: the library computes the numbers. A method that does not reach an accuracy has a line that says why.
 */
#include "cli/study/studies.h"

#include "cli/draw/plot.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"
#include "cli/words/words.h"
#include "tell/tell.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void tell(json *j, const void *result) { tell_ranking(j, result); }

static bool reached(const motus_rank_point *p) { return !isnan(p->error); }

static void accuracy_cell(table *t, double accuracy)
{
    char text[DECIMAL_MAX];
    double read = 0;
    text_brief(accuracy, -1, text);
    if (!typed_decimal(text, &read) || read != accuracy) text_brief(accuracy, -3, text);
    table_cell(t, text);
}

/* Makes the rows of the choice: the merit of a method is the mean logarithm of its work over the least work, where an
 * accuracy that it does not reach counts as a thousand times that. The cheapest for an accuracy is shown in any case.
 * NULL: no memory. */
static choose_row *choices(const motus_ranking *r, const studies *s, bool picture, size_t *shown)
{
    choose_row *rows = calloc(r->row_count + 1, sizeof *rows);
    for (size_t k = 0; rows && k < r->row_count; k++) {
        const motus_rank_row *row = r->rows[k];
        double merit = 0;
        for (size_t i = 0; i < r->judged; i++) {
            if (r->fewest[i] >= r->row_count) continue;
            const double least = (double)r->rows[r->fewest[i]]->points[i]->evaluations;
            merit += reached(row->points[i]) ? log((double)row->points[i]->evaluations / least) : log(1000);
            rows[k].must = rows[k].must || r->fewest[i] == k || r->fastest[i] == k;
        }
        rows[k].method = row->method;
        rows[k].merit = reached(row->points[0]) ? merit : INFINITY;
        rows[k].work = (double)row->points[0]->seconds;
    }
    if (rows) *shown = choose_methods(rows, r->row_count, s, picture);
    return rows;
}

/* Makes a table with a line for each method that reached an accuracy, and a column for each accuracy. */
static table *work_table(const motus_ranking *r, const choose_row *rows, bool time)
{
    char align[64] = "lr";
    memset(align + 2, 'r', r->judged);
    table *t = table_create(align);
    table_cell(t, "method");
    table_cell(t, "order");
    for (size_t i = 0; i < r->judged; i++) accuracy_cell(t, r->accuracies[i]);
    for (size_t k = 0; k < r->row_count; k++) {
        const motus_rank_row *row = r->rows[k];
        if (!rows[k].shown || !reached(row->points[0])) continue;
        table_cell(t, row->method);
        table_integer(t, row->order);
        for (size_t i = 0; i < r->judged; i++) {
            const motus_rank_point *p = row->points[i];
            char spent[DECIMAL_MAX] = "-";
            if (reached(p) && time) text_seconds(p->seconds, spent);
            if (reached(p) && !time)
                table_integer(t, p->evaluations);
            else
                table_cell(t, spent);
        }
    }
    return t;
}

static table *cheapest_table(const motus_ranking *r)
{
    table *t = table_create("rlrlr");
    static const char *const heads[] = {"accuracy", "fewest evaluations", "", "least time", ""};
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) table_cell(t, heads[i]);
    for (size_t i = 0; i < r->judged; i++) {
        const size_t few = r->fewest[i], fast = r->fastest[i];
        char spent[DECIMAL_MAX] = "-";
        accuracy_cell(t, r->accuracies[i]);
        table_cell(t, few < r->row_count ? r->rows[few]->method : "none");
        if (few < r->row_count)
            table_integer(t, r->rows[few]->points[i]->evaluations);
        else
            table_cell(t, "-");
        table_cell(t, fast < r->row_count ? r->rows[fast]->method : "none");
        if (fast < r->row_count) text_seconds(r->rows[fast]->points[i]->seconds, spent);
        table_cell(t, spent);
    }
    return t;
}

static bool print_table(const char *title, table *t, bool colours)
{
    printf("\n%s\n", title);
    const bool good = table_print(t, stdout, 2, colours);
    table_destroy(t);
    return good;
}

static motus_status print_tables(const studies *s, const void *result, motus_error *err)
{
    const motus_ranking *r = result;
    const bool colours = complain_colours(1);
    char title[MOTUS_NAME_MAX + 128];
    size_t shown = 0;
    choose_row *rows = choices(r, s, false, &shown);
    if (!rows) return complain_memory(err);
    studies_title(s, r->reference, r->reference_error);
    snprintf(title, sizeof title, "Evaluations of the force for an error of the answer of at most%s",
             r->absolute ? ", absolute" : "");
    bool good = print_table(title, work_table(r, rows, false), colours);
    snprintf(title, sizeof title, "Time for it, by the %s", r->machine);
    if (strcmp(r->machine, "interpreter") != 0) snprintf(title, sizeof title, "Time for it, %s", r->machine);
    good = print_table(title, work_table(r, rows, true), colours) && good;
    good = print_table("The cheapest", cheapest_table(r), colours) && good;
    choose_tell(shown, r->row_count, "work");
    bool first = true;
    for (size_t k = 0; k < r->row_count; k++)
        if (rows[k].shown && r->rows[k]->note[0]) studies_note(r->rows[k]->method, r->rows[k]->note, &first);
    if (r->remarks[0]) {
        putchar('\n');
        text_wrap(stdout, r->remarks, 2);
    }
    free(rows);
    return good ? MOTUS_OK : complain_memory(err);
}

/* ---- the figure ---- */

/* Draws error against work, both logarithmic. `numbers` is memory for the points. */
static motus_status draw_panel(const motus_ranking *r, plot_panel *p, const choose_row *rows, bool time,
                               double *numbers, motus_error *err)
{
    size_t used = 0;
    for (size_t k = 0; k < r->row_count; k++) {
        const size_t first = used;
        if (!rows[k].shown) continue;
        for (size_t i = 0; i < r->judged; i++) {
            const motus_rank_point *point = r->rows[k]->points[i];
            const double work = time ? point->seconds : (double)point->evaluations;
            if (!(point->error > 0) || !(work > 0)) continue; /* 0 has no logarithm */
            numbers[2 * used] = work;
            numbers[2 * used++ + 1] = point->error;
        }
        if (used > first &&
            !plot_curve_add(p, r->rows[k]->method, numbers + 2 * first, numbers + 2 * first + 1, used - first, 2))
            return complain_memory(err);
    }
    p->logarithmic = true;
    if (p->curve_count) return MOTUS_OK;
    return fail(err, MOTUS_ARGUMENT, "there is nothing to draw: no accuracy was reached with an error above 0");
}

static motus_status draw(studies *s, const void *result, file_out *file, motus_error *err)
{
    const motus_ranking *r = result;
    plot_figure figure = {0};
    size_t drawn = 0;
    snprintf(figure.title, sizeof figure.title, "%s: error against work", s->model.title);
    const size_t points = r->row_count * r->judged;
    choose_row *rows = choices(r, s, true, &drawn);
    double *numbers = malloc((4 * points + 1) * sizeof *numbers);
    motus_status status = numbers && rows ? MOTUS_OK : complain_memory(err);
    for (int time = 0; time < 2 && !status; time++) {
        char axis[PLOT_LABEL];
        snprintf(axis, sizeof axis, "time in seconds, %s", r->machine);
        plot_panel *p = plot_panel_add(&figure, time ? "time" : "evaluations", time ? axis : "evaluations of the force",
                                       r->absolute ? "largest error" : "largest error, relative");
        status = p ? draw_panel(r, p, rows, time, numbers + (time ? 2 * points : 0), err) : complain_memory(err);
    }
    if (!status) status = plot_draw(&figure, s->options->plot, file, err);
    if (!status) choose_note(drawn, r->row_count, s);
    plot_free(&figure);
    free(numbers);
    free(rows);
    return status;
}

motus_status rank_verb(const options *o, motus_error *err)
{
    static const studies_ways ways = {draw, tell, print_tables};
    studies s;
    motus_study_def def;
    motus_ranking *r = NULL;
    motus_status status = studies_begin(&s, "compare", false, o, &def, err);
    if (!status) {
        def.step = NAN;
        def.coarsest = o->accuracies.coarsest;
        def.finest = o->accuracies.finest;
        def.absolute = o->absolute;
        def.machine = o->machine;
        status = motus_rank(s.model.system, &def, &r, err);
    }
    stop_progress_end(&s.progress);
    if (!status) status = studies_show(&s, &ways, r, err);
    motus_ranking_destroy(r);
    load_free(&s.model);
    return status;
}
