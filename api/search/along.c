/* See along.h.
 *
 * The pilot is a run by an embedded pair of orders 5 and 4 with a rough tolerance: it has the motion's events, and
 * takes short steps where the motion is fast. Invariant: the system is not changed.
 */
#include "api/search/along.h"

#include "api/request/choice.h"
#include "api/motion/run.h"
#include "api/system/vector.h"

#include <math.h>
#include <string.h>

#define PILOT "dopri5"
#define TOLERANCE 1e-4
#define STAGES 6
enum { LOOKS_FEW = 16, LOOKS_EVEN = 4 }; /* LOOKS_EVEN: looks before their interval doubles */
#define LOOK 80                          /* evaluations for the rates at one state */
/* This many operations take less than a millisecond in the interpreter. Every system affords the rates at two states;
 * more evaluations than EVALUATIONS_MOST tell little that is new. */
#define OPERATIONS 6e5
#define EVALUATIONS_LEAST (2 * LOOK)
#define EVALUATIONS_MOST (2400 + ALONG_MOST * LOOK)
#define OVERHEAD 8  /* operations of the method for each number, per evaluation */
#define SETTLED 3   /* steps until their length no longer follows from the first */
#define SHORTER 0.8 /* than the shortest step before: the motion has become faster */
#define TWO_PI 6.283185307179586
#define DECAY 0.05 /* the part of an eigenvalue below which its imaginary part is 0 */
/* A motion that runs into a singularity becomes faster and faster, and its places do not count; they do where it has
 * become slower again, or goes on for long. */
#define PASSED 0.7
#define LASTING 30.0 /* c in the rate c/(time to a singularity) is below this for forces that are powers */

typedef struct pilot_run {
    motus_run *run;
    linear *at;
    double *basis;
    along *out;
} pilot_run;

static void look(pilot_run *p, double time, double span)
{
    along_place *here = &p->out->places[p->out->count];
    const problem *q = p->at->problem;
    p->at->t = run_time(p->run);
    if (run_sync(p->run, false, NULL) != MOTUS_OK) return;
    if (q->nx) memcpy(p->at->x, p->run->x, q->nx * sizeof(double));
    memcpy(p->at->v, p->run->v, q->nv * sizeof(double));
    const double x = vector_largest(p->at->x, linear_positions(q)), v = vector_largest(p->at->v, q->nv);
    p->at->size_x = fmax(p->at->size_x, x);
    p->at->size_v = v > 0 ? v : 1;
    linear_rates_of(p->at, p->basis, &here->rates);
    if (!(here->rates.fastest >= 0) || !isfinite(here->rates.fastest)) return;
    here->time = time;
    here->span = span;
    p->out->count++;
}

/* Finds how many evaluations the whole may take. */
static motus_status afford(motus_system *s, double *evaluations, motus_error *err)
{
    const double numbers = (double)(s->problem.nx + s->problem.nv);
    weight w;
    const motus_status status = choice_weigh(s, &w, err);
    const double most = OPERATIONS / (w.values + OVERHEAD * numbers);
    *evaluations = fmin(EVALUATIONS_MOST, fmax(EVALUATIONS_LEAST, most));
    return status;
}

/* Follows the pilot. Half of the effort is for steps, half for looks: of these, half where steps become shorter, the
 * others at intervals that double, since the number of steps is not known. Few looks are spread evenly, so that none
 * comes too early. */
