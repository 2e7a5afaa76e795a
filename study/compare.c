/* Every method side by side: motus_compare.
 *
 * Each method runs from the start to `until`, then a new run goes from there back to the start. States are compared
 * at ends of steps, so nothing is interpolated: at equal step all methods share these times; at equal work each has
 * its own, and the reference solution is computed at them. Invariant: the result is one allocation; a row whose
 * method failed has its status and note, and NaN for what was not measured.
 */
#include "probe.h"
#include "remarks.h"
#include "trend.h"
#include "base/decimal.h"
#include <float.h>
#include <math.h>
#include <stdio.h>

#define SAMPLES_MAX 2048 /* of the invariants along one run */
#define REMARKS_MAX 4096
#define NAME_MAX_LONG 128
#define WORK_TRIES 4        /* to find the step that spends the wanted evaluations */
#define WORK_CLOSE 0.02     /* relative: near enough to the wanted evaluations */
#define PROBES 5            /* states along the motion at which properties of the equations are measured */
#define REFERENCE_SHARE 0.1 /* of the progress */
#define ROUNDING 8.0 /* ulps by which an evaluation may round the state; over the run they add up as a random walk */

typedef struct row_text {
    char method[MOTUS_NAME_MAX], note[MOTUS_TEXT_MAX];
} row_text;
typedef struct invariant_name {
    char text[NAME_MAX_LONG];
} invariant_name;

typedef struct result {
    motus_comparison seen; /* first, since it is the handle the user holds */
    motus_allocator allocator;
    char reference[SOLUTION_TEXT_MAX], remarks[REMARKS_MAX];
    motus_compare_row *rows;
    motus_drift *drifts;                /* rows × invariants */
    const motus_compare_row **row_list; /* pointers to the rows, for the user */
    const motus_drift **drift_list;
    row_text *texts;
    invariant_name *names;
} result;

typedef struct compare {
    study s;
    motus_study_def def;
    solution reference;
    double step; /* of equal steps */
    size_t invariants, columns;
    size_t *first; /* invariants + 1: where each invariant begins in `column` */
    size_t *column;
    double *column_scale;
    double *t, *deviation; /* t: times; deviation: the change of one number since the start; samples_max of each */
    double *series;        /* samples_max × columns */
    size_t samples, samples_max;
    double *y, *a, *own_reference;
    double *roundoff; /* rows × invariants */
    remarks_fact *facts;
    const char **methods;
    size_t count;
    size_t axis;
    double acceleration, rate;
    motus_analysis analysis;
    result *out;
} compare;

/* Memory --------------------------------------------------------------------------------------------------------- */

static motus_status no_memory(compare *c, const char *what)
{
    return fail(c->s.err, MOTUS_MEMORY, "out of memory for %s", what);
}

