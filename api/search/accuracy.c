/* See accuracy.h.
 *
 * A trial goes to the end with a companion, and its largest bar is compared with the accuracy; search.c tells the size
 * of the next trial.
 */
#include "api/search/accuracy.h"

#include "api/error/bars.h"
#include "api/system/columns.h"
#include "api/system/vector.h"
#include "api/error/witness.h"

#include <math.h>

enum { CHUNK = 256, EARLY = 1 << 12 };

/* What a trial tells of progress: a search may have any number of trials, so each takes half of what is left. */
typedef struct share {
    int (*progress)(void *context, double fraction);
    void *context;
    double from, size;
} share;

static int tell(void *context, double fraction)
{
    const share *s = context;
    return s->progress(s->context, s->from + fraction * s->size);
}

typedef struct trial {
    motus_system *system;
    share share;
    motus_run_def def;
    search search;
    double *size;   /* the tolerance of the definition, or its step */
    run_hint hint;  /* of the next trial */
    motus_run *run; /* the present trial */
    double bar;     /* the largest bar of the trial; INFINITY: there is none */
    double done;    /* the part of the way that it came */
    bool once;      /* no trial follows one without digits */
    motus_error failure;
} trial;

static double bar_of(const motus_run *r, bool absolute)
{
    return r->bars->why[0] ? INFINITY : differences_worst(&r->bars->differences, absolute, true);
}

static bool hopeless(const trial *s)
{
    return search_hopeless(&s->search, bar_of(s->run, s->def.absolute), bar_of(s->run, false));
}

/* Returns whether no other tolerance mends a failure. */
static bool ends_all(motus_status status)
{
    return status == MOTUS_CANCELLED || status == MOTUS_MEMORY || status == MOTUS_CALLBACK ||
           motus_status_exit(status) == 2;
}

/* Returns whether the switches cannot be located, since the run's force was not the typed one. */
static bool refuted(const motus_run *r)
{
    size_t number = SIZE_MAX;
    if (r && r->bars) witness_differs(r->bars->witness, &number);
    return number != SIZE_MAX;
}

/* Takes the trial's steps. A stepper looks late for a crawl, so that hardly any run is asked; a trial whose first steps
 * lead nowhere is asked at once. */
static motus_status integrate(trial *s)
{
    motus_run *r = s->run;
    const timing *t = &r->timing;
    bool asked = !row_adaptive(&r->chosen) || !stepper_problem(r->stepper)->traits.smooth;
    motus_status status = MOTUS_OK;
    while (status == MOTUS_OK && !r->arrived && !hopeless(s)) {
        status = run_step(r, CHUNK, &s->failure);
        const int64_t steps = run_steps(r);
        if (status != MOTUS_OK || asked || steps < EARLY) continue;
        const double now = run_time(r), gone = fabs(now - t->t0);
        const double pace = gone * STEPPER_PACE / (double)steps;
        asked = true;
        if (stepper_may_crawl(STEPPER_PACE, pace, fabs(t->until - now), 0, true))
            status = diagnosis_crawls(&r->diagnosed, r->stepper, steps, gone, &s->failure);
    }
    return status;
}

/* Takes one trial. MOTUS_OK also where the run itself failed: its bar is then INFINITY. */
static motus_status try(trial *s, motus_error *err)
{
    const bool absolute = s->def.absolute;
    *s->size = s->search.size;
    s->failure = motus_default_error();
    s->bar = INFINITY;
    s->done = 0;
    s->share.size = (1 - s->share.from) / 2;
    motus_status status = run_create(s->system, &s->def, &s->hint, &s->run, &s->failure);
    /* the stepper may run with a smaller tolerance */
    if (status == MOTUS_OK && row_adaptive(&s->run->chosen) && !absolute && s->run->chosen.relative < *s->size) {
        search_set(&s->search, s->run->chosen.relative);
        *s->size = s->search.size;
    }
    if (status == MOTUS_OK) status = integrate(s);
    if (status == MOTUS_OK) status = bars_land(s->run, &s->failure);
    if (s->def.switches == MOTUS_SWITCHES_USUAL && refuted(s->run)) {
        motus_error located = s->failure;
        run_destroy(s->run);
        s->run = NULL;
        s->def.switches = MOTUS_SWITCHES_STEP;
        s->hint.not_located = "switches are not located: their sides would give another force than the one that is "
                              "written";
        status = try(s, err);
        if (status != MOTUS_ACCURACY || !err) return status;
        located.hint[0] = 0; /* this has been tried */
        motus_struct_write(MOTUS_DEF_ERROR, &located, err);
        return located.status;
    }
    if (status == MOTUS_OK) {
        const timing *t = &s->run->timing;
        s->bar = bar_of(s->run, absolute);
        s->done = s->run->arrived ? 1 : t->until != t->t0 ? (run_time(s->run) - t->t0) / (t->until - t->t0) : 1;
        s->hint.steps = s->done > 0 ? (double)run_steps(s->run) / s->done : 0;
        if (!s->run->bars->why[0]) return MOTUS_OK;
        fail(&s->failure, MOTUS_ACCURACY, "no accuracy can be promised, because %s", s->run->bars->why);
        status = MOTUS_ACCURACY;
    }
    /* No smaller tolerance avoids what the motion does, nor a first tolerance that is below rounding. */
    const motus_cause cause = s->failure.cause;
    const bool motions = cause == MOTUS_CAUSE_SINGULAR || cause == MOTUS_CAUSE_STIFF || cause == MOTUS_CAUSE_INFINITE;
    const bool rounds = cause == MOTUS_CAUSE_ROUNDING && s->search.trials == 0;
    const bool ends = (motions || rounds) && s->search.length == 0;
    if (!ends_all(status) && status != MOTUS_ACCURACY && !ends) return MOTUS_OK;
    if (err) motus_struct_write(MOTUS_DEF_ERROR, &s->failure, err);
    return status;
}

