/* A system behind the public handle: a problem, its machine, and the numbering of its columns.
 *
 * The numbers of a state have two orders. The inside order is that of x and v in lang/model/model.h: component by
 * component, boundary cells included. The outside order is that of the public calls: variable by variable, cell by
 * cell, component by component, without boundary cells.
 */
#ifndef API_SYSTEM_SYSTEM_H
#define API_SYSTEM_SYSTEM_H

#include "api/system/check.h"
#include "base/modes.h"
#include "core/events.h"
#include "lang/graph/weigh.h"
#include "lang/model/resolution.h"
#include "lang/read/read.h"
#include "machine/compiled.h"

typedef struct column_range { /* the columns of one name */
    motus_column_kind kind;
    bool prime;    /* a velocity, exact or not */
    uint32_t item; /* number of the state or definition */
    size_t first, count;
} column_range;

struct motus_system {
    motus_allocator allocator;
    arena arena;
    model *model; /* NULL: the system is from a callback */
    interpreter *interpreter;
    motus_text_def text; /* the definition that it was read from, in the arena */
    motus_callback_def callback;
    calling calling;
    const rules *rules; /* of a callback; NULL: nothing happens on the way */
    problem problem;
    machine machine;       /* the interpreter, or the callback */
    compiled *compiled;    /* NULL until a run asks for it */
    struct held *switches; /* NULL until a run asks for it, and where the model has none */
    bool switches_known;
    struct ruled *ruled;               /* NULL until its rules are asked for, and where the model has none */
    struct sides *sides;               /* of a located system: its switches as rules; NULL until they are asked for */
    struct motus_system *located;      /* api/system/located.h; NULL until a run asks for it */
    bool located_known;                /* or there is none */
    const char *located_refused;       /* why it has switches and none; NULL */
    uint64_t changes, located_changes; /* how often its numbers were set, and when `located` was made */
    resolution *poles; /* NULL until a run is asked for a singularity, and where the force has no poles */
    bool poles_known;
    struct bends {
        bool known;               /* since a run had a witness */
        resolution *all, *smooth; /* what in the force can hide between points, and what can where its switches keep
                                     their sides; NULL: nothing */
        bool sums;                /* it has switches within sums, which are not among these */
    } bends;
    weight weight; /* of the equations, where `weighed` */
    bool weighed;
    const char *switches_refused; /* why they cannot be located; NULL */
    double start;
    double *x0, *v0;
    model_state *states;
    uint32_t state_count; /* of the model, or made by stand_in.c for a callback */
    model_definition *definitions;
    uint32_t definition_count; /* likewise */
    size_t positions, velocities;
    column_range *ranges;
    size_t range_count, column_count;
    uint32_t *range_of, range_slots; /* a hash table by name: 1 + a range, 0 free; slots: a power of two */
    size_t named[2], named_count[2]; /* the ranges of quantities, and of invariants */
    double *observed; /* room for one quantity or invariant; of a callback, for all quantities or all invariants */
    double *exact_x, *exact_v;
    bool judged_gyroscopic, judged_gradient;   /* the traits are known */
    bool sampled_gyroscopic, sampled_gradient; /* they hold as far as sampled, and are not proved */
    bool energy;                               /* the potential is proved to have one value everywhere */
    size_t held;                               /* how many runs, ensembles and references use it: set.c */
    struct setting *settings;
    const char *explanation[3][4]; /* for each answer: gyroscopic, gradient */
    char *equation;
    char *events_text; /* what motus_explain_events said last, from the hooks */
    struct switches
        *surfaces;      /* found by motus_switch_at; NULL until it is asked, and where a located system has them */
    char *surface_text; /* what motus_switch_at said last */
    char *mathml;       /* of the statement typeset last, from the hooks */
};

