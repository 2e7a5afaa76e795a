/* motus sweep: one model, many trajectories.
 *
 * Invariant: only one batch of trajectories is in memory, however many there are; its rows are written before the next
 * batch begins. No file is touched before the request has been checked.
 */
#include "cli/sweep/sweep.h"

#include "cli/files/file.h"
#include "cli/files/stop.h"
#include "cli/model/settle.h"
#include "cli/run/csv.h"
#include "cli/run/walk.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static motus_status read_every(sweep *s, motus_error *err)
{
    const options *o = s->options;
    bool sampled = false;
    for (size_t k = 0; k < s->records.count; k++) sampled |= s->records.items[k].how != MOTUS_REDUCE_FINAL;
    if (o->given[OPTION_every] && !sampled && !o->text) /* an archive may have such a command */
        return complain(err, MOTUS_ARGUMENT, "add such a one: --record \"max(x)\"",
                        "--every: no min, max or mean is recorded, so nothing is sampled");
    s->every = o->every.steps > 0 ? o->every.steps : 1;
    if (o->every.time > 0 && isnan(s->step))
        return complain(err, MOTUS_ARGUMENT, "a sweep samples at steps: give --every \"10 steps\"",
                        "--every %g: this is a time, and the steps of the method have no one size", o->every.time);
    if (o->every.time > 0) {
        s->every = walk_steps_of(o->every.time, s->step);
        if (s->every <= 0)
            return complain(err, MOTUS_ARGUMENT,
                            "a sweep samples at steps: give a multiple of the step, or --every \"10 steps\"",
                            "--every %g: this is not a multiple of the step %g", o->every.time, s->step);
    }
    return MOTUS_OK;
}

/* Creates the ensemble. `def` has what the sweep asks of its trajectories, and what varies. */
static motus_status create(sweep *s, motus_ensemble_def *def, stop_progress *progress, motus_error *err)
{
    const options *o = s->options;
    def->records = s->records.items;
    def->record_count = sweep_kept(s);
    def->every = s->every;
    def->threads = o->threads || !o->team ? (int)o->threads : o->team->threads;
    def->lanes = (int)o->lanes;
    def->fast = o->fast;
    def->error = s->errors ? options_bars(o) : MOTUS_BARS_NONE;
    def->expected = s->grid.total / s->shard.count + 1; /* about: the size of blocks is not known yet */
    def->events = o->events || (o->plot && o->section);
    def->event_columns = s->event_columns;
    def->event_column_count = s->event_columns_count + s->event_columns_more;
    def->causes = 1;
    def->progress = stop_progress_hook;
    def->context = progress;
    return motus_ensemble_create(s->model.system, def, &s->ensemble, err);
}

/* Lets the ensemble choose by the trajectories that are furthest apart, so that all shards choose alike. */
static motus_status lead_pilots(const sweep *s, motus_error *err)
{
    double **values;
    size_t rows;
    motus_status status = grid_extremes(&s->grid, &values, &rows, err);
    if (!status) status = motus_ensemble_pilots(s->ensemble, rows, (const double *const *)values, err);
    grid_extremes_free(values);
    return status;
}

/* Prints once why no faster machine runs the sweep, when that is known. */
static void note_machine(sweep *s)
{
    const motus_ensemble_statistics now = motus_ensemble_now(s->ensemble);
    if (s->noted || s->options->quiet || !now.note[0]) return;
    s->noted = true;
    complain_note("the %s runs this: %s", strcmp(now.machine, "interpreter") == 0 ? "interpreter" : "compiled machine",
                  now.note);
}

/* Checks all ends that vary, before a file is touched. */
static motus_status check_ends(const sweep *s, motus_error *err)
{
    enum { AT_ONCE = 4096 };
    double ends[AT_ONCE];
    const size_t axis = grid_find(&s->grid, "until");
    if (axis == s->grid.count) return MOTUS_OK;
    const double **values = calloc(s->grid.count, sizeof *values);
    if (!values) return complain_memory(err);
    for (size_t k = 0; k < s->grid.count; k++) values[k] = ends;
    motus_status status = MOTUS_OK;
    size_t count = AT_ONCE;
    for (uint64_t first = 0; !status && count == AT_ONCE; first += AT_ONCE) {
        count = grid_axis_values(&s->grid, axis, first, AT_ONCE, ends);
        status = motus_ensemble_check(s->ensemble, count, values, err);
    }
    free(values);
    return status;
}

