/* Lanes: many trajectories of one model at once, one in each lane of the processor's vectors, in a text compiled for
 * the model, the method and what varies. Where a method solves equations, they are small and of one structure; those
 * of families go one trajectory at a time.
 */
#ifndef MACHINE_LANES_H
#define MACHINE_LANES_H

#include "core/methods.h"
#include "lang/model/vary.h"

typedef struct lanes lanes;

/* a number that is recorded: time, x[place], v[place], or number `place` of a definition */
typedef struct lanes_source {
    enum { SOURCE_TIME, SOURCE_X, SOURCE_V, SOURCE_DEFINITION } kind;
    const model_definition *definition;
    size_t place;
    int how; /* REDUCE_ of machine/text/reduce.h */
} lanes_source;

typedef struct lanes_def {
    model *model;
    const problem *problem;
    const chosen *chosen;
    const vary *vary;
    const size_t *places;
    size_t place_count; /* of the pool, that vary */
    const lanes_source *sources;
    size_t source_count;
    double t0, h, last, until; /* last: the shorter last step, 0 none */
    int64_t whole, every;      /* observations every so many steps */
    bool own_clock;            /* steps adapt, or ends differ: whole, last and the sign of h are not used */
    int lanes, threads;        /* lanes 0: as many as suits */
    bool fast;
    const motus_allocator *allocator;
    int (*progress)(void *context, double fraction);
    void *context;
} lanes_def;

/* Whether lanes can do it at all: NULL, or why not. */
const char *lanes_refuse(const lanes_def *);
/* The definition's pointers must outlive it. note[size]: why there is no object, where the status is MOTUS_TOOL. */
motus_status lanes_create(const lanes_def *, lanes **, char *note, size_t size, motus_error *);
void lanes_destroy(lanes *);
/* values[k][i], until[i] (NULL: that of the definition), results[r][i], stopped[i] (may be NULL) for i < count.
 * MOTUS_METHOD, with no error: lanes cannot tell
 * whether the method admits the parameters of every trajectory; one at a time can. */
motus_status lanes_run(lanes *, size_t count, const double *const *values, const double *until, double *const *results,
                       double *stopped, motus_error *);
int lanes_in_block(const lanes *);

#endif