static motus_status follow(pilot_run *p, double evaluations)
{
    along *out = p->out;
    const double looks = fmin(ALONG_MOST, floor(evaluations / (2 * LOOK))), steering = evaluations - LOOK * looks;
    const int64_t spread = (int64_t)ceil(steering / STAGES / looks);
    size_t even = 0, quick = 0;
    motus_status status = MOTUS_OK;
    const double from = p->at->t;
    double before = 0, seen = 0, shortest = INFINITY;
    while (status == MOTUS_OK && !p->run->arrived && (double)stepper_evaluations(p->run->stepper) < steering) {
        status = run_step(p->run, 1, NULL);
        const double time = fabs(run_time(p->run) - from), h = time - before;
        const int64_t steps = run_steps(p->run);
        before = time;
        if (status != MOTUS_OK || !(h > 0)) continue;
        const bool faster = steps > SETTLED && h < SHORTER * shortest && !p->run->arrived;
        if (steps > SETTLED && !p->run->arrived) shortest = fmin(shortest, h);
        const int64_t every = looks < LOOKS_FEW ? spread : (int64_t)1 << even / LOOKS_EVEN;
        const bool due = steps % every == 0 && (looks < LOOKS_FEW || even < ALONG_MOST / 2);
        if ((double)out->count >= looks || !(due || (faster && quick < ALONG_MOST / 2))) continue;
        look(p, time, time - seen);
        seen = time;
        *(due ? &even : &quick) += 1;
    }
    out->time = before;
    out->whole = p->run->arrived;
    return status == MOTUS_MEMORY || p->at->no_memory ? MOTUS_MEMORY : MOTUS_OK;
}

motus_status along_motion(motus_system *s, double way, double duration, linear *at, double *work,
                          const linear_rates *first, along *out, motus_error *err)
{
    motus_run_def def = motus_default_run();
    def.method = PILOT;
    def.tolerance = TOLERANCE;
    def.start = at->t;
    def.until = at->t + way * duration;
    def.machine = "interpreter";
    def.switches = MOTUS_SWITCHES_STEP;
    def.error = MOTUS_BARS_NONE;
    *out = (along){.count = 1, .places = {{0, 0, *first}}};
    if (!(duration > 0) || !isfinite(def.until) || def.until == at->t) return MOTUS_OK;
    double evaluations;
    motus_status status = afford(s, &evaluations, err);
    if (status != MOTUS_OK) return status;
    pilot_run p = {.out = out, .at = at, .basis = work};
    status = run_create(s, &def, &(run_hint){0}, &p.run, NULL);
    if (status == MOTUS_OK) status = follow(&p, evaluations);
    run_destroy(p.run);
    return status == MOTUS_MEMORY ? fail(err, MOTUS_MEMORY, "no memory to follow the motion") : MOTUS_OK;
}

const along_place *along_fastest(const along *a)
{
    const along_place *fastest = NULL;
    double least = INFINITY; /* least rate of the later places */
    for (size_t k = a->count; k-- > 0;) {
        const along_place *p = &a->places[k];
        const double rate = p->rates.fastest;
        const bool goes_on = a->whole || k == 0 || rate * PASSED >= least || (a->time - p->time) * rate >= LASTING;
        if (goes_on && !(fastest && rate < fastest->rates.fastest)) fastest = p;
        least = fmin(least, rate);
    }
    return fastest;
}

double along_period(const linear_rates *r, double noise, bool *turns)
{
    double longest = 0;
    for (int k = 0; k < r->count; k++) {
        const double size = sqrt(r->re[k] * r->re[k] + r->im[k] * r->im[k]);
        const bool swings = fabs(r->im[k]) >= DECAY * size;
        const double period = (swings ? TWO_PI : 1) / size;
        if (size > noise && period > longest) longest = period, *turns = swings;
    }
    if (longest > 0 || !(r->fastest > 0)) return longest;
    *turns = true;
    return TWO_PI / r->fastest;
}

double along_mean_period(const along *a, double noise)
{
    double sum = 0, time = 0, fastest = 0, before = 0;
    bool turns;
    for (size_t k = 0; k < a->count; k++) fastest = fmax(fastest, a->places[k].rates.fastest);
    for (size_t k = 0; k < a->count; k++) {
        const double period = along_period(&a->places[k].rates, noise * fastest, &turns);
        const double slower = k && (before == 0 || period == 0) ? 0 : fmax(before, period); /* 0: it does not change */
        if (slower > 0) sum += a->places[k].span / slower;
        time += a->places[k].span;
        before = period;
    }
    return sum > 0 ? time / sum : 0;
}
