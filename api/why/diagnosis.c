/* See diagnosis.h.
 *
 * Controlled steps from a state before the failure decide: where they pass the failure, the run's own steps are to
 * blame, and where they do not, the motion is.
 */
#include "api/why/diagnosis.h"

#include "api/why/evidence.h"
#include "api/system/system.h"
#include "base/decimal.h"
#include "lang/model/undefined.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    TRIAL_STEPS = 2000,
    HALVINGS = 14,
    LOOSER = 8,
    IMPLICIT_STEPS = 100,
    IMPLICIT_NUMBERS = 200,
    FEW_NUMBERS = 16,
    ROUNDINGS = 4
};
#define BEFORE 0.99 /* of the way to a singularity: where a run may end */
#define STIFF_METHOD "gauss4"
#define TRIED_METHOD "dop853"
#define TRIED_TOLERANCE 1e-9
#define NEAR_BOUND 4.0  /* steps within this factor of the stability limit, both ways, are bounded by it */
#define UNBOUNDED 500.0 /* step times rate: no bound of stability is as large */
/* the model is stiff if an implicit method can take steps of at least this many times the stability limit */
#define LONGER 10.0
#define AGREES \
    1e-2               /* largest difference between steps that serve and half of them, relative to the largest
                        * number */
#define NO_LARGER 10.0 /* times the motion's size: a trial that grows more has not succeeded */
#define TELLABLE 0.5   /* largest error of an exponent that tells something */
#define LOGARITHM \
    1e-3 /* the power is 0 if the error of the exponent is below this, and the exponent is within its
                        * error */

typedef struct judge {
    evidence e;
    motus_error *err;
    motus_system *home; /* the system as it was written; NULL: that of the evidence */
    diagnosis_leads *leads;
    evidence_ahead ahead;
    bool looked;
    trial_course whole; /* what TRIED_METHOD met on the way to `whole_to` */
    double whole_to;    /* NaN: not tried */
    char cause[MOTUS_TEXT_MAX];
} judge;

/* ---- words ---- */

static const char *name_of(const judge *j, bool in_v, size_t k, char out[MOTUS_NAME_MAX])
{
    const problem *p = j->e.problem;
    snprintf(out, MOTUS_NAME_MAX, "%s[%zu]", in_v ? "v" : "x", k);
    if (p->name) p->name(p->ctx, in_v, k, out, MOTUS_NAME_MAX);
    return out;
}

/* Returns the number whose acceleration, or rate, is number k of the force. */
static const char *name_of_force(const judge *j, size_t k, char out[MOTUS_NAME_MAX])
{
    return name_of(j, k >= j->e.problem->nx, k, out);
}

/* Writes "0.66667 ± 3e-06", with the digits that the error leaves. */
static const char *with_error(double value, double error, char out[MOTUS_TEXT_MAX])
{
    const double places = error > 0 ? ceil(-log10(error)) + 0.0 : 15;
    error_text(out, "%.*f ± %.0e", (int)fmax(0, fmin(15, places)), value, error);
    return out;
}

static double read_number(const char *text)
{
    double value = NAN;
    const bool negative = *text == '-';
    decimal_read(text + negative, strlen(text + negative), &value);
    return negative ? -value : value;
}

/* Adds a sentence to the message, with the cause and the number that it is about. */
static void say(judge *j, motus_cause cause, const char *variable)
{
    motus_error *err = j->err, kept = *err;
    fail(err, kept.status, "%s; %s", kept.message, j->cause);
    err->time = kept.time;
    err->returned = kept.returned;
    err->cause = cause;
    memcpy(err->hint, kept.hint, sizeof err->hint);
    snprintf(err->variable, sizeof err->variable, "%s", variable);
}

static void attempt(judge *j, bool verified, const char *member, const char *value)
{
    snprintf(j->err->attempt, sizeof j->err->attempt, "%.16s = %.40s", member, value);
    j->err->verified = verified;
}

