/* The processes of motus-mpi, which do one command together. All of them share a sweep; rank 0 does every other verb,
 * while the others wait. A program that is alone has no team: NULL.
 *
 * If a call waits for all, every process makes it, and they make such calls in one order.
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
    int threads;   /* of this process if the command names none: its share of the machine's processors */
    void *context; /* the first argument of the functions below */
    uint64_t (*take)(void *, uint64_t count);         /* adds to the common counter; returns its value before */
    void (*reset)(void *);                            /* waits for all, and sets the counter to 0 */
    uint64_t (*sum)(void *, uint64_t);                /* waits for all */
    int (*largest)(void *, int);                      /* waits for all */
    void (*share)(void *, void *bytes, size_t count); /* waits for all, and gives them the bytes of rank 0 */
    void (*answer)(void *);                           /* serves the counter while this process computes */
} team;

static inline bool team_first(const team *t) { return !t || t->rank == 0; }
static inline int team_size(const team *t) { return t ? t->size : 1; }
/* Fails without a message, since another process failed and has one. */
static inline motus_status team_failed(motus_error *err) { return fail(err, MOTUS_CANCELLED, "%s", ""); }
/* Fails in every process if one fails. */
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
/* Returns whether this process is the one that prints the error. */
static inline bool team_tells(const team *t, motus_status status, const motus_error *err)
{
    if (!t) return status != MOTUS_OK;
    const bool speaks = status && err->message[0];
    return t->largest(t->context, speaks ? t->size - t->rank : 0) == t->size - t->rank && speaks;
}

#endif
