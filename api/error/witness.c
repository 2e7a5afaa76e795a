/* See witness.h.
 *
 * Over a step that leads from v to v', or a part of one, the integral of the force along the dense output has to be v'
 * - v; what is missing is the error that the part makes in the velocity. Gauss's rule takes the integral, at abscissae
 * that the method does not have. Interval arithmetic over all states of a part says whether some operation may pass
 * through more than points can show; such a part is halved, so that no peak and no window is too narrow to be seen.
 * Sizes are added up over the parts, because a force that pushes and then pulls shifts a motion and leaves its
 * velocity. Where the sum is too large already, the look ends, and the step is to end there as well, so that a step
 * pays for the first of many peaks. Where not all peaks can be searched for, no bar is told.
 *
 * Where a switch may stand at 0, the force has more than one value. In a run with located switches, what has happened
 * has to be a mean of what the force does along ways beside the motion, where every switch has one side, however often
 * it is written [Filippov88]. Other runs step across switches, and parts with one are not judged, however short they
 * become.
 */
#include "api/error/witness.h"

#include "api/error/bars.h"
#include "api/request/choice.h"
#include "api/error/convex.h"
#include "api/system/vector.h"
#include "core/events.h"
#include "core/rows.h"
#include "lang/read/verify.h"

#include <math.h>
#include <string.h>

enum {
    POINTS = 8,    /* even */
    DEPTH = 40,    /* most halvings of a step */
    PARTS = 4096,  /* most parts of a step */
    TRIES = 64,    /* most refusals of one step */
    PROBED = 4096, /* most steps of a probe */
    LED = 256,     /* most steps of a probe that leads the companion */
    FINE = 8,      /* halvings after which a part is left in which a switch may change its side */
    HELD = 2,      /* halvings after which ways beside the motion are taken */
    DEEP = 4,      /* halvings after which they are taken where other operations change too, as u/|u| */
    WAYS = 32,     /* ways at first, and how many more are tried to find one that leads nearer */
    MORE = 64,     /* most ways beyond the first */
    IDLE = 4,      /* ways in succession that may not help */
    AHEAD = 256,   /* most steps ahead of which the force is looked at */
    VAIN = 32,     /* steps before that is tried again, where it has failed */
    SHORTER = 6,   /* times that a step is shortened before the force is to blame, and not the step */
    BEHIND = 3,    /* steps that the companion is led through, from the first that lacks something */
    FINEST = 24,   /* most halvings that search for what is narrow in a step */
    RESOLVED = 3,  /* halvings that the step's own points make up for */
    MANY = 8,      /* parts of a step, of which a force with narrow peaks needs more */
    WIDTH = 64     /* most velocities of a run, since for more of them ways say too little */
};
#define NEAR 0x1p-16 /* of the way that a part may lead: how far a way is beside it */
#define SLACK 0x1p-8 /* of the accelerations: the error of dense output */
/* The unit of spending is one evaluation of the typed force by the interpreter. At first so many operations may be
 * spent, but at least so many evaluations; then also a part of the run's evaluations. The part suits a compiled run,
 * whose evaluation costs a thirtieth, and holds for any machine, since looks decide steps and no machine may. A series
 * of order n counts as n^2/4 evaluations. */
#define SPEND_FIRST 4e6   /* operations */
#define SPEND_OF_MANY 1e6 /* operations, where the run is one of many */
#define SPEND_LEAST 200.0
#define SPEND 0.05
#define BOUNDS 12.0 /* evaluations that bounds over a step cost */
#define LONGER 1.25 /* a step longer than all before by this factor is looked at, whatever was spent */
/* Operations for one look at a step; for one probe; for one probe that leads the companion; and, beside the count, for
 * steps that were rightly refused and those that follow up to their ends. Looks at sides are counted by themselves, and
 * may cost as much. */
#define SPEND_STEP 2e7
#define SPEND_PROBE 2e7
#define SPEND_LEAD 2e6
#define SPEND_SPARED 1e9
#define SPARED_OF_MANY 1e8
#define FIRST 0.01      /* times what a step may lose: at the first part that lacks so much the next step is to end */
#define SUSPICIOUS 10.0 /* times what a step may lose */
#define REFUSED 30.0    /* times what a step may lose, between the step and the probe */
#define PROBE_SEES 4.0  /* what a probe has to see is less than what is missing by this factor */
#define ROUNDING 0x1p-46
#define ULP 0x1p-52
#define NOTHING 0x1p-500 /* least of what a number at rest may lose */
#define ROOM 0.75        /* of a refused step: the next one is shorter */
/* Times the largest error told so far. Where steps stand, what is missing of later ones may cancel what was missing of
 * one, so a small part of that error moves the companion. */
#define BARS 2.5
#define PART_OF_BARS 0x1p-4
/* Where the companion is left as it is: the error of one step is at most twice the largest that the companion has shown
 * by then, unless it hides. There the probe has to be far better than the step. */
#define LEFT_BARS 8.0
#define LEFT_TOLERANCE 0x1p-10
#define SHOWN 0x1p-16 /* part of what is missing that may be hidden */
#define MOSTLY 0.5    /* such a part in steps of located runs; less is what the companion sees, too */
#define PROBE "dop853"
#define PROBE_TOLERANCE 1e-10

/* Gauss's abscissae in (0, 1) beyond the middle, less 1/2, and their weights [DLMF, table 3.5.2]. */
static const double abscissa[POINTS / 2] = {0.0917173212478248849, 0.2627662049581645044, 0.3983332387068134038,
                                            0.4801449282487681160};
static const double part_of[POINTS / 2] = {0.1813418916891809915, 0.1568533229389436437, 0.1111905172266872352,
                                           0.0506142681451885293};

typedef struct state { /* of the run, in the inside order */
    double t, *x, *v;
} state;

enum { FROM, TO, MIDDLE, POINT = MIDDLE + DEPTH, END, LAST, STATES };

