/* "auto": pilot runs choose the method of a run. */
#ifndef API_SEARCH_PILOT_H
#define API_SEARCH_PILOT_H

#include "api/motion/run.h"

#define PILOT_FIRST "dop853" /* it admits every force, and chooses its steps */
enum { PILOT_CANDIDATES = 4 };

typedef struct pilot {
    const char *names[PILOT_CANDIDATES]; /* that came through, by what they need: the first was chosen */
    size_t count;
    char why[256]; /* one sentence */
    double steps;  /* about so many will the run take up to its end */
} pilot;

/* Which method needs the fewest operations for the run of this definition, whose end and tolerance are known. Fails as
 * the first method of the list does where none of them gets through. */
motus_status pilot_choose(motus_system *, const motus_run_def *, pilot *, motus_error *);
/* What a run has taken so far, in operations; order: of its Taylor series, 0: it is another method. */
double pilot_work(const motus_run *, const weight *, int order);

#endif
