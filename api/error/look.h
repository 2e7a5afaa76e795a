/* Looks at a step of a run for its witness: holds the motion within the step against the force as it is typed. The
 * witness judges what is found (witness.c). */
#ifndef API_ERROR_LOOK_H
#define API_ERROR_LOOK_H

#include "api/error/witness.h"

enum {
    DEPTH = 40, /* most halvings of a step */
    WAYS = 32,  /* ways at first, and how many more are tried to find one that leads nearer */
    MORE = 64,  /* most ways beyond the first */
    AHEAD = 256 /* most steps ahead of which the force is looked at */
};
#define FIRST 0.01   /* times what a step may lose: the next step is to end at the first part that lacks this much */
#define REFUSED 30.0 /* times what a step may lose, between the step and the probe */
#define ROUNDING 0x1p-46
#define NOTHING 0x1p-500 /* least of what a number at rest may lose */
/* Times the largest error of the run so far. Where steps always stand, what is missing from later ones may cancel what
 * was missing from one, so there a small part of that error moves the companion. */
#define BARS 2.5

typedef struct state { /* of the run, in the inside order */
    double t, *x, *v;
} state;

enum { FROM, TO, MIDDLE, POINT = MIDDLE + DEPTH, END, LAST, STATES };

struct witness {
    const motus_system *typed;
    machine machine; /* of the probe */
    chosen method;   /* of the probe: the run's, or PROBE if `steady` */
    bool steady;     /* the run's steps stand as they are */
    motus_allocator allocator;
    const differences *differences;
    size_t nx, nv;     /* of the run */
    size_t own, other; /* the typed system has the run's first `own` velocities, and those from `other` on */
    resolution *bends; /* what in the force can hide between points */
    state at[STATES];
    double *a, *v;     /* the typed force, and velocities in the order it wants */
    double *most;      /* bounds on the accelerations of the step */
    double *missing;   /* of every velocity: what is missing, sizes added up over the parts */
    double *lack;      /* of every velocity: what is missing, added up with signs */
    double *speed;     /* of every velocity, with the others of its variable: the largest size in the step */
    double *felt;      /* of every velocity: what was missing in a step where it rested */
    double *allowed;   /* of every velocity: what a step may lose */
    double *rounded;   /* of every velocity: what rounding takes, a part of the largest it has been */
    double *rounded_x; /* of every position: what rounding takes, a part of the largest it has been */
    double *driven;    /* of every typed velocity: 1 if a boundary line writes it */
    double *dx, *dv;   /* the distance of the probe from the step */
    double share[WAYS + MORE];
    /* of a run with located switches: what the force does along each way, less what has happened */
    double *ways, *room;
    double *scale;      /* the largest accelerations */
    double *weight;     /* 1 over how far off each velocity may be */
    double *other_way;  /* one more way */
    resolution *smooth; /* what can hide in the force where its switches keep their sides; NULL: nothing */
    interval *in_x, *in_v;
    interval *clear_x, *clear_v; /* a box in which the force hides nothing, for any step */
    double operations;           /* of one evaluation */
    double first;                /* evaluations that may be spent in any case */
    double most_spared;          /* evaluations that may be spent where the run hides something */
    bool kinked;                 /* the typed force has switches */
    bool located;                /* steps of the run end at switches */
    bool covered;                /* some switches are within sums, where nothing says that they stand at 0 */
    bool probes;                 /* this witness looks at a probe, and refuses at once */
    bool events;                 /* the run has events */
    bool leaves;                 /* it leaves the companion as it is */
    stepper *probe;
    struct witness *inner; /* looks at the probe */
    /* The members from here on are of the present motion. */
    int parts, tries;
    double worst, start,
        length;            /* the most that is missing from a part, in units of what is allowed; the first such part */
    double sides;          /* spent on sides of switches */
    double most_spent;     /* limit on `spent` for the present step */
    double earned, spent;  /* evaluations that it may spend so far, and has spent */
    int64_t evaluations;   /* of the run, so far */
    double longest;        /* of the steps that it has looked at */
    double least;          /* what matters to the bars, of a velocity; INFINITY: only what a step may lose matters */
    double sees;           /* `least` of the probe's own witness */
    bool far;              /* so much is missing that no probe need confirm it */
    double each;           /* what it earns in a step */
    int64_t steps;         /* steps of the run that stand, as far as it was shown them */
    int64_t looked;        /* how many of `steps` it has looked at */
    int64_t rested, rest;  /* steps to skip after the last look, and how many of them are to come */
    interval clear;        /* the times of clear_x, clear_v; empty: there is no such box */
    double ahead;          /* how many steps ahead the force is looked at */
    int vain;              /* steps before it is looked at ahead again */
    double spared;         /* evaluations that are not counted */
    bool peaks;            /* the force has narrow peaks */
    double empty[2];       /* times between which nothing is missing, as an earlier step has shown */
    double peak, peak_end; /* times between which much is missing, as an earlier step has shown; NaN */
    bool strict;           /* sides of switches are looked at */
    bool crosses;          /* a switch may stand at 0 within the step */
    bool counted, whole;   /* counted: parts before such a switch were held; whole: parts after it count as well */
    bool first_only;       /* the look ends after the first parts from which too much is missing */
    bool ended;            /* the look has ended so */
    double behind_first;
    double clean;      /* up to this time nothing is missing */
    bool exhausted;    /* the look could not afford to tell what hides in some part */
    double past;       /* the beginning of the first part with a switch at 0, after others; NaN */
    bool beside;       /* no way beside the part at `start` does what has happened */
    int behind;        /* steps to come after one that lacked something, which the companion may not have passed */
    bool open;         /* what is missing from the step after `past` is not known */
    bool moves, leads; /* the companion is to be moved by dx and dv, or (leads) by a probe that takes its step */
    bool objected;     /* it has objected to a step of the run */
    bool left;         /* dx and dv are known, and the companion is left as it is */
    bool failed;       /* the last probe failed by an error of its own */
    size_t number;     /* the velocity from which the most was missing where `beside` became true */
    bool held;         /* from `differs` on the motion is not one of the typed force */
    double until;      /* the end of a step from which a probe has differed; NaN */
    double differs;
    double unseen; /* from this time on it could not afford to look, after steps had to be refused; NaN */
};

