/* Rounds, medians and ratios. */
#include "bench/bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double thread_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void measure(side *sides, int count, int rounds)
{
    bool absent[16] = {false};
    for (int k = 0; k < count; k++) sides[k].taken = 0;
    /* The first round loads code and data; a side that answers NaN in it is not asked again. */
    for (int k = 0; k < count; k++)
        if (sides[k].rounds != 1) absent[k] = isnan(sides[k].run(sides[k].context));
    for (int round = 0; round < rounds && round < ROUNDS_MAX; round++)
        for (int k = 0; k < count; k++) {
            side *s = &sides[k];
            if (absent[k] || (s->rounds && round >= s->rounds)) continue;
            double value = s->run(s->context);
            if (!isnan(value)) s->sample[s->taken++] = value;
        }
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double middle_of(double *values, size_t count)
{
    if (count == 0) return NAN;
    qsort(values, count, sizeof *values, ascending);
    return count % 2 ? values[count / 2] : (values[count / 2 - 1] + values[count / 2]) / 2;
}

static double middle(const double *values, int count)
{
    double sorted[ROUNDS_MAX];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    return middle_of(sorted, (size_t)count);
}

double median(const side *s) { return middle(s->sample, s->taken); }

double ratio(const side *over, const side *under)
{
    if (over->taken != under->taken) return median(over) / median(under);
    double each[ROUNDS_MAX];
    for (int k = 0; k < over->taken; k++) each[k] = over->sample[k] / under->sample[k];
    return middle(each, over->taken);
}
