/* The workspace of one trajectory (or of a block of them), the constants that follow from a row and a step, and what the texts share.
 *
 * The texts of step/ include nothing. Before this one the includer defines
 *     real        a number, or a vector with one trajectory per lane      clock   time and step; apart from real, for lanes to come
 *     whole       a signed integer of 64 bits                             coef    a coefficient of a row; `row` as in core/rows.h
 *     FMA(a,b,c)  a b + c with one rounding                               ABS(x), FINITE(x), EPSILON, SQRT_EPSILON of real
 *     EACH(k)     a loop over the positions of `w`                        EACHV(k)  over velocities, then companions
 *     TRACE(w,i)  called after stage i, of implicit stages when all are solved and not yet summed; empty unless somebody looks in
 *     ROW(w,m), FACT(w,m)     members of the row and of `w` that never change; not needed where the row is known at run time only, while a
 *                             compiled model makes them constants, so that what it does not use is never translated
 * and, before newton.h and the families, the functions
 *     accel(w, t, x, v, a)                  a = a(x, v, t); counts itself in w->evaluations; 0 or STEP_CALLBACK
 *     accel_in(w, i, x, v, a), accel_now(w, x, v, a)     the same at the time of stage i, and of the present step. Macros of this file, unless
 *                                           the includer has its own (and defines both): it may know beforehand what depends on time alone
 *     solve_factor(w, s, ax, av, t, x, v)   factors I - (ax ⊗ da/dx + av ⊗ da/dv) for s stages; 0 or a STEP_ status
 *     solve_back(w, r)                      r, stage after stage, becomes the solution
 *     solve_apply(w, c, y, out)             out = (I + c da/dv) y, of the last factored derivative
 *     exact_at(w, t, x, v), refresh_at(w, t, x, v)   the exact motion; driven boundary cells: look.h asks for them
 *
 * Invariant: `x` and `v` (with their error words ex and ev, and `old`) are the main line; they change in a step and nowhere else. `a` and
 * `delta` belong to the state (x, v, n) while `fresh` is true; a step that begins with them takes them by work_reuse, which ends that.
 */
#ifndef ROW
#define ROW(w, member) ((w)->row->member)
#define FACT(w, member) ((w)->member)
#endif

enum { STEP_OK, STEP_CALLBACK, STEP_SOLVE, STEP_DIVERGED, STEP_MEMORY };

/* The outer indices that a tile is at, from … to-1, and how they move: tiled.h. Only machines that tile look at it. */
typedef struct window {
    whole from, to;
    whole strip[2], block[2];      /* their intersection is from … to; a strip moves down with every pass, a block's ends by `slope` */
    int slope[2];
    bool more, ahead;              /* another step follows in this tile; its first drift is made already */
} window;

typedef struct work {
    const row *row;
    size_t nx, nv, stride;         /* stride: distance of two arrays below; at least nv */
    clock t0, h;
    whole n, evaluations, iterations;
    bool velocity, linear;         /* the acceleration depends on v; at most linearly */
    bool constant;                 /* it depends on parameters alone */
    bool check;                    /* look for infinities after every step */
    bool finite;                   /* whoever took the last steps saw that all is finite */

    bool fresh;                    /* the acceleration of the present state is known already, because somebody looked */
    whole owed_evaluations, owed_iterations;      /* what it cost: counted when the method uses it */

    real *x, *v, *ex, *ev;         /* v: two-step methods keep the increment d = x[n] - x[n-1] here once n > 0 */
    real *a, *old, *next;
    real *delta, *r;               /* increment of an implicit kick; residual */
    real *xs, *vs, *ks;            /* stages: positions, velocities, accelerations */

    int stages, known;             /* known: implicit stages that are explicit after all (newmark's first) */
    bool merged;                   /* first and last operation are kicks: the last one waits for the next step's first */
    bool direct;                   /* the stages' equation is linear in the unknowns, or none: one solve is exact */
    clock kick[KICKS_MAX], drift[KICKS_MAX], c[KICKS_MAX], joint, closing;
    unsigned kicks, drifts;        /* bit i: stage i kicks, drifts */
    unsigned terms[STAGES_MAX], weights;          /* of an explicit tableau; bit j: a[i][j], b[j] is not 0 */
    /* The times at which a step evaluates the force, each once: at[m] in steps. Stage i is at moment[i]; that number may be `moments`: the first
     * moment of the next step, which is the end of this one. */
    int moments, moment[KICKS_MAX];
    clock at[KICKS_MAX];
    clock ha[STAGES_MAX][STAGES_MAX], hha[STAGES_MAX][STAGES_MAX], hb[STAGES_MAX], hhb[STAGES_MAX];
    clock hh, half_hh, per_h;

    const clock *table;            /* the includer's: of what depends on time alone, from step `first` on; NULL where there is none now */
    whole first;

    const real *diagonal;          /* the includer's: the matrix of an implicit kick, where it is diagonal and constant, for this slope */
    clock slope;

    size_t which;                  /* what went wrong: entry of v, or of x where !in_v */
    bool in_v;
    void *user;                    /* the includer's */
    int threads;                   /* how many may share one evaluation, or the tiles of one sweep */
    window window;
} work;

