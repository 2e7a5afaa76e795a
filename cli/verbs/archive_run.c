/* motus archive, for the archive of a run. */
#include "cli/verbs/archive.h"

#include "cli/files/archived.h"
#include "cli/run/run.h"
#include "cli/words/complain.h"

#include <stdlib.h>
#include <string.h>

bool archive_run_is(const motus_archive *a)
{
    static const char run[] = "motus run ";
    return strncmp(archived_note(a, "command"), run, sizeof run - 1) == 0;
}

static motus_status put_head(motus_archive *a, csv *plan, file_out *out, motus_error *err)
{
    char line[160];
    motus_status status = file_text(out, "# ", err);
    if (!status) status = file_text(out, archived_note(a, "command"), err);
    snprintf(line, sizeof line, "\n# motus %.40s, method %.40s, fingerprint %.32s\n", archived_note(a, "motus"),
             archived_note(a, "method"), archived_note(a, "fingerprint"));
    if (!status) status = file_text(out, line, err);
    return status ? status : csv_names(plan, out, err);
}

static motus_status put_rows(motus_archive *a, csv *plan, const run_columns *columns, stop_progress *progress,
                             motus_error *err)
{
    const uint64_t blocks = motus_archive_blocks(a);
    uint64_t first;
    size_t most, count;
    motus_archive_block(a, 0, &first, &most);
    double **rooms = run_columns_rooms(columns, most + 1), *row = calloc(2 * plan->count + 1, sizeof *row);
    motus_status status = rooms && row ? MOTUS_OK : complain_memory(err);
    for (uint64_t b = 0; !status && b < blocks; b++) {
        motus_archive_block(a, b, &first, &count);
        for (size_t k = 0; !status && k < columns->count; k++)
            status = motus_archive_read(a, k, first, count, rooms[k], err);
        for (size_t i = 0; !status && i < count; i++) {
            for (size_t k = 0; k < columns->count; k++) {
                const run_column *c = columns->columns + k;
                if (c->from != SIZE_MAX) memcpy(row + c->from, rooms[k] + i * c->width, c->width * sizeof *row);
            }
            status = csv_row(plan, row, err);
        }
        if (!status && stop_progress_hook(progress, (double)b / (double)blocks))
            status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    run_columns_drop(columns, rooms);
    free(row);
    return status;
}

motus_status archive_run_csv(motus_archive *a, const options *o, file_out *out, stop_progress *progress,
                             motus_error *err)
{
    run_command command;
    load model = {0};
    csv plan = {0};
    run_columns columns = {0};
    motus_status status = run_command_of(&command, a, o, err);
    if (!status) status = load_model(&model, &command.options, err);
    if (!status) status = csv_plan(&plan, &model, &command.options, err);
    if (!status) status = run_columns_make(&columns, &plan, err);
    if (!status && !run_columns_fit(&columns, a))
        status = fail(err, MOTUS_STATE, "the archive has other columns than those that its command makes");
    if (!status) status = put_head(a, &plan, out, err);
    if (!status) status = put_rows(a, &plan, &columns, progress, err);
    run_columns_free(&columns);
    csv_free(&plan);
    load_free(&model);
    run_command_free(&command);
    return status;
}

bool archive_run_goes_on(motus_archive *a, bool missing, uint64_t first_missing)
{
    bool good = false;
    size_t width = 0; /* bytes of a row in a state */
    motus_archive_column c;
    motus_error ignored = motus_default_error();
    for (size_t k = 0; motus_archive_column_at(a, k, &c); k++) width += motus_archive_width(&c) * sizeof(double);
    for (int back = 0; !good && back < 2; back++) {
        char *bytes;
        size_t length, count;
        uint64_t rows = UINT64_MAX;
        run_state s;
        if (missing) motus_archive_block(a, first_missing, &rows, &count);
        good = motus_archive_saved(a, back, &bytes, &length, &ignored) == MOTUS_OK && bytes &&
               run_state_read(bytes, length, &s) && s.rows - s.rest_length / width <= rows; /* the state has the rest */
        free(bytes);
    }
    return good;
}

motus_status archive_run_state(motus_archive *a, const options *o, file_out *out, motus_error *err)
{
    char *bytes;
    size_t length;
    run_state s;
    motus_status status = motus_archive_saved(a, 0, &bytes, &length, err);
    if (!status && !(bytes && run_state_read(bytes, length, &s)))
        status = fail(err, MOTUS_STATE, "%s has no state", o->operand);
    if (!status) status = file_write(out, s.text, s.length, err);
    free(bytes);
    return status;
}
