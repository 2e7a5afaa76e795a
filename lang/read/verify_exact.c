/* The check of exact lines [13]: they meet the initial values, and their second derivatives are the force. See
 * verify.h. The times are those of the golden section, at no simple fraction of the run. */
#include "lang/read/verify.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SAMPLES = 64, SAMPLES_LEAST = 4, ARRAYS = 12 };
#define START 1e-10  /* of the run: the first sample of a force with switches */
#define WORK_MAX 1e7 /* operations: of large models fewer times are sampled */

bool verify_exact_make(model *m)
{
    graph *g = m->graph;
    verify *c = m->verify;
    output *second = arena_room(m->arena, (m->exact_count + 1) * sizeof *second);
    if (!second) return false;
    size_t count = 0;
    for (size_t i = 0; i < m->exact_count; i++)
        if (m->arrays[m->exact[i].to.array].space == SPACE_V) {
            output o = m->exact[i];
            o.value = graph_derivative(g, o.value, graph_seed_time, NULL);
            o.to.array = (uint16_t)(o.to.array - m->block[BLOCK_V] + m->block[BLOCK_A]);
            second[count++] = o;
        }
    c->motion = verify_tape(m, m->exact, m->exact_count);
    c->second = verify_tape(m, second, count);
    if (!verify_between_make(m)) return false;
    if (!c->bounded) return true;
    c->motion_rounding = verify_tape(m, verify_rounding(m, m->exact, m->exact_count, verify_leaf), m->exact_count);
    c->second_rounding = verify_tape(m, verify_rounding(m, second, count, verify_leaf), count);
    return true;
}

static const statement *exact_line(const model *m)
{
    for (uint32_t i = 0; i < m->statements.count; i++)
        if (m->statements.item[i].kind == STATEMENT_EXACT) return &m->statements.item[i];
    return NULL;
}

static void place(verify_sample *s, size_t n, double *at)
{
    double **arrays[] = {&s->x, &s->v, &s->e, &s->a, &s->of_x, &s->of_v, &s->of_a, &s->of_e, &s->room};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) *arrays[k] = at + k * n; /* room: to the end */
}

void verify_exact_move(const model *m, verify_sample *s, double t)
{
    const verify *c = m->verify;
    double *motion[SPACES] = {[SPACE_X] = s->x, [SPACE_V] = s->v};
    s->t = t;
    memcpy(s->x, m->x0, m->nx * sizeof *s->x);
    memcpy(s->v, m->v0, m->nv * sizeof *s->v);
    tape_run(c->motion, s->t, motion);
    if (c->boundary) tape_run(c->boundary, s->t, motion);
}

/* The sizes of the motion and the roundings of its formula. */
static void bound(const model *m, verify_sample *s)
{
    const verify *c = m->verify;
    verify_size(m, verify_fastest(m, s->t, s->x, s->v, s->room), s->x, s->v, s->of_x, s->of_v);
    if (!c->motion_rounding) return;
    double *x = s->room, *v = x + m->nv, *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v};
    for (size_t k = 0; k < m->nv; k++) x[k] = v[k] = 0;
    tape_run(c->motion_rounding, s->t, base);
    for (size_t k = 0; k < m->nx; k++) s->of_x[k] += x[k];
    for (size_t k = 0; k < m->nv; k++) s->of_v[k] += v[k];
}

static void accelerate(const model *m, verify_sample *s)
{
    const verify *c = m->verify;
    double *second[SPACES] = {[SPACE_A] = s->e}, *rounded[SPACES] = {[SPACE_A] = s->of_e},
           *force[SPACES] = {
               [SPACE_X] = s->x, [SPACE_V] = s->v, [SPACE_A] = s->of_a, [SPACE_DX] = s->of_x, [SPACE_DV] = s->of_v};
    verify_force(m, s->t, s->x, s->v, s->a);
    for (size_t k = 0; k < m->nv; k++) s->e[k] = s->of_a[k] = s->of_e[k] = 0;
    tape_run(c->second, s->t, second);
    if (c->second_rounding) {
        tape_run(c->second_rounding, s->t, rounded);
        tape_run(c->force_rounding, s->t, force);
        return;
    }
    double most = 0;
    for (size_t k = 0; k < m->nv; k++) most = fmax(most, fabs(s->a[k]) + fabs(s->e[k]));
    for (size_t k = 0; k < m->nv; k++) s->of_a[k] = 1e5 * most;
}

/* The first number that differs by more than rounding; n: none does. An infinite rounding allows any finite number. */
static size_t differs(const double *is, const double *due, const double *of, const double *more, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        const double allowed = EXACT_ROUNDING * (of[k] + (more ? more[k] : 0));
        if (!isfinite(is[k]) || !isfinite(due[k]) || fabs(is[k] - due[k]) > allowed) return k;
    }
    return n;
}

