/* What the experiments share: the motion under study, progress, runs along a grid of times. Studies use the public
 * calls of motus.h alone.
 *
 * A state here is one row of numbers, y = (x, v): the positions, then the velocities and first-order variables.
 * Invariant: all memory comes from the system's hooks, and every run ends in CANCELLED soon after the user's progress
 * hook asks for that.
 */
#ifndef STUDY_STUDY_H
#define STUDY_STUDY_H

#include "api/system/check.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/modes.h"

#include <stdbool.h>
#include <stdint.h>
#define STUDY_SAMPLES 100 /* the usual number of times at which trajectories are compared; fewer for long states */
#define STUDY_NUMBERS_MAX ((size_t)1 << 22) /* in one table of samples: 32 MiB */
#define STUDY_SIMPLEST "explicit-euler"     /* admits every force and solves nothing: for trial runs and probes */

typedef struct study {
    motus_system *system;
    const motus_allocator *allocator;
    motus_error *err;
    size_t nx, nv, numbers; /* numbers = nx + nv */
    double from, until;
    int64_t total;    /* steps of the trial run up to `until` */
    double last_step; /* the size of the trial run's shorter last step; 0: none */
    double *start;    /* the state at `from` */
    size_t *group;    /* of each number; a variable's positions are one group, its velocities another */
    double *scale;    /* of each number: how far its group moves; set by study_scale */
    size_t groups;
    double noise;     /* the rounding of a group's largest value over its scale, the largest of all groups */
    double magnitude; /* the largest value */
    double *work;     /* room for study_scale: 2 numbers + 2 groups */
    int (*progress)(void *context, double fraction);
    void *context;
    double base, span;      /* beginning and length of the present part, as fractions of the study */
    double reached, called; /* the fraction, and the clock, when progress was last called */
    bool locate;            /* runs end their steps where the force changes its formula */
    double tolerance;       /* of the runs of adaptive methods, relative */
    const char *machine;    /* of all runs */
    bool locatable;         /* the last run could end its steps where the force changes its formula */
    double limit;           /* evaluations after which a walk gives up; 0: no limit */
    motus_run *walking;     /* the run of the present walk; NULL: none */
    bool cancelled;
    bool out_of_memory; /* memory ran out in a call that can only answer "unknown" */
} study;

/* Times at which trajectories are compared: from + k interval, k = 1 … intervals, and `until` besides. */
typedef struct study_grid {
    double from, until, interval; /* interval > 0; until - from tells the direction */
    size_t intervals, points;     /* points = intervals, or intervals + 1 */
} study_grid;

/* The lowest derivative of the force that jumps along a run, and where it first does: see motus_run_statistics. */
typedef struct study_jump {
    int64_t order; /* -1: none jumps */
    double time, rounding, power;
} study_jump;
#define STUDY_NO_JUMP ((study_jump){.order = -1, .time = NAN, .power = NAN})

/* The cost of a walk along a grid. */
typedef struct study_cost {
    int64_t steps, evaluations;
    double seconds;
    bool over; /* the walk gave up at study.limit */
    study_jump jump;
} study_cost;

/* Reads and checks the definition, into the layout of this version. */
motus_status study_read(const motus_study_def *given, motus_study_def *def, motus_error *err);
/* Finds the start and the groups. step: of the trial run, if above 0. Call study_close in any case. */
motus_status study_open(study *, motus_system *, const motus_study_def *, const motus_settings *, double step,
                        motus_error *err);
void study_close(study *);
/* Settles step, start and end, as a run by STUDY_SIMPLEST has them. NaN: a callback has none. */
motus_status study_settings(motus_system *, const motus_study_def *, motus_settings *, motus_error *);

bool study_admits(study *, const char *method);
/* Lists the methods to study: those named, or every admitted one but the exact motion; adaptive: with those that adapt
 * their steps. */
motus_status study_methods(study *, const motus_study_def *, bool adaptive, const char ***names, size_t *count);
bool study_adapts(const char *method);

/* Begins a part, which takes progress from `base` to `base` + `span`. */
void study_part(study *, double base, double span);
/* Notes that memory ran out in a call that itself returns no status. */
void study_note(study *, motus_status);
/* Returns the status of all calls so far: OK unless memory ran out or the user cancelled. */
motus_status study_broken(const study *);
/* Returns whether a status ends the study and not only the row: memory and cancellation. */
bool study_fatal(motus_status);

/* Copies the error of a call to that of the study, unless the user cancelled. Returns the status for the study. */
motus_status study_tell(study *, motus_status, const motus_error *);
/* Releases the one block of a result. */
void study_drop(void *result, motus_allocator);
/* Rounds up, so that another array may begin after these bytes of a result. */
static inline size_t study_aligned(size_t bytes) { return (bytes + 15) & ~(size_t)15; }

/* Makes a run that reports progress through the study. y NULL: from the model's start. Adaptive methods take
 * study.tolerance in place of the step. */
motus_status study_run(study *, const char *method, double step, double start, double until, const double *y,
                       motus_run **, motus_error *err);
/* Returns the grid of a run of `total` steps, the last of which is shorter if last_step > 0; *per: steps in an
 * interval, a power of 2, so that the times of coarser and finer runs are equal to the bit. */
study_grid study_grid_of(const study *, double step, int64_t total, double last_step, int64_t *per);
/* Reads the run's state as one row. */
motus_status study_state(study *, motus_run *, double *y, motus_error *err);
/* Runs a method along a grid with `per` steps in each interval, from a state (NULL: the model's start). out: points ×
 * numbers, NaN from a failure on. A failure ends the study only if study_fatal says so. */
motus_status study_walk(study *, const char *method, const study_grid *, int64_t per, const double *from, double *out,
                        study_cost *, motus_error *err);
/* Takes y from one time to another, and adds the evaluations to *spent. MOTUS_SOLVE: they exceed study.limit. */
motus_status study_leg(study *, const char *method, double step, double from, double until, double *y, int64_t *spent,
                       motus_error *err);
/* Estimates the cost of steps and evaluations, in numbers of one evaluation; equal on every machine. evaluations < 0:
 * not known yet. */
double study_work(const study *, const motus_method *, double steps, double evaluations);
double study_evaluations(const motus_method *, double steps); /* as far as known beforehand */
double study_seconds(void);                                   /* a monotonic clock */
double study_processor_seconds(void);                         /* of this thread, so that other programs do not count */

/* Sets scale to how far each number's group moves over the start and the rows; for a group at rest, to its largest
 * value, or 1. Sets noise and magnitude. */
void study_scale(study *, const double *rows, size_t count);
/* The largest |p - q| of two states, among positions, velocities, and all in units of scale; NaN if any is. */
typedef struct study_distance {
    double x, v, scaled;
} study_distance;
study_distance study_measure(const study *, const double *p, const double *q);
/* The largest |p - q| among positions, velocities and first-order variables; NaN if there are none, or any is. */
typedef struct study_errors {
    double x, v, s;
} study_errors;
study_errors study_errors_of(const study *, const double *p, const double *q);
/* Returns the larger; NaN if either is, so that an unknown error never counts as small. */
double study_larger(double, double);

#endif
