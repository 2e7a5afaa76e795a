/* motus converge: error against step, the fitted order, the certificate.
 *
 * Invariant: the table of orders comes first. The exit status is 0 unless a method does not show its order.
 */
#include "cli/draw/plot.h"
#include "cli/study/studies.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"
#include "cli/words/text.h"
#include "tell/tell.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    TOP = 100
}; /* a figure has no errors that are so many times the largest on a slope: the method is unstable there */

static void tell(json *j, const void *result) { tell_convergence(j, result); }

/* Prints steps and errors in pairs of lines; errors that the fit leaves out are in brackets. */
static bool print_points(const motus_converge_row *r, bool colours)
{
    enum { A_LINE = 10 };
    bool good = true;
    for (size_t first = 0; good && first < r->point_count; first += A_LINE) {
        char align[A_LINE + 2] = "l";
        size_t count = r->point_count - first < A_LINE ? r->point_count - first : A_LINE;
        memset(align + 1, 'r', count);
        table *t = table_create(align);
        table_cell(t, "step");
        for (size_t i = 0; i < count; i++) table_number(t, r->points[first + i]->step, 4);
        table_cell(t, "error");
        for (size_t i = 0; i < count; i++) {
            const motus_point *p = r->points[first + i];
            char number[DECIMAL_MAX], cell[DECIMAL_MAX + 4];
            text_brief(p->error, -2, number);
            snprintf(cell, sizeof cell, p->used || r->exact_here ? "%s" : "(%s)", number);
            table_cell(t, cell);
        }
        if (r->adaptive) table_cell(t, "between");
        for (size_t i = 0; r->adaptive && i < count; i++) table_number(t, r->points[first + i]->error_between, -2);
        if (r->adaptive) table_cell(t, "tolerance");
        for (size_t i = 0; r->adaptive && i < count; i++) table_number(t, r->points[first + i]->tolerance, -2);
        good = table_print(t, stdout, 4, colours);
        table_destroy(t);
    }
    return good;
}

/* Returns why a row has no order, or "" if it has one. */
static const char *without_order(const motus_converge_row *r)
{
    if (r->observed == r->observed || r->exact_here) return "";
    return r->certificate && r->certificate[0] ? r->certificate : motus_status_text(r->status);
}

static const char *passed_word(const motus_converge_row *r)
{
    return r->passed ? "yes" : r->uncertain ? "not certified" : "FAILED";
}

/* Writes a slope with twice its standard error: "5.10 ± 0.11". */
static void slope_cell(table *t, const motus_converge_row *r, double slope, double error)
{
    char text[64];
    snprintf(text, sizeof text, "%.2f ± %.2f", slope, 2 * error);
    table_cell(t, r->exact_here ? "exact here" : slope == slope ? text : "-");
}

/* Prints a line for each method that chooses its steps. Returns false if memory runs out. */
static bool print_paced(const motus_convergence *c, bool colours)
{
    static const char *const head[] = {"method", "passed", "order", "observed", "power", "due", "between", "due"};
    size_t rows = 0;
    table *t = table_create("llrrrrrrl");
    for (size_t i = 0; i < sizeof head / sizeof *head; i++) table_cell(t, head[i]);
    table_cell(t, "");
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_converge_row *r = c->rows[k];
        if (!r->adaptive) continue;
        const bool judged = r->between_due > 0;
        rows++;
        table_cell(t, r->method);
        table_cell(t, passed_word(r));
        table_integer(t, r->declared);
        slope_cell(t, r, r->observed, r->standard_error);
        slope_cell(t, r, r->power, r->power_error);
        table_number(t, r->power_due, 3);
        slope_cell(t, r, r->between, r->between_error);
        if (judged)
            table_integer(t, r->between_due);
        else
            table_cell(t, "-");
        table_cell(t, judged ? "" : r->certificate);
    }
    if (rows)
        printf("%smethods that choose their steps, each slope with twice its standard error\n"
               "(power: of the error against the tolerance)\n",
               rows < c->row_count ? "\n" : "");
    const bool good = !rows || table_print(t, stdout, 2, colours);
    table_destroy(t);
    return good;
}

