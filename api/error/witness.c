/* See witness.h. look.c finds what is missing from a step; here that is judged. */
#include "api/error/look.h"

#include "api/error/bars.h"
#include "api/request/choice.h"
#include "api/system/vector.h"
#include "core/events.h"
#include "core/rows.h"
#include "lang/read/verify.h"

#include <math.h>
#include <string.h>

enum {
    TRIES = 64,    /* most refusals of one step */
    PROBED = 4096, /* most steps of a probe */
    LED = 256,     /* most steps of a probe that leads the companion */
    SHORTER = 6,   /* times that a step is shortened before the force is to blame, and not the step */
    BEHIND = 3,    /* steps that the companion is led through, from the first that lacks something */
    FINEST = 24,   /* most halvings that search for what is narrow in a step */
    RESOLVED = 3,  /* halvings up to which the step's own points resolve a piece */
    MANY = 8,      /* parts of a step: a force that needs more has narrow peaks */
    WIDTH = 64     /* most velocities for which ways beside the motion are taken: with more they say too little */
};
/* The unit of spending is one evaluation of the typed force by the interpreter. SPEND_FIRST operations may be spent at
 * first, but at least SPEND_LEAST evaluations; later also the part SPEND of the run's evaluations. This suits a
 * compiled run, whose evaluation costs a thirtieth, but holds on every machine: looks decide steps, which must not
 * depend on the machine. A series of order n counts as n^2/4 evaluations. */
#define SPEND_FIRST 4e6   /* operations */
#define SPEND_OF_MANY 1e6 /* operations, where the run is one of many */
#define SPEND_LEAST 200.0
#define SPEND 0.05
#define LONGER 1.25 /* a step longer than all before by this factor is looked at, whatever was spent */
/* Most operations: of one look at a step; of one probe; of one probe that leads the companion; and, without being
 * counted as spent, of steps that were rightly refused and those that follow up to their ends. Looks at sides have a
 * count of their own, with the same limit. */
#define SPEND_STEP 2e7
#define SPEND_PROBE 2e7
#define SPEND_LEAD 2e6
#define SPEND_SPARED 1e9
#define SPARED_OF_MANY 1e8
#define ROOM 0.75 /* of a refused step: the next one is shorter */
#define PART_OF_BARS 0x1p-4
/* For a witness that leaves the companion as it is. The error of one step is at most twice the largest that the
 * companion has shown by then, unless the step hides it. The probe has to be far better than the step. */
#define LEFT_BARS 8.0
#define LEFT_TOLERANCE 0x1p-10
#define SHOWN 0x1p-16 /* of what is missing: a step that hides no more than this part shows it */
#define MOSTLY 0.5    /* the same where the companion sees the rest, too */
#define PROBE "dop853"
#define PROBE_TOLERANCE 1e-10

/* ---- life ---- */

/* Finds the velocities of driven boundary cells, which no acceleration moves. */
static void find_driven(witness *w, double t)
{
    const problem *const p = &w->typed->problem;
    double *const x = w->at[POINT].x, *const v = w->driven;
    for (size_t k = 0; k < p->nx; k++) x[k] = NAN;
    for (size_t k = 0; k < p->nv; k++) v[k] = NAN;
    if (p->refresh) p->refresh(p->ctx, t, x, v);
    for (size_t k = 0; k < p->nv; k++) v[k] = !isnan(v[k]);
}

static witness *make(const motus_run *r, const differences *seen)
{
    const problem *const p = &r->system->problem;
    const motus_system *const s = r->home ? r->home : r->system;
    const bool ways = r->home && p->nv <= WIDTH;
    const size_t nx = p->nx + 1, nv = p->nv + 1,
                 numbers = STATES * (nx + nv) + 17 * nv + 4 * (nx + nv) + (ways ? (WAYS + MORE) * nv : 0);
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
                               &w->dx, &w->lack, &w->speed, &w->felt,    &w->driven,    &w->ways};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++, at += nv) *arrays[k] = at;
    find_driven(w, r->timing.t0);
    return w;
}

static stepper_verdict inspect(void *ctx, stepper *);
static bool inspect_piece(void *ctx, stepper *, double until);

/* Finds the operations that can hide something. They stay in the system's arena, for all its runs. */
static bool find_bends(motus_system *s)
{
    model *const m = s->model;
    const output *const lists[] = {m->boundary, m->accel};
    const size_t counts[] = {m->boundary_count, m->accel_count};
    struct bends *const b = &s->bends;
    if (!b->known)
        b->known = verify_resolution(m, lists, counts, 2, VERIFY_SWITCHES, &b->all, &b->sums) &&
                   (s->problem.traits.smooth ||
                    (verify_resolution(m, lists, counts, 2, VERIFY_PLAIN, &b->smooth, &b->sums) &&
                     verify_resolution(m, lists, counts, 2, VERIFY_LOCATED, &b->located, &b->sums)));
    return b->known;
}

