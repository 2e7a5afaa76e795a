/* Ensembles: the public calls. See api/ensemble/ensemble.h. */
#include "api/request/choice.h"
#include "api/ensemble/ensemble.h"
#include "api/search/goal.h"
#include "api/search/suggest.h"
#include "api/system/system.h"
#include "api/motion/run_events.h"

#include <math.h>
#include <string.h>

enum { ENSEMBLE_LANES_MAX = 64 };

static motus_status check(const motus_system *s, const motus_ensemble_def *d, motus_error *err)
{
    if (!d->record_count) return fail(err, MOTUS_ARGUMENT, "nothing is recorded");
    for (size_t r = 0; r < d->record_count; r++)
        if (d->records[r].column >= s->column_count || (unsigned)d->records[r].how > MOTUS_REDUCE_TOLERANCE)
            return fail(err, MOTUS_ARGUMENT, "record %zu names column %zu of %zu, or no reduction", r,
                        d->records[r].column, s->column_count);
    if ((unsigned)d->error > MOTUS_BARS_FULL)
        return fail(err, MOTUS_ARGUMENT, "there is no kind of bars %d", (int)d->error);
    if ((unsigned)d->switches > MOTUS_SWITCHES_USUAL)
        return fail(err, MOTUS_ARGUMENT, "there is no way to treat switches of number %d", (int)d->switches);
    if (d->every < 1)
        return fail(err, MOTUS_ARGUMENT, "observations are every 1, 2, … steps, not %lld", (long long)d->every);
    if (d->threads < 0 || d->threads > MOTUS_THREADS_MAX)
        return fail(err, MOTUS_ARGUMENT, "threads are 0 (as many as there are processors) to %d, not %d",
                    MOTUS_THREADS_MAX, d->threads);
    if (d->lanes < 0 || d->lanes > ENSEMBLE_LANES_MAX || (d->lanes & (d->lanes - 1)))
        return fail(err, MOTUS_ARGUMENT, "lanes are 0 (as many as suits) or a power of two up to %d, not %d",
                    ENSEMBLE_LANES_MAX, d->lanes);
    return MOTUS_OK;
}

motus_status motus_ensemble_create(motus_system *s, const motus_ensemble_def *given, motus_ensemble **out,
                                   motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!out) return fail(err, MOTUS_ARGUMENT, "motus_ensemble_create needs a place for the ensemble");
    *out = NULL;
    if (!s || !given) return fail(err, MOTUS_ARGUMENT, "motus_ensemble_create needs a system and a definition");
    motus_ensemble_def d;
    motus_status status = motus_struct_read(MOTUS_DEF_ENSEMBLE, given, &d, err);
    ensemble_goal *goal = NULL;
    if (status == MOTUS_OK) status = check(s, &d, err);
    if (status != MOTUS_OK) return status;
    const modes m = modes_enter();
    request q = request_of_ensemble(s, &d);
    status = goal_admits(s, &q, err);
    if (status == MOTUS_OK) status = suggest_missing(s, &q, err);
    if (status == MOTUS_OK) status = ensemble_accuracy_begin(s, &d, &q, &goal, err);
    modes_leave(m);
    if (status == MOTUS_OK) status = ensemble_make(s, &d, &q, goal, NULL, out, err);
    if (status != MOTUS_OK) ensemble_accuracy_end(goal);
    return status;
}

void motus_ensemble_destroy(motus_ensemble *e)
{
    if (!e) return;
    ensemble_accuracy_end(e->goal);
    ensemble_free(e);
}

/* ---- a call ---- */

motus_status motus_ensemble_check(motus_ensemble *e, size_t count, const double *const *values, motus_error *err)
{
    places p = {0};
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    motus_status status = ensemble_run_values(e, values, &p, err);
    modes m = modes_enter();
    if (status == MOTUS_OK) status = ensemble_run_ends(e, &p, count, err);
    modes_leave(m);
    return status;
}

motus_status motus_ensemble_pilots(motus_ensemble *e, size_t count, const double *const *values, motus_error *err)
{
    places p = {0};
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    motus_status status = ensemble_run_values(e, values, &p, err);
    if (status != MOTUS_OK) return status;
    modes m = modes_enter();
    e->count = count;
    status = ensemble_witness_ask(e, &p, count, err);
    modes_leave(m);
    return status;
}

static motus_status run(motus_ensemble *e, size_t count, const double *const *values, const places *p, motus_error *err)
{
    return e && e->goal ? ensemble_accuracy_run(e, count, values, p, err) : ensemble_run_all(e, count, values, *p, err);
}

motus_status motus_ensemble_run(motus_ensemble *e, size_t count, const double *const *values, double *const *results,
                                double *stopped, motus_error *err)
{
    const places p = {.results = results, .stopped = stopped};
    return motus_error_sound(err) ? run(e, count, values, &p, err) : MOTUS_ARGUMENT;
}

