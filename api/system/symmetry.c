/* Symmetries of the derivatives: whether the velocity term is gyroscopic, and whether the force is a gradient.
 *
 * They are proved from the formulas where that succeeds (lang/model/field.h), else sampled: at states of widely
 * different sizes, and on any sides of the switches. Invariant: a sample that fails disproves a symmetry, and an answer
 * that only samples support says so (sampled_gyroscopic, sampled_gradient).
 */
#include "api/system/system.h"

#include "api/system/vector.h"
#include "lang/model/field.h"
#include "machine/held.h"

#include <math.h>
#include <string.h>

enum { MASSES_MAX = 96 }; /* most numbers for which masses are found, from as many derivatives */

static double power_of_ten(double e) { return exp(2.302585092994046 * e); }

/* Marks the numbers that have an equation by 1; they alone are varied. */
static void mark(const motus_system *s, double *mask)
{
    for (uint32_t i = 0; i < s->state_count; i++)
        for (size_t c = 0; c < s->states[i].cells.count; c++)
            for (int k = 0; k < (s->states[i].components ? s->states[i].components : 1); k++)
                mask[system_place(&s->states[i], c, k)] = 1;
}

/* Returns the problem to sample; of a model with switches, the one with held sides. NULL: there is none. */
static const problem *sampled_problem(motus_system *s, held **switches)
{
    *switches = NULL;
    if (s->problem.traits.smooth) return &s->problem;
    if (system_switches(s, NULL) != MOTUS_OK || !s->switches) return NULL;
    *switches = s->switches;
    return held_problem(s->switches);
}

static void choose_sides(const held *h, double *sides, uint64_t *random)
{
    for (size_t k = 0; k < held_count(h); k++) {
        const operation op = held_operation(h, k);
        const double r = vector_random(random);
        sides[k] = op == OP_FLOOR || op == OP_MOD                   ? floor(4 * r)
                   : op == OP_FIND                                  ? 1
                   : op == OP_ABS || op == OP_SIGN || op == OP_CBRT ? (r < 0 ? -1 : 1)
                                                                    : r < 0;
    }
}

typedef struct sample {
    double t, *x, *v, *u, *w, *ju, *jw, *mask, *sides;
} sample;

/* Draws a state and two directions, with components of widely different sizes, so that a small derivative is not hidden
 * behind the rounding of a large one. */
static void draw(const motus_system *s, int round, const sample *at, uint64_t *random)
{
    const problem *p = &s->problem;
    const double size = round == 0 ? 0 : power_of_ten(3 * vector_random(random));
    memcpy(at->x, s->x0, p->nx * sizeof *at->x);
    memcpy(at->v, s->v0, p->nv * sizeof *at->v);
    for (size_t k = 0; k < p->nv; k++) {
        const double of_x = size * vector_random(random), of_v = size * vector_random(random);
        if (k < p->nx) at->x[k] += at->mask[k] * of_x * (fabs(at->x[k]) + 1);
        at->v[k] += at->mask[k] * of_v * (fabs(at->v[k]) + 1);
        at->u[k] = at->mask[k] * vector_random(random) * power_of_ten(12 * vector_random(random));
        at->w[k] = at->mask[k] * vector_random(random) * power_of_ten(12 * vector_random(random));
        at->ju[k] = at->jw[k] = 0;
    }
}

/* Returns how many states to sample, so that the time is bounded. */
static int rounds(const motus_system *s)
{
    const double most = 3e6 / (s->model->terms + (double)s->problem.nv);
    return most < SYMMETRY_LEAST ? SYMMETRY_LEAST : most > SYMMETRY_STATES ? SYMMETRY_STATES : (int)most;
}

/* Tests w·(M J u) = sign · u·(M J w), to rounding, at random states, times, directions and sides: whether M J is
 * symmetric (sign 1) or antisymmetric (-1). M is the diagonal matrix of `masses`, or 1 if that is NULL. False: there is
 * no memory. */
static bool sample_symmetric(motus_system *s, bool in_v, double sign, const double *masses, bool *answer)
{
    held *h;
    *answer = false;
    const problem *p = sampled_problem(s, &h);
    if (!p) return !s->arena.failed;
    if (!p->jvp) return true;
    const size_t n = p->nv + 1, sides = h ? held_count(h) : 0;
    double *room = take(&s->allocator, 7 * n + sides, sizeof *room);
    if (!room) return false;
    const sample at = {
        0, room, room + n, room + 2 * n, room + 3 * n, room + 4 * n, room + 5 * n, room + 6 * n, room + 7 * n};
    uint64_t random = 12345;
    int judged = 0;
    bool ok = true, memory = true;
    mark(s, at.mask);
    for (int round = 0, all = rounds(s); round < all && ok && memory; round++) {
        const double t = s->start + (round == 0 ? 0 : power_of_ten(4 * vector_random(&random)));
        if (h) choose_sides(h, at.sides, &random);
        memory = (!h || held_bind(h, at.sides, round == 0)) && (!p->prepare || p->prepare(p->ctx, in_v));
        if (!memory) break;
        draw(s, round, &at, &random);
        ok = !p->jvp(p->ctx, t, at.x, at.v, in_v ? NULL : at.u, in_v ? at.u : NULL, at.ju) &&
             !p->jvp(p->ctx, t, at.x, at.v, in_v ? NULL : at.w, in_v ? at.w : NULL, at.jw);
        double a = 0, b = 0, size = 0;
        for (size_t k = 0; k < p->nv; k++) {
            const double mass = masses ? masses[k] : 1;
            a += mass * at.w[k] * at.ju[k];
            b += mass * at.u[k] * at.jw[k];
            size += fabs(mass * at.w[k] * at.ju[k]) + fabs(mass * at.u[k] * at.jw[k]);
        }
        if (!isfinite(size)) continue; /* the force is not defined there */
        judged++;
        ok = ok && fabs(a - sign * b) <= 1e-11 * size;
    }
    give(&s->allocator, room);
    *answer = ok && judged >= SYMMETRY_LEAST / 2;
    return memory;
}