/* Writes an end of few digits shortly before an instant, and returns it. */
static double end_before(judge *j, double instant)
{
    char text[DECIMAL_MAX];
    const double whole = instant - j->e.begin, off = (1 - BEFORE) / 2 * fabs(whole);
    const double value = decimal_near(j->e.begin + BEFORE * whole, off, text);
    attempt(j, (j->e.t - value) * j->e.way >= 0, "until", text);
    hint(j->err, "end the run before, `until = %s` of the definition", text);
    return value;
}

/* ---- what is tried before it is named ---- */

/* Returns where trials begin: at the run's start, since what is named has to lead the whole way. */
static evidence_place from_of(const judge *j) { return j->e.origin ? EVIDENCE_FROM_START : EVIDENCE_FROM_EARLY; }
static double way_to(const judge *j, double end) { return fabs(end - (j->e.origin ? j->e.begin : j->e.early_t)); }

/* Returns the way to `end` by an adaptive method; its largest number says which trials have left the motion. */
static const trial_course *whole(judge *j, double end)
{
    const evidence_trial trial = {.method = TRIED_METHOD, .tolerance = TRIED_TOLERANCE, .from = from_of(j)};
    if (j->whole_to != end) j->whole = evidence_try(&j->e, &trial, INT64_MAX, way_to(j, end), NULL);
    j->whole_to = end;
    return &j->whole;
}

/* Returns whether a trial has led as far as asked, without growing beyond the motion. */
static bool succeeds(judge *j, const trial_course *c, double end)
{
    if (c->status != MOTUS_OK) return false;
    const trial_course *const w = whole(j, end);
    const double size = w->status == MOTUS_OK ? w->largest : j->looked ? j->ahead.largest : INFINITY;
    return c->largest <= NO_LARGER * fmax(size, 1e-300);
}

/* Finds the largest step of one digit, among halvings of the run's, that leads to `end`. False: none does in a bounded
 * time. */
static bool shorter_step(judge *j, double end, char text[MOTUS_TEXT_MAX])
{
    for (int k = 1; k <= HALVINGS; k++) {
        error_text(text, "%.1g", ldexp(fabs(j->e.h), -k));
        const evidence_trial trial = {.step = read_number(text), .from = from_of(j)};
        if (way_to(j, end) / trial.step > 10 * TRIAL_STEPS) break;
        const trial_course c = evidence_try(&j->e, &trial, 10 * TRIAL_STEPS, way_to(j, end), NULL);
        if (succeeds(j, &c, end)) return true;
    }
    return false;
}

/* Proposes a shorter step to the end of the run, else an adaptive method. */
static bool propose_steps(judge *j)
{
    char text[MOTUS_TEXT_MAX], tolerance[DECIMAL_MAX];
    if (!j->e.adaptive && shorter_step(j, j->e.until, text)) {
        attempt(j, true, "step", text);
        hint(j->err, "take smaller steps, `step = %s` of the definition", text);
        return true;
    }
    if (whole(j, j->e.until)->status != MOTUS_OK) return false;
    decimal(TRIED_TOLERANCE, tolerance);
    snprintf(j->err->attempt, sizeof j->err->attempt, "method = %s, tolerance = %.24s", TRIED_METHOD, tolerance);
    j->err->verified = 1;
    hint(j->err, "take steps that adapt, `method = %s` of the definition with `tolerance = %s` of the definition",
         TRIED_METHOD, tolerance);
    return true;
}

/* Returns whether the run with switches located comes to its end. */
static bool locating_leads(const judge *j)
{
    const evidence *e = &j->e;
    motus_run_def def = motus_default_run();
    const problem *const p = &e->system->problem;
    const bool known = e->origin && e->begin == e->system->start &&
                       !memcmp(e->origin_v, e->system->v0, p->nv * sizeof(double)) &&
                       (!p->nx || !memcmp(e->origin_x, e->system->x0, p->nx * sizeof(double)));
    if (!known) return false;
    def.method = e->row->name;
    def.machine = "interpreter";
    def.error = MOTUS_BARS_NONE;
    def.switches = MOTUS_SWITCHES_LOCATE;
    def.start = e->begin, def.until = e->until;
    if (e->adaptive)
        def.tolerance = e->row->absolute > 0 ? e->row->absolute : e->row->relative, def.absolute = e->row->absolute > 0;
    else
        def.step = fabs(e->h);
    return j->leads(e->system, &def, e->steps);
}

