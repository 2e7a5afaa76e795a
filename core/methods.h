/* Every method is a row. See methods.c for the rows and step/ for the texts that run them. */
#ifndef CORE_METHODS_H
#define CORE_METHODS_H

#include "core/system.h"

/* complete in core/rows.h, which only core/, machine/ and the laws include */
typedef struct row row;

/* A row with what a run adds: arguments, as of newmark(1/6, 1/2), tolerance and limits of the steps. */
typedef struct chosen {
    const row *row;
    double argument[2];
    /* In adaptive rows a step may be off by the larger of `absolute` and `relative` times the size of the variable; its
     * size stays between `least` and `most`. */
    double relative, absolute, least, most;
    int64_t count;             /* of adaptive rows: the most steps of a leg; 0: any number */
    double first;              /* the size of the first step; 0: error control chooses it */
    bool varies;               /* the numbers of the model change while it runs */
    bool written;              /* compiled: asks for the longer text, which is compiled beside a long run */
    int threads;               /* that a large system may use; their number changes no bit */
    char name[MOTUS_NAME_MAX]; /* canonical: "verlet", "newmark(0.16666666666666666, 0.5)" */
} chosen;

#define ROW_TOLERANCE 1e-9 /* the relative tolerance that row_choose sets */

size_t row_count(void);
const motus_method *row_card(size_t k);
/* Finds a row by name or alias, in any letter case, with its arguments: "newmark(1/6, 0.5)". */
motus_status row_choose(const char *name, chosen *, const motus_method **card, motus_error *);
/* Returns MOTUS_OK, or MOTUS_METHOD with the reason and the nearest method that admits the problem. */
motus_status row_admits(const chosen *, const traits *, motus_error *);
/* Tells what a step of the row preserves of this problem's motion. A kick moves v by what does not depend on v, a drift
 * x by what does not depend on x, so both preserve the volume; so does the kick of a gyroscopic term, the Cayley form
 * of an antisymmetric matrix [Qin13; HL18]. */
motus_geometry row_geometry(const chosen *, const traits *);
/* Tells whether every step must have the same size, so that `until` must be a whole number of steps away. */
bool row_uniform(const chosen *);
/* Tells whether the states are a formula of the time, so that no step adds an error. */
bool row_formula(const chosen *);
/* Tells whether the row is only for velocity terms of the form v × B. */
bool row_gyroscopic(const chosen *);
/* Tells whether a step multiplies what has the rate λ by a function of h λ alone. */
bool row_rates(const chosen *);
/* Tells whether steps adapt, so that their number is not known beforehand. */
bool row_adaptive(const chosen *);
/* Tells whether steps adapt and bound the accelerations within them (name_swing), so that the row can be watched
 * (step/watch.h). */
bool row_watched(const chosen *);
/* Tells whether the ends of a fixed step tell its dense output and bound its accelerations (swing_of_ends). */
bool row_bounded_by_ends(const chosen *);
/* Tells whether a step chooses its order too. */
bool row_orders(const chosen *);
/* Tells whether adaptive steps follow the time scale of the motion and not an estimate of their error. */
bool row_reversible_steps(const chosen *);
/* Returns the root of the sum of the squares of the weights that stages have in a step; 0: they have none. */
double row_weights(const chosen *);

#endif
