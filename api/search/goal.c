/* See goal.h. */
#include "api/search/goal.h"

#include "api/error/bars.h"
#include "api/motion/later.h"
#include "api/search/pilot.h"
#include "api/search/suggest.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ACCURACY 1e-9 /* where nobody gives one */

/* Refuses contradictions. request_choose judges steps and tolerances without an accuracy. */
static motus_status check(const motus_run_def *def, const request *q, motus_error *err)
{
    const bool step = request_asks(q->step_said);
    motus_status status = search_alone(!isnan(def->accuracy) && !isnan(def->tolerance), false, err);
    if (status == MOTUS_OK && q->automatic && step) {
        fail(err, MOTUS_ARGUMENT, "a step is given, and auto chooses methods that choose their steps");
        hint(err, "name a method, verlet or rk4, or give `accuracy = 1e-9` of the definition in its place");
        return MOTUS_ARGUMENT;
    }
    if (status != MOTUS_OK || isnan(q->accuracy)) return status;
    status = search_alone(false, step, err);
    if (status != MOTUS_OK) return status;
    if (def->switches != MOTUS_SWITCHES_STEP && def->switches != MOTUS_SWITCHES_USUAL)
        return fail(err, MOTUS_UNAVAILABLE, "a run that locates switches cannot be given an accuracy");
    return request_admits("an accuracy", q->accuracy, q->absolute, err);
}

/* Settles start and end, which pilots and trials need. */
static motus_status settle(motus_system *s, motus_run_def *def, const request *given, motus_error *err)
{
    timing t;
    request q = *given;
    if (q.automatic)
        q.method = PILOT_FIRST;
    else
        q.step = 1; /* searched for later */
    motus_status status = request_row(s, q.method, &q.chosen, &q.card, err);
    if (status == MOTUS_OK) status = suggest_missing(s, &q, err);
    if (status == MOTUS_OK) status = run_timing(&q.chosen, q.step, q.until, q.start, &t, err);
    if (status == MOTUS_OK) def->until = t.until, def->start = t.t0;
    return status;
}

/* One method tried: with which definition, what it reaches, and how it fails. */
typedef struct attempt {
    motus_run_def def;
    run_hint hint;
    accuracy accuracy;
    motus_error failure;
} attempt;

static void attempt_find(attempt *t, motus_system *s, const char *method)
{
    if (method) t->def.method = method;
    t->failure = motus_default_error();
    t->failure.status = accuracy_find(s, &t->def, &t->hint, &t->accuracy, &t->failure);
}

static bool better(const attempt *a, const attempt *b)
{
    if (a->failure.status != MOTUS_OK || b->failure.status != MOTUS_OK) return a->failure.status == MOTUS_OK;
    if (!isfinite(a->accuracy.reached) && !isfinite(b->accuracy.reached)) /* neither came to the end with digits */
        return fabs(a->accuracy.time - a->def.start) > fabs(b->accuracy.time - b->def.start);
    return a->accuracy.reached < b->accuracy.reached;
}

/* Tries the other methods of the pilots, where the first fails for a reason of its own. */
static void try_others(motus_system *s, const attempt *asked, const pilot *p, attempt *best, char choice[256])
{
    const char *const first = best->def.method;
    for (size_t k = 1; k < p->count && accuracy_wants_another(&best->accuracy, &best->failure); k++) {
        attempt t = *asked;
        t.accuracy.trials = best->accuracy.trials;
        t.accuracy.steep = best->accuracy.steep;
        t.hint.steps = 0;
        attempt_find(&t, s, p->names[k]);
        const int trials = t.accuracy.trials;
        attempt *const worse = better(&t, best) ? best : &t;
        accuracy_end(&worse->accuracy);
        if (worse == best) *best = t;
        best->accuracy.trials = trials;
        /* such a failure ends every attempt */
        if (t.failure.status == MOTUS_CANCELLED || t.failure.status == MOTUS_MEMORY) {
            accuracy_end(&best->accuracy);
            best->failure = t.failure;
            return;
        }
    }
    if (best->def.method != first)
        snprintf(choice, 256, "%s %s, and %s, which needs fewer operations, does not", best->def.method,
                 best->accuracy.missed ? "comes nearest to the accuracy" : "keeps to the accuracy", first);
}

