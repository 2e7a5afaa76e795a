/* Figures, as a script for gnuplot.
 *
 * Invariants: text enters the script in single quotes, with quotes doubled and control characters replaced, and the
 * terminal is `noenhanced`, so that no name is a command. Curves differ by more than colour: each has its own dashes
 * and, if there are several, its own marker. The key lies beside the panel, where it hides neither curves nor words.
 */
#include "cli/draw/plot.h"
#include "cli/words/complain.h"

#include "cli/words/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define DEEPEST 1e-18 /* of the largest number on a logarithmic axis of errors */

typedef struct style {
    const char *colour, *dashes;
    int marker;
} style;
static const style styles[] = {
    {"#1d4ed8", "solid", 6},  {"#c2410c", "(14,5)", 4},         {"#7c3aed", "(3,4)", 8}, {"#0f172a", "(16,4,3,4)", 12},
    {"#be185d", "(8,4)", 10}, {"#0e7490", "(12,3,3,3,3,3)", 2}, {"#a16207", "(6,8)", 1}, {"#64748b", "(20,6)", 3},
};
enum { STYLES = sizeof styles / sizeof *styles };

plot_panel *plot_panel_add(plot_figure *f, const char *title, const char *x_label, const char *y_label)
{
    if (f->count == PLOT_PANELS) return NULL;
    plot_panel *panels = realloc(f->panels, (f->count + 1) * sizeof *panels);
    if (!panels) return NULL;
    f->panels = panels;
    plot_panel *p = &panels[f->count++];
    *p = (plot_panel){.unknown_from = NAN};
    snprintf(p->title, sizeof p->title, "%s", title);
    snprintf(p->x_label, sizeof p->x_label, "%s", x_label);
    snprintf(p->y_label, sizeof p->y_label, "%s", y_label);
    return p;
}

plot_curve *plot_curve_add(plot_panel *p, const char *label, const double *x, const double *y, size_t count,
                           size_t stride)
{
    plot_curve *curves = realloc(p->curves, (p->curve_count + 1) * sizeof *curves);
    if (!curves) return NULL;
    p->curves = curves;
    plot_curve *c = &curves[p->curve_count++];
    *c = (plot_curve){.x = x, .y = y, .count = count, .stride = stride, .known = SIZE_MAX};
    snprintf(c->label, sizeof c->label, "%s", label);
    return c;
}

void plot_free(plot_figure *f)
{
    for (size_t i = 0; i < f->count; i++) {
        free(f->panels[i].curves);
        free(f->panels[i].heat);
    }
    free(f->panels);
    *f = (plot_figure){0};
}

static void quoted(FILE *out, const char *s)
{
    char safe[2 * PLOT_LABEL];
    text_safe(s, safe, sizeof safe);
    putc('\'', out);
    for (const char *c = safe; *c; c++) {
        if (*c == '\'') putc('\'', out);
        putc(*c, out);
    }
    putc('\'', out);
}

/* The numbers at the ends of an axis. */
typedef struct range {
    double low, high;
} range;

static range range_of(const plot_panel *p, bool y)
{
    range r = {INFINITY, -INFINITY};
    for (size_t k = 0; k < p->curve_count; k++) {
        const plot_curve *c = &p->curves[k];
        data_range(c, y ? c->y : c->x, &r.low, &r.high);
    }
    return r;
}

/* Returns whether a panel has a point that its axes show; without one gnuplot would fail. */
static bool anything(const plot_panel *p)
{
    for (size_t k = 0; k < p->curve_count; k++) {
        const plot_curve *c = &p->curves[k];
        for (size_t i = 0; i < c->count; i++) {
            const double x = c->x[i * c->stride], y = c->y[i * c->stride];
            const bool shown = !(p->logarithmic && !(x > 0)) && (!(p->logarithmic || p->log_y) || y > 0);
            if (shown && data_drawable(x) && data_drawable(y)) return true;
        }
    }
    return false;
}

/* Writes what the numbers of an axis look like: numbers that differ late need more digits than gnuplot's six, as many
 * as the ends of the axis differ in, and two more. Where these are many, or the axis is short, it has room for three or
 * four. */
