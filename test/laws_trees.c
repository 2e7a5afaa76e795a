/* THE TREES OF THE ORDER CONDITIONS, generated: every way to put smaller trees under a root, once.
 *
 * Invariant: a vertex is an acceleration a. Its children are what a is differentiated by: v itself, a leaf through x;
 * the tree of another acceleration through x, which raises the order by two; or one through v, which raises it by
 * one. Rooted trees have links of the last kind alone, since in s' = f(s) every derivative of s is one f.
 */
#include "test/laws_proof.h"

enum { TREES_MAX = 4096, LINKS_MAX = TREES_ORDER_MAX };
typedef struct tree {
    int order, leaves, children, child[LINKS_MAX];
    bool velocity[LINKS_MAX]; /* child i enters through v, not x */
    quad gamma;               /* the exact solution has 1/gamma in v, 1/((order + 1) gamma) in x */
} tree;
typedef struct forest {
    trees_kind kind;
    int count;
    tree tree[TREES_MAX];
} forest;

/* The possible children: item 0 is a leaf v, 2k + 1 tree k on v, 2k + 2 tree k on x. Returns by how much it raises
 * the order; 0: not of this kind. */
static int weight(const forest *f, int item)
{
    const bool on_v = item % 2;
    if (f->kind == TREES_ROOTED && !on_v) return 0;
    if (f->kind == TREES_SPECIAL && on_v) return 0;
    return item == 0 ? 1 : f->tree[(item - 1) / 2].order + !on_v;
}

/* Adds all multisets of items that raise the order by `left`, in descending number, under `root`. */
static void grow(forest *f, tree root, int left, int last)
{
    if (left == 0) {
        f->tree[f->count++] = root;
        return;
    }
    for (int item = last; item >= 0; item--) {
        const int w = weight(f, item);
        if (w == 0 || w > left) continue;
        tree next = root;
        if (item == 0) {
            next.leaves++;
        } else {
            const tree *below = &f->tree[(item - 1) / 2];
            next.child[next.children] = (item - 1) / 2;
            next.velocity[next.children++] = item % 2;
            next.gamma *= item % 2 ? below->gamma : (below->order + 1) * below->gamma;
        }
        grow(f, next, left - w, item);
    }
}

static const forest *forest_of(trees_kind kind)
{
    static forest forests[TREES_KINDS];
    static const int orders[TREES_KINDS] = {
        [TREES_ROOTED] = 10, [TREES_SPECIAL] = TREES_ORDER_MAX, [TREES_NYSTROM] = 6};
    forest *f = &forests[kind];
    if (f->count) return f;
    f->kind = kind;
    for (int n = 1; n <= orders[kind]; n++) grow(f, (tree){.order = n, .gamma = n}, n - 1, 2 * f->count);
    return f;
}

int trees_count(trees_kind kind, int order)
{
    if (kind == TREES_WORDS) return words_count(order);
    const forest *f = forest_of(kind);
    int count = 0;
    for (int t = 0; t < f->count; t++) count += f->tree[t].order == order;
    return count;
}

static quad power(quad part, int order)
{
    quad p = 1;
    for (int k = 0; k < order; k++) p *= part;
    return p;
}

int trees_conditions(trees_kind kind, const scheme *m, int order, condition *out)
{
    if (kind == TREES_WORDS) return words_conditions(m, order, out);
    static quad phi[TREES_MAX][SCHEME_STAGES_MAX];
    const forest *f = forest_of(kind);
    int count = 0;
    for (int i = 0; i < m->stages && kind == TREES_ROOTED; i++) { /* time is a component of s whose rate is 1 */
        out[count] = (condition){1, 0, m->c[i]};
        for (int j = 0; j < m->stages; j++) out[count].left += m->av[i][j];
        count++;
    }
    if (kind != TREES_ROOTED) out[count++] = (condition){1, m->end, 1};
    for (int t = 0; t < f->count && f->tree[t].order <= order; t++) {
        const tree *tree = &f->tree[t];
        quad v = 0, x = 0;
        for (int i = 0; i < m->stages; i++) {
            phi[t][i] = 1;
            for (int l = 0; l < tree->leaves; l++) phi[t][i] *= m->c[i];
            for (int c = 0; c < tree->children; c++) {
                quad sum = 0;
                for (int j = 0; j < m->stages; j++)
                    sum += (tree->velocity[c] ? m->av : m->a)[i][j] * phi[tree->child[c]][j];
                phi[t][i] *= sum;
            }
            v += m->bv[i] * phi[t][i];
            x += m->b[i] * phi[t][i];
        }
        const quad due = power(m->part != 0 ? m->part : 1, tree->order);
        out[count++] = (condition){tree->order, v, due / tree->gamma};
        if ((kind == TREES_ROOTED && !m->places) || tree->order == order) continue;
        out[count++] =
            (condition){tree->order + 1, x, due * (m->part != 0 ? m->part : 1) / ((tree->order + 1) * tree->gamma)};
    }
    return count;
}

/* The roundings of a term, at each of at most `order` vertices: a sum of s products; an entry of the tableau, itself
 * a sum of at most s products of two coefficients; two roundings for each of these, which include decimals beyond 113
 * bits; the product with the other branches; and the exact side. */
quad trees_roundings(const scheme *m, int order) { return order * (2 * m->stages + 10); }
