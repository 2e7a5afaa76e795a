/* COLLOCATION at the roots of a Legendre polynomial: nodes and coefficients of any number of stages, generated.
 *
 * P[k] are Legendre's polynomials on the step, [0, 1], with ∫ P[k]² = 1/(2k + 1). Gauss's nodes are the roots of P[s];
 * the left ones of Radau, 0 among them, those of P[s] + P[s-1]. Quadrature at either is exact for products of two
 * polynomials of degree less than s, so Lagrange's polynomials are l[j] = b[j] Σ (2k + 1) P[k](c[j]) P[k], k < s, with
 * 1/b[j] = Σ (2k + 1) P[k](c[j])², and no matrix has to be inverted [HW96, IV.5]. Their integrals follow from
 * (2k + 1) ∫ P[k] = (P[k+1] - P[k-1])/2, where P[-1] stands for -1, which makes the integral begin at 0; those of the
 * integrals alike, where the integral of P[-1] is minus that of P[0].
 *
 * Invariant: all is computed in pairs, so a coefficient is the exact one, rounded once.
 */
#ifdef ROWS
typedef struct collocation {
    int stages;
    pair place[TABLEAU_COUPLED_MAX];                         /* the nodes on [-1, 1], ascending */
    pair p[TABLEAU_COUPLED_MAX][TABLEAU_COUPLED_MAX + 1];    /* p[i][k]: P[k] at node i */
    pair weight[TABLEAU_COUPLED_MAX];                        /* b */
    pair integral[TABLEAU_COUPLED_MAX][TABLEAU_COUPLED_MAX]; /* a */
} collocation;

/* P[0] … P[last] at y in [-1, 1]. */
static void collocation_legendre(pair y, int last, pair *p)
{
    p[0] = pair_of(1);
    p[1] = y;
    for (int k = 1; k < last; k++) {
        const pair now = pair_product(pair_of((coef)(2 * k + 1)), pair_product(y, p[k])),
                   before = pair_product(pair_of((coef)k), p[k - 1]);
        p[k + 1] = pair_quotient(pair_difference(now, before), pair_of((coef)(k + 1)));
    }
}

/* P[s], of Radau's nodes with P[s-1] added, and its slope, in coef alone. */
static coef collocation_value(int s, bool left, coef y, coef *slope)
{
    coef before = 1, now = y, rate_before = 0, rate = 1;
    for (int k = 1; k < s; k++) {
        const coef next = ((coef)(2 * k + 1) * y * now - (coef)k * before) / (coef)(k + 1),
                   rate_next = rate_before + (coef)(2 * k + 1) * now;
        before = now, now = next;
        rate_before = rate, rate = rate_next;
    }
    *slope = left ? rate + rate_before : rate;
    return left ? now + before : now;
}

/* The roots, from the largest down. To the right of all roots that are left Newton's method for the quotient by the
 * others only descends; what it finds in coef, two corrections by values in pairs complete. */
static void collocation_nodes(collocation *n, bool left)
{
    enum { DESCENTS_MAX = 100, CORRECTIONS = 2 };
    const int s = n->stages;
    for (int at = s - 1; at >= 0; at--) {
        coef y = 1, slope = 1;
        for (int i = 0; i < DESCENTS_MAX; i++) {
            const coef value = collocation_value(s, left, y, &slope);
            coef rate = slope;
            for (int k = at + 1; k < s; k++) rate -= value / (y - n->place[k].high);
            const coef next = y - value / rate;
            if (!(next < y)) break;
            y = next;
        }
        n->place[at] = pair_of(y);
        for (int i = 0; i < CORRECTIONS; i++) {
            collocation_legendre(n->place[at], s, n->p[at]);
            const pair value = left ? pair_sum(n->p[at][s], n->p[at][s - 1]) : n->p[at][s];
            n->place[at] = pair_difference(n->place[at], pair_quotient(value, pair_of(slope)));
        }
    }
    if (left) n->place[0] = pair_of(-1);
}

/* l[j] where the Legendre polynomials up to P[s] have the values q, and its integral from 0 to there. */
static pair collocation_lagrange(const collocation *n, int j, const pair *q)
{
    pair sum = pair_of(0);
    for (int k = 0; k < n->stages; k++)
        sum = pair_sum(sum, pair_product(pair_of((coef)(2 * k + 1)), pair_product(n->p[j][k], q[k])));
    return pair_product(n->weight[j], sum);
}

static pair collocation_integral(const collocation *n, int j, const pair *q)
{
    pair sum = pair_of(0);
    for (int k = 0; k < n->stages; k++)
        sum = pair_sum(sum, pair_product(n->p[j][k], pair_difference(q[k + 1], k ? q[k - 1] : pair_of(-1))));
    return pair_product(pair_product(n->weight[j], pair_of((coef)1 / 2)), sum);
}

