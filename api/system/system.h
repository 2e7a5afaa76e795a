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
    bool prime;    /* of a velocity */
    uint32_t item; /* the number of its state or definition */
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
    const rules *rules; /* of a callback; NULL: it has no events */
    problem problem;
    machine machine;       /* the interpreter, or the callback */
    compiled *compiled;    /* NULL until a run asks for it */
    struct held *switches; /* NULL until a run asks for it, and where the model has none */
    bool switches_known;
    struct ruled *ruled;               /* NULL until the rules are asked for, and where the model has none */
    struct sides *sides;               /* the switches of a located system as rules; NULL until they are asked for */
    struct motus_system *located;      /* see located.c; NULL until a run asks for it, and where there is none */
    bool located_known;                /* `located` was asked for */
    const char *located_refused;       /* why the switches of the model cannot be located, or NULL */
    uint64_t changes, located_changes; /* how often numbers were set: until now, and until `located` was made */
    resolution *poles;                 /* NULL until a run asks for a singularity, and where the force has no poles */
    bool poles_known;
    struct bends {
        bool known; /* a run had a witness */
        /* what in the force can hide between points: on all sides of its switches, on all but those of known times, and
         * on one side; NULL: nothing */
        resolution *all, *located, *smooth;
        bool sums; /* these leave out switches within sums */
    } bends;
    weight weight; /* of the equations; valid if `weighed` */
    bool weighed;
    const char *switches_refused; /* why switches cannot be held, or NULL */
    double start;
    double *x0, *v0;
    model_state *states;
    uint32_t state_count; /* states of the model, or of a callback by stand_in.c */
    model_definition *definitions;
    uint32_t definition_count; /* definitions of the model, or of a callback by stand_in.c */
    size_t positions, velocities;
    column_range *ranges;
    size_t range_count, column_count;
    uint32_t *range_of, range_slots; /* a hash table by name: 1 + a range, or 0; range_slots is a power of two */
    size_t named[2], named_count[2]; /* [0]: the ranges of quantities; [1]: of invariants */
    double *observed; /* room for one quantity or invariant; of a callback, for all quantities or all invariants */
    double *exact_x, *exact_v;
    bool judged_gyroscopic, judged_gradient;   /* the trait is known */
    bool sampled_gyroscopic, sampled_gradient; /* the trait holds as far as sampled, and is not proved */
    bool energy;                               /* the potential is proved to have one value everywhere */
    size_t held;                               /* how many runs, ensembles and references use the system */
    bool ended;                                /* it was destroyed while they use it, and ends with the last of them */
    struct setting *settings;
    const char *explanation[3][4]; /* for each answer; gyroscopic and gradient apart */
    char *equation;
    char *events_text; /* the last text of motus_explain_events, from the hooks */
    struct switches
        *surfaces;      /* found by motus_switch_at; NULL until it is asked, and where a located system has them */
    char *surface_text; /* the last text of motus_switch_at */
    char *mathml;       /* of the statement typeset last, from the hooks */
};

/* Judges the size that `made` says (defaults.c). sizes: those of all versions, the present one last. */
typedef enum defaults_fit { SIZE_FITS, SIZE_MISSING, SIZE_UNKNOWN, SIZE_ASKS_MORE } defaults_fit;
defaults_fit defaults_judge(const uint32_t *sizes, size_t count, const void *made);
/* Reads a system, as motus_system_from_text does; how: lang/read/read.h. */
motus_status system_read(const motus_text_def *, const read_how *, motus_system **, motus_error *);
/* Reads the text of a system again, with its modes. nudged, varied: lang/text/source.h. */
motus_status system_again(const motus_system *, bool nudged, const uint8_t *varied, motus_system **, motus_error *);
/* Returns whether a name, in any letter case, asks the library to choose the method. */
#define SYSTEM_AUTO "auto"
bool system_auto(const char *method);
/* Returns what the model says, where a callback says its start alone; `automatic` is not known yet. */
motus_settings system_settings(const motus_system *);
/* Copy a state from the inside order to the outside one, and back. */
void system_outside(const motus_system *, const double *x, const double *v, double *out_x, double *out_v);
void system_inside(const motus_system *, const double *in_x, const double *in_v, double *x, double *v);
/* Computes columns at a state in the inside order, and refreshes its boundary cells. */
motus_status system_values(motus_system *, double t, double *x, double *v, const size_t *columns, size_t count,
                           double *out, motus_error *);
/* Bounds the rounding of columns that are computed at a state: of quantities and invariants of a text, else 0. */
motus_status system_rounding(motus_system *, double t, double *x, double *v, const size_t *columns, size_t count,
                             double *bounds, motus_error *);
/* The bar of a column's error. */
typedef double (*system_bar)(void *ctx, size_t column);
/* Makes the box of all states that lie within the bars of (x, v). False: a number has no finite bar. */
bool system_box(const motus_system *, const double *x, const double *v, system_bar, void *ctx, interval *in_x,
                interval *in_v);
/* Returns whether a column is a quantity or invariant of a text whose formula jumps. */
bool system_jumps(motus_system *, size_t column);
/* Raises the errors of columns that jump where the bars of the state leave open on which side of a jump they are: to
 * the spread of their values within the bars, or INFINITY where that is as large as the value. A column that does
 * nothing but jump, and whose side is known, is as exact as its formula. sharp: also columns whose value or slope is
 * infinite somewhere; INFINITY where they may have a pole. */
