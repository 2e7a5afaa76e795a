/* motus run: one integration.
 *
 * Invariant: a run leaves all of its files or none. They have their names before anything is printed, so that a reader
 * of standard output that goes away loses none. The motion does not depend on what is recorded of it.
 */
#include "cli/files/file.h"
#include "cli/files/stop.h"
#include "cli/files/target.h"
#include "cli/model/load.h"
#include "cli/model/share.h"
#include "cli/run/csv.h"
#include "cli/run/deviation.h"
#include "cli/run/figure.h"
#include "cli/run/run.h"
#include "cli/run/smooth.h"
#include "cli/run/summary.h"
#include "cli/run/walk.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CSV, PLOT, STATE, EVENTS, FILES };

typedef struct job {
    const options *options;
    load model;
    motus_run_def def;
    motus_run *run;
    motus_estimate estimate; /* of the run's errors */
    motus_error singular;    /* status not 0: the run has passed something that its steps do not resolve */
    motus_error missed;      /* status not 0: the run has not reached its accuracy */
    stop_progress progress;
    double start, until, went_on; /* went_on: the time at which it continues a file; NaN: it begins */
    double began;                 /* when the search for the run's method and steps began; NaN: there was none */
    csv csv;
    run_archive *archive; /* NULL: the rows are not an archive */
    const char *from;     /* the archive that the run continues; NULL: the run begins */
    walk_observer rows;
    smooth smooth; /* the rows between adaptive steps */
    deviation deviation;
    figure figure;
    size_t plane[2]; /* of the section */
    file_out files[FILES];
} job;

static bool is_archive(const options *o) { return o->output && target_archive(o->output); }

static motus_status check_archive(const options *o, motus_error *err)
{
    const char *only = o->resume                     ? "--resume"
                       : o->compress                 ? "--compress"
                       : o->given[OPTION_checkpoint] ? "--checkpoint"
                                                     : NULL;
    if (only && !is_archive(o))
        return complain(err, MOTUS_ARGUMENT, "write it: -o run.h5", "%s is for a run into an archive", only);
    if (o->restart && is_archive(o))
        return complain(err, MOTUS_ARGUMENT, "the archive has its own states: motus run FILE.h5 --until T continues it",
                        "--restart: a run into an archive begins at its start");
    return MOTUS_OK;
}

/* Checks the names of files. `from` is the archive that the run continues, or NULL. */
static motus_status check_names(const options *o, const char *from, motus_error *err)
{
    const char *in[] = {from      ? from
                        : o->text ? NULL
                                  : o->operand,
                        o->restart},
               *out[FILES] = {o->output, o->plot, o->save_state, o->events};
    for (size_t i = 0; i < FILES; i++) {
        for (size_t k = 0; out[i] && k < 2; k++)
            /* --save-state may replace the file of --restart; - is both standard input and standard output */
            if (in[k] && strcmp(out[i], "-") != 0 && !(i == STATE && k == 1) && !(i == CSV && from) &&
                (file_same(out[i], in[k]) || (i == CSV && is_archive(o) && target_replaces(out[i], in[k]))))
                return fail(err, MOTUS_ARGUMENT, "%s is read and would be overwritten", in[k]);
        for (size_t k = i + 1; out[i] && k < FILES; k++)
            if (out[k] && file_same(out[i], out[k]))
                return fail(err, MOTUS_ARGUMENT, "%s is named for two outputs", out[k]);
    }
    motus_status status = check_archive(o, err);
    for (size_t i = 0; !status && i < FILES; i++) {
        const char *goes_on = i == CSV ? from : i == STATE ? o->restart : NULL; /* what may be written in its place */
        if (out[i] && !(goes_on && file_same(out[i], goes_on))) status = target_check(o, out[i], err);
    }
    if (status) return status;
    if (o->json && o->plot && strcmp(o->plot, "-") == 0)
        return fail(err, MOTUS_ARGUMENT, "--json and --plot - both write to standard output");
    if (o->save_state && strcmp(o->save_state, "-") == 0)
        return fail(err, MOTUS_ARGUMENT, "--save-state needs the name of a file");
    if (o->operand && o->restart && strcmp(o->operand, "-") == 0 && strcmp(o->restart, "-") == 0)
        return fail(err, MOTUS_ARGUMENT, "model and restart state cannot both be standard input");
    return o->plot ? plot_check(o->plot, err) : MOTUS_OK;
}

static motus_status restart(job *j, motus_error *err)
{
    char *text;
    size_t length;
    motus_status status = file_read(j->options->restart, FILE_STATE_MAX, &text, &length, err);
    if (status) return status;
    status = motus_run_restore(j->run, text, length, err);
    free(text);
    return status;
}

/* Writes the restart state: that before a shorter last step, so that the steps of a restarted run continue the
 * others. */
