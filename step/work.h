/* The workspace of one trajectory, or of a block of them: its state, its time, and the constants that follow from a
 * row and a step.
 *
 * The texts of step/ include nothing. Before this one the includer defines
 *     real            a number, or a vector with one trajectory per lane
 *     clock           the type of times and steps; apart from real, since lanes may share them
 *     whole           a signed integer of 64 bits
 *     coef            the type of a row's coefficients
 *     FMA(a, b, c)    a b + c with one rounding
 *     ABS(x), FINITE(x), EPSILON, SQRT_EPSILON    of real
 *     SMALLEST        a number so small that it is lost beside every number but 0
 *     clock_bits, PATTERN_OF(x), CLOCK_OF(b)    the 64 bits of a clock, from it and back
 *     EACH(k)         a loop over the positions of `w`
 *     EACHV(k)        a loop over its velocities, then its first-order variables
 *     TRACE(w, i)     called after stage i; of implicit stages when all are solved and not yet summed. Empty unless the
 *                     step is traced
 *     ROW(w, m), FACT(w, m)    members of the row and of `w` that never change. Without a definition they are read; a
 *                     compiled model makes them constants, so that the compiler drops what the model does not use
 * and, before the families, the functions
 *     accel(w, t, x, v, a)          a = a(x, v, t); counts itself in w->evaluations; 0 or STEP_CALLBACK
 *     accel_in(w, i, x, v, a)       the same at the time of stage i, and
 *     accel_now(w, x, v, a)         at the time of the present step. Both are macros of this file unless the includer
 *                                   defines both, because it has tabulated what depends on time alone
 *     solve_factor(w, where, s, ax, av, t, x, v)
 *                                   factors I - (ax ⊗ da/dx + av ⊗ da/dv) for s stages; 0 or a STEP_ status. In lanes
 *                                   only where *where holds; clears it where the matrix is singular
 *     solve_back(w, r)              r, stage after stage, becomes the solution
 *     solve_apply(w, c, y, out)     out = (I + c da/dv) y, with the derivative that was factored last
 *     exact_at(w, t, x, v)          the exact motion
 *     refresh_at(w, t, x, v)        writes driven boundary cells
 *     family_step(w) … family_dense(…)    the functions of families.def, of the row's family
 *
 * Invariant: `x` and `v` (with their error words ex and ev, and `old`) are the main line; they change in a step and
 * nowhere else. `a` and `delta` belong to the state (x, v, n) while `fresh` is true; a step that begins with them
 * takes them by work_reuse, which ends that.
 */
#ifndef ROW
#define ROW(w, member) ((w)->row->member)
#define FACT(w, member) ((w)->member)
#define LIVE(w, k) ((w)->live[k]) /* constant k of the plan is not 0 */
#endif

/* log2 of the most by which a step may grow: to 5 times its size. */
#define CONTROL_RISE 2.3

/* TRACE of an adaptive row: before a candidate, and after it, when its error is known. */
enum { TRACE_CANDIDATE = -2, TRACE_JUDGED = -3 };

enum { STEP_OK, STEP_CALLBACK, STEP_SOLVE, STEP_DIVERGED, STEP_STALLED };

/* A clock_mask says for which clocks of the workspace something holds; ticks are the steps that each has counted. There
 * are as many of both as there are clocks. */
#ifndef EVERY
typedef bool clock_mask;
typedef whole ticks;
#define EVERY true
#define CHOOSE_WHERE(good, a, b) ((good) ? (a) : (b))
#define NONE(good) (!(good))
#endif
#define CLOCK(number) ((clock){0} + (number))

/* The result of comparing reals: one bool, or one for each lane where real is a vector. PICK chooses lane by lane,
 * LARGER(a, b) is a where a > b, else b, and SOME tells whether it holds in any lane. STOP ends a step that cannot go
 * on, with its status; of lanes it marks those `where` this holds, SPOIL sets their values to NaN, and the others go
 * on. BLAME notes the entry of v that failed. */
