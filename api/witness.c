/* See witness.h.
 *
 * Over a step, or a part of it, that leads from v to v', the integral of the force along the dense output has to be
 * v' - v; what is missing is the error of the velocity that the part makes. Gauss's rule takes the integral, at
 * abscissae which are not those of the method. Interval arithmetic over all states of a part says whether some
 * operation may pass through more than points can show; such a part is halved. So no peak and no window is too narrow
 * to be seen. Sizes are added up over the parts, because a force that pushes and then pulls shifts a motion and leaves
 * its velocity.
 *
 * A part in which a switch of the force may stand at 0 is not judged, however short it becomes: the force has more than
 * one value there, and what a sign does that friction holds no single value tells.
 */
#include "api/witness.h"

#include "api/choice.h"
#include "core/rows.h"
#include "lang/read/verify.h"

#include <math.h>
#include <string.h>

enum {
    POINTS = 8,   /* an even number */
    DEPTH = 40,   /* halvings of a step */
    PARTS = 4096, /* of one step */
    TRIES = 64,   /* candidates that are refused one after the other */
    PROBED = 4096 /* steps of a probe */
};
/* What it may spend, in evaluations of the typed force by the interpreter: at the beginning so many operations, but at
 * least so many evaluations, and then a part of what run and companion spend. A series of order n costs as much as
 * n^2/4 evaluations, and a compiled evaluation a thirtieth. */
#define SPEND_FIRST 4e5 /* operations, and */
#define SPEND_LEAST 200.0
#define SPEND 0.1
#define COMPILED (1 / 30.0)
#define BOUNDS 4.0  /* what bounds over a step cost */
#define LONGER 1.25 /* than all before: such a step is looked at, whatever was spent */
/* Operations, too: what one probe may spend, and what all steps that were rightly refused, and those that follow such a
 * step up to its end, may cost besides. */
#define SPEND_PROBE 2e7
#define SPEND_SPARED 1e8
#define FIRST \
    0.01 /* times what a step may lose: the first part of which so much is missing is where a step is to end */
#define SUSPICIOUS 10.0 /* times what a step may lose */
#define REFUSED 30.0    /* likewise, between the step and the probe */
#define ROUNDING 0x1p-46
#define ROOM 0.75 /* of a step that is refused: the next one is shorter */

/* Gauss's abscissae in (0, 1) beyond the middle, less 1/2, and their weights [DLMF, table 3.5.2]. */
static const double abscissa[POINTS / 2] = {0.0917173212478248849, 0.2627662049581645044, 0.3983332387068134038,
                                            0.4801449282487681160};
static const double part_of[POINTS / 2] = {0.1813418916891809915, 0.1568533229389436437, 0.1111905172266872352,
                                           0.0506142681451885293};

typedef struct state { /* of the run, in the inside order */
    double t, *x, *v;
} state;

enum { FROM, TO, MIDDLE, POINT = MIDDLE + DEPTH, END, STATES };

struct witness {
    const motus_system *typed;
    machine machine; /* of the probe, and */
    chosen method;   /*   its method */
    motus_allocator allocator;
    const differences *seen;
    size_t nx, nv;     /* of the run, */
    size_t own, other; /*   of whose velocities the typed system has the first `own`, and those from `other` on */
    resolution *bends; /* what in the force can hide between points */
    state at[STATES];
    double *a, *sum, *v; /* of the typed force, and velocities as it wants them */
    double *most;        /* bounds on the accelerations of the step */
    double *missing;     /* of every velocity, sizes added up over the parts */
    double *allowed;     /* what a step may lose of it */
    double *dx, *dv;     /* how far the probe is from the step */
    interval *in_x, *in_v;
    int parts, tries;
    double worst, start,
        length;           /* the most that is missing of a part, in units of what is allowed; the first with much */
    double earned, spent; /* evaluations: the part of the run's that it may spend, and what it has spent */
    int64_t evaluations;  /* of the run, so far */
    double longest;       /* of the steps that it has looked at */
    double operations;    /* of one evaluation */
    double spared;        /* evaluations that are not counted, since they led to a step that was refused */
    bool kinked;          /* the typed force has switches */
    bool probes;          /* it looks at a probe, and refuses at once */
    bool events;          /* the run has some */
    bool moves;           /* dx and dv are for the companion */
    double until;         /* a probe has differed from the step that led there; NaN */
    double differs;
    stepper *probe;
    struct witness *inner; /* that looks at the probe */
};

/* ---- life ---- */