static void put_numbers(FILE *out, char axis, range r, bool logarithmic, bool is_short)
{
    const double most = fmax(fabs(r.low), fabs(r.high)), wide = r.high - r.low;
    const int digits = wide > 0 && !logarithmic ? 3 + (int)ceil(log10(most / wide)) : 0;
    if (digits > 6) fprintf(out, "set format %c '%%.%dg'\n", axis, digits < 15 ? digits : 15);
    if (wide > 0 && !logarithmic && (is_short || digits > 6)) {
        const double power = pow(10, floor(log10(wide / 3))), part = wide / 3 / power;
        fprintf(out, "set %ctics %.6g\n", axis, power * (part < 2 ? 2 : part < 5 ? 5 : 10));
    } else {
        fprintf(out, "set %ctics autofreq\n", axis);
    }
}

/* Gives the axes one scale, by more room along one of them; not if the motion would be a tenth of its length high. Time
 * axes end where the curves end. */
static void put_ranges(FILE *out, const plot_panel *p, const layout_box *box)
{
    const range x = range_of(p, false), y = range_of(p, true);
    const double wide = x.high - x.low, high = y.high - y.low;
    fputs("set autoscale\n", out);
    if (p->equal && wide > 0 && high > 0 && wide < 10 * high && high < 10 * wide) {
        const double scale = 1.06 * fmax(wide / box->width, high / box->height);
        const double mx = x.low + wide / 2, my = y.low + high / 2;
        fprintf(out, "set xrange [%.10g:%.10g]\nset yrange [%.10g:%.10g]\n", mx - scale * box->width / 2,
                mx + scale * box->width / 2, my - scale * box->height / 2, my + scale * box->height / 2);
    } else if (p->curve_count && (p->curves[0].timelike || p->log_x) && wide > 0) {
        fprintf(out, "set xrange [%.12g:%.12g]\n", x.low, x.high);
    }
    put_numbers(out, 'x', x, p->logarithmic || p->log_x, false);
    put_numbers(out, 'y', y, p->logarithmic || p->log_y, p->low);
    /* what lies deeper is 0 but for its rounding */
    if (p->top > 0 && y.high > p->top) fprintf(out, "set yrange [:%.3g]\n", p->top);
    if (p->log_y && y.high > 0 && !(y.low > DEEPEST * y.high)) fprintf(out, "set yrange [%.3g:]\n", DEEPEST * y.high);
}

static void put_title(FILE *out, const char *label)
{
    char text[PLOT_LABEL];
    layout_label(label, text);
    fputs(" title ", out);
    quoted(out, text);
}

static void put_curve_style(FILE *out, const plot_panel *p, const plot_curve *c, size_t index, size_t lines)
{
    static const int marks[] = {4, 8, 12, 10, 14};
    const style *s = &styles[index % STYLES];
    switch (c->role) {
    case PLOT_EXACT: fputs(" with lines lw 5 dt (18,7) lc rgb '#15803D'", out); return;
    case PLOT_STEPS: fprintf(out, " with points pt 7 ps 0.55 lc rgb '%s'", s->colour); return;
    case PLOT_MARKS:
        fprintf(out, " with points pt %d ps 1.1 lw 1.6 lc rgb '#0f172a'",
                marks[c->kind % (sizeof marks / sizeof *marks)]);
        return;
    case PLOT_POINTS:
        fprintf(out, " with points pt 7 ps %s",
                c->drawn > 20000               ? "0.12"
                : c->drawn > 2000 && !c->shade ? "0.2"
                : c->drawn > 200               ? "0.4"
                                               : "0.6");
        if (c->shade)
            fputs(" lc palette", out);
        else
            fprintf(out, " lc rgb '%s'", s->colour);
        return;
    case PLOT_LINE: break;
    }
    /* if there are more curves than styles, curves with equal dashes have different markers */
    int marker = styles[(index + index / STYLES) % STYLES].marker;
    bool marked = lines > 1 || p->logarithmic || c->count == 1;
    fprintf(out, " with %s lw 1.8 dt %s lc rgb '%s'", marked && !c->z ? "linespoints" : "lines", s->dashes, s->colour);
    /* in space, gnuplot marks every point or none; put_curves() draws the markers as another curve */
    if (c->z) return;
    if (marked && p->logarithmic)
        fprintf(out, " pt %d ps 0.7", marker);
    else if (marked)
        fprintf(out, " pt %d ps 0.7 pn 9", marker);
}