static motus_status make_result(compare *c)
{
    size_t rows = study_aligned(c->count * sizeof(motus_compare_row)),
           texts = study_aligned(c->count * sizeof(row_text));
    size_t drifts = study_aligned(c->count * c->invariants * sizeof(motus_drift));
    size_t head = study_aligned(sizeof(result)), names = study_aligned(c->invariants * sizeof(invariant_name));
    size_t row_list = study_aligned(c->count * sizeof(void *));
    size_t drift_list = study_aligned(c->count * c->invariants * sizeof(void *));
    char *block = take(c->s.allocator, head + rows + drifts + texts + names + row_list + drift_list, 1);
    if (!block) return no_memory(c, "the comparison");
    result *r = c->out = (result *)(void *)block;
    r->allocator = *c->s.allocator;
    r->rows = (motus_compare_row *)(void *)(block + head);
    r->drifts = (motus_drift *)(void *)(block + head + rows);
    r->texts = (row_text *)(void *)(block + head + rows + drifts);
    r->names = (invariant_name *)(void *)(block + head + rows + drifts + texts);
    r->row_list = (const motus_compare_row **)(void *)(block + head + rows + drifts + texts + names);
    r->drift_list = (const motus_drift **)(void *)(block + head + rows + drifts + texts + names + row_list);
    r->seen = (motus_comparison){c->count, r->row_list, r->reference, 0, r->remarks};
    for (size_t k = 0; k < c->invariants; k++)
        snprintf(r->names[k].text, sizeof r->names[k].text, "%s", motus_invariant_name(c->s.system, k, NULL));
    for (size_t k = 0; k < c->count; k++) {
        motus_drift *d = r->drifts + k * c->invariants;
        const motus_drift **list = r->drift_list + k * c->invariants;
        for (size_t i = 0; i < c->invariants; i++) {
            d[i] = (motus_drift){r->names[i].text, NAN, NAN, NAN, NAN, 0};
            list[i] = &d[i];
        }
        r->row_list[k] = &r->rows[k];
        r->rows[k] = (motus_compare_row){.method = r->texts[k].method,
                                         .step = NAN,
                                         .error_max_x = NAN,
                                         .error_max_v = NAN,
                                         .error_final_x = NAN,
                                         .error_final_v = NAN,
                                         .invariant_count = c->invariants,
                                         .invariants = list,
                                         .reversal = NAN,
                                         .note = r->texts[k].note,
                                         .error_max_s = NAN,
                                         .error_final_s = NAN};
    }
    return MOTUS_OK;
}

static motus_status find_columns(compare *c)
{
    study *s = &c->s;
    c->invariants = motus_invariant_count(s->system);
    c->first = take(s->allocator, c->invariants + 1, sizeof *c->first);
    if (!c->first) return no_memory(c, "the names of the invariants");
    for (int pass = 0; pass < 2; pass++) {
        c->columns = 0;
        for (size_t k = 0; k < c->invariants; k++) {
            size_t first, count;
            motus_status status =
                motus_column_find(s->system, motus_invariant_name(s->system, k, NULL), &first, &count, s->err);
            if (status != MOTUS_OK) return status;
            c->first[k] = c->columns;
            for (size_t i = 0; i < count && pass; i++) c->column[c->columns + i] = first + i;
            c->columns += count;
        }
        c->first[c->invariants] = c->columns;
        if (!pass && !(c->column = take(s->allocator, c->columns, sizeof *c->column)))
            return no_memory(c, "the columns of the invariants");
    }
    size_t most = c->columns ? STUDY_NUMBERS_MAX / c->columns : 0;
    c->samples_max = most > SAMPLES_MAX ? SAMPLES_MAX : most;
    c->column_scale = take(s->allocator, c->columns, sizeof(double));
    c->t = take(s->allocator, c->samples_max, sizeof(double));
    c->deviation = take(s->allocator, c->samples_max, sizeof(double));
    c->series = take(s->allocator, c->samples_max * c->columns, sizeof(double));
    c->y = take(s->allocator, s->numbers, sizeof(double));
    c->a = take(s->allocator, s->numbers, sizeof(double));
    if (!c->column_scale || !c->t || !c->deviation || !c->series || !c->y || !c->a)
        return no_memory(c, "the samples of the invariants");
    return MOTUS_OK;
}

/* The invariants along a run ------------------------------------------------------------------------------------- */

static motus_status observe_invariants(compare *c, motus_run *run, motus_error *err)
{
    if (!c->columns || c->samples >= c->samples_max) return MOTUS_OK;
    c->t[c->samples] = motus_run_time(run);
    motus_status status = motus_run_values(run, c->column, c->columns, c->series + c->samples * c->columns, err);
    c->samples += status == MOTUS_OK;
    return status;
}

