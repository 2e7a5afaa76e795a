/* Trajectories with events: lanes take the steps in which bounds exclude every event (machine/lanes_watched.c), and the
 * follower here takes the others. See ensemble.h.
 *
 * Every thread has a worker, and for each lane a stepper and events. They take the first step of a trajectory, every
 * step in which an event may happen, and the following ones until bounds may tell of a step again.
 *
 * Invariant: a trajectory has the bits of a run with its values. One that fails or may crawl is left to a worker
 * (ensemble_run.c), which says why it stops.
 */
#include "api/request/choice.h"
#include "api/ensemble/ensemble.h"

#include <math.h>

typedef struct followed {
    worker worker; /* the thread's, with a stepper and events of its own; e NULL: not yet made */
    trajectory at; /* values and results */
    size_t number;
    double leg, paced_t; /* leg: the start of the leg; paced_t: the time at the last look of `crawls` */
    int64_t paced;       /* the steps at the last look of `crawls` */
} followed;

typedef struct following { /* of a thread */
    worker worker;
    followed *place; /* one for each lane */
    size_t numbers;  /* the trajectory whose numbers the system has; SIZE_MAX: none */
} following;

struct ensemble_followed {
    motus_ensemble *e;
    lanes_follower by;
    following *threads;
    int count;
    const places *places;
    size_t first; /* the trajectory that lanes call number 0 */
    bool differ;  /* the motion, its events or their actions read numbers that vary */
};

/* ---- a trajectory ---- */

/* Gives the worker's system the trajectory's numbers, if that matters. False: it failed. */
static bool numbered(const ensemble_followed *f, int thread, followed *t, bool matters)
{
    following *of = &f->threads[thread];
    if (!matters || of->numbers == t->number) return true;
    of->numbers = SIZE_MAX;
    if (ensemble_single_numbers(&t->at, &t->worker.why) != MOTUS_OK) return false;
    of->numbers = t->number;
    return true;
}

/* Leaves the trajectory to a worker. Returns false: lanes do not go on with it. */
static bool leave_it(const ensemble_followed *f, const followed *t)
{
    f->e->outcomes[t->number].left = LANES_MAY_CRAWL;
    return false;
}

/* Writes the results of a trajectory at its end. Returns false: lanes do not go on with it. */
static bool finish(const ensemble_followed *f, int thread, followed *t)
{
    if (!numbered(f, thread, t, true) || ensemble_single_observe(&t->at, &t->worker.why) != MOTUS_OK ||
        ensemble_single_results(&t->at, f->places, t->number, false, true) != MOTUS_OK)
        return leave_it(f, t);
    return false;
}

/* Returns whether the trajectory may crawl, by the stepper's test, since the stepper does not see steps of lanes. */
static bool crawls(followed *t)
{
    const stepper *s = t->worker.stepper;
    if (!row_adaptive(stepper_method(s))) return false;
    const int64_t n = stepper_steps(s);
    const double now = stepper_time(s), leg = stepper_leg(s);
    if (leg != t->leg) t->leg = t->paced_t = leg, t->paced = 0;
    if (n == t->paced || n % STEPPER_PACE) return false;
    double shortest, longest;
    stepper_sizes(s, &shortest, &longest);
    const bool may =
        n == t->paced + STEPPER_PACE && stepper_may_crawl(n, fabs(now - t->paced_t), fabs(t->worker.timing.until - now),
                                                          longest, stepper_problem(s)->traits.smooth);
    t->paced = n, t->paced_t = now;
    return may;
}

/* Returns after how many steps of the leg lanes give the trajectory back: the stepper takes the last fixed steps and
 * the shorter one. */
static int64_t stop_of(const followed *t)
{
    enum { LAST = 2 };
    const stepper *s = t->worker.stepper;
    if (row_adaptive(stepper_method(s))) return INT64_MAX;
    return stepper_steps(s) + stepper_steps_before(s, t->worker.timing.until) - LAST;
}

/* Takes steps until bounds may tell of the next one. False: the trajectory is over. */
static bool lead(const ensemble_followed *f, int thread, followed *t, lanes_state *state)
{
    enum { LOOK = 1 << 10 }; /* steps between two questions whether all is over */
    worker *w = &t->worker;
    stepper_stop why;
    int64_t steps = 0;
    do {
        if (++steps % LOOK == 0 && state->over(state->asked)) return false;
        if (crawls(t) || events_go(w->events, w->stepper, t->worker.timing.until, 1, &why, &w->why) != MOTUS_OK)
            return leave_it(f, t);
        if (why != STOP_STEPS) return finish(f, thread, t);
    } while (!events_bounded(w->events, w->stepper) || stepper_steps(w->stepper) >= stop_of(t));
    if (crawls(t)) return leave_it(f, t);
    state->stop = stop_of(t);
    state->tick = events_next_time(w->events);
    state->t0 = stepper_leg(w->stepper);
    state->h = stepper_step(w->stepper);
    state->at = stepper_save(w->stepper, state->carry);
    return true;
}

static bool begin(void *ctx, int thread, size_t place, size_t number, lanes_state *state)
{
    const ensemble_followed *f = ctx;
    followed *t = &f->threads[thread].place[place];
    worker *w = &t->worker;
    stepper_stop why;
    bool began;
    t->number = f->first + number;
    if (!w->e) *w = f->threads[thread].worker;
    w->why = motus_default_error();
    if (!t->at.x && !ensemble_single_open(&t->at, w)) return leave_it(f, t);
    t->at.observations = 0;
    f->threads[thread].numbers = SIZE_MAX;
    if (ensemble_single_begin(&t->at, f->places, t->number, &began, &w->why) != MOTUS_OK) return leave_it(f, t);
    f->threads[thread].numbers = t->number;
    t->leg = NAN;
    if (stepper_advance(w->stepper, (stepper_limit){0, w->timing.until}, &why, &w->why) != MOTUS_OK)
        return leave_it(f, t);
    return why == STOP_UNTIL ? finish(f, thread, t) : lead(f, thread, t, state);
}

