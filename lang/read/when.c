/* Lowers events: the functions that they watch, and what they do. core/rules.h says what an event is.
 *
 * The indices of a family of events are the levels of its formulas. The indices up to the last one that a function
 * reads number the instances of the rule. Each event acts for all values of the others, which for a clock are all
 * indices.
 */
#include "lang/read/read_steps.h"

#include "lang/lower/lower_ghost.h"
#include "lang/lower/resolve.h"
#include "lang/model/symbols.h"

#include <math.h>
#include <string.h>

static bool failed(model *m) { return source_failed(&m->source) || m->graph->too_large; }

/* Indices ---------------------------------------------------------------------------------------------------------- */

static bool open_indices(model *m, model_rule *r, lowering *l)
{
    const statement *s = r->statement;
    if (!lower_loops(l, s->loops, s->loop_count, r->loop)) return false;
    for (uint32_t k = 0; k < s->loop_count; k++) {
        r->first[k] = l->low[k];
        r->last[k] = l->high[k];
    }
    r->loops = s->loop_count;
    return !failed(m);
}

/* Complains if what was lowered would have to be divided (lower_ghost.c). */
static bool whole(model *m, const model_rule *r)
{
    model_cut cut;
    if (!lower_cut(m, 0, r->loops, &cut)) return true;
    COMPLAIN(m, &r->statement->at, "for some of its indices this event reads cells that another line gives");
    HINT(m, "write two events, one for the indices at the border and one for the others");
    return false;
}

/* Functions -------------------------------------------------------------------------------------------------------- */

/* Adds a function, unless the rule has it, and returns its number. */
static size_t add_leaf(model *m, model_rule *r, node n, rule_comparison compare)
{
    for (size_t k = 0; k < r->leaves; k++)
        if (r->leaf[k].value == n && r->compares[k] == compare) return k;
    const size_t k = r->leaves;
    if (!(k & (k - 1))) { /* 0 or a power of two */
        const size_t room = k ? 2 * k : 1;
        output *leaf = arena_replace(m->arena, r->leaf, k * sizeof *leaf, room * sizeof *leaf);
        if (leaf) r->leaf = leaf;
        uint8_t *compares = arena_replace(m->arena, r->compares, k, room);
        if (compares) r->compares = compares;
        if (m->arena->failed) return 0;
    }
    r->leaf[k] = (output){.value = n};
    r->compares[k] = (uint8_t)compare;
    r->leaves++;
    return k;
}

/* Returns a - b, or a if b is the constant 0. */
static node difference(graph *g, node a, node b) { return b == 0 ? a : graph_op(g, OP_SUB, a, b, 0); }

static bool too_long(model *m, const model_rule *r)
{
    source_complain(&m->source, MOTUS_LIMIT, &r->statement->at,
                    "the condition has more than %d comparisons and operators", RULE_FORMULA_MOST);
    HINT(m, "divide it into several events");
    return false;
}

static bool add_word(model *m, model_rule *r, int word)
{
    if (r->words == RULE_FORMULA_MOST) return too_long(m, r);
    r->formula[r->words++] = (int16_t)word;
    return true;
}

/* Adds a condition in postfix order, with a function for each comparison. within: how many operators are around it. */
static bool add_condition(model *m, model_rule *r, node n, int within)
{
    if (within == RULE_FORMULA_MOST) return too_long(m, r);
    graph *g = m->graph;
    const graph_node c = *graph_at(g, n);
    const bool swapped = c.op == OP_LT || c.op == OP_LE;
    rule_comparison compare;
    switch ((operation)c.op) {
    case OP_AND:
    case OP_OR:
        return add_condition(m, r, c.a, within + 1) && add_condition(m, r, c.b, within + 1) &&
               add_word(m, r, c.op == OP_AND ? RULE_AND : RULE_OR);
    case OP_NOT: return add_condition(m, r, c.a, within + 1) && add_word(m, r, RULE_NOT);
    case OP_LT:
    case OP_GT: compare = RULE_ABOVE; break;
    case OP_LE:
    case OP_GE: compare = RULE_AT_LEAST; break;
    case OP_EQ: compare = RULE_AT; break;
    case OP_NE: compare = RULE_OFF; break;
    default: /* a condition that is constant */ return add_word(m, r, (int)add_leaf(m, r, n, RULE_OFF));
    }
    const node leaf = swapped ? difference(g, c.b, c.a) : difference(g, c.a, c.b);
    return add_word(m, r, (int)add_leaf(m, r, leaf, compare));
}

