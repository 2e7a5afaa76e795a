/* Events through the public API: read, created and compiled outside the clock, like those of an ensemble. */
#include "bench/bench.h"
#include "motus.h"

#include <math.h>
#include <stdlib.h>

static char *open_system(const char *file, const char *when, motus_system **system, motus_error *error)
{
    motus_text_def text = motus_default_text();
    char *words = read_text(file);
    text.text = words;
    text.when = &when;
    text.when_count = when != NULL;
    if (!words || motus_system_from_text(&text, system, error))
        report_note("%s: %s", file, words ? error->message : "cannot be read");
    return words;
}

static bool last_event(motus_run *run, const motus_system *system, watched *w, motus_error *error)
{
    motus_event_row row = motus_default_event_row();
    size_t columns[2], numbers;
    if (!w->columns[0] || !w->events) return true;
    if (motus_column_find(system, w->columns[0], &columns[0], &numbers, error) ||
        motus_column_find(system, w->columns[1], &columns[1], &numbers, error) ||
        motus_run_event(run, w->events - 1, &row) ||
        motus_run_event_values(run, w->events - 1, 0, columns, 2, w->last + 1, error))
        return false;
    w->last[0] = row.time;
    return true;
}

double ours_watched(watched *w)
{
    motus_error error = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_system *system = NULL;
    motus_run *run = NULL;
    char *words = open_system(w->file, w->when, &system, &error);
    double took = NAN;
    def.method = w->method, def.machine = w->machine, def.until = w->until;
    def.tolerance = w->tolerance, def.step = w->step;
    def.switches = w->across ? MOTUS_SWITCHES_STEP : MOTUS_SWITCHES_USUAL;
    def.x = w->x, def.v = w->v;
    if (system && !motus_run_create(system, &def, &run, &error)) {
        const double start = thread_seconds();
        if (!motus_run_finish(run, &error)) took = thread_seconds() - start;
        w->steps = motus_run_steps(run);
        w->evaluations = motus_run_now(run).evaluations;
        w->events = motus_run_events(run);
        if (!last_event(run, system, w, &error)) took = NAN;
    }
    if (system && isnan(took)) report_note("%s: %s", w->file, error.message);
    motus_run_destroy(run);
    motus_system_destroy(system);
    free(words);
    return took;
}

static void take_points(const motus_ensemble *ensemble, sections *s)
{
    for (size_t k = 0; k < s->kept; k++) {
        const size_t trajectory = k * (s->count / s->kept);
        const int64_t rows = motus_ensemble_events(ensemble, trajectory);
        s->found[k] = (int)rows;
        for (int64_t i = 0; i < rows && i < SECTION_MOST; i++) {
            motus_event_row row = motus_default_event_row();
            double values[2] = {NAN, NAN};
            motus_ensemble_event(ensemble, trajectory, i, &row, values, NULL);
            s->points[k * SECTION_MOST + (size_t)i] = (section_point){row.time, values[0], values[1]};
        }
    }
}

double ours_sections(sections *s, const char *method, double tolerance, int threads)
{
    static const char *const varied[] = {"y(0)", "x'(0)", "y'(0)"};
    const double *const values[] = {s->y, s->vx, s->vy};
    motus_error error = motus_default_error();
    motus_ensemble_def def = motus_default_ensemble();
    motus_system *system = NULL;
    motus_ensemble *ensemble = NULL;
    motus_record record = {MOTUS_REDUCE_FINAL, 0};
    size_t columns[2], numbers;
    double *final = calloc(s->count, sizeof *final), took = NAN;
    double *const results[] = {final};
    char *words = open_system("models/henon-heiles.motus", "x = 0 rising: record", &system, &error);
    def.vary = varied, def.vary_count = 3;
    def.records = &record, def.record_count = 1;
    def.method = method, def.tolerance = tolerance, def.until = s->until;
    def.machine = "compiled", def.threads = threads;
    def.events = 1, def.event_columns = columns, def.event_column_count = 2;
    if (final && system && !motus_column_find(system, "y", &columns[0], &numbers, &error) &&
        !motus_column_find(system, "y'", &columns[1], &numbers, &error) &&
        !motus_ensemble_create(system, &def, &ensemble, &error)) {
        const double start = now();
        if (!motus_ensemble_run(ensemble, s->count, values, results, NULL, &error)) took = now() - start;
        take_points(ensemble, s);
    }
    if (system && isnan(took)) report_note("%s: %s", method, error.message);
    motus_ensemble_destroy(ensemble);
    motus_system_destroy(system);
    free(words);
    free(final);
    return took;
}
