/* Figures, as a script for gnuplot.
 *
 * Invariants: text enters the script in single quotes, with quotes doubled and control characters replaced, and the
 * terminal is `noenhanced`, so that no name is a command. Data are numbers in data blocks. Curves differ by more than
 * colour: each has its own dashes and, if there are several, its own marker. Thinning keeps the smallest and the
 * largest value in every column of the picture.
 */
#include "cli/draw/plot.h"
#include "cli/words/complain.h"

#include "cli/words/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    COLUMNS = 2000,    /* columns of the picture, with two values each */
    PATH_GRID = 2500,  /* points of a path that are nearer than 1/2500 of the picture are drawn as one */
    PATH_MOST = 40000, /* points of a path, about */
    CELLS = 1600       /* cells along each side of the picture, if there are many points; a cell shows one point */
};

#define BAND_LEAST 1e-3 /* of the curve's height: a thinner band is no wider than the curve's line */

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

/* Returns whether gnuplot can scale a number without overflow; other numbers are gaps in a curve. */
static bool drawable(double v) { return isfinite(v) && fabs(v) < 1e290; }

static void put_point(FILE *out, plot_curve *c, size_t i)
{
    c->drawn++;
    double x = c->x[i * c->stride], y = c->y[i * c->stride] - (c->change ? c->y[0] : 0),
           z = c->z ? c->z[i * c->stride] : 0;
    if (!drawable(x) || !drawable(y) || !drawable(z))
        fputs(c->z ? "\n\n" : "\n", out); /* in space, a single empty line begins another row of a grid */
    else if (c->z)
        fprintf(out, "%.10g %.10g %.10g\n", x, y, z);
    else if (c->shade)
        fprintf(out, "%.12g %.10g %.10g\n", x, y, c->shade[i * c->stride]);
    else
        fprintf(out, "%.12g %.10g\n", x, y);
}

/* Returns whether a point breaks the curve, since the motion jumps there. */
static bool breaks(const plot_curve *c, size_t i) { return isnan(c->x[i * c->stride]); }

/* Draws the smallest and the largest value of the points [begin, end), in their order in time. */
static void put_extremes(FILE *out, plot_curve *c, size_t begin, size_t end)
{
    size_t low = begin, high = begin;
    for (size_t i = begin; i < end; i++) {
        double y = c->y[i * c->stride];
        if (!(y >= c->y[low * c->stride])) low = i;
        if (!(y <= c->y[high * c->stride])) high = i;
    }
    if (begin == end) return;
    put_point(out, c, low < high ? low : high);
    if (low != high) put_point(out, c, low < high ? high : low);
}

/* Draws the smallest and the largest value in every column of the picture. In a column in which the curve breaks, draws
 * them for each part, and the ends of each part, which are the sides of jumps. */
static void put_timelike(FILE *out, plot_curve *c)
{
    for (size_t bucket = 0; bucket < COLUMNS; bucket++) {
        size_t begin = (size_t)((double)c->count * (double)bucket / COLUMNS);
        size_t end = bucket + 1 == COLUMNS ? c->count : (size_t)((double)c->count * (double)(bucket + 1) / COLUMNS);
        for (size_t part = begin, i = begin; i <= end; i++) {
            if (i < end && !breaks(c, i)) continue;
            put_extremes(out, c, part, i);
            if (i < end && i > part) put_point(out, c, i - 1);
            if (i < end) put_point(out, c, i);
            part = i + 1;
            if (part < end && i < end) put_point(out, c, part);
        }
    }
    put_point(out, c, c->count - 1);
}

static double extent(const double *v, size_t count, size_t stride)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        double y = v[i * stride];
        if (!drawable(y)) continue;
        low = fmin(low, y);
        high = fmax(high, y);
    }
    return high > low ? high - low : 0;
}

/* Draws the points of a path that are a visible distance from the last one drawn, and both sides of its jumps. */
static void put_path(FILE *out, plot_curve *c)
{
    const double *axes[] = {c->x, c->y, c->z};
    double scale[3] = {0};
    for (size_t a = 0; a < 3; a++)
        if (axes[a]) {
            double e = extent(axes[a], c->count, c->stride);
            scale[a] = e > 0 ? PATH_GRID / e : 0;
        }
    size_t last = 0, kept = 0;
    size_t skip = c->count / PATH_MOST + 1;
    put_point(out, c, 0);
    for (size_t i = 1; i < c->count; i++) {
        double moved = 0;
        for (size_t a = 0; a < 3; a++)
            if (axes[a]) moved = fmax(moved, fabs(axes[a][i * c->stride] - axes[a][last * c->stride]) * scale[a]);
        const bool side = breaks(c, i) || breaks(c, i - 1) || (i + 1 < c->count && breaks(c, i + 1));
        if (i + 1 < c->count && moved < 1 && !side) continue;
        /* a path that fills the picture has only every `skip`th point after the first PATH_MOST / 2 */
        if (kept > PATH_MOST / 2 && i % skip && i + 1 < c->count && !side) continue;
        put_point(out, c, i);
        last = i;
        kept++;
    }
}

