/* A node as text in the language, with as few brackets as the grammar allows; a quotient before a factor has one more.
 *
 * Invariant: the text reads back as a node of the same value, bit for bit, except that shared nodes are written at
 * every use, and so may be fused otherwise. Signs may move: x + (-2 y) is written x - 2 y. Chains of multiplications
 * become powers. Nodes to be written wait on a list, not on the C stack. The text ends at GRAPH_TEXT_MAX, because a
 * shared graph written as a tree may be exponentially long.
 */
#include "lang/graph/graph_walk.h"
#include "lang/base/operation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* From loosest to tightest. */
typedef enum tightness { T_OR, T_AND, T_NOT, T_COMPARISON, T_SUM, T_MINUS, T_PRODUCT, T_POWER, T_FACTOR } tightness;

/* What stands last in the text, on which it depends whether a product is written by juxtaposition. */
typedef enum tail { TAIL_NONE, TAIL_NUMBER, TAIL_LATE_NUMBER, TAIL_NAME, TAIL_STATE, TAIL_POWER, TAIL_CLOSE } tail;

typedef enum task_kind { TASK_NODE, TASK_TEXT, TASK_NUMBER, TASK_LEVEL, TASK_BOUND, TASK_TIMES } task_kind;
typedef struct task {
    uint8_t kind, tightness, tail;
    bool bare; /* NODE: without its minus sign */
    node n;    /* NODE; TIMES: the right factor; LEVEL: the level; BOUND: the number of the range */
    const char *text;
    int number; /* NUMBER; BOUND: 0 for the first bound, 1 for the last */
} task;

typedef struct printer {
    const graph *g;
    graph_namer name;
    void *ctx;
    char *out;
    size_t size, wanted;
    tail tail;
    char last; /* the last character written */
    task *tasks;
    uint32_t count, capacity;
    bool failed;
} printer;

static void text(printer *p, const char *s)
{
    for (; *s && p->wanted < GRAPH_TEXT_MAX; s++, p->wanted++) {
        if (p->wanted + 1 < p->size) p->out[p->wanted] = *s;
        p->last = *s;
    }
}

static void push(printer *p, task t)
{
    if (p->count == p->capacity) {
        uint32_t capacity = p->capacity ? 2 * p->capacity : 64;
        task *tasks = take_more(&p->g->arena->allocator, p->tasks, p->count, capacity, sizeof *tasks);
        if (!tasks) {
            p->failed = true;
            return;
        }
        p->tasks = tasks;
        p->capacity = capacity;
    }
    p->tasks[p->count++] = t;
}

/* These push in reverse: the last task pushed is written first. */
static void say(printer *p, const char *s, tail t)
{
    push(p, (task){.kind = TASK_TEXT, .text = s, .tail = (uint8_t)t});
}
static void then(printer *p, node n, tightness t)
{
    push(p, (task){.kind = TASK_NODE, .n = n, .tightness = (uint8_t)t});
}
static void bare(printer *p, node n)
{
    push(p, (task){.kind = TASK_NODE, .n = n, .tightness = T_PRODUCT, .bare = true});
}

/* Shapes ----------------------------------------------------------------------------------------------------------- */

static bool minus_number(const graph *g, node n)
{
    return g->nodes[n].op == OP_CONST && signbit(g->nodes[n].value) && !isnan(g->nodes[n].value);
}

/* Returns whether a node is written with a minus in front: -x, -2, -2 x. */
static bool negative(const graph *g, node n)
{
    const graph_node *m = &g->nodes[n];
    return m->op == OP_NEG || minus_number(g, n) || ((m->op == OP_MUL || m->op == OP_DIV) && minus_number(g, m->a));
}

/* The power that a product a*b is: x*x, or a step of graph_power's chain; exponent 0: it is none. */
enum { POWER_MAX = 64, CHAIN_MAX = 12 };
typedef struct power {
    node base;
    int exponent;
} power;

static power power_of(const graph *g, node a, node b, int depth)
{
    power p = {a, 1};
    if (depth < CHAIN_MAX && g->nodes[a].op == OP_MUL) {
        power inner = power_of(g, g->nodes[a].a, g->nodes[a].b, depth + 1);
        if (inner.exponent) p = inner;
    }
    if (a == b && 2 * p.exponent <= POWER_MAX) return (power){p.base, 2 * p.exponent};
    if (p.base == b && p.exponent % 2 == 0 && p.exponent < POWER_MAX) return (power){p.base, p.exponent + 1};
    return (power){0, 0};
}

static power power_at(const graph *g, node n)
{
    const graph_node *m = &g->nodes[n];
    return m->op == OP_MUL ? power_of(g, m->a, m->b, 0) : (power){0, 0};
}

