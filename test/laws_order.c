/* LAWS OF ORDER: conditions on the coefficients where they are known in closed form, and the slope of the error for every row.
 *
 * Invariant: slopes are taken in 33 digits, over steps where the error is above what the row's own digits allow; the margin is the
 * change of the slope from one halving to the next, which is how far an asymptotic series still is from its limit.
 */
#include "core/rows.h"
#include "test/laws.h"

#include <math.h>
#include <stdio.h>

/* Rooted trees [HNW93, II.2]: b·phi(tree) = 1/gamma(tree) for every tree of up to `order` nodes. */
enum { TREES_MAX = 512, NODES_MAX = 9 };
typedef struct tree { int nodes, children, child[NODES_MAX]; quad gamma; } tree;
typedef struct forest { int count, first[NODES_MAX + 2]; tree tree[TREES_MAX]; } forest;

/* All multisets of earlier trees with `left` nodes in all, in descending index, hung under one root. */
static void grow(forest *f, tree root, int left, int last)
{
    if (left == 0) {
        root.gamma = root.nodes;
        for (int i = 0; i < root.children; i++) root.gamma *= f->tree[root.child[i]].gamma;
        f->tree[f->count++] = root;
        return;
    }
    for (int k = last; k >= 0; k--) {
        if (f->tree[k].nodes > left) continue;
        tree next = root;
        next.child[next.children++] = k;
        grow(f, next, left - f->tree[k].nodes, k);
    }
}

static void plant(forest *f, int order)
{
    f->count = 0;
    for (int n = 1; n <= order; n++) {
        f->first[n] = f->count;
        grow(f, (tree){.nodes = n}, n - 1, f->count - 1);
    }
    f->first[order + 1] = f->count;
}

/* The largest failure among the trees of exactly n nodes. */
static quad failure(const forest *f, const quad_tableau *m, int n)
{
    static quad phi[TREES_MAX][4];
    quad most = 0;
    for (int t = 0; t < f->first[n + 1]; t++) {
        quad sum = 0;
        for (int i = 0; i < m->stages; i++) {
            phi[t][i] = 1;
            for (int c = 0; c < f->tree[t].children; c++) {
                quad inner = 0;
                for (int j = 0; j < m->stages; j++) inner += m->a[i][j] * phi[f->tree[t].child[c]][j];
                phi[t][i] *= inner;
            }
            sum += m->b[i] * phi[t][i];
        }
        const quad off = quad_abs(sum - 1 / f->tree[t].gamma);
        if (f->tree[t].nodes == n && off > most) most = off;
    }
    return most;
}

static void conditions(const forest *f, method m)
{
    const motus_method *card = row_card(m);
    quad_tableau tableau;
    if (!quad_tableau_of(m, &tableau)) return;
    quad worst = 0;
    for (int n = 1; n <= card->order; n++) worst = fmax((double)worst, (double)failure(f, &tableau, n));
    for (int i = 0; i < tableau.stages; i++) {
        quad row_sum = -tableau.c[i];
        for (int j = 0; j < tableau.stages; j++) row_sum += tableau.a[i][j];
        worst = fmax((double)worst, (double)quad_abs(row_sum));
    }
    judge(worst < 100 * QUAD_EPSILON, card->name, "rooted trees", "%d trees of up to %d nodes, largest residual %.1e",
          f->first[card->order + 1], card->order, (double)worst);
    const quad next = failure(f, &tableau, card->order + 1);
    judge(next > Q(1e-7), card->name, "no higher order", "residual %.1e at %d nodes", (double)next, card->order + 1);
}

