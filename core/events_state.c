/* The part of a restart state that belongs to events: all that decides how they go on, and the table so far. See
 * events_parts.h.
 *
 * One function goes through these numbers, and counts, writes or reads them. The state at `left` is among them, because
 * the numbers of a stepper need not give it back to the bit; the functions there follow from it.
 *
 * A run with fixed steps that has come to its end is saved as it was before its last step: the end has shortened that
 * step, or set its time, and its events were found by steps that a run to a later end does not take.
 */
#include "core/events_parts.h"

#include <math.h>
#include <string.h>

typedef enum passage { PASS_COUNT, PASS_WRITE, PASS_READ } passage;

typedef struct pass {
    passage way;
    double *out;      /* PASS_WRITE */
    const double *in; /* PASS_READ */
    size_t at, count; /* count: how many numbers can be read */
    bool bad;         /* a number is missing, or could not have been written, or there is no memory */
    bool full;        /* there is no memory */
} pass;

/* Passes a number, which may be NaN or infinite: returns the one that is read or, where none is read, `value`. */
static double any(pass *p, double value)
{
    const size_t at = p->at++;
    if (p->way == PASS_WRITE) p->out[at] = value;
    if (p->way != PASS_READ) return value;
    p->bad |= at >= p->count;
    return p->bad ? 0 : p->in[at];
}

static double number(pass *p, double value)
{
    const double read = any(p, value);
    p->bad |= p->way == PASS_READ && !isfinite(read);
    return p->bad ? 0 : read;
}

/* Passes a whole number from `least` to `most`, which doubles represent. */
static int64_t whole(pass *p, int64_t value, int64_t least, int64_t most)
{
    const double read = any(p, (double)value);
    if (p->way != PASS_READ) return value;
    p->bad |= !(read >= (double)least && read <= (double)most && read == floor(read));
    return p->bad ? least : (int64_t)read;
}

#define COUNT_MOST ((int64_t)1 << 53)

static int64_t counter(pass *p, int64_t value) { return whole(p, value, 0, COUNT_MOST); }
static bool flag(pass *p, bool value) { return whole(p, value, 0, 1) != 0; }
static size_t number_of(pass *p, size_t value, size_t count)
{
    return (size_t)whole(p, (int64_t)value, 0, count ? (int64_t)count - 1 : 0);
}

static void numbers(pass *p, double *list, size_t count)
{
    for (size_t k = 0; k < count; k++) list[k] = number(p, list[k]);
}

static void flags(pass *p, uint8_t *list, size_t count)
{
    for (size_t k = 0; k < count; k++) list[k] = flag(p, list[k]);
}

static void signs(pass *p, int8_t *list, size_t count)
{
    for (size_t k = 0; k < count; k++) list[k] = (int8_t)whole(p, list[k], -1, 1);
}

/* ---- what there is ---- */

static void pass_instant(pass *p, events *e)
{
    instant *at = &e->left;
    at->t = number(p, at->t);
    at->lost = number(p, at->lost);
    numbers(p, at->x, e->problem.nx);
    numbers(p, at->v, e->problem.nv);
    numbers(p, e->most, e->problem.nx + e->problem.nv);
    e->taken = counter(p, e->taken);
    if (e->rules.pass) e->passed_times = counter(p, e->passed_times);
    e->pieces = counter(p, e->pieces);
    e->unseen = counter(p, e->unseen);
    e->unseen_at = any(p, e->unseen_at);
    e->unseen_function = number_of(p, e->unseen_function, e->rules.functions);
    if (p->way == PASS_READ) at->valued = false;
}

static void pass_functions(pass *p, events *e)
{
    const size_t f = e->rules.functions;
    signs(p, e->side, f);
    flags(p, e->stands, f);
    flags(p, e->open, f);
    signs(p, e->heads, f);
    for (size_t k = 0; k < f; k++) e->fired[k] = any(p, e->fired[k]);
}

static void pass_recent(pass *p, recent *r, int levels)
{
    r->number = counter(p, r->number);
    for (int k = 0; k < levels; k++) numbers(p, r->t + RECENT * k, (size_t)recent_count(r, k));
}

static void pass_rules(pass *p, events *e)
{
    for (size_t k = 0; k < e->rules.count; k++) {
        const rule *r = &e->rules.rule[k];
        e->count[k] = counter(p, e->count[k]);
        if (r->kind == RULE_CLOCK) e->ticks[k] = counter(p, e->ticks[k]);
        if (r->kind == RULE_CONDITION) flags(p, e->held + e->instances[k], r->instances);
        for (size_t i = 0; (r->kind == RULE_ROOT || r->kind == RULE_CONDITION) && r->assigns && i < r->instances; i++)
            pass_recent(p, &e->recent[e->instances[k] + i], recent_levels(r));
    }
}

