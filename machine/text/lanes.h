/* The last text of a compiled model in lanes: a block of trajectories starts, goes on, is looked at.
 *
 * Before it stand lanes_start, lanes_bind and lanes_looks, written for the model, and EVERY_GROUP(DO), DO(0) DO(1) …
 * for the groups of a block. Invariant: a lane never sees another; what a block needs between two calls lies in its
 * job. In between a block of a small model lives in registers and the first cache: each group takes its whole step,
 * and the processor overlaps the groups, whose chains of operations are strangers to one another. Of a row that
 * iterates the groups take their turns side by side, because a whole step is too long for the processor to look past.
 */
void motus_lanes_bind(const double *pool, const int64_t *q, double *u) { lanes_bind(pool, q, u); }

/* The numbers that all lanes share, `count` steps from job->plan.n on; room for LANES_OF_TIME more. */
void motus_lanes_table(const lanes_job *job, clock *table, whole count)
{
#if TERMS
    compiled_fill(&job->host, job->plan->t0, job->plan->h, table, job->plan->n, count);
#else
    (void)job, (void)table, (void)count;
#endif
}

static inline compiled_host lanes_host(const lanes_job *job, size_t group, bool factored)
{
    compiled_host host = job->host;
    host.own += group * job->own_size;
    host.bound += group * job->bound_size;
    solve_begin(&host, job, group, factored);
    return host;
}

static inline void lanes_place(work *w, const compiled_host *host, real *room)
{
    w->host = host;
    w->matrix = solve_coefficients(host);
    w->ex = w->ev = w->old = w->next_x = w->delta = w->r = w->xs = w->vs = w->ks = (real *)0;
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

/* From the values that vary to the state at the start. */
void motus_lanes_begin(const lanes_job *job)
{
    const work *w = job->plan;
    for (size_t group = 0; group < GROUPS; group++) {
        const compiled_host host = lanes_host(job, group, false);
        real *x = job->x + group * FACT(w, nx), *v = job->v + group * FACT(w, nv);
        lanes_start(job, &host, job->values + group * (size_t)job->value_count);
        EACH(k) x[k] = job->from_x[k] < 0 ? MANY(job->x0[k]) : host.own[job->from_x[k]];
        EACHV(k) v[k] = job->from_v[k] < 0 ? MANY(job->v0[k]) : host.own[job->from_v[k]];
        lanes_bind_lanes(&host);
#if BOUNDED
        BOUNDARY((&host), w->t0, x, v, (real *)0);
#endif
    }
}

/* A new leg from the state that was looked at, at the start of job->plan. */
void motus_lanes_set(const lanes_job *job)
{
    const work *w = job->plan;
    for (size_t group = 0; group < GROUPS; group++) {
        real *carry = job->carry + group * CARRIED * FACT(w, nv);
        for (int i = 0; i < CARRIED; i++)
            EACHV(k) carry[(size_t)i * FACT(w, nv) + k] = (real){0};
        EACH(k) carry[k] = job->x[group * FACT(w, nx) + k];
        EACHV(k) carry[FACT(w, nv) + k] = job->v[group * FACT(w, nv) + k];
    }
}

/* The workspaces of a block lie on the stack where their size is known, and not too large for that. */
#define LANES_LOCAL (NUMBERS > 0 && ARRAYS * NUMBERS * GROUPS <= 1024)

/* A workspace of one group in memory, after n steps. */
#if LANES_LOCAL
#define LANES_WORKSPACE(w, host, n_)                                                \
    work w##_ = *job->plan, *w = &w##_;                                             \
    real room[ARRAYS * NUMBERS];                                                    \
    w->stride = NUMBERS, w->n = (n_), w->table = job->table, w->first = job->first; \
    lanes_place(w, host, room);                                                     \
    lanes_load(w, job->carry + group * CARRIED * FACT(w, nv))
#else
#define LANES_WORKSPACE(w, host, n_)                              \
    work w##_ = *job->plan, *w = &w##_;                           \
    w->n = (n_), w->table = job->table, w->first = job->first;    \
    lanes_place(w, host, job->room + group * ARRAYS * w->stride); \
    lanes_load(w, job->carry + group * CARRIED * FACT(w, nv))
#endif

/* A step after n, from which constant matrices are factored; `keeps`: its end becomes the state. */
__attribute__((noinline)) static void lanes_step_once(const lanes_job *job, whole n, bool keeps)
{
    for (size_t group = 0; group < GROUPS; group++) {
        const compiled_host host = lanes_host(job, group, false);
        LANES_WORKSPACE(w, &host, n);
        family_step(w);
        time_tick(w, EVERY);
        if (keeps) lanes_store(w, job->carry + group * CARRIED * FACT(w, nv));
    }
}

/* The first step of all, for which some methods have a formula of its own. */
void motus_lanes_first(const lanes_job *job) { lanes_step_once(job, 0, true); }

/* What is recorded of a state: `all` of it, or what has to be seen on the way. */
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
        real *kept = job->kept + (group * RECORDS + i) * REDUCE_KEPT;
        if (first)
            reduce_first(kept, value, MANY(t));
        else
            reduce_next(kept, r->how, value, MANY(t));
    }
}

