/* Symmetries of the derivatives, which only sampled states can show: whether the velocity term is gyroscopic, and
 * whether the force is a gradient.
 *
 * Invariant: a sample that fails disproves the symmetry; all of them together leave no doubt but that of rounding. /
 */
#include "api/symmetry.h"

#include <math.h>
#include <string.h>

enum { MASSES_MAX = 96 }; /* numbers up to which masses are found, from as many derivatives */

static double random_number(uint64_t *state) /* splitmix64, to (-1, 1) */
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

/* 1 for the numbers that have an equation, which alone are varied. */
static void mark(const motus_system *s, double *mask)
{
    for (uint32_t i = 0; i < s->state_count; i++)
        for (size_t c = 0; c < s->states[i].cells.count; c++)
            for (int k = 0; k < (s->states[i].components ? s->states[i].components : 1); k++)
                mask[system_place(&s->states[i], c, k)] = 1;
}

/* Tests w·(M J u) = sign · u·(M J w) at random states and directions, to rounding: whether M J is symmetric (sign 1) or
 * antisymmetric (-1), M the diagonal matrix of `masses`, or 1 where that is NULL. Another J fails at almost every
 * state. False: there was no memory for the test. */
static bool symmetric(motus_system *s, bool in_v, double sign, const double *masses, bool *answer)
{
    problem *p = &s->problem;
    size_t n = p->nv, work = 7 * (n + 1);
    *answer = false;
    if (!p->jvp) return true;
    if (p->prepare && !p->prepare(p->ctx, in_v)) return false;
    double *x = take(&s->allocator, work, sizeof *x);
    if (!x) return false;
    double *v = x + n + 1, *u = v + n + 1, *w = u + n + 1, *ju = w + n + 1, *jw = ju + n + 1, *mask = jw + n + 1;
    mark(s, mask);
    bool ok = true;
    uint64_t random = 12345;
    int judged = 0;
    for (int round = 0; round < SYMMETRY_STATES && ok; round++) {
        memcpy(x, s->x0, p->nx * sizeof *x);
        memcpy(v, s->v0, n * sizeof *v);
        for (size_t k = 0; k < n; k++) {
            double spread = round == 0 ? 0 : 0.3;
            if (k < p->nx) x[k] += mask[k] * spread * (fabs(x[k]) + 1) * random_number(&random);
            v[k] += mask[k] * spread * (fabs(v[k]) + 1) * random_number(&random);
            u[k] = mask[k] * random_number(&random);
            w[k] = mask[k] * random_number(&random);
        }
        memset(ju, 0, n * sizeof *ju);
        memset(jw, 0, n * sizeof *jw);
        if (p->jvp(p->ctx, s->start, x, v, in_v ? NULL : u, in_v ? u : NULL, ju) ||
            p->jvp(p->ctx, s->start, x, v, in_v ? NULL : w, in_v ? w : NULL, jw)) {
            ok = false;
            break;
        }
        double a = 0, b = 0, size = 0;
        for (size_t k = 0; k < n; k++) {
            const double mass = masses ? masses[k] : 1;
            a += mass * w[k] * ju[k];
            b += mass * u[k] * jw[k];
            size += fabs(mass * w[k] * ju[k]) + fabs(mass * u[k] * jw[k]);
        }
        if (!isfinite(size)) continue; /* the force is not defined there */
        judged++;
        ok = fabs(a - sign * b) <= 1e-11 * size;
    }
    give(&s->allocator, x);
    *answer = ok && judged > 0;
    return true;
}

bool symmetry_gyroscopic(motus_system *s)
{
    traits *t = &s->problem.traits;
    if (s->sampled_gyroscopic || !t->velocity || !t->linear_v || t->first_order || !s->model) return true;
    modes m = modes_enter();
    s->sampled_gyroscopic = symmetric(s, true, -1, NULL, &t->gyroscopic);
    modes_leave(m);
    return s->sampled_gyroscopic;
}

/* The masses for which the derivative at one state may be symmetric, m[i] J[i][j] = m[j] J[j][i], by going from
 * number to number; 1 where no other number is coupled to it. column: J, column after column. False: some mass would
 * be negative. */
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

/* As symmetric, with masses that make it so. The state is between the samples of `symmetric`. */
static bool with_masses(motus_system *s, bool *answer)
{
    problem *p = &s->problem;
    const size_t n = p->nv;
    double *x = take(&s->allocator, n * n + 6 * (n + 1), sizeof *x);
    size_t *reached = take(&s->allocator, n + 1, sizeof *reached);
    bool ok = x && reached;
    if (ok) {
        double *v = x + n + 1, *mask = v + n + 1, *u = mask + n + 1, *masses = u + n + 1, *column = masses + n + 1;
        uint64_t random = 54321;
        bool found = true;
        memcpy(x, s->x0, p->nx * sizeof *x);
        memcpy(v, s->v0, n * sizeof *v);
        mark(s, mask);
        for (size_t k = 0; k < p->nx; k++) x[k] += 0.1 * mask[k] * (fabs(x[k]) + 1) * random_number(&random);
        for (size_t k = 0; k < n && found; k++) {
            u[k] = mask[k];
            found = !p->jvp(p->ctx, s->start, x, v, u, NULL, column + k * n);
            u[k] = 0;
        }
        for (size_t i = 0; i < n; i++) /* numbers without an equation are coupled to none */
            for (size_t j = 0; j < n; j++)
                if (!mask[i] || !mask[j]) column[j * n + i] = 0;
        if (found && find_masses(n, column, masses, reached)) ok = symmetric(s, false, 1, masses, answer);
    }
    give(&s->allocator, reached);
    give(&s->allocator, x);
    return ok;
}

bool symmetry_gradient(motus_system *s)
{
    traits *t = &s->problem.traits;
    if (s->sampled_gradient || t->velocity || t->first_order || !s->model) return true;
    if (s->problem.nv == 1) return t->gradient = s->sampled_gradient = true; /* -V', V an integral of the force */
    modes m = modes_enter();
    s->sampled_gradient = symmetric(s, false, 1, NULL, &t->gradient);
    if (s->sampled_gradient && !t->gradient && s->problem.nv <= MASSES_MAX)
        s->sampled_gradient = with_masses(s, &t->gradient);
    t->gradient = t->gradient || t->constant;
    modes_leave(m);
    return s->sampled_gradient;
}
