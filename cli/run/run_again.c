/* Computes the first rows of the archive of a run again, and compares their bytes. */
#include "cli/run/run.h"

#include "base/decimal.h"
#include "cli/words/complain.h"

#include <inttypes.h>
#include <string.h>

#define ENOUGH MOTUS_CANCELLED /* an observer returns it to end the walk */

typedef struct comparison {
    motus_archive *file;
    const csv *plan;
    run_columns columns;
    double **ours, **its; /* rooms for a computed row, and for a block of the file */
    size_t block;
    uint64_t rows, wanted;
    bool same;
    char *where;
    stop_progress *progress;
} comparison;

static void tell(comparison *c, size_t k, size_t i, double its, double ours)
{
    char a[DECIMAL_MAX], b[DECIMAL_MAX], place[48] = "";
    if (c->columns.columns[k].width > 1) snprintf(place, sizeof place, " (number %zu of the row)", i + 1);
    snprintf(c->where, RUN_WHERE, "row %" PRIu64 ", %.80s%s: %s in the file, %s computed", c->rows,
             c->columns.columns[k].name, place, decimal(its, a), decimal(ours, b));
}

/* Reads the block of the next row. */
static motus_status read_block(comparison *c, motus_error *err)
{
    const uint64_t left = motus_archive_rows(c->file) - c->rows;
    motus_status status = MOTUS_OK;
    for (size_t k = 0; !status && k < c->columns.count; k++)
        status = motus_archive_read(c->file, k, c->rows, left < c->block ? (size_t)left : c->block, c->its[k], err);
    if (!status && c->progress && stop_progress_hook(c->progress, (double)c->rows / (double)c->wanted))
        status = fail(err, MOTUS_CANCELLED, "cancelled");
    return status;
}

static motus_status take(void *context, const double *values, motus_error *err)
{
    comparison *c = context;
    if (c->rows == c->wanted || !c->same) return ENOUGH;
    const size_t at = (size_t)(c->rows % c->block);
    const motus_status status = at == 0 ? read_block(c, err) : MOTUS_OK;
    if (status) return status;
    run_columns_put(&c->columns, c->plan, values, c->ours, 0);
    for (size_t k = 0; c->same && k < c->columns.count; k++) {
        const size_t width = c->columns.columns[k].width;
        const double *ours = c->ours[k], *its = c->its[k] + at * width;
        for (size_t i = 0; c->same && i < width; i++) {
            c->same = memcmp(ours + i, its + i, sizeof *ours) == 0;
            if (!c->same) tell(c, k, i, its[i], ours[i]);
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

static motus_status begin(comparison *c, motus_error *err)
{
    uint64_t first;
    if (!run_columns_fit(&c->columns, c->file))
        return fail(err, MOTUS_STATE, "the archive has other columns than those that its command makes");
    motus_archive_block(c->file, 0, &first, &c->block);
    c->ours = run_columns_rooms(&c->columns, 1);
    c->its = run_columns_rooms(&c->columns, c->block);
    return c->ours && c->its ? MOTUS_OK : complain_memory(err);
}

motus_status run_again_rows(const options *o, motus_archive *file, uint64_t rows, bool *same, char where[RUN_WHERE],
                            stop_progress *progress, motus_error *err)
{
    load model;
    csv plan = {0};
    motus_run *run = NULL;
    motus_run_def def;
    options quiet = *o;
    quiet.quiet = true;
    stop_progress silent = stop_progress_begin("archive", true);
    comparison c = {.file = file, .plan = &plan, .wanted = rows, .same = true, .where = where, .progress = progress};
    const motus_bars bars = o->errors ? options_bars(o) : MOTUS_BARS_NONE;
    motus_status status = load_model(&model, &quiet, err);
    if (!status) status = run_make(&quiet, &model, &silent, bars, &def, &run, err);
    if (!status) status = csv_plan(&plan, &model, &quiet, err);
    if (!status) status = run_columns_make(&c.columns, &plan, err);
    if (!status) status = begin(&c, err);
    if (!status) {
        walk_observer w = run_make_rows(&quiet, &model, run);
        w.columns = plan.columns, w.count = plan.count;
        w.take = take, w.jump = jump, w.context = &c;
        status = walk(run, motus_run_time(run), model.set.until, &w, 1, NULL, err);
        if (status == ENOUGH && !stop_requested()) status = MOTUS_OK;
        if (!status && c.same && c.rows < rows)
            status = fail(err, MOTUS_STATE, "the run of the archive's command has only %" PRIu64 " rows", c.rows);
    }
    *same = c.same;
    run_columns_drop(&c.columns, c.ours);
    run_columns_drop(&c.columns, c.its);
    run_columns_free(&c.columns);
    csv_free(&plan);
    motus_run_destroy(run);
    load_free(&model);
    return status;
}
