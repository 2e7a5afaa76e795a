/* THE SIZE OF AN ERROR: an error of every number, in units of what the tolerance allows.
 *
 * Numbers of one variable share a size, since a component that is nearly zero is no more exact than its vector;
 * different variables, which may have different units, do not. The size of positions is the largest position at the two
 * ends of the step, and the way that the step leads; so it is not zero where a motion passes through zero. Likewise the
 * sizes of velocities and first-order variables. What is allowed of velocities never falls below the rounding of the
 * positions over the step: at rest in an equilibrium nothing else is left of them.
 */
/* Tells whether the rounding of the time counts. Only the library's own loops take such candidates. */
#ifndef BLURS
#define BLURS(w) false
#endif
/* The largest part of a variable's velocities that it takes. */
static inline real norm_blur(const work *w, size_t from, size_t to)
{
    real most = {0};
    for (size_t k = from; BLURS(w) && k < to; k++) most = LARGER(w->blur[k], most);
    return most;
}
typedef struct norm {
    real size, way, off; /* the largest of a variable */
} norm;

static inline norm norm_none(void)
{
    const real none = {0};
    norm n;
    n.size = n.way = n.off = none;
    return n;
}

static inline void norm_take(norm *n, real before, real change, real rate, real off)
{
    const real after = before + change;
    n->size = LARGER(ABS(before), n->size);
    n->size = LARGER(ABS(after), n->size);
    n->way = LARGER(ABS(rate), n->way);
    n->off = LARGER(ABS(off), n->off);
}

/* What rounding may leave, and what is allowed. floor: the rounding of the positions over the step, of a velocity. */
static inline clock norm_rounding(const work *w, const norm *n, clock floor)
{
    return FMA(8 * EPSILON, n->size + ABS(w->h) * n->way, floor);
}

static inline clock norm_allowed(const work *w, const norm *n, clock floor)
{
    const clock least = norm_rounding(w, n, floor),
                allowed = FMA(w->relative, n->size + ABS(w->h) * n->way, w->absolute);
    return LARGER(allowed, least) + (clock){0} + SMALLEST;
}

/* The error over what is allowed; 0 where both are 0. */
static inline clock norm_share(const work *w, const norm *n, clock floor) { return n->off / norm_allowed(w, n, floor); }

/* The largest share of all variables; NaN where the candidate or its error is not finite. */
static inline clock control_norm(const work *w, const real *off_x, const real *off_v)
{
    const real *restrict x = w->x, *restrict v = w->v, *restrict a = w->a, *restrict dx = w->dx, *restrict dv = w->dv;
    const clock per_h = 16 * EPSILON * ABS(w->per_h);
    clock worst = {0};
    real none = {0};
    EACH_VARIABLE(g)
    {
        const size_t from = VARIABLE(w, g), to = VARIABLE(w, g + 1);
        norm place = norm_none(), rate = norm_none();
        for (size_t k = from; k < to; k++) {
            norm_take(&rate, v[k], dv[k], a[k], off_v[k]);
            none += (dv[k] - dv[k]) + (off_v[k] - off_v[k]);
        }
        const clock blur = (clock){0} + norm_blur(w, from, to);
        clock floor = {0};
        if (from < FACT(w, nx)) {
            for (size_t k = from; k < to; k++) {
                norm_take(&place, x[k], dx[k], v[k], off_x[k]);
                none += (dx[k] - dx[k]) + (off_x[k] - off_x[k]);
            }
            const clock share = norm_share(w, &place, BLURS(w) ? ABS(w->h) * blur : floor);
            worst = LARGER(share, worst);
            floor = per_h * place.size;
        }
        const clock share = norm_share(w, &rate, BLURS(w) ? floor + blur : floor);
        worst = LARGER(share, worst);
    }
    return worst + none;
}

/* Corrections r of the accelerations ks, of `count` stages each, over the step: in units of what is allowed of the
 * velocities beyond the last digits, infinite where that is nothing or everything; of what rounding may leave of them;
 * and of the largest acceleration of the variable. NaN where one is not finite. */
typedef struct norm_correction {
    clock share, roundings, change;
} norm_correction;

static inline norm_correction control_corrections(const work *w, const real *r, const real *ks, int count)
{
    const clock per_h = 16 * EPSILON * ABS(w->per_h), none = {0};
    norm_correction worst = {none, none, none};
    EACH_VARIABLE(g)
    {
        norm rate = norm_none();
        real place = {0}, lost = {0};
        for (size_t k = VARIABLE(w, g); k < VARIABLE(w, g + 1); k++) {
            for (size_t i = k; i < k + (size_t)count * w->stride; i += w->stride) {
                norm_take(&rate, w->v[k], (real){0}, ks[i], r[i]);
                lost += r[i] - r[i];
            }
            if (k < FACT(w, nx)) place = LARGER(ABS(w->x[k]), place);
        }
        const clock size = rate.size + ABS(w->h) * rate.way, off = ABS(w->h) * rate.off;
        const clock allowed = LARGER(CHOOSE_WHERE(w->absolute < size, w->absolute, none), w->relative * size),
                    slack = CHOOSE_WHERE(allowed < size, LARGER(allowed - 64 * EPSILON * size, none), none);
        const clock share = off / (slack + SMALLEST),
                    roundings = off / (norm_rounding(w, &rate, per_h * place) + SMALLEST),
                    change = rate.off / (rate.way + SMALLEST);
        worst.share = LARGER(share, worst.share);
        worst.roundings = LARGER(roundings, worst.roundings) + lost;
        worst.change = LARGER(change, worst.change);
    }
    return worst;
}
