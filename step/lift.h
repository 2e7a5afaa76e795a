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

/* The nodes of the next round, and what it leads to; 0: none is needed. */
static int lift_next(const work *w, lift_errors *e)
{
    const int due = w->between + 1, least = lift_least(lift_least(e->x, e->v), e->s), rate = w->velocity ? least : e->x,
              force = w->velocity && !w->quadrature ? least : e->x;
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

static dense_room lift_between(const work *w, coef *unit)
{
    int nodes[LIFT_ROUNDS_MAX];
    const int count = lift_rounds(w, nodes);
    (void)unit;
    return (dense_room){.arrays = count ? 2 + lift_widest(nodes, count, 0) + lift_widest(nodes, count, 1) : 0};
}

/* The polynomial ------------------------------------------------------------------------------------------------- */

/* The weights of a state at the part u of the step: of the accelerations, and of how far the ends are from one another:
 * dv = v₁ - v₀ and dx = x₁ - x₀ - h v₀. */
typedef struct lift_weights {
    clock x[LIFT_NODES_MAX + 2], v[LIFT_NODES_MAX + 2], s[LIFT_NODES_MAX + 2];
    clock x_dv, x_dx, v_dv, v_dx, s_dv;
} lift_weights;

/* The integrals from 0 to u, once and twice, of the l[j], of ω and of u ω: by Gauss's rule, which is exact for them. */
static void lift_integrals(int nodes, clock u, clock *once, clock *twice)
{
    static const coef point[LIFT_POINTS / 2] = {
        K(0.01985507175123188415821956571526350478588), K(0.1016667612931866302042230317620847815814),
        K(0.2372337950418355070911304754053768254790), K(0.4082826787521750975302619288199080096666)};
    static const coef weight[LIFT_POINTS / 2] = {
        K(0.05061426814518812957626567715498109505770), K(0.1111905172266872352721779972131204422151),
        K(0.1568533229389436436689811009933006566302), K(0.1813418916891809914825752246385978060971)};
    const int n = nodes + 2;
    for (int j = 0; j < n + 2; j++) once[j] = twice[j] = 0;
    for (int g = 0; g < LIFT_POINTS; g++) {
        const int at = g < LIFT_POINTS / 2 ? g : LIFT_POINTS - 1 - g;
        const clock y = u * (g == at ? point[at] : 1 - point[at]), c = u * weight[at];
        clock all = 1;
        for (int l = 0; l < n; l++) all *= y - lift_node(nodes, l);
        for (int j = 0; j < n + 2; j++) {
            clock value = j < n ? CLOCK(1) : j == n ? all : y * all;
            for (int l = 0; l < n && j < n; l++)
                if (l != j) value *= (y - lift_node(nodes, l)) / (lift_node(nodes, j) - lift_node(nodes, l));
            once[j] = FMA(c, value, once[j]);
            twice[j] = FMA(c * (u - y), value, twice[j]);
        }
    }
}

static void lift_weigh(int nodes, clock u, lift_weights *out)
{
    const int n = nodes + 2;
    clock once[LIFT_NODES_MAX + 4], twice[LIFT_NODES_MAX + 4], end[LIFT_NODES_MAX + 4], end2[LIFT_NODES_MAX + 4];
    lift_integrals(nodes, u, once, twice);
    lift_integrals(nodes, 1, end, end2);
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

/* inner: the accelerations within the step. */
static void lift_state(const work *w, const dense_end e[2], int nodes, const real *inner, clock u, real *x, real *v)
{
    lift_weights of;
    const real *a[LIFT_NODES_MAX + 2] = {e[0].a};
    const int n = nodes + 2;
    const clock h = e[1].t - e[0].t;
    for (int j = 1; j < n; j++) a[j] = j == n - 1 ? e[1].a : inner + (size_t)(j - 1) * w->stride;
    lift_weigh(nodes, u, &of);
    for (size_t k = 0; k < w->nv; k++) {
        const bool moves = k < w->nx;
        const real v0 = e[0].v[k], dv = e[1].v[k] - v0;
        real speed = {0}, place = {0};
        for (int j = 0; j < n; j++) {
            speed = FMA(moves ? of.v[j] : of.s[j], a[j][k], speed);
            place = FMA(of.x[j], a[j][k], place);
        }
        v[k] = v0 + FMA(h, speed, (moves ? of.v_dv : of.s_dv) * dv);
        if (!moves) continue;
        const real x0 = e[0].x[k], dx = (e[1].x[k] - x0) - h * v0;
        v[k] += of.v_dx * (dx / h);
        x[k] = x0 + FMA(h, FMA(h, place, FMA(of.x_dv, dv, u * v0)), of.x_dx * dx);
    }
}

/* Where the accelerations of round r stand. */
static real *lift_place(const work *w, const dense_step *d, const int *nodes, int count, int r)
{
    return d->more + (size_t)(2 + (r % 2 ? lift_widest(nodes, count, 0) : 0)) * w->stride;
}

static int lift_extend(work *w, const dense_step *d)
{
    int nodes[LIFT_ROUNDS_MAX], bad = STEP_OK;
    const int count = lift_rounds(w, nodes);
    const clock t0 = d->end[0].t, h = d->end[1].t - t0;
    const whole evaluations = w->evaluations;
    real *X = d->more, *V = d->more + w->stride;
    for (int r = 0; r < count; r++)
        for (int j = 1; j <= nodes[r] && !bad; j++) {
            const clock u = lift_node(nodes[r], j), t = t0 + u * h;
            if (r == 0)
                dense_hermite(w, d->end, t, X, V);
            else
                lift_state(w, d->end, nodes[r - 1], lift_place(w, d, nodes, count, r - 1), u, X, V);
            bad = accel(w, t, X, V, lift_place(w, d, nodes, count, r) + (size_t)(j - 1) * w->stride);
        }
    w->evaluations = evaluations;
    return bad;
}

static int lift_dense(work *w, const dense_step *d, clock t, real *x, real *v)
{
    int nodes[LIFT_ROUNDS_MAX];
    const int count = lift_rounds(w, nodes);
    const clock u = (t - d->end[0].t) / (d->end[1].t - d->end[0].t);
    if (count)
        lift_state(w, d->end, nodes[count - 1], lift_place(w, d, nodes, count, count - 1), u, x, v);
    else
        dense_hermite(w, d->end, t, x, v);
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
