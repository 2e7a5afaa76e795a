/* The figure of one run: its state with the steps of the method and its events, the change of its invariants, or the
 * columns of --plot-of. */
#ifndef CLI_RUN_FIGURE_H
#define CLI_RUN_FIGURE_H

#include "cli/draw/plot.h"
#include "cli/files/file.h"
#include "cli/model/load.h"
#include "cli/run/walk.h"

enum { FIGURE_OBSERVERS = 6, FIGURE_PANELS = 10 };

/* Columns of a run in memory, one array each, at a bounded number of steps. */
typedef struct record {
    size_t *columns;
    double **values; /* values[k][row] of columns[k] */
    size_t count;
    size_t rows, room; /* a record with room for one row keeps the last row */
    int64_t stride;    /* of steps */
    double period;     /* of time, for adaptive steps, which have no stride */
    double **errors;   /* errors[k][row] of columns[k]; NULL: they are not recorded */
    bool with_errors;
    int64_t every, seen; /* every: of adaptive steps, one is recorded of so many; 0: the stride says it */
    int jumps;           /* how many more jumps have room; 0: they are not recorded */
} record;

/* Prepares at most `samples` samples of a run of `steps` steps over the time `way`. steps 0: they are adaptive. samples
 * 1: only the end is recorded. */
record record_for(int64_t steps, double way, int64_t samples);
/* Prepares `within` samples in each step of a run with steps of one size. */
record record_between(double step, double way, int64_t within);
/* Prepares at most `samples` samples at steps, also of adaptive ones, whose number is not known before: a record that
 * is full goes on with every other step. It has no errors. */
record record_at_steps(int64_t steps, double way, int64_t samples);
/* Adds room for both sides of jumps, and a row of NaN between them, to a record without errors. Call it before
 * record_add(). */
record record_with_jumps(record);
/* Adds a column. Returns its array, which never moves. NULL: out of memory. */
double *record_add(record *, size_t column);
walk_observer record_observer(record *);
void record_free(record *);

typedef struct figure_heat {
    size_t panel, first;  /* first: the first of its columns in the record */
    size_t rows, columns; /* columns 0: one for each sample */
    bool field;           /* its record is `last`, else `coarse` */
    double cell_first, cell_step;
} figure_heat;

typedef struct figure {
    const load *model;
    plot_figure plot;
    record fine, coarse, last; /* for curves; for heat maps against time; for fields at the end */
    record bars;               /* for bands of errors; empty if the run has no errors */
    record steps;              /* for the dots at steps, and the changes of invariants */
    record smooth;             /* for the exact motion, if the curves of the method are straight lines; else empty */
    double *t, *coarse_t, *bars_t, *steps_t;
    size_t shared;  /* the panel of the numbers of the state; SIZE_MAX: there is none */
    bool dotted;    /* the steps are drawn, if there are not many */
    double **rooms; /* of marks */
    size_t room_count;
    figure_heat heats[FIGURE_PANELS];
    size_t heat_count;
    bool left_out; /* some cells or panels are not drawn */
} figure;

/* Chooses before the run what will be drawn. `errors` says whether the run has errors. */
motus_status figure_begin(figure *, const load *, const options *, motus_run *, double until, bool errors,
                          motus_error *);
/* Finds a column of one number by its name in --plot-of. */
motus_status figure_column(const load *, const char *name, size_t *column, motus_error *);
/* Finds the two columns of --plot-of. */
motus_status figure_plane(const load *, const char *text, size_t columns[2], motus_error *);
/* Writes the name of a column with its unit. */
void figure_label(const load *, size_t column, char out[PLOT_LABEL]);
/* Returns whether two columns have one unit, so that axes of both have one scale: by the comments of the model, or
 * where it tells no unit, because both are positions or both are velocities. */
bool figure_agree(const load *, size_t, size_t);
/* Returns whether curves between the steps of a method are nearer to its motion than straight lines: not of first
 * order. */
bool figure_smooth(const char *method);
/* Makes the observers that record the run. */
void figure_observers(figure *, walk_observer out[FIGURE_OBSERVERS]);
/* Draws the figure of a finished run. No digit is known after the time `known_until`; NaN: digits are known at all
 * times. */
motus_status figure_draw(figure *, motus_run *, double known_until, const char *path, file_out *, motus_error *);
void figure_free(figure *);

/* The columns of a variable: component c of cell i is first + i cell_step + c component_step. */
typedef struct figure_place {
    size_t first, cells, components, cell_step, component_step;
} figure_place;
/* Finds the columns of a variable. The prefix is "" or "exact ", the suffix "" or "'". Returns false if there are no
 * such columns. */
bool figure_find(const load *, const motus_variable *, const char *prefix, const char *suffix, figure_place *);

/* split.c: divides the panel that several numbers share by their units and sizes, when its curves have their points.
 * Returns false if memory runs out. */
bool split_panels(figure *);

/* marks.c: adds the events of a finished run to the figure, whose curves have their points. */
motus_status marks_add(figure *, motus_run *, motus_error *);

/* section.c: the points of --section in a plane. */

/* Chooses the plane before the run: that of --plot-of, or a number that the section does not name against its velocity;
 * without velocities, two such numbers; where the section fixes one of two numbers, the other against the time. */
motus_status section_plane(const load *, const options *, size_t columns[2], motus_error *);
/* Draws the points of a finished run. Fails if there are none. */
motus_status section_draw(const load *, const options *, motus_run *, const size_t columns[2], file_out *,
                          motus_error *);

#endif
