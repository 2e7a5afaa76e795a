/* Whether a run passes a singularity of the force: motus_run_singular.
 *
 * Interval arithmetic over the states of a step tells where a divisor may be 0 (lang/model/resolution.h). Such a step
 * is taken once more from its start, by controlled steps. Either they halt, at a singularity; or they pass a pole, too
 * weak for their error to show it; or they lead to another state than the run's step: then the run alone has passed a
 * pole, or its step does not resolve the force. Invariant: a step that agrees with controlled ones, which pass no pole,
 * is not accused, however near to a pole it leads.
 */
#include "api/request/choice.h"
#include "api/why/diagnosis.h"
#include "api/search/goal.h"
#include "api/calls/pole.h"
#include "api/motion/run.h"
#include "api/motion/run_events.h"
#include "api/system/vector.h"
#include "api/system/columns.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { PIECES_MAX = 50000 }; /* controlled steps in all */
#define CONTROLLED "rk4"     /* the method of controlled steps */
#define TOLERANCE 1e-6       /* of the motion's size, for a controlled step */
#define LEAST 0x1p-44        /* of the run's step: a controlled step that must be shorter is at a singularity */
#define APART 0.5            /* of the velocity, or of the way: two ends farther apart are different */

typedef struct end {
    double t, *x, *v, *a;
} end;

typedef enum course { ARRIVES, HALTS, PASSES, LASTS } course; /* LASTS: on its way when the steps ran out */

typedef struct judge {
    motus_run *run;
    const problem *problem;
    end from, to, now, whole, half;
    stepper *stepper;  /* of controlled steps */
    double *room;      /* 4 nv numbers */
    interval *box;     /* nx, then nv */
    int pieces;        /* controlled steps so far */
    double of_x, of_v; /* sizes to which errors of controlled steps relate */
} judge;

static void copy(const judge *j, end *to, const end *from)
{
    to->t = from->t;
    memcpy(to->x, from->x, j->problem->nx * sizeof(double));
    memcpy(to->v, from->v, j->problem->nv * sizeof(double));
}

static double least(double a, double b, double c, double d) { return fmin(fmin(a, b), fmin(c, d)); }
static double most(double a, double b, double c, double d) { return fmax(fmax(a, b), fmax(c, d)); }

/* Bounds a number within a step of size h: by its ends, and by those of the tangents there. */
static interval reach(double from, double rate, double to, double end_rate, double h)
{
    const double ahead = from + h * rate, back = to - h * end_rate;
    return (interval){least(from, to, ahead, back), most(from, to, ahead, back)};
}

static bool may_meet_pole(const judge *j)
{
    const problem *p = j->problem;
    const motus_system *s = j->run->system;
    const end *a = &j->from, *b = &j->to;
    const double h = b->t - a->t;
    interval *x = j->box, *v = x + p->nx;
    for (size_t k = 0; k < p->nx; k++) x[k] = reach(a->x[k], a->v[k], b->x[k], b->v[k], h);
    for (size_t k = 0; k < p->nv; k++) v[k] = reach(a->v[k], a->a[k], b->v[k], b->a[k], h);
    return resolution_pole(s->poles, (interval){fmin(a->t, b->t), fmax(a->t, b->t)}, x, v, s->model->pool);
}

/* Controlled steps ------------------------------------------------------------------------------------------------ */

/* Takes steps of size h, which lead to `to`. False: they cannot be taken, or lead to no finite state. */
static bool step(const judge *j, const end *from, double h, int64_t steps, end *to)
{
    const stepper_limit limit = {steps, NAN};
    to->t = from->t + (double)steps * h;
    return stepper_start(j->stepper, from->t, h, from->x, from->v, NULL) == MOTUS_OK &&
           stepper_advance(j->stepper, limit, NULL, NULL) == MOTUS_OK &&
           stepper_sync(j->stepper, to->x, to->v, NULL, NULL) == MOTUS_OK;
}

/* Returns the error of a controlled step in units of the tolerance, by two half steps, which lead to `half`. */
static double error_of(judge *j, double h)
{
    const problem *p = j->problem;
    if (!step(j, &j->now, h, 1, &j->whole) || !step(j, &j->now, h / 2, 2, &j->half)) return NAN;
    const double x = vector_apart(j->half.x, j->whole.x, p->nx), v = vector_apart(j->half.v, j->whole.v, p->nv);
    return fmax(x > 0 ? x / j->of_x : 0, v > 0 ? v / j->of_v : 0) / TOLERANCE;
}

/* Returns the factor of the next step after one with this error. */
static double rate(double error) { return 0.9 * exp(-0.2 * log(error)); }

