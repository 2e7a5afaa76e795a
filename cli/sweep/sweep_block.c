/* How many trajectories a block of a sweep has.
 *
 * Processes share the work by blocks, and an archive keeps it by blocks, so a block should take one lane only a moment.
 * The work of a trajectory is counted: the steps of a few trajectories, over a few hundred steps, times the operations
 * of a step. A clock would choose another size on every machine, but the bytes of an archive and the division into
 * shards depend on the size.
 *
 * Invariant: the size depends only on what the numbers depend on.
 */
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"

#include <math.h>
#include <stdlib.h>

#define BLOCK_WORK 0x1p30 /* operations of a block: 0.1 s to 1 s of one processor, by the machine */
#define TRIAL_WORK 2e6    /* operations of a trial */
/* BLOCKS_MOST: of a sweep, since each block costs some memory and time. */
enum { BLOCKS_MOST = 1 << 16, TRIALS = 8, STEPS_LEAST = 8, STEPS_MOST = 256 };

/* Trajectories that are spread evenly over the sweep. */
typedef struct trials {
    size_t count;
    double *values, **of; /* TRIALS values of each axis */
    double until[TRIALS];
} trials;

static motus_status choose_trials(trials *t, const sweep *s, motus_error *err)
{
    const size_t axes = s->grid.count, own = grid_find(&s->grid, "until");
    *t = (trials){.count = s->grid.total < TRIALS ? (size_t)s->grid.total : TRIALS,
                  .values = calloc(TRIALS * axes + 1, sizeof *t->values),
                  .of = calloc(axes + 1, sizeof *t->of)};
    double **one = calloc(axes + 1, sizeof *one);
    const bool room = t->values && t->of && one;
    for (size_t k = 0; room && k < axes; k++) t->of[k] = t->values + k * TRIALS;
    for (size_t i = 0; room && i < t->count; i++) {
        for (size_t k = 0; k < axes; k++) one[k] = t->of[k] + i;
        grid_values(&s->grid, s->grid.total / t->count * i + s->grid.total / t->count / 2, 1, one);
        t->until[i] = own < axes ? t->of[own][i] : s->until;
    }
    free(one);
    return room ? MOTUS_OK : complain_memory(err);
}

/* Makes an ensemble that only counts steps, up to `most` for each trajectory. */
static motus_status make_trial(const sweep *s, int64_t most, motus_ensemble **out, motus_error *err)
{
    const motus_record steps = {MOTUS_REDUCE_STEPS, 0};
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = s->grid.names;
    def.vary_count = s->grid.count;
    def.records = &steps;
    def.record_count = 1;
    def.method = s->method;
    def.tolerance = s->tolerance;
    def.absolute = s->absolute;
    def.shortest_step = s->options->shortest_step;
    def.longest_step = s->options->longest_step;
    def.most_steps = most;
    def.until = s->until;
    def.machine = "interpreter";
    def.threads = 1;
    def.error = MOTUS_BARS_NONE;
    def.switches = MOTUS_SWITCHES_STEP;
    return motus_ensemble_create(s->model.system, &def, out, err);
}

/* Finds the mean number of steps of a trajectory, as if the steps beyond `most` were as long as those before. */
static motus_status count_steps(const sweep *s, trials *t, double start, int64_t most, double *mean, motus_error *err)
{
    double steps[TRIALS], stopped[TRIALS], *results[] = {steps};
    motus_ensemble *e = NULL;
    motus_status status = make_trial(s, most, &e, err);
    if (!status) status = motus_ensemble_run(e, t->count, (const double *const *)t->of, results, stopped, err);
    motus_ensemble_destroy(e);
    *mean = 0;
    for (size_t i = 0; !status && i < t->count; i++) {
        const double way = fabs(t->until[i] - start), gone = fabs(stopped[i] - start);
        *mean += isnan(stopped[i]) ? steps[i] : (double)most * (gone > 0 ? way / gone : way > 0 ? 1e6 : 0);
    }
    *mean /= (double)t->count;
    return status;
}

/* Estimates the operations of a trajectory. */
static motus_status work_of(const sweep *s, double *work, motus_error *err)
{
    trials t;
    const double step = motus_ensemble_step_work(s->ensemble), start = s->model.set.from;
    const int64_t most = (int64_t)fmin(STEPS_MOST, fmax(STEPS_LEAST, TRIAL_WORK / step));
    double steps = 0;
    motus_status status = choose_trials(&t, s, err);
    if (!status && isnan(s->step)) {
        /* The sweep itself will report a failure. */
        if (count_steps(s, &t, start, most, &steps, NULL) != MOTUS_OK) steps = 0;
    } else if (!status) {
        for (size_t i = 0; i < t.count; i++) steps += fabs((t.until[i] - start) / s->step) / (double)t.count;
    }
    free(t.values);
    free(t.of);
    *work = steps * step;
    return status;
}

motus_status sweep_block_choose(const sweep *s, uint64_t *block, motus_error *err)
{
    const bool cut = !shard_whole(&s->shard) || (s->options->output && target_archive(s->options->output));
    double work;
    *block = s->block ? s->block : SHARD_BLOCK;
    if (s->block || !cut) return MOTUS_OK;
    const motus_status status = work_of(s, &work, err);
    while (!status && *block > 1 && work * (double)*block > BLOCK_WORK && s->grid.total / *block < BLOCKS_MOST / 2)
        *block /= 2;
    return status;
}
