/* Results as JSON, for the program (--json) and for the page.
 *
 * Each function writes members into an open object. What only the page needs is in lab/core/; what only a verb of the
 * program needs is in its file.
 */
#ifndef TELL_TELL_H
#define TELL_TELL_H

#include "motus.h"
#include "tell/json.h"

void tell_methods(json *, const motus_method *only); /* the catalogue, or one method of it */
void tell_variables(json *, const motus_system *);
void tell_analysis(json *, const motus_system *);
void tell_switches(json *, motus_system *);         /* where the force changes its formula */
void tell_admissions(json *, const motus_system *); /* whether each method admits the model, and if not, why */
void tell_comparison(json *, const motus_comparison *);
void tell_convergence(json *, const motus_convergence *);
void tell_ranking(json *, const motus_ranking *);
void tell_estimate(json *, const motus_estimate *); /* what bars of error rest on */
void tell_event(json *, const motus_event_row *);   /* an event, without its state */
void tell_ended(json *, motus_run *);               /* which event ended a run, and where events accumulate */
void tell_diagnosis(json *, const motus_error *);   /* why a run failed; null: not known, or it did not */
void tell_error(json *, const motus_error *, const char *message); /* message: the error's, with or without its hint */

/* Returns what a force may depend on: "x, t". */
const char *tell_forces(motus_forces);
const char *tell_geometry(motus_geometry); /* "symplectic", "volume", or "" */
/* Returns the reason in the message of a method that does not admit a model, without "METHOD does not admit this model:
 * ". */
const char *tell_reason(const char *message, const char *method);

#endif