/* Returns whether the way to a state after the time h passes a pole. */
static bool pole_between(const judge *j, const end *from, double h, const double *x, const double *v, bool straight)
{
    return pole_on(&(pole_way){j->run->system, from->t, h, from->x, from->v, x, v, straight, j->box, j->room});
}

/* Takes controlled steps from `from` to the time t; `now` is then the state there. */
static course follow(judge *j, double t)
{
    const double whole = t - j->from.t, short_of = fmax(LEAST * fabs(whole), 8 * DBL_EPSILON * fabs(t));
    double h = whole;
    copy(j, &j->now, &j->from);
    j->of_v = vector_largest(j->from.v, j->problem->nv) + fabs(h) * vector_largest(j->from.a, j->problem->nv);
    j->of_x = vector_largest(j->from.x, j->problem->nx) + fabs(h) * j->of_v;
    while (j->pieces++ < PIECES_MAX) {
        const double left = t - j->now.t;
        const bool last = fabs(h) >= fabs(left);
        if (last) h = left;
        if (fabs(left) <= short_of) return ARRIVES;
        const double error = error_of(j, h);
        if (error <= 1) {
            if (pole_between(j, &j->now, h, j->half.x, j->half.v, false)) return PASSES;
            copy(j, &j->now, &j->half);
            j->of_v = fmax(j->of_v, vector_largest(j->now.v, j->problem->nv));
            if (last) return ARRIVES;
            h *= fmin(4, rate(fmax(error, 1e-4)));
            continue;
        }
        h *= isfinite(error) ? fmax(0.1, fmin(0.5, rate(error))) : 0.1;
        if (fabs(h) < short_of) return HALTS;
    }
    return LASTS;
}

/* Judges whether the run's step from `from` is another motion than the controlled steps, which lead to `now`. acted: an
 * event at the end of the step has changed the run's state. */
static motus_status judged(judge *j, bool acted)
{
    const problem *p = j->problem;
    const motus_run *r = j->run;
    const double way = vector_apart(j->to.x, j->from.x, p->nx), until = j->to.t;
    const course course = follow(j, until);
    if (course == HALTS || course == PASSES) return MOTUS_SINGULAR;
    if (acted) return MOTUS_OK;
    const double x = fmax(way, vector_apart(j->now.x, j->from.x, p->nx)),
                 v = fmax(vector_largest(j->from.v, p->nv), vector_largest(j->now.v, p->nv));
    if (vector_apart(j->now.x, r->x, p->nx) <= APART * x && vector_apart(j->now.v, r->v, p->nv) <= APART * v)
        return pole_between(j, &j->now, 0, r->x, r->v, true) ? MOTUS_SINGULAR : MOTUS_OK; /* between both ends */
    if (pole_between(j, &j->from, until - j->from.t, r->x, r->v, true)) return MOTUS_SINGULAR;
    return course == ARRIVES ? MOTUS_UNRESOLVED : MOTUS_OK;
}

/* The run ---------------------------------------------------------------------------------------------------------- */

static motus_status observe(judge *j, end *at, motus_error *err)
{
    motus_run *r = j->run;
    const problem *p = j->problem;
    const motus_status status = run_sync(r, true, err);
    if (status != MOTUS_OK) return status;
    at->t = run_time(r);
    memcpy(at->x, r->x, p->nx * sizeof(double));
    memcpy(at->v, r->v, p->nv * sizeof(double));
    memcpy(at->a, r->a, p->nv * sizeof(double));
    return MOTUS_OK;
}

/* Reports a force that has no finite value at the start itself. */
static bool undefined_start(const judge *j, double from, motus_error *err)
{
    const problem *p = j->problem;
    char t[DECIMAL_MAX], name[MOTUS_NAME_MAX] = "";
    if (from != j->run->timing.t0) return false;
    for (size_t k = 0; k < p->nv; k++) {
        if (isfinite(j->from.a[k])) continue;
        p->name(p->ctx, true, k, name, sizeof name);
        fail(err, MOTUS_SINGULAR,
             "the motion is undefined at the start, t = %s: %s has no finite rate of change there; what follows is not "
             "the motion",
             decimal_time(from, from, t), name);
        hint(err, "begin elsewhere, or look for a division by zero in the equation");
        if (err) err->time = from;
        return true;
    }
    return false;
}

