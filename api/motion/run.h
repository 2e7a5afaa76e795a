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

/* From the start to the end: whole steps, and a shorter last one. */
typedef struct timing {
    double t0, h, until;
    double last;          /* size of the shorter last step, 0: there is none */
    int64_t whole, total; /* whole steps up to `until`, and all, with the shorter one */
} timing;

typedef struct bars bars; /* api/error/bars.h */

/* What goes along with a run, its bars of error, and is asked before and after its steps: the run knows nothing else of
 * it. */
typedef struct run_company {
    motus_status (*begin)(motus_run *, motus_error *); /* the run stands at its start */
    void (*leg)(motus_run *);                          /* a leg begins, at a state that was set */
    /* How many steps may follow until it is asked again. */
    motus_status (*before)(motus_run *, int64_t *steps, motus_error *);
    void (*failed)(motus_run *); /* the run failed */
    /* The run has gone on compiled; whether its company waits for an object of its own; and a look for that. */
    motus_status (*compile)(motus_run *, motus_error *);
    bool (*waits)(const motus_run *);
    motus_status (*look)(motus_run *, motus_error *);
    void (*end)(motus_run *);
} run_company;

/* How it goes on compiled: api/motion/later.h. All bytes 0: it stays on its machine. */
typedef struct later {
    bool automatic;  /* nobody named the machine, and compiling pays */
    bool considers;  /* how long the run is is not known: it is to judge later whether compiling pays */
    bool waits;      /* a compiler is at work */
    int64_t look;    /* after so many steps, in all legs, it looks again; 0: no more */
    int64_t piece;   /* steps from one look for the object to the next */
    double looked;   /* when */
    int64_t exactly; /* tests: the step after which it goes over; 0: as soon as it can */
    beside beside;   /* while it waits */
} later;

struct motus_run {
    motus_system *system; /* a located one where its switches are (api/system/located.h), */
    motus_system *home;   /*   of this one; NULL: the caller's own */
    diagnosed diagnosed;
    machine machine;
    const char *note;
    const char *not_located; /* why switches are not; "": they are, or there are none */
    motus_allocator allocator;
    chosen chosen;
    const motus_method *card;
    timing timing; /* of the present leg */
    stepper *stepper;
    bool arrived, halted; /* halted: the last advance ended before its steps were taken, since a landing is due */
    int legs;             /* a leg begins at the start and at every motus_run_set_state */
    int64_t before;       /* steps taken in earlier legs */
    double first_step;    /* size of the first step of all; NaN before it */
    int (*observer)(void *context, motus_run *);
    bool observing;    /* the observer is being called */
    double *x, *v, *a; /* the synchronised state, valid while `synchronised` */
    bool synchronised, with_a;
    double *mid_x, *mid_v; /* a state between two steps, one behind the other */
    int (*progress)(void *context, double fraction);
    void *context;
    pace pace;
    double told; /* when `progress` was last called */
    char *saved;
    size_t saved_room;
    bool locating;              /* the definition asks that steps end at switches */
    struct locate *locate;      /* NULL: they do not */
    const rules *rules;         /* of the system, NULL: it has none */
    events *events;             /* NULL: likewise */
    bars *bars;                 /* of error; NULL: none are asked for, */
    const run_company *company; /*   and then this is NULL */
    bool kept;                  /* a compiled object is used only where there is one */
    later later;
    int64_t compiled_from; /* steps, in all legs, that the interpreter took before; -1: all of them */
    struct trace *trace;   /* of the last step that was traced; NULL */
    struct goal *goal;     /* what it was made for; NULL: a method and a step, or a tolerance, that were given */
};

/* What is known of a run before it is made. */
typedef struct run_hint {
    double steps;            /* about how many it takes; 0: not known */
    const char *not_located; /* why its switches are not; NULL: its definition says whether they are */
    /* Gives the run its company, before it has a stepper; NULL: it has none. */
    motus_status (*accompany)(motus_run *, const motus_run_def *, motus_error *);
} run_hint;
/* A run of a definition that wants no accuracy, nor "auto". */
motus_status run_create(motus_system *, const motus_run_def *, const run_hint *, motus_run **, motus_error *);

/* Of a request that has a row, a step where the row needs one, and an end. */
motus_status run_of(motus_system *, const request *, const motus_run_def *, const run_hint *, motus_run **,
                    motus_error *);
/* A run without method, machine and stepper, which holds the system. NULL: no memory. */
motus_run *run_new(motus_system *);
void run_destroy(motus_run *);
/* Takes up to n steps; motus_run_step, but for its checks. */
motus_status run_step(motus_run *, int64_t n, motus_error *);
/* Begins another leg at this state. */
motus_status run_set_state(motus_run *, double t, const double *x, const double *v, motus_error *);
/* The state at the end of the last step, in the outside order. */
motus_status run_state(motus_run *, double *x, double *v, motus_error *);
/* Fills in a timing. MOTUS_ARGUMENT: there is no step (NaN), which a row of fixed steps needs, or no end. */
motus_status run_timing(const chosen *, double step, double until, double start, timing *, motus_error *);
/* A time for a message, with the digits that tell it from the ends of the run. Returns out. */
char *run_time_text(const motus_run *, double t, char out[DECIMAL_MAX]);
bool run_leads(motus_system *, const motus_run_def *, int64_t steps); /* a diagnosis_leads */
motus_status run_sync(motus_run *, bool with_a, motus_error *);
/* Whether it is so short, beside the time at which it begins, that the rounding of times moves what it tells. */
bool run_starts_late(const timing *);
/* The state at a time that is not before the last step, in the inside order: where it is kept. Takes steps as needed.
 * MOTUS_ARGUMENT: t lies beyond the end, or before that step. */
motus_status run_between(motus_run *, double t, double **x, double **v, motus_error *);
/* Begins a leg with this timing. */
void run_leg(motus_run *, const timing *);
/* Call it when the stepper was moved: forgets what was observed, and finds out whether the stepper is at the end. */
motus_status run_moved(motus_run *, motus_error *);
/* MOTUS_ARGUMENT, for what an observer may not do with its run. */
motus_status run_refuse_move(motus_error *);
/* MOTUS_STATE: a restart state of time t lies beyond the end of the run. */
motus_status run_refuse_beyond(const motus_run *, double t, motus_error *);
/* MOTUS_UNAVAILABLE, for what a run that locates switches cannot do: "saved"; else MOTUS_OK. */
motus_status run_refuse(const motus_run *, const char *what, motus_error *);

int64_t locate_steps(const motus_run *); /* api/motion/locate.h */
/* The steps of the present leg. */
static inline int64_t run_steps(const motus_run *r)
{
    if (r->events) return events_steps(r->events);
    return stepper_steps(r->stepper) + (r->locate ? locate_steps(r) : 0);
}
static inline double run_time(const motus_run *r) { return stepper_time(r->stepper); }

#endif
