/* The last text of a compiled model in lanes: a block of trajectories starts, goes on, is observed.
 *
 * Included after lanes_start, lanes_bind and lanes_quantities, which are written for the model, and EVERY_GROUP(DO),
 * DO(0) DO(1) … for the groups of a block.
 *
 * Invariant: a lane never sees another; what a block needs between two calls lies in its job. In between a block of a
 * small model lives in registers and the first cache: each group takes its whole step, and the processor overlaps the
 * groups, whose operations are independent. With a row that iterates, the groups take their turns side by side, because
 * a whole step is too long for the processor to overlap.
 *
 * OWN_CLOCK: every lane has its own time and step. Those of an adaptive row accept their candidates one by one; those
 * of a row of fixed steps take as many steps as the library knows that all of them have to take.
 */
void motus_lanes_bind(const double *pool, const int64_t *q, double *u) { lanes_bind(pool, q, u); }

/* Tabulates the numbers that all lanes share, for `count` steps from job->n on; room for LANES_OF_TIME more. */
void motus_lanes_table(const lanes_job *job, double *table, whole count)
{
#if TERMS
    compiled_fill(&job->host, job->t0, job->h, table, job->n, count);
#else
    (void)job, (void)table, (void)count;
#endif
}

/* ---- a group: its host, its workspace, its arrays ---- */

static inline compiled_host lanes_host(const lanes_job *job, size_t group, bool factored)
{
    compiled_host host = job->host;
    host.own += group * job->own_size;
    host.bound += group * job->bound_size;
    host.begins = job->begins;
    host.lost = job->lost + group;
    if (!factored) *host.lost = MANY(0.0);
    solve_begin(&host, job, group, factored);
    return host;
}

/* Sets the clock of a group: time, steps taken, and the row's constants for the present step; `scaled` is room for
 * them. */
static inline void lanes_clock(work *w, const lanes_job *job, size_t group, clock *scaled)
{
    w->scaled = scaled;
    w->unit = fact_unit;
    w->c = fact_c;
#if OWN_CLOCK
    const real *own = job->clocks + group * LANES_CLOCKS;
    w->t0 = own[LANES_T0], w->n = own[LANES_N];
    w->t = own[LANES_T], w->lost = own[LANES_LOST], w->next = own[LANES_NEXT], w->until = own[LANES_UNTIL];
    w->before = own[LANES_BEFORE], w->rise = own[LANES_RISE];
    w->shortest = own[LANES_SHORTEST], w->longest = own[LANES_LONGEST], w->refused = own[LANES_REFUSED];
    w->span = own[LANES_SPAN];
    w->relative = CLOCK(job->relative), w->absolute = CLOCK(job->absolute);
    w->least = CLOCK(job->least), w->most = CLOCK(job->most);
    w->variables = job->variables, w->variable = job->variable;
    work_scale(w, own[LANES_H]);
#else
    (void)group;
    w->t0 = job->t0, w->n = job->n;
    w->table = job->table, w->first = job->first_row;
    work_scale(w, job->h);
#endif
}

static inline void lanes_place(work *w, const compiled_host *host, real *room)
{
    w->host = host;
    w->matrix = solve_coefficients(host);
    w->ex = w->ev = w->old = w->next_x = w->delta = w->r = w->xs = w->vs = w->ks = w->dx = w->dv = (real *)0;
    w->low = w->us = (real *)0;
    work_place(w, room);
}

static inline void lanes_load(work *w, const real *carry)
{
    real *list[CARRY_MAX];
    int count = family_carry(w, list);
    for (int i = 0; i < count; i++)
        EACHV(k) list[i][k] = carry[(size_t)i * FACT(w, nv) + k];
}

static inline void lanes_store(work *w, real *carry)
{
    real *list[CARRY_MAX];
    int count = family_carry(w, list);
    for (int i = 0; i < count; i++)
        EACHV(k) carry[(size_t)i * FACT(w, nv) + k] = list[i][k];
}

/* A workspace without arrays: sizes alone. */
#define LANES_SIZES(w)                                            \
    const work w##_ = {.nx = job->nx, .nv = job->nv}, *w = &w##_; \
    (void)w

