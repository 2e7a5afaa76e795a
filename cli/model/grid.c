/* The values that --vary and --random give to each trajectory.
 *
 * Invariant: the values of a trajectory depend only on its number.
 */
#include "cli/model/grid.h"

#include "cli/model/draw.h"
#include "cli/words/complain.h"

#include <stdlib.h>
#include <string.h>

/* Fails if a name is varied twice, or set and varied. */
static motus_status check_name(const grid *g, const options *o, size_t k, motus_error *err)
{
    const char *name = g->axes[k].name;
    for (size_t i = 0; i < k; i++)
        if (strcmp(g->axes[i].name, name) == 0) return fail(err, MOTUS_ARGUMENT, "%s is varied twice", name);
    for (size_t i = 0; i < o->set.count; i++) {
        size_t length = strcspn(o->set.items[i], "=");
        while (length > 0 && o->set.items[i][length - 1] == ' ') length--;
        if (length == strlen(name) && strncmp(o->set.items[i], name, length) == 0)
            return fail(err, MOTUS_ARGUMENT, "%s is both set and varied", name);
    }
    return MOTUS_OK;
}

static motus_status too_many(motus_error *err)
{
    return complain(err, MOTUS_LIMIT,
                    "--zip pairs the values instead of combining all; --random with --count draws a sample",
                    "the sweep has more than %llu trajectories", (unsigned long long)GRID_MOST);
}

static motus_status count_points(grid *g, size_t varied, motus_error *err)
{
    uint64_t points = 1;
    for (size_t k = 0; k < varied; k++) {
        uint64_t n = g->axes[k].count;
        if (!g->zip && points > GRID_MOST / n) return too_many(err);
        if (g->zip && k > 0 && n != points)
            return complain(err, MOTUS_ARGUMENT, "give every --vary the same number of values",
                            "--zip: %s has %llu values, %s has %llu", g->axes[0].name, (unsigned long long)points,
                            g->axes[k].name, (unsigned long long)n);
        points = g->zip ? n : points * n;
    }
    if (points > GRID_MOST / g->draws) return too_many(err);
    g->total = points * g->draws;
    return MOTUS_OK;
}

static motus_status check(const options *o, motus_error *err)
{
    if (o->vary.count + o->random.count == 0)
        return complain(err, MOTUS_ARGUMENT,
                        "--vary F=0:1:11, --random \"x(0)=-1:1\" --count 100; motus run integrates a single one",
                        "motus sweep needs --vary or --random: without them all trajectories are equal");
    if (o->random.count > 0 && o->vary.count == 0 && o->count == 0)
        return complain(err, MOTUS_ARGUMENT, "add --count 100", "--random needs --count, the number of trajectories");
    if (o->random.count == 0 && (o->count > 0 || o->given[OPTION_seed]))
        return complain(err, MOTUS_ARGUMENT, "add --random F=0:1; the count of a --vary is its third number, F=0:1:11",
                        "%s needs --random", o->count > 0 ? "--count" : "--seed");
    if (o->zip && o->vary.count < 2) return fail(err, MOTUS_ARGUMENT, "--zip needs at least two --vary");
    return MOTUS_OK;
}

motus_status grid_read(grid *g, const options *o, motus_error *err)
{
    *g = (grid){.zip = o->zip, .seed = o->seed, .draws = o->count > 0 ? (uint64_t)o->count : 1};
    motus_status status = check(o, err);
    if (status) return status;
    size_t count = o->vary.count + o->random.count;
    g->axes = calloc(count, sizeof *g->axes);
    g->names = calloc(count, sizeof *g->names);
    if (!g->axes || !g->names) return complain_memory(err);
    for (size_t k = 0; !status && k < count; k++) {
        bool drawn = k >= o->vary.count;
        g->count++;
        status = axis_read(&g->axes[k], drawn ? "--random" : "--vary",
                           drawn ? o->random.items[k - o->vary.count] : o->vary.items[k], err);
        g->names[k] = g->axes[k].name;
        if (!status) status = check_name(g, o, k, err);
    }
    return status ? status : count_points(g, o->vary.count, err);
}

