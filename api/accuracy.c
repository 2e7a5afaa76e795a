/* See accuracy.h.
 *
 * A trial integrates to the end with a companion beside it, and its largest bar is compared with what is wanted. The
 * error of the answer is proportional to the tolerance, or to a power of the step, up to a factor that no formula
 * knows: it contains what the motion makes of errors, and how they cancel. So one trial tells the size of the next. A
 * trial that is far off is not taken to its end; how its bar would have gone on is then guessed, with the square of
 * the time.
 *
 * Where bars no longer fall with the tolerance, rounding has the word, and no tolerance helps.
 */
#include "api/accuracy.h"

#include "api/bars.h"
#include "api/choice.h"
#include "api/suggest.h"

#include "lang/base/operation.h"

#include <math.h>
#include <stdio.h>

enum { TRIALS = 6, CHUNK = 256 };
#define MARGIN 0.3            /* the next trial aims at this part of what is wanted */
#define HOPELESS 30           /* a trial whose bars are so many times what is wanted is stopped, */
#define ROUNDED 1e-8          /*   unless they are below this, relative to the motion; */
#define WRECKED 0.05          /*   and one with such bars tells no more than that the tolerance was far too large: */
#define NEARER 1e-2           /*   the next is smaller by this factor */
#define FARTHEST 1e-6         /* no trial is smaller than the one before by more */
#define FALLS 0.7             /* bars fall where the next one is below this part of the last */
#define TOLERANCE_TRIED 5e-15 /* below this a relative tolerance is rounding */
#define STEPS_TRIED 1e8       /* of a method with steps of one size */

/* A search may have any number of trials, so each takes half of what is left of it. */
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

typedef struct search {
    motus_system *system;
    share share;
    motus_run_def def; /* of the trial; its tolerance, or its step, is the size */
    double *size;
    double power;   /* errors go with this power of the size */
    double least;   /* size */
    double length;  /* of a run whose steps have one size, else 0: its steps divide it */
    double steps;   /* about how many a trial takes, 0: not known */
    motus_run *run; /* the trial in hand */
    double bar;     /* the largest of it, INFINITY: it has none, or failed */
    double done;    /* how far it came, as a part of the whole way */
    motus_error failure;
} search;

static double bar_of(const motus_run *r, bool absolute)
{
    return r->bars->why[0] ? INFINITY : differences_worst(&r->bars->differences, absolute);
}

/* Bars near the rounding are no reason to stop: they may be the best that there is. */
static bool hopeless(const search *s, double wanted)
{
    return bar_of(s->run, s->def.absolute) > HOPELESS * wanted && bar_of(s->run, false) > ROUNDED;
}

/* A failure that another tolerance does not mend. */
static bool ends_all(motus_status status)
{
    return status == MOTUS_CANCELLED || status == MOTUS_MEMORY || status == MOTUS_CALLBACK ||
           motus_status_exit(status) == 2;
}

/* Steps of one size divide the way; a tolerance has two digits, so that it can be given again. */
static void set_size(search *s, double size)
{
    int power = 0;
    if (s->length > 0) {
        *s->size = s->length / ceil(s->length / size * (1 - 1e-12));
        return;
    }
    for (; size < 10 && power > -300; power--) size *= 10;
    for (; size >= 100; power++) size /= 10;
    *s->size = decimal_scaled(floor(size * (1 + 1e-12)), power);
}

/* One trial. MOTUS_OK also where the run itself failed: then its bar is infinite. */
static motus_status try(search *s, double wanted, motus_error *err)
{
    const bool absolute = s->def.absolute;
    s->failure = motus_default_error();
    s->bar = INFINITY;
    s->done = 0;
    s->share.size = (1 - s->share.from) / 2;
    const run_hint hint = {.steps = s->steps};
    motus_status status = run_create(s->system, &s->def, &hint, &s->run, &s->failure);
    /* the tolerance with which it runs */
    if (status == MOTUS_OK && row_adaptive(&s->run->chosen) && !absolute && s->run->chosen.relative < *s->size)
        set_size(s, s->run->chosen.relative);
    while (status == MOTUS_OK && !motus_run_done(s->run) && !hopeless(s, wanted))
        status = motus_run_step(s->run, CHUNK, &s->failure);
    if (status == MOTUS_OK) {
        motus_estimate e = motus_default_estimate();
        status = motus_run_estimate(s->run, &e, &s->failure);
    }
    if (status == MOTUS_OK) {
        const timing *t = &s->run->timing;
        s->bar = bar_of(s->run, absolute);
        s->done = t->until != t->t0 ? (motus_run_time(s->run) - t->t0) / (t->until - t->t0) : 1;
        s->steps = s->done > 0 ? (double)motus_run_steps(s->run) / s->done : 0;
        if (!s->run->bars->why[0]) return MOTUS_OK;
        fail(&s->failure, MOTUS_ACCURACY, "no accuracy can be promised, because %s", s->run->bars->why);
        status = MOTUS_ACCURACY;
    }
    if (!ends_all(status) && status != MOTUS_ACCURACY) return MOTUS_OK;
    if (err) motus_struct_write(MOTUS_DEF_ERROR, &s->failure, err);
    return status;
}

