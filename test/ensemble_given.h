/* What tests of ensembles share: an ensemble from a model's text, its results in memory, and their comparison byte by
 * byte. */
#ifndef TEST_ENSEMBLE_GIVEN_H
#define TEST_ENSEMBLE_GIVEN_H

#include "test/given.h"
#include "test/given_cache.h"
#include "test/share.h"

enum { COUNT_MAX = 64, VARY_MAX = 5, RECORDS_MAX = 400 };

/* The results of `count` trajectories, record by record, and the times at which they stopped. */
typedef struct outcome {
    size_t count, records;
    double *numbers, *stopped;
    double *at[RECORDS_MAX];
} outcome;

UNUSED static outcome room_for(size_t count, size_t records)
{
    outcome o = {.count = count,
                 .records = records,
                 .numbers = calloc(count * records + 1, sizeof(double)),
                 .stopped = calloc(count + 1, sizeof(double))};
    assert_true(o.numbers && o.stopped && records <= RECORDS_MAX);
    for (size_t r = 0; r < records; r++) o.at[r] = o.numbers + r * count;
    return o;
}

UNUSED static void forget(outcome *o)
{
    free(o->numbers);
    free(o->stopped);
}

/* Equal to the byte, except that any NaN equals any other. */
UNUSED static int same_number(double a, double b) { return isnan(a) ? isnan(b) : !memcmp(&a, &b, sizeof a); }

UNUSED static void same_outcome(const outcome *a, const outcome *b, const char *what)
{
    assert_true(a->count == b->count && a->records == b->records);
    for (size_t k = 0; k < a->count; k++) {
        if (!same_number(a->stopped[k], b->stopped[k]))
            fail_msg("%s: trajectory %zu of %zu stopped at %a and at %a", what, k, a->count, a->stopped[k],
                     b->stopped[k]);
        for (size_t r = 0; r < a->records; r++)
            if (!same_number(a->at[r][k], b->at[r][k]))
                fail_msg("%s: trajectory %zu of %zu, record %zu: %a and %a", what, k, a->count, r, a->at[r][k],
                         b->at[r][k]);
    }
}

UNUSED static motus_ensemble *given_ensemble(motus_system *s, const motus_ensemble_def *def, const char *what)
{
    motus_error err = motus_default_error();
    motus_ensemble *e = NULL;
    must(motus_ensemble_create(s, def, &e, &err), &err, what);
    return e;
}

UNUSED static outcome go(motus_ensemble *e, size_t count, size_t records, const double *const *values, const char *what)
{
    motus_error err = motus_default_error();
    outcome o = room_for(count, records);
    must(motus_ensemble_run(e, count, values, o.at, o.stopped, &err), &err, what);
    return o;
}

#endif
