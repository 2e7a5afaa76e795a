/* See ruled.h.
 *
 * All functions are one tape. Every rule that assigns has a tape of its own, whose loops over instances begin and end
 * at an int slot, so one event costs one instance.
 */
#include "machine/ruled.h"

#include "base/decimal.h"
#include "lang/graph/graph_place.h"
#include "lang/model/resolution.h"
#include "lang/model/undefined.h"
#include "lang/model/whole.h"
#include "lang/tape/lone.h"
#include "lang/tape/tape.h"
#include "machine/arguments.h"
#include "machine/least.h"
#include "machine/rounding.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FEW = 16 }; /* functions: so few take no longer together than one alone */

typedef struct leaf {
    const rule *rule;
    size_t first; /* its first function */
    bool bends;   /* a function of it is no polynomial */
} leaf;

struct ruled {
    model *model;
    rules supplied;
    rule *rule;
    tape *of[RULED_NUMBERS]; /* NULL: there are no functions */
    ruled_faster faster;     /* NULL: the tapes compute all */
    void *faster_ctx;
    resolution *within, *rates_within; /* the functions and their rates as intervals */
    interval *in_x, *in_v, *in_a, *is; /* room for the intervals of the state and of all
                                                            * functions */
    leaf *leaf;                        /* of all rules, in the order of their functions */
    size_t leaves;
    arguments *arguments;
    lone *alone[RULE_NUMBERS]; /* single functions of every leaf; NULL: there are few, or they contain sums */
    tape *periods;             /* of the clocks, by the numbers of their rules; NULL: there are none */
    double *period;
    tape **act;      /* of each rule; NULL: it assigns nothing */
    int64_t *ints;   /* the numbers of the model, then the present values of MAX_DIMS indices */
    double *becomes; /* room for the assigned values of one rule */
};

/* ---- functions ---- */

/* Computes a number of all functions. A cell outside the ranges has none and becomes `else_`. */
static void run(const ruled *r, ruled_number number, double time, double else_, double *base[SPACES])
{
    if (r->faster && r->faster(r->faster_ctx, number, time, base)) return;
    for (size_t k = 0; k < r->supplied.functions; k++) base[SPACE_OUT][k] = else_;
    if (r->of[number]) tape_run(r->of[number], time, base);
}

static int values(void *ctx, double t, double *x, double *v, double *out)
{
    run(ctx, RULED_VALUES, t, NAN, (double *[SPACES]){[SPACE_X] = x, [SPACE_V] = v, [SPACE_OUT] = out});
    return 0;
}

static int rates(void *ctx, double t, double *x, double *v, double *a, double *out)
{
    run(ctx, RULED_RATES, t, NAN, (double *[SPACES]){[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a, [SPACE_OUT] = out});
    return 0;
}

static void rounding(void *ctx, double t, double *x, double *v, double *out)
{
    const ruled *r = ctx;
    run(r, RULED_ROUNDING, t, NAN, (double *[SPACES]){[SPACE_X] = x, [SPACE_V] = v, [SPACE_OUT] = out});
    for (size_t k = 0; k < r->supplied.functions; k++) out[k] *= 0x1p-53;
}

static void least(void *ctx, double *x, double *v, double *dx, double *dv, double *out)
{
    run(ctx, RULED_LEAST, NAN, INFINITY,
        (double *[SPACES]){[SPACE_X] = x, [SPACE_V] = v, [SPACE_DX] = dx, [SPACE_DV] = dv, [SPACE_OUT] = out});
}

static void least_rates(void *ctx, double *x, double *v, double *dx, double *dv, double *out)
{
    run(ctx, RULED_LEAST_RATES, NAN, INFINITY,
        (double *[SPACES]){[SPACE_X] = x, [SPACE_V] = v, [SPACE_DX] = dx, [SPACE_DV] = dv, [SPACE_OUT] = out});
}

/* Returns the number of the leaf to which function f belongs. */
static size_t leaf_of(const ruled *r, size_t f)
{
    size_t low = 0, high = r->leaves;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        *(r->leaf[middle].first <= f ? &low : &high) = middle;
    }
    return low;
}

static bool may_be_narrow(void *ctx, size_t f)
{
    const ruled *r = ctx;
    return r->leaf[leaf_of(r, f)].bends;
}

static void indices_of(const model_rule *rule, size_t instance, int64_t *index)
{
    for (int k = rule->own - 1; k >= 0; k--) {
        const size_t length = (size_t)(rule->last[k] - rule->first[k] + 1);
        index[k] = rule->first[k] + (int64_t)(instance % length);
        instance /= length;
    }
}