/* Reads the state at t between the ends of a step. */
bool look_see(stepper *, double t, state *);
/* Returns the place among the run's velocities of velocity k of the typed system, which has no sides of switches. */
static inline size_t look_place(const witness *w, size_t k) { return k < w->own ? k : k - w->own + w->other; }
/* Returns whether nothing of these bends hides in a part of a step. NULL: nothing can. */
bool look_fits(witness *, resolution *bends, const state *from, const state *to);
/* Returns a number in [-1, 1) from those of a way and a variable. */
double look_turn(uint32_t way, size_t k);
/* Returns how much a step of size h may lose of position k, whose value is x. */
double look_lost(const witness *, size_t k, double x, double h);
/* Computes what the force does along a way, less what has happened. False: sampling or the force fails. */
bool look_follow(witness *, stepper *, const state *from, const state *to, uint32_t way, double *less);
/* Bounds the accelerations of the marked step. False: sampling or the force fails. */
bool look_bound(witness *, stepper *);
/* Return whether more is missing than `times` times the errors that the companion has shown. */
bool look_beyond_velocities(const witness *, const double *missing, double times);
bool look_beyond_places(const witness *, const double *missing, double times);
/* Returns whether too much is missing from a step, and finds `sees` and `far`. */
bool look_suspects(witness *);
/* Returns whether something is missing from velocity k although it rests. */
bool look_stirs(const witness *, size_t k);
/* Adds up what is missing from a part of a step, made by `depth` halvings. False: sampling or the force fails. */
bool look_at(witness *, stepper *, const state *from, const state *to, int depth);

#endif