/* defaults.c. Whether the size in `made` is valid, when the versions had `sizes`, of which the last is the present. */
typedef enum defaults_fit { SIZE_FITS, SIZE_MISSING, SIZE_UNKNOWN, SIZE_ASKS_MORE } defaults_fit;
defaults_fit defaults_judge(const uint32_t *sizes, size_t count, const void *made);
/* As motus_system_from_text; how: lang/read/read.h. */
motus_status system_read(const motus_text_def *, const read_how *, motus_system **, motus_error *);
/* Reads the text of a system again, with the same modes; nudged, varied: as in lang/text/source.h. */
motus_status system_again(const motus_system *, bool nudged, const uint8_t *varied, motus_system **, motus_error *);
/* Whether a name stands for no method, but for its choice; in any letter case. */
#define SYSTEM_AUTO "auto"
bool system_auto(const char *method);
/* Copy between the two orders. */
void system_outside(const motus_system *, const double *x, const double *v, double *out_x, double *out_v);
void system_inside(const motus_system *, const double *in_x, const double *in_v, double *x, double *v);
/* Values of columns at a state in the inside order, whose driven boundary cells are refreshed. */
motus_status system_values(motus_system *, double t, double *x, double *v, const size_t *columns, size_t count,
                           double *out, motus_error *);
/* Bounds on how far rounding carries the numbers of columns off that are computed at a state: of quantities and
 * invariants of a text, else 0. */
motus_status system_rounding(motus_system *, double t, double *x, double *v, const size_t *columns, size_t count,
                             double *bounds, motus_error *);
/* Quantities and invariants of a text that jump: where the bars of the state leave open on which side of a jump one is,
 * its error is the spread of what it may be; INFINITY, where a jump makes that as large as itself. One that does
 * nothing but jump, and is decided, is as exact as its formula. sharp: those, too, whose value or slope is infinite
 * somewhere: near there the error is the spread of what they may be; INFINITY, where they may have a pole. */
typedef double (*system_bar)(void *ctx, size_t column);
/* The state x and v, each number anywhere within its bar. False: of one there is none. */
bool system_box(const motus_system *, const double *x, const double *v, system_bar, void *ctx, interval *in_x,
                interval *in_v);
bool system_jumps(motus_system *, size_t column); /* whether its column is one of those */
motus_status system_leaps(motus_system *, double t, double *x, double *v, system_bar, void *ctx, bool sharp,
                          const size_t *columns, size_t count, double *errors, motus_error *);
/* The same at a state that stays as it is; `room`, nx + nv numbers, takes a copy of it. */
motus_status system_values_of(motus_system *, double t, const double *x, const double *v, double *room,
                              const size_t *columns, size_t count, double *out, motus_error *);
/* Moves a state at t to one that is later by little, to first order; a: room for its acceleration. Other than 0: the
 * answer of the acceleration, without which velocities stay as they are. */
int system_later(const motus_system *, double t, double late, double *x, double *v, double *a);
/* Finds the switches of the model, once: `switches`, or why they cannot be held. */
motus_status system_switches(motus_system *, motus_error *);
/* Whether runs of it end their steps where a switch changes its side. See located.h. */
bool system_located(const motus_system *);
/* The rules of the model, made once; *out is NULL where it has none. */
motus_status system_rules(motus_system *, const rules **out, motus_error *);
/* To be called after the model's numbers have changed: its machines compute with the new ones. False: no memory, which
 * the first call alone may need. */
bool system_rebind(motus_system *);
/* set.c. A copy of all numbers of a model, by the hooks (NULL: no memory); and they are the system's numbers again. */
double *set_aside(const motus_system *);
void set_back(motus_system *, const double *numbers);
bool system_number_columns(motus_system *);
/* The place in x, or in v, of column 1 + outer. */
size_t system_number(const motus_system *, size_t outer, bool of_v);
/* The quantity or invariant of a column, and the column's number in it, in the inside order. */
const model_definition *system_definition(const motus_system *, size_t column, size_t *number);
size_t system_place(const model_state *, size_t cell, int component);

#endif
