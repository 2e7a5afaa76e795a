/* Sweeps as whole programs: an archive beside a .npy, ranks beside threads, and what writing takes beside computing. */
#include "bench/bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ROUNDS = 7, WORDS = 32 };

typedef struct sweeping {
    char output[300];
    const char *words[WORDS];
    int count;
    bool inside;    /* what the program says that it took, without its start and that of MPI */
    double writing; /* of all ranks, per cent of what they computed; NaN: not told */
} sweeping;

static void add(sweeping *s, const char *word)
{
    if (s->count + 1 < WORDS) s->words[s->count++] = word;
}

static char folder[256], mpi[300];

/* A sweep of so many pendulums, by so many ranks; 0: by motus itself, with so many threads. */
static void describe(sweeping *s, const char *name, const char *vary, const char *until, int ranks, const char *threads)
{
    static const char *const counts[] = {"0", "1", "2"};
    *s = (sweeping){.writing = NAN};
    snprintf(s->output, sizeof s->output, "%s/%s", folder, name);
    if (ranks > 0) {
        add(s, "mpirun"), add(s, "--oversubscribe"), add(s, "-n"), add(s, counts[ranks]);
        add(s, mpi);
    } else {
        add(s, process_motus());
    }
    add(s, "sweep"), add(s, "bench/swings.motus"), add(s, "--vary"), add(s, vary), add(s, "--until"), add(s, until);
    add(s, "--record"), add(s, "final"), add(s, "--threads"), add(s, threads);
    add(s, "-o"), add(s, s->output), add(s, "--json");
}

/* The sum of what all ranks say of "name". */
static double told(const char *json, const char *name)
{
    char words[64];
    double sum = 0;
    snprintf(words, sizeof words, "\"%s\": ", name);
    for (const char *at = strstr(json, "\"ranks\""); at && (at = strstr(at, words)); at++)
        sum += strtod(at + strlen(words), NULL);
    return sum;
}

static double by_sweep(void *context)
{
    sweeping *s = context;
    remove(s->output);
    const process run = process_run(s->words);
    if (run.status != 0) return NAN;
    const double computing = told(run.out, "computing");
    if (computing > 0) s->writing = 100 * told(run.out, "writing") / computing;
    const char *wall = strstr(run.out, "\"wall\": ");
    return !s->inside ? run.seconds : wall ? strtod(wall + 8, NULL) : NAN;
}

static void compare_formats(void)
{
    report_section("A sweep into an archive, beside one into a .npy", "all of it");
    static const struct {
        const char *name, *vary, *until;
    } cases[] = {{"1e6 pendulums, 32 steps", "x(0)=0.1:3:1000000", "4"},
                 {"1e6 pendulums, 80 steps", "x(0)=0.1:3:1000000", "10"},
                 {"1e7 pendulums, 32 steps", "x(0)=0.1:3:10000000", "4"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sweeping h5, npy;
        describe(&h5, "swings.h5", cases[k].vary, cases[k].until, 0, "2");
        describe(&npy, "swings.npy", cases[k].vary, cases[k].until, 0, "2");
        side sides[] = {SIDE(by_sweep, &h5), SIDE(by_sweep, &npy)};
        measure(sides, 2, ROUNDS);
        report_at_most(cases[k].name, &sides[0], &sides[1], 1, "ms");
    }
}

static void compare_ranks(void)
{
    report_section("A sweep of 1e6 pendulums, 2000 steps, by ranks of MPI", "without the start");
    static const char vary[] = "x(0)=0.1:3:1000000", until[] = "250";
    sweeping alone, one, two;
    describe(&alone, "alone.h5", vary, until, 0, "1");
    describe(&one, "one.h5", vary, until, 1, "1");
    describe(&two, "two.h5", vary, until, 2, "1");
    alone.inside = one.inside = two.inside = true;
    side sides[] = {SIDE(by_sweep, &two), SIDE(by_sweep, &one), SIDE(by_sweep, &alone)};
    measure(sides, 3, ROUNDS);
    report_at_least("2 ranks beside 1", &sides[0], &sides[1], 1.9, "ms");
    report_at_least("1 rank beside motus with one thread", &sides[1], &sides[2], 0.98, "ms");
    report_note("writing takes %.2f %% of what computing takes on 1 rank, %.2f %% on 2, with %.3g us a trajectory",
                one.writing, two.writing, 1e6 * median(&sides[1]) / 1e6);
    sweeping cheap;
    describe(&cheap, "cheap.h5", "x(0)=0.1:3:4000000", "50", 2, "1");
    cheap.inside = true;
    side writer[] = {SIDE(by_sweep, &cheap)};
    measure(writer, 1, 3);
    report_note("and %.2f %% with %.3g us (4e6 pendulums, 400 steps, 2 ranks)", cheap.writing,
                1e6 * 2 * median(&writer[0]) / 4e6);
}

void compare_sweeps(void)
{
    const char *base = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/motus-sweeps-XXXXXX", base && *base ? base : "/tmp");
    if (!mkdtemp(folder)) {
        report_note("no directory for the files of sweeps");
        return;
    }
    snprintf(mpi, sizeof mpi, "%s-mpi", process_motus());
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    compare_formats();
    if (access(mpi, X_OK) == 0)
        compare_ranks();
    else
        report_note("no motus-mpi: ranks are not measured");
    static const char *const names[] = {"swings.h5", "swings.npy", "swings.npy.json", "alone.h5",
                                        "one.h5",    "two.h5",     "cheap.h5"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char path[300];
        snprintf(path, sizeof path, "%s/%s", folder, names[k]);
        remove(path);
    }
    rmdir(folder);
}
