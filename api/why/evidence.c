/* See evidence.h. */
#include "api/why/evidence.h"

#include "api/request/choice.h"
#include "api/system/linear.h"
#include "api/system/vector.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { STEPS_LEAST = 200, STEPS_MOST = 20000, DEEPER = 8, AHEAD = 2, BISECTIONS = 80, SIZES = 11, SCATTER = 8 };
#define LOOK_METHOD "dop853"
#define LOOK_TOLERANCE 1e-12
#define LOOSER_TOLERANCE 1e-10
#define WORK 4e8            /* operations of one trial */
#define CALLBACK_WORK 100.0 /* operations of a callback, for each number */
#define STAGES 12.0         /* evaluations of one trial step */
#define HALTED 1e-5         /* of the way: a trial that ends this near to the instant has come to a halt */
#define LARGEST 1e290       /* beyond it a product leaves the finite numbers */
#define DEEP 1e-9           /* of the way: steps that lead this far beyond the instant have passed an encounter */
#define EARLIER 1e-2        /* of the way so far: where samples of a force begin */
#define FAR_BACK 1e3        /* largest distance of a halt from its cause, in roundings of the time */
#define HUGE_STATE 1e100    /* products of larger numbers may leave the finite numbers */
#define JUMP 1e-3           /* least jump, as a part of the force */
#define LASTS 0.5           /* a jump keeps at least this part of the first change, however near its sides are */
#define NOISY 0.1           /* least part of the allowed error that counts as noise */

/* ---- the scene ---- */

static int64_t steps_of(motus_system *s, const problem *p)
{
    const double numbers = (double)(p->nx + p->nv);
    double operations = CALLBACK_WORK * numbers;
    weight w;
    if (s->model && choice_weigh(s, &w, NULL) == MOTUS_OK) operations = w.values + 10 * numbers;
    return (int64_t)fmax(STEPS_LEAST, fmin(STEPS_MOST, WORK / (STAGES * (operations + 1))));
}

static bool force(evidence *e, double t, double *x, double *v, double *a)
{
    const problem *p = e->problem;
    memset(a, 0, p->nv * sizeof *a);
    if (p->refresh) p->refresh(p->ctx, t, x, v);
    return p->accel(p->ctx, t, x, v, a) == 0;
}

static void copy_state(const evidence *e, double *t, double *x, double *v, double from_t, const double *from_x,
                       const double *from_v)
{
    *t = from_t;
    memcpy(x, from_x, e->problem->nx * sizeof *x);
    memcpy(v, from_v, e->problem->nv * sizeof *v);
}

bool evidence_begin(evidence *e, motus_system *s, motus_system *home, stepper *of, double noted)
{
    const problem *p = stepper_problem(of);
    const size_t nx = p->nx, nv = p->nv;
    *e = (evidence){.system = s,
                    .problem = p,
                    .row = stepper_method(of),
                    .begin = stepper_leg(of),
                    .until = stepper_limit_of(of),
                    .h = stepper_last_step(of),
                    .noted = noted,
                    .t = stepper_time(of)};
    e->adaptive = row_adaptive(e->row);
    e->way = e->until < e->begin || (!(e->until > e->begin) && stepper_step(of) < 0) ? -1 : 1;
    double *room = take(&s->allocator, 4 * nx + 7 * nv, sizeof *room);
    if (!room) return false;
    e->early_x = room, e->x = room + nx, e->other_x = room + 2 * nx;
    e->early_v = room + 3 * nx, e->v = e->early_v + nv, e->a = e->v + nv, e->other_v = e->a + nv;
    e->b = e->other_v + nv, e->c = e->b + nv;
    e->origin_x = e->c + nv, e->origin_v = e->origin_x + nx;
    e->origin = stepper_origin(of, e->origin_x, e->origin_v);
    e->steps = steps_of(s, p);
    if (isnan(e->noted)) e->noted = e->t;
    const bool early = stepper_earlier(of, &e->early_t, e->early_x, e->early_v),
               now = stepper_sync(of, e->x, e->v, NULL, NULL) == MOTUS_OK;
    if (early && !now) copy_state(e, &e->t, e->x, e->v, e->early_t, e->early_x, e->early_v);
    if (now && !early) copy_state(e, &e->early_t, e->early_x, e->early_v, e->t, e->x, e->v);
    if (home) e->problem = &home->problem;
    if ((early || now) && force(e, e->t, e->x, e->v, e->a)) return true;
    evidence_end(e);
    return false;
}

