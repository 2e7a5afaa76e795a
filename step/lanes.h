/* The last text of a compiled model in lanes: a block of trajectories starts, goes on, is looked at.
 *
 * Before it stand lanes_start, lanes_bind and lanes_looks, written for the model, and EVERY_GROUP(DO), DO(0) DO(1) … for the groups of a block.
 * Invariant: a lane never sees another; what a block needs between two calls lies in its job. In between a block of a small model lives in
 * registers and the first cache: each group takes its whole step, and the processor overlaps the groups, whose chains of operations are
 * strangers to one another.
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

static inline compiled_host lanes_host(const lanes_job *job, size_t group)
{
    compiled_host host = job->host;
    host.own += group * job->own_size;
    host.bound += group * job->bound_size;
    return host;
}

static inline void lanes_place(work *w, const compiled_host *host, real *room)
{
    w->user = (void *)host;
    w->ex = w->ev = w->old = w->next = w->delta = w->r = w->xs = w->vs = w->ks = (real *)0;
    work_place(w, room);
}

static inline void lanes_load(work *w, const real *carry)
{
    real *list[CARRY_MAX];
    int count = work_carry(w, list);
    for (int i = 0; i < count; i++) EACHV(k) list[i][k] = carry[(size_t)i * FACT(w, nv) + k];
}

static inline void lanes_store(work *w, real *carry)
{
    real *list[CARRY_MAX];
    int count = work_carry(w, list);
    for (int i = 0; i < count; i++) EACHV(k) carry[(size_t)i * FACT(w, nv) + k] = list[i][k];
}

/* From the values that vary to the state at the start. */
void motus_lanes_begin(const lanes_job *job)
{
    const work *w = job->plan;
    for (size_t group = 0; group < GROUPS; group++) {
        const compiled_host host = lanes_host(job, group);
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
        for (int i = 0; i < CARRIED; i++) EACHV(k) carry[(size_t)i * FACT(w, nv) + k] = (real){0};
        EACH(k) carry[k] = job->x[group * FACT(w, nx) + k];
        EACHV(k) carry[FACT(w, nv) + k] = job->v[group * FACT(w, nv) + k];
    }
}

/* A workspace of one group in memory, after n steps. */
#if LANES_LOCAL
#define LANES_WORKSPACE(w, host, n_)                                                    \
    work w##_ = *job->plan, *w = &w##_;                                                  \
    real room[ARRAYS * NUMBERS];                                                        \
    w->stride = NUMBERS, w->n = (n_), w->table = job->table, w->first = job->first;     \
    lanes_place(w, host, room);                                                         \
    lanes_load(w, job->carry + group * CARRIED * FACT(w, nv))
#else
#define LANES_WORKSPACE(w, host, n_)                                                    \
    work w##_ = *job->plan, *w = &w##_;                                                  \
    w->n = (n_), w->table = job->table, w->first = job->first;                          \
    lanes_place(w, host, job->room + group * ARRAYS * w->stride);                       \
    lanes_load(w, job->carry + group * CARRIED * FACT(w, nv))
#endif

/* The first step of all, for which some methods have a formula of its own. */
void motus_lanes_first(const lanes_job *job)
{
    for (size_t group = 0; group < GROUPS; group++) {
        const compiled_host host = lanes_host(job, group);
        LANES_WORKSPACE(w, &host, 0);
        advance_step(w);
        w->n++;
        lanes_store(w, job->carry + group * CARRIED * FACT(w, nv));
    }
}

/* The look at one group, after n steps. */
__attribute__((noinline)) static void lanes_look(const lanes_job *job, whole n, clock t, bool first, size_t group)
{
    const compiled_host host = lanes_host(job, group);
    LANES_WORKSPACE(w, &host, n);
    real *x = job->x + group * FACT(w, nx), *v = job->v + group * FACT(w, nv), *out = job->out + group * job->out_size;
    real *a = job->a ? job->a + group * FACT(w, nv) : job->a;
    advance_sync(w, x, v, (real *)0);
    if (t != time_of(w, n)) refresh_at(w, t, x, v);         /* the end is `until`, whatever t0 + n h comes to */
    if (a) accel(w, t, x, v, a);
    lanes_looks(&host, t, x, v, a, out);
    for (whole i = 0; i < job->record_count; i++) {
        const lanes_record *r = &job->records[i];
        const real value = r->from == LANES_X ? x[r->element] : r->from == LANES_V ? v[r->element] : r->from == LANES_OUT ? out[r->element] : MANY(t);
        real *kept = job->kept + (group * (size_t)job->record_count + (size_t)i) * REDUCE_KEPT;
        if (first) reduce_first(kept, value, MANY(t));
        else reduce_next(kept, r->how, value, MANY(t));
    }
}

#if LANES_LOCAL
#define LANES_ROOM(g) real room_##g[ARRAYS * NUMBERS];
#else
#define LANES_ROOM(g) real *const room_##g = job->room + g * ARRAYS * w->stride;
#endif
#define LANES_HOST(g) const compiled_host host_##g = lanes_host(job, g);
#define LANES_LOAD(g) lanes_place(w, &host_##g, room_##g); lanes_load(w, job->carry + g * CARRIED * FACT(w, nv));
#define LANES_STEP(g) lanes_place(w, &host_##g, room_##g); advance_step(w);
#define LANES_STORE(g) lanes_place(w, &host_##g, room_##g); lanes_store(w, job->carry + g * CARRIED * FACT(w, nv));

/* `steps` more, not the first one, and a look after every `every` of them (0: none; the last is a look in any case then). */
__attribute__((flatten)) void motus_lanes_run(const lanes_job *job, whole steps, whole every)
{
    work local = *job->plan, *w = &local;
#if LANES_LOCAL
    w->stride = NUMBERS;
#endif
    EVERY_GROUP(LANES_ROOM)
    EVERY_GROUP(LANES_HOST)
    EVERY_GROUP(LANES_LOAD)
    w->table = job->table;
    w->first = job->first;
    w->fresh = false;
    bool first = job->first_look;
    do {
        for (whole some = every && every < steps ? every : steps; some > 0; some--) {
            if (w->n < 1) __builtin_unreachable();
            EVERY_GROUP(LANES_STEP)
            w->n++;
            steps--;
        }
        EVERY_GROUP(LANES_STORE)
        for (size_t group = 0; every && group < GROUPS; group++)
            lanes_look(job, w->n, job->ends && steps <= 0 ? job->until : time_of(w, w->n), first, group);
        first = false;
    } while (steps > 0);
}
