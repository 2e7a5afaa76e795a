/* The figure of one run: its motion, its quantities, the change of its invariants, or a plane of two columns. */
#ifndef CLI_RUN_FIGURE_H
#define CLI_RUN_FIGURE_H

#include "cli/model/load.h"
#include "cli/draw/plot.h"
#include "cli/run/record.h"

enum { FIGURE_OBSERVERS = 4, FIGURE_PANELS = 10 };

typedef struct figure_heat {
    size_t panel, first;  /* first: of its columns in the record */
    size_t rows, columns; /* columns 0: one per sample */
    bool field;           /* from `last`; else from `coarse` */
    double cell_first, cell_step;
} figure_heat;

typedef struct figure {
    const load *model;
    plot_figure plot;
    record fine, coarse, last; /* curves; heat maps over time; fields at the end */
    record bars;               /* curves with their errors; empty where the run tells none */
    double *t, *coarse_t, *bars_t;
    figure_heat heats[FIGURE_PANELS];
    size_t heat_count;
    bool left_out; /* some cells or panels are not drawn */
} figure;

/* Chooses before the run what will be drawn. errors: the run tells them. */
motus_status figure_begin(figure *, const load *, const options *, motus_run *, double until, bool errors,
                          motus_error *);
/* One column, of one number, by its name in --plot-of. */
motus_status figure_column(const load *, const char *name, size_t *column, motus_error *);
/* The two columns of --plot-of. */
motus_status figure_plane(const load *, const char *text, size_t columns[2], motus_error *);
/* The observers that record it along the run. */
void figure_observers(figure *, walk_observer out[FIGURE_OBSERVERS]);
/* known_until: no digit of its numbers is known later; NaN: of all of them some are. */
motus_status figure_draw(figure *, double known_until, const char *path, file_out *, motus_error *);
void figure_free(figure *);

/* The columns of a variable: component c of cell i is first + i cell_step + c component_step. */
typedef struct figure_place {
    size_t first, cells, components, cell_step, component_step;
} figure_place;
/* prefix: "" or "exact "; suffix: "" or "'". False: there are no such columns. */
bool figure_find(const load *, const motus_variable *, const char *prefix, const char *suffix, figure_place *);

#endif
