/* The last text of a compiled model in lanes: a block of trajectories starts, goes on, is looked at.
 *
 * Before it stand lanes_start, lanes_bind and lanes_looks, written for the model. Invariant: a lane never sees another; what a block needs
 * between two calls lies in its job, and a block of a small model lives in registers in between.
 */
void motus_lanes_bind(const double *pool, const int64_t *q, double *u) { lanes_bind(pool, q, u); }

/* The numbers that all lanes share, `count` steps from job->plan.n on; room for LANES_OF_TIME more. */
void motus_lanes_table(const lanes_job *job, clock *table, whole count)
{
#if TERMS
    for (whole n = 0; n < count; n += LANES_OF_TIME)
        compiled_fill(&job->plan, &job->host, table + n * MOMENTS * TERMS, job->plan.n + n);
#else
    (void)job, (void)table, (void)count;
#endif
}

static inline void lanes_place(work *w, const lanes_job *job, real *room)
{
    w->user = (void *)&job->host;
    w->ex = w->ev = w->old = w->next = w->delta = w->r = w->xs = w->vs = w->ks = (real *)0;
    work_place(w, room);
}

static inline void lanes_load(work *w, const lanes_job *job)
{
    real *list[CARRY_MAX];
    int count = work_carry(w, list);
    for (int i = 0; i < count; i++) EACHV(k) list[i][k] = job->carry[(size_t)i * FACT(w, nv) + k];
}

static inline void lanes_store(work *w, const lanes_job *job)
{
    real *list[CARRY_MAX];
    int count = work_carry(w, list);
    for (int i = 0; i < count; i++) EACHV(k) job->carry[(size_t)i * FACT(w, nv) + k] = list[i][k];
}

/* From the values that vary to the state at the start. */
void motus_lanes_begin(const lanes_job *job)
{
    const compiled_host *host = &job->host;
    const work *w = &job->plan;
    real *x = job->x, *v = job->v;
    lanes_start(job, host);
    for (size_t k = 0; k < FACT(w, nx) / GROUPS; k++)
        for (int g = 0; g < GROUPS; g++)
            x[k * GROUPS + (size_t)g] = job->from_x[k] < 0 ? MANY(job->x0[k]) : host->own[job->from_x[k] * GROUPS + g];
    for (size_t k = 0; k < FACT(w, nv) / GROUPS; k++)
        for (int g = 0; g < GROUPS; g++)
            v[k * GROUPS + (size_t)g] = job->from_v[k] < 0 ? MANY(job->v0[k]) : host->own[job->from_v[k] * GROUPS + g];
    lanes_bind_lanes(host);
#if BOUNDED
    BOUNDARY(host, w->t0, x, v, (real *)0);
#endif
}

/* A new leg from the state that was looked at, at the start of job->plan. */
void motus_lanes_set(const lanes_job *job)
{
    const work *w = &job->plan;
    for (int i = 0; i < CARRY_MAX; i++) EACHV(k) job->carry[(size_t)i * FACT(w, nv) + k] = (real){0};
    EACH(k) job->carry[k] = job->x[k];
    EACHV(k) job->carry[FACT(w, nv) + k] = job->v[k];
}

static inline real lanes_number(const lanes_job *job, const lanes_record *r, clock t, int g)
{
    return r->from == LANES_X ? job->x[r->element * GROUPS + g] : r->from == LANES_V ? job->v[r->element * GROUPS + g]
         : r->from == LANES_OUT ? job->out[r->element * GROUPS + g] : MANY(t);
}

static inline void lanes_look(work *w, const lanes_job *job, clock t, bool first)
{
    advance_sync(w, job->x, job->v, (real *)0);
    if (t != time_of(w, w->n)) refresh_at(w, t, job->x, job->v);         /* the end is `until`, whatever t0 + n h comes to */
    if (job->a) accel(w, t, job->x, job->v, job->a);
    lanes_looks(host_of(w), t, job->x, job->v, job->a, job->out);
    for (int i = 0; i < job->record_count; i++)
        for (int g = 0; g < GROUPS; g++) {
            const lanes_record *r = &job->records[i];
            real *kept = job->kept + (i * GROUPS + g) * REDUCE_KEPT, value = lanes_number(job, r, t, g);
            if (first) reduce_first(kept, value, MANY(t));
            else reduce_next(kept, r->how, value, MANY(t));
        }
}

/* `steps` more, and a look after every `every` of them (0: none; the last is a look in any case then). */
__attribute__((flatten)) void motus_lanes_run(const lanes_job *job, whole steps, whole every)
{
    work local = job->plan, *w = &local;
#if SMALL
    real room[ARRAYS * NUMBERS];
    w->stride = NUMBERS;
    lanes_place(w, job, room);
#else
    lanes_place(w, job, job->room);
#endif
    lanes_load(w, job);
    w->table = job->table;
    w->first = job->first;
    w->fresh = false;
    bool first = job->first_look;
    do {
        for (whole some = every && every < steps ? every : steps; some > 0; some--) {
            advance_step(w);
            w->n++;
            steps--;
        }
        if (every) lanes_look(w, job, job->ends && steps <= 0 ? job->until : time_of(w, w->n), first);
        first = false;
    } while (steps > 0);
    lanes_store(w, job);
}
