/* Ctrl-C and other signals that stop the program, and the progress line of long work. */
#ifndef CLI_FILES_STOP_H
#define CLI_FILES_STOP_H

#include <stdbool.h>

/* From now on SIGINT, SIGTERM, SIGHUP and SIGUSR1 set stop_requested() and do not kill, unless nobody asks for it
 * within 0.15 s. To be called where work begins that asks for it; before, while a model is read, they kill. */
void stop_catch_signals(void);
/* From now on a write beyond the largest size that a file may have (SIGXFSZ) fails and does not kill. */
void stop_file_limit(void);
bool stop_requested(void);
int stop_asked(void *); /* the same, as a hook of archives; NULL */
/* From now on SIGTERM and SIGUSR1, by which batch systems warn, do not stop at once: stop_warned() tells of them, and
 * the program ends when what it has in hand is done; after SIGTERM within half a second, done or not: then the progress
 * hook asks for an end, and where nobody asks the hook, of a process that works alone, the clock raises the signal. A
 * second one kills. */
void stop_gently(bool alone);
bool stop_warned(void);
void stop_reader_gone(void); /* standard output was closed by its reader: request a stop as if by SIGPIPE */
/* If a stop was requested, raises its signal again with the default action, so that the parent process learns of it.
 * Call when everything is cleaned up. */
void stop_obey(void);

/* The progress of long work on standard error: one line that is renewed, on a terminal; elsewhere, as in the log of a
 * batch job, a line a minute. */
typedef struct stop_progress {
    const char *what;
    double began, shown;  /* seconds; shown 0: not yet */
    bool terminal, tells; /* tells: anything at all */
    /* Work in parts: the hook's fraction is of the present part, which goes from `from` to `from` + `span` of all the
     * work; `before` of it was done by an earlier command. span 0: one part. */
    double from, span, before;
    const char *unit;          /* with a unit, a bar and the rate are shown, too */
    double amount;             /* of the unit: all the work */
    void (*meanwhile)(void *); /* NULL, or called with `with` whenever the hook is */
    void *with;
} stop_progress;
stop_progress stop_progress_begin(const char *what, bool quiet);
/* The library's progress hook: context is a stop_progress; not 0 if a stop was requested. */
int stop_progress_hook(void *context, double fraction);
/* While `held`, the hook does not tell of a stop: what is done now must not be left halfway. */
void stop_hold(bool held);
/* While the work `keeps` a state, from which it goes on, it has 2 s after a signal to write one. */
void stop_keep(bool keeps);
void stop_progress_end(stop_progress *);

double stop_clock(void); /* seconds of a monotonic clock */

#endif
