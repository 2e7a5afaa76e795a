/* The analysis of a model in words. */
#include "api/calls/explain.h"
#include "api/system/system.h"
#include "lang/graph/graph_walk.h"
#include "lang/model/table.h"

#include <string.h>

motus_status motus_analysis_of(const motus_system *given, motus_analysis *out)
{
    motus_system *s = (motus_system *)given;
    if (!s || !out || motus_struct_check(MOTUS_DEF_ANALYSIS, out, NULL) != MOTUS_OK) return MOTUS_ARGUMENT;
    if (!symmetry_gyroscopic(s) || !symmetry_gradient(s)) return MOTUS_MEMORY;
    const traits *t = &s->problem.traits;
    const motus_analysis ours = {.velocity_dependent = t->velocity,
                                 .linear_in_velocity = t->linear_v,
                                 .time_dependent = t->time,
                                 .affine = t->affine,
                                 .constant = t->constant,
                                 .gyroscopic = t->gyroscopic,
                                 .gradient = t->gradient,
                                 .smooth = t->smooth,
                                 .exact_recognised = s->model && s->model->exact_recognised,
                                 .sampled_gyroscopic = s->sampled_gyroscopic && t->gyroscopic,
                                 .sampled_gradient = s->sampled_gradient && t->gradient,
                                 .energy = s->energy && t->gradient};
    motus_struct_write(MOTUS_DEF_ANALYSIS, &ours, out);
    return MOTUS_OK;
}

/* ---- words ---- */

enum { COEFFICIENTS_SHOWN = 12, LOADS_MAX = 64 };

typedef struct velocity_loads {
    const model *model;
    node item[LOADS_MAX];
    int count;
} velocity_loads;

static void note_load(void *ctx, const reference *r, const range *sums, int first_level, int inside)
{
    velocity_loads *l = ctx;
    (void)sums;
    (void)first_level;
    if (inside || l->count == LOADS_MAX) return;
    l->item[l->count++] = graph_load(l->model->graph, r);
}

static node seed_one(graph *g, node leaf, void *which) { return leaf == *(node *)which ? graph_const(g, 1) : 0; }

/* Writes the coefficient of each velocity in each equation. */
static void say_coefficients(sentences *w, const model *m)
{
    int shown = 0;
    char left[256], velocity[160], coefficient[400];
    for (size_t i = 0; i < m->accel_count; i++) {
        velocity_loads loads = {.model = m};
        graph_loads(m->graph, m->accel[i].value, SPACE_V, note_load, &loads);
        for (int k = 0; k < loads.count; k++) {
            node d = graph_derivative(m->graph, m->accel[i].value, seed_one, &loads.item[k]);
            if (d == 0) continue;
            if (shown++ == COEFFICIENTS_SHOWN) {
                sentences_say(w, "  …\n");
                return;
            }
            model_equation(m, i, left, sizeof left);
            left[strcspn(left, "=")] = 0;
            model_print(m, loads.item[k], velocity, sizeof velocity);
            model_print(m, d, coefficient, sizeof coefficient);
            sentences_say(w, "  in %s the coefficient of %s is %s\n",
                          left[0] ? (left[strlen(left) - 1] = 0, left) : left, velocity, coefficient);
        }
    }
}

static void say_variables(sentences *w, const motus_system *s)
{
    for (uint32_t i = 0; i < s->state_count; i++) {
        const model_state *st = &s->states[i];
        sentences_say(w, "%s is %s", st->name, st->dims ? "a family" : st->components ? "a vector" : "a number");
        if (st->dims) sentences_say(w, " of %zu %s", st->cells.count, st->components ? "vectors" : "numbers");
        if (st->components) sentences_say(w, " of length %d", st->components);
        sentences_say(w, st->order == 2 ? "; its acceleration is given\n"
                                        : "; its rate of change is given (a first-order variable)\n");
    }
    bool coordinate = false;
    for (uint32_t i = 0; i < s->state_count; i++) coordinate |= !strcmp(s->states[i].name, "t");
    if (strcmp(s->model->time, "t"))
        sentences_say(w, "the time is named %s%s\n", s->model->time,
                      coordinate ? ", since t has an equation of motion" : "");
}

#define SAMPLED ", as far as sampled at random states of many sizes, since the formulas were not proof"

static void say_gradient(sentences *w, const motus_system *s)
{
    const traits *t = &s->problem.traits;
    sentences_say(w, "the force is a gradient%s: its derivative is symmetric, with constant masses%s%s\n",
                  t->time ? " at every time" : "", s->sampled_gradient ? SAMPLED : "",
                  t->time     ? ""
                  : s->energy ? ", so an energy exists"
                  : s->sampled_gradient
                      ? ""
                      : ", so an energy exists, though it may change on a way round a singularity of the force");
}

