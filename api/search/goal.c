/* See goal.h.
 *
 * Who says what: the caller's definition comes first, and what the model says of its own method is left aside where the
 * caller names another one, or wants an accuracy that the model does not set.
 */
#include "api/search/goal.h"

#include "api/error/bars.h"
#include "api/request/choice.h"
#include "api/request/control.h"
#include "api/motion/later.h"
#include "api/search/pilot.h"
#include "api/search/suggest.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ACCURACY 1e-9 /* of a run for which nobody says how exact it is to be */

/* The method, "auto" included. */
static const char *name_of(const motus_run_def *def, const goal_wish *w)
{
    if (def->method) return def->method;
    if (w->set.method) return w->set.method;
    return isnan(def->step) && isnan(w->set.step) ? SYSTEM_AUTO : "verlet";
}

goal_wish goal_wish_of(const motus_system *s, const motus_run_def *def)
{
    goal_wish w = {.set = motus_default_settings(), .accuracy = def->accuracy, .absolute = def->absolute};
    motus_settings_of(s, &w.set);
    const bool own = isnan(w.set.accuracy) && !isnan(def->accuracy); /* the accuracy is the caller's alone */
    if (def->method || own) {
        w.set.method = NULL;
        w.set.step = w.set.tolerance = w.set.accuracy = NAN;
    }
    const bool given = !isnan(def->accuracy) || !isnan(def->tolerance) || !isnan(def->step);
    if (!given && !isnan(w.set.accuracy)) w.accuracy = w.set.accuracy, w.absolute = w.set.absolute;
    w.automatic = system_auto(name_of(def, &w));
    return w;
}

/* What contradicts itself. Steps and tolerances without an accuracy are judged by control_choose. */
static motus_status check(const motus_run_def *def, const goal_wish *w, motus_error *err)
{
    const bool step = !isnan(def->step) || !isnan(w->set.step);
    motus_status status = search_alone(!isnan(def->accuracy) && !isnan(def->tolerance), false, err);
    if (status == MOTUS_OK && w->automatic && step) {
        fail(err, MOTUS_ARGUMENT, "a step is given, and auto chooses methods that choose their steps");
        hint(err, "name a method, verlet or rk4, or give `accuracy = 1e-9` of the definition in its place");
        return MOTUS_ARGUMENT;
    }
    if (status != MOTUS_OK || isnan(w->accuracy)) return status;
    status = search_alone(false, step, err);
    if (status != MOTUS_OK) return status;
    if (def->switches != MOTUS_SWITCHES_STEP && def->switches != MOTUS_SWITCHES_USUAL)
        return fail(err, MOTUS_UNAVAILABLE, "a run that locates switches cannot be given an accuracy");
    return control_admits("an accuracy", w->accuracy, w->absolute, err);
}

/* The start and the end, which pilot and trial runs need. */
static motus_status settle(motus_system *s, motus_run_def *def, const goal_wish *w, motus_error *err)
{
    chosen c;
    timing t;
    const motus_method *card;
    double step = w->automatic || !isnan(def->step) ? def->step : 1;
    motus_status status = choice_method(s, w->automatic ? PILOT_FIRST : def->method, &c, &card, err);
    if (status == MOTUS_OK) status = suggest_missing(s, &c, c.name, def->start, &step, &def->until, err);
    if (status == MOTUS_OK) status = run_timing(s, &c, step, def->until, def->start, &t, err);
    if (status == MOTUS_OK) def->until = t.until, def->start = t.t0;
    return status;
}

/* With this method: what it reaches, how it may fail, and with what definition. */
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

/* Other methods that pilots have flown, where the first fails for a reason of its own. */
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
        /* what ends all ends this, too */
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