static motus_status save(job *j, motus_error *err)
{
    const char *text;
    size_t length;
    motus_status status = motus_run_save(j->run, &text, &length, err);
    return status ? status : file_write(&j->files[STATE], text, length, err);
}

/* Returns which errors are computed: none if no output has them. A restart state has the errors up to it. */
static motus_bars bars_wanted(const options *o)
{
    const bool seen = !o->quiet || o->json || o->errors || o->plot || o->save_state || o->events || is_archive(o);
    return seen ? options_bars(o) : MOTUS_BARS_NONE;
}

static motus_status plan_rows(job *j, motus_error *err)
{
    const motus_run_statistics now = motus_run_now(j->run);
    j->rows = run_make_rows(j->options, &j->model, j->run);
    j->rows.columns = j->csv.columns;
    j->rows.count = j->csv.count;
    j->rows.take = csv_row;
    j->rows.jump = csv_jump;
    j->rows.context = &j->csv;
    if (is_archive(j->options) || isnan(now.tolerance) || run_make_asks_rows(j->options, &j->model) ||
        !figure_smooth(now.method))
        return MOTUS_OK;
    j->rows.parts = &j->smooth.parts;
    return smooth_begin(&j->smooth, &j->model, j->run, err);
}

static motus_status open_archive(job *j, motus_error *err)
{
    const run_archive_def def = {.options = j->options,
                                 .model = &j->model,
                                 .plan = &j->csv,
                                 .run = j->run,
                                 .start = j->start,
                                 .until = j->until,
                                 .rows = &j->rows,
                                 .from = j->from};
    return run_archive_open(&j->archive, &def, err);
}

static motus_status begin(job *j, motus_error *err)
{
    const options *o = j->options;
    motus_status status = check_names(o, j->from, err);
    if (!status) status = load_model(&j->model, o, err);
    if (!status && o->output) status = csv_plan(&j->csv, &j->model, o, err);
    if (!status && o->section && o->plot) status = section_plane(&j->model, o, j->plane, err);
    if (status) return status;
    j->began = stop_clock();
    status = run_make(o, &j->model, &j->progress, bars_wanted(o), &j->def, &j->run, err);
    if (status) return status;
    if (isnan(motus_run_now(j->run).accuracy)) j->began = NAN;
    j->start = motus_run_time(j->run);
    j->until = j->model.set.until;
    status = deviation_begin(&j->deviation, &j->model, j->run, err);
    if (!status && o->restart) status = restart(j, err);
    const bool errors = j->def.error != MOTUS_BARS_NONE;
    if (!status && o->plot && !o->section)
        status = figure_begin(&j->figure, &j->model, o, j->run, j->until, errors, err);
    const char *const names[FILES] = {is_archive(o) ? NULL : o->output, o->plot, o->save_state, o->events};
    for (int i = 0; !status && i < FILES; i++)
        if (names[i]) status = file_create(&j->files[i], names[i], err);
    if (!status && o->output) status = plan_rows(j, err);
    if (!status && is_archive(o)) return open_archive(j, err);
    if (!status && o->output) status = csv_begin(&j->csv, &j->files[CSV], o, j->run, err);
    return status;
}

static motus_status go(job *j, motus_error *err)
{
    walk_observer observers[3 + FIGURE_OBSERVERS];
    walk_keeper keeper = {0};
    size_t count = 0;
    int64_t steps = motus_run_now(j->run).steps_total;
    if (j->archive) run_archive_observe(j->archive, &j->rows, &keeper);
    if (j->options->output) observers[count++] = j->rows;
    if (j->deviation.count > 0 && j->options->output && j->rows.stride > 0)
        observers[count++] = deviation_observer(&j->deviation, j->rows.stride);
    if (j->deviation.count > 0)
        observers[count++] = deviation_observer(&j->deviation, deviation_stride(&j->model, steps));
    if (j->options->plot && !j->options->section) {
        figure_observers(&j->figure, observers + count);
        count += FIGURE_OBSERVERS;
    }
    const motus_status status = motus_run_done(j->run) ? deviation_here(&j->deviation, j->run, err)
                                                       : MOTUS_OK; /* walk() would not observe it */
    return status ? status : walk(j->run, j->start, j->until, observers, count, &keeper, err);
}