/* Passes the instance of a rule, after a number that says whether there is one. */
static bool pass_instance(pass *p, const events *e, bool there, size_t *rule, size_t *instance)
{
    if (!flag(p, there)) return false;
    if (p->bad) return false;
    *rule = number_of(p, *rule, e->rules.count);
    *instance = number_of(p, *instance, e->rules.rule[*rule].instances);
    return true;
}

static void pass_accumulation(pass *p, events *e)
{
    const bool after = pass_instance(p, e, e->after_rule != SIZE_MAX, &e->after_rule, &e->after_instance);
    if (after) numbers(p, e->after, e->problem.nx + e->problem.nv);
    if (!after) e->after_rule = SIZE_MAX;
    e->tail = number(p, e->tail);
    e->growths = (int)whole(p, e->growths, 0, 48);
    const int marks = e->growths < GROWTH_MARKS ? e->growths : GROWTH_MARKS;
    numbers(p, e->growth_t, (size_t)marks);
    numbers(p, e->growth_most, (size_t)marks * (e->problem.nx + e->problem.nv));
    e->has_limit = pass_instance(p, e, e->has_limit, &e->limit.rule, &e->limit.instance);
    if (!e->has_limit) return;
    e->limit_told = flag(p, e->limit_told);
    e->limit.t = number(p, e->limit.t);
    e->limit.error = number(p, e->limit.error);
    e->limit.lasting = number(p, e->limit.lasting);
}

/* Passes the swarms, if the force has switches. */
static void pass_swarms(pass *p, events *e)
{
    const size_t all = e->problem.nx + e->problem.nv;
    for (int k = 0; e->rules.settle && k < SWARMS && !p->bad; k++) {
        swarm *s = &e->swarm[k];
        s->count = (int)whole(p, s->count, 0, 3);
        if (!s->count) continue;
        s->function = number_of(p, s->function, e->rules.functions);
        s->shorter = counter(p, s->shorter);
        s->parity = flag(p, s->parity);
        s->slows = flag(p, s->slows);
        numbers(p, s->t, s->count > 1 ? 2 : 1);
        s->cycle = number(p, s->cycle);
        s->longest = number(p, s->longest);
        s->marks = (int)whole(p, s->marks, 0, 2);
        for (int j = 0; j < s->marks; j++)
            s->mark[j].t = number(p, s->mark[j].t), s->mark[j].cycle = number(p, s->mark[j].cycle);
        double *state = e->swarm_state + 2 * (size_t)k * all;
        for (size_t j = 0; j < 2 * all; j++) state[j] = any(p, state[j]);
    }
}

static void pass_all(pass *p, events *e)
{
    e->steps = counter(p, e->steps);
    e->first = flag(p, e->first);
    e->end = (events_end)whole(p, e->end, EVENTS_END_NONE, EVENTS_END_ACCUMULATED);
    e->end_rule = number_of(p, e->end == EVENTS_END_NONE ? 0 : e->end_rule, e->rules.count);
    e->at_once = any(p, e->at_once);
    e->actions = (int)whole(p, e->actions, 0, EVENTS_AT_ONCE);
    e->acted = counter(p, e->acted);
    e->acted_sum = number(p, e->acted_sum);
    e->flights = counter(p, e->flights);
    e->flights_sum = number(p, e->flights_sum);
    e->turned_step = counter(p, e->turned_step);
    e->interval = any(p, e->interval);
    pass_instant(p, e);
    pass_functions(p, e);
    pass_rules(p, e);
    pass_accumulation(p, e);
    pass_swarms(p, e);
}

/* Passes the newest kept numbers. */
static void pass_kept(pass *p, events *e)
{
    const size_t n = e->rules.kept_count, last = e->kept_states - 1;
    if (!n) return;
    if (p->way != PASS_READ) {
        number(p, e->kept_state[last].t);
        for (size_t j = 0; j < n; j++) number(p, e->kept[last * n + j]);
        return;
    }
    const double t = number(p, 0);
    for (size_t j = 0; j < n; j++) e->next.x[e->rules.kept[j]] = number(p, 0);
    e->kept_states = 0;
    p->full = !p->bad && !events_keep_now(e, t, e->next.x);
    p->bad |= p->full;
}

static void write_row(pass *p, events *e, size_t k)
{
    const event *row = &e->row[k];
    const size_t all = e->problem.nx + e->problem.nv;
    any(p, (double)row->rule), any(p, (double)row->instance), any(p, (double)row->count);
    any(p, row->t), any(p, row->lasting), any(p, row->doubt), any(p, row->touched), any(p, row->changed);
    numbers(p, e->row_state + e->row_at[k], row->changed ? 2 * all : all);
}

