/* The settings of models, runs and ensembles, each with who says it; and the step of many trajectories.
 *
 * Invariant: the caller's system is not changed; a clone of it takes the numbers of one trajectory after the other.
 */
#include "api/ensemble/ensemble.h"
#include "api/search/goal.h"
#include "api/search/suggest.h"

#include <math.h>
#include <string.h>

typedef struct varied {
    motus_system *system; /* the clone */
    vary *vary;           /* of the clone's model */
    size_t count, *places;
    size_t *given; /* for each place, which of the caller's arrays has its numbers; `until` has no place */
    double *values;
} varied;

/* Returns whether a name is that of the end, which is no number of the system. */
static bool is_end(const char *name) { return name && !strcmp(name, "until"); }

static motus_status begin(varied *y, motus_system *s, const char *const *names, size_t count, motus_error *err)
{
    motus_status status = motus_system_clone(s, &y->system, err);
    y->places = take(&s->allocator, count + 1, sizeof *y->places);
    y->given = take(&s->allocator, count + 1, sizeof *y->given);
    y->values = take(&s->allocator, count + 1, sizeof *y->values);
    if (status == MOTUS_OK && !(y->places && y->given && y->values))
        status = fail(err, MOTUS_MEMORY, "no memory to find a step");
    for (size_t k = 0; k < count && status == MOTUS_OK; k++) {
        if (is_end(names[k])) continue;
        y->given[y->count] = k;
        status = ensemble_place(y->system, names[k], &y->places[y->count++], err);
    }
    if (status == MOTUS_OK && y->system->model)
        status = vary_create(y->system->model, y->places, y->count, true, true, &y->vary, err);
    return status;
}

static void end(varied *y, const motus_allocator *memory)
{
    give(memory, y->places);
    give(memory, y->given);
    give(memory, y->values);
    motus_system_destroy(y->system);
}

/* Gives the clone the numbers of trajectory i. False: no memory. */
static bool become(varied *y, const double *const *values, size_t i)
{
    motus_system *s = y->system;
    for (size_t k = 0; k < y->count; k++) {
        const size_t at = y->places[k], nx = s->problem.nx;
        y->values[k] = values[y->given[k]][i];
        if (!s->model) *(at < nx ? &s->x0[at] : &s->v0[at - nx]) = y->values[k];
    }
    s->judged_gyroscopic = s->judged_gradient = false;
    return !s->model || (vary_apply(y->vary, y->values) && system_rebind(s));
}

/* Finds the shortest of the steps, with its rate. A trajectory for which no step is found is left out, since it will
 * stop. */
static motus_status shortest(varied *y, size_t trajectories, const double *const *values, motus_settings *set,
                             motus_error *err)
{
    const motus_settings wish = *set;
    for (size_t i = 0; i < trajectories; i++) {
        motus_settings one = wish;
        if (!become(y, values, i)) return fail(err, MOTUS_MEMORY, "no memory to find a step");
        motus_error why = motus_default_error();
        const motus_status status = motus_suggest(y->system, &one, &why);
        if (status == MOTUS_MEMORY || status == MOTUS_CALLBACK) {
            if (err) motus_struct_write(MOTUS_DEF_ERROR, &why, err);
            return status;
        }
        if (status == MOTUS_OK && !(one.step >= set->step))
            set->step = one.step, set->step_said = one.step_said, set->rate = one.rate, set->period = one.period;
    }
    return MOTUS_OK;
}

/* Tells what a request asks for; what a row does not take is none. */
static motus_status tell(const request *q, motus_status status, motus_settings *out)
{
    motus_settings set = q->set;
    const bool accurate = !isnan(set.accuracy), adaptive = accurate || (q->card && row_adaptive(&q->chosen));
    if (adaptive) set.step = NAN;
    if (!accurate && adaptive && isnan(set.tolerance)) {
        set.tolerance = set.absolute ? q->chosen.absolute : q->chosen.relative;
        set.tolerance_said = MOTUS_SAID_DEFAULT;
    }
    motus_struct_write(MOTUS_DEF_SETTINGS, &set, out);
    return status;
}