#ifndef ALWAYS
typedef bool mask;
#define ALWAYS true
#define PICK(where, a, b) ((where) ? (a) : (b))
#define LARGER(a, b) ((a) > (b) ? (a) : (b))
#define SOME(where) (where)
#define STOP(w, where, status)      \
    do {                            \
        if (where) return (status); \
    } while (0)
#define SPOIL(w, y) ((void)0)
#define BLAME(w, where, k)           \
    do {                             \
        if (where) (w)->which = (k); \
    } while (0)
#endif
#define NEVER NOT(ALWAYS)
#define NOT(where) ((where) == 0)

/* The outer indices that a tile computes, from … to-1, and how they move: tiled.h. Only machines with tiles use it. */
typedef struct window {
    whole from, to;
    /* their intersection is from … to; a strip moves down with every pass, a block's ends by `slope` */
    whole strip[2], block[2];
    int slope[2];
    bool more; /* another step follows in this tile */
} window;

/* One end of a step: dense.h. */
typedef struct dense_end {
    clock t;
    const real *x, *v, *a;
} dense_end;

/* What dense output takes besides the two ends of a step: how many arrays, and how many constants of the row. */
typedef struct dense_room {
    int arrays;
    size_t constants;
} dense_room;

/* The last step, for dense output; its arrays and constants have the room that name_between asks for. */
typedef struct dense_step {
    dense_end end[2];
    real *more; /* arrays, w->stride apart */
    const coef *unit;
} dense_step;

/* A watch is asked after every step whether anything may have happened in it; where it may have, the steps end
 * (loop.h). It has arrays of its own, so that those of a compiled model can stay in registers. */
typedef struct watch watch;
struct watch {
    bool (*quiet)(watch *); /* nothing has happened in the step */
    void *ctx;
    real *from_x, *from_v, *to_x, *to_v; /* the states at its ends */
    real *from_a, *to_a;                 /* of fixed steps: the accelerations there */
    real *most;                          /* bounds on the accelerations within it */
    real *largest_x, *largest_v;         /* become the largest sizes of the states at which steps begin */
    real *middle, *width, *least; /* room for a box (box.h), x and then v, and for a bound on each of `functions` */
    size_t functions;
    clock t, lost, to_t, to_lost; /* where it began, and where it ended */
    ticks n;                      /* steps before it */
    bool known;                   /* `most` has the acceleration there; of fixed steps: its ends are observed */
    bool shown;                   /* `quiet` has been asked after this step */
    bool met;                     /* something may have happened in the last step */
};
/* From its start to its end. */
static inline clock watch_span(const watch *of) { return (of->to_t - of->t) + (of->to_lost - of->lost); }

