/* An ensemble through the public library.
 *
 * Contract: `file` is a model with one position; trajectory k has `varied` ("F", "theta(0)") set to values[k], all
 * else as the model says; `steps` steps of `step` by `method` on `threads` threads. x[k] and v[k] receive the final
 * state (v at the time of x). Returns the seconds of the call that computes it, without reading and compiling the
 * model, or NaN where that fails.
 */
#include "bench/bench.h"
#include "motus.h"

#include <math.h>
#include <stdlib.h>

double ours_ensemble(const char *file, const char *method, int64_t steps, double step, const char *varied,
                     const double *values, size_t count, double *x, double *v, int threads)
{
    motus_error error = motus_default_error();
    motus_text_def text = motus_default_text();
    motus_ensemble_def def = motus_default_ensemble();
    motus_system *system = NULL;
    motus_ensemble *ensemble = NULL;
    /* columns: t, the position, the velocity */
    const motus_record records[2] = {{MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_FINAL, 2}};
    double *const results[2] = {x, v};
    double took = NAN;
    char *words = read_text(file);
    text.text = words;
    def.vary = &varied;
    def.vary_count = 1;
    def.records = records;
    def.record_count = 2;
    def.method = method;
    def.step = step;
    def.until = (double)steps * step;
    def.machine = "compiled";
    def.threads = threads;
    if (words && !motus_system_from_text(&text, &system, &error) &&
        !motus_ensemble_create(system, &def, &ensemble, &error)) {
        double start = now();
        motus_status status = motus_ensemble_run(ensemble, count, &values, results, NULL, &error);
        if (!status) took = now() - start;
    }
    if (isnan(took)) report_note("%s: %s", file, words ? error.message : "cannot be read");
    motus_ensemble_destroy(ensemble);
    motus_system_destroy(system);
    free(words);
    return took;
}
