/* What the experiments share. They are written with the public calls alone: whoever can read motus.h can read these
 * files.
 *
 * A state here is one row of numbers, y = (x, v): the positions, then the velocities and companions. Invariant:
 * whatever a study takes it takes through the system's hooks, and every walk ends in CANCELLED soon after the user's
 * progress hook asked for that.
 */
#ifndef STUDY_STUDY_H
#define STUDY_STUDY_H

#include "api/check.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/modes.h"

#include <stdbool.h>
#include <stdint.h>
/* Truth and trajectories are looked at about this often; fewer when the states are long. */
#define STUDY_SAMPLES 100
#define STUDY_NUMBERS_MAX ((size_t)1 << 22) /* in one table of samples: 32 MiB */
/* Admits every force and needs no solve: asked where runs start, and what the acceleration is. */
#define STUDY_PLAINEST "explicit-euler"

typedef struct study {
    motus_system *system;
    const motus_allocator *allocator;
    motus_error *err;
    size_t nx, nv, numbers; /* numbers = nx + nv */
    double from, until;
    int64_t total; /* steps of the trial run up to `until`, and the size of its shortened last one */
    double last_step;
    double *start; /* the state at `from` */
    /* to which group a number belongs; positions and velocities of a variable are two */
    size_t *group;
    double *scale; /* by how much each number moves; set by study_scale */
    size_t groups;
    /* the rounding of the largest value of a group, in units of its scale: largest of all */
    double noise;
    double magnitude; /* the largest value */
    double *work;     /* 2 numbers + 2 groups: working space of study_scale */
    int (*progress)(void *context, double fraction);
    void *context;
    double base, span;    /* the part of the whole that the present walk is */
    double reached, told; /* the fraction and the moment of the last call */
    bool cancelled;
    bool starved; /* memory ran out where an answer could only be "unknown" */
} study;

/* Times at which trajectories are compared: from + k interval, k = 1 … intervals, and `until` if that is not among
 * them. */
typedef struct study_grid {
    double from, until, interval; /* interval > 0; the direction is that of until - from */
    size_t intervals, points;     /* points = intervals, or intervals + 1 */
} study_grid;

/* What a walk along a grid cost. */
typedef struct study_cost {
    int64_t steps, evaluations;
    double seconds;
} study_cost;

/* The definition as this library knows it, checked. */
motus_status study_read(const motus_study_def *given, motus_study_def *def, motus_error *err);
/* Finds the start, the end and the groups; `step` is only a hint for the trial run. study_close in any case. */
motus_status study_open(study *, motus_system *, const motus_study_def *, double step, motus_error *err);
void study_close(study *);

bool study_admits(study *, const char *method);
/* The methods to be studied: those named, or every admitted one but the exact motion itself. */
motus_status study_methods(study *, const motus_study_def *, const char ***names, size_t *count);

/* The next walk is this part of the whole. */
void study_part(study *, double base, double span);
/* Notes a failure that a probe or a survey met, and hands it on as the study's: OK unless memory ran out or the user
 * cancelled. */
void study_note(study *, motus_status);
motus_status study_broken(const study *);
/* True for what ends the study and not only the row: memory and cancellation. */
bool study_fatal(motus_status);

/* A run of the study: progress goes through its hook. x and v may be NULL: the model's start. */
motus_status study_run(study *, const char *method, double step, double start, double until, const double *y,
                       motus_run **, motus_error *err);
/* The grid of a run of `total` steps, of which the last is shorter if last_step > 0; *per: steps in an interval, a
 * power of 2, so that the times of coarser and finer runs are the same numbers. */
study_grid study_grid_of(const study *, double step, int64_t total, double last_step, int64_t *per);
/* The state now as one row. */
motus_status study_look(study *, motus_run *, double *y, motus_error *err);
/* `per` steps in each interval; out: points × numbers, NaN from a failure on. A failure is the walk's, not the study's,
 * unless study_fatal. */
motus_status study_walk(study *, const char *method, const study_grid *, int64_t per, double *out, study_cost *,
                        motus_error *err);
/* What so many steps and evaluations cost, in numbers of a state updated by one evaluation; a rough measure, but the
 * same on every machine. evaluations < 0: a guess before the run. */
double study_work(const study *, const motus_method *, double steps, double evaluations);
double study_seconds(void); /* a steady clock */

/* scale: for each number how far its group moved over the rows (the first is the start); what never moves has the
 * size of its values, or 1. */
void study_scale(study *, const double *rows, size_t count);
/* The largest |p - q| of two states among positions, among velocities, and of all in units of scale. NaN wins. */
typedef struct study_distance {
    double x, v, scaled;
} study_distance;
study_distance study_measure(const study *, const double *p, const double *q);
/* The larger; a NaN in either wins, so that what is unknown never looks small. */
double study_larger(double, double);

#endif
