/* See arguments.h. An argument within a sum has as many values as the sum has terms, so a function with such an
 * argument is not determined by its arguments. */
#include "machine/arguments.h"

#include "core/rules.h"
#include "lang/graph/graph_walk.h"
#include "lang/model/resolution.h"

#include <math.h>

enum { USES_MOST = 16, DEGREE_MOST = 8, MOVING = DEP_TIME | (DEP_STATE & ~DEP_MODE) };

/* An operation and the numbers of its arguments. */
typedef struct use {
    uint8_t op, of[2];
} use;

typedef struct leaf {
    node argument[RULE_ARGUMENTS_MOST];
    use use[USES_MOST];
    int arguments, uses;
    bool told;
} leaf;

struct arguments {
    leaf *leaf;
    tape *tape[RULE_ARGUMENTS_MOST]; /* number k has argument k of all functions */
    size_t most;
};

/* The search for the arguments of one leaf. */
typedef struct finding {
    graph *g;
    const graph_walk *walk;
    double *degree; /* of each node of the walk, in what moves; an operation that is noted counts as a variable */
    leaf *leaf;
    unsigned within; /* the levels of sums, as dependences */
} finding;

static double degree_of(const finding *f, node n)
{
    return graph_reached(f->g, f->walk, n) ? f->degree[f->g->place[n]] : 0;
}

/* Returns the number of an argument, which it adds if it is new; RULE_ARGUMENTS_MOST: there is no room, or it is within
 * a sum. */
static int number_of(finding *f, node n)
{
    leaf *l = f->leaf;
    int k = 0;
    while (k < l->arguments && l->argument[k] != n) k++;
    if (k < l->arguments) return k;
    if (k == RULE_ARGUMENTS_MOST || f->g->nodes[n].deps & f->within) return RULE_ARGUMENTS_MOST;
    l->argument[l->arguments++] = n;
    return k;
}

static void note(finding *f, const graph_node *n, const node *operand)
{
    leaf *l = f->leaf;
    const bool two = operation_at((operation)n->op)->arity == 2, divides = n->op == OP_DIV;
    const int a = number_of(f, operand[divides]), b = two && !divides ? number_of(f, operand[1]) : a;
    l->told &= a < RULE_ARGUMENTS_MOST && b < RULE_ARGUMENTS_MOST && l->uses < USES_MOST;
    if (l->told) l->use[l->uses++] = (use){n->op, {(uint8_t)a, (uint8_t)b}};
}

/* Returns the degree of a node from those of its operands; notes an operation that is not a polynomial of them. */
static double visit(finding *f, node self)
{
    const graph_node n = f->g->nodes[self];
    node operand[3] = {0};
    double d[3] = {0}, most = 0;
    const int count = graph_operands(&n, operand);
    for (int j = 0; j < count; j++) d[j] = degree_of(f, operand[j]), most = fmax(most, d[j]);
    switch ((degree_rule)operation_at((operation)n.op)->degree) {
    case DEGREE_LEAF: return 1;
    case DEGREE_SUM:
        if (count > 1 && d[1] > 0) f->leaf->told = false;
        return most;
    case DEGREE_LINEAR: return most;
    case DEGREE_PRODUCT: return d[0] + d[1];
    case DEGREE_FUSED: return fmax(d[0] + d[1], d[2]);
    case DEGREE_QUOTIENT:
        if (d[1] > 0) break;
        return d[0];
    default: break;
    }
    note(f, &n, operand);
    return 1;
}

static bool find(model *m, const output *o, leaf *l)
{
    graph *g = m->graph;
    graph_walk w;
    l->told = true;
    if (!graph_order(g, &o->value, 1, MOVING, true, &w)) return false;
    double *degree = take(&g->arena->allocator, (size_t)w.count + 1, sizeof *degree);
    finding f = {g, &w, degree, l, DEP_LEVELS & ~((1u << o->loops) - 1)};
    for (uint32_t k = 0; degree && k < w.count; k++) {
        degree[k] = visit(&f, w.nodes[k]);
        l->told &= degree[k] <= DEGREE_MOST;
    }
    if (!l->told) l->arguments = 0;
    if (!degree) g->arena->failed = true;
    give(&g->arena->allocator, degree);
    give(&g->arena->allocator, w.nodes);
    return degree != NULL;
}

/* Makes the tape of argument k of all functions. */
static tape *tape_for(model *m, const output *leaves, const leaf *l, size_t count, int k, output *room)
{
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        if (k >= l[i].arguments) continue;
        room[n] = leaves[i];
        room[n++].value = l[i].argument[k];
    }
    return tape_of(m->arena, m->graph, room, n);
}

bool arguments_create(model *m, arguments **out)
{
    size_t count = 0;
    for (uint32_t i = 0; i < m->rule_count; i++) count += m->rules[i].leaves;
    arguments *a = *out = arena_take(m->arena, sizeof *a);
    output *leaves = arena_room(m->arena, 2 * (count + 1) * sizeof *leaves), *room = leaves + count;
    leaf *l = arena_take(m->arena, (count + 1) * sizeof *l);
    if (!a || !leaves || !l) return false;
    a->leaf = l;
    for (uint32_t i = 0, n = 0; i < m->rule_count; i++)
        for (size_t k = 0; k < m->rules[i].leaves; k++, n++) {
            leaves[n] = m->rules[i].leaf[k];
            if (!find(m, &leaves[n], &l[n])) return false;
            if ((size_t)l[n].arguments > a->most) a->most = (size_t)l[n].arguments;
        }
    for (size_t k = 0; k < a->most; k++)
        if (!(a->tape[k] = tape_for(m, leaves, l, count, (int)k, room))) return false;
    return true;
}

bool arguments_bind(arguments *a, const binding *b)
{
    for (size_t k = 0; k < a->most; k++)
        if (!tape_bind(a->tape[k], b)) return false;
    return true;
}

size_t arguments_most(const arguments *a) { return a->most; }

void arguments_run(const arguments *a, size_t functions, double t, double *x, double *v, double *out)
{
    for (size_t k = 0; k < a->most * functions; k++) out[k] = NAN;
    for (size_t k = 0; k < a->most; k++)
        tape_run(a->tape[k], t, (double *[SPACES]){[SPACE_X] = x, [SPACE_V] = v, [SPACE_OUT] = out + k * functions});
}

bool arguments_regular(const arguments *a, size_t number, const double *low, const double *high)
{
    const leaf *l = &a->leaf[number];
    bool all = l->told && l->uses > 0;
    for (int k = 0; all && k < l->uses; k++) {
        const int p = l->use[k].of[0], q = l->use[k].of[1];
        all = low[p] <= high[p] && low[q] <= high[q] &&
              resolution_regular((operation)l->use[k].op, (interval){low[p], high[p]}, (interval){low[q], high[q]});
    }
    return all;
}