static witness *make(const motus_run *r, const differences *seen)
{
    const problem *const p = &r->system->problem;
    const motus_system *const s = r->home ? r->home : r->system;
    const size_t nx = p->nx + 1, nv = p->nv + 1, numbers = STATES * (nx + nv) + 7 * nv + nx + 2 * (nx + nv);
    witness *w = take(&r->allocator, 1, sizeof *w + numbers * sizeof(double));
    if (!w) return NULL;
    *w = (witness){.typed = s, .machine = r->machine, .method = r->chosen, .allocator = r->allocator, .seen = seen};
    w->nx = p->nx, w->nv = p->nv;
    w->own = s->problem.nx, w->other = p->nx;
    w->until = w->differs = NAN;
    double *at = (double *)(void *)(w + 1);
    w->in_x = (interval *)(void *)at, w->in_v = w->in_x + nx;
    at += 2 * (nx + nv);
    for (size_t k = 0; k < STATES; k++, at += nx + nv) w->at[k] = (state){.x = at, .v = at + nx};
    double **const arrays[] = {&w->a, &w->sum, &w->v, &w->most, &w->missing, &w->allowed, &w->dv, &w->dx};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++, at += nv) *arrays[k] = at;
    return w;
}

static double inspect(void *ctx, stepper *);

/* It lives in the system's arena, for all its runs. */
static bool find_bends(motus_system *s)
{
    const model *const m = s->model;
    const output *const lists[] = {m->boundary, m->accel};
    const size_t counts[] = {m->boundary_count, m->accel_count};
    bool sums = false;
    if (!s->bends_known) s->bends_known = verify_resolution(s->model, lists, counts, 2, &s->bends, &sums);
    return s->bends_known;
}

motus_status witness_create(const motus_run *r, const differences *seen, witness **out, motus_error *err)
{
    motus_system *const s = r->home ? r->home : r->system;
    *out = NULL;
    if (!s->model || !row_adaptive(&r->chosen) || row_reversible_steps(&r->chosen)) return MOTUS_OK;
    if (!find_bends(s)) return fail(err, MOTUS_MEMORY, "no memory for a witness of the run");
    weight each;
    motus_status status = s->bends ? choice_weigh(s, &each, err) : MOTUS_OK;
    if (status != MOTUS_OK || !s->bends) return status;
    witness *const w = make(r, seen);
    if (w) w->inner = make(r, seen);
    if (!w || !w->inner) {
        witness_destroy(w);
        return fail(err, MOTUS_MEMORY, "no memory for a witness of the run");
    }
    w->operations = w->inner->operations = each.values + 10 * (double)s->problem.nv;
    w->earned = fmax(SPEND_LEAST, SPEND_FIRST / w->operations);
    w->events = r->events != NULL;
    w->kinked = w->inner->kinked = !s->problem.traits.smooth;
    w->bends = w->inner->bends = s->bends;
    w->inner->probes = true;
    stepper_inspected(r->stepper, inspect, w);
    *out = w;
    return MOTUS_OK;
}

void witness_destroy(witness *w)
{
    if (!w) return;
    const motus_allocator a = w->allocator;
    stepper_destroy(w->probe);
    give(&a, w->inner);
    give(&a, w);
}

bool witness_moves(witness *w, const double **x, const double **v)
{
    if (!w || !w->moves) return false;
    *x = w->dx, *v = w->dv;
    w->moves = false;
    return true;
}

double witness_differs(const witness *w) { return w ? w->differs : NAN; }

/* ---- looking ---- */

static bool see(stepper *s, double t, state *to)
{
    to->t = t;
    return stepper_sample(s, t, to->x, to->v, NULL) == MOTUS_OK;
}

/* The place among the run's velocities of velocity k of the typed system, which has no sides of switches. */
static size_t place(const witness *w, size_t k) { return k < w->own ? k : k - w->own + w->other; }

static interval about(double middle, double half) { return (interval){middle - half, middle + half}; }

static bool fits(witness *w, const state *from, const state *to)
{
    const problem *const p = &w->typed->problem;
    const double h = fabs(to->t - from->t);
    for (size_t k = 0; k < p->nv; k++) {
        const size_t at = place(w, k);
        w->in_v[k] = about(from->v[at] + (to->v[at] - from->v[at]) / 2, h / 2 * w->most[at]);
    }
    for (size_t k = 0; k < p->nx; k++)
        w->in_x[k] =
            about(from->x[k] + (to->x[k] - from->x[k]) / 2, fabs(to->x[k] - from->x[k]) / 2 + h * h / 8 * w->most[k]);
    const interval t = {fmin(from->t, to->t), fmax(from->t, to->t)};
    return resolution_fits(w->bends, t, w->in_x, w->in_v, w->typed->model->pool);
}

