/* The verbs of the program. */
#ifndef CLI_VERBS_H
#define CLI_VERBS_H

#include "cli/options.h"

motus_status run_verb(const options *, motus_error *);
motus_status compare_verb(const options *, motus_error *);
motus_status converge_verb(const options *, motus_error *);
motus_status check_verb(const options *, motus_error *);
motus_status methods_verb(const options *, motus_error *);
motus_status sweep_verb(const options *, motus_error *);
motus_status merge_verb(const options *, motus_error *);
motus_status archive_verb(const options *, motus_error *);
motus_status cache_verb(const options *, motus_error *);
motus_status lab_verb(const options *, motus_error *);

#endif