static bool idle(void *ctx, int thread, size_t place, const stepper_shown *step)
{
    const ensemble_followed *f = ctx;
    followed *t = &f->threads[thread].place[place];
    return numbered(f, thread, t, f->differ) && events_idle(t->worker.events, step);
}

static bool look(void *ctx, int thread, size_t place, int64_t steps, const double *largest, lanes_state *state)
{
    const ensemble_followed *f = ctx;
    followed *t = &f->threads[thread].place[place];
    worker *w = &t->worker;
    /* Stepper and events take the state that lanes have reached. */
    if (!numbered(f, thread, t, f->differ) ||
        stepper_load_leg(w->stepper, state->t0, state->h, state->at, state->carry, &w->why) != MOTUS_OK ||
        events_led(w->events, w->stepper, steps, largest, &w->why) != MOTUS_OK)
        return leave_it(f, t);
    return state->end ? finish(f, thread, t) : lead(f, thread, t, state);
}

/* ---- all ---- */

/* Finds whether the force, the functions of events or their actions read a number that varies or follows from one that
 * does. If only initial values vary, they mostly do not. False: no memory. */
static bool depends(const motus_ensemble *e, bool *out)
{
    model *m = e->system->model;
    const uint8_t *affected = vary_affected(e->vary);
    size_t count = m->accel_count;
    for (uint32_t i = 0; i < m->rule_count; i++) count += m->rules[i].leaves + m->rules[i].assignments;
    output *all = arena_room(m->arena, (count + 1) * sizeof *all);
    if (!all) return false;
    count = 0;
    for (size_t k = 0; k < m->accel_count; k++) all[count++] = m->accel[k];
    for (uint32_t i = 0; i < m->rule_count; i++) {
        const model_rule *r = &m->rules[i];
        for (size_t k = 0; k < r->leaves; k++) all[count++] = r->leaf[k];
        for (size_t k = 0; k < r->assignments; k++) all[count++] = r->assignment[k].value;
    }
    const program *p = program_create(m->graph, all, count);
    if (!p) return false;
    *out = false;
    for (uint32_t n = 0; n < p->graph->count; n++) {
        const graph_node *node = &p->graph->nodes[n];
        if (node->op == OP_PARAM) *out |= affected[node->a] != 0;
        if (node->op != OP_LOAD) continue;
        const array *from = &p->graph->arrays[p->graph->references[node->a].array];
        *out |= from->space == SPACE_POOL && graph_marked(from, affected);
    }
    return true;
}

motus_status ensemble_followed_create(motus_ensemble *e, const lanes_follower **by, motus_error *err)
{
    ensemble_followed *f = take(&e->allocator, 1, sizeof *f);
    if (!f) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    e->followed = f;
    *f = (ensemble_followed){.e = e, .by = {.ctx = f, .begin = begin, .idle = idle, .look = look}};
    *by = &f->by;
    return e->vary_count == 0 || depends(e, &f->differ) ? MOTUS_OK
                                                        : fail(err, MOTUS_MEMORY, "no memory for the ensemble");
}

/* Makes workers besides the ensemble's, since lanes read the ensemble's system meanwhile. */
motus_status ensemble_followed_begin(motus_ensemble *e, const places *p, size_t first, motus_error *err)
{
    ensemble_followed *f = e->followed;
    const size_t lanes = (size_t)lanes_in_block(e->lanes);
    const char *why;
    f->places = p;
    f->first = first;
    e->chosen.varies = e->vary_count > 0;
    motus_status status =
        f->threads ? MOTUS_OK : choice_compile(e->system, &e->chosen, false, false, &e->machine, &why, err);
    if (status == MOTUS_OK && !f->threads) {
        f->threads = take(&e->allocator, (size_t)e->threads, sizeof *f->threads);
        f->count = f->threads ? e->threads : 0;
    }
    /* after a failed call: the workers that it left unmade */
    for (int i = 0; i < f->count && status == MOTUS_OK; i++) {
        following *t = &f->threads[i];
        t->numbers = SIZE_MAX;
        status = ensemble_worker_prepare(e, &t->worker, 1 + i, err);
        if (status == MOTUS_OK && !t->place) t->place = take(&e->allocator, lanes, sizeof *t->place);
        if (status == MOTUS_OK && !t->place) status = fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    }
    return status != MOTUS_OK || f->threads ? status : fail(err, MOTUS_MEMORY, "no memory for the ensemble");
}

void ensemble_followed_destroy(motus_ensemble *e)
{
    ensemble_followed *f = e->followed;
    const size_t lanes = f && e->lanes ? (size_t)lanes_in_block(e->lanes) : 0;
    for (int i = 0; f && i < f->count; i++) {
        following *t = &f->threads[i];
        for (size_t k = 0; t->place && k < lanes; k++) {
            ensemble_single_close(&t->place[k].at);
            stepper_destroy(t->place[k].worker.stepper);
            events_destroy(t->place[k].worker.events);
        }
        give(&e->allocator, t->place);
        motus_system_destroy(t->worker.system);
    }
    if (f) give(&e->allocator, f->threads);
    give(&e->allocator, f);
    e->followed = NULL;
}
