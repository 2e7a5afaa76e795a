/* PROOFS OF ORDER: every row satisfies every order condition up to its declared order, and violates one of the next.
 *
 * Invariant: no tolerance is written here. The coefficients that the author meant satisfy a condition exactly; those
 * of the row are off by at most half a unit in the last place that the row prints. So a condition may be violated by
 * the sum of its changes when one coefficient after the other is moved by as much, plus the roundings of 113 bits,
 * relative to the same sums over absolute values. A larger violation disproves the row. One of the next order beyond
 * that bound proves that the order is no higher.
 */
#include "test/laws_proof.h"

#include <stdio.h>

/* A method under test: the tableau of a row with coefficients, or one whose numbers are exact up to rounding. */
typedef struct subject {
    const char *name;
    trees_kind kind;
    const scheme *scheme;
    method row;
    bool spelled;
    quad slack; /* of an embedded method: the digits of two weights of which its own are differences */
} subject;

/* bound[k]: by how much condition k may be violated. Returns the number of conditions. */
static int measure(const subject *s, int order, condition *now, quad *bound)
{
    static condition moved[TREES_CONDITIONS_MAX];
    scheme m = *s->scheme;
    const int count = trees_conditions(s->kind, &m, order, now);
    coefficients c = {0}, size = {0};
    if (s->spelled) size = c = coefficients_of(s->row);
    for (int i = 0; i < c.count; i++) size.value[i] = quad_abs(c.value[i]);
    if (s->spelled) {
        coefficients_scheme(s->row, size.value, &m);
    } else {
        for (int i = 0; i < m.stages; i++) {
            m.b[i] = quad_abs(m.b[i]);
            m.bv[i] = quad_abs(m.bv[i]);
            for (int j = 0; j < m.stages; j++) m.a[i][j] = quad_abs(m.a[i][j]), m.av[i][j] = quad_abs(m.av[i][j]);
        }
    }
    trees_conditions(s->kind, &m, order, moved);
    for (int k = 0; k < count; k++)
        bound[k] = trees_roundings(&m, now[k].order) * QUAD_EPSILON / 2 * (moved[k].left + quad_abs(moved[k].right)) +
                   s->slack;
    for (int i = 0; i < c.count; i++) {
        if (c.unit[i] == 0) continue;
        const quad keep = c.value[i];
        c.value[i] += c.unit[i];
        coefficients_scheme(s->row, c.value, &m);
        c.value[i] = keep;
        trees_conditions(s->kind, &m, order, moved);
        for (int k = 0; k < count; k++)
            bound[k] += quad_abs((moved[k].left - moved[k].right) - (now[k].left - now[k].right));
    }
    return count;
}

static quad miss_of(const condition *c) { return quad_abs(c->left - c->right); }

static void prove(const subject *s, int order)
{
    const bool words = s->kind == TREES_WORDS;
    static condition now[TREES_CONDITIONS_MAX];
    static quad bound[TREES_CONDITIONS_MAX];
    if (trees_count(s->kind, order + 1) == 0) {
        judge(false, s->name, "order conditions", "test/laws_trees.c has no trees of order %d", order + 1);
        return;
    }
    const int count = measure(s, order + 1, now, bound);
    int kept = 0, worst = -1, best = -1;
    quad most = -1, next = -1;
    for (int k = 0; k < count; k++) {
        const quad miss = miss_of(&now[k]), share = miss == 0 ? 0 : miss / bound[k];
        if (now[k].order <= order) {
            kept++;
            if (share > most) most = share, worst = k;
        } else if (share > next) {
            next = share, best = k;
        }
    }
    judge(most <= 1, s->name, words ? "order of the composition" : "order conditions",
          "%d to order %d; worst, of order %d: %.1e, %.3f of its bound %.1e", kept, order, now[worst].order,
          (double)miss_of(&now[worst]), (double)most, (double)bound[worst]);
    judge(next > 1, s->name, words ? "no higher composition" : "no higher order",
          "misses a condition of order %d by %.1e, digits allow %.1e%s", now[best].order, (double)miss_of(&now[best]),
          (double)bound[best], next > 1 ? "" : ": the order is higher, or the row prints too few digits to tell");
}

void proof_of_digits(const char *name, trees_kind kind, const scheme *m, int order, quad slack)
{
    prove(&(subject){.name = name, .kind = kind, .scheme = m, .slack = slack}, order);
}

void proof_of_scheme(const char *name, trees_kind kind, const scheme *m, int order)
{
    proof_of_digits(name, kind, m, order, 0);
}

