/* The swings of one number, from its changes of sign. Zeroed, it has seen nothing. */
#ifndef API_SEARCH_SWINGS_H
#define API_SEARCH_SWINGS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct swings {
    double largest, time, value;    /* the last value that was not negligible */
    double first, before, last;     /* changes of sign */
    double shortest, longest;       /* from one to the next but one */
    uint32_t changes, since, steps; /* since: steps taken before the first; steps: from there to the last */
} swings;

/* Notes the number at a time, after so many steps. */
void swings_note(swings *, double time, uint32_t taken, double value);
/* The mean time from a change of sign to the next but one; 0: it does not swing. */
double swings_length(const swings *);
/* It has swung so often that its swings are known, or it was 0 throughout. */
bool swings_often(const swings *);
/* Its longest swing is clearly longer than its shortest. */
bool swings_uneven(const swings *);

#endif
