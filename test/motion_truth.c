/* Extrapolated midpoint steps of 113 bits, and what leads them through switches, layers and rest. */
#include "test/motion_truth.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 9, MOST_Y = 2 * MOTION_VARIABLES + 1 };

/* One extrapolated step of y' = rate(t, y) ------------------------------------------------------------------------- */

typedef void rate_of(void *context, quad t, const quad *y, quad *rate);

/* What a column of the extrapolation weighs the one before with: products are faster than divisions. */
static quad weight[COLUMNS][COLUMNS];
static void fill(void)
{
    if (weight[1][0] != 0) return;
    for (int k = 1; k < COLUMNS; k++)
        for (int j = 0; j < k; j++) weight[k][j] = 1 / ((quad)((k + 1) * (k + 1)) / ((j + 1) * (j + 1)) - 1);
}

/* Of as many columns as the error `enough` needs: false where it is not finite. *error: of the result. */
static bool gragg(rate_of *rate, void *context, int size, quad t, const quad *from, quad h, quad enough, quad *to,
                  quad *error)
{
    fill();
    quad table[COLUMNS][MOST_Y], first[MOST_Y];
    rate(context, t, from, first);
    *error = 2 * enough + 1;
    for (int k = 0; k<COLUMNS && * error> enough; k++) {
        const int n = 2 * (k + 1);
        const quad d = h / n;
        quad before[MOST_Y], now[MOST_Y], f[MOST_Y];
        for (int i = 0; i < size; i++) before[i] = from[i], now[i] = from[i] + d * first[i];
        for (int s = 1; s < n; s++) {
            rate(context, t + d * s, now, f);
            for (int i = 0; i < size; i++) {
                const quad after = before[i] + 2 * d * f[i];
                before[i] = now[i], now[i] = after;
            }
        }
        rate(context, t + h, now, f); /* the smoothing step */
        for (int i = 0; i < size; i++) table[k][i] = (now[i] + before[i] + d * f[i]) / 2;
        for (int j = k; j-- > 0;)
            for (int i = 0; i < size; i++)
                table[j][i] = table[j + 1][i] + weight[k][j] * (table[j + 1][i] - table[j][i]);
        if (k == 0) continue;
        *error = 0;
        for (int i = 0; i < size; i++) {
            const quad e = motion_absolute(table[0][i] - table[1][i]);
            if (!(e - e == 0)) return false;
            if (e > *error) *error = e;
        }
    }
    memcpy(to, table[0], (size_t)size * sizeof *to);
    return true;
}

/* Sides --------------------------------------------------------------------------------------------------------- */

/* How the motion goes on: the side of every switch, and which are held at 0. */
typedef struct stance {
    quad side[MOTION_SWITCHES];
    bool held[MOTION_SWITCHES];
    int held_count;
} stance;

typedef struct going {
    const motion *m;
    stance st;
    quad mode[MOTION_MODES], tolerance, most;
    const char *why; /* why the truth cannot be found */
} going;

static void from_y(const going *g, quad t, const quad *y, motion_point *at)
{
    at->t = t;
    memcpy(at->y, y, 2 * (size_t)g->m->variables * sizeof *y);
    memcpy(at->mode, g->mode, sizeof at->mode);
}

static void plain_forces(const motion *m, const motion_point *at, const quad *sides, quad *a, quad *values,
                         quad *arguments)
{
    motion_values(m, at, sides, arguments, values);
    for (int i = 0; i < m->variables; i++) {
        a[i] = values[m->force[i]];
        if (m->first_order[i] && m->frame.backward) a[i] = -a[i];
    }
}

/* The rates of the arguments, with the forces of these sides. */
static void rates_of(const motion *m, const motion_point *at, const quad *sides, quad *rates)
{
    quad values[MOTION_NODES], along[MOTION_NODES], arguments[MOTION_SWITCHES], a[MOTION_VARIABLES];
    plain_forces(m, at, sides, a, values, arguments);
    motion_rates(m, at, sides, a, values, along, rates);
}

