/* What the experiments share: progress, runs along a grid, and the size of a motion.
 *
 * Invariant: a study owns no run between calls; each walk creates its run and destroys it.
 */
#include "study.h"
#include <float.h>
#include <math.h>
#include <string.h>
#include <time.h>

#define PROGRESS_SECONDS 0.01    /* between two calls of the progress hook */
#define EVALUATION_OVERHEAD 16.0 /* of an evaluation itself, in numbers of the state */
#define SOLVE_PASSES 4.0         /* evaluations for each stage that is solved */
#define SOLVE_FLOPS 3e4          /* operations of elimination that take as long as an evaluation */
#define AT_REST 1e-10            /* a group that moves less than this part of its size is at rest */

double study_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double study_processor_seconds(void)
{
#ifdef CLOCK_THREAD_CPUTIME_ID
    struct timespec now;
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0) return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
#endif
    return study_seconds();
}

double study_evaluations(const motus_method *m, double steps)
{
    return steps * (m->evaluations > 0 ? m->evaluations : SOLVE_PASSES * m->stages);
}

double study_work(const study *s, const motus_method *m, double steps, double evaluations)
{
    double numbers = (double)s->numbers, unknowns = numbers * m->stages;
    if (evaluations < 0) evaluations = study_evaluations(m, steps);
    /* A solve needs a Jacobian, which is one evaluation a column, and its elimination. */
    if (m->evaluations == 0) evaluations += steps * (numbers + unknowns * unknowns * unknowns / SOLVE_FLOPS);
    return evaluations * (numbers + EVALUATION_OVERHEAD);
}

double study_larger(double a, double b) { return isnan(a) || isnan(b) ? NAN : a > b ? a : b; }

bool study_fatal(motus_status status) { return status == MOTUS_CANCELLED || status == MOTUS_MEMORY; }

void study_note(study *s, motus_status status) { s->out_of_memory = s->out_of_memory || status == MOTUS_MEMORY; }

motus_status study_broken(const study *s)
{
    if (s->cancelled) return MOTUS_CANCELLED;
    return s->out_of_memory ? fail(s->err, MOTUS_MEMORY, "%s", motus_status_text(MOTUS_MEMORY)) : MOTUS_OK;
}

motus_status study_tell(study *s, motus_status status, const motus_error *e)
{
    if (s->err && !s->cancelled) motus_struct_write(MOTUS_DEF_ERROR, e, s->err);
    return s->cancelled ? MOTUS_CANCELLED : status;
}

void study_drop(void *result, motus_allocator allocator) { give(&allocator, result); }

/* Progress ------------------------------------------------------------------------------------------------------- */

void study_part(study *s, double base, double span)
{
    s->base = base;
    s->span = span;
}

static motus_status tick(study *s, double fraction)
{
    if (!s->progress || s->cancelled) return s->cancelled ? MOTUS_CANCELLED : MOTUS_OK;
    double now = study_seconds();
    if (s->called >= 0 && now - s->called < PROGRESS_SECONDS) return MOTUS_OK;
    s->called = now;
    /* A part that is repeated with a shorter step does not set progress back. */
    s->reached = fmin(1, fmax(s->reached, s->base + s->span * fraction));
    s->cancelled = s->progress(s->context, s->reached) != 0;
    if (!s->cancelled) return MOTUS_OK;
    return fail(s->err, MOTUS_CANCELLED, "%s", motus_status_text(MOTUS_CANCELLED));
}

/* Returns whether the present walk has cost more than its limit. */
static bool over(const study *s)
{
    return s->limit > 0 && s->walking && (double)motus_run_now(s->walking).evaluations > s->limit;
}

static int hook(void *context, double fraction)
{
    study *s = context;
    return tick(s, fraction) != MOTUS_OK || over(s);
}

/* Opening -------------------------------------------------------------------------------------------------------- */

