/* NUMBERS OF TWICE THE DIGITS of coef: a pair is the sum of two of them, the second at most half a unit in the last
 * place of the first [Dekker71]. With them a plan forms coefficients that are then rounded once.
 *
 * Invariant: only sums and products of coef, in a written order, so the bits are the same everywhere; a few units in
 * the last place of the pair are lost by each operation. Products are split by multiplication, because coef may have no
 * fused operation.
 */
#ifdef ROWS
typedef struct pair {
    coef high, low;
} pair;

/* a + b, exactly [Knuth69, 4.2.2]. */
static inline pair pair_exact_sum(coef a, coef b)
{
    const coef s = a + b, t = s - a;
    return (pair){s, (a - (s - t)) + (b - t)};
}

/* a + b, exactly, where a is 0 or not smaller than b. */
static inline pair pair_tidy(coef a, coef b)
{
    const coef s = a + b;
    return (pair){s, b - (s - a)};
}

/* a b, exactly: both are split into halves whose products need no rounding. */
static inline pair pair_exact_product(coef a, coef b)
{
    const coef cut = 2 / SQRT_EPSILON + 1, p = a * b;
    const coef ca = cut * a, a1 = ca - (ca - a), a2 = a - a1, cb = cut * b, b1 = cb - (cb - b), b2 = b - b1;
    return (pair){p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

static inline pair pair_of(coef a) { return (pair){a, 0}; }
static inline pair pair_minus(pair a) { return (pair){-a.high, -a.low}; }

static inline pair pair_sum(pair a, pair b)
{
    const pair s = pair_exact_sum(a.high, b.high), t = pair_exact_sum(a.low, b.low),
               u = pair_tidy(s.high, s.low + t.high);
    return pair_tidy(u.high, u.low + t.low);
}

static inline pair pair_difference(pair a, pair b) { return pair_sum(a, pair_minus(b)); }

static inline pair pair_product(pair a, pair b)
{
    const pair p = pair_exact_product(a.high, b.high);
    return pair_tidy(p.high, p.low + (a.high * b.low + a.low * b.high));
}

/* Long division, three digits of coef. */
static inline pair pair_quotient(pair a, pair b)
{
    const coef first = a.high / b.high;
    const pair rest = pair_difference(a, pair_product(b, pair_of(first)));
    const coef second = rest.high / b.high;
    const pair last = pair_difference(rest, pair_product(b, pair_of(second))), q = pair_tidy(first, second);
    return pair_sum(q, pair_of(last.high / b.high));
}
#endif
