/* The public calls that make a run, take its steps, and ask for its state and statistics. */
#include "api/calls/explain.h"
#include "api/search/goal.h"
#include "api/motion/locate.h"
#include "api/motion/run_events.h"
#include "api/system/columns.h"
#include "lang/model/undefined.h"
#include "machine/cache.h"

#include <math.h>

motus_status motus_run_create(motus_system *s, const motus_run_def *given, motus_run **out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!out) return fail(err, MOTUS_ARGUMENT, "motus_run_create needs a place for the run");
    *out = NULL;
    if (!s) return fail(err, MOTUS_ARGUMENT, "motus_run_create needs a system");
    motus_run_def def;
    const motus_status read = motus_struct_read(MOTUS_DEF_RUN, given, &def, err);
    if (read != MOTUS_OK) return read;
    const modes m = modes_enter();
    const motus_status status = goal_run(s, &def, out, err);
    if (status == MOTUS_OK) (*out)->cut = cuts_sentence(*out);
    if (status != MOTUS_OK) column_names_error(s, err);
    modes_leave(m);
    return status;
}

void motus_run_destroy(motus_run *r) { goal_end(r); }

/* ---- time ---- */

int motus_run_done(const motus_run *r) { return r && r->arrived; }
double motus_run_time(const motus_run *r) { return r ? stepper_time(r->stepper) : NAN; }
double motus_run_time_of(const motus_run *r, int64_t step)
{
    if (!r || step < 0 || (row_adaptive(&r->chosen) && step < INT64_MAX)) return NAN;
    if (r->events && step < r->timing.total) return r->timing.t0 + (double)step * r->timing.h;
    return step >= r->timing.total ? r->timing.until
                                   : stepper_time_of(r->stepper, step - (r->locate ? locate_steps(r) : 0));
}

int64_t motus_run_steps(const motus_run *r) { return r ? run_steps(r) : 0; }

/* ---- its state ---- */

motus_status motus_run_state(motus_run *r, double *x, double *v, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r) return fail(err, MOTUS_ARGUMENT, "motus_run_state needs a run");
    modes m = modes_enter();
    const motus_status status = run_state(r, x, v, err);
    modes_leave(m);
    return status;
}

motus_status motus_run_values(motus_run *r, const size_t *columns, size_t count, double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT, "motus_run_values needs a run, columns and a place for the values");
    modes m = modes_enter();
    motus_status status = run_sync(r, false, err);
    if (status == MOTUS_OK)
        status = system_values(r->system, stepper_time(r->stepper), r->x, r->v, columns, count, out, err);
    modes_leave(m);
    return status;
}

motus_status motus_run_value(motus_run *r, const char *name, double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || !out) return fail(err, MOTUS_ARGUMENT, "motus_run_value needs a run and a place for the value");
    size_t column;
    const motus_status status = motus_columns_named(r->system, 1, &name, &column, err);
    return status == MOTUS_OK ? motus_run_values(r, &column, 1, out, err) : status;
}

motus_status motus_run_undefined(motus_run *r, size_t column, motus_error *err)
{
    double value = 0;
    undefined_term why;
    const motus_status status = motus_run_values(r, &column, 1, &value, err);
    if (status != MOTUS_OK || isfinite(value) || !r->system->model) return status;
    const column_range *const of = columns_range(r->system, column);
    if (of->kind != MOTUS_COLUMN_QUANTITY && of->kind != MOTUS_COLUMN_INVARIANT) return MOTUS_OK;
    size_t number;
    const model_definition *const d = system_definition(r->system, column, &number);
    const double t = stepper_time(r->stepper);
    if (!undefined_find(r->system->model, d->outputs, d->output_count, number, t, r->x, r->v, &why)) return MOTUS_OK;
    fail(err, MOTUS_DIVERGED, "%s", why.says);
    if (why.holds) hint(err, "let the end values hold: %s(…, hold)", why.holds);
    if (err) err->time = why.time;
    return MOTUS_DIVERGED;
}

motus_status motus_run_set_state(motus_run *r, double t, const double *x, const double *v, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r) return fail(err, MOTUS_ARGUMENT, "motus_run_set_state needs a run");
    if (r->observing) return run_refuse_move(err);
    if (isnan(t)) t = stepper_time(r->stepper);
    modes m = modes_enter();
    const motus_status status = run_set_state(r, t, x, v, err);
    modes_leave(m);
    return status;
}

/* ---- steps ---- */

