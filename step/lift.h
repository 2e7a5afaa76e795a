/* DENSE OUTPUT OF A METHOD'S OWN ORDER, from the two ends of a step and accelerations evaluated within it: Hermite's
 * polynomial (dense.h), lifted.
 *
 * In a round the force is evaluated at nodes within the step, at the states that the polynomial so far gives there. The
 * next polynomial has these accelerations, those of the ends, and the ends themselves: q'' through the nodes, where
 * q'' = Σ l[j](u) a[j] + ω(u) (α + β u), l[j] Lagrange's polynomials and ω = Π (u - node), so that q and q' lead to
 * the end of the step. First-order variables have no β. With m nodes within the step its own errors are h^(6+m) in x,
 * h^(5+m) in v and h^(4+m) in first-order variables; those of the accelerations enter x by h² and v by h. So a round
 * gains two powers where the force reads positions alone, else one [EJNT86], and rounds go on
 * until the errors have the power of the method's own.
 *
 * Invariant: nothing is evaluated where Hermite's polynomial is as good as the method. Nodes are symmetric and even in
 * number: else the integral of ω vanishes.
 */
enum { LIFT_NODES_MAX = 10, LIFT_ROUNDS_MAX = 12, LIFT_POINTS = 8 };

/* Node j of those within the step: they make the errors small, by a search that compared their largest values. */
static clock lift_node(int nodes, int j)
{
    static const coef left[][LIFT_NODES_MAX / 2] = {{K(0.2)},
                                                    {K(0.11), K(0.29)},
                                                    {K(0.06), K(0.17), K(0.34)},
                                                    {K(0.04), K(0.12), K(0.24), K(0.37)},
                                                    {K(0.03), K(0.09), K(0.18), K(0.28), K(0.41)}};
    if (j == 0 || j == nodes + 1) return j > 0;
    const coef *of = left[nodes / 2 - 1];
    return j <= nodes / 2 ? of[j - 1] : 1 - of[nodes - j];
}

/* Rounds --------------------------------------------------------------------------------------------------------- */

/* The powers of the step with which positions, velocities and first-order variables are off. */
typedef struct lift_errors {
    int x, v, s;
} lift_errors;

static int lift_least(int a, int b) { return a < b ? a : b; }

/* The order that is wanted; of rows that find their own it is the last step's, as far as there are nodes. */
static int lift_order(const work *w)
{
    const int most = LIFT_NODES_MAX + 4;
    if (!ROW(w, orders)) return w->between;
    return w->span > 0 && 2 * w->span < most ? 2 * (int)w->span : most;
}

/* The nodes of the next round, and what it leads to; 0: none is needed. */
static int lift_next(const work *w, lift_errors *e)
{
    const int due = lift_order(w) + 1, least = lift_least(lift_least(e->x, e->v), e->s),
              rate = w->velocity ? least : e->x, force = w->velocity && !w->quadrature ? least : e->x;
    if (e->v >= due && e->s >= due) return 0;
    const bool moves = w->nx > 0, flows = w->nv > w->nx;
    int m = 2;
    while (m < LIFT_NODES_MAX &&
           ((moves && 5 + m < lift_least(due, force + 1)) || (flows && 4 + m < lift_least(due, rate + 1))))
        m += 2;
    if (moves) e->x = lift_least(6 + m, force + 2), e->v = lift_least(5 + m, force + 1);
    if (flows) e->s = lift_least(4 + m, rate + 1);
    return m;
}

static int lift_rounds(const work *w, int nodes[LIFT_ROUNDS_MAX])
{
    enum { NO_ERROR = 99 };
    lift_errors e = {NO_ERROR, NO_ERROR, NO_ERROR};
    int count = 0;
    if (w->nx > 0) e.x = 6, e.v = 5;
    if (w->nv > w->nx) e.s = 4;
    while (count < LIFT_ROUNDS_MAX && (nodes[count] = lift_next(w, &e))) count++;
    return count;
}

/* Rounds take turns in two places. */
static int lift_widest(const int *nodes, int count, int from)
{
    int most = 0;
    for (int r = from; r < count; r += 2) most = nodes[r] > most ? nodes[r] : most;
    return most;
}

/* In `more`: a state, how far the ends are apart, and the accelerations of two rounds. */
enum { LIFT_STATE = 0, LIFT_APART = 2, LIFT_FIRST = 4 };

