/* A run: a stepper between the start and `until`.
 *
 * Invariant: the stepper alone holds the time, the number of steps and the state; the run keeps copies of what was
 * observed.
 */
#ifndef API_MOTION_RUN_H
#define API_MOTION_RUN_H

#include "api/why/diagnosis.h"
#include "api/motion/pace.h"
#include "api/request/request.h"
#include "api/system/system.h"
#include "machine/beside.h"

/* The way from start to end: whole steps, and a shorter last one. */
typedef struct timing {
    double t0, h, until;
    double last;          /* the size of the shorter last step; 0: none */
    int64_t whole, total; /* steps up to `until`: the whole ones, and with the shorter one */
} timing;

typedef struct bars bars; /* api/error/bars.h */

/* What goes along with a run, as its bars of error do, called around its steps. The run knows no more of it. */
typedef struct run_company {
    motus_status (*begin)(motus_run *, motus_error *); /* called at the start of the run */
    void (*leg)(motus_run *);                          /* called where a leg begins, at a state that was set */
    /* says how many steps may follow before the next call */
    motus_status (*before)(motus_run *, int64_t *steps, motus_error *);
    void (*failed)(motus_run *);                         /* called when the run has failed */
    motus_status (*compile)(motus_run *, motus_error *); /* called when the run has gone on compiled */
    bool (*waits)(const motus_run *);                    /* whether the company waits for an object of its own */
    motus_status (*look)(motus_run *, motus_error *);    /* looks for that object */
    void (*end)(motus_run *);
} run_company;

/* How a run goes on compiled: api/motion/later.h. All bytes 0: it stays on its machine. */
typedef struct later {
    bool automatic;  /* nobody named the machine, and compiling pays */
    bool considers;  /* whether compiling pays is judged on the way, after `when` steps and later */
    bool waits;      /* a compiler is at work */
    int64_t when;    /* in all legs, as those of `look` */
    int64_t look;    /* the number of steps, in all legs, after which the run looks again; 0: never */
    int64_t piece;   /* steps between two looks for the object */
    double looked;   /* the time of the last look */
    int64_t exactly; /* for tests: the step after which the run goes over; 0: as soon as it can */
    int64_t longer;  /* for tests: the same, for the longer text */
    beside beside;   /* used while a compiler is at work */
} later;

struct motus_run {
    motus_system *system; /* a located one (api/system/system.h) where switches are located */
    motus_system *home;   /* the caller's system where `system` is a located one; else NULL */
    diagnosed diagnosed;
    machine machine;
    const char *note;
    const char *not_located; /* why switches are not located; "": they are, or the model has none */
    const char *cut;         /* how events that assign affect the method's geometry; "" */
    motus_allocator allocator;
    chosen chosen;
    const motus_method *card;
    timing timing; /* of the present leg */
    stepper *stepper;
    bool arrived, halted; /* halted: the last advance stopped early, since a landing is due */
    int legs;             /* a leg begins at the start and at every motus_run_set_state */
    int64_t before;       /* steps taken in earlier legs */
    double first_step;    /* the size of the first step of all; NaN before it */
    int (*observer)(void *context, motus_run *);
    bool observing;    /* the observer is being called */
    double *x, *v, *a; /* the synchronised state, valid while `synchronised` */
    bool synchronised, with_a;
    double *mid_x, *mid_v; /* a state between two steps; mid_v follows mid_x */
    int (*progress)(void *context, double fraction);
    void *context;
    pace pace;
    double told; /* when `progress` was last called */
    char *saved;
    size_t saved_room;
    bool unswitched;            /* steps are to end at switches, and there are none */
    struct locate *locate;      /* NULL: switches end no fixed steps */
    const rules *rules;         /* of the system; NULL: it has none */
    events *events;             /* NULL: the system has no rules */
    bars *bars;                 /* NULL: the caller asks for no bars */
    const run_company *company; /* NULL: nothing goes along */
    bool kept;                  /* a compiled object is used only if it is already there */
    later later;
    int64_t compiled_from; /* steps, in all legs, that the interpreter took before; -1: it takes all */
    struct trace *trace;   /* of the last step that was traced; NULL */
    struct goal *goal;     /* the accuracy that the run was made for; NULL: none */
};

/* What is known of a run before it is made. */
typedef struct run_hint {
    double steps;            /* about how many it takes; 0: not known */
    const char *not_located; /* why its switches are not located; NULL: its definition decides */
    /* gives the run its company before the run has a stepper; NULL: the run has none */
    motus_status (*accompany)(motus_run *, const motus_run_def *, motus_error *);
} run_hint;
/* Makes a run of a definition that asks for no accuracy, nor for "auto". */
motus_status run_create(motus_system *, const motus_run_def *, const run_hint *, motus_run **, motus_error *);

/* Makes a run of a request that has a row, an end, and a step where the row needs one. */
motus_status run_of(motus_system *, const request *, const motus_run_def *, const run_hint *, motus_run **,
                    motus_error *);
/* Makes a run without method, machine and stepper, and holds the system. NULL: no memory. */
motus_run *run_new(motus_system *);
void run_destroy(motus_run *);
/* Takes up to n steps, as motus_run_step does after its checks. */
motus_status run_step(motus_run *, int64_t n, motus_error *);
/* Begins another leg at this state. */
motus_status run_set_state(motus_run *, double t, const double *x, const double *v, motus_error *);
/* Copies the state at the end of the last step, in the outside order. */
motus_status run_state(motus_run *, double *x, double *v, motus_error *);
/* Fills in a timing. MOTUS_ARGUMENT: there is no end, or no step (NaN) for a row of fixed steps. */
motus_status run_timing(const chosen *, double step, double until, double start, timing *, motus_error *);
/* Writes a time for a message, with the digits that tell it from the ends of the run. Returns out. */
char *run_time_text(const motus_run *, double t, char out[DECIMAL_MAX]);
bool run_leads(motus_system *, const motus_run_def *, int64_t steps); /* a diagnosis_leads */
/* Makes x and v, and a if asked for, the state at the end of the last step. */
motus_status run_sync(motus_run *, bool with_a, motus_error *);
/* Returns whether a leg is so short, beside the time at which it begins, that the rounding of times matters. */
bool run_starts_late(const timing *);
/* Finds the state at a time from the last step on, in the inside order, and where it is kept; takes steps as needed.
 * MOTUS_ARGUMENT: t lies beyond the end, or before the last step. */
motus_status run_between(motus_run *, double t, double **x, double **v, motus_error *);
/* Begins a leg with this timing. */
void run_leg(motus_run *, const timing *);
/* Forgets what was observed, and finds out whether the stepper is at the end. Call it when the stepper was moved. */
motus_status run_moved(motus_run *, motus_error *);
/* Refuses what an observer may not do with its run. MOTUS_ARGUMENT. */
motus_status run_refuse_move(motus_error *);
/* Refuses a restart state whose time t lies beyond the end of the run. MOTUS_STATE. */
motus_status run_refuse_beyond(const motus_run *, double t, motus_error *);
/* Refuses what a run that locates switches cannot be: `what`, "saved". MOTUS_UNAVAILABLE, else MOTUS_OK. */
motus_status run_refuse(const motus_run *, const char *what, motus_error *);

int64_t locate_steps(const motus_run *); /* api/motion/locate.h */
/* Counts the steps of the present leg. */
static inline int64_t run_steps(const motus_run *r)
{
    if (r->events) return events_steps(r->events);
    return stepper_steps(r->stepper) + (r->locate ? locate_steps(r) : 0);
}
static inline double run_time(const motus_run *r) { return stepper_time(r->stepper); }

#endif