/* What is missing of one part. */
static bool hold(witness *w, stepper *s, const state *from, const state *to)
{
    const problem *const p = &w->typed->problem;
    state *const point = &w->at[POINT];
    const double h = to->t - from->t;
    double most = 0;
    for (size_t k = 0; k < p->nv; k++) w->sum[k] = 0;
    for (int i = 0; i < POINTS; i++) {
        const double c = i & 1 ? abscissa[i / 2] : -abscissa[i / 2];
        if (!see(s, from->t + h * (0.5 + c), point)) return false;
        for (size_t k = 0; k < p->nv; k++) w->v[k] = point->v[place(w, k)];
        if (p->accel(p->ctx, point->t, point->x, w->v, w->a)) return false;
        for (size_t k = 0; k < p->nv; k++) w->sum[k] += part_of[i / 2] * w->a[k];
    }
    for (size_t k = 0; k < p->nv; k++) {
        const size_t at = place(w, k);
        const double missing = fabs((to->v[at] - from->v[at]) - h * w->sum[k]);
        w->missing[at] += missing;
        most = fmax(most, missing / w->allowed[at]);
    }
    w->spent += POINTS;
    if (most > w->worst && !(w->worst > FIRST)) w->start = from->t, w->length = h;
    w->worst = fmax(w->worst, most);
    w->parts++;
    return true;
}

static bool look(witness *w, stepper *s, const state *from, const state *to, int depth)
{
    state *const middle = &w->at[MIDDLE + depth];
    const bool last = depth == DEPTH || w->parts >= PARTS;
    if (last && w->kinked) return w->parts++, true;
    w->spent += BOUNDS;
    if (last || fits(w, from, to)) return hold(w, s, from, to);
    return see(s, from->t + (to->t - from->t) / 2, middle) && look(w, s, from, middle, depth + 1) &&
           look(w, s, middle, to, depth + 1);
}

/* ---- judging ---- */

/* What a step may lose of each velocity. */
static void allow(witness *w, const problem *p)
{
    const state *const from = &w->at[FROM], *const to = &w->at[TO];
    const double h = fabs(to->t - from->t);
    const size_t whole[2] = {0, p->nv}, *const variable = p->variables ? p->variables : whole;
    const int count = p->variables ? p->variable_count : 1;
    for (int g = 0; g < count; g++) {
        double speed = 0;
        for (size_t k = variable[g]; k < variable[g + 1]; k++)
            speed = fmax(speed, fmax(fmax(fabs(from->v[k]), fabs(to->v[k])), h * w->most[k]));
        const double lost = fmax(ROUNDING * speed, fmax(w->method.relative * speed, w->method.absolute));
        for (size_t k = variable[g]; k < variable[g + 1]; k++) w->allowed[k] = lost > 0 ? lost : 1;
    }
}

/* How far the probe and the step are apart, in units of what is allowed. */
static double apart(witness *w)
{
    const state *const from = &w->at[FROM], *const to = &w->at[TO], *const end = &w->at[END];
    const double h = fabs(to->t - from->t);
    double most = 0;
    for (size_t k = 0; k < w->nv; k++) {
        w->dv[k] = end->v[k] - to->v[k];
        most = fmax(most, fabs(w->dv[k]) / w->allowed[k]);
    }
    for (size_t k = 0; k < w->nx; k++) {
        w->dx[k] = end->x[k] - to->x[k];
        const double size = fmax(fabs(from->x[k]), fabs(to->x[k]));
        const double lost = fmax(fmax(w->method.relative, ROUNDING) * size, h * w->allowed[k]);
        if (lost > 0) most = fmax(most, fabs(w->dx[k]) / lost);
    }
    return most;
}

/* Takes the step once more, as the force asks for; the end is at[END]. */
static bool probe(witness *w, stepper *s, double size)
{
    const state *const from = &w->at[FROM], *const to = &w->at[TO];
    state *const end = &w->at[END];
    const double *x, *v;
    double lost;
    const double t = stepper_marked(s, &lost, &x, &v);
    witness *const inner = w->inner;
    motus_status status = MOTUS_OK;
    stepper_stop why;
    if (!w->probe) {
        status = stepper_create(&w->machine, &w->method, t, size, from->x, from->v, &w->allocator, &w->probe, NULL);
        if (!status) stepper_inspected(w->probe, inspect, inner);
    }
    const double spent = inner->spent;
    inner->tries = 0, inner->differs = NAN;
    inner->earned = spent + fmax(SPEND_LEAST, SPEND_PROBE / w->operations);
    if (!status) status = stepper_jump(w->probe, t, lost, size, from->x, from->v, NULL);
    if (!status) status = stepper_advance(w->probe, (stepper_limit){PROBED, to->t}, &why, NULL);
    if (!status && why != STOP_UNTIL) inner->differs = stepper_time(w->probe);
    w->spent += inner->spent - spent;
    return !status && !stepper_sync(w->probe, end->x, end->v, NULL, NULL);
}