/* The arrays of a block lie on the stack where their size is known, and not too large for that. */
#define LANES_LOCAL (NUMBERS > 0 && ARRAYS * NUMBERS * GROUPS <= 1024)
#if LANES_LOCAL
#define LANES_STRIDE NUMBERS
#define LANES_ROOM(g) real room_##g[ARRAYS * NUMBERS];
#else
#define LANES_STRIDE job->stride
#define LANES_ROOM(g) real *const room_##g = job->room + g * ARRAYS * job->stride;
#endif
#define LANES_NEW(w) work w = {.nx = job->nx, .nv = job->nv, .stride = LANES_STRIDE}

/* A workspace of one group, whose number is `group`. */
#define LANES_WORKSPACE(w, host)        \
    LANES_NEW(w##_);                    \
    work *const w = &w##_;              \
    clock scaled[CONSTANTS + 1];        \
    LANES_ROOM(group)                   \
    lanes_clock(w, job, group, scaled); \
    lanes_place(w, host, room_group);   \
    lanes_load(w, job->carry + group * CARRIED * FACT(w, nv))

/* Tells whether a number is NaN or as large as `limit`, which may be infinite. */
int motus_lanes_far(const real *numbers, size_t count, double limit)
{
    mask far = NEVER;
    for (size_t k = 0; k < count; k++)
        far = far | (numbers[k] >= limit) | (numbers[k] <= -limit) | (numbers[k] != numbers[k]);
    return SOME(far);
}

/* ---- a leg begins ---- */

/* Computes the state at the start from the values that vary. */
void motus_lanes_begin(const lanes_job *job)
{
    LANES_SIZES(w);
    for (size_t group = 0; group < GROUPS; group++) {
        const compiled_host host = lanes_host(job, group, false);
        real *x = job->x + group * FACT(w, nx), *v = job->v + group * FACT(w, nv);
        lanes_start(job, &host, job->values + group * (size_t)job->value_count);
        EACH(k) x[k] = job->from_x[k] < 0 ? MANY(job->x0[k]) : host.own[job->from_x[k]];
        EACHV(k) v[k] = job->from_v[k] < 0 ? MANY(job->v0[k]) : host.own[job->from_v[k]];
        lanes_bind_lanes(&host);
#if BOUNDED && OWN_CLOCK
        BOUNDARY((&host), job->clocks[group * LANES_CLOCKS + LANES_T0], x, v, (real *)0);
#elif BOUNDED
        BOUNDARY((&host), job->t0, x, v, (real *)0);
#endif
    }
}

/* Computes what the steps carry from the state that was observed. */
void motus_lanes_set(const lanes_job *job)
{
    LANES_SIZES(w);
    for (size_t group = 0; group < GROUPS; group++) {
        real *carry = job->carry + group * CARRIED * FACT(w, nv);
        for (int i = 0; i < CARRIED; i++)
            EACHV(k) carry[(size_t)i * FACT(w, nv) + k] = (real){0};
        EACH(k) carry[k] = job->x[group * FACT(w, nx) + k];
        EACHV(k) carry[FACT(w, nv) + k] = job->v[group * FACT(w, nv) + k];
    }
}

/* ---- observations ---- */

/* Records a state: `all` of it, or only the records that need observations on the way. */
static inline void lanes_keep(const lanes_job *job, const real *x, const real *v, const real *out, clock t, bool first,
                              bool all, size_t group)
{
    WRITTEN_OUT_RECORDS for (size_t i = 0; i < RECORDS; i++)
    {
        const lanes_record *r = &the_records[i];
        if (!all && r->how == REDUCE_FINAL) continue;
        const real value = r->from == LANES_X     ? x[r->element]
                           : r->from == LANES_V   ? v[r->element]
                           : r->from == LANES_OUT ? out[r->element]
                                                  : MANY(t);
        real *kept = job->kept + (group * RECORDS + i) * REDUCE_KEPT, now[REDUCE_KEPT] = {kept[0], kept[1]};
        if (first)
            reduce_first(now, value, MANY(t));
        else
            reduce_next(now, r->how, value, MANY(t));
#if OWN_CLOCK
        const mask where = job->where[group] != 0;
        for (int k = 0; k < REDUCE_KEPT; k++) kept[k] = PICK(where, now[k], kept[k]);
#else
        for (int k = 0; k < REDUCE_KEPT; k++) kept[k] = now[k];
#endif
    }
}

/* Returns the time of an observation from outside the loop: at the end it is `until`, whatever t0 + n h is. */
static inline clock lanes_time(const lanes_job *job, const work *w, size_t group)
{
#if OWN_CLOCK
    const mask ends = job->ends ? job->where[group] != 0 : NEVER;
    return PICK(ends, job->clocks[group * LANES_CLOCKS + LANES_UNTIL], time_now(w));
#else
    (void)group;
    return job->ends ? job->until : time_now(w);
#endif
}

/* Computes the state of a group as it is observed, and the quantities that are recorded. */
static inline void lanes_see(const lanes_job *job, work *w, const compiled_host *host, clock t, size_t group)
{
    real *x = job->x + group * FACT(w, nx), *v = job->v + group * FACT(w, nv), *out = job->out + group * job->out_size;
    real *a = job->a ? job->a + group * FACT(w, nv) : job->a;
    advance_sync(w, x, v, (real *)0);
#if OWN_CLOCK
    if (job->ends) refresh_at(w, t, x, v);
#else
    if (t != time_now(w)) refresh_at(w, t, x, v);
#endif
    if (a) accel(w, t, x, v, a);
    lanes_quantities(host, t, x, v, a, out);
}

/* Observes from outside the loop; records nothing where record_count is 0. */
void motus_lanes_observe(const lanes_job *job)
{
    for (size_t group = 0; group < GROUPS; group++) {
        const compiled_host host = lanes_host(job, group, false);
        LANES_WORKSPACE(w, &host);
        const clock t = lanes_time(job, w, group);
        lanes_see(job, w, &host, t, group);
        if (job->record_count)
            lanes_keep(job, job->x + group * FACT(w, nx), job->v + group * FACT(w, nv),
                       job->out + group * job->out_size, t, job->first_observation, true, group);
    }
}

/* Observes from within the loop: takes positions from the workspace, and computes all else. */
static inline void lanes_observe_within(const lanes_job *job, work *w, const compiled_host *host, size_t group)
{
    const clock t = time_now(w);
#if SEES_VELOCITY
    lanes_see(job, w, host, t, group);
    lanes_keep(job, job->x + group * FACT(w, nx), job->v + group * FACT(w, nv), job->out + group * job->out_size, t,
               false, false, group);
#else
    (void)host;
    lanes_keep(job, w->x, w->v, (real *)0, t, false, false, group);
#endif
}

/* ---- steps ---- */

#if OWN_CLOCK
static inline void lanes_put_clock(const work *w, real *own)
{
    own[LANES_N] = w->n, own[LANES_H] = w->h;
    own[LANES_T] = w->t, own[LANES_LOST] = w->lost, own[LANES_NEXT] = w->next;
    own[LANES_BEFORE] = w->before, own[LANES_RISE] = w->rise;
    own[LANES_SHORTEST] = w->shortest, own[LANES_LONGEST] = w->longest, own[LANES_REFUSED] = w->refused;
    own[LANES_SPAN] = w->span;
}
#define lanes_store_clock(w, job, group) lanes_put_clock(w, (job)->clocks + (group)*LANES_CLOCKS)
#else
#define lanes_store_clock(w, job, group) ((void)0)
#endif

/* Takes one step, which factors constant matrices. keeps: its end becomes the state. */
__attribute__((noinline)) static void lanes_step_once(const lanes_job *job, bool begins, bool keeps)
{
    for (size_t group = 0; group < GROUPS; group++) {
        compiled_host host = lanes_host(job, group, false);
        host.begins = begins;
        LANES_WORKSPACE(w, &host);
        family_step(w);
        time_tick(w, EVERY);
        host.begins = false;
        if (!keeps) continue;
        lanes_store(w, job->carry + group * CARRIED * FACT(w, nv));
        lanes_store_clock(w, job, group);
    }
}

/* Takes the first step of all, for which some methods have a formula of its own. */
void motus_lanes_first(const lanes_job *job) { lanes_step_once(job, true, true); }

#define LANES_HOST(g)                                            \
    compiled_host host_##g = lanes_host(job, g, SOLVE_CONSTANT); \
    SOLVE_NEAR(host_##g, solving_##g, lost_##g)
#if OWN_CLOCK
/* Prepares a workspace for every group. */
#define LANES_PREPARE(g)                                           \
    LANES_NEW(work_##g);                                           \
    clock scaled_##g[CONSTANTS + 1];                               \
    lanes_clock(&work_##g, job, g, scaled_##g);                    \
    host_##g.begins = false;                                       \
    lanes_place(&work_##g, &host_##g, room_##g);                   \
    lanes_load(&work_##g, job->carry + g * CARRIED * FACT(w, nv)); \
    lanes_recall(&work_##g, job, g);
#define LANES_SELECT(g) work *const w = &work_##g;
#define LANES_TICK ((void)0)
#else
/* Prepares the one workspace of all groups, whose arrays change from group to group. */
#define LANES_PREPARE(g)                 \
    lanes_place(w, &host_##g, room_##g); \
    lanes_load(w, job->carry + g * CARRIED * FACT(w, nv));
#define LANES_SELECT(g) lanes_place(w, &host_##g, room_##g);
#define LANES_TICK time_tick(w, EVERY)
#endif
/* Take the accelerations that the call before has left, and leave those for the next one, if steps adapt. */
static inline void lanes_recall(work *w, const lanes_job *job, size_t group)
{
    if (!ROW_adaptive || !job->known || !job->fresh[group]) return;
    EACHV(k) w->a[k] = job->known[group * FACT(w, nv) + k];
    w->fresh = true;
}

static inline void lanes_remember(const work *w, const lanes_job *job, size_t group)
{
    if (!ROW_adaptive || !job->known) return;
    job->fresh[group] = w->fresh;
    if (w->fresh)
        EACHV(k) job->known[group * FACT(w, nv) + k] = w->a[k];
}

#if WATCHED
/* The ends of the latest step of a group: numbers of its own, or those of the workspace. */
typedef struct lanes_ends {
    clock span;
    const real *from_x, *from_v, *to_x, *to_v;
} lanes_ends;

/* Returns the `good` lanes in whose latest step something may have happened. job->bounds: bounds on the accelerations
 * within it. */
static inline mask lanes_open(const lanes_job *job, const work *w, const compiled_host *host, const lanes_ends *of,
                              mask good, size_t group)
{
    const size_t nx = FACT(w, nx), nv = FACT(w, nv);
    real *largest = job->largest + group * (nx + nv);
    real x[NUMBERS], v[NUMBERS], dx[NUMBERS], dv[NUMBERS], least[BOUNDS];
    const box in = {x, v, dx, dv};
    const clock t = time_now(w), past = (t - job->clocks[group * LANES_CLOCKS + LANES_EVENT]) * w->h;
    mask open = past >= -8 * EPSILON * ABS(t) * ABS(w->h);
    box_of(&in, nx, nv, of->span, of->from_x, of->from_v, of->to_x, of->to_v, job->bounds + group * nv);
    compiled_least(host->pool, host->q, host->u, host->bound, host->own, CLOCK(0), (const clock *)0, x, v, (real *)0,
                   least, dx, dv);
    for (size_t f = 0; f < BOUNDS; f++) open = open | NOT(least[f] > 0);
    EACH(k) largest[k] = LARGER(ABS(of->from_x[k]), largest[k]);
    EACHV(k) largest[nx + k] = LARGER(ABS(of->from_v[k]), largest[nx + k]);
    open = open & good;
    job->met[group] = PICK(open, MANY(1.0), MANY(0.0));
    return open;
}

static inline void lanes_keep_before(const lanes_job *job, work *w, size_t group)
{
    lanes_store(w, job->before + group * CARRIED * FACT(w, nv));
    lanes_put_clock(w, job->before_clocks + group * LANES_CLOCKS);
}

#if ROW_adaptive
/* Does for lanes what step/watch.h does for one trajectory. The first stage is read before the step begins, where the
 * last stage takes its place. */
static inline void lanes_watch_begin(const lanes_job *job, work *w, size_t group)
{
    real *most = job->bounds + group * FACT(w, nv);
    const bool first = !FACT(w, expands) && control_last_is_first(w);
    lanes_keep_before(job, w, group);
    if (first && !w->fresh) {
        (void)control_begin(w);
        control_known(w, EVERY);
    }
    EACHV(k) most[k] = first ? ABS(w->a[k]) : MANY(0.0);
}

/* Returns the lanes whose candidate was accepted and in whose step something may have happened. */
static inline mask lanes_watch_ends(const lanes_job *job, work *w, const compiled_host *host, size_t group)
{
    const real *from = job->before + group * CARRIED * FACT(w, nv), *clocks = job->before_clocks + group * LANES_CLOCKS;
    const clock span = (w->t - clocks[LANES_T]) + (w->lost - clocks[LANES_LOST]);
    (void)family_swing(w, job->bounds + group * FACT(w, nv));
    return lanes_open(job, w, host, &(lanes_ends){span, from, from + FACT(w, nv), w->x, w->v}, w->n > clocks[LANES_N],
                      group);
}
#define LANES_WATCH(g) lanes_watch_begin(job, w, g)
#else
/* Observes the state at the start of a fixed step, unless it is `known` as the end of the step before. */
static inline void lanes_watch_begin(const lanes_job *job, work *w, size_t group, bool known)
{
    const size_t nx = FACT(w, nx), nv = FACT(w, nv), numbers = nx + 2 * nv;
    real *from = job->shown + 2 * group * numbers, *to = from + numbers;
    lanes_keep_before(job, w, group);
    if (known)
        for (size_t k = 0; k < numbers; k++) from[k] = to[k];
    else
        advance_sync(w, from, from + nx, from + nx + nv);
}

static inline mask lanes_watch_ends(const lanes_job *job, work *w, const compiled_host *host, size_t group)
{
    const size_t nx = FACT(w, nx), nv = FACT(w, nv), numbers = nx + 2 * nv;
    real *from = job->shown + 2 * group * numbers, *to = from + numbers;
    advance_sync(w, to, to + nx, to + nx + nv);
    swing_of_ends(nx, nv, w->h, from, from + nx, from + nx + nv, to, to + nx, to + nx + nv, job->bounds + group * nv);
    return lanes_open(job, w, host, &(lanes_ends){w->h, from, from + nx, to, to + nx}, ALWAYS, group);
}
#define LANES_WATCH(g) lanes_watch_begin(job, w, g, watched)
#endif
#define LANES_MET(g) mask met_##g = NEVER;
#define LANES_WATCHED(g) met_##g = lanes_watch_ends(job, w, &host_##g, g)
#define LANES_OPEN_TO(g) met_##g
#else
#define LANES_MET(g)
#define LANES_WATCH(g) ((void)0)
#define LANES_WATCHED(g) ((void)0)
#define LANES_OPEN_TO(g) NEVER
#endif

/* In an adaptive row, and where steps are watched, w->fresh tells whether the accelerations of a group are known. */
#define LANES_FRESH(w) ((void)(ROW_adaptive || WATCHED || ((w)->fresh = fresh)))
#if ROW_adaptive
#define LANES_ADVANCE(w) advance_step(w)
#elif OWN_CLOCK
#define LANES_ADVANCE(w) (family_step(w), time_tick(w, EVERY))
#else
#define LANES_ADVANCE(w) family_step(w)
#endif
#define LANES_STEP(g)     \
    {                     \
        LANES_SELECT(g)   \
        LANES_FRESH(w);   \
        LANES_WATCH(g);   \
        LANES_ADVANCE(w); \
        LANES_WATCHED(g); \
    }
/* Where a row iterates, all groups take their turns side by side until all equations are solved. A group that is done
 * waits for the others; its lanes keep their values. */
#define LANES_ITERATION(g) implicit_iteration iteration_##g;
#define LANES_BEGIN(g)                     \
    {                                      \
        LANES_SELECT(g)                    \
        w->fresh = fresh;                  \
        implicit_begin(w, &iteration_##g); \
    }
#define LANES_TURN(g)                     \
    {                                     \
        LANES_SELECT(g)                   \
        implicit_turn(w, &iteration_##g); \
    }
#define LANES_OPEN(g) | iteration_##g.open
#define LANES_END(g)                        \
    {                                       \
        LANES_SELECT(g)                     \
        implicit_end(w, &iteration_##g);    \
        if (OWN_CLOCK) time_tick(w, EVERY); \
    }
#define LANES_OBSERVE(g)                            \
    {                                               \
        LANES_SELECT(g)                             \
        w->fresh = false;                           \
        lanes_observe_within(job, w, &host_##g, g); \
    }
#define LANES_STORE(g)                                          \
    {                                                           \
        LANES_SELECT(g)                                         \
        lanes_store(w, job->carry + g * CARRIED * FACT(w, nv)); \
        lanes_store_clock(w, job, g);                           \
        lanes_remember(w, job, g);                              \
    }                                                           \
    SOLVE_FAR(job, g, lost_##g)

/* Adaptive or watched: adds to `due` the lanes that have taken their steps, are at their end, cannot go on, or in whose
 * step something may have happened. */
#define LANES_DUE(g)                                                                                              \
    {                                                                                                             \
        const real *own = job->clocks + g * LANES_CLOCKS;                                                         \
        const mask here = work_##g.until == work_##g.until,                                                       \
                   ends = ROW_adaptive ? work_##g.t == work_##g.until : NEVER;                                    \
        due = due | (here & ((work_##g.n == own[LANES_STOP]) | ends | (*host_##g.lost != 0) | LANES_OPEN_TO(g))); \
    }

/* Takes `steps` more steps, not the first one, and observes after every `every` of them; every = 0: never. Adaptive:
 * takes up to `steps` candidates. */
__attribute__((flatten)) void motus_lanes_run(const lanes_job *job, whole steps, whole every)
{
    bool fresh = false; /* the accelerations of all groups are known, from an observation */
    if (SOLVE_CONSTANT) lanes_step_once(job, false, false);
    EVERY_GROUP(LANES_ROOM)
    EVERY_GROUP(LANES_HOST)
#if OWN_CLOCK
    LANES_SIZES(w);
#else
    LANES_NEW(local);
    work *const w = &local;
    clock scaled[CONSTANTS + 1];
    lanes_clock(w, job, 0, scaled);
#endif
    EVERY_GROUP(LANES_PREPARE)
    EVERY_GROUP(LANES_MET)
#if WATCHED
    bool watched = false; /* this call has taken a step */
#endif
    while (steps > 0) {
        const whole some = every && every < steps ? every : steps;
        for (whole left = some; left > 0; left--) {
#if !OWN_CLOCK
            if (w->n < 1) __builtin_unreachable();
#endif
#if ITERATES
            EVERY_GROUP(LANES_ITERATION)
            EVERY_GROUP(LANES_BEGIN)
            EVERY_GROUP(LANES_TURN) /* apart from the loop: in the first turn all are open, and nothing is compared */
            while (implicit_more(&iteration_0, NEVER EVERY_GROUP(LANES_OPEN))) { EVERY_GROUP(LANES_TURN) }
            EVERY_GROUP(LANES_END)
#else
            EVERY_GROUP(LANES_STEP)
#endif
            LANES_TICK;
            fresh = false;
#if WATCHED
            watched = true;
#endif
#if ROW_adaptive || WATCHED
            mask due = NEVER;
            EVERY_GROUP(LANES_DUE)
            if (SOME(due)) break;
#endif
        }
        steps -= some;
#if LOOKING
        if (every) {
            EVERY_GROUP(LANES_OBSERVE)
            fresh = SEES_VELOCITY && FACT(w, waits);
        }
#endif
    }
    EVERY_GROUP(LANES_STORE)
}