/* Returns whether the minus of a factor can stand before the whole product. */
static bool minus_factor(const graph *g, node n)
{
    return minus_number(g, n) || (g->nodes[n].op == OP_NEG && g->nodes[g->nodes[n].a].op != OP_DIV);
}

void graph_name(graph *g, node n, node argument, const char *before, const char *after, int component)
{
    for (uint32_t k = 0; k < g->call_count; k++)
        if (g->calls[k].n == n) return;
    if (!arena_more(g->arena, &g->calls, g->call_count, &g->call_room, sizeof *g->calls)) return;
    g->calls[g->call_count++] = (graph_call){n, argument, component, before, after};
}

/* Returns the call that has made a node; NULL: none. */
static const graph_call *call_of(const graph *g, node n)
{
    const graph_call *found = NULL;
    if (g->nodes[n].op == OP_ADD)
        for (uint32_t k = 0; k < g->call_count && !found; k++)
            if (g->calls[k].n == n) found = &g->calls[k];
    return found;
}

static tightness tightness_of(const graph *g, node n)
{
    const graph_node *m = &g->nodes[n];
    if (call_of(g, n)) return T_FACTOR;
    if (negative(g, n)) return T_MINUS;
    switch (m->op) {
    case OP_OR: return T_OR;
    case OP_AND: return T_AND;
    case OP_NOT: return T_NOT;
    case OP_LT:
    case OP_LE:
    case OP_GT:
    case OP_GE:
    case OP_EQ:
    case OP_NE: return T_COMPARISON;
    case OP_ADD:
    case OP_SUB:
    case OP_FMA:
    case OP_FMS:
    case OP_FNMA: return T_SUM;
    case OP_MUL: return power_at(g, n).exponent ? T_POWER : T_PRODUCT;
    case OP_DIV: return T_PRODUCT;
    case OP_POW: return T_POWER;
    case OP_CONST: return isfinite(m->value) ? T_FACTOR : T_PRODUCT;
    default: return T_FACTOR;
    }
}

/* Returns whether the right factor of a product starts with a digit, or with a bracket. */
static void right_factor(const graph *g, node n, bool *digit, bool *bracket)
{
    *digit = *bracket = false;
    if (tightness_of(g, n) < T_POWER) {
        *bracket = true;
        return;
    }
    const graph_node *m = &g->nodes[n];
    if (m->op == OP_MUL || m->op == OP_POW) {
        node base = m->op == OP_POW ? m->a : power_at(g, n).base;
        *bracket = tightness_of(g, base) < T_FACTOR;
        m = &g->nodes[base];
    }
    *digit = !*bracket && m->op == OP_CONST;
}

/* Leaves ----------------------------------------------------------------------------------------------------------- */

static void ask(printer *p, const graph_node *n, const char *otherwise)
{
    char name[MOTUS_NAME_MAX * 4] = "";
    if (p->name) p->name(p->ctx, n, name, sizeof name);
    text(p, name[0] ? name : otherwise);
}

static void level_name(printer *p, int level)
{
    ask(p, &(graph_node){.op = OP_INDEX, .level = (uint8_t)level},
        (const char *[]){"i", "j", "k", "l", "m", "n", "o", "p"}[level]);
}

static void bound(printer *p, const subscript *s)
{
    char number[32];
    bool first = true;
    if (s->modulus >= 0) text(p, "mod(");
    if (s->level >= 0) {
        level_name(p, s->level);
        first = false;
    }
    if (s->slot >= 0) {
        text(p, first ? "" : " + ");
        snprintf(number, sizeof number, "n%d", s->slot);
        ask(p, &(graph_node){.op = OP_INDEX, .level = MAX_LEVELS, .a = (node)s->slot}, number);
        first = false;
    }
    if (s->literal || first) {
        snprintf(number, sizeof number, "%lld",
                 s->literal < 0 && !first ? -(long long)s->literal : (long long)s->literal);
        text(p, first ? "" : s->literal < 0 ? " - " : " + ");
        text(p, number);
    }
    if (s->modulus >= 0) {
        text(p, ", ");
        snprintf(number, sizeof number, "n%d", s->modulus);
        ask(p, &(graph_node){.op = OP_INDEX, .level = MAX_LEVELS, .a = (node)s->modulus}, number);
        text(p, ")+1");
    }
}

static void number(printer *p, double value)
{
    char s[DECIMAL_MAX];
    bool late = p->last == '*';
    if (isnan(value)) {
        text(p, "0/0");
    } else if (isinf(value)) {
        text(p, "1/0");
    } else {
        text(p, decimal(value, s));
    }
    p->tail = late ? TAIL_LATE_NUMBER : TAIL_NUMBER;
}

