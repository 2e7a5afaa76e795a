/* The step and the end of a model that gives none. See motus_suggest. */
#ifndef API_SEARCH_SUGGEST_H
#define API_SEARCH_SUGGEST_H

#include "api/request/request.h"

/* Fills in the step, where its row needs one, and the end that a request lacks, but of a callback. */
motus_status suggest_missing(motus_system *, request *, motus_error *);

/* By how many powers of ten steps of the settings, which have all numbers, grow up to the end where the motion swings
 * or decays; of a method that adapts its steps 0. */
motus_status suggest_growth(motus_system *, const motus_settings *, double *powers, motus_error *);

#endif