/* Time of the part c of step n, a clock or a vector of them: the ends are the loop's own times, so that a force evaluated there is the
 * neighbour's too. */
#define TIME_OF(w, n) ((w)->t0 + (n) * (w)->h)
#define TIME_IN(w, n, c) ((c) == 0 || (c) == 1 ? TIME_OF(w, (n) + (c)) : TIME_OF(w, n) + (c) * (w)->h)
static inline clock time_of(const work *w, whole n) { return TIME_OF(w, (clock)n); }
static inline clock time_in(const work *w, clock c) { return TIME_IN(w, (clock)w->n, c); }

/* 1: the arrays are so short that to copy them is nothing, and that they may then live in registers; known when the text is compiled. */
#ifndef SMALL
#define SMALL 0
#endif

/* A loop over stages; a compiled model may ask for it to be written out, so that every coefficient and every time is a constant. */
#ifndef EACH_STAGE
#define EACH_STAGE(i, count) for (int i = 0; i < (count); i++)
#endif

#ifndef accel_in
#define accel_in(w, i, x, v, a) accel(w, time_in(w, FACT(w, c)[i]), x, v, a)
#define accel_now(w, x, v, a) accel(w, time_of(w, (w)->n), x, v, a)
#endif

/* y += c z, and the same with the error word e of y: Knuth's two-sum, exact whichever operand is larger. */
#define ADVANCE(y, c, z) ((y) = FMA((c), (z), (y)))
#define ADVANCE_EXACTLY(y, e, c, z)                                 \
    do {                                                            \
        __typeof__(y) p_ = FMA((c), (z), (e)), s_ = (y) + p_, b_ = s_ - (y); \
        (e) = ((y) - (s_ - b_)) + (p_ - b_);                        \
        (y) = s_;                                                   \
    } while (0)

/* The acceleration at the start of a step, from where it is known already. */
static inline bool work_reuse(work *w)
{
    if (!w->fresh) return false;
    w->fresh = false;
    w->evaluations += w->owed_evaluations;
    w->iterations += w->owed_iterations;
    return true;
}

/* Constants ------------------------------------------------------------------------------------------------------- */

static inline void work_plan_splitting(work *w)
{
    const row *m = w->row;
    coef kick[KICKS_MAX] = {0}, drift[KICKS_MAX] = {0};
    if (m->composition.count) {                            /* neighbouring half drifts are one */
        int s = m->composition.count;
        w->stages = s + 1;
        for (int i = 0; i < s; i++) {
            coef weight = m->composition.weight[i < s - 1 - i ? i : s - 1 - i];
            drift[i] += weight / 2;
            kick[i + 1] = weight;
            drift[i + 1] += weight / 2;
        }
    } else {
        w->stages = m->splitting.stages;
        for (int i = 0; i < w->stages; i++) {
            kick[i] = m->splitting.kick[i];
            drift[i] = m->splitting.drift[i];
        }
    }
    int last = w->stages - 1;
    coef time = 0;
    for (int i = 0; i <= last; i++) {                      /* a kick happens at the time to which the drifts have come */
        bool over = true;
        for (int j = i; j <= last; j++) over = over && drift[j] == 0;
        w->c[i] = over ? 1 : (clock)time;
        time += drift[i];
        w->kick[i] = (clock)kick[i] * w->h;
        w->drift[i] = (clock)drift[i] * w->h;
        w->kicks |= (unsigned)(kick[i] != 0) << i;
        w->drifts |= (unsigned)(drift[i] != 0) << i;
    }
    w->merged = kick[0] != 0 && kick[last] != 0 && drift[last] == 0;
    w->closing = w->kick[last];
    w->joint = (clock)(kick[0] + kick[last]) * w->h;
}

static inline void work_plan_tableau(work *w, const double argument[2])
{
    const row *m = w->row;
    coef a[STAGES_MAX][STAGES_MAX] = {{0}}, aa[STAGES_MAX][STAGES_MAX] = {{0}}, b[STAGES_MAX] = {0}, bb[STAGES_MAX] = {0};
    w->stages = m->newmark ? 2 : m->tableau.stages;
    w->known = m->newmark ? 1 : 0;
    for (int i = 0; i < w->stages; i++) {
        if (m->newmark) continue;
        b[i] = m->tableau.b[i];
        w->c[i] = (clock)m->tableau.c[i];
        for (int j = 0; j < w->stages; j++) a[i][j] = m->tableau.a[i][j];
    }
    /* A method for x' = v, v' = a in Nyström form: positions go with a a and b a [HNW93, II.14]. */
    for (int i = 0; i < w->stages; i++)
        for (int j = 0; j < w->stages; j++)
            for (int l = 0; l < w->stages; l++) {
                aa[i][j] += a[i][l] * a[l][j];
                if (i == 0) bb[j] += b[l] * a[l][j];
            }
    if (m->newmark) {                                      /* the second stage is the end of the step */
        coef beta = (coef)argument[0], gamma = (coef)argument[1];
        w->c[1] = 1;
        a[1][0] = b[0] = 1 - gamma;
        a[1][1] = b[1] = gamma;
        aa[1][0] = bb[0] = (coef)0.5 - beta;
        aa[1][1] = bb[1] = beta;
    }
    for (int i = 0; i < w->stages; i++) {
        w->hb[i] = (clock)b[i] * w->h;
        w->hhb[i] = (clock)bb[i] * w->hh;
        w->weights |= (unsigned)(b[i] != 0) << i;
        for (int j = 0; j < w->stages; j++) {
            w->ha[i][j] = (clock)a[i][j] * w->h;
            w->hha[i][j] = (clock)aa[i][j] * w->hh;
            w->terms[i] |= (unsigned)(a[i][j] != 0) << j;
        }
    }
    w->direct = m->newmark && w->hha[1][1] == 0 && (!w->velocity || w->linear);
}

