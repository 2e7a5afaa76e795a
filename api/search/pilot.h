/* "auto": pilot runs choose the method of a run. */
#ifndef API_SEARCH_PILOT_H
#define API_SEARCH_PILOT_H

#include "api/motion/run.h"

#define PILOT_FIRST "dop853" /* admits every force, and adapts its steps */
enum { PILOT_CANDIDATES = 4 };

typedef struct pilot {
    /* the methods that came through, by the operations they need: the first is chosen */
    const char *names[PILOT_CANDIDATES];
    size_t count;
    char why[256]; /* the reason, in one sentence */
    double steps;  /* about how many the run will take up to its end */
} pilot;

/* Finds the method that needs the fewest operations for a definition with an end and a tolerance. Where no method comes
 * through, fails as the first of the list does. */
motus_status pilot_choose(motus_system *, const motus_run_def *, pilot *, motus_error *);
/* Returns what a run has taken so far, in operations. order: of its Taylor series; 0: another method. */
double pilot_work(const motus_run *, const weight *, int order);

#endif
