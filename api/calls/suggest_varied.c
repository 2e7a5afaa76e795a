/* The step of many trajectories: motus_suggest_varied and motus_step_growth.
 *
 * Invariant: the caller's system is not changed; a clone of it takes the numbers of one trajectory after the other.
 */
#include "api/search/suggest.h"

#include "api/ensemble/ensemble.h"

#include <math.h>
#include <string.h>

typedef struct varied {
    motus_system *system; /* the clone */
    vary *vary;           /* of the clone's model */
    size_t count, *places;
    size_t *given; /* for each place, the array of the call with its numbers; `until` has no place */
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
            set->step = one.step, set->rate = one.rate, set->period = one.period;
    }
    return MOTUS_OK;
}

motus_status motus_suggest_varied(motus_system *s, size_t count, const char *const *names, size_t trajectories,
                                  const double *const *values, motus_settings *set, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s || !set || (count && !names) || (trajectories && count && !values))
        return fail(err, MOTUS_ARGUMENT, "motus_suggest_varied needs a system, names, values and settings to fill in");
    motus_settings ours;
    motus_status status = motus_struct_read(MOTUS_DEF_SETTINGS, set, &ours, err);
    if (status == MOTUS_OK && isnan(ours.step)) {
        varied y = {0};
        motus_settings found = ours;
        modes m = modes_enter();
        status = begin(&y, s, names, count, err);
        modes_leave(m);
        if (status == MOTUS_OK) status = shortest(&y, trajectories, values, &found, err);
        end(&y, &s->allocator);
        if (status == MOTUS_OK) ours.step = found.step, ours.rate = found.rate, ours.period = found.period;
    }
    const double rate = ours.rate, period = ours.period;
    if (status == MOTUS_OK) status = motus_suggest(s, &ours, err);
    if (rate > 0) ours.rate = rate;
    if (rate > 0 && ours.period == 0) ours.period = period;
    if (status == MOTUS_OK) motus_struct_write(MOTUS_DEF_SETTINGS, &ours, set);
    return status;
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