struct witness {
    const motus_system *typed;
    machine machine; /* of the probe */
    chosen method;   /* of the probe: the run's, or PROBE if `steady` */
    bool steady;     /* the run's steps stand as they are */
    motus_allocator allocator;
    const differences *differences;
    size_t nx, nv;     /* of the run */
    size_t own, other; /* the typed system has the run's first `own` velocities, and those from `other` on */
    resolution *bends; /* what in the force can hide between points */
    state at[STATES];
    double *a, *v;     /* the typed force, and velocities in the order it wants */
    double *most;      /* bounds on the accelerations of the step */
    double *missing;   /* of every velocity: what is missing, sizes added up over the parts */
    double *lack;      /* of every velocity: what is missing, added up with signs */
    double *speed;     /* of every velocity, with the others of its variable: the largest size in the step */
    double *felt;      /* of every velocity: what was missing in a step where it rested */
    double *allowed;   /* of every velocity: what a step may lose */
    double *rounded;   /* of every velocity: what rounding takes, a part of the largest it has been */
    double *rounded_x; /* of every place: what rounding takes, a part of the largest it has been */
    double *dx, *dv;   /* the distance of the probe from the step */
    double share[WAYS + MORE];
    /* of a run with located switches: what the force does along each way, less what has happened */
    double *ways, *room;
    double *scale;      /* the largest accelerations */
    double *weight;     /* 1 over what each velocity may be off */
    double *other_way;  /* one more way */
    resolution *smooth; /* what can hide in the force where its switches keep their sides; NULL: nothing */
    interval *in_x, *in_v;
    interval *clear_x, *clear_v; /* a box in which the force hides nothing, for any step */
    double operations;           /* of one evaluation */
    double first;                /* evaluations that may be spent in any case */
    double most_spared;          /* evaluations that may be spent where the run hides something */
    bool kinked;                 /* the typed force has switches */
    bool located;                /* steps of the run end at switches */
    bool covered;                /* some switches are within sums, where nothing says that they stand at 0 */
    bool probes;                 /* this witness looks at a probe, and refuses at once */
    bool events;                 /* the run has events */
    bool leaves;                 /* it leaves the companion as it is */
    stepper *probe;
    struct witness *inner; /* looks at the probe */
    /* The members from here on are of the present motion. */
    int parts, tries;
    double worst, start,
        length;            /* the most that is missing of a part, in units of what is allowed; the first such part */
    double sides;          /* spent on sides of switches */
    double most_spent;     /* limit on `spent` for the present step */
    double earned, spent;  /* evaluations that it may spend so far, and has spent */
    int64_t evaluations;   /* of the run, so far */
    double longest;        /* of the steps that it has looked at */
    double least;          /* what matters to the bars, of a velocity; INFINITY: only what a step may lose matters */
    double sees;           /* `least` of the probe's own witness */
    bool far;              /* so much is missing that no probe need confirm it */
    double each;           /* what it earns in a step */
    int64_t steps;         /* steps of the run that stand, as far as it was shown them */
    int64_t looked;        /* how many of `steps` it has looked at */
    int64_t rested, rest;  /* steps to leave aside after the last look, and how many of them are to come */
    interval clear;        /* the times of clear_x, clear_v; empty: there is no such box */
    double ahead;          /* how many steps ahead the force is looked at */
    int vain;              /* steps before it is looked at ahead again */
    double spared;         /* evaluations that are not counted */
    bool peaks;            /* the force has narrow peaks */
    double empty[2];       /* times between which nothing is missing, as an earlier step has shown */
    double peak, peak_end; /* times between which much is missing, as an earlier step has shown; NaN */
    bool strict;           /* sides of switches are looked at */
    bool crosses;          /* a switch may stand at 0 within the step */
    bool counted, whole;   /* counted: parts before such a switch were held; whole: parts behind it count as well */
    bool first_only;       /* the look ends behind the first parts of which too much is missing */
    bool ended;            /* the look has ended so */
    double behind_first;
    double clean;      /* up to this time nothing is missing */
    bool exhausted;    /* the look could not afford to tell what hides in some part */
    double past;       /* the beginning of the first part with a switch at 0, behind others; NaN */
    bool beside;       /* no way beside the part at `start` does what has happened */
    int behind;        /* steps to come behind one that lacked something, which the companion may not have passed */
    bool open;         /* what is missing of the step from `past` on is not known */
    bool moves, leads; /* the companion is to be moved by dx and dv, or (leads) by a probe that takes its step */
    bool objected;     /* it has objected to a step of the run */
    bool left;         /* dx and dv are known, and the companion is left as it is */
    bool failed;       /* the last probe failed by an error of its own */
    size_t number;     /* the velocity of which the most was missing where `beside` became true */
    bool held;         /* from `differs` on the motion is not one of the typed force */
    double until;      /* the end of a step from which a probe has differed; NaN */
    double differs;
    double unseen; /* from this time on it could not afford to look, after steps had to be refused; NaN */
};

/* ---- life ---- */

static witness *make(const motus_run *r, const differences *seen)
{
    const problem *const p = &r->system->problem;
    const motus_system *const s = r->home ? r->home : r->system;
    const bool ways = r->home && p->nv <= WIDTH;
    const size_t nx = p->nx + 1, nv = p->nv + 1,
                 numbers = STATES * (nx + nv) + 16 * nv + 4 * (nx + nv) + (ways ? (WAYS + MORE) * nv : 0);
    witness *w = take(&r->allocator, 1, sizeof *w + numbers * sizeof(double));
    if (!w) return NULL;
    *w = (witness){
        .typed = s, .machine = r->machine, .method = r->chosen, .allocator = r->allocator, .differences = seen};
    if (!stepper_refuses(&r->chosen) && row_choose(PROBE, &w->method, NULL, NULL) == MOTUS_OK) {
        w->machine = r->system->machine;
        w->method.relative = PROBE_TOLERANCE;
        w->steady = true;
    }
    w->nx = p->nx, w->nv = p->nv;
    w->own = s->problem.nx, w->other = p->nx;
    w->located = ways;
    double *at = (double *)(void *)(w + 1);
    w->in_x = (interval *)(void *)at, w->in_v = w->in_x + nx;
    w->clear_x = w->in_v + nv, w->clear_v = w->clear_x + nx;
    at += 4 * (nx + nv);
    for (size_t k = 0; k < STATES; k++, at += nx + nv) w->at[k] = (state){.x = at, .v = at + nx};
    double **const arrays[] = {&w->a,  &w->v,    &w->most,  &w->missing, &w->allowed,   &w->rounded,
                               &w->dv, &w->room, &w->scale, &w->weight,  &w->other_way, &w->rounded_x,
                               &w->dx, &w->lack, &w->speed, &w->felt,    &w->ways};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++, at += nv) *arrays[k] = at;
    return w;
}

static stepper_verdict inspect(void *ctx, stepper *);
static bool inspect_piece(void *ctx, stepper *, double until);

/* Finds what can hide. It lives in the system's arena, for all runs. */
static bool find_bends(motus_system *s)
{
    model *const m = s->model;
    const output *const lists[] = {m->boundary, m->accel};
    const size_t counts[] = {m->boundary_count, m->accel_count};
    struct bends *const b = &s->bends;
    if (!b->known)
        b->known = verify_resolution(m, lists, counts, 2, true, &b->all, &b->sums) &&
                   (s->problem.traits.smooth || verify_resolution(m, lists, counts, 2, false, &b->smooth, &b->sums));
    return b->known;
}

