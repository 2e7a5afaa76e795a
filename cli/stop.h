/* Ctrl-C and other requests to stop, and the line of progress that long work shows. */
#ifndef CLI_STOP_H
#define CLI_STOP_H

#include <stdbool.h>

/* From now on the signals ask, they do not kill: to be called where work begins that looks at the answer (the hook
 * below, stop_requested()). Before, while a model is read, they kill as ever. */
void stop_watch(void);
bool stop_requested(void);
void stop_reader_gone(void); /* whoever read standard output went away: to be treated like SIGPIPE */
/* When a signal asked: die of it, as whoever sent it expects. Call after everything is cleaned up; else returns. */
void stop_obey(void);

/* Progress of long work on standard error, when that is a terminal. */
typedef struct stop_progress {
    const char *what;
    double began, shown; /* seconds; shown 0: not yet */
    bool terminal;
    /* Work in parts: the hook's fraction is of a part that begins at `from` and has the length `span` of the whole,
     * of which `before` was done when this began. span 0: one part. With a unit, a bar and the rate are shown:
     * `amount` of it is the whole. */
    double from, span, before, amount;
    const char *unit;
} stop_progress;
stop_progress stop_progress_begin(const char *what, bool quiet);
/* The library's hook: context is a stop_progress; other than 0 when a signal asks to stop. */
int stop_progress_hook(void *context, double fraction);
void stop_progress_end(stop_progress *);

double stop_clock(void); /* seconds of a clock that never jumps */

#endif
