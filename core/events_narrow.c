/* Events that are narrow beside the step, so that the points of dense output may miss them. See events_parts.h.
 *
 * The step is halved until bounds on boxes prove for every piece that the function is nowhere 0 in it or monotone: then
 * its signs at the ends of the pieces tell all its roots. If that takes too many pieces, the step is counted as unseen.
 * Near roots that the points have found, where the function is small, the points are trusted, since no bound decides
 * where a function is flat.
 *
 * Invariant: `here` is the state at the end of the pieces that are decided, `next` that at the end of the present one.
 */
#include "core/events_parts.h"

#include <math.h>
#include <string.h>

#include "core/scalar.h"
#include "step/box.h"

#define SHORTEST 0x1p-32 /* as a part of the step: a shorter piece is not halved */
#define NEAR 0.125       /* as a part of the step: nearer to a root the points are trusted */
#define BETWEEN 0.125    /* a polynomial leaves its range at the points, between them, by at most this part of it */
#define ROUNDED 0x1p-44  /* the rounding error of a value, as a part of it */
enum { DEEP = 33, PIECES_MOST = 1024, PASSES_MOST = 64 };

/* A run may examine PIECES_AT_ONCE pieces at first and PIECES_IN_STEP more for each step; a piece costs one more for
 * every FUNCTIONS_IN_PIECE functions. */
enum { PIECES_AT_ONCE = 4096, PIECES_IN_STEP = 16, FUNCTIONS_IN_PIECE = 8 };

/* An interval, in parts of the step, in which a function passes 0. */
typedef struct pass {
    double from, to;
    int sign; /* of the function at `to` */
} pass;

typedef struct narrow {
    events *e;
    stepper *s;
    size_t f;
    double *most; /* bounds on the accelerations in the step */
    double noise; /* a value up to this size has no certain sign */
    double slack; /* near a root that the points have found, a value up to this size has none either */
    size_t first; /* the first candidate that the points have found */
    bool starts;  /* the function is near 0 at the start of the step */
    bool ends;    /* the function is near 0 at the end of the step */
    int sign;     /* the latest certain sign, and where it was found */
    double since;
    pass pass[PASSES_MOST];
    size_t passes;
} narrow;

void events_may_look(events *e, int64_t steps)
{
    const int64_t room = PIECES_AT_ONCE - e->pieces;
    e->pieces += steps < room / PIECES_IN_STEP ? PIECES_IN_STEP * steps : room;
}

int64_t events_unseen(const events *e, size_t *rule, double *t)
{
    *rule = e->unseen ? e->rule_of[e->unseen_function] : 0;
    *t = e->unseen ? e->unseen_at : NAN;
    return e->unseen;
}

static void count_unseen(events *e, size_t f)
{
    if (!e->unseen++) e->unseen_at = e->left.t, e->unseen_function = f;
}

/* Tells whether a place in the step is near a root that the points have found. */
static bool is_near(const narrow *n, double tau)
{
    const events *e = n->e;
    if ((n->starts && tau < NEAR) || (n->ends && tau > 1 - NEAR)) return true;
    for (size_t k = n->first; k < e->candidates; k++)
        if (fabs(e->candidate[k].at - tau * e->span) < NEAR * fabs(e->span)) return true;
    return false;
}

static int sign_of(const narrow *n, double tau, double g)
{
    const bool hidden = isnan(g) || fabs(g) <= n->noise || (fabs(g) <= n->slack && is_near(n, tau));
    return hidden ? 0 : g > 0 ? 1 : -1;
}

/* Writes the state a part tau of the step after its start, and evaluates the function there. */
static motus_status state_at(const narrow *n, double tau, instant *to, motus_error *err)
{
    events *e = n->e;
    if (tau >= 1) {
        events_copy(e, to, &e->right);
        return MOTUS_OK;
    }
    to->t = events_place_in(e, tau * e->span);
    const motus_status status = stepper_sample(n->s, to->t, to->x, to->v, err);
    return status ? status : events_value_of(e, n->f, to, err);
}

/* Tells whether the part of the step from `here` to `next` is decided: on a box around it the function, or its rate, is
 * nowhere 0, or the points are trusted there. */
