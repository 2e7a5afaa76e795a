/* Constants: parameters, lists, the start, initial values, and where states lie. Everything is resolved when it is first needed; what is
 * needed while it is being resolved is a circle. Constant expressions are computed by the tape, like everything else, so a parameter
 * has the value that a machine would compute. */
#include "lang/lower.h"
#include "lang/tape.h"
#include "lang/vary.h"
#include "base/near.h"

#include <math.h>
#include <string.h>

static bool failed(const model *m) { return source_failed(&m->source); }

static bool circle(model *m, span at, const char *name)
{
    source_complain(&m->source, MOTUS_NAME, at, "%s is defined by itself, in a circle", name);
    return false;
}

bool resolve_run(model *m, const output *outputs, size_t count, double t, double *const base[SPACES])
{
    if (failed(m))
        return false;
    program *p = program_create(m->graph, outputs, count);
    tape *tp = failed(m) || !p ? NULL : tape_create(m->arena, p);
    binding b = {m->arrays, m->ints, m->pool};
    if (!tp || failed(m) || !tape_bind(tp, &b))
        return false;
    tape_run(tp, t, base);
    return true;
}

/* ---- the pool and the arrays ---- */

bool resolve_pool(model *m, size_t count, size_t *first)
{
    if (m->pool_count + count > m->pool_capacity) {
        size_t room = m->pool_capacity + m->pool_capacity / 2 + count + 64;
        double *more = arena_grow(m->arena, m->pool, m->pool_capacity * sizeof *more, room * sizeof *more);
        if (!more)
            return false;
        memset(more + m->pool_capacity, 0, (room - m->pool_capacity) * sizeof *more);
        m->pool = more;
        m->pool_capacity = room;
    }
    *first = m->pool_count;
    m->pool_count += count;
    return true;
}

bool resolve_arrays(model *m, int count, uint16_t *first)
{
    uint32_t need = m->array_count + (uint32_t)count;
    if (need > UINT16_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, (span){0, 0, 0}, "the model has more than %d arrays", UINT16_MAX);
        return false;
    }
    if (need > m->array_capacity) {
        uint32_t room = need + 64 + m->array_capacity / 2;
        array *more = arena_grow(m->arena, m->arrays, m->array_capacity * sizeof *more, room * sizeof *more);
        if (!more)
            return false;
        m->arrays = more;
        m->array_capacity = room;
    }
    *first = (uint16_t)m->array_count;
    memset(&m->arrays[m->array_count], 0, (size_t)count * sizeof *m->arrays);
    m->array_count = need;
    m->graph->arrays = m->arrays;
    return true;
}

size_t resolve_shape(array *a, space space, size_t base, int dims, const int64_t first[], const int64_t last[])
{
    size_t count = 1;
    *a = (array){.space = space, .dims = dims, .base = base};
    for (int d = dims - 1; d >= 0; d--) {
        a->first[d] = first[d];
        a->last[d] = last[d];
        a->stride[d] = (int64_t)count;
        count *= (size_t)(last[d] - first[d] + 1);
    }
    return count;
}

/* ---- single numbers ---- */

static bool constant_node(model *m, node n, span at)
{
    if (graph_deps(m->graph, n) & (DEP_TIME | DEP_STATE | DEP_LEVELS | DEP_D)) {
        source_complain(&m->source, MOTUS_SHAPE, at, "this must be constant: it cannot depend on a state, on time or on an index");
        return false;
    }
    return true;
}

/* Computes constant nodes into out. */
static bool compute(model *m, const node *nodes, int count, double *out)
{
    bool literal = true;
    for (int k = 0; k < count; k++)
        literal &= graph_at(m->graph, nodes[k])->op == OP_CONST;
    if (literal) {
        for (int k = 0; k < count; k++)
            out[k] = graph_at(m->graph, nodes[k])->value;
        return true;
    }
    uint32_t arrays = m->array_count;
    uint16_t first;
    output *o = arena_room(m->arena, (size_t)count * sizeof *o);
    if (!o || !resolve_arrays(m, count, &first))
        return false;
    for (int k = 0; k < count; k++) {
        resolve_shape(&m->arrays[first + k], SPACE_OUT, (size_t)k, 0, NULL, NULL);
        o[k] = (output){.value = nodes[k], .to = {.array = (uint16_t)(first + k)}};
    }
    double *base[SPACES] = {[SPACE_OUT] = out};
    bool ok = resolve_run(m, o, (size_t)count, 0, base);
    m->array_count = arrays;         /* they were only the way out */
    return ok;
}

