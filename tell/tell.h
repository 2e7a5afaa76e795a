/* What is told of a result, by the program (--json) and to the page: one description of each.
 *
 * Each function writes members of an object that is open. What the page alone wants stands in lab/core/, what the
 * program alone tells with its verb.
 */
#ifndef TELL_TELL_H
#define TELL_TELL_H

#include "motus.h"
#include "tell/json.h"

void tell_methods(json *, const motus_method *only); /* the catalogue; NULL: all of it */
void tell_variables(json *, const motus_system *);
void tell_analysis(json *, const motus_system *);
void tell_admissions(json *, const motus_system *); /* each method, and why not */
void tell_comparison(json *, const motus_comparison *);
void tell_convergence(json *, const motus_convergence *);
void tell_error(json *, const motus_error *, const char *message); /* message: with the hint in it, or without */

/* "x, t": what a force may depend on. */
const char *tell_forces(motus_forces);
/* Why a method does not admit a model, without its name and that it does not, which stand beside it. */
const char *tell_reason(const char *message, const char *method);

#endif