typedef struct work {
    const row *row;
    size_t nx, nv, stride; /* stride: distance of two arrays below; at least nv */
    bool velocity, linear; /* the acceleration depends on v; at most linearly */
    bool quadrature;       /* it does in first-order variables alone, which nothing reads */
    bool constant;         /* it depends on parameters alone */
    bool affine;           /* it is affine in x and v, and does not depend on time */
    int between;           /* the order that the states between steps are to have */
    /* the numbers of variable g are variable[g] … variable[g + 1] - 1 of v, and of x those of them that x has */
    int variables;
    const size_t *variable;
    bool check;  /* test after every step whether the state is finite */
    bool finite; /* the machine found the state finite after the last steps */
    int threads; /* how many may share one evaluation, or the tiles of one sweep */
    whole evaluations, iterations;
    ticks refused; /* candidates that were not accepted */

    /* Time. Fixed: step n begins at t0 + n h. Carried: it begins at t, a sum whose rounding error is `lost`. */
    bool carried;
    clock_mask stalled; /* the next step would not move time on */
    clock_mask ends;    /* the candidate reaches `until` */
    clock t0, h;
    ticks n;              /* steps finished since t0 */
    clock t, lost, until; /* carried only; no step passes `until` */

    /* Adaptive. What a step may be off: `relative` times the size of its variable, `absolute`, or the larger of both;
     * between which sizes steps stay. */
    clock relative, absolute, least, most;
    clock next;  /* the size that the next candidate should have; 0: the first is not chosen yet */
    clock error; /* the candidate's error, in units of what is allowed */
    /* log2 of the error of the step before (density.h: whether control has begun; extrapolation.h: the line at which
     * the next step aims); of the most that the next may be longer */
    clock before, rise;
    const real *blur; /* what the rounding of the time leaves of velocities (core/stepper_blur.c); NULL: nothing */
    clock shortest, longest; /* step so far, that to the end apart; 0 before the first */
    /* adaptive: the last step; of rows that carry stages that of theirs, < 0 · h: it was refused. extrapolation.h: the
     * line at which the last step ended */
    clock span;
    int order; /* of the error estimate, which goes with h^(order + 1) */

    /* The plan, without dimensions, from the row alone: `unit`, constants of which the first `linears` are multiplied
     * by h and the next `squares` by h²; c: the abscissae of the stages. `scaled`: the constants for the present h. */
    int stages, linears, squares, plains; /* plains: constants that are not multiplied */
    const coef *unit, *c;
    const unsigned char *live;
    clock *scaled, hh, half_hh, per_h;
    int summed;    /* of a compensated splitting: its stages; work_sums */
    clock *matrix; /* room for the coefficients of the coupled stages: 2 solves² */
    int known;     /* stages of an implicit row that are explicit (newmark's first) */
    int kept;      /* stages that lead to the next step */
    int solves;    /* stages that are coupled in one equation; 0: nothing is solved */
    bool solves_x; /* that equation contains da/dx */
    bool iterates; /* an equation is solved by turns */
    bool direct;   /* it is linear in the unknowns, so that one solve is exact */
    /* first same as last: the closing kick of a step waits for the opening kick of the next */
    bool fsal;
    bool closing; /* the last stage is at the state to which the step leads */
    bool opening; /* of a density: a step begins with the acceleration of the state */
    bool ending;  /* an adaptive step evaluates the force at the candidate, which is the next step's first stage */
    bool second;  /* it has a second estimate of the error */
    int means;    /* of a quadrature: at how many velocities a kick takes its rates */
    bool fused;   /* a kick and the drift after it are made in one pass over memory */
    bool waits;   /* the state between two steps needs one more evaluation before it can be observed */

    bool fresh; /* the acceleration of the present state is known already, because it was observed */
    whole owed_evaluations, owed_iterations; /* the cost of that acceleration, counted when a step uses it */
    int moved;                               /* drifts that a machine's PASS has already made together with a kick */
    clock after;   /* adaptive, of rows that find their own sizes or orders: `next` once the candidate is judged */
    int expands;   /* the order of the Taylor series that the row needs; 0: none */
    size_t series; /*   numbers that the series keep, as the problem says */
    int expanded;  /*   how much of the series is known at the present state: taylor.h */

    real *x, *v, *ex, *ev;  /* v: verlet keeps the increment d = x[n] - x[n-1] here once n > 0 */
    real *a, *old, *next_x; /* old: of a density the lengths of variables */
    /* of a candidate: what it would add to x and v, with their error words; of a density: accelerations before and
     * after the state */
    real *dx, *dv;
    real *delta, *r;    /* change of v by an implicit kick; residual */
    real *xs, *vs, *ks; /* stages: positions, velocities, accelerations */
    /* of a compensated splitting: the roundings of ev; the velocities before a kick, where a force reads them */
    real *low, *us;

    /* the includer's table of what depends on time alone, from step `first` on; NULL: there is none now */
    const clock *table;
    whole first;
    /* the includer's matrix of an implicit kick for this slope, where it is diagonal and constant */
    const real *diagonal;
    clock slope;

    watch *watch; /* NULL: nobody watches the steps */
    size_t which; /* the number that failed: entry of v, or of x where !in_v */
    bool in_v;
    struct stepper_host *services;    /* the includer's: for the library's own bodies */
    const struct compiled_host *host; /* the includer's: for a compiled model */
    window window;
} work;

/* 1: the arrays are so short that copies cost nothing and that they fit into registers; known when the text is
 * compiled. */
#ifndef SMALL
#define SMALL 0
#endif

/* Of a density: the largest part of the motion's time scale that a step takes, and the part on a circular orbit for an
 * error of 1 (density.h). */
