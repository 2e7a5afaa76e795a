/* Figures: panels of curves or heat maps, drawn by gnuplot. */
#ifndef CLI_DRAW_PLOT_H
#define CLI_DRAW_PLOT_H

#include "cli/files/file.h"

#include <stddef.h>

enum { PLOT_LABEL = MOTUS_NAME_MAX + 128, PLOT_PANELS = 12 };

typedef enum plot_role {
    PLOT_LINE,   /* one of several: its own colour, dashes and marker */
    PLOT_POINTS, /* points without a line between them */
    PLOT_EXACT,  /* the exact motion: green, thick, behind the others */
    PLOT_STEPS,  /* dots on the line before it: the steps of a method */
    PLOT_MARKS   /* marks over the lines, such as events; curves of one label stand once in the key */
} plot_role;

/* A curve through the points (x[i * stride], y[i * stride]); the caller owns the numbers. */
typedef struct plot_curve {
    char label[PLOT_LABEL];
    plot_role role;
    const double *x, *y, *z; /* z: NULL in the plane */
    const double *shade;     /* NULL, or a number for each point, which gives its colour */
    size_t count, stride;
    bool change;   /* draw y minus its first value */
    bool timelike; /* x grows along the curve, so that thinning can go by columns of the picture */
    size_t known;  /* the points of a line of which a digit is known; the rest of the line is thin and dotted */
    size_t kind;   /* of marks: curves of one kind have one mark */
    size_t drawn;  /* the points left after thinning; set by plot_draw() */
    /* NULL, or a band from middle - error to middle + error at the times `at`, for a curve against t */
    const double *at, *middle, *error;
    size_t band_count, band_stride; /* band_stride 0: 1 */
} plot_curve;

typedef struct plot_panel {
    char title[PLOT_LABEL], x_label[PLOT_LABEL], y_label[PLOT_LABEL], z_label[PLOT_LABEL], shade_label[PLOT_LABEL];
    double unknown_from; /* a line in a heat map against time: no digit is known after it; NaN: no line */
    bool equal;          /* both axes have one unit, and one scale if the shape allows it */
    bool path;           /* lines do not go along the time: each has a mark at its start, and an arrow */
    bool logarithmic;    /* both axes are logarithmic; every point is marked */
    bool log_x, log_y;   /* the horizontal axis is logarithmic; the vertical one */
    double top;          /* numbers above it are not shown; 0: all are */
    bool low;            /* one that is looked at last: it is a third as high as others */
    plot_curve *curves;
    size_t curve_count;
    /* A heat map in place of curves: heat[row * heat_columns + column], from the lowest row on; the panel owns it. */
    double *heat;
    size_t heat_rows, heat_columns;
    double x_first, x_step, y_first, y_step;
} plot_panel;

typedef struct plot_figure {
    char title[PLOT_LABEL];
    plot_panel *panels;
    size_t count;
    bool one_key; /* all panels have the curves of the first, whose key is that of all */
} plot_figure;

/* Return NULL if memory runs out. A new panel makes earlier pointers to panels invalid, a new curve those to curves. */
plot_panel *plot_panel_add(plot_figure *, const char *title, const char *x_label, const char *y_label);
plot_curve *plot_curve_add(plot_panel *, const char *label, const double *x, const double *y, size_t count,
                           size_t stride);
void plot_free(plot_figure *);

/* Checks that the name ends in a known format and that gnuplot is installed. Call it before long work. */
motus_status plot_check(const char *path, motus_error *);
/* Draws into the file, in the format that `path` ends in. The caller finishes the file. */
motus_status plot_draw(plot_figure *, const char *path, file_out *, motus_error *);

/* data.c: the numbers. */

/* Returns whether gnuplot can scale a number without overflow; other numbers are gaps in a curve. */
bool data_drawable(double);
/* Widens [low, high] by the numbers v of a curve. */
void data_range(const plot_curve *, const double *v, double *low, double *high);
/* Returns whether there are no points of a curve that is drawn upon others. */
static inline bool data_none(const plot_curve *c) { return c->count == 0 && c->role >= PLOT_STEPS; }
/* Returns whether a curve of a panel has a band that is wider than its line. */
bool data_band(const plot_panel *, const plot_curve *);
/* Returns whether no digit of a part of the line is known. */
bool data_rest(const plot_curve *);
/* Writes the data blocks: $dP_C of curve C in panel P, $uP_C of its part without known digits, $bP_C of its band,
 * $heatP. */
void data_write(FILE *, plot_figure *);

/* layout.c: where the panels lie, in pixels from the upper left corner. */

/* The part of a panel inside its axes, and where its key begins; key 0: the panel has no key. */
typedef struct layout_box {
    double left, top, width, height, key;
} layout_box;
typedef struct layout {
    int width, height; /* of the picture */
    layout_box boxes[PLOT_PANELS];
} layout;
layout layout_make(const plot_figure *);
/* Writes the label of a curve in the key, cut to the room that a key has. */
void layout_label(const char *label, char out[PLOT_LABEL]);

/* gnuplot as a child process: it reads a script, and motus writes its picture to a file. */
typedef struct gnuplot {
    FILE *script;     /* gnuplot's standard input */
    FILE *complaints; /* gnuplot's standard error */
} gnuplot;

/* Fails if gnuplot is not installed. */
motus_status gnuplot_check(motus_error *);
motus_status gnuplot_open(gnuplot *, motus_error *);
/* Runs the script; the picture goes to the file. The error has gnuplot's first message. */
motus_status gnuplot_draw(gnuplot *, file_out *picture, motus_error *);
void gnuplot_close(gnuplot *);

#endif