motus_status motus_run_step(motus_run *r, int64_t n, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || n < 0)
        return fail(err, MOTUS_ARGUMENT, "motus_run_step needs a run and a number of steps that is not negative");
    modes m = modes_enter();
    motus_status status = r->observing ? run_refuse_move(err) : MOTUS_OK;
    if (status == MOTUS_OK && !(n > 0 && goal_arrive(r, n))) status = run_step(r, n, err);
    if (status == MOTUS_OK) status = goal_judge(r, err);
    if (status != MOTUS_OK) column_names_error(r->system, err);
    modes_leave(m);
    return status;
}

motus_status motus_run_finish(motus_run *r, motus_error *err) { return motus_run_step(r, INT64_MAX, err); }

/* ---- between steps ---- */

static motus_status sample(motus_run *r, const double *times, size_t n, const size_t *columns, size_t count,
                           double *out, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t i = 0; i < n && status == MOTUS_OK; i++, out += count) {
        double *x = NULL, *v = NULL;
        status = run_between(r, times[i], &x, &v, err);
        if (status == MOTUS_OK) status = system_values(r->system, times[i], x, v, columns, count, out, err);
    }
    return status;
}

motus_status motus_run_sample(motus_run *r, const double *times, size_t n, const size_t *columns, size_t count,
                              double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || (n && !times) || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT, "motus_run_sample needs a run, times, columns and a place for the values");
    motus_status status = r->locate ? run_refuse(r, "sampled between steps", err) : MOTUS_OK;
    if (status != MOTUS_OK) return status;
    modes m = modes_enter();
    status = sample(r, times, n, columns, count, out, err);
    modes_leave(m);
    return status;
}

/* ---- statistics ---- */

motus_status motus_run_statistics_of(const motus_run *r, motus_run_statistics *out)
{
    if (!r || !out || motus_struct_check(MOTUS_DEF_RUN_STATISTICS, out, NULL) != MOTUS_OK) return MOTUS_ARGUMENT;
    motus_run_statistics ours = motus_default_run_statistics();
    ours.legs = r->legs;
    ours.method = r->chosen.name;
    ours.machine = r->machine.name;
    ours.note = r->note;
    ours.not_located = r->not_located;
    ours.cut = r->cut;
    ours.compiled_from = r->compiled_from;
    if (!row_adaptive(&r->chosen)) ours.step = fabs(r->timing.h);
    ours.shorter_last = fabs(r->timing.last);
    ours.steps_total = r->timing.total;
    ours.steps = r->before + run_steps(r);
    ours.refused = stepper_refused(r->stepper);
    ours.evaluations = stepper_evaluations(r->stepper);
    ours.iterations = stepper_iterations(r->stepper);
    ours.first_step = r->first_step;
    ours.last_step = ours.steps > 0 ? fabs(stepper_last_step(r->stepper)) : NAN;
    ours.absolute = r->chosen.absolute > 0;
    if (row_adaptive(&r->chosen)) ours.tolerance = ours.absolute ? r->chosen.absolute : r->chosen.relative;
    goal_statistics(r, &ours);
    stepper_sizes(r->stepper, &ours.shortest_step, &ours.longest_step);
    locate_statistics(r, &ours);
    run_events_statistics(r, &ours);
    motus_struct_write(MOTUS_DEF_RUN_STATISTICS, &ours, out);
    return MOTUS_OK;
}

/* ---- the text of the compiled machine ---- */

const char *motus_compiled_text(motus_system *s, const char *method, motus_error *err)
{
    motus_run_def def = motus_default_run();
    def.method = method;
    return motus_run_text(s, &def, err);
}

const char *motus_run_text(motus_system *s, const motus_run_def *given, motus_error *err)
{
    motus_run_def def;
    size_t length;
    if (!motus_error_sound(err) || motus_struct_read(MOTUS_DEF_RUN, given, &def, err) != MOTUS_OK) return NULL;
    if (!s || !s->model) {
        fail(err, MOTUS_ARGUMENT, "only a model from a text is compiled");
        return NULL;
    }
    request q = request_of_run(s, &def);
    if (q.set.method_said == MOTUS_SAID_DEFAULT) q.set.method = "verlet";
    if (request_choose(s, &q, err) != MOTUS_OK) return NULL;
    if (!s->compiled && compiled_create(s->model, &s->problem, &s->compiled, err) != MOTUS_OK) return NULL;
    const char *text = compiled_text(s->compiled, &q.chosen, &length);
    if (!text) fail(err, MOTUS_MEMORY, "no memory for the text");
    return text;
}

int motus_cache_clear(void) { return cache_clear(); }
