/* The verbs of the program. */
#ifndef CLI_VERBS_H
#define CLI_VERBS_H

#include "cli/options.h"

/* run_verb, sweep_verb … */
#define VERB(bit, name, ...) motus_status name##_verb(const options *, motus_error *);
#include "cli/options.def"

#endif