static double alone(void *ctx, rule_number what, size_t f, double t, double *x, double *v, double *a)
{
    const ruled *r = ctx;
    const size_t number = leaf_of(r, f);
    const leaf *l = &r->leaf[number];
    int64_t index[MAX_LEVELS] = {0};
    indices_of(&r->model->rules[l->rule - r->rule], f - l->first, index);
    const binding b = {r->model->arrays, r->ints, r->model->pool};
    const double value =
        lone_run(r->alone[what], number, index, &b, t, (double *[SPACES]){[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a});
    return what == RULE_ROUNDING ? value * 0x1p-53 : value;
}

static void arguments_at(void *ctx, double t, double *x, double *v, double *out)
{
    const ruled *r = ctx;
    arguments_run(r->arguments, r->supplied.functions, t, x, v, out);
}

static bool regular(void *ctx, size_t f, const double *low, const double *high)
{
    const ruled *r = ctx;
    return arguments_regular(r->arguments, leaf_of(r, f), low, high);
}

static void enclose(interval *to, const double *middle, const double *half, size_t count)
{
    for (size_t k = 0; k < count; k++) to[k] = (interval){middle[k] - half[k], middle[k] + half[k]};
}

static bool apart(void *ctx, size_t f, bool rate, const double t[2], const double *x, const double *v, const double *dx,
                  const double *dv, const double *most)
{
    const ruled *r = ctx;
    const model *m = r->model;
    if (rate && r->leaf[leaf_of(r, f)].rule->jump) return false; /* the rate says nothing of its jumps */
    enclose(r->in_x, x, dx, m->nx);
    enclose(r->in_v, v, dv, m->nv);
    for (size_t k = 0; k < m->nv; k++) r->in_a[k] = (interval){-most[k], most[k]};
    r->is[f] = (interval){1, 1}; /* a cell without a rule */
    resolution_values(rate ? r->rates_within : r->within, (interval){fmin(t[0], t[1]), fmax(t[0], t[1])}, r->in_x,
                      r->in_v, r->in_a, m->pool, r->is);
    const interval size = interval_magnitude(r->is[f]);
    return size.low > 0x1p-40 * size.high; /* intervals are not rounded outward */
}

/* ---- actions ---- */

typedef struct assigning {
    const ruled *ruled;
    const model_rule *rule;
    const model_assignment *one;
    int64_t index[MAX_LEVELS];
    double *x, *v;
    bool *in_v;
    size_t *which;
} assigning;

/* Copies the values of an assignment to their places, for all indices from `level` on. With `check` it copies nothing,
 * and returns false where a value is not finite. */
static bool copy(assigning *s, int level, bool check)
{
    const ruled *r = s->ruled;
    const model *m = r->model;
    const model_rule *rule = s->rule;
    if (level == s->one->value.loops) {
        const double value = r->becomes[graph_element(m->arrays, &s->one->value.to, s->index, r->ints)];
        const size_t at = graph_element(m->arrays, &s->one->to, s->index, r->ints);
        const bool in_v = m->arrays[s->one->to.array].space == SPACE_V;
        if (check && !isfinite(value)) {
            *s->in_v = in_v;
            *s->which = at;
            return false;
        }
        if (!check) (in_v ? s->v : s->x)[at] = value;
        return true;
    }
    const int64_t first = graph_subscript(&rule->loop[level].first, s->index, r->ints),
                  last = graph_subscript(&rule->loop[level].last, s->index, r->ints);
    for (s->index[level] = first; s->index[level] <= last; s->index[level]++)
        if (!copy(s, level + 1, check)) return false;
    return true;
}

static int act(void *ctx, size_t number, size_t instance, double t, double *x, double *v, bool *in_v, size_t *which)
{
    const ruled *r = ctx;
    const model_rule *rule = &r->model->rules[number];
    if (!r->act[number]) return 0;
    assigning s = {.ruled = r, .rule = rule, .x = x, .v = v, .in_v = in_v, .which = which};
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_OUT] = r->becomes};
    indices_of(rule, instance, s.index);
    memcpy(r->ints + r->model->int_count, s.index, MAX_DIMS * sizeof *r->ints);
    tape_run(r->act[number], t, base);
    for (int check = 1; check >= 0; check--)
        for (size_t k = 0; k < rule->assignments; k++) {
            s.one = &rule->assignment[k];
            if (!copy(&s, rule->own, check)) return 1;
        }
    return 0;
}

