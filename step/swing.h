/* Bounds on the accelerations within a step, which tell how far it can be from the straight line between its ends, and
 * cost nothing beside the step: `most` of each number is raised to them. The stages of an adaptive step may miss its
 * largest acceleration, but hardly by half of it, since the method itself would be as wrong. */
static inline bool swing_unknown(const work *w, real *most) { return (void)w, (void)most, false; }
static inline bool swing_of_stages(const work *w, real *most)
{
    const int count = FACT(w, stages) + FACT(w, ending);
    if (!ROW(w, adaptive)) return false; /* their stages are not kept */
    EACHV(k) {
        real largest = most[k];
        for (int i = 0; i < count; i++) largest = LARGER(ABS(w->ks[(size_t)i * w->stride + k]), largest);
        most[k] = 2 * largest;
    }
    return true;
}
/* Bounds the accelerations of a step of fixed size with these ends, whose dense output is Hermite's polynomial
 * (dense.h): a polynomial is nowhere larger than its coefficients in Bernstein's basis [Farouki12], and those of q''
 * are the accelerations at the ends and two more; of a first-order variable's rate one more. Twice as much, since rows
 * of a higher order change that polynomial by less (lift.h). If a number overflows, the bound is NaN. */
static inline void swing_of_ends(size_t nx, size_t nv, clock h, const real *x0, const real *v0, const real *a0,
                                 const real *x1, const real *v1, const real *a1, real *most)
{
    const clock per_h = 1 / h;
    for (size_t k = 0; k < nv; k++) {
        const bool moves = k < nx;
        const real way = moves ? 20 * per_h * (x1[k] - x0[k]) : 3 * (v1[k] - v0[k]);
        const real one =
            moves ? per_h * (way - (8 * v1[k] + 12 * v0[k])) + (a1[k] - 2 * a0[k]) : per_h * way - (a0[k] + a1[k]);
        const real two = moves ? per_h * ((8 * v0[k] + 12 * v1[k]) - way) + (a0[k] - 2 * a1[k]) : one;
        const real ends = LARGER(ABS(a0[k]), ABS(a1[k])), inner = LARGER(ABS(one), ABS(two));
        most[k] = 2 * LARGER(inner, ends) + 0 * (one + two);
    }
}
