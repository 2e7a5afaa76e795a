/* The trajectory as CSV (RFC 4180, except that a line ends with only a newline).
 *
 * Invariant: every line of the head begins with '#' and has no control character, whatever the command line has. A name
 * with a comma or a quote is in quotes. Every number reads back as the same double in every locale.
 */
#include "cli/run/csv.h"

#include "cli/files/command.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"
#include "cli/words/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

motus_status csv_plan(csv *c, const load *model, const options *o, motus_error *err)
{
    *c = (csv){.model = model, .errors = o->errors};
    size_t all = motus_column_count(model->system);
    if (!o->columns) {
        c->columns = malloc((all + 1) * sizeof *c->columns);
        if (!c->columns) return complain_memory(err);
        for (size_t k = 0; k < all; k++) c->columns[k] = k;
        c->count = all;
        return MOTUS_OK;
    }
    options_list names;
    motus_status status = words_part(o->columns, "--columns", &names, err);
    if (status) return status;
    for (size_t i = 0; !status && i < names.count; i++) {
        size_t first, count;
        status = motus_column_find(model->system, names.items[i], &first, &count, err);
        if (status) break;
        size_t *columns = count < SIZE_MAX / sizeof *columns - c->count
                              ? realloc(c->columns, (c->count + count + 1) * sizeof *columns)
                              : NULL;
        if (!columns) {
            status = complain_memory(err);
            break;
        }
        c->columns = columns;
        for (size_t k = 0; k < count; k++) c->columns[c->count++] = first + k;
    }
    words_free(&names);
    return status;
}

void csv_free(csv *c)
{
    free(c->columns);
    free(c->line);
    c->columns = NULL;
    c->line = NULL;
}

motus_status csv_comment(file_out *f, const options *o, const motus_run *run, motus_error *err)
{
    char line[256], step[DECIMAL_MAX];
    const motus_run_statistics done = motus_run_now(run);
    motus_status status = file_text(f, "# motus", err);
    for (int i = 1; !status && i < o->argc; i++) status = command_word(f, o->argv[i], err);
    const bool adapts = !isnan(done.tolerance);
    decimal(adapts ? done.tolerance : done.step, step);
    snprintf(line, sizeof line, "\n# motus %s, method %s, %s %s%s, machine %s\n", motus_version(), done.method,
             adapts ? "tolerance" : "step", step, done.absolute ? " absolute" : "", o->machine ? o->machine : "auto");
    return status ? status : file_text(f, line, err);
}

motus_status csv_name(file_out *f, const char *name, motus_error *err)
{
    char safe[sizeof((motus_column *)0)->name + 32];
    text_safe(name, safe, sizeof safe);
    if (!strpbrk(safe, ",\"")) return file_text(f, safe, err);
    motus_status status = file_text(f, "\"", err);
    for (const char *s = safe; !status && *s; s++)
        status = file_write(f, *s == '"' ? "\"\"" : s, *s == '"' ? 2 : 1, err);
    return status ? status : file_text(f, "\"", err);
}

motus_status csv_numbers(file_out *f, const double *values, size_t count, motus_error *err)
{
    char text[DECIMAL_MAX + 1] = ",";
    motus_status status = MOTUS_OK;
    for (size_t k = 0; !status && k < count; k++) {
        decimal(values[k], text + 1);
        status = file_text(f, text, err);
    }
    return status;
}

motus_status csv_names(csv *c, file_out *file, motus_error *err)
{
    motus_status status = MOTUS_OK;
    c->file = file;
    c->line = c->count < SIZE_MAX / DECIMAL_MAX / 2 - 2 ? malloc((2 * c->count + 2) * DECIMAL_MAX) : NULL;
    if (!c->line) return complain_memory(err);
    for (size_t k = 0; !status && k < (c->errors ? 2 : 1) * c->count; k++) {
        motus_column column = motus_default_column();
        const bool error = k >= c->count;
        const size_t index = c->columns[error ? k - c->count : k];
        status = motus_column_at(c->model->system, index, &column);
        if (status) return fail(err, status, "column %zu has no name", index);
        if (error && column.kind == MOTUS_COLUMN_TIME) continue;
        char name[sizeof column.name + 16];
        snprintf(name, sizeof name, "%s%s", column.name, error ? ".error" : "");
        if (k > 0) status = file_text(c->file, ",", err);
        if (!status) status = csv_name(c->file, name, err);
    }
    return status ? status : file_text(c->file, c->errors ? ",significant\n" : "\n", err);
}

motus_status csv_begin(csv *c, file_out *file, const options *o, const motus_run *run, motus_error *err)
{
    const motus_status status = csv_comment(file, o, run, err);
    return status ? status : csv_names(c, file, err);
}

bool csv_significant(const csv *c, const double *values)
{
    bool known = true;
    for (size_t k = 0; c->errors && k < c->count; k++)
        known = known && (c->columns[k] == 0 || !isinf(values[c->count + k])); /* t has no error */
    return known;
}

motus_status csv_row(void *context, const double *values, motus_error *err)
{
    csv *c = context;
    char *s = c->line;
    for (size_t k = 0; k < (c->errors ? 2 : 1) * c->count; k++) {
        if (k >= c->count && c->columns[k - c->count] == 0) continue; /* t */
        if (k > 0) *s++ = ',';
        decimal(values[k], s);
        s += strlen(s);
    }
    if (c->errors) *s++ = ',', *s++ = csv_significant(c, values) ? '1' : '0';
    *s++ = '\n';
    c->rows++;
    return file_write(c->file, c->line, (size_t)(s - c->line), err);
}

motus_status csv_jump(void *context, const double *before, const double *after, motus_error *err)
{
    ((csv *)context)->jumps++;
    const motus_status status = csv_row(context, before, err);
    return status ? status : csv_row(context, after, err);
}