static motus_status check_options(const options *o, motus_error *err)
{
    if (o->threads > INT_MAX || o->lanes > INT_MAX)
        return fail(err, MOTUS_ARGUMENT, "%s is too large", o->threads > INT_MAX ? "--threads" : "--lanes");
    motus_status status = sweep_file_check(o, err);
    if (!status) status = sweep_section_check(o, err);
    return status ? status : sweep_events_check(o, err);
}

/* Checks that several processes can write the output together. */
static motus_status check_team(const options *o, motus_error *err)
{
    if (team_size(o->team) == 1) return MOTUS_OK;
    if (!o->output || !target_archive(o->output))
        return complain(err, MOTUS_ARGUMENT, "add -o FILE.h5",
                        "several processes together can write rows only to an archive");
    if (o->plot)
        return complain(err, MOTUS_ARGUMENT, "write the points, --events points.csv, and draw them from there",
                        "several processes together cannot draw a picture");
    if (!o->events || sweep_events_in_segments(o)) return MOTUS_OK;
    return complain(err, MOTUS_ARGUMENT, "--events events.csv",
                    "several processes together can write events only to a file");
}

/* Makes the ensemble and the head of the file. */
static motus_status make(sweep *s, motus_ensemble_def *def, stop_progress *progress, motus_error *err)
{
    const options *o = s->options;
    motus_status status = create(s, def, progress, err);
    if (!status) note_machine(s);
    const motus_ensemble_statistics now = motus_ensemble_now(s->ensemble);
    if (!status && !o->quiet && now.not_located[0]) complain_note("%s", now.not_located);
    if (!status) status = check_ends(s, err);
    if (!status) status = lead_pilots(s, err);
    if (status) return status;
    s->method = now.method;
    s->tolerance = now.tolerance;
    s->absolute = now.absolute;
    status = sweep_block_choose(s, &s->shard.block, err);
    if (status) return status;
    s->rows = shard_rows(&s->shard, s->grid.total);
    return sweep_head_make(s, o->output && target_npy(o->output), err);
}

motus_status sweep_begin(sweep *s, sweep_section *section, stop_progress *progress, motus_error *err)
{
    const options *o = s->options;
    motus_status status = check_options(o, err);
    if (!status) status = check_team(o, err);
    if (!status) status = load_model(&s->model, o, err);
    if (!status) status = grid_read(&s->grid, o, err);
    for (size_t k = 0; !status && o->output && k < s->grid.count; k++)
        if (s->grid.axes[k].path &&
            (file_same(s->grid.axes[k].path, o->output) || target_replaces(o->output, s->grid.axes[k].path)))
            status = fail(err, MOTUS_ARGUMENT, "%s is read and would be overwritten", s->grid.axes[k].path);
    for (size_t k = 0; !status && o->events && k < s->grid.count; k++)
        if (s->grid.axes[k].path && file_same(s->grid.axes[k].path, o->events))
            status = fail(err, MOTUS_ARGUMENT, "%s is read and would be overwritten", s->grid.axes[k].path);
    if (!status) status = sweep_records_read(&s->records, &s->model, o->record, err);
    if (!status && o->events)
        status = event_file_columns(&s->model, o, &s->event_columns, &s->event_columns_count, err);
    if (!status) status = sweep_section_plan(section, s, err);
    if (status) return status;
    const bool own_ends = grid_find(&s->grid, "until") < s->grid.count;
    if (own_ends && !isnan(o->until))
        return fail(err, MOTUS_ARGUMENT, "--until is one end for all, and --vary until one for each: leave one out");
    motus_ensemble_def def = motus_default_ensemble();
    SETTLE_ASK(&def, o);
    def.vary = s->grid.names;
    def.vary_count = s->grid.count;
    status = settle_sweep(&s->model, o, &s->grid, &def, err);
    if (status) return status;
    s->accuracy = s->model.set.accuracy;
    s->step = s->model.set.step;
    s->until = own_ends ? NAN : s->model.set.until;
    s->errors = o->errors;
    s->columns = 3 + s->grid.count + s->records.count + s->errors + s->records.ended;
    for (size_t r = 0; s->errors && r < s->records.count; r++) s->columns += sweep_record_errs(&s->records.items[r]);
    status = read_every(s, err);
    return status ? status : make(s, &def, progress, err);
}