/* ---- causes of the motion ---- */

static const evidence_ahead *look(judge *j)
{
    if (!j->looked) j->ahead = evidence_look(&j->e);
    j->looked = true;
    return &j->ahead;
}

/* Reports a singularity at which the way ahead ends. Returns whether there is one. */
static bool tell_singular(judge *j)
{
    const evidence_ahead *a = look(j);
    char name[MOTUS_NAME_MAX], t[MOTUS_TEXT_MAX], p[MOTUS_TEXT_MAX];
    if (a->way != EVIDENCE_SINGULAR) return false;
    name_of_force(j, a->which, name);
    with_error(a->t, a->t_error, t);
    const bool told = a->exponent_error<TELLABLE, sign_told = fabs(a->exponent)> a->exponent_error;
    /* For example, a rate grows as the power -1 of the time left, and an acceleration as the power -2. */
    if (told && !sign_told && a->exponent_error < LOGARITHM)
        error_text(j->cause, "%s is singular at t = %s, where it grows as the logarithm of the time left", name, t);
    else if (told)
        error_text(j->cause, "%s is singular at t = %s, where it goes %sas the power %s of the time left", name, t,
                   !sign_told        ? ""
                   : a->exponent < 0 ? "to infinity "
                                     : "to its limit ",
                   with_error(a->exponent, a->exponent_error, p));
    else
        error_text(j->cause, "%s is singular at t = %s", name, t);
    /* No tolerance bounds the errors of fixed steps. */
    if (!a->from_start && !j->e.adaptive && j->e.early_t != j->e.begin) {
        char text[MOTUS_TEXT_MAX];
        snprintf(text, sizeof text, "%s", j->cause);
        error_text(j->cause,
                   "from where the run stands, %s; it is not known whether the motion from the start gets there", text);
    }
    say(j, MOTUS_CAUSE_SINGULAR, name);
    j->err->singular = a->t;
    j->err->singular_error = a->t_error;
    j->err->exponent = told ? a->exponent : NAN;
    j->err->exponent_error = told ? a->exponent_error : NAN;
    return true;
}

/* Judges a singularity. Where the run failed long before the motion does, its steps are to blame as well. */
static bool singular(judge *j)
{
    char step[MOTUS_TEXT_MAX], text[MOTUS_TEXT_MAX];
    if (!tell_singular(j)) return false;
    const double end = end_before(j, j->ahead.t);
    if (j->err->verified) return true;
    if (!j->e.adaptive && shorter_step(j, end, step)) {
        snprintf(text, sizeof text, "%s", j->err->hint);
        const size_t length = strlen(j->err->attempt);
        snprintf(j->err->attempt + length, sizeof j->err->attempt - length, ", step = %.24s", step);
        j->err->verified = 1;
        hint(j->err, "%s with `step = %s` of the definition", text, step);
    } else {
        end_before(j, j->e.t);
    }
    return true;
}

static bool infinite(judge *j)
{
    const evidence_ahead *a = look(j);
    char name[MOTUS_NAME_MAX];
    if (a->way != EVIDENCE_INFINITE) return false;
    name_of(j, a->in_v, a->which, name);
    error_text(j->cause, "the motion itself takes %s beyond the largest number, 1.8e308", name);
    say(j, MOTUS_CAUSE_INFINITE, name);
    end_before(j, j->e.t);
    return true;
}