/* The size of the trial after this one. */
static double next_size(const search *s, double wanted)
{
    const double bar = s->done > 0 ? s->bar / (s->done * s->done) : INFINITY;
    double factor = fmax(FARTHEST, fmin(1, MARGIN * wanted / bar));
    if (!(s->bar < WRECKED) && !s->def.absolute) factor = fmin(fmax(factor, NEARER / 10), NEARER);
    if (!isfinite(s->bar)) factor = NEARER;
    return fmax(s->least, *s->size * operation_value(OP_POW, factor, 1 / s->power, 0));
}

static motus_status begin(search *s, const accuracy *a, motus_error *err)
{
    chosen c;
    const motus_method *card;
    motus_status status = choice_method(s->system, s->def.method, &c, &card, err);
    if (status != MOTUS_OK) return status;
    s->power = 1;
    if (row_adaptive(&c)) {
        s->size = &s->def.tolerance;
        s->least = a->absolute ? 0 : TOLERANCE_TRIED;
        set_size(s, fmax(s->least, a->wanted / 10));
        return status;
    }
    motus_settings set = motus_default_settings();
    set.method = s->def.method;
    set.until = s->def.until;
    set.from = s->def.start;
    status = motus_suggest(s->system, &set, err);
    s->size = &s->def.step;
    s->length = fabs(s->def.until - s->def.start);
    s->power = card->order > 0 ? card->order : 1;
    s->least = s->length / STEPS_TRIED;
    if (status == MOTUS_OK) set_size(s, set.step);
    s->steps = 0;
    return status;
}

/* Keeps the trial if it is the best. */
static void keep(search *s, accuracy *a, double *size)
{
    const double bar = s->done >= 1 ? s->bar : INFINITY;
    if (!a->best || bar <= a->reached) {
        motus_run_destroy(a->best);
        a->best = s->run;
        a->reached = bar;
        *size = *s->size;
    } else {
        motus_run_destroy(s->run);
    }
    s->run = NULL;
}

static void explain(accuracy *a, const search *s)
{
    char wanted[DECIMAL_MAX], t[DECIMAL_MAX];
    decimal(a->wanted, wanted);
    const motus_run *best = a->best;
    if (!isfinite(a->reached))
        snprintf(
            a->why, sizeof a->why,
            "the accuracy %s cannot be reached: no digit of the answer is significant after t = %s", wanted,
            run_time_text(
                best, isnan(best->bars->differences.until) ? motus_run_time(best) : best->bars->differences.until, t));
    else
        snprintf(a->why, sizeof a->why, "the accuracy %s cannot be reached: the best is %.1e%s, with the %s %.2g",
                 wanted, a->reached, a->absolute ? "" : " of the motion's size", s->power == 1 ? "tolerance" : "step",
                 *s->size);
}

motus_status accuracy_find(motus_system *system, motus_run_def *def, double steps, accuracy *a, motus_error *err)
{
    search s = {.system = system, .def = *def, .steps = steps};
    s.def.accuracy = NAN;
    s.def.observer = NULL;
    s.def.error = MOTUS_BARS_CHEAP;
    s.share = (share){.progress = def->progress, .context = def->context};
    if (def->progress) s.def.progress = tell, s.def.context = &s.share;
    double last = INFINITY, size = NAN;
    motus_status status = begin(&s, a, err);
    a->best = NULL;
    for (a->trials = 0; status == MOTUS_OK && a->trials < TRIALS;) {
        a->trials++;
        status = try(&s, a->wanted, err);
        if (status != MOTUS_OK) break;
        s.share.from += s.share.size;
        const double bar = s.bar, next = next_size(&s, a->wanted);
        const bool whole = s.done >= 1;
        if (s.run) keep(&s, a, &size);
        if (whole && bar <= a->wanted) break;
        if (whole && !(bar < FALLS * last)) break;
        if (!(next < *s.size)) break;
        if (whole) last = bar;
        set_size(&s, next);
    }
    motus_run_destroy(s.run);
    if (status == MOTUS_OK && !a->best) {
        status = s.failure.status;
        if (err) motus_struct_write(MOTUS_DEF_ERROR, &s.failure, err);
    }
    if (status != MOTUS_OK) {
        accuracy_end(a);
        return status;
    }
    *s.size = size;
    def->tolerance = s.def.tolerance;
    def->step = s.def.step;
    if (!(a->reached <= a->wanted)) explain(a, &s);
    return MOTUS_OK;
}

void accuracy_end(accuracy *a)
{
    motus_run_destroy(a->best);
    a->best = NULL;
}