#define DENSITY_MOST 0.5
#define DENSITY_REACH(w) (FACT(w, unit)[FACT(w, linears) + FACT(w, squares)])

/* A loop over the variables, and the first number of each. */
#define EACH_VARIABLE(g) for (int g = 0; g < FACT(w, variables); g++)
#define VARIABLE(w, g) FACT(w, variable)[g]

/* A loop over stages; a compiled model may unroll it, so that every coefficient and every time is a constant. */
#ifndef EACH_STAGE
#define EACH_STAGE(i, count) for (int i = 0; i < (count); i++)
#endif

/* Tells whether this is the first step since t0, for which some methods have another formula. */
#ifndef FIRST
#define FIRST(w) (!ROW(w, adaptive) && (w)->n == 0)
#endif

/* What rounding leaves of y + p = sum, exactly, whichever of the two is larger [Knuth69, 4.2.2]. */
#define ROUNDED_OFF(y, p, sum) (((y) - ((sum) - ((sum) - (y)))) + ((p) - ((sum) - (y))))

/* y += c z, and the same by compensated addition with the error word e of y. */
#define ADVANCE(y, c, z) ((y) = FMA((c), (z), (y)))
#define ADVANCE_COMPENSATED(y, e, c, z) ADD_COMPENSATED(y, e, FMA((c), (z), (e)))
#define ADD_COMPENSATED(y, e, sum)               \
    do {                                         \
        __typeof__(y) p_ = (sum), s_ = (y) + p_; \
        (e) = ROUNDED_OFF(y, p_, s_);            \
        (y) = s_;                                \
    } while (0)

/* y += d where the step is accepted; e: the error word of y, which d has in it already. */
#define MOVE_WHERE(good, compensated, y, e, d)                                  \
    do {                                                                        \
        const __typeof__(y) p_ = (d), s_ = (y) + p_;                            \
        if (compensated) (e) = CHOOSE_WHERE(good, ROUNDED_OFF(y, p_, s_), (e)); \
        (y) = CHOOSE_WHERE(good, s_, (y));                                      \
    } while (0)

/* What a splitting with compensated addition does with every number (operators.h). A kick: ev += b a, whose rounding
 * `low` collects from the first kick of a step on. A drift: at = x + (way + way_low) v + ex after ex += c ev, in the
 * order in which nothing else waits for ev. The end of a step of h + h_low. */
#define APART_KICK(first, ev, low, b, a)                                                 \
    do {                                                                                 \
        __typeof__(ev) before_ = (ev);                                                   \
        ADVANCE(ev, b, a);                                                               \
        (low) = ((first) ? (__typeof__(ev)){0} : (low)) + FMA((b), (a), before_ - (ev)); \
    } while (0)
#define APART_DRIFT(at, x, ex, way, way_low, v, c, ev)                           \
    do {                                                                         \
        (at) = (x) + FMA((c), (ev), FMA((way), (v), FMA((way_low), (v), (ex)))); \
        ADVANCE(ex, c, ev);                                                      \
    } while (0)
#define APART_END_X(x, ex, v, h, h_low)                                                         \
    do {                                                                                        \
        __typeof__(x) way_ = (h) * (v), rest_ = FMA((h), (v), -way_) + FMA((h_low), (v), (ex)); \
        ADD_COMPENSATED(x, ex, way_);                                                           \
        ADD_COMPENSATED(x, ex, (ex) + rest_);                                                   \
    } while (0)
#define APART_END_V(v, ev, low)     \
    do {                            \
        ADD_COMPENSATED(v, ev, ev); \
        (ev) += (low);              \
    } while (0)

/* Time ------------------------------------------------------------------------------------------------------------ */

/* Fixed steps: the time t0 + (n + c) h at the fraction c of step n, a clock or a vector of them. Both ends of a step
 * are computed as t0 + n h, so that the neighbouring step can use a force that was evaluated there. */
#define TIME_FIXED(w, n, c) \
    ((c) == 0 || (c) == 1 ? (w)->t0 + ((n) + (c)) * (w)->h : ((w)->t0 + (n) * (w)->h) + (c) * (w)->h)