void sweep_free(sweep *s)
{
    free(s->head);
    free(s->event_columns);
    motus_ensemble_destroy(s->ensemble);
    free(s->records.items);
    grid_free(&s->grid);
    load_free(&s->model);
    *s = (sweep){0};
}

/* Returns how many of `count` rows go up to the end of the last block that they complete; all, if they complete
 * none. */
static size_t up_to_block(uint64_t row, size_t count, uint64_t block)
{
    const size_t behind = (size_t)((row + count) % block);
    return behind < count ? count - behind : count;
}

/* Makes the error for a warning by the batch system that it will end the program; note_unfinished says how to go on. */
static motus_status warned(motus_error *err) { return fail(err, MOTUS_CANCELLED, "stopped by a signal"); }

static motus_status go(sweep *s, sweep_file *f, sweep_events *events, sweep_section *section, stop_progress *p,
                       motus_error *err)
{
    sweep_batch b = {0};
    motus_status status = sweep_batch_make(&b, s, err);
    const double total = (double)s->rows;
    p->before = (double)f->found / total;
    p->amount = total;
    p->unit = "trajectories";
    for (uint64_t left; !status && (left = sweep_file_left(f)) > 0;) {
        size_t count = left < b.count ? (size_t)left : b.count;
        if (f->archive) count = up_to_block(f->rows, count, s->shard.block);
        if (f->rows % s->shard.block == 0 && sweep_archive_given_up(f)) break; /* only between blocks */
        double began = stop_clock();
        p->from = sweep_file_done(f) / total;
        p->span = (double)count / total;
        status = sweep_batch_compute(&b, s, f->rows, count, &f->share.computing, err);
        const double computed = stop_clock();
        const sweep_rows rows = sweep_batch_rows(&b);
        note_machine(s);
        if (!status) status = sweep_events_rows(events, f->rows, count, err);
        if (!status) status = sweep_section_take(section, f->rows, count, &rows, err);
        if (!status) status = sweep_file_rows(f, count, &rows, err);
        f->share.writing += stop_clock() - computed;
        if (!status && sweep_file_left(f) > 0 && stop_progress_hook(p, 1))
            status = fail(err, MOTUS_CANCELLED, "cancelled");
        if (!status && sweep_file_left(f) > 0 && f->rows % s->shard.block == 0 && stop_warned()) status = warned(err);
        sweep_batch_adapt(&b, s, stop_clock() - began);
    }
    if (status == MOTUS_CANCELLED && f->archive && stop_warned()) status = warned(err);
    if (status) sweep_archive_give_up(f);
    sweep_batch_free(&b);
    return status;
}

/* Prints how many rows the file has, after a failure of any process. Waits for all. */
static void note_unfinished(const sweep *s, const sweep_file *f, motus_status status)
{
    const team *t = s->options->team;
    const uint64_t have = sweep_file_have(f);
    const bool refused = team_any(t, status == MOTUS_ACCURACY); /* the command would fail again */
    if (!refused && team_first(t) && f->regular && have < s->rows)
        complain_note("%llu of %llu trajectories are in %s; the same command with --resume continues",
                      (unsigned long long)have, (unsigned long long)s->rows, f->path);
}

/* Adds up what all processes have counted. */
static void add_up(const team *t, sweep_file *f)
{
    if (team_size(t) == 1) return;
    f->stopped = t->sum(t->context, f->stopped);
    f->lost = t->sum(t->context, f->lost);
    for (int k = 0; k < MOTUS_CAUSE_COUNT; k++) f->stopped_by[k] = t->sum(t->context, f->stopped_by[k]);
}

