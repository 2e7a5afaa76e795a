/* Checks what a model claims of its motion: its exact lines (verify_exact.c, at the times of verify_sample.c, and
 * between them in verify_between.c) and its invariants, whose formulas verify_invariant.c makes and which
 * api/system/invariants.c follows along a motion; what both need is in verify_size.c.
 *
 * Numbers count as equal where their difference is below EXACT_ROUNDING times what rounding may make of them: a bound
 * from their formulas (graph_rounding), which knows about cancellation, and the size of the motion, by which a velocity
 * or a position is known. Invariant: a claim that rounding alone contradicts is accepted.
 */
#ifndef LANG_READ_VERIFY_H
#define LANG_READ_VERIFY_H

#include "lang/model/resolution.h"
#include "lang/tape/tape.h"

enum {
    VERIFY_NODES_MAX = 10000, /* of formulas: of larger ones no bound is derived, and no invariant checked */
    VERIFY_TERMS_MAX = 200000 /* of families and sums, per evaluation: likewise */
};

typedef struct verify {
    bool bounded;   /* the formulas are small enough to derive bounds */
    uint32_t nodes; /* of the formulas */
    tape *boundary, *force, *force_rounding;
    tape *motion, *motion_rounding, *second, *second_rounding; /* of exact lines */
    tape *boundary_second;                                     /* the acceleration of boundary cells */
    tape **rate, **rate_rounding;   /* for each definition; NULL: it is no invariant, or none that is checked */
    tape **value, **value_rounding; /* likewise, of invariants with kinks */
    bool *proved, *kinks;           /* likewise; kinks: their formulas have some */
    resolution *along;              /* of the force and of invariants; NULL: nothing to resolve */
    size_t numbers;                 /* of the largest invariant */
    struct verify_between *between;
} verify;

/* MOTUS_OK; MOTUS_ARGUMENT: complained; MOTUS_MEMORY. */
motus_status verify_claims(model *);

/* verify_size.c, for the two checks. NULL: no memory. */
tape *verify_tape(model *, const output *, size_t count);
bool verify_bind(const model *, tape *const tapes[], size_t count);
output *verify_rounding(model *, const output *, size_t count, graph_seed leaf);
/* The error of a leaf in SPACE_DX, SPACE_DV for X and V; a parameter's is its size. */
node verify_leaf(graph *, node leaf, void *model);
/* The acceleration at a state, whose driven boundary cells become those of time t. */
void verify_force(const model *, double t, double *x, double *v, double *a);
/* The fastest rate of change by the force at a state: the largest sum of |da/dv| in a row, or the root of that of
 * |da/dx|; 0: not known. room: 3 nv numbers. */
double verify_fastest(const model *, double t, double *x, double *v, double *room);
/* The size of the motion of each variable at a state: the largest of its places, or its largest velocity over `rate`;
 * and so for velocities. */
void verify_size(const model *, double rate, const double *x, const double *v, double *size_x, double *size_v);
/* Two numbers with the digits that tell them apart. */
enum { VERIFY_DIGITS = MOTUS_TEXT_MAX };
void verify_digits(double a, double b, char of_a[VERIFY_DIGITS], char of_b[VERIFY_DIGITS]);

/* One time: the exact motion, its acceleration e, the force a there; and how far rounding may carry each off. */
typedef struct verify_sample {
    double t, *x, *v, *e, *a, *of_x, *of_v, *of_a, *of_e, *room;
} verify_sample;

/* verify_sample.c. Binds the tapes, and takes room, from s->x on. False: no memory. */
bool verify_sample_take(model *, verify_sample *);
/* The exact motion at a time, into x and v of the sample. */
void verify_sample_move(const model *, verify_sample *, double t);
/* The sizes of the motion there, and the roundings of its formula. */
void verify_sample_bound(const model *, verify_sample *);
/* The first of n numbers that differs by more than rounding; n: none does. An infinite rounding allows any number. */
size_t verify_sample_differs(const double *is, const double *due, const double *of, const double *more, size_t n);
/* The first number of v whose acceleration differs from the force at a time; nv: none does. */
size_t verify_sample_at(const model *, verify_sample *, double t);

typedef struct verify_fault {
    size_t number; /* of v that differs, at the time of the sample; nv: none does */
    double pole;   /* the time of a pole of the exact motion; NaN: none was found */
} verify_fault;

/* Which switches count: none; all; all but those at whose times, known beforehand, a located run ends its steps. */
typedef enum verify_switches { VERIFY_PLAIN, VERIFY_SWITCHES, VERIFY_LOCATED } verify_switches;
/* The resolution of lists of outputs, those that go into x and v in the first list, and of where switches change; *out
 * NULL: there is nothing to resolve. *sums becomes true where switches within sums are left out. False: no memory. */
bool verify_resolution(model *, const output *const lists[], const size_t counts[], size_t n, verify_switches,
                       resolution **out, bool *sums);
bool verify_between_make(model *);
/* Sets exact_between of the model. MOTUS_OK, or MOTUS_MEMORY. */
motus_status verify_between(model *, verify_sample *, verify_fault *);

bool verify_exact_make(model *);
motus_status verify_exact(model *);
bool verify_invariant_make(model *);

#endif
