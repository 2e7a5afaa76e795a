/* motus-mpi: the program in the processes of an MPI job.
 *
 * There is no master: every process, a rank, computes, and takes its work from a counter in the memory of rank 0, which
 * the others add to without its help (MPI_Fetch_and_op). Rank 0 prints. Without mpirun there is one rank.
 *
 * Invariants: a failure of one rank ends all by a common decision (cli/words/team.h), with one message and its exit
 * status, and never by MPI_Abort; what MPI itself refuses ends the job as MPI does.
 */
#include "base/platform.h"
#include "cli/verbs/program.h"
#include "mpi/bits.h"

#include <inttypes.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct counter {
    MPI_Win window;
    uint64_t *value; /* the counter, which rank 0 has */
    int rank;
} counter;

static uint64_t take(void *context, uint64_t count)
{
    counter *c = context;
    uint64_t before = 0;
    MPI_Fetch_and_op(&count, &before, MPI_UINT64_T, 0, 0, MPI_SUM, c->window);
    MPI_Win_flush(0, c->window);
    return before;
}

static void reset(void *context)
{
    counter *c = context;
    const uint64_t none = 0;
    uint64_t before;
    MPI_Barrier(MPI_COMM_WORLD);
    if (c->rank == 0) {
        MPI_Fetch_and_op(&none, &before, MPI_UINT64_T, 0, 0, MPI_REPLACE, c->window);
        MPI_Win_flush(0, c->window);
    }
    MPI_Barrier(MPI_COMM_WORLD);
}

static uint64_t sum(void *context, uint64_t mine)
{
    uint64_t all = 0;
    (void)context;
    MPI_Allreduce(&mine, &all, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    return all;
}

static int largest(void *context, int mine)
{
    int all = 0;
    (void)context;
    MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return all;
}

static void share(void *context, void *bytes, size_t count)
{
    enum { AT_ONCE = 1 << 30 };
    (void)context;
    for (char *at = bytes; count > 0;) {
        const size_t some = count < AT_ONCE ? count : AT_ONCE;
        MPI_Bcast(at, (int)some, MPI_BYTE, 0, MPI_COMM_WORLD);
        at += some, count -= some;
    }
}

/* Calls MPI in the process that has the counter, since some transports answer the others only inside such calls. */
static void answer(void *context)
{
    int flag;
    (void)context;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &flag, MPI_STATUS_IGNORE);
}

/* Returns as many threads as this rank has processors: those on which it may run, shared with the ranks that may run
 * there too. */
static int threads_of_rank(void)
{
    MPI_Comm machine;
    uint64_t mine[PLATFORM_SET], other[PLATFORM_SET];
    int here, me, sharers = 0, count = 0;
    platform_set(mine);
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &here);
    MPI_Comm_rank(machine, &me);
    for (int k = 0; k < here; k++) {
        bool shared = false;
        memcpy(other, mine, sizeof other);
        MPI_Bcast(other, PLATFORM_SET, MPI_UINT64_T, k, machine);
        for (int i = 0; i < PLATFORM_SET; i++) shared = shared || mine[i] & other[i];
        sharers += shared;
    }
    MPI_Comm_free(&machine);
    for (int i = 0; i < PLATFORM_SET; i++) count += __builtin_popcountll(mine[i]);
    return count > sharers ? count / sharers : 1;
}

/* ---- versions ---- */

enum { SAID = 192 };

static const char *instructions(void)
{
#if defined __x86_64__
    return __builtin_cpu_supports("avx512f") ? "AVX-512" : __builtin_cpu_supports("avx2") ? "AVX2" : "SSE2";
#elif defined __aarch64__
    return "NEON";
#else
    return "the base set";
#endif
}

/* Writes and returns what rank k says of itself; all ranks call it, in one order. */
static const char *said_by(int k, const char *mine, char out[SAID])
{
    snprintf(out, SAID, "%s", mine);
    MPI_Bcast(out, SAID, MPI_CHAR, k, MPI_COMM_WORLD);
    return out;
}

/* Checks that all ranks have one version, since several would compute different bits. Returns 0, or the exit status. */
static int versions_differ(int rank, int size)
{
    char first[SAID], other[SAID];
    int differs = 0;
    said_by(0, motus_version(), first);
    for (int k = 1; k < size; k++) {
        const int now = strcmp(first, said_by(k, motus_version(), other)) != 0;
        if (now && !differs && rank == 0)
            fprintf(stderr,
                    "motus: rank 0 is motus %s, and rank %d is motus %s\n  hint: install one version everywhere\n",
                    first, k, other);
        differs |= now;
    }
    return differs ? 2 : 0;
}

/* Prints what each rank is and computes. Returns the exit status. */
static int check(int rank, int size)
{
    char own[SAID], first[SAID] = "", other[SAID], name[MPI_MAX_PROCESSOR_NAME] = "", bits[24];
    int length, differs = 0;
    uint64_t hash = 0;
    motus_error err = motus_default_error();
    const int threads = threads_of_rank();
    const motus_status status = bits_compute(&hash, &err);
    snprintf(bits, sizeof bits, "%016" PRIx64, hash);
    MPI_Get_processor_name(name, &length);
    if (status) snprintf(bits, sizeof bits, "not computed");
    snprintf(own, sizeof own, "motus %s, bits %s, %s, %d thread%s, on %.60s", motus_version(), bits, instructions(),
             threads, threads == 1 ? "" : "s", name);
    for (int k = 0; k < size; k++) {
        char its[SAID];
        said_by(k, bits, its);
        if (k == 0) memcpy(first, its, SAID);
        differs |=
            !strchr(its, ' ') && !strchr(first, ' ') && strcmp(first, its) != 0; /* "not computed" tells nothing */
        said_by(k, own, other);
        if (rank == 0) printf("rank %d: %s\n", k, other);
    }
    if (rank == 0) {
        char library[MPI_MAX_LIBRARY_VERSION_STRING] = "";
        MPI_Get_library_version(library, &length);
        library[strcspn(library, "\n,")] = 0;
        printf("%d rank%s, %s\n", size, size == 1 ? "" : "s", library);
        if (differs)
            fprintf(stderr, "motus: these ranks compute different bits\n  hint: take ranks of one kind; the bits of "
                            "motus do not depend on the processor, so please report this\n");
    }
    if (status) fprintf(stderr, "motus: rank %d cannot compute: %s\n", rank, err.message);
    return differs ? 2 : status ? 1 : 0;
}

int main(int argc, char **argv)
{
    int rank, size, threads, exit;
    counter c;
    program_begin();
    if (MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads) != MPI_SUCCESS) return 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    setenv("NO_COLOR", "1", 0); /* mpirun gives rank 0 a terminal, and what it prints to a file */
    exit = versions_differ(rank, size);
    if (!exit && argc == 2 && strcmp(argv[1], "--mpi-check") == 0) {
        exit = check(rank, size);
    } else if (!exit) {
        c.rank = rank;
        MPI_Win_allocate(rank == 0 ? sizeof *c.value : 0, sizeof *c.value, MPI_INFO_NULL, MPI_COMM_WORLD, &c.value,
                         &c.window);
        MPI_Win_lock_all(0, c.window);
        const int processors = threads >= MPI_THREAD_FUNNELED ? threads_of_rank() : 1;
        const team t = {rank, size, processors, &c, take, reset, sum, largest, share, answer};
        exit = program_main(argc, argv, &t);
        MPI_Win_unlock_all(c.window);
        MPI_Win_free(&c.window);
    }
    MPI_Finalize();
    return exit;
}