/* The time at the fraction c of the present step. */
static inline clock time_in(const work *w, coef c)
{
    if (!FACT(w, carried)) return TIME_FIXED(w, (clock)w->n, c);
    if (c == 0) return w->t;
    const clock t = w->t + (c * w->h + w->lost);
    return c == 1 ? CHOOSE_WHERE(w->ends, w->until, t) : t;
}

static inline clock time_now(const work *w) { return time_in(w, 0); }

/* The step is finished, for those trajectories that accepted it. */
static inline void time_tick(work *w, clock_mask good)
{
    if (NONE(good)) return;
    if (FACT(w, carried)) {
        const clock way = w->h + w->lost, sum = w->t + way;
        w->lost = CHOOSE_WHERE(good, ROUNDED_OFF(w->t, way, sum), w->lost);
        w->t = CHOOSE_WHERE(good, sum, w->t);
        if (!NONE(w->ends)) {
            w->lost = CHOOSE_WHERE(good & w->ends, 0, w->lost);
            w->t = CHOOSE_WHERE(good & w->ends, w->until, w->t);
        }
    }
    w->n = CHOOSE_WHERE(good, w->n + 1, w->n);
}

#ifndef accel_in
#define accel_in(w, i, x, v, a) accel(w, time_in(w, FACT(w, c)[i]), x, v, a)
#define accel_now(w, x, v, a) accel(w, time_now(w), x, v, a)
#endif

/* Tells whether the acceleration at the start of the step is known from an observation; counts it as used. KNOWN: a
 * compiled model may evaluate it again, to the same bits and at the same cost, so that its loop has one kind of
 * step. */
#ifndef KNOWN
#define KNOWN(w) ((w)->fresh)
#endif
static inline bool work_reuse(work *w)
{
    if (!KNOWN(w)) return false;
    w->fresh = false;
    w->evaluations += w->owed_evaluations;
    w->iterations += w->owed_iterations;
    return true;
}

/* Constants ------------------------------------------------------------------------------------------------------- */

/* The numbers that a plan needs memory for: unit, c and live; then `scaled` and `matrix`, which belong to a step
 * size. */
static inline size_t work_constants(const work *w)
{
    return (size_t)w->linears + (size_t)w->squares + (size_t)w->plains;
}
static inline size_t work_scaled_size(const work *w)
{
    return (size_t)w->linears + (size_t)w->squares + 2 * (size_t)w->solves * (size_t)w->solves;
}
static inline size_t work_live_size(const work *w) { return (work_constants(w) + sizeof(coef) - 1) / sizeof(coef); }
static inline size_t work_plan_size(const work *w)
{
    return work_constants(w) + (size_t)w->stages + work_live_size(w) + work_scaled_size(w);
}

/* The constants from number `from` on, `count` of them, should add up to h. Rounded, they do not, and since they are
 * rounded alike in every step, the motion would run too fast or too slow. What is missing goes to the smallest of them
 * but the first and the last, which represents it best, and by halves where it has a mirror image. */
static inline void work_fit(work *w, int from, int count)
{
    const coef *unit = w->unit + from;
    clock *c = w->scaled + from, missing = w->h, low = CLOCK(0);
    int first = 0, last = count - 1, least = 0;
    while (first < last && unit[first] == 0) first++;
    while (last > first && unit[last] == 0) last--;
    for (int i = first + 1; i < last; i++)
        if (unit[i] != 0 && (!least || unit[i] * unit[i] < unit[least] * unit[least])) least = i;
    for (int i = first; i <= last; i++) {
        clock error;
        ADD_COMPENSATED(missing, error, -c[i]);
        low += error;
    }
    const int mirror = first + last - least;
    if (!least) return;
    if (mirror == least || unit[mirror] != unit[least]) {
        c[least] += missing + low;
    } else {
        c[least] += (missing + low) / 2;
        c[mirror] = c[least];
    }
}