static void forget_peak(witness *w) { w->empty[0] = w->empty[1] = w->peak = w->peak_end = NAN; }

/* Forgets the motion so far. */
static void forget(witness *w, const stepper *s)
{
    memset((char *)w + offsetof(witness, parts), 0, sizeof *w - offsetof(witness, parts));
    memset(w->rounded, 0, (w->nv + 1) * sizeof *w->rounded);
    memset(w->rounded_x, 0, (w->nv + 1) * sizeof *w->rounded_x);
    memset(w->felt, 0, (w->nv + 1) * sizeof *w->felt);
    w->until = w->differs = w->unseen = NAN;
    forget_peak(w);
    w->least = INFINITY;
    w->clear = (interval){1, -1};
    w->ahead = AHEAD / 16;
    w->earned = w->first;
    w->evaluations = s ? stepper_evaluations(s) : 0;
}

void witness_begin(witness *w, const motus_run *r)
{
    forget(w, r->stepper);
    forget(w->inner, w->probe);
    stepper_inspected(r->stepper, w->steady && r->events ? NULL : inspect, w);
    if (r->events) events_witnessed(r->events, inspect_piece, w);
}

motus_status witness_create(const motus_run *r, const differences *seen, bool many, witness **out, motus_error *err)
{
    motus_system *const s = r->home ? r->home : r->system;
    *out = NULL;
    if (!s->model || r->locate) return MOTUS_OK;
    if (!find_bends(s)) return fail(err, MOTUS_MEMORY, "no memory for a witness of the run");
    weight each;
    const bool any = s->bends.all || (r->home && s->bends.sums);
    motus_status status = any ? choice_weigh(s, &each, err) : MOTUS_OK;
    if (status != MOTUS_OK || !any) return status;
    witness *const w = make(r, seen);
    if (w) w->inner = make(r, seen);
    if (!w || !w->inner) {
        witness_destroy(w);
        return fail(err, MOTUS_MEMORY, "no memory for a witness of the run");
    }
    w->operations = w->inner->operations = each.values + 10 * (double)s->problem.nv;
    w->first = w->inner->first = fmax(SPEND_LEAST, (many ? SPEND_OF_MANY : SPEND_FIRST) / w->operations);
    w->most_spared = (many ? SPARED_OF_MANY : SPEND_SPARED) / w->operations;
    w->events = r->events != NULL;
    w->kinked = w->inner->kinked = !s->problem.traits.smooth;
    w->bends = w->inner->bends = s->bends.all;
    w->smooth = w->inner->smooth = s->bends.smooth;
    w->covered = w->inner->covered = s->bends.sums;
    w->inner->probes = true, w->inner->steady = false;
    witness_begin(w, r);
    *out = w;
    return MOTUS_OK;
}

void witness_leave(witness *w) { w->leaves = true; }

void witness_destroy(witness *w)
{
    if (!w) return;
    const motus_allocator a = w->allocator;
    stepper_destroy(w->probe);
    give(&a, w->inner);
    give(&a, w);
}

bool witness_waits(const witness *w) { return w && w->moves; }

bool witness_moves(const witness *w, witness_move *to)
{
    if (!w || !w->moves) return false;
    *to = (witness_move){w->leads ? w->at[FROM].t : NAN, w->dx, w->dv};
    return true;
}

void witness_moved(witness *w) { w->moves = false; }

double witness_differs(const witness *w, size_t *number)
{
    if (number) *number = w && w->held ? w->inner->number : SIZE_MAX;
    return w ? w->differs : NAN;
}

double witness_unseen(const witness *w) { return w ? w->unseen : NAN; }

double witness_looked(const motus_run *r)
{
    const struct bends *const b = r->home ? &r->home->bends : &r->system->bends;
    const witness *const w = r->bars ? r->bars->witness : NULL;
    if (!w) return b->known && !b->all && !(r->home && b->sums) ? 1 : NAN;
    return w->steps ? (double)w->looked / (double)w->steps : 1;
}

/* ---- looking ---- */

static bool see(stepper *s, double t, state *to)
{
    to->t = t;
    return stepper_sample(s, t, to->x, to->v, NULL) == MOTUS_OK;
}

/* Returns the place among the run's velocities of velocity k of the typed system, which has no sides of switches. */
static size_t place(const witness *w, size_t k) { return k < w->own ? k : k - w->own + w->other; }

static interval about(double middle, double half) { return (interval){middle - half, middle + half}; }

/* Finds the box of the motion in a part of a step. Returns its times. */
static interval surround(witness *w, const state *from, const state *to)
{
    const problem *const p = &w->typed->problem;
    const double h = fabs(to->t - from->t);
    for (size_t k = 0; k < p->nv; k++) {
        const size_t at = place(w, k);
        const double around = w->strict ? SUSPICIOUS * w->rounded[at] : 0;
        w->in_v[k] = about(from->v[at] + (to->v[at] - from->v[at]) / 2, h / 2 * w->most[at] + around);
    }
    for (size_t k = 0; k < p->nx; k++) {
        const double way = to->x[k] - from->x[k], around = w->strict ? SUSPICIOUS * w->rounded_x[k] : 0;
        w->in_x[k] = about(from->x[k] + way / 2, fabs(way) / 2 + h * h / 8 * w->most[k] + around);
    }
    return (interval){fmin(from->t, to->t), fmax(from->t, to->t)};
}

static bool passes(witness *w, resolution *bends, interval t, interval *x, interval *v)
{
    w->spent += BOUNDS;
    return resolution_fits(bends, t, x, v, w->typed->model->pool);
}

static bool inside(const interval *part, const interval *whole, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (!(part[k].low >= whole[k].low && part[k].high <= whole[k].high)) return false;
    return true;
}

/* Extends an interval to the next steps, on the side to which it moves, and somewhat on both. */
static interval extend(interval now, double way, double steps)
{
    const double most = (now.high - now.low) * steps / 4, far = way * steps;
    return (interval){now.low + fmin(far, 0) - most, now.high + fmax(far, 0) + most};
}

/* Returns whether nothing hides in a whole step, with the box in_x, in_v and the times t. What fits over a box fits
 * over every part of it, so many short steps need one look, at where they may lead. */