motus_status motus_ensemble_run_errors(motus_ensemble *e, size_t count, const double *const *values,
                                       double *const *results, double *const *errors, double *stopped, motus_error *err)
{
    const places p = {.results = results, .errors = errors, .stopped = stopped};
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!errors) return fail(err, MOTUS_ARGUMENT, "motus_ensemble_run_errors needs room for errors");
    if (e && (e->goal ? !e->goal->told : e->error == MOTUS_BARS_NONE)) {
        fail(err, MOTUS_ARGUMENT, "the ensemble tells no errors");
        hint(err, "give `error = MOTUS_BARS_CHEAP` of the definition");
        return MOTUS_ARGUMENT;
    }
    return run(e, count, values, &p, err);
}

/* ---- what trajectories came to ---- */

static ensemble_outcome outcome_of(const motus_ensemble *e, size_t trajectory)
{
    return e && trajectory < e->outcome_count ? e->outcomes[trajectory] : (ensemble_outcome){0};
}

motus_cause motus_ensemble_stopped_by(const motus_ensemble *e, size_t trajectory)
{
    return (motus_cause)outcome_of(e, trajectory).cause;
}

const char *motus_ensemble_ended(const motus_ensemble *e, size_t trajectory)
{
    const uint32_t rule = outcome_of(e, trajectory).ended;
    return rule ? e->rules->rule[rule - 1].name : "";
}

const char *motus_ensemble_kind(const motus_ensemble *e, size_t k)
{
    /* a switch of the force is no event */
    for (size_t i = 0; e && e->rules && i < e->rules->count; i++)
        if (!e->rules->rule[i].internal && k-- == 0) return e->rules->rule[i].name;
    return NULL;
}

int64_t motus_ensemble_events(const motus_ensemble *e, size_t trajectory)
{
    const ensemble_table *t = outcome_of(e, trajectory).table;
    return t ? (int64_t)t->count : 0;
}

motus_status motus_ensemble_event(const motus_ensemble *e, size_t trajectory, int64_t k, motus_event_row *out,
                                  double *values, double *after)
{
    if (!out || k < 0 || k >= motus_ensemble_events(e, trajectory) ||
        motus_struct_check(MOTUS_DEF_EVENT_ROW, out, NULL) != MOTUS_OK)
        return MOTUS_ARGUMENT;
    const ensemble_table *t = outcome_of(e, trajectory).table;
    const size_t count = e->event_columns_count;
    const double *from = t->values + (size_t)k * 2 * count;
    run_events_row(e->rules, &t->row[k].event, t->row[k].error, out);
    if (values && count) memcpy(values, from, count * sizeof *values);
    if (after && count) memcpy(after, from + count, count * sizeof *after);
    return MOTUS_OK;
}

/* ---- what was chosen ---- */

double motus_ensemble_step_work(motus_ensemble *e)
{
    weight w;
    if (!e || choice_weigh(e->system, &w, NULL) != MOTUS_OK) return NAN;
    return choice_step(&e->system->problem, &w, &e->chosen, e->card);
}

static motus_switches switches_of(const motus_system *s)
{
    if (!s->model) return MOTUS_SWITCHES_USUAL;
    if (system_located(s)) return MOTUS_SWITCHES_LOCATE;
    return located_kinks(s->model) ? MOTUS_SWITCHES_STEP : MOTUS_SWITCHES_USUAL;
}

motus_status motus_ensemble_statistics_of(const motus_ensemble *e, motus_ensemble_statistics *out)
{
    if (!e || !out || motus_struct_check(MOTUS_DEF_ENSEMBLE_STATISTICS, out, NULL) != MOTUS_OK) return MOTUS_ARGUMENT;
    const motus_ensemble_statistics ours = {.absolute = e->chosen.absolute > 0,
                                            .method = e->chosen.name,
                                            .machine = ensemble_machine(e),
                                            .note = e->note,
                                            .not_located = e->not_located,
                                            .steps = ensemble_steps_differ(e) ? 0 : e->timing.total,
                                            .tolerance = tally_tolerance(&e->chosen),
                                            .accuracy = e->goal ? e->goal->wanted : NAN,
                                            .compiled_from = e->compiled_from,
                                            .seconds = e->seconds,
                                            .lanes =
                                                e->lanes && e->awaits != AWAITS_LANES ? lanes_in_block(e->lanes) : 1,
                                            .threads = e->threads,
                                            .switches = switches_of(e->system)};
    motus_struct_write(MOTUS_DEF_ENSEMBLE_STATISTICS, &ours, out);
    return MOTUS_OK;
}