static motus_status accuse(const judge *j, motus_status what, double from, motus_error *err)
{
    char a[MOTUS_TEXT_MAX], b[MOTUS_TEXT_MAX];
    const double to = run_time(j->run);
    if (what == MOTUS_SINGULAR && undefined_start(j, from, err)) {
        column_names_error(j->run->system, err);
        return what;
    }
    for (int digits = 6; digits <= 17; digits++) {
        error_text(a, "%.*g", digits, from);
        error_text(b, "%.*g", digits, to);
        if (strcmp(a, b) != 0) break;
    }
    if (what == MOTUS_SINGULAR)
        fail(err, what,
             "the run passes a singularity of the force between t = %s and t = %s, which the step does not resolve; "
             "what follows is not the motion",
             a, b);
    else
        fail(err, what, "the step does not resolve the force between t = %s and t = %s; what follows is not the motion",
             a, b);
    if (what == MOTUS_SINGULAR)
        hint(err,
             "let the run end before, `until = %s` of the definition; or take a smaller step, where the motion only "
             "comes near to it",
             a);
    else
        hint(err, "take a smaller step");
    if (err) err->time = from;
    if (what == MOTUS_SINGULAR && err)
        diagnosis_singular(&j->run->diagnosed, j->run->stepper, from, j->from.x, j->from.v, a, err);
    column_names_error(j->run->system, err);
    return what;
}

static motus_status walk(judge *j, motus_error *err)
{
    motus_run *r = j->run;
    const model *m = r->system->model;
    const double evaluations = r->card->evaluations ? r->card->evaluations : 4 * r->card->stages;
    weight weight;
    motus_status status = choice_weigh(r->system, &weight, err);
    if (status != MOTUS_OK) return status;
    /* In loops an evaluation takes more operations than the graph has. */
    const double operations = fmax(weight.values, m->graph->count) + 4.0 * (double)m->nv;
    int64_t left = (int64_t)(MOTUS_SINGULAR_WORK / ((evaluations + 2) * operations));
    status = observe(j, &j->from, NULL);
    while (status == MOTUS_OK && left-- > 0 && j->pieces < PIECES_MAX && !r->arrived) {
        const int64_t acted = run_events_acted(r);
        status = run_step(r, 1, NULL);
        if (status == MOTUS_OK) status = observe(j, &j->to, NULL);
        if (status != MOTUS_OK) break;
        if (may_meet_pole(j)) {
            const double from = j->from.t;
            const motus_status what = judged(j, run_events_acted(r) != acted);
            if (what != MOTUS_OK) return accuse(j, what, from, err);
        }
        const end kept = j->from;
        j->from = j->to;
        j->to = kept;
    }
    return MOTUS_OK; /* a run that fails reports it itself */
}

static motus_status look(motus_run *r, motus_error *err)
{
    const problem *p = &r->system->problem;
    const size_t nx = p->nx, nv = p->nv;
    judge j = {.run = r, .problem = p};
    double *room = take(&r->allocator, 5 * (nx + 2 * nv) + 4 * nv + 2 * (nx + nv), sizeof *room);
    if (!room) return fail(err, MOTUS_MEMORY, "no memory to look for singularities");
    double *at = room;
    end *const ends[] = {&j.from, &j.to, &j.now, &j.whole, &j.half};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++, at += nx + 2 * nv)
        *ends[k] = (end){0, at, at + nx, at + nx + nv};
    j.room = at;
    j.box = (interval *)(void *)(at + 4 * nv);
    chosen row;
    motus_status status = row_choose(CONTROLLED, &row, NULL, err);
    if (status == MOTUS_OK)
        status = stepper_create(&r->system->machine, &row, r->timing.t0, r->timing.h, r->system->x0, r->system->v0,
                                &r->allocator, &j.stepper, err);
    if (status == MOTUS_OK) status = walk(&j, err);
    stepper_destroy(j.stepper);
    give(&r->allocator, room);
    return status;
}

static motus_status find_poles(motus_system *s, motus_error *err)
{
    if (s->poles_known) return MOTUS_OK;
    if (!resolution_create_poles(s->model, s->model->accel, s->model->accel_count, &s->poles))
        return fail(err, MOTUS_MEMORY, "no memory to look for singularities");
    s->poles_known = true;
    return MOTUS_OK;
}

motus_status motus_run_singular(motus_system *s, const motus_run_def *given, motus_error *err)
{
    motus_run *r = NULL;
    motus_run_def def;
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s) return fail(err, MOTUS_ARGUMENT, "motus_run_singular needs a system");
    motus_status status = motus_struct_read(MOTUS_DEF_RUN, given, &def, err);
    if (status != MOTUS_OK || !s->model) return status;
    modes m = modes_enter();
    status = find_poles(s, err);
    if (status == MOTUS_OK && s->poles) {
        def.machine = "interpreter";
        def.progress = NULL;
        def.observer = NULL;
        def.switches = MOTUS_SWITCHES_STEP;
        status = goal_run(s, &def, &r, err);
        if (status == MOTUS_OK && !row_formula(&r->chosen)) status = look(r, err);
        goal_end(r);
    }
    modes_leave(m);
    return status;
}
