/* The figure of one run: its motion, its quantities, the change of its invariants, or a plane of two columns. */
#ifndef CLI_RUN_FIGURE_H
#define CLI_RUN_FIGURE_H

#include "cli/draw/plot.h"
#include "cli/files/file.h"
#include "cli/model/load.h"
#include "cli/run/walk.h"

enum { FIGURE_OBSERVERS = 4, FIGURE_PANELS = 10 };

/* Columns of a run in memory, one array each, at a bounded number of steps. */
typedef struct record {
    size_t *columns;
    double **values; /* values[k][row] of columns[k] */
    size_t count;
    size_t rows, room; /* a record with room for one row keeps the last */
    int64_t stride;
    double period;   /* where steps adapt: of time, in place of a stride of steps */
    double **errors; /* errors[k][row] of columns[k]; NULL: they are not recorded */
    bool with_errors;
    int jumps; /* for how many there is room; 0: they are not recorded */
} record;

/* For at most `samples` samples of a run of `steps` steps over the time `way`; 0: steps adapt. 1: at the end only. */
record record_for(int64_t steps, double way, int64_t samples);
/* The same with both sides of jumps, and a row of NaN between them; without errors. Call before record_add(). */
record record_with_jumps(record);
/* Adds a column and returns its array, which is never moved. NULL: out of memory. */
double *record_add(record *, size_t column);
walk_observer record_observer(record *);
void record_free(record *);

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

/* section.c: the points of --section in a plane. */
/* Chooses the plane before the run: that of --plot-of; else, of a model of one number its motion, of two numbers that
 * of the one that the section does not name, each against its velocity. */
motus_status section_plane(const load *, const options *, size_t columns[2], motus_error *);
/* Draws the points of a run at its end. Fails where there are none. */
motus_status section_draw(const load *, const options *, motus_run *, const size_t columns[2], file_out *,
                          motus_error *);

#endif