/* Finds the number of invariant k that deviates most. */
static motus_drift deviation_of(compare *c, size_t k, int64_t evaluations, double *roundoff)
{
    motus_drift d = {c->out->names[k].text, NAN, NAN, NAN, NAN, 0};
    size_t worst = c->first[k];
    double largest = 0;
    for (size_t j = c->first[k]; j < c->first[k + 1]; j++) {
        double most = 0, size = 0;
        for (size_t i = 0; i < c->samples; i++) {
            double value = c->series[i * c->columns + j];
            most = study_larger(most, fabs(value - c->series[j]));
            size = study_larger(size, fabs(value));
        }
        if (j > c->first[k] && !(most > d.max_drift || isnan(most))) continue;
        worst = j;
        largest = size;
        d.max_drift = most;
    }
    if (c->samples == 0 || c->first[k] == c->first[k + 1]) return d;
    *roundoff = ROUNDING * DBL_EPSILON * (c->column_scale[worst] + largest) * sqrt((double)evaluations + 1);
    d.initial = c->series[worst];
    d.final = c->series[(c->samples - 1) * c->columns + worst];
    for (size_t i = 0; i < c->samples; i++) c->deviation[i] = c->series[i * c->columns + worst] - d.initial;
    trend_result trend = trend_find(c->t, c->deviation, c->samples, *roundoff);
    d.trend = trend.trend;
    d.trending = trend.trending;
    return d;
}

/* One row -------------------------------------------------------------------------------------------------------- */

static motus_status row_failed(compare *c, size_t k, motus_status status, const motus_error *e)
{
    if (study_fatal(status)) return study_tell(&c->s, status, e);
    c->out->rows[k].status = status;
    if (e->hint[0])
        snprintf(c->out->texts[k].note, sizeof c->out->texts[k].note, "%.300s: %.200s", e->message, e->hint);
    else
        snprintf(c->out->texts[k].note, sizeof c->out->texts[k].note, "%s", e->message);
    return MOTUS_OK;
}

/* Finds the step with which the method spends about def.evaluations. */
static motus_status equal_work_step(compare *c, size_t k, const char *method, double *step)
{
    study *s = &c->s;
    double span = fabs(s->until - s->from), wanted = (double)c->def.evaluations;
    int rate = c->facts[k].card->evaluations;
    int64_t n = (int64_t)fmax(1, floor(wanted / (rate > 0 ? rate : 1)));
    for (int attempt = 0; attempt < WORK_TRIES; attempt++) {
        motus_run *run = NULL;
        motus_error e = motus_default_error();
        *step = span / (double)n;
        motus_status status = study_run(s, method, *step, NAN, s->until, NULL, &run, &e);
        if (status == MOTUS_OK) status = motus_run_finish(run, &e);
        double spent = run ? (double)motus_run_now(run).evaluations : 0;
        motus_run_destroy(run);
        if (study_fatal(status)) return row_failed(c, k, status, &e);
        /* If this run failed, the row's own run will fail too and report it. */
        if (status != MOTUS_OK || spent <= 0 || fabs(spent - wanted) <= WORK_CLOSE * wanted) return MOTUS_OK;
        int64_t next = (int64_t)fmax(1, floor((double)n * wanted / spent));
        if (next == n) return MOTUS_OK;
        n = next;
    }
    *step = span / (double)n;
    return MOTUS_OK;
}

/* Advances by one interval of the grid, or to the end, and takes `samples` samples of the invariants. */
static motus_status advance(compare *c, motus_run *run, int64_t per, int64_t samples, bool last, double *seconds,
                            motus_error *e)
{
    motus_status status = MOTUS_OK;
    for (int64_t i = 0; i < samples && status == MOTUS_OK && !(last && motus_run_done(run)); i++) {
        double began = study_seconds();
        status = last && i + 1 == samples ? motus_run_finish(run, e) : motus_run_step(run, per / samples, e);
        *seconds += study_seconds() - began;
        if (status == MOTUS_OK) status = observe_invariants(c, run, e);
    }
    return status;
}

