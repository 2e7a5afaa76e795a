/* See accuracy.h.
 *
 * A plain run follows the motion. After every step the operands that have an infinite slope at 0 are evaluated; one
 * whose sign has changed has passed 0.
 */
#include "api/search/accuracy.h"

#include "api/search/pilot.h"
#include "api/system/columns.h"
#include "lang/tape/tape.h"

#include <math.h>
#include <string.h>

enum { FORMULAS = 16, STEPS = 1 << 14 }; /* at most */
#define TOLERANCE 1e-9                   /* of the run, which has only to be near the motion */

/* Operands with an infinite slope at 0, each for all cells of its equation. */
typedef struct operands {
    output of[FORMULAS];
    size_t count;
    arena arena;
    tape *tapes[FORMULAS]; /* one for each operand, because the cells of an equation have one place for a number */
} operands;

static bool find_operands(model *m, operands *o)
{
    const binding b = {m->arrays, m->ints, m->pool};
    o->count = 0;
    arena_init(&o->arena, &m->arena->allocator);
    for (size_t k = 0; k < m->accel_count; k++) {
        node of[FORMULAS];
        const size_t found = graph_steep(m->graph, m->accel[k].value, FORMULAS - o->count, of);
        for (size_t i = 0; i < found; i++) {
            o->of[o->count] = m->accel[k];
            o->of[o->count++].value = of[i];
        }
    }
    for (size_t k = 0; k < o->count; k++) {
        o->tapes[k] = tape_of(&o->arena, m->graph, &o->of[k], 1);
        if (!o->tapes[k] || !tape_bind(o->tapes[k], &b)) return false;
    }
    return !m->arena->failed;
}

/* Evaluates the operands at the run's state: for each of them one value per velocity, 0 where its equation has none. */
static motus_status look(motus_run *r, const operands *o, double *values, motus_error *err)
{
    const size_t nv = r->system->problem.nv;
    const motus_status status = run_sync(r, false, err);
    memset(values, 0, o->count * nv * sizeof *values);
    for (size_t k = 0; status == MOTUS_OK && k < o->count; k++) {
        double *const base[SPACES] = {[SPACE_X] = r->x, [SPACE_V] = r->v, [SPACE_A] = values + k * nv};
        tape_run(o->tapes[k], run_time(r), base);
    }
    return status;
}

/* Returns whether an operand has passed 0 since the time t, from the values `from` to `to`. */
static bool passes(const motus_run *r, const operands *o, double t, const double *from, const double *to, steep *out)
{
    const size_t nv = r->system->problem.nv;
    for (size_t k = 0; k < o->count * nv; k++) {
        if (!(from[k] * to[k] < 0) && !(from[k] == 0 && to[k] != 0)) continue;
        const double step = run_time(r) - t, at = t + step * (from[k] / (from[k] - to[k]));
        char when[DECIMAL_MAX], what[MOTUS_TEXT_MAX / 4];
        decimal_near(at, fmin(fabs(step), 1e-3 * fabs(at - r->timing.t0)), when);
        model_print(r->system->model, o->of[k / nv].value, what, sizeof what);
        error_text(out->text, "the force has an infinite slope where %s is 0, first at %s = %s", what,
                   columns_time(r->system), when);
        return true;
    }
    return false;
}

static motus_status follow(motus_run *r, const operands *o, double *from, steep *out, motus_error *err)
{
    double *to = from + o->count * r->system->problem.nv;
    motus_status status = look(r, o, from, err);
    for (int k = 0; status == MOTUS_OK && k < STEPS && !r->arrived; k++) {
        const double t = run_time(r);
        status = run_step(r, 1, err);
        if (status == MOTUS_OK) status = look(r, o, to, err);
        if (status != MOTUS_OK || passes(r, o, t, from, to, out)) break;
        double *const now = to;
        to = from, from = now;
    }
    return status;
}

static motus_status find(motus_system *s, const motus_run_def *given, const operands *o, steep *out, motus_error *err)
{
    const run_hint hint = {0};
    motus_run *r = NULL;
    motus_run_def def = *given;
    def.method = PILOT_FIRST;
    def.tolerance = TOLERANCE, def.absolute = false;
    def.step = def.accuracy = NAN;
    def.error = MOTUS_BARS_NONE;
    def.switches = MOTUS_SWITCHES_STEP; /* the force as it is written */
    def.machine = "interpreter";
    double *values = take(&s->allocator, 2 * o->count * s->problem.nv, sizeof *values);
    motus_status status = values ? run_create(s, &def, &hint, &r, err) : MOTUS_MEMORY;
    if (status == MOTUS_OK) status = follow(r, o, values, out, err);
    run_destroy(r);
    give(&s->allocator, values);
    return status;
}

motus_status steep_find(motus_system *s, const motus_run_def *def, steep *out, motus_error *err)
{
    operands o;
    if (out->known || !s->model) return MOTUS_OK;
    *out = (steep){.known = true};
    motus_error theirs = motus_default_error();
    motus_status status = find_operands(s->model, &o) ? MOTUS_OK : MOTUS_MEMORY;
    if (status == MOTUS_OK && o.count) status = find(s, def, &o, out, &theirs);
    arena_release(&o.arena);
    if (status == MOTUS_MEMORY) return fail(err, status, "no memory to look for infinite slopes");
    if (status != MOTUS_CANCELLED) return MOTUS_OK; /* a run that fails tells no more */
    if (err) motus_struct_write(MOTUS_DEF_ERROR, &theirs, err);
    return status;
}
