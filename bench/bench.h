/* THE BENCH: pairs of programs that compute the same, timed against each other.
 *
 * Invariant: the sides of a comparison are measured in turn, round after round, in one process (or as processes, one
 * after the other); a ratio is the median of the rounds' ratios. What cannot be measured says so and has no number;
 * what misses its limit is "short", and is not an error.
 */
#ifndef BENCH_BENCH_H
#define BENCH_BENCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { ROUNDS_MAX = 32 };

/* measure.c: one side of a comparison. `run` does a piece of work and returns what one unit of it took; NaN: it
 * cannot be measured. */
typedef struct side {
    double (*run)(void *context);
    void *context;
    int rounds; /* 0: as many as the others */
    double sample[ROUNDS_MAX];
    int taken;
} side;
#define SIDE(f, c)                 \
    {                              \
        .run = (f), .context = (c) \
    }
#define SIDE_ROUNDS(f, c, n)                      \
    {                                             \
        .run = (f), .context = (c), .rounds = (n) \
    }

double now(void);                                 /* seconds */
double thread_seconds(void);                      /* seconds that this thread has had the processor */
void measure(side *sides, int count, int rounds); /* a round before the first is not counted */
double middle_of(double *values, size_t count);   /* their median; it sorts them. NaN: there are none */
double median(const side *);                      /* NaN: not measured */
double ratio(const side *over, const side *under);

/* report.c: lines. Times are in seconds, `unit` is "ns" or "ms". */
void report_open(FILE *copy); /* a second place for every line, or NULL */
void report_text(const char *format, ...) __attribute__((format(printf, 1, 2)));
void report_section(const char *title, const char *what);
/* ours/other */
void report_at_most(const char *name, const side *ours, const side *other, double limit, const char *unit);
/* other/ours */
void report_at_least(const char *name, const side *ours, const side *other, double limit, const char *unit);
/* a ratio of two times that were not measured in rounds: other/ours */
void report_times(const char *name, double ours, double other, double limit, const char *unit);
/* errors, ours at most `limit` */
void report_error(const char *name, double ours, double other, double limit);
/* no limit */
void report_beside(const char *name, const side *ours, const side *other, const char *unit);
void report_value(const char *name, double value, double limit,
                  const char *unit); /* "ms", "MB", "x": at most; "x" at least */
void report_note(const char *format, ...) __attribute__((format(printf, 1, 2)));
void report_bits(const char *name, bool known, bool same);
void report_close(void); /* how many are ok, short, not measured */

/* machine.c */
/* lines of the report: processor, cores, compiler, system; nothing that names a computer */
void machine_describe(void);
void machine_slug(char *out, size_t size); /* "amd-epyc-avx2": for a file's name */
int machine_cores(void);

/* process.c: programs, with a cache of their own. */
/* out: the first line it printed */
typedef struct process {
    double seconds;
    long kilobytes;
    int status;
    char out[1024];
} process;
bool process_open(void); /* makes the directory that is the programs' cache */
void process_close(void);
void process_forget(void);                     /* empties it */
process process_run(const char *const *words); /* status -1: could not be started */
const char *process_motus(void);               /* the program: $MOTUS or build/motus */
const char *process_python(void);              /* one that has NumPy, or NULL */

/* ours_run.c: one system through the library. */
typedef struct ours ours;
/* `set` is a NULL-ended list of "name=expression" or NULL; steps: as many as will be taken. NULL: it cannot be had,
 * and why was reported. */
ours *ours_open(const char *file, const char *const *set, const char *method, double step, int64_t steps,
                const char *machine, int threads);
double ours_step(ours *, int64_t steps); /* seconds */
bool ours_state(ours *, double *x, double *v);
void ours_close(ours *);
char *read_text(const char *file); /* or NULL */

/* ours_ensemble.c */
double ours_ensemble(const char *file, const char *method, int64_t steps, double step, const char *varied,
                     const double *values, size_t count, double *x, double *v, int threads);

/* ours_adaptive.c: a problem to its end by a tolerance, and what it took. */
typedef struct ours_answer {
    double created, seconds; /* of the clock, to read, compile and prepare; of the processor. NaN: it failed */
    int64_t steps;
} ours_answer;
struct problem;
void ours_prepare(const char *file, const struct problem *, const char *method, double tolerance);
ours_answer ours_adaptive(const char *file, const struct problem *, const char *method, double tolerance,
                          double *state);
/* bench/driven-pendulum.motus on one thread: the processor's seconds without reading and compiling, or NaN. */
double ours_pendulums(const char *file, const char *method, double tolerance, size_t count, const double *F,
                      const double *theta, double *x, double *v);

/* ours_events.c: a run with events to its end. */
typedef struct watched {
    const char *file, *when; /* the model, and one rule more or NULL */
    const char *method, *machine;
    double tolerance, step, until; /* as in motus_run_def */
    int across;                    /* 1: switches of the force are not located */
    const double *x, *v;           /* as in motus_run_def */
    const char *columns[2];        /* NULL, or what `last` tells */
    int64_t steps, evaluations, events;
    double last[3]; /* of the last event: its time and the columns */
} watched;
double ours_watched(watched *); /* the processor's seconds of the run alone, or NaN */
/* `count` motions of models/henon-heiles.motus from x = 0, and where they pass x = 0 rising: those of `kept` motions at
 * equal distances among them, SECTION_MOST places each. */
enum { SECTION_MOST = 256 };
typedef struct section_point {
    double t, y, v;
} section_point;
typedef struct sections {
    size_t count, kept;
    double *y, *vx, *vy, until; /* the starts */
    section_point *points;
    int *found; /* how many of each */
} sections;
double ours_sections(sections *, const char *method, double tolerance, int threads); /* seconds, or NaN */

/* The comparisons, one file each. */
void compare_accuracy(void);
void compare_driven_pendulums(void); /* a part of it */
void compare_energy(void);
void compare_ensembles(void);
void compare_events(void);
void compare_sections(void); /* a part of it */
void compare_single(void);
void compare_sweeps(void);
void compare_large(void);
void compare_programs(void);

#endif