static motus_status forward(compare *c, size_t k, motus_run *run, const study_grid *g, int64_t per,
                            const double *reference_rows, motus_error *e)
{
    study *s = &c->s;
    motus_compare_row *row = &c->out->rows[k];
    int64_t samples = 1;
    while (2 * samples <= per && (2 * samples * (int64_t)g->points) < (int64_t)c->samples_max) samples *= 2;
    c->samples = 0;
    study_errors worst = {0, 0, 0};
    motus_status status = observe_invariants(c, run, e);
    for (size_t p = 0; p < g->points && status == MOTUS_OK; p++) {
        status = advance(c, run, per, samples, p + 1 == g->points, &row->seconds, e);
        if (status == MOTUS_OK) status = study_state(s, run, c->y, e);
        if (status != MOTUS_OK || !reference_rows) continue;
        const study_errors d = study_errors_of(s, c->y, reference_rows + p * s->numbers);
        worst.x = study_larger(worst.x, d.x);
        worst.v = study_larger(worst.v, d.v);
        worst.s = study_larger(worst.s, d.s);
        row->error_final_x = d.x;
        row->error_final_v = d.v;
        row->error_final_s = d.s;
    }
    if (status == MOTUS_OK && reference_rows) {
        row->error_max_x = worst.x;
        row->error_max_v = worst.v;
        row->error_max_s = worst.s;
        if (!isnan(c->acceleration))
            c->facts[k].miss = c->y[c->axis] - reference_rows[(g->points - 1) * s->numbers + c->axis];
    } else {
        row->error_final_x = row->error_final_v = row->error_final_s = NAN;
    }
    return status;
}

/* Runs from c->y at `until` back to the start with the steps in reverse order: a shorter last step comes first. */
static motus_status backward(compare *c, size_t k, const char *method, int64_t total, double last_step, motus_error *e)
{
    study *s = &c->s;
    motus_compare_row *row = &c->out->rows[k];
    double direction = s->until > s->from ? 1 : -1;
    double legs[3] = {s->until, s->from, s->from}, steps[2] = {row->step, row->step};
    int count = 1;
    if (last_step > 0 && total > 1) {
        legs[1] = s->from + direction * (double)(total - 1) * row->step;
        steps[0] = last_step;
        count = 2;
    } else if (last_step > 0) {
        steps[0] = last_step;
    }
    motus_status status = MOTUS_OK;
    for (int leg = 0; leg < count && status == MOTUS_OK; leg++) {
        motus_run *run = NULL;
        status = study_run(s, method, steps[leg], legs[leg], legs[leg + 1], c->y, &run, e);
        if (status == MOTUS_OK) status = motus_run_finish(run, e);
        if (status == MOTUS_OK) status = study_state(s, run, c->y, e);
        motus_run_destroy(run);
    }
    if (status == MOTUS_OK) row->reversal = study_measure(s, c->y, s->start).scaled;
    return status;
}

