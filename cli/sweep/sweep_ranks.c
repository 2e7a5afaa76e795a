/* How the work of a sweep was shared among the processes of a team. */
#include "cli/sweep/sweep.h"

#include <stdlib.h>

#define MICRO 1e6

/* A number of the process `rank`, known to all. */
static uint64_t tell(const team *t, int rank, uint64_t mine) { return t->sum(t->context, t->rank == rank ? mine : 0); }
static double tell_seconds(const team *t, int rank, double mine)
{
    return (double)tell(t, rank, mine > 0 ? (uint64_t)(mine * MICRO) : 0) / MICRO;
}

sweep_share *sweep_ranks_gather(const team *t, const sweep_share *mine)
{
    sweep_share *all = calloc((size_t)t->size, sizeof *all), room;
    for (int k = 0; k < t->size; k++) {
        sweep_share *one = all ? all + k : &room;
        one->blocks = tell(t, k, mine->blocks);
        one->rows = tell(t, k, mine->rows);
        one->computing = tell_seconds(t, k, mine->computing);
        one->waiting = tell_seconds(t, k, mine->waiting);
        one->writing = tell_seconds(t, k, mine->writing);
    }
    return all;
}