/* Returns what may hide something from the steps of a run. */
static resolution *bends_of(const motus_run *r)
{
    return r->home && !r->home->problem.traits.smooth ? r->home->bends.located
                                                      : (r->home ? r->home : r->system)->bends.all;
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
    const bool any = bends_of(r) || (r->home && s->bends.sums);
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
    w->bends = w->inner->bends = bends_of(r);
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
    if (!w) return b->known && !bends_of(r) && !(r->home && b->sums) ? 1 : NAN;
    return w->steps ? (double)w->looked / (double)w->steps : 1;
}

/* ---- judging ---- */

/* Finds how much of each velocity a step may lose. */
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
        const double lost = look_lost(w, k, fmax(fabs(from->x[k]), fabs(to->x[k])), h);
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
    inner->tries = 0, inner->differs = NAN, inner->held = inner->objected = false;
    forget_peak(inner);
    inner->least = least;
    inner->earned = spent + fmax(SPEND_LEAST, (w->steady ? SPEND_LEAD : SPEND_PROBE) / w->operations);
    if (!status) status = stepper_jump(w->probe, t, lost, size, x, v, NULL);
    const int64_t most = w->steady ? LED : PROBED;
    if (!status) status = stepper_advance(w->probe, (stepper_limit){most, until}, &why, NULL);
    w->failed = status != MOTUS_OK;
    if (!status && why != STOP_UNTIL) inner->differs = stepper_time(w->probe);
    w->spent += inner->spent - spent + (w->steady ? (double)(stepper_evaluations(w->probe) - before) : 0);
    const bool stops = status != MOTUS_OK || why != STOP_UNTIL;
    /* it found what the run's step lacks, and no shorter step shows what the motion is instead */
    if (w->steady && stops && inner->objected && isnan(w->differs)) w->differs = t;
    if (w->steady && stops) return false;
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

/* Returns whether the probe is farther from the end of the step than `times` times the errors. */
static bool beyond_bars(const witness *w, double times)
{
    return look_beyond_velocities(w, w->dv, times) || look_beyond_places(w, w->dx, times);
}

/* Returns whether the stepper is within a step whose end a probe has contradicted. */
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

/* Returns how much spending need not be counted. A force that has hidden something once may do so again; from then on
 * spending is free up to `most_spared`, plus the cost of the run itself. */
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

/* Gives sizes to the numbers at rest from which something is missing: at rest they may lose nothing, so that without a
 * size the least amount would be too much. Returns whether there are any. */
static bool feels(witness *w)
{
    bool more = false;
    for (size_t k = 0; k < w->nv; k++) {
        if (!look_stirs(w, k)) continue;
        w->felt[k] = w->missing[k];
        more = true;
    }
    return more;
}

/* Adds up what is missing from the whole step. */
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
        if (!look_at(w, s, &w->at[FROM], &w->at[TO], 0)) return false;
        if (!feels(w)) break;
    }
    return true;
}

/* Returns whether Gauss's rule over the whole step misses more than `part` of what is missing. */
static bool hides(witness *w, stepper *s, double part)
{
    double most = 0, hidden = 0;
    if (!look_follow(w, s, &w->at[FROM], &w->at[TO], 0, w->room)) return false;
    for (size_t k = 0; k < w->typed->problem.nv; k++) {
        const double lack = w->lack[look_place(w, k)];
        most = fmax(most, fabs(lack)), hidden = fmax(hidden, fabs(lack - w->room[k]));
    }
    return hidden > part * most;
}

/* Returns whether a step lacks something that it does not show, or leads across a switch, since the companion may cross
 * it at the same time. (In runs with events both know their switches.) */
static bool lacks(witness *w, stepper *s)
{
    if (look_fits(w, w->bends, &w->at[FROM], &w->at[TO]) || !look_at_all(w, s, true)) return false;
    w->peaks |= w->parts > MANY && may_be_peak(w);
    if (w->crosses) return !w->events && !w->covered && !w->leaves;
    return w->parts > 1 && look_beyond_velocities(w, w->missing, PART_OF_BARS) && hides(w, s, SHOWN);
}

/* Compares the force with a step that is not to be refused. What the step lacks is to move the companion. */
static void compare(witness *w, stepper *s, double until)
{
    const state *const from = &w->at[FROM], *const to = &w->at[TO];
    if (w->moves || !see_ends(w, s) || !look_bound(w, s) || (until != to->t && !look_see(s, until, &w->at[TO]))) return;
    if (from->t == until) return;
    w->behind = lacks(w, s) ? BEHIND : w->behind > 0 ? w->behind - 1 : 0;
    w->leads = !w->events, w->moves = w->leads && w->behind > 0;
    if (w->leads || w->behind < BEHIND || !probe(w, s, (until - from->t) / 4, INFINITY)) return;
    apart(w);
    w->moves = look_beyond_velocities(w, w->dv, PART_OF_BARS) || look_beyond_places(w, w->dx, PART_OF_BARS);
}

/* Returns how many steps to skip before another look is affordable. The number varies, so that looks do not follow the
 * period of a motion. */