motus_status study_read(const motus_study_def *given, motus_study_def *def, motus_error *err)
{
    motus_status status = motus_struct_read(MOTUS_DEF_STUDY, given, def, err);
    if (status != MOTUS_OK) return status;
    if (!isnan(def->step) && !(def->step > 0 && def->step < INFINITY)) {
        fail(err, MOTUS_ARGUMENT, "the step of the study is %g", def->step);
        hint(err, "a step is a positive number");
        return MOTUS_ARGUMENT;
    }
    if (isinf(def->until)) {
        fail(err, MOTUS_ARGUMENT, "the study has no end");
        hint(err, "a study ends at a finite time");
        return MOTUS_ARGUMENT;
    }
    if (!(def->tolerance >= 0 && def->tolerance < INFINITY)) {
        fail(err, MOTUS_ARGUMENT, "the tolerance of the study is %g", def->tolerance);
        hint(err, "a tolerance is 0 or a positive number");
        return MOTUS_ARGUMENT;
    }
    if (def->evaluations < 0) {
        fail(err, MOTUS_ARGUMENT, "the number of evaluations is %lld", (long long)def->evaluations);
        hint(err, "0 compares at equal step, a positive number at equal work");
        return MOTUS_ARGUMENT;
    }
    return MOTUS_OK;
}

motus_status study_settings(motus_system *system, const motus_study_def *def, motus_settings *set, motus_error *err)
{
    motus_run_def run = motus_default_run();
    *set = motus_default_settings();
    run.method = STUDY_SIMPLEST; /* the model's own method need not be among those that are studied */
    run.step = def->step;
    run.until = def->until;
    return motus_run_settings(system, &run, set, err);
}

static void find_groups(study *s)
{
    size_t variables = motus_variable_count(s->system);
    s->groups = 2 * (variables + 1);
    for (size_t k = 0; k < s->numbers; k++) {
        motus_column c = motus_default_column();
        size_t variable = variables;
        if (motus_column_at(s->system, k + 1, &c) == MOTUS_OK && c.variable < variables) variable = c.variable;
        s->group[k] = 2 * variable + (k >= s->nx);
    }
}

/* Refuses a callback that reads the velocity though its definition denies it: every run would fail. */
static motus_status refuse_undeclared(motus_run *trial, motus_error *err)
{
    motus_error e = motus_default_error();
    if (motus_run_step(trial, 1, &e) != MOTUS_CALLBACK || e.returned) return MOTUS_OK;
    if (err) motus_struct_write(MOTUS_DEF_ERROR, &e, err);
    return MOTUS_CALLBACK;
}

motus_status study_open(study *s, motus_system *system, const motus_study_def *def, const motus_settings *set,
                        double step, motus_error *err)
{
    *s = (study){.system = system,
                 .err = err,
                 .progress = def->progress,
                 .context = def->context,
                 .machine = def->machine,
                 .called = -1,
                 .span = 1};
    s->allocator = motus_system_allocator(system);
    s->nx = motus_positions(system);
    s->nv = motus_velocities(system);
    s->numbers = s->nx + s->nv;
    s->from = set->from;
    s->until = set->until;
    if (isnan(s->until)) {
        fail(err, MOTUS_ARGUMENT, "the study has no end: neither its definition nor the model gives one");
        hint(err, "give the definition an end; motus_suggest finds one");
        return MOTUS_ARGUMENT;
    }

    size_t groups = 2 * (motus_variable_count(system) + 1);
    s->start = take(s->allocator, s->numbers, sizeof(double));
    s->scale = take(s->allocator, s->numbers, sizeof(double));
    s->group = take(s->allocator, s->numbers, sizeof(size_t));
    s->work = take(s->allocator, s->numbers + groups, 2 * sizeof(double));
    if (!s->start || !s->scale || !s->group || !s->work)
        return fail(err, MOTUS_MEMORY, "out of memory for a state of %zu numbers", s->numbers);
    find_groups(s);

    /* A trial run tells the start, so that the model's rules about it are in one place. */
    motus_run *run = NULL;
    double trial = step > 0 ? step : fabs(s->until - s->from) / 64;
    if (!(trial > 0)) trial = 1;
    motus_status status = study_run(s, STUDY_SIMPLEST, trial, NAN, s->until, NULL, &run, err);
    if (status == MOTUS_OK) status = study_state(s, run, s->start, err);
    if (status == MOTUS_OK) {
        s->from = motus_run_time(run);
        s->total = motus_run_now(run).steps_total;
        s->last_step = motus_run_now(run).shorter_last;
    }
    if (status == MOTUS_OK) status = refuse_undeclared(run, err);
    motus_run_destroy(run);
    if (status == MOTUS_OK && s->from == s->until) {
        fail(err, MOTUS_ARGUMENT, "the motion from %g until %g has no length", s->from, s->until);
        hint(err, "let the study end at another time than it starts");
        return MOTUS_ARGUMENT;
    }
    if (status == MOTUS_OK) status = tick(s, 0);
    return status;
}

