/* Brouwer's law: where nothing but rounding is left, and rounding has no bias, the energy errs like a random walk, as
 * the square root of time; a bias gives the power 1. The outer solar system over a million steps, from many starts. */
#include "bench/bench.h"
#include "motus.h"

#include <math.h>
#include <stdlib.h>

enum { STARTS = 32, TIMES = 6, COUNT = STARTS * TIMES };
static const double WITHIN = 0.1;
/* The first is the one that the others are compared with. Fewer steps than the second would show the rounding of the
 * energy's own formula. */
static const double steps_at[TIMES] = {1, 10000, 31623, 100000, 316228, 1000000};

typedef struct energies {
    double d[COUNT], until[COUNT], energy[COUNT];
    double rms[TIMES]; /* of the relative change since the first time, over the starts */
} energies;

/* Start s at time k is trajectory k STARTS + s. */
static bool measure_energies(const char *method, double step, energies *e)
{
    static const char *const varied[] = {"d", "until"};
    const double *const values[] = {e->d, e->until};
    double *const results[] = {e->energy};
    motus_error error = motus_default_error();
    motus_text_def text = motus_default_text();
    motus_ensemble_def def = motus_default_ensemble();
    motus_system *system = NULL;
    motus_ensemble *ensemble = NULL;
    motus_record record = {MOTUS_REDUCE_FINAL, 0};
    size_t numbers;
    char *words = read_text("bench/solar-at-rest.motus");
    for (int i = 0; i < COUNT; i++) {
        e->d[i] = 1e-4 * (i % STARTS);
        e->until[i] = step * steps_at[i / STARTS];
    }
    text.text = words;
    def.machine = "auto";
    def.vary = varied, def.vary_count = 2;
    def.records = &record, def.record_count = 1;
    def.method = method, def.step = step;
    const bool ran = words && !motus_system_from_text(&text, &system, &error) &&
                     !motus_column_find(system, "energy", &record.column, &numbers, &error) &&
                     !motus_ensemble_create(system, &def, &ensemble, &error) &&
                     !motus_ensemble_run(ensemble, COUNT, values, results, NULL, &error);
    if (!ran) report_note("%s: %s", method, words ? error.message : "the model cannot be read");
    motus_ensemble_destroy(ensemble);
    motus_system_destroy(system);
    free(words);
    return ran;
}

/* The power of time by least squares in logarithms, all of the times having the same weight. */
static double power_of(energies *e)
{
    double x = 0, y = 0, xx = 0, xy = 0;
    for (int k = 1; k < TIMES; k++) {
        double square = 0;
        for (int s = 0; s < STARTS; s++) {
            const double first = e->energy[s], off = (e->energy[k * STARTS + s] - first) / first;
            square += off * off / STARTS;
        }
        e->rms[k] = sqrt(square);
        const double lx = log(steps_at[k]), ly = log(e->rms[k]);
        x += lx, y += ly, xx += lx * lx, xy += lx * ly;
    }
    const double n = TIMES - 1;
    return (n * xy - x * y) / (n * xx - x * x);
}

static void compare_one(const char *method, double step)
{
    energies *e = calloc(1, sizeof *e);
    if (e && measure_energies(method, step, e)) {
        const double power = power_of(e);
        char name[100];
        report_text("  %s, steps of %g days: energy off by\n     ", method, step);
        for (int k = 1; k < TIMES; k++) report_text(" %.1e", e->rms[k]);
        report_text("\n");
        snprintf(name, sizeof name, "  grows with this power of time, off 0.5 by");
        report_error(name, fabs(power - 0.5), power, WITHIN);
    }
    free(e);
}

void compare_energy(void)
{
    report_section("Energy of the outer solar system: root mean square of 32 starts", "10^4, 10^4.5 … 10^6 steps");
    compare_one("radau15-fixed", 50);
    compare_one("kahan-li8", 50);
}