/* The values that keep the arguments of what is held where they are: a linear system. */
static bool hold(const motion *m, const motion_point *at, stance *st)
{
    int of[MOTION_SWITCHES], n = 0;
    for (int s = 0; s < m->switches; s++)
        if (st->held[s]) of[n++] = s, st->side[s] = 0;
    if (n == 0) return true;
    quad base[MOTION_SWITCHES], rates[MOTION_SWITCHES], table[MOTION_SWITCHES][MOTION_SWITCHES + 1];
    rates_of(m, at, st->side, base);
    for (int j = 0; j < n; j++) {
        st->side[of[j]] = 1;
        rates_of(m, at, st->side, rates);
        st->side[of[j]] = 0;
        for (int i = 0; i < n; i++) table[i][j] = rates[of[i]] - base[of[i]];
    }
    for (int i = 0; i < n; i++) table[i][n] = -base[of[i]];
    for (int j = 0; j < n; j++) {
        int best = j;
        for (int i = j; i < n; i++)
            if (motion_absolute(table[i][j]) > motion_absolute(table[best][j])) best = i;
        if (motion_absolute(table[best][j]) < Q(1e-12)) return false;
        for (int k = j; k <= n; k++) {
            const quad u = table[j][k];
            table[j][k] = table[best][k], table[best][k] = u;
        }
        for (int i = 0; i < n; i++) {
            if (i == j) continue;
            const quad factor = table[i][j] / table[j][j];
            for (int k = j; k <= n; k++) table[i][k] -= factor * table[j][k];
        }
    }
    for (int j = 0; j < n; j++) st->side[of[j]] = table[j][n] / table[j][j];
    return true;
}

static void rate(void *context, quad t, const quad *y, quad *f)
{
    going *g = context;
    const motion *m = g->m;
    motion_point at;
    from_y(g, t, y, &at);
    if (g->st.held_count && !hold(m, &at, &g->st)) g->why = "what is held has no value";
    quad values[MOTION_NODES], arguments[MOTION_SWITCHES], a[MOTION_VARIABLES];
    plain_forces(m, &at, g->st.side, a, values, arguments);
    for (int i = 0; i < m->variables; i++) {
        f[i] = m->first_order[i] ? a[i] : y[m->variables + i];
        f[m->variables + i] = m->first_order[i] ? 0 : a[i];
    }
}

static bool step(going *g, const motion_point *from, quad h, motion_point *to, quad *error)
{
    *to = *from;
    to->t = from->t + h;
    return gragg(rate, g, 2 * g->m->variables, from->t, from->y, h, g->tolerance * Q(1e-5), to->y, error);
}

static quad gap(const motion *m, int s, const stance *st, const quad *arguments)
{
    if (st->held[s]) return 1 - motion_absolute(st->side[s]);
    if (motion_switch_at(m, s)->op != MOTION_MOD) return st->side[s] * arguments[s];
    const quad up = st->side[s] + 1 - arguments[s], down = arguments[s] - st->side[s];
    return up < down ? up : down;
}

/* The smallest distance of a switch from the end of its side, below 0 beyond it. */
static quad nearest(going *g, const motion_point *at, int *which)
{
    const motion *m = g->m;
    quad values[MOTION_NODES], arguments[MOTION_SWITCHES], worst = 1;
    if (g->st.held_count) hold(m, at, &g->st);
    motion_values(m, at, g->st.side, arguments, values);
    for (int s = 0; s < m->switches; s++) {
        const quad d = gap(m, s, &g->st, arguments);
        if (s == 0 || d < worst) worst = d, *which = s;
    }
    return worst;
}

/* Which sides, or none, the switches of `open` take from here on: those with which a short trial step agrees. */
typedef struct choice {
    int open[MOTION_SWITCHES], count;
} choice;

static bool may_hold(const motion *m, int s)
{
    const motion_op op = motion_switch_at(m, s)->op;
    return op == MOTION_SIGN || op == MOTION_SIDE || op == MOTION_GREATER;
}