static bool clear(witness *w, const state *from, const state *to, interval t)
{
    const problem *const p = &w->typed->problem;
    if (inside(&t, &w->clear, 1) && inside(w->in_x, w->clear_x, p->nx) && inside(w->in_v, w->clear_v, p->nv))
        return true;
    if (w->vain > 0) return w->vain--, passes(w, w->bends, t, w->in_x, w->in_v);
    for (size_t k = 0; k < p->nx; k++) w->clear_x[k] = extend(w->in_x[k], to->x[k] - from->x[k], w->ahead);
    for (size_t k = 0; k < p->nv; k++)
        w->clear_v[k] = extend(w->in_v[k], to->v[place(w, k)] - from->v[place(w, k)], w->ahead);
    w->clear = extend(t, to->t - from->t, w->ahead);
    if (passes(w, w->bends, w->clear, w->clear_x, w->clear_v)) return w->ahead = fmin(2 * w->ahead, AHEAD), true;
    w->clear = (interval){1, -1};
    w->ahead /= 4;
    if (w->ahead < 2) w->ahead = AHEAD / 16, w->vain = VAIN;
    return passes(w, w->bends, t, w->in_x, w->in_v);
}

static bool fits(witness *w, resolution *bends, const state *from, const state *to)
{
    const interval t = bends ? surround(w, from, to) : (interval){0, 0};
    const bool whole = bends == w->bends && from == &w->at[FROM] && to == &w->at[TO] && !w->strict;
    return !bends || (whole ? clear(w, from, to, t) : passes(w, bends, t, w->in_x, w->in_v));
}

/* Returns a number in [-1, 1) from those of a way and a variable. */
static double turn(uint32_t way, size_t k)
{
    uint64_t state = ((uint64_t)way - 1) * 0x9e3779b97f4a7c15u + ((uint64_t)k + 1) * 0xd1b54a32d192ed03u;
    return vector_random(&state);
}

/* Returns what a step may lose of a place. */
static double lost_of_place(const witness *w, size_t k, double x, double h)
{
    return fmax(fmax(w->method.relative, ROUNDING) * fabs(x), h * w->allowed[k]);
}

/* Moves a state of the motion to a way beside it, farther than rounding and than what a step may lose. */
static void step_aside(const witness *w, double *x, double *v, double h, uint32_t way)
{
    const problem *const p = &w->typed->problem;
    h = fabs(h);
    for (size_t k = 0; k < p->nx; k++) {
        const double lost = fmax(lost_of_place(w, k, x[k], h), w->rounded_x[k]);
        const double far = NEAR * h * (fabs(v[k]) + h * w->scale[k]) + SUSPICIOUS * lost;
        x[k] += far * turn(way, p->nv + k);
    }
    for (size_t k = 0; k < p->nv; k++)
        v[k] += (NEAR * h * w->scale[k] + SUSPICIOUS * w->allowed[place(w, k)]) * turn(way, k);
}

/* Counts a part. most: the most that is missing of it, in units of what is allowed. */
static void count_part(witness *w, const state *from, double h, double most)
{
    if (most > w->worst && !(w->worst > FIRST)) w->start = from->t, w->length = h;
    w->worst = fmax(w->worst, most);
    w->parts++;
}

/* Integrates the force over a part, and finds the largest accelerations in it. way 0: along the motion; others lie
 * beside it, each on one side from the beginning to the end of the part. */
static bool integrate(witness *w, stepper *s, const state *from, double h, uint32_t way, double *sum)
{
    const problem *const p = &w->typed->problem;
    state *const point = &w->at[POINT];
    for (size_t k = 0; k < p->nv; k++) sum[k] = 0;
    for (int i = 0; i < POINTS; i++) {
        const double c = i & 1 ? abscissa[i / 2] : -abscissa[i / 2];
        if (!see(s, from->t + h * (0.5 + c), point)) return false;
        for (size_t k = 0; k < p->nv; k++) w->v[k] = point->v[place(w, k)];
        if (way) step_aside(w, point->x, w->v, h, way);
        if (p->accel(p->ctx, point->t, point->x, w->v, w->a)) return false;
        for (size_t k = 0; k < p->nv; k++) {
            sum[k] += part_of[i / 2] * h * w->a[k];
            w->scale[k] = fmax(w->scale[k], fabs(w->a[k]));
        }
    }
    w->spent += POINTS;
    return true;
}

/* Finds how much each velocity may be off in a part before another force must be what moves it. */
static void find_weights(witness *w, double h)
{
    for (size_t k = 0; k < w->typed->problem.nv; k++) {
        const size_t at = place(w, k);
        w->weight[k] = 1 / (SLACK * fabs(h) * w->scale[k] + SUSPICIOUS * (w->probes ? w->rounded : w->allowed)[at]);
    }
}

/* Notes that too much, `room`, is missing of a part. */
static void note_beside(witness *w)
{
    double most = 0;
    w->beside = true;
    for (size_t k = 0; k < w->typed->problem.nv; k++) {
        const double off = fabs(w->room[k]) * w->weight[k];
        if (off > most) most = off, w->number = k;
    }
}

/* Computes what the force does along a way, less what has happened. */
static bool follow(witness *w, stepper *s, const state *from, const state *to, uint32_t way, double *less)
{
    if (!integrate(w, s, from, to->t - from->t, way, less)) return false;
    for (size_t k = 0; k < w->typed->problem.nv; k++) less[k] -= to->v[place(w, k)] - from->v[place(w, k)];
    return true;
}

/* Bounds the accelerations of a marked step that begins at[FROM]. Where the method has no bounds, they are twice the
 * force's largest values at points between. */
static bool bound(witness *w, stepper *s)
{
    const double h = stepper_time(s) - w->at[FROM].t;
    if (stepper_swing(s, w->most)) return true;
    memset(w->scale, 0, w->nv * sizeof *w->scale);
    memset(w->most, 0, w->nv * sizeof *w->most);
    if (!integrate(w, s, &w->at[FROM], h, 0, w->room)) return false;
    for (size_t k = 0; k < w->typed->problem.nv; k++) w->most[place(w, k)] = 2 * w->scale[k];
    return true;
}

/* Adds up what is missing of a part. */
static bool hold(witness *w, stepper *s, const state *from, const state *to)
{
    const double h = to->t - from->t;
    double most = 0, off = 0;
    for (size_t k = 0; k < w->typed->problem.nv; k++) w->scale[k] = w->most[place(w, k)];
    if (!follow(w, s, from, to, 0, w->room)) return false;
    find_weights(w, h);
    for (size_t k = 0; k < w->typed->problem.nv; k++) {
        const double missing = fabs(w->room[k]);
        w->missing[place(w, k)] += missing;
        w->lack[place(w, k)] += w->room[k];
        most = fmax(most, missing / w->allowed[place(w, k)]);
        off = fmax(off, missing * w->weight[k]);
    }
    if (w->strict && off > 1) note_beside(w);
    count_part(w, from, h, most);
    return true;
}

