/* THE ORDER OF COLLOCATION, by Butcher's simplifying assumptions [Butcher64; HNW93, II.7]:
 *
 *     B(p): Σ bv[i] c[i]^(k-1) = 1/k, k ≤ p;    C(η): Σ av[i][j] c[j]^(k-1) = c[i]^k/k, k ≤ η;
 *     D(ζ): Σ bv[i] c[i]^(k-1) av[i][j] = bv[j] (1 - c[j]^k)/k, k ≤ ζ.
 *
 * They give the order p where p ≤ η + ζ + 1 and p ≤ 2η + 2, for any number of stages; B(p + 1) is a condition of order
 * p + 1. Positions have the squared tableau, a = av² and b = bv av; or the polynomial through the accelerations is
 * integrated twice, Σ a[i][j] c[j]^(k-1) = c[i]^(k+1)/(k(k + 1)), k ≤ s, and the step has the order of its quadrature
 * [HLW06, II.1.5].
 *
 * Invariant: a condition may be violated by the roundings of its terms and of the numbers in it alone.
 */
#include "test/laws_proof.h"

typedef struct assumptions {
    int count, broken;
    quad worst; /* the largest violation, in units of its bound */
} assumptions;

/* terms: the sum of their absolute values */
static void add(assumptions *a, const scheme *m, int order, quad left, quad right, quad terms)
{
    const quad bound = trees_roundings(m, order) * QUAD_EPSILON / 2 * (terms + quad_abs(right)),
               miss = quad_abs(left - right), share = miss == 0 ? 0 : miss / bound;
    a->count++;
    a->broken += share > 1;
    if (share > a->worst) a->worst = share;
}

static quad power(quad c, int k)
{
    quad p = 1;
    for (int i = 0; i < k; i++) p *= c;
    return p;
}

/* B(p) at k = p */
static void quadrature(assumptions *a, const scheme *m, int k)
{
    quad sum = 0;
    for (int i = 0; i < m->stages; i++) sum += m->bv[i] * power(m->c[i], k - 1);
    add(a, m, k, sum, Q(1.0) / k, sum);
}

static void stages(assumptions *a, const scheme *m, int k)
{
    for (int i = 0; i < m->stages; i++) {
        quad sum = 0, terms = 0;
        for (int j = 0; j < m->stages; j++) {
            const quad term = m->av[i][j] * power(m->c[j], k - 1);
            sum += term, terms += quad_abs(term);
        }
        add(a, m, k, sum, power(m->c[i], k) / k, terms);
    }
}

static void adjoint(assumptions *a, const scheme *m, int k)
{
    for (int j = 0; j < m->stages; j++) {
        quad sum = 0, terms = 0;
        for (int i = 0; i < m->stages; i++) {
            const quad term = m->bv[i] * power(m->c[i], k - 1) * m->av[i][j];
            sum += term, terms += quad_abs(term);
        }
        add(a, m, k + 1, sum, m->bv[j] * (1 - power(m->c[j], k)) / k, terms + m->bv[j]);
    }
}

/* Row `i` of the squared tableau, or, where i is the number of stages, its weights. */
static void squares(assumptions *a, const scheme *m, int i)
{
    const bool end = i == m->stages;
    for (int j = 0; j < m->stages; j++) {
        quad sum = 0, terms = 0;
        for (int l = 0; l < m->stages; l++) {
            const quad term = (end ? m->bv[l] : m->av[i][l]) * m->av[l][j];
            sum += term, terms += quad_abs(term);
        }
        add(a, m, 2, sum, end ? m->b[j] : m->a[i][j], terms);
    }
}

/* Where the stage, or the end, has the abscissa c, and its row is `row`. */
static void twice_integrated(assumptions *a, const scheme *m, const quad *row, quad c, int k)
{
    quad sum = 0, terms = 0;
    for (int j = 0; j < m->stages; j++) {
        const quad term = row[j] * power(m->c[j], k - 1);
        sum += term, terms += quad_abs(term);
    }
    add(a, m, k + 1, sum, power(c, k + 1) / (k * (k + 1)), terms);
}

static assumptions measure(const scheme *m, bool twice, int order)
{
    const int s = m->stages;
    assumptions a = {0};
    add(&a, m, 1, m->end, 1, 1);
    for (int k = 1; k <= order; k++) quadrature(&a, m, k);
    for (int k = 1; k <= s; k++) stages(&a, m, k);
    for (int k = 1; k <= order - s; k++) adjoint(&a, m, k);
    for (int i = 0; i <= s && !twice; i++) squares(&a, m, i);
    for (int k = 1; k <= s && twice; k++)
        for (int i = 0; i <= s; i++) twice_integrated(&a, m, i < s ? m->a[i] : m->b, i < s ? m->c[i] : m->end, k);
    return a;
}

/* Whether a number of the scheme, moved by so much, breaks an assumption. */
static bool breaks(const scheme *moved, quad *number, quad by, bool twice, int order)
{
    const quad keep = *number;
    *number += by;
    const bool broken = measure(moved, twice, order).broken > 0;
    *number = keep;
    return broken;
}

void proof_of_collocation(const char *name, const scheme *m, bool twice, int order)
{
    const quad by = Q(1e-29);
    const int s = m->stages, all = s * (2 * s + 3);
    const assumptions kept = measure(m, twice, order);
    assumptions next = {0};
    quadrature(&next, m, order + 1);
    judge(!kept.broken, name, "order by assumptions", "%d conditions, the worst %.3f of its bound", kept.count,
          (double)kept.worst);
    judge(next.broken && order <= 2 * s, name, "no higher order", "misses B(%d) by %.1e of its bound", order + 1,
          (double)next.worst);
    scheme moved = *m;
    int caught = 0;
    for (int i = 0; i < s; i++) {
        caught += breaks(&moved, &moved.c[i], by, twice, order);
        caught += breaks(&moved, &moved.b[i], by, twice, order);
        caught += breaks(&moved, &moved.bv[i], by, twice, order);
        for (int j = 0; j < s; j++) {
            caught += breaks(&moved, &moved.a[i][j], by, twice, order);
            caught += breaks(&moved, &moved.av[i][j], by, twice, order);
        }
    }
    judge(caught == all, name, "no coefficient is free", "%d of %d, moved by %.1e, break an assumption", caught, all,
          (double)by);
}