/* The integral of the integral of l[j], where those of the P[k] have the values `once`. */
static pair collocation_twice(const collocation *n, int j, const pair *once)
{
    pair sum = pair_of(0);
    for (int k = 0; k < n->stages; k++)
        sum = pair_sum(sum,
                       pair_product(n->p[j][k], pair_difference(once[k + 1], k ? once[k - 1] : pair_minus(once[0]))));
    return pair_product(pair_product(n->weight[j], pair_of((coef)1 / 2)), sum);
}

static void collocation_make(collocation *n, int stages, bool left)
{
    n->stages = stages;
    collocation_nodes(n, left);
    for (int i = 0; i < stages; i++) {
        pair sum = pair_of(0);
        collocation_legendre(n->place[i], stages, n->p[i]);
        for (int k = 0; k < stages; k++)
            sum = pair_sum(sum, pair_product(pair_of((coef)(2 * k + 1)), pair_product(n->p[i][k], n->p[i][k])));
        n->weight[i] = pair_quotient(pair_of(1), sum);
    }
    for (int i = 0; i < stages; i++)
        for (int j = 0; j < stages; j++) n->integral[i][j] = collocation_integral(n, j, n->p[i]);
}

/* The node on [0, 1]. */
static pair collocation_abscissa(const collocation *n, int i)
{
    return pair_product(pair_sum(n->place[i], pair_of(1)), pair_of((coef)1 / 2));
}

/* l[j] at the nodes of the next step. */
static void collocation_ahead(const collocation *n, coef *ahead)
{
    const int s = n->stages;
    for (int i = 0; i < s; i++) {
        pair p[TABLEAU_COUPLED_MAX + 1];
        collocation_legendre(pair_sum(n->place[i], pair_of(2)), s, p);
        for (int j = 0; j < s; j++) ahead[i * s + j] = collocation_lagrange(n, j, p).high;
    }
}

/* The constants of tableau.h: a and b; for positions the square of a, as the formulas for (x, v)' = (v, a) have it, or
 * `twice`: the integrals of the integrals of l[j], which belong to the polynomial of a. */
static void collocation_fill(const work *w, const collocation *n, bool twice, coef *unit)
{
    const int s = n->stages;
    for (int i = 0; i < s && w->kept; i++) unit[tableau_low_c(w) + i] = collocation_abscissa(n, i).low;
    for (int i = 0; i <= s; i++) { /* the last row is the end of the step */
        const pair *row = i < s ? n->integral[i] : n->weight;
        pair p[TABLEAU_COUPLED_MAX + 2], once[TABLEAU_COUPLED_MAX + 1];
        collocation_legendre(i < s ? n->place[i] : pair_of(1), s + 1, p);
        once[0] = pair_product(pair_sum(p[1], p[0]), pair_of((coef)1 / 2));
        for (int k = 1; k <= s; k++)
            once[k] = pair_quotient(pair_difference(p[k + 1], p[k - 1]), pair_of((coef)(4 * k + 2)));
        for (int j = 0; j < s; j++) {
            pair sum = twice ? collocation_twice(n, j, once) : pair_of(0);
            for (int l = 0; l < s && !twice; l++) sum = pair_sum(sum, pair_product(row[l], n->integral[l][j]));
            unit[(i < s ? tableau_a(w, i) : tableau_b(w)) + j] = row[j].high;
            unit[(i < s ? tableau_aa(w, i) : tableau_bb(w)) + j] = sum.high;
            if (i < s || !w->kept) continue;
            unit[tableau_rest(w, false) + j] = row[j].low;
            unit[tableau_rest(w, true) + j] = sum.low;
        }
    }
}

/* (2k + 1) b[j] P[k](c[j]). */
static void collocation_series(const collocation *n, coef *series)
{
    const int s = n->stages;
    for (int k = 0; k < s; k++)
        for (int j = 0; j < s; j++)
            series[k * s + j] = pair_product(pair_of((coef)(2 * k + 1)), pair_product(n->weight[j], n->p[j][k])).high;
}

/* By how much the polynomial through the accelerations changes at node j, where node i changes by 1, those before i
 * stay, and its divided differences beyond i stay [Everhart85]. */
static inline void collocation_spread(const collocation *n, coef *spread)
{
    const int s = n->stages;
    for (int i = 0; i < s; i++)
        for (int j = 0; j < s; j++) {
            pair product = pair_of(1);
            for (int l = 0; l < i; l++)
                product = pair_product(product, pair_quotient(pair_difference(n->place[j], n->place[l]),
                                                              pair_difference(n->place[i], n->place[l])));
            spread[i * s + j] = product.high;
        }
}
#endif