/* Finds, of WAYS ways, the one that leads farthest from `room` towards the origin. */
static bool nearest(witness *w, stepper *s, const state *from, const state *to, uint32_t *way, double *best)
{
    const size_t n = w->typed->problem.nv;
    double least = INFINITY, *const one = w->other_way;
    for (const uint32_t end = *way + WAYS; *way < end; (*way)++) {
        if (!follow(w, s, from, to, *way, one)) return false;
        const double along = convex_product(w->room, one, w->weight, n);
        if (along < least) least = along, memcpy(best, one, n * sizeof *best);
    }
    return true;
}

/* Adds up what is missing of a part where a switch may stand at 0: what no mean of the ways beside it does. */
static bool hold_beside(witness *w, stepper *s, const state *from, const state *to)
{
    const size_t n = w->typed->problem.nv;
    const double h = to->t - from->t;
    uint32_t way = 0, count = 0;
    for (size_t k = 0; k < n; k++) w->scale[k] = w->most[place(w, k)];
    for (; way < WAYS; way++, count++)
        if (!follow(w, s, from, to, way, w->ways + way * n)) return false;
    find_weights(w, h);
    double off = convex_distance(w->ways, count, n, w->weight, 1, w->share, w->room);
    for (int idle = 0; off > 1 && count < WAYS + MORE && idle < IDLE;) {
        const double least = off;
        if (!nearest(w, s, from, to, &way, w->ways + count * n)) return false;
        off = convex_distance(w->ways, ++count, n, w->weight, 1, w->share, w->room);
        idle = off < (1 - SLACK) * least ? 0 : idle + 1;
    }
    const bool is = off > 1;
    for (size_t k = 0; is && k < n; k++) w->missing[place(w, k)] += fabs(w->room[k]);
    if (is) note_beside(w);
    count_part(w, from, h, is ? SUSPICIOUS * off : 0);
    return true;
}

/* Returns whether more is missing of n places or velocities y than their errors. */
static bool beyond_errors(const double *missing, const double *y, size_t n, double errors)
{
    return vector_largest(missing, n) > fmax(errors, ROUNDING * vector_largest(y, n));
}

static bool beyond_velocities(const witness *w, const double *missing, double times)
{
    return beyond_errors(missing, w->at[TO].v, w->nv, times * fmax(w->differences->most[1], w->differences->most[2]));
}

static bool beyond_places(const witness *w, const double *missing, double times)
{
    return beyond_errors(missing, w->at[TO].x, w->nx, times * w->differences->most[0]);
}

/* Returns whether too much is missing of a step, and finds `sees` and `far`. */
static bool suspects(witness *w)
{
    double most = 0;
    for (size_t k = 0; k < w->nv; k++) most = fmax(most, w->missing[k] / w->allowed[k]);
    const double least = vector_largest(w->missing, w->nv) / (PROBE_SEES * SUSPICIOUS);
    w->sees = most > SUSPICIOUS ? INFINITY : least;
    w->far = most > SUSPICIOUS * REFUSED;
    return most > SUSPICIOUS || (!w->probes && beyond_velocities(w, w->missing, BARS));
}

/* Returns whether something is missing of a number that rests. */
static bool stirs(const witness *w, size_t k)
{
    return w->speed[k] <= NOTHING && w->missing[k] > NOTHING && isfinite(w->missing[k]);
}

/* Returns whether the look may end, since too much is missing. For a number that rests it may not: what is missing is
 * its size. */
static bool shows_enough(witness *w)
{
    bool any = false;
    for (size_t k = 0; k < w->nv && !any; k++) any = stirs(w, k);
    return !any && suspects(w) && w->far;
}

/* Holds a part in which no switch stands at 0. It counts if it lies before every switch, or the whole step counts. */
static bool hold_before(witness *w, stepper *s, const state *from, const state *to)
{
    if (!isnan(w->past) && !w->whole) return w->parts++, true;
    w->counted = true;
    if (!hold(w, s, from, to)) return false;
    if (vector_largest(w->missing, w->nv) <= ULP * vector_largest(to->v, w->nv)) w->clean = to->t;
    w->ended = w->first_only && (from != &w->at[FROM] || to != &w->at[TO]) && shows_enough(w);
    if (w->ended) w->behind_first = to->t;
    return true;
}

/* Notes that a switch may stand at 0 in a part that begins at t. */
static void cross(witness *w, double t)
{
    w->crosses = true;
    if (w->counted && isnan(w->past)) w->past = t;
}

static bool look(witness *w, stepper *s, const state *from, const state *to, int depth)
{
    if (w->ended) return true;
    state *const middle = &w->at[MIDDLE + depth];
    const bool spent = w->parts >= PARTS || w->spent > w->most_spent, last = depth == DEPTH || spent;
    const bool known = depth == 0 && !w->strict; /* the whole step did not fit before */
    if (!w->covered && !known && fits(w, w->bends, from, to)) return hold_before(w, s, from, to);
    const bool sided = (w->located || (w->steady && w->kinked)) && depth >= (w->steady || w->strict ? HELD : FINE),
               deep = w->strict && (depth >= DEEP || last);
    if (sided && (deep || fits(w, w->smooth, from, to))) {
        cross(w, from->t);
        return w->strict ? hold_beside(w, s, from, to) : (w->parts++, true);
    }
    if (last && w->kinked) return cross(w, from->t), w->parts++, true;
    w->exhausted |= spent;
    if (last) return hold_before(w, s, from, to);
    return see(s, from->t + (to->t - from->t) / 2, middle) && look(w, s, from, middle, depth + 1) &&
           look(w, s, middle, to, depth + 1);
}

/* ---- judging ---- */

/* Finds what a step may lose of each velocity. */
static void allow(witness *w, const problem *p)
{
    const state *const from = &w->at[FROM], *const to = &w->at[TO];
    const double h = fabs(to->t - from->t);
    const size_t whole[2] = {0, p->nv}, *const variable = p->variables ? p->variables : whole;
    const int count = p->variables ? p->variable_count : 1;
    for (int g = 0; g < count; g++) {
        double speed = 0;
        for (size_t k = variable[g]; k < variable[g + 1]; k++)
            speed = fmax(speed, fmax(fmax(fabs(from->v[k]), fabs(to->v[k])), fmax(h * w->most[k], w->felt[k])));
        const double most = fmax(w->method.relative * speed, w->method.absolute);
        const double lost = fmax(ROUNDING * speed, fmin(most, w->least));
        for (size_t k = variable[g]; k < variable[g + 1]; k++) {
            w->speed[k] = speed;
            w->rounded[k] = fmax(fmax(ROUNDING * speed, w->rounded[k]), NOTHING);
            w->allowed[k] = fmax(lost, w->strict ? w->rounded[k] : NOTHING);
        }
    }
    for (size_t k = 0; k < w->nx; k++)
        w->rounded_x[k] = fmax(ROUNDING * fmax(fabs(from->x[k]), fabs(to->x[k])), w->rounded_x[k]);
}

