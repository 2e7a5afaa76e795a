/* Ctrl-C and other signals that stop the program, and the progress line of long work. */
#ifndef CLI_FILES_STOP_H
#define CLI_FILES_STOP_H

#include <stdbool.h>

/* Catches SIGINT, SIGTERM, SIGHUP and SIGUSR1: they make stop_requested() true, and kill only if it is not called
 * within 0.15 s. Call this before work that calls stop_requested(); until then, while a model is read, they kill. */
void stop_catch_signals(void);
/* Ignores SIGXFSZ: a write beyond the largest size that a file may have then fails, and does not kill. */
void stop_file_limit(void);
bool stop_requested(void);
int stop_asked(void *); /* returns stop_requested(), as a hook of archives; its argument is unused */
/* Makes SIGTERM and SIGUSR1, by which batch systems warn, set stop_warned() in place of stop_requested(): the program
 * finishes the present block and ends. SIGTERM leaves it less than half a second: then the progress hook asks for an
 * end, or, if a process that is `alone` does not call the hook, the clock raises the signal. A second signal kills. */
void stop_gently(bool alone);
bool stop_warned(void);
void stop_reader_gone(void); /* requests a stop as by SIGPIPE, when the reader of standard output has closed it */
/* Raises the signal of a requested stop again, with the default action, so that the parent process learns of it. Call
 * it when everything is cleaned up. */
void stop_obey(void);

/* The progress of long work on standard error: one line that is renewed on a terminal, or a line a minute in a log. */
typedef struct stop_progress {
    const char *what;
    double began, shown;  /* seconds; shown 0: nothing was shown yet */
    bool terminal, tells; /* tells false: nothing is shown */
    /* Work in parts: the present part is the share `span` of all the work, and begins at `from`; an earlier command did
     * the share `before`. span 0: the work has one part. */
    double from, span, before;
    const char *unit;          /* NULL, or a bar and the rate in this unit are shown too */
    double amount;             /* all the work, in units */
    void (*meanwhile)(void *); /* NULL, or called whenever the hook is */
    void *with;                /* the argument of `meanwhile` */
} stop_progress;
stop_progress stop_progress_begin(const char *what, bool quiet);
/* Shows the progress of the present part; a hook of the library. `context` is a stop_progress. Returns whether to
 * stop. */
int stop_progress_hook(void *context, double fraction);
/* While `held`, makes the hook return 0, since the present work must not be left halfway. */
void stop_hold(bool held);
/* While the work `keeps` a state, gives it 2 s after a signal to write the state. */
void stop_keep(bool keeps);
void stop_progress_end(stop_progress *);

double stop_clock(void); /* returns the seconds of a monotonic clock */

#endif