/* Whether more is missing than the run's errors are said to be. */
static bool beyond_bars(const witness *w, const double *v)
{
    double most = 0, size = 0;
    for (size_t k = 0; k < w->nv; k++) most = fmax(most, fabs(v[k])), size = fmax(size, fabs(w->at[TO].v[k]));
    return most > fmax(2.5 * fmax(w->seen->most[1], w->seen->most[2]), ROUNDING * size);
}

/* Whether the stepper is within a step whose end a probe did not come to. */
static bool known(const witness *w, const stepper *s)
{
    return !isnan(w->until) && (w->until - (stepper_time(s) - stepper_last_step(s))) * stepper_last_step(s) > 0;
}

/* Whether it can afford to look at this step. */
static bool affords(witness *w, const stepper *s)
{
    const int64_t all = stepper_evaluations(s);
    const double now = all > w->evaluations ? (double)(all - w->evaluations) : 0,
                 each = w->method.row->expands ? now * now / 4 : now, h = fabs(stepper_last_step(s));
    w->evaluations = all;
    w->earned += 3 * SPEND * each * (stepper_compiled(s) ? COMPILED : 1);
    const bool follows = !w->probes && (w->tries > 0 || known(w, s));
    const double most = w->earned + (follows ? SPEND_SPARED / w->operations : 0);
    if (w->spent > most && (w->probes || h < LONGER * w->longest)) return false;
    w->longest = fmax(h, w->longest);
    return true;
}

/* The step is to be taken again: what the run has spent to see that is not counted, within bounds. */
static double refuse(witness *w, double size, double spent)
{
    w->tries++;
    if (w->probes) return size;
    w->spared += w->spent - spent;
    if (w->spared < SPEND_SPARED / w->operations) w->spent = spent;
    return size;
}

static double inspect(void *ctx, stepper *s)
{
    witness *const w = ctx;
    state *const from = &w->at[FROM], *const to = &w->at[TO];
    const double *x, *v;
    double lost;
    if ((stepper_compiled(s) && !affords(w, s)) || !stepper_swing(s, w->most)) return 0;
    to->t = stepper_time(s), from->t = stepper_marked(s, &lost, &x, &v);
    memcpy(from->x, x, w->nx * sizeof *x);
    memcpy(from->v, v, w->nv * sizeof *v);
    if (stepper_sync(s, to->x, to->v, NULL, NULL)) return 0;
    w->spent += stepper_compiled(s) ? BOUNDS : 0; /* beside a step in the interpreter that is little */
    if (fits(w, from, to) || (!stepper_compiled(s) && !affords(w, s))) {
        w->tries = 0;
        return 0;
    }
    const double spent = w->spent;
    allow(w, stepper_problem(s));
    w->parts = 0, w->worst = 0;
    memset(w->missing, 0, w->nv * sizeof *w->missing);
    if (!look(w, s, from, to, 0)) return 0;
    double most = 0;
    for (size_t k = 0; k < w->nv; k++) most = fmax(most, w->missing[k] / w->allowed[k]);
    const bool suspicious = w->parts > 1 && (most > SUSPICIOUS || (!w->probes && beyond_bars(w, w->missing)));
    if (!suspicious) {
        w->tries = 0;
        return 0;
    }
    const double whole = to->t - from->t, before = w->start - from->t,
                 first = fabs(before) > fabs(w->length) ? before : w->length,
                 size = fabs(first) < ROOM * fabs(whole) ? first : whole / 4;
    if (w->tries >= TRIES) {
        w->differs = from->t;
        return 0;
    }
    if (w->probes || known(w, s)) return refuse(w, size, spent);
    if (!probe(w, s, size)) return 0;
    const double far = apart(w);
    const bool beyond = beyond_bars(w, w->dv);
    if (far > REFUSED) {
        w->until = to->t;
        return refuse(w, size, spent);
    }
    w->moves = beyond && !w->events;
    return 0;
}
