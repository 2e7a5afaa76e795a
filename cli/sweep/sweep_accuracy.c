/* What a sweep says of a trajectory that does not reach the accuracy. */
#include "base/decimal.h"
#include "cli/words/complain.h"
#include "cli/sweep/sweep.h"
#include "cli/words/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* "trajectory 17 (F = 0.85)" */
static void name_of(const sweep *s, uint64_t number, char *out, size_t size)
{
    size_t n = (size_t)snprintf(out, size, "trajectory %llu", (unsigned long long)number);
    double *room = malloc((s->grid.count + 1) * sizeof *room), **values = malloc((s->grid.count + 1) * sizeof *values);
    for (size_t k = 0; room && values && k < s->grid.count; k++) values[k] = room + k;
    if (room && values && s->grid.count) {
        grid_values(&s->grid, number, 1, values);
        for (size_t k = 0; k < s->grid.count && n < size; k++) {
            char text[DECIMAL_MAX];
            n += (size_t)snprintf(out + n, size - n, "%s%s = %s%s", k ? ", " : " (", s->grid.names[k],
                                  decimal(values[k][0], text), k + 1 == s->grid.count ? ")" : "");
        }
    }
    free(room);
    free(values);
}

motus_status sweep_accuracy_refuse(const sweep *s, uint64_t first, size_t count, double *const *judged,
                                   const double *stopped, motus_error *err)
{
    char who[256], wanted[DECIMAL_MAX], bar[DECIMAL_MAX], tolerance[DECIMAL_MAX];
    size_t i = 0;
    while (i + 1 < count && (!isnan(stopped[i]) || judged[SWEEP_REACHED][i] <= s->accuracy)) i++;
    const double reached = judged[SWEEP_REACHED][i];
    name_of(s, shard_trajectory(&s->shard, first + i), who, sizeof who);
    decimal(s->accuracy, wanted);
    decimal(judged[SWEEP_TOLERANCE][i], tolerance);
    text_brief(reached, 2, bar);
    if (isnan(reached))
        fail(err, MOTUS_ACCURACY, "no accuracy can be promised: there is no companion of %s", who);
    else if (isinf(reached))
        fail(err, MOTUS_ACCURACY,
             "the accuracy %s is not reached: no digit of %s is known to be significant at its end", wanted, who);
    else
        fail(err, MOTUS_ACCURACY, "the accuracy %s is not reached: %s has the error %s with the tolerance %s", wanted,
             who, bar, tolerance);
    hint(err, "allow a larger error, or leave this trajectory out");
    return MOTUS_ACCURACY;
}