/* Reports a force that has no value where a leg begins: which term has none, and what may be written in its place. */
static bool undefined_start(judge *j)
{
    const evidence *e = &j->e;
    motus_system *const s = j->home ? j->home : e->system;
    undefined_term u;
    size_t which;
    char name[MOTUS_NAME_MAX], limit[DECIMAL_MAX];
    if (e->t != e->begin || !s->model || !evidence_undefined_here(&j->e, &which)) return false;
    name_of(j, true, which, name);
    const bool found = !system_located(s) &&
                       undefined_find(s->model, s->model->accel, s->model->accel_count, which, e->t, e->x, e->v, &u);
    error_text(j->cause, "%s", found ? u.says : "its equation has no value there");
    say(j, MOTUS_CAUSE_INFINITE, name);
    if (found && u.has_limit)
        hint(j->err, "write the value that it has there, `if(%s == 0, %s, %s)`", u.divisor, decimal(u.limit, limit),
             u.term);
    else if (found && u.both)
        hint(j->err, "write the value that it is to have there, as by `if(%s == 0, …, %s)`%s", u.divisor, u.term,
             e->begin == s->start ? "; or begin elsewhere" : "");
    else
        hint(j->err, "%swrite what the force is to be there", e->begin == s->start ? "begin elsewhere, or " : "");
    return true;
}

static bool undefined(judge *j)
{
    size_t which;
    double at;
    char name[MOTUS_NAME_MAX];
    if (look(j)->way == EVIDENCE_ON || !evidence_undefined(&j->e, &which, &at)) return false;
    error_text(j->cause, "%s has no finite rate of change beyond it", name_of(j, true, which, name));
    say(j, MOTUS_CAUSE_INFINITE, name);
    end_before(j, j->e.t);
    return true;
}

/* Returns whether steps of this row can end where the force jumps, and do not yet. */
static bool can_locate(const judge *j)
{
    motus_system *const s = j->e.system, *to = NULL;
    const char *why = "";
    if (!s->model || system_located(s)) return false;
    return located_for(s, j->e.row, MOTUS_SWITCHES_LOCATE, &to, &why, NULL) == MOTUS_OK && to;
}

/* Proposes to locate switches. False: such steps do not lead to the end. */
static bool propose_locating(judge *j)
{
    if (!can_locate(j) || !locating_leads(j)) return false;
    attempt(j, true, "switches", "locate");
    hint(j->err, "let steps end where the force jumps, `switches = locate` of the definition");
    return true;
}

/* Reports a motion that leaves a table, or the entries of a list. */
static bool outside_table(judge *j)
{
    const evidence *e = &j->e;
    motus_system *const s = j->home ? j->home : e->system;
    undefined_term u;
    size_t which;
    double at = e->t;
    char name[MOTUS_NAME_MAX], text[DECIMAL_MAX];
    if (!s->model || !s->model->table_count) return false;
    if (!evidence_undefined_here(&j->e, &which) && !evidence_undefined(&j->e, &which, &at)) return false;
    if (!undefined_find(s->model, s->model->accel, s->model->accel_count, which, at, e->other_x, e->other_v, &u) ||
        !u.outside[0])
        return false;
    if (!u.holds && !isnan(u.time) && at != e->t) {
        at = evidence_undefined_since(&j->e, which, at);
        if (!undefined_find(s->model, s->model->accel, s->model->accel_count, which, at, e->other_x, e->other_v, &u) ||
            !u.outside[0])
            return false;
    }
    const double t = isnan(u.time) ? e->t : u.time;
    const motus_status status = j->err->status;
    fail(j->err, status, "at t = %s %s", decimal(t, text), u.outside);
    j->err->time = t;
    j->err->cause = MOTUS_CAUSE_INFINITE;
    snprintf(j->err->variable, sizeof j->err->variable, "%s", name_of(j, true, which, name));
    const bool start = e->way * (t - e->begin) <= 0 && (!j->home || e->begin == s->start);
    if (!start && !u.holds && propose_locating(j)) return true;
    const double until = undefined_until(&u, t, e->begin);
    if (!start && !u.points[0]) attempt(j, true, "until", decimal(until, text));
    undefined_hint(&u, until, start, j->err);
    return true;
}

