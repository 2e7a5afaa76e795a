/* The differences between a run and its companions in every column, what they were lately, and the bars that follow.
 */
#ifndef API_DIFFERENCES_H
#define API_DIFFERENCES_H

#include "api/system.h"

/* Sums for straight lines through the points (t, y) and (ln t, y). */
typedef struct differences_growth {
    double n, t, tt, l, ll, y, yy, ty, ly;
} differences_growth;

enum { DIFFERENCES_GROUPS = 3 }; /* positions, velocities, first-order variables */

typedef struct differences {
    size_t count; /* columns */
    double start, length;
    size_t *columns; /* 0 … count-1 */
    double *values;  /* of the run, at the last landing */
    double *other;   /* of a companion, at work */
    /* |run - companion| at the last landing and its largest in each part of the run: `slots` rows, of which the part
     * `part` uses row part % slots; and the same of the twin, NULL: there is none */
    double *d, *envelope, *twin;
    int slots;
    int64_t part;
    uint8_t *zero;                    /* 1: the run and its companion have had 0 at all landings */
    double scale[DIFFERENCES_GROUPS]; /* the largest number of each group so far */
    double most[DIFFERENCES_GROUPS];  /* the largest |run - companion| of each group so far */
    double distance;                  /* the largest |run - companion| / scale so far */
    double first;                     /* the distance when 1/32 of the run was done */
    bool first_known;
    double until; /* the first time with a distance at which no digit is significant; NaN: none */
    differences_growth growth;
    bool full, kinked;
} differences;

motus_status differences_create(differences *, const motus_system *, bool full, bool kinked, motus_error *);
/* A leg begins that goes from start to until. */
void differences_begin(differences *, double start, double until);
/* The columns of the run and of the companion at t, and of the twin or NULL; states in the inside order. */
motus_status differences_take(differences *, motus_system *, double t, double *x, double *v, motus_system *half,
                              double *half_x, double *half_v, double *twin_x, double *twin_v, motus_error *);
/* The bar of a column at the last landing; 0: its number is exact; INFINITY: no digit of it is significant. */
double differences_bar(const differences *, size_t column);
/* A bound on the bars that any number of the state had so far, relative to the largest number of its group or in its
 * own units. INFINITY: of some no digit was significant. */
double differences_worst(const differences *, bool absolute);
double differences_ratio(const differences *); /* by how much the distance has grown */
/* The rate at which the distance grows, where it grows as an exponential; else NaN. */
double differences_rate(const differences *);
void differences_destroy(differences *, const motus_allocator *);

#endif