/* Returns whether an earlier curve of the panel has this label in the key. */
static bool in_key(const plot_panel *p, size_t k)
{
    for (size_t i = 0; i < k; i++)
        if (p->curves[i].role == p->curves[k].role && strcmp(p->curves[i].label, p->curves[k].label) == 0) return true;
    return false;
}

static void put_curves(FILE *out, const plot_panel *p, size_t panel)
{
    size_t lines = 0;
    bool banded = false;
    for (size_t k = 0; k < p->curve_count; k++) lines += p->curves[k].role == PLOT_LINE;
    fputs(p->curve_count && p->curves[0].z ? "splot " : "plot ", out);
    /* bands and exact curves first, so that the others are drawn over them; dots and marks last */
    const char *comma = "";
    for (int pass = 0; pass < 3; pass++) {
        size_t index = 0;
        for (size_t k = 0; k < p->curve_count; k++) {
            const plot_curve *c = &p->curves[k];
            const size_t own = c->role == PLOT_STEPS && index > 0 ? index - 1 : index;
            index += c->role == PLOT_LINE;
            if (pass == 0 && data_band(p, c)) {
                fprintf(out, "%s$b%zu_%zu using 1:2:3 with filledcurves fc rgb '%s' fs transparent solid 0.25 noborder",
                        comma, panel, k, styles[own % STYLES].colour);
                put_title(out, banded ? "" : "error");
                banded = true;
                comma = ", ";
            }
            if (data_none(c)) continue;
            if (pass != (c->role == PLOT_EXACT ? 0 : c->role == PLOT_STEPS || c->role == PLOT_MARKS ? 2 : 1)) continue;
            fprintf(out, "%s$d%zu_%zu using %s", comma, panel, k, c->z || c->shade ? "1:2:3" : "1:2");
            comma = ", ";
            put_curve_style(out, p, c, own, lines);
            put_title(out, in_key(p, k) ? "" : c->label);
            if (c->z && c->role == PLOT_LINE && lines > 1)
                fprintf(out, ", $d%zu_%zu using 1:2:3 every %zu with points pt %d ps 0.9 lc rgb '%s' notitle", panel, k,
                        c->drawn / 5 + 1, styles[own % STYLES].marker, styles[own % STYLES].colour);
            if (!data_rest(c)) continue;
            fprintf(out, ", $u%zu_%zu using %s with lines lw 1.2 dt (2,4) lc rgb '%s' notitle", panel, k,
                    c->z ? "1:2:3" : "1:2", styles[own % STYLES].colour);
        }
    }
    putc('\n', out);
}

/* Writes a point of a curve as coordinates. */
static void put_place(FILE *out, const plot_curve *c, size_t i)
{
    i *= c->stride;
    if (c->z)
        fprintf(out, "first %.10g, first %.10g, first %.10g", c->x[i], c->y[i], c->z[i]);
    else
        fprintf(out, "first %.10g, first %.10g", c->x[i], c->y[i]);
}

