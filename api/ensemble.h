/* An ensemble: what varies, what is recorded, and one of two ways to compute it: in lanes, or one trajectory after the other. */
#ifndef API_ENSEMBLE_H
#define API_ENSEMBLE_H

#include "api/run.h"
#include "run/lanes.h"

struct motus_ensemble {
    motus_system *system;
    motus_allocator allocator;
    chosen chosen;
    timing timing;
    int64_t every;
    size_t vary_count, record_count;
    size_t *places;                  /* of the pool; of a callback: of x, then v */
    motus_record *records;
    vary *vary;
    lanes *lanes;                    /* NULL: one trajectory after the other */
    const machine *machine;          /* then */
    const problem *problem;
    int threads;
    double seconds;
    int (*progress)(void *context, double fraction);
    void *context;
    double told;                     /* when `progress` was last called */
    char note[MOTUS_TEXT_MAX];
};

double ensemble_now(void);               /* seconds */
/* Tells the one who watches, not more often than every 10 ms; other than 0: cancel. The context is the ensemble. */
int ensemble_watched(void *context, double fraction);
/* What varies: its place in the pool of a model, or in x and then v of a callback. */
motus_status ensemble_place(const motus_system *, const char *name, size_t *place, motus_error *);
/* One trajectory after the other. */
motus_status ensemble_singly(motus_ensemble *, size_t count, const double *const *values, double *const *results, double *stopped, motus_error *);

#endif
