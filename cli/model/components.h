/* --set of one component: "r.x(0)=5", "r'.y(0)=1", "r[3].x(0)=2", "g.x=9.81". */
#ifndef CLI_MODEL_COMPONENTS_H
#define CLI_MODEL_COMPONENTS_H

#include "cli/words/options.h"

/* Whether an item of --set names a component. The text of a model gives a vector as a whole, so the library's `set`
 * does not take one. */
bool components_are(const char *item);
/* Sets those items that name one, in a system that was read with the others. */
motus_status components_set(motus_system *, const options_list *set, motus_error *);

#endif
