/* Initial values x(0), x'(0), x[i](0), from lines that may use one another in any order.
 *
 * Invariant: each line is computed once, when it is first needed. A cell keeps the value of the line with the highest
 * rank, in any order of computing: lines of --set rank above lines for a single cell, and these above lines for a
 * family.
 */
#include "lang/lower/start.h"

#include "lang/lower/hull.h"
#include "lang/lower/lower.h"
#include "lang/lower/resolve.h"
#include "lang/model/evaluate.h"
#include "lang/model/vary_record.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool failed(const model *m) { return source_failed(&m->source); }

enum { START_OF_FAMILY = 1, START_OF_CELL, START_OF_SET };

/* Gives a state its components, which the first computed line decides, and room in the pool. */
static bool give_shape(model *m, model_state *s, const statement *one, int components)
{
    int parts = components ? components : 1;
    size_t base;
    s->shaped = true;
    s->components = components;
    if ((double)s->hull * parts > MODEL_NUMBERS_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, &one->at, "%s would have %.4g numbers; at most %d fit", s->name,
                        (double)s->hull * parts, MODEL_NUMBERS_MAX);
        return false;
    }
    for (int d = 0; d < s->order; d++) {
        if (!model_take_numbers(m, s->hull * (size_t)parts, &base) || !model_take_arrays(m, parts, &s->start_array[d]))
            return false;
        for (int k = 0; k < parts; k++) {
            graph_shape(m->arena, &m->arrays[s->start_array[d] + k], SPACE_POOL, base + (size_t)k * s->hull, s->dims,
                        s->first, s->last);
            m->array_owner[s->start_array[d] + k] = 2 * (uint32_t)(s - m->states) + 2;
        }
    }
    return true;
}

/* Evaluates a line into the pool; copies constants. */
static bool run_line(model *m, model_state *s, const statement *one, const output *o, value v)
{
    size_t base = m->arrays[s->start_array[one->primes]].base;
    int64_t at[MAX_DIMS];
    bool known = o->loops == 0;
    for (int k = 0; k < (v.count ? v.count : 1); k++) known &= graph_at(m->graph, v.item[k])->op == OP_CONST;
    if (!known) return evaluate_into_pool(m, o, v.item, v.count ? v.count : 1, base, s->first, s->last, s->hull);
    for (int d = 0; d < s->dims; d++)
        at[d] = o->to.at[d].literal + (o->to.at[d].slot >= 0 ? m->ints[o->to.at[d].slot] : 0);
    const size_t cell = model_cell(s->dims, s->first, s->last, at);
    for (int k = 0; k < (v.count ? v.count : 1); k++)
        m->pool[base + (size_t)k * s->hull + cell] = graph_at(m->graph, v.item[k])->value;
    return true;
}

/* Lowers a line, with the initial values that it uses, and checks its shape. */
static bool line_value(model *m, model_state *s, const statement *one, lowering *l, output *o, value *v)
{
    lower_start(l, m, PLACE_CONSTANT, "an initial value");
    if (!lower_target(l, one, o)) return false;
    *v = lower_numbers(l, one->value);
    if (failed(m)) return false;
    if (s->shaped && v->count != s->components) {
        char now[40], before[40];
        snprintf(now, sizeof now, v->count ? "a vector of length %d" : "a number", v->count);
        snprintf(before, sizeof before, s->components ? "a vector of length %d" : "a number", s->components);
        source_complain(&m->source, MOTUS_SHAPE, &one->value->at, "%s%s at the start is %s here, but %s before",
                        s->name, one->primes ? "'" : "", now, before);
        return false;
    }
    return s->shaped || give_shape(m, s, one, v->count);
}

/* Evaluates a line; cells with values of higher rank keep them. */
static bool run_start(model *m, model_state *s, const statement *one, const output *o, value v, uint8_t rank)
{
    const uint8_t *map = s->start_map[one->primes];
    size_t base = m->arrays[s->start_array[one->primes]].base, parts = (size_t)(v.count ? v.count : 1), kept = 0;
    double *keep = NULL;
    for (size_t i = 0; one->loop_count > 0 && i < s->hull; i++) kept += map[i] > rank;
    if (kept && !(keep = arena_room(m->arena, kept * parts * sizeof *keep))) return false;
    for (size_t i = 0, n = 0; n < kept * parts; i++)
        for (size_t k = 0; k < parts && map[i] > rank; k++) keep[n++] = m->pool[base + k * s->hull + i];
    if (!run_line(m, s, one, o, v)) return false;
    for (size_t i = 0, n = 0; n < kept * parts; i++)
        for (size_t k = 0; k < parts && map[i] > rank; k++) m->pool[base + k * s->hull + i] = keep[n++];
    return true;
}