static void leaf(printer *p, const graph_node *n)
{
    switch (n->op) {
    case OP_CONST: number(p, n->value); return;
    case OP_TIME: ask(p, n, "t"); break;
    case OP_INDEX:
        level_name(p, n->level);
        p->tail = TAIL_STATE;
        return;
    case OP_TOTAL: text(p, "total"); break;
    case OP_LOAD:
        ask(p, n, "?");
        p->tail = TAIL_STATE;
        return;
    default: ask(p, n, "?"); break;
    }
    p->tail = TAIL_NAME;
}

/* Nodes ------------------------------------------------------------------------------------------------------------ */

static void infix(printer *p, node a, tightness left, const char *sign, node b, tightness right)
{
    then(p, b, right);
    say(p, sign, TAIL_NONE);
    then(p, a, left);
}

/* Writes a + b or a - b; a minus at the head of b turns the sign. */
static void sum(printer *p, node a, bool minus, node b)
{
    if (negative(p->g, b)) {
        bare(p, b);
        minus = !minus;
    } else {
        then(p, b, T_PRODUCT);
    }
    say(p, minus ? " - " : " + ", TAIL_NONE);
    then(p, a, T_SUM);
}

static void raise(printer *p, power w)
{
    push(p, (task){.kind = TASK_NUMBER, .number = w.exponent});
    say(p, "^", TAIL_NONE);
    then(p, w.base, T_FACTOR);
}

/* Writes a product. A quotient on the left gets brackets that the grammar does not need, to show what is divided. */
static void product(printer *p, node a, node b, bool without_minus)
{
    power whole = power_of(p->g, a, b, 0);
    if (whole.exponent) {
        raise(p, whole);
        return;
    }
    then(p, b, T_POWER);
    push(p, (task){.kind = TASK_TIMES, .n = b});
    if (without_minus)
        bare(p, a);
    else
        then(p, a, p->g->nodes[a].op == OP_DIV ? T_POWER : T_PRODUCT);
}

/* Writes c + a b or c - a b. */
static void fused(printer *p, const graph_node *m, bool minus)
{
    bool turn = minus_factor(p->g, m->a);
    product(p, m->a, m->b, turn);
    say(p, minus != turn ? " - " : " + ", TAIL_NONE);
    then(p, m->c, T_SUM);
}

static void call(printer *p, const char *name, const node *operands, int count)
{
    say(p, ")", TAIL_CLOSE);
    for (int k = count; k-- > 0;) {
        then(p, operands[k], T_OR);
        if (k) say(p, ", ", TAIL_NONE);
    }
    say(p, "(", TAIL_NONE);
    say(p, name, TAIL_NONE);
}

static void sum_over(printer *p, const graph_node *m)
{
    const graph_node *how = &p->g->nodes[m->a];
    bool add = how->op == OP_ADD && p->g->nodes[how->a].op == OP_TOTAL;
    bool fuse = (how->op == OP_FMA || how->op == OP_FNMA) && p->g->nodes[how->c].op == OP_TOTAL;
    say(p, ")", TAIL_CLOSE);
    if (fuse) {
        product(p, how->a, how->b, false);
        if (how->op == OP_FNMA) say(p, "-", TAIL_NONE);
    } else {
        then(p, add ? how->b : m->a, T_OR);
    }
    say(p, ": ", TAIL_NONE);
    if (m->b) {
        then(p, m->b, T_OR);
        say(p, ", ", TAIL_NONE);
    }
    push(p, (task){.kind = TASK_BOUND, .n = m->c, .number = 1});
    say(p, "..", TAIL_NONE);
    push(p, (task){.kind = TASK_BOUND, .n = m->c, .number = 0});
    say(p, " = ", TAIL_NONE);
    push(p, (task){.kind = TASK_LEVEL, .n = m->level});
    say(p, "sum(", TAIL_NONE);
}

static void without_minus(printer *p, node n)
{
    const graph_node *m = &p->g->nodes[n];
    if (m->op == OP_NEG)
        then(p, m->a, T_PRODUCT);
    else if (m->op == OP_CONST)
        number(p, -m->value);
    else if (m->op == OP_MUL)
        product(p, m->a, m->b, true);
    else {
        then(p, m->b, T_POWER);
        say(p, "/", TAIL_NONE);
        bare(p, m->a);
    }
}

