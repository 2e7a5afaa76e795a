/* The check of exact lines between the times that verify_exact.c samples: a force may have a pulse there, or a switch.
 *
 * Each piece of time between two samples is halved, and its middle sampled, until the force is resolved over it
 * (lang/model/resolution.h), with the motion bounded by its own formulas. A switch counts as 1 over what it compares
 * with 0, which is not resolved where that is 0. Invariant: a difference counts where it lasts for INSTANT of the
 * run on both sides; so the one instant of a switch, at which rounding decides, refuses no line.
 */
#include "lang/read/verify.h"

#include "lang/graph/graph_walk.h"
#include "lang/model/switches.h"

#include <math.h>

enum {
    PIECES = 64,
    DEPTH = 26,       /* halvings of a piece */
    TRIES_MAX = 4096, /* pieces that are examined in all */
    MOVING = DEP_TIME | DEP_STATE
};
#define INSTANT 1e-10 /* of the run; less than a piece after DEPTH halvings */
#define WORK_MAX 4e6  /* operations: of large models fewer pieces are examined */
#define POLE 1e3      /* times the largest number of the motion elsewhere: there it has a pole */

struct verify_between {
    resolution *force, *poles; /* of the force with its switches, of the motion alone; NULL: nothing to resolve */
    bool sums;                 /* switches within sums, which are not examined */
};

/* Making it -------------------------------------------------------------------------------------------------------- */

/* Whether an operation counts as a switch. An angle that is an output (`told`) jumps on its cut; a force that reads one
 * may well be the same on both sides. */
static bool counts(const graph *g, const graph_node *n, bool told)
{
    return switches_is(g, n) || (told && n->op == OP_ATAN2);
}

/* Returns what is 0 where the operation switches; 0: it is no switch. */
static node switched_at(graph *g, const graph_node *n, bool told)
{
    if (!counts(g, n, told)) return 0;
    if (n->op == OP_ATAN2) return graph_op(g, OP_MAX, graph_op(g, OP_ABS, n->a, 0, 0), n->b, 0);
    const operation op = (operation)n->op;
    const node u = switches_argument(g, op, n->a, n->b);
    if (!switches_counts(op)) return u;
    return graph_op(g, OP_SIN, graph_op(g, OP_MUL, graph_const(g, 3.141592653589793), u, 0), 0, 0);
}

/* Adds the switches of one output to a list, as outputs that go into no place; `to` NULL: counts them. */
static bool add_switches(model *m, const output *o, verify_switches which, output *to, size_t *count, bool *sums)
{
    graph *g = m->graph;
    graph_walk w;
    const space into = m->arrays[o->to.array].space;
    const bool told = into == SPACE_OUT;
    if (!graph_order(g, &o->value, 1, MOVING, true, &w)) return false;
    for (uint32_t k = 0; k < w.count; k++) {
        const graph_node n = g->nodes[w.nodes[k]];
        if (which == VERIFY_LOCATED && switches_timed(g, &n)) continue;
        if (!to) {
            *count += counts(g, &n, told);
            continue;
        }
        const node zero = switched_at(g, &n, told);
        if (!zero || !(graph_deps(g, zero) & MOVING)) continue;
        const unsigned outer = (1u << o->loops) - 1, levels = (1u << MAX_LEVELS) - 1;
        if (graph_deps(g, zero) & levels & ~outer) {
            *sums = true;
            continue;
        }
        output *made = &to[(*count)++];
        *made = *o;
        made->value = graph_op(g, OP_DIV, graph_const(g, 1), zero, 0);
        if (into == SPACE_X) made->to.array = (uint16_t)(o->to.array - m->block[BLOCK_X] + m->block[BLOCK_A]);
        if (into == SPACE_V) made->to.array = (uint16_t)(o->to.array - m->block[BLOCK_V] + m->block[BLOCK_A]);
    }
    give(&m->arena->allocator, w.nodes);
    return true;
}

bool verify_resolution(model *m, const output *const lists[], const size_t counts[], size_t n, verify_switches which,
                       resolution **out, bool *sums)
{
    size_t plain = 0, room = 0, count = 0;
    for (size_t l = 0; l < n; l++)
        for (size_t k = 0; k < counts[l]; k++, plain++)
            if (which && !add_switches(m, &lists[l][k], which, NULL, &room, sums)) return false;
    output *all = arena_room(m->arena, (plain + room + 1) * sizeof *all);
    if (!all) return false;
    for (size_t l = 0; l < n; l++)
        for (size_t k = 0; k < counts[l]; k++) all[count++] = lists[l][k];
    for (size_t k = 0; which && k < plain; k++)
        if (!add_switches(m, &all[k], which, all, &count, sums)) return false;
    return resolution_create(m, all, count, count > plain, out);
}

bool verify_between_make(model *m)
{
    struct verify_between *b = m->verify->between = arena_take(m->arena, sizeof *b);
    if (!b || !m->verify->bounded) return b != NULL;
    const output *const lists[] = {m->exact, m->boundary, m->accel};
    const size_t counts[] = {m->exact_count, m->boundary_count, m->accel_count};
    return verify_resolution(m, lists, counts, 3, VERIFY_SWITCHES, &b->force, &b->sums) &&
           resolution_create_poles(m, m->exact, m->exact_count, &b->poles);
}

