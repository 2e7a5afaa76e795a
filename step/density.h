/* THE DENSITY OF STEPS: adaptive steps that can be taken backward, for symmetric methods.
 *
 * Steps that follow from the error of the step before make a symmetric method forget which way time runs, and its
 * energy drifts. Here a step is h = e T: e is a constant, and T, a time, changes from step to step by the way in which
 * the time scale of the motion changes around the present state [HS05]:
 *
 *     T[n+1/2] = T[n-1/2] (1 + z)/(1 - z),   z = (h/2) d(log T)/dt at (x[n], v[n]),
 *     T[1/2] = T(x[0], v[0]) (1 + z/2)/(1 - z/2).
 *
 * Backward in time z has the other sign, so the steps are the same in reverse, whatever z is; that alone keeps the
 * energy. The more exact z, the closer is T[n+1/2] to the time scale. The scale follows from the motion alone, by
 *
 *     T^-4 = Σ (a⁴ + v² j²)/(v⁴ + l² a²) + (v²/(x² + l²))²/16 + (e/longest step)⁴,
 *
 * a sum over variables, of which x, v, a and j = da/dt are the sizes. T is 1/ω at every phase of an oscillation of
 * amplitude l, x'' = -ω² x, about (r³/k)^½ on a Kepler orbit, and smooth at turning points and where the force is zero.
 * l, a length of each variable, is constant, also through an action of an event; away from turning points T hardly
 * depends on it. A first-order variable has its rate for v, and the rate of that for a.
 *
 * d(log T)/dt is a difference: of T half a span e B before and after the present state, B(x, v, a) a rougher time
 * scale. The accelerations there and here give a and j in the middles. So z costs two evaluations, and the formula of
 * the force is not needed.
 *
 * Where a step is not within 1/4 to 4 of what the scale would have, because a close encounter was not resolved or T has
 * nearly a zero, the control begins anew, and the motion cannot be taken back beyond this place; w->refused counts
 * these. A tolerance that allows every error leaves the steps as control.h has them.
 *
 * Invariant: w->next is the last step, or e T, whose changes it takes along; a shorter last step changes nothing of it.
 * w->before is 1 once the control has begun. w->old has l² of variable g at its first number.
 */
#define DENSITY_FAR 4

/* Tells whether any error is allowed. */
static inline clock_mask density_free(const work *w) { return w->relative + w->absolute > 1e200; }

/* q^(-1/4): Newton's method doubles the digits of the rough logarithm. */
static inline real density_root(real q)
{
    const real least = (real){0} + 1e-290, p = PICK(q > least, PICK(q < 1e290, q, (real){0} + 1e290), least);
    real y = control_exp2(-control_log2(p) / 4);
    for (int i = 0; i < 4; i++) {
        const real yy = y * y;
        y = y * FMA(-0.25 * p, yy * yy, (real){0} + 1.25);
    }
    return q == q ? y : q;
}

/* The squares of a variable's sizes. */
typedef struct density_sizes {
    real x, v, a, j;
} density_sizes;

/* Returns the sizes of variable g half a span d from the present state, towards the acceleration `there`, a span
 * away. */
static inline density_sizes density_middle(const work *w, int g, const real *there, clock d)
{
    const clock per_d = 1 / d;
    const real none = {0};
    density_sizes s;
    s.x = s.v = s.a = s.j = none;
    for (size_t k = VARIABLE(w, g); k < VARIABLE(w, g + 1); k++) {
        const real a = w->a[k] / 2 + there[k] / 2, j = (there[k] - w->a[k]) * per_d, v = FMA(d / 2, w->a[k], w->v[k]);
        if (k < FACT(w, nx)) {
            const real x = FMA(d / 2, FMA(d / 4, w->a[k], w->v[k]), w->x[k]);
            s.x += x * x, s.v += v * v, s.a += a * a, s.j += j * j;
        } else {
            s.x += v * v, s.v += a * a, s.a += j * j;
        }
    }
    return s;
}

/* The fourth power of its rate, 1/T; l: the square of its length. On a variable without a length no force acts. */
static inline real density_rate(const density_sizes *s, real l)
{
    const real none = (real){0}, v = s->v, ratio = v / (s->x + l + SMALLEST);
    const real rate = FMA(s->a, s->a, v * s->j) / FMA(v, v, FMA(l, s->a, none + SMALLEST)) + ratio * ratio / 16;
    return PICK(l > 0, rate, none);
}

static inline real density_floor(const work *w, clock unit)
{
    const clock f = unit / w->most;
    return f * f * (f * f) + (real){0};
}