static double lowest(const double *v, size_t count, size_t stride)
{
    double low = INFINITY;
    for (size_t i = 0; i < count; i++)
        if (drawable(v[i * stride])) low = fmin(low, v[i * stride]);
    return low;
}

/* Draws points; of many, only the first in each cell of the picture, which is smaller than a point. */
static void put_points(FILE *out, plot_curve *c)
{
    const double x = lowest(c->x, c->count, c->stride), y = lowest(c->y, c->count, c->stride);
    const double wide = extent(c->x, c->count, c->stride), high = extent(c->y, c->count, c->stride);
    unsigned char *taken = c->count > CELLS ? calloc((size_t)CELLS * CELLS, 1) : NULL; /* NULL: draw all */
    for (size_t i = 0; i < c->count; i++) {
        const double u = c->x[i * c->stride], v = c->y[i * c->stride];
        if (taken && drawable(u) && drawable(v)) {
            const size_t column = wide > 0 ? (size_t)((u - x) / wide * (CELLS - 1)) : 0;
            const size_t row = high > 0 ? (size_t)((v - y) / high * (CELLS - 1)) : 0;
            if (taken[row * CELLS + column]) continue;
            taken[row * CELLS + column] = 1;
        }
        put_point(out, c, i);
    }
    free(taken);
}

static void put_curve(FILE *out, plot_curve *c)
{
    if (c->role == PLOT_POINTS) {
        put_points(out, c);
        return;
    }
    if (c->count > 2 * COLUMNS && c->timelike)
        put_timelike(out, c);
    else if (c->count > 2 * COLUMNS)
        put_path(out, c);
    else
        for (size_t i = 0; i < c->count; i++) put_point(out, c, i);
}

/* Returns whether a curve has a band that is wider than its line. */
static bool has_band(const plot_curve *c)
{
    double widest = 0;
    for (size_t i = 0; i < c->band_count; i++) widest = fmax(widest, c->error[i]);
    return widest > BAND_LEAST * extent(c->y, c->count, c->stride);
}

/* Returns whether no digit of a part of the line is known. */
static bool has_rest(const plot_curve *c) { return c->role == PLOT_LINE && c->known < c->count; }

/* Returns the points from `begin` to `end` as a curve of their own. */
static plot_curve part_of(const plot_curve *c, size_t begin, size_t end)
{
    plot_curve part = *c;
    part.x += begin * c->stride;
    part.y += begin * c->stride;
    if (c->z) part.z += begin * c->stride;
    part.count = end - begin;
    return part;
}

/* Writes the part of a curve of which digits are known, and the rest, which begins where that part ends. */
static void put_parts(FILE *out, plot_curve *c, size_t panel, size_t index)
{
    fprintf(out, "$d%zu_%zu << END_OF_DATA\n", panel, index);
    plot_curve known = *c;
    if (has_rest(c)) known = part_of(c, 0, c->known);
    put_curve(out, &known);
    c->drawn = known.drawn;
    fputs("END_OF_DATA\n", out);
    if (!has_rest(c)) return;
    fprintf(out, "$u%zu_%zu << END_OF_DATA\n", panel, index);
    plot_curve rest = part_of(c, c->known > 0 ? c->known - 1 : 0, c->count);
    put_curve(out, &rest);
    fputs("END_OF_DATA\n", out);
}

static void put_band(FILE *out, const plot_curve *c)
{
    for (size_t i = 0; i < c->band_count; i++)
        fprintf(out, "%.12g %.10g %.10g\n", c->at[i], c->middle[i] - c->error[i], c->middle[i] + c->error[i]);
}

static void put_heat(FILE *out, const plot_panel *p)
{
    for (size_t r = 0; r < p->heat_rows; r++)
        for (size_t c = 0; c < p->heat_columns; c++) {
            double v = p->heat[r * p->heat_columns + c];
            if (drawable(v))
                fprintf(out, "%.6g%c", v, c + 1 == p->heat_columns ? '\n' : ' ');
            else
                fprintf(out, "NaN%c", c + 1 == p->heat_columns ? '\n' : ' ');
        }
}

