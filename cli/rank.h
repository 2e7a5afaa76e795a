/* motus compare --accuracies. */
#ifndef CLI_RANK_H
#define CLI_RANK_H

#include "cli/options.h"

motus_status rank_verb(const options *, motus_error *);

#endif
