/* What the errors of a finished run rest on, in words. */
#ifndef CLI_RUN_ANSWER_H
#define CLI_RUN_ANSWER_H

#include "cli/run/summary.h"

void answer_print(const summary *, FILE *);
/* Why "auto" chose its method; nothing where it did not. */
void answer_choice(const summary *, FILE *);

#endif
