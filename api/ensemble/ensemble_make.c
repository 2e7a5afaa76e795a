/* The making of an ensemble, from a definition that is complete. See ensemble.h. */
#include "api/ensemble/ensemble.h"
#include "api/system/system.h"
#include "machine/parallel.h"

#include <math.h>
#include <string.h>

static motus_status find_places(motus_ensemble *e, const motus_ensemble_def *d, motus_error *err)
{
    for (size_t k = 0; k < d->vary_count; k++) {
        bool twice = false;
        if (d->vary[k] && !strcmp(d->vary[k], "until")) {
            twice = e->until != SIZE_MAX;
            e->until = k;
        } else {
            size_t *place = &e->places[e->vary_count];
            motus_status status = ensemble_place(e->system, d->vary[k], place, err);
            if (status == MOTUS_OK && e->home)
                status = ensemble_place(e->home, d->vary[k], &e->home_places[e->vary_count], err);
            if (status != MOTUS_OK) return status;
            for (size_t i = 0; i < e->vary_count; i++) twice |= e->places[i] == *place;
            e->vary_count++;
        }
        if (twice) return fail(err, MOTUS_ARGUMENT, "%s varies twice", d->vary[k]);
    }
    if (e->until != SIZE_MAX && !isnan(d->until))
        return fail(err, MOTUS_ARGUMENT, "the end is %g, and varies: only one of them can hold", d->until);
    return MOTUS_OK;
}

static motus_status check_columns(const motus_ensemble *e, motus_error *err)
{
    const size_t columns = e->system->column_count;
    for (size_t k = 0; k < e->event_columns_count; k++)
        if (e->event_columns[k] >= columns)
            return fail(err, MOTUS_ARGUMENT, "event_columns has column %zu of %zu", e->event_columns[k], columns);
    return MOTUS_OK;
}

/* Takes over what varies from another ensemble of the system. */
static void take_places(motus_ensemble *e, const motus_ensemble *like)
{
    e->until = like->until, e->vary_count = like->vary_count;
    e->decided = like->decided, e->looks = like->looks;
    memcpy(e->places, like->places, e->vary_count * sizeof *e->places);
    memcpy(e->home_places, like->home_places, e->vary_count * sizeof *e->home_places);
}

static motus_status complete(motus_ensemble *e, const motus_ensemble_def *d, const request *q,
                             const motus_ensemble *like, motus_error *err)
{
    motus_system *s = e->system;
    motus_status status = system_rules(s, &e->rules, err);
    if (status == MOTUS_OK) status = check_columns(e, err);
    if (like) take_places(e, like);
    if (status == MOTUS_OK && !like) status = find_places(e, d, err);
    if (status == MOTUS_OK && e->error != MOTUS_BARS_NONE) status = ensemble_errors_prepare(e, err);
    const motus_settings *const set = &q->set;
    const bool steps = set->step_said == MOTUS_SAID_CALLER || set->step_said == MOTUS_SAID_SUGGESTED;
    /* where the ends vary, each trajectory gets its own timing later */
    if (status == MOTUS_OK)
        status = run_timing(&e->chosen, e->step, q->ends ? s->start : set->until, s->start, &e->timing, err);
    if (status == MOTUS_OK && s->model)
        status =
            vary_create(s->model, e->places, e->vary_count, steps, set->until_said != MOTUS_SAID_MODEL, &e->vary, err);
    return status == MOTUS_OK ? ensemble_machine_choose(e, d, err) : status;
}

/* Finds the located system, by the rule of runs; NULL: the caller's own serves, and `why` says why switches that could
 * have been located are not. */
static motus_status locate(motus_system *s, const chosen *c, motus_switches asked, motus_system **out, const char **why,
                           motus_error *err)
{
    if (asked == MOTUS_SWITCHES_RESOLVE) return fail(err, MOTUS_UNAVAILABLE, "an ensemble does not resolve switches");
    return located_for(s, c, asked, out, why, err);
}

motus_status ensemble_make(motus_system *s, const motus_ensemble_def *d, const request *q, ensemble_goal *goal,
                           const motus_ensemble *like, motus_ensemble **out, motus_error *err)
{
    motus_system *home = like ? like->home : NULL, *located = NULL;
    const char *why = "";
    motus_status status = like ? MOTUS_OK : locate(s, &q->chosen, d->switches, &located, &why, err);
    if (status != MOTUS_OK) return status;
    if (located) home = s, s = located;
    const size_t varied = d->vary_count + 1, records = d->record_count + 1,
                 columns = d->events ? d->event_column_count + 1 : 0;
    motus_ensemble *e = take(&s->allocator, 1,
                             sizeof *e + varied * (sizeof *e->values + 2 * sizeof *e->places) +
                                 records * sizeof *e->records + columns * sizeof *e->event_columns);
    if (!e) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    *e = (motus_ensemble){.system = s,
                          .home = home,
                          .not_located = why,
                          .allocator = s->allocator,
                          .every = d->every,
                          .given = d->vary_count,
                          .until = SIZE_MAX,
                          .chosen = q->chosen,
                          .card = q->card,
                          .step = q->set.step,
                          .values = (const double **)(void *)(e + 1),
                          .record_count = d->record_count,
                          .error = d->error,
                          .tells_causes = d->causes != 0,
                          .threads = d->threads ? d->threads
                                     : s->model ? parallel_processors()
                                                : 1,
                          .progress = d->progress,
                          .context = d->context};
    e->places = (size_t *)(void *)(e->values + varied);
    e->home_places = e->places + varied;
    e->records = (motus_record *)(void *)(e->home_places + varied);
    memcpy(e->records, d->records, d->record_count * sizeof *e->records);
    if (goal) e->records[e->record_count++] = (motus_record){MOTUS_REDUCE_ACCURACY, 0};
    if (columns) {
        e->event_columns = (size_t *)(void *)(e->records + records);
        e->event_columns_count = d->event_column_count;
        if (d->event_column_count) memcpy(e->event_columns, d->event_columns, (columns - 1) * sizeof *e->event_columns);
    }
    motus_system_hold(s, true);
    if (home) motus_system_hold(home, true);
    modes m = modes_enter();
    status = complete(e, d, q, like, err);
    modes_leave(m);
    if (status == MOTUS_OK)
        *out = e, e->goal = goal;
    else
        ensemble_free(e);
    return status;
}

void ensemble_free(motus_ensemble *e)
{
    motus_allocator a = e->allocator;
    motus_system *const used[] = {e->system, e->home};
    ensemble_machine_end(e);
    ensemble_lanes_end(e);
    ensemble_workers_destroy(e);
    ensemble_outcome_end(e);
    motus_system_destroy(e->half);
    give(&a, e->compared_columns);
    give(&a, e->compared_record);
    give(&a, e->how);
    give(&a, e);
    motus_system_hold(used[0], false); /* last, and before its home, since that may own it */
    if (used[1]) motus_system_hold(used[1], false);
}