static inline real density_time(const work *w, const real *there, clock d, clock unit)
{
    real sum = density_floor(w, unit);
    EACH_VARIABLE(g)
    {
        const density_sizes s = density_middle(w, g, there, d);
        sum += density_rate(&s, w->old[VARIABLE(w, g)]);
    }
    return density_root(sum);
}

/* The rougher time scale of the present state, for which no other acceleration is needed. */
static inline real density_rough(const work *w, clock unit)
{
    real sum = density_floor(w, unit);
    EACH_VARIABLE(g)
    {
        const real l = w->old[VARIABLE(w, g)];
        real v = {0}, a = {0};
        for (size_t k = VARIABLE(w, g); k < VARIABLE(w, g + 1); k++) {
            const bool moves = k < FACT(w, nx);
            const real rate = moves ? w->v[k] : w->a[k];
            v += rate * rate;
            if (moves) a += w->a[k] * w->a[k];
        }
        const real ratio = v / (l + SMALLEST), both = a * a / FMA(v, v, FMA(l, a, (real){0} + SMALLEST));
        sum += PICK(l > 0, FMA(ratio, ratio / 16, both), (real){0});
    }
    return density_root(sum);
}

/* The accelerations a span d before and after the present state, in w->dx and w->dv. */
static inline int density_look(work *w, clock d)
{
    int bad = STEP_OK;
    for (int side = 0; side < 2 && !bad; side++) {
        const clock way = side ? d : -d;
        EACH(k) w->xs[k] = FMA(way, FMA(way / 2, w->a[k], w->v[k]), w->x[k]);
        EACHV(k) w->vs[k] = FMA(way, w->a[k], w->v[k]);
        bad = accel(w, time_now(w) + way, w->xs, w->vs, side ? w->dv : w->dx);
    }
    return bad;
}

/* The square of the length of variable g, by what is known a span d around: the amplitude that an oscillation with
 * these derivatives has; but no more than the motion itself can tell of it. */
static inline real density_length(const work *w, int g, clock d, clock reach)
{
    real x = {0}, v = {0}, a = {0}, j = {0}, s = {0};
    const clock per_d = 1 / d;
    for (size_t k = VARIABLE(w, g); k < VARIABLE(w, g + 1); k++) {
        const real here = w->a[k], j_k = (w->dv[k] - w->dx[k]) * (per_d / 2),
                   s_k = ((w->dv[k] - here) - (here - w->dx[k])) * (per_d * per_d);
        const bool moves = k < FACT(w, nx);
        const real place = moves ? w->x[k] : w->v[k], rate = moves ? w->v[k] : here;
        x += place * place, v += rate * rate;
        if (moves) a += here * here, j += j_k * j_k, s += s_k * s_k;
    }
    /* a place nearer to 0 than the motion goes in d tells nothing */
    const real near = FMA(d * d, a, v) * (d * d), place_most = 256 * LARGER(x, near);
    const real far = FMA(reach * reach, a, v) * (reach * reach), most = PICK(x > 0, place_most, far);
    const real p = FMA(a, a, v * j), q = FMA(j, j, a * s), root = density_root(p);
    const real amplitude = p * p * (root * root) / (q + SMALLEST);
    const real none = {0}, simple = VARIABLE(w, g) < FACT(w, nx) ? none : PICK(v > 0, PICK(x > 0, x, far / 256), none);
    return PICK(p > 0, PICK(amplitude < most, amplitude, most), simple);
}

/* Where the control has to begin: at first, and where a force begins to act on a variable. */
static inline clock_mask density_begins(const work *w)
{
    clock_mask begins = w->before == 0;
    EACH_VARIABLE(g)
    {
        real size = {0};
        for (size_t k = VARIABLE(w, g); k < VARIABLE(w, g + 1); k++) size += ABS(w->a[k]);
        begins = begins | ((w->old[VARIABLE(w, g)] == 0) & (size > 0));
    }
    return begins;
}

/* Measures the lengths of all variables, where the control begins. Those that an action has left are lengths of the
 * motion: they grow at most. */
static int density_measure(work *w, clock_mask begins)
{
    const clock d = ABS(w->next);
    const int bad = density_look(w, d);
    if (bad) return bad;
    EACH_VARIABLE(g)
    {
        const size_t at = VARIABLE(w, g);
        const real l = density_length(w, g, d, 100 * d);
        w->old[at] = CHOOSE_WHERE(begins & (l > w->old[at]), l, w->old[at]);
    }
    return STEP_OK;
}