static bool discontinuous(judge *j)
{
    size_t which;
    double before, after;
    char name[MOTUS_NAME_MAX];
    if (j->e.problem->traits.smooth && !j->e.problem->returned) return false;
    if (!evidence_jump(&j->e, &which, &before, &after)) return false;
    char from[MOTUS_TEXT_MAX], to[MOTUS_TEXT_MAX];
    error_text(from, "%.3g", before);
    error_text(to, "%.3g", after);
    if (!strcmp(from, to)) return false; /* so small a change is no jump, but a steep force */
    name_of(j, true, which, name);
    error_text(
        j->cause,
        "the force is discontinuous there, the rate of change of %s jumps from %.24s to %.24s, and steps do not end on "
        "the jump",
        name, from, to);
    say(j, MOTUS_CAUSE_DISCONTINUOUS, name);
    if (propose_locating(j)) return true;
    end_before(j, j->e.t);
    char text[MOTUS_TEXT_MAX];
    snprintf(text, sizeof text, "%s", j->err->hint);
    hint(j->err, "%s; or smooth the jump, tanh(x'/0.001) for sign(x')", text);
    return true;
}

/* ---- causes of the steps ---- */

static bool noise(judge *j)
{
    size_t which;
    char name[MOTUS_NAME_MAX], value[MOTUS_TEXT_MAX];
    if (!evidence_noise(&j->e, &which)) return false;
    name_of(j, true, which, name);
    error_text(
        j->cause,
        "the tolerance %.2g is below rounding: the rate of change of %s is rounded by more than the tolerance allows",
        j->e.row->absolute > 0 ? j->e.row->absolute : j->e.row->relative, name);
    say(j, MOTUS_CAUSE_ROUNDING, name);
    const double until = fabs(j->e.until - j->e.t), far = fmin(until, 1e6 * fabs(j->e.h) + 1e-3 * until);
    double size = 0;
    for (size_t k = 0; k < j->e.problem->nv; k++) size = fmax(size, fabs(j->e.v[k]));
    for (size_t k = 0; k < j->e.problem->nx; k++) size = fmax(size, fabs(j->e.x[k]));
    for (int k = 0; k < 2 * LOOSER; k++) {
        const bool absolute = k % 2 == 0;
        double tolerance = fmax(j->e.row->relative, absolute ? 1e-15 : 1e-14) * pow(10, k / 2);
        if (absolute) tolerance *= size > 0 ? size : 1;
        error_text(value, "%.0e", tolerance);
        tolerance = read_number(value);
        decimal(tolerance, value);
        if (!(tolerance < 0.1)) continue;
        const evidence_trial trial = {.tolerance = tolerance, .absolute = absolute};
        const trial_course c = evidence_try(&j->e, &trial, TRIAL_STEPS, far, NULL);
        if (c.status != MOTUS_OK) continue;
        const evidence_trial again = {.tolerance = tolerance, .absolute = absolute, .from = from_of(j)};
        const motus_status status = evidence_try(&j->e, &again, INT64_MAX, way_to(j, j->e.until), NULL).status;
        if (status != MOTUS_OK && status != MOTUS_STEPS) continue;
        if (absolute) strcat(value, " absolute");
        attempt(j, true, "tolerance", value);
        hint(j->err, "allow more, `tolerance = %s` of the definition", value);
        return true;
    }
    hint(j->err, "allow a larger error, or compute the number without cancellation");
    return true;
}

/* Judges whether only the rounding of the time stops the run: with time counted from 0 its steps are possible. */
static bool time_rounding(judge *j)
{
    const evidence *e = &j->e;
    const double ulp = fabs(nextafter(e->t, INFINITY) - e->t);
    const evidence_trial same = {0};
    char t[DECIMAL_MAX];
    const trial_course c = evidence_try(&j->e, &same, TRIAL_STEPS, ROUNDINGS * ulp, NULL);
    if (c.status != MOTUS_OK || c.steps < 2 * ROUNDINGS) return false;
    error_text(j->cause, "steps of about %.0e are needed, and near t = %s times are %.0e apart",
               c.gone / (double)c.steps, decimal_time(e->t, 1, t), ulp);
    say(j, MOTUS_CAUSE_ROUNDING, j->err->variable);
    hint(j->err, "begin at t = 0, or allow a larger error");
    return true;
}