void evidence_from(evidence *e, double t, const double *x, const double *v)
{
    copy_state(e, &e->t, e->x, e->v, t, x, v);
    copy_state(e, &e->early_t, e->early_x, e->early_v, t, x, v);
    e->origin = false;
    force(e, t, e->x, e->v, e->a);
}

void evidence_end(evidence *e)
{
    give(&e->system->allocator, e->early_x);
    e->early_x = NULL;
}

/* ---- the way ahead ---- */

typedef struct samples {
    double *t, *y;
    size_t count, which;
    double largest, state;
} samples;

static size_t largest_at(const double *y, size_t count)
{
    size_t at = 0;
    for (size_t k = 1; k < count; k++)
        if (fabs(y[k]) > fabs(y[at])) at = k;
    return at;
}

/* Collects the force after each step, until the steps end. Returns what ended them. */
static motus_status collect(evidence *e, trial *p, double until, samples *out)
{
    motus_status status = MOTUS_OK;
    bool arrived = false;
    const size_t nx = e->problem->nx, nv = e->problem->nv;
    for (;;) {
        if (stepper_sync(p->stepper, e->other_x, e->other_v, e->b, NULL) != MOTUS_OK) return MOTUS_DIVERGED;
        out->state = fmax(vector_largest(e->other_x, nx), vector_largest(e->other_v, nv));
        out->largest = fmax(out->largest, out->state);
        const size_t which = largest_at(e->b, nv);
        const double y = fabs(e->b[which]);
        if (y > 0 && isfinite(y)) {
            out->which = which;
            out->t[out->count] = fabs(stepper_time(p->stepper));
            out->y[out->count++] = y;
            out->state = fmax(out->state, y);
        }
        if (arrived || status != MOTUS_OK) return status;
        status = trial_step(p, until, &arrived);
        if (status != MOTUS_OK) return status;
    }
}

static void judge_ahead(evidence *e, const samples *s, motus_status status, double from, double gone, double span,
                        evidence_ahead *out)
{
    power fit;
    out->gone = gone;
    out->which = s->which;
    out->largest = s->largest;
    if (status == MOTUS_OK) {
        out->way = EVIDENCE_ON;
        return;
    }
    if (status == MOTUS_STEPS) return;
    const double rounding = gone * DBL_EPSILON;
    if (power_fit(s->t, s->y, s->count, rounding, &fit) && fabs(fit.at - gone) <= HALTED * gone + fit.at_error &&
        fit.at <= span) {
        const double order = s->which < e->problem->nx ? 2 : 1;
        out->way = EVIDENCE_SINGULAR;
        out->t = from + e->way * fit.at;
        out->t_error = fit.at_error + LOOK_TOLERANCE * gone + DBL_EPSILON * fabs(out->t);
        out->exponent = order - fit.exponent;
        out->exponent_error = fit.exponent_error + 1e-9;
    } else if (s->state >= LARGEST) {
        const size_t nx = e->problem->nx, x = largest_at(e->other_x, nx), v = largest_at(e->other_v, e->problem->nv);
        out->way = EVIDENCE_INFINITE;
        out->in_v = nx == 0 || fabs(e->other_v[v]) > fabs(e->other_x[x]);
        out->which = out->in_v ? v : x;
    }
}

/* Returns whether steps pass a singularity if their time begins anew at the last state before it, and again where they
 * come to a halt. It is then an encounter, too short for the rounding of the time; two bodies that fall on each other
 * come ever nearer. */