/* Computes a line x(0) = …, x'(0) = … or x[i](0) = … for …, once. */
static bool start_line(model *m, model_state *s, statement *one)
{
    if (one->progress == 2) return true;
    if (one->progress == 1) {
        source_complain(&m->source, MOTUS_NAME, &one->at, "this initial value depends on itself, in a circle");
        return false;
    }
    if (m->start_depth == MODEL_CHAIN_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, &one->at, "initial values use one another more than %d deep",
                        MODEL_CHAIN_MAX);
        return false;
    }
    if ((int)one->index_count != s->dims) return hull_indices_wrong(m, s, one->at);
    one->progress = 1;
    m->start_depth++;
    lowering l;
    output o = {0};
    value v;
    if (!line_value(m, s, one, &l, &o, &v)) return false;
    m->start_depth--;
    int64_t first[MAX_DIMS], last[MAX_DIMS];
    lower_extent(m, &l, &o, first, last);
    for (int d = 0; d < s->dims; d++)
        if (first[d] < s->first[d] || last[d] > s->last[d]) {
            source_complain(&m->source, MOTUS_NAME, &one->at,
                            "%s has an initial value at index %lld, but no equation there", s->name,
                            (long long)(first[d] < s->first[d] ? first[d] : last[d]));
            return false;
        }
    const size_t cell = model_cell(s->dims, s->first, s->last, first);
    uint8_t *map = s->start_map[one->primes];
    uint8_t rank = one->at.text > 0 ? START_OF_SET : one->loop_count > 0 ? START_OF_FAMILY : START_OF_CELL;
    one->progress = 2;
    if (rank == START_OF_CELL && map[cell] == START_OF_SET) return true;
    if (rank == START_OF_CELL && map[cell] == START_OF_CELL) {
        source_complain(&m->source, MOTUS_NAME, &one->at, "%s%s at the start is given twice", s->name,
                        one->primes ? "'" : "");
        return false;
    }
    if (!run_start(m, s, one, &o, v, rank)) return false;
    if (!vary_record(m, &o, v.item, v.count ? v.count : 1, m->arrays[s->start_array[one->primes]].base, s->dims,
                     s->first, s->last, s->hull, map, rank, &s->log_array[one->primes]))
        return false;
    if (!o.loops) evaluate_held_cells(m, &o, v.item, v.count ? v.count : 1, s->start_array[one->primes]);
    if (s->dims > 0) return hull_mark(m, s, one, first, last, map, rank, false);
    map[0] = rank;
    return true;
}

static bool start_maps(model *m, model_state *s)
{
    if (!resolve_start_time(m) || !hull_find(m, s)) return false;
    for (int primes = 0; primes < s->order; primes++) {
        if (s->start_map[primes]) continue;
        s->start_map[primes] = arena_room(m->arena, s->hull);
        if (!s->start_map[primes]) return false;
    }
    return true;
}

/* Computes the lines for families and then, with `cells`, the lines for single cells. */
static bool start_lines(model *m, model_state *s, int primes, bool cells)
{
    for (int pass = 0; pass <= (int)cells; pass++)
        for (uint32_t i = s->line; i; i = m->statements.item[i - 1].next) {
            statement *one = &m->statements.item[i - 1];
            if (one->kind == STATEMENT_START && one->primes == primes && (one->loop_count == 0) == pass &&
                !start_line(m, s, one))
                return false;
        }
    return true;
}

static bool start_missing(model *m, const model_state *s, int primes, size_t cell)
{
    char name[MOTUS_NAME_MAX + 64];
    model_state_name(s, cell, -1, primes, name, sizeof name);
    source_complain(&m->source, MOTUS_NAME, &s->at, "the initial value %s(%g) is missing", name, m->start);
    source_hint(&m->source, s->dims ? "write %s[i]%s(%g) = … for i = …" : "write %s%s(%g) = …", s->name,
                primes ? "'" : "", m->start);
    if (s->dims == 0 && s->components == 0)
        source_repair(&m->source, "", "%s%s(%g) = %d", s->name, primes ? "'" : "", m->start, !primes);
    return false;
}

/* Fills in start_own, once, so that a use of a cell need not search all lines. */
static bool own_lines(model *m, model_state *s, int primes)
{
    if (s->start_own[primes]) return true;
    s->start_own[primes] = arena_room(m->arena, s->hull * sizeof *s->start_own[primes]);
    if (!s->start_own[primes]) return false;
    for (uint32_t i = s->line; i; i = m->statements.item[i - 1].next) {
        const statement *one = &m->statements.item[i - 1];
        int64_t first[MAX_DIMS], last[MAX_DIMS];
        if (one->kind != STATEMENT_START || one->primes != primes || one->loop_count > 0 ||
            (int)one->index_count != s->dims)
            continue;
        if (!lower_places(m, one, first, last)) return false;
        bool inside = true;
        for (int d = 0; d < s->dims; d++) inside &= first[d] >= s->first[d] && first[d] <= s->last[d];
        if (inside) s->start_own[primes][model_cell(s->dims, s->first, s->last, first)] = i;
    }
    return true;
}

