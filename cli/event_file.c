/* The table of events as CSV. See event_file.h.
 *
 * Invariant: a row is as long as the head; the values after an event that changed nothing are those on arrival.
 */
#include "cli/event_file.h"

#include "base/error.h"
#include "cli/complain.h"
#include "cli/csv.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct job {
    file_out *file;
    const load *model;
    motus_run *run;
    size_t *columns;
    double *values;
    size_t count;
    bool errors; /* of the times */
} job;

static motus_event_row row_at(motus_run *run, int64_t k)
{
    motus_event_row row = motus_default_event_row();
    motus_run_event(run, k, &row);
    return row;
}

/* The columns of the trajectory that are numbers of the motion: without the time, which every row has, and by default
 * without the exact motion. */
static motus_status plan(job *j, const options *o, motus_error *err)
{
    csv all;
    motus_status status = csv_plan(&all, j->model, o, err);
    const size_t end = o->columns ? SIZE_MAX : load_invariant_column(j->model) + j->model->invariants;
    j->columns = all.columns;
    for (size_t k = 0; !status && k < all.count; k++)
        if (all.columns[k] > 0 && all.columns[k] < end) j->columns[j->count++] = all.columns[k];
    if (!status) j->values = malloc((j->count + 1) * sizeof *j->values);
    return status || j->values ? status : complain_memory(err);
}

static motus_status put_names(const job *j, const char *suffix, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t k = 0; !status && k < j->count; k++) {
        motus_column column = motus_default_column();
        status = motus_column_at(j->model->system, j->columns[k], &column);
        if (status) return fail(err, status, "column %zu has no name", j->columns[k]);
        char name[sizeof column.name + 16];
        snprintf(name, sizeof name, "%s%s", column.name, suffix);
        status = file_text(j->file, ",", err);
        if (!status) status = csv_name(j->file, name, err);
    }
    return status;
}

static motus_status put_values(job *j, int64_t k, int after, motus_error *err)
{
    const motus_status status = motus_run_event_values(j->run, k, after, j->columns, j->count, j->values, err);
    return status ? status : csv_numbers(j->file, j->values, j->count, err);
}

static motus_status put_row(job *j, int64_t k, motus_error *err)
{
    char text[64];
    const motus_event_row row = row_at(j->run, k);
    const double times[] = {row.time, row.error};
    motus_status status = csv_name(j->file, row.instance, err);
    if (!status) status = csv_numbers(j->file, times, j->errors ? 2 : 1, err);
    snprintf(text, sizeof text, ",%lld,%d", (long long)row.count, row.touched != 0);
    if (!status) status = file_text(j->file, text, err);
    for (int after = 0; !status && after < 2; after++) status = put_values(j, k, after, err);
    return status ? status : file_text(j->file, "\n", err);
}

motus_status event_file_write(file_out *file, const load *model, const options *o, motus_run *run, motus_error *err)
{
    job j = {.file = file, .model = model, .run = run};
    const int64_t rows = motus_run_events(run);
    motus_status status = plan(&j, o, err);
    for (int64_t k = 0; k < rows && !j.errors; k++) j.errors = !isnan(row_at(run, k).error);
    if (!status) status = csv_comment(file, o, run, err);
    if (!status) status = file_text(file, j.errors ? "event,t,t.error,count,touched" : "event,t,count,touched", err);
    if (!status) status = put_names(&j, "", err);
    if (!status) status = put_names(&j, ".after", err);
    if (!status) status = file_text(file, "\n", err);
    for (int64_t k = 0; !status && k < rows; k++) status = put_row(&j, k, err);
    free(j.columns);
    free(j.values);
    return status;
}
