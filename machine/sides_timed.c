/* Switches that change at times which are known beforehand: |t - 5|, t < 3, floor(t/dt), max(0, 1 - |t|), the search in
 * a table of the time. Nothing looks for their roots; runs end their steps at these times.
 *
 * While the sides are held, an argument is a + b t, and has the value c at the time (c - a)/b. Sides follow from these
 * times alone, so a time and a side agree to the last bit.
 */
#include "lang/model/table.h"
#include "machine/sides_parts.h"

#include <math.h>

typedef struct timed {
    size_t which; /* its switch */
    operation op;
    uint16_t points;   /* FIND: the array of the table of points */
    size_t count;      /* FIND: how many they are */
    double from, rate; /* the argument is from + rate t */
    const double *at;  /* FIND: that table, in the pool */
} timed;

static const table *table_of(const model *m, node of)
{
    const table *found = NULL;
    for (uint32_t k = 0; k < m->table_count && !found; k++)
        if (m->tables[k]->array == graph_at(m->graph, of)->a) found = m->tables[k];
    return found;
}

/* Makes the tapes of all arguments and of their rates, to the numbers of their switches. */
static bool make_tapes(sides *s, model *m)
{
    const switches *w = s->switches;
    output *from = arena_room(m->arena, 2 * (w->kinds + 1) * sizeof *from), *rate = from + w->kinds;
    size_t count = 0;
    s->line = arena_room(m->arena, 2 * (w->count + 1) * sizeof *s->line);
    if (!from || !s->line) return false;
    for (size_t k = 0; k < w->kinds; k++) {
        const graph_node n = *graph_at(m->graph, w->original[k]);
        if (!switches_timed(m->graph, &n)) continue;
        from[count] = rate[count] = w->held[k];
        if (n.op == OP_FIND) from[count].value = w->within[k];
        s->nested |= (graph_deps(m->graph, from[count].value) & DEP_MODE) != 0;
        rate[count].value = graph_derivative(m->graph, from[count].value, graph_seed_time, NULL);
        count++;
    }
    s->from = tape_of(m->arena, m->graph, from, count);
    s->rates = tape_of(m->arena, m->graph, rate, count);
    return s->from && s->rates;
}

bool sides_find_timed(sides *s, model *m)
{
    const switches *w = s->switches;
    s->timed = arena_room(m->arena, (w->count + 1) * sizeof *s->timed);
    s->is_timed = arena_take(m->arena, w->count + 1);
    if (!s->timed || !s->is_timed) return false;
    for (size_t k = 0; k < w->kinds; k++) {
        const graph_node n = *graph_at(m->graph, w->original[k]);
        if (!switches_timed(m->graph, &n)) continue;
        timed one = {.op = (operation)n.op};
        if (n.op == OP_FIND) {
            const table *t = table_of(m, n.b);
            const extent *over = m->arrays[t->points].over;
            one.points = t->array, one.count = (size_t)(over->last[0] - over->first[0] + 1);
        }
        for (size_t i = 0; i < switches_cells(w, k); i++) {
            one.which = w->first[k] + i;
            s->is_timed[one.which] = 1;
            s->timed[s->timed_count++] = one;
        }
    }
    return !s->timed_count || make_tapes(s, m);
}

/* Computes the arguments and their rates at t = 0, while these sides are held. */
static void measure(sides *s, double *x)
{
    const size_t count = s->switches->count;
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_OUT] = s->line};
    tape_run(s->from, 0, base);
    base[SPACE_OUT] = s->line + count;
    tape_run(s->rates, 0, base);
    for (size_t i = 0; i < s->timed_count; i++) {
        timed *one = &s->timed[i];
        one->from = s->line[one->which], one->rate = s->line[count + one->which];
    }
}

