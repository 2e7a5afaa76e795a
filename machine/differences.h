/* The differences between a run and its companions in every number that is reported, and the bars that follow from
 * them. */
#ifndef MACHINE_DIFFERENCES_H
#define MACHINE_DIFFERENCES_H

#include "core/system.h"

/* Sums for straight lines through the points (t, y) and (ln t, y). */
typedef struct differences_growth {
    double n, t, tt, l, ll, y, yy, ty, ly;
    double next; /* the time after the start from which another point may be added */
} differences_growth;

enum { DIFFERENCES_GROUPS = 3 };   /* positions, velocities, first-order variables */
enum { DIFFERENCES_SEEN_MAX = 3 }; /* the run, its companion, a twin of the run */

/* How large a group of numbers was at the time `since`, shortly before, and when it last grew by a large factor. */
typedef struct differences_size_of {
    double size, since, grew;
} differences_size_of;

/* Which numbers are compared: the time, the state, and others. */
typedef struct differences_shape {
    size_t count, positions, velocities; /* all numbers; of the state; velocities and first-order variables */
    /* the reduction of each number over the observations, REDUCE_ of machine/text/reduce.h; NULL: the last values */
    const int *how;
    bool full, kinked, slow; /* there is a twin; the force is not smooth; the method is of order 1 */
} differences_shape;

typedef struct differences {
    differences_shape shape;
    double start, length;
    /* What the caller saw last of the run, its companion and its twin (NULL: there is none), and writes here. The bars
     * belong to values[0]; a number that is reduced is replaced by its reduction. */
    double *values[DIFFERENCES_SEEN_MAX];
    double *kept[DIFFERENCES_SEEN_MAX]; /* REDUCE_KEPT numbers for each; NULL: none is reduced */
    int64_t observations;
    /* d: |run - companion| at the last landing. envelope and twin (NULL: no twin): the largest |run - companion| and
     * |run - twin| in each of the last `slots` parts of the run, where part `part` has row part % slots. */
    double *d, *envelope, *twin;
    int slots;
    int64_t part;
    double *size;         /* the largest size of each number, of run or companion, at any landing */
    double *now, *before; /* the largest size at the last landing, and at the landing before */
    double *last;         /* |run - companion| at the landing before, or within the last step */
    double *apart;        /* an error of each number that run and companion share, which the caller writes; first 0 */
    double taken;         /* the time of the last landing */
    bool between;         /* the next landing lies within a step that the run has taken; the caller says so */
    double scale[DIFFERENCES_GROUPS]; /* the largest number of each group so far */
    double most[DIFFERENCES_GROUPS];  /* the largest |run - companion| of each group so far */
    differences_size_of growing[DIFFERENCES_GROUPS];
    double distance; /* the largest |run - companion| / scale so far, of groups that have a size of their own */
    double first;    /* the distance when 1/32 of the run was done */
    bool first_known;
    double until; /* the first time with a distance at which no digit is significant; NaN: none */
    differences_growth growth;
} differences;

/* Returns the step at which a companion lands after step `landed`, in a run of `total` fixed steps; it may be past the
 * end. With adaptive steps a companion lands after every step. */
int64_t differences_due(int64_t total, int64_t landed);
/* Returns how many fixed steps the half takes while the run takes n. For an adaptive step it takes two halves. */
static inline int64_t differences_steps(int64_t n) { return 2 * n + 1; }
#define DIFFERENCES_ANY_ERROR 1e300 /* an absolute tolerance by which error control accepts every step */

/* Returns how many doubles of memory the arrays need. */
size_t differences_size(const differences_shape *);
/* Makes the struct, with its arrays in `memory`. */
void differences_place(differences *, const differences_shape *, double *memory);
void differences_begin(differences *, double start, double until);
/* Compares, at time t, the numbers that the caller has written to values[0], values[1] and, with `twin`, values[2].
 * observed: this is an observation, which enters the reductions. */
void differences_take(differences *, double t, bool observed, bool twin);
/* Widens the differences, after the caller has replaced values[1] by other numbers that the run might have had. */
void differences_widen(differences *);
/* Returns the bar of a number at the last landing; 0: it is exact; INFINITY: no digit is significant. */
double differences_bar(const differences *, size_t number);
/* Tells whether the motion rests: no velocity can have moved a position by more than this part of the largest one. */
bool differences_still(const differences *, double part);
/* Tells whether run and companion have lately had equal values of a number, so nothing is known to move it. */
bool differences_agree(const differences *, size_t number);
/* Bounds the bars of all numbers of the state so far: absolute, or relative to the largest number of the group.
 * INFINITY: a number had no significant digit. unknown: counts `apart` too. */
double differences_worst(const differences *, bool absolute, bool unknown);
/* Returns how many numbers keep what was seen so far. */
size_t differences_kept(const differences_shape *);
/* Writes these numbers, all finite. False: one is not. */
bool differences_keep(const differences *, double *out);
/* Goes on at time t from these numbers, after differences_begin, with the bars that were kept. */
void differences_resume(differences *, double t, const double *kept);
double differences_ratio(const differences *); /* the factor by which the distance has grown */
/* Returns the rate at which the distance grows, if it grows as an exponential; else NaN. */
double differences_rate(const differences *);

#endif