static bool is_told(const narrow *n, double first, double last)
{
    events *e = n->e;
    const size_t nx = e->problem.nx, nv = e->problem.nv;
    const double from = e->here.g[n->f], to = e->next.g[n->f], t[2] = {e->here.t, e->next.t};
    if (fabs(from) <= n->slack && fabs(to) <= n->slack && is_near(n, first) && is_near(n, last)) return true;
    const box in = {e->best.x, e->best.v, e->width, e->width + nx};
    box_of(&in, nx, nv, (last - first) * e->span, e->here.x, e->here.v, e->next.x, e->next.v, n->most);
    for (int rate = 0; rate < 2; rate++)
        if (e->rules.apart(e->rules.ctx, n->f, rate, t, in.x, in.v, in.dx, in.dv, n->most)) return true;
    return false;
}

/* Takes over the present piece, up to tau. False: there is no room for another pass. */
static bool accept(narrow *n, double tau)
{
    events *e = n->e;
    const int sign = sign_of(n, tau, e->next.g[n->f]);
    if (sign && n->sign && sign != n->sign) {
        if (n->passes == PASSES_MOST) return false;
        n->pass[n->passes++] = (pass){n->since, tau, sign};
    }
    if (sign) n->sign = sign, n->since = tau;
    events_copy(e, &e->here, &e->next);
    return true;
}

/* Finds the pieces in which the function passes 0. *all false: there are too many pieces. */
static motus_status look(narrow *n, bool *all, motus_error *err)
{
    events *e = n->e;
    const int64_t cost = 1 + (int64_t)(e->rules.functions / FUNCTIONS_IN_PIECE);
    double ends[DEEP + 2] = {1}, from = 0;
    motus_status status = MOTUS_OK;
    events_copy(e, &e->here, &e->left);
    n->passes = 0, n->since = 0;
    int pieces = 0;
    for (int count = 1; count > 0;) {
        const double to = ends[count - 1];
        *all = pieces++ < PIECES_MOST && e->pieces >= cost;
        if (!*all) return MOTUS_OK;
        e->pieces -= cost;
        status = state_at(n, to, &e->next, err);
        if (status) return status;
        if (to - from > SHORTEST && !is_told(n, from, to)) {
            ends[count++] = from + (to - from) / 2;
            continue;
        }
        *all = accept(n, to);
        if (!*all) return MOTUS_OK;
        from = to;
        count--;
    }
    return MOTUS_OK;
}

/* Finds where the function passes 0 in a piece, by dense output, so that candidates of several functions come in their
 * order. */
static motus_status root_of(const narrow *n, const pass *p, double *tau, motus_error *err)
{
    enum { HALVINGS = 48 };
    double low = p->from, high = p->to;
    motus_status status = MOTUS_OK;
    for (int k = 0; k < HALVINGS && !status; k++) {
        const double middle = low + (high - low) / 2;
        status = state_at(n, middle, &n->e->next, err);
        *((n->e->next.g[n->f] > 0) == (p->sign > 0) ? &high : &low) = middle;
    }
    *tau = low + (high - low) / 2;
    return status;
}

/* Returns how many roots the candidates from number `first` on stand for, at most. */
static size_t known(const events *e, size_t first)
{
    size_t count = 0;
    for (size_t k = first; k < e->candidates; k++) count += e->candidate[k].near ? 2 : 1;
    return count;
}

/* Returns the largest size of the function at the ends of the step and at the points between. */
static double size_of(const events *e, size_t f, int degree)
{
    double most = fmax(fabs(e->left.g[f]), fabs(e->right.g[f]));
    for (int k = 1; k < degree; k++) {
        const double size = fabs(e->samples[(size_t)k * e->rules.functions + f]);
        if (size > most && isfinite(size)) most = size;
    }
    return most;
}

/* Replaces the candidates that the points have found, from the first pass on, by candidates of the passes. */
static motus_status replace(const narrow *n, motus_error *err)
{
    events *e = n->e;
    const size_t all = e->rules.functions;
    const double from = n->pass[0].from * e->span;
    size_t count = n->first;
    motus_status status = MOTUS_OK;
    for (size_t k = n->first; k < e->candidates; k++) {
        candidate *c = &e->candidate[k];
        if (e->way * (c->at - from) > 0) continue;
        if (e->way * (c->high - from) > 0) c->high = from;
        e->candidate[count++] = *c;
    }
    e->candidates = count;
    if (!n->starts) e->side[n->f] = (int8_t)e->was[n->f], e->stands[n->f] = e->was[all + n->f];
    e->open[n->f] = 0;
    for (size_t k = 0; k < n->passes && !status; k++) {
        const pass *p = &n->pass[k];
        /* bisection tells a root from a pole or a jump */
        candidate c = {.of = n->f,
                       .low = p->from * e->span,
                       .high = p->to * e->span,
                       .kind = (candidate_kind)p->sign,
                       .sampled = true};
        status = root_of(n, p, &c.at, err);
        c.at *= e->span;
        if (!status && !events_add(e, c)) status = events_no_memory(err);
    }
    return status;
}

