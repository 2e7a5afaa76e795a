/* Adaptive runs and ensembles through the public API: read, created and compiled outside the clock. */
#include "bench/bench.h"
#include "bench/problems.h"
#include "motus.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double LONG = 1.5; /* seconds of the processor, of which a compiler beside gets as many */

/* Lets a long run get the object that long runs get, and the cache keep it. */
void ours_prepare(const char *file, const problem *p, const char *method, double tolerance)
{
    motus_text_def text = motus_default_text();
    motus_run_def def = motus_default_run();
    motus_system *system = NULL;
    motus_run *run = NULL;
    char *words = read_text(file);
    text.text = words;
    def.method = method, def.machine = "compiled", def.tolerance = tolerance;
    def.until = 1e6 * p->until, def.x = p->start, def.v = p->start + p->positions;
    const double begin = thread_seconds();
    if (words && !motus_system_from_text(&text, &system, NULL) && !motus_run_create(system, &def, &run, NULL))
        while (thread_seconds() - begin < LONG && !motus_run_step(run, 1000, NULL)) continue;
    motus_run_destroy(run);
    motus_system_destroy(system);
    free(words);
}

/* The state of a model is in the order of its families, as that of the problem is. */
ours_answer ours_adaptive(const char *file, const problem *p, const char *method, double tolerance, double *state)
{
    motus_error error = motus_default_error();
    motus_text_def text = motus_default_text();
    motus_run_def def = motus_default_run();
    motus_system *system = NULL;
    motus_run *run = NULL;
    char *words = read_text(file);
    ours_answer answer = {NAN, NAN, 0};
    text.text = words;
    def.method = method, def.machine = "compiled", def.tolerance = tolerance;
    def.until = p->until, def.x = p->start, def.v = p->start + p->positions;
    const double begin = now();
    if (!words || motus_system_from_text(&text, &system, &error) || motus_run_create(system, &def, &run, &error)) {
        report_note("%s: %s", file, words ? error.message : "cannot be read");
    } else {
        answer.created = now() - begin;
        const double from = thread_seconds();
        const motus_status status = motus_run_finish(run, &error);
        if (!status) answer.seconds = thread_seconds() - from;
        answer.steps = motus_run_steps(run);
        motus_run_state(run, state, state + p->positions, NULL);
    }
    motus_run_destroy(run);
    motus_system_destroy(system);
    free(words);
    return answer;
}

double ours_pendulums(const char *file, const char *method, double tolerance, size_t count, const double *F,
                      const double *theta, double *x, double *v)
{
    static const char *const varied[] = {"F", "theta(0)"};
    /* columns: t, the position, the velocity */
    const motus_record records[2] = {{MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_FINAL, 2}};
    const double *const values[] = {F, theta};
    double *const results[] = {x, v};
    motus_error error = motus_default_error();
    motus_text_def text = motus_default_text();
    motus_ensemble_def def = motus_default_ensemble();
    motus_system *system = NULL;
    motus_ensemble *ensemble = NULL;
    char *words = read_text(file);
    double took = NAN;
    text.text = words;
    def.vary = varied, def.vary_count = 2;
    def.records = records, def.record_count = 2;
    def.method = method, def.tolerance = tolerance, def.machine = "compiled", def.threads = 1;
    if (words && !motus_system_from_text(&text, &system, &error) &&
        !motus_ensemble_create(system, &def, &ensemble, &error)) {
        const double start = thread_seconds();
        const motus_status status = motus_ensemble_run(ensemble, count, values, results, NULL, &error);
        if (!status) took = thread_seconds() - start;
    }
    if (isnan(took)) report_note("%s: %s", file, words ? error.message : "cannot be read");
    motus_ensemble_destroy(ensemble);
    motus_system_destroy(system);
    free(words);
    return took;
}