/* The step `last` becomes the next one, where that is near what the time scale has, `own`. Returns where it is not. */
static inline clock_mask density_turn(work *w, clock_mask begins, clock last, clock own, clock z, clock forward)
{
    const clock turned = last * ((1 + z) / (1 - z)), anew = forward * own * ((1 + z / 2) / (1 - z / 2));
    const clock_mask far = (ABS(turned) > DENSITY_FAR * own) | (DENSITY_FAR * ABS(turned) < own);
    w->next = CHOOSE_WHERE(begins | far, anew, turned);
    return far & NOT(begins);
}

/* The next step, from the accelerations a span d around. Where no force acts it is the last one, and a part of the
 * guess where that is `guessed`. */
static void density_follow(work *w, clock_mask begins, clock_mask guessed, clock forward, clock d, clock unit)
{
    const clock last = w->next, guess = ABS(last);
    for (int turn = 0; turn < 2; turn++) {
        const clock behind = density_time(w, w->dx, -forward * d, unit),
                    ahead = density_time(w, w->dv, forward * d, unit), own = unit * ((ahead + behind) / 2);
        const clock slope = unit * (ahead - behind) / (2 * d), least = LARGER(slope, CLOCK(-0.5)),
                    z = CHOOSE_WHERE(least < 0.5, least, CLOCK(0.5));
        const clock_mask far =
            density_turn(w, begins, last, CHOOSE_WHERE(own < 1e60, own, CHOOSE_WHERE(guessed, unit * guess, guess)),
                         CHOOSE_WHERE(slope == slope, z, CLOCK(0)), forward);
        if (NONE(far)) break;
        w->refused = CHOOSE_WHERE(far, w->refused + 1, w->refused);
        EACH_VARIABLE(g)
        {
            const size_t at = VARIABLE(w, g);
            const real l = density_length(w, g, d, 100 * guess);
            w->old[at] = CHOOSE_WHERE(far & (l > w->old[at]), l, w->old[at]);
        }
        begins = begins | far;
    }
    w->before = CLOCK(1);
}

/* e: what a circular orbit loses in a step of e radians is the tolerance. But no step is longer than half of the time
 * scale, since longer ones would not see it change. */
static inline clock density_unit(const work *w)
{
    const clock unit = DENSITY_REACH(w) * control_exp2(control_log2(w->relative) / (FACT(w, order) + 1));
    return CHOOSE_WHERE(unit < DENSITY_MOST, unit, CLOCK(DENSITY_MOST));
}

/* Before a step: w->next, and the acceleration of the state where the method's first stage takes it. */
static int density_begin(work *w)
{
    const clock_mask guessed = w->next == 0; /* else a step has been taken before an action, or is given */
    int bad = control_first(w);
    if (bad || NONE(NOT(density_free(w)))) return bad;
    bad = control_begin(w);
    if (bad) return bad;
    const clock_mask begins = density_begins(w);
    if (!NONE(begins)) bad = density_measure(w, begins);
    if (bad) return bad;
    const clock forward = CHOOSE_WHERE(w->next < 0, CLOCK(-1), CLOCK(1)), unit = density_unit(w),
                rough = unit * density_rough(w, unit), most = 1024 * ABS(w->next),
                span = CHOOSE_WHERE(rough < most, rough, most);
    bad = density_look(w, forward * span);
    if (!bad) density_follow(w, begins, guessed, forward, span, unit);
    control_known(w, FACT(w, opening) ? EVERY : NOT(EVERY));
    return bad;
}

#ifdef ROWS
/* A circular Kepler orbit: its force over the place, and how long a step may be, in radians, for an error of 1, as if
 * the error went with the power order + 1 of the step from `arc` on, of which cosine and sine are given; one step leads
 * from (1, 0) to x, v. An oscillator would not tell: some methods are made for it. */
static coef density_pull(const coef x[2])
{
    const coef root = density_root(x[0] * x[0] + x[1] * x[1]), cube = root * root * root;
    return cube * cube;
}

static coef density_reach(const work *w, const coef x[2], const coef v[2], coef arc, coef cosine, coef sine)
{
    const coef place = LARGER(ABS(x[0] - cosine), ABS(x[1] - sine)),
               rate = LARGER(ABS(v[0] + sine), ABS(v[1] - cosine)), off = LARGER(place, rate);
    return arc * (coef)control_exp2(-control_log2(off) / (w->order + 1));
}
#endif

/* Every candidate is accepted. */
static inline clock_mask density_judge(work *w)
{
    const clock_mask good = EVERY;
    w->error = CLOCK(0);
    if (NONE(NOT(density_free(w)))) return control_judge(w);
    control_settle(w, good);
    control_known(w, FACT(w, closing) ? good : NOT(good));
    return good;
}