bool resolve_number(model *m, node n, span at, const char *what, double *value)
{
    if (failed(m) || !constant_node(m, n, at) || !compute(m, &n, 1, value))
        return false;
    vary_freeze(m, n, what);
    return !failed(m);
}

int resolve_int(model *m, node n, span at, int64_t *value)
{
    for (uint32_t i = 0; i < m->int_count; i++)
        if (m->int_nodes[i] == n) {
            *value = m->ints[i];
            return (int)i;
        }
    double v;
    if (!resolve_number(m, n, at, NULL, &v))
        return -1;
    if (fabs(v) > 1e9) {
        source_complain(&m->source, MOTUS_LIMIT, at, "a bound of an index is at most 1e9, and this is %g", v);
        return -1;
    }
    if (v != floor(v)) {
        source_complain(&m->source, MOTUS_SHAPE, at, "a whole number is due here, not %g", v);
        return -1;
    }
    if (m->int_count == INT16_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, at, "more than %d different bounds and shifts of indices", INT16_MAX);
        return -1;
    }
    if (m->int_count == m->int_capacity) {
        uint32_t room = m->int_capacity ? 2 * m->int_capacity : 32;
        int64_t *ints = arena_grow(m->arena, m->ints, m->int_capacity * sizeof *ints, room * sizeof *ints);
        node *nodes = arena_grow(m->arena, m->int_nodes, m->int_capacity * sizeof *nodes, room * sizeof *nodes);
        if (!ints || !nodes)
            return -1;
        m->ints = ints;
        m->int_nodes = nodes;
        m->int_capacity = room;
    }
    m->ints[m->int_count] = *value = (int64_t)v;
    m->int_nodes[m->int_count] = n;
    return (int)m->int_count++;
}

/* ---- parameters ---- */

static bool finite_values(model *m, const model_definition *d, const double *v, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (!isfinite(v[k])) {
            source_complain(&m->source, MOTUS_ARGUMENT, d->statement->value->at, "%s is not a finite number", d->name);
            source_hint(&m->source, "look for a division by zero, or a root or logarithm of a negative number");
            return false;
        }
    return true;
}

static bool resolve_plain(model *m, model_definition *d)
{
    lowering l;
    lower_start(&l, m, PLACE_CONSTANT, "a parameter");
    value v = lower_expression(&l, d->statement->value);
    int n = v.count ? v.count : 1;
    if (failed(m))
        return false;
    if (v.boolean) {
        source_complain(&m->source, MOTUS_SHAPE, d->statement->value->at, "a parameter is a number, a vector or a list, not a condition");
        return false;
    }
    d->components = v.count;
    d->slot = m->scalar_used;
    if (m->scalar_used + (uint32_t)n > m->scalar_slots) {
        source_complain(&m->source, MOTUS_LIMIT, d->statement->at, "the parameters have too many components");
        return false;
    }
    double *out = arena_room(m->arena, (size_t)n * sizeof *out);
    if (!out || !compute(m, v.item, n, out) || !finite_values(m, d, out, (size_t)n))
        return false;
    memcpy(m->pool + d->slot, out, (size_t)n * sizeof *out);
    for (int k = 0; k < n; k++)
        if (!vary_record_scalar(m, v.item[k], d->slot + (uint32_t)k))
            return false;
    m->scalar_used += (uint32_t)n;
    return true;
}