/* Lets a state of a draft start at rest, with the shape of x(0), if it has no line x'(0) = …; the pool has zeros. */
static bool suppose_rest(model *m, model_state *s)
{
    if (!m->draft || s->order == 1 || s->supposed) return true;
    for (uint32_t i = s->line; i; i = m->statements.item[i - 1].next)
        if (m->statements.item[i - 1].kind == STATEMENT_START && m->statements.item[i - 1].primes == 1) return true;
    if (!start_lines(m, s, 0, true)) return false;
    s->supposed = s->shaped;
    if (s->shaped) memset(s->start_map[1], START_OF_FAMILY, s->hull);
    return true;
}

bool start_cells(model *m, model_state *s, int primes, const int64_t low[], const int64_t high[])
{
    if (s->start_done) return true;
    if (!start_maps(m, s)) return false;
    if (primes && !suppose_rest(m, s)) return false;
    const size_t cell = model_cell(s->dims, s->first, s->last, low);
    bool single = true;
    for (int d = 0; d < s->dims; d++) single &= low[d] == high[d];
    if (!single) return start_lines(m, s, primes, true) && (s->shaped || start_missing(m, s, primes, 0));
    for (uint32_t i = m->source.count > 1 ? s->line : 0; i; i = m->statements.item[i - 1].next) {
        statement *one = &m->statements.item[i - 1]; /* families of --set, but none that is being computed */
        if (one->kind == STATEMENT_START && one->primes == primes && one->at.text > 0 && one->loop_count > 0 &&
            one->progress == 0 && !start_line(m, s, one))
            return false;
    }
    if (s->start_map[primes][cell] == START_OF_SET) return true;
    if (!own_lines(m, s, primes)) return false;
    uint32_t own = s->start_own[primes][cell];
    if (own ? !start_line(m, s, &m->statements.item[own - 1]) : !start_lines(m, s, primes, false)) return false;
    return s->start_map[primes][cell] != 0 || start_missing(m, s, primes, cell);
}

/* Returns the place of the first line of the kind that gave a cell its value, or of the equation. */
static const span *start_span(const model *m, const model_state *s, int primes, bool own)
{
    for (uint32_t i = s->line; i; i = m->statements.item[i - 1].next) {
        const statement *one = &m->statements.item[i - 1];
        if (one->kind == STATEMENT_START && one->primes == primes && (one->loop_count == 0) == own) return &one->at;
    }
    return &s->at;
}

static bool check_start(model *m, model_state *s, int primes)
{
    char name[MOTUS_NAME_MAX + 64];
    const uint8_t *map = s->start_map[primes];
    size_t base = m->arrays[s->start_array[primes]].base, parts = (size_t)(s->components ? s->components : 1);
    for (size_t i = 0; i < s->cells.count; i++) {
        size_t cell = s->cells.offset ? s->cells.offset[i] : i;
        if (!map[cell]) return start_missing(m, s, primes, cell);
        for (size_t k = 0; k < parts; k++)
            if (!isfinite(m->pool[base + k * s->hull + cell])) {
                model_state_name(s, cell, s->components ? (int)k : -1, primes, name, sizeof name);
                source_complain(&m->source, MOTUS_ARGUMENT, start_span(m, s, primes, map[cell] >= START_OF_CELL),
                                "the initial value %s(%g) is not a finite number", name, m->start);
                source_hint(&m->source, "look for a division by zero, or a root or logarithm of a negative number");
                return false;
            }
    }
    return true;
}

bool start_state(model *m, model_state *s)
{
    if (s->start_done) return true;
    if (!start_maps(m, s)) return false;
    for (int primes = 0; primes < s->order; primes++) {
        if (!start_lines(m, s, primes, true)) return false;
        if (!s->shaped) {
            source_complain(&m->source, MOTUS_NAME, &s->at, "the initial value %s%s(%g) is missing", s->name,
                            s->dims ? "[…]" : "", m->start);
            for (uint32_t i = s->line; i && s->dims == 0; i = m->statements.item[i - 1].next)
                if (m->statements.item[i - 1].kind == STATEMENT_DEFINITION) /* x[0] = 1 */
                    source_hint(&m->source, "an initial value is written with round brackets: %s(%g) = …", s->name,
                                m->start);
            source_hint(&m->source, "write %s%s(%g) = … (its shape, number or vector, is the shape of %s)", s->name,
                        s->dims ? "[i]" : "", m->start, s->name);
            if (s->dims == 0) source_repair(&m->source, "", "%s(%g) = 1", s->name, m->start);
            return false;
        }
    }
    if (!suppose_rest(m, s)) return false;
    for (int primes = 0; primes < s->order; primes++)
        if (!check_start(m, s, primes)) return false;
    s->start_done = true;
    return true;
}