static bool lower_condition(model *m, model_rule *r, lowering *l)
{
    const tree *t = r->statement->when->left;
    char text[80];
    value v = lower_expression(l, t);
    lower_as_condition(l, &v);
    if (!whole(m, r) || failed(m)) return false;
    if (!v.boolean) {
        COMPLAIN(m, &t->at, "an event happens when a condition becomes true, or where two numbers are equal");
        HINT(m, "write when %s = 0: …, or a comparison, when %s != 0: …", quote(m, &t->at, text), text);
        return false;
    }
    r->formula = arena_take(m->arena, RULE_FORMULA_MOST * sizeof *r->formula);
    return !m->arena->failed && add_condition(m, r, v.item[0], 0);
}

/* Refuses a condition as a side of an equation: its number jumps past all numbers between 0 and 1. */
static bool no_condition(model *m, lowering *l, const tree *t, node n)
{
    char text[80];
    value v = {.item = &n};
    lower_as_decided(l, &v);
    if (failed(m) || !v.boolean) return !failed(m);
    COMPLAIN(m, &t->at, "%s is a condition, and one = in an event stands between two numbers", quote(m, &t->at, text));
    HINT(m, "write `when %s: …` for where it becomes true, `when not %s: …` for where it becomes false", text, text);
    return false;
}

static bool lower_equation(model *m, model_rule *r, lowering *l)
{
    const when *w = r->statement->when;
    const node a = lower_scalar(l, w->left, "the left side of an event");
    const node b = failed(m) ? 0 : lower_scalar(l, w->right, "the right side of an event");
    if (!no_condition(m, l, w->left, a) || !no_condition(m, l, w->right, b)) return false;
    if (!whole(m, r) || failed(m)) return false;
    add_leaf(m, r, difference(m->graph, a, b), RULE_ABOVE);
    return true;
}

/* Makes places for the functions, once it is known which indices they read. */
static bool place_leaves(model *m, model_rule *r)
{
    unsigned deps = 0;
    for (size_t k = 0; k < r->leaves; k++) deps |= graph_deps(m->graph, r->leaf[k].value);
    if (r->leaves && !(deps & (DEP_TIME | DEP_STATE))) {
        source_complain(&m->source, MOTUS_ARGUMENT, &r->occasion,
                        "this depends neither on a state nor on time, so it never happens");
        return false;
    }
    r->own = 0;
    r->instances = 1;
    for (int k = 0; k < r->loops; k++)
        if (deps & 1u << k) r->own = (uint8_t)(k + 1);
    for (int k = 0; k < r->own; k++) r->instances *= (size_t)(r->last[k] - r->first[k] + 1);
    r->leaf_first = m->rule_functions;
    if ((double)r->instances * (double)r->leaves > (double)(RULE_FUNCTIONS_MOST - m->rule_functions)) {
        source_complain(&m->source, MOTUS_LIMIT, &r->statement->at,
                        "the events of a model watch at most %d functions, cells of families counted",
                        RULE_FUNCTIONS_MOST);
        return false;
    }
    for (size_t k = 0; k < r->leaves; k++) {
        output *o = &r->leaf[k];
        if (!model_take_arrays(m, 1, &o->to.array)) return false;
        graph_shape(m->arena, &m->arrays[o->to.array], SPACE_OUT, m->rule_functions, r->own, r->first, r->last);
        m->rule_functions += r->instances;
        o->to.dims = r->own;
        o->loops = r->own;
        for (int d = 0; d < r->own; d++) {
            o->loop[d] = r->loop[d];
            o->to.at[d] = (subscript){.level = (int8_t)d, .slot = -1, .modulus = -1};
        }
    }
    return true;
}

/* Actions ---------------------------------------------------------------------------------------------------------- */

/* Complains if an assignment may reach a cell that has no equation. */
static bool moving_cells(model *m, lowering *l, const tree *t, const model_state *s)
{
    int64_t low[MAX_DIMS], high[MAX_DIMS], at[MAX_DIMS];
    char text[80];
    if (s->dims == 0 || (int)t->index_count != s->dims) return true; /* lower_name.c complains */
    for (int d = 0; d < s->dims; d++) {
        subscript ignored;
        if (!lower_subscript(l, t->item[d], &ignored, &low[d], &high[d])) return false;
        if (low[d] > high[d] || low[d] < s->first[d] || high[d] > s->last[d]) return true; /* lower_name.c complains */
        at[d] = low[d];
    }
    do {
        const size_t cell = model_cell(s->dims, s->first, s->last, at);
        if (s->owner[cell] == 2) {
            char name[MOTUS_NAME_MAX + 64];
            model_state_name(s, cell, -1, false, name, sizeof name);
            COMPLAIN(m, &t->at, "%s reaches %s, which a boundary line gives", quote(m, &t->at, text), name);
            HINT(m, "an event assigns cells that have an equation of motion");
            return false;
        }
    } while (model_next_cell(s->dims, low, high, at));
    return true;
}