/* Finds the largest step, of one digit, with which a method that no stability bounds leads on, agrees with half of it,
 * and leads the whole way, or as far as could be tried. 0: none above `least`. */
static double implicit_step(judge *j, evidence_place from, double least, char text[MOTUS_TEXT_MAX], bool *tried)
{
    evidence *e = &j->e;
    const size_t n = e->problem->nx + e->problem->nv;
    double *one = take(&e->system->allocator, 2 * n, sizeof *one), *two = one ? one + n : NULL, found = 0;
    if (n > IMPLICIT_NUMBERS) found = NAN; /* its equations would take too long */
    double step = fabs(e->until - (from == EVIDENCE_FROM_EARLY ? e->early_t : e->t)) / IMPLICIT_STEPS;
    for (; one && found == 0 && step >= least; step /= 2) {
        error_text(text, "%.0e", step);
        evidence_trial trial = {.method = STIFF_METHOD, .step = read_number(text), .from = from};
        decimal(trial.step, text);
        const double far = IMPLICIT_STEPS * trial.step, whole = trial.step;
        const trial_course c = evidence_try(e, &trial, TRIAL_STEPS, far, one);
        trial.step /= 2;
        if (c.status != MOTUS_OK || evidence_try(e, &trial, TRIAL_STEPS, far, two).status != MOTUS_OK) continue;
        double off = 0, size = 0;
        for (size_t k = 0; k < n; k++) off = fmax(off, fabs(one[k] - two[k])), size = fmax(size, fabs(two[k]));
        trial.step = whole, trial.from = from_of(j);
        if (off > AGREES * size) continue;
        const int64_t steps = n <= FEW_NUMBERS ? 10 * TRIAL_STEPS : TRIAL_STEPS;
        const trial_course all = evidence_try(e, &trial, steps, way_to(j, e->until), NULL);
        if (all.status == MOTUS_OK || all.status == MOTUS_STEPS) found = whole;
        *tried = all.status == MOTUS_OK;
    }
    give(&e->system->allocator, one);
    return isnan(found) ? 0 : found;
}

/* Returns whether a method that no stability bounds takes much longer steps, and the run is near its own bound. */
static bool stiff(judge *j, double mean)
{
    evidence *e = &j->e;
    double re, im;
    size_t which;
    bool tried = false;
    char name[MOTUS_NAME_MAX], text[MOTUS_TEXT_MAX];
    const bool early = !e->adaptive;
    const evidence_place from = early ? EVIDENCE_FROM_EARLY : EVIDENCE_FROM_LAST;
    if (!evidence_rate(e, early, &re, &im, &which) || !(re < 0) || fabs(im) > -re) return false;
    const double rate = hypot(re, im), bound = stability_bound(e->row->name, re, im),
                 h = e->adaptive ? mean : fabs(e->h);
    /* A row whose steps solve equations by iteration stays where that converges, near 1/rate. */
    const double limit = !(bound < UNBOUNDED) && e->adaptive ? 1 : bound;
    if (!(limit > 0) || (e->adaptive && (h * rate > NEAR_BOUND * limit || h * rate < limit / NEAR_BOUND))) return false;
    if (!e->adaptive && h * rate <= limit) return false;
    if (implicit_step(j, from, LONGER * limit / rate, text, &tried) == 0) return false;
    error_text(j->cause, "the model is stiff: %s returns to the motion with the rate %.2g, and steps of %s %s %.2g",
               name_of(j, true, which, name), rate, e->row->name,
               limit == bound ? "are unstable above" : "do not converge much above", limit / rate);
    say(j, MOTUS_CAUSE_STIFF, name);
    snprintf(j->err->attempt, sizeof j->err->attempt, "method = %s, step = %.24s", STIFF_METHOD, text);
    j->err->verified = tried;
    hint(j->err,
         "take a method that is stable at every step, `method = %s` of the definition with `step = %s` of the "
         "definition%s",
         STIFF_METHOD, text, tried ? "" : "; or smaller ones: these were tried for a part of the way");
    return true;
}

