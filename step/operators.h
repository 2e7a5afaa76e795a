/* The operators kick, v += b h a, and drift, x += d h v, of stage i of a splitting row, on a problem of any size.
 *
 * Invariant: joining operators changes no bit of the state. A kick makes the drift of its stage in the same pass over
 * memory where it can (kick_drifts). In a row that begins and ends with a kick (FSAL, first same as last) the closing
 * kick of a step is joined with the opening kick of the next step, which has the same acceleration (kick_joint). A kick
 * whose acceleration is known from an observation does not evaluate it again.
 *
 * Compensated addition, once a step: x and v stay what they are until the step ends. Within it their error words hold
 * what is to be added, small numbers whose rounding is smaller by the factor h: ev = Σ b h a, whose own roundings `low`
 * collects, and ex = Σ d h ev; the drifts of v itself come to h v. After drifts of C h in all, the positions are
 * xs = x + (C h v + ex), where C h is the exact sum: were it rounded, kicks and drifts would no longer be symplectic.
 * The end of the step (step_end) adds what has come together, so no compensated addition delays an acceleration.
 */
static inline coef kick_unit(const work *w, int i) { return w->unit[i]; }
static inline coef drift_unit(const work *w, int i) { return w->unit[FACT(w, stages) + i]; }
static inline bool kicks(const work *w, int i) { return LIVE(w, i); }
static inline bool drifts(const work *w, int i) { return LIVE(w, FACT(w, stages) + i); }
static inline clock kick_size(const work *w, int i) { return w->scaled[i]; }
static inline clock drift_size(const work *w, int i) { return w->scaled[FACT(w, stages) + i]; }
/* closing and opening kick in one */
static inline clock kick_joint(const work *w) { return w->scaled[2 * FACT(w, stages)]; }
static inline clock kick_closing(const work *w) { return w->scaled[FACT(w, stages) - 1]; }
/* of a compensated row: all drifts up to that of stage i, in two numbers */
static inline clock drift_way(const work *w, int i) { return w->scaled[2 * FACT(w, stages) + 1 + i]; }
static inline clock drift_way_low(const work *w, int i) { return w->scaled[3 * FACT(w, stages) + 1 + i]; }
/* the last stage of a step's own; the closing kick of an FSAL row is the next step's */
static inline int last_stage(const work *w) { return FACT(w, stages) - FACT(w, fsal) - 1; }
static inline bool first_kick(const work *w, int i) { return i == !kicks(w, 0); }

/* The positions at which stage i kicks, and the velocities before that kick, where some force reads them. */
static inline real *kick_positions(const work *w, int i) { return ROW(w, compensated) && i > 0 ? w->xs : w->x; }
static inline real *kick_velocities(work *w)
{
    if (!ROW(w, compensated) || !(FACT(w, solves) || FACT(w, means))) return w->v;
    EACHV(k) w->us[k] = w->v[k] + w->ev[k];
    return w->us;
}

/* Kicks the sum of a compensated row by b a. */
static inline void kick_sum(work *w, int i, clock b, const real *restrict a)
{
    real *restrict ev = w->ev, *restrict low = w->low;
    const bool first = first_kick(w, i);
    EACHV(k) APART_KICK(first, ev[k], low[k], b, a[k]);
}

/* v += b a(x, (v + v')/2, t), v' the velocity after the kick: the implicit midpoint rule for v' = a at fixed x and t,
 * which is symmetric, so a step of leapfrog with this kick is symmetric and of order 2 for every force, and the
 * compositions of such steps keep their order [HLW06, II.4, V.3.2]. For a = E + v × B it is the Boris rotation, the
 * Cayley form of exp(h B×), written as the one linear system that it solves [Boris70; Qin13]. */
static int kick_implicit(work *w, int i)
{
    int bad = newton_increment(w, kick_size(w, i), CLOCK(1), kick_positions(w, i), kick_velocities(w), i);
    if (bad) return bad;
    real *restrict v = w->v;
    const real *restrict delta = w->delta;
    if (ROW(w, compensated))
        kick_sum(w, i, CLOCK(1), delta);
    else
        EACHV(k) v[k] += delta[k];
    return STEP_OK;
}

