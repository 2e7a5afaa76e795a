/* The calls of the page, over motus.h. The page writes texts and reads numbers in the module's memory; answers with
 * names in them are JSON.
 *
 * Every call that can fail returns a motus_status, and lab_problem tells the rest. Counts are doubles: JavaScript's
 * integers.
 */
#include "lab/core/core.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

const char **lab_list(const char *strings, size_t count)
{
    const char **list = malloc((count + 1) * sizeof *list);
    for (size_t k = 0; list && k < count; k++, strings += strlen(strings) + 1) list[k] = strings;
    return list;
}

bool lab_no_memory(lab *l)
{
    l->error = motus_default_error();
    l->error.status = MOTUS_MEMORY;
    return false;
}

LAB_CALL(lab_create) lab *lab_create(void)
{
    lab *l = malloc(sizeof *l);
    if (l) *l = (lab){.error = motus_default_error()};
    return l;
}

void lab_forget_run(lab *l)
{
    motus_run_destroy(l->run);
    l->run = NULL;
}

LAB_CALL(lab_destroy) void lab_destroy(lab *l)
{
    if (!l) return;
    lab_forget_run(l);
    motus_reference_destroy(l->reference);
    motus_system_destroy(l->system);
    free(l->answer.text);
    free(l);
}

/* The text of a model, what replaces its values, `sets` strings one behind the other, and events besides those of the
 * text, `whens` strings likewise. Whoever types it may leave it incomplete: it is a draft. */
LAB_CALL(lab_open)
motus_status lab_open(lab *l, const char *text, size_t length, const char *set, size_t sets, const char *when,
                      size_t whens)
{
    lab_forget_run(l);
    motus_reference_destroy(l->reference);
    motus_system_destroy(l->system);
    l->reference = NULL;
    l->system = NULL;
    motus_text_def def = motus_default_text();
    const char **list = lab_list(set, sets), **events = lab_list(when, whens);
    if (!list || !events) {
        free(list);
        free(events);
        lab_no_memory(l);
        return MOTUS_MEMORY;
    }
    def.text = text;
    def.length = length;
    def.set = list;
    def.set_count = sets;
    def.when = events;
    def.when_count = whens;
    def.draft = 100000;
    motus_status status = motus_system_from_text(&def, &l->system, &l->error);
    free(list);
    free(events);
    return status;
}

/* The last problem. */
LAB_CALL(lab_problem) const char *lab_problem(lab *l)
{
    const motus_error *e = &l->error;
    json j = lab_answer(l);
    tell_error(&j, e, e->message[0] ? e->message : motus_status_text(e->status));
    json_string(&j, "hint", e->hint);
    json_string(&j, "source", e->source);
    json_string(&j, "caret", e->caret);
    json_number(&j, "time", e->time);
    json_string(&j, "variable", e->variable);
    json_string(&j, "word", e->word);
    json_string(&j, "instead", e->instead);
    return lab_answered(l, &j);
}

/* Runs: started, recorded in slices, and looked at. `step`, `tolerance`, `until`: NaN is the model's. */
motus_run_def lab_run(const char *method, double step, double tolerance, double until)
{
    motus_run_def def = motus_default_run();
    def.method = *method ? method : NULL;
    def.step = step;
    def.tolerance = tolerance;
    def.until = until;
    def.machine = "interpreter";
    return def;
}

/* accuracy, absolute: of motus_run_def, NaN: none is asked for. bars: motus_bars, for lab_errors. */
LAB_CALL(lab_start)
motus_status lab_start(lab *l, const char *method, double step, double tolerance, double until, double accuracy,
                       int absolute, int bars)
{
    lab_forget_run(l);
    motus_run_def def = lab_run(method, step, tolerance, until);
    def.accuracy = accuracy;
    def.absolute = absolute;
    def.error = (motus_bars)bars;
    return motus_run_create(l->system, &def, &l->run, &l->error);
}

/* Whether such a run passes a singularity of the force (motus_run_singular): MOTUS_SINGULAR or MOTUS_UNRESOLVED, and
 * lab_problem says where. */
LAB_CALL(lab_singular)
motus_status lab_singular(lab *l, const char *method, double step, double tolerance, double until)
{
    const motus_run_def def = lab_run(method, step, tolerance, until);
    return motus_run_singular(l->system, &def, &l->error);
}

