/* The reference solution at any time, as a handle: motus_reference.
 *
 * The solution is computed once, as for compare, and its rows at the points of the grid are kept. A state at another
 * time is computed by the solution's method, with steps no larger than its own, from the last kept row before that
 * time, or from the last answer if that is nearer. Invariant: errors of answers do not accumulate, since each is less
 * than one interval of the grid away from a kept row.
 */
#include "solution.h"
#include "base/decimal.h"
#include <math.h>
#include <string.h>

struct motus_reference {
    study s;
    solution solution;
    study_grid grid;
    double *y;  /* the last answer */
    double t;   /* its time; NaN: none yet */
    bool holds; /* has called motus_system_hold, so that the system's numbers cannot change */
};

static double direction_of(const study *s) { return s->until > s->from ? 1 : -1; }

static motus_status answer(motus_reference *r, double t, motus_error *err)
{
    study *s = &r->s;
    /* The exact motion takes one step from the start, at no loss of accuracy. */
    size_t row = r->solution.exact ? 0 : solution_row(&r->grid, t);
    double from = solution_time(&r->grid, row), direction = direction_of(s);
    /* false for NaN */
    bool onward = !r->solution.exact && (r->t - from) * direction > 0 && (t - r->t) * direction >= 0;
    if (onward)
        from = r->t;
    else
        memcpy(r->y, r->solution.rows + row * s->numbers, s->numbers * sizeof(double));
    r->t = NAN; /* stays so if the run fails */
    motus_status status = solution_same_time(from, t) ? MOTUS_OK : solution_go(s, &r->solution, from, t, r->y, err);
    if (status == MOTUS_OK) r->t = t;
    return status;
}

static bool within(const study *s, double t)
{
    double most = s->until > s->from ? s->until : s->from, least = s->until > s->from ? s->from : s->until;
    return isfinite(t) && (t >= least || solution_same_time(t, least)) && (t <= most || solution_same_time(t, most));
}

motus_status motus_reference_at(motus_reference *r, const double *times, size_t count, double *x, double *v,
                                motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || (count && !times)) return fail(err, MOTUS_ARGUMENT, "motus_reference_at needs a reference and times");
    study *s = &r->s;
    motus_status status = MOTUS_OK;
    for (size_t k = 0; k < count && status == MOTUS_OK; k++)
        if (!within(s, times[k])) {
            char t[DECIMAL_MAX], from[DECIMAL_MAX], until[DECIMAL_MAX];
            status = fail(err, MOTUS_ARGUMENT, "time %zu, %s, is not between %s and %s", k + 1, decimal(times[k], t),
                          decimal(s->from, from), decimal(s->until, until));
            hint(err, "ask for times between the start and the end of the reference");
        }
    const modes host = modes_enter();
    for (size_t k = 0; k < count && status == MOTUS_OK; k++) {
        status = answer(r, times[k], err);
        if (status == MOTUS_OK && x) memcpy(x + k * s->nx, r->y, s->nx * sizeof(double));
        if (status == MOTUS_OK && v) memcpy(v + k * s->nv, r->y + s->nx, s->nv * sizeof(double));
    }
    modes_leave(host);
    return status;
}

static motus_status prepare(motus_reference *r, motus_system *system, const motus_study_def *given, motus_error *err)
{
    study *s = &r->s;
    motus_study_def def;
    motus_settings settings;
    motus_status status = study_read(given, &def, err);
    if (status == MOTUS_OK) status = study_settings(system, &def, &settings, err);
    if (status != MOTUS_OK) return status;
    const double step = settings.step_said == MOTUS_SAID_SUGGESTED ? NAN : settings.step;
    if ((status = study_open(s, system, &def, &settings, step, err)) != MOTUS_OK) return status;
    r->t = NAN;
    r->y = take(s->allocator, s->numbers, sizeof(double));
    if (!r->y) return fail(err, MOTUS_MEMORY, "out of memory for a state of %zu numbers", s->numbers);
    r->grid = solution_grid(s, step);
    const int64_t steps = isnan(step) ? STUDY_SAMPLES : s->total;
    if ((status = solution_find(s, &r->grid, steps, def.tolerance, &r->solution)) != MOTUS_OK) return status;
    if (!r->solution.known) return solution_missing(s, &r->solution, s->until);
    /* The caller's error and hook are valid during this call only. */
    s->err = NULL;
    s->progress = NULL;
    s->context = NULL;
    return MOTUS_OK;
}

motus_status motus_reference_create(motus_system *system, const motus_study_def *given, motus_reference **reference,
                                    motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!system || !reference)
        return fail(err, MOTUS_ARGUMENT, "motus_reference_create needs a system and a place for the reference");
    *reference = NULL;
    motus_reference *r = take(motus_system_allocator(system), 1, sizeof *r);
    if (!r) return fail(err, MOTUS_MEMORY, "out of memory for a reference");
    r->s.allocator = motus_system_allocator(system);
    const modes host = modes_enter();
    motus_status status = prepare(r, system, given, err);
    modes_leave(host);
    if (status != MOTUS_OK)
        motus_reference_destroy(r);
    else {
        motus_system_hold(system, r->holds = true);
        *reference = r;
    }
    return status;
}

double motus_reference_error(const motus_reference *r) { return r ? r->solution.error : NAN; }

const char *motus_reference_name(const motus_reference *r) { return r ? r->solution.text : ""; }

void motus_reference_destroy(motus_reference *r)
{
    if (!r) return;
    const motus_allocator allocator = *r->s.allocator;
    motus_system *const used = r->holds ? r->s.system : NULL;
    solution_free(&r->s, &r->solution);
    give(&allocator, r->y);
    study_close(&r->s);
    give(&allocator, r);
    if (used) motus_system_hold(used, false);
}
