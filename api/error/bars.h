/* Bars of error: how far the numbers of a run may be from the exact motion, told from its companions.
 *
 * Invariant: the run never learns of its bars; its bits and its counters are those of a run without bars.
 */
#ifndef API_ERROR_BARS_H
#define API_ERROR_BARS_H

#include "api/error/companion.h"
#include "machine/differences.h"

struct bars {
    motus_bars kind;
    bool kept;             /* companions, like the run, use a compiled object only if it is already there */
    bool given_x, given_v; /* the caller gave the run's start in place of the model's */
    bool started;
    witness *witness;     /* NULL: the witness cannot look at such a run */
    companion half, twin; /* half: with about half the step; twin: as the run, from a state that is an ulp away */
    size_t count;         /* how many numbers are compared, and their columns */
    size_t *columns;
    uint8_t *whole; /* whether each number only counts (lang/model/whole.h); NULL: there are no rules */
    size_t endless; /* 1 + the rule whose events accumulated when `whole` was judged; 0: none */
    double *memory; /* for `differences` */
    double *room;   /* bars_moved_room; bars_later uses it for a state and its acceleration */
    differences differences;
    /* Of a run with events: how far the rounding of places moved each acceleration at the last landing, and room for
     * `spread` of bars.c; else NULL. */
    double *steep;
    double landed;  /* the time of the last landing */
    int64_t steps;  /* whole steps of the run before the last landing */
    double seconds; /* spent on bars */
    /* The numbers of a restart state for the bars, until these begin; else NULL. */
    double *resumed;
    size_t resumed_count;
    /* The companion of a restored run landed beyond the run, after a shorter last step that the state does not have. */
    bool ahead;
    /* Run and companion have had different events, as when one of them has had an event just before the other; their
     * states are then not compared. */
    bool gap;
    double gap_since;
    bool end_reached;   /* the companion was led to where events ended the run */
    double *open_since; /* for each rule: the time from which the number of its events is uncertain; NULL: for none */
    size_t rows;        /* how many rows of the table of events a companion confirms */
    bool rows_differ;   /* after these rows the companion has other events */
    char why[256];      /* why there are no bars; "": there are bars */
};

/* Gives a run its bars, of all columns, as its company, where the definition asks for bars. */
motus_status bars_prepare(motus_run *, const motus_run_def *, motus_error *);
/* Gives a run bars of these columns, the time and the state first. how: as in machine/differences.h. */
motus_status bars_make(motus_run *, motus_bars, const size_t *columns, const int *how, size_t count, motus_error *);
differences_shape bars_shape(const motus_system *, const motus_method *card, motus_bars, const int *how, size_t count);
/* Makes the system of the companion before it is needed. affected: as in api/system/system.h. */
motus_status bars_ready(motus_run *, const uint8_t *affected, motus_error *);
/* Begins another motion of the run: from the state of the system, or from one that the caller gave. */
void bars_again(motus_run *, bool given);
/* Forgets the events of the companions. */
void bars_forget_events(motus_run *);
/* Lands where the run stands. */
motus_status bars_land(motus_run *, motus_error *);
/* Lands where the run stands, for an observation, which the reduced numbers take in. */
motus_status bars_observe(motus_run *, motus_error *);
/* Lands at a time within the last step. x, v: the run's state there, in the inside order. */
motus_status bars_land_between(motus_run *, double t, double *x, double *v, motus_error *);
/* Returns the bar of a number at t, if the companion has landed there. NaN: it has not. */
double bars_of(const bars *, double t, size_t number);
/* Computes the error of a number at a state of the run (errors.c): the sum of its bar and *error, the bound of
 * system_rounding, raised to what events leave unknown. */
motus_status errors_of(motus_run *, double t, double *x, double *v, size_t number, double *error, motus_error *);
/* Raises the errors of columns that jump or are sharp, as system_leaps does. Call it after errors_of. */
motus_status errors_leaps(motus_run *, double t, double *x, double *v, bool sharp, const size_t *columns, size_t count,
                          double *errors, motus_error *);
/* Computes the errors of columns, and their values unless NULL. A run without bars has values, too. */
motus_status errors_tell(motus_run *, double t, double *x, double *v, const size_t *columns, size_t count,
                         double *values, double *errors, motus_error *);
/* Returns the largest bar, as differences_worst does. NaN: there are no bars. */
double bars_worst(const bars *, bool absolute, bool unknown);
/* Returns the factor from the distance between run and companion to the bar. */
double bars_part(const motus_run *);
/* The error of velocities, in parts of 2^-52, that run and companion share after each event that changed the state; it
 * acts for all the time since. A row adds the same numbers in the same order step after step, so the parts have one
 * sign: dopri5 leaves 2^-52 of the velocity of each flight of a ball. */
#define BARS_LASTING 1.5
/* Return by how much the state at t may be late or early in run and companion alike: by the error that the times of
 * events share, and (bars_late) by the rounding of the run's end. */
double bars_events_late(const motus_run *, double t);
double bars_late(const motus_run *, double t);
/* Ends the bars, with the reason. The first reason stays. */
void bars_give_up(motus_run *, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Collects the numbers of a restart state for the bars (bars_kept.c): `count` numbers to give back; 0: there are no
 * bars. t: where the run stands, or before its shorter last step to the end. */
motus_status bars_keep(motus_run *, double t, double **numbers, size_t *count, motus_error *);
/* Takes the numbers of a restart state, from which the companion goes on. False: they are not of these bars. */
bool bars_resume(motus_run *, double *numbers, size_t count);
motus_status bars_kept_begin(motus_run *, const double *x, const double *v, motus_error *);
/* Compares the run at t, with the state x, v in the inside order, with the companions, which stand there. */
motus_status bars_take(motus_run *, double t, double *x, double *v, bool observed, motus_error *);
/* Computes the numbers of a state: seen 0: of the run; 1: of its companion; 2: of its twin. */
motus_status bars_see(motus_run *, motus_system *, double t, double *x, double *v, int seen, motus_error *);
/* Moves the state x, v at t to one `late` later, in the bars' room, which the next call uses again. */
motus_status bars_later(motus_run *, motus_system *, double t, double late, const double *x, const double *v,
                        double **to_x, double **to_v, motus_error *);
/* Returns the room that bars_moved takes for `count` columns. */
static inline size_t bars_moved_room(const motus_system *s, size_t count)
{
    return s->problem.nx + 2 * s->problem.nv + 3 + count;
}
motus_status bars_moved(motus_system *, double t, double late, const double *x, const double *v, const size_t *columns,
                        size_t count, double *room, double *out, motus_error *);
/* Returns how much later a time is, as it was written, than the double that was read. of_model, of_half: that time as
 * computed by the model and by the companion's system; NaN: it is not the model's. */
double bars_time_rounding(double t, double of_model, double of_half);
/* Bounds how far from the double `until` runs of a system may end: by how it was written, and by what rounding leaves
 * out of times. half: the companion's system; NULL: not known yet. */
double bars_end_rounding(double until, const motus_system *, const motus_system *half);
/* Lets the bars of another run go along with this run, which takes its place. */
void bars_move(motus_run *);

#endif
