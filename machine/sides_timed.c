/* Switches that change at times which are known beforehand: the search in a table by the time, interp(t, T, A) or
 * interp((t - t0)/c, T, A). Nothing looks for their roots; runs end their steps at these times.
 *
 * Where the argument is a + b t, it is at point k of a table at the time (T[k] - a)/b. The side of the switch counts
 * the points by these times alone, so a time and its side agree to the last bit.
 */
#include "lang/model/table.h"
#include "machine/sides_parts.h"

#include <math.h>

typedef struct timed {
    size_t which;        /* its switch */
    uint16_t points;     /* the array of the points */
    size_t count;        /* of points */
    double from, rate;   /* the argument is from + rate t */
    const double *first; /* the points, in the pool */
} timed;

static const table *table_of(const model *m, node of)
{
    const table *found = NULL;
    for (uint32_t k = 0; k < m->table_count && !found; k++)
        if (m->tables[k]->array == graph_at(m->graph, of)->a) found = m->tables[k];
    return found;
}

bool sides_is_timed(const sides *s, size_t k)
{
    bool is = false;
    for (size_t i = 0; i < s->timed_count && !is; i++) is = s->timed[i].which == k;
    return is;
}

/* Makes the tape of all arguments and their rates. */
static bool make_times(sides *s, model *m)
{
    const size_t count = 2 * s->timed_count;
    output *o = arena_room(m->arena, (count + 1) * sizeof *o);
    uint16_t first;
    s->line = arena_room(m->arena, (count + 1) * sizeof *s->line);
    if (!o || !s->line || !model_take_arrays(m, (int)count, &first)) return false;
    for (size_t i = 0; i < count; i++) {
        const node u = graph_at(m->graph, s->switches->original[switches_kind(s->switches, s->timed[i / 2].which)])->a;
        graph_shape(m->arena, &m->arrays[first + i], SPACE_OUT, i, 0, NULL, NULL);
        o[i] = (output){.value = i % 2 ? graph_derivative(m->graph, u, graph_seed_time, NULL) : u,
                        .to = {.array = (uint16_t)(first + i)}};
    }
    s->times = tape_of(m->arena, m->graph, o, count);
    return s->times != NULL;
}

bool sides_find_timed(sides *s, model *m)
{
    const switches *w = s->switches;
    s->timed = arena_room(m->arena, (w->kinds + 1) * sizeof *s->timed);
    if (!s->timed) return false;
    for (size_t k = 0; k < w->kinds; k++) {
        const graph_node n = *graph_at(m->graph, w->original[k]);
        if (!switches_timed(m->graph, &n)) continue;
        const table *t = table_of(m, n.b);
        const extent *over = m->arrays[t->points].over;
        s->timed[s->timed_count++] =
            (timed){.which = w->first[k], .points = t->points, .count = (size_t)(over->last[0] - over->first[0] + 1)};
    }
    return !s->timed_count || make_times(s, m);
}

void sides_bind_timed(sides *s)
{
    double *base[SPACES] = {[SPACE_OUT] = s->line};
    if (s->timed_count) tape_run(s->times, 0, base);
    for (size_t i = 0; i < s->timed_count; i++) {
        timed *one = &s->timed[i];
        one->from = s->line[2 * i], one->rate = s->line[2 * i + 1];
        one->first = s->model->pool + s->model->arrays[one->points].base;
    }
}

/* Returns the time at which the argument is at point k, counted from 1. */
static double time_of(const timed *one, size_t k) { return (one->first[k - 1] - one->from) / one->rate; }

/* Returns whether point k counts for the side at time t: it has been reached, if the argument grows along the way; it
 * is still ahead, if the argument falls. */
static bool counts(const timed *one, size_t k, double way, double t)
{
    const double left = way * (time_of(one, k) - t);
    return way * one->rate > 0 ? left <= 0 : left > 0;
}

/* Returns the side at time t; near: the side before, beside which it usually is. */
static size_t side_at(const timed *one, double way, double t, double near)
{
    const size_t n = one->count;
    size_t low = 0, high = n + 1;
    for (int i = 0; i < 2; i++) {
        const double side = near + (i == 0 ? 0 : way * one->rate > 0 ? 1 : -1);
        if (!(side >= 0 && side <= (double)n)) continue;
        const size_t k = (size_t)side;
        if ((k == 0 || counts(one, k, way, t)) && (k == n || !counts(one, k + 1, way, t))) return k;
    }
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (counts(one, middle, way, t))
            low = middle;
        else
            high = middle;
    }
    return low;
}

double sides_next_time(void *ctx, double way, double t, const double *x)
{
    const sides *s = ctx;
    double next = way * INFINITY;
    for (size_t i = 0; i < s->timed_count; i++) {
        const timed *one = &s->timed[i];
        const size_t side = side_at(one, way, t, x[s->switches->slot + one->which]);
        const bool grows = way * one->rate > 0;
        if (grows ? side == one->count : side == 0) continue;
        const double at = time_of(one, grows ? side + 1 : side);
        if (way * (next - at) > 0) next = at;
    }
    return next;
}

int64_t sides_pass_times(void *ctx, double way, double t, double *x)
{
    const sides *s = ctx;
    int64_t passed = 0;
    for (size_t i = 0; i < s->timed_count; i++) {
        double *side = x + s->switches->slot + s->timed[i].which;
        const double now = (double)side_at(&s->timed[i], way, t, *side);
        passed += *side != now;
        *side = now;
    }
    return passed;
}