/* m = [1, 2, 3] or [(1, 0), (0, 1)]: places 1 … n */
static bool resolve_list(model *m, model_definition *d)
{
    const tree *list = d->statement->value;
    int n = (int)list->count;
    lowering l;
    lower_start(&l, m, PLACE_CONSTANT, "a parameter");
    value *item = arena_room(m->arena, (size_t)n * sizeof *item);
    if (!item)
        return false;
    for (int i = 0; i < n; i++) {
        item[i] = lower_expression(&l, list->item[i]);
        if (failed(m))
            return false;
        if (item[i].boolean || item[i].count != item[0].count) {
            source_complain(&m->source, MOTUS_SHAPE, list->item[i]->at, "the entries of a list are all numbers, or all vectors of one length");
            return false;
        }
    }
    d->list = true;
    d->dims = 1;
    d->components = item[0].count;
    d->first[0] = 1;
    d->last[0] = n;
    int parts = d->components ? d->components : 1;
    size_t base;
    uint16_t at;
    if (!resolve_pool(m, (size_t)n * (size_t)parts, &base) || !resolve_arrays(m, parts, &at))
        return false;
    d->array = at;
    node *column = arena_room(m->arena, (size_t)n * sizeof *column);
    if (!column)
        return false;
    for (int k = 0; k < parts; k++) {
        resolve_shape(&m->arrays[at + k], SPACE_POOL, base + (size_t)k * (size_t)n, 1, d->first, d->last);
        for (int i = 0; i < n; i++)
            column[i] = item[i].item[k];
        double *out = arena_room(m->arena, (size_t)n * sizeof *out);
        if (!out || !compute(m, column, n, out) || !finite_values(m, d, out, (size_t)n))
            return false;
        memcpy(m->pool + base + (size_t)k * (size_t)n, out, (size_t)n * sizeof *out);
    }
    for (int i = 0; i < n; i++) {
        const output place = {.to = {.dims = 1, .at = {{.level = -1, .slot = -1, .modulus = -1, .literal = i + 1}}}};
        if (!vary_record(m, &place, item[i].item, parts, base, 1, d->first, d->last, (size_t)n, NULL, 0, &d->log_array))
            return false;
    }
    return true;
}

/* The hull of what a left side runs over. */
void resolve_target(const model *m, const lowering *l, const output *o, int64_t first[], int64_t last[])
{
    for (int d = 0; d < o->to.dims; d++) {
        const subscript *s = &o->to.at[d];
        if (s->level >= 0) {
            first[d] = l->low[s->level];
            last[d] = l->high[s->level];
        } else {
            first[d] = last[d] = s->literal + (s->slot >= 0 ? m->ints[s->slot] : 0);
        }
    }
}

/* Runs a statement's components into the pool, at `base` on, as an array of the given hull. */
bool resolve_into_pool(model *m, const output *target, value v, size_t base, const int64_t first[], const int64_t last[], size_t hull)
{
    int parts = v.count ? v.count : 1;
    uint32_t arrays = m->array_count;
    uint16_t at;
    output *o = arena_room(m->arena, (size_t)parts * sizeof *o);
    if (!o || !resolve_arrays(m, parts, &at))
        return false;
    for (int k = 0; k < parts; k++) {
        resolve_shape(&m->arrays[at + k], SPACE_OUT, base + (size_t)k * hull, target->to.dims, first, last);
        o[k] = *target;
        o[k].value = v.item[k];
        o[k].to.array = (uint16_t)(at + k);
    }
    double *spaces[SPACES] = {[SPACE_OUT] = m->pool};
    bool ok = resolve_run(m, o, (size_t)parts, 0, spaces);
    m->array_count = arrays;
    return ok;
}