static void write_node(printer *p, node n)
{
    static const char *const comparisons[] = {" < ", " <= ", " > ", " >= ", " == ", " != "};
    const graph *g = p->g;
    const graph_node *m = &g->nodes[n];
    const char *sign = operation_at(m->op)->spelling;
    const graph_call *called = call_of(g, n);
    if (called) {
        say(p, called->component ? "]" : ")", TAIL_CLOSE);
        if (called->component) {
            push(p, (task){.kind = TASK_NUMBER, .number = called->component});
            say(p, ")[", TAIL_NONE);
        }
        say(p, called->after, TAIL_NONE);
        say(p, ", ", TAIL_NONE);
        then(p, called->argument, T_OR);
        say(p, called->before, TAIL_NONE);
        return;
    }
    if (negative(g, n)) {
        text(p, "-");
        without_minus(p, n);
        return;
    }
    switch (m->op) {
    case OP_CONST:
    case OP_TIME:
    case OP_PARAM:
    case OP_INDEX:
    case OP_LOAD:
    case OP_TABLE:
    case OP_TOTAL: leaf(p, m); return;
    case OP_SUM: sum_over(p, m); return;
    case OP_ADD: sum(p, m->a, false, m->b); return;
    case OP_SUB: sum(p, m->a, true, m->b); return;
    case OP_FMA: fused(p, m, false); return;
    case OP_FNMA: fused(p, m, true); return;
    case OP_FMS:
        if (negative(g, m->c)) {
            bare(p, m->c);
            say(p, " + ", TAIL_NONE);
        } else {
            then(p, m->c, T_PRODUCT);
            say(p, " - ", TAIL_NONE);
        }
        product(p, m->a, m->b, minus_factor(g, m->a));
        if (minus_factor(g, m->a)) say(p, "-", TAIL_NONE);
        return;
    case OP_MUL: product(p, m->a, m->b, false); return;
    case OP_DIV: infix(p, m->a, T_PRODUCT, "/", m->b, T_POWER); return;
    case OP_POW: infix(p, m->a, T_FACTOR, "^", m->b, T_POWER); return;
    case OP_LT:
    case OP_LE:
    case OP_GT:
    case OP_GE:
    case OP_EQ:
    case OP_NE: infix(p, m->a, T_SUM, comparisons[m->op - OP_LT], m->b, T_SUM); return;
    case OP_AND: infix(p, m->a, T_AND, " and ", m->b, T_NOT); return;
    case OP_OR: infix(p, m->a, T_OR, " or ", m->b, T_AND); return;
    case OP_FIND:
        say(p, ", ...)", TAIL_CLOSE);
        then(p, m->b, T_OR);
        say(p, ", ", TAIL_NONE);
        then(p, m->a, T_OR);
        say(p, "interp(", TAIL_NONE);
        return;
    case OP_ENTRY:
        say(p, "]", TAIL_CLOSE);
        then(p, m->a, T_OR);
        say(p, "[", TAIL_NONE);
        then(p, m->b, T_FACTOR);
        return;
    case OP_NOT:
        then(p, m->a, T_NOT);
        say(p, "not ", TAIL_NONE);
        return;
    default: call(p, sign, (node[]){m->a, m->b, m->c}, operation_at(m->op)->arity); return;
    }
}

static void times(printer *p, node right)
{
    bool digit, bracket;
    right_factor(p->g, right, &digit, &bracket);
    /* `x (…)` would be an initial value, `x 2` and `i (…)` are errors, `x^2 (…)` reads badly, and in `x*2 y` the 2 is
     * not first */
    bool star = digit || p->tail == TAIL_LATE_NUMBER || (bracket && (p->tail == TAIL_STATE || p->tail == TAIL_POWER));
    text(p, star ? "*" : " ");
}

static void work(printer *p, const task *t)
{
    char digits[16];
    switch ((task_kind)t->kind) {
    case TASK_NODE:
        if (t->bare) {
            without_minus(p, t->n);
        } else if (tightness_of(p->g, t->n) < (tightness)t->tightness) {
            text(p, "(");
            say(p, ")", TAIL_CLOSE);
            then(p, t->n, T_OR);
        } else {
            write_node(p, t->n);
        }
        break;
    case TASK_TEXT:
        text(p, t->text);
        p->tail = (tail)t->tail;
        break;
    case TASK_NUMBER:
        snprintf(digits, sizeof digits, "%d", t->number);
        text(p, digits);
        p->tail = TAIL_POWER;
        break;
    case TASK_LEVEL: level_name(p, (int)t->n); break;
    case TASK_BOUND: bound(p, t->number ? &p->g->ranges[t->n].last : &p->g->ranges[t->n].first); break;
    case TASK_TIMES: times(p, t->n); break;
    }
}

size_t graph_print(const graph *g, node n, graph_namer name, void *ctx, char *out, size_t size)
{
    printer p = {.g = g, .name = name, .ctx = ctx, .out = out, .size = size};
    then(&p, n, T_OR);
    while (p.count && !p.failed && p.wanted < GRAPH_TEXT_MAX) {
        task t = p.tasks[--p.count];
        work(&p, &t);
    }
    give(&g->arena->allocator, p.tasks);
    if (size) out[p.wanted < size ? p.wanted : size - 1] = 0;
    if (p.failed || p.wanted >= GRAPH_TEXT_MAX) {
        g->arena->failed |= p.failed;
        size_t end = p.wanted < size ? p.wanted : size ? size - 1 : 0;
        if (end >= 3) memcpy(out + end - 3, "...", 3);
    }
    return p.wanted;
}