/* Marks the start of a path by a circle, and its direction by an arrow after a tenth of the picture. */
static void put_start(FILE *out, const plot_panel *p, const plot_curve *c, const style *s, int *arrows)
{
    enum { FROM, TO };
    const double *const axes[] = {c->x, c->y, c->z};
    const double at[] = {[FROM] = 0.12, [TO] = 0.15};
    double size[3] = {0}, way = 0;
    size_t found[2] = {0, 0};
    for (size_t a = 0; a < 3 && axes[a]; a++) {
        range r = {INFINITY, -INFINITY};
        for (size_t k = 0; k < p->curve_count; k++) {
            const plot_curve *other = &p->curves[k];
            const double *const theirs[] = {other->x, other->y, other->z};
            if (theirs[a]) data_range(other, theirs[a], &r.low, &r.high);
        }
        size[a] = r.high - r.low;
    }
    for (size_t a = 0; p->equal && a < 3; a++) size[a] = fmax(size[0], fmax(size[1], size[2]));
    for (size_t i = 1; i < c->count && !found[TO]; i++) {
        double moved = 0;
        for (size_t a = 0; a < 3 && axes[a]; a++)
            if (size[a] > 0) moved = hypot(moved, (axes[a][i * c->stride] - axes[a][(i - 1) * c->stride]) / size[a]);
        if (isnan(moved)) return; /* the motion jumps before it has gone far */
        way += moved;
        for (int k = FROM; k <= TO; k++)
            if (!found[k] && way > at[k]) found[k] = i;
    }
    if (c->count == 0 || isnan(c->x[0])) return;
    fprintf(out, "set label %d '' at ", ++*arrows);
    put_place(out, c, 0);
    fprintf(out, " point pt 6 ps 1.2 lw 2 lc rgb '%s' front\n", s->colour);
    if (!found[TO]) return;
    if (found[FROM] == found[TO]) found[FROM]--; /* the steps are long */
    fprintf(out, "set arrow %d from ", *arrows);
    put_place(out, c, found[FROM]);
    fputs(" to ", out);
    put_place(out, c, found[TO]);
    fprintf(out, " head filled size screen 0.014,18 fixed lw 2 lc rgb '%s' front\n", s->colour);
}

#define RISING "set palette defined (0 '#1e3a8a', 1 '#0e7490', 2 '#15803d', 3 '#c2410c', 4 '#be185d')\n"

/* Numbers of both signs are red and blue from 0 on; those of one sign rise through the colours. */
static void put_heat_map(FILE *out, const plot_panel *p, size_t panel)
{
    range r = {INFINITY, -INFINITY};
    for (size_t i = 0; i < p->heat_rows * p->heat_columns; i++) {
        if (!data_drawable(p->heat[i])) continue;
        r.low = fmin(r.low, p->heat[i]);
        r.high = fmax(r.high, p->heat[i]);
    }
    const double most = fmax(fabs(r.low), fabs(r.high));
    if (r.low < r.high && (r.low >= 0 || r.high <= 0))
        fprintf(out, "set cbrange [%.6g:%.6g]\n" RISING, r.low, r.high);
    else
        fprintf(out,
                "set cbrange [%.6g:%.6g]\nset palette defined (-1 '#1e3a8a', -0.5 '#60a5fa', 0 '#f8fafc', 0.5 "
                "'#fb923c', 1 '#7c2d12')\n",
                isfinite(most) && most > 0 ? -most : -1, isfinite(most) && most > 0 ? most : 1);
    fprintf(out,
            "set autoscale xfix\nset autoscale yfix\nplot $heat%zu matrix using (%.12g+$1*%.12g):(%.12g+$2*%.12g):3 "
            "with image notitle\n",
            panel, p->x_first, p->x_step, p->y_first, p->y_step);
}

static void put_box(FILE *out, const layout *l, const layout_box *box)
{
    const double w = l->width, h = l->height;
    fprintf(out, "set lmargin at screen %.6f\nset rmargin at screen %.6f\n", box->left / w,
            (box->left + box->width) / w);
    fprintf(out, "set tmargin at screen %.6f\nset bmargin at screen %.6f\n", 1 - box->top / h,
            1 - (box->top + box->height) / h);
    if (box->key > 0)
        fprintf(out,
                "set key at screen %.6f, screen %.6f left top vertical Left reverse nobox samplen 2.5 spacing 1.1\n",
                box->key / w, 1 - box->top / h);
    else
        fputs("unset key\n", out);
}

