/* The swings of one number, from its changes of sign. Begins with all bytes 0. */
#ifndef API_SEARCH_SWINGS_H
#define API_SEARCH_SWINGS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct swings {
    double largest, time, value;    /* the last value that was not negligible */
    double first, before, last;     /* changes of sign */
    double shortest, longest;       /* from one change of sign to the next but one */
    uint32_t changes, since, steps; /* steps before the first change, and from there to the last */
} swings;

/* Notes the number's value at a time, after so many steps. */
void swings_note(swings *, double time, uint32_t taken, double value);
/* Returns the mean time from a change of sign to the next but one; 0: the number does not swing. */
double swings_length(const swings *);
/* Returns whether the number has swung so often that its swings are known, or was 0 throughout. */
bool swings_often(const swings *);
/* Returns whether its longest swing is clearly longer than its shortest. */
bool swings_uneven(const swings *);

#endif