/* Prints a line for each method with a fixed step. Returns false if memory runs out. */
static bool print_orders(const motus_convergence *c, bool colours)
{
    bool remarks = false;
    size_t rows = 0;
    for (size_t k = 0; k < c->row_count; k++) {
        remarks |= !c->rows[k]->adaptive && *without_order(c->rows[k]) != 0;
        rows += !c->rows[k]->adaptive;
    }
    if (!rows) return true;
    table *t = table_create(remarks ? "lrrrl" : "lrrr");
    static const char *const head[] = {"method", "declared", "observed", "passed"};
    for (size_t i = 0; i < sizeof head / sizeof *head; i++) table_cell(t, head[i]);
    if (remarks) table_cell(t, "");
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_converge_row *r = c->rows[k];
        if (r->adaptive) continue;
        char observed[32];
        snprintf(observed, sizeof observed, "%.2f", r->observed);
        table_cell(t, r->method);
        table_integer(t, r->declared);
        table_cell(t, r->exact_here ? "exact here" : r->observed == r->observed ? observed : "-");
        table_cell(t, passed_word(r));
        if (remarks) table_cell(t, without_order(r));
    }
    const bool good = table_print(t, stdout, 2, colours);
    table_destroy(t);
    return good;
}

static motus_status print_tables(const studies *s, const void *result, motus_error *err)
{
    const motus_convergence *c = result;
    const bool colours = complain_colours(1);
    studies_title(s, c->reference, c->reference_error);
    putchar('\n');
    bool good = print_orders(c, colours) && print_paced(c, colours), uncertain = false;
    for (size_t k = 0; k < c->row_count; k++) uncertain |= c->rows[k]->uncertain != 0;
    if (uncertain)
        text_wrap(stdout,
                  "\nnot certified: too few errors lie between the coarsest steps or tolerances and round-off to find "
                  "every slope, or the steps are not small enough, or the force is not smooth and leaves only a lower "
                  "order",
                  0);
    if (s->options->points)
        text_wrap(stdout, "\nin brackets: not in the fit, because instability or round-off dominates", 0);
    for (size_t k = 0; s->options->points && k < c->row_count && good; k++) {
        const motus_converge_row *r = c->rows[k];
        printf("\n  %s%s%s\n", colours ? "\033[1m" : "", r->method, colours ? "\033[0m" : "");
        good = print_points(r, colours);
    }
    return good ? MOTUS_OK : complain_memory(err);
}

/* Makes the rows of the choice: the merit of a method is its smallest error, at equal work. NULL: no memory. */
static choose_row *choices(const motus_convergence *c, const studies *s)
{
    choose_row *rows = calloc(c->row_count + 1, sizeof *rows);
    double least = INFINITY, most = 1;
    for (int pass = 0; rows && pass < 2; pass++)
        for (size_t k = 0; k < c->row_count; k++) {
            const motus_converge_row *r = c->rows[k];
            const motus_point *finest = NULL;
            for (size_t i = 0; i < r->point_count; i++)
                if (r->points[i]->error > 0 && (!finest || r->points[i]->error < finest->error)) finest = r->points[i];
            const double work = finest ? (double)finest->evaluations : 0;
            if (finest) least = fmin(least, finest->error);
            most = fmax(most, work);
            rows[k] = (choose_row){.method = r->method, .work = work, .merit = INFINITY};
            if (finest) rows[k].merit = choose_merit(finest->error, least, work, most, r->declared);
        }
    if (rows) (void)choose_methods(rows, c->row_count, s, true);
    return rows;
}

