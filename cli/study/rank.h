/* motus compare --accuracies. */
#ifndef CLI_STUDY_RANK_H
#define CLI_STUDY_RANK_H

#include "cli/words/options.h"

motus_status rank_verb(const options *, motus_error *);

#endif