static double value(const grid *g, size_t k, uint32_t stream, uint64_t place, uint64_t trajectory)
{
    const axis *a = &g->axes[k];
    switch (a->kind) {
    case AXIS_RANGE: return range_value(&a->range, place);
    case AXIS_LIST: return a->list[place];
    case AXIS_UNIFORM: return a->range.from + draw_uniform(g->seed, stream, trajectory) * (a->range.to - a->range.from);
    case AXIS_NORMAL: return a->range.from + draw_normal(g->seed, stream, trajectory) * a->range.to;
    }
    return 0;
}

void grid_values(const grid *g, uint64_t first, size_t count, double *const *values)
{
    size_t varied = 0;
    while (varied < g->count && g->axes[varied].kind <= AXIS_LIST) varied++;
    for (size_t k = varied; k < g->count; k++)
        for (size_t i = 0; i < count; i++) values[k][i] = value(g, k, (uint32_t)(k - varied), 0, first + i);
    uint64_t repeat = g->draws; /* how many successive trajectories share a value of axis k */
    for (size_t k = varied; k-- > 0;) {
        uint64_t n = g->axes[k].count, place = first / repeat % n, left = repeat - first % repeat;
        double v = value(g, k, 0, place, 0);
        for (size_t i = 0; i < count; i++) {
            if (left-- == 0) {
                left = repeat - 1;
                place = place + 1 == n ? 0 : place + 1;
                v = value(g, k, 0, place, 0);
            }
            values[k][i] = v;
        }
        if (!g->zip) repeat *= n;
    }
}

size_t grid_find(const grid *g, const char *name)
{
    size_t k = 0;
    while (k < g->count && strcmp(g->names[k], name)) k++;
    return k;
}

size_t grid_axis_values(const grid *g, size_t axis, uint64_t first, size_t count, double *values)
{
    const bool drawn = g->axes[axis].kind > AXIS_LIST;
    const uint64_t all = drawn ? g->total : g->axes[axis].count;
    uint32_t stream = 0; /* the number of random axes before this one */
    for (size_t k = 0; k < axis; k++) stream += drawn && g->axes[k].kind > AXIS_LIST;
    size_t n = 0;
    for (; n < count && first + n < all; n++) values[n] = value(g, axis, stream, first + n, first + n);
    return n;
}

void grid_free(grid *g)
{
    for (size_t k = 0; k < g->count; k++) axis_free(&g->axes[k]);
    free(g->axes);
    free(g->names);
    *g = (grid){0};
}

/* ---- the trajectories that are furthest apart ---- */

enum {
    ALL = 16,      /* up to this many trajectories, all are taken */
    CORNERS = 4,   /* up to this many axes, all corners are taken */
    ROWS = 64,     /* at most this many are taken */
    DEVIATIONS = 3 /* the ends of a normal distribution: this many deviations from the mean */
};

/* Finds the indices of the least and the largest value of --vary. */
static void ends_of(const axis *a, uint64_t *least, uint64_t *largest)
{
    *least = 0;
    *largest = a->kind == AXIS_RANGE ? a->count - 1 : 0;
    for (uint64_t i = 0; a->kind == AXIS_LIST && i < a->count; i++) {
        if (a->list[i] < a->list[*least]) *least = i;
        if (a->list[i] > a->list[*largest]) *largest = i;
    }
}

/* Returns the lower end of an axis (side -1), its upper end (1), or its middle (0). */
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

/* Returns the side of axis k in a row. The first row has the middles of all axes. The others are the corners, or, if
 * there are many axes, an end of one axis and the opposite ends of the others. */
static int side_of(const grid *g, size_t row, size_t k)
{
    if (row == 0) return 0;
    if (g->count <= CORNERS) return ((row - 1) >> k) & 1 ? 1 : -1;
    const int side = row % 2 ? 1 : -1;
    return (row - 1) / 2 == k ? side : -side;
}

/* Fills the rows of a sweep with --zip: at the ends of each varied axis, the values of all. Random axes are at their
 * own ends. Returns the number of rows. */
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