static motus_status finish(const sweep *s, sweep_file *f, sweep_events *events, sweep_section *section,
                           stop_progress *progress, double began, motus_error *err)
{
    const options *o = s->options;
    motus_status status = sweep_events_finish(events, err);
    if (!status) status = sweep_section_draw(section, err);
    if (!status) status = sweep_file_finish(f, err);
    status = team_agree(o->team, status, err);
    if (!status && team_first(o->team)) status = sweep_events_join(events, progress, err);
    if (!status && team_size(o->team) > 1 && team_first(o->team)) status = sweep_archive_look(f, err);
    if (!status && o->compress && team_first(o->team)) status = sweep_archive_compress(f, err);
    double wall = stop_clock() - began;
    status = team_agree(o->team, status, err);
    if (!status) add_up(o->team, f);
    sweep_share *all = status || !o->team || !o->json ? NULL : sweep_report_gather(o->team, &f->share);
    if (status || !team_first(o->team)) {
        free(all);
        return status;
    }
    sweep_report(s, f, wall, all);
    free(all);
    status = file_flush_output(err);
    if (!status && f->stopped > 0 && !o->quiet)
        complain_note("%llu of %llu trajectories did not reach their end: their column `stopped` has the time, and "
                      "`stopped_by` the cause if it is known",
                      (unsigned long long)f->stopped, (unsigned long long)s->rows);
    if (!status && f->lost > 0 && !o->quiet)
        complain_note("no digit is known to be significant at the end of %llu of %llu trajectories: their column "
                      "`significant` is 0",
                      (unsigned long long)f->lost, (unsigned long long)s->rows);
    return status;
}

/* Puts the number of the shard into the names of its files. The caller frees `names`. */
static motus_status name_files(const sweep *s, options *o, char *names[3], motus_error *err)
{
    const char **const given[] = {&o->output, &o->events, &o->plot};
    for (int k = 0; k < 3; k++) {
        if (!*given[k]) continue;
        names[k] = shard_file(&s->shard, *given[k]);
        if (!names[k]) return complain_memory(err);
        *given[k] = names[k];
    }
    return MOTUS_OK;
}

static motus_status open_both(sweep_file *f, const sweep *s, motus_error *err)
{
    const motus_status status = sweep_file_open(f, s, err);
    return status ? status : sweep_events_open(f->events, f->rows, err);
}

/* Opens the files: first in the first process, which makes or finds them, and then in the others. */
static motus_status open_files(sweep_file *f, const sweep *s, motus_error *err)
{
    const team *t = s->options->team;
    motus_status status = team_agree(t, team_first(t) ? open_both(f, s, err) : MOTUS_OK, err);
    if (!status && !team_first(t)) status = open_both(f, s, err);
    status = team_agree(t, status, err);
    if (status || !f->archive) return status;
    sweep_archive_begin(f);
    stop_gently(team_size(t) == 1);
    return MOTUS_OK;
}

motus_status sweep_verb(const options *o, motus_error *err)
{
    options own = *o; /* with the names of this shard's files */
    sweep s = {.options = &own};
    sweep_file f = {.descriptor = -1};
    sweep_events events = {.descriptor = -1};
    sweep_section section = {0};
    stop_progress progress = stop_progress_begin("sweep", o->quiet);
    if (o->team) progress.meanwhile = o->team->answer, progress.with = o->team->context;
    const double began = stop_clock();
    char *names[3] = {NULL};
    motus_status status = shard_read(&s.shard, o->shard, err);
    s.block = sweep_archive_block(&own);
    if (own.plot && !own.output && !own.plan) own.output = "/dev/null"; /* a picture is asked for, and no rows */
    if (!status) status = name_files(&s, &own, names, err);
    if (!status) status = sweep_begin(&s, &section, &progress, err);
    if (!status) status = sweep_events_begin(&events, &s, err);
    status = team_agree(o->team, status, err);
    if (!status && o->plan) {
        if (team_first(o->team)) status = sweep_plan(&s, &progress, err);
    } else if (!status) {
        f.events = &events;
        status = open_files(&f, &s, err);
        bool open = !status;
        progress.began = stop_clock();
        if (!status) status = sweep_section_open(&section, err);
        if (!status) status = go(&s, &f, &events, &section, &progress, err);
        stop_progress_end(&progress);
        const double done = stop_clock();
        status = team_agree(o->team, status, err);
        f.share.waiting += stop_clock() - done;
        if (!status)
            status = finish(&s, &f, &events, &section, &progress, began, err);
        else if (open)
            note_unfinished(&s, &f, status);
    }
    sweep_file_close(&f);
    sweep_events_close(&events);
    sweep_section_close(&section);
    for (int k = 0; k < 3; k++) free(names[k]);
    sweep_free(&s);
    return status;
}
