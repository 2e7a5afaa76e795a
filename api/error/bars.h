/* Bars of error: how far the numbers of a run may be from the exact motion, told from its companions.
 *
 * Invariant: the run never learns of them; its bits and its counters are the same with and without.
 */
#ifndef API_ERROR_BARS_H
#define API_ERROR_BARS_H

#include "api/error/companion.h"
#include "machine/differences.h"

struct bars {
    motus_bars kind;
    bool kept;             /* the companion, as the run, uses a compiled object only where there is one */
    bool given_x, given_v; /* the run's state at its start is not the model's */
    bool started;
    witness *witness;     /* NULL: the run is none that one can look at */
    companion half, twin; /* of about half the step; a twin of the run from a state that is an ulp away */
    size_t count;         /* numbers that are compared: their columns */
    size_t *columns;
    uint8_t *whole; /* of each number, where there are events, whether it only counts (event_bars.c); NULL */
    size_t endless; /* 1 + the rule whose events were found to accumulate when it was judged; 0: none */
    double *memory; /* of the differences */
    double *room;   /* bars_moved_room; a state, and its acceleration (bars_later) */
    differences differences;
    /* Of a run with events, how far the rounding of its places moves each acceleration at the last landing, and room
     * for what `spread` of bars.c needs besides; NULL: it has none. */
    double *steep;
    double landed;  /* time of the last landing */
    int64_t steps;  /* whole steps of the run before it */
    double seconds; /* elapsed in all this */
    /* Of a restart state, until they begin; NULL. Afterwards, whether the run has not come yet to where the companion
     * landed last: that was at the end, after a shorter step, which the state is before. */
    double *resumed;
    size_t resumed_count;
    bool ahead;
    /* The run and its companion have not had the same events, as between the time of an event of the one and that of
     * the other; since when. Then their states are not compared. */
    bool gap;
    double gap_since;
    bool end_reached;   /* the companion was led to where events have ended the run */
    double *open_since; /* of every rule, since when it is open how often it has happened; NULL: of none */
    size_t rows;        /* of the table of events, that a companion confirms so far */
    bool rows_differ;   /* it has other events from there on */
    char why[256];      /* no bar; "": there is one */
};

/* Gives a run its company, r->bars, of all columns, where the definition asks for them. */
motus_status bars_prepare(motus_run *, const motus_run_def *, motus_error *);
/* The same of these columns, of which the first are the time and the state. how: as in machine/differences.h. */
motus_status bars_make(motus_run *, motus_bars, const size_t *columns, const int *how, size_t count, motus_error *);
differences_shape bars_shape(const motus_system *, const motus_method *card, motus_bars, const int *how, size_t count);
/* Makes the system of the companion, before it is needed. affected: as in api/system/shadow.h. */
motus_status bars_ready(motus_run *, const uint8_t *affected, motus_error *);
/* A run of another motion begins: with the state of the system, or (given) with one of its own. */
void bars_again(motus_run *, bool given);
/* And it has other events, of which none has happened. */
void bars_forget_events(motus_run *);
/* Lands where the run stands. Fails likewise. */
motus_status bars_land(motus_run *, motus_error *);
/* The same; this is an observation, so it enters the numbers that are reduced. */
motus_status bars_observe(motus_run *, motus_error *);
/* The same at a time within its last step, where its state is x, v in the inside order. */
motus_status bars_land_between(motus_run *, double t, double *x, double *v, motus_error *);
/* The bar of a number at t, at which the companion has landed if it could; NaN: there is none. */
double bars_of(const bars *, double t, size_t number);
/* errors.c: the error of a number at the run's state, or at one between: that, the bound of system_rounding, which
 * *error holds before, and what events add. */
motus_status errors_of(motus_run *, double t, double *x, double *v, size_t number, double *error, motus_error *);
/* Afterwards: what quantities that jump, or are sharp, add to theirs, system_leaps. */
motus_status errors_leaps(motus_run *, double t, double *x, double *v, bool sharp, const size_t *columns, size_t count,
                          double *errors, motus_error *);
/* Of columns, with their values, which may be NULL: the run's own, also where there are no bars. */
motus_status errors_tell(motus_run *, double t, double *x, double *v, const size_t *columns, size_t count,
                         double *values, double *errors, motus_error *);
/* As differences_worst; NaN: there are no bars. */
double bars_worst(const bars *, bool absolute, bool unknown);
/* The bar of what run and companion differ by, in parts of their distance. */
double bars_part(const motus_run *);
/* After every event that changed the state, run and companion share a part in 2^52 of its velocities, which acts on all
 * the time since: so many such parts. Step after step a row adds the same numbers in the same order, so the parts have
 * one sign: dopri5 leaves 2^-52 of the velocity of each flight of a ball. */
#define BARS_LASTING 1.5
/* By how much the state at t is late or early in run and companion alike, where events have happened: by what their
 * times share; bars_late: and by the rounding of the run's end. */
double bars_events_late(const motus_run *, double t);
double bars_late(const motus_run *, double t);
/* From now on there are no bars, and why. The first reason stays. */
void bars_give_up(motus_run *, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* bars_kept.c: what a restart state has of them, where they have landed: `count` numbers to give back, 0: there are no
 * bars. `t`: of the state, where the run stands or, if it has taken a shorter step to its end, before that. */
motus_status bars_keep(motus_run *, double t, double **numbers, size_t *count, motus_error *);
/* The run was restored by such a state: its companion will go on. False: the numbers are not those of its bars. */
bool bars_resume(motus_run *, double *numbers, size_t count);
motus_status bars_kept_begin(motus_run *, const double *x, const double *v, motus_error *);
/* Compares the run at t, where its state is x, v in the inside order, with its companions, which stand there. */
motus_status bars_take(motus_run *, double t, double *x, double *v, bool observed, motus_error *);
/* The numbers of a state of the run, of its companion or of its twin. */
motus_status bars_see(motus_run *, motus_system *, double t, double *x, double *v, int seen, motus_error *);
/* The state a short time later than x, v at t, in the bars' room: as long as they are not asked again. */
motus_status bars_later(motus_run *, motus_system *, double t, double late, const double *x, const double *v,
                        double **to_x, double **to_v, motus_error *);
/* How far the numbers of columns move in a time `late`, in which the state x, v at t is moved to first order. */
static inline size_t bars_moved_room(const motus_system *s, size_t count)
{
    return s->problem.nx + 2 * s->problem.nv + 3 + count;
}
motus_status bars_moved(motus_system *, double t, double late, const double *x, const double *v, const size_t *columns,
                        size_t count, double *room, double *out, motus_error *);
/* How much later a time is that was written than the double which was read; of_model, of_half: the same time as the
 * model has computed it, and the companion's. NaN: it is not the model's. */
double bars_time_rounding(double t, double of_model, double of_half);
/* How much later or earlier than the double `until` runs of a system may end, as it was written and by what rounding
 * leaves out of their times. half: the companion's; NULL: it is not known yet. */
double bars_end_rounding(double until, const motus_system *, const motus_system *half);
/* The bars come from another run, whose place this one takes. */
void bars_move(motus_run *);

#endif
