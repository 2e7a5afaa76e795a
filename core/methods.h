/* Every method is a row. See methods.c for the rows and step/ for the texts that run them. */
#ifndef CORE_METHODS_H
#define CORE_METHODS_H

#include "core/system.h"

/* its members are in core/rows.h, for core/, machine/ and the laws alone */
typedef struct row row;

/* A row together with the arguments it was called with: newmark(1/6, 1/2). */
typedef struct chosen {
    const row *row;
    double argument[2];
    /* Of adaptive rows: what a step may be off, the larger of `relative` times the size of its variable and
     * `absolute`; and between which sizes steps stay. */
    double relative, absolute, least, most;
    int64_t count;             /* and how many steps a leg may have; 0: any number */
    double first;              /* the size of the first step; 0: error control chooses it */
    bool varies;               /* the numbers of the model change while it runs */
    int threads;               /* that a large system may use; it changes no bit */
    char name[MOTUS_NAME_MAX]; /* canonical: "verlet", "newmark(0.16666666666666666, 0.5)" */
} chosen;

#define ROW_TOLERANCE 1e-9 /* of a row that row_choose finds */

size_t row_count(void);
const motus_method *row_card(size_t k);
/* Finds a row by name or alias, in any letter case; "newmark(1/6, 0.5)": arguments are numbers or quotients of two. */
motus_status row_choose(const char *name, chosen *, const motus_method **card, motus_error *);
/* MOTUS_OK, or MOTUS_METHOD with the reason and the nearest method that admits the problem. */
motus_status row_admits(const chosen *, const traits *, motus_error *);
/* What a step of the row preserves of this problem's motion: all that the library says of it asks here. Kicks and
 * drifts move v or x by what does not depend on it, which preserves the volume; so does the kick of a gyroscopic term,
 * the Cayley form of an antisymmetric matrix [Qin13; HL18]. */
motus_geometry row_geometry(const chosen *, const traits *);
/* True: every step must have the same size, so `until` must be a whole number of steps away (verlet-literal). */
bool row_uniform(const chosen *);
/* True: its states are a formula of the time, so no step adds an error. */
bool row_formula(const chosen *);
/* True: only for velocity terms of the form v × B. */
bool row_gyroscopic(const chosen *);
/* True: step sizes follow from errors, so the number of steps is not known beforehand. */
bool row_adaptive(const chosen *);
/* Its steps adapt, and bound the accelerations within them (name_swing): it can be watched (step/watch.h). */
bool row_watched(const chosen *);
/* Its steps have one size, and dense output follows from their ends: bounds on the accelerations do, too
 * (swing_of_ends). */
bool row_bounded_by_ends(const chosen *);
/* True: a step chooses its order too. */
bool row_orders(const chosen *);
/* True: they follow the time scale of the motion, and not an error; row_adaptive holds too. */
bool row_reversible_steps(const chosen *);

#endif
