/* The truth about a random motion: its states and the times of its events by extrapolated midpoint steps (Gragg) of 113
 * bits, which end at every switch, hold what slides, and step through every layer that the model declares.
 */
#ifndef TEST_MOTION_TRUTH_H
#define TEST_MOTION_TRUTH_H

#include "test/motion.h"

enum { MOTION_TRUTH_TIMES = 16, MOTION_TRUTH_EVENTS = 128 };

typedef struct motion_truth {
    quad y[MOTION_TRUTH_TIMES][2 * MOTION_VARIABLES]; /* places, then speeds along the run; natural units */
    quad event_time[MOTION_TRUTH_EVENTS];
    int event_kind[MOTION_TRUTH_EVENTS], events;
    long switched, held; /* how often a switch changed its side, and how often it was held */
} motion_truth;

/* At `count` rising times since the start, in natural units. coarse: with other steps and larger errors, so that two
 * truths agree where they are true. NULL, or why there is no truth. */
const char *motion_truth_find(const motion *, const quad *times, int count, bool coarse, motion_truth *);

#endif
