/* The table of events as CSV.
 *
 * Invariant: a row has as many cells as the head. The values after an event that changed nothing are those on arrival.
 */
#include "cli/run/csv.h"

#include "cli/model/load.h"
#include "cli/words/complain.h"

#include <math.h>
#include <stdlib.h>

typedef struct job {
    file_out *file;
    motus_run *run;
    size_t *columns;
    double *values; /* on arrival, and after them, as the action left them */
    size_t count;
    bool errors; /* the errors of times are known */
} job;

static motus_event_row row_at(motus_run *run, int64_t k)
{
    motus_event_row row = motus_default_event_row();
    motus_run_event(run, k, &row);
    return row;
}

/* Returns whether --record has added the column to the model. */
static bool added(const load *model, size_t k)
{
    motus_column column = motus_default_column();
    const char *rest;
    return motus_column_at(model->system, k, &column) == MOTUS_OK && defined_label(&model->defined, column.name, &rest);
}

/* Leaves out the time, which every row has, and by default the exact motion and the quantities that --record has
 * added. */
motus_status event_file_columns(const load *model, const options *o, size_t **columns, size_t *count, motus_error *err)
{
    csv all;
    motus_status status = csv_plan(&all, model, o, err);
    const size_t end = o->columns ? SIZE_MAX : load_invariant_column(model) + model->invariants;
    *columns = all.columns;
    *count = 0;
    for (size_t k = 0; !status && k < all.count; k++)
        if (all.columns[k] > 0 && all.columns[k] < end && (o->columns || !added(model, all.columns[k])))
            (*columns)[(*count)++] = all.columns[k];
    return status;
}

static motus_status put_names(file_out *file, const load *model, const size_t *columns, size_t count,
                              const char *suffix, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t k = 0; !status && k < count; k++) {
        motus_column column = motus_default_column();
        status = motus_column_at(model->system, columns[k], &column);
        if (status) return fail(err, status, "column %zu has no name", columns[k]);
        char name[sizeof column.name + 16];
        snprintf(name, sizeof name, "%s%s", column.name, suffix);
        status = file_text(file, ",", err);
        if (!status) status = csv_name(file, name, err);
    }
    return status;
}

motus_status event_file_names(file_out *file, const load *model, const size_t *columns, size_t count, bool errors,
                              motus_error *err)
{
    motus_status status = file_text(file, errors ? "event,t,t.error,count,touched" : "event,t,count,touched", err);
    if (!status) status = put_names(file, model, columns, count, "", err);
    if (!status) status = put_names(file, model, columns, count, ".after", err);
    return status ? status : file_text(file, "\n", err);
}

motus_status event_file_row(file_out *file, const motus_event_row *row, bool errors, const double *values,
                            const double *after, size_t count, motus_error *err)
{
    char text[64];
    const double times[] = {row->time, row->error};
    motus_status status = csv_name(file, row->instance, err);
    if (!status) status = csv_numbers(file, times, errors ? 2 : 1, err);
    snprintf(text, sizeof text, ",%lld,%d", (long long)row->count, row->touched != 0);
    if (!status) status = file_text(file, text, err);
    if (!status) status = csv_numbers(file, values, count, err);
    if (!status) status = csv_numbers(file, after, count, err);
    return status ? status : file_text(file, "\n", err);
}

static motus_status put_row(job *j, int64_t k, motus_error *err)
{
    const motus_event_row row = row_at(j->run, k);
    double *const after = j->values + j->count;
    motus_status status = motus_run_event_values(j->run, k, 0, j->columns, j->count, j->values, err);
    if (!status) status = motus_run_event_values(j->run, k, 1, j->columns, j->count, after, err);
    return status ? status : event_file_row(j->file, &row, j->errors, j->values, after, j->count, err);
}

motus_status event_file_write(file_out *file, const load *model, const options *o, motus_run *run, motus_error *err)
{
    job j = {.file = file, .run = run};
    const int64_t rows = motus_run_events(run);
    motus_status status = event_file_columns(model, o, &j.columns, &j.count, err);
    j.values = status ? NULL : malloc((2 * j.count + 1) * sizeof *j.values);
    if (!status && !j.values) status = complain_memory(err);
    for (int64_t k = 0; k < rows && !j.errors; k++) j.errors = !isnan(row_at(run, k).error);
    if (!status) status = csv_comment(file, o, run, err);
    if (!status) status = event_file_names(file, model, j.columns, j.count, j.errors, err);
    for (int64_t k = 0; !status && k < rows; k++) status = put_row(&j, k, err);
    free(j.columns);
    free(j.values);
    return status;
}