/* Bounds the accelerations within the step; if the row has no such bound, by twice the largest that the velocities of
 * dense output show between points. */
static motus_status bound_accelerations(const narrow *n, motus_error *err)
{
    enum { POINTS = 16 };
    events *e = n->e;
    if (stepper_swing(n->s, n->most)) return MOTUS_OK;
    motus_status status = MOTUS_OK;
    memset(n->most, 0, e->problem.nv * sizeof *n->most);
    events_copy(e, &e->here, &e->left);
    for (int i = 1; i <= POINTS && !status; i++) {
        status = state_at(n, (double)i / POINTS, &e->next, err);
        for (size_t k = 0; k < e->problem.nv; k++)
            n->most[k] = fmax(n->most[k], 2 * POINTS * fabs((e->next.v[k] - e->here.v[k]) / e->span));
        events_copy(e, &e->here, &e->next);
    }
    return status;
}

/* Tells whether the points of the step show all roots of a function that they resolve: its operations are regular over
 * the ranges of their arguments at the points, widened by what the points do not resolve. */
static bool is_regular(const events *e, size_t f, int degree)
{
    const size_t all = e->rules.functions, each = e->rules.arguments * all;
    double low[RULE_ARGUMENTS_MOST], high[RULE_ARGUMENTS_MOST], coefficients[ROOTS_DEGREE_MOST + 1];
    if (e->in_parts || !e->rules.arguments) return false;
    for (size_t k = 0; k < e->rules.arguments; k++) {
        const double *value = e->arguments + k * all + f;
        roots_fitted fitted;
        low[k] = high[k] = value[0];
        for (int i = 1; i <= degree; i++) {
            const double one = value[(size_t)i * each];
            low[k] = fmin(low[k], one), high[k] = fmax(high[k], one);
        }
        const double largest = fmax(fabs(low[k]), fabs(high[k]));
        const bool told =
            roots_fit(value, each, degree, largest * ROUNDED, coefficients, &fitted) != ROOTS_FIT_NOT_FINITE;
        const double beyond = told ? BETWEEN * (high[k] - low[k]) + fitted.unseen : NAN;
        low[k] -= beyond, high[k] += beyond;
    }
    return e->rules.regular(e->rules.ctx, f, low, high);
}

motus_status events_narrow(events *e, stepper *s, size_t f, size_t first, int degree, bool failed, bool *more,
                           motus_error *err)
{
    const size_t all = e->rules.functions;
    narrow n = {.e = e, .s = s, .f = f, .most = e->best.a, .first = failed ? e->candidates : first};
    bool looked = false;
    *more = false;
    if (e->rules.rule[e->rule_of[f]].internal) return MOTUS_OK;
    if (e->rules.may_be_narrow && !e->rules.may_be_narrow(e->rules.ctx, f)) return MOTUS_OK;
    if (!failed && is_regular(e, f, degree)) return MOTUS_OK;
    if (!e->rules.apart || e->problem.refresh) return count_unseen(e, f), MOTUS_OK;
    motus_status status = bound_accelerations(&n, err);
    if (!status) status = events_bounds(e, &e->left, err);
    if (!status) status = events_bounds(e, &e->right, err);
    n.noise = 4 * fmin(e->left.bound[f], e->right.bound[f]);
    n.slack = failed ? 0 : EVENTS_SLACK * size_of(e, f, degree);
    n.starts = !e->was[f] || e->was[all + f] || e->was[2 * all + f];
    n.ends = e->open[f] || e->stands[f];
    n.sign = n.starts ? 0 : (int8_t)e->was[f];
    if (!status) status = look(&n, &looked, err);
    if (status) return status;
    if (!looked) return count_unseen(e, f), MOTUS_OK;
    *more = n.passes > (failed ? 0 : known(e, first));
    n.first = first;
    return *more ? replace(&n, err) : MOTUS_OK;
}
