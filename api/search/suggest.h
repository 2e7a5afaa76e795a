/* The step and the end of a model that gives none, for motus_suggest and for runs. */
#ifndef API_SEARCH_SUGGEST_H
#define API_SEARCH_SUGGEST_H

#include "api/request/request.h"

/* Returns whether the row of a request needs a step that nobody gives. */
bool suggest_lacks_step(const motus_system *, const request *);
/* Fills in the end that a request lacks, and the step if its row needs one; of a callback neither. */
motus_status suggest_missing(motus_system *, request *, motus_error *);

/* Finds by how many powers of ten steps of the settings grow up to the end, where the motion swings or decays; 0 for a
 * method that adapts its steps. */
motus_status suggest_growth(motus_system *, const motus_settings *, double *powers, motus_error *);

#endif
