/* From when on a followed motion is where it ends, by samples of its numbers. */
#ifndef API_SEARCH_SETTLED_H
#define API_SEARCH_SETTLED_H

#include <stddef.h>

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

#endif
