/* What lanes.c (text and object) and lanes_blocks.c (blocks of trajectories) share. */
#ifndef MACHINE_LANES_PARTS_H
#define MACHINE_LANES_PARTS_H

#include "machine/compose.h"
#include "machine/lanes.h"
#include "machine/reduction.h"

#include "machine/text/host.h"
#include "machine/text/lanes_job.h"

enum { ALIGNMENT = 64 }; /* bytes of a cache line, and of the widest vector */

struct lanes {
    lanes_def def;
    work plan;                /* of the row, for no particular step */
    int width, groups, block; /* block: trajectories in one */
    emit e;
    void *handle;
    void (*bind)(const double *, const int64_t *, double *);
    void (*table)(const lanes_job *, clock *, whole);
    void (*begin)(const lanes_job *);
    void (*set)(const lanes_job *);
    void (*first)(const lanes_job *);
    void (*look)(const lanes_job *);
    void (*run)(const lanes_job *, whole, whole);
    double *u;
    int64_t *q, *places, *from_x, *from_v;
    size_t outs; /* numbers of the definitions that are looked at */
    bool wants_a;
    size_t solving; /* bytes of the linear systems of a group */
    size_t carried; /* elements of a group's carry */
    /* of one block, in doubles, whole cache lines */
    size_t own_size, bound_size, carry_size, kept_size, work_size, look_size, solve_size;
};

/* Doubles for so many elements of every lane of a block, in whole cache lines. */
static inline size_t lines(const lanes *l, size_t elements) { return (elements * (size_t)l->block + 7) / 8 * 8; }

#endif
