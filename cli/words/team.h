/* The processes that do one command together, each with the same words (motus-mpi). A sweep is shared by all; every
 * other verb is done by rank 0, while the others wait. A program alone has no team, NULL.
 *
 * Calls that wait for all are made by all, in the same order.
 */
#ifndef CLI_WORDS_TEAM_H
#define CLI_WORDS_TEAM_H

#include "base/error.h"
#include "motus.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct team {
    int rank, size;
    int threads; /* for this process, where the command names none: its share of the machine's processors */
    void *context;
    uint64_t (*take)(void *, uint64_t count);         /* adds to a counter of all; its value before */
    void (*reset)(void *);                            /* waits for all; the counter is 0 */
    uint64_t (*sum)(void *, uint64_t);                /* waits for all */
    int (*largest)(void *, int);                      /* waits for all */
    void (*share)(void *, void *bytes, size_t count); /* waits for all; everyone has the bytes of rank 0 */
    void (*answer)(void *);                           /* lets the counter go on while this process computes */
} team;

static inline bool team_first(const team *t) { return !t || t->rank == 0; }
static inline int team_size(const team *t) { return t ? t->size : 1; }
/* MOTUS_CANCELLED, without a message: another one failed. */
static inline motus_status team_failed(motus_error *err) { return fail(err, MOTUS_CANCELLED, "%s", ""); }
/* A failure of one is a failure of all. */
static inline motus_status team_agree(const team *t, motus_status status, motus_error *err)
{
    const bool failed = t && t->size > 1 && t->largest(t->context, status != MOTUS_OK);
    if (status) return status;
    return failed ? team_failed(err) : MOTUS_OK;
}
static inline bool team_any(const team *t, bool mine)
{
    return t && t->size > 1 ? t->largest(t->context, mine) != 0 : mine;
}
/* Whether this process is the one that tells of the failure. */
static inline bool team_tells(const team *t, motus_status status, const motus_error *err)
{
    if (!t) return status != MOTUS_OK;
    const bool speaks = status && err->message[0];
    return t->largest(t->context, speaks ? t->size - t->rank : 0) == t->size - t->rank && speaks;
}

#endif