motus_status motus_settings_of(const motus_system *s, motus_settings *out)
{
    if (!s || !out || motus_struct_check(MOTUS_DEF_SETTINGS, out, NULL) != MOTUS_OK) return MOTUS_ARGUMENT;
    const motus_run_def nothing = motus_default_run();
    motus_settings set = system_settings(s);
    set.automatic = request_of_run(s, &nothing).set.automatic;
    motus_struct_write(MOTUS_DEF_SETTINGS, &set, out);
    return MOTUS_OK;
}

motus_status motus_run_settings(motus_system *s, const motus_run_def *given, motus_settings *out, motus_error *err)
{
    motus_run_def def;
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s || !out) return fail(err, MOTUS_ARGUMENT, "motus_run_settings needs a system and settings to fill in");
    motus_status status = motus_struct_check(MOTUS_DEF_SETTINGS, out, err);
    if (status == MOTUS_OK) status = motus_struct_read(MOTUS_DEF_RUN, given, &def, err);
    if (status != MOTUS_OK) return status;
    request q = request_of_run(s, &def);
    const modes m = modes_enter();
    status = goal_admits(s, &q, err);
    if (status == MOTUS_OK) status = suggest_missing(s, &q, err);
    modes_leave(m);
    return tell(&q, status, out);
}

motus_status motus_ensemble_settings(motus_system *s, const motus_ensemble_def *given, size_t trajectories,
                                     const double *const *values, motus_settings *out, motus_error *err)
{
    motus_ensemble_def def;
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s || !given || !out)
        return fail(err, MOTUS_ARGUMENT,
                    "motus_ensemble_settings needs a system, a definition and settings to fill in");
    motus_status status = motus_struct_check(MOTUS_DEF_SETTINGS, out, err);
    if (status == MOTUS_OK) status = motus_struct_read(MOTUS_DEF_ENSEMBLE, given, &def, err);
    if (status == MOTUS_OK && trajectories && def.vary_count && !values)
        status = fail(err, MOTUS_ARGUMENT, "motus_ensemble_settings needs the values of its trajectories");
    if (status != MOTUS_OK) return status;
    request q = request_of_ensemble(s, &def);
    varied y = {0};
    const modes m = modes_enter();
    status = goal_admits(s, &q, err);
    const bool shortens = status == MOTUS_OK && trajectories && suggest_lacks_step(s, &q);
    if (shortens) status = begin(&y, s, def.vary, def.vary_count, err);
    if (shortens && status == MOTUS_OK) status = shortest(&y, trajectories, values, &q.set, err);
    if (shortens) end(&y, &s->allocator);
    if (status == MOTUS_OK) status = suggest_missing(s, &q, err);
    modes_leave(m);
    return tell(&q, status, out);
}

motus_status motus_step_growth(motus_system *s, size_t count, const char *const *names, size_t trajectories,
                               const double *const *values, const motus_settings *set, double *powers, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s || !set || !powers || (count && !names) || (trajectories && count && !values))
        return fail(err, MOTUS_ARGUMENT, "motus_step_growth needs a system, names, values, settings and a place");
    motus_settings ours;
    *powers = 0;
    motus_status status = motus_struct_read(MOTUS_DEF_SETTINGS, set, &ours, err);
    if (status == MOTUS_OK && !(ours.step > 0 && isfinite(ours.step) && isfinite(ours.until) && !isinf(ours.from)))
        status = fail(err, MOTUS_ARGUMENT, "motus_step_growth needs a step and an end");
    if (status != MOTUS_OK) return status;
    varied y = {0};
    modes m = modes_enter();
    status = begin(&y, s, names, count, err);
    for (size_t i = 0; i < trajectories && status == MOTUS_OK; i++) {
        double one = 0;
        motus_error why = motus_default_error();
        if (!become(&y, values, i)) status = fail(err, MOTUS_MEMORY, "no memory to judge a step");
        if (status != MOTUS_OK) break;
        const motus_status found = suggest_growth(y.system, &ours, &one, &why);
        if (found == MOTUS_MEMORY || found == MOTUS_CALLBACK) {
            if (err) motus_struct_write(MOTUS_DEF_ERROR, &why, err);
            status = found;
        } else if (found == MOTUS_OK) {
            *powers = fmax(*powers, one);
        }
    }
    modes_leave(m);
    end(&y, &s->allocator);
    return status;
}
