/* Showing a page in the reader's browser. */
#ifndef CLI_BROWSER_H
#define CLI_BROWSER_H

#include <stdbool.h>

/* Starts $BROWSER, else what the system opens addresses with; neither waits for it nor shows what it says. False:
 * none could be started. */
bool browser_open(const char *url);

#endif