/* Sums of kicks and drifts are 1 to the digits that are known, and reversible rows read the same from both ends. */
static void consistency(method m)
{
    const motus_method *card = row_card(m);
    quad kick[SPLITTING_MAX], drift[SPLITTING_MAX], skew = 0;
    const int n = quad_splitting_of(m, kick, drift);
    if (!n) return;
    quad sequence[2 * SPLITTING_MAX];
    int length = 0;
    for (int i = 0; i < n; i++) {
        sequence[length++] = kick[i];
        sequence[length++] = drift[i];
    }
    int first = 0, last = length - 1;
    while (sequence[first] == 0) first++;
    while (sequence[last] == 0) last--;
    if ((last - first) % 2) skew = 1;                     /* the mirror of a kick would be a drift */
    for (; first < last; first++, last--) skew = fmax((double)skew, (double)quad_abs(sequence[first] - sequence[last]));
    const quad off = quad_looseness(m);
    judge(off < Q(1e-15), card->name, "consistency", "sums of kicks and drifts miss 1 by %.1e", (double)off);
    judge(card->reversible ? skew < Q(1e-30) : skew > Q(0.01), card->name, card->reversible ? "palindrome" : "no palindrome",
          "asymmetry %.1e", (double)skew);
}

static void slope(method m, const double *argument, const char *name, int order, const quad_problem *p)
{
    enum { POINTS_MAX = 14 };
    /* Where the coefficients' digits begin to show: tableaux have 33, compositions of order 8 have 20, all others at least 15. */
    quad_tableau tableau;
    const quad span = Q(1.25), floor = quad_tableau_of(m, &tableau) ? Q(1e-22) : order >= 8 ? Q(1e-17) : Q(1e-13);
    quad_state truth = {0}, start = {0};
    for (size_t k = 0; k < p->nx; k++) truth.x[k] = p->x[k];
    for (size_t k = 0; k < p->nv; k++) truth.v[k] = p->v[k];
    start = truth;
    quad_truth(p, 0, span, &truth);
    double errors[POINTS_MAX];
    int points = 0;
    int64_t n = 4;
    for (; points < POINTS_MAX; n *= 2) {
        quad_state end = start;
        if (quad_run(m, argument, p, 0, span / (quad)n, n, &end).bad) continue;
        const quad error = quad_distance(p, &end, &truth);
        if (error < floor && points >= 3) break;
        if (error < Q(0.1)) errors[points++] = quad_log2(error);
        if (n >= (order > 2 ? 1024 : 4096)) break;
    }
    char law[64];
    snprintf(law, sizeof law, "order on %s", p->name);
    if (points < 3) {
        judge(false, name, law, "only %d usable steps", points);
        return;
    }
    const double before = errors[points - 3] - errors[points - 2], last = errors[points - 2] - errors[points - 1];
    const double margin = fmin(0.1, 1.5 * fabs(last - before) + 0.02);
    judge(fabs(last - order) <= margin, name, law, "observed %.3f, declared %d, margin %.3f", last, order, margin);
}

void laws_of_order(void)
{
    static forest f;
    plant(&f, 9);
    judge(f.first[9] == 200 && f.count == 486, "laws", "tree census", "%d rooted trees of up to 8 nodes, %d of up to 9", f.first[9], f.count);
    for (method m = 0; m < row_count(); m++) {
        const motus_method *card = row_card(m);
        conditions(&f, m);
        consistency(m);
        static const int problems[] = {HENON_HEILES, DRIVEN, RIDER, DAMPED, TANGLED, MAGNET};
        for (size_t i = 0; i < sizeof problems / sizeof *problems; i++)
            if (quad_admits(m, &quad_problems[problems[i]])) slope(m, NULL, card->name, card->order, &quad_problems[problems[i]]);
    }
    /* Newmark's arguments: order 2 for every beta with gamma = 1/2, and 1 for any other gamma. */
    static const double betas[][2] = {{0, 0.5}, {1.0 / 12, 0.5}, {1.0 / 6, 0.5}, {0.3025, 0.6}};
    static const char *const names[] = {"newmark(0, 1/2)", "newmark(1/12, 1/2)", "newmark(1/6, 1/2)", "newmark(0.3025, 0.6)"};
    for (method m = 0; m < row_count(); m++)
        for (int i = 0; row_card(m)->name[0] == 'n' && i < 4; i++)
            for (int p = DAMPED; p <= TANGLED; p++) slope(m, betas[i], names[i], betas[i][1] == 0.5 ? 2 : 1, &quad_problems[p]);
}