static motus_status reach(motus_system *s, motus_run_def *def, const goal_wish *w, run_hint *hint, struct goal *g,
                          motus_error *err)
{
    pilot p = {.count = 0};
    motus_status status = settle(s, def, w, err);
    if (status == MOTUS_OK && w->automatic) {
        motus_run_def first = *def;
        if (isnan(first.tolerance)) first.tolerance = w->absolute ? w->accuracy / 10 : fmax(1e-14, w->accuracy / 10);
        status = pilot_choose(s, &first, &p, err);
        if (status != MOTUS_OK) return status;
        memcpy(g->choice, p.why, sizeof g->choice);
        def->method = p.names[0];
        hint->steps = p.steps;
    }
    if (status != MOTUS_OK || isnan(w->accuracy)) return status;
    g->accuracy.wanted = w->accuracy;
    g->accuracy.absolute = w->absolute;
    const attempt asked = {.def = *def, .hint = *hint, .accuracy = g->accuracy};
    attempt best = asked;
    attempt_find(&best, s, NULL);
    if (w->automatic) try_others(s, &asked, &p, &best, g->choice);
    g->accuracy = best.accuracy;
    *def = best.def, *hint = best.hint;
    if (best.failure.status == MOTUS_OK)
        hint->steps = (double)run_steps(g->accuracy.best);
    else if (err)
        motus_struct_write(MOTUS_DEF_ERROR, &best.failure, err);
    return best.failure.status;
}

/* Completes a definition: names its method, and finds what reaches its accuracy, by pilot and trial runs where they are
 * due. *goal: NULL, or the run's. */
static motus_status reach_goal(motus_system *s, motus_run_def *def, run_hint *hint, struct goal **goal,
                               motus_error *err)
{
    goal_wish w = goal_wish_of(s, def);
    if (w.automatic && isnan(w.accuracy) && isnan(def->tolerance) && isnan(w.set.tolerance)) w.accuracy = ACCURACY;
    motus_status status = check(def, &w, err);
    *goal = NULL;
    if (status != MOTUS_OK || (!w.automatic && isnan(w.accuracy))) return status;
    struct goal *g = *goal = take(&s->allocator, 1, sizeof *g);
    if (!g) return fail(err, MOTUS_MEMORY, "no memory for the run");
    *g = (struct goal){.accuracy = {.wanted = NAN, .reached = NAN, .rounding = NAN}};
    def->method = w.automatic ? NULL : name_of(def, &w);
    def->absolute = w.absolute;
    def->accuracy = NAN;
    if (isnan(def->tolerance) && isnan(w.accuracy)) def->tolerance = w.set.tolerance, def->absolute = w.set.absolute;
    return reach(s, def, &w, hint, g, err);
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

void goal_statistics(const motus_run *r, motus_statistics *out)
{
    if (!r->goal) return;
    const accuracy *a = &r->goal->accuracy;
    out->accuracy = a->wanted;
    out->reached = accuracy_reached(a, r);
    out->trials = a->trials;
    if (!isnan(a->wanted)) out->absolute = a->absolute;
}

const char *goal_choice(const motus_run *r) { return r->goal ? r->goal->choice : ""; }

/* ---- runs ---- */

static void destroy(const motus_allocator *a, struct goal *g)
{
    if (g) accuracy_end(&g->accuracy);
    give(a, g);
}

/* The step and the end that nobody gives. */
static motus_status complete(motus_system *s, motus_run_def *def, motus_error *err)
{
    chosen c;
    const motus_method *card;
    const control_wish wish = control_wish_of_run(def);
    motus_status status = choice_method(s, def->method, &c, &card, err);
    if (status == MOTUS_OK) status = control_choose(s, &wish, &c, err);
    return status == MOTUS_OK ? suggest_missing(s, &c, def->method, def->start, &def->step, &def->until, err) : status;
}

motus_status goal_run(motus_system *s, motus_run_def *def, motus_run **out, motus_error *err)
{
    run_hint hint = {.accompany = bars_prepare};
    struct goal *goal = NULL;
    motus_status status = reach_goal(s, def, &hint, &goal, err);
    if (status == MOTUS_OK) status = complete(s, def, err);
    if (status == MOTUS_OK) status = run_create(s, def, &hint, out, err);
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