motus_status system_leaps(motus_system *, double t, double *x, double *v, system_bar, void *ctx, bool sharp,
                          const size_t *columns, size_t count, double *errors, motus_error *);
/* Computes columns as system_values does, and leaves the state as it is; `room`: nx + nv numbers. */
motus_status system_values_of(motus_system *, double t, const double *x, const double *v, double *room,
                              const size_t *columns, size_t count, double *out, motus_error *);
/* Moves a state from t to t + late, a little later, to first order. a: room for its acceleration. Returns the answer of
 * the acceleration; where that is not 0, velocities stay as they are. */
int system_later(const motus_system *, double t, double late, double *x, double *v, double *a);
/* Finds the switches of the model, once: `switches`, or in `switches_refused` why they cannot be held. */
motus_status system_switches(motus_system *, motus_error *);
bool system_located(const motus_system *);
/* Makes the rules of the model, once; *out is NULL where it has none. */
motus_status system_rules(motus_system *, const rules **out, motus_error *);
/* Lets the machines compute with the model's present numbers; call it after a change. False: no memory, which only the
 * first call may need. */
bool system_rebind(motus_system *);
/* Copies all numbers of a model, by the hooks (set.c). NULL: no memory. */
double *set_aside(const motus_system *);
void set_back(motus_system *, const double *numbers);
bool system_number_columns(motus_system *);
/* Returns the place in x, or in v, of column 1 + outer. */
size_t system_number(const motus_system *, size_t outer, bool of_v);
/* Returns the quantity or invariant of a column; number: that of the column in it, in the inside order. */
const model_definition *system_definition(const motus_system *, size_t column, size_t *number);
size_t system_place(const model_state *, size_t cell, int component);

/* ---- invariants.c: whether the invariants of a model hold along its motion ---- */

/* Checks the invariants of a model. MOTUS_ARGUMENT: the error says where and how fast one changes. */
motus_status invariants_check(motus_system *, motus_error *);

/* ---- stand_in.c: the variables, quantities and invariants of a callback ---- */

/* Makes states and definitions from the callback definition, and copies the names. */
motus_status stand_in_make(motus_system *, motus_error *);

/* ---- symmetry.c: traits that are proved or sampled when a caller first needs them ---- */

enum { SYMMETRY_STATES = 32, SYMMETRY_LEAST = 6 }; /* states at which a symmetry is sampled; of large systems fewer */

/* Find out whether the velocity term does no work, and whether the force is a gradient (with constant masses), and note
 * it in the traits. False: there is no memory for the test. */
bool symmetry_gyroscopic(motus_system *);
bool symmetry_gradient(motus_system *);

/* ---- shadow.c: a copy of a system whose decimals are rounded to the other side, for bars of error ---- */

/* Makes the shadow of a system. A decimal of a text, 0.1, is read as the double next to it; the shadow has the next
 * double on the decimal's other side, and likewise for pi, so that what was written lies between the two systems. A
 * constant that was computed, 1/3 or 1000.7^2 - 1000.6^2, becomes the double on the other side of what its decimals
 * say. Numbers that motus_system_set gave are doubles and stay. The shadow is a clone of a callback, and where a moved
 * number would decide a size. affected: a byte for each place of the pool, not 0 where a caller changes the number,
 * which then stays; NULL: all 0. */
motus_status shadow_create(const motus_system *, const uint8_t *affected, motus_system **, motus_error *);

/* Sets in `to` every number that was set in `from`, a system of the same text; `to` computes what depends on them. */
motus_status shadow_numbers(const motus_system *from, motus_system *to, motus_error *);

/* ---- located.c: systems whose runs end a step wherever a switch of the force changes its side ----
 *
 * A located system is read from the text of another, with modes for the sides of its switches. It has the motion, the
 * columns and their order of that system; x has the sides after the positions, and its rules change them. */

/* The switches of a system with more of them are not located unless asked for, since each costs time in every step. */
enum { LOCATED_MOST = 64 };
/* Returns whether the force, or what moves a boundary cell, is not smooth. */
bool located_kinks(const model *);
/* Finds the located system of a system, with its numbers, or makes it; the system owns it. NULL: it has no switches, or
 * `why`, else "", says why they are not located. asked: MOTUS_SWITCHES_LOCATE wherever that is possible;
 * MOTUS_SWITCHES_USUAL where the force is defined beyond every switch and there are at most LOCATED_MOST of them;
 * another choice: NULL. Use it only until the system's numbers are set again. */
motus_status located_of(motus_system *, motus_switches asked, motus_system **, const char **why, motus_error *);
/* Returns whether switches are not located unless asked for only because the force may be undefined beyond one; after
 * located_of. */
bool located_may_leave(const motus_system *);
/* Finds the located system for runs of a method, as located_of does. A row of fixed steps gets one only for
 * MOTUS_SWITCHES_LOCATE. */
motus_status located_for(motus_system *, const chosen *, motus_switches asked, motus_system **, const char **why,
                         motus_error *);

#endif