/* Steps on by `every` (from the second row of a run on) and writes the numbers of `count` columns, up to `rows` times
 * or to the end. The rows that were written are in *written, also where a step failed; MOTUS_ACCURACY: the last of them
 * is the end. */
LAB_CALL(lab_record)
motus_status lab_record(lab *l, const size_t *columns, size_t count, double every, size_t rows, int first, double *out,
                        size_t *written)
{
    *written = 0;
    for (size_t i = 0; i < rows; i++) {
        motus_status status = MOTUS_OK;
        if (!first || i > 0) {
            if (motus_run_done(l->run)) return MOTUS_OK;
            status = motus_run_step(l->run, (int64_t)every, &l->error);
        }
        if (status == MOTUS_OK || status == MOTUS_ACCURACY) {
            const motus_status read =
                motus_run_values(l->run, columns, count, out + i * count, status == MOTUS_OK ? &l->error : NULL);
            *written = i + (read == MOTUS_OK);
            if (status == MOTUS_OK) status = read;
        }
        if (status != MOTUS_OK) return status;
    }
    return MOTUS_OK;
}

/* The numbers of `count` columns at given times, in the order of the run and not before its last step, row by row; it
 * steps on as far as needed. Between steps they are the method's dense output. */
LAB_CALL(lab_sample)
motus_status lab_sample(lab *l, const double *times, size_t time_count, const size_t *columns, size_t count,
                        double *out)
{
    return motus_run_sample(l->run, times, time_count, columns, count, out, &l->error);
}

/* The numbers of `count` columns where the run stands, and their bars of error. */
LAB_CALL(lab_errors)
motus_status lab_errors(lab *l, const size_t *columns, size_t count, double *values, double *errors)
{
    return motus_run_errors(l->run, columns, count, values, errors, &l->error);
}

/* A number with its error, in print. */
LAB_CALL(lab_bar) const char *lab_bar(lab *l, double value, double error) { return bar_text(value, error, l->bar); }

/* Why there are no bars, and from what time on no digit is significant. NULL: lab_problem. */
LAB_CALL(lab_estimate) const char *lab_estimate(lab *l)
{
    motus_estimate e = motus_default_estimate();
    if (motus_run_estimate(l->run, &e, &l->error) != MOTUS_OK) return NULL;
    json j = lab_answer(l);
    json_string(&j, "reason", e.reason);
    json_number(&j, "significant_until", e.significant_until);
    return lab_answered(l, &j);
}

/* out: time, steps, steps in all, step, last step, evaluations, done, refused steps, tolerance; accuracy and what was
 * reached of it (motus_run_statistics), runs that were tried for it. Where steps adapt steps in all are 0, and the step
 * is NaN; elsewhere the tolerance. */
LAB_CALL(lab_progress) void lab_progress(const lab *l, double *out)
{
    const motus_run_statistics all = motus_run_now(l->run);
    out[0] = motus_run_time(l->run);
    out[1] = (double)motus_run_steps(l->run);
    out[2] = (double)all.steps_total;
    out[3] = all.step;
    out[4] = all.shorter_last;
    out[5] = (double)all.evaluations;
    out[6] = motus_run_done(l->run);
    out[7] = (double)all.refused;
    out[8] = all.tolerance;
    out[9] = all.accuracy;
    out[10] = all.reached;
    out[11] = all.trials;
}

LAB_CALL(lab_advance) motus_status lab_advance(lab *l, double steps)
{
    return motus_run_step(l->run, (int64_t)steps, &l->error);
}

LAB_CALL(lab_method) const char *lab_method(const lab *l) { return motus_run_now(l->run).method; }
/* Why "auto" chose it. */
LAB_CALL(lab_choice) const char *lab_choice(const lab *l) { return motus_run_now(l->run).choice; }

/* The restart state: the whole state in hexadecimal numbers. NULL: lab_problem. */
LAB_CALL(lab_save) const char *lab_save(lab *l)
{
    const char *text;
    size_t length;
    return motus_run_save(l->run, &text, &length, &l->error) == MOTUS_OK ? text : NULL;
}

LAB_CALL(lab_positions) size_t lab_positions(const lab *l) { return motus_positions(l->system); }
LAB_CALL(lab_velocities) size_t lab_velocities(const lab *l) { return motus_velocities(l->system); }
LAB_CALL(lab_jacobian) motus_status lab_jacobian(lab *l, double *da_dx, double *da_dv)
{
    return motus_run_jacobian(l->run, da_dx, da_dv, &l->error);
}