/* Kicks and drifts of a compensated splitting add up to h; the sums of the drifts, exact, in two numbers each. */
static inline void work_sums(work *w)
{
    const int count = FACT(w, summed);
    work_fit(w, 0, count);
    work_fit(w, count, count);
    clock *way = w->scaled + 2 * count + 1, *way_low = way + count, sum = CLOCK(0), low = CLOCK(0);
    for (int i = 0; i < count; i++) {
        clock error;
        ADD_COMPENSATED(sum, error, w->scaled[count + i]);
        low += error;
        way[i] = sum + low;
        way_low[i] = low - (way[i] - sum);
    }
}

/* The step is h from now on. */
static inline void work_scale(work *w, clock h)
{
    w->h = h;
    w->hh = h * h;
    w->half_hh = w->hh / 2;
    w->per_h = 1 / h;
    const int linears = FACT(w, linears), all = linears + FACT(w, squares);
    for (int i = 0; i < linears; i++) w->scaled[i] = w->unit[i] * w->h;
    for (int i = linears; i < all; i++) w->scaled[i] = w->unit[i] * w->hh;
    if (FACT(w, summed)) work_sums(w);
}

/* Memory ---------------------------------------------------------------------------------------------------------- */

/* Arrays, `stride` apart, handed out one after the other; memory NULL: only counted. */
typedef struct placing {
    real *memory;
    size_t stride, used;
} placing;

static inline real *work_array(placing *p, int count)
{
    real *array = p->memory ? p->memory + p->used * p->stride : p->memory;
    p->used += (size_t)count;
    return array;
}

/* Tells whether the row's workspace has this array; a compiled model knows. */
#ifndef PLACED
#define PLACED(w, name) ((w)->name)
#endif

/* What density.h needs besides xs and vs. */
static inline void work_density(work *w, placing *p)
{
    if (!ROW(w, density)) return;
    w->old = work_array(p, 1);
    w->dx = work_array(p, 1);
    w->dv = work_array(p, 1);
}

/* Copies the numbers of all arrays, of the stages those that are kept, from one workspace to another. */
static inline void work_move(work *to, const work *from, size_t count)
{
#define MOVE(name) \
    for (size_t k = 0; PLACED(to, name) && k < count; k++) to->name[k] = from->name[k]
    MOVE(x);
    MOVE(v);
    MOVE(a);
    MOVE(ex);
    MOVE(ev);
    MOVE(old);
    MOVE(next_x);
    MOVE(delta);
    MOVE(vs);
#undef MOVE
    for (int i = 0; i < FACT(to, kept); i++)
        for (size_t k = 0; k < count; k++) to->ks[(size_t)i * to->stride + k] = from->ks[(size_t)i * from->stride + k];
    /* the stages of the last step, for dense output */
    for (int i = 0; ROW(to, adaptive) && PLACED(to, ks) && i < FACT(to, stages) + FACT(to, ending); i++)
        for (size_t k = 0; k < count; k++) to->ks[(size_t)i * to->stride + k] = from->ks[(size_t)i * from->stride + k];
}

/* The arrays that lead from a step to the next: name_carry in families.def. */
enum { CARRY_MAX = 12 };
static inline int work_carry_main(const work *w, real *list[CARRY_MAX])
{
    int count = 0;
    list[count++] = w->x;
    list[count++] = w->v;
    if (ROW(w, compensated)) list[count++] = w->ex, list[count++] = w->ev;
    if (ROW(w, density)) list[count++] = w->old;
    return count;
}

/* Functions that several families share: the state is x and v as they are; the step has moved the state already; the
 * state needs no evaluation before it is observed. */
static inline int work_sync_main(work *w, real *x, real *v)
{
    EACH(k) x[k] = w->x[k];
    EACHV(k) v[k] = w->v[k];
    return STEP_OK;
}
static inline void step_is_final(work *w, clock_mask good) { (void)w, (void)good; }
static inline int state_is_complete(work *w) { return (void)w, STEP_OK; }
/* Dense output that needs nothing but the ends of the step. */
static inline dense_room dense_without(const work *w, coef *unit) { return (void)w, (void)unit, (dense_room){0}; }
static inline int dense_as_it_is(work *w, const dense_step *d) { return (void)w, (void)d, STEP_OK; }