static bool passes(evidence *e, const chosen *look, double left)
{
    const problem *p = e->problem;
    double *x = take(&e->system->allocator, p->nx + p->nv, sizeof *x), *v = x ? x + p->nx : NULL;
    bool arrived = false;
    if (!x) return false;
    for (int i = 0; i < DEEPER && !arrived; i++) {
        trial deep;
        motus_status status = MOTUS_OK;
        memcpy(x, e->other_x, p->nx * sizeof *x);
        memcpy(v, e->other_v, p->nv * sizeof *v);
        if (!trial_begin(&deep, p, &e->system->allocator, look, e->t, e->way, x, v, e->steps)) break;
        while (status == MOTUS_OK && !arrived) {
            status = trial_step(&deep, e->way * left, &arrived);
            if (status == MOTUS_OK) status = stepper_sync(deep.stepper, e->other_x, e->other_v, NULL, NULL);
        }
        const double gone = fabs(stepper_time(deep.stepper));
        trial_end(&deep);
        if (status == MOTUS_STEPS || !(gone > 0)) break;
    }
    give(&e->system->allocator, x);
    return arrived;
}

/* Finds whether the force at the last good state is singular in the time: where steps have come to a halt, samples at
 * ever earlier times tell its power. */
static bool look_back(evidence *e, samples *s, evidence_ahead *out)
{
    enum { SAMPLES = 80 };
    power fit;
    const double span = EARLIER * fabs(e->t - e->begin);
    s->count = 0;
    for (int i = 0; i < SAMPLES && span > 0; i++) {
        const double back = span * exp2(-0.5 * i), t = e->t - e->way * back;
        memcpy(e->other_x, e->x, e->problem->nx * sizeof(double));
        memcpy(e->other_v, e->v, e->problem->nv * sizeof(double));
        if (!force(e, t, e->other_x, e->other_v, e->b)) return false;
        s->which = largest_at(e->b, e->problem->nv);
        const double y = fabs(e->b[s->which]);
        if (!(y > 0) || !isfinite(y)) continue;
        s->t[s->count] = -fabs(t - e->t);
        s->y[s->count++] = y;
    }
    const double rounding = DBL_EPSILON * fabs(e->t);
    if (!power_fit(s->t, s->y, s->count, rounding, &fit)) return false;
    const double halted = fabs(e->noted - e->t) + FAR_BACK * rounding + fit.at_error;
    if (!(fabs(fit.at) <= halted)) return false;
    *out = (evidence_ahead){.way = EVIDENCE_SINGULAR,
                            .t = e->t + e->way * fit.at,
                            .t_error = fit.at_error + halted,
                            .exponent = (s->which < e->problem->nx ? 2 : 1) - fit.exponent,
                            .exponent_error = fit.exponent_error + 1e-9,
                            .which = s->which};
    return true;
}

/* Looks ahead from a state by at most `steps` controlled steps over a time `span`; if they come as far as `past`, the
 * motion goes on. UNKNOWN with a time: an encounter. */
static evidence_ahead look_from(evidence *e, double t, const double *x, const double *v, double span, double past,
                                double tolerance, int64_t steps, samples *s)
{
    evidence_ahead out = {.t = NAN, .t_error = NAN, .exponent = NAN, .exponent_error = NAN};
    chosen look;
    trial p;
    s->count = 0, s->largest = 0;
    if (row_choose(LOOK_METHOD, &look, NULL, NULL) != MOTUS_OK) return out;
    look.relative = tolerance;
    if (!trial_begin(&p, e->problem, &e->system->allocator, &look, t, e->way, x, v, steps)) return out;
    const motus_status status = collect(e, &p, e->way * span, s);
    judge_ahead(e, s, status, t, fabs(stepper_time(p.stepper)), span, &out);
    trial_end(&p);
    if (status == MOTUS_STEPS && out.gone >= past) out.way = EVIDENCE_ON;
    if (out.way == EVIDENCE_SINGULAR && passes(e, &look, DEEP * out.gone)) out.way = EVIDENCE_UNKNOWN;
    return out;
}

/* Looks ahead from the start. The results of two tolerances differ by the errors of the looser one, which are a hundred
 * times those of the other. */