/* Going through the run -------------------------------------------------------------------------------------------- */

typedef struct walk {
    model *model;
    verify_sample *sample;
    interval *x, *v;
    double run, usual; /* the run's length; the largest number of the motion at the samples */
    int tries;
    bool unresolved;
    size_t wrong; /* the number of v that differs; nv: none */
    double pole;  /* the time of a pole; NaN: none */
} walk;

static double greatest(const model *m, const verify_sample *s)
{
    double most = 0;
    for (size_t k = 0; k < m->nx; k++) most = fmax(most, fabs(s->x[k]));
    for (size_t k = 0; k < m->nv; k++) most = fmax(most, fabs(s->v[k]));
    return most;
}

/* Whether the equation holds at a time, or shortly before or after it. Times outside the run are not tried. */
static bool holds(walk *w, double t)
{
    const model *m = w->model;
    static const double shift[3] = {INSTANT, -INSTANT, 0}; /* the last failure is reported */
    for (int k = 0; k < 3; k++) {
        const double at = t + shift[k] * w->run, part = (at - m->start) / w->run;
        if (part < 0 || part > 1) continue;
        w->wrong = verify_sample_at(m, w->sample, at);
        if (w->wrong == m->nv) return true;
    }
    return false;
}

/* The intervals are the state at the middle; the formulas of the motion, which come first, widen them. */
static void intervals(walk *w, double a, double b, interval *t)
{
    const model *m = w->model;
    verify_sample_move(m, w->sample, a + (b - a) / 2);
    for (size_t k = 0; k < m->nx; k++) w->x[k] = (interval){w->sample->x[k], w->sample->x[k]};
    for (size_t k = 0; k < m->nv; k++) w->v[k] = (interval){w->sample->v[k], w->sample->v[k]};
    *t = (interval){fmin(a, b), fmax(a, b)};
}

/* A short piece that is not resolved: whether the motion has a pole in it. */
static bool has_pole(walk *w, double a, double b)
{
    const model *m = w->model;
    interval t;
    if (!m->verify->between->poles) return false;
    intervals(w, a, b, &t);
    if (!resolution_pole(m->verify->between->poles, t, w->x, w->v, m->pool)) return false;
    verify_sample_move(m, w->sample, a);
    const double at_a = greatest(m, w->sample);
    verify_sample_move(m, w->sample, b);
    return fmin(at_a, greatest(m, w->sample)) > POLE * w->usual;
}

/* Examines a piece whose ends were sampled. False: the line is wrong. */
static bool examine(walk *w, double a, double b, int depth)
{
    interval t;
    intervals(w, a, b, &t);
    w->tries--;
    if (resolution_fits(w->model->verify->between->force, t, w->x, w->v, w->model->pool)) return true;
    if (depth == DEPTH) {
        if (has_pole(w, a, b)) w->pole = a + (b - a) / 2;
        return isnan(w->pole);
    }
    if (w->tries <= 0) return w->unresolved = true;
    const double middle = a + (b - a) / 2;
    return holds(w, middle) && examine(w, a, middle, depth + 1) && examine(w, middle, b, depth + 1);
}

static bool go(walk *w)
{
    const model *m = w->model;
    const double work = fmax(m->terms, (double)m->nv) * (1 + (double)m->verify->nodes);
    const int most = (int)fmin(TRIES_MAX, WORK_MAX / work) / PIECES;
    for (int k = 0; k < PIECES; k++) { /* the middles: ends are sampled from both sides, and poles lie there often */
        verify_sample_move(m, w->sample, m->start + w->run * (k + 0.5) / PIECES);
        const double size = greatest(m, w->sample);
        if (isfinite(size)) w->usual += size / PIECES;
    }
    for (int k = 0; k < PIECES; k++) {
        const double a = m->start + w->run * k / PIECES, b = m->start + w->run * (k + 1) / PIECES;
        w->tries = most + (w->tries > 0 ? w->tries : 0);
        if (!holds(w, b) || !examine(w, a, b, 0)) return false;
    }
    return true;
}

motus_status verify_between(model *m, verify_sample *s, verify_fault *fault)
{
    const struct verify_between *b = m->verify->between;
    const double run = isfinite(m->until) ? m->until - m->start : 1;
    *fault = (verify_fault){.number = m->nv, .pole = NAN};
    m->exact_between = m->verify->bounded && !b->sums;
    if (!b->force || run == 0) return MOTUS_OK;
    interval *room = take(&m->arena->allocator, m->nx + m->nv + 1, sizeof *room);
    if (!room) return MOTUS_MEMORY;
    walk w = {.model = m, .sample = s, .x = room, .v = room + m->nx, .run = run, .wrong = m->nv, .pole = NAN};
    if (!go(&w)) fault->number = isnan(w.pole) ? w.wrong : m->nv;
    fault->pole = w.pole;
    m->exact_between &= !w.unresolved;
    give(&m->arena->allocator, room);
    return MOTUS_OK;
}