static bool resolve_family(model *m, model_definition *d)
{
    lowering l;
    output o = {0};
    lower_start(&l, m, d->kind == DEFINED_PARAMETER ? PLACE_CONSTANT : PLACE_QUANTITY, "a parameter");
    if (!lower_target(&l, d->statement, &o))
        return false;
    if (o.loops == 0 || o.loops != o.to.dims) {
        source_complain(&m->source, MOTUS_SHAPE, d->statement->at, "%s[…] needs an index that runs", d->name);
        source_hint(&m->source, "write %s[i] = … for i = 1..N, or a list %s = [1, 2, 3]", d->name, d->name);
        return false;
    }
    resolve_target(m, &l, &o, d->first, d->last);
    d->dims = o.to.dims;
    if (d->kind != DEFINED_PARAMETER)
        return true;                 /* its expression is put in where it is used */
    value v = lower_expression(&l, d->statement->value);
    if (failed(m))
        return false;
    int parts = v.count ? v.count : 1;
    d->list = true;
    d->components = v.count;
    array probe;
    size_t hull = resolve_shape(&probe, SPACE_POOL, 0, d->dims, d->first, d->last), base;
    if (hull * (size_t)parts > MODEL_LIST_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, d->statement->at, "%zu numbers are more than the %d that fit", hull * (size_t)parts, MODEL_LIST_MAX);
        return false;
    }
    uint16_t at;
    if (!resolve_pool(m, hull * (size_t)parts, &base) || !resolve_arrays(m, parts, &at))
        return false;
    d->array = at;
    for (int k = 0; k < parts; k++)
        resolve_shape(&m->arrays[at + k], SPACE_POOL, base + (size_t)k * hull, d->dims, d->first, d->last);
    return resolve_into_pool(m, &o, v, base, d->first, d->last, hull) && finite_values(m, d, m->pool + base, hull * (size_t)parts) &&
           vary_record(m, &o, v.item, parts, base, d->dims, d->first, d->last, hull, NULL, 0, &d->log_array);
}

bool resolve_definition(model *m, model_definition *d)
{
    if (d->progress == 2)
        return true;
    if (d->progress == 1)
        return circle(m, d->statement->name_at, d->name);
    d->progress = 1;
    const statement *s = d->statement;
    bool ok;
    if (s->index_count > 0 || s->loop_count > 0)
        ok = resolve_family(m, d);
    else if (d->kind != DEFINED_PARAMETER)
        ok = true;
    else if (s->value->kind == TREE_LIST)
        ok = resolve_list(m, d);
    else
        ok = resolve_plain(m, d);
    d->progress = ok && !failed(m) ? 2 : 0;
    return ok && !failed(m);
}

/* ---- the start ---- */

static bool constant_value(model *m, const tree *t, const char *what, double *out)
{
    lowering l;
    lower_start(&l, m, PLACE_CONSTANT, what);
    node n = lower_scalar(&l, t, what);
    if (failed(m) || !resolve_number(m, n, t->at, what, out))
        return false;
    if (!isfinite(*out)) {
        source_complain(&m->source, MOTUS_ARGUMENT, t->at, "%s is not a finite number", what);
        return false;
    }
    return true;
}

bool resolve_start_time(model *m)
{
    if (m->start_known)
        return true;
    bool any = false;
    span where = {0, 0, 0};
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *s = &m->statements.item[i];
        bool from = s->kind == STATEMENT_FROM;
        if (!from && s->kind != STATEMENT_START)
            continue;
        double at;
        const tree *t = from ? s->value : s->start_at;
        m->start_known = true;       /* an initial value in here would be a circle; it meets a start that is not a number */
        if (!any)
            m->start = NAN;
        if (!constant_value(m, t, "the start", &at))
            return false;
        if (any && at != m->start) {
            source_complain(&m->source, MOTUS_ARGUMENT, t->at, "the start is %g here, but %g in line %d", at, m->start, source_line(&m->source, where));
            source_hint(&m->source, "all states start at one time");
            return false;
        }
        if (!any)
            where = t->at;
        m->start = at;
        any = true;
    }
    if (!any)
        m->start = 0;
    m->start_known = true;
    return !failed(m);
}

/* ---- states ---- */

bool resolve_indices_wrong(model *m, const model_state *s, span at)
{
    static const char *const indices[] = {"", "[i]", "[i,j]", "[i,j,k]", "[i,j,k,l]"};
    if (s->dims == 0)
        source_complain(&m->source, MOTUS_SHAPE, at, "%s is not a family and has no index", s->name);
    else
        source_complain(&m->source, MOTUS_SHAPE, at, "%s is a family and needs %d ind%s", s->name, s->dims, s->dims == 1 ? "ex" : "ices");
    source_hint(&m->source, "by its equation in line %d it is written %s%s", source_line(&m->source, s->at), s->name, indices[s->dims]);
    return false;
}