static motus_status wrong_start(model *m, const double *is, const double *due, bool in_v, size_t k)
{
    char name[MOTUS_NAME_MAX + 64], a[VERIFY_DIGITS], b[VERIFY_DIGITS];
    model_name(m, in_v, k, name, sizeof name);
    verify_digits(is[k], due[k], a, b);
    source_complain(&m->source, MOTUS_ARGUMENT, &exact_line(m)->at,
                    "the exact motion does not meet the initial value: %s is %s at the start, not %s; they differ by "
                    "%.2g",
                    name, a, b, is[k] - due[k]);
    source_hint(&m->source, "give the initial value by its formula, with all its digits, or correct the exact line");
    return MOTUS_ARGUMENT;
}

static motus_status wrong_force(model *m, const verify_sample *s, size_t k)
{
    char name[MOTUS_NAME_MAX + 64], a[VERIFY_DIGITS], b[VERIFY_DIGITS], time[DECIMAL_MAX];
    model_name(m, true, k, name, sizeof name - 1);
    char *prime = strchr(name, '\'');
    if (prime) memmove(prime + 1, prime, strlen(prime) + 1);
    verify_digits(s->e[k], s->a[k], a, b);
    source_complain(&m->source, MOTUS_ARGUMENT, &exact_line(m)->at,
                    "the exact motion does not obey the equation: at t = %s %s is %s, but the force gives %s; they "
                    "differ by %.2g",
                    decimal_time(s->t, m->until - m->start, time), name, a, b, s->e[k] - s->a[k]);
    source_hint(&m->source, "correct the exact line, or leave it out");
    return MOTUS_ARGUMENT;
}

static motus_status pole(model *m, double t)
{
    char time[DECIMAL_MAX];
    source_complain(&m->source, MOTUS_ARGUMENT, &exact_line(m)->at,
                    "the exact motion has a pole at t = %s: it obeys the equation before that alone",
                    decimal_time(t, m->until - m->start, time));
    source_hint(&m->source, "let the run end before that: until = ...");
    return MOTUS_ARGUMENT;
}

size_t verify_exact_at(const model *m, verify_sample *s, double t)
{
    verify_exact_move(m, s, t);
    bound(m, s);
    accelerate(m, s);
    return differs(s->e, s->a, s->of_a, s->of_e, m->nv);
}

static motus_status check_start(model *m, verify_sample *s)
{
    verify_exact_move(m, s, m->start);
    bound(m, s);
    size_t at = differs(s->x, m->x0, s->of_x, NULL, m->nx);
    if (at < m->nx) return wrong_start(m, s->x, m->x0, false, at);
    at = differs(s->v, m->v0, s->of_v, NULL, m->nv);
    return at < m->nv ? wrong_start(m, s->v, m->v0, true, at) : MOTUS_OK;
}

static motus_status check(model *m, verify_sample *s)
{
    const double way = isfinite(m->until) ? m->until - m->start : 1, golden = 0.61803398874989485;
    const double work = fmax(m->terms, (double)m->nv) * (1 + (double)m->verify->nodes);
    const int samples = work * SAMPLES < WORK_MAX ? SAMPLES : (int)fmax(SAMPLES_LEAST, WORK_MAX / work);
    const motus_status start = check_start(m, s);
    if (start != MOTUS_OK) return start;
    for (int k = 0; k <= samples; k++) {
        const double t = m->start + way * (k * golden - floor(k * golden));
        /* at the start a switch may be in neither of its sides, which lasts for no time */
        const size_t at = verify_exact_at(m, s, k == 0 && !m->traits.smooth ? t + START * way : t);
        if (at < m->nv) return wrong_force(m, s, at);
    }
    verify_fault fault;
    if (verify_between(m, s, &fault) != MOTUS_OK) return MOTUS_MEMORY;
    if (!isnan(fault.pole)) return pole(m, fault.pole);
    return fault.number < m->nv ? wrong_force(m, s, fault.number) : MOTUS_OK;
}

static bool bind(const model *m)
{
    const verify *c = m->verify;
    tape *const tapes[] = {c->motion,          c->motion_rounding, c->second,
                           c->second_rounding, c->boundary,        c->force_rounding};
    return verify_bind(m, tapes, sizeof tapes / sizeof *tapes);
}

motus_status verify_exact(model *m)
{
    if (!bind(m)) return MOTUS_MEMORY;
    const size_t n = m->nv + 1;
    double *room = take(&m->arena->allocator, ARRAYS * n, sizeof *room);
    if (!room) return MOTUS_MEMORY;
    verify_sample s = {0};
    place(&s, n, room);
    const motus_status status = check(m, &s);
    give(&m->arena->allocator, room);
    return status;
}

bool verify_exact_rounding(model *m, double t, double *x, double *v)
{
    const size_t n = m->nv + 1;
    double *room = bind(m) ? take(&m->arena->allocator, ARRAYS * n, sizeof *room) : NULL;
    if (!room) return false;
    verify_sample s = {0};
    place(&s, n, room);
    verify_exact_move(m, &s, t);
    bound(m, &s);
    memcpy(x, s.of_x, m->nx * sizeof *x);
    memcpy(v, s.of_v, m->nv * sizeof *v);
    give(&m->arena->allocator, room);
    return true;
}