/* 0: the trial contradicts the sides. 1: it does not; 2: it confirms every one. */
static int trial(going *g, const motion_point *at, const choice *c, const stance *st, quad h)
{
    const motion *m = g->m;
    const stance kept = g->st;
    g->st = *st;
    int verdict = 2;
    for (int part = 1; part <= 2 && verdict; part++) {
        motion_point to;
        quad error, values[MOTION_NODES], arguments[MOTION_SWITCHES];
        if ((g->st.held_count && !hold(m, at, &g->st)) || !step(g, at, h * part / 2, &to, &error)) {
            verdict = 0;
            break;
        }
        if (g->st.held_count) hold(m, &to, &g->st);
        motion_values(m, &to, g->st.side, arguments, values);
        for (int k = 0; k < c->count && verdict; k++) {
            const quad d = gap(m, c->open[k], &g->st, arguments);
            if (!(d >= Q(-1e-31)))
                verdict = 0;
            else if (!(d > Q(1e-31)) && verdict == 2)
                verdict = 1;
        }
    }
    g->why = NULL;
    g->st = kept;
    return verdict;
}

static void recount(const motion *m, stance *st)
{
    st->held_count = 0;
    for (int s = 0; s < m->switches; s++) st->held_count += st->held[s];
}

static bool decide_by(going *g, const motion_point *at, const choice *c, quad h)
{
    const motion *m = g->m;
    int combinations = 1, found[3] = {0};
    stance best[3];
    for (int k = 0; k < c->count; k++) combinations *= 3;
    for (int n = 0; n < combinations; n++) {
        stance st = g->st;
        bool sound = true;
        for (int k = 0, rest = n; k < c->count; k++, rest /= 3) {
            const int s = c->open[k], how = rest % 3;
            st.held[s] = how == 2;
            st.side[s] = how == 0 ? 1 : how == 1 ? -1 : 0;
            if (how == 2 && !may_hold(m, s)) sound = false;
        }
        if (!sound) continue;
        recount(m, &st);
        const int verdict = trial(g, at, c, &st, h);
        if (!found[verdict]++) best[verdict] = st;
    }
    if (found[2] > 1) g->why = "the motion is not unique";
    if (!found[2] && !found[1]) return false;
    g->st = best[found[2] ? 2 : 1];
    return true;
}

static void decide(going *g, const motion_point *at, const choice *c)
{
    if (c->count == 0) return;
    if (c->count > 4) {
        g->why = "more than four switches in one place";
        return;
    }
    const motion *m = g->m;
    const int s = c->open[0];
    if (c->count == 1 && g->st.held_count == 0) { /* the rates of both sides mostly tell */
        quad up[MOTION_SWITCHES], down[MOTION_SWITCHES];
        stance st = g->st;
        st.side[s] = 1;
        rates_of(m, at, st.side, up);
        st.side[s] = -1;
        rates_of(m, at, st.side, down);
        const quad clear = Q(1e-6);
        if (motion_absolute(up[s]) > clear && motion_absolute(down[s]) > clear) {
            if (up[s] > 0 && down[s] < 0) g->why = "the motion is not unique";
            g->st.side[s] = up[s] > 0 ? 1 : -1;
            if (up[s] < 0 && down[s] > 0) {
                if (!may_hold(m, s)) g->why = "a switch of a continuous force is to be held";
                g->st.held[s] = true, g->st.side[s] = 0;
                recount(m, &g->st);
            }
            return;
        }
    }
    if (!decide_by(g, at, c, Q(1e-5)) && !decide_by(g, at, c, Q(1e-8))) g->why = "no side agrees with the motion";
}

