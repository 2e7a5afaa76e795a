/* Opens a page in the user's browser. */
#ifndef CLI_FILES_BROWSER_H
#define CLI_FILES_BROWSER_H

#include <stdbool.h>

/* Starts $BROWSER, else the system's program for opening addresses, without waiting for it or showing its output.
 * False: none could be started. */
bool browser_open(const char *url);

#endif
