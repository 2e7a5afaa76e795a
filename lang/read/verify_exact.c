/* The check of exact lines [13]: they meet the initial values, and their second derivatives are the force. See
 * verify.h. The times are those of the golden section, at no simple fraction of the run. */
#include "lang/read/verify.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 64, SAMPLES_LEAST = 4 };
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
                    "the exact motion does not obey the equation: at %s = %s %s is %s, but the force gives %s; they "
                    "differ by %.2g",
                    m->time, decimal_time(s->t, m->until - m->start, time), name, a, b, s->e[k] - s->a[k]);
    source_hint(&m->source, "correct the exact line, or leave it out");
    return MOTUS_ARGUMENT;
}

static motus_status pole(model *m, double t)
{
    char time[DECIMAL_MAX];
    source_complain(&m->source, MOTUS_ARGUMENT, &exact_line(m)->at,
                    "the exact motion has a pole at %s = %s: it obeys the equation before that alone", m->time,
                    decimal_time(t, m->until - m->start, time));
    source_hint(&m->source, "let the run end before that: until = ...");
    return MOTUS_ARGUMENT;
}

static motus_status check_start(model *m, verify_sample *s)
{
    verify_sample_move(m, s, m->start);
    verify_sample_bound(m, s);
    size_t at = verify_sample_differs(s->x, m->x0, s->of_x, NULL, m->nx);
    if (at < m->nx) return wrong_start(m, s->x, m->x0, false, at);
    at = verify_sample_differs(s->v, m->v0, s->of_v, NULL, m->nv);
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
        const size_t at = verify_sample_at(m, s, k == 0 && !m->traits.smooth ? t + START * way : t);
        if (at < m->nv) return wrong_force(m, s, at);
    }
    verify_fault fault;
    if (verify_between(m, s, &fault) != MOTUS_OK) return MOTUS_MEMORY;
    if (!isnan(fault.pole)) return pole(m, fault.pole);
    return fault.number < m->nv ? wrong_force(m, s, fault.number) : MOTUS_OK;
}

motus_status verify_exact(model *m)
{
    verify_sample s;
    if (!verify_sample_take(m, &s)) return MOTUS_MEMORY;
    const motus_status status = check(m, &s);
    give(&m->arena->allocator, s.x);
    return status;
}