/* The switches at the end of their sides; the others get the sides that they have. */
static void look(going *g, const motion_point *at, choice *c)
{
    const motion *m = g->m;
    quad values[MOTION_NODES], arguments[MOTION_SWITCHES];
    c->count = 0;
    for (int pass = 0; pass < 2; pass++) { /* arguments may hold switches */
        if (g->st.held_count) hold(m, at, &g->st);
        motion_values(m, at, g->st.side, arguments, values);
        for (int s = 0; s < m->switches; s++) {
            if (motion_switch_at(m, s)->op == MOTION_MOD) {
                g->st.side[s] = floor((double)arguments[s]);
                if (arguments[s] - g->st.side[s] >= 1) g->st.side[s]++;
                if (arguments[s] < g->st.side[s]) g->st.side[s]--;
                const quad to_next = g->st.side[s] + 1 - arguments[s];
                if (to_next < Q(1e-22)) g->st.side[s]++; /* a time, which rises */
            } else if (motion_absolute(arguments[s]) <= Q(1e-22)) {
                if (pass) c->open[c->count++] = s;
            } else {
                g->st.held[s] = false;
                g->st.side[s] = arguments[s] > 0 ? 1 : -1;
            }
        }
        recount(m, &g->st);
    }
}

/* At the end of a side: events act, and the switches there take their new sides. */
static void turn(going *g, motion_point *at, motion_truth *out)
{
    const motion *m = g->m;
    quad values[MOTION_NODES], arguments[MOTION_SWITCHES];
    if (g->st.held_count) hold(m, at, &g->st);
    motion_values(m, at, g->st.side, arguments, values);
    for (int k = 0; k < m->event_count; k++) {
        const motion_event *e = &m->events[k];
        const int s = m->nodes[e->cross].which;
        if (!(g->st.side[s] * arguments[s] < 0)) continue;
        if (e->direction != 0 && e->direction != (g->st.side[s] > 0 ? -1 : 1)) continue;
        if (out->events >= MOTION_TRUTH_EVENTS) {
            g->why = "too many events";
            return;
        }
        out->event_kind[out->events] = k;
        out->event_time[out->events++] = at->t;
        const quad value = values[e->becomes];
        if (e->changes == MOTION_PLACE) at->y[e->which] = value;
        if (e->changes == MOTION_SPEED) at->y[m->variables + e->which] = value;
        if (e->changes == MOTION_MODE) g->mode[e->which] = at->mode[e->which] = value;
    }
    choice c;
    look(g, at, &c);
    decide(g, at, &c);
}

/* Steps --------------------------------------------------------------------------------------------------------- */

static void layers_at(going *g, const motion_point *at, quad *u, quad *du)
{
    const motion *m = g->m;
    quad values[MOTION_NODES], along[MOTION_NODES], arguments[MOTION_SWITCHES], a[MOTION_VARIABLES], r[MOTION_SWITCHES];
    if (g->st.held_count) hold(m, at, &g->st);
    plain_forces(m, at, g->st.side, a, values, arguments);
    motion_rates(m, at, g->st.side, a, values, along, r);
    for (int k = 0; k < m->layer_count; k++)
        u[k] = values[m->layers[k].u], du[k] = motion_absolute(along[m->layers[k].u]);
}

/* How far u may change in one step: never into a layer from far away, and by one unit within it. */
static quad way(const motion_layer *l, quad u)
{
    const quad far = (l->below ? u : motion_absolute(u)) - l->reach;
    return far > 1 ? far : 1;
}

/* A point within a step, by Hermite's polynomial of places, speeds and accelerations of its ends. */
static void between(going *g, const motion_point *from, const motion_point *to, quad p, motion_point *at)
{
    const int n = g->m->variables;
    const quad h = to->t - from->t, q = 1 - p;
    quad f0[MOST_Y], f1[MOST_Y];
    rate(g, from->t, from->y, f0);
    rate(g, to->t, to->y, f1);
    *at = *from;
    at->t = from->t + p * h;
    const quad h00 = (1 + 2 * p) * q * q, h10 = p * q * q, h01 = p * p * (3 - 2 * p), h11 = -p * p * q;
    for (int i = 0; i < 2 * n; i++) at->y[i] = h00 * from->y[i] + h10 * h * f0[i] + h01 * to->y[i] + h11 * h * f1[i];
}