static void name(void *ctx, size_t number, size_t instance, char *out, size_t size)
{
    const ruled *r = ctx;
    const model_rule *rule = &r->model->rules[number];
    int64_t index[MAX_DIMS];
    indices_of(rule, instance, index);
    size_t n = (size_t)snprintf(out, size, "%s", rule->name);
    for (int k = 0; k < rule->own && n < size; k++)
        n += (size_t)snprintf(out + n, size - n, "%s%lld%s", k ? "," : "[", (long long)index[k],
                              k == rule->own - 1 ? "]" : "");
}

static motus_status undefined(void *ctx, size_t f, double last, double t, const double *x, const double *v,
                              motus_error *err)
{
    const ruled *r = ctx;
    const leaf *l = &r->leaf[leaf_of(r, f)];
    model *m = r->model;
    const model_rule *of = &m->rules[l->rule - r->rule];
    undefined_term u;
    char at[DECIMAL_MAX], of_event[MOTUS_NAME_MAX + 64];
    if (!undefined_find(m, of->leaf, of->leaves, f, t, x, v, &u) || !u.outside[0]) return MOTUS_OK;
    if (u.holds && !isnan(u.time)) last = u.time;
    name(ctx, (size_t)(l->rule - r->rule), f - l->first, of_event, sizeof of_event);
    fail(err, MOTUS_EVENTS, "at t = %s the occasion of %s has no value: %s", decimal(last, at), of_event, u.outside);
    if (err) err->time = last;
    undefined_hint(&u, undefined_until(&u, last, m->start), last == m->start, err);
    return MOTUS_EVENTS;
}

/* ---- making ---- */

/* Makes what computes single functions, rates, and bounds on rounding. */
static bool make_alone(ruled *r, model *m, output *const outputs[RULED_NUMBERS], size_t count)
{
    if (r->supplied.functions < FEW) return true;
    const output *const of[RULE_NUMBERS] = {outputs[RULED_VALUES], outputs[RULED_RATES], outputs[RULED_ROUNDING]};
    bool all = true;
    for (int k = 0; k < RULE_NUMBERS; k++) {
        if (!lone_create(m->arena, m->graph, of[k], count, &r->alone[k])) return false;
        all &= r->alone[k] != NULL;
    }
    if (all) r->supplied.alone = alone;
    return true;
}

bool ruled_outputs(model *m, output *of[RULED_NUMBERS], size_t *count)
{
    output *nearest = least_sizes(m, count);
    if (!nearest || !*count) return nearest != NULL;
    output *leaves = arena_room(m->arena, 3 * *count * sizeof *leaves), *rate = leaves + *count,
           *slowest = rate + *count;
    if (!leaves) return false;
    for (uint32_t i = 0, n = 0; i < m->rule_count; i++)
        for (size_t k = 0; k < m->rules[i].leaves; k++, n++) {
            leaves[n] = rate[n] = slowest[n] = m->rules[i].leaf[k];
            rate[n].value = graph_derivative(m->graph, leaves[n].value, model_seed_motion, m);
            slowest[n].value = least_rate(m, leaves[n].value, rate[n].value);
        }
    of[RULED_VALUES] = leaves, of[RULED_RATES] = rate, of[RULED_ROUNDING] = rounding_outputs(m, leaves, *count);
    of[RULED_LEAST] = nearest, of[RULED_LEAST_RATES] = slowest;
    return of[RULED_ROUNDING] != NULL;
}

static bool make_functions(ruled *r, model *m)
{
    size_t count;
    output *of[RULED_NUMBERS];
    if (!ruled_outputs(m, of, &count)) return false;
    if (!count) return true;
    const output *const leaves = of[RULED_VALUES], *const rate = of[RULED_RATES];
    for (size_t n = 0; n < count; n++)
        if (graph_deps(m->graph, rate[n].value) & DEP_A) r->supplied.rates_without_a = false;
    for (int k = 0; k < RULED_NUMBERS; k++) {
        r->of[k] = tape_of(m->arena, m->graph, of[k], count);
        if (!r->of[k]) return false;
    }
    r->in_x = arena_room(m->arena, (m->nx + 2 * m->nv + m->rule_functions) * sizeof *r->in_x);
    if (!r->in_x || !resolution_create_values(m, leaves, count, &r->within) ||
        !resolution_create_values(m, rate, count, &r->rates_within))
        return false;
    r->in_v = r->in_x + m->nx, r->in_a = r->in_v + m->nv, r->is = r->in_a + m->nv;
    r->leaf = arena_room(m->arena, count * sizeof *r->leaf);
    if (!r->leaf || !arguments_create(m, &r->arguments)) return false;
    for (uint32_t i = 0; i < m->rule_count; i++)
        for (size_t k = 0; k < m->rules[i].leaves; k++, r->leaves++)
            r->leaf[r->leaves] = (leaf){.rule = &r->rule[i],
                                        .first = r->rule[i].first + k * r->rule[i].instances,
                                        .bends = resolution_bends(r->within, r->leaves)};
    r->supplied.arguments = arguments_most(r->arguments);
    return make_alone(r, m, of, count);
}