/* Returns the name on the left of an assignment; NULL: there is none. */
static const tree *target_name(const tree *t)
{
    while (t->kind == TREE_COMPONENT) t = t->item[0];
    return t->kind == TREE_NAME ? t : NULL;
}

/* Complains if an assignment is neither to a state nor to a parameter. */
static bool may_assign(model *m, lowering *l, const tree *t)
{
    const tree *name = target_name(t);
    char text[80];
    if (!name || !strcmp(name->name, "pi") || lower_is_index(l, name->name)) {
        COMPLAIN(m, &t->at, "%s cannot be assigned", quote(m, &t->at, text));
        HINT(m, "an event assigns states and parameters: x = …, x' = …, r' = (…, …), n = …");
        return false;
    }
    if (!strcmp(name->name, m->time)) {
        COMPLAIN(m, &t->at, "%s is the time and cannot be assigned", m->time);
        return false;
    }
    const symbol s = symbols_find(m, name->name);
    if (s.definition && s.definition->kind != DEFINED_PARAMETER) {
        COMPLAIN(m, &t->at, "%s is %s and follows from the state: it cannot be assigned", name->name,
                 s.definition->kind == DEFINED_INVARIANT ? "an invariant" : "a quantity");
        HINT(m, "assign the states that it depends on");
        return false;
    }
    if (s.definition) return true;
    if (!s.state) {
        COMPLAIN(m, &t->at, "%s is a function and cannot be assigned", name->name);
        return false;
    }
    if (name->primes >= s.state->order) {
        COMPLAIN(m, &t->at, "%s follows from its equation and cannot be assigned", quote(m, &name->at, text));
        HINT(m, s.state->order == 2 ? "assign %s or %s'" : "assign %s", s.state->name, s.state->name);
        return false;
    }
    return moving_cells(m, l, name, s.state);
}

bool when_add(model *m, model_rule *r, const model_assignment *one)
{
    const size_t count = r->assignments;
    if (!(count & (count - 1))) { /* 0 or a power of two */
        const size_t room = count ? 2 * count : 1;
        model_assignment *more = arena_replace(m->arena, r->assignment, count * sizeof *more, room * sizeof *more);
        if (!more) return false;
        r->assignment = more;
    }
    r->assignment[r->assignments++] = *one;
    return true;
}

static bool add_assignment(model *m, model_rule *r, const action *a, node target, node is)
{
    const reference to = m->graph->references[graph_at(m->graph, target)->a];
    char text[80];
    for (size_t k = 0; k < r->assignments; k++)
        if (graph_same_reference(&r->assignment[k].to, &to)) {
            COMPLAIN(m, &a->target->at, "%s is assigned twice by one event", quote(m, &a->target->at, text));
            HINT(m, "all right sides see the state before the event; what comes after it is an event of its own");
            return false;
        }
    return when_add(m, r, &(model_assignment){.value = {.value = is}, .to = to, .at = a->target->at});
}

static bool lower_assignment(model *m, model_rule *r, lowering *l, const action *a)
{
    char text[80], other[80];
    if (!may_assign(m, l, a->target)) return false;
    const value to = lower_expression(l, a->target);
    const value is = failed(m) ? to : lower_numbers(l, a->value);
    if (!whole(m, r) || failed(m)) return false;
    if (is.rows || is.count != to.count) {
        quote(m, &a->target->at, text);
        if (to.count)
            COMPLAIN(m, &a->value->at, "%s is a vector of length %d, but this is %s", text, to.count,
                     is.rows    ? "a matrix"
                     : is.count ? "of another length"
                                : "a number");
        else
            COMPLAIN(m, &a->value->at, "%s is a number, but this is a vector", text);
        if (!to.count && is.count) HINT(m, "assign a component: %s.x", quote(m, &a->value->at, other));
        return false;
    }
    for (int k = 0; k < (to.count ? to.count : 1); k++)
        if (!add_assignment(m, r, a, to.item[k], is.item[k])) return false;
    return true;
}