static void read_row(pass *p, events *e)
{
    instant *to = &e->next;
    const size_t rule = number_of(p, 0, e->rules.count);
    const size_t instance = p->bad ? 0 : number_of(p, 0, e->rules.rule[rule].instances);
    const int64_t count = counter(p, 0), now = e->count[rule];
    to->t = number(p, 0);
    const double lasting = number(p, 0), doubt = number(p, 0);
    const bool touched = flag(p, false), changed = flag(p, false);
    for (int after = 0; after <= changed && !p->bad; after++) {
        numbers(p, to->x, e->problem.nx);
        numbers(p, to->v, e->problem.nv);
        if (p->bad) return;
        e->count[rule] = count; /* events_note takes it into the row */
        p->bad = p->full = !(after ? events_note_after(e, to) : events_note(e, rule, instance, touched, to));
        e->count[rule] = now;
        if (!p->bad) e->row[e->rows - 1].lasting = lasting, e->row[e->rows - 1].doubt = doubt;
    }
}

/* ---- writing ---- */

void events_may_save(events *e) { e->may_save = true; }

void events_unsave(events *e)
{
    give(&e->allocator, e->saved);
    e->saved = NULL;
}

static size_t head_count(events *e)
{
    pass p = {.way = PASS_COUNT};
    pass_all(&p, e);
    pass_kept(&p, e);
    return 1 + p.at;
}

static void write_head(events *e, const stepper *s, double *out)
{
    pass p = {.way = PASS_WRITE, .out = out};
    any(&p, stepper_leg(s));
    pass_all(&p, e);
    pass_kept(&p, e);
}

bool events_save_here(events *e, const stepper *s)
{
    const size_t head = head_count(e);
    events_unsave(e);
    e->saved = take(&e->allocator, head + stepper_carry(s), sizeof *e->saved);
    if (!e->saved) return false;
    e->saved_head = head;
    e->saved_rows = e->rows;
    e->saved_time = e->left.t;
    write_head(e, s, e->saved);
    e->saved_steps = stepper_save(s, e->saved + head);
    return true;
}

stepper_count events_save_stepper(const events *e, const stepper *s, double *carry)
{
    if (!e->saved) return stepper_save(s, carry);
    memcpy(carry, e->saved + e->saved_head, stepper_carry(s) * sizeof *carry);
    return e->saved_steps;
}

double events_saved_time(const events *e, const stepper *s) { return e->saved ? e->saved_time : stepper_time(s); }

size_t events_save(events *e, const stepper *s, double *out)
{
    const size_t head = e->saved ? e->saved_head : head_count(e), rows = e->saved ? e->saved_rows : e->rows;
    pass p = {.way = out ? PASS_WRITE : PASS_COUNT, .out = out, .at = head};
    if (out && e->saved) memcpy(out, e->saved, head * sizeof *out);
    if (out && !e->saved) write_head(e, s, out);
    any(&p, (double)rows);
    for (size_t k = 0; k < rows; k++) write_row(&p, e, k);
    return p.at;
}

/* ---- reading ---- */

/* Tells whether the stepper will stand at `left`. With fixed steps its time is a product, which may differ by rounding.
 * */
static bool stands(const events *e, const stepper *s, const events_leg *leg)
{
    const double there = row_adaptive(&e->method) ? stepper_time_saved(s, leg->then, leg->carry)
                                                  : e->began + (double)leg->then.steps * leg->step;
    return fabs(there - e->left.t) <= 16 * events_ulp(fmax(fabs(e->began), fabs(e->left.t)));
}

motus_status events_load(events *e, const stepper *s, const events_leg *leg, const double *in, size_t count,
                         motus_error *err)
{
    pass p = {.way = PASS_READ, .in = in, .count = count};
    e->start = e->grid_start = leg->start;
    e->grid_step = leg->step;
    e->until = e->leg_end = leg->until;
    e->way = leg->until < leg->start ? -1 : 1;
    e->limit = (events_limit){0};
    e->pace = INFINITY;
    events_unsave(e);
    e->rows = e->numbers = e->pasts = 0;
    e->began = number(&p, 0);
    pass_all(&p, e);
    pass_kept(&p, e);
    const int64_t rows = whole(&p, 0, 0, EVENTS_ROWS_MOST);
    for (int64_t k = 0; k < rows && !p.bad; k++) read_row(&p, e);
    if (p.full) return fail(err, MOTUS_MEMORY, "no memory for the events of the restart state");
    if (!p.bad && p.at == count && (!s || stands(e, s, leg))) return MOTUS_OK;
    fail(err, MOTUS_STATE, "what the restart state has of events is damaged");
    hint(err, "take the text as it was saved, unchanged");
    return MOTUS_STATE;
}

motus_status events_load_stepper(const events *e, stepper *s, const events_leg *leg, motus_error *err)
{
    return stepper_load_leg(s, e->began, leg->step, leg->then, leg->carry, err);
}

double events_time(const events *e) { return e->left.t; }
