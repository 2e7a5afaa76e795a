/* The step and the end of a draft, a model that is being written and gives none. See motus_suggest. */
#ifndef API_SEARCH_DRAFT_H
#define API_SEARCH_DRAFT_H

#include "api/system/system.h"

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