static int64_t rest_of(const witness *w)
{
    const double owes = w->peaks && w->spared < most_spared(w) ? 0 : w->spent - w->earned;
    return owes > 0 ? (int64_t)(owes / w->each * (1 + look_turn((uint32_t)w->steps, 0) / 2)) : 0;
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

/* Returns the size to try after a step that lacks too much: up to the first part that lacks much. */
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
    /* where a switch stands at 0 at the start, steps of every size are off */
    if (w->tries >= (w->beside ? SHORTER : TRIES)) {
        if (w->beside || !w->kinked) w->differs = from->t, w->held |= w->beside, w->objected = true;
        return 0;
    }
    if (w->probes || known(w, s)) return refuse(w, size);
    if (!probe(w, s, size, w->sees)) { /* shorter steps of the run may fail as well, and tell why */
        if (w->failed && w->kinked && !w->located && w->far) w->differs = from->t, w->objected = true;
        return w->failed && !w->kinked ? refuse(w, size) : 0;
    }
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

/* Lets a step stand in which nothing was found, unless there are narrow peaks and the look could not afford to see them
 * all. */
static double pass(witness *w, double whole)
{
    const bool many = w->parts > MANY && may_be_peak(w), lost = many && w->exhausted;
    w->peaks |= many;
    if (lost && w->tries < SHORTER) return refuse(w, whole / 4);
    if (lost) miss(w, w->at[FROM].t);
    return w->tries = 0;
}

static double earlier(double a, double b, double way) { return way < 0 ? fmax(a, b) : fmin(a, b); }

/* Looks for the first peak that the step hides, without a probe, so that a step pays for the first of many peaks only.
 * *again: the size of the next step; 0: nothing is hidden. False: the look failed. */
static bool judge_first(witness *w, stepper *s, double *again)
{
    state *const to = &w->at[TO];
    const double from = w->at[FROM].t, end = to->t, whole = end - from;
    w->first_only = true;
    const bool looked = look_at_all(w, s, true);
    w->first_only = false;
    *again = 0;
    if (!looked || !w->ended || w->kinked || w->tries >= TRIES) return looked;
    const bool hidden = look_see(s, w->behind_first, to) && hides(w, s, MOSTLY), back = look_see(s, end, to);
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

/* Returns whether a peak that an earlier step found decides: before the peak nothing is missing, and a step that leaps
 * over it is too long. *again: the size of the next step; 0: the step stands. */
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
    if (look_fits(w, w->smooth, from, to)) {
        if (depth > *deepest) *deepest = depth, w->start = from->t, w->length = to->t - from->t;
        return true;
    }
    return depth < FINEST && w->spent <= w->most_spent && look_see(s, from->t + (to->t - from->t) / 2, middle) &&
           find_shortest(w, s, from, middle, depth + 1, deepest) && find_shortest(w, s, middle, to, depth + 1, deepest);
}

/* Returns whether, with a switch at 0, the run's own points resolve what else the force does. No integral tells there
 * what is missing: whatever frees a state that is held must be found at these points. */
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
 * switch, after which it has another force: what is missing from there on is not known. */
static double judge(witness *w, stepper *s)
{
    const state *const from = &w->at[FROM], *const to = &w->at[TO];
    double again = 0;
    if (!see_ends(w, s) || !look_bound(w, s)) return 0;
    const double whole = to->t - from->t;
    const bool all = w->located || w->strict;
    go_on(w);
    if (!w->strict && look_fits(w, w->bends, from, to)) return w->tries = 0;
    if (!all && (meets_peak(w, &again) || !judge_first(w, s, &again) || again != 0)) return again;
    if ((all || w->ended) && !look_at_all(w, s, !w->located || w->strict)) return 0;
    w->open = !w->whole && !isnan(w->past);
    if (!(w->parts > 1 && look_suspects(w)) && !w->beside)
        return w->strict || resolves(w, s) ? pass(w, whole) : refuse(w, shorter(w, whole));
    return w->open && !look_see(s, w->past, &w->at[TO]) ? 0 : object(w, s, whole);
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

/* Looks at the sides of switches in a step, up to where one changes. They are those of the typed force unless a probe
 * in shorter steps shows otherwise. */
static void inspect_sides(witness *w, stepper *s, double until)
{
    state *const to = &w->at[TO];
    const double spent = w->spent;
    if (w->held || w->sides > w->earned) return;
    if (!see_ends(w, s) || !look_bound(w, s)) return;
    if (until == w->at[FROM].t || (to->t != until && !look_see(s, until, to))) return;
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

/* Judges a step up to `until`, after which it does not count. What is missing up to there moves the companion. */
static void judge_piece(witness *w, stepper *s, double until)
{
    const double h = until - w->at[FROM].t;
    w->moves = h != 0 && look_see(s, until, &w->at[TO]) && look_at_all(w, s, true) && look_suspects(w) &&
               probe(w, s, h / 4, w->sees);
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
