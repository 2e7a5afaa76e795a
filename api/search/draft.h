/* A draft, a model that is being written: its motion is followed, and tells the step and the end that the model does
 * not give. See motus_suggest. */
#ifndef API_SEARCH_DRAFT_H
#define API_SEARCH_DRAFT_H

#include "api/system/system.h"

#include <stdbool.h>
#include <stdint.h>
#include <stddef.h>

/* ---- swings.c: the swings of one number, from its changes of sign; begins with all bytes 0 ---- */

typedef struct swings {
    double largest, time, value;    /* the last value that was not negligible */
    double first, before, last;     /* changes of sign */
    double shortest, longest;       /* from one change of sign to the next but one */
    uint32_t changes, since, steps; /* steps before the first change, and from there to the last */
} swings;

/* Notes the number's value at a time. taken: the steps before. */
void swings_note(swings *, double time, uint32_t taken, double value);
/* Returns the mean time from a change of sign to the next but one; 0: the number does not swing. */
double swings_length(const swings *);
/* Returns whether the number has swung so often that its swings are known, or was 0 throughout. */
bool swings_often(const swings *);
/* Returns whether its longest swing is clearly longer than its shortest. */
bool swings_uneven(const swings *);

/* ---- settled.c: from when on a followed motion is where it ends, by samples of its numbers ---- */

enum { SETTLED_SAMPLES = 1024 };

typedef struct settled {
    double *times, *values; /* room for `room` samples */
    size_t numbers, room, count;
    double first; /* the time of the first sample after the start */
} settled;

/* Notes positions and then first-order variables, where the last sample is old enough. */
void settled_note(settled *, double time, const double *x, size_t nx, const double *s);
/* Returns the time since which every number is within a hundredth of its range of where it is at `time`, the end. 0:
 * the motion was followed for less than three times as long, or nothing moves. */
double settled_since(const settled *, double time, const double *x, size_t nx, const double *s);

/* ---- follow.c: the motion of a draft from its start on: what swings, settles, falls, runs away ---- */

typedef enum follow_end {
    FOLLOW_GOES_ON,
    FOLLOW_INFINITE,  /* a position or first-order variable becomes infinite */
    FOLLOW_SINGULAR,  /* a velocity or the force becomes infinite */
    FOLLOW_UNDEFINED, /* the force has no value beyond */
} follow_end;

typedef struct followed {
    bool rests;               /* the start is an equilibrium, and nothing was followed */
    double shortest, longest; /* periods, from a turning point to the next but one; 0: nothing swings */
    size_t fastest, slowest;  /* the numbers of v with these periods */
    bool irregular;           /* the periods of a number differ, and these are means */
    double change;  /* the shortest time in which the motion changes as a harmonic one does in 1/15 of its period */
    double grown;   /* how long until it has grown FOLLOW_GROWTH times; 0: it does not */
    double since;   /* `grown` is from its size at this time after the start */
    double landed;  /* how long until the number `falling` is 0; 0: it never is */
    size_t falling; /* the number with the largest force */
    double settled; /* how long until it stays within 1 % of where it ends; 0: it does not */
    double elapsed; /* how long it was followed */
    bool cut;       /* it was followed to the limit of the draft */
    double step;    /* the mean of its last steps */
    double fast;    /* the largest rate at which positions move; 0: not known */
    follow_end end;
    double bound; /* how long until `end` */
} followed;

enum { FOLLOW_GROWTH = 20 };

/* Follows the motion for at most the time `horizon`, as far as the draft allows; a fall is followed to its end. rate:
 * the fastest at the start, > 0. way: 1, or -1 backward. False: no memory. */
bool follow_motion(motus_system *, double from, double way, double rate, double horizon, followed *);

/* ---- draft.c: the step and the end ---- */

typedef struct draft_scales {
    double rate, period; /* as in motus_settings; where the rate is 0, the period is the length of the run */
    bool lands;          /* the force is constant, and number `falling` ends at 0 */
    size_t falling;
    bool turns;            /* something oscillates with the period; else it is a scale of growth or decay */
    double from, duration; /* duration: 0 where no end is given */
    bool uniform;          /* all steps are equal */
    double way;            /* 1, or -1 backward; set by draft_choose */
    double stable;         /* the longest step that may be chosen */
} draft_scales;

/* Fills in the step and the end where they are NaN, with the reasons. */
motus_status draft_choose(motus_system *, draft_scales *, motus_settings *, motus_error *);

#endif