static motus_status finish(job *j, double seconds, motus_error *err)
{
    const options *o = j->options;
    motus_status status = j->archive ? run_archive_finish(j->archive, err) : MOTUS_OK;
    if (!status && j->archive && j->options->compress) status = run_archive_compress(j->archive, err);
    if (!status && o->save_state) status = save(j, err);
    if (!status && o->plot && o->section)
        status = section_draw(&j->model, o, j->run, j->plane, &j->files[PLOT], err);
    else if (!status && o->plot)
        status = figure_draw(&j->figure, j->run, j->estimate.significant_until, o->plot, &j->files[PLOT], err);
    if (!status && o->events) status = event_file_write(&j->files[EVENTS], &j->model, o, j->run, err);
    for (int i = 0; !status && i < FILES; i++) status = file_finish(&j->files[i], err);
    for (int i = 0; !status && i < FILES; i++) status = file_keep(&j->files[i], err);
    summary s = {&j->model,
                 o,
                 j->run,
                 &j->deviation,
                 j->start,
                 seconds,
                 j->singular.status == MOTUS_SINGULAR ? j->singular.time : NAN,
                 j->def.error != MOTUS_BARS_NONE,
                 j->estimate,
                 &j->singular,
                 &j->missed,
                 j->from      ? j->from
                 : o->restart ? o->restart
                              : o->output,
                 j->went_on,
                 j->rows.stride,
                 j->rows.period,
                 j->archive ? run_archive_rows(j->archive) : j->csv.rows,
                 j->smooth.count > 0,
                 j->csv.jumps};
    if (j->singular.status) s.estimate.reason = j->singular.message;
    if (!status && o->json)
        status = summary_json(&s, err);
    else if (!status && !o->quiet && !(o->plot && strcmp(o->plot, "-") == 0))
        status = summary_print(&s, err);
    if (!status) status = file_flush_output(err);
    if (!status && !o->quiet && o->plot && j->figure.left_out)
        complain_note("the figure shows only some cells or panels: there are more than it has room for");
    const char *const quantity = motus_quantity_name(j->model.system, 0, NULL);
    if (!status && !o->quiet && o->plot && !o->plot_of && !o->section && quantity)
        complain_note("the figure shows no quantities; --plot-of \"%s,%s\" draws one", j->model.time, quantity);
    return status;
}

/* Looks for poles that the run has passed, with the method and the steps that were found for its accuracy. */
static motus_status look_for_poles(job *j)
{
    motus_run_def def = j->def;
    const motus_run_statistics done = motus_run_now(j->run);
    def.error = MOTUS_BARS_NONE;
    if (!isnan(done.accuracy) || done.choice[0]) {
        def.method = done.method;
        def.accuracy = NAN;
        def.step = done.step;
        def.tolerance = done.tolerance;
        def.absolute = done.absolute;
    }
    return motus_run_singular(j->model.system, &def, &j->singular);
}

static motus_status emit(const options *o, motus_error *err)
{
    load model;
    motus_status status = load_model(&model, o, err);
    motus_run_def def = run_make_asked(o);
    def.accuracy = NAN; /* else trials would search for its tolerance */
    const char *text = status ? NULL : motus_run_text(model.system, &def, err);
    if (!status && !text) status = err->status;
    if (text) {
        fputs(text, stdout);
        status = file_flush_output(err);
    }
    load_free(&model);
    return status;
}

static motus_status run(const options *o, const char *from, motus_error *err)
{
    job j = {.options = o,
             .from = from,
             .estimate = motus_default_estimate(),
             .singular = motus_default_error(),
             .missed = motus_default_error()};
    bool whole = false, finished = false;
    motus_status status = begin(&j, err);
    if (!status) {
        j.went_on = from || o->resume || o->restart ? motus_run_time(j.run) : NAN;
        j.progress = stop_progress_begin("run", o->quiet);
        const double began = isnan(j.began) ? stop_clock() : j.began;
        status = go(&j, err);
        whole = !status;
        if (!status && j.def.error != MOTUS_BARS_NONE) status = motus_run_estimate(j.run, &j.estimate, err);
        double seconds = fmax(0, stop_clock() - began - j.estimate.seconds); /* without the time of companions */
        stop_progress_end(&j.progress);
        if (!status && look_for_poles(&j) == MOTUS_MEMORY) *err = j.singular, status = MOTUS_MEMORY;
        if (!status) j.missed.status = motus_run_step(j.run, 0, &j.missed);
        if (!status) status = finish(&j, seconds, err);
        finished = !status;
        if (!status && j.singular.status) *err = j.singular, status = j.singular.status;
        if (!status && j.missed.status) *err = j.missed, status = j.missed.status;
    }
    if (status && !finished) run_archive_leave(j.archive, whole);
    for (int i = 0; i < FILES; i++) file_drop(&j.files[i]);
    figure_free(&j.figure);
    deviation_free(&j.deviation);
    csv_free(&j.csv);
    smooth_free(&j.smooth);
    run_archive_close(j.archive);
    motus_run_destroy(j.run);
    load_free(&j.model);
    return status;
}

/* Continues the run of an archive. */
static motus_status go_on(const options *o, motus_error *err)
{
    run_command c;
    motus_status status = run_command_read(&c, o, err);
    if (!status) status = run(&c.options, o->operand, err);
    run_command_free(&c);
    return status;
}

motus_status run_verb(const options *o, motus_error *err)
{
    if (o->operand && target_archive(o->operand)) return go_on(o, err);
    if (o->emit_c) return emit(o, err);
    if (o->share) return share_verb(o, err);
    return run(o, NULL, err);
}