static evidence_ahead look_from_start(evidence *e, samples *s)
{
    const double past = fabs(e->noted - e->begin) + 4 * fabs(e->h), span = AHEAD * past;
    const int64_t steps = e->steps / 2;
    evidence_ahead out = look_from(e, e->begin, e->origin_x, e->origin_v, span, past, LOOK_TOLERANCE, steps, s);
    if (out.way == EVIDENCE_UNKNOWN) return out;
    evidence_ahead loose = look_from(e, e->begin, e->origin_x, e->origin_v, span, past, LOOSER_TOLERANCE, steps, s);
    if (loose.way != out.way) return loose.way = EVIDENCE_UNKNOWN, loose;
    if (out.way == EVIDENCE_SINGULAR) {
        out.t_error += fabs(out.t - loose.t);
        out.exponent_error += fabs(out.exponent - loose.exponent);
    }
    out.from_start = true;
    return out;
}

evidence_ahead evidence_look(evidence *e)
{
    evidence_ahead out = {.t = NAN, .t_error = NAN, .exponent = NAN, .exponent_error = NAN};
    samples s = {.t = take(&e->system->allocator, 2 * (size_t)(e->steps + 2), sizeof *s.t)};
    if (!s.t) return out;
    s.y = s.t + e->steps + 2;
    const double whole = fabs(e->early_t - e->begin);
    out = look_from(e, e->early_t, e->early_x, e->early_v, AHEAD * fabs(e->noted - e->early_t) + 4 * fabs(e->h),
                    INFINITY, LOOK_TOLERANCE, e->steps, &s);
    if (out.way == EVIDENCE_SINGULAR) out.t_error += 10 * (e->adaptive ? e->row->relative : 0) * whole;
    if (out.way == EVIDENCE_SINGULAR && !e->adaptive && whole > 0) out.t_error += fabs(e->h);
    const bool leads = out.way == EVIDENCE_SINGULAR || out.way == EVIDENCE_INFINITE;
    if (e->origin && whole > 0 && (leads || !e->adaptive)) {
        evidence_ahead start = look_from_start(e, &s);
        start.drifted = leads && start.way == EVIDENCE_ON;
        if (start.from_start) out = start;
    }
    if (e->adaptive && !leads && !out.from_start && isnan(out.t) && e->problem->traits.time) look_back(e, &s, &out);
    give(&e->system->allocator, s.t);
    return out;
}

/* ---- the force near the last good state ---- */

/* Moves the state by a time dt, by the first terms of its series, to other_x and other_v. */
static void move(evidence *e, double dt)
{
    const problem *p = e->problem;
    for (size_t k = 0; k < p->nv; k++) {
        e->other_v[k] = e->v[k] + dt * e->a[k];
        if (k < p->nx) e->other_x[k] = e->x[k] + dt * (e->v[k] + dt / 2 * e->a[k]);
    }
}

/* Computes the force at a fraction of the straight way from the last good state to the one after dt. */
static bool force_on(evidence *e, double dt, double part, double *a)
{
    const problem *p = e->problem;
    move(e, dt);
    for (size_t k = 0; k < p->nv; k++) {
        e->other_v[k] = e->v[k] + part * (e->other_v[k] - e->v[k]);
        if (k < p->nx) e->other_x[k] = e->x[k] + part * (e->other_x[k] - e->x[k]);
    }
    return force(e, e->t + part * dt, e->other_x, e->other_v, a) && isfinite(vector_largest(a, p->nv));
}

/* Returns the change of number k of the force that stays however near its two sides are; 0: none. */
static double lasting(evidence *e, double dt, size_t k, double *before, double *after)
{
    double low = 0, high = 1;
    *before = e->a[k];
    if (!force_on(e, dt, 1, e->b)) return 0;
    *after = e->b[k];
    const double first = fabs(*after - *before);
    for (int i = 0; i < BISECTIONS; i++) {
        const double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) break;
        if (!force_on(e, dt, middle, e->b)) return 0;
        if (fabs(e->b[k] - *before) > fabs(*after - e->b[k]))
            high = middle, *after = e->b[k];
        else
            low = middle, *before = e->b[k];
    }
    const double left = fabs(*after - *before);
    return left >= LASTS * first ? left : 0;
}