void study_close(study *s)
{
    if (!s->allocator) return;
    give(s->allocator, s->work);
    give(s->allocator, s->group);
    give(s->allocator, s->scale);
    give(s->allocator, s->start);
}

bool study_adapts(const char *method)
{
    const motus_method *card = NULL;
    return motus_method_find(method, &card, NULL) == MOTUS_OK && card->adaptive;
}

bool study_admits(study *s, const char *method)
{
    motus_status status = motus_method_admits(s->system, method, NULL);
    study_note(s, status);
    return status == MOTUS_OK;
}

motus_status study_methods(study *s, const motus_study_def *def, bool adaptive, const char ***names, size_t *count)
{
    bool all = !def->methods || def->method_count == 0;
    size_t most = all ? motus_method_count() : def->method_count;
    *count = 0;
    *names = take(s->allocator, most, sizeof **names);
    if (!*names) return fail(s->err, MOTUS_MEMORY, "out of memory for the names of %zu methods", most);
    for (size_t k = 0; k < most; k++) {
        const motus_method *m = NULL;
        if (all) {
            m = motus_method_at(k);
            /* The other methods are compared with the exact motion. */
            if (m->order > 0 && (adaptive || !m->adaptive) && study_admits(s, m->name)) (*names)[(*count)++] = m->name;
            continue;
        }
        motus_status status = motus_method_find(def->methods[k], &m, s->err);
        if (status != MOTUS_OK) return status;
        if (m->adaptive && !adaptive) {
            fail(s->err, MOTUS_UNAVAILABLE, "%s chooses its steps, and this comparison gives all methods one step",
                 m->name);
            hint(s->err, "motus_rank compares what adaptive methods need for an accuracy");
            return MOTUS_UNAVAILABLE;
        }
        (*names)[(*count)++] = def->methods[k];
    }
    if (study_broken(s) != MOTUS_OK) return study_broken(s);
    if (*count == 0) {
        fail(s->err, MOTUS_METHOD, "no method admits this model");
        hint(s->err, "motus check, or motus_method_admits, says why each does not");
        return MOTUS_METHOD;
    }
    return MOTUS_OK;
}

/* Runs ----------------------------------------------------------------------------------------------------------- */

motus_status study_run(study *s, const char *method, double step, double start, double until, const double *y,
                       motus_run **run, motus_error *err)
{
    motus_run_def def = motus_default_run();
    def.method = method;
    if (study_adapts(method))
        def.tolerance = s->tolerance;
    else
        def.step = step;
    def.until = until;
    def.machine = s->machine;
    def.switches = s->locate ? MOTUS_SWITCHES_RESOLVE : MOTUS_SWITCHES_STEP;
    if (y) {
        def.start = start;
        def.x = y;
        def.v = y + s->nx;
    }
    if (s->progress || s->limit > 0) {
        def.progress = hook;
        def.context = s;
    }
    return motus_run_create(s->system, &def, run, err);
}

study_grid study_grid_of(const study *s, double step, int64_t total, double last_step, int64_t *per)
{
    int64_t full = total - (last_step > 0);
    int64_t most = (int64_t)(STUDY_NUMBERS_MAX / s->numbers);
    most = most > 2 * STUDY_SAMPLES ? 2 * STUDY_SAMPLES : most < 2 ? 2 : most;
    for (*per = 1; full / *per >= most;) *per *= 2;
    study_grid g = {.from = s->from, .until = s->until, .interval = step * (double)*per};
    g.intervals = (size_t)(full / *per);
    g.points = g.intervals + (full % *per != 0 || last_step > 0 || full == 0);
    return g;
}

motus_status study_state(study *s, motus_run *run, double *y, motus_error *err)
{
    return motus_run_state(run, y, y + s->nx, err);
}