static motus_status begin(trial *s, const accuracy *a, motus_error *err)
{
    chosen c;
    const motus_method *card;
    motus_status status = request_row(s->system, s->def.method, &c, &card, err);
    if (status != MOTUS_OK) return status;
    if (row_adaptive(&c)) {
        s->size = &s->def.tolerance;
        s->search = search_by_tolerance(a->wanted, a->absolute);
        return status;
    }
    motus_settings set = motus_default_settings();
    set.method = s->def.method;
    set.until = s->def.until;
    set.from = s->def.start;
    status = motus_suggest(s->system, &set, err);
    s->size = &s->def.step;
    s->hint.steps = 0;
    s->search = search_by_step(a->wanted, a->absolute, set.step, fabs(s->def.until - s->def.start), card->order);
    return status;
}

/* Keeps the trial if it is the best so far. */
static void keep(trial *s, accuracy *a, double *size)
{
    const double bar = s->done >= 1 ? s->bar : INFINITY;
    if (!a->best || bar <= a->reached) {
        run_destroy(a->best);
        a->best = s->run;
        a->reached = bar;
        *size = *s->size;
    } else {
        run_destroy(s->run);
    }
    s->run = NULL;
}

/* Finds the part of the error that no tolerance lessens, where that is more than was wanted. */
static motus_status find_decimals(accuracy *a, trial *s, motus_error *err)
{
    double part;
    s->share.size = 1 - s->share.from;
    motus_status status = decimals_part(&s->def, a->best, a->absolute, &part, err);
    if (status == MOTUS_OK && part > a->wanted) a->rounding = part;
    return status;
}

/* Writes why the force makes errors large, for the end of a sentence. */
static const char *because(const accuracy *a, char out[MOTUS_TEXT_MAX])
{
    out[0] = 0;
    if (a->steep.text[0]) error_text(out, "; %s", a->steep.text);
    return out;
}

bool accuracy_wants_another(const accuracy *a, const motus_error *failure)
{
    if (failure->status == MOTUS_OK) return a->missed && (a->steep.text[0] || a->failed);
    return !ends_all(failure->status) && failure->cause == MOTUS_CAUSE_NONE;
}

/* Reports how the trials have failed. */
static motus_status tell_failure(accuracy *a, const trial *s, motus_error *failure, motus_error *err)
{
    char of[MOTUS_TEXT_MAX];
    accuracy_end(a);
    if (accuracy_wants_another(a, failure)) {
        const motus_status status = steep_find(s->system, &s->def, &a->steep, err);
        if (status != MOTUS_OK) return status;
        const motus_error kept = *failure;
        error_text(failure->message, "%s%s", kept.message, because(a, of));
    }
    if (err) motus_struct_write(MOTUS_DEF_ERROR, failure, err);
    return failure->status;
}

double accuracy_reached(const accuracy *a, const motus_run *r)
{
    return isfinite(a->reached) || !r->arrived || !r->bars ? a->reached : bars_worst(r->bars, a->absolute, true);
}

motus_status accuracy_refuse(const accuracy *a, const motus_run *r, motus_error *err)
{
    char wanted[DECIMAL_MAX], t[DECIMAL_MAX], size[MOTUS_TEXT_MAX], part[MOTUS_TEXT_MAX] = "", why[MOTUS_TEXT_MAX];
    const char *const unit = a->absolute ? "" : " of the motion's size";
    const bool lost = r->bars && !isnan(r->bars->differences.until);
    const double reached = accuracy_reached(a, r);
    decimal(a->wanted, wanted);
    error_text(size, "with the %s %.2g", a->by_step ? "step" : "tolerance", a->size);
    if (!isnan(a->rounding))
        error_text(part, "; of that, up to %.1e comes from the rounding of the model's decimals to doubles",
                   a->rounding);
    because(a, why);
    if (isfinite(a->reached))
        fail(err, MOTUS_ACCURACY, "the accuracy %s is not reached: the trials reached %.1e%s at best, %s%s%s", wanted,
             reached, unit, size, part, why);
    else if (lost)
        fail(err, MOTUS_ACCURACY,
             "the accuracy %s is not reached: no digit of the answer is known to be significant after t = %s%s", wanted,
             run_time_text(r, r->bars->differences.until, t), why);
    else if (isfinite(reached))
        fail(err, MOTUS_ACCURACY, "the accuracy %s is not reached: the error is %.1e%s, %s%s", wanted, reached, unit,
             size, why);
    else
        fail(err, MOTUS_ACCURACY, "the accuracy %s is not reached: the best trial was beyond it at t = %s, %s%s",
             wanted, run_time_text(r, a->time, t), size, why);
    column_names_error(r->system, err);
    if (lost && !why[0])
        hint(err, "errors grow with the time: end earlier, with a smaller `until` of the definition");
    else
        hint(err, "the numbers are there, with the errors that they have; allow a larger error");
    return MOTUS_ACCURACY;
}