static void nothing_leads(judge *j)
{
    hint(j->err, "take a smaller step, or another method: none that could be tried in a short time leads to the end");
}

/* Judges steps that have left a motion which goes on: fixed steps, or errors within a tolerance. */
static bool left_motion(judge *j)
{
    const evidence *const e = &j->e;
    char name[MOTUS_NAME_MAX];
    if (look(j)->way != EVIDENCE_ON || (e->adaptive && !j->ahead.drifted)) return false;
    snprintf(name, sizeof name, "%s", j->err->variable);
    if (e->adaptive)
        error_text(j->cause, "the motion itself goes on, and the tolerance %.2g of %s is too large for it",
                   fmax(e->row->absolute, e->row->relative), e->row->name);
    else
        error_text(j->cause, "the motion itself goes on, and steps of %.3g by %s are too long for it", fabs(e->h),
                   e->row->name);
    say(j, MOTUS_CAUSE_INFINITE, name);
    if (!propose_steps(j)) nothing_leads(j);
    return true;
}

static void unsolved(judge *j)
{
    if (singular(j)) return;
    j->err->cause = MOTUS_CAUSE_SOLVER;
    if (propose_steps(j)) return;
    if (propose_locating(j))
        j->err->cause = MOTUS_CAUSE_DISCONTINUOUS; /* no shorter step converges, and the force has jumps or kinks */
    else if (!j->e.adaptive)
        nothing_leads(j);
}

/* ---- the judgement ---- */

static void judge_all(judge *j, double mean)
{
    const motus_status status = j->err->status;
    if (outside_table(j)) return;
    if (status == MOTUS_DIVERGED && undefined_start(j)) return;
    if (status == MOTUS_SOLVE) {
        unsolved(j);
        return;
    }
    if (!j->e.adaptive) {
        if (status == MOTUS_DIVERGED)
            (void)(singular(j) || infinite(j) || stiff(j, mean) || undefined(j) || left_motion(j));
        return;
    }
    if (discontinuous(j) || singular(j) || infinite(j) || left_motion(j) || noise(j) || stiff(j, mean)) return;
    if (status == MOTUS_DIVERGED) (void)(undefined(j) || time_rounding(j));
}

static void add(const diagnosed *d, motus_system *home, stepper *of, double mean, motus_error *err)
{
    if (err->status == MOTUS_EVENTS) err->cause = MOTUS_CAUSE_EVENTS;
    if (err->status != MOTUS_DIVERGED && err->status != MOTUS_SOLVE && err->status != MOTUS_STEPS) return;
    judge j = {.err = err, .home = home, .leads = d->leads, .whole_to = NAN};
    if (!evidence_begin(&j.e, d->system, home, of, err->time)) return;
    judge_all(&j, isnan(mean) ? fabs(j.e.h) : mean);
    evidence_end(&j.e);
}

void diagnosis_add(const diagnosed *d, stepper *of, motus_error *err)
{
    if (err && of && err->cause == MOTUS_CAUSE_NONE) add(d, d->home, of, NAN, err);
}

void diagnosis_singular(const diagnosed *d, stepper *of, double t, const double *x, const double *v, const char *end,
                        motus_error *err)
{
    judge j = {.err = err, .leads = d->leads};
    if (evidence_begin(&j.e, d->system, NULL, of, t)) {
        evidence_from(&j.e, t, x, v);
        tell_singular(&j);
        evidence_end(&j.e);
    }
    err->cause = MOTUS_CAUSE_SINGULAR;
    attempt(&j, true, "until", end);
}

motus_status diagnosis_crawls(void *diagnosed, stepper *of, int64_t steps, double gone, motus_error *err)
{
    motus_error why = motus_default_error();
    const motus_status status = stepper_crawls(of, steps, gone, &why);
    add(diagnosed, NULL, of, gone / (double)steps, &why);
    if (why.cause == MOTUS_CAUSE_NONE) return MOTUS_OK;
    if (err) motus_struct_write(MOTUS_DEF_ERROR, &why, err);
    return status;
}