static inline void work_plan_moments(work *w)
{
    int last = w->row->family == TWO_STEP ? 0 : w->merged ? w->stages - 2 : w->stages - 1;
    bool all = w->row->family != SPLITTING;
    for (int start = 1; start >= 0; start--)               /* the start of the step first, where the force is taken there */
        for (int i = 0; i <= last; i++) {
            int m = 0;
            if ((w->c[i] == 0) != start || !(all || w->kicks >> i & 1)) continue;
            while (m < w->moments && w->at[m] != w->c[i]) m++;
            if (w->c[i] == 1 && w->moments && w->at[0] == 0) m = -1;
            w->moment[i] = m;
            if (m == w->moments) w->at[w->moments++] = w->c[i];
        }
    for (int i = 0; i <= last; i++)
        if (w->moment[i] < 0) w->moment[i] = w->moments;
}

/* row, h, velocity, linear must be set, all else 0. */
static inline void work_plan(work *w, const double argument[2])
{
    w->hh = w->h * w->h;
    w->half_hh = w->hh / 2;
    w->per_h = 1 / w->h;
    if (w->row->family == SPLITTING) work_plan_splitting(w);
    if (w->row->family == RUNGE_KUTTA || w->row->family == IMPLICIT) work_plan_tableau(w, argument);
    if (w->row->family != EXACT) work_plan_moments(w);
}

/* Memory ---------------------------------------------------------------------------------------------------------- */

/* Gives every array its place in `memory`, `stride` apart, and returns how many there are (memory NULL: counts). After work_plan. */
static inline size_t work_place(work *w, real *memory)
{
    size_t used = 0;
    bool solve = ROW(w, gyroscopic) || (ROW(w, family) == TWO_STEP && ROW(w, two_step) != BEEMAN && FACT(w, velocity));
#define PLACE(name, count) (w->name = memory ? memory + used * w->stride : memory, used += (size_t)(count))
    PLACE(x, 1);
    PLACE(v, 1);
    PLACE(a, 1);
    if (ROW(w, compensated)) PLACE(ex, 1), PLACE(ev, 1);
    if (ROW(w, family) == TWO_STEP) PLACE(old, 1), PLACE(vs, 1);
    if (ROW(w, family) == TWO_STEP && ROW(w, two_step) == VERLET_LITERAL) PLACE(next, 1);
    if (ROW(w, gyroscopic)) PLACE(vs, 1);
    if (solve) PLACE(delta, 1), PLACE(r, 1);
    if (ROW(w, family) == RUNGE_KUTTA) PLACE(xs, 1), PLACE(vs, FACT(w, stages)), PLACE(ks, FACT(w, stages));
    if (ROW(w, family) == IMPLICIT) PLACE(xs, 1), PLACE(vs, 1), PLACE(ks, FACT(w, stages)), PLACE(r, FACT(w, stages));
#undef PLACE
    return used;
}

/* The numbers of all arrays but the stages' from one workspace to another. */
static inline void work_move(work *to, const work *from, size_t count)
{
#define MOVE(name) for (size_t k = 0; to->name && k < count; k++) to->name[k] = from->name[k]
    MOVE(x);
    MOVE(v);
    MOVE(a);
    MOVE(ex);
    MOVE(ev);
    MOVE(old);
    MOVE(next);
    MOVE(delta);
    if (ROW(to, family) == TWO_STEP) MOVE(vs);
#undef MOVE
}

/* The arrays that carry a trajectory from step n to the next; all else is recomputed. At n = 0 two-step methods carry v itself. */
enum { CARRY_MAX = 4 };
static inline int work_carry(const work *w, real *list[CARRY_MAX])
{
    int count = 0;
    if (ROW(w, family) == EXACT) return 0;
    bool literal = ROW(w, family) == TWO_STEP && ROW(w, two_step) == VERLET_LITERAL;
    list[count++] = w->x;
    list[count++] = literal && w->n > 0 ? w->old : w->v;
    if (ROW(w, compensated)) list[count++] = w->ex, list[count++] = w->ev;
    if (ROW(w, family) == TWO_STEP && ROW(w, two_step) == BEEMAN) list[count++] = w->old;
    if (ROW(w, newmark)) list[count++] = w->a;
    return count;
}