static void put_panel(FILE *out, const plot_panel *p, const layout *l, size_t index)
{
    const layout_box *box = &l->boxes[index];
    bool solid = p->curve_count && p->curves[0].z;
    put_box(out, l, box);
    fputs("set title ", out);
    quoted(out, p->title);
    fputs(" offset 0,-0.4\nset xlabel ", out);
    quoted(out, p->x_label);
    fputs(" offset 0,0.4\nset ylabel ", out);
    quoted(out, p->y_label);
    putc('\n', out);
    if (p->heat && !isnan(p->unknown_from))
        for (int k = 1; k <= 2; k++) /* a dark line on a light one is seen on every colour */
            fprintf(out, "set arrow %d from first %.12g, graph 0 to first %.12g, graph 1 nohead front %s\n", k,
                    p->unknown_from, p->unknown_from,
                    k == 1 ? "lw 5 lc rgb '#f8fafc'" : "lw 2.5 dt (2,3) lc rgb '#0f172a'");
    fputs(solid ? "set border 31 lc rgb '#64748b'\n" : "set border 3 lc rgb '#64748b'\n", out);
    if (p->logarithmic) fputs("set logscale xy\nset format xy '%.0e'\n", out);
    if (p->log_x) fputs("set logscale x\n", out);
    if (p->log_y) fputs("set logscale y\nset format y '%.0e'\n", out);
    if (solid) {
        fprintf(out, "set view 62, 32, 1, 1\nset view %sequal xyz\nset xyplane 0\nset zlabel ", p->equal ? "" : "no");
        quoted(out, p->z_label);
        putc('\n', out);
    }
    if (p->shade_label[0]) {
        fputs("set autoscale cb\n" RISING "set cblabel ", out);
        quoted(out, p->shade_label);
        putc('\n', out);
    }
    if (p->heat) {
        fputs("set autoscale\n", out);
        put_heat_map(out, p, index);
    } else if (!anything(p)) {
        fputs("set xrange [0:1]\nset yrange [0:1]\nset label 1 'every number is 0, or not known' at graph 0.5, graph "
              "0.5 center\nplot NaN notitle\n",
              out);
    } else {
        int arrows = 0;
        size_t lines = 0;
        put_ranges(out, p, box);
        for (size_t k = 0; p->path && k < p->curve_count; k++)
            if (p->curves[k].role == PLOT_LINE) put_start(out, p, &p->curves[k], &styles[lines++ % STYLES], &arrows);
        put_curves(out, p, index);
    }
    fputs("unset logscale\nset format\nunset zlabel\nunset cblabel\nunset arrow\nunset label\nset view noequal\n", out);
}

static const char *const formats[] = {".svg", ".png", ".pdf"};

static size_t format_of(const char *path)
{
    size_t length = strlen(path), k = 0;
    while (k < 3 && !(length > 4 && strcasecmp(path + length - 4, formats[k]) == 0)) k++;
    return k;
}

motus_status plot_check(const char *path, motus_error *err)
{
    if (format_of(path) == 3)
        return complain(err, MOTUS_ARGUMENT, "end the name in .svg, .png or .pdf",
                        "--plot %s: the name's ending is not a known format", path);
    return gnuplot_check(err);
}

static void put_terminal(FILE *out, const char *path, layout l)
{
    fputs("set encoding utf8\n", out);
    switch (format_of(path)) {
    case 1:
        fprintf(out, "set terminal pngcairo size %d,%d noenhanced font 'sans,11' background '#ffffff'\n", l.width,
                l.height);
        break;
    case 2:
        fprintf(out, "set terminal pdfcairo size %.2fin,%.2fin noenhanced font 'sans,11' background '#ffffff'\n",
                l.width / 96.0, l.height / 96.0);
        break;
    default:
        fprintf(out, "set terminal svg size %d,%d noenhanced font 'sans-serif,14' background '#ffffff' standalone\n",
                l.width, l.height);
    }
}

static void put_script(FILE *out, plot_figure *f, const char *path)
{
    const layout l = layout_make(f);
    put_terminal(out, path, l);
    data_write(out, f);
    fputs("set tics nomirror\nset grid lt 1 lw 0.7 lc rgb '#e2e8f0'\nset datafile missing 'NaN'\n", out);
    fputs("set multiplot title ", out);
    quoted(out, f->title);
    putc('\n', out);
    for (size_t i = 0; i < f->count; i++) put_panel(out, &f->panels[i], &l, i);
    fputs("unset multiplot\n", out);
}

motus_status plot_draw(plot_figure *f, const char *path, file_out *file, motus_error *err)
{
    gnuplot g = {0};
    motus_status status = gnuplot_open(&g, err);
    if (!status) {
        put_script(g.script, f, path);
        status = gnuplot_draw(&g, file, err);
    }
    gnuplot_close(&g);
    return status;
}
