/* See bits.h. */
#include "mpi/bits.h"

#include "cli/files/command.h"

enum { TRAJECTORIES = 64 };

/* A driven pendulum with the operations in which processors and libraries could differ: functions, powers, a division,
 * a root. It is chaotic: where one differs in a last bit, in the end all digits differ. */
static const char model[] =
    "x'' = -sin(x) - 0.2 x' + 1.2 cos(2 t/3) + 1e-3 (exp(-x^2)/sqrt(2 + cos(x)) + abs(tanh(x'))^1.5)\n"
    "x(0) = 1\n"
    "x'(0) = 0\n";

motus_status bits_compute(uint64_t *hash, motus_error *err)
{
    double from[TRAJECTORIES], x[TRAJECTORIES] = {0}, v[TRAJECTORIES] = {0};
    const char *vary[] = {"x(0)"};
    const double *values[] = {from};
    double *results[] = {x, v};
    motus_record records[] = {{MOTUS_REDUCE_FINAL, 0}, {MOTUS_REDUCE_FINAL, 0}};
    size_t count;
    motus_text_def text = motus_default_text();
    motus_ensemble_def def = motus_default_ensemble();
    motus_system *system = NULL;
    motus_ensemble *ensemble = NULL;
    text.text = model;
    for (int k = 0; k < TRAJECTORIES; k++) from[k] = 0.01 * k;
    motus_status status = motus_system_from_text(&text, &system, err);
    if (!status) status = motus_column_find(system, "x", &records[0].column, &count, err);
    if (!status) status = motus_column_find(system, "x'", &records[1].column, &count, err);
    def.vary = vary, def.vary_count = 1;
    def.records = records, def.record_count = 2;
    def.method = "dop853";
    def.tolerance = 1e-9;
    def.until = 400;
    def.machine = "interpreter";
    def.threads = 1;
    if (!status) status = motus_ensemble_create(system, &def, &ensemble, err);
    if (!status) status = motus_ensemble_run(ensemble, TRAJECTORIES, values, results, NULL, err);
    *hash = COMMAND_HASH;
    command_mix(hash, x, sizeof x);
    command_mix(hash, v, sizeof v);
    motus_ensemble_destroy(ensemble);
    motus_system_destroy(system);
    return status;
}
