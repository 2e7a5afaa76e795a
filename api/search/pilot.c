/* See pilot.h.
 *
 * The candidates integrate the first part of the motion, as far as the first of them comes in STEPS steps, with the
 * tolerance of the run. Their work is counted in operations: evaluations times the operations of the equations, and
 * those of the method. A clock would choose differently on every machine, and on one machine from day to day.
 *
 * Invariant: the choice depends on the system, the initial state, the end and the tolerance alone.
 */
#include "api/search/pilot.h"

#include "api/request/choice.h"
#include "api/motion/run.h"

#include "core/stepper_body.h"

#include "api/system/system.h"

#include <math.h>
#include <stdio.h>

/* FAR: a candidate stops at this many times the work of the best. CHUNK: steps between two looks at that. */
enum { STEPS = 256, FAR = 4, CHUNK = 16 };

/* The first candidate admits every force. Forces that are not smooth have candidates of low order. */
static const char *const smooth[] = {PILOT_FIRST, "dep12", "dep6", "taylor"}, *const kinked[] = {PILOT_FIRST, "dopri5"};

typedef struct fleet {
    motus_system *system;
    motus_run_def def;
    weight weight;
    double until; /* the end of the part that all candidates integrate; NaN: the first one finds it */
    double best;  /* the least work so far */
    double work[PILOT_CANDIDATES];
    double steps[PILOT_CANDIDATES]; /* that each candidate takes for the part */
    const char *const *names;
    size_t count;
} fleet;

/* Lets the caller cancel; how far these short runs have come is not told. */
static int tell(void *ctx, double fraction)
{
    const motus_run_def *const def = ctx;
    (void)fraction;
    return def->progress(def->context, 0);
}

double pilot_work(const motus_run *r, const weight *each, int order)
{
    const problem *p = &r->system->problem;
    if (order) return (double)run_steps(r) * choice_expansion(p, each, order);
    return (double)stepper_evaluations(r->stepper) * choice_evaluation(p, each, r->card);
}

/* Flies one candidate, as far as that is worth while. */
static motus_status fly(fleet *f, size_t k, motus_error *err)
{
    motus_run *r = NULL;
    motus_run_def def = f->def;
    def.method = f->names[k];
    if (!isnan(f->until)) def.until = f->until;
    motus_status status = run_create(f->system, &def, &(run_hint){0}, &r, err);
    const int order = r ? stepper_plan(&f->system->problem, &r->chosen, NULL).expands : 0;
    while (status == MOTUS_OK && !r->arrived && pilot_work(r, &f->weight, order) < FAR * f->best &&
           !(isnan(f->until) && run_steps(r) >= STEPS))
        status = run_step(r, CHUNK, err);
    if (status == MOTUS_OK) {
        f->work[k] = pilot_work(r, &f->weight, order);
        f->steps[k] = (double)run_steps(r);
        if (isnan(f->until)) f->until = run_time(r);
    }
    run_destroy(r);
    return status;
}

/* Returns whether a failure is not the method's. */
static bool ends_all(motus_status status)
{
    return status == MOTUS_CANCELLED || status == MOTUS_MEMORY || status == MOTUS_CALLBACK;
}

static void explain(const fleet *f, size_t chosen, pilot *out)
{
    size_t at = 0;
    int length = snprintf(out->why, sizeof out->why, "%s needs the fewest operations", f->names[chosen]);
    for (size_t k = 0; k < f->count; k++) {
        if (k == chosen || !isfinite(f->work[k])) continue;
        const double ratio = f->work[k] / f->best;
        const bool first = at == 0;
        char times[MOTUS_TEXT_MAX] = "about as many";
        if (ratio >= 1.05)
            error_text(times, "%s%.*f times%s", ratio >= FAR ? "over " : "", ratio < FAR,
                       ratio >= FAR ? (double)FAR : ratio, first ? " as many" : "");
        at += (size_t)length;
        length = snprintf(out->why + at, sizeof out->why - at, "%s %s%s %s", first ? ":" : ",", f->names[k],
                          first ? " needs" : "", times);
    }
}

/* Lists the candidates by their work; equals stay in their order. */
static void list(const fleet *f, pilot *out)
{
    double work[PILOT_CANDIDATES];
    out->count = 0;
    for (size_t k = 0; k < f->count; k++) {
        size_t at = out->count;
        if (!isfinite(f->work[k])) continue;
        for (; at > 0 && work[at - 1] > f->work[k]; at--) work[at] = work[at - 1], out->names[at] = out->names[at - 1];
        work[at] = f->work[k];
        out->names[at] = f->names[k];
        out->count++;
    }
}

motus_status pilot_choose(motus_system *s, const motus_run_def *def, pilot *out, motus_error *err)
{
    motus_system *located = NULL;
    const char *why;
    const motus_status known = located_of(s, def->switches, &located, &why, err);
    if (known != MOTUS_OK) return known;
    const bool kinks = s->model && !s->problem.traits.smooth && !located;
    fleet f = {.system = s, .def = *def, .until = NAN, .best = INFINITY, .names = kinks ? kinked : smooth};
    f.count = kinks ? sizeof kinked / sizeof *kinked : sizeof smooth / sizeof *smooth;
    f.def.error = MOTUS_BARS_NONE;
    f.def.accuracy = NAN;
    f.def.most_steps = 0;
    f.def.observer = NULL;
    motus_run_def caller = *def;
    if (def->progress) f.def.progress = tell, f.def.context = &caller;
    f.def.machine = "interpreter";
    motus_error first = motus_default_error();
    motus_status status = choice_weigh(f.system, &f.weight, err);
    size_t best = f.count;
    for (size_t k = 0; status == MOTUS_OK && k < f.count; k++) {
        motus_error why = motus_default_error();
        chosen c;
        f.work[k] = INFINITY;
        status = row_choose(f.names[k], &c, NULL, &why);
        if (status == MOTUS_OK && row_admits(&c, &s->problem.traits, &why) != MOTUS_OK) continue;
        if (status == MOTUS_OK) status = fly(&f, k, &why);
        if (status != MOTUS_OK && (k == 0 || ends_all(status))) first = why;
        if (status == MOTUS_OK && f.work[k] < f.best) f.best = f.work[k], best = k;
        if (!ends_all(status)) status = MOTUS_OK;
    }
    if (status == MOTUS_OK && best == f.count) status = first.status;
    if (status != MOTUS_OK) {
        if (first.status && err) motus_struct_write(MOTUS_DEF_ERROR, &first, err);
        return status;
    }
    const double part = fabs(f.until - def->start), all = fabs(def->until - def->start);
    list(&f, out);
    out->steps = f.steps[best] * (part > 0 ? all / part : 1);
    explain(&f, best, out);
    return MOTUS_OK;
}
