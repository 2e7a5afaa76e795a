/* Studies for the page: truth and errors, one step opened up, convergence, comparison, stability. */
#include "lab/core/core.h"

#include <math.h>
#include <stdlib.h>

static motus_study_def study(double step, double until)
{
    motus_study_def def = motus_default_study();
    def.step = step;
    def.until = until;
    return def;
}

/* The study's methods, `count` names one behind the other; the list is to be freed. False: no memory, which is the
 * problem then. */
static bool by(lab *l, motus_study_def *def, const char *methods, size_t count)
{
    def->methods = lab_list(methods, count);
    def->method_count = count;
    return def->methods || lab_no_memory(l);
}

/* The exact motion or a reference run, judged as a study at this step would be; tolerance: of motus_study_def. */
LAB_CALL(lab_reference) motus_status lab_reference(lab *l, double step, double until, double tolerance)
{
    motus_reference_destroy(l->reference);
    l->reference = NULL;
    motus_study_def def = study(step, until);
    def.tolerance = tolerance;
    return motus_reference_create(l->system, &def, &l->reference, &l->error);
}
LAB_CALL(lab_reference_name) const char *lab_reference_name(const lab *l) { return motus_reference_name(l->reference); }
LAB_CALL(lab_reference_error) double lab_reference_error(const lab *l) { return motus_reference_error(l->reference); }

/* positions and velocities at `count` times, row by row. */
LAB_CALL(lab_reference_at)
motus_status lab_reference_at(lab *l, const double *times, size_t count, double *x, double *v)
{
    return motus_reference_at(l->reference, times, count, x, v, &l->error);
}

/* The numbers of `columns` at `count` states, row by row: quantities of the reference, which tells states alone. */
LAB_CALL(lab_values)
motus_status lab_values(lab *l, const double *times, const double *x, const double *v, size_t count,
                        const size_t *columns, size_t column_count, double *out)
{
    const size_t nx = motus_positions(l->system), nv = motus_velocities(l->system);
    motus_run_def def = motus_default_run();
    motus_run *run = NULL;
    if (!count) return MOTUS_OK;
    /* Every time is one from which steps lead on. */
    const double way = times[count - 1] - times[0];
    def.method = "explicit-euler";
    def.start = times[0];
    def.until = times[count - 1] + (way != 0 ? way : 1);
    def.step = fabs(def.until - def.start);
    def.x = x;
    def.v = v;
    def.machine = "interpreter";
    motus_status status = motus_run_create(l->system, &def, &run, &l->error);
    for (size_t k = 0; k < count && status == MOTUS_OK; k++) {
        if (k > 0) status = motus_run_set_state(run, times[k], x + k * nx, v + k * nv, &l->error);
        if (status == MOTUS_OK)
            status = motus_run_values(run, columns, column_count, out + k * column_count, &l->error);
    }
    motus_run_destroy(run);
    return status;
}

/* The next step of the run, event by event (protocol.ts, TraceEntry). NULL: lab_problem. */
LAB_CALL(lab_trace) const char *lab_trace(lab *l)
{
    static const char *const kinds[] = {
        [MOTUS_TRACE_START] = "start", [MOTUS_TRACE_KICK] = "kick",   [MOTUS_TRACE_DRIFT] = "drift",
        [MOTUS_TRACE_STAGE] = "stage", [MOTUS_TRACE_SOLVE] = "solve", [MOTUS_TRACE_TAYLOR] = "taylor",
        [MOTUS_TRACE_STEP] = "step",   [MOTUS_TRACE_END] = "end",     [MOTUS_TRACE_REFUSED] = "refused",
    };
    const motus_trace_entry *const *entries;
    size_t count;
    if (motus_run_trace(l->run, &entries, &count, &l->error) != MOTUS_OK) return NULL;
    const size_t nx = motus_positions(l->system), nv = motus_velocities(l->system);
    json j = lab_answer(l);
    json_open(&j, "entries", '[');
    for (size_t k = 0; k < count; k++) {
        const motus_trace_entry *e = entries[k];
        json_open(&j, NULL, '{');
        json_string(&j, "kind", kinds[e->kind]);
        json_integer(&j, "stage", e->stage);
        json_integer(&j, "stages", e->stages);
        json_integer(&j, "iterations", e->iterations);
        json_number(&j, "time", e->time);
        json_number(&j, "step", e->step);
        json_number(&j, "coefficient", e->coefficient);
        json_number(&j, "weight", e->weight);
        json_number(&j, "weight_x", e->weight_x);
        json_numbers(&j, "row", e->row, (size_t)e->stages);
        json_numbers(&j, "row_x", e->row_x, (size_t)e->stages);
        json_numbers(&j, "x", e->x, nx);
        json_numbers(&j, "v", e->v, nv);
        json_numbers(&j, "a", e->a, nv);
        json_numbers(&j, "before_x", e->before_x, nx);
        json_numbers(&j, "before_a", e->before_a, nv);
        json_number(&j, "error", e->error);
        json_close(&j, '}');
    }
    json_close(&j, ']');
    return lab_answered(l, &j);
}

/* Order, by slope (protocol.ts, Convergence). NULL: lab_problem. */
LAB_CALL(lab_converge) const char *lab_converge(lab *l, const char *methods, size_t count, double step, double until)
{
    motus_study_def def = study(step, until);
    motus_convergence *c = NULL;
    if (!by(l, &def, methods, count)) return NULL;
    motus_converge(l->system, &def, &c, &l->error);
    free((void *)def.methods);
    if (!c) return NULL;
    json j = lab_answer(l);
    tell_convergence(&j, c);
    motus_convergence_destroy(c);
    return lab_answered(l, &j);
}

/* Every method side by side (protocol.ts, Comparison). NULL: lab_problem. */
LAB_CALL(lab_compare) const char *lab_compare(lab *l, const char *methods, size_t count, double step, double until)
{
    motus_study_def def = study(step, until);
    motus_comparison *c = NULL;
    if (!by(l, &def, methods, count)) return NULL;
    motus_compare(l->system, &def, &c, &l->error);
    free((void *)def.methods);
    if (!c) return NULL;
    json j = lab_answer(l);
    tell_comparison(&j, c);
    motus_comparison_destroy(c);
    return lab_answered(l, &j);
}

LAB_CALL(lab_stability)
motus_status lab_stability(lab *l, const char *method, size_t count, const double *re, const double *im, double *growth)
{
    return motus_stability(method, count, re, im, growth, &l->error);
}