static motus_status make_row(compare *c, size_t k)
{
    study *s = &c->s;
    motus_compare_row *row = &c->out->rows[k];
    const char *method = c->methods[k];
    motus_error e = motus_default_error();
    snprintf(c->out->texts[k].method, sizeof c->out->texts[k].method, "%s", method);
    motus_status status = motus_method_find(method, &c->facts[k].card, &e);
    if (status != MOTUS_OK) return row_failed(c, k, status, &e);
    row->order = c->facts[k].card->order;
    status = motus_method_geometry(s->system, method, &c->facts[k].geometry, &e);
    if (status != MOTUS_OK) return row_failed(c, k, status, &e);

    row->step = c->step;
    double base = s->base, span = s->span;
    study_part(s, base, 0);
    if (c->def.evaluations > 0 && (status = equal_work_step(c, k, method, &row->step)) != MOTUS_OK) return status;
    study_part(s, base, span / 2);
    motus_run *run = NULL;
    if ((status = study_run(s, method, row->step, NAN, s->until, NULL, &run, &e)) != MOTUS_OK)
        return row_failed(c, k, status, &e);
    const motus_run_statistics made = motus_run_now(run);
    snprintf(c->out->texts[k].method, sizeof c->out->texts[k].method, "%s", made.method);
    int64_t per, total = made.steps_total;
    double last_step = made.shorter_last;
    c->facts[k].last_step = last_step;
    double full_steps = (double)(total - (last_step > 0));
    c->facts[k].expected = 0.5 * c->acceleration * (full_steps * row->step * row->step + last_step * last_step);
    study_grid g = study_grid_of(s, row->step, total, last_step, &per);
    const double *reference_rows = c->reference.known ? c->reference.rows + s->numbers : NULL;
    if (c->def.evaluations > 0 && reference_rows) {
        give(s->allocator, c->own_reference);
        c->own_reference = take(s->allocator, g.points * s->numbers, sizeof(double));
        status = c->own_reference ? solution_on(s, &c->reference, &g, c->own_reference)
                                  : no_memory(c, "the reference solution at the times of a method");
        reference_rows = c->own_reference;
    }
    if (status != MOTUS_OK) {
        motus_run_destroy(run);
        return status;
    }
    status = forward(c, k, run, &g, per, reference_rows, &e);
    row->steps = motus_run_steps(run);
    row->evaluations = motus_run_now(run).evaluations;
    motus_run_destroy(run);
    if (status != MOTUS_OK) return row_failed(c, k, status, &e);
    motus_drift *drifts = c->out->drifts + k * c->invariants;
    for (size_t i = 0; i < c->invariants; i++)
        drifts[i] = deviation_of(c, i, row->evaluations, &c->roundoff[k * c->invariants + i]);

    study_part(s, base + span / 2, span / 2);
    status = backward(c, k, method, total, last_step, &e);
    if (study_fatal(status)) return row_failed(c, k, status, &e);
    char *note = c->out->texts[k].note;
    if (status != MOTUS_OK)
        snprintf(note, MOTUS_TEXT_MAX, "on the way back: %.400s", e.message);
    else if (last_step > 0) {
        char until[DECIMAL_MAX];
        snprintf(note, MOTUS_TEXT_MAX, "the last step is %.6g, to end at %s", last_step,
                 decimal_time(s->until, s->until - s->from, until));
    }
    return MOTUS_OK;
}

/* The comparison ------------------------------------------------------------------------------------------------- */

/* Measures, at states along the motion, how much rounding changes the invariants, the fastest rate, and a constant
 * acceleration if there is one. */
static motus_status probe_motion(compare *c, const study_grid *g)
{
    study *s = &c->s;
    double direction = s->until > s->from ? 1 : -1;
    size_t count = c->reference.known ? PROBES : 1;
    c->rate = c->acceleration = NAN;
    if (motus_analysis_of(s->system, &c->analysis) != MOTUS_OK) return no_memory(c, "the analysis of the equations");
    if (c->analysis.constant && probe_acceleration(s, s->from, s->start, c->a))
        for (size_t k = 0; k < s->nx; k++)
            if (k == 0 || fabs(c->a[k]) > fabs(c->acceleration)) {
                c->axis = k;
                c->acceleration = c->a[k];
            }
    for (size_t p = 0; p < count; p++) {
        size_t r = count > 1 ? p * g->points / (count - 1) : 0;
        double t = r == g->points ? s->until : s->from + direction * (double)r * g->interval;
        const double *y = r == 0 ? s->start : c->reference.rows + r * s->numbers;
        double rate = probe_rate(s, t, y);
        c->rate = p == 0 ? rate : study_larger(c->rate, rate);
        if (c->columns) {
            motus_status status = probe_columns(s, t, y, c->column, c->columns, c->column_scale);
            if (status != MOTUS_OK) return status;
        }
    }
    return study_broken(s);
}

