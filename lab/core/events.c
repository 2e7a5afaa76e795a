/* Events for the page: the table of a run, what ended it, and a run from a state that the page chose. */
#include "lab/core/core.h"

#include <stddef.h>

LAB_CALL(lab_event_count) double lab_event_count(const lab *l) { return (double)motus_run_events(l->run); }

/* Of rows `first` to `first + rows - 1`: time, its error, count, touched, changed; then `count` columns on arrival, and
 * the same as the action left them. */
LAB_CALL(lab_events)
motus_status lab_events(lab *l, double first, size_t rows, const size_t *columns, size_t count, double *out)
{
    for (size_t k = 0; k < rows; k++, out += 5 + 2 * count) {
        motus_event_row row = motus_default_event_row();
        const int64_t at = (int64_t)first + (int64_t)k;
        motus_status status = motus_run_event(l->run, at, &row);
        out[0] = row.time;
        out[1] = row.error;
        out[2] = (double)row.count;
        out[3] = row.touched;
        out[4] = (double)row.changed;
        for (int after = 0; after < 2 && status == MOTUS_OK; after++)
            status = motus_run_event_values(l->run, at, after, columns, count, out + 5 + after * count, &l->error);
        if (status != MOTUS_OK) return status;
    }
    return MOTUS_OK;
}

/* The names of these rows, with their indices. */
LAB_CALL(lab_event_names) const char *lab_event_names(lab *l, double first, size_t rows)
{
    json j = lab_answer(l);
    json_open(&j, "names", '[');
    for (size_t k = 0; k < rows; k++) {
        motus_event_row row = motus_default_event_row();
        if (motus_run_event(l->run, (int64_t)first + (int64_t)k, &row) == MOTUS_OK) json_string(&j, NULL, row.instance);
    }
    json_close(&j, ']');
    return lab_answered(l, &j);
}

/* What ended the run, where events accumulate, and how many rows of the table have a significant digit. */
LAB_CALL(lab_ended) const char *lab_ended(lab *l)
{
    json j = lab_answer(l);
    tell_ended(&j, l->run);
    json_string(&j, "accumulates", motus_run_accumulates(l->run));
    json_integer(&j, "significant", motus_run_events_significant(l->run));
    return lab_answered(l, &j);
}

/* A run that begins at these positions and velocities at the model's start. */
LAB_CALL(lab_start_at)
motus_status lab_start_at(lab *l, const char *method, double step, double tolerance, double until, const double *x,
                          const double *v)
{
    motus_run_def def = lab_run(method, step, tolerance, until);
    lab_forget_run(l);
    def.x = x;
    def.v = v;
    return motus_run_create(l->system, &def, &l->run, &l->error);
}