static bool lower_stop(model *m, model_rule *r, const action *a)
{
    double after = 1;
    if (r->stop) {
        COMPLAIN(m, &a->at, "`stop` stands twice in one event");
        return false;
    }
    if (a->value && !resolve_constant(m, a->value, "the number of events before the stop", &after)) return false;
    if (after < 1 || after != floor(after) || after > 9e15) {
        source_complain(&m->source, MOTUS_ARGUMENT, &a->value->at,
                        "`stop after` counts events: 1, 2, 3 …, and this is %g", after);
        return false;
    }
    r->stop = (int64_t)after;
    return true;
}

static bool lower_action(model *m, model_rule *r, lowering *l, const action *a)
{
    if (a->kind == ACTION_STOP) return lower_stop(m, r, a);
    if (a->kind == ACTION_ASSIGN) return lower_assignment(m, r, l, a);
    if (r->records) {
        COMPLAIN(m, &a->at, "`record` stands twice in one event");
        return false;
    }
    return r->records = true;
}

/* Returns whether index k of the rule is in what is assigned. */
static bool runs_over(const reference *to, int k)
{
    for (int d = 0; d < to->dims; d++)
        if (to->at[d].level == k) return true;
    return false;
}

/* Complains about an index on which nothing depends. */
static bool indices_used(model *m, const model_rule *r)
{
    for (int k = r->own; k < r->loops; k++) {
        const loop *l = &r->statement->loops[k];
        bool used = r->assignments > 0;
        for (size_t i = 0; i < r->assignments; i++) used &= runs_over(&r->assignment[i].to, k);
        if (used) continue;
        COMPLAIN(m, &l->at,
                 r->assignments ? "this would assign the same number for every %s" : "nothing depends on the index %s",
                 l->name);
        HINT(m, "when x[%s] = 0 is an event for each %s; what it assigns may also run over %s alone", l->name, l->name,
             l->name);
        return false;
    }
    return true;
}

/* Rules ------------------------------------------------------------------------------------------------------------ */

static bool lower_period(model *m, model_rule *r)
{
    const tree *t = r->statement->when->left;
    node n;
    if (!resolve_varying(m, t, "the period of an event", &n, &r->period)) return false;
    if (r->period > 0) {
        r->every = (output){.value = n};
        if (!model_take_arrays(m, 1, &r->every.to.array)) return false;
        graph_shape(m->arena, &m->arrays[r->every.to.array], SPACE_OUT, (size_t)(r - m->rules), 0, NULL, NULL);
        return true;
    }
    source_complain(&m->source, MOTUS_ARGUMENT, &t->at, "the period of an event is positive, not %g", r->period);
    return false;
}

/* Gives the accumulation of a family's events the instances of that family, if it has indices. */
static bool like_accumulating(model *m, model_rule *r)
{
    const model_rule *of = &m->rules[r->of];
    if (r->loops == 0) return true;
    bool same = r->loops >= of->own && of->own > 0;
    for (int k = 0; same && k < of->own; k++) same = r->first[k] == of->first[k] && r->last[k] == of->last[k];
    if (!same) {
        COMPLAIN(m, &r->statement->loops[0].at, "the indices of an accumulation are those of the event %s", of->name);
        HINT(m, of->own ? "write the ranges that it has, in their order" : "it has none: leave the ranges out");
        return false;
    }
    r->own = of->own;
    r->instances = of->instances;
    return true;
}

static bool lower_rule(model *m, model_rule *r)
{
    lowering l;
    const when *w = r->statement->when;
    lower_start(&l, m, PLACE_EVENT, "an event");
    if (w->left) r->occasion = (span){w->left->at.text, w->left->at.from, (w->right ? w->right : w->left)->at.to};
    if (!open_indices(m, r, &l)) return false;
    bool ok = true;
    switch (w->kind) {
    case WHEN_EQUAL:
        r->kind = RULE_ROOT;
        r->direction = w->direction;
        ok = lower_equation(m, r, &l);
        break;
    case WHEN_CONDITION:
        r->kind = RULE_CONDITION;
        ok = lower_condition(m, r, &l);
        break;
    case WHEN_EVERY:
        r->kind = RULE_CLOCK;
        ok = lower_period(m, r);
        break;
    default: r->kind = RULE_ACCUMULATES;
    }
    if (!ok || !place_leaves(m, r) || (w->kind == WHEN_ACCUMULATES && !like_accumulating(m, r))) return false;
    for (const action *a = w->actions; a; a = a->next)
        if (!lower_action(m, r, &l, a)) return false;
    return indices_used(m, r);
}

bool when_all(model *m)
{
    /* accumulations have the indices of other events */
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t i = 0; i < m->rule_count; i++)
            if ((m->rules[i].statement->when->kind == WHEN_ACCUMULATES) == pass && !lower_rule(m, &m->rules[i]))
                return false;
    return !failed(m);
}