/* Tells which kinks the accelerations have: those of tables by interp (*linear) and by spline (*curved), and others. */
static bool find_kinks(const model *m, bool *linear, bool *curved, bool *others)
{
    const unsigned moving = DEP_TIME | (DEP_STATE & ~DEP_MODE);
    bool known = true;
    for (size_t k = 0; k < m->accel_count && known; k++) {
        graph_walk w;
        known = graph_order(m->graph, &m->accel[k].value, 1, moving, true, &w);
        for (uint32_t i = 0; i < w.count; i++) {
            const graph_node *n = graph_at(m->graph, w.nodes[i]);
            const node chosen = n->op == OP_SELECT ? n->a : w.nodes[i];
            if (!operation_is((operation)n->op, BENDS) || !(graph_deps(m->graph, chosen) & moving)) continue;
            *others |= n->op != OP_FIND && n->op != OP_ENTRY;
            for (uint32_t j = 0; n->op == OP_ENTRY && j < m->table_count; j++) {
                if (m->tables[j]->array != graph_at(m->graph, n->b)->a) continue;
                *linear |= m->tables[j]->kind == TABLE_LINEAR || m->tables[j]->hold;
                *curved |= m->tables[j]->kind == TABLE_SPLINE;
            }
        }
        give(&m->arena->allocator, w.nodes);
    }
    return known;
}

static void say_kinks(sentences *w, const model *m)
{
    bool linear = false, curved = false, others = false;
    if (!find_kinks(m, &linear, &curved, &others)) return;
    if (linear || curved)
        sentences_say(
            w,
            "the force contains tables: adaptive methods end their steps at the points; of methods with steps "
            "of one size, which lead across, order %d is left\n",
            linear ? 2 : 4);
    if (others || !(linear || curved))
        sentences_say(w,
                      "the equations are not smooth: they contain abs, min, max, floor, mod, sign, if or a comparison; "
                      "high orders lose their order where these switch\n");
}

static void say_forces(sentences *w, const motus_system *s)
{
    const traits *t = &s->problem.traits;
    if (t->constant)
        sentences_say(w, "the acceleration is constant\n");
    else
        sentences_say(w, "the acceleration depends on %s%s%s\n",
                      t->first_order && (!t->velocity || t->quadrature) ? "the positions"
                      : t->velocity                                     ? "the state and its velocity"
                                                                        : "the positions",
                      t->time ? " and on time" : "", t->time ? "" : "; not on time");
    if (t->quadrature)
        sentences_say(
            w, "the velocity enters first-order variables alone, and nothing depends on these: they are integrals "
               "along the "
               "motion, which splitting methods follow at the mean velocity of each kick or at two of Gauss's nodes\n");
    if (t->velocity && t->linear_v) {
        sentences_say(w, "the velocity enters linearly: the implicit velocity term is solved in closed form%s\n",
                      t->constant_jv ? ", with constant coefficients" : "");
        say_coefficients(w, s->model);
        if (t->gyroscopic)
            sentences_say(w, "the velocity term does no work (v × B)%s: the Boris rotation applies\n",
                          s->sampled_gyroscopic ? SAMPLED : "");
    } else if (t->velocity) {
        sentences_say(w,
                      "the velocity enters nonlinearly: implicit velocity terms are solved by Newton's method with the "
                      "derived Jacobian\n");
    }
    if (t->affine && !t->constant) sentences_say(w, "the equations are linear\n");
    if (t->gradient && !t->constant) say_gradient(w, s);
    if (!t->smooth) say_kinks(w, s->model);
    if (t->has_exact)
        sentences_say(
            w, s->model->exact_recognised ? "the exact motion is known: constant acceleration\n"
               : s->model->exact_between
                   ? "the exact motion is given, and was checked against the equation at times of the run\n"
                   : "the exact motion is given, and was checked against the equation at times of the run; between "
                     "them the force may change unseen\n");
}

const char *motus_explain(motus_system *s)
{
    if (!s) return "";
    if (!s->model) return "the acceleration is a callback: its form is not known\n";
    if (!symmetry_gyroscopic(s) || !symmetry_gradient(s)) return "";
    const traits *t = &s->problem.traits;
    const char **kept = &s->explanation[t->gyroscopic + s->sampled_gyroscopic][t->gradient + (s->sampled_gradient ? 1
                                                                                              : s->energy         ? 2
                                                                                                                  : 0)];
    if (*kept) return *kept;
    modes m = modes_enter();
    sentences w = {.allocator = &s->allocator};
    say_variables(&w, s);
    say_forces(&w, s);
    modes_leave(m);
    const char *text = w.text && !w.failed ? arena_text(&s->arena, w.text, w.length) : NULL;
    give(&s->allocator, w.text);
    if (!text || s->arena.failed) return ""; /* a part of the text would mislead */
    return *kept = text;
}

const char *motus_equation_text(motus_system *s, size_t k)
{
    enum { ROOM = 4096 };
    if (!s || !s->model) return NULL;
    if (!s->equation) s->equation = arena_room(&s->arena, ROOM);
    if (!s->equation) return NULL;
    modes m = modes_enter();
    bool any = model_equation(s->model, k, s->equation, ROOM);
    modes_leave(m);
    return any && !s->arena.failed ? s->equation : NULL;
}