/* The state of a group as one sees it, and the quantities that are recorded. */
static inline void lanes_see(const lanes_job *job, work *w, const compiled_host *host, clock t, size_t group)
{
    real *x = job->x + group * FACT(w, nx), *v = job->v + group * FACT(w, nv), *out = job->out + group * job->out_size;
    real *a = job->a ? job->a + group * FACT(w, nv) : job->a;
    advance_sync(w, x, v, (real *)0);
    if (t != time_now(w)) refresh_at(w, t, x, v); /* the end is `until`, whatever t0 + n h comes to */
    if (a) accel(w, t, x, v, a);
    lanes_looks(host, t, x, v, a, out);
}

/* A look from outside the loop, at the present step of the plan; records nothing where record_count is 0. */
void motus_lanes_look(const lanes_job *job)
{
    const clock t = job->ends ? job->until : time_now(job->plan);
    for (size_t group = 0; group < GROUPS; group++) {
        const compiled_host host = lanes_host(job, group, false);
        LANES_WORKSPACE(w, &host, job->plan->n);
        lanes_see(job, w, &host, t, group);
        if (job->record_count)
            lanes_keep(job, job->x + group * FACT(w, nx), job->v + group * FACT(w, nv),
                       job->out + group * job->out_size, t, job->first_look, true, group);
    }
}

/* A look from within: positions are where they are, all else is worked out. */
static inline void lanes_look_within(const lanes_job *job, work *w, const compiled_host *host, clock t, size_t group)
{
#if SEES_VELOCITY
    lanes_see(job, w, host, t, group);
    lanes_keep(job, job->x + group * FACT(w, nx), job->v + group * FACT(w, nv), job->out + group * job->out_size, t,
               false, false, group);
#else
    (void)host;
    lanes_keep(job, w->x, w->v, (real *)0, t, false, false, group);
#endif
}

#if LANES_LOCAL
#define LANES_ROOM(g) real room_##g[ARRAYS * NUMBERS];
#else
#define LANES_ROOM(g) real *const room_##g = job->room + g * ARRAYS * w->stride;
#endif
#define LANES_HOST(g)                                            \
    compiled_host host_##g = lanes_host(job, g, SOLVE_CONSTANT); \
    SOLVE_NEAR(host_##g, solving_##g, lost_##g)
#define LANES_LOAD(g)                    \
    lanes_place(w, &host_##g, room_##g); \
    lanes_load(w, job->carry + g * CARRIED * FACT(w, nv));
#define LANES_STEP(g)                    \
    lanes_place(w, &host_##g, room_##g); \
    w->fresh = fresh;                    \
    family_step(w);
/* Of a row that iterates: the turns of all groups side by side, until all equations of all are solved. A group that
 * is done waits for the others; its lanes keep their values. */
#define LANES_ITERATION(g) implicit_iteration iteration_##g;
#define LANES_BEGIN(g)                   \
    lanes_place(w, &host_##g, room_##g); \
    w->fresh = fresh;                    \
    implicit_begin(w, &iteration_##g);
#define LANES_TURN(g)                    \
    lanes_place(w, &host_##g, room_##g); \
    implicit_turn(w, &iteration_##g);
#define LANES_OPEN(g) | iteration_##g.open
#define LANES_END(g)                     \
    lanes_place(w, &host_##g, room_##g); \
    implicit_end(w, &iteration_##g);
#define LANES_LOOK(g)                    \
    lanes_place(w, &host_##g, room_##g); \
    w->fresh = false;                    \
    lanes_look_within(job, w, &host_##g, time_now(w), g);
#define LANES_STORE(g)                                      \
    lanes_place(w, &host_##g, room_##g);                    \
    lanes_store(w, job->carry + g * CARRIED * FACT(w, nv)); \
    SOLVE_FAR(job, g, lost_##g)

/* `steps` more, not the first one, and a look after every `every` of them; every = 0: none. */
__attribute__((flatten)) void motus_lanes_run(const lanes_job *job, whole steps, whole every)
{
    work local = *job->plan, *w = &local;
    clock scaled[CONSTANTS + 1];
    bool fresh = false; /* the accelerations of all groups are known, because somebody looked */
#if LANES_LOCAL
    w->stride = NUMBERS;
#endif
    if (SOLVE_CONSTANT) lanes_step_once(job, job->plan->n, false);
    EVERY_GROUP(LANES_ROOM)
    EVERY_GROUP(LANES_HOST)
    EVERY_GROUP(LANES_LOAD)
    w->table = job->table;
    w->first = job->first;
    w->moved = 0;
    WRITTEN_OUT for (int i = 0; i < CONSTANTS; i++) scaled[i] = job->plan->scaled[i];
    w->scaled = scaled;
    while (steps > 0) {
        const whole some = every && every < steps ? every : steps;
        for (whole left = some; left > 0; left--) {
            if (w->n < 1) __builtin_unreachable();
#if ITERATES
            EVERY_GROUP(LANES_ITERATION)
            EVERY_GROUP(LANES_BEGIN)
            EVERY_GROUP(LANES_TURN) /* by itself: in the first turn all are open, and nothing is compared */
            while (iteration_0.turns < NEWTON_MAX && SOME(NEVER EVERY_GROUP(LANES_OPEN))) { EVERY_GROUP(LANES_TURN) }
            EVERY_GROUP(LANES_END)
#else
            EVERY_GROUP(LANES_STEP)
#endif
            time_tick(w, EVERY);
            fresh = false;
        }
        steps -= some;
#if LOOKING
        if (every) {
            EVERY_GROUP(LANES_LOOK)
            fresh = SEES_VELOCITY && FACT(w, waits);
        }
#endif
    }
    EVERY_GROUP(LANES_STORE)
}