static bool make_periods(ruled *r, model *m)
{
    size_t count = 0;
    output *every = arena_room(m->arena, m->rule_count * sizeof *every);
    r->period = arena_room(m->arena, m->rule_count * sizeof *r->period);
    if (!every || !r->period) return false;
    for (uint32_t i = 0; i < m->rule_count; i++)
        if (m->rules[i].kind == RULE_CLOCK) every[count++] = m->rules[i].every;
    r->periods = count ? tape_of(m->arena, m->graph, every, count) : NULL;
    return !count || r->periods;
}

static tape *make_act(model *m, const model_rule *rule)
{
    output *o = arena_room(m->arena, rule->assignments * sizeof *o);
    for (size_t k = 0; o && k < rule->assignments; k++) {
        o[k] = rule->assignment[k].value;
        for (int d = 0; d < rule->own; d++) {
            const subscript here = {.level = -1, .slot = (int16_t)(m->int_count + (uint32_t)d), .modulus = -1};
            o[k].loop[d] = (range){here, here};
        }
    }
    return o ? tape_of(m->arena, m->graph, o, rule->assignments) : NULL;
}

/* Finds the places in x of the modes that rules with `keeps` change. */
static bool find_kept(ruled *r, const model *m)
{
    uint8_t *changed = arena_room(m->arena, m->mode_count + 1);
    size_t count = 0;
    if (!changed) return false;
    for (uint32_t i = 0; i < m->rule_count; i++)
        for (size_t k = 0; m->rules[i].keeps && k < m->rules[i].assignments; k++) {
            const model_state *s = model_state_of(m, m->rules[i].assignment[k].to.array);
            uint8_t *one = &changed[s - m->states - m->state_count];
            count += *one ? 0 : model_numbers(s);
            *one = 1;
        }
    size_t *places = arena_room(m->arena, (count + 1) * sizeof *places);
    if (!places) return false;
    r->supplied.kept = places;
    for (uint32_t i = 0; i < m->mode_count; i++) {
        const model_state *s = &m->states[m->state_count + i];
        for (size_t k = 0; changed[i] && k < model_numbers(s); k++) places[r->supplied.kept_count++] = s->base + k;
    }
    return true;
}

/* Finds the places in x of the modes that rules assign and rounding can change: those with more than PLACES binary
 * places. */
static bool find_rounded(ruled *r, const model *m)
{
    enum { PLACES = 4 };
    whole w;
    size_t count = 0, room = 1;
    for (uint32_t i = 0; i < m->mode_count; i++) room += model_numbers(&m->states[m->state_count + i]);
    size_t *places = arena_room(m->arena, room * sizeof *places);
    uint8_t *listed = arena_room(m->arena, m->mode_count + 1);
    const bool found = whole_find(&w, m, PLACES, NULL, &m->arena->allocator) && places && listed;
    for (uint32_t i = 0; found && i < m->rule_count; i++)
        for (size_t k = 0; k < m->rules[i].assignments; k++) {
            const model_assignment *a = &m->rules[i].assignment[k];
            const model_state *s = model_state_of(m, a->to.array);
            const size_t one = (size_t)(s - m->states);
            if (one < m->state_count || w.array[a->to.array] || listed[one - m->state_count]++) continue;
            for (size_t n = 0; n < model_numbers(s); n++) places[count++] = s->base + n;
        }
    whole_end(&w, &m->arena->allocator);
    r->supplied.rounded = places;
    r->supplied.rounded_count = count;
    return found;
}

/* Returns the first operation in a rule's functions that may jump, as a text in the model's arena, or NULL. */
static const char *jump_of(model *m, const model_rule *r)
{
    char text[64];
    for (size_t k = 0; k < r->leaves; k++) {
        const node at = graph_jump(m->graph, r->leaf[k].value);
        if (!at) continue;
        model_print(m, at, text, sizeof text);
        return arena_text(m->arena, text, strlen(text));
    }
    return NULL;
}

