/* See goal.h. */
#include "api/search/goal.h"

#include "api/error/bars.h"
#include "api/motion/later.h"
#include "api/search/pilot.h"
#include "api/search/suggest.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Refuses contradictions. request_choose judges steps and tolerances without an accuracy. */
static motus_status check(const request *asked, motus_error *err)
{
    const motus_settings *const q = &asked->set;
    const bool step = request_asks(q->step_said);
    const bool both = q->accuracy_said == MOTUS_SAID_CALLER && q->tolerance_said == MOTUS_SAID_CALLER;
    motus_status status = search_alone(both, false, err);
    if (status == MOTUS_OK && q->automatic && step && !asked->ensemble) {
        fail(err, MOTUS_ARGUMENT, "a step is given, and auto chooses methods that choose their steps");
        hint(err, "name a method, verlet or rk4, or give `accuracy = 1e-9` of the definition in its place");
        return MOTUS_ARGUMENT;
    }
    if (status != MOTUS_OK || isnan(q->accuracy)) return status;
    status = search_alone(false, step, err);
    return status == MOTUS_OK ? request_admits("an accuracy", q->accuracy, q->absolute, err) : status;
}

static motus_status refuse_fixed(const chosen *c, motus_error *err)
{
    fail(err, MOTUS_ARGUMENT, "an accuracy is asked for, and the steps of %s have one size", c->name);
    hint(err, "choose an adaptive method, dop853 or taylor: every trajectory then has a tolerance of its own");
    return MOTUS_ARGUMENT;
}

static motus_status refuse_located(const char *what, motus_error *err)
{
    fail(err, MOTUS_UNAVAILABLE, "a run %s cannot be given an accuracy", what);
    hint(err,
         "give a step, `step = 0.01` of the definition, or choose a method that adapts its steps, dop853 or taylor");
    return MOTUS_UNAVAILABLE;
}

motus_status goal_admits(motus_system *s, request *q, motus_error *err)
{
    const char *const asked = q->set.method;
    motus_status status = check(q, err);
    if (status != MOTUS_OK) return status;
    if (q->set.automatic && !q->ensemble) q->set.method = PILOT_FIRST; /* until pilots have chosen */
    status = request_choose(s, q, err);
    q->set.method = asked;
    const bool fixed = status == MOTUS_OK && !row_adaptive(&q->chosen);
    return fixed && q->ensemble && !isnan(q->set.accuracy) ? refuse_fixed(&q->chosen, err) : status;
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

/* Chooses among methods where that is asked, and searches for what reaches the accuracy, if there is one. */
static motus_status seek(motus_system *s, motus_run_def *def, const motus_settings *set, run_hint *hint, struct goal *g,
                         motus_error *err)
{
    pilot p = {.count = 0};
    if (set->automatic) {
        motus_run_def first = *def;
        if (isnan(first.tolerance)) first.tolerance = fmax(set->absolute ? 0 : 1e-14, set->accuracy / 10);
        const motus_status status = pilot_choose(s, &first, &p, err);
        if (status != MOTUS_OK) return status;
        memcpy(g->choice, p.why, sizeof g->choice);
        def->method = p.names[0];
        hint->steps = p.steps;
    }
    if (isnan(set->accuracy)) return MOTUS_OK;
    g->accuracy.wanted = set->accuracy;
    g->accuracy.absolute = set->absolute;
    const attempt asked = {.def = *def, .hint = *hint, .accuracy = g->accuracy};
    attempt best = asked;
    attempt_find(&best, s, NULL);
    if (set->automatic) try_others(s, &asked, &p, &best, g->choice);
    g->accuracy = best.accuracy;
    *def = best.def, *hint = best.hint;
    if (best.failure.status != MOTUS_OK) {
        if (err) motus_struct_write(MOTUS_DEF_ERROR, &best.failure, err);
        return best.failure.status;
    }
    hint->steps = (double)run_steps(g->accuracy.best);
    return MOTUS_OK;
}

/* Searches with switches that are located, where the force may be undefined beyond one: such steps are refused, and
 * usually far fewer than those that it takes to lead across. Leaves *found false, and all as it was, where that does
 * not reach the accuracy. */
static motus_status seek_located(motus_system *s, motus_run_def *def, const motus_settings *set, run_hint *hint,
                                 struct goal *g, bool *found, motus_error *err)
{
    motus_run_def located = *def;
    motus_system *of_switches;
    const char *not_located;
    run_hint theirs = *hint;
    motus_error why = motus_default_error();
    const struct goal before = *g;
    *found = false;
    if (!set->automatic || isnan(set->accuracy) || def->switches != MOTUS_SWITCHES_USUAL) return MOTUS_OK;
    motus_status status = located_of(s, def->switches, &of_switches, &not_located, err);
    if (status != MOTUS_OK || !located_may_leave(s)) return status;
    located.switches = MOTUS_SWITCHES_LOCATE;
    status = seek(s, &located, set, &theirs, g, &why);
    *found = status == MOTUS_OK && !g->accuracy.missed;
    if (*found) {
        *def = located, *hint = theirs;
        return MOTUS_OK;
    }
    accuracy_end(&g->accuracy);
    const int trials = g->accuracy.trials;
    *g = before;
    g->accuracy.trials = trials;
    if (status != MOTUS_CANCELLED && status != MOTUS_MEMORY) return MOTUS_OK;
    if (err) motus_struct_write(MOTUS_DEF_ERROR, &why, err);
    return status;
}

/* Names the method of a definition, and finds what reaches its accuracy, by pilots and trials where they are due. */
static motus_status reach(motus_system *s, motus_run_def *def, request *q, run_hint *hint, struct goal *g,
                          motus_error *err)
{
    const motus_settings *const set = &q->set;
    timing t;
    bool found;
    /* where steps have one size, their size is searched for later */
    motus_status status = run_timing(&q->chosen, 1, set->until, set->from, &t, err);
    if (status != MOTUS_OK) return status;
    def->method = set->automatic ? NULL : set->method;
    def->until = t.until, def->start = t.t0;
    def->absolute = set->absolute;
    def->accuracy = NAN;
    if (isnan(set->accuracy)) def->tolerance = set->tolerance;
    status = seek_located(s, def, set, hint, g, &found, err);
    if (status == MOTUS_OK && !found) status = seek(s, def, set, hint, g, err);
    if (status != MOTUS_OK) return status;
    *q = request_of_run(s, def); /* of what was found */
    return request_choose(s, q, err);
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
    request q = request_of_run(s, def);
    motus_status status = goal_admits(s, &q, err);
    if (status == MOTUS_OK) status = suggest_missing(s, &q, err);
    const bool accurate = !isnan(q.set.accuracy);
    if (status == MOTUS_OK && accurate && def->switches == MOTUS_SWITCHES_RESOLVE)
        status = refuse_located("that resolves switches", err);
    if (status == MOTUS_OK && accurate && def->switches == MOTUS_SWITCHES_LOCATE && !row_adaptive(&q.chosen))
        status = refuse_located("by steps of one size that locates switches", err);
    if (status == MOTUS_OK && (accurate || q.set.automatic)) {
        goal = take(&s->allocator, 1, sizeof *goal);
        if (!goal) return fail(err, MOTUS_MEMORY, "no memory for the run");
        *goal = (struct goal){.accuracy = {.wanted = NAN, .reached = NAN, .rounding = NAN}};
        status = reach(s, def, &q, &hint, goal, err);
    }
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
