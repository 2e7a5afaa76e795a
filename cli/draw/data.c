/* The numbers of figures, as data blocks for gnuplot.
 *
 * Invariant: data are numbers. Thinning keeps the smallest and the largest value in every column of the picture.
 */
#include "cli/draw/plot.h"

#include <math.h>
#include <stdlib.h>

enum {
    COLUMNS = 2000,    /* columns of the picture, with two values each */
    PATH_GRID = 2500,  /* points of a path that are nearer than 1/2500 of the picture are drawn as one */
    PATH_MOST = 40000, /* points of a path, about */
    CELLS = 1600       /* cells along each side of the picture, if there are many points; a cell shows one point */
};

#define BAND_LEAST 4e-3 /* of the height of a panel's curves: a thinner band is hardly wider than a line */

bool data_drawable(double v) { return isfinite(v) && fabs(v) < 1e290; }

static void put_point(FILE *out, plot_curve *c, size_t i)
{
    c->drawn++;
    double x = c->x[i * c->stride], y = c->y[i * c->stride] - (c->change ? c->y[0] : 0),
           z = c->z ? c->z[i * c->stride] : 0;
    if (!data_drawable(x) || !data_drawable(y) || !data_drawable(z))
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

void data_range(const plot_curve *c, const double *v, double *low, double *high)
{
    const double from = c->change && v == c->y && c->count ? v[0] : 0;
    for (size_t i = 0; i < c->count; i++) {
        const double y = v[i * c->stride] - from;
        if (!data_drawable(y)) continue;
        *low = fmin(*low, y);
        *high = fmax(*high, y);
    }
}

/* Returns how far the numbers of a curve reach; *low is the smallest. */
static double extent(const plot_curve *c, const double *v, double *low)
{
    double high = -INFINITY;
    *low = INFINITY;
    data_range(c, v, low, &high);
    return high > *low ? high - *low : 0;
}

/* Draws the points of a path that are a visible distance from the last one drawn, and both sides of its jumps. */
static void put_path(FILE *out, plot_curve *c)
{
    const double *axes[] = {c->x, c->y, c->z};
    double scale[3] = {0};
    for (size_t a = 0; a < 3; a++)
        if (axes[a]) {
            double low, e = extent(c, axes[a], &low);
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

/* Draws points; of many, only the first in each cell of the picture, which is smaller than a point. */
static void put_points(FILE *out, plot_curve *c)
{
    double x, y;
    const double wide = extent(c, c->x, &x), high = extent(c, c->y, &y);
    unsigned char *taken = c->count > CELLS ? calloc((size_t)CELLS * CELLS, 1) : NULL; /* NULL: draw all */
    for (size_t i = 0; i < c->count; i++) {
        const double u = c->x[i * c->stride], v = c->y[i * c->stride];
        if (taken && data_drawable(u) && data_drawable(v)) {
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
    if (c->role == PLOT_POINTS || c->role == PLOT_STEPS || c->role == PLOT_MARKS) {
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

static size_t band_place(const plot_curve *c, size_t i) { return c->band_stride ? i * c->band_stride : i; }

bool data_band(const plot_panel *p, const plot_curve *c)
{
    double widest = 0, low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < c->band_count; i++) widest = fmax(widest, c->error[band_place(c, i)]);
    for (size_t k = 0; k < p->curve_count && widest > 0; k++) data_range(&p->curves[k], p->curves[k].y, &low, &high);
    return widest > 0 && widest > BAND_LEAST * (high - low);
}

bool data_rest(const plot_curve *c) { return c->role == PLOT_LINE && c->known < c->count; }

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
    if (data_rest(c)) known = part_of(c, 0, c->known);
    put_curve(out, &known);
    c->drawn = known.drawn;
    fputs("END_OF_DATA\n", out);
    if (!data_rest(c)) return;
    fprintf(out, "$u%zu_%zu << END_OF_DATA\n", panel, index);
    plot_curve rest = part_of(c, c->known > 0 ? c->known - 1 : 0, c->count);
    put_curve(out, &rest);
    fputs("END_OF_DATA\n", out);
}

static void put_band(FILE *out, const plot_curve *c)
{
    for (size_t i = 0; i < c->band_count; i++) {
        const size_t k = band_place(c, i);
        fprintf(out, "%.12g %.10g %.10g\n", c->at[k], c->middle[k] - c->error[k], c->middle[k] + c->error[k]);
    }
}

static void put_heat(FILE *out, const plot_panel *p)
{
    for (size_t r = 0; r < p->heat_rows; r++)
        for (size_t c = 0; c < p->heat_columns; c++) {
            double v = p->heat[r * p->heat_columns + c];
            if (data_drawable(v))
                fprintf(out, "%.6g%c", v, c + 1 == p->heat_columns ? '\n' : ' ');
            else
                fprintf(out, "NaN%c", c + 1 == p->heat_columns ? '\n' : ' ');
        }
}

void data_write(FILE *out, plot_figure *f)
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
            if (!data_band(p, &p->curves[k])) continue;
            fprintf(out, "$b%zu_%zu << END_OF_DATA\n", i, k);
            put_band(out, &p->curves[k]);
            fputs("END_OF_DATA\n", out);
        }
    }
}