/* Bounds the force at states that differ by a few roundings. */
static void scatter(evidence *e, double *least, double *most)
{
    const problem *p = e->problem;
    memcpy(least, e->a, p->nv * sizeof *least);
    memcpy(most, e->a, p->nv * sizeof *most);
    double *a = take(&e->system->allocator, p->nv, sizeof *a);
    for (int i = 0; a && i < SCATTER; i++) {
        const double by = (1 + i % 4) * DBL_EPSILON / 2;
        for (size_t k = 0; k < p->nv; k++) {
            const double side = rate_scatter((size_t)i * (2 * p->nv + 1) + k) > 0 ? 1 : -1,
                         other = rate_scatter((size_t)i * (2 * p->nv + 1) + p->nv + k) > 0 ? 1 : -1;
            e->other_v[k] = e->v[k] * (1 + side * by);
            if (k < p->nx) e->other_x[k] = e->x[k] * (1 + other * by);
        }
        if (!force(e, e->t, e->other_x, e->other_v, a)) continue;
        for (size_t k = 0; k < p->nv; k++) least[k] = fmin(least[k], a[k]), most[k] = fmax(most[k], a[k]);
    }
    give(&e->system->allocator, a);
}

bool evidence_jump(evidence *e, size_t *which, double *before, double *after)
{
    const size_t nv = e->problem->nv;
    const double size = vector_largest(e->a, nv);
    for (int i = 0; i < 2 * SIZES; i++) {
        const double dt = (i % 2 ? -1 : 1) * e->h * ldexp(1, i / 2);
        if (!force_on(e, dt, 1, e->b)) continue;
        size_t k = 0;
        for (size_t j = 1; j < nv; j++)
            if (fabs(e->b[j] - e->a[j]) > fabs(e->b[k] - e->a[k])) k = j;
        const double change = fabs(e->b[k] - e->a[k]);
        if (!(change > JUMP * fmax(size, fabs(e->b[k])))) continue;
        const double left = lasting(e, dt, k, before, after);
        if (left == 0) continue;
        scatter(e, e->b, e->c);
        if (left < 10 * (e->c[k] - e->b[k])) continue;
        if (i % 2) {
            const double swap = *before;
            *before = *after, *after = swap;
        }
        *which = k;
        return true;
    }
    return false;
}

bool evidence_undefined_here(evidence *e, size_t *which)
{
    memcpy(e->other_x, e->x, e->problem->nx * sizeof *e->x);
    memcpy(e->other_v, e->v, e->problem->nv * sizeof *e->v);
    if (!force(e, e->t, e->other_x, e->other_v, e->b)) return false;
    for (size_t k = 0; k < e->problem->nv; k++)
        if (!isfinite(e->b[k])) return *which = k, true;
    return false;
}

bool evidence_undefined(evidence *e, size_t *which, double *at)
{
    for (int i = -SIZES; i < SIZES; i++) {
        const double dt = e->way * fabs(e->h) * ldexp(1, i);
        move(e, dt);
        if (vector_largest(e->other_x, e->problem->nx) > HUGE_STATE ||
            vector_largest(e->other_v, e->problem->nv) > HUGE_STATE)
            break;
        if (!force(e, e->t + dt, e->other_x, e->other_v, e->b)) continue;
        for (size_t k = 0; k < e->problem->nv; k++)
            if (!isfinite(e->b[k])) return *which = k, *at = e->t + dt, true;
    }
    return false;
}

double evidence_undefined_since(evidence *e, size_t which, double at)
{
    for (double good = e->t;;) {
        const double middle = good + (at - good) / 2;
        const bool between = (middle - good) * (at - middle) > 0;
        const double t = between ? middle : at;
        move(e, t - e->t);
        if (!force(e, t, e->other_x, e->other_v, e->b) || !between) return at;
        *(isfinite(e->b[which]) ? &good : &at) = t;
    }
}

