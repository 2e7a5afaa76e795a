/* The figure of one run: its motion, its quantities, the drift of its invariants, or a plane of two columns. */
#ifndef CLI_FIGURE_H
#define CLI_FIGURE_H

#include "cli/load.h"
#include "cli/plot.h"
#include "cli/record.h"

enum { FIGURE_WATCHERS = 3, FIGURE_PANELS = 10 };

typedef struct figure_heat {
    size_t panel, first;  /* first: of its columns in the record */
    size_t rows, columns; /* columns 0: one per look */
    bool field;           /* from `last`; else from `coarse` */
    double cell_first, cell_step;
} figure_heat;

typedef struct figure {
    const load *model;
    plot_figure plot;
    record fine, coarse, last; /* curves; heat maps over time; fields at the end */
    double *t, *coarse_t;
    figure_heat heats[FIGURE_PANELS];
    size_t heat_count;
    bool left_out; /* not everything found room */
} figure;

/* Chooses what is drawn of a run, before it starts. */
motus_status figure_begin(figure *, const load *, const options *, motus_run *, motus_error *);
/* Who has to look along the run. */
void figure_watchers(figure *, walk_watcher out[FIGURE_WATCHERS]);
motus_status figure_draw(figure *, const char *path, file_out *, motus_error *);
void figure_free(figure *);

/* Columns of a variable: where component c of cell i lies. */
typedef struct figure_place {
    size_t first, cells, components, cell_step, component_step;
} figure_place;
/* prefix: "" or "exact "; suffix: "" or "'". False where there are no such columns. */
bool figure_find(const load *, const motus_variable *, const char *prefix, const char *suffix, figure_place *);

#endif