static void put_data(FILE *out, plot_figure *f)
{
    for (size_t i = 0; i < f->count; i++) {
        const plot_panel *p = &f->panels[i];
        if (p->heat) {
            fprintf(out, "$heat%zu << END_OF_DATA\n", i);
            put_heat(out, p);
            fputs("END_OF_DATA\n", out);
        }
        for (size_t k = 0; k < p->curve_count; k++) {
            put_parts(out, &p->curves[k], i, k);
            if (!has_band(&p->curves[k])) continue;
            fprintf(out, "$b%zu_%zu << END_OF_DATA\n", i, k);
            put_band(out, &p->curves[k]);
            fputs("END_OF_DATA\n", out);
        }
    }
}

/* Returns whether both axes have one scale: not if the picture would be more than 4 times as long as wide. */
static bool one_scale(const plot_panel *p)
{
    if (!p->spatial) return false;
    double x = 0, y = 0;
    for (size_t k = 0; k < p->curve_count; k++) {
        const plot_curve *c = &p->curves[k];
        x = fmax(x, extent(c->x, c->count, c->stride));
        y = fmax(y, extent(c->y, c->count, c->stride));
    }
    return x > 0 && y > 0 && x / y < 4 && y / x < 4;
}

static void put_curve_style(FILE *out, const plot_panel *p, const plot_curve *c, size_t index, size_t lines)
{
    const style *s = &styles[index % STYLES];
    if (c->role == PLOT_EXACT) {
        fputs(" with lines lw 5 dt (18,7) lc rgb '#15803D'", out);
        return;
    }
    if (c->role == PLOT_POINTS) {
        fprintf(out, " with points pt 7 ps %s", c->drawn > 20000 ? "0.12" : c->drawn > 2000 ? "0.2" : "0.3");
        if (c->shade)
            fputs(" lc palette", out);
        else
            fprintf(out, " lc rgb '%s'", s->colour);
        return;
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

static void put_curves(FILE *out, const plot_panel *p, size_t panel)
{
    size_t lines = 0;
    for (size_t k = 0; k < p->curve_count; k++) lines += p->curves[k].role == PLOT_LINE;
    fputs(p->curve_count && p->curves[0].z ? "splot " : "plot ", out);
    /* the exact curves first, so that the others are drawn over them */
    bool first = true;
    for (int pass = 0; pass < 2; pass++) {
        size_t index = 0;
        for (size_t k = 0; k < p->curve_count; k++) {
            const plot_curve *c = &p->curves[k];
            size_t own = index;
            index += c->role == PLOT_LINE;
            if (pass == 0 && has_band(c)) {
                fprintf(out, "%s$b%zu_%zu using 1:2:3 with filledcurves fc rgb '%s' fs transparent solid 0.25 noborder",
                        first ? "" : ", ", panel, k, styles[own % STYLES].colour);
                fputs(" title ", out);
                quoted(out, "error");
                first = false;
            }
            if ((c->role == PLOT_EXACT) != (pass == 0)) continue;
            fprintf(out, "%s$d%zu_%zu using %s", first ? "" : ", ", panel, k, c->z || c->shade ? "1:2:3" : "1:2");
            put_curve_style(out, p, c, own, lines);
            fputs(" title ", out);
            quoted(out, c->label);
            if (c->z && c->role == PLOT_LINE && lines > 1)
                fprintf(out, ", $d%zu_%zu using 1:2:3 every %zu with points pt %d ps 0.9 lc rgb '%s' notitle", panel, k,
                        c->drawn / 5 + 1, styles[own % STYLES].marker, styles[own % STYLES].colour);
            first = false;
            if (!has_rest(c)) continue;
            fprintf(out, ", $u%zu_%zu using %s with lines lw 1.2 dt (2,4) lc rgb '%s' notitle", panel, k,
                    c->z ? "1:2:3" : "1:2", styles[own % STYLES].colour);
        }
    }
    putc('\n', out);
}

static void put_heat_map(FILE *out, const plot_panel *p, size_t panel)
{
    double most = 0;
    for (size_t i = 0; i < p->heat_rows * p->heat_columns; i++)
        if (drawable(p->heat[i])) most = fmax(most, fabs(p->heat[i]));
    if (!(most > 0)) most = 1;
    fprintf(out, "set cbrange [%.6g:%.6g]\n", -most, most);
    fputs("set palette defined (-1 '#1e3a8a', -0.5 '#60a5fa', 0 '#f8fafc', 0.5 '#fb923c', 1 '#7c2d12')\nunset key\n",
          out);
    fprintf(out,
            "set autoscale xfix\nset autoscale yfix\nplot $heat%zu matrix using (%.12g+$1*%.12g):(%.12g+$2*%.12g):3 "
            "with image\n",
            panel, p->x_first, p->x_step, p->y_first, p->y_step);
}

static void put_panel(FILE *out, const plot_panel *p, size_t index)
{
    bool solid = p->curve_count && p->curves[0].z;
    fputs("set title ", out);
    quoted(out, p->title);
    fputs("\nset xlabel ", out);
    quoted(out, p->x_label);
    fputs(" offset 0,0.4\nset ylabel ", out);
    quoted(out, p->y_label);
    fputs("\nset autoscale\n", out);
    if (p->heat && !isnan(p->unknown_from))
        for (int k = 1; k <= 2; k++) /* a dark line on a light one is seen on every colour */
            fprintf(out, "set arrow %d from first %.12g, graph 0 to first %.12g, graph 1 nohead front %s\n", k,
                    p->unknown_from, p->unknown_from,
                    k == 1 ? "lw 5 lc rgb '#f8fafc'" : "lw 2.5 dt (2,3) lc rgb '#0f172a'");
    fputs(solid ? "set border 31 lc rgb '#64748b'\n" : "set border 3 lc rgb '#64748b'\n", out);
    /* the key lies outside, so that it hides no curve; the axis names a single curve */
    bool beside = p->curve_count > 6;
    if (p->curve_count < 2)
        fputs("unset key\n", out);
    else
        fprintf(out, "set key outside %s nobox samplen 4 spacing 1.1 width 2\n",
                beside ? "right top vertical" : "bottom center horizontal");
    fputs(beside ? "unset rmargin\n" : "set rmargin 4\n", out);
    if (p->logarithmic) fputs("set logscale xy\nset format xy '%.0e'\n", out);
    if (solid) {
        fputs("set view 62, 32, 1, 1\nset xyplane 0\nset zlabel ", out);
        quoted(out, p->z_label);
        putc('\n', out);
    }
    if (p->shade_label[0]) {
        fputs("set palette defined (0 '#1e3a8a', 1 '#0e7490', 2 '#15803d', 3 '#c2410c', 4 '#be185d')\nset cblabel ",
              out);
        quoted(out, p->shade_label);
        fputs("\nset rmargin 9\n", out);
    }
    if (one_scale(p) && !solid) fputs("set size ratio -1\n", out);
    if (p->heat)
        put_heat_map(out, p, index);
    else
        put_curves(out, p, index);
    fputs("unset logscale\nset format\nset size noratio\nunset zlabel\nunset arrow\n", out);
}

typedef struct layout {
    size_t rows, columns;
    int width, height;
} layout;

static layout arrange(const plot_figure *f)
{
    bool square = false;
    size_t most_curves = 0;
    for (size_t i = 0; i < f->count; i++) {
        const plot_panel *p = &f->panels[i];
        square = square || p->spatial || p->heat || p->logarithmic;
        most_curves = p->curve_count > most_curves ? p->curve_count : most_curves;
    }
    size_t columns = square ? (f->count > 1 ? 2 : 1) : f->count > 4 ? 2 : 1;
    size_t rows = (f->count + columns - 1) / columns;
    int width = columns == 1 ? (square ? 820 : 960) : square ? 660 : 760;
    int height = f->count == 1 ? (square ? 680 : 480) : square ? 500 : 280;
    if (most_curves > 12) { /* room for the names beside the panel */
        width += 320;
        height = height < (int)most_curves * 20 + 120 ? (int)most_curves * 20 + 120 : height;
    }
    return (layout){rows, columns, width * (int)columns, height * (int)rows + 40};
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
    layout l = arrange(f);
    put_terminal(out, path, l);
    put_data(out, f);
    fputs("set tics nomirror\nset grid lt 1 lw 0.7 lc rgb '#e2e8f0'\nset datafile missing 'NaN'\n", out);
    fprintf(out, "set multiplot layout %zu,%zu title ", l.rows, l.columns);
    quoted(out, f->title);
    putc('\n', out);
    for (size_t i = 0; i < f->count; i++) put_panel(out, &f->panels[i], i);
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