/* Finds how far the probe and the step are apart, in units of what is allowed. */
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
        const double lost = lost_of_place(w, k, fmax(fabs(from->x[k]), fabs(to->x[k])), h);
        if (lost > 0) most = fmax(most, fabs(w->dx[k]) / lost);
    }
    return most;
}

/* Leads a probe from a state at t + lost to `until`; the end is at[END]. least: as in struct witness. */
static bool lead(witness *w, double t, double lost, const double *x, const double *v, double until, double size,
                 double least)
{
    state *const end = &w->at[END];
    witness *const inner = w->inner;
    motus_status status = MOTUS_OK;
    stepper_stop why;
    if (!w->probe) {
        chosen method = w->method;
        if (w->leaves) method.relative = fmax(LEFT_TOLERANCE * method.relative, ROUNDING);
        status = stepper_create(&w->machine, &method, t, size, x, v, &w->allocator, &w->probe, NULL);
        if (!status) stepper_inspected(w->probe, inspect, inner);
    }
    const double spent = inner->spent;
    const int64_t before = w->probe ? stepper_evaluations(w->probe) : 0;
    inner->tries = 0, inner->differs = NAN, inner->held = false;
    forget_peak(inner);
    inner->least = least;
    inner->earned = spent + fmax(SPEND_LEAST, (w->steady ? SPEND_LEAD : SPEND_PROBE) / w->operations);
    if (!status) status = stepper_jump(w->probe, t, lost, size, x, v, NULL);
    const int64_t most = w->steady ? LED : PROBED;
    if (!status) status = stepper_advance(w->probe, (stepper_limit){most, until}, &why, NULL);
    w->failed = status != MOTUS_OK;
    if (!status && why != STOP_UNTIL) inner->differs = stepper_time(w->probe);
    w->spent += inner->spent - spent + (w->steady ? (double)(stepper_evaluations(w->probe) - before) : 0);
    if (w->steady && !status && why != STOP_UNTIL) return false;
    return !status && !stepper_sync(w->probe, end->x, end->v, NULL, NULL);
}

/* Takes the run's step once more by a probe. */
static bool probe(witness *w, stepper *s, double size, double least)
{
    const state *const from = &w->at[FROM];
    const double *x, *v;
    double lost;
    const double t = stepper_marked(s, &lost, &x, &v);
    return lead(w, t, lost, from->x, from->v, w->at[TO].t, size, least);
}

bool witness_lead(witness *w, double t, double until, double *x, double *v)
{
    if (!lead(w, t, 0, x, v, until, (until - t) / 4, INFINITY)) return false;
    memcpy(x, w->at[END].x, w->nx * sizeof *x);
    memcpy(v, w->at[END].v, w->nv * sizeof *v);
    return true;
}

/* Returns whether the probe is farther from the end of the step than so many times the errors. */
static bool beyond_bars(const witness *w, double times)
{
    return beyond_velocities(w, w->dv, times) || beyond_places(w, w->dx, times);
}

/* Returns whether the stepper is within a step from whose end a probe has differed. */
static bool known(const witness *w, const stepper *s)
{
    return !isnan(w->until) && (w->until - (stepper_time(s) - stepper_last_step(s))) * stepper_last_step(s) > 0;
}

static void earn(witness *w, const stepper *s)
{
    const int64_t all = stepper_evaluations(s);
    const double now = all > w->evaluations ? (double)(all - w->evaluations) : 0,
                 each = w->method.row->expands ? now * now / 4 : now;
    w->evaluations = all;
    w->earned += SPEND * each;
}

/* Returns how much need not be counted: a force that has hidden something once may do so again, so within bounds, and
 * beyond them up to the cost of the run, spending is free from then on. */
static double most_spared(const witness *w) { return w->probes ? 0 : w->most_spared + (w->earned - w->first) / SPEND; }

static void spare(witness *w, double spent)
{
    w->spared += w->spent - spent;
    if (w->spared < most_spared(w)) w->spent = spent;
}

/* Returns whether a look at this step is affordable. */
static bool affords(witness *w, const stepper *s)
{
    const double h = fabs(stepper_last_step(s));
    earn(w, s);
    const bool spares = (w->peaks || w->tries > 0 || known(w, s)) && w->spared < most_spared(w);
    if (!spares && w->spent > w->earned && (w->probes || h < LONGER * w->longest)) return false;
    w->longest = fmax(h, w->longest);
    return true;
}

/* Notes that from t on not all steps are searched for peaks. */
static void miss(witness *w, double t)
{
    if (isnan(w->unseen)) w->unseen = t;
}

/* Returns whether a look may have found a peak: no switch stands at 0, and other operations can hide something. */
static bool may_be_peak(const witness *w) { return !w->crosses && (!w->kinked || w->smooth); }

/* Refuses the step, which is to be taken again with this size. */
static double refuse(witness *w, double size)
{
    w->tries++, w->objected = true;
    w->peaks |= may_be_peak(w);
    return size;
}

/* Reads the ends of a marked step. */
static bool see_ends(witness *w, stepper *s)
{
    state *const from = &w->at[FROM], *const to = &w->at[TO];
    const double *x, *v;
    double lost;
    to->t = stepper_time(s), from->t = stepper_marked(s, &lost, &x, &v);
    memcpy(from->x, x, w->nx * sizeof *x);
    memcpy(from->v, v, w->nv * sizeof *v);
    w->spent++;
    return stepper_sync(s, to->x, to->v, NULL, NULL) == MOTUS_OK;
}

/* Finds the sizes of numbers that rest and of which something is missing; they may lose nothing, so that without a size
 * the least would count as much as all. Returns whether there are any. */
static bool feels(witness *w)
{
    bool more = false;
    for (size_t k = 0; k < w->nv; k++) {
        if (!stirs(w, k)) continue;
        w->felt[k] = w->missing[k];
        more = true;
    }
    return more;
}

/* Adds up what is missing of the whole step. */
static bool look_at_all(witness *w, stepper *s, bool whole)
{
    w->whole = whole;
    for (int time = 0; time < 2; time++) {
        w->most_spent = w->spent + fmax(SPEND_LEAST, SPEND_STEP / w->operations);
        allow(w, stepper_problem(s));
        w->parts = 0, w->worst = 0, w->beside = w->crosses = w->counted = w->ended = w->exhausted = false;
        w->past = NAN;
        w->clean = w->at[FROM].t;
        memset(w->missing, 0, w->nv * sizeof *w->missing);
        memset(w->lack, 0, w->nv * sizeof *w->lack);
        if (!look(w, s, &w->at[FROM], &w->at[TO], 0)) return false;
        if (!feels(w)) break;
    }
    return true;
}

