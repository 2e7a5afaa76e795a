/* A run: an engine on its way from the start to `until`.
 *
 * Invariant: the engine only ever takes whole steps of size h. The shorter last step is taken by an engine of its own from the synchronised
 * state, so the main line stays what it would be in a longer run, and a saved state can go on beyond `until`.
 */
#ifndef API_RUN_H
#define API_RUN_H

#include "api/system.h"

struct motus_run {
    motus_system *system;
    const machine *machine;
    const problem *problem;          /* the system's, or the compiled machine's */
    const char *note;
    motus_allocator allocator;
    chosen chosen;
    const motus_method *card;
    double t0, h, until;
    int64_t whole, total;            /* whole steps up to `until`, and with the short one */
    double last;                     /* size of the short one, 0: none */
    engine *engine, *tail;           /* tail: after the short step */
    int64_t tail_evaluations, tail_iterations;
    double *x, *v, *a;               /* the synchronised state, valid while `synchronised` */
    bool synchronised, with_a;
    double before_t, *before_x, *before_v, *before_a;     /* for reading between steps */
    bool before;
    double *mid_x, *mid_v;
    int (*progress)(void *context, double fraction);
    void *context;
    int64_t piece;                   /* steps between two looks at the clock, and when the hook was last called */
    double told;
    char *saved; size_t saved_room;
    struct trace *trace;             /* of the last step that was traced; NULL */
};

/* From the start to the end: whole steps, and a shorter last one. NaN: the model's. */
typedef struct timing { double t0, h, until, last; int64_t whole, total; } timing;
motus_status run_timing(const motus_system *, const chosen *, double step, double until, double start, timing *, motus_error *);
double run_now(void);                  /* seconds of a clock that never goes back */
double run_time(const motus_run *);
motus_status run_sync(motus_run *, bool with_a, motus_error *);
/* One more step, whole or the short last one, told to the tracer; not past the end. */
motus_status run_trace(motus_run *, const tracer *, motus_error *);

#endif