/* Adds the curve of a method: its errors against its steps. Returns how many points it has, which are at `numbers`. */
static size_t add_row(plot_panel *p, const motus_converge_row *r, double *numbers, motus_status *status)
{
    size_t count = 0;
    char label[PLOT_LABEL];
    for (size_t i = 0; i < r->point_count; i++)
        if (r->points[i]->error > 0) { /* 0 has no logarithm */
            numbers[2 * count] = r->points[i]->step;
            numbers[2 * count++ + 1] = r->points[i]->error;
        }
    if (r->observed == r->observed)
        snprintf(label, sizeof label, "%s %.2f", r->method, r->observed);
    else
        snprintf(label, sizeof label, "%s", r->method);
    if (count > 0 && !plot_curve_add(p, label, numbers, numbers + 1, count, 2)) *status = MOTUS_MEMORY;
    return count;
}

/* Returns the largest error on a slope; 0: there is no slope. */
static double largest_used(const motus_convergence *c, const choose_row *rows)
{
    double most = 0;
    for (size_t k = 0; k < c->row_count; k++)
        for (size_t i = 0; rows[k].shown && i < c->rows[k]->point_count; i++)
            if (c->rows[k]->points[i]->used) most = fmax(most, c->rows[k]->points[i]->error);
    return most;
}

/* Draws error against step, both logarithmic, so that the slope is the order. Of unstable methods, whose errors may be
 * 1e100, a tenth of the figure is enough. */
static motus_status draw(studies *s, const void *result, file_out *file, motus_error *err)
{
    const motus_convergence *c = result;
    plot_figure figure = {0};
    char step[PLOT_LABEL];
    size_t points = 0, used = 0, drawn = 0;
    units_label(s->model.text, "step", true, step, sizeof step);
    snprintf(figure.title, sizeof figure.title, "%s: error against step", s->model.title);
    plot_panel *p = plot_panel_add(&figure, "slope is the order", step, "largest error");
    for (size_t k = 0; k < c->row_count; k++) points += c->rows[k]->point_count;
    double *numbers = malloc((2 * points + 1) * sizeof *numbers);
    choose_row *rows = choices(c, s);
    motus_status status = p && numbers && rows ? MOTUS_OK : MOTUS_MEMORY;
    for (size_t k = 0; !status && k < c->row_count; k++) {
        if (!rows[k].shown) continue;
        used += add_row(p, c->rows[k], numbers + 2 * used, &status);
        drawn++;
    }
    if (status) (void)complain_memory(err);
    if (!status && p->curve_count == 0)
        status = fail(err, MOTUS_ARGUMENT, "there is nothing to draw: every error is 0 or unknown");
    if (!status) {
        p->logarithmic = true;
        p->top = TOP * largest_used(c, rows);
        status = plot_draw(&figure, s->options->plot, file, err);
    }
    if (!status) choose_note(drawn, c->row_count, s);
    plot_free(&figure);
    free(numbers);
    free(rows);
    return status;
}

/* Makes the error for methods that do not show their order. */
static motus_status verdict(const motus_convergence *c, motus_error *err)
{
    char names[MOTUS_TEXT_MAX / 2] = "";
    for (size_t k = 0; k < c->row_count; k++)
        if (!c->rows[k]->passed && !c->rows[k]->uncertain &&
            strlen(names) + strlen(c->rows[k]->method) + 3 < sizeof names) {
            strcat(names, names[0] ? ", " : "");
            strcat(names, c->rows[k]->method);
        }
    return fail(err, MOTUS_ORDER, "the certificate does not hold for: %s", names);
}

motus_status converge_verb(const options *o, motus_error *err)
{
    static const studies_ways ways = {draw, tell, print_tables};
    studies s;
    motus_study_def def;
    motus_convergence *c = NULL;
    motus_status status = studies_begin(&s, "converge", false, o, &def, err);
    if (!status) def.until = o->until; /* else the library takes the model's end or suggests one, and may cut it */
    if (!status) status = motus_converge(s.model.system, &def, &c, err);
    stop_progress_end(&s.progress);
    if (!status) status = studies_show(&s, &ways, c, err);
    if (!status && !c->passed) status = verdict(c, err);
    motus_convergence_destroy(c);
    load_free(&s.model);
    return status;
}
