/* Writes a plan as the tasks of tape_series_code.h, and counts the memory of its series. */
#include "lang/tape/tape_series_code.h"

#include <string.h>
#include "lang/tape/tape_isa.h"

typedef struct writer {
    plan plan;
    expansion expansion;
    tape_series *out;
    LIST(series_task) tasks;
    LIST(double) constants;
    uint32_t totals;
    uint32_t region;
} writer;

static void put(writer *w, series_task t)
{
    if (!ROOM(&w->plan, w->tasks)) return;
    w->tasks.at[w->tasks.count++] = t;
}

static uint32_t operand(const writer *w, node n)
{
    return plan_find(&w->plan, n, plan_home(&w->plan, w->plan.g->nodes[n].deps, w->region));
}

static void put_outputs(writer *w, uint32_t first)
{
    for (uint32_t k = first; k != NONE; k = w->plan.next_output[k])
        put(w, (series_task){.what = SERIES_PUT, .r = k, .a = operand(w, w->plan.program->outputs[k].value)});
}

static series_task leaf(writer *w, uint32_t item, const graph_node *n)
{
    series_task t = {.r = item, .a = n->a};
    switch (n->op) {
    case OP_CONST:
        t.what = SERIES_CONST;
        t.a = w->constants.count;
        if (ROOM(&w->plan, w->constants)) w->constants.at[w->constants.count++] = n->value;
        break;
    case OP_TIME: t.what = SERIES_TIME; break;
    case OP_PARAM: t.what = SERIES_PARAM; break;
    case OP_TABLE: t.what = SERIES_TABLE; break;
    case OP_INDEX: t.what = SERIES_INDEX, t.a = n->level; break;
    default: t.what = w->expansion.values[item].state ? SERIES_STATE : SERIES_FETCH; break;
    }
    return t;
}

static void put_item(writer *w, uint32_t item)
{
    const plan_item *i = &w->plan.items.at[item];
    const graph_node *n = &w->plan.g->nodes[i->n];
    const expansion_value *v = &w->expansion.values[item];
    const int arity = operation_at(n->op)->arity;
    series_task t = {.r = item, .op = n->op};
    if (n->op == OP_SUM) {
        t.what = SERIES_TOTAL;
        t.a = w->plan.sums.at[i->sum].total;
    } else if (arity == 0) {
        t = leaf(w, item, n);
    } else if (v->twin != NONE) {
        t.what = SERIES_TWIN;
        t.a = v->twin;
    } else {
        t.a = operand(w, n->a);
        t.b = arity > 1 ? operand(w, n->b) : t.a;
        t.c = arity > 2 ? operand(w, n->c) : t.a;
        t.begins = expansion_begins(&w->expansion, &w->plan, item);
    }
    t.at = v->at;
    put(w, t);
    put_outputs(w, i->outputs);
}

static void put_update(writer *w, const plan_item *update)
{
    const plan_item *whole = &w->plan.items.at[plan_updates(&w->plan, update)];
    const graph_node *sum = &w->plan.g->nodes[whole->n], *how = &w->plan.g->nodes[sum->a];
    const bool fused = how->op != OP_ADD;
    put(w, (series_task){.what = SERIES_UPDATE,
                         .op = how->op,
                         .r = w->plan.sums.at[whole->sum].total,
                         .a = operand(w, fused ? how->a : how->b),
                         .b = operand(w, how->b),
                         .c = sum->b ? operand(w, sum->b) : NONE,
                         .at = (uint32_t)w->plan.regions.at[w->region].level});
}

/* Writes a loop; the totals of its sums lie side by side. */
static void put_loop(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    series_region *to = &w->out->regions[region];
    to->first_total = w->totals;
    for (uint32_t k = r->sums; k != NONE; k = w->plan.sums.at[w->plan.items.at[k].sum].next) {
        w->plan.sums.at[w->plan.items.at[k].sum].total = w->totals++;
        w->plan.items.at[k].reg = 0; /* its loop has been written */
    }
    to->total_count = w->totals - to->first_total;
    put(w, (series_task){.what = SERIES_LOOP, .a = region});
}