#define EACH_LINE(m, s, one) \
    for (const statement *one = (s)->line ? &(m)->statements.item[(s)->line - 1] : NULL; one; \
         one = one->next ? &(m)->statements.item[one->next - 1] : NULL)

bool resolve_mark(model *m, const model_state *s, const statement *from, const int64_t first[], const int64_t last[], uint8_t *map, uint8_t as, bool once)
{
    int64_t at[MAX_DIMS];
    for (int d = 0; d < s->dims; d++)
        at[d] = first[d];
    for (;;) {
        size_t offset = 0;
        for (int d = 0; d < s->dims; d++)
            offset = offset * (size_t)(s->last[d] - s->first[d] + 1) + (size_t)(at[d] - s->first[d]);
        if (once && map[offset]) {
            char name[MOTUS_NAME_MAX + 64];
            model_state_name(s, offset, 0, false, name, sizeof name);
            source_complain(&m->source, MOTUS_NAME, from->at, "%s%.*s has two lines that say how it moves", s->components ? "a component of " : "", 100, name);
            source_hint(&m->source, "each index has exactly one equation or boundary line");
            return false;
        }
        if (map[offset] < as)
            map[offset] = as;
        int d = s->dims - 1;
        while (d >= 0 && ++at[d] > last[d]) {
            at[d] = first[d];
            d--;
        }
        if (d < 0)
            return true;
    }
}

static bool gather_hull(model *m, model_state *s, bool boundary)
{
    bool any = false;
    EACH_LINE(m, s, one) {
        if (one->kind != STATEMENT_EQUATION && !(boundary && one->kind == STATEMENT_DEFINITION))
            continue;
        if ((int)one->index_count != s->dims) {
            return resolve_indices_wrong(m, s, one->at);
        }
        lowering l;
        output o = {0};
        int64_t first[MAX_DIMS], last[MAX_DIMS];
        lower_start(&l, m, PLACE_CONSTANT, "an index");
        if (!lower_target(&l, one, &o))
            return false;
        resolve_target(m, &l, &o, first, last);
        for (int d = 0; d < s->dims; d++) {
            int64_t *lo = boundary ? &s->first[d] : &s->eq_first[d], *hi = boundary ? &s->last[d] : &s->eq_last[d];
            if (!any || first[d] < *lo)
                *lo = first[d];
            if (!any || last[d] > *hi)
                *hi = last[d];
        }
        any = true;
    }
    return true;
}

static bool mark_owners(model *m, model_state *s)
{
    EACH_LINE(m, s, one) {
        if (one->kind != STATEMENT_EQUATION && one->kind != STATEMENT_DEFINITION)
            continue;
        lowering l;
        output o = {0};
        int64_t first[MAX_DIMS], last[MAX_DIMS];
        lower_start(&l, m, PLACE_CONSTANT, "an index");
        if (!lower_target(&l, one, &o))
            return false;
        resolve_target(m, &l, &o, first, last);
        if (!resolve_mark(m, s, one, first, last, s->owner, one->kind == STATEMENT_EQUATION ? 1 : 2, true))
            return false;
    }
    size_t count = 0;
    bool gap = false;
    for (size_t k = 0; k < s->hull; k++) {
        if (s->owner[k] == 1)
            gap |= k != count++;
    }
    s->cells.count = count;
    if (!gap)
        return true;
    s->cells.offset = arena_room(m->arena, count * sizeof *s->cells.offset);
    if (!s->cells.offset)
        return false;
    count = 0;
    for (size_t k = 0; k < s->hull; k++)
        if (s->owner[k] == 1)
            s->cells.offset[count++] = (uint32_t)k;
    return true;
}

