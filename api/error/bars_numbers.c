/* The numbers of a run and of its companions at one instant, and the roundings of times that both share. See bars.h. */
#include "api/error/bars.h"

#include "api/system/columns.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void bars_give_up(motus_run *r, const char *format, ...)
{
    va_list list;
    if (!r->bars || r->bars->why[0]) return;
    va_start(list, format);
    vsnprintf(r->bars->why, sizeof r->bars->why, format, list);
    va_end(list);
    column_names_time(r->system, r->bars->why, sizeof r->bars->why);
}

void bars_again(motus_run *r, bool given)
{
    r->bars->started = false;
    r->bars->given_x = r->bars->given_v = given;
    r->bars->why[0] = 0;
    r->bars->ahead = false;
    give(&r->allocator, r->bars->resumed);
    r->bars->resumed = NULL;
}

differences_shape bars_shape(const motus_system *s, const motus_method *card, motus_bars kind, const int *how,
                             size_t count)
{
    return (differences_shape){.count = count,
                               .positions = s->positions,
                               .velocities = s->velocities,
                               .how = how,
                               .full = kind == MOTUS_BARS_FULL,
                               .slow = card->order == 1,
                               .kinked = s->model && !s->problem.traits.smooth};
}

/* ---- a state at another time ---- */

/* Copies a state to the room and moves it. */
static motus_status move_later(motus_system *s, double t, double late, const double *x, const double *v, double *room,
                               double **to_x, double **to_v, motus_error *err)
{
    const problem *p = &s->problem;
    double *const x1 = *to_x = room, *const v1 = *to_v = x1 + p->nx + 1, *const a = v1 + p->nv + 1;
    if (p->nx) memcpy(x1, x, p->nx * sizeof *x);
    memcpy(v1, v, p->nv * sizeof *v);
    const int answer = late == 0 ? 0 : system_later(s, t, late, x1, v1, a);
    return answer && !s->model ? columns_callback_failed("acceleration", t, answer, err) : MOTUS_OK;
}

motus_status bars_later(motus_run *r, motus_system *s, double t, double late, const double *x, const double *v,
                        double **to_x, double **to_v, motus_error *err)
{
    return move_later(s, t, late, x, v, r->bars->room, to_x, to_v, err);
}

/* Reads how a time was written. What the model computes by differences of decimals the companion's system has as it is
 * written. A decimal of at most 13 digits is exact, also where it was computed, as 1e9 + 0.3. Any other double of a
 * caller is the time itself; what the model computes, pi/2, lies within a unit in the last place. */
double bars_time_rounding(double t, double of_model, double of_half)
{
    enum { CLEARLY = 4 };
    const double unit = nextafter(t, INFINITY) - t;
    if (t == of_model && fabs(of_half - t) > CLEARLY * unit) return of_half - t;
    /* few doubles are such decimals by chance; powers of ten up to the largest are doubles */
    static const double most = 1e13, largest = 1e22;
    for (double power = 1; power <= largest && fabs(t) * power < most; power *= 10) {
        const double digits = rint(t * power);
        if (digits / power == t) return fma(-t, power, digits) / power;
    }
    return t == of_model ? unit : 0;
}

/* Part of a unit in the last place of the time: where the force depends on the time, run and companion begin their
 * steps at times with equal roundings. */
#define SHARED 0.5

static double shared_rounding(double t, const motus_system *s)
{
    return s->problem.traits.time ? SHARED * events_ulp(t) : 0;
}

double bars_end_rounding(double until, const motus_system *s, const motus_system *half)
{
    const double late =
        bars_time_rounding(until, s->model ? s->model->until : NAN, half && half->model ? half->model->until : NAN);
    return fabs(late) + shared_rounding(until, s);
}

double bars_events_late(const motus_run *r, double t) { return BARS_LASTING * 0x1p-52 * events_lasting(r->events, t); }

double bars_late(const motus_run *r, double t)
{
    const double end = t == r->timing.until ? bars_end_rounding(t, r->system, r->bars->half.system) : 0;
    return bars_events_late(r, t) + end;
}

/* ---- what is compared ---- */

motus_status bars_see(motus_run *r, motus_system *s, double t, double *x, double *v, int seen, motus_error *err)
{
    const bars *b = r->bars;
    return system_values(s, t, x, v, b->columns, b->count, b->differences.values[seen], err);
}

/* Widens the bars where events accumulate: the limit follows from the states before, which run and companion may have
 * in common, so the state is moved by as far as it may be off. */
static motus_status take_limit(motus_run *r, double t, const double *x, const double *v, motus_error *err)
{
    const problem *p = &r->system->problem;
    double *const other = take(&r->allocator, p->nx + p->nv + 2, sizeof *other), *const moved = other + p->nx + 1;
    if (!other) return fail(err, MOTUS_MEMORY, "no memory for the errors at a limit of events");
    const double *const off = events_limit_off(r->events);
    for (size_t k = 0; k < p->nx; k++) other[k] = x[k] + off[k];
    for (size_t k = 0; k < p->nv; k++) moved[k] = v[k] + off[p->nx + k];
    const motus_status status = bars_see(r, r->system, t, other, moved, 1, err);
    if (status == MOTUS_OK) differences_widen(&r->bars->differences);
    give(&r->allocator, other);
    return status;
}