void sides_bind_timed(sides *s)
{
    if (!s->timed_count) return;
    for (size_t k = 0; k < 2 * s->switches->count; k++) s->line[k] = 0; /* a cell without a switch never changes */
    for (size_t i = 0; i < s->timed_count; i++)
        if (s->timed[i].op == OP_FIND) s->timed[i].at = s->model->pool + s->model->arrays[s->timed[i].points].base;
    if (!s->nested) measure(s, NULL);
}

/* Returns the value of the argument at which side k begins, from below: a point of a table, or a whole number. */
static double value_of(const timed *one, double k) { return one->op == OP_FIND ? table_point(one->at, (size_t)k) : k; }

static double time_of(const timed *one, double value) { return (value - one->from) / one->rate; }

/* Returns whether the argument is beyond a value at time t, in the direction of growing arguments; at the value itself
 * it is where it comes next. */
static bool beyond(const timed *one, double value, double way, double t)
{
    if (one->rate == 0) return one->from >= value;
    const double left = way * (time_of(one, value) - t);
    return way * one->rate > 0 ? left <= 0 : left > 0;
}

/* Returns the number of the interval in which the argument of a switch that counts is at time t; near: one beside which
 * it usually is. */
static double count_at(const timed *one, double way, double t, double near)
{
    const bool finds = one->op == OP_FIND;
    const double n = (double)one->count;
    if (finds && one->rate == 0 && one->from == value_of(one, n)) return n - 1; /* it rests at the last point */
    double low = finds ? 0 : floor(one->from + one->rate * t) - 2, high = finds ? n + 1 : low + 5;
    for (int i = 0; i < 2; i++) {
        const double k = near + (i == 0 ? 0 : way * one->rate > 0 ? 1 : -1);
        if (!(k >= low && k < high)) continue;
        const bool reached = (finds && k == 0) || beyond(one, value_of(one, k), way, t);
        if (reached && ((finds && k == n) || !beyond(one, value_of(one, k + 1), way, t))) return k;
    }
    while (high - low > 1) {
        const double middle = low + floor((high - low) / 2);
        if (beyond(one, value_of(one, middle), way, t))
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double side_at(const timed *one, double way, double t, double near)
{
    return switches_counts(one->op) ? count_at(one, way, t, near)
                                    : switches_side(one->op, beyond(one, 0, way, t) ? 1 : -1, 0);
}

/* Returns the first time after t at which one switch changes. */
static double next_of(const timed *one, double way, double t, double side)
{
    const bool grows = way * one->rate > 0, finds = one->op == OP_FIND;
    if (one->rate == 0) return way * INFINITY;
    if (!switches_counts(one->op)) return beyond(one, 0, way, t) == grows ? way * INFINITY : time_of(one, 0);
    const double k = count_at(one, way, t, side) + (grows ? 1 : 0);
    return finds && (k < 1 || k > (double)one->count) ? way * INFINITY : time_of(one, value_of(one, k));
}

double sides_next_time(void *ctx, double way, double t, double *x)
{
    sides *s = ctx;
    double next = way * INFINITY;
    if (s->nested) measure(s, x);
    for (size_t i = 0; i < s->timed_count; i++) {
        const double at = next_of(&s->timed[i], way, t, x[s->switches->slot + s->timed[i].which]);
        if (way * (next - at) > 0) next = at;
    }
    return next;
}

int64_t sides_pass_times(sides *s, double way, double t, double *x, bool *jumps)
{
    int64_t passed = 0;
    *jumps = false;
    for (int pass = 0; pass < (s->nested ? NESTED : 1); pass++) {
        const int64_t before = passed;
        if (s->nested) measure(s, x);
        for (size_t i = 0; i < s->timed_count; i++) {
            double *side = x + s->switches->slot + s->timed[i].which;
            const double now = side_at(&s->timed[i], way, t, *side);
            passed += *side != now;
            *jumps |= *side != now && switches_jumps(s->timed[i].op) && s->timed[i].op != OP_FIND;
            *side = now;
        }
        if (passed == before) break;
    }
    return passed;
}