/* For first-order variables that read v, and that nothing reads, a kick is an integral along the known v + u b a, 0 ≤ u
 * ≤ 1: from w->a at u = 0 to its mean. One node, the mean velocity, is symmetric and of order 2, which compositions
 * need; Gauss's two nodes are of order 4 [HNW93, II.7]. The accelerations of the positions do not change. */
static inline int kick_mean(work *w, int i, clock b)
{
    real *V = w->vs, *a = w->a, *first = w->r;
    const real *v = kick_velocities(w);
    real *x = kick_positions(w, i);
    const bool two = FACT(w, means) > 1;
    const coef node = two ? w->unit[2 * FACT(w, stages) + 1] : (coef)1 / 2;
    EACHV(k) V[k] = FMA(b * node, a[k], v[k]);
    int bad = accel_in(w, i, x, V, a);
    if (bad || !two) return bad;
    EACHV(k) {
        first[k] = a[k];
        V[k] = FMA(b * (1 - node), a[k], v[k]);
    }
    bad = accel_in(w, i, x, V, a);
    EACHV(k) a[k] = a[k] / 2 + first[k] / 2;
    return bad;
}

static inline bool kick_drifts(const work *w, int i) { return FACT(w, fused) && kicks(w, i) && drifts(w, i); }

static inline int kick(work *w, int i)
{
    if (!kicks(w, i)) return STEP_OK;
    if (FACT(w, solves)) return kick_implicit(w, i);
    const bool known = i == 0 && work_reuse(w);
    const clock b = i == 0 && FACT(w, fsal) && !FIRST(w) ? kick_joint(w) : kick_size(w, i), c = drift_size(w, i);
#ifdef PASS /* a machine's own: acceleration, kick and drift of stage i in one pass over memory */
    if (!known && drifts(w, i)) {
        if (ROW(w, compensated))
            PASS_APART(w, i, b, c, kick_positions(w, i), drift_way(w, i), drift_way_low(w, i), first_kick(w, i),
                       i == last_stage(w));
        else
            PASS(w, i, b, c);
        return STEP_OK;
    }
#endif
    int bad = known ? STEP_OK : accel_in(w, i, kick_positions(w, i), FACT(w, means) ? kick_velocities(w) : w->v, w->a);
    if (!bad && FACT(w, means)) bad = kick_mean(w, i, b);
    if (bad) return bad;
    real *restrict x = w->x, *restrict v = w->v;
    const real *restrict a = w->a;
    if (ROW(w, compensated)) {
        kick_sum(w, i, b, a);
    } else if (kick_drifts(w, i)) {
        EACH(k) {
            ADVANCE(v[k], b, a[k]);
            ADVANCE(x[k], c, v[k]);
        }
    } else {
        EACHV(k) ADVANCE(v[k], b, a[k]);
    }
    return STEP_OK;
}

static inline void drift(work *w, int i)
{
    if (!drifts(w, i)) return;
#ifdef PASS
    if (w->moved) {
        w->moved--;
        return;
    }
#endif
    if (kick_drifts(w, i)) return;
    real *restrict x = w->x, *restrict ex = w->ex, *restrict xs = w->xs;
    const real *restrict v = w->v, *restrict ev = w->ev;
    const clock c = drift_size(w, i);
    if (!ROW(w, compensated))
        EACH(k) ADVANCE(x[k], c, v[k]);
    else if (i < last_stage(w))
        EACH(k) APART_DRIFT(xs[k], x[k], ex[k], drift_way(w, i), drift_way_low(w, i), v[k], c, ev[k]);
    else
        EACH(k) ADVANCE(ex[k], c, ev[k]);
}

/* The end of a step of a compensated row: its increments are added to the state. */
static inline void step_end(work *w)
{
    if (!ROW(w, compensated)) return;
#ifdef PASS
    if (w->moved) {
        w->moved--;
        return;
    }
#endif
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    const real *restrict low = w->low;
    const clock h = drift_way(w, last_stage(w)), h_low = drift_way_low(w, last_stage(w));
    EACH(k) APART_END_X(x[k], ex[k], v[k], h, h_low);
    EACHV(k) APART_END_V(v[k], ev[k], low[k]);
}