static motus_status prepare(compare *c, motus_system *system, motus_error *err)
{
    study *s = &c->s;
    motus_settings settings;
    motus_status status = study_settings(system, &c->def, &settings, err);
    if (status != MOTUS_OK) return status;
    c->step = settings.step;
    if (c->def.evaluations == 0 && !(c->step > 0)) {
        fail(err, MOTUS_ARGUMENT, "the comparison has no step: neither its definition nor the model gives one");
        hint(err, "give the definition a step; motus_suggest finds one");
        return MOTUS_ARGUMENT;
    }
    status = study_open(s, system, &c->def, &settings, c->def.evaluations > 0 ? 0 : c->step, err);
    if (status == MOTUS_OK) status = study_methods(s, &c->def, false, &c->methods, &c->count);
    if (status == MOTUS_OK) status = find_columns(c);
    if (status != MOTUS_OK) return status;
    c->facts = take(s->allocator, c->count, sizeof *c->facts);
    c->roundoff = take(s->allocator, c->count * c->invariants, sizeof(double));
    if (!c->facts || !c->roundoff) return no_memory(c, "the rows of the comparison");
    for (size_t k = 0; k < c->count; k++) {
        c->facts[k].miss = NAN;
        c->facts[k].roundoff = c->roundoff + k * c->invariants;
    }
    return make_result(c);
}

static motus_status compare_all(compare *c)
{
    study *s = &c->s;
    study_grid g = solution_grid(s, c->def.evaluations > 0 ? NAN : c->step);
    study_part(s, 0, REFERENCE_SHARE);
    motus_status status =
        solution_find(s, &g, c->def.evaluations > 0 ? c->def.evaluations : s->total, 0, &c->reference);
    if (status == MOTUS_OK) status = probe_motion(c, &g);
    for (size_t k = 0; k < c->count && status == MOTUS_OK; k++) {
        double share = (1 - REFERENCE_SHARE) / (double)c->count;
        study_part(s, REFERENCE_SHARE + share * (double)k, share);
        status = make_row(c, k);
    }
    if (status != MOTUS_OK) return status;
    snprintf(c->out->reference, sizeof c->out->reference, "%s", c->reference.text);
    c->out->seen.reference_error = c->reference.error;
    remarks_view view = {.s = s,
                         .analysis = c->analysis,
                         .reference = &c->reference,
                         .rows = c->out->rows,
                         .facts = c->facts,
                         .count = c->count,
                         .axis = c->axis,
                         .acceleration = c->acceleration,
                         .rate = c->rate};
    remarks_write(&view, c->out->remarks, sizeof c->out->remarks);
    return MOTUS_OK;
}

motus_status motus_compare(motus_system *system, const motus_study_def *given, motus_comparison **comparison,
                           motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!system || !comparison)
        return fail(err, MOTUS_ARGUMENT, "motus_compare needs a system and a place for its result");
    *comparison = NULL;
    compare c = {.rate = NAN, .analysis = motus_default_analysis()};
    const modes host = modes_enter();
    motus_status status = study_read(given, &c.def, err);
    if (status == MOTUS_OK) status = prepare(&c, system, err);
    if (status == MOTUS_OK) status = compare_all(&c);
    if (c.s.allocator) {
        const motus_allocator *a = c.s.allocator;
        solution_free(&c.s, &c.reference);
        void *blocks[] = {c.first, c.column, c.column_scale,  c.t,        c.deviation, c.series,
                          c.y,     c.a,      c.own_reference, c.roundoff, c.facts,     (void *)c.methods};
        for (size_t k = 0; k < sizeof blocks / sizeof *blocks; k++) give(a, blocks[k]);
        if (status == MOTUS_OK)
            *comparison = &c.out->seen;
        else
            give(a, c.out);
        study_close(&c.s);
    }
    modes_leave(host);
    return status;
}

void motus_comparison_destroy(motus_comparison *c)
{
    if (c) study_drop(c, ((result *)(void *)c)->allocator);
}