/* Tells whether the polynomial is more than Hermite's formula: of adaptive rows it always takes what the ends are apart
 * from `more`, where the step's stages may tell it with less rounding than the ends do. */
static bool lift_needed(const work *w, int count) { return (void)w, count > 0 || ROW(w, adaptive); }

static real *lift_array(const work *w, const dense_step *d, int i) { return d->more + (size_t)i * w->stride; }

/* x₁ - x₀ - h v₀ and v₁ - v₀. */
static void lift_apart(const work *w, const dense_step *d)
{
    real *dx = lift_array(w, d, LIFT_APART), *dv = lift_array(w, d, LIFT_APART + 1);
    const dense_end *e = d->end;
    for (size_t k = 0; k < w->nx; k++) dx[k] = (e[1].x[k] - e[0].x[k]) - w->h * e[0].v[k];
    for (size_t k = 0; k < w->nv; k++) dv[k] = e[1].v[k] - e[0].v[k];
}

/* The polynomial ------------------------------------------------------------------------------------------------- */

/* The weights of a state at the part u of the step: of the accelerations, and of how far the ends are apart:
 * dv = v₁ - v₀ and dx = x₁ - x₀ - h v₀. */
typedef struct lift_weights {
    clock x[LIFT_NODES_MAX + 2], v[LIFT_NODES_MAX + 2], s[LIFT_NODES_MAX + 2];
    clock x_dv, x_dx, v_dv, v_dx, s_dv;
} lift_weights;

/* For one number of nodes, what every time within a step needs: 1/Π (node j - node l), and the integrals over the step,
 * once and twice, of the l[j], of ω and of u ω. */
typedef struct lift_table {
    clock over[LIFT_NODES_MAX + 2], once[LIFT_NODES_MAX + 4], twice[LIFT_NODES_MAX + 4];
} lift_table;
enum { LIFT_TABLES = LIFT_NODES_MAX / 2 + 1 };

/* The constants: the tables, then, of rows of one order, the weights at the nodes of all rounds in turn. */
typedef struct lift_constants {
    lift_table table[LIFT_TABLES];
    lift_weights at[];
} lift_constants;

static const lift_constants *lift_known(const dense_step *d) { return (const lift_constants *)(const void *)d->unit; }

/* The integrals from 0 to u, once and twice, of the l[j], of ω and of u ω: by Gauss's rule, which is exact for them. */
static void lift_integrals(int nodes, const clock *over, clock u, clock *once, clock *twice)
{
    static const coef point[LIFT_POINTS / 2] = {
        K(0.01985507175123188415821956571526350478588), K(0.1016667612931866302042230317620847815814),
        K(0.2372337950418355070911304754053768254790), K(0.4082826787521750975302619288199080096666)};
    static const coef weight[LIFT_POINTS / 2] = {
        K(0.05061426814518812957626567715498109505770), K(0.1111905172266872352721779972131204422151),
        K(0.1568533229389436436689811009933006566302), K(0.1813418916891809914825752246385978060971)};
    const int n = nodes + 2;
    /* of point g: y and its weight, and Π (y - node) over the nodes before and beyond j; points are the inner loops */
    clock y[LIFT_POINTS], c[LIFT_POINTS], below[LIFT_NODES_MAX + 3][LIFT_POINTS], above[LIFT_POINTS];
    for (int g = 0; g < LIFT_POINTS; g++) {
        const int at = g < LIFT_POINTS / 2 ? g : LIFT_POINTS - 1 - g;
        y[g] = u * (g == at ? point[at] : 1 - point[at]);
        c[g] = u * weight[at];
        below[0][g] = above[g] = CLOCK(1);
    }
    for (int j = 0; j < n; j++) {
        const clock node = lift_node(nodes, j);
        for (int g = 0; g < LIFT_POINTS; g++) below[j + 1][g] = below[j][g] * (y[g] - node);
    }
    for (int j = n + 1; j >= 0; j--) {
        const clock node = j < n ? lift_node(nodes, j) : CLOCK(0);
        clock value[LIFT_POINTS], one = CLOCK(0), two = CLOCK(0);
        for (int g = 0; g < LIFT_POINTS; g++) {
            value[g] = j > n ? y[g] * below[n][g] : j == n ? below[n][g] : below[j][g] * above[g] * over[j];
            if (j < n) above[g] *= y[g] - node;
        }
        for (int g = 0; g < LIFT_POINTS; g++) {
            one = FMA(c[g], value[g], one);
            two = FMA(c[g] * (u - y[g]), value[g], two);
        }
        once[j] = one, twice[j] = two;
    }
}

