/* See run_again.h. */
#include "cli/run_again.h"

#include "base/decimal.h"
#include "base/error.h"
#include "cli/complain.h"
#include "cli/run_columns.h"
#include "cli/run_make.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ENOUGH MOTUS_CANCELLED /* how an observer ends the walk */

typedef struct comparison {
    motus_archive *file;
    const csv *plan;
    run_columns columns;
    double *its; /* a row of a column */
    uint64_t rows, wanted;
    bool same;
    char *where;
} comparison;

static void tell(comparison *c, size_t k, size_t i, double its, double ours)
{
    char a[DECIMAL_MAX], b[DECIMAL_MAX], place[48] = "";
    if (c->columns.columns[k].width > 1) snprintf(place, sizeof place, " (number %zu of the row)", i + 1);
    snprintf(c->where, RUN_WHERE, "row %" PRIu64 ", %.80s%s: %s in the file, %s computed", c->rows,
             c->columns.columns[k].name, place, decimal(its, a), decimal(ours, b));
}

static motus_status take(void *context, const double *values, motus_error *err)
{
    comparison *c = context;
    double significant = 1;
    if (c->rows == c->wanted || !c->same) return ENOUGH;
    for (size_t k = c->plan->count; c->plan->errors && k < 2 * c->plan->count; k++)
        if (isinf(values[k])) significant = 0;
    for (size_t k = 0; c->same && k < c->columns.count; k++) {
        const run_column *column = c->columns.columns + k;
        const double *ours = column->from == SIZE_MAX ? &significant : values + column->from;
        const motus_status status = motus_archive_read(c->file, k, c->rows, 1, c->its, err);
        if (status) return status;
        for (size_t i = 0; c->same && i < column->width; i++) {
            c->same = memcmp(ours + i, c->its + i, sizeof *ours) == 0;
            if (!c->same) tell(c, k, i, c->its[i], ours[i]);
        }
    }
    c->rows++;
    return MOTUS_OK;
}

static motus_status jump(void *context, const double *before, const double *after, motus_error *err)
{
    const motus_status status = take(context, before, err);
    return status ? status : take(context, after, err);
}

/* Whether the file has these columns; the room for a row of the widest. */
static motus_status check(comparison *c, motus_error *err)
{
    size_t widest = 1;
    bool same = motus_archive_column_count(c->file) == c->columns.count;
    for (size_t k = 0; same && k < c->columns.count; k++) {
        motus_archive_column its;
        motus_archive_column_at(c->file, k, &its);
        same = its.kind == MOTUS_ARCHIVE_NUMBER && motus_archive_width(&its) == c->columns.columns[k].width &&
               strcmp(its.name, c->columns.columns[k].name) == 0;
        if (c->columns.columns[k].width > widest) widest = c->columns.columns[k].width;
    }
    if (!same) return fail(err, MOTUS_STATE, "the archive has other columns than those that its command makes");
    c->its = malloc(widest * sizeof *c->its);
    return c->its ? MOTUS_OK : complain_memory(err);
}

motus_status run_again_rows(const options *o, motus_archive *file, uint64_t rows, bool *same, char where[RUN_WHERE],
                            motus_error *err)
{
    load model;
    csv plan = {0};
    motus_run *run = NULL;
    motus_run_def def;
    options quiet = *o;
    quiet.quiet = true;
    stop_progress progress = stop_progress_begin("archive", true);
    comparison c = {.file = file, .plan = &plan, .wanted = rows, .same = true, .where = where};
    const motus_bars bars = !o->errors                                  ? MOTUS_BARS_NONE
                            : o->error && strcmp(o->error, "full") == 0 ? MOTUS_BARS_FULL
                                                                        : MOTUS_BARS_CHEAP;
    motus_status status = load_model(&model, &quiet, err);
    if (!status) status = run_make(&quiet, &model, &progress, bars, &def, &run, err);
    if (!status) status = csv_plan(&plan, &model, &quiet, err);
    if (!status) status = run_columns_make(&c.columns, &plan, err);
    if (!status) status = check(&c, err);
    if (!status) {
        walk_observer w = run_make_rows(&quiet, &model, run);
        w.columns = plan.columns, w.count = plan.count;
        w.take = take, w.jump = jump, w.context = &c;
        status = walk(run, motus_run_time(run), load_until(&model), &w, 1, NULL, err);
        if (status == ENOUGH && !stop_requested()) status = MOTUS_OK;
        if (!status && c.same && c.rows < rows)
            status = fail(err, MOTUS_STATE, "the run of the archive's command has only %" PRIu64 " rows", c.rows);
    }
    *same = c.same;
    free(c.its);
    run_columns_free(&c.columns);
    csv_free(&plan);
    motus_run_destroy(run);
    load_free(&model);
    return status;
}