/* Whether a switch leaves its side and comes back within the step. */
static bool excursion(going *g, const motion_point *from, const motion_point *to)
{
    for (int k = 1; k <= 4; k++) {
        motion_point at;
        int which;
        between(g, from, to, Q(0.2) * k, &at);
        if (nearest(g, &at, &which) < Q(-1e-9)) return true;
    }
    return false;
}

/* The end of the first side within h, after which a switch is `beyond` its side: a step that ends just behind
 * it. Regula falsi with halved weights (Illinois), and a bisection in every third turn. */
static void locate(going *g, const motion_point *from, quad h, quad beyond, motion_point *to)
{
    quad low = 0, high = h, error;
    int which, last = 0;
    quad at_low = nearest(g, from, &which), at_high = beyond;
    if (at_low < 0) at_low = 0;
    for (int turn = 0; turn < 300 && high - low > Q(1e-29); turn++) {
        quad middle = low + (high - low) * at_low / (at_low - at_high);
        if (turn % 3 == 2 || !(middle > low && middle < high)) middle = (low + high) / 2;
        step(g, from, middle, to, &error);
        const quad d = nearest(g, to, &which);
        if (d < 0 && d > Q(-1e-29)) return;
        if (d < 0) {
            high = middle, at_high = d;
            if (last == 1) at_low /= 2;
            last = 1;
        } else {
            low = middle, at_low = d;
            if (last == -1) at_high /= 2;
            last = -1;
        }
    }
    step(g, from, high, to, &error);
}

/* To time `end`. */
static void go(going *g, motion_point *at, quad end, quad *size, motion_truth *out)
{
    const motion *m = g->m;
    const quad grows = g->tolerance * Q(1e-4);
    quad h = *size, u[MOTION_LAYERS], du[MOTION_LAYERS], later[MOTION_LAYERS], none[MOTION_LAYERS];
    for (int steps = 0; at->t < end && !g->why; steps++) {
        if (steps > 60000 || !(h > Q(1e-24))) {
            g->why = "too many steps";
            return;
        }
        quad most = h;
        if (most > g->most) most = g->most;
        layers_at(g, at, u, du);
        for (int k = 0; k < m->layer_count; k++) {
            const quad allowed = Q(0.75) * way(&m->layers[k], u[k]);
            if (most * du[k] > allowed) most = allowed / du[k];
        }
        if (at->t + most > end) most = end - at->t;
        motion_point to;
        quad error;
        bool sound = step(g, at, most, &to, &error) && !(error > g->tolerance);
        if (sound && m->layer_count) {
            layers_at(g, &to, later, none);
            for (int k = 0; k < m->layer_count; k++)
                if (!(motion_absolute(later[k] - u[k]) <= way(&m->layers[k], u[k]) * Q(1.5))) sound = false;
        }
        if (!sound) {
            h = most / 2;
            continue;
        }
        int which;
        const quad d = m->switches ? nearest(g, &to, &which) : 1;
        if (d >= 0 && m->switches && most > Q(1e-5) && excursion(g, at, &to)) {
            h = most / 2;
            continue;
        }
        if (error < grows && h <= most) h = 2 * most;
        if (d < 0) {
            locate(g, at, most, d, &to);
            *at = to;
            if (out->switched++ > 3000) g->why = "too many switches";
            turn(g, at, out);
            out->held += g->st.held_count > 0;
        } else {
            const bool last = at->t + most >= end && to.t >= end - Q(1e-30);
            *at = to;
            if (last) at->t = end;
        }
    }
    *size = h;
}

/* Friction in the plane ----------------------------------------------------------------------------------------- */

/* y: the place, the velocity, the time; by the time s with dt = |v| ds, in which the force of friction is smooth up to
 * the place of rest, to which v goes exponentially. */