static void lift_tabulate(int nodes, lift_table *out)
{
    const int n = nodes + 2;
    for (int j = 0; j < n; j++) {
        clock product = 1;
        for (int l = 0; l < n; l++) product *= l == j ? CLOCK(1) : lift_node(nodes, j) - lift_node(nodes, l);
        out->over[j] = 1 / product;
    }
    lift_integrals(nodes, out->over, 1, out->once, out->twice);
}

static void lift_weigh(int nodes, const lift_table *whole, clock u, lift_weights *out)
{
    const int n = nodes + 2;
    const clock *end = whole->once, *end2 = whole->twice;
    clock once[LIFT_NODES_MAX + 4], twice[LIFT_NODES_MAX + 4];
    lift_integrals(nodes, whole->over, u, once, twice);
    const clock a = end[n], b = end[n + 1], c = end2[n], d = end2[n + 1], det = a * d - b * c;
    out->v_dv = (d * once[n] - c * once[n + 1]) / det;
    out->v_dx = (a * once[n + 1] - b * once[n]) / det;
    out->x_dv = (d * twice[n] - c * twice[n + 1]) / det;
    out->x_dx = (a * twice[n + 1] - b * twice[n]) / det;
    out->s_dv = once[n] / a;
    for (int j = 0; j < n; j++) {
        out->v[j] = once[j] - out->v_dv * end[j] - out->v_dx * end2[j];
        out->x[j] = twice[j] - out->x_dv * end[j] - out->x_dx * end2[j];
        out->s[j] = once[j] - out->s_dv * end[j];
    }
}

/* The nodes that a round finds. */
static int lift_before(const int *nodes, int r) { return r ? nodes[r - 1] : 0; }

static void lift_fill(const work *w, const int *nodes, int count, lift_constants *out)
{
    lift_weights *at = out->at;
    for (int i = 0; i < LIFT_TABLES; i++) lift_tabulate(2 * i, &out->table[i]);
    for (int r = 0; r < count && !ROW(w, orders); r++)
        for (int j = 1; j <= nodes[r]; j++) {
            const int before = lift_before(nodes, r);
            lift_weigh(before, &out->table[before / 2], lift_node(nodes[r], j), at++);
        }
}

static dense_room lift_between(const work *w, coef *unit)
{
    int nodes[LIFT_ROUNDS_MAX], arrays = LIFT_FIRST + 2 * LIFT_NODES_MAX;
    const int count = lift_rounds(w, nodes);
    size_t bytes = sizeof(lift_constants);
    if (!lift_needed(w, count)) return (dense_room){0};
    if (unit) lift_fill(w, nodes, count, (lift_constants *)(void *)unit);
    for (int r = 0; r < count && !ROW(w, orders); r++) bytes += (size_t)nodes[r] * sizeof(lift_weights);
    if (!ROW(w, orders)) arrays = LIFT_FIRST + lift_widest(nodes, count, 0) + lift_widest(nodes, count, 1);
    return (dense_room){.arrays = arrays, .constants = bytes / sizeof(coef)};
}

/* Computes the state at the part u of the step, from the accelerations at `nodes` nodes within it and their weights. */
static void lift_state(const work *w, const dense_step *d, int nodes, const lift_weights *of, const real *inner,
                       clock u, real *x, real *v)
{
    const dense_end *e = d->end;
    const real *a[LIFT_NODES_MAX + 2] = {e[0].a}, *dx = lift_array(w, d, LIFT_APART),
                                   *dv = lift_array(w, d, LIFT_APART + 1);
    const int n = nodes + 2;
    const clock h = w->h;
    for (int j = 1; j < n; j++) a[j] = j == n - 1 ? e[1].a : inner + (size_t)(j - 1) * w->stride;
    for (size_t k = 0; k < w->nv; k++) {
        const bool moves = k < w->nx;
        const real v0 = e[0].v[k];
        real speed = {0}, place = {0};
        for (int j = 0; j < n; j++) {
            speed = FMA(moves ? of->v[j] : of->s[j], a[j][k], speed);
            place = FMA(of->x[j], a[j][k], place);
        }
        const real turn = FMA(h, speed, (moves ? of->v_dv : of->s_dv) * dv[k]);
        v[k] = v0 + (moves ? FMA(of->v_dx / h, dx[k], turn) : turn);
        if (moves) x[k] = e[0].x[k] + FMA(h, FMA(h, place, FMA(of->x_dv, dv[k], u * v0)), of->x_dx * dx[k]);
    }
}

