/* The step and the end of a draft that gives none. See motus_suggest. */
#ifndef API_SEARCH_DRAFT_H
#define API_SEARCH_DRAFT_H

#include "api/system/system.h"

typedef struct draft_scales {
    double rate, period;   /* as in motus_settings; where the rate is 0, the period is the length of the run */
    bool lands;            /* where the force is constant: it ends at 0, */
    size_t falling;        /*   the number that does */
    bool turns;            /* the period is one: it is no scale of what grows or decays */
    double from, duration; /* duration: 0: not given */
    bool uniform;          /* all steps are equal */
    double way;            /* 1, or -1 backward; draft_choose fills it in */
    double stable;         /* no step that is chosen is longer */
} draft_scales;

/* Fills in step and until where they are NaN, and why. */
motus_status draft_choose(motus_system *, draft_scales *, motus_settings *, motus_error *);

#endif