/* Writes the tasks of one region; the regions inside follow later. */
static void put_region(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    series_region *to = &w->out->regions[region];
    w->region = region;
    *to = (series_region){.first = w->tasks.count,
                          .frame = w->expansion.frames[region],
                          .first_total = to->first_total,
                          .total_count = to->total_count,
                          .level = r->level,
                          .sum = r->sum,
                          .range = r->range};
    put_outputs(w, r->outputs);
    for (uint32_t k = 0; k < r->item_count && !w->plan.failed; k++) {
        const uint32_t item = w->plan.order[r->items + k];
        const plan_item *i = &w->plan.items.at[item];
        const uint32_t inside = plan_inside(&w->plan, i);
        if (inside != NONE && i->reg == NONE) put_loop(w, inside);
        if (plan_updates(&w->plan, i) != NONE)
            put_update(w, i);
        else
            put_item(w, item);
    }
    for (uint32_t k = r->first_child; k != NONE && !w->plan.failed; k = w->plan.regions.at[k].next)
        if (!w->plan.regions.at[k].sum && region != AT_BIND) put(w, (series_task){.what = SERIES_LOOP, .a = k});
    to->count = w->tasks.count - to->first;
}

static bool write(writer *w, arena *a, int length)
{
    const uint32_t items = w->plan.items.count, regions = w->plan.regions.count;
    tape_series *s = w->out;
    if (!expansion_place(&w->expansion, a, &w->plan, length, false)) return false;
    s->regions = arena_room(a, regions * sizeof *s->regions);
    s->last = arena_room(a, (items + 1) * sizeof *s->last);
    s->at = arena_room(a, (items + 1) * sizeof *s->at);
    if (!s->regions || !s->last || !s->at) return false;
    for (uint32_t k = 0; k < items; k++) s->last[k] = w->expansion.values[k].last;
    for (uint32_t r = 0; r < regions; r++)
        put_region(w, r); /* the region of a loop has a higher number than the one around it */
    s->totals = arena_room(a, (w->totals + 1) * sizeof *s->totals);
    s->region_count = regions;
    return s->totals && !w->plan.failed;
}

tape_series *tape_series_create(arena *a, const program *program, int length)
{
    tape_series *s = arena_room(a, sizeof *s);
    if (!s) return NULL;
    writer w = {.out = s};
    *s = (tape_series){.length = length, .program = program, .machine = tape_machine_at(0)};
    bool ok = plan_create(&w.plan, a, program, false) && write(&w, a, length);
    s->tasks = KEPT(&w.plan, a, w.tasks);
    s->constants = KEPT(&w.plan, a, w.constants);
    plan_release(&w.plan);
    if (!ok) a->failed = true;
    return a->failed ? NULL : s;
}

/* Memory ----------------------------------------------------------------------------------------------------------- */

typedef struct counting {
    const tape_series *s;
    int64_t index[MAX_LEVELS];
} counting;

/* Returns whether a bound of a loop inside a region depends on the index of a level. */
static bool depends(const tape_series *s, uint32_t region, int level)
{
    const series_region *r = &s->regions[region];
    for (uint32_t k = 0; k < r->count; k++) {
        const series_task *t = &s->tasks[r->first + k];
        if (t->what != SERIES_LOOP) continue;
        const range *inside = &s->regions[t->a].range;
        if (inside->first.level == level || inside->last.level == level || depends(s, t->a, level)) return true;
    }
    return false;
}

static size_t numbers_of(counting *c, uint32_t region)
{
    const tape_series *s = c->s;
    const series_region *r = &s->regions[region];
    size_t all = r->frame;
    for (uint32_t k = 0; k < r->count; k++) {
        const series_task *t = &s->tasks[r->first + k];
        if (t->what != SERIES_LOOP) continue;
        const series_region *inside = &s->regions[t->a];
        const int64_t first = graph_subscript(&inside->range.first, c->index, s->binding.ints),
                      last = graph_subscript(&inside->range.last, c->index, s->binding.ints);
        if (last < first) continue;
        c->index[inside->level] = first;
        if (!depends(s, t->a, inside->level)) {
            size_t runs = (size_t)(last - first + 1);
            if (inside->level == 0 && !inside->sum)
                runs = (runs + EXPANSION_LANES - 1) / EXPANSION_LANES * EXPANSION_LANES;
            all += runs * numbers_of(c, t->a);
            continue;
        }
        for (; c->index[inside->level] <= last; c->index[inside->level]++) all += numbers_of(c, t->a);
    }
    return all;
}

void tape_series_bind(tape_series *s, const binding *b)
{
    counting c = {.s = s};
    s->binding = *b;
    s->bound = numbers_of(&c, AT_BIND);
    /* vectors begin at a multiple of their size, after one series that nothing uses (emit_series.c) */
    s->numbers = s->bound + numbers_of(&c, AT_RUN) + EXPANSION_LANES * (size_t)(s->length + 1);
}

size_t tape_series_numbers(const tape_series *s) { return s->numbers; }

void tape_series_run(tape_series *s, const series_pass *pass) { s->machine->expand(s, pass); }