/* progress: 1 and 2 while and after the hull is found */
bool resolve_hull(model *m, model_state *s)
{
    if (s->progress >= 2)
        return true;
    if (s->progress == 1)
        return circle(m, s->at, s->name);
    s->progress = 1;
    s->hull = 1;
    s->cells.count = 1;
    if (s->dims > 0) {
        if (!gather_hull(m, s, true) || !gather_hull(m, s, false))
            return false;
        double numbers = 1;
        for (int d = 0; d < s->dims; d++)
            numbers *= (double)(s->last[d] - s->first[d] + 1);
        if (numbers > MODEL_NUMBERS_MAX) {
            source_complain(&m->source, MOTUS_LIMIT, s->at, "%s would have %.4g places; at most %d fit", s->name, numbers, MODEL_NUMBERS_MAX);
            return false;
        }
        s->hull = (size_t)numbers;
        s->owner = arena_room(m->arena, s->hull);
        if (!s->owner)
            return false;
        memset(s->owner, 0, s->hull);
        if (!mark_owners(m, s))
            return false;
    }
    s->progress = 2;
    return true;
}

/* Places in x and v, and the five blocks of arrays. */
static bool lay_out(model *m)
{
    size_t total = 0;
    uint32_t parts = 0;
    for (int order = 2; order >= 1; order--) {
        for (uint32_t i = 0; i < m->state_count; i++) {
            model_state *s = &m->states[i];
            if (s->order != order)
                continue;
            s->base = total;
            s->array = (uint16_t)parts;
            total += s->hull * (size_t)(s->components ? s->components : 1);
            parts += (uint32_t)(s->components ? s->components : 1);
            if (total > MODEL_NUMBERS_MAX) {
                source_complain(&m->source, MOTUS_LIMIT, s->at, "the states have more than the %d numbers that fit", MODEL_NUMBERS_MAX);
                return false;
            }
            if (parts > UINT16_MAX / 8) {
                source_complain(&m->source, MOTUS_LIMIT, s->at, "more than %d variables and components", UINT16_MAX / 8);
                source_hint(&m->source, "a family, x[i]'' = … for i = 1..N, is one variable however large N is");
                return false;
            }
        }
        if (order == 2)
            m->nx = total;
    }
    m->nv = total;
    m->block_size = (uint16_t)parts;
    static const space spaces[5] = {SPACE_X, SPACE_V, SPACE_A, SPACE_DX, SPACE_DV};
    for (int b = 0; b < 5; b++) {
        if (!resolve_arrays(m, (int)parts, &m->block[b]))
            return false;
        for (uint32_t i = 0; i < m->state_count; i++) {
            const model_state *s = &m->states[i];
            for (int k = 0; k < (s->components ? s->components : 1); k++)
                resolve_shape(&m->arrays[m->block[b] + s->array + k], spaces[b], s->base + (size_t)k * s->hull, s->dims, s->first, s->last);
        }
    }
    m->x0 = arena_room(m->arena, (m->nx + 1) * sizeof *m->x0);
    m->v0 = arena_room(m->arena, (m->nv + 1) * sizeof *m->v0);
    if (!m->x0 || !m->v0)
        return false;
    memset(m->x0, 0, (m->nx + 1) * sizeof *m->x0);
    memset(m->v0, 0, (m->nv + 1) * sizeof *m->v0);
    resolve_start_state(m);
    return true;
}

void resolve_start_state(model *m)
{
    for (uint32_t i = 0; i < m->state_count; i++) {
        const model_state *s = &m->states[i];
        size_t n = s->hull * (size_t)(s->components ? s->components : 1);
        const double *first = m->pool + m->arrays[s->start_array[0]].base;
        if (s->order == 2) {
            memcpy(m->x0 + s->base, first, n * sizeof *first);
            memcpy(m->v0 + s->base, m->pool + m->arrays[s->start_array[1]].base, n * sizeof *first);
        } else {
            memcpy(m->v0 + s->base, first, n * sizeof *first);
        }
    }
}

