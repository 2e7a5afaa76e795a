/* SPLITTING: every method of kicks v += b h a(x, t) and drifts x += d h v, once [HLW06, II.5]. operators.h makes
 * them.
 *
 * Invariant: in a row that begins and ends with a kick, `v` lacks the closing kick between steps; splitting_sync
 * forms it aside, so observing changes no bit.
 */
static int splitting_step(work *w)
{
    EACH_STAGE(i, FACT(w, stages) - FACT(w, fsal)) {
        int bad = kick(w, i);
        if (bad) return bad;
        drift(w, i);
        if (i == last_stage(w)) step_end(w);
        TRACE(w, i);
    }
    return STEP_OK;
}
#define splitting_accept step_is_final

static int splitting_observe(work *w) { return accel_now(w, w->x, w->v, w->a); }

static int splitting_sync(work *w, real *x, real *v)
{
    const clock b = kick_closing(w);
    const bool waiting = FACT(w, fsal) && !FIRST(w);
    EACH(k) x[k] = w->x[k];
    if (waiting && ROW(w, compensated))
        EACHV(k) v[k] = w->v[k] + FMA(b, w->a[k], w->ev[k]);
    else if (waiting)
        EACHV(k) v[k] = FMA(b, w->a[k], w->v[k]);
    else
        EACHV(k) v[k] = w->v[k];
    return STEP_OK;
}

#define splitting_carry work_carry_main
#define splitting_between lift_between
#define splitting_extend lift_extend
#define splitting_swing swing_unknown
#define splitting_dense lift_dense

static inline void splitting_place(work *w, placing *p)
{
    if (ROW(w, compensated)) {
        w->xs = work_array(p, 1);
        w->low = work_array(p, 1);
        if (FACT(w, solves) || FACT(w, means)) w->us = work_array(p, 1);
    }
    if (ROW(w, density) && !ROW(w, compensated)) w->xs = work_array(p, 1);
    work_density(w, p);
    if (ROW(w, density) || FACT(w, solves) || FACT(w, means)) w->vs = work_array(p, 1);
    if (!FACT(w, solves) && !FACT(w, means)) return;
    if (FACT(w, means)) w->r = work_array(p, 1);
    if (!FACT(w, solves)) return;
    w->delta = work_array(p, 1);
    w->r = work_array(p, 1);
}

#ifdef ROWS
static coef splitting_reach(const work *w, const coef *kick, const coef *drift)
{
    const coef h = K(0.25);
    coef x[2] = {1, 0}, v[2] = {0, 1};
    for (int i = 0; i < w->stages; i++) {
        const coef k = kick[i] * h * density_pull(x);
        for (int n = 0; n < 2; n++) v[n] -= k * x[n];
        for (int n = 0; n < 2; n++) x[n] += drift[i] * h * v[n];
    }
    return density_reach(w, x, v, h, K(0.96891242171064478414459544949418919980413),
                         K(0.24740395925452292959684870484938919589339));
}

/* unit: kicks, drifts, the joint kick of a row that begins and ends with one, of a compensated row room for work_sums,
 * and Gauss's node for a quadrature; of a density the reach. */
static void splitting_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    const row *m = w->row;
    const int count = m->composition.count, last = count ? count : m->splitting.stages - 1;
    (void)argument;
    w->stages = last + 1;
    w->means = !w->quadrature ? 0 : count || m->splitting.stages <= 2 ? 1 : 2;
    w->solves = w->velocity && !w->means;
    w->linears = 2 * w->stages + 1 + (m->compensated ? 2 * w->stages : 0) + (w->means > 1);
    w->summed = m->compensated ? w->stages : 0;
    w->plains = m->density;
    w->order = m->card.order;
    w->opening = m->density && !count && !w->solves && m->splitting.kick[0] != 0;
    /* of a compensated row the last kick is not at the positions to the last bit */
    w->closing = w->opening && !m->compensated && !w->means && m->splitting.drift[last] == 0;
    w->fused = !m->compensated && !w->solves && w->nv == w->nx;
    w->fsal = w->waits = !count && !m->adaptive && !w->means && m->splitting.kick[0] != 0 &&
                         m->splitting.kick[last] != 0 && m->splitting.drift[last] == 0;
    if (!unit) return;
    for (int i = 0; i < w->linears; i++) unit[i] = 0;
    coef *kick = unit, *drift = unit + w->stages, time = 0;
    for (int i = 0; i <= last; i++) {
        kick[i] = count ? 0 : m->splitting.kick[i];
        drift[i] = count ? 0 : m->splitting.drift[i];
    }
    for (int i = 0; i < count; i++) { /* joins neighbouring half drifts */
        const coef weight = m->composition.weight[i < count - 1 - i ? i : count - 1 - i];
        drift[i] += weight / 2;
        kick[i + 1] = weight;
        drift[i + 1] += weight / 2;
    }
    /* the abscissa of a kick: the sum of the drifts before it */
    for (int i = 0; i <= last; i++) {
        bool over = true;
        for (int j = i; j <= last; j++) over = over && drift[j] == 0;
        c[i] = over ? 1 : time;
        time += drift[i];
    }
    if (m->density) unit[w->linears] = splitting_reach(w, kick, drift);
    unit[2 * w->stages] = kick[0] + kick[last];
    if (w->means > 1) unit[w->linears - 1] = K(0.21132486540518711774542560974902127218);
}
#endif

#ifdef TRACING
static trace_room splitting_room(const work *w)
{
    trace_room room = {0};
    for (int i = 0; i < w->stages; i++) {
        room.v += 2 * kicks(w, i);
        room.x += drifts(w, i);
    }
    room.events = room.v / 2 + room.x;
    return room;
}

/* A kick and its drift may have been made in one pass. The kick's event has no positions, because they are unchanged by
 * it. */
static void splitting_trace(work *w, int i)
{
    if (i < 0) return;
    const tracer *to = tracer_of(w);
    const int last = w->stages - 1;
    const bool within = w->row->compensated && i < last_stage(w); /* x and v are still those at the start */
    if (kicks(w, i)) {
        const real *a = w->a, *v = w->v;
        if (within) {
            real *now = w->us ? w->us : to->v;
            EACHV(k) now[k] = w->v[k] + w->ev[k];
            v = now;
        }
        /* the acceleration that solves the implicit kick: delta = b h a */
        if (w->solves) {
            EACHV(k) to->v[k] = w->delta[k] / kick_size(w, i);
            a = to->v;
        }
        tell(w, (trace_event){.kind = MOTUS_TRACE_KICK,
                              .stage = i + 1,
                              .time = time_in(w, w->c[i]),
                              .coefficient = kick_unit(w, i),
                              .v = v,
                              .a = a});
    }
    if (drifts(w, i))
        tell(w, (trace_event){.kind = MOTUS_TRACE_DRIFT,
                              .stage = i + 1,
                              .time = time_in(w, i < last ? w->c[i + 1] : 1),
                              .coefficient = drift_unit(w, i),
                              .x = within ? w->xs : w->x});
    if (w->fsal && i == last - 1)
        tell(w, (trace_event){.kind = MOTUS_TRACE_KICK,
                              .stage = last + 1,
                              .time = time_in(w, 1),
                              .coefficient = kick_unit(w, last)});
}
#endif