static bool is_smooth(const model *m, const model_rule *r)
{
    for (size_t k = 0; k < r->leaves; k++)
        if (graph_kink(m->graph, r->leaf[k].value)) return false;
    return true;
}

static bool is_timed(const model *m, const model_rule *r)
{
    unsigned deps = 0;
    for (size_t k = 0; k < r->leaves; k++) deps |= graph_deps(m->graph, r->leaf[k].value);
    return (deps & DEP_TIME) && !(deps & (DEP_STATE | DEP_D));
}

static void describe(const model_rule *from, rule *to)
{
    *to = (rule){.name = from->name,
                 .kind = (rule_kind)from->kind,
                 .direction = from->direction,
                 .first = from->leaf_first,
                 .leaves = from->leaves,
                 .instances = from->instances,
                 .formula = from->formula,
                 .words = from->words,
                 .compares = from->compares,
                 .period = from->period,
                 .of = from->of,
                 .records = from->records,
                 .assigns = from->assigns,
                 .keeps = from->keeps,
                 .stop = from->stop};
}

static bool make(ruled *r, model *m)
{
    size_t most = 0;
    r->model = m;
    r->rule = arena_room(m->arena, m->rule_count * sizeof *r->rule);
    r->act = arena_room(m->arena, m->rule_count * sizeof *r->act);
    r->ints = arena_room(m->arena, (m->int_count + MAX_DIMS) * sizeof *r->ints);
    if (!r->rule || !r->act || !r->ints) return false;
    if (m->int_count) memcpy(r->ints, m->ints, m->int_count * sizeof *r->ints);
    for (uint32_t i = 0; i < m->rule_count; i++) {
        const model_rule *rule = &m->rules[i];
        describe(rule, &r->rule[i]);
        r->rule[i].jump = jump_of(m, rule);
        r->rule[i].timed = is_timed(m, rule);
        r->rule[i].smooth = is_smooth(m, rule);
        r->act[i] = rule->assignments ? make_act(m, rule) : NULL;
        if (rule->assignments && !r->act[i]) return false;
        if (rule->numbers > most) most = rule->numbers;
    }
    r->becomes = arena_room(m->arena, (most + 1) * sizeof *r->becomes);
    r->supplied = (rules){.ctx = r,
                          .rule = r->rule,
                          .count = m->rule_count,
                          .functions = m->rule_functions,
                          .values = values,
                          .rates = rates,
                          .rates_without_a = true,
                          .rounding = rounding,
                          .undefined = m->table_count ? undefined : NULL,
                          .least = least,
                          .least_rates = least_rates,
                          .apart = apart,
                          .may_be_narrow = may_be_narrow,
                          .arguments_at = arguments_at,
                          .regular = regular,
                          .act = act,
                          .name = name};
    return r->becomes && find_kept(r, m) && find_rounded(r, m) && make_functions(r, m) && make_periods(r, m) &&
           ruled_rebind(r);
}

motus_status ruled_create(model *m, ruled **out, motus_error *err)
{
    ruled *r = arena_take(m->arena, sizeof *r);
    *out = NULL;
    if (m->int_count + MAX_DIMS > INT16_MAX)
        return fail(err, MOTUS_LIMIT, "the model has too many different bounds and shifts of indices for its events");
    if (m->arena->failed || !make(r, m))
        return m->graph->too_large ? fail(err, MOTUS_LIMIT, "the formulas of the events are too large")
                                   : fail(err, MOTUS_MEMORY, "no memory for the events of the model");
    *out = r;
    return MOTUS_OK;
}

void ruled_use(ruled *r, ruled_faster faster, void *ctx) { r->faster = faster, r->faster_ctx = ctx; }

const rules *ruled_rules(const ruled *r) { return &r->supplied; }

bool ruled_rebind(ruled *r)
{
    const binding b = {r->model->arrays, r->ints, r->model->pool};
    for (size_t k = 0; k < RULED_NUMBERS; k++)
        if (r->of[k] && !tape_bind(r->of[k], &b)) return false;
    if (r->periods && !tape_bind(r->periods, &b)) return false;
    if (r->arguments && !arguments_bind(r->arguments, &b)) return false;
    double *base[SPACES] = {[SPACE_OUT] = r->period};
    if (r->periods) tape_run(r->periods, 0, base);
    for (size_t k = 0; r->periods && k < r->supplied.count; k++)
        if (r->rule[k].kind == RULE_CLOCK) r->rule[k].period = r->period[k];
    for (size_t k = 0; k < r->supplied.count; k++)
        if (r->act[k] && !tape_bind(r->act[k], &b)) return false;
    return true;
}