static bool resolve_settings(model *m)
{
    bool seen[STATEMENT_EVERY + 1] = {false};
    m->step = m->tolerance = m->until = m->every_time = NAN;
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *s = &m->statements.item[i];
        if (s->kind < STATEMENT_METHOD)
            continue;
        if (seen[s->kind]) {
            source_complain(&m->source, MOTUS_NAME, s->at, "%s is set twice", s->name);
            return false;
        }
        seen[s->kind] = true;
        if (s->kind == STATEMENT_METHOD) {
            m->method = s->text;
            continue;
        }
        double v;
        if (!constant_value(m, s->value, s->name, &v))
            return false;
        bool positive = s->kind == STATEMENT_STEP || s->kind == STATEMENT_TOLERANCE || s->kind == STATEMENT_EVERY;
        if (positive && !(v > 0)) {
            source_complain(&m->source, MOTUS_ARGUMENT, s->value->at, "%s is positive, not %g", s->name, v);
            if (s->kind == STATEMENT_STEP)
                source_hint(&m->source, "a run goes backward when `until` lies before the start");
            return false;
        }
        switch (s->kind) {
        case STATEMENT_STEP: m->step = v; break;
        case STATEMENT_TOLERANCE: m->tolerance = v; break;
        case STATEMENT_UNTIL: m->until = v; break;
        case STATEMENT_EVERY:
            if (!s->steps) {
                m->every_time = v;
            } else if (v != floor(v) || v > 9e15) {
                source_complain(&m->source, MOTUS_ARGUMENT, s->value->at, "every %g steps: a whole number is due", v);
                return false;
            } else {
                m->every_steps = (int64_t)v;
            }
            break;
        default: break;
        }
    }
    return true;
}

/* Lines that no state claims: x(0) without an equation, an index on something that is no family. */
static bool check_orphans(model *m)
{
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *s = &m->statements.item[i];
        symbol named = s->kind == STATEMENT_START || s->kind == STATEMENT_EXACT || (s->kind == STATEMENT_DEFINITION && s->index_count)
                           ? symbols_find(m, s->name) : (symbol){0};
        const char *what = s->kind == STATEMENT_EXACT ? "an exact motion" : "an initial value";
        if ((s->kind == STATEMENT_START || s->kind == STATEMENT_EXACT) && !named.state) {
            if (s->kind == STATEMENT_START && s->start_at->kind == TREE_NAME && !strcmp(s->start_at->name, "t")) {
                source_complain(&m->source, MOTUS_SYNTAX, s->at, "a name is defined without its (t)");
                source_hint(&m->source, "write %s = …; it may use t", s->name);
                return false;
            }
            source_complain(&m->source, MOTUS_NAME, s->name_at, "%s has %s, but no equation of motion", s->name, what);
            if (s->kind == STATEMENT_START && named.definition)
                source_hint(&m->source, "%s is a %s", s->name, named.definition->kind == DEFINED_PARAMETER ? "parameter" : "quantity");
            for (uint32_t k = 0; k < m->state_count; k++)
                if (near_likely(s->name, m->states[k].name))
                    source_hint(&m->source, "did you mean %s?", m->states[k].name);
            source_hint(&m->source, "write one: %s'' = …", s->name);
            return false;
        }
        if (s->kind == STATEMENT_START && s->primes >= named.state->order) {
            source_complain(&m->source, MOTUS_NAME, s->at, "%s has an equation of first order: its derivative at the start follows", s->name);
            return false;
        }
    }
    return true;
}

bool resolve_all(model *m)
{
    /* Room for every scalar and vector component a parameter can have: one per name, and one per comma of the text. */
    m->scalar_slots = m->definition_count + 8;
    for (uint32_t t = 0; t < m->source.count; t++)
        for (uint32_t i = 0; i < m->source.texts[t].length; i++)
            m->scalar_slots += m->source.texts[t].bytes[i] == ',' ? 2 : 0;
    size_t first;
    if (!resolve_pool(m, m->scalar_slots, &first) || !check_orphans(m) || !resolve_start_time(m))
        return false;
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (!resolve_definition(m, &m->definitions[i]))
            return false;
    for (uint32_t i = 0; i < m->state_count; i++)
        if (!start_state(m, &m->states[i]))
            return false;
    return resolve_settings(m) && lay_out(m);
}
