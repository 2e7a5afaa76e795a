/* Signals that stop the program, and progress.
 *
 * Invariant: the handler stores the signal and starts a clock. The work ends at its next call of stop_requested(),
 * temporary files are removed, and the program raises the signal again, so that a shell and its loops stop too. If that
 * call does not come in time, as in a loop without end, the clock raises the signal; files are then as after kill -9,
 * and --resume continues them. A second signal kills at once.
 */
#include "cli/files/stop.h"

#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum { PATIENCE = 150000, PATIENCE_KEEPING = 2000000 }; /* microseconds from the signal on */
#define HURRY 0.2                                       /* seconds that a block has to become complete after SIGTERM */
enum { PATIENCE_BLOCK = 400000 };                       /* microseconds until the clock then raises the signal */

/* The program's globals that change: a signal handler has no other way to report. */
static volatile sig_atomic_t requested, heard;

static volatile sig_atomic_t warned, hurries;
static bool holding, alone; /* alone: no other process waits for this one */
static volatile sig_atomic_t keeping;

static void store(int number)
{
    const struct itimerval once = {
        .it_value = {keeping ? PATIENCE_KEEPING / 1000000 : 0, keeping ? PATIENCE_KEEPING % 1000000 : PATIENCE}};
    requested = number;
    heard = 0;
    setitimer(ITIMER_REAL, &once, NULL);
}

static void warn(int number)
{
    const struct itimerval once = {.it_value = {0, PATIENCE_BLOCK}};
    warned = number;
    if (number != SIGTERM) return;
    hurries = number;
    if (alone) setitimer(ITIMER_REAL, &once, NULL);
}

/* Raises the signal if the work did not ask in time. */
static void end(int number)
{
    const int late = requested ? requested : hurries;
    (void)number;
    if (heard || !late) return;
    signal(late, SIG_DFL);
    raise(late);
}

/* Sets a handler for signals that are not ignored. */
static void handle(const int *signals, size_t count, void (*handler)(int))
{
    struct sigaction action = {0}, before;
    sigemptyset(&action.sa_mask);
    action.sa_handler = handler;
    action.sa_flags = (int)SA_RESETHAND;
    for (size_t i = 0; i < count; i++)
        if (sigaction(signals[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(signals[i], &action, NULL);
}

void stop_gently(bool by_itself)
{
    alone = by_itself;
    static const int warnings[] = {SIGTERM, SIGUSR1};
    handle(warnings, sizeof warnings / sizeof *warnings, warn);
}

void stop_hold(bool held) { holding = held; }
void stop_keep(bool keeps) { keeping = keeps; }

bool stop_warned(void)
{
    if (warned) heard = 1;
    return warned != 0;
}

/* Returns whether the time after SIGTERM in which a block may be completed is over. */
static bool is_over(void)
{
    static double since;
    if (!hurries) return false;
    const double now = stop_clock();
    if (!since) since = now;
    if (now - since < HURRY) return false;
    heard = 1;
    return true;
}

static void ignore(int number)
{
    struct sigaction action = {0};
    sigemptyset(&action.sa_mask);
    action.sa_handler = SIG_IGN;
    sigaction(number, &action, NULL);
}

void stop_file_limit(void) { ignore(SIGXFSZ); }

void stop_catch_signals(void)
{
    static const int caught[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};
    struct sigaction clock = {.sa_handler = end, .sa_flags = SA_RESTART};
    sigemptyset(&clock.sa_mask);
    sigaction(SIGALRM, &clock, NULL);
    handle(caught, sizeof caught / sizeof *caught, store);
    ignore(SIGPIPE); /* a write to a closed pipe then fails, and temporary files can be removed */
}

bool stop_requested(void)
{
    if (requested) heard = 1;
    return requested != 0;
}
int stop_asked(void *context) { return (void)context, stop_requested(); }

void stop_reader_gone(void) { requested = SIGPIPE; }

void stop_obey(void)
{
    if (!requested) return;
    fflush(stderr);
    signal((int)requested, SIG_DFL);
    raise((int)requested);
}

double stop_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

stop_progress stop_progress_begin(const char *what, bool quiet)
{
    return (stop_progress){
        .what = what, .began = stop_clock(), .terminal = isatty(STDERR_FILENO) == 1, .tells = !quiet};
}

/* Prints a line of progress; on a terminal it replaces the last one. */
static void show(const stop_progress *p, double fraction, double spent)
{
    enum { BAR = 20 };
    const double gone = fraction - p->before;
    fprintf(stderr, "%s%s %3.0f %%", p->terminal ? "\r\033[K" : "motus: ", p->what, 100 * fraction);
    if (p->unit && p->terminal) {
        const int full = (int)(BAR * fraction);
        fprintf(stderr, " [%.*s%.*s]", full, "####################", BAR - full, "....................");
    }
    if (p->unit) fprintf(stderr, "%s %.3g %s/s", p->terminal ? "" : ",", p->amount * gone / spent, p->unit);
    if (gone > 0.02 * (1 - p->before) && fraction < 1) fprintf(stderr, ", %.0f s left", spent * (1 - fraction) / gone);
    if (!p->terminal) putc('\n', stderr);
    fflush(stderr);
}

int stop_progress_hook(void *context, double fraction)
{
    enum { FIRST_MS = 500, REFRESH_MS = 100, LOG_MS = 60000 };
    stop_progress *p = context;
    if (p->meanwhile) p->meanwhile(p->with);
    if (p->tells) {
        const double now = stop_clock(), spent = now - p->began, since = p->shown > 0 ? now - p->shown : spent;
        if (spent * 1000 > FIRST_MS && since * 1000 > (p->terminal ? REFRESH_MS : LOG_MS)) {
            show(p, p->span > 0 ? p->from + p->span * fraction : fraction, spent);
            p->shown = now;
        }
    }
    return !holding && (stop_requested() || is_over());
}

void stop_progress_end(stop_progress *p)
{
    if (p->terminal && p->tells && p->shown > 0) {
        fputs("\r\033[K", stderr);
        fflush(stderr);
    }
    p->shown = 0;
}
