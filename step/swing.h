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