/* Returns whether Gauss's rule over the whole step misses such a part of what is missing. */
static bool hides(witness *w, stepper *s, double part)
{
    double most = 0, hidden = 0;
    if (!follow(w, s, &w->at[FROM], &w->at[TO], 0, w->room)) return false;
    for (size_t k = 0; k < w->typed->problem.nv; k++) {
        const double lack = w->lack[place(w, k)];
        most = fmax(most, fabs(lack)), hidden = fmax(hidden, fabs(lack - w->room[k]));
    }
    return hidden > part * most;
}

/* Returns whether a step lacks something that it does not show, or leads across a switch, which the companion may do at
 * the same time. In runs with events both know of their switches. */
static bool lacks(witness *w, stepper *s)
{
    if (fits(w, w->bends, &w->at[FROM], &w->at[TO]) || !look_at_all(w, s, true)) return false;
    w->peaks |= w->parts > MANY && may_be_peak(w);
    if (w->crosses) return !w->events && !w->covered && !w->leaves;
    return w->parts > 1 && beyond_velocities(w, w->missing, PART_OF_BARS) && hides(w, s, SHOWN);
}

/* Compares a step that stands with the force; what it lacks moves the companion, which waits for it. */
static void compare(witness *w, stepper *s, double until)
{
    const state *const from = &w->at[FROM], *const to = &w->at[TO];
    if (w->moves || !see_ends(w, s) || !bound(w, s) || (until != to->t && !see(s, until, &w->at[TO]))) return;
    if (from->t == until) return;
    w->behind = lacks(w, s) ? BEHIND : w->behind > 0 ? w->behind - 1 : 0;
    w->leads = !w->events, w->moves = w->leads && w->behind > 0;
    if (w->leads || w->behind < BEHIND || !probe(w, s, (until - from->t) / 4, INFINITY)) return;
    apart(w);
    w->moves = beyond_velocities(w, w->dv, PART_OF_BARS) || beyond_places(w, w->dx, PART_OF_BARS);
}

/* Returns how many steps are to be left aside before another look is affordable. The number varies, for motions that
 * repeat themselves. */
static int64_t rest_of(const witness *w)
{
    const double owes = w->peaks && w->spared < most_spared(w) ? 0 : w->spent - w->earned;
    return owes > 0 ? (int64_t)(owes / w->each * (1 + turn((uint32_t)w->steps, 0) / 2)) : 0;
}

static stepper_verdict inspect_steady(witness *w, stepper *s, double until)
{
    const double before = w->earned;
    earn(w, s);
    w->each = fmax(SPEND, (w->earned - before) / (double)(w->rested + 1));
    w->steps += w->rested + 1;
    if (rest_of(w) == 0) {
        const double spent = w->spent;
        compare(w, s, until);
        if (w->peaks) spare(w, spent);
        w->looked++;
    }
    w->rested = rest_of(w);
    if (w->peaks && w->rested > 0) miss(w, stepper_time(s));
    w->objected |= w->moves;
    return (stepper_verdict){.rest = w->rested, .halt = w->moves};
}

/* Returns the size of the next step, up to the first part that lacks much, where a step lacks too much. */
static double shorter(const witness *w, double whole)
{
    const double before = w->start - w->at[FROM].t, first = fabs(before) > fabs(w->length) ? before : w->length;
    return !w->beside && fabs(first) < ROOM * fabs(whole) ? first : whole / 4;
}

/* Returns the size of the next step if a probe to at[TO] confirms that the step is wrong; 0: the step stands. */
static double object(witness *w, stepper *s, double whole)
{
    const state *const from = &w->at[FROM];
    const double size = shorter(w, whole);
    /* where a switch stands at 0 at the start of a step, every step is off */
    if (w->tries >= (w->beside ? SHORTER : TRIES)) {
        if (w->beside || !w->kinked) w->differs = from->t, w->held |= w->beside, w->objected = true;
        return 0;
    }
    if (w->probes || known(w, s)) return refuse(w, size);
    if (!probe(w, s, size, w->sees)) /* shorter steps of the run may fail as well, and tell why */
        return w->failed && !w->kinked ? refuse(w, size) : 0;
    const double far = apart(w);
    const bool beyond = beyond_bars(w, BARS) && (!w->located || (far > FIRST && hides(w, s, MOSTLY)));
    if (far > REFUSED) {
        w->until = w->at[TO].t;
        return refuse(w, size);
    }
    w->moves = beyond && !w->leaves;
    w->left = beyond && w->leaves;
    return 0;
}

/* Lets a step stand in which nothing was found, unless the look ended before it had seen all of narrow peaks. */
static double pass(witness *w, double whole)
{
    const bool many = w->parts > MANY && may_be_peak(w), lost = many && w->exhausted;
    w->peaks |= many;
    if (lost && w->tries < SHORTER) return refuse(w, whole / 4);
    if (lost) miss(w, w->at[FROM].t);
    return w->tries = 0;
}

static double earlier(double a, double b, double way) { return way < 0 ? fmax(a, b) : fmin(a, b); }

/* Looks for the first peak that the step hides; for that no probe is asked, so that a step pays for the first of many
 * peaks. *again: the size of the next step; 0: nothing is hidden. False: the look failed. */
static bool judge_first(witness *w, stepper *s, double *again)
{
    state *const to = &w->at[TO];
    const double from = w->at[FROM].t, end = to->t, whole = end - from;
    w->first_only = true;
    const bool looked = look_at_all(w, s, true);
    w->first_only = false;
    *again = 0;
    if (!looked || !w->ended || w->kinked || w->tries >= TRIES) return looked;
    const bool hidden = see(s, w->behind_first, to) && hides(w, s, MOSTLY), back = see(s, end, to);
    if (!back || !hidden) return back;
    w->until = end;
    w->empty[0] = from, w->empty[1] = earlier(w->start, w->clean, whole);
    w->peak = w->start, w->peak_end = w->start + w->length;
    *again = refuse(w, shorter(w, whole));
    return true;
}

/* Forgets the peak unless the step leads on from the state where the last one ended. */
static void go_on(witness *w)
{
    const state *const from = &w->at[FROM], *const to = &w->at[TO], *const last = &w->at[LAST];
    const size_t x = w->nx * sizeof *from->x, v = w->nv * sizeof *from->v;
    if (!isnan(w->peak) && w->tries == 0 && (memcmp(from->x, last->x, x) != 0 || memcmp(from->v, last->v, v) != 0))
        forget_peak(w);
    memcpy(last->x, to->x, x);
    memcpy(last->v, to->v, v);
}