/* Where the accelerations of round r stand. */
static real *lift_place(const work *w, const dense_step *d, const int *nodes, int count, int r)
{
    return lift_array(w, d, LIFT_FIRST + (r % 2 ? lift_widest(nodes, count, 0) : 0));
}

/* The rounds, once it is known how far the ends are apart. */
static int lift_rise(work *w, const dense_step *d)
{
    int nodes[LIFT_ROUNDS_MAX], bad = STEP_OK;
    const int count = lift_rounds(w, nodes);
    const whole evaluations = w->evaluations;
    const lift_constants *known = lift_known(d);
    const lift_weights *at = known->at;
    real *X = lift_array(w, d, LIFT_STATE), *V = lift_array(w, d, LIFT_STATE + 1);
    for (int r = 0; r < count; r++)
        for (int j = 1; j <= nodes[r] && !bad; j++, at++) {
            const int before = lift_before(nodes, r);
            const clock u = lift_node(nodes[r], j);
            real *a = lift_place(w, d, nodes, count, r) + (size_t)(j - 1) * w->stride;
            lift_weights now;
            if (ROW(w, orders)) lift_weigh(before, &known->table[before / 2], u, &now);
            lift_state(w, d, before, ROW(w, orders) ? &now : at, lift_place(w, d, nodes, count, r + 1), u, X, V);
            bad = accel(w, d->end[0].t + u * (d->end[1].t - d->end[0].t), X, V, a);
        }
    w->evaluations = evaluations;
    return bad;
}

static int lift_extend(work *w, const dense_step *d)
{
    int nodes[LIFT_ROUNDS_MAX];
    if (!lift_needed(w, lift_rounds(w, nodes))) return STEP_OK;
    lift_apart(w, d);
    return lift_rise(w, d);
}

/* For rows that keep what the step adds without the linear motion: over h² in w->next_x, over h in w->delta. The ends
 * are rounded, and a velocity from them would have that rounding over h. */
static inline int lift_extend_kept(work *w, const dense_step *d)
{
    real *dx = lift_array(w, d, LIFT_APART), *dv = lift_array(w, d, LIFT_APART + 1);
    const clock h = w->h, hh = h * h;
    for (size_t k = 0; k < w->nx; k++) dx[k] = hh * w->next_x[k];
    for (size_t k = 0; k < w->nv; k++) dv[k] = h * w->delta[k];
    return lift_rise(w, d);
}

static int lift_dense(work *w, const dense_step *d, clock t, real *x, real *v)
{
    int nodes[LIFT_ROUNDS_MAX];
    const int count = lift_rounds(w, nodes);
    if (!lift_needed(w, count)) {
        dense_hermite(w, d->end, t, x, v);
        return STEP_OK;
    }
    const int last = lift_before(nodes, count);
    const clock u = (t - d->end[0].t) / (d->end[1].t - d->end[0].t);
    lift_weights now;
    lift_weigh(last, &lift_known(d)->table[last / 2], u, &now);
    lift_state(w, d, last, &now, lift_place(w, d, nodes, count, count + 1), u, x, v);
    return STEP_OK;
}

/* Collocation with more than four stages has its own polynomial. */
static dense_room dense_stages_between(const work *w, coef *unit)
{
    return w->kept > 4 ? (dense_room){0} : lift_between(w, unit);
}
static int dense_stages_extend(work *w, const dense_step *d) { return w->kept > 4 ? STEP_OK : lift_extend(w, d); }
static int dense_stages(work *w, const dense_step *d, clock t, real *x, real *v)
{
    if (w->kept <= 4) return lift_dense(w, d, t, x, v);
    dense_collocation(w, d, t, x, v);
    return STEP_OK;
}