/* A Nyström method has Σ a[i][j] = c[i]²/2 at every stage, also where no condition of its order needs it. */
static bool uneven(const subject *s, const scheme *m)
{
    bool uneven = false;
    for (int i = 0; coefficients_nystrom(s->row) && i < m->stages; i++) {
        quad sum = -m->c[i] * m->c[i] / 2;
        for (int j = 0; j < m->stages; j++) sum += m->a[i][j];
        uneven = uneven || quad_abs(sum) > Q(1e-28);
    }
    return uneven;
}

/* Checks that the proof can fail: any coefficient, moved by ten units in the coarsest place that the row prints (or,
 * where it prints more than 26, by 1e-26), breaks a condition. */
static void sharp(const subject *s, int order)
{
    static condition now[TREES_CONDITIONS_MAX], moved[TREES_CONDITIONS_MAX];
    static quad bound[TREES_CONDITIONS_MAX];
    const quad least = Q(1e-26), unit = coefficients_unit(s->row), by = 20 * unit > least ? 20 * unit : least;
    const int count = measure(s, order, now, bound);
    coefficients c = coefficients_of(s->row);
    int caught = 0;
    for (int i = 0; i < c.count; i++) {
        scheme m;
        const quad keep = c.value[i];
        c.value[i] += by;
        coefficients_scheme(s->row, c.value, &m);
        c.value[i] = keep;
        trees_conditions(s->kind, &m, order, moved);
        int k = 0;
        while (k < count && miss_of(&moved[k]) <= bound[k]) k++;
        caught += k < count || uneven(s, &m);
    }
    judge(caught == c.count, s->name, "no coefficient is free", "%d of %d, moved by %.1e, break a condition", caught,
          c.count, (double)by);
}

/* The number of trees is that of the literature [HNW93, II.2, II.14], and no tree occurs twice. */
static void census(void)
{
    static const struct {
        const char *name;
        int count[TREES_ORDER_MAX];
    } known[TREES_KINDS] = {
        [TREES_ROOTED] = {"rooted", {1, 1, 2, 4, 9, 20, 48, 115, 286, 719}},
        [TREES_SPECIAL] = {"special Nyström", {1, 1, 2, 3, 6, 10, 20, 36, 72, 137, 275, 541, 1098}},
        [TREES_NYSTROM] = {"Nyström", {1, 2, 6, 18, 60, 204}},
        /* Fibonacci's numbers: words of odd letters by their sum */
        [TREES_WORDS] = {"words for", {1, 1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144, 233}},
    };
    for (trees_kind kind = 0; kind < TREES_KINDS; kind++)
        for (int n = 1; n <= TREES_ORDER_MAX && known[kind].count[n - 1]; n++) {
            const int count = trees_count(kind, n);
            const bool same = count == known[kind].count[n - 1];
            judge(same, "trees", "census", "%d %s trees of order %d", count, known[kind].name, n);
        }
}

/* The embedded method has the order that its estimate is said to have, and no higher one. */
static void estimate(method m, const scheme *s)
{
    char name[64];
    for (int which = 0; which < 2; which++) {
        scheme embedded = *s;
        const int order = coefficients_embedded(m, which, &embedded);
        if (order == 0) continue;
        snprintf(name, sizeof name, "%s, estimate %d", row_card(m)->name, which + 1);
        quad size = 0; /* every weight is a difference, and the abscissae are at most 1 */
        for (int i = 0; i < embedded.stages; i++)
            size += quad_abs(s->bv[i]) + quad_abs(s->bv[i] - embedded.bv[i]) + quad_abs(s->b[i]);
        const quad slack = 4 * size * (coefficients_unit(m) + QUAD_EPSILON);
        prove(&(subject){.name = name, .kind = coefficients_trees(m), .scheme = &embedded, .slack = slack}, order);
    }
}

static void row_with_coefficients(method m)
{
    const coefficients c = coefficients_of(m);
    scheme s;
    coefficients_scheme(m, c.value, &s);
    subject subject = {
        .name = row_card(m)->name, .kind = coefficients_trees(m), .scheme = &s, .row = m, .spelled = true};
    if (coefficients_nystrom(m)) judge(!uneven(&subject, &s), subject.name, "row sums", "%d stages", s.stages);
    prove(&subject, row_card(m)->order);
    sharp(&subject, row_card(m)->order);
    estimate(m, &s);
    if (!coefficients_compose(m)) return;
    subject.kind = TREES_WORDS;
    prove(&subject, row_card(m)->order);
    sharp(&subject, row_card(m)->order);
}

void laws_of_proof(void)
{
    census();
    for (method m = 0; m < row_count(); m++)
        if (coefficients_of(m).count) row_with_coefficients(m);
}