motus_status study_walk(study *s, const char *method, const study_grid *g, int64_t per, const double *from, double *out,
                        study_cost *cost, motus_error *err)
{
    motus_run *run = NULL;
    size_t done = 0;
    *cost = (study_cost){.jump = STUDY_NO_JUMP};
    motus_status status = tick(s, 0);
    if (status == MOTUS_OK)
        status = study_run(s, method, g->interval / (double)per, from ? g->from : NAN, g->until, from, &run, err);
    s->walking = run;
    for (; status == MOTUS_OK && done < g->points; done++) {
        double began = study_seconds();
        /* motus_run_finish makes the last time equal to `until` to the bit. */
        status = done + 1 == g->points ? motus_run_finish(run, err) : motus_run_step(run, per, err);
        cost->seconds += study_seconds() - began;
        if (status == MOTUS_OK) status = study_state(s, run, out + done * s->numbers, err);
        if (status == MOTUS_OK && over(s)) status = MOTUS_CANCELLED;
        if (status != MOTUS_OK) break;
    }
    cost->over = over(s); /* so that the result is equal on every machine, whenever the hook was called */
    s->walking = NULL;
    if (cost->over && !s->cancelled) status = MOTUS_SOLVE;
    for (size_t k = done * s->numbers; k < g->points * s->numbers; k++) out[k] = NAN;
    if (run) {
        cost->steps = motus_run_steps(run);
        const motus_run_statistics did = motus_run_now(run);
        cost->evaluations = did.evaluations;
        cost->jump = (study_jump){did.jump, did.jump_time, did.jump_rounding, did.jump_power};
        s->locatable = did.switches >= 0;
    }
    motus_run_destroy(run);
    return s->cancelled ? MOTUS_CANCELLED : status;
}

motus_status study_leg(study *s, const char *method, double step, double from, double until, double *y, int64_t *spent,
                       motus_error *err)
{
    motus_run *run = NULL;
    motus_status status = study_run(s, method, step, from, until, y, &run, err);
    s->walking = run;
    if (status == MOTUS_OK) status = motus_run_finish(run, err);
    if (status == MOTUS_OK) status = study_state(s, run, y, err);
    if (run) *spent += motus_run_now(run).evaluations;
    if (over(s) && !s->cancelled) status = MOTUS_SOLVE;
    s->walking = NULL;
    motus_run_destroy(run);
    return s->cancelled ? MOTUS_CANCELLED : status;
}

/* The size of a motion ------------------------------------------------------------------------------------------- */

void study_scale(study *s, const double *rows, size_t count)
{
    double *most = s->work, *least = most + s->numbers, *moves = least + s->numbers, *size = moves + s->groups;
    memcpy(most, s->start, s->numbers * sizeof(double));
    memcpy(least, s->start, s->numbers * sizeof(double));
    for (size_t r = 0; r < count; r++)
        for (size_t k = 0; k < s->numbers; k++) {
            double y = rows[r * s->numbers + k];
            most[k] = y > most[k] ? y : most[k]; /* false for NaN */
            least[k] = y < least[k] ? y : least[k];
        }
    for (size_t g = 0; g < s->groups; g++) moves[g] = size[g] = 0;
    for (size_t k = 0; k < s->numbers; k++) {
        size_t g = s->group[k];
        moves[g] = fmax(moves[g], most[k] - least[k]);
        size[g] = fmax(size[g], fmax(fabs(most[k]), fabs(least[k])));
    }
    s->noise = DBL_EPSILON;
    s->magnitude = 0;
    for (size_t g = 0; g < s->groups; g++) {
        s->magnitude = fmax(s->magnitude, size[g]);
        if (!(moves[g] > AT_REST * size[g])) moves[g] = size[g] > 0 ? size[g] : 1;
        s->noise = fmax(s->noise, DBL_EPSILON * size[g] / moves[g]);
    }
    for (size_t k = 0; k < s->numbers; k++) s->scale[k] = moves[s->group[k]];
}

study_distance study_measure(const study *s, const double *p, const double *q)
{
    study_distance d = {0, 0, 0};
    for (size_t k = 0; k < s->numbers; k++) {
        double e = fabs(p[k] - q[k]);
        double *part = k < s->nx ? &d.x : &d.v;
        *part = study_larger(*part, e);
        d.scaled = study_larger(d.scaled, e / s->scale[k]);
    }
    return d;
}

study_errors study_errors_of(const study *s, const double *p, const double *q)
{
    const double none = s->nx ? 0 : NAN;
    study_errors e = {none, none, s->nv > s->nx ? 0 : NAN};
    for (size_t k = 0; k < s->numbers; k++) {
        double *part = k < s->nx ? &e.x : k < 2 * s->nx ? &e.v : &e.s;
        *part = study_larger(*part, fabs(p[k] - q[k]));
    }
    return e;
}