static void rate_in_plane(void *context, quad s, const quad *y, quad *f)
{
    (void)s;
    going *g = context;
    motion_point at;
    from_y(g, y[4], y, &at);
    quad values[MOTION_NODES], arguments[MOTION_SWITCHES], a[MOTION_VARIABLES];
    plain_forces(g->m, &at, g->st.side, a, values, arguments);
    const quad speed = motion_root(y[2] * y[2] + y[3] * y[3]);
    for (int i = 0; i < 2; i++) f[i] = speed * y[2 + i], f[2 + i] = speed * a[i] - g->m->slides * y[2 + i];
    f[4] = speed;
}

static void go_in_plane(going *g, motion_point *at, quad end)
{
    const quad rest = Q(1e-24);
    quad y[5], h = Q(0.05);
    memcpy(y, at->y, 4 * sizeof *y);
    y[4] = at->t;
    for (int steps = 0; y[4] < end; steps++) {
        if (steps > 60000) {
            g->why = "too many steps";
            return;
        }
        quad a[MOTION_VARIABLES], values[MOTION_NODES], arguments[MOTION_SWITCHES];
        from_y(g, y[4], y, at);
        plain_forces(g->m, at, g->st.side, a, values, arguments);
        const quad speed = motion_root(y[2] * y[2] + y[3] * y[3]), pull = motion_root(a[0] * a[0] + a[1] * a[1]);
        if (speed <= rest) {
            const quad slack = pull - g->m->slides;
            if (motion_absolute(slack) < Q(1e-9)) g->why = "at rest friction and force balance";
            if (slack < 0) { /* it sticks: what does not depend on the time stays */
                y[2] = y[3] = 0;
                y[4] = end;
                break;
            }
            for (int i = 0; i < 2; i++) y[2 + i] = 2 * rest * a[i] / pull;
            h = Q(0.05);
        }
        quad to[5], error;
        if (!gragg(rate_in_plane, g, 5, 0, y, h, g->tolerance * Q(1e-5), to, &error) || error > g->tolerance) {
            h /= 2;
            continue;
        }
        if (to[4] > end) { /* a step that ends at `end` */
            quad low = 0, high = h;
            for (int turn = 0; turn < 200 && high - low > high * Q(1e-33); turn++) {
                const quad middle = (low + high) / 2;
                gragg(rate_in_plane, g, 5, 0, y, middle, g->tolerance * Q(1e-5), to, &error);
                if (to[4] > end)
                    high = middle;
                else
                    low = middle;
            }
            to[4] = end;
        } else if (error < g->tolerance * Q(1e-4) && h < g->most) {
            h *= 2;
        }
        memcpy(y, to, sizeof to);
    }
    memcpy(at->y, y, 4 * sizeof *y);
    at->t = end;
}

const char *motion_truth_find(const motion *m, const quad *times, int count, bool coarse, motion_truth *out)
{
    going g = {.m = m, .tolerance = coarse ? Q(1e-23) : Q(1e-25)};
    const quad fine = m->switches ? Q(0.1) : m->layer_count ? Q(0.25) : Q(1.0);
    g.most = coarse ? fine * Q(0.37) : fine;
    memset(out, 0, sizeof *out);
    motion_point at;
    memset(&at, 0, sizeof at);
    for (int i = 0; i < m->variables; i++) {
        at.y[i] = motion_decimal(m->x[i]);
        at.y[m->variables + i] = m->frame.backward ? -motion_decimal(m->v[i]) : motion_decimal(m->v[i]);
    }
    for (int k = 0; k < m->modes; k++) g.mode[k] = at.mode[k] = m->mode[k];
    for (int s = 0; s < m->switches; s++) g.st.side[s] = 1;
    choice c;
    look(&g, &at, &c);
    decide(&g, &at, &c);
    quad size = Q(0.05);
    for (int k = 0; k < count && !g.why; k++) {
        if (m->slides != 0)
            go_in_plane(&g, &at, times[k]);
        else
            go(&g, &at, times[k], &size, out);
        memcpy(out->y[k], at.y, sizeof at.y);
    }
    return g.why;
}
