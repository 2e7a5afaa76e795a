/* The step and the end of a model that gives none. See motus_suggest. */
#ifndef API_SEARCH_SUGGEST_H
#define API_SEARCH_SUGGEST_H

#include "core/methods.h"

/* Fills in *step and *until where they are NaN and the model, which is not a callback, has none. start: NaN: the
 * model's. */
motus_status suggest_missing(motus_system *, const chosen *, const char *method, double start, double *step,
                             double *until, motus_error *);

/* By how many powers of ten steps of the settings, which have all numbers, grow up to the end where the motion swings
 * or decays; of a method that adapts its steps 0. */
motus_status suggest_growth(motus_system *, const motus_settings *, double *powers, motus_error *);

#endif