/* Computes the numbers of a companion at the instant of the run's. At the end of a step that is t plus what the
 * rounding of the run's time has left out, up to 6e-8 s after 1e9 s; between steps t itself. */
static motus_status see_companion(motus_run *r, companion *c, double t, int seen, motus_error *err)
{
    motus_system *const s = c->system ? c->system : r->system;
    const double theirs = c->events ? c->t : t;
    const bool here = theirs == stepper_time(r->stepper), between = r->bars->differences.between;
    const double run_lost = between ? 0 : stepper_lost(r->stepper);
    const bool off = run_starts_late(&r->timing) && (here || between) && theirs == stepper_time(c->stepper);
    const double late = off ? run_lost - stepper_lost(c->stepper) : 0;
    double *x = c->x, *v = c->v;
    motus_status status = late == 0 ? MOTUS_OK : bars_later(r, s, theirs, late, c->x, c->v, &x, &v, err);
    return status == MOTUS_OK ? bars_see(r, s, theirs, x, v, seen, err) : status;
}

/* Widens the bars at a time within a step by whose end the companion is to be moved: the run may be astray there. */
static motus_status take_astray(motus_run *r, double t, motus_error *err)
{
    companion *c = &r->bars->half;
    motus_system *const s = c->system ? c->system : r->system;
    witness_move move;
    double *x, *v;
    if (!r->bars->differences.between || !witness_moves(r->bars->witness, &move) || !isnan(move.from)) return MOTUS_OK;
    motus_status status = bars_later(r, s, t, 0, c->x, c->v, &x, &v, err);
    for (size_t k = 0; k < r->system->problem.nx; k++) x[k] += move.x[k];
    for (size_t k = 0; k < r->system->problem.nv; k++) v[k] += move.v[k];
    if (status == MOTUS_OK) status = bars_see(r, s, t, x, v, 1, err);
    if (status == MOTUS_OK) differences_widen(&r->bars->differences);
    return status;
}

motus_status bars_moved(motus_system *s, double t, double late, const double *x, const double *v, const size_t *columns,
                        size_t count, double *room, double *out, motus_error *err)
{
    const problem *const p = &s->problem;
    double *to_x, *to_v, *const before = room + p->nx + 2 * p->nv + 3;
    motus_status status = move_later(s, t, 0, x, v, room, &to_x, &to_v, err);
    if (status == MOTUS_OK) status = system_values(s, t, to_x, to_v, columns, count, before, err);
    if (status == MOTUS_OK) status = move_later(s, t, late, x, v, room, &to_x, &to_v, err);
    if (status == MOTUS_OK) status = system_values(s, t, to_x, to_v, columns, count, out, err);
    for (size_t k = 0; status == MOTUS_OK && k < count; k++) {
        const double moved = fabs(out[k] - before[k]);
        out[k] = isfinite(moved) ? moved : 0;
    }
    return status;
}

/* Finds what roundings of times leave unknown of numbers: at the end, and anywhere after a late start. */
static motus_status take_times(motus_run *r, double t, const double *x, const double *v, motus_error *err)
{
    bars *b = r->bars;
    differences *f = &b->differences;
    motus_system *const s = b->half.system ? b->half.system : r->system;
    double late = run_starts_late(&r->timing) ? shared_rounding(t, s) : 0;
    if (t == r->timing.until) late = bars_end_rounding(t, r->system, s);
    memset(f->apart, 0, b->count * sizeof *f->apart);
    if (late == 0) return MOTUS_OK;
    const motus_status status = bars_moved(s, t, late, x, v, b->columns, b->count, b->room, f->apart, err);
    for (size_t k = 0; f->shape.how && k < b->count; k++)
        if (f->shape.how[k] != MOTUS_REDUCE_FINAL) f->apart[k] = 0;
    return status;
}

motus_status bars_take(motus_run *r, double t, double *x, double *v, bool observed, motus_error *err)
{
    bars *b = r->bars;
    const bool twin = b->kind == MOTUS_BARS_FULL && t == b->twin.t;
    motus_status status = bars_see(r, r->system, t, x, v, 0, err);
    if (status == MOTUS_OK) status = see_companion(r, &b->half, t, 1, err);
    if (status == MOTUS_OK && twin) status = see_companion(r, &b->twin, t, 2, err);
    if (status == MOTUS_OK) differences_take(&b->differences, t, observed, twin);
    if (status == MOTUS_OK) status = take_astray(r, t, err);
    if (status == MOTUS_OK) status = take_times(r, t, x, v, err);
    const bool limit = r->events && events_ended(r->events, NULL) == EVENTS_END_ACCUMULATED && t == run_time(r);
    return status == MOTUS_OK && limit ? take_limit(r, t, x, v, err) : status;
}

#define OWN 2.5
#define OWN_SLOW 3.75 /* for a method of order 1 */
double bars_part(const motus_run *r) { return r->bars->differences.shape.slow ? OWN_SLOW : OWN; }

double bars_of(const bars *b, double t, size_t number)
{
    const bool lost = !isnan(b->differences.until),
               known = !b->why[0] && (!b->gap || lost) && (lost || b->ahead || b->landed == t);
    return known ? differences_bar(&b->differences, number) : NAN;
}

double bars_worst(const bars *b, bool absolute, bool unknown)
{
    return b->why[0] ? NAN : differences_worst(&b->differences, absolute, unknown);
}
