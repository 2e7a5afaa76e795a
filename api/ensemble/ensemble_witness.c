/* Whether the trajectories of an ensemble need a witness each. See ensemble.h and witness.h.
 *
 * If errors are wanted, and the force may do more within a step than steps show, some trajectories, the pilots, first
 * go one at a time with a witness, as far as a budget allows. If a pilot's witness objects to a step, all trajectories
 * go one at a time with a witness.
 *
 * Invariant: that is decided once, by the definition and the pilots, not by machine, threads or calls.
 */
#include "api/error/bars.h"
#include "api/request/choice.h"
#include "api/ensemble/ensemble.h"
#include "api/search/pilot.h"

#include "core/stepper_body.h"

enum { PILOTS = 3, CHUNK = 16 };
/* Operations of all pilots. Steps with their companion and the witness cost about COST times the steps alone. */
#define WORK 4e6
#define COST 3.0

typedef struct flight {
    const places *places;
    weight weight;
    double most; /* operations of one pilot */
    size_t count, pilots;
    atomic_bool objected;
} flight;

static double work_of(const worker *w, const flight *f)
{
    const int order = stepper_plan(&w->system->problem, &w->e->chosen, NULL).expands;
    return COST * pilot_work(w->run, &f->weight, order);
}

static motus_status lead(trajectory *s, flight *f, size_t k, motus_error *err)
{
    bool began;
    motus_status status = ensemble_errors_worker(s->w, err);
    if (status == MOTUS_OK) status = ensemble_single_begin(s, f->places, k, &began, err);
    motus_run *const r = s->w->run;
    if (status != MOTUS_OK || !r->bars->witness) return status; /* without a witness nothing is found */
    witness_leave(r->bars->witness);
    const double most = work_of(s->w, f) + f->most;
    while (status == MOTUS_OK && !r->arrived && work_of(s->w, f) < most && !atomic_load(&f->objected)) {
        status = run_step(r, CHUNK, err);
        if (status == MOTUS_OK) status = bars_land(r, err);
        if (witness_objected(r->bars->witness)) atomic_store(&f->objected, true);
    }
    return status;
}

/* Leads one pilot; pilots are spread from the first trajectory to the last. Its failure is no error here: it fails
 * again as a trajectory. */
static motus_status fly(worker *w, size_t pilot, void *ctx)
{
    flight *const f = ctx;
    const size_t k = f->pilots > 1 ? (f->count - 1) * pilot / (f->pilots - 1) : 0;
    trajectory s;
    motus_error why = motus_default_error();
    if (!ensemble_single_open(&s, w)) return fail(&w->why, MOTUS_MEMORY, "no memory for a trajectory");
    s.errors = true;
    w->trajectories = 1;
    motus_status status = lead(&s, f, k, &why);
    ensemble_single_close(&s);
    if (status != MOTUS_MEMORY && status != MOTUS_CANCELLED) return MOTUS_OK;
    w->why = why;
    return status;
}

motus_status ensemble_witness_ask(motus_ensemble *e, const places *p, size_t pilots, motus_error *err)
{
    flight f = {.places = p, .count = e->count, .pilots = pilots, .most = WORK / (double)pilots};
    if (e->decided || e->error == MOTUS_BARS_NONE || !e->system->model || !pilots) return MOTUS_OK;
    motus_status status = choice_weigh(e->system, &f.weight, err);
    if (status != MOTUS_OK) return status;
    /* Pilots are led to their ends, whatever is awaited meanwhile. */
    const int awaits = (int)e->awaits;
    const size_t exactly = e->exactly;
    e->awaits = AWAITS_NOTHING, e->exactly = 0;
    e->looks = true;
    if (!e->machine.problem) e->machine = e->system->machine;
    status = ensemble_each(e, 0, pilots, fly, &f, err);
    e->awaits = awaits, e->exactly = exactly;
    ensemble_workers_destroy(e); /* their witnesses only looked (witness_leave) */
    e->decided = status == MOTUS_OK;
    e->looks = e->decided && atomic_load(&f.objected);
    return status;
}

motus_status ensemble_witness_first(motus_ensemble *e, const places *p, motus_error *err)
{
    if (!p->errors) return MOTUS_OK;
    return ensemble_witness_ask(e, p, e->count < PILOTS ? e->count : PILOTS, err);
}
