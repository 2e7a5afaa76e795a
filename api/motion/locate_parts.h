/* What the files of located steps share: the run's places and sides, and the functions of each file.
 *
 * Invariant: `from` is a state of the trajectory, and `side` are the sides after it.
 */
#ifndef API_MOTION_LOCATE_PARTS_H
#define API_MOTION_LOCATE_PARTS_H

#include "api/motion/locate.h"
#include "machine/held.h"

enum {
    LOCATE_STILL_MAX = 64, /* sides that may change one after the other while time hardly moves */
    LOCATE_HALVINGS_MAX = 200
};

typedef struct place {
    double t;
    double *x, *v, *a, *u;
} place;

struct locate {
    held *held;
    problem problem;
    size_t count;
    double *side, *old_side, *rate[2];
    double *slack; /* of each argument that was left just before its root: how far it may still be on the other side */
    double *size;
    place from, to, beyond; /* ends of a piece, and a trial state between */
    place start;            /* of the step */
    place twice;            /* the end of two half pieces */
    place found;            /* a state within the step at which an argument has left its side */
    interval *box;          /* nx positions, nv velocities, nv accelerations */
    interval *reach;        /* of the arguments, then of their rates */
    bool resolves;          /* pieces must resolve the force */
    double next;            /* the size of the next piece to try; INFINITY: all that is left of the step */
    size_t touches;         /* how many touches pieces must end at */
    /* the arguments of touches at both ends of a step, and their rates */
    double *touch[2], *touch_rate[2], *room;
    double *start_side;
    bool known;    /* `from` is the stepper's state */
    bool away;     /* the stepper was used for trials, and is not on the run's leg */
    int64_t steps; /* of the leg, before the stepper's own count began */
    int64_t located;
    double jump; /* the lowest power with which the force departed from a smooth one (jump.h); NaN: none */
    double jump_time;
    /* the sum of what the rounding of times may have changed a velocity by, where the force changes fast */
    double rounding;
};

/* locate_place.c: states, trial steps, roots */
size_t locate_numbers(const problem *, size_t count); /* of a place with `count` switches */
void locate_copy(place *to, const place *from, const problem *, size_t count);
void locate_swap(place *, place *);
/* Reads the stepper's state and the arguments of all switches there. */
motus_status locate_observe(motus_run *, place *at, motus_error *);
/* Computes the acceleration of a place, on the sides that are bound. False: it cannot. */
bool locate_accelerate(const locate *, place *at);
/* Takes a trial step of size h from `from` to `to`. */
motus_status locate_try(motus_run *, const place *from, double h, place *to, motus_error *);
double locate_gap(const locate *, size_t k, const place *at);
/* Returns the least gap of all arguments, in units of `size`; below 0: an argument has left its side. */
double locate_least_gap(const locate *, const place *at, const double *size);
/* Computes the state at the time `way` from `at`, by Taylor's formula. */
void locate_follow(const problem *, const place *at, double way, double *x, double *v);
motus_status locate_root(motus_run *, double *h, bool *failed, motus_error *);

/* locate_piece.c: a step in pieces */
bool locate_sure(const locate *, const place *from, const place *to);
motus_status locate_pieces(motus_run *, double end, motus_error *);

/* locate_jump.c: how the force jumps */
double locate_leap(const locate *);
void locate_note(motus_run *, const place *at, double h);
motus_status locate_touch(motus_run *, double h, double *fraction, motus_error *);

#endif