/* Returns whether an earlier step decides: it has shown nothing before the peak, and a long step leaps over it. *again:
 * the size of the next step; 0: the step stands. */
static bool meets_peak(witness *w, double *again)
{
    const double from = w->at[FROM].t, to = w->at[TO].t, sign = to < from ? -1 : 1, whole = fabs(to - from),
                 before = sign * (w->peak - from), length = sign * (w->peak_end - w->peak),
                 first = fmax(before, length);
    *again = 0;
    if (sign * (from - w->empty[0]) >= 0 && sign * (w->empty[1] - to) >= 0) {
        w->tries = 0;
        return true;
    }
    if (!(sign * (w->peak_end - from) > 0 && whole > before && first < ROOM * whole) || w->tries >= TRIES) return false;
    *again = refuse(w, sign * first);
    return true;
}

/* Finds the shortest piece, the first of equals, into which a part is halved until only a switch may hide something.
 * False: too many halvings or evaluations are needed, or sampling fails. */
static bool find_shortest(witness *w, stepper *s, const state *from, const state *to, int depth, int *deepest)
{
    state *const middle = &w->at[MIDDLE + depth];
    if (fits(w, w->smooth, from, to)) {
        if (depth > *deepest) *deepest = depth, w->start = from->t, w->length = to->t - from->t;
        return true;
    }
    return depth < FINEST && w->spent <= w->most_spent && see(s, from->t + (to->t - from->t) / 2, middle) &&
           find_shortest(w, s, from, middle, depth + 1, deepest) && find_shortest(w, s, middle, to, depth + 1, deepest);
}

/* Returns whether the run's own points resolve what the force does besides, where a switch stands at 0. There no
 * integral tells what is missing: what lets go a state that is held is found at these points. */
static bool resolves(witness *w, stepper *s)
{
    int deepest = 0;
    if (!w->crosses || !w->smooth || w->tries >= TRIES) return true;
    w->most_spent = w->spent + fmax(SPEND_LEAST, SPEND_STEP / w->operations);
    const bool narrow = find_shortest(w, s, &w->at[FROM], &w->at[TO], 0, &deepest) && deepest > RESOLVED;
    w->peaks |= narrow;
    return !narrow;
}

/* Returns the size by which a step is to be taken again; 0: the step stands. A located run may end the step at a
 * switch, behind which the force is another one: what is missing from there on is open. */
static double judge(witness *w, stepper *s)
{
    const state *const from = &w->at[FROM], *const to = &w->at[TO];
    double again = 0;
    if (!see_ends(w, s) || !bound(w, s)) return 0;
    const double whole = to->t - from->t;
    const bool all = w->located || w->strict;
    go_on(w);
    if (!w->strict && fits(w, w->bends, from, to)) return w->tries = 0;
    if (!all && (meets_peak(w, &again) || !judge_first(w, s, &again) || again != 0)) return again;
    if ((all || w->ended) && !look_at_all(w, s, !w->located || w->strict)) return 0;
    w->open = !w->whole && !isnan(w->past);
    if (!(w->parts > 1 && suspects(w)) && !w->beside)
        return w->strict || resolves(w, s) ? pass(w, whole) : refuse(w, shorter(w, whole));
    return w->open && !see(s, w->past, &w->at[TO]) ? 0 : object(w, s, whole);
}

bool witness_objected(witness *w)
{
    if (!w) return false;
    if (w->left) w->objected |= w->differences->taken == w->at[TO].t && beyond_bars(w, LEFT_BARS);
    w->left = false;
    return w->objected;
}

static stepper_verdict inspect(void *ctx, stepper *s)
{
    witness *const w = ctx;
    if (w->steady) return inspect_steady(w, s, stepper_time(s));
    witness_objected(w);
    w->moves = w->open = w->exhausted = false;
    const bool afforded = affords(w, s);
    if (!afforded && w->peaks && w->spared >= most_spared(w)) miss(w, stepper_time(s) - stepper_last_step(s));
    const double spent = w->spent, again = afforded ? judge(w, s) : 0;
    if (w->peaks || again != 0) spare(w, spent);
    if (again == 0) w->looked += afforded && !w->exhausted, w->steps++;
    w->objected |= w->moves;
    return (stepper_verdict){.again = again};
}

/* Looks at the sides of switches in a step, up to where one changes: they are those of the typed force, unless a probe
 * in shorter steps shows that they are not. */
static void inspect_sides(witness *w, stepper *s, double until)
{
    state *const to = &w->at[TO];
    const double spent = w->spent;
    if (w->held || w->sides > w->earned) return;
    if (!see_ends(w, s) || !bound(w, s)) return;
    if (until == w->at[FROM].t || (to->t != until && !see(s, until, to))) return;
    w->strict = true;
    if (look_at_all(w, s, true) && w->beside) {
        witness *const inner = w->inner;
        memcpy(inner->rounded, w->rounded, w->nv * sizeof *w->rounded);
        memcpy(inner->rounded_x, w->rounded_x, w->nx * sizeof *w->rounded_x);
        inner->strict = true;
        probe(w, s, (to->t - w->at[FROM].t) / 4, INFINITY);
        inner->strict = false;
        if (inner->held) w->differs = inner->differs, w->held = w->objected = true;
    }
    w->strict = false;
    w->sides += w->spent - spent, w->spent = spent;
}

/* Judges a step up to the end of a piece, since behind it the step has not happened. What is missing before moves the
 * companion. */
static void judge_piece(witness *w, stepper *s, double until)
{
    const double h = until - w->at[FROM].t;
    w->moves =
        h != 0 && see(s, until, &w->at[TO]) && look_at_all(w, s, true) && suspects(w) && probe(w, s, h / 4, w->sees);
    const bool beyond = w->moves && apart(w) > FIRST && beyond_bars(w, BARS) && hides(w, s, MOSTLY);
    w->moves = beyond && !w->leaves;
    w->left = beyond && w->leaves;
    w->objected |= w->moves;
}

static bool inspect_piece(void *ctx, stepper *s, double until)
{
    witness *const w = ctx;
    if (w->open || (!w->steady && w->moves && until != stepper_time(s))) judge_piece(w, s, until);
    w->open = false;
    if (w->located) inspect_sides(w, s, until);
    if (!w->steady) return false;
    if (w->rest > 0)
        w->rest--;
    else
        w->rest = inspect_steady(w, s, until).rest;
    return w->moves;
}
