/* The differences between a run and its companions in every number that is told, what they were lately, and the bars
 * that follow.
 */
#ifndef MACHINE_DIFFERENCES_H
#define MACHINE_DIFFERENCES_H

#include "core/system.h"

/* Sums for straight lines through the points (t, y) and (ln t, y). */
typedef struct differences_growth {
    double n, t, tt, l, ll, y, yy, ty, ly;
    double next; /* time after the start from which on there may be another point */
} differences_growth;

enum { DIFFERENCES_GROUPS = 3 };   /* positions, velocities, first-order variables */
enum { DIFFERENCES_SEEN_MAX = 3 }; /* the run, its companion, a twin of the run */

/* How large a group of numbers was at a time shortly before, and when it had last grown by far. */
typedef struct differences_size_of {
    double size, since, grew;
} differences_size_of;

/* Which numbers are compared: the time, the state, and others. */
typedef struct differences_shape {
    size_t count, positions, velocities; /* numbers; of the state: positions, velocities and first-order variables */
    /* of each number its reduction over the observations, REDUCE_ of machine/text/reduce.h; NULL: its last value */
    const int *how;
    bool full, kinked, slow; /* there is a twin; the force is not smooth; the method is of order 1 */
} differences_shape;

typedef struct differences {
    differences_shape shape;
    double start, length;
    /* What was seen last, of which the caller writes the numbers: of the run, of its companion, of the twin (NULL). The
     * bars belong to values[0], which of numbers that are reduced is their reduction. */
    double *values[DIFFERENCES_SEEN_MAX];
    double *kept[DIFFERENCES_SEEN_MAX]; /* REDUCE_KEPT of each number; NULL: none is reduced */
    int64_t observations;
    /* |run - companion| at the last landing and its largest in each part of the run: `slots` rows, of which the part
     * `part` uses row part % slots; and the same of the twin, NULL: there is none */
    double *d, *envelope, *twin;
    int slots;
    int64_t part;
    double *size;         /* the largest that the run or its companion has had at a landing */
    double *now, *before; /* the same at the last landing alone, and at the one before */
    double *last;         /* |run - companion| at the landing before, or within the last step */
    /* Of each number what neither run nor companion knows of its error: 0 until the caller writes it. */
    double *apart;
    double taken; /* the time of the last landing */
    bool between; /* the next one is within a step that the run has taken, which the caller writes */
    double scale[DIFFERENCES_GROUPS]; /* the largest number of each group so far */
    double most[DIFFERENCES_GROUPS];  /* the largest |run - companion| of each group so far */
    differences_size_of growing[DIFFERENCES_GROUPS];
    double distance; /* the largest |run - companion| / scale so far, of groups that have a size of their own */
    double first;    /* the distance when 1/32 of the run was done */
    bool first_known;
    double until; /* the first time with a distance at which no digit is significant; NaN: none */
    differences_growth growth;
} differences;

/* Where a companion lands in a run of so many steps of one size, after it has landed at step `landed`; which may be
 * past the end. Where steps adapt it lands after every step. */
int64_t differences_due(int64_t total, int64_t landed);
/* How many steps of one size it takes while the run takes n; of adaptive steps it takes the two halves of each. */
static inline int64_t differences_steps(int64_t n) { return 2 * n + 1; }
#define DIFFERENCES_ANY_ERROR 1e300 /* an absolute tolerance by which error control accepts every step */

/* How many doubles of memory they need; they are used where they lie. */
size_t differences_size(const differences_shape *);
void differences_place(differences *, const differences_shape *, double *memory);
/* A leg begins that goes from start to until. */
void differences_begin(differences *, double start, double until);
/* Compares what the caller has written to values[0] and [1], at t, and [2] where the twin is there. observed: this is
 * an observation, so it enters what is reduced. */
void differences_take(differences *, double t, bool observed, bool twin);
/* What was seen last of the companion in values[1] was replaced by what the run may be as well. */
void differences_widen(differences *);
/* The bar of a number at the last landing; 0: it is exact; INFINITY: no digit of it is significant. */
double differences_bar(const differences *, size_t number);
/* Whether no velocity can have moved a place by more than that part of the largest: the motion rests. */
bool differences_still(const differences *, double part);
/* Whether run and companion have had the same number of late, so that nothing is known to move it. */
bool differences_agree(const differences *, size_t number);
/* A bound on the bars that any number of the state had so far, relative to the largest number of its group or in its
 * own units. INFINITY: of some no digit was significant. unknown: what neither run nor companion knows counts. */
double differences_worst(const differences *, bool absolute, bool unknown);
/* How many numbers tell what was seen so far; writes them, all finite, or returns false: it cannot be told. And goes on
 * from them at t, after differences_begin; the bars are those that it had. */
size_t differences_kept(const differences_shape *);
bool differences_keep(const differences *, double *out);
void differences_resume(differences *, double t, const double *kept);
double differences_ratio(const differences *); /* by how much the distance has grown */
/* The rate at which the distance grows, where it grows as an exponential; else NaN. */
double differences_rate(const differences *);

#endif
