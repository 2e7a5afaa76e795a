/* The trajectories of a sweep that are furthest apart. See grid.h. */
#include "cli/words/complain.h"
#include "cli/model/grid.h"

#include <math.h>
#include <stdlib.h>

enum {
    ALL = 16,      /* a sweep of so few trajectories: every one of them */
    CORNERS = 4,   /* of so many axes every corner */
    ROWS = 64,     /* at most */
    DEVIATIONS = 3 /* from the mean of what is drawn from a normal distribution */
};

/* The indices of the least and the largest value of --vary. */
static void ends_of(const axis *a, uint64_t *least, uint64_t *largest)
{
    *least = 0;
    *largest = a->kind == AXIS_RANGE ? a->count - 1 : 0;
    for (uint64_t i = 0; a->kind == AXIS_LIST && i < a->count; i++) {
        if (a->list[i] < a->list[*least]) *least = i;
        if (a->list[i] > a->list[*largest]) *largest = i;
    }
}

/* -1: the lower end of an axis, 1: the upper one, 0: its middle. */
static double end_of(const axis *a, int side)
{
    uint64_t least, largest;
    const double from = a->range.from, to = a->range.to;
    if (a->kind == AXIS_UNIFORM) return side < 0 ? from : side > 0 ? to : from + (to - from) / 2;
    if (a->kind == AXIS_NORMAL) return from + side * DEVIATIONS * to;
    ends_of(a, &least, &largest);
    const uint64_t at = side < 0 ? least : side > 0 ? largest : a->count / 2;
    return a->kind == AXIS_LIST ? a->list[at] : range_value(&a->range, at);
}

/* Which side axis k is on in this row: the middle of all first, then corners, or every end by itself among the others'
 * opposite ends. */
static int side_of(const grid *g, size_t row, size_t k)
{
    if (row == 0) return 0;
    if (g->count <= CORNERS) return ((row - 1) >> k) & 1 ? 1 : -1;
    const int side = row % 2 ? 1 : -1;
    return (row - 1) / 2 == k ? side : -side;
}

/* Axes that go together: at the ends of each, the values of all; what is drawn is at its own ends. */
static size_t zipped(const grid *g, double *const *values)
{
    size_t rows = 0;
    for (size_t k = 0; k < g->count && g->axes[k].kind <= AXIS_LIST; k++) {
        uint64_t ends[2];
        ends_of(&g->axes[k], &ends[0], &ends[1]);
        for (int side = 0; side < 2 && rows < ROWS; side++, rows++)
            for (size_t j = 0; j < g->count; j++) {
                const axis *a = &g->axes[j];
                values[j][rows] = a->kind == AXIS_RANGE  ? range_value(&a->range, ends[side])
                                  : a->kind == AXIS_LIST ? a->list[ends[side]]
                                                         : end_of(a, side ? 1 : -1);
            }
    }
    return rows;
}

motus_status grid_extremes(const grid *g, double ***values, size_t *rows, motus_error *err)
{
    double **table = calloc(g->count + 1, sizeof *table), *room = calloc(ROWS * g->count + 1, sizeof *room);
    *values = table;
    if (!table || !room) {
        free(room);
        free(table);
        *values = NULL;
        return complain_memory(err);
    }
    for (size_t k = 0; k < g->count + !g->count; k++) table[k] = room + k * ROWS;
    if (g->total <= ALL) {
        *rows = (size_t)g->total;
        grid_values(g, 0, *rows, table);
    } else if (g->zip) {
        *rows = zipped(g, table);
    } else {
        *rows = 1 + (g->count <= CORNERS ? (size_t)1 << g->count : 2 * g->count);
        if (*rows > ROWS) *rows = ROWS;
        for (size_t k = 0; k < g->count; k++)
            for (size_t i = 0; i < *rows; i++) table[k][i] = end_of(&g->axes[k], side_of(g, i, k));
    }
    return MOTUS_OK;
}

void grid_extremes_free(double **values)
{
    if (values) free(values[0]);
    free(values);
}
