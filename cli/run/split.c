/* Numbers that share a panel, and should not.
 *
 * Invariant: curves on one axis have one unit, and none is so low that it looks like a line at rest.
 */
#include "cli/run/figure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LOWEST 0.04 /* of the highest curve of a panel */

/* Returns how far the numbers of a curve reach. */
static double height(const plot_curve *c)
{
    double low = INFINITY, high = -INFINITY;
    data_range(c, c->y, &low, &high);
    return high > low ? high - low : 0;
}

/* Returns whether a line belongs to the first of a panel, beside which the highest curve of its unit is `most`. */
static bool goes_with(const figure *f, const plot_panel *p, const plot_curve *c, double most)
{
    char unit[2][UNIT_MAX];
    units_of(f->model->text, p->curves[0].label, false, unit[0]);
    units_of(f->model->text, c->label, false, unit[1]);
    const double own = height(c);
    return strcmp(unit[0], unit[1]) == 0 && (own >= LOWEST * most) == (height(&p->curves[0]) >= LOWEST * most);
}

/* Moves the curves that do not go with the first one to a new panel behind it. Returns false if memory runs out; *more
 * says whether there is a new panel. */
static bool split(figure *f, size_t index, bool *more)
{
    plot_panel *p = &f->plot.panels[index];
    double most = 0;
    *more = false;
    for (size_t k = 0; k < p->curve_count; k++) most = fmax(most, height(&p->curves[k]));
    for (size_t k = 0; k < p->curve_count; k++)
        *more = *more || (p->curves[k].role == PLOT_LINE && !goes_with(f, p, &p->curves[k], most));
    *more = *more && f->plot.count < FIGURE_PANELS;
    if (!*more) return true;
    const plot_panel whole = *p; /* adding a panel moves the others */
    if (!plot_panel_add(&f->plot, whole.title, whole.x_label, "")) return false;
    p = &f->plot.panels[index];
    const plot_panel last = f->plot.panels[f->plot.count - 1];
    memmove(p + 2, p + 1, (f->plot.count - 2 - index) * sizeof *p);
    p[1] = last;
    for (size_t k = 0; k < f->heat_count; k++) f->heats[k].panel += f->heats[k].panel > index;
    size_t kept = 0;
    bool moves = false;
    p[1].curves = malloc(p->curve_count * sizeof *p->curves);
    if (!p[1].curves) return false;
    for (size_t k = 0; k < whole.curve_count; k++) { /* dots and exact curves follow their lines */
        const plot_curve c = whole.curves[k];
        if (c.role == PLOT_LINE) moves = k > 0 && !goes_with(f, p, &c, most);
        if (moves)
            p[1].curves[p[1].curve_count++] = c;
        else
            p->curves[kept++] = c;
    }
    p->curve_count = kept;
    return true;
}

/* Names the vertical axis by its only line, or by the unit of all. */
static void name_axis(const figure *f, plot_panel *p)
{
    size_t lines = 0;
    char unit[UNIT_MAX];
    for (size_t k = 0; k < p->curve_count; k++) lines += p->curves[k].role == PLOT_LINE;
    units_of(f->model->text, p->curves[0].label, false, unit);
    if (lines == 1)
        units_label(f->model->text, p->curves[0].label, false, p->y_label, sizeof p->y_label);
    else if (unit[0])
        snprintf(p->y_label, sizeof p->y_label, "(%s)", unit);
    else
        p->y_label[0] = 0;
}

bool split_panels(figure *f)
{
    if (f->shared == SIZE_MAX) return true;
    for (size_t index = f->shared, more = 1; more; index++) {
        bool again;
        if (!split(f, index, &again)) return false;
        if (again || index > f->shared) name_axis(f, &f->plot.panels[index]);
        more = again;
    }
    return true;
}