bool symmetry_gyroscopic(motus_system *s)
{
    traits *t = &s->problem.traits;
    if (s->judged_gyroscopic || !t->velocity || !t->linear_v || t->first_order || !s->model) return true;
    modes m = modes_enter();
    field_proof proof;
    bool known = field_prove(s->model, true, NULL, &proof);
    t->gyroscopic = proof.holds;
    if (known && !proof.holds && !proof.refuted) known = sample_symmetric(s, true, -1, NULL, &t->gyroscopic);
    s->sampled_gyroscopic = t->gyroscopic && !proof.holds;
    s->judged_gyroscopic = known;
    modes_leave(m);
    return known;
}

/* Finds the masses for which the derivative at one state may be symmetric, m[i] J[i][j] = m[j] J[j][i], by going from
 * number to number; 1 where no other number is coupled. column: J, column after column. False: some mass would be
 * negative. */
static bool find_masses(size_t n, const double *column, double *masses, size_t *reached)
{
    for (size_t k = 0; k < n; k++) masses[k] = 0;
    for (size_t root = 0; root < n; root++) {
        size_t count = 0, next = 0;
        if (masses[root] > 0) continue;
        masses[root] = 1;
        reached[count++] = root;
        while (next < count) {
            const size_t i = reached[next++];
            for (size_t j = 0; j < n; j++) {
                const double there = column[j * n + i], back = column[i * n + j];
                if (masses[j] > 0 || there == 0 || back == 0) continue;
                masses[j] = masses[i] * there / back;
                if (!(masses[j] > 0) || !isfinite(masses[j])) return false;
                reached[count++] = j;
            }
        }
    }
    return true;
}

/* Finds masses that may make the derivative symmetric, from one state. masses: nv numbers. *found false: there are
 * none. */
static bool masses_of(motus_system *s, double *masses, bool *found)
{
    problem *p = &s->problem;
    const size_t n = p->nv;
    double *x = take(&s->allocator, n * n + 5 * (n + 1), sizeof *x);
    size_t *reached = take(&s->allocator, n + 1, sizeof *reached);
    const bool ok = x && reached && (!p->prepare || p->prepare(p->ctx, false));
    *found = false;
    if (ok && p->jvp) {
        double *v = x + n + 1, *mask = v + n + 1, *u = mask + n + 1, *column = u + n + 1;
        uint64_t random = 54321;
        memcpy(x, s->x0, p->nx * sizeof *x);
        memcpy(v, s->v0, n * sizeof *v);
        mark(s, mask);
        for (size_t k = 0; k < p->nx; k++) x[k] += 0.1 * mask[k] * (fabs(x[k]) + 1) * vector_random(&random);
        *found = true;
        for (size_t k = 0; k < n && *found; k++) {
            u[k] = mask[k];
            *found = !p->jvp(p->ctx, s->start, x, v, u, NULL, column + k * n);
            u[k] = 0;
        }
        for (size_t i = 0; i < n; i++) /* numbers without an equation are coupled to none */
            for (size_t j = 0; j < n; j++)
                if (!mask[i] || !mask[j]) column[j * n + i] = 0;
        *found = *found && find_masses(n, column, masses, reached);
    }
    give(&s->allocator, reached);
    give(&s->allocator, x);
    return ok;
}

/* Proves or samples whether the force is a gradient with these masses (NULL: 1), and notes it in the traits. */
static bool judge_with(motus_system *s, const double *masses)
{
    traits *t = &s->problem.traits;
    field_proof proof;
    bool known = field_prove(s->model, false, masses, &proof);
    t->gradient = proof.holds;
    s->energy = proof.single && !t->time;
    if (known && !proof.holds && !proof.refuted && !proof.jumps && !field_jumps(s->model))
        known = sample_symmetric(s, false, 1, masses, &t->gradient);
    s->sampled_gradient = t->gradient && !proof.holds;
    return known;
}

/* Judges without masses, then with those that one state suggests. */
static bool judge_gradient(motus_system *s)
{
    traits *t = &s->problem.traits;
    bool known = judge_with(s, NULL), found = false;
    if (known && !t->gradient && s->problem.nv <= MASSES_MAX) {
        double *masses = take(&s->allocator, s->problem.nv, sizeof *masses);
        known = masses && masses_of(s, masses, &found);
        if (known && found) known = judge_with(s, masses);
        give(&s->allocator, masses);
    }
    t->gradient = t->gradient || t->constant;
    return known;
}

bool symmetry_gradient(motus_system *s)
{
    traits *t = &s->problem.traits;
    if (s->judged_gradient || t->velocity || t->first_order || !s->model) return true;
    if (s->problem.nv == 1) { /* -V', V an integral of the force */
        s->energy = !t->time;
        return t->gradient = s->judged_gradient = true;
    }
    modes m = modes_enter();
    s->judged_gradient = judge_gradient(s);
    modes_leave(m);
    return s->judged_gradient;
}