bool evidence_noise(evidence *e, size_t *which)
{
    const problem *p = e->problem;
    const size_t one[] = {0, p->nv}, *from = p->variables ? p->variables : one;
    const int count = p->variables ? p->variable_count : 1;
    double worst = NOISY;
    if (!e->adaptive) return false;
    scatter(e, e->b, e->c);
    for (int g = 0; g < count; g++) {
        const double size = vector_largest(e->v + from[g], from[g + 1] - from[g]);
        const double next = fmax(size, fabs(e->h) * vector_largest(e->a + from[g], from[g + 1] - from[g]));
        const double allowed = fmax(e->row->relative * next, e->row->absolute);
        for (size_t k = from[g]; k < from[g + 1]; k++) {
            const double part = fabs(e->h) * (e->c[k] - e->b[k]) / allowed;
            if (e->c[k] > e->b[k] && !(part <= worst)) worst = part, *which = k;
        }
    }
    return worst > NOISY;
}

/* ---- rates ---- */

bool evidence_rate(evidence *e, bool early, double *re, double *im, size_t *which)
{
    const problem *p = e->problem;
    const size_t n = p->nx + p->nv, room_of_linear = linear_room(p);
    double *room = take(&e->system->allocator, room_of_linear + (RATE_MOTION_MAX + 1) * n, sizeof *room);
    if (!room) return false;
    linear at = {.t = early ? e->early_t : e->t};
    double *basis = room + room_of_linear, all_re[RATE_MOTION_MAX], all_im[RATE_MOTION_MAX], most = -1;
    linear_place(&at, p, room);
    memcpy(at.x, early ? e->early_x : e->x, p->nx * sizeof *room);
    memcpy(at.v, early ? e->early_v : e->v, p->nv * sizeof *room);
    const double x = vector_largest(at.x, linear_positions(p)), v = vector_largest(at.v, p->nv);
    at.size_x = x > 0 ? x : 1;
    at.size_v = v > 0 ? v : 1;
    const rate_map map = {n, linear_product, &at};
    const double fastest = rate_fastest(&map, basis, basis + n);
    if (fastest > 0 && p->nx) {
        at.size_v = fastest * at.size_x;
        rate_fastest(&map, basis, basis + n);
    }
    *which = largest_at(basis + p->nx, p->nv);
    const int count = fastest > 0 ? rate_motion(&map, linear_rounding(p), basis, all_re, all_im) : 0;
    for (int k = 0; k < count; k++)
        if (hypot(all_re[k], all_im[k]) > most) most = hypot(all_re[k], all_im[k]), *re = all_re[k], *im = all_im[k];
    give(&e->system->allocator, room);
    if (!(most > 0)) return false;
    *re *= e->way;
    return true;
}

/* ---- trials ---- */

trial_course evidence_try(evidence *e, const evidence_trial *trial, int64_t steps, double until, double *end)
{
    chosen row = *e->row;
    double h = e->adaptive ? e->way : e->way * fabs(e->h);
    if (trial->method) {
        if (row_choose(trial->method, &row, NULL, NULL) != MOTUS_OK) return (trial_course){.status = MOTUS_METHOD};
        if (e->adaptive) row.relative = e->row->relative, row.absolute = e->row->absolute;
        h = e->way;
    }
    if (trial->step > 0) h = e->way * trial->step;
    if (trial->tolerance > 0) {
        row.relative = trial->absolute ? 0 : trial->tolerance;
        row.absolute = trial->absolute ? trial->tolerance : 0;
    }
    row.count = 0;
    row.least = 0;
    const double times[] = {e->t, e->early_t, e->begin};
    const double *const x[] = {e->x, e->early_x, e->origin_x}, *const v[] = {e->v, e->early_v, e->origin_v};
    if (steps > e->steps) steps = e->steps;
    return trial_run(e->problem, &e->system->allocator, &row, times[trial->from], h, x[trial->from], v[trial->from],
                     steps, e->way * until, end);
}