void accuracy_end(accuracy *a)
{
    run_destroy(a->best);
    a->best = NULL;
}

/* Takes trials; *size: that of the best. */
static motus_status find(trial *s, accuracy *a, double *size, motus_error *failure)
{
    bool more = true;
    motus_status status = begin(s, a, failure);
    a->best = NULL;
    while (status == MOTUS_OK && more) {
        status = try(s, failure);
        if (status != MOTUS_OK) break;
        s->share.from += s->share.size;
        if (s->run) keep(s, a, size);
        more = search_next(&s->search, s->bar, s->done) && (isfinite(s->bar) || !s->once);
    }
    a->trials += s->search.trials;
    if (status != MOTUS_OK || a->best) return status;
    *failure = s->failure;
    return failure->status;
}

/* Returns `part` of the largest number of the state, rounded to a power of ten. */
static double part_of_largest(const motus_run *r, double part)
{
    const problem *const p = stepper_problem(r->stepper);
    const double most = fmax(vector_largest(r->x, p->nx), vector_largest(r->v, p->nv)),
                 digits = most > 0 && isfinite(most) ? floor(log10(most)) : 0;
    return digits < 0 ? part / pow(10, -digits) : part * pow(10, digits);
}

#define NEARLY 10.0 /* times the accuracy: a motion that goes no farther rests */

/* Takes the trials once more, where a number is rounding alone and no part of it can be asked for: the accuracy is then
 * absolute, that part of the largest numbers. If that fails, what was found before stays. */
static motus_status find_absolute(trial *s, accuracy *a, motus_status before, double *size, motus_error *failure)
{
    motus_error theirs = motus_default_error();
    accuracy whole = *a;
    double found = NAN;
    whole.wanted = part_of_largest(a->best ? a->best : s->run, whole.wanted);
    whole.absolute = true;
    s->def.absolute = s->once = true;
    run_destroy(s->run);
    s->run = NULL;
    const motus_status status = find(s, &whole, &found, &theirs);
    if (status == MOTUS_OK && whole.reached <= whole.wanted) {
        accuracy_end(a);
        *a = whole;
        *size = found;
        return MOTUS_OK;
    }
    accuracy_end(&whole);
    s->def.absolute = false;
    if (!ends_all(status)) return before;
    *failure = theirs;
    return status;
}

motus_status accuracy_find(motus_system *system, motus_run_def *def, run_hint *hint, accuracy *a, motus_error *err)
{
    trial s = {.system = system, .def = *def, .hint = *hint};
    s.def.accuracy = NAN;
    s.def.observer = NULL;
    s.def.error = MOTUS_BARS_CHEAP;
    s.share = (share){.progress = def->progress, .context = def->context};
    if (def->progress) s.def.progress = tell, s.def.context = &s.share;
    double size = NAN;
    motus_error failure = motus_default_error();
    motus_status status = find(&s, a, &size, &failure);
    const bool rounds = status != MOTUS_OK && failure.cause == MOTUS_CAUSE_ROUNDING && s.run,
               rests = status == MOTUS_OK && a->reached > a->wanted &&
                       differences_still(&a->best->bars->differences, NEARLY * a->wanted);
    if (!a->absolute && (rounds || rests)) status = find_absolute(&s, a, status, &size, &failure);
    run_destroy(s.run);
    if (status != MOTUS_OK) return tell_failure(a, &s, &failure, err);
    *s.size = size;
    def->tolerance = s.def.tolerance;
    def->absolute = s.def.absolute;
    def->step = s.def.step;
    def->switches = s.def.switches;
    hint->not_located = s.hint.not_located;
    a->by_step = s.search.length > 0;
    a->size = size;
    if (a->reached <= a->wanted) return MOTUS_OK;
    a->missed = true;
    a->failed = !isfinite(a->reached) && s.failure.status != MOTUS_OK && s.failure.cause == MOTUS_CAUSE_NONE;
    a->time = run_time(a->best);
    status = steep_find(s.system, &s.def, &a->steep, err);
    if (status == MOTUS_OK && isfinite(a->reached)) status = find_decimals(a, &s, err);
    if (status != MOTUS_OK) accuracy_end(a);
    return status;
}