static motus_status reach(motus_system *s, motus_run_def *def, const request *q, run_hint *hint, struct goal *g,
                          motus_error *err)
{
    pilot p = {.count = 0};
    motus_status status = settle(s, def, q, err);
    if (status == MOTUS_OK && q->automatic) {
        motus_run_def first = *def;
        if (isnan(first.tolerance)) first.tolerance = q->absolute ? q->accuracy / 10 : fmax(1e-14, q->accuracy / 10);
        status = pilot_choose(s, &first, &p, err);
        if (status != MOTUS_OK) return status;
        memcpy(g->choice, p.why, sizeof g->choice);
        def->method = p.names[0];
        hint->steps = p.steps;
    }
    if (status != MOTUS_OK || isnan(q->accuracy)) return status;
    g->accuracy.wanted = q->accuracy;
    g->accuracy.absolute = q->absolute;
    const attempt asked = {.def = *def, .hint = *hint, .accuracy = g->accuracy};
    attempt best = asked;
    attempt_find(&best, s, NULL);
    if (q->automatic) try_others(s, &asked, &p, &best, g->choice);
    g->accuracy = best.accuracy;
    *def = best.def, *hint = best.hint;
    if (best.failure.status == MOTUS_OK)
        hint->steps = (double)run_steps(g->accuracy.best);
    else if (err)
        motus_struct_write(MOTUS_DEF_ERROR, &best.failure, err);
    return best.failure.status;
}

/* Names the method of a definition, and finds what reaches its accuracy, by pilots and trials where they are due.
 * *goal: the run's; NULL: it has none. */
static motus_status reach_goal(motus_system *s, motus_run_def *def, run_hint *hint, struct goal **goal,
                               motus_error *err)
{
    request q = request_of_run(s, def);
    if (q.automatic && isnan(q.accuracy) && isnan(q.tolerance)) q.accuracy = ACCURACY;
    motus_status status = check(def, &q, err);
    *goal = NULL;
    if (status != MOTUS_OK || (!q.automatic && isnan(q.accuracy))) return status;
    struct goal *g = *goal = take(&s->allocator, 1, sizeof *g);
    if (!g) return fail(err, MOTUS_MEMORY, "no memory for the run");
    *g = (struct goal){.accuracy = {.wanted = NAN, .reached = NAN, .rounding = NAN}};
    def->method = q.automatic ? NULL : q.method;
    def->absolute = q.absolute;
    def->accuracy = NAN;
    if (isnan(q.accuracy)) def->tolerance = q.tolerance;
    return reach(s, def, &q, hint, g, err);
}

bool goal_arrive(motus_run *r, int64_t n)
{
    struct goal *g = r->goal;
    motus_run *best = g ? g->accuracy.best : NULL;
    if (!best) return false;
    const bool fits = best->arrived && n >= run_steps(best) && !r->observer && r->legs == 1 && run_steps(r) == 0 &&
                      (!r->bars || r->bars->kind == best->bars->kind);
    if (fits) {
        stepper *const mine = r->stepper;
        bars *const own = r->bars;
        r->stepper = best->stepper;
        best->stepper = mine;
        stepper_judged(r->stepper, diagnosis_crawls, &r->diagnosed);
        events *const happened = r->events;
        r->events = best->events;
        best->events = happened;
        later_end(r);
        r->machine = best->machine;
        r->compiled_from = best->compiled_from;
        if (own) r->bars = best->bars, best->bars = own, bars_move(r);
        r->first_step = best->first_step;
        r->arrived = true;
        r->synchronised = false;
    }
    accuracy_end(&g->accuracy);
    return fits;
}

motus_status goal_judge(const motus_run *r, motus_error *err)
{
    const accuracy *a = r->goal ? &r->goal->accuracy : NULL;
    if (!a || !r->arrived || r->legs != 1) return MOTUS_OK;
    return a->missed || accuracy_reached(a, r) > a->wanted ? accuracy_refuse(a, r, err) : MOTUS_OK;
}

void goal_restored(motus_run *r)
{
    if (r->goal) r->goal->accuracy.reached = NAN;
}

void goal_statistics(const motus_run *r, motus_run_statistics *out)
{
    if (!r->goal) return;
    const accuracy *a = &r->goal->accuracy;
    out->choice = r->goal->choice;
    out->accuracy = a->wanted;
    out->reached = accuracy_reached(a, r);
    out->trials = a->trials;
    if (!isnan(a->wanted)) out->absolute = a->absolute;
}

/* ---- runs ---- */

static void destroy(const motus_allocator *a, struct goal *g)
{
    if (g) accuracy_end(&g->accuracy);
    give(a, g);
}

motus_status goal_run(motus_system *s, motus_run_def *def, motus_run **out, motus_error *err)
{
    run_hint hint = {.accompany = bars_prepare};
    struct goal *goal = NULL;
    motus_status status = reach_goal(s, def, &hint, &goal, err);
    request q = request_of_run(s, def);
    if (status == MOTUS_OK) status = request_choose(s, &q, err);
    if (status == MOTUS_OK) status = suggest_missing(s, &q, err);
    if (status == MOTUS_OK) status = run_of(s, &q, def, &hint, out, err);
    if (*out)
        (*out)->goal = goal;
    else
        destroy(&s->allocator, goal);
    return status;
}

void goal_end(motus_run *r)
{
    if (!r) return;
    struct goal *const goal = r->goal;
    const motus_allocator a = r->allocator;
    run_destroy(r);
    destroy(&a, goal);
}
