/* Every method is a row. See methods.c for the rows and step/ for the texts that run them. */
#ifndef CORE_METHODS_H
#define CORE_METHODS_H

#include "core/system.h"

/* the whole row; core/ and the laws test see inside (core/rows.h), nobody else needs to */
typedef struct row row;

/* A row together with the arguments it was called with: newmark(1/6, 1/2). */
typedef struct chosen {
    const row *row;
    double argument[2];
    int threads;               /* that a large system may use; it changes no bit */
    char name[MOTUS_NAME_MAX]; /* canonical: "verlet", "newmark(0.16666666666666666, 0.5)" */
} chosen;

size_t row_count(void);
const motus_method *row_card(size_t k);
/* By name, alias, any letter case; "newmark(1/6, 0.5)": arguments are numbers or quotients of numbers. */
motus_status row_choose(const char *name, chosen *, const motus_method **card, motus_error *);
/* MOTUS_OK, or MOTUS_METHOD with reason and nearest fitting method. */
motus_status row_admits(const chosen *, const traits *, motus_error *);
/* True: every step must have the same size, so `until` must be a whole number of steps away (verlet-literal). */
bool row_uniform(const chosen *);
/* True: step sizes follow from errors, so their number is not known beforehand. */
bool row_adaptive(const chosen *);

#endif
