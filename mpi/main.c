/* motus-mpi: the program in the processes of an MPI job.
 *
 * There is no master: every process, a rank, computes, and takes its work from a counter in the memory of rank 0, which
 * the others add to without its help (MPI_Fetch_and_op). Rank 0 prints. Without mpirun there is one rank.
 *
 * Invariants: a failure of one rank ends all by a common decision (cli/team.h), with one message and its exit status,
 * and never by MPI_Abort; what MPI itself refuses ends the job as MPI does.
 */
#include "cli/program.h"

#include <mpi.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct counter {
    MPI_Win window;
    uint64_t *value; /* of rank 0 */
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

/* Some transports answer the others only while the process that has the counter is inside MPI. */
static void answer(void *context)
{
    int flag;
    (void)context;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &flag, MPI_STATUS_IGNORE);
}

/* As many threads as this rank has processors: those it is bound to, or its share of those of the machine. */
static int threads_of_rank(void)
{
    MPI_Comm machine;
    cpu_set_t allowed;
    int here = 1;
    const long all = sysconf(_SC_NPROCESSORS_ONLN);
    if (MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine) == MPI_SUCCESS) {
        MPI_Comm_size(machine, &here);
        MPI_Comm_free(&machine);
    }
    const int mine = sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : 1;
    const int share = mine < all ? mine : (int)all / here;
    return share > 1 ? share : 1;
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

/* What every rank says of itself, one behind the other; on rank 0, to be freed. */
static char *gather(const char *mine, int size)
{
    char own[SAID] = "", *all = calloc((size_t)size, SAID);
    snprintf(own, sizeof own, "%s", mine);
    if (all) MPI_Allgather(own, SAID, MPI_CHAR, all, SAID, MPI_CHAR, MPI_COMM_WORLD);
    return all;
}

/* Ranks of several versions would compute different bits. Returns 0, or the exit status. */
static int versions_differ(int rank, int size)
{
    char *all = gather(motus_version(), size);
    int differs = all == NULL;
    for (int k = 1; all && k < size && !differs; k++) {
        differs = strcmp(all, all + (size_t)k * SAID) != 0;
        if (differs && rank == 0)
            fprintf(stderr,
                    "motus: rank 0 is motus %s, and rank %d is motus %s\n  hint: install one version everywhere\n", all,
                    k, all + (size_t)k * SAID);
    }
    free(all);
    return differs ? 2 : 0;
}

static int check(int rank, int size, int threads)
{
    char own[SAID], name[MPI_MAX_PROCESSOR_NAME] = "";
    int length;
    MPI_Get_processor_name(name, &length);
    snprintf(own, sizeof own, "motus %s, %s, on %.100s", motus_version(), instructions(), name);
    char *all = gather(own, size);
    for (int k = 0; all && rank == 0 && k < size; k++) printf("rank %d: %s\n", k, all + (size_t)k * SAID);
    if (rank == 0) {
        char library[MPI_MAX_LIBRARY_VERSION_STRING] = "";
        MPI_Get_library_version(library, &length);
        library[strcspn(library, "\n,")] = 0;
        printf("%d rank%s, %s, %s\n", size, size == 1 ? "" : "s", library,
               threads >= MPI_THREAD_FUNNELED ? "threads inside a rank" : "no threads inside a rank: use --threads 1");
    }
    free(all);
    return all ? 0 : 1;
}

int main(int argc, char **argv)
{
    int rank, size, threads, exit;
    counter c;
    if (MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads) != MPI_SUCCESS) return 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    exit = versions_differ(rank, size);
    if (!exit && argc == 2 && strcmp(argv[1], "--mpi-check") == 0) {
        exit = check(rank, size, threads);
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
